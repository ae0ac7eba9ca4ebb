"""A Verdict in words."""
import os
import re
import shlex

from lib.judging.matching import listed
from lib.judging.verdict import BY_THE_RIGHT, FAILED, MISSING, OPEN, WRONG

HEADER = ["stage", "file", "verdict", "numbers that differ", "largest difference, first pixel", "remarks"]


def rows(verdict):
    """The lines of a table below HEADER."""
    return [[
        file.stage, file.file, file.verdict, "" if file.shown_count is None else str(file.shown_count),
        file.largest or file.first, "; ".join(remarks_of(file))] for file in verdict.files]


def remarks_of(file):
    rule = f"{file.counts}: {file.rule}" if file.is_good and file.rule else file.rule
    return [*filter(None, (file.cause, rule)), *file.remarks]


def matrices(verdict):
    """The fitted matrices beside ours, with a line above each."""
    for file in verdict.files:
        if file.matrices:
            yield f"The matrix of {file.stage}, from the points of {file.file}:"
            yield from file.matrices.lines()
            yield ""


def names_of(files):
    return listed([file.file for file in files])


def sentence_of_right(verdict):
    words, rules = f"all {'five' if len(verdict.files) == 5 else 'three'} files are right", {}
    for file in verdict.files:
        if file.rule:
            rules.setdefault(file.rule, []).append(file)
    by_rules = "; ".join(
        f"{names_of(files)} by {'' if rule.startswith('another rule') else 'another rule: '}{rule}"
        for rule, files in rules.items())
    return f"{words}, {by_rules}; that {verdict.files[-1].counts}" if rules else words


def sentence(verdict):
    """The first stage that went wrong, why, and the later ones that are wrong by themselves."""
    failed = [file for file in verdict.files if file.verdict in FAILED]
    undecided = [file for file in verdict.files if file.verdict in OPEN]
    if not failed:
        return "; ".join(f"{file.file}: {file.verdict}" for file in undecided) or sentence_of_right(verdict)
    if all(file.verdict == MISSING for file in failed):
        are = "is" if len(failed) == 1 else "are"
        words = f"{names_of(failed)} {are} not handed in; what is there is right"
        return words if len(failed) < len(verdict.files) else "nothing is handed in"
    kind = failed[0].stage, failed[0].verdict, failed[0].causes
    first = [file for file in failed if (file.stage, file.verdict, file.causes) == kind]
    missing = [file for file in failed if file not in first and file.verdict == MISSING]
    rest = [file for file in failed if file not in [*first, *missing]]
    words = (f"the first stage that went wrong is {first[0].stage} ({names_of(first)} "
             f"{'is' if len(first) == 1 else 'are'} {first[0].verdict})")
    if first[0].cause:
        words += f": {first[0].cause}"
    open_words = (f"; not handed in: {names_of(missing)}" if missing else "") + "".join(
        f"; {file.file}: {file.verdict}" for file in undecided)
    if rest:
        by_reason = {}
        for file in rest:
            by_reason.setdefault(file.cause, []).append(file)
        others = ", ".join(names_of(some) + f" ({why})" * bool(why) for why, some in by_reason.items())
        return f"{words}; also wrong, by themselves: {others}{open_words}"
    last = [file for file in verdict.files if file.verdict not in OPEN and file not in missing][-1]
    after = verdict.files[verdict.files.index(first[-1]) + 1:]
    given = "by the right numbers" if any(
        BY_THE_RIGHT in remark for file in after for remark in file.remarks) else "given that"
    return words + (f"; what follows is right, {given}" if first[-1] is not last else "") + open_words


def next_command(verdict, theirs, scene, config):
    """The command that shows more of the first file that is wrong; None if there is none."""
    wrong = next((file for file in verdict.files if file.verdict == WRONG), None)
    if wrong is None or not all(map(os.path.isfile, (scene, config))):
        return None
    triangle = re.search(r"of triangle (\d+): ", wrong.first)
    words = ["explain", scene, config, "--triangle", triangle[1]] if triangle and wrong.stage != "zbuf" else [
        "inspect", scene, config, "--theirs", theirs]
    return shlex.join(["pipeline", *words])
