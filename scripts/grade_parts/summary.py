"""The table of mistakes, and how many hand-ins made each."""
import collections

from lib.judging.verdict import FAILED, OPEN, WRONG
from lib.rim.command import shown
from lib.showing.table import table


def equal_files(graded):
    """{number of a hand-in: remarks} where wrong files of two hand-ins are equal; right ones often are."""
    owners, remarks = collections.defaultdict(list), collections.defaultdict(list)
    for hand_in, result in graded:
        for place, digest in result.wrong.items():
            owners[place, digest].append(hand_in)
    for ((test, file), _), same in owners.items():
        for hand_in in same if len(same) > 1 else ():
            others = ", ".join(other.name for other in same if other is not hand_in)
            remarks[hand_in.number].append(f"{shown(test)}: the wrong {file} is equal to that of {others}")
    return remarks


def findings(graded):
    """The mistakes of a hand-in: pairs of a stage and words, each once for all tests."""
    if graded.failure:
        yield "", graded.failure.rstrip(".")
    tests = collections.Counter(pair for test in graded.tests for pair in {(file.stage, cause.text)
                                                                           for file in test.verdict.files
                                                                           for cause in file.causes})
    for test in graded.tests:
        for file in test.verdict.files:
            if file.verdict == WRONG:  # of causes that one test cannot tell apart, the most frequent
                most = max((tests[file.stage, cause.text] for cause in file.causes), default=0)
                yield file.stage, "; or: ".join(
                    cause.text.rstrip(".") for cause in file.causes
                    if tests[file.stage, cause.text] == most) or ("wrong, without a cause")
            elif file.verdict in FAILED or file.verdict in OPEN:
                yield file.stage, file.verdict
            elif file.rule:
                yield file.stage, "right, by " + file.rule.split(":")[0]


def summary(graded):
    """The lines of a table for [(HandIn, Graded)], the most frequent first, and a line about all."""
    counts = collections.Counter(finding for _, result in graded for finding in set(findings(result)))
    stages = ("model", "view", "project", "zbuf", "")
    found = sorted((-count, stages.index(stage), words) for (stage, words), count in counts.items())
    rows = [[str(-count), stages[stage], shown(words)] for count, stage, words in found]
    full = sum(not result.failure and all(file.is_good for test in result.tests
                                          for file in test.verdict.files) for _, result in graded)
    return [
        *(table(["hand-ins", "stage", "what"], rows) if rows else []), "",
        f"{len(graded)} hand-in{'' if len(graded) == 1 else 's'}, {full} right in all tests."]
