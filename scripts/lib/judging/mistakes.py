"""The mistakes with a name, from the one list that judge, conformance pack and the student's program
share."""
import functools
import re

from lib.rim.places import place

ENTRY = re.compile(r"(?:judge )?(model|view|project|zbuf|all)/([a-z0-9-]+): (.+)")


@functools.cache
def sentences(name="mistakes.txt"):
    """{STAGE/NAME: sentence}, in the order of the list."""
    path = place(f"tests/conformance/{name}", f"share/pipeline/conformance/{name}")
    lines = path.read_text(encoding="utf-8").splitlines()
    entries = [ENTRY.fullmatch(line) for line in lines if line.strip() and not line.startswith("#")]
    return {f"{entry[1]}/{entry[2]}": entry[3] for entry in entries if entry}


def sentence(name):
    return sentences()[name]


def fix(name):
    """What to do about a mistake, or about several with `and` between, as sentences; empty for one that is
    not in the list."""
    fixes = sentences("fixes.txt")
    return " ".join(filter(None, (fixes.get(part, "") for part in name.split(" and "))))
