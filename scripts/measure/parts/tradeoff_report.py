"""The tables of scripts/measure/tradeoff."""
import statistics

from parts.tradeoff_measure import ratios_of



class Results:
    """The rows of tradeoff.csv: cell(scene, setting, column) is a number, or None if not measured."""

    def __init__(self, rows):
        self.rows = {(row["scene"], row["setting"]): row for row in rows}
        self.settings = list(dict.fromkeys(row["setting"] for row in rows))
        scenes = list(dict.fromkeys(row["scene"] for row in rows))
        self.cost_scenes = [scene for scene in scenes if self.rows[scene, "default"]["runs_seconds"]]
        self.error_scenes = [scene for scene in scenes if self.rows[scene, "default"]["covered_pixels"]]
        self.machine = rows[0]["machine"]
        self.rounds = len(self.runs(self.cost_scenes[0], "default"))

    def cell(self, scene, setting, column):
        text = self.rows[scene, setting][column]
        return float(text) if text else None

    def runs(self, scene, setting):
        return [float(word) for word in self.rows[scene, setting]["runs_seconds"].split()]

    def share(self, scene, setting, *columns):
        """The sum of columns as a share of the covered pixels."""
        count = sum(self.cell(scene, setting, column) for column in columns)
        return count / self.cell(scene, setting, "covered_pixels")


def code(setting):
    return setting if setting == "default" else f"`{setting}`"


def number(value, digits=2):
    """A few digits, with a power of ten only if that is shorter."""
    if value is None:
        return ""
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        decimals = max(0, digits - 1 - int(f"{value:e}".split("e")[1]))
        return f"{value:.{decimals}f}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def percent(share):
    return "0" if share == 0 else f"{number(100 * share)} %"


def table(header, rows):
    lines = ["| " + " | ".join(cells) + " |" for cells in (header, *rows)]
    lines.insert(1, "|---|" + "--:|" * (len(header) - 1))
    return "\n".join(lines) + "\n"


def cost_table(results):
    def cells(setting):
        def cell(scene, column):
            return results.cell(scene, setting, column)
        yield code(setting)
        columns = [f"seconds_per_million_{kind}" for kind in ("median", "min", "max")]
        yield "%.2f (%.2f-%.2f)" % tuple(cell("unit", column) for column in columns)
        for scene in results.cost_scenes:
            yield "%.2f (%.2f-%.2f)" % tuple(cell(scene, f"ratio_{kind}") for kind in ("median", "min", "max"))
        yield number(cell("unit", "bytes_per_triangle"), 3)

    header = ["setting", "CPU s per million triangles, unit", *(f"ratio, {scene}" for scene in results.cost_scenes),
              "bytes per triangle"]
    return table(header, [list(cells(setting)) for setting in results.settings])


def error_table(results, text_of_cell):
    return table(["setting", *results.error_scenes],
                 [[code(setting), *(text_of_cell(scene, setting) for scene in results.error_scenes)]
                  for setting in results.settings])


# Settings whose base is not the default but the same setting without its last option.
BASES = {"--digits exact --precision double": "--digits exact"}
SPEED = "speed"


def gains(results, setting):
    """(the gain, scenes) against its base. Speed: 3 % less CPU time, by the median of the ratios and by the
    fastest runs. Accuracy: a tenth of an error, and for pixels 10 fewer."""
    base = BASES.get(setting, "default")

    def is_faster(scene):
        own, other = results.runs(scene, setting), results.runs(scene, base)
        return max(statistics.median(ratios_of(own, other)), min(own) / min(other)) <= 0.97

    def is_better(scene, columns, least):
        values = [[results.cell(scene, name, column) for column in columns] for name in (setting, base)]
        if None in values[0] + values[1]:
            return False
        own, other = map(sum, values)
        return own <= other / 10 and other - own > least

    yield SPEED, [scene for scene in results.cost_scenes if is_faster(scene)]
    for what, columns, least in (("vertices", ["vertex_error_pixels"], 0), ("depths", ["depth_error_median"], 0),
                                 ("pixels", ["flipped_pixels", "wrong_pixels"], 9),
                                 ("edges", ["off_center_pixels"], 9)):
        yield what, [scene for scene in results.error_scenes if is_better(scene, columns, least)]


def gains_table(results):
    def named(scenes):
        return "all" if len(scenes) == len(results.error_scenes) else ", ".join(scenes)

    def cells(setting):
        bought = dict(gains(results, setting))
        yield code(setting) + (f", against `{BASES[setting]}`" if setting in BASES else "")
        yield ", ".join(bought.pop(SPEED)) or "-"
        yield "; ".join(f"{what}: {named(scenes)}" for what, scenes in bought.items() if scenes) or "-"

    return table(["setting", "buys speed on", "buys accuracy on"],
                 [list(cells(setting)) for setting in results.settings[1:]])


def report(results):
    def vertex(scene, setting):
        return number(results.cell(scene, setting, "vertex_error_pixels"))

    def off_center(scene, setting):
        return percent(results.share(scene, setting, "off_center_pixels"))

    def pixels(scene, setting):
        counts = [results.cell(scene, setting, f"{kind}_pixels") for kind in ("flipped", "wrong", "neighbor")]
        return " / ".join("%d" % count for count in counts) if any(counts) else "0"

    def depth(scene, setting):
        errors = [results.cell(scene, setting, f"depth_error_{kind}") for kind in ("median", "max")]
        return " / ".join(map(number, errors)) if None not in errors else "none"

    return f"""# What accuracy costs

Written by `scripts/measure/tradeoff`; all numbers are in [tradeoff.csv](tradeoff.csv). A setting is named by what differs from
the default, `--digits 7 --precision extended --coverage nearest --depth f64`.

![time against error](tradeoff.svg)

## Cost

CPU time of the whole pipe `model | view | project | zbuf` on {results.machine}:
the median of {results.rounds} runs, in brackets the smallest and the largest. A ratio is to the default's time in the same
round. Bytes are those in the three pipes together. In `fill`, 40 rectangles as large as a picture of 1400 x 1400, nearly
all time goes into pixels.

{cost_table(results)}
## What it gives up

Against a lossless run (`--digits exact --precision extended --depth f64`) with the same rule of coverage.

Largest error of a vertex on the screen, in pixels:

{error_table(results, vertex)}
Pixels: flipped (covered here or there, not in both) / wrong (a triangle that should be hidden) / neighbor (one that
shares a vertex with the right triangle). `nearest` lights pixels on a common edge twice, and which of the two triangles
is nearer there hangs on the last bits of their depths: hence neighbors, whatever the number of digits.

{error_table(results, pixels)}
Depth (NDC z) where the right triangle is seen: median / largest error. The largest are on triangles seen nearly
edge-on, of which a pixel shows depths from end to end.

{error_table(results, depth)}
Pixels that show another triangle than the nearest in which their center lies, as a share of those covered:

{error_table(results, off_center)}
## What each value buys

Speed: 3 % less CPU time, both by the median of the ratios and by the fastest runs. Accuracy: a tenth of an error or
less (vertices: the largest; depths: the median; pixels: flipped and wrong; edges: the last table above; the last two
by 10 pixels at least).

{gains_table(results)}"""


# docs/accuracy.md

SHORT_SETTINGS = [
    "default", "--digits 5", "--digits 9", "--digits 12", "--digits exact", "--precision double",
    "--digits exact --precision double", "--depth f32", "--coverage center", "--digits 9 --coverage center",
    "--digits exact --coverage center"]


def short_table(results):
    def cells(setting):
        yield code(setting)
        yield "%.2f" % results.cell("unit", setting, "ratio_median")
        yield number(results.cell("unit", setting, "bytes_per_triangle"), 3)
        for scene in ("unit", "1e-3", "1e-5"):
            yield number(results.cell(scene, setting, "vertex_error_pixels"), 1)
        for scene in ("layers 1e2", "layers 1e4", "layers 1e6"):
            yield percent(results.share(scene, setting, "flipped_pixels", "wrong_pixels"))
        yield percent(results.share("unit", setting, "off_center_pixels"))

    header = ["setting", "CPU time", "bytes per triangle", "vertex error, object of size 1", "1e-3", "1e-5",
              "wrong pixels, far/near 1e2", "1e4", "1e6", "off-center pixels"]
    return table(header, [list(cells(setting)) for setting in SHORT_SETTINGS])


def short_report(results):
    """The table and the plot for docs/accuracy.md."""
    cost = results.cell("unit", "default", "seconds_per_million_median")
    return f"""{short_table(results)}
CPU time is that of the whole pipe, relative to the default's: {cost:.1f} s per million triangles, the median of
{results.rounds} rounds on {results.machine}.

![CPU time against three kinds of error, for every setting](../scripts/measure/results/tradeoff.svg)
"""
