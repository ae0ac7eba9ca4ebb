"""The mistakes with a name, from the list that judge, conformance pack and student's program share."""
import functools
import re

from lib.rim.places import place

ENTRY = re.compile(r"^(?:judge )?((?:model|view|project|zbuf|all)/[a-z0-9-]+): (.+)(?:\n  (.+))?", re.M)


@functools.cache
def entries(name):
    """{STAGE/NAME: (sentence, fix)} in the order of a list; the fix is empty where it has none."""
    path = place(f"tests/conformance/{name}", f"share/pipeline/conformance/{name}")
    return {entry[1]: (entry[2], entry[3] or "") for entry in ENTRY.finditer(path.read_text("utf-8"))}


@functools.cache
def sentences(name="mistakes.txt"):
    """{STAGE/NAME: sentence}, in the order of the list."""
    return {key: sentence for key, (sentence, _) in entries(name).items()}


def sentence(name):
    return sentences()[name]


def fix(name):
    """The remedy for a mistake of the list, or for several with `and` between, as sentences."""
    known = entries("mistakes.txt")
    return " ".join(known[part][1] for part in name.split(" and ") if part in known)


def names_of(stage):
    """The names of the mistakes of a stage, without the stage."""
    return [name.partition("/")[2] for name in sentences() if name.startswith(stage + "/")]
