"""The teacher's word on hand-ins, in a CSV: points that win, and comments."""
import csv
import io
import os

from grade_parts.assignment import amount
from grade_parts.contents import without_suffix
from grade_parts.graders import GradedTest
from lib.judging.verdict import Verdict
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import read_input

COLUMNS = ["hand-in", "test", "points", "comment"]


def read_overrides(path, hand_ins, tests):
    """{number of a hand-in: [(test or "", points or None, comment)]} of a CSV; the hand-ins have their own
    names in it, also where students see numbers."""
    def expect(right, words):
        if not right:
            raise CommandFailure(f"{shown(path)}:{rows.line_num}: {words}")

    numbers = {}
    for hand_in in hand_ins:
        name = shown(without_suffix(os.path.basename(hand_in.path)))
        numbers.setdefault(name, []).append(hand_in.number)
    names = {test.name for test in tests}
    text = read_input(path).decode("utf-8-sig", errors="replace")
    rows, found = csv.reader(io.StringIO(text, newline=""), strict=True), {}
    try:
        expect(next(rows, None) == COLUMNS, f"expected the columns {','.join(COLUMNS)}")
        for row in filter(None, rows):
            expect(len(row) == len(COLUMNS), f"expected {len(COLUMNS)} columns, found {len(row)}")
            name, test, points, comment = map(str.strip, row)
            expect(name in numbers, f"expected the name of a hand-in, found '{shown(name)}'")
            expect(len(numbers[name]) == 1, f"{len(numbers[name])} hand-ins have the name '{shown(name)}'")
            expect(test in names or not test and not points,
                   f"expected the name of a test, found '{shown(test)}'")
            line = test, amount(points) if points else None, shown(comment)
            found.setdefault(numbers[name][0], []).append(line)
    except (csv.Error, ValueError) as error:
        expect(False, shown(str(error)))
    return found


def override(result, lines, tests):
    """Changes a Graded by its lines, and has it say so."""
    if not result.tests and any(test for test, _, _ in lines):
        result.tests = [
            GradedTest(test.name, 0.0, test.max_score, Verdict([]), result.failure, [], []) for test in tests]
    by_name = {test.name: test for test in result.tests}
    for name, points, comment in lines:
        said = f"Teacher: {comment}" if comment else "Teacher:"
        if not name:
            result.remarks.append(said)
            continue
        test = by_name[name]
        if points is not None:
            said += f" ({points:g} points in place of {test.score:.4g})"
            test.score = points
        test.by_teacher = " ".join(filter(None, (test.by_teacher, said)))
