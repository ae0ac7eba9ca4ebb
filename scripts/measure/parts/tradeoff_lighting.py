"""The cost of culling, clipping, shading models and samples, and how far the pictures are from 8 x 8 supersampling."""
import dataclasses
import pathlib
import random
import statistics
import tempfile

from parts.measuring import put_between, write_csv
from parts.tradeoff_measure import Bench, ratios_of
from parts.tradeoff_scenes import Scene

SAMPLES = pathlib.Path(__file__).resolve().parents[3] / "samples"
TITLES = {"shaded-torus": "torus", "inside": "room from inside"}


@dataclasses.dataclass(frozen=True)
class LightSetting:
    cull: str = ""
    clip: str = "auto"
    shading: str = "phong"
    samples: str = "1"

    def __str__(self):
        changed = [f"--{f.name} {getattr(self, f.name)}" for f in dataclasses.fields(self)
                   if getattr(self, f.name) != f.default]
        return " ".join(changed) or "default"

    def command(self, bin_dir, tool):
        options = {"project": ["--clip", self.clip] + (["--cull", self.cull] if self.cull else []),
                   "zbuf": ["--shading", self.shading, "--samples", self.samples, "--image", "picture.ppm", "config.txt"]}
        return [str(bin_dir / tool), *options.get(tool, [])]


BASE = LightSetting()
FINEST = LightSetting(samples="8")
SETTINGS = [BASE, *(LightSetting(shading=model) for model in ("none", "flat", "gouraud")),
            *(LightSetting(samples=count) for count in ("2", "4", "8")),
            *(LightSetting(clip=mode) for mode in ("near", "frustum", "reject")), LightSetting(cull="back"),
            *(LightSetting(shading=model, samples="4") for model in ("flat", "gouraud"))]


def settings_of(scene):
    """A viewer inside a room has triangles behind the eye, which must be clipped."""
    return [setting for setting in SETTINGS if scene.name != "inside" or setting.clip != "reject"]


def scenes(quick):
    size = (60, 45) if quick else (480, 360)
    for name, title in TITLES.items():
        text = (SAMPLES / name / "scene.txt").read_text()
        yield Scene(name, title, text, *size, text.count("triangle\n"))


def picture(bench, setting):
    text = bench.scene.text.encode()
    for tool in ("model", "view", "project", "zbuf"):
        text = bench.run(tool, setting, text)
    return (bench.folder / "picture.ppm").read_bytes()[-3 * bench.scene.columns * bench.scene.rows:]


def measured_on(bench, rounds):
    """A row for each setting: its cost, and the mean and largest difference of a channel from FINEST."""
    settings = settings_of(bench.scene)
    dice, seconds = random.Random(1), {setting: [] for setting in settings}
    for _ in range(rounds):
        for setting in dice.sample(settings, len(settings)):
            seconds[setting].append(sum(bench.cpu_seconds(setting)))
    finest = picture(bench, FINEST)
    for setting in settings:
        differences = [abs(a - b) for a, b in zip(picture(bench, setting), finest)]
        yield {"scene": bench.scene.name, "setting": str(setting),
               "seconds_median": statistics.median(seconds[setting]),
               "ratio_median": statistics.median(ratios_of(seconds[setting], seconds[BASE])),
               "difference_mean": statistics.fmean(differences), "difference_max": max(differences)}


def table(rows):
    names = list(TITLES)
    by_key = {(row["scene"], row["setting"]): row for row in rows}
    lines = ["| setting | " + " | ".join(f"{TITLES[name]}: CPU time | mean difference | largest" for name in names) + " |",
             "|---|" + "--:|" * (3 * len(names))]
    for setting in SETTINGS:
        cells = [str(setting) if setting == BASE else f"`{setting}`"]
        for name in names:
            row = by_key.get((name, str(setting)))
            cells += (["%.2f" % row["ratio_median"], "%.2f" % row["difference_mean"], str(row["difference_max"])]
                      if row else ["", "must cut", ""])
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def measure(bin_dir, out, quick, rounds):
    """Writes lighting.csv and lighting.md to `out`; gives the table."""
    rows = []
    for scene in scenes(quick):
        with tempfile.TemporaryDirectory() as folder:
            rows += measured_on(Bench(bin_dir, folder, scene), rounds)
    write_csv(out / "lighting.csv", rows)
    (out / "lighting.md").write_text("# What light and smooth edges cost\n\n" + table(rows))
    return table(rows)


def put_into_readme(readme, words, machine, rounds):
    put_between(readme, "lighting", words + f"""
CPU time is that of the whole pipe at 480 x 360 pixels, relative to the default's (phong, one sample), the median of {rounds} rounds on {machine}.
""")
