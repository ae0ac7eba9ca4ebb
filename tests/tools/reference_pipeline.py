#!/usr/bin/env python3
"""A second implementation of the unlit pipeline, as a reference for the tools.

usage: reference_pipeline.py SCENE CONFIG DIR

Writes stage1.txt, stage2.txt, stage3.txt, z_buffer.txt and out.bmp to DIR.

It shares no code with libpipeline and uses other methods. Stages 1 to 3 calculate with 700 decimal digits, which
hold the sum of any two doubles; each takes the unrounded numbers of the previous stage, and a number becomes
text by rounding once, to 7 decimals. Stage 4 reads the text of stage 3, as the course's does. In doubles it finds the
pixels that a triangle covers by the rule `nearest`, and with 100 digits the depth there.
It is meant to be read: it does one thing after another and checks almost nothing.
"""
import decimal
import math
import os
import struct
import sys
from decimal import Decimal

DIGITS = decimal.Context(prec=700, rounding=decimal.ROUND_HALF_EVEN)
DIGITS_OF_DEPTH = decimal.Context(prec=100, rounding=decimal.ROUND_HALF_EVEN)
decimal.setcontext(DIGITS)


# Numbers and text

def real(word):
    """The double nearest to a word, exactly."""
    return Decimal(float(word))


def fixed(x):
    """x with 7 decimals, ties to even, no sign on zero.

    After 700 digits a tie may read 0.00000004999...9: hence the first rounding.
    """
    rounded = x.quantize(Decimal("1e-60")).quantize(Decimal("1e-7"))
    return f"{abs(rounded) if rounded.is_zero() else rounded:f}"


def words_of(text):
    """All words of a text without its comments: the unlit formats can be read without regard to lines."""
    return [word for line in text.split("\n") for word in line.split("#")[0].split()]


# Trigonometry, by power series

NEGLIGIBLE = Decimal("1e-720")


def arctan_of_inverse(n):
    """arctan(1/n) = 1/n - 1/(3 n^3) + 1/(5 n^5) - ..."""
    total, power, k = Decimal(0), 1 / Decimal(n), 1
    while abs(power) > NEGLIGIBLE:
        total += power / k
        power, k = -power / (n * n), k + 2
    return total


PI = 16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)  # Machin, 1706


def sin_and_cos(degrees):
    """The real and the imaginary part of exp(i x) = 1 + i x + (i x)^2 / 2! + ..., x in radians."""
    x = degrees % 360 * PI / 180
    sums, term, k = [Decimal(0)] * 4, Decimal(1), 0  # sums of the terms in 1, i, -1, -i
    while abs(term) > NEGLIGIBLE:
        sums[k % 4] += term
        k += 1
        term *= x / k
    return sums[1] - sums[3], sums[0] - sums[2]


def tan(degrees):
    sine, cosine = sin_and_cos(degrees)
    return sine / cosine


# Vectors: tuples of three numbers

def add(a, b):
    return tuple(p + q for p, q in zip(a, b))


def subtract(a, b):
    return tuple(p - q for p, q in zip(a, b))


def times(factor, a):
    return tuple(factor * p for p in a)


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalized(a):
    return times(1 / dot(a, a).sqrt(), a)


# Stage 1, modeling: a transform is the images of the origin and of the three unit vectors

AXES = ((Decimal(1), Decimal(0), Decimal(0)), (Decimal(0), Decimal(1), Decimal(0)), (Decimal(0), Decimal(0), Decimal(1)))
IDENTITY = ((Decimal(0),) * 3,) + AXES


def applied(transform, p):
    """The image of the point p."""
    origin, x_axis, y_axis, z_axis = transform
    return add(add(origin, times(p[0], x_axis)), add(times(p[1], y_axis), times(p[2], z_axis)))


def composed(outer, inner):
    """The transform that applies `inner` first."""
    origin = applied(outer, inner[0])
    return (origin,) + tuple(subtract(applied(outer, add(inner[0], axis)), origin) for axis in inner[1:])


def translation(offset):
    return (offset,) + AXES


def scaling(factors):
    return (IDENTITY[0],) + tuple(times(factor, axis) for factor, axis in zip(factors, AXES))


def rotation(degrees, axis):
    """Rodrigues: x turns into cos t x + (1 - cos t)(a.x) a + sin t (a x x)."""
    a = normalized(axis)
    sine, cosine = sin_and_cos(degrees)
    return (IDENTITY[0],) + tuple(
        add(add(times(cosine, x), times((1 - cosine) * dot(a, x), a)), times(sine, cross(a, x))) for x in AXES)


class Scene:
    """The contents of a scene.txt: eye, look, up, projection (kind and numbers) and the triangles in world space."""

    def __init__(self, text):
        self.words = words_of(text)
        self.next = 0
        self.eye, self.look, self.up = self.point(), self.point(), self.point()
        kind = self.word() if self.words[self.next] in ("ortho", "frustum") else "perspective"
        numbers = self.numbers(4 if kind == "perspective" else 6)
        if self.words[self.next:self.next + 1] and self.words[self.next] in ("ratio", "angle"):
            kind = self.word()
        self.projection = (kind, numbers)
        self.triangles = list(self.run())

    def word(self):
        self.next += 1
        return self.words[self.next - 1]

    def numbers(self, count):
        return tuple(real(self.word()) for _ in range(count))

    def point(self):
        return self.numbers(3)

    def run(self):
        """Executes the commands; yields the triangles as they come."""
        transform, saved = IDENTITY, []
        while (command := self.word()) != "end":
            if command == "triangle":
                yield self.triangle(transform)
            elif command == "translate":
                transform = composed(transform, translation(self.point()))
            elif command == "scale":
                transform = composed(transform, scaling(self.point()))
            elif command == "rotate":
                degrees, = self.numbers(1)
                transform = composed(transform, rotation(degrees, self.point()))
            elif command == "push":
                saved.append(transform)
            elif command == "pop":
                transform = saved.pop()
            else:
                self.other_command(command, transform)

    def triangle(self, transform):
        return [applied(transform, self.point()) for _ in range(3)]

    def other_command(self, command, transform):
        raise ValueError("not a command: " + command)


# Stage 2, viewing

def view(scene):
    """From world space to view space: the eye at the origin, looking down -z, y up."""
    l = normalized(subtract(scene.look, scene.eye))
    r = normalized(cross(l, scene.up))
    u = cross(r, l)

    def seen(p):
        q = subtract(p, scene.eye)
        return (dot(r, q), dot(u, q), -dot(l, q))

    return [[seen(p) for p in triangle] for triangle in scene.triangles]


# Stage 3, projection; from here on each triangle carries its number

def window(projection):
    """left, right, bottom, top, near, far of a projection; for a perspective by the course's rule fovX = fovY * aspect, unless it is
    named `ratio`."""
    kind, numbers = projection
    if kind in ("ortho", "frustum"):
        return numbers
    fov_y, aspect, near, far = numbers
    top = near * tan(fov_y / 2)
    right = aspect * top if kind == "ratio" else near * tan(fov_y * aspect / 2)
    return (-right, right, -top, top, near, far)


def clipped_at_near(triangle, near):
    """The polygon beyond the near plane (z <= -near in view space), in the order of the triangle's outline."""
    polygon = []
    for p, q in zip(triangle, triangle[1:] + triangle[:1]):
        p_is_in, q_is_in = p[2] <= -near, q[2] <= -near
        if p_is_in:
            polygon.append(p)
        if p_is_in != q_is_in:
            polygon.append(add(p, times((-near - p[2]) / (q[2] - p[2]), subtract(q, p))))
    return polygon


def pieces(triangle, near):
    """The triangle itself unless it comes near the eye's plane; else the part beyond the near plane, as a fan."""
    if all(-p[2] >= near / 1024 for p in triangle):
        return [triangle]
    polygon = clipped_at_near(triangle, near)
    return [[polygon[0], polygon[i], polygon[i + 1]] for i in range(1, len(polygon) - 1)]


def project(scene, triangles):
    """From view space to NDC: pairs of a scene triangle's number and the coordinates of the triangle or of a piece of it."""
    left, right, bottom, top, near, far = window(scene.projection)
    is_ortho = scene.projection[0] == "ortho"

    def projected(p):
        distance = -p[2]
        if is_ortho:
            x, y, z = p[0], p[1], (2 * distance - far - near) / (far - near)
        else:
            x, y = p[0] * near / distance, p[1] * near / distance
            z = ((far + near) * distance - 2 * far * near) / (distance * (far - near))
        return ((2 * x - left - right) / (right - left), (2 * y - bottom - top) / (top - bottom), z)

    return [(number, [projected(p) for p in piece])
            for number, triangle in enumerate(triangles)
            for piece in ([triangle] if is_ortho else pieces(triangle, near))]


def stage_text(numbered):
    """Three vertex lines and a blank line for each triangle; `triangle N` wherever the number is not the next one."""
    lines, expected = [], 0
    for number, triangle in numbered:
        if number != expected:
            lines.append("triangle %d" % number)
        expected = number + 1
        lines += [" ".join(fixed(c) for c in p) for p in triangle] + [""]
    return "".join(line + "\n" for line in lines)


# Stage 4, visibility: coordinates are doubles from here on

class Config:
    """The contents of a config.txt: the image's size in pixels, and the limits of the visible box."""

    def __init__(self, text):
        words = words_of(text)
        self.width, self.height = int(words[0]), int(words[1])
        left, bottom, self.front, self.rear = [float(word) for word in words[2:]] or (-1.0, -1.0, -1.0, 1.0)
        self.dx, self.dy = -2 * left / self.width, -2 * bottom / self.height
        self.left_x, self.top_y = left + self.dx / 2, -bottom - self.dy / 2

    def x_of(self, column):
        return self.left_x + column * self.dx

    def y_of(self, row):
        return self.top_y - row * self.dy


def read_stage_text(text):
    """Pairs of a triangle's number and its three points."""
    words, at, number = words_of(text), 0, 0
    while at < len(words):
        if words[at] == "triangle":
            number, at = int(words[at + 1]), at + 2
        c = [float(word) for word in words[at:at + 9]]
        yield number, [tuple(c[0:3]), tuple(c[3:6]), tuple(c[6:9])]
        number, at = number + 1, at + 9


def crossings(triangle, y):
    """The crossings of the triangle's edges with the horizontal line at y: (x, z), ordered by x."""
    found = []
    for p, q in ((0, 1), (1, 2), (2, 0)):
        low, high = sorted((triangle[p], triangle[q]), key=lambda v: (v[1], v[0], v[2]))
        if low[1] <= y <= high[1] and low[1] != high[1]:
            t = (y - low[1]) / (high[1] - low[1])
            found.append((low[0] + t * (high[0] - low[0]), low[2] + t * (high[2] - low[2])))
    return sorted(found)


def depth_along(met):
    """The depth as a function of x on a row, from the crossings with the triangle's edges; the nearest double."""
    (x_left, z_left), (x_right, z_right) = met[0], met[-1]
    slope = 0 if x_left == x_right else (z_right - z_left) / (x_right - x_left)
    return lambda x: float(z_left + (x - x_left) * slope)


def between(first, x, last):
    return max(first, min(x, last))


def pixels_of(triangle, config):
    """The pixels that a triangle covers by the rule `nearest`, with its depth there: (row, column, z)."""
    exact = [tuple(map(Decimal, v)) for v in triangle]
    highest, lowest = max(v[1] for v in triangle), min(v[1] for v in triangle)
    first_row = math.ceil(between(0, (config.top_y - highest) / config.dy, config.height))
    last_row = math.floor(between(-1, (config.top_y - lowest) / config.dy, config.height - 1))
    for row in range(first_row, last_row + 1):
        met = crossings(triangle, config.y_of(row))
        if len(met) < 2:
            continue
        x_left, x_right = met[0][0], met[-1][0]
        first = math.floor(between(0, (x_left - config.left_x) / config.dx + 0.5, config.width))
        last = math.floor(between(-1, (x_right - config.left_x) / config.dx + 0.5, config.width - 1))
        depth_at = depth_along(crossings(exact, Decimal(config.y_of(row))))
        for column in range(first, last + 1):
            yield row, column, depth_at(Decimal(config.x_of(column)))


def colors():
    """(red, green, blue) of triangles 0, 1, 2 ...: three numbers of the course's generator each."""
    state = 1
    while True:
        color = []
        for _ in range(3):
            state = (214013 * state + 2531011) % 2**32
            color.append((state >> 16 & 0x7fff) % 256)
        yield tuple(color)


def z_buffered(stage3, config):
    """The depth of every pixel and the number of its visible triangle, or None; each a list of rows from the top."""
    depth = [[config.rear] * config.width for _ in range(config.height)]
    owners = [[None] * config.width for _ in range(config.height)]
    with decimal.localcontext(DIGITS_OF_DEPTH):
        for number, triangle in read_stage_text(stage3):
            for row, column, z in pixels_of(triangle, config):
                if config.front <= z < depth[row][column]:
                    depth[row][column] = z
                    owners[row][column] = number
    return depth, owners


def colored(owners):
    """The image: every triangle in its color, on black."""
    numbers = {number for row in owners for number in row if number is not None}
    by_number = dict(zip(range(max(numbers, default=-1) + 1), colors()))
    return [[(0, 0, 0) if number is None else by_number[number] for number in row] for row in owners]


def depth_text(depth, rear):
    """A line for each row; every value below rear with 6 decimals and a tab."""
    return "".join("".join("%.6f\t" % z for z in row if z < rear) + "\n" for row in depth).replace("-0.000000", "0.000000")


def bmp(image):
    """A 24-bit BMP file: rows from the bottom, blue green red, each row padded to a multiple of 4 bytes."""
    height, width = len(image), len(image[0])
    fill = bytes(-3 * width % 4)
    rows = b"".join(b"".join(bytes((b, g, r)) for r, g, b in row) + fill for row in reversed(image))
    return struct.pack("<2sIHHI IiiHHIIiiII", b"BM", 54 + len(rows), 0, 0, 54,
                       40, width, height, 1, 24, 0, len(rows), 0, 0, 0, 0) + rows


def stages(scene, config):
    """The four texts, by name, and the visible triangle of each pixel."""
    in_world = scene.triangles
    in_view = view(scene)
    in_ndc = project(scene, in_view)
    stage3 = stage_text(in_ndc)
    depth, owners = z_buffered(stage3, config)
    files = {"stage1.txt": stage_text(enumerate(in_world)), "stage2.txt": stage_text(enumerate(in_view)),
             "stage3.txt": stage3, "z_buffer.txt": depth_text(depth, config.rear)}
    return {name: text.encode() for name, text in files.items()}, owners


def pipeline(scene_text, config_text):
    """The five files, by name."""
    files, owners = stages(Scene(scene_text), Config(config_text))
    return files | {"out.bmp": bmp(colored(owners))}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    for name, data in pipeline(read(sys.argv[1]), read(sys.argv[2])).items():
        with open(os.path.join(sys.argv[3], name), "wb") as file:
            file.write(data)


if __name__ == "__main__":
    main()
