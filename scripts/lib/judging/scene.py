"""A scene that `model` has accepted: camera, commands and points in world space, right or by a mistake."""
import math

from lib.judging import model_habits
from lib.judging.matrices import (image, negative, perspective_matrix, projection_matrix, slack, transposed,
                                  view_matrix)
from lib.maths.matrices import TRANSFORMS, Projection
from lib.maths.vectors import cross, normalized
from lib.text.scene import commands

NO_UNITS = (0.0, 0.0, 0.0)
OF_FRUSTUMS = {
    "near-and-far-swapped", "missing-two", "z-row-sign", "w-is-plus-z", "last-element-is-one",
    "depth-is-linear", "z-not-divided", "divided-twice", "depth-in-view-space", "depth-divided-twice"}


class Scene:
    """The text of a scene and the header that `model` made of it."""
    def __init__(self, text, header):
        self.commands = list(commands(text))
        self.header = header
        self.triangle_lines = [command.line for command in self.commands if command.keyword == "triangle"]
        self.eye, self.look, self.up = (tuple(map(float, header[name])) for name in ("eye", "look", "up"))
        self.l = tuple(b - a for a, b in zip(self.eye, self.look))
        keyword = next(name for name in ("perspective", "frustum", "ortho") if name in header)
        self.projection = Projection(keyword, header[keyword])

    def world(self, habit=model_habits.RIGHT):
        """The points after model with their slacks, one by one."""
        stack = model_habits.Stack(habit.stack)
        for command in self.commands:
            keyword = command.keyword
            if keyword in TRANSFORMS:
                numbers = tuple(map(float, command.arguments[0]))
                stack.matrix = habit.moved(stack.matrix, keyword, numbers)
            elif keyword == "triangle":
                for words in command.arguments:
                    p = tuple(map(float, words[:3]))
                    yield image(stack.matrix, p, False), slack(stack.matrix, p, NO_UNITS, False)
            stack.command(keyword)

    def shows(self, name):
        """True if a mistake of model moves points here, in each of its forms; False for an unnamed one."""
        return name in model_habits.MODEL_MISTAKES and all(
            any(math.dist(p, q) > 1e-3 for (p, _), (q, _) in zip(self.world(), self.world(habit)))
            for habit in model_habits.MODEL_MISTAKES[name])

    def matrix(self, stage, mistakes=(), spelling=0):
        if stage == "view":
            return view_matrix(self.eye, self.look, self.up, mistakes, spelling)
        return self.of_project(mistakes, spelling=spelling)

    def of_project(self, mistakes=(), pi=math.pi, spelling=0):
        """The matrix of project; None if the mistakes cannot be made with this projection."""
        kind = self.projection
        own = {*mistakes} - {"depth-from-0-to-1", "matrix-transposed"}  # which change any matrix
        if kind.kind == "perspective":
            m = perspective_matrix(*map(float, kind.numbers), kind.aspect_rule == "ratio", own, pi, spelling)
        else:
            m = tuple(tuple(map(float, row)) for row in kind.matrix())
            if own - {"no-divide"}:
                if kind.is_parallel or not own <= OF_FRUSTUMS:
                    return None
                window = (m[0][0], m[0][2], m[1][1], m[1][2])
                m = projection_matrix(window, float(kind.near), float(kind.far), own)
        if "depth-from-0-to-1" in mistakes:
            m = (*m[:2], tuple((z + w) / 2 for z, w in zip(m[2], self.of_project()[3])), m[3])
        return transposed(m) if "matrix-transposed" in mistakes else m

    def directions(self):
        """(name, vector) of each direction that a row of the matrix of view may have."""
        named = [("the scene's up", self.up), ("the scene's eye", self.eye), ("the scene's look", self.look),
                 ("look - eye", self.l), ("l x up", cross(normalized(self.l), self.up))]
        r, u, back = (row[:3] for row in self.matrix("view")[:3])
        named += ("r", r), ("u", u), ("l", negative(back))
        for name, v in named:
            yield name, v
            yield f"-{name}" if len(name) == 1 else f"-({name})", negative(v)
            if any(v) and len(name) > 1:
                yield f"{name}, divided by its length", normalized(v)
