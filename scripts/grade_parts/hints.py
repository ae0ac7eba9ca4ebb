"""How much of a Verdict is given away to its student."""
import dataclasses

from judge_parts.mistakes import fix
from judge_parts.report import sentence
from judge_parts.verdict import MISSING, UNREADABLE, Verdict

LEVELS = ("none", "stage", "cause", "fix")


def gives(level, what):
    """Whether a level of hints gives away what another one does."""
    return LEVELS.index(level) >= LEVELS.index(what)


def told(verdict, level):
    """The Verdict without what the level keeps to itself; with `none`, only files that are missing or cannot
    be read are left."""
    if gives(level, "cause"):
        return verdict
    if level == "none":
        return Verdict([
            without_cause(file) for file in verdict.files if file.verdict in (MISSING, UNREADABLE)])
    return Verdict([without_cause(file) for file in verdict.files])


def without_cause(file):
    keeps_remarks = file.is_good or file.verdict in (MISSING, UNREADABLE)
    first = file.first if file.stage == "zbuf" else file.first.rpartition(": ")[0]  # without the right number
    return dataclasses.replace(file, causes=[], remarks=file.remarks if keeps_remarks else [], matrices=None,
                               largest="", first=first)


def in_words(verdict, level):
    """The verdict as sentences."""
    if level != "none":
        words = sentence(told(verdict, level))
        if len(verdict.files) < 3:  # of a program for one stage
            words = words.replace("all three files are", "what the program writes is")
        return upper_first(words) + "."
    good = sum(file.is_good for file in verdict.files)
    others = [f"{file.file} is {file.verdict}." for file in told(verdict, level).files]
    return " ".join([f"{good} of {len(verdict.files)} files are right.", *others])


def fixes(verdict, level):
    """What to do about the mistakes, as sentences."""
    if not gives(level, "fix"):
        return []
    return list(
        dict.fromkeys(text for file in verdict.files for cause in file.causes if (text := fix(cause.name))))


def upper_first(text):
    """A sentence's first letter as a capital, unless it begins with a file's name."""
    return text if "." in text.split(" ")[0] else text[:1].upper() + text[1:]
