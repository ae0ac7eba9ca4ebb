"""What `--cull back` saves on a closed ball of 65,536 triangles, and what it changes in the picture."""
import dataclasses
import math
import tempfile

from parts.instructions import callgrind_count, no_count_at_all
from parts.measuring import write_csv
from parts.tradeoff_measure import TOOLS, Bench, cpu_seconds_in_turn, median_ratio
from parts.tradeoff_scenes import grid, scene

CAMERA = ["1.8 1.2 2.4", "0 0 0", "0 1 0", "40 1.3333333333333333 1 10"]
LOOKS = ["color 235 150 60", "attributes normal", "ambient 0.15 0.15 0.2", "material 1 0.8 0.5 40", "light -3 2 5 0.9 0.9 0.85"]


@dataclasses.dataclass(frozen=True)
class CullSetting:
    coverage: str
    cull: tuple = ()

    def __str__(self):
        return f"--coverage {self.coverage}" + (" --cull back" if self.cull else "")

    def command(self, bin_dir, tool):
        options = {"project": self.cull, "zbuf": ("--coverage", self.coverage, "--image", "picture.ppm", "config.txt")}
        return [str(bin_dir / tool), *options.get(tool, ())]


PAIRS = [(CullSetting(rule), CullSetting(rule, ("--cull", "back"))) for rule in ("nearest", "center")]


def closed_ball(rings, sectors):
    """2 * (RINGS - 1) * SECTORS triangles, each vertex with its normal. No gap at the poles: of each cell there, the triangle
    without area is left out."""
    def corner(i, k):
        u, v = math.pi * i / rings, math.tau * (k % sectors) / sectors
        n = (math.sin(u) * math.cos(v), math.cos(u), math.sin(u) * math.sin(v))
        return (*n, *n) if 0 < i < rings else (0, n[1], 0, 0, n[1], 0)

    return (triangle for triangle in grid(rings, sectors, corner) if len(set(triangle)) == 3)


def ball_scene(quick):
    detail, size = ((9, 16), (60, 45)) if quick else ((129, 256), (480, 360))
    return scene("ball", "a closed ball", CAMERA, LOOKS, closed_ball(*detail), size)


def instructions(bench, setting):
    """Of each stage of the pipe; empty where they cannot be counted."""
    if no_count_at_all():
        return {}
    text, counts = bench.scene.text.encode(), {}
    for tool in TOOLS:
        (bench.folder / "stage.txt").write_bytes(text)
        counts[tool] = callgrind_count([*setting.command(bench.bin_dir, tool), "stage.txt"], bench.folder)
        text = bench.run(tool, setting, text)
    return counts


def measured_on(bench, rounds):
    """A row for each coverage rule: the cost of culling relative to none, and how many channels of the picture change."""
    seconds = cpu_seconds_in_turn(bench, [setting for pair in PAIRS for setting in pair], rounds)
    for plain, culled in PAIRS:
        pictures = [bench.picture(setting) for setting in (plain, culled)]
        row = {"triangles": bench.scene.triangle_count, "coverage": plain.coverage,
               "ratio_median": median_ratio(seconds[culled], seconds[plain]),
               "channels": len(pictures[0]), "channels_changed": sum(a != b for a, b in zip(*pictures))}
        for setting, name in (plain, "instructions"), (culled, "instructions_culled"):
            row.update({f"{tool}_{name}": count for tool, count in instructions(bench, setting).items()})
        yield row


def change(row, tools):
    """The instructions that culling saves on these tools, in per cent."""
    if f"{tools[0]}_instructions" not in row:
        return "not counted"
    plain, culled = (sum(row[f"{tool}_{name}"] for tool in tools) for name in ("instructions", "instructions_culled"))
    return f"{100 * culled / plain - 100:+.0f} %"


def table(rows):
    lines = [f"| ball of {rows[0]['triangles']:,} triangles | CPU time | instructions | of `project` and `zbuf` | channels of the picture that change |",
             "|---|--:|--:|--:|--:|"]
    lines += [f"| `--cull back`, `--coverage {row['coverage']}` | {row['ratio_median']:.2f} | {change(row, TOOLS)} | {change(row, TOOLS[2:])} | "
              f"{row['channels_changed']:,} of {row['channels']:,} |" for row in rows]
    return "\n".join(lines) + "\n"


def measure(bin_dir, out, quick, rounds):
    """Writes culling.csv to `out`; gives the table."""
    with tempfile.TemporaryDirectory() as folder:
        rows = list(measured_on(Bench(bin_dir, folder, ball_scene(quick)), rounds))
    write_csv(out / "culling.csv", rows)
    return table(rows)
