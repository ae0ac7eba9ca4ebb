"""An adapter is a program that has one rasterizer draw triangles. It first writes a line of JSON about the
rasterizer,

    {"name": ..., "version": ..., "promise": what it promises, and how it rounds, "grid": to which part
    of a pixel it rounds corners, "is_antialiased": ..., "has_depth": ...}

then, for each line of JSON on stdin,

    {"width", "height", "left", "bottom", "front", "rear": the config, "triangles": [[[x, y, z] three times],
    ...], numbers as words}

a line {"coverage": [for each triangle, alone in the picture, the rows from the top in hexadecimal, a byte a
pixel, 255 is all of it], "seen": [for each pixel the triangle seen there among all, -1 for none]}, without
"seen" if the rasterizer has no depth. Where the rasterizer is not installed, it writes a line that says so to
stderr, and its exit status is 77.
"""
import ctypes
import ctypes.util
import json
import sys
from fractions import Fraction

NOT_INSTALLED = 77


def leave(reason):
    print(reason, file=sys.stderr)
    sys.exit(NOT_INSTALLED)


def library(name, package):
    """The shared library, of a Debian package."""
    found = ctypes.util.find_library(name)
    try:
        return ctypes.CDLL(found) if found else leave(f"no lib{name} (Debian: {package})")
    except OSError as error:
        leave(f"lib{name}: {error}")


class Case:
    def __init__(self, fields):
        self.width, self.height = fields["width"], fields["height"]
        self.left, self.bottom, self.front, self.rear = (Fraction(fields[key])
                                                         for key in ("left", "bottom", "front", "rear"))
        self.words = fields["triangles"]
        self.config = "{width} {height}\n{left}\n{bottom}\n{front} {rear}\n".format(**fields)
        self.triangles = [[tuple(map(Fraction, point)) for point in triangle] for triangle in self.words]

    def pixels(self, point):
        """x and y in pixels from the top left corner of the picture: the center of the first pixel is at 0.5
        0.5."""
        x, y, _ = point
        return (x - self.left) * self.width / (-2 * self.left), (-self.bottom -
                                                                 y) * self.height / (-2 * self.bottom)

    def ndc(self, point):
        """The point with the window, and the limits of z, at -1 and 1."""
        x, y, z = point
        return x / -self.left, y / -self.bottom, 2 * (z - self.front) / (self.rear - self.front) - 1


def serve(about, coverage, seen=None):
    """Answers the cases on stdin; coverage(case, number of a triangle) gives bytes, seen(case) numbers."""
    print(json.dumps({**about, "has_depth": seen is not None}), flush=True)
    for line in sys.stdin:
        case = Case(json.loads(line))
        answer = {"coverage": [coverage(case, number).hex() for number in range(len(case.triangles))]}
        if seen:
            answer["seen"] = seen(case)
        print(json.dumps(answer), flush=True)
