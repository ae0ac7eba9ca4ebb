"""The matrices of the three stages, right or with mistakes, in doubles, as in a student's program."""
import math

from lib.maths.vectors import cross as right_cross
from lib.maths.vectors import dot, normalized

IDENTITY = tuple(tuple(float(i == j) for j in range(4)) for i in range(4))
UNDEFINED = (math.nan,) * 3
ONCE = (1, 1)  # by w: x and y, and z
ROUNDING = 1e-13  # of sums and products in doubles, with some to spare


def product(a, b):
    columns = tuple(zip(*b))
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def transposed(m):
    return tuple(zip(*m))


def affine(rows, offset=(0.0, 0.0, 0.0)):
    return (*((*row, last) for row, last in zip(rows, offset)), (0.0, 0.0, 0.0, 1.0))


def negative(v):
    return tuple(-x for x in v)


def image(m, p, divisions=ONCE):
    """The image of a point; UNDEFINED where it would be divided by 0. `divisions` is how often x and y are
    divided by w, and how often z; True for once, False for never."""
    x, y, z = p
    x, y, z, w = (row[0] * x + row[1] * y + row[2] * z + row[3] for row in m)
    if not divisions:
        return x, y, z
    of_x, of_z = ONCE if divisions is True else divisions
    return (x / w**of_x, y / w**of_x, z / w**of_z) if abs(w) > 1e-12 else UNDEFINED


def slack(m, p, units, divisions=ONCE):
    """How far the image of p moves if p moves by `units`, and by rounding on the way."""
    moves = (*(u + ROUNDING * abs(x) for u, x in zip(units, p)), ROUNDING)
    *slacks, of_w = (sum(abs(a) * move for a, move in zip(row, moves)) for row in m)
    if not divisions:
        return slacks
    *values, w = (abs(dot(row, (*p, 1.0))) for row in m)
    if w <= 2 * of_w or w <= 1e-12:
        return math.inf, math.inf, math.inf
    of_x, of_z = ONCE if divisions is True else divisions
    for axis, count in enumerate((of_x, of_x, of_z)):
        for _ in range(count):
            values[axis] /= w
            slacks[axis] = (slacks[axis] + values[axis] * of_w) / (w - of_w)
    return slacks


# model
def translation(offset):
    return affine([row[:3] for row in IDENTITY[:3]], offset)


def scaling(factors):
    return affine([[factors[i] if i == j else 0.0 for j in range(3)] for i in range(3)])


def rotation(radians, axis, factors=lambda c, s: (c, 1 - c, s)):
    """Rodrigues' formula for a unit vector; `factors` makes its terms' factors from cosine and sine."""
    of_x, of_axis, of_side = factors(math.cos(radians), math.sin(radians))
    images = ([
        of_x * e + of_axis * dot(axis, x) * a + of_side * t for e, a, t in zip(x, axis, right_cross(axis, x))]
              for x in (row[:3] for row in IDENTITY[:3]))
    return affine(list(zip(*images)))


# view
def view_matrix(eye, look, up, mistakes=(), spelling=0):
    """The matrix of view, right or with mistakes of these names, made in the way `spelling`, 0 or 1."""
    def cross(a, b):
        x, y, z = right_cross(a, b)
        return x, -y if "cross-product-sign" in mistakes else y, z

    if "eye-and-look-exchanged" in mistakes:
        eye, look = look, eye
    up = (0.0, 1.0, 0.0) if "up-is-0-1-0" in mistakes else up
    up = tuple(b - a for a, b in zip(eye, up)) if "up-is-a-point" in mistakes else up
    l = tuple(look) if "look-is-a-direction" in mistakes else tuple(b - a for a, b in zip(eye, look))
    l = negative(l) if {"l-is-eye-minus-look", "left-handed"} & {*mistakes} else l
    l = l if "l-not-unit" in mistakes else normalized(l)
    r = cross(up, l) if "r-is-up-cross-l" in mistakes else cross(l, up)
    r = r if "r-not-unit" in mistakes else normalized(r)
    u = cross(l, r) if "u-is-l-cross-r" in mistakes else cross(r, l)
    if "up-as-given" in mistakes:
        u = normalized(up) if spelling else tuple(up)
    elif spelling:
        u = normalized(u)
    back = l if "l-not-negated" in mistakes else negative(l)
    turn = IDENTITY if "no-rotation" in mistakes else affine([r, u, back])
    turn = transposed(turn) if "rotation-transposed" in mistakes else turn
    factor = 1.0 if "eye-added" in mistakes else 0.0 if "no-translation" in mistakes else -1.0
    move = translation([factor * x for x in eye])
    m = product(move, turn) if "translation-after-rotation" in mistakes else product(turn, move)
    return transposed(m) if "matrix-transposed" in mistakes else m


TWO_SPELLINGS = ("up-as-given", "l-not-unit", "r-not-unit", "near-left-out")  # others have one


# project
def perspective_matrix(fov_y, aspect, near, far, is_ratio=False, mistakes=(), pi=math.pi, spelling=0):
    """The matrix of project; `mistakes` and `spelling` as for view_matrix."""
    radian = 1.0 if "fov-in-radians" in mistakes else pi / 180
    of_tangent = 0.5 if "tangent-halved" in mistakes else 1.0
    part = 1 if {"fov-not-halved", "tangent-halved"} & {*mistakes} else 2
    fov_x = fov_y if "fovx-equals-fovy" in mistakes else (
        fov_y / aspect if "fovx-divided-by-aspect" in mistakes else fov_y * aspect)
    top, right = (of_tangent * math.tan(radian * fov / part) for fov in (fov_y, fov_x))
    right = top * aspect if is_ratio or "r-is-t-times-aspect" in mistakes else right
    if "r-and-t-swapped" in mistakes:
        right, top = top, right
    if "near-left-out" in mistakes:
        right, top = (x * near if spelling else x / near for x in (right, top))
    return projection_matrix((1 / right, 0.0, 1 / top, 0.0), near, far, mistakes)


def projection_matrix(window, near, far, mistakes=()):
    """The matrix of a perspective or a frustum. `window` has the scale and the shift of x, then of y."""
    if "near-and-far-swapped" in mistakes:
        near, far = far, near
    two = 1 if "missing-two" in mistakes else 2
    z_row = (0.0, 0.0, -(far + near) / (far - near), -two * far * near / (far - near))
    if "z-row-sign" in mistakes:
        z_row = negative(z_row)
    if "depth-is-linear" in mistakes:  # and z is not divided
        z_row = (0.0, 0.0, -2 / (far - near), -(far + near) / (far - near))
    if "depth-in-view-space" in mistakes:  # nor here
        z_row = (0.0, 0.0, 1.0, 0.0)
    w_row = (0.0, 0.0, 1.0 if "w-is-plus-z" in mistakes else -1.0, float("last-element-is-one" in mistakes))
    x_scale, x_shift, y_scale, y_shift = window
    return (x_scale, 0.0, x_shift, 0.0), (0.0, y_scale, y_shift, 0.0), z_row, w_row
