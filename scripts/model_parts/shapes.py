"""Shapes with smooth normals, made by formulas. Coordinates have six decimals, so that the last bits of sin
and cos do not show."""
import math
from dataclasses import dataclass, field

from lib.maths.profiles import BISHOP, curve, joined
from lib.maths.vectors import cross, normalized


@dataclass
class Mesh:
    """Vertices with a unit normal each, perhaps a color (0 to 255), and triangles of three indices,
    counter-clockwise seen from outside."""
    vertices: list
    normals: list
    triangles: list
    colors: list = field(default_factory=list)


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
    """A trefoil knot: a tube around the curve that winds three times one way and twice the other way about a
    torus."""
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
    waves = [(0.5, 0.9, 0.6, 0.3), (0.28, -1.3, 1.5, 1.1), (0.12, 2.7, 2.2, 2.0), (0.05, -5.1, 4.3, 0.5),
             (0.012, 8.3, -6.1, 4.0), (0.006, 5.3, 14.1, 1.0)]
    cells, size = 7 * detail, 8.0

    def vertex(i, k):
        x, z = size * k / cells - size / 2, size / 2 - size * i / cells
        y = sum(a * math.sin(u * x + v * z + phase) for a, u, v, phase in waves)
        dx = sum(a * u * math.cos(u * x + v * z + phase) for a, u, v, phase in waves)
        dz = sum(a * v * math.cos(u * x + v * z + phase) for a, u, v, phase in waves)
        return (x, y, z), (-dx, 1, -dz)

    return grid(cells, cells, False, False, vertex)


def bishop(detail):
    """A chess piece: curves with creases between them, turned about the y axis."""
    around = 6 * detail
    mesh = Mesh([], [], [])
    for points in joined([[(0, 0), BISHOP[0][0]], *BISHOP]):
        line = list(curve(points, max(1, detail // 3)))

        def vertex(i, k):
            turn = math.tau * k / around
            radius, height, outward, up = line[i]
            return (radius * math.cos(turn), height, radius * math.sin(turn)), (outward * math.cos(turn), up,
                                                                                outward * math.sin(turn))

        part = grid(len(line) - 1, around, False, True, vertex)
        # Counter-clockwise from outside: z is to the left of x here.
        add(mesh, Mesh(part.vertices, part.normals, [(a, c, b) for a, b, c in part.triangles]))
    return mesh


def add(mesh, part, color=None, size=1, place=(0, 0, 0)):
    """Adds a part, scaled and then moved. Triangles with two corners at one point, as at a pole, are left
    out."""
    first = len(mesh.vertices)
    mesh.vertices += [rounded(tuple(size * x + move for x, move in zip(p, place))) for p in part.vertices]
    mesh.normals += part.normals
    mesh.triangles += [
        tuple(first + i for i in triangle) for triangle in part.triangles
        if len({part.vertices[i]
                for i in triangle}) == 3]
    if color:
        mesh.colors += [color] * len(part.vertices)


def box(low, high):
    """A box with its sides along the axes."""
    mesh = Mesh([], [], [])
    for axis in range(3):
        for end in (0, 1):

            def corner(s, t):
                ends = [0, 0, 0]
                ends[axis], ends[axis - 2], ends[axis - 1] = end, s, t
                return tuple((low, high)[one][i] for i, one in enumerate(ends))

            first = len(mesh.vertices)
            corners = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
            mesh.vertices += corners if end else corners[::-1]
            mesh.normals += [tuple((2 * end - 1) * float(i == axis) + 0.0 for i in range(3))] * 4
            mesh.triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]
    return mesh


def ball(detail):
    """A ball of radius 1 about the origin."""
    rows, columns = 3 * detail, 6 * detail

    def vertex(i, k):
        up, turn = math.pi * i / rows - math.pi / 2, -math.tau * k / columns
        p = (math.cos(up) * math.cos(turn), math.sin(up), math.cos(up) * math.sin(turn))
        return p, p

    return grid(rows, columns, False, True, vertex)


LIGHT_TILE, DARK_TILE, WALL, SIDE_WALL, WOOD, STONE = (214, 200, 176), (120, 96,
                                                                        84), (214, 222,
                                                                              222), (226, 204,
                                                                                     176), (134, 88,
                                                                                            52), (180, 178,
                                                                                                  172)
CLAY, BRASS, IVORY, RED = (62, 112, 140), (214, 164, 62), (236, 222, 190), (176, 44, 40)


def room(detail):
    """A corner of a room, with a vase on a table, a chess piece, a knot on a pedestal and a ball, in
    colors."""
    mesh = Mesh([], [], [])
    for i in range(6):
        for k in range(6):
            add(mesh, box((i - 3, -0.1, k - 3), (i - 2, 0, k - 2)), LIGHT_TILE if (i + k) % 2 else DARK_TILE)
    add(mesh, box((-3.1, -0.1, -3.1), (3, 3.4, -3)), WALL)
    add(mesh, box((-3.1, -0.1, -3), (-3, 3.4, 3)), SIDE_WALL)
    for low, high in (((-2.3, 1.05, -2.3), (0.5, 1.15, -0.7)), ((-2.2, 0, -2.2), (-2.08, 1.05, -2.08)),
                      ((0.28, 0, -2.2), (0.4, 1.05, -2.08)), ((-2.2, 0, -0.92), (-2.08, 1.05, -0.8)),
                      ((0.28, 0, -0.92), (0.4, 1.05, -0.8))):
        add(mesh, box(low, high), WOOD)
    add(mesh, vase(detail), CLAY, 0.5, (-1.5, 1.15, -1.6))
    add(mesh, bishop(detail), IVORY, 0.7, (-0.2, 1.15, -1.3))
    add(mesh, box((1.2, 0, -2.4), (2.4, 0.6, -1.2)), STONE)
    add(mesh, knot(detail), BRASS, 0.24, (1.8, 1.4, -1.8))
    add(mesh, ball(detail), RED, 0.45, (1.4, 0.45, 0.9))
    return mesh


SHAPES = {"bishop": bishop, "knot": knot, "room": room, "terrain": terrain, "vase": vase}
