"""Another rule at the borders: each pixel that differs has to show a triangle or the background that lies
within REACH of it, across an edge or the line where two triangles meet."""
import collections
import functools
import math

from lib.judging.raster import kept, spend

REACH = 1.5  # pixels between a pixel that differs and the place that it shows
DEPTH_REACH = 1.0  # pixels along which the depth of a triangle may be taken


class BorderRule:
    """What a pixel may show if its center may move by REACH: triangles in pixels, beside the Mismatch of
    the nearest of our two rules in a picture's pixel_comparing.Context."""
    def __init__(self, context, mismatch):
        self.mismatch, self.pixels = mismatch, context.shown.pixels()
        self.tolerance = context.shown.depths.tolerance if context.shown.depths else lambda z: 0.0
        self.drawing = context.drawing(mismatch.reading, mismatch.rule)
        self.triangles = self.drawing.triangles
        self.plane, self.boxes = functools.cache(self.plane), functools.cache(self.boxes)

    def plane(self, t):
        """A triangle in pixels: its edges as (a, b, c) with a column + b row + c the distance from the
        inside, its depth as (per column, per row, at 0 0), and the ranges of its columns, rows and depths."""
        grid = self.triangles.grid
        corners = [(grid.column_at(x), grid.row_at(y), z) for x, y, z in self.triangles.corners[t]]
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = corners
        area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        box = [(min(values), max(values)) for values in zip(*corners)]
        if not self.triangles.winding(t):
            return None, (0.0, 0.0, 0.0), box
        per_column = ((bz - az) * (cy - ay) - (cz - az) * (by - ay)) / area
        per_row = ((cz - az) * (bx - ax) - (bz - az) * (cx - ax)) / area
        depth = per_column, per_row, az - per_column * ax - per_row * ay
        edges = []
        for (px, py, _), (qx, qy, _) in zip(corners, corners[1:] + corners[:1]):
            length = math.copysign(math.hypot(qx - px, qy - py), area)
            a, b = (py - qy) / length, (qx - px) / length
            edges.append((a, b, -(a * px + b * py)))
            if abs(area) < REACH * abs(length):
                return None, depth, box
        return edges, depth, box

    def fragment(self, t, row, column, tolerance):
        """(triangle, least depth, largest depth) and whether it is there for certain; None out of reach."""
        edges, (per_column, per_row, at_0), (of_x, of_y, of_z) = self.plane(t)
        if not (of_x[0] - REACH <= column <= of_x[1] + REACH and of_y[0] - REACH <= row <= of_y[1] + REACH):
            return None
        slope = abs(per_column) + abs(per_row)
        if edges is None:
            # Thinner than a pixel: where it is drawn and which depth is extrapolated are open.
            slack = slope * REACH + tolerance
            return (t, of_z[0] - slack, of_z[1] + slack), False
        inside = self.inside(t, row, column)
        if inside < -REACH:
            return None
        z = per_column * column + per_row * row + at_0
        slack = slope * max(DEPTH_REACH, -inside) + tolerance  # outside, it may be the depth of the edge
        low, high = z - slack, z + slack
        return (t, low, high), inside >= REACH and low >= self.drawing.front and high < self.drawing.rear

    def inside(self, t, row, column):
        """The pixels from a center to a triangle's outline; below 0 outside, and in thin triangles."""
        edges = self.plane(t)[0]
        return -REACH if edges is None else min(a * column + b * row + c for a, b, c in edges)

    def boxes(self, row):
        """The triangles on a row or beside it, each with its first and its last column."""
        rows = self.triangles.rows[max(row - 1, 0):row + 2]
        return [(t, *self.plane(t)[2][0]) for t in sorted(set().union(*rows))]

    def near(self, row, column):
        """The triangles on this row or beside it that come within REACH of the column."""
        boxes = self.boxes(row)
        spend(self.drawing.work, len(boxes))
        return [t for t, left, right in boxes if left - REACH <= column <= right + REACH]

    @property
    def explains_all(self):
        """True if nothing but borders differs."""
        # If more pixels differ than are drawn, they are not only borders.
        mismatch = self.mismatch
        return bool(self.pixels.drawn) and not mismatch.has_rows and (
            mismatch.count("extra", "missing") <= mismatch.drawn and self.shows_each_triangle
            and all(map(self.is_within_reach, mismatch.pixels)))

    @property
    def shows_each_triangle(self):
        """True if the picture shows at least half the visible pixels of each triangle with a pixel at least
        REACH inside its outline and, if there are smaller triangles, a pixel of one of them."""
        visible, agreeing, deep = collections.Counter(), collections.Counter(), set()
        for row in range(self.triangles.grid.height):
            for column, t in enumerate(self.drawing.row(row)[0]):
                if t >= 0:
                    visible[t] += 1
                    agreeing[t] += not self.is_other(row, column, t)
                    if t not in deep and self.inside(t, row, column) >= REACH:
                        deep.add(t)
        small = visible.keys() - deep
        return all(2 * agreeing[t] >= visible[t] for t in deep) and (not small or any(agreeing[t]
                                                                                      for t in small))

    def is_other(self, row, column, t):
        """True if a pixel shows no triangle t: it may have the color and the depth of another one."""
        mismatch, kind = self.mismatch, self.mismatch.pixels.get((row, column))
        if kind != "depth" or not self.pixels.colors:
            return kind is not None
        if not self.pixels.depths[row]:  # which pixel differs is open
            return False
        color, z = self.pixels.colors[row][column], self.pixels.depths[row][column]
        if mismatch.colors.get(t) == color and t not in mismatch.unplaced:
            return False
        others = self.mismatch.of_color(color) & {*self.near(row, column)} - {t}
        found = [self.fragment(one, row, column, self.tolerance(z)) for one in (t, *others)]
        is_there, *are_there = (one is not None and one[0][1] <= z <= one[0][2] for one in found)
        return not is_there and any(are_there)

    def is_within_reach(self, place):
        """True if a triangle, of the pixel's color if it has one, could show the same within REACH."""
        (row, column), pixels, drawing = place, self.pixels, self.drawing
        is_drawn = pixels.drawn[row][column]
        z = pixels.depths[row][column] if pixels.depths and pixels.depths[row] else None
        seen = self.mismatch.of_color(pixels.colors[row][column]) if is_drawn else (-1,)
        found = [self.fragment(t, row, column, self.tolerance(z or 0.0)) for t in self.near(row, column)]
        found = [*filter(None, found)]
        possible = [one for one, _ in found if one[2] >= drawing.front and one[1] < drawing.rear]
        options = kept([one for one, is_sure in found if is_sure], possible, "nearest")
        return any(t in seen and (z is None or t < 0 or low <= z <= high) for t, low, high in options)
