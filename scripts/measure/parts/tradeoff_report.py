"""The tables of scripts/measure/tradeoff."""
from lib.showing import figures
from parts.tradeoff_epsilon import DISTANCES
from parts.tradeoff_epsilon import SETTINGS as EPSILONS

# Scenes of which a picture is timed, not a triangle.
PICTURES = ("fill", "torus", "inside")

# Why a setting stays that another one beats in every column.
REASONS = {
    "default": "Assignments ask for `nearest`, and for every triangle in the text.",
    "--digits exact": "Assignments ask for `nearest`.",
    "--digits 5": "Its text is the shortest.",
    "--digits 6": "It is the text of printf's `%f`.",
    "--digits 15": "Other programs read it back with the digits that doubles have.",
    "--precision double": "Where matrices cancel it is faster (`plain pivot`).",
    "--digits exact --precision double": "Where matrices cancel it is faster (`plain pivot`).",
    "--depth f32": "A float takes 8 bytes a pixel in place of 12.",
    "--depth u24":
        "Between narrow limits of z it is finer than `f32`, and as coarse as the buffer of a graphics card.",
    "--clip near": "What lies between the eye and the near plane must go.",
    "--clip frustum": "The text holds nothing that is outside the picture.",
    "--clip reject": "It drops what is outside and cuts nothing.",
    "--shading none": "Colors as they are given.",
    "--shading flat": "Facets show; it is no approximation of `phong`.",
    "--shading gouraud": "It is what OpenGL does.",
    "--shading flat --samples 4": "Facets show; it is no approximation of `phong`.",
    "--shading gouraud --samples 4": "It is what OpenGL does.",
}


def code(setting):
    return setting if setting == "default" else f"`{setting}`"


def number(value, digits=2):
    """As figures.number; an empty cell for what was not measured."""
    return "" if value is None else figures.number(value, digits)


def percent(share):
    return "0" if share == 0 else f"{number(100 * share)} %"


def table(header, rows):
    lines = ["| " + " | ".join(cells) + " |" for cells in (header, *rows)]
    lines.insert(1, "|---|" + "--:|" * (len(header) - 1))
    return "\n".join(lines) + "\n"


# Cost

def with_quartiles(results, scene, setting, column, factor, form):
    """The median, and the quartiles in brackets."""
    median, low, high = (results.cell(scene, setting, name) * factor
                         for name in (column, f"{column}_q1", f"{column}_q3"))
    return f"{median:{form}} ({low:{form}}-{high:{form}})"


def cost_table(results, scene):
    if scene in PICTURES:
        unit, factor, form, what = "ms", 1e3, ".1f", "the picture"
    else:
        unit, factor, form, what = "ns", 1e9 / results.cell(scene, "default",
                                                            "triangles"), ".0f", "a triangle"
    has_counts = results.cell(scene, "default", "instructions") is not None

    def cells(setting):
        def cell(column):
            return results.cell(scene, setting, column)
        yield code(setting)
        yield f"{1e3 * cell('empty_cpu_seconds'):.1f}"
        yield f"{cell('empty_mib'):.0f}"
        yield with_quartiles(results, scene, setting, "cpu_seconds", factor, form)
        yield with_quartiles(results, scene, setting, "ratio", 1, ".2f")
        yield with_quartiles(results, scene, setting, "wall_seconds", factor, form)
        if has_counts:
            yield f"{cell('instructions'):,.0f}"
        yield f"{cell('bytes'):.0f}"
        yield f"{cell('mib'):.0f}"

    header = [
        "setting", "empty run: CPU, ms", "MiB", f"{what}: CPU, {unit}", "times the default's",
        f"wall, {unit}", *["instructions"] * has_counts, "bytes of a triangle", "MiB of the run"]
    return table(header, [list(cells(setting)) for setting in results.settings(scene)])


def cost_section(results, scene):
    title = results.titles[scene]
    count, size = int(results.cell(scene, "default", "triangles")), results.words(scene, "size")
    return f"### {scene}: {title}\n\n{count:,} triangles, {size} pixels.\n\n{cost_table(results, scene)}"


# Errors

def error_table(results, text_of_cell):
    return table(["setting", *results.error_scenes],
                 [[code(setting), *(text_of_cell(scene, setting) for scene in results.error_scenes)]
                  for setting in results.settings(results.error_scenes[0])])


def vertex_cell(results):
    return lambda scene, setting: number(results.cell(scene, setting, "vertex_error_pixels"))


def off_center_cell(results):
    return lambda scene, setting: percent(results.share(scene, setting, "off_center_pixels"))


def pixels_cell(results):
    def text(scene, setting):
        counts = [results.cell(scene, setting, f"{kind}_pixels") for kind in ("flipped", "wrong", "neighbor")]
        return " / ".join("%d" % count for count in counts) if any(counts) else "0"
    return text


def depth_cell(results):
    def text(scene, setting):
        errors = [results.cell(scene, setting, f"depth_error_{kind}") for kind in ("median", "max")]
        return " / ".join(map(number, errors)) if None not in errors else "none"
    return text


def epsilon_table(results):
    def cells(setting):
        rows = [results.epsilon[setting, str(distance)] for distance in DISTANCES]
        yield code(setting)
        yield from (percent(float(row["fighting"])) for row in rows)
        yield from (number(float(row["swallowed"])) for row in rows)

    header = [
        "setting", *(f"pixels that fight at {distance}" for distance in DISTANCES),
        *(f"gap hidden at {distance}" for distance in DISTANCES)]
    return table(header, [list(cells(str(setting))) for setting in EPSILONS])


def beaten_table(results):
    rows = [[code(setting), ", ".join(map(code, winners)),
             REASONS.get(setting, "")] for setting, winners in results.beaten().items()]
    return table(["setting", "beaten by", "it stays because"], rows) if rows else "None is.\n"


def costs(results):
    rounds = results.words(results.cost_scenes[0], "rounds")
    counted = {
        "callgrind":
            "Instructions are those that Valgrind counts, on a processor with AVX2 and without AVX-512",
        "perf":
            "Instructions are those that the processor counts outside the kernel"}.get(
                results.counter, f"Instructions: {results.counter}")
    sections = "\n".join(cost_section(results, scene) for scene in results.cost_scenes)
    return f"""\
The whole pipe `model | view | project | zbuf` on {results.machine}. An *empty run* has the same header,
options and picture, but no triangle: it is what a run costs anyway. What it costs is taken off the run with
triangles of the same round; the rest is given for a triangle, or for the picture. Medians of {rounds}
rounds, quartiles in brackets; a ratio is to the default's time in the same round. Wall time is that on two
cores. {counted}: those of a picture with as large triangles, but a 25th of them (`ball` and `half`: the
same). Memory is the sum of the stages' largest resident sets. Bytes are those in the three pipes together.

{sections}"""


def losses(results):
    return f"""Against a lossless run (`--digits exact`) with the same rule of coverage.

Largest error of a vertex on the screen, in pixels:

{error_table(results, vertex_cell(results))}
Pixels: flipped (covered here or there, not in both) / wrong (a triangle that should be hidden) / neighbor
(one that shares a vertex with the right triangle). `nearest` lights pixels on a common edge twice, and
which of the two triangles is nearer there hangs on the last bits of their depths: hence neighbors, whatever
the number of digits.

{error_table(results, pixels_cell(results))}
Depth (NDC z) where the right triangle is seen: median / largest error. The largest are on triangles seen
nearly edge-on, of which a pixel shows depths from end to end.

{error_table(results, depth_cell(results))}
Pixels that show another triangle than the nearest in which their center lies, as a share of those covered:

{error_table(results, off_center_cell(results))}"""


def report(results):
    return f"""# What accuracy costs

Written by `scripts/measure/tradeoff`; all numbers are in [tradeoff.csv](tradeoff.csv) and
[epsilon.csv](epsilon.csv). A setting is named by what differs from the default,
`--digits 7 --precision extended --coverage nearest --depth f64`.

![cost and errors of every setting](tradeoff.svg)

## Cost

{costs(results)}
## What it gives up

{losses(results)}
## What --depth-epsilon hides

One oblique plane, drawn twice and divided differently, should show the surface drawn first: pixels that
show the other *fight*. Strips before a wall should all show: the *gap hidden* is the largest between a
strip and the wall, in units of the scene, whose strip does not show; 0 if all do. At distances of 5, 50 and
500, near 1, far 1000.

{epsilon_table(results)}
## Settings that another one beats

Nowhere worse in cost or error, and better somewhere, in every scene in which both were measured. Costs
differ if they do so by more than 3 %, times only if their quartiles do not overlap, either.

{beaten_table(results)}"""


# docs/accuracy.md

SHORT_SETTINGS = [
    "default", "--digits 5", "--digits 9", "--digits 12", "--digits exact", "--precision double",
    "--depth f32", "--coverage center", "--digits 9 --coverage center", "--digits exact --coverage center"]


def short_table(results):
    def cells(setting):
        yield code(setting)
        yield f"{results.cell('plain', setting, 'ratio'):.2f}"
        yield f"{results.cell('plain', setting, 'bytes'):.0f}"
        yield from (number(results.cell(scene, setting, "vertex_error_pixels"), 1)
                    for scene in ("unit", "1e-3", "1e-5"))
        yield from (percent(results.share(f"layers {ratio}", setting, "flipped_pixels", "wrong_pixels"))
                    for ratio in ("1e2", "1e4", "1e6"))
        yield percent(results.share("unit", setting, "off_center_pixels"))

    header = [
        "setting", "CPU time", "bytes", "vertex error, size 1", "1e-3", "1e-5", "wrong pixels, far/near 1e2",
        "1e4", "1e6", "off-center pixels"]
    return table(header, [list(cells(setting)) for setting in SHORT_SETTINGS])


def price_table(results):
    """What a run and a triangle cost, by kind of scene."""
    scenes = {"plain": "plain", "color": "a color, one light", "normals": "colors, normals, one light"}

    def cells(scene, title):
        yield title
        yield (
            f"{1e3 * results.cell(scene, 'default', 'empty_cpu_seconds'):.0f} ms, "
            f"{results.cell(scene, 'default', 'empty_mib'):.0f} MiB"
        )
        yield f"{1e9 * results.per_triangle(scene, 'default', 'cpu_seconds'):.0f} ns"
        yield f"{1e9 * results.per_triangle(scene, 'default', 'wall_seconds'):.0f} ns"
        yield f"{results.cell(scene, 'default', 'bytes'):.0f}"
        yield f"{results.cell(scene, 'default', 'mib'):.0f} MiB"
        yield from (f"{results.cell(scene, setting, 'ratio'):.2f}"
                    for setting in ("--digits 9", "--digits exact", "--coverage center", "--samples 2"))

    header = [
        "a million triangles", "an empty run", "a triangle: CPU", "wall, 2 cores", "bytes",
        "memory of the run", "`--digits 9`", "`--digits exact`", "`--coverage center`", "`--samples 2`"]
    return table(header, [list(cells(*item)) for item in scenes.items()])


def short_report(results):
    """The tables and the plot for docs/accuracy.md."""
    return f"""{price_table(results)}
{short_table(results)}
Medians of {results.words('plain', 'rounds')} rounds on {results.machine}. The last four columns of the
first table, and the CPU time of the second, are what a triangle costs with the setting, relative to the
default.

![Cost and errors of every setting](../scripts/measure/results/tradeoff.svg)
"""


# docs/lighting.md

def shading_table(results):
    names = {"torus": "torus", "inside": "room from inside"}

    def cells(setting):
        yield code(setting)
        for name in names:
            if results.cell(name, setting, "ratio") is None:
                yield from ("", "must cut", "")
            else:
                yield f"{results.cell(name, setting, 'ratio'):.2f}"
                mean, largest = (results.cell(name, setting, f"difference_{kind}")
                                 for kind in ("mean", "max"))
                yield from ("its own shadows", "") if mean is None else (f"{mean:.2f}", f"{largest:.0f}")

    header = [
        "setting",
        *(words for name in names.values() for words in (f"{name}: CPU time", "mean difference", "largest"))]
    return table(header, [list(cells(setting)) for setting in results.settings("torus")])


def culling_table(results):
    scenes = ("ball", "half")

    def cells(setting):
        yield code(setting)
        for scene in scenes:
            plain, own = (results.cell(scene, s, "instructions") for s in ("default", setting))
            yield f"{results.cell(scene, setting, 'ratio'):.2f}"
            yield f"{100 * own / plain - 100:+.0f} %" if own else "not counted"
        changed = results.cell("ball", setting, "channels_changed")
        yield "" if changed is None else f"{changed:,.0f} of {results.cell('ball', setting, 'channels'):,.0f}"

    count = int(results.cell("ball", "default", "triangles"))
    header = [
        f"ball of {count:,} triangles", "CPU time", "instructions", "half of it in the picture: CPU time",
        "instructions", "channels that culling changes"]
    return table(header, [list(cells(setting)) for setting in results.settings("ball")[1:]])


def lighting_report(results):
    return f"""{shading_table(results)}
{culling_table(results)}
CPU time is what the triangles cost the whole pipe at 480 x 360 pixels, relative to the default (phong, one
sample, `--coverage nearest`); an empty run is taken off. Medians of {results.words('torus', 'rounds')}
rounds on {results.machine}; instructions by {results.counter}, relative to the default's.
"""
