"""The table and the sentences of trade."""
from lib.figures import number
from lib.table import table

HEADER = ("CPU time", "over default", "bytes", "wrong pixels", "neighbors", "vertex error", "digits lost")

TOO_SHORT = """The default's run takes hardly longer: these times tell nothing about the settings, and the one
with the fewest bytes counts as the cheapest. Try a larger scene."""


def seconds(value):
    return f"{value:.2f} s" if value >= 1 else f"{1000 * value:.1f} ms"


def size(count):
    for unit, name in ((10**9, "GB"), (10**6, "MB"), (10**3, "kB")):
        if count >= unit:
            return f"{count / unit:.3g} {name}"
    return f"{count} B"


def percent(value):
    return f"{number(value)} %"


def pixels(row):
    return f"{row.wrong} ({percent(row.percent_wrong)})" if row.wrong else "0"


def cells(row):
    ratio = row.ratio
    return [
        str(row.setting.under_default_coverage),
        seconds(row.seconds.median), f"{ratio.median:.2f} ({ratio.first:.2f}-{ratio.third:.2f})",
        size(row.size),
        pixels(row),
        str(row.neighbors), f"{number(row.vertex_error)} px" if row.vertex_error else "0",
        str(row.digits_lost)]


def about_times(times):
    """What the times are worth."""
    share = min(1, times.start_up / times.seconds_of_default)
    words = (
        f"CPU time: medians of {times.rounds} round{'s' * (times.rounds != 1)}, and over the default's with "
        f"quartiles. {seconds(times.start_up)} of each run, {100 * share:.0f} % of\n"
        "the default's, starts four processes and writes an empty picture.")
    return words + ("\n" + TOO_SHORT if times.are_too_short else "")


def asked(limits):
    words = [] if limits.percent_wrong is None else [
        f"at most {limits.percent_wrong:g} % wrong pixels" if limits.percent_wrong else "0 wrong pixels"]
    if limits.ratio is not None:
        words.append(f"at most {limits.ratio:g} times the default's CPU time")
    return " and ".join(words)


def summary(row):
    return (f"{row.setting}: {row.ratio.median:.2f} times the default's CPU time, {pixels(row)} wrong "
            f"pixel{'s' * (row.wrong != 1)}")


def decided_by(chosen, alike):
    """Why this one among those that cost the same; empty if it is alone."""
    others = [row for row in alike if row is not chosen]
    if not others:
        return ""
    told = (f"\n{len(others)} other setting{'s' * (len(others) > 1)} cost{'s' * (len(others) == 1)} the "
            f"same, as far as these times tell: ")
    least = [row for row in others if row.size == chosen.size]
    if not least:
        return told + "this one has the fewest bytes."
    if not (least := [row for row in least if row.wrong == chosen.wrong]):
        return told + "of those with as few bytes, this one has the fewest wrong pixels."
    if all(row.vertex_error > chosen.vertex_error for row in least):
        return told + "of those with as few bytes and wrong pixels, this one has the smallest vertex error."
    return told + "of those with as few bytes and as exact, this one is nearest to the default."


def answer(chosen, is_met, alike, limits, command_line):
    """`alike` are the rows that cost the same as the chosen one, by what was measured."""
    first = (f"The cheapest with {asked(limits)}:"
             if is_met else f"No setting has {asked(limits)}. The nearest is")
    return f"{first}\n{summary(chosen)}{decided_by(chosen, alike)}\n\n    {command_line}"


def report(rows, times, covered):
    """A table for each coverage rule, and what the times are worth."""
    lines = []
    for coverage, count in covered.items():
        own = [cells(row) for row in rows if row.setting.coverage == coverage]
        lines += [
            *table((f"--coverage {coverage}", *HEADER), own), "", f"The lossless run covers {count} pixels.",
            ""]
    return "\n".join([*lines, about_times(times)])
