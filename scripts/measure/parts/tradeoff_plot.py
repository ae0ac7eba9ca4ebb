"""The plot of scripts/measure/tradeoff: CPU time against three kinds of error, as SVG."""
import dataclasses
import math

from parts.svg import STYLE, line, spread_out, text

@dataclasses.dataclass(frozen=True)
class Panel:
    title: str
    unit: str
    series: dict        # at most three: {name: {setting: error}}
    decades: tuple      # powers of ten at the bottom and the top of the axis
    tick: object        # gives the text of a power of ten
    band: tuple = None  # (smallest error that matters, text)


WIDTH, HEIGHT = 1160, 520
PLOT_WIDTH, PLOT_TOP, PLOT_BOTTOM, ZERO_Y = 285, 150, 405, 425
LEFTS = (75, 455, 835)


def front(points):
    """The Pareto front: the points (x, y) that no other point beats in one and at least equals in the other coordinate."""
    best, chosen = math.inf, []
    for point in sorted(points):
        if point[1] < best:
            best = point[1]
            chosen.append(point)
    return chosen


def short(setting):
    if setting == "default":
        return "7 (default)"
    return ", ".join(word for word in setting.split() if not word.startswith("--"))


def ticks(low, high):
    """About five round numbers from low to high."""
    step = 10.0 ** math.floor(math.log10((high - low) / 3))
    step *= max(factor for factor in (1, 2, 5) if factor * step <= (high - low) / 3)
    return [step * i for i in range(math.ceil(low / step), math.floor(high / step) + 1)]


def draw(panel, left, seconds):
    settings = sorted(next(iter(panel.series.values())), key=lambda setting: seconds[setting])
    low, high = min(seconds.values()), max(seconds.values())
    low, high = low - 0.08 * (high - low), high + 0.05 * (high - low)
    right = left + PLOT_WIDTH
    bottom_power, top_power = panel.decades

    def x_of(setting_seconds):
        return left + PLOT_WIDTH * (setting_seconds - low) / (high - low)

    def y_of(error):
        if error == 0:
            return ZERO_Y
        power = min(max(math.log10(error), bottom_power), top_power)
        return PLOT_BOTTOM - (PLOT_BOTTOM - PLOT_TOP) * (power - bottom_power) / (top_power - bottom_power)

    yield text(left - 55, 34, panel.title, 'class="title"')
    yield text(left - 55, 52, panel.unit, 'class="soft"')
    if panel.band:
        y = y_of(panel.band[0])
        yield f'<rect class="band" x="{left}" y="{PLOT_TOP}" width="{PLOT_WIDTH}" height="{y - PLOT_TOP:.1f}"/>'
        yield text(right - 6, PLOT_TOP + 16, panel.band[1], 'class="soft" text-anchor="end"')
    step = 1 if top_power - bottom_power < 8 else 3
    for power in range(bottom_power, top_power + 1, step):
        yield line("grid", (left, y_of(10.0**power)), (right, y_of(10.0**power)))
        yield text(left - 8, y_of(10.0**power) + 4, panel.tick(power), 'class="soft" text-anchor="end"')
    yield line("grid", (left, ZERO_Y), (right, ZERO_Y))
    yield text(left - 8, ZERO_Y + 4, "0", 'class="soft" text-anchor="end"')
    for tick in ticks(low, high):
        yield line("axis", (x_of(tick), ZERO_Y + 12), (x_of(tick), ZERO_Y + 17))
        yield text(x_of(tick), ZERO_Y + 32, f"{tick:g}", 'class="soft" text-anchor="middle"')
    yield line("axis", (left, PLOT_TOP), (left, PLOT_BOTTOM + 4))
    yield line("axis", (left, ZERO_Y + 12), (right, ZERO_Y + 12))
    yield text(left + PLOT_WIDTH / 2, ZERO_Y + 52, "CPU seconds per million triangles",
               'class="soft" text-anchor="middle"')

    places = spread_out([x_of(seconds[setting]) for setting in settings], 15)
    for setting, place in zip(settings, places):
        x = x_of(seconds[setting])
        yield line("guide", (place, PLOT_TOP - 22), (x, PLOT_TOP - 6), (x, ZERO_Y))
        turn = f'transform="rotate(-50 {place:.1f} {PLOT_TOP - 26:.1f})"'
        yield text(place, PLOT_TOP - 26, short(setting), turn)

    legend_top = 18 + (y_of(panel.band[0]) if panel.band else PLOT_TOP)
    for i, (name, errors) in enumerate(panel.series.items()):
        points = [(seconds[setting], error) for setting, error in errors.items()]
        best = front(points)
        corners = []
        for x, y in best:
            if corners:
                corners.append((x_of(x), corners[-1][1]))
            corners.append((x_of(x), y_of(y)))
        yield f'<g class="s s{i}">' + line("front", *corners)
        for x, y in points:
            kind = "dot" if (x, y) in best else "behind"
            yield f'<circle class="{kind}" cx="{x_of(x):.1f}" cy="{y_of(y):.1f}" r="{4 - 0.6 * i:.1f}"/>'
        yield text(right - 6, legend_top + 17 * i, name, 'text-anchor="end"') + "</g>"


def plot(results):
    seconds = {setting: results.cell("unit", setting, "seconds_per_million_median") for setting in results.settings}

    def errors(scene, wanted, error):
        return {setting: error(scene, setting) for setting in results.settings if wanted(setting)}

    def vertex_pixels(scene, setting):
        return results.cell(scene, setting, "vertex_error_pixels")

    def wrong_percent(scene, setting):
        return 100 * results.share(scene, setting, "flipped_pixels", "wrong_pixels")

    def off_center_percent(scene, setting):
        return 100 * results.share(scene, setting, "off_center_pixels")

    def percent_tick(power):
        return f"{10.0**power:g} %"

    def without(*words):
        return lambda setting: not any(word in setting for word in words)

    layers = {f"1e{n}": errors(f"layers 1e{n}", without("center"), wrong_percent) for n in (6, 4, 2)}
    vertices = {name: errors(name, without("center", "depth"), vertex_pixels) for name in ("1e-5", "1e-3", "unit")}
    edges = {name: errors(name, without("double", "depth"), off_center_percent) for name in ("1e-5", "1e-3", "unit")}
    panels = [
        Panel("How far vertices move", "largest error in pixels; an object of size ...",
              vertices, (-15, 3), lambda power: f"1e{power}", (0.5, "half a pixel and more")),
        Panel("How much hidden shows", "wrong pixels; two layers 1e-5 apart, far/near ...",
              layers, (-1, 2), percent_tick),
        Panel("How true edges are", "pixels not of the triangle at their center; size ...",
              edges, (-3, 2), percent_tick),
    ]
    footnote = ("Along the top: decimals (--digits), and what else differs from the default. Filled and joined by "
                f"a line: the Pareto front. Medians of {results.rounds} runs, {results.machine}.")
    size = f'viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}"'
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
             "<title>CPU time against error for the settings of the pipeline, with Pareto fronts</title>",
             f"<style>{STYLE}</style>",
             f'<rect class="card" x=".5" y=".5" width="{WIDTH - 1}" height="{HEIGHT - 1}" rx="8"/>',
             text(20, HEIGHT - 16, footnote, 'class="soft"')]
    for panel, left in zip(panels, LEFTS):
        parts += draw(panel, left, seconds)
    return "\n".join(parts) + "\n</svg>\n"
