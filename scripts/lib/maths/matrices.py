"""The matrices of the pipeline, as rows of exact numbers. Points are columns (x y z 1)."""
from fractions import Fraction

from lib.maths.exact import cotangent, double, root, sine_cosine, trimmed
from lib.maths.vectors import cross, dot

ZERO, ONE = Fraction(0), Fraction(1)
IDENTITY = tuple(tuple(ONE if i == j else ZERO for j in range(4)) for i in range(4))


def product(a, b):
    """The matrix that applies `b` first."""
    columns = tuple(zip(*b))
    return tuple(tuple(trimmed(dot(row, column)) for column in columns) for row in a)


def applied(matrix, p):
    """The image of a point (x y z) as (x y z w)."""
    return tuple(dot(row, (*p, ONE)) for row in matrix)


def affine(rows, offset=(ZERO, ZERO, ZERO)):
    """The matrix of three rows, with a fourth column."""
    return (*((*row, last) for row, last in zip(rows, offset)), (ZERO, ZERO, ZERO, ONE))


def translation(numbers):
    return affine([row[:3] for row in IDENTITY[:3]], numbers)


def scaling(numbers):
    return affine([tuple(numbers[i] if i == j else ZERO for j in range(3)) for i in range(3)])


def rotation(numbers):
    """Rodrigues: x turns into cos t x + (1 - cos t)(a.x) a + sin t (a x x), for the unit vector a of the
    axis."""
    degrees, *axis = numbers
    sine, cosine = sine_cosine(degrees)
    square = dot(axis, axis)
    along, turned = (1 - cosine) / square, sine / root(square)
    images = []
    for unit in (row[:3] for row in IDENTITY[:3]):
        images.append([
            cosine * x + along * dot(axis, unit) * a + turned * c
            for x, a, c in zip(unit, axis, cross(axis, unit))])
    return affine(list(zip(*images)))


TRANSFORMS = {"translate": translation, "scale": scaling, "rotate": rotation}


def view_matrix(eye, look, up):
    """From world space to view space: first the eye moves to the origin, then the camera's axes become x, y
    and -z."""
    forward = tuple(b - a for a, b in zip(eye, look))
    right = cross(forward, up)
    camera_up = cross(right, forward)
    axes = [
        tuple(x / root(dot(axis, axis)) for x in axis)
        for axis in (right, camera_up, tuple(-x for x in forward))]
    return affine(axes, [-dot(axis, eye) for axis in axes])


class Projection:
    """A line `perspective`, `frustum` or `ortho` of the header, which may end in the aspect rule `angle` or
    `ratio`."""
    def __init__(self, kind, words, aspect_rule=None, number=double):
        """`number` makes numbers of words."""
        count = 4 if kind == "perspective" else 6
        self.kind, self.words = kind, words[:count]
        self.numbers = [number(word) for word in self.words]
        self.near, self.far = self.numbers[-2:]
        self.aspect_rule = aspect_rule or (words[count] if len(words) > count else "angle")
        self.is_parallel = kind == "ortho"

    def matrix(self):
        """From view space to clip space."""
        near, far = self.near, self.far
        x_scale, x_offset, y_scale, y_offset = self.window()
        if self.is_parallel:
            return ((x_scale, ZERO, ZERO, -x_offset), (ZERO, y_scale, ZERO, -y_offset),
                    (ZERO, ZERO, -2 / (far - near), -(far + near) / (far - near)), IDENTITY[3])
        return ((x_scale, ZERO, x_offset, ZERO), (ZERO, y_scale, y_offset, ZERO),
                (ZERO, ZERO, -(far + near) / (far - near), -2 * far * near / (far - near)), (ZERO, ZERO, -ONE,
                                                                                             ZERO))

    def window(self):
        """The scales and offsets of x and y that map the window to [-1, 1]."""
        if self.kind == "perspective":
            fov_y, aspect = self.numbers[:2]
            y_scale = cotangent(fov_y / 2)
            return (y_scale / aspect if self.aspect_rule == "ratio" else cotangent(fov_y * aspect /
                                                                                   2)), ZERO, y_scale, ZERO
        left, right, bottom, top = self.numbers[:4]
        size = 2 if self.is_parallel else 2 * self.near
        return size / (right - left), (right + left) / (right - left), size / (top - bottom), (
            top + bottom) / (top - bottom)
