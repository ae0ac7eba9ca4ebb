"""Vectors of three numbers, and the camera's axes."""
import math


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def turned_about(a, axis, angle):
    """The vector a, turned about a unit vector by an angle in radians (Rodrigues, 1840)."""
    c, s, along = math.cos(angle), math.sin(angle), dot(a, axis)
    return tuple(c * x + s * y + (1 - c) * along * z for x, y, z in zip(a, cross(axis, a), axis))


def normalized(a):
    size = math.hypot(*a)
    return tuple(x / size for x in a)


def moved(p, *steps):
    """p plus the steps, each a distance and a direction."""
    return tuple(x + sum(distance * way[i] for distance, way in steps) for i, x in enumerate(p))


def axes(eye, look, up):
    """Right, up and forward of a camera: orthogonal unit vectors."""
    forward = normalized(tuple(b - a for a, b in zip(eye, look)))
    right = normalized(cross(forward, up))
    return right, cross(right, forward), forward
