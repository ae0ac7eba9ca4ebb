"""The tables of scripts/measure/tradeoff."""
from lib.showing import figures

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


def beaten_table(results):
    rows = [[code(setting), ", ".join(map(code, winners)),
             REASONS.get(setting, "")] for setting, winners in results.beaten().items()]
    return table(["setting", "beaten by", "it stays because"], rows) if rows else "None is.\n"


def short_report(results):
    """The tables and the plot for docs/accuracy.md."""
    return f"""{price_table(results)}
{short_table(results)}
Medians of {results.words('plain', 'rounds')} rounds on {results.machine}. The last four columns of the
first table, and the CPU time of the second, are what a triangle costs with the setting, relative to the
default.

![Cost and errors of every setting](../scripts/measure/results/tradeoff.svg)

Settings that another one beats: in every scene with both never better in cost or error, and worse somewhere:

{beaten_table(results)}"""


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
