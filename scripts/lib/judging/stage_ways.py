"""The ways in which a text of stage 1, 2 or 3 may have come about: right, or with mistakes."""
import collections
import dataclasses
import itertools
import math

from lib.judging import fit
from lib.judging.matrices import IDENTITY, ROUNDING, image, slack
from lib.judging.matrix_mistakes import causes_by_rows, changed_elements, listed, other_forms
from lib.judging.model_habits import MODEL_MISTAKES, ROUGH_PIS, Habit, model_pairs
from lib.judging.pixel_rules import MOST_PAIRS
from lib.judging.scene import NO_UNITS
from lib.judging.verdict import Cause, cause_of, cause_of_all
from lib.maths.vectors import cross, normalized

UNTOUCHED = "The points are those of the scene: no transformation is carried out"
UNCHANGED = "The points are those of the stage before, unchanged"
PI = "pi is taken as {:.8g}"
# `cause` is the mistake, or the rule of a right way; `images` makes lists of (point, slacks of its
# coordinates), one for each reading; `memory` makes the exact points, None if they are not known.
Way = collections.namedtuple("Way", "cause images memory")


def exact_reading(points):
    """A possible input of a stage is (points, how far each coordinate may be off)."""
    return points, [NO_UNITS] * len(points)


def exact_images(m, is_divided, points):
    """The images of points; None if one is not defined."""
    done = [image(m, p, is_divided) for p in points]
    return done if all(math.isfinite(p[0]) for p in done) else None


class ModelWays:
    """The ways of model. `exact_world` are the right points."""
    stage = "model"

    def __init__(self, scene, exact_world):
        self.scene = scene
        self.scene_lines = scene.triangle_lines
        exact = [(p, slacks) for p, (_, slacks) in zip(exact_world, scene.world())]
        self.right = [
            Way(Cause("", ""), lambda: [exact], lambda: exact_world),
            *(self.way(Cause("", PI.format(pi)), Habit(radians=lambda degrees, pi=pi: degrees * pi / 180))
              for pi in ROUGH_PIS)]

    def way(self, cause, habit):
        return Way(cause, lambda: [self.scene.world(habit)], lambda: [p for p, _ in self.scene.world(habit)])

    def has_count(self, count):
        return count == 3 * len(self.scene_lines)

    def single(self):
        """Lists of Ways: mistakes in their usual form, then in others, for where none of those fits."""
        for chosen in (slice(1), slice(1, None)):
            yield (self.way(cause_of("model/" + name), habit) for name, habits in MODEL_MISTAKES.items()
                   for habit in habits[chosen])
        yield [self.way(Cause("", UNTOUCHED), Habit(order="neither"))]

    def several(self):
        """(Ways, how many of them may fit before none counts)."""
        yield (self.way(cause_of_all("model", pair), habit)
               for pair, habit in model_pairs(len(self.scene_lines))), MOST_PAIRS

    def with_details(self, causes, result):
        *others, last = causes
        return [*others, dataclasses.replace(last, detail=self.place(result) if last.name else "")]

    def place(self, result):
        """The place of the first wrong triangle in the scene, and the last command before it."""
        triangle = result[0][0] // 3
        line = self.scene_lines[triangle]
        before = [one for one in self.scene.commands if one.line < line and one.keyword != "triangle"]
        after = f", after {before[-1].keyword} in line {before[-1].line}" if before else ""
        return f"the first wrong triangle is number {triangle}, in line {line} of the scene{after}"


class MatrixWays:
    """The ways of view or project, each one matrix. `right` are (rule in words, matrix, is_divided)."""
    scene_lines = ()

    def __init__(self, stage, scene, readings, right):
        self.stage, self.scene, self.readings = stage, scene, readings
        self.ours = right[0][1]
        # the rounding of numbers that cancel in the matrix
        self.reach = ROUNDING * math.hypot(*scene.eye) if stage == "view" else 0.0
        self.right = [self.way(Cause("", rule), m, is_divided) for rule, m, is_divided in right]

    def way(self, cause, m, is_divided):
        def images(reading):
            for p, units in zip(*reading):
                yield image(m, p, is_divided), [x + self.reach for x in slack(m, p, units, is_divided)]

        return Way(cause, lambda: map(images, self.readings),
                   lambda: exact_images(m, is_divided, self.readings[-1][0]))

    def has_count(self, count):
        """True if a reading has as many points as the text; others are then no longer asked."""
        comparable = [reading for reading in self.readings if len(reading[0]) == count]
        self.readings = comparable or self.readings
        return bool(comparable)

    def made(self, candidates):
        return itertools.starmap(self.way, candidates)

    def single(self):
        """As in ModelWays."""
        unchanged = Cause("", UNCHANGED), IDENTITY, False
        yield self.made([unchanged, *listed(self.stage, self.scene)])
        yield self.made(other_forms(self.stage, self.ours))

    def several(self):
        """As in ModelWays: one element, or two mistakes."""
        yield self.made(changed_elements(self.stage, self.ours)), 1
        yield self.made(listed(self.stage, self.scene, 2)), MOST_PAIRS

    def with_details(self, causes, _):
        l = self.scene.l
        r = cross(normalized(l), self.scene.up)
        lengths = {"view/l-not-unit": math.hypot(*l), "view/r-not-unit": math.hypot(*r)}
        details = {name: f"its length is {length:.4f}" for name, length in lengths.items()}
        return [dataclasses.replace(cause, detail=details.get(cause.name, "")) for cause in causes]

    def add_matrix(self, verdict, theirs):
        """Adds the matrix that the points show, and the cause that lies in its elements, or in its rows."""
        verdict.matrices = fit.compare(self.readings[0][0], theirs.points, theirs.units, self.ours,
                                       self.stage == "project")
        verdict.causes = verdict.causes or fit.cause_of_elements(verdict.matrices) or causes_by_rows(
            self, theirs, theirs.digits, verdict.matrices)
        verdict.remarks += fit.known_rows(verdict, self.scene.directions() if self.stage == "view" else ())
