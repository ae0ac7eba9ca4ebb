"""Lines of a report: numbers in columns, and a matrix beside a list."""
from fractions import Fraction

from lib.maths.exact import short

NEGLIGIBLE = Fraction(1, 10**100)  # of a matrix's largest entry: a 0 with the error of rounded sines
MIN_LEFT_WIDTH = 42
INDENT = "  "


def aligned(rows, justified=str.rjust, gap="  "):
    """Rows of words as lines, each column aligned on the right."""
    widths = [max(map(len, column)) for column in zip(*rows)]
    return [INDENT + gap.join(map(justified, row, widths)).rstrip() for row in rows]


def aligned_left(rows):
    return aligned(rows, str.ljust, "   ")


def on_the_point(column):
    """Numbers as words, padded so that their decimal points line up."""
    behind = max(len(word) - len(word.partition(".")[0]) for word in column)
    padded = [word + " " * (behind - (len(word) - len(word.partition(".")[0]))) for word in column]
    width = max(map(len, padded))
    return [word.rjust(width) for word in padded]


def matrix_lines(name, matrix):
    least = NEGLIGIBLE * max(abs(x) for row in matrix for x in row)
    columns = [on_the_point([short(x if abs(x) > least else 0) for x in column]) for column in zip(*matrix)]
    return [(f"{name} = " if i == 0 else " " * (len(name) + 3)) + "| " + "  ".join(row) + " |"
            for i, row in enumerate(zip(*columns))]


def beside(left, right):
    """Two lists of lines, one beside the other."""
    count = max(len(left), len(right))
    left, right = (lines + [""] * (count - len(lines)) for lines in (left, right))
    width = max(MIN_LEFT_WIDTH, *(len(line) + 2 for line in left))
    return [(INDENT + a.ljust(width) + b).rstrip() for a, b in zip(left, right)]
