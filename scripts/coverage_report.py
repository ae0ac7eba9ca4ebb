"""Says what gcovr has counted: lines and branches of every file, and each line that was not run, with its reason.

usage: coverage_report.py GCOVR.JSON REASONS [ROOT]

REASONS (tests/uncovered.txt) gives lines that no test can run: a reason, then, indented, one `FILE: TEXT` for every such line,
where TEXT stands on that line. Exit status 1 if a line without a reason was not run, or a reason is about no line.
"""
import collections
import json
import pathlib
import sys

Excuse = collections.namedtuple("Excuse", "file text reason line")


def read_reasons(path):
    excuses, reason = [], None
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        if not line[0].isspace():
            reason = line.strip()
            continue
        file, colon, text = line.strip().partition(": ")
        if not colon or reason is None:
            raise SystemExit(f"{path}:{number}: expected a reason, then lines '  FILE: TEXT', found '{line.strip()}'")
        excuses.append(Excuse(file, text, reason, number))
    return excuses


class Share:
    """How many of how many."""

    def __init__(self, flags):
        flags = list(flags)
        self.run, self.all = sum(flags), len(flags)

    def __str__(self):
        return f"{100 * self.run / self.all:.1f} % ({self.run}/{self.all})" if self.all else "none"


def lines_of(file):
    return [line for line in file["lines"] if not line.get("gcovr/noncode", False)]


def line_share(files):
    return Share(line["count"] > 0 for file in files for line in lines_of(file))


def branch_share(files):
    return Share(branch["count"] > 0 for file in files for line in lines_of(file) for branch in line["branches"])


def table(files):
    rows = [("file", "lines", "branches")]
    rows += [(file["file"], str(line_share([file])), str(branch_share([file]))) for file in files]
    rows.append(("all", str(line_share(files)), str(branch_share(files))))
    widths = [max(len(row[i]) for row in rows) for i in range(3)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]


def lines_with(excuse, files, sources):
    return [line for file in files if file["file"] == excuse.file for line in lines_of(file)
            if excuse.text in sources[file["file"]][line["line_number"] - 1]]


def main(counted_path, reasons_path, root="."):
    files = sorted(json.loads(pathlib.Path(counted_path).read_text())["files"], key=lambda file: file["file"])
    excuses = read_reasons(pathlib.Path(reasons_path))
    sources = {file["file"]: (pathlib.Path(root) / file["file"]).read_text().splitlines() for file in files}
    print("\n".join(table(files)))

    by_reason, without_reason = collections.defaultdict(list), []
    for file in files:
        for line in lines_of(file):
            if line["count"] > 0:
                continue
            text = sources[file["file"]][line["line_number"] - 1].strip()
            reasons = [excuse.reason for excuse in excuses if excuse.file == file["file"] and excuse.text in text]
            shown = f"  {file['file']}:{line['line_number']}: {text}"
            if reasons:
                by_reason[reasons[0]].append(shown)
            else:
                without_reason.append(shown)
    for reason, shown in by_reason.items():
        print("\nNot run: " + reason, *shown, sep="\n")
    run = [f"  line {excuse.line}: {excuse.file}: {excuse.text}" for excuse in excuses
           if any(found := [line["count"] > 0 for line in lines_with(excuse, files, sources)]) and all(found)]
    if run:
        print(f"\nRun here, in spite of a reason in {reasons_path}:", *run, sep="\n")
    if without_reason:
        print(f"\nNot run, and {reasons_path} has no reason:", *without_reason, sep="\n")
    stale = [f"  line {excuse.line}: {excuse.file}: {excuse.text}" for excuse in excuses
             if not any(excuse.text in line for line in sources.get(excuse.file, []))]
    if stale:
        print(f"\nIn {reasons_path}, but nowhere in the sources:", *stale, sep="\n")
    return 1 if without_reason or stale else 0


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
