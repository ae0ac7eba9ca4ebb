"""How programs carry out the commands of a scene: the right way, and the ways of each mistake of model."""
import dataclasses
import functools
import itertools
import math

from lib.judging.matrices import IDENTITY, affine, product, rotation, scaling, translation, transposed
from lib.maths.matrices import TRANSFORMS
from lib.maths.vectors import normalized

ROUGH_PIS = (3.1416, 3.14159, 3.1415927, 3.141592, 3.141593, 3.1415926, 3.1415, 3.142, 22 / 7, 3.14)
MANY = 1000


def with_wrong_element(m, row):
    """The matrix of a rotation with an element of its second column in its third."""
    return tuple((*line[:2], line[1], line[3]) if i == row else line for i, line in enumerate(m))


def by_euler_angles(order, radians, axis):
    """The turns about x, y and z that an angle and an axis stand for, multiplied in this order."""
    return functools.reduce(product, (rotation(radians * axis[i], IDENTITY[i][:3]) for i in order))


@dataclasses.dataclass(frozen=True)
class Habit:
    """How a program carries out the commands. The defaults are right."""
    order: str = "right"  # on which side of the matrix a transform is multiplied: right, left, left
    #                                 if it is a rotation, or neither
    stack: str = "nested"  # how push and pop work
    radians: object = math.radians  # of degrees
    axis: object = normalized  # made of the axis of a rotation
    form: object = rotation  # makes a matrix of radians and an axis
    after: object = tuple  # made of that matrix
    offset: str = ""  # added, put: how `translate` changes the matrix's last column

    def moved(self, matrix, keyword, numbers):
        """The matrix after a transform."""
        if keyword == "rotate":
            made = self.after(self.form(self.radians(numbers[0]), self.axis(numbers[1:])))
        else:
            made = (translation if keyword == "translate" else scaling)(numbers)
        if self.order == "neither":
            return matrix
        if keyword == "translate" and self.offset == "put":
            return affine([row[:3] for row in matrix[:3]], [row[3] for row in made[:3]])
        is_left = self.order == "left" or keyword == "translate" and self.offset or (
            self.order == "left if a rotation" and keyword == "rotate")
        return product(made, matrix) if is_left else product(matrix, made)


RIGHT = Habit()

# How each mistake of model is made: the usual way first, then others that programs were seen to have.
MODEL_MISTAKES = {
    "multiplied-on-the-left": [Habit(order="left")],
    "push-and-pop-ignored": [Habit(stack="ignored")],
    "pop-ignored": [Habit(stack="ignored")],
    "push-of-the-identity": [Habit(stack="push identity")],
    "pop-to-the-identity": [Habit(stack="pop identity")],
    "second-push-lost": [
        Habit(stack=f"{lost}, {empty}")
        for lost in ("adjacent lost", "every other lost", "all but first lost", "nested lost")
        for empty in ("stay", "identity")] + [Habit(stack="one count")],
    "push-does-not-nest": [Habit(stack="slot"), Habit(stack="slot kept")],
    "pop-takes-one-transform": [Habit(stack="one transform"),
                                Habit(stack="one transform, push saves none")],
    "axis-not-normalized": [Habit(axis=tuple)],
    "angle-in-radians": [Habit(radians=float)],
    "rotation-transposed": [Habit(after=transposed)],
    "rotation-element-from-the-wrong-column": [
        Habit(after=functools.partial(with_wrong_element, row=row)) for row in range(3)],
    "angle-negated": [Habit(radians=lambda degrees: math.radians(-degrees))],
    "translation-added": [Habit(offset="added"), Habit(offset="put")],
    "rotation-without-a-term": [
        Habit(form=functools.partial(rotation, factors=factors))
        for factors in (lambda c, s: (c, 1, s), lambda c, s: (c, 0, s), lambda c, s: (c, 1 - c, 0),
                        lambda c, s: (0, 1 - c, s))],
    "rotation-on-the-left": [Habit(order="left if a rotation")],
    "rotation-by-euler-angles": [
        Habit(form=functools.partial(by_euler_angles, order), axis=axis) for axis in (normalized, tuple)
        for order in itertools.permutations(range(3))],}


class Stack:
    """The current and saved matrices, under a habit; kinds "one ..." also save after a transform."""
    def __init__(self, habit):
        self.matrix, self.saved = IDENTITY, []
        self.last, self.was_push, self.was_lost = "", False, False  # the last command; the last push or pop
        self.kind, _, self.rest = habit.partition(", ")
        self.count = 1  # how many pop takes back; in "one count", all since a push

    def is_lost(self):
        """True if a push that comes now saves nothing."""
        return self.kind in ("ignored", "one count") or {
            "adjacent lost": self.last == "push", "every other lost": self.was_push and not self.was_lost,
            "all but first lost": self.was_push, "nested lost": bool(self.saved), "one transform": bool(
                self.rest)}.get(self.kind, False)

    def push(self):
        self.was_push, self.was_lost = True, self.is_lost()
        if not self.was_lost:
            if self.kind.startswith("slot"):
                self.saved.clear()
            self.saved.append(self.matrix)
            self.matrix = IDENTITY if self.kind == "push identity" else self.matrix
        elif self.kind == "one count":
            self.count = 0

    def pop(self):
        self.was_push = False
        if self.kind.startswith("one") and self.count:
            del self.saved[-self.count:]
            self.matrix = self.saved[-1] if self.saved else IDENTITY
        elif self.saved and self.kind != "one count":
            popped = self.saved[-1] if self.kind == "slot kept" else self.saved.pop()
            self.matrix = IDENTITY if self.kind == "pop identity" else popped
        elif self.rest == "identity":
            self.matrix = IDENTITY

    def command(self, keyword):
        """Carries out a push or a pop, or takes note of another command, after its transform."""
        if keyword in ("push", "pop"):
            (self.push if keyword == "push" else self.pop)()
        elif keyword in TRANSFORMS and self.kind.startswith("one"):
            self.saved.append(self.matrix)
            self.count += self.kind == "one count"
        self.last = keyword


def model_pairs(triangle_count):
    """((name, name), Habit) of any two mistakes that change different things; of MANY triangles, one way."""
    chosen = slice(1 if triangle_count > MANY else None)
    for (a, ones), (b, others) in itertools.combinations(MODEL_MISTAKES.items(), 2):
        for one, other in itertools.product(ones[chosen], others[chosen]):
            changes = {key: value for key, value in vars(other).items() if value != getattr(RIGHT, key)}
            if all(getattr(one, key) == getattr(RIGHT, key) for key in changes):
                yield (a, b), dataclasses.replace(one, **changes)
