"""Stages 1 to 3 of a hand-in: right, or with the mistake that reproduces their numbers."""
import dataclasses
import math

from lib.judging import fit
from lib.judging import matching
from lib.judging import some_vertices
from lib.judging.digits import EXACT
from lib.judging.matrices import ROUNDING, image, slack
from lib.judging.matrix_causes import MOST_PAIRS, MatrixCauses
from lib.judging.points import described, difference, differs
from lib.judging.scene import NO_UNITS, ROUGH_PIS, Habit, turned_with
from lib.judging.some_vertices import ALL_VERTICES
from lib.judging.verdict import (
    ANOTHER_RULE, RIGHT, TOO_FEW_DIGITS, UNDECIDED, WRONG, Cause, FileVerdict, cause_of, cause_of_all)
from lib.maths.vectors import cross


@dataclasses.dataclass
class Reading:
    """What a stage may have read: points, and how far each coordinate may be off."""
    points: list
    units: list

    @classmethod
    def exact(cls, points):
        return cls(points, [NO_UNITS] * len(points))

    def at(self, part):
        """Those of a slice."""
        return self if part is ALL_VERTICES[0] else Reading(self.points[part], self.units[part])


@dataclasses.dataclass
class Outcome:
    verdict: FileVerdict
    memory: list = None  # the exact points that the program has after this stage; None if they are not known


def matrix_images(m, is_divided, reading, reach=0.0):
    """The expected points of a stage with their slacks, one by one. `reach` is the size of what cancels in
    the matrix."""
    for p, units in zip(reading.points, reading.units):
        slacks = slack(m, p, units, is_divided)
        yield image(m, p, is_divided), [x + ROUNDING * reach for x in slacks]


def exact_images(m, is_divided, points):
    """The images of points; None if one is not defined."""
    done = [image(m, p, is_divided) for p in points]
    return done if all(math.isfinite(p[0]) for p in done) else None


def count_verdict(stage, name, theirs, expected, digits, scene_lines=()):
    """The verdict on a text with more or fewer triangles than `expected`, which are lists of points with
    their slacks, right ones in the right number. The cause is which triangle is missing or too many, if all
    others are right. `scene_lines` are where the triangles stand in the scene, if that is the input."""
    ours = [triangles_of(points) for points in expected]
    count = len(theirs) // 3
    verdict = FileVerdict(stage, name, WRONG,
                          remarks=[f"{count} triangle{'' if count == 1 else 's'} in place of {len(ours[0])}"])
    written, lines = triangles_of(theirs.points), theirs.lines[::3]

    def is_same(triangle, right):
        return not differs(triangle, digits, right)

    texts = [
        matching.missing(written, triangles, is_same, scene_lines)
        if count < len(triangles) else matching.added(written, triangles, is_same, lines)
        for triangles in ours]
    verdict.causes = [Cause("", text) for text in texts if text][:1]
    return verdict


def causes_of_order(theirs, expected, digits):
    """The cause if a text has the right triangles in another order; a list of at most one."""
    def is_same(triangle, right):
        return not differs(triangle, digits, right)

    texts = (matching.reordered(triangles_of(theirs.points), triangles_of(points), is_same)
             for points in expected)
    return [Cause("", text) for text in [next(filter(None, texts), "")] if text]


def used_digits(theirs):
    """Mistakes are not named by numbers that show too few digits."""
    return EXACT if theirs.digits.are_too_few else theirs.digits


def triangles_of(points):
    points = list(points)
    return [points[i:i + 3] for i in range(0, len(points), 3)]


def undecided_outcome(stage, name, why="the stages before give no points to judge it by"):
    return Outcome(FileVerdict(stage, name, UNDECIDED, remarks=[why]))


def right_verdict(stage, name, theirs, rule=""):
    verdict = FileVerdict(stage, name, ANOTHER_RULE if rule else RIGHT, rule, differing=0,
                          compared=3 * len(theirs))
    decimals = theirs.digits.decimals
    if (theirs.digits.significant if decimals is None else decimals) < 7:
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
        digits = used_digits(theirs)
        if len(theirs) != 3 * count:
            return Outcome(count_verdict("model", name, theirs, [scene.world()], digits,
                                         scene.triangle_lines))
        right = [(p, slacks) for p, (_, slacks) in zip(self.exact_world, scene.world())]
        if not differs(theirs.points, digits, right):
            return Outcome(right_verdict("model", name, theirs), self.exact_world)
        for pi in ROUGH_PIS:
            habit = Habit(turn=turned_with(pi))
            if not differs(theirs.points, digits, scene.world(habit)):
                return Outcome(right_verdict("model", name, theirs, f"pi is taken as {pi:.8g}"),
                               [p for p, _ in scene.world(habit)])
        found, untouched = self.model_mistakes(theirs.points, digits), scene.untouched()
        result = difference(theirs.points, digits, right)
        verdict = self.wrong("model", name, theirs, result)
        if not found and not differs(theirs.points, digits, ((p, NO_UNITS) for p in untouched)):
            verdict.causes = [
                Cause("", "The points are those of the scene: no transformation is carried out")]
            return Outcome(verdict, untouched)
        if not found and theirs.digits.are_too_few:
            return self.outcome_of_few_digits("model", name, theirs, [right])
        place = self.place_of(result.first_triangle)
        verdict.causes = [
            cause_of("model/" + mistake, place if i == len(found) - 1 else "")
            for i, mistake in enumerate(found)]
        if not found:
            verdict.causes = causes_of_order(theirs, [right], digits) or self.two_of_model(
                theirs.points, digits) or some_vertices.causes(
                result, count, lambda part: not differs(theirs.points[part], digits, right[part]),
                lambda parts: [
                    cause_of("model/" + mistake)
                    for mistake in self.model_mistakes(theirs.points, digits, parts)])
            verdict.remarks += ([place] if place else []) + (some_vertices.few_triangles(result, count)
                                                             if not verdict.causes else [])
        return Outcome(verdict, [p for p, _ in scene.world(next(iter(found.values())))] if found else None)

    def model_mistakes(self, points, digits, parts=ALL_VERTICES):
        """{name: habit} of the mistakes that reproduce the points. Each is made in its usual way; only if
        none fits, in others."""
        def is_by(habit):
            if parts is ALL_VERTICES:  # without a list of them all
                return not differs(points, digits, self.scene.world(habit))
            world = list(self.scene.world(habit))
            return not any(differs(points[part], digits, world[part]) for part in parts)

        for ways in (lambda habits: habits[:1], lambda habits: habits[1:]):
            found = {}
            for name, habits in self.scene.model_mistakes():
                fitting = (habit for habit in ways(habits) if is_by(habit))
                if habit := next(fitting, None):
                    found[name] = habit
            if found:
                return found
        return {}

    def two_of_model(self, points, digits):
        """The causes if two mistakes at once reproduce the points."""
        found = [cause_of_all("model", pair) for pair, habit in self.scene.model_pairs()
                 if not differs(points, digits, self.scene.world(habit))]
        return found if len(found) <= MOST_PAIRS else []

    def place_of(self, triangle):
        """Where the first wrong triangle stands in the scene."""
        line, before = self.scene.triangle_lines[triangle], self.scene.command_before(triangle)
        after = f", after {before.keyword} in line {before.line}" if before else ""
        return f"the first wrong triangle is number {triangle}, in line {line} of the scene{after}"

    # view and project
    def view(self, name, theirs, readings):
        right = [("", self.scene.of_view(), False)]
        return self.by_matrix("view", name, theirs, readings, right)

    def project(self, name, theirs, readings, others=()):
        """`others` are lists of points that are right, too: those that were clipped, for each reading, the
        exact one last."""
        right = [("", self.scene.of_project(), True)]
        if self.scene.projection.kind == "perspective":
            right += [(f"pi is taken as {pi:.8g}", self.scene.of_project(pi=pi), True) for pi in ROUGH_PIS]
        digits = used_digits(theirs)
        for points in reversed(others):  # the exact ones are what the program may have in memory
            if len(points) == len(theirs) and not differs(theirs.points, digits,
                                                          ((p, NO_UNITS) for p in points)):
                return Outcome(right_verdict("project", name, theirs), points)
        return self.by_matrix("project", name, theirs, readings, right)

    def by_matrix(self, stage, name, theirs, readings, right):
        """The Outcome of a stage that is one matrix for all points. `right` has (rule in words, matrix,
        whether it divides)."""
        if not readings:
            return undecided_outcome(stage, name)
        fitting = [reading for reading in readings if len(reading.points) == len(theirs)]
        if fitting:
            return self.by_images(stage, name, theirs, fitting, right)
        return Outcome(
            count_verdict(stage, name, theirs, [
                matrix_images(m, is_divided, reading, self.reach(stage))
                for reading in readings
                for _, m, is_divided in right], used_digits(theirs)))

    def reach(self, stage):
        return math.hypot(*self.scene.eye) if stage == "view" else 0.0

    def by_images(self, stage, name, theirs, readings, right):
        """The same of a text that has as many points as the readings."""
        digits, reach, memory = used_digits(theirs), self.reach(stage), readings[-1].points

        def is_by(m, is_divided, parts=ALL_VERTICES):
            return any(not any(
                differs(theirs.points[part], digits, matrix_images(m, is_divided, reading.at(part), reach))
                for part in parts)
                       for reading in readings)

        def images(m, is_divided):
            return [matrix_images(m, is_divided, reading, reach) for reading in readings]

        for rule, m, is_divided in right:
            if is_by(m, is_divided):
                return Outcome(right_verdict(stage, name, theirs, rule), exact_images(m, is_divided, memory))
        _, ours, divides = right[0]
        causes = self.causes_of_matrices(stage, (ours, divides), is_by)
        found = causes.of_the_list()
        if not found and theirs.digits.are_too_few:
            return self.outcome_of_few_digits(stage, name, theirs,
                                              [points for _, *way in right for points in images(*way)])
        result = min((difference(theirs.points, digits, points) for points in images(ours, divides)),
                     key=lambda result: result.differing)
        verdict = self.wrong(stage, name, theirs, result)
        found = found or causes.of_the_form() or causes.of_an_element() or causes.of_two()
        verdict.causes = [dataclasses.replace(cause, detail=self.detail(cause.name)) for cause, *_ in found]
        count = len(theirs) // 3
        verdict.causes = verdict.causes or causes_of_order(
            theirs, images(ours, divides), digits) or some_vertices.causes(
                result, count,
                lambda part: any(is_by(m, is_divided, [part]) for _, m, is_divided in right),
                lambda parts: [cause for cause, *_ in causes.of_the_list(parts) or causes.of_the_form(parts)])
        verdict.remarks += some_vertices.few_triangles(result, count) if not verdict.causes else []
        verdict.matrices = fit.compare(readings[0].points, theirs.points, theirs.units, ours, divides)
        verdict.causes = verdict.causes or fit.cause_of_one_element(verdict.matrices)
        verdict.remarks += fit.known_rows(verdict, self.scene.directions() if stage == "view" else ())
        return Outcome(verdict, exact_images(*found[0][1:], memory) if found else None)

    def causes_of_matrices(self, stage, right, is_by):
        scene = self.scene
        mistakes, pairs = (scene.view_mistakes(), scene.view_pairs()) if stage == "view" else (
            scene.project_mistakes(), scene.project_pairs())
        return MatrixCauses(stage, right, list(mistakes), pairs, is_by)

    def detail(self, name):
        """A number that shows the mistake."""
        scene = self.scene
        if name == "view/r-not-unit":
            l = tuple(b - a for a, b in zip(scene.eye, scene.look))
            return f"its length is {math.hypot(*cross(l, scene.up)) / math.hypot(*l):.4f}"
        if name == "view/l-not-unit":
            return f"its length is {math.hypot(*(b - a for a, b in zip(scene.eye, scene.look))):.4f}"
        return ""

    # verdicts
    @staticmethod
    def wrong(stage, name, theirs, result):
        largest, first = (described(pair, theirs.lines) if pair else ""
                          for pair in (result.largest, result.first))
        return FileVerdict(stage, name, WRONG, differing=result.differing, compared=result.compared,
                           largest=largest, first=first)

    def outcome_of_few_digits(self, stage, name, theirs, expected):
        """Of a text with too few digits to name a mistake by. It is wrong if it differs from all that is
        right (lists of points with their slacks) by more than those digits hide."""
        result = min((difference(theirs.points, theirs.digits, points) for points in expected),
                     key=lambda result: result.differing)
        if not result.differing:
            return Outcome(FileVerdict(stage, name, TOO_FEW_DIGITS, remarks=[f"it shows {theirs.digits}"]))
        verdict = self.wrong(stage, name, theirs, result)
        verdict.remarks.append(f"it shows {theirs.digits}, too few to name a cause")
        return Outcome(verdict)
