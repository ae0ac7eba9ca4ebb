"""The triangle that a pixel's center shows if no stage rounds, straight from the scene."""
import bisect
import collections
import functools
import math

from lib.maths.balls import Ball, Undecided, ball, exactly
from lib.maths.matrices import IDENTITY, Projection, applied, product, view_matrix
from lib.maths.vectors import cross, dot
from lib.text.scene import camera, find_triangles

ROUNDED = 1e-14  # a bound of the relative rounding error of sums of four products in doubles
SMALLEST = 1e-300
NEAR = 0.001  # a bound of the rounding error of a pixel's place in doubles, in pixels
CUT_WITHIN = 1024  # triangles nearer to the eye plane than near / 1024 are cut at the near plane (P7)

FEW_BITS, MOST_BITS = 256, 4096  # the latter are slow, and decide only near ties
MOST_STEPS = 5_000_000  # of some microseconds
STEPS_OF_A_MATRIX, STEPS_OF_A_CANDIDATE, STEPS_OF_A_TRIANGLE = 300, 100, 10


class TooMuch(Exception):
    """More than MOST_STEPS."""


def owners(scene, window, pixels):
    """{(column, row): the (number, SceneTriangle) seen there, or None} for the pixels that MOST_BITS decide;
    `scene` is the text of a scene that `model` has accepted."""
    found, left = {}, None
    for bits in (FEW_BITS, MOST_BITS):
        Ball.bits = bits
        exact = ExactPixels(scene, window)
        left = exact.candidates(pixels) if left is None else left
        for pixel, triangles in list(left.items()):
            left[pixel], is_decided = exact.seen(pixel, triangles)
            if is_decided:
                found[pixel] = next(iter(left.pop(pixel)), None)
    return found


class Fragment:
    """A triangle at a pixel's center: its corners in clip space, its depth, and whether it certainly covers
    the center."""
    def __init__(self, number, triangle, clip, depth, is_sure):
        self.number, self.triangle, self.clip = number, triangle, clip
        self.depth, self.is_sure = depth, is_sure

    def hides(self, other):
        """True if this fragment certainly hides the other."""
        try:
            if self.clip is other.clip or self.depth == other.depth:  # equal triangles need no digits
                return self.is_sure and self.number < other.number
        except Undecided:
            return False
        return self.is_sure and self.depth < other.depth


class ExactPixels:
    """A scene on a window, to the precision of Ball.bits."""
    def __init__(self, scene, window):
        self.scene, self.window = scene, window
        *_, (kind, *words) = camera(scene)
        self.projection = Projection(kind, words, number=exactly)
        matrix, self.scales, self.x_per_y = unscaled(self.projection)
        self.edges = {}  # by a triangle's matrix and points
        # By the line of the last transform: to clip space, unscaled, and in doubles.
        self.matrices = {None: self.with_doubles(product(matrix, to_view_space(scene)))}
        self.steps = 0

    def candidates(self, pixels):
        """{pixel: [(number, SceneTriangle), ...]}: the triangles that may be there, by bounds in doubles."""
        columns_of, found = collections.defaultdict(list), {pixel: [] for pixel in pixels}
        for column, row in sorted(pixels):
            columns_of[row].append(column)
        rows, grid = sorted(columns_of), self.window.grid
        xs = {column: float(grid.x_of(column)) for column, _ in pixels}
        ys = {row: float(grid.y_of(row)) for row in rows}
        for number, triangle in enumerate(find_triangles(self.scene)):
            self.count(STEPS_OF_A_TRIANGLE)
            outline = Outline(self.matrices_of(triangle)[1], triangle.points, self.window.grid_in_doubles)
            for row in rows[slice(*outline.range_of(rows, 1))]:
                columns = columns_of[row]
                for column in columns[slice(*outline.range_of(columns, 0))]:
                    self.count(1)
                    if outline.may_cover(xs[column], ys[row]):
                        self.count(STEPS_OF_A_CANDIDATE)
                        found[column, row].append((number, triangle))
        return found

    def count(self, steps):
        self.steps += steps
        if self.steps > MOST_STEPS:
            raise TooMuch

    def matrices_of(self, triangle):
        """The matrix of the triangle's transforms, exact and in doubles; earlier triangles' are reused."""
        missing, in_force = [], triangle.in_force
        while line_of(in_force) not in self.matrices:
            missing.append(in_force)
            in_force = in_force[1]
        for transform in reversed(missing):
            self.count(STEPS_OF_A_MATRIX)
            matrix = product(self.matrices[line_of(transform[1])][0], transform[0].matrix(exactly))
            self.matrices[line_of(transform)] = self.with_doubles(matrix)
        return self.matrices[line_of(triangle.in_force)]

    def with_doubles(self, matrix):
        return matrix, [
            [in_doubles(x * scale) for x in matrix[i]] for i, scale in zip((0, 1, 3), (*self.scales, 1))]

    def seen(self, pixel, triangles):
        """The triangles that may be seen by Z5 to Z8, and True if that is decided: one or none."""
        try:
            fragments = [found for triangle in triangles if (found := self.fragment(pixel, *triangle))]
        except Undecided:
            return triangles, False
        if not fragments:
            return [], True
        first = functools.reduce(lambda best, other: other if other.hides(best) else best, fragments)
        left = [other for other in fragments if not first.hides(other)]
        return [(one.number, one.triangle) for one in left], first.is_sure and left == [first]

    def fragment(self, pixel, number, triangle):
        """The Fragment of the triangle, or None if it is not there."""
        clip, edges, area = self.edges_of(triangle)
        if area.sign == 0:
            return None
        center = self.window.grid.x_of(pixel[0]), self.window.grid.y_of(pixel[1]), 1
        sides = [dot(edge, center) for edge in edges]
        depth = dot(sides, [z for _, _, z, _ in clip]) / area
        tests = [functools.partial(is_owned, edge, side, area.sign) for edge, side in zip(edges, sides)]
        is_sure = True
        for test in (*tests, lambda: self.is_drawn(depth), lambda: self.is_left(clip, depth)):
            try:
                if not test():
                    return None
            except Undecided:
                is_sure = False
        return Fragment(number, triangle, clip, depth, is_sure)

    def edges_of(self, triangle):
        """The triangle's corners in clip space, unscaled; its edges as factors of x, y and 1, positive inside
        if the area is positive; and its area. Edges and area are multiplied by a factor that keeps an
        irrational scale of x and y in few of the numbers."""
        matrix, _ = self.matrices_of(triangle)
        key = line_of(triangle.in_force), *map(tuple, triangle.points)
        if key not in self.edges:
            clip = [applied(matrix, [exactly(word) for word in words]) for words in triangle.points]
            a, b, c = ((x, y, w) for x, y, _, w in clip)
            x_scale = self.scales[0]
            edges = [
                (x, y * self.x_per_y, z * x_scale) for x, y, z in (cross(b, c), cross(c, a), cross(a, b))]
            self.edges[key] = clip, edges, dot(a, cross(b, c)) * x_scale
        return self.edges[key]

    def is_drawn(self, depth):
        return not depth < self.window.front and depth < self.window.rear

    def is_left(self, clip, depth):
        """True if cutting the triangle by P7 leaves its point at this depth; Undecided on the cut."""
        if self.projection.is_parallel or (depth + 1).sign > 0:
            return True
        is_cut = any(w < self.projection.near / CUT_WITHIN for *_, w in clip)
        if is_cut and (depth + 1).sign == 0:
            raise Undecided
        return not is_cut


def to_view_space(scene):
    return view_matrix(*(tuple(map(exactly, words)) for words in camera(scene)[:3]))


def unscaled(projection):
    """The matrix to clip space, without the scales of x and y if these may be irrational; the two scales; and
    the first divided by the second."""
    matrix = projection.matrix()
    if projection.kind != "perspective":
        return matrix, (Ball(1), Ball(1)), Ball(1)
    x_scale, _, y_scale, _ = projection.window()
    aspect = projection.numbers[1]
    is_rational = projection.aspect_rule == "ratio" or aspect == 1
    return (*IDENTITY[:2], *matrix[2:]), (x_scale, y_scale), 1 / aspect if is_rational else x_scale / y_scale


def is_owned(edge, side, area_sign):
    """True if a center is on the inner side of the edge, or on a left or top edge (Z5)."""
    step_right, step_up = edge[:2]
    side = side.sign * area_sign
    return side > 0 or side == 0 and (step_right.sign * area_sign or -step_up.sign * area_sign) > 0


def line_of(in_force):
    return in_force and in_force[0].line


def in_doubles(x):
    """A double near x, and a bound of its error, with the rounding of a product with it."""
    x = ball(x)
    double = float(x)
    radius = float(Ball.around(x.radius, 0, x.exponent)) if x.exact is None else 0
    return double, ROUNDED * abs(double) + 2 * radius + math.ulp(0)


class Outline:
    """The part of the window where a triangle may be, in doubles with error bounds."""
    def __init__(self, matrix, points, grid):
        """`matrix` is the rows of x, y and w of the matrix to clip space, as in_doubles()."""
        self.grid = grid
        self.corners = []  # x, y and w, and their error bounds
        for words in points:
            p = [*map(float, words), 1.0]
            self.corners.append(([sum(a * b for (a, _), b in zip(row, p)) for row in matrix], [
                sum(e * abs(b) for (_, e), b in zip(row, p)) + SMALLEST for row in matrix]))
        self.has_numbers = all(math.isfinite(x) for corner in self.corners for part in corner for x in part)

    def range_of(self, pixels, axis):
        """The range of the sorted columns (axis 0) or rows (1) that the triangle may reach, as indices."""
        if self.has_numbers and all(p[2] + e[2] <= 0 for p, e in self.corners):
            return 0, 0
        if not self.has_numbers or any(p[2] - e[2] <= 0 for p, e in self.corners):
            return 0, len(pixels)
        at = (self.grid.column_at, self.grid.row_at)[axis]
        places = [
            at((p[axis] + i * e[axis]) / (p[2] + k * e[2])) for p, e in self.corners for i in (-1, 1)
            for k in (-1, 1)]
        return bisect.bisect_left(pixels, min(places) - NEAR), bisect.bisect_right(pixels, max(places) + NEAR)

    def may_cover(self, x, y):
        """True if the center may be on the same side of all edges."""
        if not self.has_numbers:
            return True
        turned = [(p[0] - x * p[2], p[1] - y * p[2], e[0] + abs(x) * e[2] + ROUNDED * abs(x * p[2]),
                   e[1] + abs(y) * e[2] + ROUNDED * abs(y * p[2])) for p, e in self.corners]
        signs = set()
        for (a, b, a_error, b_error), (c, d, c_error, d_error) in zip(turned, turned[1:] + turned[:1]):
            error = (abs(a) + a_error) * d_error + (abs(b) + b_error) * c_error + a_error * abs(d) + \
                b_error * abs(c) + ROUNDED * (abs(a * d) + abs(b * c)) + SMALLEST
            side = a * d - b * c
            signs.add((1 if side > 0 else -1) if abs(side) > error else 0)  # 0 for NaN, too
        return not signs >= {1, -1}
