"""The plots of scripts/measure/extremes: for each axis the digits that are right, and where pixels are wrong
and what is noted."""
from lib.showing.svg import document, dots, line, spread_out, text
from parts.extremes_report import Results, short
from parts.extremes_scenes import AXES

WIDTH, LEFT, RIGHT, TOP, BOTTOM, ROW = 860, 140, 800, 78, 290, 24
INSET = 30  # of the first and the last value
MOST = 16
SERIES = {
    "--digits 5": 0, "default": 1, "--digits 9": 2, "--digits 12": 3, "--digits exact": 4,
    "--precision double": 1, "--digits exact --precision double": 4}
NAMES = {
    "default": "7 (default)", "--precision double": "7, doubles",
    "--digits exact --precision double": "exact, doubles"}
STYLE_OF_ROWS = """.s4 text, .s4 .dot { fill: #6e7781 } .s4 .front { stroke: #6e7781 }
.dashed { stroke-dasharray: 5 4 }
.right { fill: #0a7d78; opacity: .22 } .some { fill: #d9922b } .many { fill: #bf2045 }
.note { fill: none; stroke: #1f2328; stroke-width: 1.6 }
@media (prefers-color-scheme: dark) { .note { stroke: #e6edf3 } }
"""


def name_of(setting):
    return NAMES.get(setting, setting.replace("--digits ", ""))


def kind(count, covered):
    """Of wrong pixels: none, fewer than one in a hundred, or more."""
    return "right" if count == 0 else "some" if 100 * count < covered else "many"


def curves(results, axis, x_of):
    def y_of(digits):
        return BOTTOM - (BOTTOM - TOP) * min(digits, MOST) / MOST

    for digits in range(0, MOST + 1, 4):
        yield line("axis" if digits == 0 else "grid", (LEFT, y_of(digits)), (RIGHT, y_of(digits)))
        yield text(RIGHT + 10, y_of(digits) + 4, str(digits), 'class="soft"')
    points = {
        setting: [(x, y_of(float(row["digits_right"]))) for x, row in zip(x_of, results.of(axis, setting))]
        for setting in results.settings}
    # Names stand where the lines begin, since at the extreme many meet.
    in_order = sorted(points, key=lambda setting: points[setting][0][1])
    for setting, y in zip(in_order, spread_out([points[setting][0][1] for setting in in_order], 15)):
        yield f'<g class="s s{SERIES[setting]}">' + line("front" + " dashed" *
                                                         ("double" in setting), *points[setting])
        yield text(LEFT - 10, y + 4, name_of(setting), 'text-anchor="end"') + "</g>"


def rows_of_pixels(results, axis, x_of, top):
    """For each setting two bars: against the truth, and below, half as high, against the lossless run; and a
    ring where a tool notes."""
    half = min(INSET, (x_of[1] - x_of[0]) / 2)
    for i, setting in enumerate(results.settings):
        y = top + ROW * i
        yield f'<g class="s s{SERIES[setting]}">' + text(LEFT - 10, y + 13, name_of(setting),
                                                         'text-anchor="end"') + "</g>"
        shapes, noted = {"right": "", "some": "", "many": ""}, []
        for x, row in zip(x_of, results.of(axis, setting)):
            for column, offset, height in (("wrong_pixels", 0, 11), ("pixels_unlike_lossless", 12, 5)):
                shapes[kind(int(row[column]), int(row["covered"]))] += (
                    f"M{x - half + 0.5:.1f} {y + offset}h{2 * half - 1:.1f}v{height}h{1 - 2 * half:.1f}z")
            if row["note"]:
                noted.append((x, y + 5.5))
        yield from (f'<path class="{name}" d="{path}"/>' for name, path in shapes.items() if path)
        if noted:
            yield dots("note", noted, 3.5)


def legend(y):
    keys = (("right", "no wrong pixel"), ("some", "fewer than 1 %"), ("many", "1 % and more"))
    for i, (name, words) in enumerate(keys):
        yield f'<rect class="{name}" x="{20 + 140 * i}" y="{y - 10}" width="14" height="11"/>' + text(
            40 + 140 * i, y, words, 'class="soft"')
    yield dots("note", [(427, y - 4.5)], 3.5) + text(440, y, "a tool notes it", 'class="soft"')
    yield text(550, y, "thick: against the truth; thin: the lossless run", 'class="soft"')


def plot(rows, axis):
    results = Results(rows)
    title, unit, _ = AXES[axis]
    values = [row["value"] for row in results.of(axis, results.settings[0])]
    x_of = [LEFT + INSET + i * (RIGHT - LEFT - 2 * INSET) / (len(values) - 1) for i in range(len(values))]
    top = BOTTOM + 76
    end = top + ROW * len(results.settings)
    height = end + 44
    parts = [
        text(20, 30, title[0].upper() + title[1:], 'class="title"'),
        text(20, 50, "digits that are right; lines are the values of --digits", 'class="soft"'),
        text(20, top - 14, "wrong pixels", 'class="soft"'),
        text((LEFT + RIGHT) / 2, BOTTOM + 42, unit, 'class="soft" text-anchor="middle"')]
    for i, (x, value) in enumerate(zip(x_of, values)):
        parts.append(line("grid", (x, TOP), (x, BOTTOM)))
        if i % 2 == 0 or len(values) < 14:
            parts.append(text(x, BOTTOM + 20, short(value), 'class="soft" text-anchor="middle"'))
    parts += [*curves(results, axis, x_of), *rows_of_pixels(results, axis, x_of, top), *legend(height - 18)]
    return document(WIDTH, height, f"{title}: digits and pixels that are right", parts, STYLE_OF_ROWS)
