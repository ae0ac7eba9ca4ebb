"""Lists of reasons: a reason, then, indented, one `FILE: TEXT` for each thing it excuses; lines that begin
with # do not count."""
import collections

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
            raise SystemExit(
                f"{path}:{number}: expected a reason, then lines '  FILE: TEXT', found '{line.strip()}'")
        excuses.append(Excuse(file, text, reason, number))
    return excuses
