"""Stages 1 to 3 of a hand-in: right, or with the mistake that reproduces their numbers."""
import dataclasses
import math

from judge_parts import fit
from judge_parts.digits import EXACT
from judge_parts.matrices import IDENTITY, ROUNDING, image, slack
from judge_parts.points import described, difference, differs
from judge_parts.scene import NO_UNITS, ROUGH_PIS, Habit, turned_with
from judge_parts.verdict import ANOTHER_RULE, RIGHT, TOO_FEW_DIGITS, UNDECIDED, WRONG, Cause, FileVerdict, cause_of
from lib.vectors import cross

UNCHANGED = "The points are those of the stage before, unchanged"


@dataclasses.dataclass
class Reading:
    """What a stage may have read: points, and how far each coordinate may be off."""
    points: list
    units: list

    @classmethod
    def exact(cls, points):
        return cls(points, [NO_UNITS] * len(points))


@dataclasses.dataclass
class Outcome:
    verdict: FileVerdict
    memory: list = None  # the exact points that the program has after this stage; None if they are not known


def matrix_images(m, is_divided, reading, reach=0.0):
    """The expected points of a stage with their slacks, one by one. `reach` is the size of what cancels in the matrix."""
    for p, units in zip(reading.points, reading.units):
        slacks = slack(m, p, units, is_divided)
        yield image(m, p, is_divided), [x + ROUNDING * reach for x in slacks]


def exact_images(m, is_divided, points):
    """The images of points; None if one is not defined."""
    done = [image(m, p, is_divided) for p in points]
    return done if all(math.isfinite(p[0]) for p in done) else None


def count_verdict(stage, name, theirs, expected):
    count = len(theirs) // 3
    return FileVerdict(stage, name, WRONG, remarks=[f"{count} triangle{'' if count == 1 else 's'} in place of {expected}"])


def undecided_outcome(stage, name):
    return Outcome(FileVerdict(stage, name, UNDECIDED, remarks=["the stages before give no points to judge it by"]))


def right_verdict(stage, name, theirs, rule=""):
    verdict = FileVerdict(stage, name, ANOTHER_RULE if rule else RIGHT, rule, differing=0, compared=3 * len(theirs))
    if theirs.digits.decimals is not None and theirs.digits.decimals < 7 or theirs.digits.decimals is None and theirs.digits.significant < 7:
        verdict.remarks.append(f"to the {theirs.digits} it shows")
    return verdict


class StageJudge:
    """Judges the first three stages of a scene, whose exact points in world space are given."""

    def __init__(self, scene, exact_world):
        self.scene, self.exact_world = scene, exact_world

    # model
    def model(self, name, theirs):
        """The Outcome for Points."""
        scene, count = self.scene, len(self.scene.triangle_lines)
        if len(theirs) != 3 * count:
            return Outcome(count_verdict("model", name, theirs, count))
        slacks = [slacks for _, slacks in scene.world()]
        digits = EXACT if theirs.digits.are_too_few else theirs.digits
        if not differs(theirs.points, digits, zip(self.exact_world, slacks)):
            return Outcome(right_verdict("model", name, theirs), self.exact_world)
        for pi in ROUGH_PIS:
            habit = Habit(turn=turned_with(pi))
            if not differs(theirs.points, digits, scene.world(habit)):
                return Outcome(right_verdict("model", name, theirs, f"pi is taken as {pi:.8g}"), [p for p, _ in scene.world(habit)])
        found = self.model_mistakes(theirs.points, digits)
        untouched = self.scene.untouched()
        if not found and not differs(theirs.points, digits, ((p, NO_UNITS) for p in untouched)):
            verdict = self.wrong("model", name, theirs, difference(theirs.points, digits, zip(self.exact_world, slacks)))
            verdict.causes = [Cause("", "The points are those of the scene: no transformation is carried out")]
            return Outcome(verdict, untouched)
        if not found and theirs.digits.are_too_few:
            return Outcome(self.undecided("model", name, theirs))
        result = difference(theirs.points, digits, zip(self.exact_world, slacks))
        verdict = self.wrong("model", name, theirs, result)
        place = self.place_of(result.first_triangle)
        verdict.causes = [cause_of("model/" + mistake, place if i == len(found) - 1 else "") for i, mistake in enumerate(found)]
        if not found and place:
            verdict.remarks.append(place)
        return Outcome(verdict, [p for p, _ in scene.world(next(iter(found.values())))] if found else None)

    def model_mistakes(self, points, digits):
        """{name: habit} of the mistakes that reproduce the points. Each is made in its usual way; only if none fits, in others."""
        for ways in (lambda habits: habits[:1], lambda habits: habits[1:]):
            found = {}
            for name, habits in self.scene.model_mistakes():
                fitting = (habit for habit in ways(habits) if not differs(points, digits, self.scene.world(habit)))
                if habit := next(fitting, None):
                    found[name] = habit
            if found:
                return found
        return {}

    def place_of(self, triangle):
        """Where the first wrong triangle stands in the scene."""
        line, before = self.scene.triangle_lines[triangle], self.scene.command_before(triangle)
        after = f", after {before.keyword} in line {before.line}" if before else ""
        return f"the first wrong triangle is number {triangle}, in line {line} of the scene{after}"

    # view and project
    def view(self, name, theirs, readings):
        right = [("", self.scene.of_view(), False)]
        return self.by_matrix("view", name, theirs, readings, right, list(self.scene.view_mistakes()))

    def project(self, name, theirs, readings, others=()):
        """`others` are lists of points that are right, too: those that were clipped, for each reading, the exact one last."""
        right = [("", self.scene.of_project(), True)]
        if self.scene.projection.kind == "perspective":
            right += [(f"pi is taken as {pi:.8g}", self.scene.of_project(pi=pi), True) for pi in ROUGH_PIS]
        digits = EXACT if theirs.digits.are_too_few else theirs.digits
        for points in reversed(others):  # the exact ones are what the program may have in memory
            if len(points) == len(theirs) and not differs(theirs.points, digits, ((p, NO_UNITS) for p in points)):
                return Outcome(right_verdict("project", name, theirs), points)
        return self.by_matrix("project", name, theirs, readings, right, list(self.scene.project_mistakes()))

    def by_matrix(self, stage, name, theirs, readings, right, mistakes):
        """The Outcome of a stage that is one matrix for all points. `right` and `mistakes` are (name, matrix, whether it divides); the
        name of what is right is the rule, in words."""
        given = readings
        readings = [reading for reading in given if len(reading.points) == len(theirs)]
        if not readings:
            return Outcome(count_verdict(stage, name, theirs, len(given[0].points) // 3)) if given else undecided_outcome(stage, name)
        digits = EXACT if theirs.digits.are_too_few else theirs.digits
        reach = math.hypot(*self.scene.eye) if stage == "view" else 0.0
        memory = readings[-1].points

        def is_by(m, is_divided):
            return any(not differs(theirs.points, digits, matrix_images(m, is_divided, reading, reach)) for reading in readings)

        for rule, m, is_divided in right:
            if is_by(m, is_divided):
                return Outcome(right_verdict(stage, name, theirs, rule), exact_images(m, is_divided, memory))
        _, ours, divides = right[0]
        found = {}
        for mistake, m, is_divided in mistakes:
            if mistake not in found and is_by(m, is_divided):
                found[mistake] = (m, is_divided)
        causes = [cause_of(f"{stage}/{mistake}", self.detail(mistake)) for mistake in found]
        if not found and theirs.digits.are_too_few:
            return Outcome(self.undecided(stage, name, theirs))
        if not found and is_by(IDENTITY, False):
            causes, found = [Cause("", UNCHANGED)], {UNCHANGED: (IDENTITY, False)}
        elif not found:
            causes, found = self.changed_elements(stage, ours, divides, is_by)
        verdict = self.wrong(stage, name, theirs, min((difference(theirs.points, digits, matrix_images(ours, divides, reading, reach))
                                                       for reading in readings), key=lambda result: result.differing))
        verdict.causes = causes
        verdict.matrices = fit.compare(readings[0].points, theirs.points, theirs.units, ours, divides)
        return Outcome(verdict, exact_images(*next(iter(found.values())), memory) if found else None)

    def detail(self, mistake):
        """A number that shows the mistake."""
        scene = self.scene
        if mistake == "r-not-unit":
            l = tuple(b - a for a, b in zip(scene.eye, scene.look))
            return f"its length is {math.hypot(*cross(l, scene.up)) / math.hypot(*l):.4f}"
        if mistake == "l-not-unit":
            return f"its length is {math.hypot(*(b - a for a, b in zip(scene.eye, scene.look))):.4f}"
        return ""

    @staticmethod
    def changed_elements(stage, ours, divides, is_by):
        """A cause outside the list: one row with the opposite sign, or one element that is another number. None if several would do."""
        found = {}
        for i in range(4 if stage == "project" else 3):
            m = tuple(tuple(-x for x in row) if k == i else row for k, row in enumerate(ours))
            if is_by(m, divides):
                found[f"Row {i + 1} of the matrix has the opposite sign"] = (m, divides)
        numbers = {0.0, 1.0, -1.0, *(sign * abs(x) for row in ours for x in row for sign in (1, -1))}
        for i in range(4 if stage == "project" else 3):
            for j in range(4):
                for value in sorted(numbers | {2 * ours[i][j], ours[i][j] / 2}):
                    m = tuple(tuple(value if (k, n) == (i, j) else x for n, x in enumerate(row)) for k, row in enumerate(ours))
                    if value != ours[i][j] and is_by(m, divides):
                        found[f"Row {i + 1}, column {j + 1} of the matrix is {value:.6g}, not {ours[i][j]:.6g}"] = (m, divides)
        return ([Cause("", text) for text in found], found) if len(found) == 1 else ([], {})

    # verdicts
    @staticmethod
    def wrong(stage, name, theirs, result):
        largest, first = (described(pair, theirs.lines) if pair else "" for pair in (result.largest, result.first))
        return FileVerdict(stage, name, WRONG, differing=result.differing, compared=result.compared, largest=largest, first=first)

    @staticmethod
    def undecided(stage, name, theirs):
        return FileVerdict(stage, name, TOO_FEW_DIGITS, remarks=[f"it shows {theirs.digits}"])
