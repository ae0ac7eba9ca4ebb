"""Shapes with smooth normals, made by formulas. Coordinates have six decimals, so that the last bits of sin and cos do not show."""
import math
from dataclasses import dataclass

from lib.vectors import cross, normalized


@dataclass
class Mesh:
    """Vertices with a unit normal each, and triangles of three indices, counter-clockwise seen from outside."""
    vertices: list
    normals: list
    triangles: list


def rounded(vector):
    return tuple(round(x, 6) + 0.0 for x in vector)


def grid(rows, columns, wraps_rows, wraps_columns, vertex):
    """The mesh of a grid of quadrangles; `vertex(i, k)` gives a point and its normal."""
    height, width = rows + (not wraps_rows), columns + (not wraps_columns)
    pairs = [vertex(i, k) for i in range(height) for k in range(width)]
    triangles = []
    for i in range(rows):
        for k in range(columns):
            a, b = i * width + k, i * width + (k + 1) % width
            d, c = (i + 1) % height * width + k, (i + 1) % height * width + (k + 1) % width
            triangles += [(a, b, c), (a, c, d)]
    return Mesh([rounded(p) for p, _ in pairs], [rounded(normalized(n)) for _, n in pairs], triangles)


def knot(detail):
    """A trefoil knot: a tube around the curve that winds three times one way and twice the other way about a torus."""
    around, tube, radius = 16 * detail, 3 * detail, 0.45

    def curve(t):
        distance = 2 + math.cos(3 * t)
        return (distance * math.cos(2 * t), distance * math.sin(2 * t), math.sin(3 * t))

    def tangent(t):
        """The derivative of the curve."""
        distance, change = 2 + math.cos(3 * t), -3 * math.sin(3 * t)
        return normalized((change * math.cos(2 * t) - 2 * distance * math.sin(2 * t),
                     change * math.sin(2 * t) + 2 * distance * math.cos(2 * t), 3 * math.cos(3 * t)))

    def vertex(i, k):
        t, turn = math.tau * i / around, math.tau * k / tube
        forward = tangent(t)
        side = normalized(cross(forward, (0, 0, 1)))  # the curve never runs along z
        up = cross(side, forward)
        normal = tuple(math.cos(turn) * s - math.sin(turn) * u for s, u in zip(side, up))
        return tuple(p + radius * n for p, n in zip(curve(t), normal)), normal

    return grid(around, tube, True, True, vertex)


def vase(detail):
    """A vase: an outline of distance over height, turned about the y axis, open at the top."""
    rows, columns = 4 * detail, 6 * detail

    def outline(h):
        return 0.55 + 0.4 * math.sin(1.2 + 4.2 * h) * (1 - 0.35 * h)

    def vertex(i, k):
        h, turn = i / rows, -math.tau * k / columns
        step = 1e-5
        slope = (outline(h + step) - outline(h - step)) / (2 * step) / 2  # the vase is 2 high
        x, z = math.cos(turn), math.sin(turn)
        return (outline(h) * x, 2 * h, outline(h) * z), (x, -slope, z)

    return grid(rows, columns, False, True, vertex)


def terrain(detail):
    """Hills: a sum of waves over a square, y up."""
    waves = [(0.5, 0.9, 0.6, 0.3), (0.28, -1.3, 1.5, 1.1), (0.12, 2.7, 2.2, 2.0), (0.05, -5.1, 4.3, 0.5), (0.02, 9.1, -8.3, 4.0), (0.01, 15.3, 17.1, 1.0)]
    cells, size = 7 * detail, 8.0

    def vertex(i, k):
        x, z = size * k / cells - size / 2, size / 2 - size * i / cells
        y = sum(a * math.sin(u * x + v * z + phase) for a, u, v, phase in waves)
        dx = sum(a * u * math.cos(u * x + v * z + phase) for a, u, v, phase in waves)
        dz = sum(a * v * math.cos(u * x + v * z + phase) for a, u, v, phase in waves)
        return (x, y, z), (-dx, 1, -dz)

    return grid(cells, cells, False, False, vertex)


SHAPES = {"knot": knot, "vase": vase, "terrain": terrain}
