"""The window transform of a config.txt, and which pixels a triangle covers, exactly.

A point of the window is (column, row), row 0 at the top; whole numbers are the centers of pixels."""
import dataclasses
import math
from fractions import Fraction

from lib.maths.exact import as_decimal, decimal_or_double, double, root

DEFAULT_LIMITS = ("-1", "-1", "-1", "1")
FAR_OFF = 10**9  # a column beyond any picture, since doubles may be infinite
OWNING = ("left", "top")  # the edges whose points belong to the triangle, under --coverage center


class Window:
    """The window [left, -left] x [bottom, -bottom] of NDC, which becomes width x height pixels."""
    def __init__(self, config):
        words = [word for line in config.split("\n") for word in line.split("#")[0].split()]
        self.width, self.height = int(words[0]), int(words[1])
        left, bottom, front, rear = words[2:] or DEFAULT_LIMITS
        self.left, self.bottom = decimal_or_double(left), decimal_or_double(bottom)
        self.front, self.rear = double(front), double(rear)
        self.grid = Grid(self.width, self.height, self.left, self.bottom)
        self.grid_in_doubles = Grid(self.width, self.height, float(left), float(bottom))

    def place(self, p):
        """The (column, row) of a point in NDC."""
        return self.grid.column_at(p[0]), self.grid.row_at(p[1])


class Grid:
    """The pixel centers in NDC, in the number type of the limits: fractions, or doubles with zbuf's
    roundings."""
    def __init__(self, width, height, left, bottom):
        self.dx, self.dy = -2 * left / width, -2 * bottom / height
        self.left_x, self.top_y = left + self.dx / 2, -bottom - self.dy / 2

    def column_at(self, x):
        return (x - self.left_x) / self.dx

    def row_at(self, y):
        return (self.top_y - y) / self.dy

    def x_of(self, column):
        return self.left_x + column * self.dx

    def y_of(self, row):
        return self.top_y - row * self.dy


@dataclasses.dataclass
class Edge:
    name: str
    side: str  # the side of the triangle that it bounds: left, right, top or bottom
    value: Fraction  # distance times length; positive inside, 0 on the edge
    square: Fraction  # of its length in pixels

    @property
    def distance(self):
        """The distance of the pixel's center, in pixels."""
        return Fraction(as_decimal(self.value) / as_decimal(root(self.square)))

    @property
    def is_owned(self):
        return self.value > 0 or self.value == 0 and self.side in OWNING


def side_of(step_right, step_down):
    """The side that an edge bounds, from the growth of its edge function to the right and downwards."""
    if step_right:
        return "left" if step_right > 0 else "right"
    return "top" if step_down > 0 else "bottom"


class PixelOfTriangle:
    """A pixel's center and a triangle, given by names and points in NDC (fractions)."""
    def __init__(self, window, names, points, pixel):
        self.window, self.names, self.points, self.pixel = window, names, points, pixel
        corners = [window.place(p) for p in points]
        (ac, ar), (bc, br), (cc, cr) = corners
        self.doubled_area = (bc - ac) * (cr - ar) - (cc - ac) * (br - ar)
        sign = 1 if self.doubled_area > 0 else -1
        self.edges = []
        for i, j in ((0, 1), (1, 2), (2, 0)):
            right, down = (sign * (q - p) for p, q in zip(corners[i], corners[j]))
            value = right * (pixel[1] - corners[i][1]) - down * (pixel[0] - corners[i][0])
            self.edges.append(Edge(f"{names[i]}-{names[j]}", side_of(-down, right), value,
                                   right**2 + down**2))

    @property
    def has_area(self):
        return self.doubled_area != 0

    @property
    def distance(self):
        """The distance of the center from the nearest edge, in pixels; negative outside."""
        return min(edge.distance for edge in self.edges) if self.has_area else -math.inf

    def is_covered(self, rule):
        """By the rule `center`, True if the center is inside, or on top and left edges alone, exactly; by the
        rule `nearest`, True if the pixel is in its row's span, from the pixel nearest to the left end to the
        one nearest to the right end, in zbuf's doubles."""
        if rule == "center":
            return self.has_area and all(edge.is_owned for edge in self.edges)
        span = self.span_in_doubles()
        return span is not None and span.has(self.pixel[0])

    @property
    def weights(self):
        """The weights of the three vertices at the pixel's center: each is the area between the center and
        the opposite edge, as a share of the triangle's."""
        ab, bc, ca = (edge.value / abs(self.doubled_area) for edge in self.edges)
        return bc, ca, ab

    def depth(self, rule):
        """The depth of the triangle's plane at the pixel's center, exactly; by the rule `nearest`, if the row
        crosses the triangle in a single point, the depth there."""
        end = self.single_crossing(rule)
        return end if end is not None else sum(weight * p[2] for weight, p in zip(self.weights, self.points))

    def single_crossing(self, rule):
        """The depth of the single point (a corner, or an edge-on triangle) in which the row crosses the
        triangle by the rule `nearest`, in zbuf's doubles; exact if exact numbers give one, too. Else None."""
        span = self.span_in_doubles() if rule == "nearest" else None
        if span is None or span.depth is None:
            return None
        exact = self.span()
        return Fraction(span.depth) if exact is None or exact.depth is None else exact.depth

    def span(self):
        """The exact Span of the rule `nearest`, or None if the row misses the triangle."""
        return span_on_row(self.window.grid, self.points, self.pixel[1])

    def span_in_doubles(self):
        """The same Span in doubles, step by step as zbuf calculates it."""
        return span_on_row(self.window.grid_in_doubles, [tuple(map(float, p)) for p in self.points],
                           self.pixel[1])


@dataclasses.dataclass
class Span:
    """The columns where a row enters and leaves a triangle, and the pixels nearest to them; `depth` is that
    of the point if both are a single one, else None."""
    left: object
    right: object
    first: int
    last: int
    depth: object

    @property
    def ends(self):
        return self.first, self.last

    def has(self, column):
        return self.first <= column <= self.last


def span_on_row(grid, points, row):
    """The Span of a row, halves going right. None if the line through the row's pixel centers meets fewer
    than two edges."""
    highest, lowest = max(p[1] for p in points), min(p[1] for p in points)
    if not grid.row_at(highest) <= row <= grid.row_at(lowest):
        return None
    met = crossings(points, grid.y_of(row))
    if len(met) < 2:
        return None
    (left_x, left_z), (right_x, _) = min(met), max(met)
    left, right = grid.column_at(left_x), grid.column_at(right_x)
    half = 0.5 if isinstance(left, float) else Fraction(1, 2)
    first, last = (math.floor(max(-FAR_OFF, min(column + half, FAR_OFF))) for column in (left, right))
    return Span(left, right, first, last, left_z if left_x == right_x else None)


def crossings(points, y):
    """The sorted (x, z) where non-horizontal edges cross the line at y, interpolated from the lower
    end (by y, then x, then z)."""
    found = []
    for p, q in zip(points, points[1:] + points[:1]):
        low, high = sorted((p, q), key=lambda v: (v[1], v[0], v[2]))
        if low[1] <= y <= high[1] and low[1] != high[1]:
            t = (y - low[1]) / (high[1] - low[1])
            x, z = ((p + t * (q - p) if y != high[1] else q)
                    for p, q in ((low[0], high[0]), (low[2], high[2])))
            found.append((x, z))
    return found
