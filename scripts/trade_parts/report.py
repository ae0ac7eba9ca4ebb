"""The table and the sentences of trade."""
import math
import textwrap

from lib.showing.figures import number
from lib.showing.table import table
from trade_parts.timing import CPU_TIME

HEADER = ("net", "CPU", "wrong pixels", "gap", "levels")

TOO_SHORT = """The default takes hardly longer: these times tell nothing about the settings.
Try a larger scene."""


def seconds(value):
    return f"{number(value, 3)} s" if value >= 1 else f"{number(1000 * value, 3)} ms"


def size(count):
    for unit, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if count >= unit:
            return f"{count / unit:.3g} {name}"
    return f"{count} B"


def pixels(row):
    if row.loss.wrong is None:
        return "-"
    return f"{row.loss.wrong} ({number(row.percent_wrong)} %)" if row.loss.wrong else "0"


def pixels_of_uncertain(row):
    """The count of wrong pixels, followed by that of uncertain ones if these are known and not 0."""
    wrong = pixels(row)
    count, *share = wrong.split(" ", 1)
    return " ".join([f"{count}/{row.loss.uncertain}", *share]) if row.loss.uncertain else wrong


def cells(row, unit):
    """The cells of a row under HEADER; the last only if colors were compared."""
    gap, levels = row.loss.gap, row.loss.levels
    return [
        str(row.setting.under_default_coverage), "-" if math.isnan(row.net) else f"{row.net:.2f}",
        seconds(row.seconds.median) if unit == CPU_TIME else f"{row.ratio:.2f}",
        pixels_of_uncertain(row), "-" if gap is None else number(gap),
        *([] if levels is None else [f"{levels:.2f}"])]


def about_times(times):
    """A sentence on the reliability of the times."""
    share = min(1, times.start_up / times.seconds_of_default)
    if times.unit != CPU_TIME:
        return (f"The programs run too briefly to be timed: {times.unit} are counted,\n"
                "divided by the default's: all, and (net) without what an empty picture takes.")
    words = (f"CPU: medians of {times.rounds} round{'s' * (times.rounds != 1)}. Starting four programs and "
             f"writing an empty\npicture takes {seconds(times.start_up)} of each, {100 * share:.0f} % of the "
             "default's; net leaves that out.")
    return words + ("\n" + TOO_SHORT if times.are_too_short else "")


def asked(limits):
    words = [] if limits.percent_wrong is None else [
        f"at most {limits.percent_wrong:g} % wrong pixels" if limits.percent_wrong else "0 wrong pixels"]
    if limits.ratio is not None:
        words.append(f"at most {limits.ratio:g} times the default's CPU time")
    return " and ".join(words)


def summary(row, unit):
    return (f"{row.setting}: {row.ratio:.2f} times the default's {unit}, {size(row.size)} in the pipes,\n"
            f"{pixels(row)} wrong pixel{'s' * (row.loss.wrong != 1)}")


def names(rows):
    return "".join(f"\n    {row.setting}" for row in rows)


def about_pixels(choice):
    """A sentence on the reliability of the pixels of the chosen row."""
    lines = [f"\n{row.setting}: {wrong} wrong with the eye moved a little" for row, wrong in choice.lucky]
    if choice.row.loss.uncertain is not None:
        lines.append(f"\n{choice.row.loss.uncertain} of its pixels are not certain (zbuf --certify)")
    return "".join(lines)


def about_ties(choice):
    """A sentence on the settings that cost as much, or may cost less; empty if there is none."""
    if choice.untold:
        return ("\nThe cheapest is unknown (busy machine, or too few rounds): this is the simplest.\n"
                f"These may be cheaper:{names(choice.untold)}\n"
                "Repeat it when the machine is idle, or with more --rounds.")
    if choice.ties:
        return ("\nThese cost the same, as far as anybody notices; this is the simplest:" +
                names(choice.ties))
    return ""


def answer(choice, is_met, limits, command_line, times):
    first = f"No setting has {asked(limits)}. The nearest is"
    if is_met:
        is_told = not choice.untold and not times.are_too_few
        first = f"The {'cheapest' if is_told else 'simplest'} with {asked(limits)}:"
    return (f"{first}\n{summary(choice.row, times.unit)}{about_pixels(choice)}{about_ties(choice)}\n\n"
            f"    {command_line}")


def notes(rows):
    """The notes of the stages, each once, after the settings that cause it."""
    found = {}
    for row in rows:
        for note in row.loss.notes:
            found.setdefault(note, []).append(str(row.setting))
    for note, settings in found.items():
        yield from textwrap.wrap(f"{', '.join(settings)}: {note}", 80, subsequent_indent="    ",
                                 break_on_hyphens=False)
    yield from [""] * bool(found)


def report(rows, times):
    """A table for each coverage rule and for trace, and a sentence on the reliability of the times."""
    header = HEADER if times.unit == CPU_TIME else ("net", times.unit, *HEADER[2:])
    lines, width = [], len(cells(rows[0], times.unit))
    for title in dict.fromkeys(map(title_of, rows)):
        own = [cells(row, times.unit) for row in rows if title_of(row) == title]
        lines += [*table((title, *header)[:width], own), ""]
    covered = f"The exact picture covers {rows[0].covered} pixels."
    return "\n".join([*lines, *notes(rows), covered, about_times(times)])


def title_of(row):
    return "rays" if row.setting.is_traced else f"--coverage {row.setting.coverage}"
