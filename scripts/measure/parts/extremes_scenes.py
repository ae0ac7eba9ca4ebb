"""The scenes of scripts/measure/extremes: one object, and a camera that goes to the extreme along one axis.

The object is a bumpy patch of two layers that fills the picture. The hidden layer comes first, so that equal
depths show it, which is wrong. A command turns the patch, and the camera faces it."""
import dataclasses
import math

CELLS = 8
SIZE = 96  # columns and rows of the picture
GAP = 0.02  # between the layers
FACING = (2 / 7, 3 / 7, 6 / 7)
TURN = ("rotate", "31.002719133874 -3 2 0")  # from the z axis to the patch's normal: by acos(6/7)
MARGIN = 1.15  # of the picture around the patch

AXES = {  # title, unit, values
    "distance": ("the eye and the object, of size 1, far from the origin", "distance from the origin",
                 [10.0**n for n in range(16)]),
    "depth": ("far / near, with the object at a third of far", "far / near", [10.0**n for n in range(1, 13)]),
    "size": ("the size of object and camera", "size", [10.0**-n for n in range(13)]),
    "angle": ("the angle of view, with an object that fills it", "fovY in degrees",
              [179.999, 179.99, 179.9, 179.0, 170.0, 120.0, 45.0, 10.0, *(10.0**-n for n in range(10))]),
}
QUICK = {
    "distance": (1.0, 1e8, 1e15), "depth": (10.0, 1e6, 1e12), "size": (1.0, 1e-4, 1e-12),
    "angle": (179.999, 45.0, 1e-9)}


@dataclasses.dataclass(frozen=True)
class Case:
    axis: str
    value: float


def cases(is_quick):
    return [
        Case(axis, value) for axis, (_, _, values) in AXES.items()
        for value in (QUICK[axis] if is_quick else values)]


def noise():
    """Numbers from 0 to 1, the same ones each time."""
    state = 1
    while True:
        state = (214013 * state + 2531011) % 2**32
        yield (state >> 8) % 2**16 / 2**16


def patch(width, height):
    """Triangles of three points: the hidden layer, then the layer above it; `width` is half the patch's,
    `height` the bumps'."""
    dice = noise()
    corners = [[((2 * (k + 0.4 * next(dice)) / CELLS - 1) * width,
                 (2 * (i + 0.4 * next(dice)) / CELLS - 1) * width, next(dice) * height)
                for k in range(CELLS + 1)] for i in range(CELLS + 1)]
    for lift in (-GAP * height, 0):
        for i in range(CELLS):
            for k in range(CELLS):
                a, b, c, d = ((x, y, z + lift) for x, y, z in (corners[i][k], corners[i][k + 1],
                                                               corners[i + 1][k + 1], corners[i + 1][k]))
                yield a, b, c
                yield a, c, d


def words(numbers):
    return " ".join("%.17g" % x for x in numbers)


def scene_text(case):
    center, distance, width, height, fov_y, near, far = (0, 0, 0), 3.0, 1.0, 0.2, 45.0, 1.0, 10.0
    value = case.value
    if case.axis == "distance":
        center = [round(value * part) for part in (0.6, 0.48, 0.64)]
    elif case.axis == "depth":
        near = far / value
    elif case.axis == "size":
        distance, width, height, near, far = (value * x for x in (distance, width, height, near, far))
    else:
        fov_y = value
        tangent = float("%.6g" % math.tan(math.radians(fov_y) / 2))
        distance = max(1.0, float("%.6g" % (MARGIN / tangent)))
        width = float("%.6g" % (distance * tangent / MARGIN))
        near, far = (0.5, 2.0) if distance == 1 else (max(distance / 2, distance - 1), distance + 1)
    eye = [c + distance * part for c, part in zip(center, FACING)]
    lines = [
        words(eye),
        words(center), "0 1 0",
        words((fov_y, 1, near, far)), "translate",
        words(center), *TURN]
    for triangle in patch(width, height):
        lines += ["triangle", *(" ".join("%.9g" % x for x in point) for point in triangle)]
    return "\n".join([*lines, "end"]) + "\n"
