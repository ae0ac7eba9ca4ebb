"""The triangle that each pixel shows if no stage rounds, by rule `center`: the reference's stages in one, in
fractions. Sines and roots have 150 decimals; where they cannot decide, the pixel is a TIE.
"""
import decimal
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
            for row, column, z, is_inside in fragments(
                    [corner.position for corner in triangle.corners], config):
                if config.front - SMALL <= z <= config.rear + SMALL:
                    is_sure = is_inside and config.front + SMALL < z < config.rear - SMALL
                    pixels[row][column].setdefault(triangle.number, []).append((z, is_sure))
        return [[nearest(pixel) for pixel in row] for row in pixels]


def fragments(corners, config):
    """Yields row, column, depth and whether the triangle certainly covers the pixel's center (Z1, Z5, Z7)."""
    left, bottom = map(reference.exact, config.written[:2])
    dx, dy = -2 * left / config.width, -2 * bottom / config.height
    half = Fraction(1, 2)  # columns and rows, y downwards, are whole numbers; depths stay fractions
    a, b, c = ((round(((x - left) / dx - half) * GRID), round(((-bottom - y) / dy - half) * GRID))
               for x, y, _ in corners)
    area = side_of_edge(*c, a, b)
    if abs(area) < GRID * GRID * SMALL:  # no area, no pixel
        return
    xs, ys = zip(a, b, c)
    for row in reference.inside(Fraction(min(ys), GRID), Fraction(max(ys), GRID), config.height):
        for column in reference.inside(Fraction(min(xs), GRID), Fraction(max(xs), GRID), config.width):
            weights = [side_of_edge(column * GRID, row * GRID, p, q) * (1 if area > 0 else -1)
                       for p, q in ((b, c), (c, a), (a, b))]
            if min(weights) > -GRID * GRID * SMALL:
                z = dot(weights, [corner[2] for corner in corners]) / abs(area)
                yield row, column, z, min(weights) > GRID * GRID * SMALL


def nearest(pixel):
    """The number of the nearest of {number: [(depth, is_sure), ...]}: several where pieces meet."""
    if not pixel:
        return None
    (z, is_sure, number), *others = sorted((min(found)[0], len(found) > 1 or found[0][1], number)
                                           for number, found in pixel.items())
    return number if is_sure and all(other[0] > z + SMALL for other in others) else TIE
