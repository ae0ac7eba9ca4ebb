"""Whether a program's output is what a case expects, and the first difference if it is not."""
import re
import struct
from collections import namedtuple
from decimal import Decimal
from fractions import Fraction

# excuses: mistakes that would have given something else; other_rule: the rule by which there is no
# difference; is_failure: the program did not come to an end of its own, or failed; points: pairs of what a
# vertex should be and what it is
Difference = namedtuple("Difference", "message expected found excuses other_rule is_failure points",
                        defaults=("", "", (), None, False, ()))
# A double has up to 309 digits before the point and 1074 behind it; Python reads no number of more than 4300.
NUMBER = re.compile(r"[+-]?([0-9]{1,2000}\.?[0-9]{0,2000}|\.[0-9]{1,2000})([eE][+-]?[0-9]{1,4})?")
LEAST_DIGITS = 6  # a text whose numbers do not all have the same decimals is taken to have at least these
COARSEST = Fraction(5, 1000)  # no text is right to fewer digits
DOUBLE = Fraction(1, 2**50)  # doubles give no more digits, whatever a text shows
LETTERS = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"


def first_different_line(expected, found):
    """The Difference of two texts whose bytes differ."""
    lines = [text.decode("latin-1").split("\n") for text in (expected, found)]
    at = next((i for i, (a, b) in enumerate(zip(*lines)) if a != b), min(map(len, lines)))
    shown = [repr(text[at]) if at < len(text) else "the end" for text in lines]
    return Difference(f"line {at + 1} differs", *shown)


def same_bytes(expected, found):
    return None if expected == found else first_different_line(expected, found)


class Digits:
    """How many digits some numbers show: all as many decimals, or all as many significant digits as the
    longest."""
    def __init__(self, words, may_be_fixed=True):
        decimals = {len(word.partition(".")[2]) if "e" not in word.lower() else -1 for word in words}
        self.is_fixed = may_be_fixed and len(decimals) == 1 and min(decimals) >= 2
        self.significant = max([LEAST_DIGITS, *(len(Decimal(word).as_tuple().digits) for word in words)])

    def half_unit(self, word):
        """Half a unit of the last digit that this number shows."""
        number = Decimal(word)
        place = number.as_tuple().exponent
        if not self.is_fixed:
            place = min(place, number.adjusted() - self.significant + 1)
        return min(Fraction(10)**place / 2, COARSEST * max(1, abs(Fraction(word))))


def group_of(line, column, is_stage_text):
    """Numbers of one group are printed alike: those of the header, coordinates, and each further column."""
    if not NUMBER.fullmatch(line[0]):
        return "header"
    return max(2, column) if is_stage_text else "depths"


def digits_by_group(lines, is_stage_text):
    groups = {}
    for line in lines:
        for column, word in enumerate(line):
            if NUMBER.fullmatch(word):
                groups.setdefault(group_of(line, column, is_stage_text), []).append(word)
    return {group: Digits(words, group != "header") for group, words in groups.items()}


def same_digits(expected, found, is_stage_text=True):
    """The first Difference of two texts, right to the digits that both show, in any formatting but the lines;
    or None."""
    texts = [[line.split() for line in text.decode("latin-1").splitlines() if line.split()]
             for text in (expected, found)]
    digits = [digits_by_group(lines, is_stage_text) for lines in texts]
    for at, (want, got) in enumerate(zip(*texts)):
        groups = [group_of(want, column, is_stage_text) for column in range(len(want))]
        shown = [[by_group.get(group) for by_group in digits] for group in groups]
        if len(want) != len(got) or not all(map(is_same_word, want, got, shown)):
            return Difference(f"line {at + 1}, blank ones not counted, differs", " ".join(want),
                              " ".join(got))
    if len(texts[0]) != len(texts[1]):
        return Difference("the number of lines differs",
                          *(f"{len(lines)} line{'s' * (len(lines) != 1)}" for lines in texts))
    return None


def is_same_word(expected, found, digits):
    if not (NUMBER.fullmatch(expected) and NUMBER.fullmatch(found)) or None in digits:
        return expected == found
    leeway = sum(shown.half_unit(word) for shown, word in zip(digits, (expected, found)))
    return abs(Fraction(expected) - Fraction(found)) <= leeway + DOUBLE * abs(Fraction(expected))


def same_shortest(expected, found):
    """The first Difference of `w` and of the lines of `clipped`, which are written in the shortest form,
    whatever the others are (T20), of two texts whose numbers are the same."""
    texts = [[line.split() for line in text.decode("latin-1").splitlines() if line.split()]
             for text in (expected, found)]
    has_w, clipped = False, 0
    for at, (want, got) in enumerate(zip(*texts), 1):
        has_w |= want[:2] == ["attributes", "w"]
        clipped = 4 if want == ["clipped"] else max(0, clipped - 1)
        columns = slice(0, 4) if clipped else slice(3, 4) if has_w and NUMBER.fullmatch(want[0]) else slice(0)
        if want[columns] != got[columns]:
            field = "a line of `clipped`" if clipped else "w"
            return Difference(f"line {at}, blank ones not counted: {field} is not in the shortest form (T20)",
                              " ".join(want[columns]), " ".join(got[columns]))
    return None


class NoPicture(Exception):
    """Its text says what is wrong with a file that should be a BMP image."""


def read_bmp(data):
    """The rows of an image, from the top, each a list of (red, green, blue)."""
    if len(data) < 54 or data[:2] != b"BM":
        raise NoPicture("not a BMP file")
    start, _, width, height, _, depth, compression = struct.unpack_from("<2I2i2HI", data, 10)
    size, stride = depth // 8, (width * depth // 8 + 3) // 4 * 4
    is_known = depth in (24, 32) and compression in (0, 3)
    if not is_known or width <= 0 or len(data) < start + stride * abs(height):
        raise NoPicture("not a BMP file of 24 or 32 bits a pixel, or cut short")
    rows = [[tuple(data[at + size * column:at + size * column + 3][::-1]) for column in range(width)]
            for at in range(start, start + stride * abs(height), stride)]
    return rows[::-1] if height > 0 else rows


# Of a BMP file (T24): where each field begins, and its name.
FIELDS = {
    0: "the letters BM", 2: "the file's size", 6: "reserved", 10: "where the pixels begin",
    14: "the size of the second header", 18: "the width", 22: "the height", 26: "the planes",
    28: "the bits a pixel", 30: "the compression", 34: "the size of the pixels", 38: "pixels a meter in x",
    42: "pixels a meter in y", 46: "the colors used", 50: "the important colors",
    54: "the pixels, or their filling"}


def different_field(expected, found):
    """The Difference of two BMP files with the same pixels; None if there is none."""
    if expected == found:
        return None
    at = next((i for i, (a, b) in enumerate(zip(expected, found)) if a != b), min(len(expected), len(found)))
    begin = max(start for start in FIELDS if start <= at)
    end = min([start for start in FIELDS if start > at], default=at + 1)
    if begin == 54:
        return Difference(f"the picture's file, byte {at}: {FIELDS[54]}", f"{len(expected)} bytes",
                          f"{len(found)} bytes")
    values = [str(int.from_bytes(data[begin:end], "little")) for data in (expected, found)]
    return Difference(f"the picture's file, bytes {begin} to {end - 1}: {FIELDS[begin]}", *values)


def drawn(rows, background):
    """A picture as text, a line a row: a point for the background, and a letter for each color in the order
    in which they appear."""
    names = {background: "."}
    return [
        "".join(names.setdefault(pixel, LETTERS[(len(names) - 1) % len(LETTERS)]) for pixel in row)
        for row in rows]


def same_owners(expected, found):
    """As same_picture, but colors are free: pixels have one color where one triangle is seen, and another
    where another is."""
    there, back = {(0, 0, 0): (0, 0, 0)}, {(0, 0, 0): (0, 0, 0)}
    for want, got in zip(expected, found):
        for a, b in zip(want, got):
            if there.setdefault(a, b) != b or back.setdefault(b, a) != a:
                return False
    return True


def same_picture(expected, found, has_free_colors):
    """The Difference of two BMP files, or None."""
    try:
        want, got = read_bmp(expected), read_bmp(found)
    except NoPicture as error:
        return Difference(f"the picture is {error}")
    sizes = [f"{len(rows[0])} x {len(rows)} pixels" for rows in (want, got)]
    if sizes[0] != sizes[1]:
        return Difference("the picture's size differs", *sizes)
    if want == got or has_free_colors and same_owners(want, got):
        return None
    pictures = [drawn(rows, (0, 0, 0)) for rows in (want, got)]
    if pictures[0] != pictures[1]:
        return Difference("the picture differs", *("\n".join(picture) for picture in pictures))
    row, column = next(
        (r, c) for r, line in enumerate(want) for c, pixel in enumerate(line) if got[r][c] != pixel)
    return Difference(f"the color of the pixel in row {row} and column {column} differs",
                      str(want[row][column]), str(got[row][column]))
