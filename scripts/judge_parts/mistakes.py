"""The mistakes with a name, from the one list that judge, conformance pack and the student's program
share."""
import functools
import re

from judge_parts.places import place

ENTRY = re.compile(r"(model|view|project|zbuf)/([a-z0-9-]+): (.+)")


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
    """What to do about a mistake, as a sentence; empty for one that is not in the list."""
    return sentences("fixes.txt").get(name, "")
