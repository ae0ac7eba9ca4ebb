"""The triangle that each pixel shows, by rule `center` and in doubles, once the vertices of a projected text
have moved as far as its bounds let them.
"""
import math
import random

from reference import cross, dot

WITHIN = 1 - 1e-6  # of the bounds, more than doubles lose
NO_AREA = 1e-13  # of its points' sizes: where a triangle's points coincide, doubles cannot tell where it is


class Moved:
    """A text for zbuf with the bounds A R B S, drawn with other vertices each time."""

    def __init__(self, stage, bounds, config, clips_all):
        self.absolute, self.relative, *self.rounded = map(float, bounds)
        self.config, self.clips_all, self.rng = config, clips_all, random.Random(1)
        part = stage.header["projection"]
        self.is_ortho = part.kind == "ortho"
        *sides, self.near, self.far = map(float, part.numbers)
        window = 1 if self.is_ortho else self.near  # clip = scale * view + shift * w
        self.axes = [(2 * window / (high - low), -(high + low) / (high - low)) for low, high in
                     (sides[:2], sides[2:])]
        triangles = {}  # one of each number: pieces have that of their whole
        for found in stage.triangles():
            triangles[found.number] = [self.vertex(corner, bool(found.whole))
                                       for corner in found.whole or found.corners]
        self.triangles = list(triangles.items())

    def vertex(self, corner, is_whole):
        """x, y and the distance in view space, and how far each may be from the truth."""
        x, y, z, w = map(float, (*corner.position, corner.w))
        own = 0 if is_whole else (self.rounded[0] + self.rounded[1] * max(map(abs, (x, y, z)))) * w
        clip = (x, y) if is_whole else (x * w, y * w)
        place = [(p - shift * w) / scale for p, (scale, shift) in zip(clip, self.axes)]
        place.append((z * (self.far - self.near) + self.far + self.near) / 2 if self.is_ortho else w)
        error = self.absolute + self.relative * max(map(abs, place))
        return place, [error + own / abs(scale) for scale, _ in self.axes] + [
            error + (own * abs(self.far - self.near) / 2 if self.is_ortho else 0)]

    def picture(self):
        """Rows of numbers, or None. One triangle moves against all others, or every vertex by itself."""
        pixels = [[(float("inf"), None)] * self.config.width for _ in range(self.config.height)]
        sides, one = [self.sign(), self.sign(), -1], self.rng.randrange(len(self.triangles) or 1)
        is_opposed = self.rng.random() < 0.7
        for i, (number, vertices) in enumerate(self.triangles):
            sign = 1 if i == one else -1
            moved = [[p + WITHIN * error * (sign * side if is_opposed else self.sign())
                      for p, error, side in zip(place, errors, sides)] for place, errors in vertices]
            for row, column, distance in self.fragments(moved):
                pixels[row][column] = min(pixels[row][column], (distance, number))
        return [[number for _, number in row] for row in pixels]

    def sign(self):
        return self.rng.choice((-1, 1))

    def fragments(self, places):
        ws = [1 if self.is_ortho else place[2] for place in places]
        points = [[scale * p + shift * w for p, (scale, shift) in zip(place, self.axes)] + [w]
                  for place, w in zip(places, ws)]
        edges = [cross(points[k - 2], points[k - 1]) for k in range(3)]
        area = dot(points[0], edges[0])
        if abs(area) < NO_AREA * math.prod(max(map(abs, point)) for point in points):
            return
        is_cut = self.clips_all or not self.is_ortho and min(ws) * 1024 < self.near
        least = self.near if is_cut else float("-inf") if self.is_ortho else 0
        width, height = self.config.width, self.config.height
        left, bottom, front, rear = map(float, (self.config.left, self.config.bottom, self.config.front,
                                                self.config.rear))
        for row in range(height):
            y = -bottom * (1 - (2 * row + 1) / height)
            for column in range(width):
                x = left * (1 - (2 * column + 1) / width)
                a, b, c = (e[0] * x + e[1] * y + e[2] for e in edges)
                if not (min(a, b, c) > 0 < area or max(a, b, c) < 0 > area):
                    continue
                mean = (a * places[0][2] + b * places[1][2] + c * places[2][2]) / (a + b + c)
                distance = mean if self.is_ortho else area / (a + b + c)
                depth = self.depth(distance)
                if front < depth < rear and distance > least:
                    yield row, column, distance

    def depth(self, distance):
        total = self.far + self.near
        scaled = 2 * distance if self.is_ortho else 2 * (total - self.far * self.near / distance)
        return (scaled - total) / (self.far - self.near)
