"""A student's stages 1 to 3, in plain doubles with 4 x 4 matrices, and with students' errors.

An error is a word: "swapped 1" and "swapped 2" (rows and columns of the rotation), "radians 1" and "radians 3" (degrees taken
as radians by the rotations, or in the field of view), "up", "divide", "handedness", "rounding".
"""
import math

IDENTITY = [[float(i == j) for j in range(4)] for i in range(4)]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def transposed(a):
    return [list(column) for column in zip(*a)]


def image(m, p):
    x, y, z, w = (sum(a * b for a, b in zip(row, (*p, 1))) for row in m)
    return x, y, z, w


def unit(v):
    return [x / math.hypot(*v) for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def rotation(angle, axis):
    a = unit(axis)
    c, s = math.cos(angle), math.sin(angle)
    rows = [[c * (i == j) + (1 - c) * a[i] * a[j] for j in range(3)] + [0.0] for i in range(3)] + [[0.0, 0.0, 0.0, 1.0]]
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        rows[i][j] -= s * a[k]
        rows[j][i] += s * a[k]
    return rows


def translation(offset):
    rows = [row[:] for row in IDENTITY]
    for i in range(3):
        rows[i][3] = offset[i]
    return rows


def scaling(factors):
    return [[IDENTITY[i][j] * [*factors, 1][i] for j in range(4)] for i in range(4)]


class Student:
    def __init__(self, scene, mistake=""):
        self.mistake = mistake
        words = [word for line in scene.split("\n") for word in line.split("#")[0].split()]
        self.is_ratio = words[13] == "ratio"
        words = iter(words[:13] + words[14:] if self.is_ratio else words)
        self.next = lambda count: [float(next(words)) for _ in range(count)]
        self.eye, self.look, self.up = self.next(3), self.next(3), self.next(3)
        self.fov_y, self.aspect, self.near, self.far = self.next(4)
        self.commands = words

    def made(self, *mistakes):
        return self.mistake in mistakes

    def stage1(self):
        m, stack, points = IDENTITY, [], []
        for word in self.commands:
            if word == "push":
                stack.append(m)
            elif word == "pop":
                m = stack.pop()
            elif word == "translate":
                m = product(m, translation(self.next(3)))
            elif word == "scale":
                m = product(m, scaling(self.next(3)))
            elif word == "rotate":
                angle, *axis = self.next(4)
                turn = rotation(angle if self.made("radians 1") else math.radians(angle), axis)
                m = product(m, transposed(turn) if self.made("swapped 1") else turn)
            elif word == "triangle":
                points += [image(m, self.next(3))[:3] for _ in range(3)]
        return points

    def stage2(self, points):
        l = unit([b - a for a, b in zip(self.eye, self.look)])
        r = unit(cross(l, self.up))
        u = unit(self.up) if self.made("up") else cross(r, l)
        back = l if self.made("handedness") else [-x for x in l]
        turn = [[*r, 0.0], [*u, 0.0], [*back, 0.0], [0.0, 0.0, 0.0, 1.0]]
        m = product(transposed(turn) if self.made("swapped 2") else turn, translation([-x for x in self.eye]))
        return [image(m, p)[:3] for p in points]

    def stage3(self, points):
        def window(fov):
            return self.near * math.tan((fov if self.made("radians 3") else math.radians(fov)) / 2)

        n, f = self.near, self.far
        right = self.aspect * window(self.fov_y) if self.is_ratio else window(self.fov_y * self.aspect)
        m = [[n / right, 0, 0, 0], [0, n / window(self.fov_y), 0, 0],
             [0, 0, -(f + n) / (f - n), -2 * f * n / (f - n)], [0, 0, -1, 0]]
        return [(x, y, z) if self.made("divide") else (x / w, y / w, z / w) for x, y, z, w in (image(m, p) for p in points)]

    def text(self, points):
        """Stage text; the student who does not round correctly truncates the decimals."""
        lines = []
        for i, p in enumerate(points):
            cut = [math.trunc(x * 1e7) / 1e7 for x in p] if self.made("rounding") else p
            lines.append(" ".join(f"{x:.7f}" for x in cut) + "\n" * (1 + (i % 3 == 2)))
        return "".join(lines)

    def texts(self, in_memory=True):
        """The three stage texts; each stage continues with the numbers of the previous one, or reads its text."""
        def handed_on(points):
            return points if in_memory else [tuple(map(float, line.split())) for line in self.text(points).split("\n") if line]

        first = self.stage1()
        second = self.stage2(handed_on(first))
        third = self.stage3(handed_on(second))
        return [self.text(points) for points in (first, second, third)]
