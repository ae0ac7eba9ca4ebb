"""Draws triangles row by row under any combination of the rules that the assignment leaves open, and of
mistakes.

Every span of a row carries the uncertainty of its ends and depths, since the numbers in a text are rounded: a
pixel whose owner depends on that may show either."""
import collections
import dataclasses
import functools
import itertools
import math

from lib.maths import window

ROUNDING = 1e-9  # of columns and rows calculated in doubles
MOST_SPANS = 500_000
NARROW = 1e-12
MOST_ON_EDGES = 8  # triangles whose edges a pixel's center lies on, that are looked at
FAR = 1e9  # in NDC: beyond this, all is the same

# Ends of a row of pixels, from where the row of pixel centers meets the triangle, in columns.
ENDS = {
    "down": math.floor, "up": math.ceil, "truncated": math.trunc, "rounded": lambda t: math.floor(t + 0.5)}


class Grid(window.Grid):
    """Pixel centers in NDC, also by a mistake; if `is_one_less`, the outermost lie on the borders."""
    def __init__(self, width, height, left, bottom, half_x=True, half_y=True, is_one_less=False):
        super().__init__(max(1, width - is_one_less), max(1, height - is_one_less), left, bottom)
        self.width, self.height, self.left, self.bottom = width, height, left, bottom
        self.left_x = self.left_x if half_x and not is_one_less else left
        self.top_y = self.top_y if half_y and not is_one_less else -bottom


@dataclasses.dataclass(frozen=True)
class Rule:
    """How spans become pixels and which pixel wins; by default as in `zbuf`."""
    left: str = "rounded"
    right: str = "rounded"
    depth: str = "plane"  # plane, between ends, from left
    clamp: int = None  # between ends: the columns that ends may lie beyond the picture; None is no limit
    half_x: bool = True
    half_y: bool = True
    window: str = ""  # one: its limits are -1 and 1; exchanged: left and bottom are
    is_depth_one: bool = False  # front and rear are -1 and 1
    is_one_less: bool = False  # width - 1 and height - 1 in place of width and height
    corners: str = ""  # how they are changed: whole, rounded, sorted down, sorted up
    winding: int = 0  # of triangles that are drawn: 1 counterclockwise, -1 clockwise; 0 is any
    half: str = ""  # upper, lower: the part of a triangle that is drawn
    ends_z: str = ""  # as met: edge by edge, not from left to right; exchanged
    starts_at_zero: bool = False
    column_more: int = 0  # the excess columns at the right ends of rows
    columns_before: int = 0  # the excess columns at their left ends
    row_short: bool = False
    row_long: bool = False
    columns: str = ""  # to the border, from the border, at the left end, at the right end
    shift: tuple = (0, 0)  # columns and rows
    is_cut_first: bool = False  # whether spans end at the picture's borders before the shift
    is_strict: bool = False  # whether pixels whose centers lie on an edge are left out
    keep: str = "nearest"  # nearest, farthest, last, none
    has_front: bool = True
    has_rear: bool = True
    flat: str = ""  # a single depth, of FLAT_TRIANGLE or of FLAT_ROW
    without: frozenset = frozenset()  # numbers of triangles that are not drawn
    picture_flip: str = ""  # upside down, mirrored, turned, transposed
    text_flip: str = ""

    @property
    def is_of_depths(self):
        """True if it changes which depth a pixel of a triangle has, or which of two wins."""
        return bool(self.flat or self.ends_z or self.keep != "nearest" or self.corners.startswith("sorted")
                    or self.is_depth_one or self.starts_at_zero or not (self.has_front and self.has_rear))


# A triangle's part of a row: its ends in columns, its depth at both, and how uncertain they are; whether the
# row is the triangle's last one, lies above its middle corner, is met by the first edge from the right, and
# meets the triangle, which has an area, for certain.
Span = collections.namedtuple(
    "Span", "triangle left right z_left z_right slack_left slack_right slack_z is_last is_upper "
    "is_met_from_right is_certain")
FLAT_TRIANGLE = ("mean", "first", "second", "third", "least", "most")  # of the depths of its corners
FLAT_ROW = ("left of row", "right of row", "mean of row")


def changed_corners(corners, change, grid):
    """Corners moved to the centers of pixels, by rounding; or sorted by y, but for their depths."""
    if change.startswith("sorted"):
        by_height = sorted(corners, key=lambda p: p[1], reverse=change == "sorted down")
        return [(*p[:2], q[2]) for p, q in zip(by_height, corners)]
    offset = 0.5 if change == "rounded" else 0.0
    return [(grid.x_of(math.floor((x - grid.left) / grid.dx + offset)),
             grid.y_of(math.floor((-grid.bottom - y) / grid.dy + offset)), z) for x, y, z in corners]


class Triangles:
    """Triangles in NDC over a grid, changed by Rule.corners. Coordinates may be off by their `units`."""
    def __init__(self, points, units, grid, change=""):
        self.grid = grid
        near = [tuple(max(-FAR, min(x, FAR)) for x in p) for p in points]
        self.corners = [near[i:i + 3] for i in range(0, len(near), 3)]
        if change:
            self.corners = [changed_corners(corners, change, grid) for corners in self.corners]
        self.units = [min(FAR, max(max(u) for u in units[i:i + 3])) for i in range(0, len(units), 3)]
        self.rows, count = [[] for _ in range(grid.height)], 0
        self.row, self.below = functools.cache(self.row), functools.cache(self.below)
        for t, corners in enumerate(self.corners):
            lowest, _, highest = sorted(p[1] for p in corners)
            slack = self.units[t] / grid.dy + ROUNDING
            first = math.ceil(min(max(0.0, grid.row_at(highest) - slack), grid.height))
            last = math.floor(min(max(-1.0, grid.row_at(lowest) + slack), grid.height - 1))
            count += max(0, last - first + 1)
            if count > MOST_SPANS:
                raise TooMuch
            for row in range(first, last + 1):
                self.rows[row].append(t)

    def row(self, row):
        """The spans of a row; none beyond the picture."""
        return [self.span(t, row) for t in self.rows[row]] if 0 <= row < self.grid.height else []

    def below(self, row):
        """The spans of triangles that end on the row above, with their lowest edges extended to this one."""
        return [self.span(span.triangle, row, True) for span in self.row(row - 1) if span.is_last]

    def span(self, t, row, is_below=False):
        grid, corners, unit = self.grid, self.corners[t], self.units[t]
        y = grid.y_of(row)
        lowest, middle, highest = sorted(p[1] for p in corners)
        slack_y = unit + ROUNDING * grid.dy
        is_certain = is_below or lowest + slack_y < y < highest - slack_y
        inside = min(max(y, lowest), highest)
        y = y if is_below else inside
        met = []
        for i in range(3):
            low, high = sorted((corners[i], corners[(i + 1) % 3]), key=lambda p: (p[1], p[0], p[2]))
            if low[1] == high[1] or not low[1] <= inside <= high[1]:
                continue
            dx, dy, dz = (b - a for a, b in zip(low, high))
            t_y = (y - low[1]) / dy
            x, z = (high[0], high[2]) if y == high[1] else (low[0] + t_y * dx, low[2] + t_y * dz)
            stretch = 1 + 2 * max(0.0, -t_y)
            met.append((x, z, (unit + min(abs(dx),
                                          abs(dx) / dy * unit)) * stretch, abs(dz) / dy * unit * stretch))
        if len(met) < 2:  # a horizontal line
            ends = sorted(corners)
            met, is_certain = [(*ends[0][::2], unit, 0.0), (*ends[2][::2], unit, 0.0)], False
        (x_left, z_left, slack_left, dz_left), (x_right, z_right, slack_right, dz_right) = min(met), max(met)
        left, right = grid.column_at(x_left), grid.column_at(x_right)
        slack_left, slack_right = slack_left / grid.dx + ROUNDING, slack_right / grid.dx + ROUNDING
        width = max(right - left, NARROW)
        reach_z = max(p[2] for p in corners) - min(p[2] for p in corners)
        slack_z = (unit + min(dz_left + dz_right, reach_z)) * (1 + 2 / width)
        slack_z += abs(z_right - z_left) / width * (slack_left + slack_right)
        if right - left <= slack_left + slack_right and not self.winding(t):
            is_certain, slack_z = False, slack_z + abs(z_right - z_left)
        return Span(t, left, right, z_left, z_right, slack_left, slack_right, slack_z,
                    row == math.floor(grid.row_at(lowest) + ROUNDING), y >= middle, met[0] != min(met),
                    is_certain)

    def winding(self, t):
        """1 for counterclockwise, -1 for clockwise; 0 where the last digits decide, as without an area."""
        (ax, ay, _), (bx, by, _), (cx, cy, _) = self.corners[t]
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        reach = max(abs(bx - ax), abs(by - ay), abs(cx - ax), abs(cy - ay))
        return int(math.copysign(abs(area) > 4 * reach * (self.units[t] + 1e-15), area))

    def meet_on(self, s, t, row, column):
        """True if a pixel's center lies on an edge between two triangles, away from its ends."""
        corners, others = {*self.corners[s]}, {*self.corners[t]}
        if len(corners & others) != 2 or len(corners | others) != 4:
            return False
        (px, py, _), (qx, qy, _) = corners & others
        x, y, dx, dy = self.grid.x_of(column) - px, self.grid.y_of(row) - py, qx - px, qy - py
        sides, square = [dx * (b - py) - dy * (a - px) for a, b, _ in corners ^ others], dx * dx + dy * dy
        is_on = abs(dx * y - dy * x) <= ROUNDING * self.grid.dx * math.sqrt(square)
        return is_on and sides[0] * sides[1] < 0 and 1e-3 * square < dx * x + dy * y < 0.999 * square


class TooMuch(Exception):
    """More spans or pixels than can be drawn in Python."""


def spend(work, count):
    """Subtracts `count` from the number in `work`; raises TooMuch when the number is used up."""
    work[0] -= count
    if work[0] < 0:
        raise TooMuch


def ends_of(span, rule, width, slack=0.0):
    """The first and the last column; as wide as the span's uncertainty allows, or (slack < 0) as narrow."""
    first = ENDS[rule.left](span.left - slack * span.slack_left)
    last = ENDS[rule.right](span.right + slack * span.slack_right)
    if rule.is_strict and slack <= 0:
        first += abs(first - span.left) <= span.slack_left
        last -= abs(last - span.right) <= span.slack_right
    if rule.is_cut_first:
        first, last = max(first, 0), min(last, width - 1)
    if rule.columns:  # min for max, or max for min
        first, last = {
            "to the border": (first, width - 1), "from the border": (0, last),
            "at the left end": (first, first), "at the right end": (last, last)}[rule.columns]
    return first - rule.columns_before + rule.shift[0], last + rule.column_more + rule.shift[0]


class Drawing:
    """A picture under a rule, with `limits` front and rear; `work` counts down pixels and spans looked at."""
    def __init__(self, triangles, rule, limits, work):
        self.triangles, self.rule, self.work = triangles, rule, work
        self.reach = functools.cache(self.reach)
        self.front = limits[0] if rule.has_front else -math.inf
        self.rear = 0.0 if rule.starts_at_zero else limits[1] if rule.has_rear else math.inf
        self.width = triangles.grid.width

    def spans(self, row):
        rule, row = self.rule, row - self.rule.shift[1]
        below = self.triangles.below(row) if rule.row_long else ()
        return [
            span for span in sorted([*self.triangles.row(row), *below], key=lambda span: span.triangle)
            if not (rule.row_short and span.is_last or rule.half and span.is_upper != (rule.half == "upper")
                    or rule.winding and self.triangles.winding(span.triangle) == -rule.winding
                    or span.triangle in rule.without)]

    def line(self, span):
        """The depth as (z at column 0, z per column)."""
        rule, left, right, z_left, z_right = self.rule, span.left, span.right, span.z_left, span.z_right
        if rule.flat:
            zs = [p[2] for p in self.triangles.corners[span.triangle]]
            values = (sum(zs) / 3, *zs, min(zs), max(zs), z_left, z_right, (z_left + z_right) / 2)
            return values[(FLAT_TRIANGLE + FLAT_ROW).index(rule.flat)], 0.0
        if rule.ends_z == "exchanged" or rule.ends_z and span.is_met_from_right:
            z_left, z_right = z_right, z_left
        if rule.depth == "between ends":
            left, right = ENDS[rule.left](left), ENDS[rule.right](right)
            if rule.clamp is not None:
                left, right = (max(-rule.clamp, min(end, self.width - 1 + rule.clamp))
                               for end in (left, right))
        if right - left < NARROW:
            return min(z_left, z_right), 0.0
        slope = (z_right - z_left) / (right - left)
        if rule.depth == "from left":
            left = max(ENDS[rule.left](left), 0 if rule.clamp == 0 else -math.inf)
        left += rule.shift[0]
        return z_left - left * slope, slope

    def row(self, row):
        """The triangle (or -1) and the depth of each pixel of a row, and the range of columns with any."""
        owner, depth, start, stop = [-1] * self.width, [self.rear] * self.width, self.width, 0
        front, rear, keep = self.front, self.rear, self.rule.keep
        for span in self.spans(row):
            if self.rule.is_strict and not span.is_certain:
                continue
            first, last = ends_of(span, self.rule, self.width)
            at_0, slope = self.line(span)
            t, columns = span.triangle, range(max(first, 0), min(last, self.width - 1) + 1)
            spend(self.work, len(columns) + 1)
            start, stop = min(start, columns.start), max(stop, columns.stop)
            for column in columns:
                z = at_0 + column * slope
                if keep == "nearest":
                    if front <= z < depth[column]:
                        owner[column], depth[column] = t, z
                elif front <= z < rear and keep != "none" and (keep == "last" or owner[column] < 0
                                                               or z > depth[column]):
                    owner[column], depth[column] = t, z
        return owner, depth, range(start, stop)

    def reach(self, row):
        """For each span of a row: its possible ends, its certain ones, and its depths."""
        return [(span, *(ends_of(span, self.rule, self.width, slack)
                         for slack in (1.0, -1.0)), self.line(span)) for span in self.spans(row)]

    def could_show(self, row, column, tolerance):
        """All that a pixel may show, given how uncertain the numbers are: pairs of a triangle and a range of
        depths; the triangle -1 stands for none. `tolerance` is a depth's."""
        sure, possible, unsure, spans, center = [], [], [], self.reach(row), column - self.rule.shift[0]
        spend(self.work, len(spans))
        for span, (least, most), (first, last), (at_0, slope) in spans:
            if not least <= column <= most:
                continue
            beyond = max(0.0, span.left - center, center - span.right) if self.rule.columns else 0.0
            stretch = 1 + 2 * beyond / max(span.right - span.left, NARROW)
            z, slack = at_0 + column * slope, tolerance + span.slack_z * stretch
            if not (z + slack >= self.front and z - slack < self.rear):
                continue
            fragment = (span.triangle, z - slack, z + slack)
            possible.append(fragment)
            if z - slack >= self.front and z + slack < self.rear:
                (sure if span.is_certain and first <= column <= last else unsure).append(fragment)
        for one, other in itertools.combinations(unsure[:MOST_ON_EDGES], 2):
            if self.triangles.meet_on(one[0], other[0], row - self.rule.shift[1], center):
                if self.rule.is_strict:  # neither of them is there
                    possible = [fragment for fragment in possible if fragment not in (one, other)]
                else:  # one of them is
                    sure.append((min(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2])))
        return kept(sure, possible, self.rule.keep)


def kept(sure, possible, keep):
    """The fragments (triangle, least depth, largest depth) that a pixel may show; `sure` ones exist."""
    if not sure:
        return [*possible, (-1, 0.0, 0.0)]
    if keep in ("last", "farthest"):
        own, others = (0, 0) if keep == "last" else (1, 2)
        least = max(fragment[own] for fragment in sure)
        return [fragment for fragment in possible if fragment[others] >= least]
    most = min(high for _, _, high in sure)
    return [fragment for fragment in possible if fragment[1] <= most]
