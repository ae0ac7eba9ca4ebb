"""Another rule at the borders: whether each pixel that differs lies within REACH of an edge, or of the line
where two triangles meet, and the pixels are not all shifted."""
import collections
import functools
import math

from lib.judging.raster import Rule, kept, spend

REACH = 1.5        # pixels between one that differs and an edge
DEPTH_REACH = 1.0  # pixels along which the depth of a triangle may be taken
DEEP = 1.5         # pixels
SHIFT = 0.4        # pixels, on average
LEAST_ENDS = 3     # before their average says anything
# All that differs should lie within a pixel of an edge. Honest programs have a few pixels astray, for example
# where a row passes just by a vertex, and depths that depend on the ends of their row: no more is let through
# than they need.
MOST_STRAYS = 1 / 32   # of the pixels that are drawn, or not, otherwise
MOST_OTHERS = 1 / 64   # of the pixels with a triangle, that may show one which is none within a pixel
MOST_DEPTHS = 1 / 5    # of them, that may have a depth which the triangle has nowhere within a pixel


class Borders:
    """Triangles (raster.Triangles) in pixels: what may be seen at a pixel if its center may move by REACH.
    `work` is that of Drawing."""

    def __init__(self, triangles, limits, work):
        self.triangles, (self.front, self.rear), self.work = triangles, limits, work
        self.planes, self.boxes = {}, {}

    def plane(self, t):
        """Of a triangle in pixels: its edges as (a, b, c) with a column + b row + c the distance from the
        inside, its depth as (per column, per row, at 0 0), its columns from and to, and its depths from and
        to."""
        if t not in self.planes:
            self.planes[t] = self.make_plane(t)
        return self.planes[t]

    def make_plane(self, t):
        grid = self.triangles.grid
        corners = [((x - grid.left_x) / grid.dx, (grid.top_y - y) / grid.dy, z)
                   for x, y, z in self.triangles.corners[t]]
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        box = [(min(values), max(values)) for values in zip(*corners)]
        sides = [(px, py, qx - px, qy - py, math.hypot(qx - px, qy - py))
                 for (px, py, _), (qx, qy, _) in zip(corners, corners[1:] + corners[:1])]
        if not self.triangles.has_area(t) or abs(area) < REACH * max(side[-1] for side in sides):
            return None, None, box
        sign, edges = math.copysign(1.0, area), []
        for px, py, dx, dy, length in sides:
            a, b = -sign * dy / length, sign * dx / length
            edges.append((a, b, -(a * px + b * py)))
        per_column = ((bz - az) * (cy - ay) - (cz - az) * (by - ay)) / area
        per_row = ((cz - az) * (bx - ax) - (bz - az) * (cx - ax)) / area
        return edges, (per_column, per_row, az - per_column * ax - per_row * ay), box

    def fragment(self, t, row, column, tolerance):
        """(triangle, least depth, largest depth) and whether it is there for certain; None if it is out of
        reach."""
        edges, depth, ((left, right), (top, bottom), (nearest, farthest)) = self.plane(t)
        if not (left - REACH <= column <= right + REACH and top - REACH <= row <= bottom + REACH):
            return None
        if edges is None:
            # Thinner than a pixel: open where it is drawn.
            return (t, nearest - tolerance, farthest + tolerance), False
        inside = min(a * column + b * row + c for a, b, c in edges)
        if inside < -REACH:
            return None
        per_column, per_row, at_0 = depth
        z = per_column * column + per_row * row + at_0
        slack = (abs(per_column) + abs(per_row)) * DEPTH_REACH + tolerance
        low, high = z - slack, z + slack
        return (t, low, high), inside >= REACH and low >= self.front and high < self.rear

    def has(self, t, row, column, z, tolerance):
        """Whether a triangle has a depth within a pixel of the center of this one."""
        found = self.fragment(t, row, column, tolerance)
        return found is not None and found[0][1] <= z <= found[0][2]

    def inside(self, t, row, column):
        """How far a pixel's center lies inside the outline of a triangle, in pixels; less than 0 outside, and
        of a triangle thinner than a pixel."""
        edges = self.plane(t)[0]
        return -REACH if edges is None else min(a * column + b * row + c for a, b, c in edges)

    def near(self, row, column):
        """The triangles on this row or beside it that come within a pixel of the column."""
        if row not in self.boxes:
            rows = self.triangles.rows[max(row - 1, 0):row + 2]
            self.boxes[row] = [(t, *self.plane(t)[2][0]) for t in sorted(set().union(*rows))]
        boxes = self.boxes[row]
        spend(self.work, len(boxes))
        return [t for t, left, right in boxes if left - REACH <= column <= right + REACH]

    def allows(self, row, column, is_drawn):
        """Whether a pixel may or may not be drawn within a pixel of the edges, whatever it shows."""
        found = [fragment for t in self.near(row, column) if (fragment := self.fragment(t, row, column, 0.0))]
        return bool(found) if is_drawn else not any(is_sure for _, is_sure in found)

    def could_show(self, row, column, is_drawn, z, tolerance, seen):
        """Whether the pixel may show what it does: a triangle (one of `seen`, unless that is None) with the
        depth z (unless that is None), or nothing."""
        fragments = [
            found for t in self.near(row, column) if (found := self.fragment(t, row, column, tolerance))]
        possible = [
            fragment for fragment, _ in fragments if fragment[2] >= self.front and fragment[1] < self.rear]
        options = kept([fragment for fragment, is_sure in fragments if is_sure], possible, "nearest")
        return any(
            (t >= 0) == is_drawn and (z is None or t < 0 or low <= z <= high) and (seen is None or t in seen)
            for t, low, high in options)


def shows_each(drawing, borders, is_other):
    """Whether the picture shows half of the visible pixels of each triangle that has one at least DEEP inside
    its outline, and any of all smaller ones. `is_other(row, column, triangle)` tells whether a pixel shows
    something else than the triangle that the drawing has there."""
    visible, agreeing, deep = collections.Counter(), collections.Counter(), set()
    for row in range(drawing.triangles.grid.height):
        for column, t in enumerate(drawing.row(row)[0]):
            if t >= 0:
                visible[t] += 1
                agreeing[t] += not is_other(row, column, t)
                if t not in deep and borders.inside(t, row, column) >= DEEP:
                    deep.add(t)
    small = visible.keys() - deep
    return all(2 * agreeing[t] >= visible[t] for t in deep) and (not small or any(agreeing[t] for t in small))


def runs(row):
    """(first, last) of each run of true values."""
    ends, first = [], None
    for column, value in enumerate([*row, False]):
        if value and first is None:
            first = column
        elif not value and first is not None:
            ends.append((first, column - 1))
            first = None
    return ends


def shift(drawing, drawn):
    """By how many columns the left and the right ends of the drawn pixels have moved, if both have moved the
    same way, each by more than SHIFT on average; else 0."""
    left, right = [], []
    width = drawing.width
    for row, theirs in enumerate(drawn):
        ours = [t >= 0 for t in drawing.row(row)[0]]
        a, b = runs(theirs), runs(ours)
        if len(a) == len(b):
            left += [p[0] - q[0] for p, q in zip(a, b) if min(p[0], q[0]) > 0 and abs(p[0] - q[0]) <= 2]
            right += [
                p[1] - q[1] for p, q in zip(a, b) if max(p[1], q[1]) < width - 1 and abs(p[1] - q[1]) <= 2]
    if min(len(left), len(right)) < LEAST_ENDS:
        return 0.0
    left, right = sum(left) / len(left), sum(right) / len(right)
    is_shift = min(left, right) > SHIFT or max(left, right) < -SHIFT
    return (left + right) / 2 if is_shift else 0.0


class BorderRule:
    """Whether the nearest of our two rules, with its Mismatch, explains all but borders. `context` is a
    pixel_comparing.Context of a picture."""

    def __init__(self, context, mismatch):
        self.context, self.mismatch, self.pixels = context, mismatch, context.shown.pixels()
        self.tolerance = context.shown.depths.tolerance if context.shown.depths else None
        self.drawing = context.drawing(mismatch.reading, mismatch.rule)
        self.borders = Borders(self.drawing.triangles, context.limits, context.work)

    @functools.cached_property
    def shift(self):
        return shift(self.context.drawing(self.context.first, Rule()), self.pixels.drawn)

    def beyond(self):
        """A Counter of the pixels that differ beyond REACH from the edges; None if they are too many."""
        mismatch, shapes = self.mismatch, len(self.mismatch.of_shape)
        # Where more differs than is drawn, these are not the borders of what there is to draw.
        if not self.pixels.drawn or mismatch.has_rows or shapes > mismatch.drawn:
            return None
        of_drawn = mismatch.drawn if shapes else 0  # where no border differs, no other rule holds there
        most = {
            "stray": MOST_STRAYS * shapes, "other": MOST_OTHERS * of_drawn, "depth": MOST_DEPTHS * of_drawn}
        if not self.shows_each_triangle():
            return None
        found = collections.Counter()
        for what in filter(None, map(self.place_beyond, mismatch.pixels)):
            found[what] += 1
            if found[what] > most[what]:
                return None
        return found

    def shows_each_triangle(self):
        return shows_each(self.drawing, self.borders, self.is_other)

    def is_other(self, row, column, t):
        """Whether a pixel shows something else than triangle t. A triangle whose pixels have the color and
        the depths of another is not shown."""
        mismatch, kind = self.mismatch, self.mismatch.pixels.get((row, column))
        if kind != "depth" or not self.pixels.colors:
            return kind is not None
        if not self.pixels.depths[row]:  # it is open whose depth differs
            return False
        color, z = self.pixels.colors[row][column], self.pixels.depths[row][column]
        if mismatch.colors.get(t) == color and t not in mismatch.unplaced:
            return False
        tolerance, same = self.tolerance(z), mismatch.of_color(color)
        return not self.borders.has(t, row, column, z, tolerance) and any(
            self.borders.has(other, row, column, z, tolerance)
            for other in self.borders.near(row, column) if other in same and other != t)

    def place_beyond(self, place):
        """`stray` if a pixel is drawn, or not, farther than a pixel from the edges, or has a depth beyond the
        limits; `other` if it shows a triangle that is not within a pixel, `depth` a depth that its triangle
        does not have there; else empty."""
        (row, column), kind, borders, pixels = place, self.mismatch.pixels[place], self.borders, self.pixels
        is_drawn = pixels.drawn[row][column]
        z = pixels.depths[row][column] if pixels.depths and pixels.depths[row] else None
        tolerance = self.tolerance(z) if z is not None else 0.0
        seen = self.mismatch.of_color(pixels.colors[row][column]) if is_drawn else None
        if borders.could_show(row, column, is_drawn, z, tolerance, seen):
            return ""
        front, rear = self.context.limits
        is_kept = z is None or front - tolerance <= z < rear + tolerance
        is_shape = kind in ("extra", "missing")
        if not is_kept or is_shape and not borders.allows(row, column, is_drawn):
            return "stray"
        if is_shape:
            return ""
        return "depth" if borders.could_show(row, column, is_drawn, None, tolerance, seen) else "other"
