"""Profiles of chess pieces, which a lathe turns about the y axis; the side of a square of the board is 1."""
import math

# Profiles: curves through points (radius, height), bottom to top, with creases between the curves.
FOOT = [[(0.33, 0), (0.33, 0.07)], [(0.33, 0.07), (0.31, 0.12), (0.25, 0.155)], [(0.25, 0.155), (0.25, 0.19)]]


def ball(radius, middle, from_angle):
    """The profile of a ball from an angle above the horizon, in degrees, to its top."""
    angles = [math.radians(from_angle + (90 - from_angle) * i / 8) for i in range(9)]
    return [(radius * math.cos(angle) if angle < math.pi / 2 else 0, middle + radius * math.sin(angle))
            for angle in angles]


def stem(top_radius, height):
    """From the foot to a collar at this height."""
    return [[(0.25, 0.19), (0.16, 0.28), (0.85 * top_radius, 0.55 * height + 0.05), (top_radius, height)],
            [(top_radius, height), (top_radius + 0.09, height + 0.015), (top_radius + 0.1, height + 0.04),
             (top_radius + 0.05, height + 0.06)]]


PAWN = [*FOOT, *stem(0.1, 0.48), ball(0.155, 0.67, -55)]
ROOK = [
    *FOOT, *stem(0.16, 0.6), [(0.2, 0.66), (0.22, 0.68), (0.24, 0.72)], [(0.24, 0.72), (0.24, 0.8)],
    [(0.24, 0.8), (0.16, 0.8)], [(0.16, 0.8), (0.16, 0.77)], [(0.16, 0.77), (0, 0.77)]]
BISHOP = [
    *FOOT, *stem(0.11, 0.68), [(0.14, 0.74), (0.185, 0.85), (0.15, 0.98), (0.06, 1.07), (0.045, 1.08)],
    ball(0.055, 1.12, -40)]
QUEEN = [
    *FOOT, *stem(0.12, 0.85), [(0.15, 0.91), (0.16, 1.0), (0.2, 1.1), (0.24, 1.16)],
    [(0.24, 1.16), (0.19, 1.16)], [(0.19, 1.16), (0.12, 1.2), (0.07, 1.21)],
    ball(0.065, 1.26, -40)]
KING = [
    *FOOT, *stem(0.13, 0.92), [(0.16, 0.98), (0.17, 1.08), (0.22, 1.22)], [(0.22, 1.22), (0.19, 1.25)],
    [(0.19, 1.25), (0.1, 1.29), (0, 1.3)]]


def curve(points, steps):
    """(radius, height, outward normal in their plane) along a Catmull-Rom spline through the points; two
    points make a line."""
    padded = [
        tuple(2 * p - q for p, q in zip(points[0], points[1])), *points,
        tuple(2 * p - q for p, q in zip(points[-1], points[-2]))]
    count = steps if len(points) > 2 else 1
    for i in range(len(points) - 1):
        for step in range(count + (i == len(points) - 2)):
            t = step / count
            place, slope = [], []
            for a, b, c, d in zip(*padded[i:i + 4]):
                place.append(b + t * ((c - a) / 2 + t * (a - 2.5 * b + 2 * c - d / 2 + t * (1.5 * (b - c) +
                                                                                            (d - a) / 2))))
                slope.append((c - a) / 2 + t * (2 * a - 5 * b + 4 * c - d + t * (4.5 * (b - c) + 1.5 *
                                                                                 (d - a))))
            size = math.hypot(*slope)
            yield (*place, slope[1] / size, -slope[0] / size)


def joined(profile):
    """The curves of a profile, with a straight line from the end of each to the next one's beginning."""
    for before, points in zip([None, *profile], profile):
        if before and before[-1] != points[0]:
            yield [before[-1], points[0]]
        yield points
