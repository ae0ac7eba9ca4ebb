"""What is true of the pixels of a case, in exact fractions. Points are (x, y, z), with x and y in pixels from
the top left corner."""
import math
from fractions import Fraction

OUTSIDE, EDGE, INSIDE = range(3)


def side(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def as_whole_numbers(triangle):
    """The corners' x and y times a scale, and the scale, an even number: with whole numbers, exact arithmetic
    is fast."""
    scale = 2 * math.lcm(*(x.denominator for corner in triangle for x in corner[:2]))
    return [tuple(int(x * scale) for x in corner[:2]) for corner in triangle], scale


def edges(triangle):
    """The edges in the direction that has the inside on the positive side; none if there is no inside."""
    a, b, c = triangle
    area = side(a, b, c)
    if area == 0:
        return []
    return [(a, b), (b, c), (c, a)] if area > 0 else [(a, c), (c, b), (b, a)]


def position(triangle, p):
    """Where a point lies: OUTSIDE, INSIDE, or on the EDGE."""
    signs = [side(a, b, p) for a, b in edges(triangle)]
    if not signs or min(signs) < 0:
        return OUTSIDE
    return INSIDE if min(signs) > 0 else EDGE


def angle_at(triangle, p):
    """The part of a full turn around a point on the edge that the triangle takes."""
    for a, b, c in (triangle, triangle[1:] + triangle[:1], triangle[2:] + triangle[:2]):
        if a[:2] == p:
            u, v = ((float(q[0] - a[0]), float(q[1] - a[1])) for q in (b, c))
            return abs(math.atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])) / (2 * math.pi)
    return 0.5


def is_inside_all(triangles, p):
    """Whether a point lies inside the union of triangles that do not overlap: not on its border."""
    turn = 0
    for triangle in triangles:
        where = position(triangle, p)
        turn += {OUTSIDE: 0, INSIDE: 1}.get(where) if where != EDGE else angle_at(triangle, p)
    return turn > 1 - 1e-9


def are_apart(first, second):
    """Whether the boxes around two triangles have no inner points in common."""
    return any(
        max(p[axis]
            for p in a) <= min(p[axis]
                               for p in b)
        for axis in (0, 1)
        for a, b in ((first, second), (second, first)))


def overlap(first, second):
    """Whether two triangles have inner points in common: no edge of either has the other on its far side."""
    if are_apart(first, second):
        return False
    sides = edges(first), edges(second)
    if not all(sides):
        return False
    return not any(
        all(side(a, b, p) <= 0 for p in other) for own, other in zip(sides, (second, first)) for a, b in own)


def distance_to_edge(edge, p):
    """How far a point is from an edge."""
    a, b = edge
    u, v = (float(b[0] - a[0]), float(b[1] - a[1])), (float(p[0] - a[0]), float(p[1] - a[1]))
    length = u[0] ** 2 + u[1] ** 2
    t = min(1.0, max(0.0, (u[0] * v[0] + u[1] * v[1]) / length)) if length else 0.0
    return math.hypot(v[0] - t * u[0], v[1] - t * u[1])


def distance(triangle, p):
    """How far a point is from the border of a triangle."""
    a, b, c = triangle
    return min(distance_to_edge(edge, p) for edge in ((a, b), (b, c), (c, a)))


def depth(triangle, p):
    """z of the triangle's plane."""
    a, b, c = triangle
    area = side(a, b, c)
    return (side(b, c, p) * a[2] + side(c, a, p) * b[2] + side(a, b, p) * c[2]) / area


def area_in_pixel(triangle, column, row):
    """The area of the part of a triangle that lies in a pixel."""
    if are_apart(triangle, ((column, row), (column + 1, row + 1))):
        return 0
    polygon = [a[:2] for a, _ in edges(triangle)]
    for axis, limit, sign in ((0, column, 1), (0, column + 1, -1), (1, row, 1), (1, row + 1, -1)):
        clipped = []
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            s, t = sign * (p[axis] - limit), sign * (q[axis] - limit)
            if s >= 0:
                clipped.append(p)
            if s * t < 0:
                clipped.append(tuple(u + (v - u) * s / (s - t) for u, v in zip(p, q)))
        polygon = clipped
    return sum(
        (p[0] * q[1] - p[1] * q[0] for p, q in zip(polygon, polygon[1:] + polygon[:1])), Fraction(0)) / 2
