"""The cases that a rasterizer can be tried on: those of the conformance pack whose triangles have nothing but
coordinates."""
import dataclasses
import functools
import itertools
import math
import pathlib
import re
import sys
from fractions import Fraction

from . import scoreboard_geometry as geometry

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "tests/conformance"))
from conform_parts import cases  # noqa: E402

PLAIN = re.compile(rb"[-+.eE0-9 \t\r\n]*")


@dataclasses.dataclass(eq=False)
class Case:
    name: str
    fields: dict  # what adapters are told
    why: str

    @property
    def width(self):
        return self.fields["width"]

    @property
    def height(self):
        return self.fields["height"]

    @functools.cached_property
    def triangles(self):
        """In pixels."""
        left, bottom = Fraction(self.fields["left"]), Fraction(self.fields["bottom"])
        dx, dy = -2 * left / self.width, -2 * bottom / self.height
        return [[((x - left) / dx, (-bottom - y) / dy, z)
                 for x, y, z in (map(Fraction, point)
                                 for point in triangle)]
                for triangle in self.fields["triangles"]]

    def centers(self):
        """(pixel, its center) of all pixels, row by row."""
        for row, column in itertools.product(range(self.height), range(self.width)):
            yield row * self.width + column, (column + Fraction(1, 2), row + Fraction(1, 2))

    @functools.cached_property
    def positions(self):
        """For each pixel, where its center lies in each triangle."""
        table = [[geometry.OUTSIDE] * len(self.triangles) for _ in range(self.width * self.height)]
        for number, triangle in enumerate(self.triangles):
            corners, scale = geometry.as_whole_numbers(triangle)
            rows, columns = (range(max(0, math.floor(min(values))), min(limit,
                                                                        math.ceil(max(values)) + 1))
                             for values, limit in (([y for _, y, _ in triangle], self.height),
                                                   ([x for x, _, _ in triangle], self.width)))
            for row, column in itertools.product(rows, columns):
                center = (2 * column + 1) * scale // 2, (2 * row + 1) * scale // 2
                table[row * self.width + column][number] = geometry.position(corners, center)
        return table

    @functools.cached_property
    def is_tiling(self):
        """Whether there are triangles to divide pixels among, and no two overlap."""
        return len(self.triangles) > 1 and not any(
            geometry.overlap(a, b) for a, b in itertools.combinations(self.triangles, 2))

    @functools.cached_property
    def inner_pixels(self):
        """Of a tiling: the pixels whose centers lie inside, so that exactly one triangle should own each."""
        return [
            pixel for pixel, center in self.centers()
            if any(self.positions[pixel]) and geometry.is_inside_all(self.triangles_at(pixel), center)]

    def triangles_at(self, pixel):
        """Those that contain the pixel's center, or have it on an edge."""
        return [
            triangle for triangle, where in zip(self.triangles, self.positions[pixel])
            if where != geometry.OUTSIDE]

    @functools.cached_property
    def border(self):
        """Of a tiling: the edges that no two triangles share."""
        ends = [frozenset((a[:2], b[:2])) for triangle in self.triangles for a, b in geometry.edges(triangle)]
        return [tuple(edge) for edge in ends if ends.count(edge) == 1]

    def border_distance(self, pixel):
        """From a pixel's center to the border, in pixels."""
        return min(
            geometry.distance_to_edge(edge, (pixel % self.width + 0.5, pixel // self.width + 0.5))
            for edge in self.border)

    @functools.cached_property
    def full_pixels(self):
        """Of a tiling: the pixels that lie inside with their whole area."""
        return [
            pixel for pixel in self.inner_pixels if sum(
                geometry.area_in_pixel(triangle, pixel % self.width, pixel // self.width)
                for triangle in self.triangles) == 1]

    def distance(self, triangle, pixel):
        """From a pixel's center to the border of a triangle, in pixels."""
        return geometry.distance(self.triangles[triangle],
                                 (pixel % self.width + 0.5, pixel // self.width + 0.5))

    def seen(self, pixel, tolerance):
        """The triangle seen in a pixel, -1 for none; None if depths, or a depth and a limit, are nearer to
        each other than the part `tolerance` of the limits' distance, or if the center is on an edge."""
        center = pixel % self.width + Fraction(1, 2), pixel // self.width + Fraction(1, 2)
        if geometry.EDGE in self.positions[pixel]:
            return None
        front, rear = Fraction(self.fields["front"]), Fraction(self.fields["rear"])
        depths = sorted((geometry.depth(triangle, center), number)
                        for number, triangle in enumerate(self.triangles)
                        if self.positions[pixel][number] == geometry.INSIDE)
        least = tolerance * (rear - front)
        if any(abs(z - limit) < least for z, _ in depths for limit in (front, rear)):
            return None
        depths = [(z, number) for z, number in depths if front <= z < rear]
        if len(depths) > 1 and depths[1][0] - depths[0][0] < least:
            return None
        return depths[0][1] if depths else -1


def expressed(case):
    """A case of the pack as a Case; None if an adapter cannot express it, or if it needs more digits than
    doubles have: most interfaces take single precision."""
    text, config = case.read("input.txt"), case.read("config.txt")
    if "exactness" in case.words("needs") or case.refused_line is not None or case.has(
            "options.txt") or not PLAIN.fullmatch(text) or not PLAIN.fullmatch(config):
        return None
    words, limits = text.decode().split(), config.decode().split()
    corners = [words[i:i + 3] for i in range(0, len(words), 3)]
    triangles = [corners[i:i + 3] for i in range(0, len(corners), 3)]
    left, bottom, front, rear = limits[2:] or ("-1", "-1", "-1", "1")
    fields = {
        "width": int(limits[0]), "height": int(limits[1]), "left": left, "bottom": bottom, "front": front,
        "rear": rear, "triangles": triangles}
    return Case(case.short_name, fields, case.why) if triangles else None


def read_cases(folder):
    """The cases of a pack's folder for zbuf, as far as an adapter can express them."""
    return [case for case in map(expressed, cases.read_cases("zbuf", folder)) if case]
