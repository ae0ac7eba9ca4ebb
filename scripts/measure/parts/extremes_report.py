"""The tables of scripts/measure/extremes, in Markdown."""
from lib.showing.markdown import filled

MODERATE = 45.0  # degrees: the angle of view between its two extremes
DIRECTIONS = {  # title of the column: axis, and a function that is True for the column's values
    "distance": ("distance", lambda value: True), "far / near": ("depth", lambda value: True),
    "size": ("size", lambda value: True), "wide angle": ("angle", lambda value: value >= MODERATE),
    "narrow angle": ("angle", lambda value: value <= MODERATE)}


def short(value):
    """A value in short: 1e+08 as 1e8, and 0.001 as 1e-3."""
    value = float(value)
    if 0.01 <= value <= 1000:
        return f"{value:g}"
    mantissa, exponent = f"{value:e}".split("e")
    return f"1e{int(exponent)}" if float(mantissa) == 1 else f"{value:g}"


class Results:
    """The rows of extremes.csv, read by csv.DictReader."""
    def __init__(self, rows):
        self.rows = rows
        self.settings = list(dict.fromkeys(row["setting"] for row in rows))

    def of(self, axis, setting):
        return [row for row in self.rows if row["axis"] == axis and row["setting"] == setting]

    def towards(self, direction, setting):
        """The rows from the moderate value to the extreme one."""
        axis, belongs = DIRECTIONS[direction]
        rows = [row for row in self.of(axis, setting) if belongs(float(row["value"]))]
        return rows[::-1] if direction == "wide angle" else rows

    def first(self, direction, setting, column):
        """The first value with wrong pixels, and the first at which a tool notes it, if there is one; empty
        if no pixels are wrong."""
        rows = self.towards(direction, setting)
        wrong = next((row for row in rows if int(row[column])), None)
        if wrong is None:
            return ""
        noted = next((row for row in rows[rows.index(wrong):] if row["note"]), None)
        when = ("no note"
                if noted is None else "noted" if noted is wrong else f"note from {short(noted['value'])}")
        return f"{short(wrong['value'])} ({when})"

    def uncertain(self, direction, setting):
        """The first value with uncertain pixels, and their number; the first with wrong ones among them, and
        their number; and the first at which bounds are refused."""
        rows = self.towards(direction, setting)
        known = [row for row in rows if row["uncertain_pixels"] != "refused"]
        if not known:
            return "refused"
        counts = {}
        for column in ("uncertain_pixels", "wrong_pixels"):
            for row in [row for row in known if int(row[column])][:1]:
                wrong = f"{int(row['wrong_pixels']):,} of " if int(row["wrong_pixels"]) else ""
                counts[short(row["value"])] = f"({wrong}{int(row['uncertain_pixels']):,})"
        return ", ".join([
            *map(" ".join, counts.items()),
            *(f"{short(row['value'])} refused" for row in rows if row not in known)])


def code(setting):
    return setting if setting == "default" else f"`{setting}`"


def table(results, cell):
    """The table, without settings that are refused everywhere."""
    rows = [[code(setting), *(cell(direction, setting) or "-" for direction in DIRECTIONS)]
            for setting in results.settings]
    lines = ["| setting | " + " | ".join(DIRECTIONS) + " |", "|---|" + "---|" * len(DIRECTIONS)]
    lines += [f"| {' | '.join(row)} |" for row in rows if {*row[1:]} != {"refused"}]
    return "\n".join(lines) + "\n"


def counts_of(results, column):
    return [int(row[column]) for row in results.rows if row[column]]


def certainty(results):
    """A sentence on pixels that are called certain but wrong."""
    counts = counts_of(results, "wrong_though_certain")
    found = f"{sum(counts):,}" if any(counts) else "none"
    return f"Of the pixels that it calls certain, in {len(counts)} pictures, {found} are wrong."


def promise(results):
    """The findings of the check of single digits."""
    counts = counts_of(results, "wrong_without_note")
    found = f"{sum(counts)}" if any(counts) else "none"
    return (
        f"In {3 * len(counts)} runs of a stage, {found} printed a wrong digit, given the numbers it had read,"
        " without a note.")


def tables(rows):
    """The text for docs/accuracy.md; the cells of `rows` are text."""
    results = Results(rows)
    return filled(f"""The first value at which a pixel is wrong, and the first with a note:

{table(results, lambda *cell: results.first(*cell, "wrong_pixels"))}
With `zbuf --certify`, the first value with uncertain pixels (how many of 9,216), and the first with wrong
ones (how many of the uncertain ones). {certainty(results)}

{table(results, results.uncertain)}
{promise(results)}
""")
