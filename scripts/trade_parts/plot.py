"""The plot of trade: each setting's cost beside its losses, in a row."""
import dataclasses
import math

from lib.showing.svg import document, dots, line, text
from trade_parts.report import asked
from trade_parts.timing import CPU_TIME

TOP, ROW, BOTTOM = 96, 22, 60
CPU_LEFT, CPU_WIDTH, WRONG_LEFT, WRONG_WIDTH, LAST_LEFT, LAST_WIDTH, WIDTH = 330, 190, 560, 150, 750, 180, 960
ZERO_WIDTH = 30  # between 0 and the smallest power of ten
STYLE_OF_BARS = (".bar { fill: #7d76d4 } .start { fill: #a9b1ba } .chosen { font-weight: 700 } .limit { "
                 "stroke: #bf2045; stroke-dasharray: 4 3 }")


@dataclasses.dataclass(frozen=True)
class Axis:
    """Numbers from left to right."""
    left: float
    width: float
    high: float

    def x(self, value):
        return self.left + self.width * value / self.high

    def ticks(self):
        """About five round numbers, with their texts."""
        step = 10.0**math.floor(math.log10(self.high / 3))
        step *= max(factor for factor in (1, 2, 5) if factor * step <= self.high / 3)
        return [(step * i, f"{step * i:g}") for i in range(math.floor(self.high / step) + 1)]


@dataclasses.dataclass(frozen=True)
class PowerAxis:
    """0 at the left, and powers of ten to its right."""
    left: float
    width: float
    low: int
    high: int

    def x(self, value):
        if value == 0:
            return self.left
        power = min(max(math.log10(value), self.low), self.high)
        return self.left + ZERO_WIDTH + (self.width - ZERO_WIDTH) * (power - self.low) / (self.high -
                                                                                          self.low)

    def ticks(self):
        step = math.ceil(45 * (self.high - self.low) / (self.width - ZERO_WIDTH))
        powers = range(self.high, self.low - 1, -step)
        return [(0, "0"),
                *((10.0**power, f"{10.0**power:g}" if -3 < power < 4 else f"1e{power}") for power in powers)]


def power_axis(left, width, values):
    """A PowerAxis with room for all these values."""
    powers = [math.log10(value) for value in values if value] or [0]
    low = math.floor(min(powers))
    return PowerAxis(left, width, low, max(math.ceil(max(powers)), low + 1))


def panel(axis, title, unit, limit, bottom):
    yield text(axis.left, 60, title, 'class="title"')
    yield text(axis.left, 78, unit, 'class="soft"')
    for value, words in axis.ticks():
        yield line("grid", (axis.x(value), TOP - 8), (axis.x(value), bottom))
        yield text(axis.x(value), bottom + 18, words, 'class="soft" text-anchor="middle"')
    if limit is not None:
        yield line("limit", (axis.x(limit), TOP - 8), (axis.x(limit), bottom))


def bar(axis, y, begin, end, kind):
    return (f'<rect class="{kind}" x="{axis.x(begin):.1f}" y="{y - 6:.1f}" '
            f'width="{max(0, axis.x(end) - axis.x(begin)):.1f}" height="12"/>')


def row_of(row, y, axes, start_up, is_chosen):
    cpu, wrong, last = axes
    yield text(CPU_LEFT - 12, y + 4, str(row.setting), 'text-anchor="end"' + ' class="chosen"' * is_chosen)
    yield bar(cpu, y, 0, start_up, "start") + bar(cpu, y, start_up, row.seconds.median, "bar")
    yield line("axis", (cpu.x(row.seconds.first), y), (cpu.x(row.seconds.third), y))
    percent = None if row.loss.wrong is None else row.percent_wrong
    for axis, value in (wrong, percent), (last, last_of(row)):
        if value is not None:
            yield f'<g class="s s{0 if value else 2}">' + dots("dot", [(axis.x(value), y)], 4.5) + "</g>"


def last_of(row):
    """A row's value in the last panel: its levels if colors were compared, else its gap."""
    return row.loss.gap if row.loss.levels is None else row.loss.levels


def plot(rows, chosen, limits, times):
    """The SVG; `chosen` is the row that the answer names."""
    bottom, default = TOP + ROW * len(rows), times.seconds_of_default
    cpu = Axis(CPU_LEFT, CPU_WIDTH, 1.03 * max(row.seconds.third for row in rows))
    drawn = [row.percent_wrong for row in rows if row.loss.wrong is not None]
    wrong = power_axis(WRONG_LEFT, WRONG_WIDTH, [*drawn, limits.percent_wrong])
    last = power_axis(LAST_LEFT, LAST_WIDTH, [last_of(row) for row in rows])
    words = ("gap between layers", "the scene's units") if rows[0].loss.levels is None else ("colors",
                                                                                             "levels of 256")
    most = None if limits.ratio is None or limits.ratio * default > cpu.high else limits.ratio * default
    height = bottom + BOTTOM
    unit = "seconds; " if times.unit == CPU_TIME else ""
    verdict = "the cheapest with" if limits.are_met_by(chosen) else "the nearest to"
    parts = [
        text(20, 30, f"{chosen.setting}: {verdict} {asked(limits)}",
             'class="title"'), *panel(cpu, times.unit, f"{unit}gray: four processes start", most, bottom),
        *panel(wrong, "wrong pixels", "% of those covered", limits.percent_wrong, bottom),
        *panel(last, *words, None, bottom)]
    for i, row in enumerate(rows):
        parts += row_of(row, TOP + ROW * (i + 0.5), (cpu, wrong, last), times.start_up, row is chosen)
    parts.append(
        text(
            20, height - 16,
            f"Medians of {times.rounds} round{'s' * (times.rounds != 1)}, with a line between the quartiles. "
            f"Dashed: what was asked for.", 'class="soft"'))
    return document(WIDTH, height, "What each setting takes and what it loses", parts, STYLE_OF_BARS)
