"""The points of a stage text, how far they may lie from the expected ones, and lines that do not belong;
a tolerance can only come from the digits that a text shows."""
import dataclasses
import math
import statistics
from decimal import Decimal

from lib.judging.pixel_words import counted
from lib.rim.command import shown
from lib.text.plain_stage_text import real
from lib.text.scene import SETTINGS
from lib.text.stage_text import StageTextError, begins_with_a_camera, is_scene, parse_stage_text, text_of

# numbers of 7 decimals that were calculated from numbers of 7 decimals; times their size beyond 1
BASE = 1e-6
MORE = "only x, y and z are judged, not the numbers behind them"
MOST_UNDECIDED = 0.1  # of the numbers, for example where a point would be divided by 0
WORDS = {  # that begin header lines
    "eye", "look", "up", "perspective", "ortho", "frustum", "projected", "framed", "end", "triangle",
    "clipped", "error", "sphere", *SETTINGS}
LONGEST = 40  # characters of a line, as shown
LEAST_DIGITS = 3
FINEST = 17  # significant digits, of a double


@dataclasses.dataclass(frozen=True)
class Digits:
    """`decimals` is the count of every number, or None if counts differ or are 0; `significant` is the count
    of the largest number's significant digits or, with None, the most of any number."""
    decimals: int
    significant: int
    largest: float = 1.0

    def unit(self, x):
        """The value of one unit in the last digit of x."""
        if self.decimals is not None:
            return 10.0**-self.decimals
        return 10.0**(exponent_of(x) - self.significant + 1) if x else 0.0

    @property
    def are_too_few(self):
        """True if the largest number shows fewer significant digits than LEAST_DIGITS."""
        count = self.significant if self.decimals is None else (exponent_of(self.largest) +
                                                                bool(self.largest) + self.decimals)
        return count < LEAST_DIGITS

    def __str__(self):
        if self.decimals is None:
            return counted(self.significant, "significant digit")
        return counted(self.decimals, "decimal")


EXACT = Digits(None, FINEST)


def exponent_of(x):
    return math.floor(math.log10(abs(x))) if x else 0


def digits_of(words):
    """The Digits of the words of a text's numbers."""
    largest = max((abs(float(word)) for word in words), default=0.0)
    numbers = [(word, Decimal(word).as_tuple()) for word in words]
    decimals = {None if "e" in word.lower() else -number.exponent for word, number in numbers}
    fixed = min(decimals.pop() or 0, FINEST) if len(decimals) == 1 else 0
    significant = exponent_of(largest) + 1 + fixed if fixed else max(
        (len(number.digits) for _, number in numbers), default=0)
    return Digits(fixed or None, max(1, min(significant, FINEST)), largest)


def share_digits(texts):
    """Corrects the Digits of texts that one program printed: numbers such as 0.5 show as many digits as they
    have, in a text whose program does not print trailing zeros."""
    most = max((text.digits.significant for text in texts if text.digits.decimals is None), default=0)
    for text in texts:
        if text.digits.decimals is None or text.digits.significant < most:
            text.digits = Digits(None, most, text.digits.largest)


@dataclasses.dataclass
class Points:
    """The points of a stage text, three a triangle; `units` are the units in the last digits of each."""
    points: list
    lines: list
    digits: Digits = EXACT
    header: dict = dataclasses.field(default_factory=dict)
    remarks: list = dataclasses.field(default_factory=list)  # on lines and numbers that are not judged

    def __len__(self):
        return len(self.points)

    @property
    def units(self):
        return [tuple(map(self.digits.unit, p)) for p in self.points]


def read_points(data, name):
    """The Points of a stage text; raises a StageTextError."""
    text = text_of(data, name)
    strays = strays_of(text)
    try:
        parsed = parse_stage_text(text, name)
    except StageTextError as error:
        # In a text of another kind no line is a stray one.
        is_other = is_scene(text) or begins_with_a_camera(text)
        is_the_one = not strays or strays.startswith("1 line is ")  # the one that the error is about
        raise StageTextError(str(error) if is_the_one or is_other else f"{error}; {strays}") from None
    lines, vertices = text.split("\n"), parsed.vertices
    words = [word for vertex in vertices for word in lines[vertex.line - 1].split("#")[0].split()[:3]]
    more = MORE if any(len(vertex.numbers) > 3 for vertex in vertices) else ""
    return Points([vertex.numbers[:3] for vertex in vertices], [vertex.line for vertex in vertices],
                  digits_of(words), parsed.header, [*filter(None, (strays, more))])


def dropped(before, after):
    """A remark on the line `attributes` of a stage's input, or its numbers, if the output lacks it; a list of
    at most one."""
    if before is None or "attributes" not in before.header or MORE not in before.remarks:
        return []
    parts = ["the line 'attributes'"] * ("attributes" not in after.header)
    parts += ["the numbers after x, y and z"] * (MORE not in after.remarks)
    return [f"it drops {' and '.join(parts)}: colors or light are lost"] if parts else []


def holds_enough(points, exact):
    """True if points have enough places to show the next stage's mistakes: a quarter of the exact ones, and
    at least three."""
    exact, points = ([p for p in some if all(map(math.isfinite, p))] for some in (exact, points))
    if not exact:
        return True
    middle = [statistics.median(axis) for axis in zip(*exact)]
    step = statistics.median(max(abs(x - m) for x, m in zip(p, middle)) for p in exact) / 500
    expected, found = (len({tuple(x / step // 1 for x in p)
                            for p in some}) if step else len(set(map(tuple, some)))
                       for some in (exact, points))
    return found >= max(expected / 4, min(expected, 3))


def printed_tolerance(p, digits):
    """How far printing may move coordinates: by a unit in the last digit of the point's largest one."""
    size = max(map(abs, p))
    if not math.isfinite(size):
        return math.inf
    return max(BASE * max(1.0, size), digits.unit(size))


def is_off(a, b, tolerance):
    """True if a differs from b; a number of ours that is not finite decides nothing."""
    return math.isfinite(b) and abs(a - b) > tolerance


def off(theirs, digits, expected, axes=range(3)):
    """(index of the point, axis, theirs, expected) of each coordinate that is off from the expected (point,
    slacks of its coordinates), which are taken one by one; where our number decides nothing, it is nan."""
    for i, (p, (q, slacks)) in enumerate(zip(theirs, expected)):
        printed = printed_tolerance(q, digits)
        for axis in axes:
            if not math.isfinite(q[axis] + slacks[axis]):
                yield i, axis, p[axis], math.nan
            elif is_off(p[axis], q[axis], printed + slacks[axis]):
                yield i, axis, p[axis], q[axis]


def differs(theirs, digits, expected, axes=range(3)):
    """True if any point is off on some axes; also if too many of its numbers decide nothing."""
    undecided = 0
    for *_, b in off(theirs, digits, expected, axes):
        if not math.isnan(b):
            return True
        undecided += 1
    return undecided > MOST_UNDECIDED * len(axes) * len(theirs)


def differences(theirs, digits, expected):
    """All coordinates that are off for certain."""
    return [found for found in off(theirs, digits, expected) if not math.isnan(found[-1])]


def described(found, lines):
    """A coordinate that is off with its location: their number, and ours."""
    i, axis, a, b = found
    return (f"line {lines[i]}, {'xyz'[axis]} of vertex {i % 3 + 1} of triangle {i // 3}: {a:.10g} in place "
            f"of {b:.10g}, off by {abs(a - b):.3g}")


def strays_of(text):
    """Names the lines that do not belong in a stage text, whose triangles may stand between blank lines."""
    lines, vertices, long, strays = text.split("\n"), [[]], [], []
    may_be_long = any(line.split()[:1] == ["attributes"] for line in lines)
    for number, line in enumerate(lines, 1):
        words = line.split("#")[0].split()
        if not line.strip():
            vertices.append([])
        if not words or words[0] in WORDS:
            continue
        try:
            count = len([*map(real, words)])
        except ValueError:
            count = 0
        (strays if count < 3 else vertices[-1]).append(number)
        if count > 3 and not may_be_long:
            long.append(number)
    blocks = [*filter(None, vertices)]
    is_of_each = len(blocks) > 1 and strays and len(strays) % len(blocks) == 0
    each = f", {len(strays) // len(blocks)} for each triangle" if is_of_each else ""

    def quoted(number):
        return f"line {number}, '{shown(lines[number - 1].strip()[:LONGEST])}'"

    torn = [block for block in blocks if len(block) % 3]
    remarks = ((strays, "1 line is", "lines are", f"neither a vertex nor a header line{each}",
                quoted), (long, "1 vertex line has", "vertex lines have",
                          "more than three numbers, of which the first three count", quoted),
               (torn, "a triangle (between blank lines) has",
                f"of {len(blocks)} triangles (between blank lines) have",
                "another number of vertices than three",
                lambda block: f"the one in line {block[0]}, {len(block)}"))
    return "; ".join(
        (f"{len(some)} {many} {words}: first " if len(some) > 1 else f"{one} {words}: ") + first(some[0])
        for some, one, many, words, first in remarks if some)
