"""The plot of scripts/measure/tradeoff: cost and errors of every setting, a row each, as SVG."""
import dataclasses
import math

from lib.showing.svg import document, dots, line, text

WIDTH, TOP, ROW_HEIGHT, LABEL_WIDTH = 1180, 112, 24, 255
ZERO_WIDTH = 36  # left of a logarithmic axis, for errors that are 0


@dataclasses.dataclass(frozen=True)
class Panel:
    title: str
    unit: str
    series: dict      # {name: {setting: value}}, at most three
    left: float
    width: float
    ticks: tuple
    is_logarithmic: bool = False
    tick_text: object = "{:g}".format

    def x_of(self, value):
        low, high = self.ticks[0], self.ticks[-1]
        if not self.is_logarithmic:
            return self.left + self.width * (value - low) / (high - low)
        if value == 0:
            return self.left
        share = (math.log10(value) - math.log10(low)) / (math.log10(high) - math.log10(low))
        return self.left + ZERO_WIDTH + (self.width - ZERO_WIDTH) * min(max(share, 0), 1)


def rounded_up(value):
    """About five ticks from 0 to at least the value."""
    step = 10.0 ** math.floor(math.log10(value / 2))
    step *= max(factor for factor in (1, 2, 5) if factor * step <= value / 2)
    return tuple(step * i for i in range(math.ceil(value / step) + 1))


def panel_parts(panel, settings, bottom):
    yield text(panel.left, 30, panel.title, 'class="title"')
    yield text(panel.left, 48, panel.unit, 'class="soft"')
    if len(panel.series) > 1:
        x = panel.left
        for i, name in enumerate(panel.series):
            yield f'<g class="s s{i}">' + dots("dot", [(x + 5, 66)], 4.5) + text(x + 14, 70, name) + "</g>"
            x += 30 + 7 * len(name)
    for tick in panel.ticks:
        x = panel.x_of(tick)
        yield line("grid", (x, TOP - 6), (x, bottom))
        yield text(x, TOP - 14, panel.tick_text(tick), 'class="soft" text-anchor="middle"')
    if panel.is_logarithmic:
        yield line("grid", (panel.left, TOP - 6), (panel.left, bottom))
        yield text(panel.left, TOP - 14, "0", 'class="soft" text-anchor="middle"')
    for i, values in enumerate(panel.series.values()):
        ends = [(panel.x_of(values[setting]), TOP + ROW_HEIGHT * (row + 0.5))
                for row, setting in enumerate(settings)]
        yield f'<g class="s s{i}">'
        if not panel.is_logarithmic:
            yield from (line("front", (panel.x_of(0), y), (x, y)) for x, y in ends)
        # The smaller dots of later series stay visible on those of earlier ones.
        yield dots("dot", ends, 6 - 1.4 * i) + "</g>"


def share_text(share):
    return f"{100 * share:g} %"


def power_text(value):
    return f"1e{math.log10(value):.0f}"


def panels_of(results, settings, nanoseconds):
    def errors(scenes, error):
        return {name: {s: error(scene, s) for s in settings} for name, scene in scenes.items()}

    layers = errors({f"1e{n}": f"layers 1e{n}" for n in (6, 4, 2)},
                    lambda scene, s: results.share(scene, s, "flipped_pixels", "wrong_pixels"))
    sizes = {"1e-5": "1e-5", "1e-3": "1e-3", "1": "unit"}
    vertices = errors(sizes, lambda scene, s: results.cell(scene, s, "vertex_error_pixels"))
    edges = errors(sizes, lambda scene, s: results.share(scene, s, "off_center_pixels"))
    shares = (1e-4, 1e-2, 1)
    text_bytes = {s: results.cell("plain", s, "bytes") for s in settings}
    return [
        Panel("CPU", "ns a triangle", {"": nanoseconds}, LABEL_WIDTH, 150,
              rounded_up(max(nanoseconds.values()))),
        Panel("Text", "bytes a triangle", {"": text_bytes}, LABEL_WIDTH + 190, 90,
              rounded_up(max(text_bytes.values()))),
        Panel("How far vertices move", "pixels, at most; objects of size", vertices, LABEL_WIDTH + 325, 200,
              (1e-15, 1e-10, 1e-5, 1, 1e5), True, power_text),
        Panel("Hidden that shows", "layers 1e-5 apart, far/near", layers, LABEL_WIDTH + 565, 160, shares,
              True, share_text),
        Panel("Pixels off center", "objects of size", edges, LABEL_WIDTH + 765, 130, shares, True,
              share_text)]


def plot(results):
    beaten = results.beaten()
    settings = [setting for setting in results.settings("plain") if setting in results.settings("unit")]
    nanoseconds = {s: 1e9 * results.per_triangle("plain", s, "cpu_seconds") for s in settings}
    settings.sort(key=nanoseconds.get)
    bottom = TOP + ROW_HEIGHT * len(settings)
    height = bottom + 40
    footnote = (f"Plain triangles, what they cost beyond an empty run. Medians of "
                f"{results.words('plain', 'rounds')} rounds, {results.machine}.")
    if any(setting in beaten for setting in settings):
        footnote += " *: beaten by another setting."
    parts = [text(20, height - 14, footnote, 'class="soft"')]
    for row, setting in enumerate(settings):
        y = TOP + ROW_HEIGHT * (row + 0.5)
        parts.append(line("grid", (20, y + ROW_HEIGHT / 2), (WIDTH - 20, y + ROW_HEIGHT / 2)))
        parts.append(text(20, y + 4, setting + " *" * (setting in beaten)))
    for panel in panels_of(results, settings, nanoseconds):
        parts += panel_parts(panel, settings, bottom)
    return document(WIDTH, height, "Cost and errors of the settings of the pipeline", parts)
