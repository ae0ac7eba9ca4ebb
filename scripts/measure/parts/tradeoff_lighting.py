"""The cost of clipping, shading models and samples, and how far the pictures are from 8 x 8 supersampling."""
import dataclasses
import pathlib
import statistics
import tempfile

from parts.measuring import write_csv
from parts.tradeoff_measure import Bench, cpu_seconds_in_turn, median_ratio
from parts.tradeoff_scenes import Scene

SAMPLES = pathlib.Path(__file__).resolve().parents[3] / "samples"
TITLES = {"shaded-torus": "torus", "inside": "room from inside"}


@dataclasses.dataclass(frozen=True)
class LightSetting:
    clip: str = "auto"
    shading: str = "phong"
    samples: str = "1"

    def __str__(self):
        changed = [f"--{f.name} {getattr(self, f.name)}" for f in dataclasses.fields(self)
                   if getattr(self, f.name) != f.default]
        return " ".join(changed) or "default"

    def command(self, bin_dir, tool):
        options = {"project": ["--clip", self.clip],
                   "zbuf": ["--shading", self.shading, "--samples", self.samples, "--image", "picture.ppm", "config.txt"]}
        return [str(bin_dir / tool), *options.get(tool, [])]


BASE = LightSetting()
FINEST = LightSetting(samples="8")
SETTINGS = [BASE, *(LightSetting(shading=model) for model in ("none", "flat", "gouraud")),
            *(LightSetting(samples=count) for count in ("2", "4", "8")),
            *(LightSetting(clip=mode) for mode in ("near", "frustum", "reject")),
            *(LightSetting(shading=model, samples="4") for model in ("flat", "gouraud"))]


def settings_of(scene):
    """A viewer inside a room has triangles behind the eye, which must be clipped."""
    return [setting for setting in SETTINGS if scene.name != "inside" or setting.clip != "reject"]


def scenes(quick):
    size = (60, 45) if quick else (480, 360)
    for name, title in TITLES.items():
        text = (SAMPLES / name / "scene.txt").read_text()
        yield Scene(name, title, text, *size, text.count("triangle\n"))


def measured_on(bench, rounds):
    """A row for each setting: its cost, and the mean and largest difference of a channel from FINEST."""
    settings = settings_of(bench.scene)
    seconds = cpu_seconds_in_turn(bench, settings, rounds)
    finest = bench.picture(FINEST)
    for setting in settings:
        differences = [abs(a - b) for a, b in zip(bench.picture(setting), finest)]
        yield {"scene": bench.scene.name, "setting": str(setting),
               "seconds_median": statistics.median(seconds[setting]),
               "ratio_median": median_ratio(seconds[setting], seconds[BASE]),
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
    """Writes lighting.csv to `out`; gives the table."""
    rows = []
    for scene in scenes(quick):
        with tempfile.TemporaryDirectory() as folder:
            rows += measured_on(Bench(bin_dir, folder, scene), rounds)
    write_csv(out / "lighting.csv", rows)
    return table(rows)
