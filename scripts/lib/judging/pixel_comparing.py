"""Compares the pixels of a hand-in with those that its triangles give under a rule."""
import collections
import dataclasses
import functools
import itertools
import math

from lib.judging import pixel_rules
from lib.judging.raster import Drawing, Grid, Rule, Triangles, spend
from lib.judging.shown import DEPTH_BASE

PIXELS_LOOKED_AT = 30_000  # limits how many differing pixels are checked for all they show
# Pixels of triangles and spans that are looked at, in the search for a cause and for the rules that are open.
# They are counted: seconds would make a verdict depend on the machine.
MOST_WORK, MOST_OPEN_WORK = 10_000_000, 60_000_000


@dataclasses.dataclass
class Mismatch:
    """The pixels that a rule does not explain: {(row, column): extra, missing, other or depth}."""
    rule: Rule
    reading: str
    pixels: dict = dataclasses.field(default_factory=dict)
    drawn: int = 0  # pixels with a triangle, by the rule
    doubtful: int = 0  # pixels that fit only thanks to the rule's uncertainty
    areas: collections.Counter = dataclasses.field(default_factory=collections.Counter)  # of each triangle
    offsets: dict = dataclasses.field(default_factory=dict)  # of depths, at these pixels
    colors: dict = dataclasses.field(default_factory=dict)  # of each triangle, by the majority of its pixels
    visible: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    owners: dict = dataclasses.field(default_factory=dict)  # by the rule, of these pixels
    triangle_count: int = 0
    has_rows: bool = False  # of which the number of depths differs, each as one pixel

    def count(self, *kinds):
        return sum(kind in kinds for kind in self.pixels.values())

    @property
    def compared(self):
        """How many pixels show a triangle, by the rule or in the hand-in."""
        return self.drawn + sum(place not in self.owners for place in self.pixels)

    @functools.cached_property
    def by_color(self):
        """{color: the triangles that have it}, once all colors are known."""
        found = collections.defaultdict(set)
        for t, color in self.colors.items():
            found[color].add(t)
        return found

    @functools.cached_property
    def unplaced(self):
        """The triangles that share their color with a larger one, or show no pixel."""
        largest = {max(group, key=lambda t: self.visible[t]) for group in self.by_color.values()}
        return set(range(self.triangle_count)) - largest

    def of_color(self, color):
        """The triangles that a color may stand for: those that have it, else all without one of their own."""
        return self.by_color.get(color) or self.unplaced

    def of(self, kind):
        """The pixels that differ in the depths or in the picture."""
        own = "other" if kind == "picture" else "depth"
        return [place for place, found in self.pixels.items() if found in ("extra", "missing", own)]


@dataclasses.dataclass
class Context:
    """All that rules are compared by."""
    readings: dict  # {name: (points, units)}: the numbers of the file, those in memory, and the right ones
    window: object  # a lib.maths.window.Window
    shown: object  # the files, as a lib.judging.shown.Shown
    borders_first: bool = False
    is_one_of_two: bool = False
    triangles: dict = dataclasses.field(default_factory=dict)
    left: list = dataclasses.field(default_factory=lambda: [MOST_WORK])  # of the search for a cause

    def __post_init__(self):
        self.first, self.work = next(iter(self.readings)), [MOST_OPEN_WORK]
        self.unlimited = functools.cache(lambda *tried: Attempt(self, *tried).mismatch(math.inf))
        self.limits = float(self.window.front), float(self.window.rear)

    def of_one_file(self, kind):
        """The Context of the depths, or of the picture, alone. The search in both has one limit."""
        return dataclasses.replace(self, shown=self.shown.only(kind), is_one_of_two=True)

    @functools.cached_property
    def open_rules(self):
        return pixel_rules.open_rules(self.window, self.readings, bool(self.shown.depths))

    @functools.cached_property
    def mistakes(self):
        """Those of pixel_rules.MISTAKES that can make a difference here."""
        can_matter = pixel_rules.can_matter
        return [one for one in pixel_rules.MISTAKES if can_matter(one[1], self.window, self.shown)]

    @functools.cached_property
    def plain(self):
        """The Mismatch of our own rule."""
        return self.compare(self.first, Rule())

    def drawing(self, reading, rule):
        kind = rule.half_x, rule.half_y, rule.is_one_less
        key = reading, rule.window, kind, rule.corners
        if key not in self.triangles:
            window = self.window
            corner = {"one": (-1, -1), "exchanged": (window.bottom, window.left)}.get(
                rule.window, (window.left, window.bottom))
            grid = Grid(window.width, window.height, *map(float, corner), *kind)
            self.triangles[key] = Triangles(*self.readings[reading], grid, rule.corners)
        limits = (-1.0, 1.0) if rule.is_depth_one else self.limits
        return Drawing(self.triangles[key], rule, limits, self.work)

    def explained(self, reading, rule, rows):
        """The empty Mismatch of a rule that explains everything, else None. `rows` are looked at first."""
        return None if Attempt(self, reading, rule).count(rows, 0) else self.compare(reading, rule, limit=0)

    def compare(self, reading, rule, limit=math.inf):
        """The Mismatch of a rule; None if more than `limit` pixels are not explained."""
        tried = reading, rule
        return self.unlimited(*tried) if limit == math.inf else Attempt(self, *tried).mismatch(limit)


class Attempt:
    """A rule, tried on one of the readings."""
    def __init__(self, context, reading, rule):
        self.reading, self.rule, self.width = reading, rule, context.window.width
        self.height, self.rear, self.depths = context.window.height, context.limits[1], context.shown.depths
        self.drawing = context.drawing(reading, rule)
        self.pixels = context.shown.pixels(rule.picture_flip, rule.text_flip)
        self.budget, self.background, self.doubtful = PIXELS_LOOKED_AT, context.shown.background, 0

    @property
    def has_torn_rows(self):
        """True if the text, flipped back, has another number of depths in a row than the picture."""
        pixels = self.pixels
        return bool(self.rule.text_flip and pixels.listed) and (not any(pixels.listed) or bool(pixels.drawn)
                                                                and None in pixels.depths)

    def could_show(self, row, column, is_drawn, z, triangles=None):
        """True if a pixel could show this after all; False once the budget is spent."""
        self.budget -= 1
        slack = self.depths.tolerance(z) if z is not None else 0.0
        return self.budget > 0 and any(
            (t >= 0) == is_drawn and (z is None or low <= z <= high) and (triangles is None or t in triangles)
            for t, low, high in self.drawing.could_show(row, column, slack))

    def differences(self, row, drawn_row=None):
        """(column, kind) of each pixel of a row, as drawn, that the rule does not explain, colors aside."""
        owner, depth, columns = drawn_row or self.drawing.row(row)
        spend(self.drawing.work, self.width)
        depths, seen = self.pixels.depths[row] if self.pixels.depths else None, self.pixels.seen[row]
        if self.pixels.depths and depths is None:
            yield from self.differences_of_list(row, (owner, depth, columns), self.pixels.listed[row])
        if not seen:
            return
        drawn, others = seen
        tolerance = self.depths.tolerance if depths else None
        for column in range(min(columns.start, others.start), max(columns.stop, others.stop)):
            t, is_drawn = owner[column], drawn[column]
            if t < 0 and not is_drawn:
                continue
            z = depths[column] if depths and is_drawn else None
            if (t >= 0) == is_drawn and (z is None or abs(z - depth[column]) <= DEPTH_BASE
                                         or abs(z - depth[column]) <= tolerance(z)):
                continue
            if not self.could_show(row, column, is_drawn, z):
                yield column, "extra" if t < 0 else "missing" if not is_drawn else "depth"
            elif (t >= 0) != is_drawn:
                self.doubtful += 1

    def differences_of_list(self, row, drawn_row, listed):
        """The same without a pixel for each depth: the depths of a row in their order, all or only the ones
        before the rear limit. A column beyond the picture stands for the whole row."""
        owner, depth, columns = drawn_row
        expected = [(column, depth[column]) for column in columns if owner[column] >= 0]
        if len(expected) > len(listed):
            expected = [(column, z) for column, z in expected if z < self.rear]
        if len(expected) != len(listed):
            yield self.width, "depth"
            return
        for (column, z), given in zip(expected, listed):
            if abs(z - given) > self.depths.tolerance(z) and not self.could_show(row, column, True, given):
                yield column, "depth"

    def count(self, rows, most):
        """How many pixels of some rows are not explained, up to most + 1, as in a row of another length."""
        unexplained = (most + 1 if column == self.width else 1 for row in rows
                       for column, _ in self.differences(row))
        return sum(itertools.islice(unexplained, most + 1))

    def mismatch(self, limit):
        """The Mismatch; None if more than `limit` pixels are not explained."""
        drawing, pixels = self.drawing, self.pixels
        result = Mismatch(self.rule, self.reading, triangle_count=len(drawing.triangles.corners))
        pairs = collections.Counter()
        for row in range(self.height):
            owner, depth, columns = drawn_row = drawing.row(row)
            part = slice(columns.start, columns.stop)
            result.areas.update(owner[part])
            for column, kind in self.differences(row, drawn_row):
                result.pixels[row, column] = kind
                if column == self.width:
                    result.has_rows = True
                    continue
                if owner[column] >= 0:
                    result.owners[row, column] = owner[column]
                if kind == "depth":
                    z = pixels.depths[row][column] if pixels.depths[row] else None
                    result.offsets[row, column] = abs(z - depth[column]) if z is not None else 0.0
            if len(result.pixels) > limit:
                return None
            if pixels.colors:
                pairs.update(zip(owner[part], pixels.colors[row][part]))
        del result.areas[-1]
        result.drawn, result.doubtful = sum(result.areas.values()), self.doubtful
        for t, color in [*pairs]:
            if t < 0 or color == self.background:
                del pairs[t, color]
        self.add_colors(result, pairs, limit)
        return result if len(result.pixels) <= limit else None

    def add_colors(self, result, pairs, limit):
        """Gives every triangle the color that most of its pixels have, and adds the pixels that show another
        triangle, until there are more than `limit`. `pairs` counts (triangle, color)."""
        for (t, color), count in reversed(pairs.most_common()):
            result.colors[t] = color
            result.visible[t] += count
        if all(result.colors[t] == color for t, color in pairs):
            return
        for row in range(self.height):
            if len(result.pixels) > limit:
                return
            owner, _, columns = self.drawing.row(row)
            depths = self.pixels.depths[row] if self.pixels.depths else None
            colors, drawn = self.pixels.colors[row], self.pixels.drawn[row]
            for column in columns:
                t, color = owner[column], colors[column]
                if t < 0 or not drawn[column] or result.colors[t] == color or (row, column) in result.pixels:
                    continue
                z = depths[column] if depths else None
                if not self.could_show(row, column, True, z, result.of_color(color)):
                    result.pixels[row, column], result.owners[row, column] = "other", t
