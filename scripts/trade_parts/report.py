"""The table and the sentences of trade."""
import math

from lib.showing.figures import number
from lib.showing.table import table

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


def percent(value):
    return f"{number(value)} %"


def pixels(row):
    if row.loss.wrong is None:
        return "-"
    return f"{row.loss.wrong} ({percent(row.percent_wrong)})" if row.loss.wrong else "0"


def cells(row):
    """As in HEADER; the last one only if colors were compared."""
    gap, levels = row.loss.gap, row.loss.levels
    return [
        str(row.setting.under_default_coverage), "-" if math.isnan(row.net) else f"{row.net:.2f}",
        seconds(row.seconds.median),
        pixels(row), "-" if gap is None else number(gap), *([] if levels is None else [f"{levels:.2f}"])]


def about_times(times):
    """How far the times can be trusted."""
    share = min(1, times.start_up / times.seconds_of_default)
    words = (
        f"CPU: medians of {times.rounds} round{'s' * (times.rounds != 1)}. {seconds(times.start_up)} of "
        f"each, {100 * share:.0f} % of the default's, starts four\nprograms and writes an empty picture: net "
        f"is the rest, over the default's.")
    return words + ("\n" + TOO_SHORT if times.are_too_short else "")


def asked(limits):
    words = [] if limits.percent_wrong is None else [
        f"at most {limits.percent_wrong:g} % wrong pixels" if limits.percent_wrong else "0 wrong pixels"]
    if limits.ratio is not None:
        words.append(f"at most {limits.ratio:g} times the default's CPU time")
    return " and ".join(words)


def summary(row):
    return (f"{row.setting}: {row.ratio:.2f} times the default's CPU time, {size(row.size)} in the pipes,\n"
            f"{pixels(row)} wrong pixel{'s' * (row.loss.wrong != 1)}")


def names(rows):
    return "".join(f"\n    {row.setting}" for row in rows)


def about_ties(choice):
    """Which settings cost as much, or may cost less; empty if there is none."""
    if choice.untold:
        return ("\nToo busy to tell which is cheapest, or too few rounds: this is the simplest.\n"
                f"These may be cheaper:{names(choice.untold)}\n"
                "Repeat it when the machine is idle, or with more --rounds.")
    if choice.ties:
        return ("\nThese cost the same, as far as anybody notices; this is the simplest:" +
                names(choice.ties))
    return ""


def answer(choice, is_met, limits, command_line):
    first = f"No setting has {asked(limits)}. The nearest is"
    if is_met:
        first = f"The {'simplest' if choice.untold else 'cheapest'} with {asked(limits)}:"
    return f"{first}\n{summary(choice.row)}{about_ties(choice)}\n\n    {command_line}"


def report(rows, times):
    """A table for each coverage rule and for trace, and what the times are worth."""
    lines, width = [], len(cells(rows[0]))
    for title in dict.fromkeys(map(title_of, rows)):
        own = [cells(row) for row in rows if title_of(row) == title]
        lines += [*table((title, *HEADER)[:width], own), ""]
    return "\n".join([*lines, f"The exact picture covers {rows[0].covered} pixels.", about_times(times)])


def title_of(row):
    return "rays" if row.setting.is_traced else f"--coverage {row.setting.coverage}"
