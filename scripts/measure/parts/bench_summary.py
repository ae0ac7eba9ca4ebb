"""The short form of bench.csv for docs/performance.md: a table for filters, one for the pipe, one for
drawing."""

FILTERS = {
    "from_chars and to_chars": "a plain filter, `from_chars` and `to_chars`",
    "iostream": "a plain filter, iostream",
    "view": "`view`",
    "project": "`project`",
    "view --digits 9 --precision double": "`view --digits 9 --precision double`",
    "view --digits exact --precision double": "`view --digits exact --precision double`",
}
UNITS = {"large triangles": "Gpixel/s", "triangles of 3 pixels": "Mtriangle/s"}


def table(alignments, header, *rows):
    return "".join("| " + " | ".join(row) + " |\n" for row in [header, alignments, *rows])


def filters(rows):
    found = {row["case"]: row for row in rows if row["group"] == "filter"}
    lines = ((words, f"{float(found[case]['median']):.3g}", f"{float(found[case]['ratio']):.2g}")
             for case, words in FILTERS.items())
    return table(("---", "--:", "--:"), ("filter", "MB of input per CPU second", "times the first one"),
                 *lines)


def pipes(rows):
    """Seconds of the whole pipe by the number of triangles."""
    seconds = {}
    for row in rows:
        if row["group"] == "pipe":
            seconds.setdefault(row["case"].split(" ")[0], {})[row["figure"]] = f"{float(row['median']):.2g}"
    return table(("--:", "--:", "--:"), ("triangles", "wall seconds", "CPU seconds"),
                 *((count, each["wall"], each["CPU"]) for count, each in seconds.items()))


def drawing(rows):
    """What each renderer draws in a second under the coverage rule that they share. The rows of the others
    follow zbuf's and begin with their names."""
    lines, of_center = [], False
    for row in rows:
        if row["group"] not in UNITS:
            continue
        rate = f"{float(row['median']):.2g} {UNITS[row['group']]}"
        if " on those, " not in row["case"]:
            rule, where = row["case"].split(", ", 1)
            of_center = rule == "center"
            if of_center:
                lines.append({"what": f"{row['group']}, {where}", "zbuf": rate})
        elif of_center:
            lines[-1][row["case"].split(" on those, ")[0]] = rate
    return table(
        ("---", "--:", "--:", "--:"), ("`--coverage center`", "`zbuf`", "a plain loop", "Mesa"),
        *([line.get(column, "") for column in ("what", "zbuf", "a plain loop", "Mesa")] for line in lines))


def summary(rows):
    """`rows` are those of bench.csv, as text."""
    return f"""{filters(rows)}
The whole pipe, at 500 x 500 pixels:

{pipes(rows)}
Drawing alone, from memory into an empty picture:

{drawing(rows)}
Medians on {rows[0]['machine']}.
"""
