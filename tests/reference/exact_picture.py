"""The triangle that each pixel shows if no stage rounds, by rule `center`: the reference's stages in one, in
fractions. Sines and roots have 150 decimals; where they cannot decide, the pixel is a TIE.
"""
import decimal
import math
from fractions import Fraction

import reference
from reference import dot, side_of_edge

TIE = "tie"
SMALL = Fraction(1, 2**150)  # beyond this, a difference of depths, or the side of an edge, is certain
GRID = 2**300  # places on the screen are rounded to this part of a pixel
reference.DECIMALS = 150
decimal.getcontext().prec = 200


class Unrounded:
    """Stands for the text between two stages: for the reference's Writer, then for its Stage."""
    end_of_header = 0

    def __init__(self, header, _):
        self.header, self.list = dict(header), []

    def add(self, triangle):
        self.list.append(triangle)

    def text(self):
        return self

    def triangles(self):
        return self.list


reference.Writer, reference.Stage = Unrounded, lambda text, *_: text


class Exact:
    """A scene (bytes), in world space, view space and NDC."""
    def __init__(self, scene, clip):
        self.world = reference.model(scene, {})
        self.view = reference.view(self.world, {})
        self.ndc = reference.project(self.view, {"--clip": clip, "--clip-inset": "0"})

    def picture(self, config_text):
        """Rows of the numbers of the triangles seen (Z8), None where none is, TIE where it cannot be told."""
        config = reference.read_config(reference.Text(config_text))
        pixels = [[{} for _ in range(config.width)] for _ in range(config.height)]
        for triangle in self.ndc.list:
            corners = [corner.position for corner in triangle.corners]
            small = 0 if is_rational(corners) else SMALL
            for row, column, z, is_inside in fragments(corners, config, small):
                if config.front - small <= z < config.rear + small:
                    is_sure = is_inside and config.front + small <= z < config.rear - small
                    pixels[row][column].setdefault(triangle.number, []).append((z, is_sure, small, corners))
        return [[nearest(pixel) for pixel in row] for row in pixels]


def is_rational(corners):
    """Whether they are exact; sines and roots have powers of ten below their fraction bars."""
    return all(x.denominator % 5**100 for corner in corners for x in corner)


def fragments(corners, config, small):
    """Yields row, column, depth and whether the triangle certainly covers the pixel's center (Z1, Z5, Z7);
    if `small` is 0, those that it covers."""
    left, bottom = map(reference.exact, config.written[:2])
    dx, dy = -2 * left / config.width, -2 * bottom / config.height
    half = Fraction(1, 2)  # columns and rows, y downwards, are whole numbers; depths stay fractions
    points = [((x - left) / dx - half, (-bottom - y) / dy - half) for x, y, _ in corners]
    grid = GRID if small else math.lcm(*(x.denominator for point in points for x in point))
    a, b, c = ((round(x * grid), round(y * grid)) for x, y in points)
    area = side_of_edge(*c, a, b)
    if abs(area) <= grid * grid * small:  # no area, no pixel
        return
    xs, ys = zip(a, b, c)
    for row in reference.inside(Fraction(min(ys), grid), Fraction(max(ys), grid), config.height):
        for column in reference.inside(Fraction(min(xs), grid), Fraction(max(xs), grid), config.width):
            edges = [(b, c), (c, a), (a, b)] if area > 0 else [(c, b), (a, c), (b, a)]  # clockwise as seen
            weights = [side_of_edge(column * grid, row * grid, *edge) for edge in edges]
            is_sure = all(
                weight > grid * grid * small or not small and weight == 0 and reference.is_left_or_top(*edge)
                for weight, edge in zip(weights, edges))
            if is_sure or small and min(weights) > -grid * grid * small:
                z = dot(weights, [corner[2] for corner in corners]) / abs(area)
                yield row, column, z, is_sure


def nearest(pixel):
    """The number of the nearest of {number: [(depth, is_sure, small, corners), ...]}: several where pieces
    meet."""
    if not pixel:
        return None
    (z, number, is_sure, small, corners), *others = sorted(
        (min(found)[0], number, len(found) > 1 or found[0][1], *found[0][2:])
        for number, found in pixel.items())
    is_told = all(
        other[0] > z + small + other[3] or small == other[3] == 0 or other[4] == corners for other in others)
    return number if is_sure and is_told else TIE
