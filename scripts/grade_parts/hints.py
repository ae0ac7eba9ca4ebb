"""The part of a Verdict that its student may see."""
import dataclasses
import re

from lib.judging.mistakes import fix
from lib.judging.report import sentence
from lib.judging.verdict import MISSING, UNREADABLE, WRONG, Verdict

LEVELS = ("none", "stage", "cause", "fix")


def gives(level, what):
    """True if a level of hints gives away at least as much as the level `what`."""
    return LEVELS.index(level) >= LEVELS.index(what)


def shown_of(verdict, level):
    """The Verdict as far as the level shows it; at `none`, only files that are missing or cannot be read."""
    if gives(level, "cause"):
        return verdict
    files = [file for file in verdict.files if level != "none" or file.verdict in (MISSING, UNREADABLE)]
    return Verdict([*map(without_cause, files)])


def without_cause(file):
    keeps_remarks = file.is_good or file.verdict in (MISSING, UNREADABLE)
    first = file.first if file.stage == "zbuf" else file.first.rpartition(": ")[0]  # without the right number
    return dataclasses.replace(file, causes=[], remarks=file.remarks if keeps_remarks else [], matrices=None,
                               largest="", first=first)


def in_words(verdict, level):
    """The verdict as sentences."""
    if level != "none":
        words = sentence(shown_of(verdict, level))
        if len(verdict.files) < 3:  # of a program for one stage
            words = words.replace("all three files are", "what the program writes is")
        is_name = "." in words.split(" ")[0]  # of a file, which stays as it is
        return (words if is_name else words[:1].upper() + words[1:]) + "."
    good = sum(file.is_good for file in verdict.files)
    others = [f"{file.file} is {file.verdict}." for file in shown_of(verdict, level).files]
    return " ".join([f"{good} of {len(verdict.files)} files are right.", *others])


def fixes(verdict, level):
    """Sentences on how to fix the mistakes."""
    if not gives(level, "fix"):
        return []
    known = dict.fromkeys(
        text for file in verdict.files for cause in file.causes if (text := fix(cause.name)))
    unknown = next((file for file in verdict.files if file.verdict == WRONG and not file.causes), None)
    return [*known, *([by_hand(unknown)] if unknown else [])]


def by_hand(file):
    """Advice on a file that no known mistake explains."""
    place = re.search(r"triangle \d+(?=: )|row \d+, column \d+", file.first)
    return (f"No known mistake explains {file.file}: calculate {place[0] if place else 'its first triangle'} "
            "by hand, print what your program has after each step, and find the first step that differs.")
