"""What a setting loses against the lossless run: vertices, digits and pixels."""
import collections
import dataclasses
import itertools
import math

from lib.owners import NOBODY
from lib.stage_text import triangle_lines

DIGITS_OF_A_DOUBLE = 16


@dataclasses.dataclass(frozen=True)
class Pixels:
    """How many pixels differ from the lossless picture."""
    wrong: int      # covered in only one of the two, or with a triangle that should be hidden
    neighbors: int  # with a triangle that shares a vertex with the right one


def clamped(x, low, high):
    return max(low, min(x, high))


def numbers_of(line):
    return tuple(map(float, line.split(None, 3)[:3]))


class Screen:
    """Where the window of a config shows what is in NDC, in doubles."""

    def __init__(self, window):
        self.limits = [(float(low), float(high))
                       for low, high in ((window.left, -window.left), (window.bottom, -window.bottom),
                                         (window.front, window.rear))]
        self.size = window.width, window.height

    def clamped(self, p):
        return [clamped(x, *limits) for x, limits in zip(p, self.limits)]

    def pixels_between(self, true, p):
        """How far two positions of a vertex are apart, in pixels; where both are outside the window, as much
        as reaches it."""
        reach = max(1, *(abs(x) / high for x, (_, high) in zip(true, self.limits[:2])))
        dx, dy = ((x - t) / (2 * high) * count / reach
                  for t, x, (_, high), count in zip(true, p, self.limits, self.size))
        return math.hypot(dx, dy)


def vertex_pairs(true_path, path):
    """(line of the lossless text, line) of each vertex; not of triangles that were cut into other numbers of
    pieces."""
    with open(true_path, "rb") as true_file, open(path, "rb") as file:
        groups = [
            itertools.groupby(triangle_lines(lines), key=lambda triangle: triangle[0])
            for lines in (true_file, file)]
        heads = [next(group, None) for group in groups]
        while all(heads):
            behind = [i for i in (0, 1) if heads[i][0] <= heads[1 - i][0]]
            if len(behind) == 2:
                pieces = [[corner for _, corners in head[1] for corner in corners] for head in heads]
                if len(pieces[0]) == len(pieces[1]):
                    yield from zip(*pieces)
            for i in behind:
                heads[i] = next(groups[i], None)


class Vertices:
    """The vertices of the lossless run, which others are compared with."""

    def __init__(self, path, screen):
        self.path, self.screen = path, screen
        low, high = [math.inf] * 3, [-math.inf] * 3
        with open(path, "rb") as file:
            for _, corners in triangle_lines(file):
                for corner in corners:
                    p = screen.clamped(numbers_of(corner))
                    low, high = list(map(min, low, p)), list(map(max, high, p))
        self.extents = [b - a for a, b in zip(low, high)]  # of what is in the window, along each axis

    def compared(self, path):
        """The largest error of a vertex in pixels, and how many of a double's digits are lost, relative to
        the scene's extent along the axis that loses most."""
        largest, errors = 0.0, [0.0] * 3
        pixels = [count / (2 * high) for count, (_, high) in zip(self.screen.size, self.screen.limits)]
        for true_line, line in vertex_pairs(self.path, path):
            if true_line == line:
                continue
            true, p = numbers_of(true_line), numbers_of(line)
            dx, dy, dz = abs(p[0] - true[0]), abs(p[1] - true[1]), abs(p[2] - true[2])
            # Of millions of vertices few exceed those before them; the window only makes errors smaller.
            if dx > errors[0] or dy > errors[1] or dz > errors[2] or (dx * pixels[0])**2 + (
                    dy * pixels[1])**2 > largest**2:
                largest = max(largest, self.screen.pixels_between(true, p))
                errors = [
                    max(error, abs(b - a))
                    for error, a, b in zip(errors, self.screen.clamped(true), self.screen.clamped(p))]
        left = min((digits_left(error, extent) for error, extent in zip(errors, self.extents) if extent > 0),
                   default=DIGITS_OF_A_DOUBLE)
        return largest, DIGITS_OF_A_DOUBLE - left


def digits_left(error, extent):
    """How many whole digits of an extent an error leaves: 3 if it is a thousandth."""
    if error == 0:
        return DIGITS_OF_A_DOUBLE
    return math.floor(clamped(math.log10(extent / error), 0, DIGITS_OF_A_DOUBLE))


def corners_of(path, marks):
    """{mark: the corners of that triangle and of its pieces} in a text of project."""
    found = collections.defaultdict(set)
    with open(path, "rb") as file:
        for number, corners in triangle_lines(file):
            if number + 1 in marks:
                found[number + 1].update(b" ".join(corner.split(None, 3)[:3]) for corner in corners)
    return found


def pixel_differences(pictures, true_pictures, true_path):
    """{setting: Pixels} for {setting: picture}; `true_pictures` has the lossless one of each setting."""
    pairs = {setting: collections.Counter((a, b) for a, b in zip(picture, true_pictures[setting]) if a != b)
             for setting, picture in pictures.items()}
    corners = corners_of(true_path, {mark
                                     for counts in pairs.values() for pair in counts
                                     for mark in pair} - {NOBODY})

    def are_neighbors(a, b):
        return NOBODY not in (a, b) and not corners[a].isdisjoint(corners[b])

    def counted(counts):
        neighbors = sum(count for pair, count in counts.items() if are_neighbors(*pair))
        return Pixels(sum(counts.values()) - neighbors, neighbors)

    return {setting: counted(counts) for setting, counts in pairs.items()}
