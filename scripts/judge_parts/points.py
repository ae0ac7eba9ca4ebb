"""The points of a stage text with the digits it shows, and how far they may lie from what is expected."""
import dataclasses
import math

from judge_parts.digits import EXACT, Digits, digits_of
from lib.stage_text import parse_stage_text, text_of

BASE = 1e-6     # numbers of 7 decimals that were calculated from numbers of 7 decimals; times their size beyond 1
MOST_UNDECIDED = 0.1  # of the numbers, for example where a point would be divided by 0


@dataclasses.dataclass
class Points:
    """The points of a stage text, three for each triangle. `units` is what a unit in the last digit of each coordinate is worth."""
    points: list
    lines: list
    digits: Digits = EXACT

    def __len__(self):
        return len(self.points)

    @property
    def units(self):
        return [tuple(map(self.digits.unit, p)) for p in self.points]


def read_points(data, name):
    """The Points of a stage text; raises a StageTextError."""
    text = text_of(data, name)
    vertices = parse_stage_text(text, name).vertices
    lines = text.split("\n")
    words = [word for vertex in vertices for word in lines[vertex.line - 1].split("#")[0].split()[:3]]
    return Points([vertex.numbers[:3] for vertex in vertices], [vertex.line for vertex in vertices], digits_of(words))


def printed_tolerance(p, digits):
    """How far printing may move the coordinates of a point: by a unit in the last digit of its largest coordinate."""
    size = max(map(abs, p))
    if not math.isfinite(size):
        return math.inf
    return max(BASE * max(1.0, size), digits.unit(size))


@dataclasses.dataclass
class Difference:
    """How points differ from what is expected; `first` and `largest` are (index of the point, axis, theirs, expected)."""
    differing: int = 0
    compared: int = 0
    first: tuple = None
    largest: tuple = None

    @property
    def first_triangle(self):
        return None if self.first is None else self.first[0] // 3


def is_off(a, b, tolerance):
    """Whether a differs from b; whatever is not finite on our side decides nothing."""
    return math.isfinite(b) and abs(a - b) > tolerance


def differs(theirs, digits, expected):
    """Whether any point differs from the expected (point, slacks of its coordinates), which are drawn one by one; also if too many
    of those decide nothing."""
    undecided = 0
    for p, (q, slacks) in zip(theirs, expected):
        printed = printed_tolerance(q, digits)
        for a, b, slack in zip(p, q, slacks):
            if is_off(a, b, printed + slack):
                return True
            undecided += not (math.isfinite(b) and math.isfinite(slack))
    return undecided > MOST_UNDECIDED * 3 * len(theirs)


def difference(theirs, digits, expected):
    """The Difference from the expected (point, slacks)."""
    result = Difference()
    for i, (p, (q, slacks)) in enumerate(zip(theirs, expected)):
        printed = printed_tolerance(q, digits)
        for axis, (a, b, slack) in enumerate(zip(p, q, slacks)):
            result.compared += 1
            if is_off(a, b, printed + slack):
                result.differing += 1
                pair = (i, axis, a, b)
                result.first = result.first or pair
                if result.largest is None or abs(a - b) > abs(result.largest[2] - result.largest[3]):
                    result.largest = pair
    return result


def described(pair, lines):
    """A difference with its location."""
    i, axis, a, b = pair
    return f"{abs(a - b):.3g}, line {lines[i]}, {'xyz'[axis]} of vertex {i % 3 + 1} of triangle {i // 3}: {a:.10g} and {b:.10g}"
