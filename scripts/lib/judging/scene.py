"""A scene that `model` has accepted: its camera, its commands, and what it becomes in world space, right or
with one mistake."""
import contextlib
import dataclasses
import itertools
import math

from lib.judging.matrices import (DIVIDES_X_AND_Y, IDENTITY, TWICE, VIEW_SPELLINGS, Z_TWICE, affine,
                                  image, negative, perspective_matrix, product, projection_matrix, rotation,
                                  scaling, slack, transposed, translation, view_matrix)
from lib.judging.mistakes import sentences
from lib.maths.matrices import Projection
from lib.maths.vectors import cross, normalized
from lib.text.scene import commands

NO_UNITS = (0.0, 0.0, 0.0)
DIVISIONS = {"no-divide": False, "divided-twice": TWICE, "z-not-divided": DIVIDES_X_AND_Y,
             "depth-is-linear": DIVIDES_X_AND_Y, "depth-in-view-space": DIVIDES_X_AND_Y,
             "depth-divided-twice": Z_TWICE}  # by w; other mistakes of project divide all three
OF_FRUSTUMS = ("near-and-far-swapped", "missing-two", "z-row-sign", "w-is-plus-z", "last-element-is-one",
               "depth-is-linear", "z-not-divided", "divided-twice", "depth-in-view-space",
               "depth-divided-twice")
ROUGH_PIS = (3.1416, 3.14159, 3.1415927, 3.141592, 3.141593, 3.1415926, 3.1415, 3.142, 22 / 7, 3.14)


OF_THE_WHOLE = {"matrix-transposed", "depth-from-0-to-1"}  # made of the right matrix


@dataclasses.dataclass(frozen=True)
class Habit:
    """How a program carries out the commands. The defaults are right."""
    order: str = "right"            # on which side of the matrix a transform is multiplied
    stack: str = "nested"           # what push and pop do
    turn: object = None             # makes a matrix of an angle in degrees and an axis
    offset: str = ""                # added, put: what becomes of the matrix's last column at `translate`

    def moved(self, matrix, made, keyword):
        """The matrix after a command for which one was made."""
        if keyword == "translate" and self.offset == "put":
            return affine([row[:3] for row in matrix[:3]], [row[3] for row in made[:3]])
        is_left = self.order == "left" or keyword == "translate" and self.offset
        return product(made, matrix) if is_left else product(matrix, made)


def turned(degrees, axis, *factors):
    return rotation(math.radians(degrees), normalized(axis), *factors)


def turned_with(pi):
    return lambda degrees, axis: rotation(degrees * pi / 180, normalized(axis))


def with_wrong_element(m, row):
    """The matrix of a rotation with an element of its second column in its third."""
    return tuple((*line[:2], line[1], line[3]) if i == row else line for i, line in enumerate(m))


# How each mistake of model is made: the usual way first, then others that programs were seen to have.
MODEL_MISTAKES = {
    "multiplied-on-the-left": [Habit(order="left")],
    "push-and-pop-ignored": [Habit(stack="ignored")],
    "pop-ignored": [Habit(stack="no pop")],
    "push-of-the-identity": [Habit(stack="push identity")],
    "pop-to-the-identity": [Habit(stack="pop identity")],
    "second-push-lost": [
        Habit(stack=f"{lost}, {empty}")
        for lost in ("adjacent lost", "every other lost", "all but first lost", "nested lost")
        for empty in ("stay", "identity")] + [Habit(stack="one count")],
    "push-does-not-nest": [Habit(stack="slot"), Habit(stack="slot kept")],
    "axis-not-normalized": [Habit(turn=lambda degrees, axis: rotation(math.radians(degrees), axis))],
    "angle-in-radians": [Habit(turn=lambda degrees, axis: rotation(degrees, normalized(axis)))],
    "rotation-transposed": [Habit(turn=lambda degrees, axis: transposed(turned(degrees, axis)))],
    "rotation-element-from-the-wrong-column": [
        Habit(turn=lambda degrees, axis, row=row: with_wrong_element(turned(degrees, axis), row))
        for row in range(3)],
    "angle-negated": [Habit(turn=lambda degrees, axis: turned(-degrees, axis))],
    "translation-added": [Habit(offset="added"), Habit(offset="put")],
    "rotation-without-a-term": [
        Habit(turn=lambda degrees, axis, factors=factors: turned(degrees, axis, factors))
        for factors in (lambda c, s: (c, 1, s), lambda c, s: (c, 0, s), lambda c, s: (c, 1 - c, 0),
                        lambda c, s: (0, 1 - c, s))],
}


class Stack:
    """The current matrix and the saved ones, under a habit."""

    def __init__(self, habit):
        self.matrix, self.saved = IDENTITY, []
        # commands: any, and the last push or pop; whether that was lost
        self.last, self.last_of_stack, self.was_lost = "", "", False
        self.kind, _, self.empty = habit.partition(", ")
        self.count = 0  # of the transforms since the last push, for the habit that counts them

    def is_lost(self):
        """Whether a push that comes now saves nothing."""
        was_push = self.last_of_stack == "push"
        return {
            "adjacent lost": self.last == "push", "every other lost": was_push and not self.was_lost,
            "all but first lost": was_push, "nested lost": bool(self.saved)}.get(self.kind, False)

    def moved_to(self, matrix):
        self.matrix = matrix
        if self.kind == "one count":
            self.saved.append(matrix)
            self.count += 1

    def count_back(self, keyword):
        """push and pop of a program that keeps all matrices and counts those since the last push: that push
        forgets the count of the push before it."""
        if keyword == "push":
            self.count = 0
        elif keyword == "pop" and self.count:
            del self.saved[-self.count:]
            self.matrix = self.saved[-1] if self.saved else IDENTITY

    def command(self, keyword):
        if self.kind == "one count":
            return self.count_back(keyword)
        is_lost = keyword == "push" and self.is_lost()
        if keyword == "push" and self.kind != "ignored" and not is_lost:
            if self.kind.startswith("slot"):
                self.saved.clear()
            self.saved.append(self.matrix)
            if self.kind == "push identity":
                self.matrix = IDENTITY
        elif keyword == "pop" and self.kind not in ("ignored", "no pop"):
            if self.saved:
                popped = self.saved[-1] if self.kind == "slot kept" else self.saved.pop()
                self.matrix = IDENTITY if self.kind == "pop identity" else popped
            elif self.empty == "identity":
                self.matrix = IDENTITY
        if keyword in ("push", "pop"):
            self.last_of_stack, self.was_lost = keyword, is_lost
        self.last = keyword
        return None


class Scene:
    """The text of a scene and the header that `model` made of it."""

    def __init__(self, text, header):
        self.commands = list(commands(text))
        self.header = header
        self.triangle_lines = [command.line for command in self.commands if command.keyword == "triangle"]
        self.eye, self.look, self.up = (tuple(map(float, header[name])) for name in ("eye", "look", "up"))
        keyword = next(name for name in ("perspective", "frustum", "ortho") if name in header)
        self.projection = Projection(keyword, header[keyword])

    def world(self, habit=Habit()):
        """The points after model with their slacks, one by one."""
        stack, turn = Stack(habit.stack), habit.turn or turned
        for command in self.commands:
            keyword = command.keyword
            if keyword in ("translate", "scale", "rotate"):
                numbers = tuple(map(float, command.arguments[0]))
                made = turn(numbers[0], numbers[1:]) if keyword == "rotate" else (
                    translation if keyword == "translate" else scaling)(numbers)
                stack.moved_to(habit.moved(stack.matrix, made, keyword))
            elif keyword == "triangle":
                for words in command.arguments:
                    p = tuple(map(float, words[:3]))
                    yield image(stack.matrix, p, False), slack(stack.matrix, p, NO_UNITS, False)
            stack.command(keyword)

    def untouched(self):
        """The points as the scene gives them, before any transformation."""
        return [
            tuple(map(float, words[:3])) for command in self.commands if command.keyword == "triangle"
            for words in command.arguments]

    @staticmethod
    def model_mistakes():
        """(name, habits) for each mistake of model in the list."""
        return [(name, MODEL_MISTAKES[name]) for name in names_of("model") if name in MODEL_MISTAKES]

    def command_before(self, triangle):
        """The last command before a triangle that is none itself: the line after which it comes. None if
        there is none."""
        line = self.triangle_lines[triangle]
        before = itertools.takewhile(lambda command: command.line < line, self.commands)
        return next((command for command in reversed(list(before)) if command.keyword != "triangle"), None)

    def of_view(self, mistake="", spelling=0):
        return view_matrix(self.eye, self.look, self.up, mistake, spelling)

    def of_project(self, mistake="", pi=math.pi):
        """The matrix of project; None if the mistake cannot be made with this projection."""
        if mistake == "matrix-transposed":
            return transposed(self.of_project())
        if mistake == "depth-from-0-to-1":
            x_row, y_row, z_row, w_row = self.of_project()
            return x_row, y_row, tuple((z + w) / 2 for z, w in zip(z_row, w_row)), w_row
        kind = self.projection
        if kind.kind == "perspective":
            return perspective_matrix(*map(float, kind.numbers), kind.aspect_rule == "ratio", mistake, pi)
        exact = tuple(tuple(map(float, row)) for row in kind.matrix())
        if mistake in ("", "no-divide"):
            return exact
        if kind.is_parallel or not {*mistake.split()} <= {*OF_FRUSTUMS}:
            return None
        window = (exact[0][0], exact[0][2], exact[1][1], exact[1][2])
        return projection_matrix(window, float(kind.near), float(kind.far), mistake)

    def directions(self):
        """(name, vector) of what may stand in a row of the matrix of view."""
        l = tuple(b - a for a, b in zip(self.eye, self.look))
        named = [("the scene's up", self.up), ("the scene's eye", self.eye), ("the scene's look", self.look),
                 ("look - eye", l), ("l x up", cross(normalized(l), self.up))]
        r, u, back = (row[:3] for row in self.of_view()[:3])
        named += ("r", r), ("u", u), ("l", negative(back))
        for name, v in named:
            yield name, v
            yield f"-{name}" if len(name) == 1 else f"-({name})", negative(v)
            if any(v) and len(name) > 1:
                yield f"{name}, divided by its length", normalized(v)

    def view_pairs(self):
        """((name, name), matrix, whether it divides) for each two mistakes of view."""
        for pair in itertools.combinations(names_of("view"), 2):
            with contextlib.suppress(ZeroDivisionError):
                yield pair, self.of_view(" ".join(pair)), False

    def project_pairs(self):
        for pair in itertools.combinations(names_of("project"), 2):
            if OF_THE_WHOLE.isdisjoint(pair) and (len(DIVISIONS.keys() & pair) < 2):
                with contextlib.suppress(ZeroDivisionError, OverflowError):
                    matrix = self.of_project(" ".join(pair))
                    yield pair, matrix, next((DIVISIONS[name] for name in pair if name in DIVISIONS), True)

    def view_mistakes(self):
        """(name, matrix, whether it divides) for each mistake of view."""
        for name in names_of("view"):
            for spelling in range(VIEW_SPELLINGS.get(name, 1)):
                try:
                    m = self.of_view(name, spelling)
                except ZeroDivisionError:  # for example a direction of 0 0 0
                    continue
                yield name, m, False
                if name == "matrix-transposed":  # its w is not 1, and some programs divide by it
                    yield name, m, True

    def project_mistakes(self):
        for name in names_of("project"):
            try:
                matrix = self.of_project(name)
            except (ZeroDivisionError, OverflowError):
                continue
            if matrix is not None:
                yield name, matrix, DIVISIONS.get(name, True)
                if name == "depth-in-view-space":  # or the distance from the eye
                    yield name, (*matrix[:2], negative(matrix[2]), matrix[3]), DIVISIONS[name]

    @staticmethod
    def model_pairs():
        """((name, name), Habit) for each two mistakes of model that change different things."""
        for (a, (one, *_)), (b, (other, *_)) in itertools.combinations(Scene.model_mistakes(), 2):
            changes = {key: value for key, value in vars(other).items() if value != getattr(Habit(), key)}
            if all(getattr(one, key) == getattr(Habit(), key) for key in changes):
                yield (a, b), dataclasses.replace(one, **changes)


def names_of(stage):
    """The names of the mistakes of a stage, without the stage."""
    return [name.partition("/")[2] for name in sentences() if name.startswith(stage + "/")]
