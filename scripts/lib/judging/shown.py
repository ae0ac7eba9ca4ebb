"""The depths and the picture of a hand-in, pixel by pixel."""
import collections
import copy
import dataclasses
import functools
import itertools

from lib.judging.points import EXACT, Digits, digits_of
from lib.rim.command import shown as printable
from lib.showing.pictures import picture_of
from lib.text.plain_stage_text import real
from lib.text.stage_text import StageTextError, text_of

LEAST_EMPTY = 0.01  # the share of pixels with depth 0 from which 0 stands for an empty pixel
DEPTH_BASE = 2e-6  # for depths of 6 decimals, calculated from numbers of 7; times their size beyond 1
FLIPS = {
    "": lambda rows: rows, "upside down": lambda rows: rows[::-1],
    "mirrored": lambda rows: [row[::-1] for row in rows],
    "turned": lambda rows: [row[::-1] for row in rows[::-1]], "transposed": lambda rows: list(zip(*rows))}
# What each pixel shows, row by row: `drawn`, whether a triangle, and `colors`, both None without a picture,
# and `depths`: a row is None if its numbers' pixels are unknown; `listed` has them. `seen` pairs `drawn`
# (without a picture, the pixels with depths) with the range of columns that show any; None if unknown.
Pixels = collections.namedtuple("Pixels", "drawn colors depths listed seen")


@dataclasses.dataclass
class Depths:
    """Rows of depths, as far as a text prints them."""
    rows: list
    digits: Digits = EXACT

    def tolerance(self, z):
        return max(DEPTH_BASE * max(1.0, abs(z)), self.digits.unit(z))


def depth_rows(text, name):
    """Rows of depths, one a line; raises a StageTextError."""
    rows, number_of = [], functools.cache(real)
    for number, line in enumerate(text.split("\n"), 1):
        try:
            rows.append([*map(number_of, line.split())])
        except ValueError:
            raise StageTextError(
                f"{name}:{number}: expected depths, found '{printable(line.strip()[:40])}'") from None
    while rows and not rows[-1]:  # rows at the end may be empty
        rows.pop()
    return rows


def read_depths(data, name):
    text = text_of(data, name)
    return Depths(depth_rows(text, name), digits_of({*text.split()}))


def read_colors(data, name, size, background):
    """Rows of colors, three bytes each, of a picture of a given (width, height) over the background."""
    rows = picture_of(data, name, background, size)[2]
    return [[row[i:i + 3] for i in range(0, 3 * size[0], 3)] for row in rows]


class Rows:
    """A sequence whose rows are made on demand: most rules fail in the first row."""
    def __init__(self, make, count):
        self.make, self.count = functools.cache(make), count

    def __getitem__(self, row):
        if row >= self.count:
            raise IndexError
        return self.make(row)


class Shown:
    """A hand-in's picture (rows of colors, or None) and Depths (or None). `is_uncovered` makes rows with
    True for each pixel that no triangle covers."""
    def __init__(self, colors, depths, window, is_uncovered):
        self.colors, self.depths, self.pixels = colors, depths, functools.cache(self.pixels)
        self.width, self.height, self.rear = width, height, rear = window.width, window.height, float(
            window.rear)
        self.is_full = depths is not None and [*map(len, depths.rows)] == [width] * height
        most = max((z for row in depths.rows for z in row), default=rear) if depths else rear
        is_empty = self.is_full and (most >= rear - depths.tolerance(rear)
                                     or most == 0 and self.counted(0.0) > width * height * LEAST_EMPTY)
        self.empty = most if is_empty else None  # the depth of pixels without a triangle, if they are printed
        self.background = self.find_background(is_uncovered) if colors else None

    def but(self, **fields):
        """A Shown with some fields changed."""
        changed = copy.copy(self)
        vars(changed).update(fields, pixels=functools.cache(functools.partial(Shown.pixels, changed)))
        return changed

    def only(self, kind):
        """A Shown without the picture, or without the depths."""
        return self.but(colors=None) if kind == "depths" else self.but(depths=None, is_full=False)

    def in_one_color(self):
        """A Shown with one color for all pixels that show a triangle."""
        ground, color = self.background, bytes(255 - x for x in self.background)
        return self.but(colors=[[ground if own == ground else color for own in row] for row in self.colors])

    @property
    def own_colors(self):
        """The colors of a picture without the background."""
        return set().union(*self.colors) - {self.background}

    @property
    def blank(self):
        """{kind: whether it shows no triangle} of the depths and the picture, as far as they are given."""
        found = {"picture": not self.own_colors} if self.colors else {}
        if self.depths:
            depths = itertools.chain(*self.depths.rows)
            found["depths"] = all(self.empty is not None and z >= self.empty for z in depths)
        return found

    def counted(self, z):
        return sum(row.count(z) for row in self.depths.rows)

    def find_background(self, is_uncovered):
        """The color without a triangle: the color of as many pixels as have no depth. If there is none: black
        or, in a picture without black, the color where no triangle is visible."""
        counts, black = collections.Counter(itertools.chain(*self.colors)), bytes(3)
        if self.depths:
            count = self.width * self.height - sum(map(len, self.depths.rows))
            bare = count if self.empty is None else self.counted(self.empty)
            if fitting := [color for color in (black, *counts) if counts[color] == bare]:
                return fitting[0]
        if counts[black]:
            return black
        seen = collections.Counter(color for row, places in zip(self.colors, is_uncovered())
                                   for color, is_bare in zip(row, places) if is_bare)
        return seen.most_common(1)[0][0] if seen else black

    def pixels(self, picture_flip="", text_flip=""):
        """The Pixels, if picture and text are flipped back."""
        colors = FLIPS[picture_flip](self.colors) if self.colors else None
        drawn = colors and Rows(lambda r: [color != self.background for color in colors[r]], len(colors))
        listed = self.listed_rows(text_flip, drawn) if self.depths else None
        depths = listed and Rows(lambda r: self.aligned(drawn[r] if drawn else None, listed[r]), self.height)

        def seen(row):
            shown = drawn[row] if drawn else depths[row] and [z is not None for z in depths[row]]
            if not shown or True not in shown:
                return shown and (shown, range(self.width, 0))
            return shown, range(shown.index(True), self.width - shown[::-1].index(True))

        return Pixels(drawn, colors, depths, listed, Rows(seen, self.height))

    def listed_rows(self, flip, drawn):
        rows = self.depths.rows
        if flip == "transposed" and not self.is_full:
            if [len(row) for row in rows] == [self.height] * self.width:
                return list(zip(*rows))
            missing = [0] * (self.width - len(rows))
            if not drawn or list(map(len, rows)) + missing != list(map(sum, zip(*drawn))):
                return [[]] * self.height
            columns = list(map(iter, rows))
            return [[next(columns[c]) for c, is_drawn in enumerate(row) if is_drawn] for row in drawn]
        if drawn and len(rows) != self.height and sum(map(len, rows)) == sum(map(
                sum, drawn)):  # empty rows were left out
            values = iter([z for row in rows for z in row])
            rows = [[next(values) for is_drawn in row if is_drawn] for row in FLIPS[flip]([*drawn])]
        rows = rows[:self.height] + [[]] * (self.height - len(rows))
        return FLIPS[flip](rows)

    def aligned(self, drawn, listed):
        """The depth of each pixel of a row, None where none is drawn; or None if it is not determined."""
        if self.is_full:
            return [None if self.empty is not None and z >= self.empty else z for z in listed]
        if drawn is None or sum(drawn) != len(listed):
            return None
        values = iter(listed)
        return [next(values) if is_drawn else None for is_drawn in drawn]
