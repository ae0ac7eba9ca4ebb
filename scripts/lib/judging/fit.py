"""The 4 x 4 matrix that takes one list of points to another, fitted by least squares, and how it compares
with ours.

A matrix is shown only if the points determine it: more fits, to numbers moved within their last digit, show
how uncertain rounding leaves it."""
import dataclasses
import itertools
import math
import random

from lib.judging.matrices import image, negative, product, scaling, translation
from lib.judging.verdict import Cause
from lib.maths.vectors import dot

MOST_POINTS = 60
TRIALS = 3
WORST_SPREAD = 0.01  # of an element, against the largest one
LEAST_DIFFERENCE = 1e-4  # of an element, against 1 and its own size
# of an image's coordinate: relative to its size or to 1, and in its last digit
MISFIT, MISFIT_IN_UNITS = 1e-3, 20


@dataclasses.dataclass
class Comparison:
    theirs: tuple  # None if no matrix comes near the points
    ours: tuple
    differing: set  # (row, column), from 0

    def lines(self):
        """Both matrices side by side; a * marks what differs."""
        if self.theirs is None:
            return ["  no 4 x 4 matrix gives these numbers"]
        rows = []
        for i, (a, b) in enumerate(zip(self.theirs, self.ours)):
            left = " ".join(f"{shown(x):>12}{' *'[(i, j) in self.differing]}" for j, x in enumerate(a))
            rows.append(f"  {left}   | " + " ".join(f"{shown(x):>12}" for x in b))
        width = rows[0].index("|")
        return [f"  {'found in the points (* differs)':<{width - 2}}| right", *rows]


def cause_of_element(i, j, value, right, digits=6):
    place = f"Row {i + 1}, column {j + 1} of the matrix (counted from 1)"
    return Cause("", f"{place} is {value:.{digits}g}, not {right:.{digits}g}")


def cause_of_elements(comparison, rows=range(4)):
    """The cause if a Comparison shows that one element in some rows is another number, or that the first two
    of the diagonal have an extra factor; a list of at most one."""
    differing = sorted(place for place in getattr(comparison, "differing", ()) if place[0] in rows)
    if len(differing) == 1:
        (i, j), = differing
        return [cause_of_element(i, j, comparison.theirs[i][j], comparison.ours[i][j], digits=5)]
    if differing == [(0, 0), (1, 1)]:
        factors = [comparison.theirs[i][i] / comparison.ours[i][i] for i in range(2) if comparison.ours[i][i]]
        if len(factors) == 2 and abs(factors[0] - factors[1]) <= LEAST_DIFFERENCE * abs(factors[0]):
            return [Cause("", f"The first two elements of the diagonal are {factors[0]:.4g} times too large")]
    return []


def known_rows(verdict, directions):
    """Remarks on wrong rows of a verdict without a cause that begin with a known (name, direction)."""
    comparison, directions = verdict.matrices, list(directions)
    differing = () if verdict.causes else getattr(comparison, "differing", ())
    for i in sorted({i for i, j in differing if j < 3}):
        row = comparison.theirs[i]
        for name, v in directions:
            if any(v) and math.dist(row[:3], v) < LEAST_DIFFERENCE * max(1, math.hypot(*v)):
                yield f"row {i + 1} of its matrix is {name}"
                break


def shown(x):
    text = f"{x:.5f}"
    return text.lstrip("-") if not text.strip("-0.") else text


def null_vector(rows):
    """The unit vector that a matrix makes shortest, by inverse iteration with the triangle R of its QR
    decomposition, by modified Gram-Schmidt (Björck, 1967)."""
    columns, r = [*zip(*rows)], []
    count = len(columns)
    for k in range(count):
        size = math.hypot(*columns[k]) or 1.0
        unit = [x / size for x in columns[k]]
        r.append([0.0] * k + [dot(unit, column) for column in columns[k:]])
        columns[k:] = [[y - z * x for x, y in zip(unit, column)] for z, column in zip(r[k][k:], columns[k:])]
    least = 1e-14 * max(r[k][k] for k in range(count))
    for k in range(count):  # the diagonal has no negative element
        r[k][k] = max(r[k][k], least)
    x = [1.0 + 0.1 * k for k in range(count)]
    for _ in range(6):
        for k in range(count):  # R' y = x
            x[k] = (x[k] - sum(r[i][k] * x[i] for i in range(k))) / r[k][k]
        for k in reversed(range(count)):  # R z = y
            x[k] = (x[k] - sum(r[k][j] * x[j] for j in range(k + 1, count))) / r[k][k]
        size = math.hypot(*x)
        x = [value / size for value in x]
    return x


def normalizing(points):
    """The matrix that moves points to the origin and scales them to a size of about 1; and its inverse."""
    center = [sum(values) / len(points) for values in zip(*points)]
    size = max(max(abs(x - c) for x, c in zip(p, center)) for p in points) or 1.0
    there = product(scaling((1 / size,) * 3), translation(negative(center)))
    return there, product(translation(center), scaling((size,) * 3))


def fitted(before, after, is_divided):
    """The matrix that takes points to their images; only up to a factor if they are divided by w."""
    there, _ = normalizing(before)
    images, back = normalizing(after)
    rows = []
    for p, q in zip(before, after):
        column, q = (*image(there, p, False), 1.0), image(images, q, False)
        for axis in range(3):
            known = [-q[axis] * x for x in (column if is_divided else (1.0,))]
            rows.append([0.0] * 4 * axis + [*column] + [0.0] * 4 * (2 - axis) + known)
    m = null_vector(rows)
    last = m[12:] if is_divided else (0.0, 0.0, 0.0, m[12])
    m = product(product(back, [*(m[i:i + 4] for i in (0, 4, 8)), last]), there)
    return m if is_divided else tuple(tuple(x / m[3][3] for x in row) for row in m)


def scaled_like(m, ours):
    """A matrix known up to a factor, scaled so that most elements equal ours."""
    pairs = [*zip(itertools.chain(*m), itertools.chain(*ours))]
    ratios = [b / a for a, b in pairs if abs(b) > 1e-9 and abs(a) > 1e-12]

    def agreeing(factor):
        return sum(abs(factor * a - b) <= 1e-3 * max(1.0, abs(b)) for a, b in pairs)

    factor = max(ratios, key=agreeing, default=1.0)
    return tuple(tuple(factor * x for x in row) for row in m)


def compare(before, after, units, ours, is_divided):
    """The Comparison of the matrix from `before` to `after` with ours; None if the points allow several."""
    step = max(1, len(before) // MOST_POINTS)
    chosen = [i for i in range(0, len(before), step) if all(map(math.isfinite, after[i]))]
    before, after, units = ([values[i] for i in chosen] for values in (before, after, units))
    if len(before) < 6:
        return None
    rng = random.Random(1)
    moved = ([
        tuple(x + (trial > 0) * rng.uniform(-0.5, 0.5) * u for x, u in zip(q, unit))
        for q, unit in zip(after, units)] for trial in range(TRIALS + 1))
    try:
        fits = [fitted(before, images, is_divided) for images in moved]
    except (ZeroDivisionError, OverflowError):
        return None
    theirs, *others = [scaled_like(m, ours) for m in fits] if is_divided else fits
    if any(not abs(x - y) <= MISFIT_IN_UNITS * unit + MISFIT * max(1.0, abs(y))
           for p, q, limits in zip(before, after, units)
           for x, y, unit in zip(image(theirs, p, is_divided), q, limits)):
        return Comparison(None, ours, set())
    spread = [[2 * max(abs(m[i][j] - theirs[i][j]) for m in others) for j in range(4)] for i in range(4)]
    if any(not max(moves) <= WORST_SPREAD * max(1e-3, *map(abs, row)) for moves, row in zip(spread, theirs)):
        return None
    differing = {(i, j)
                 for i, row in enumerate(ours) for j, x in enumerate(row)
                 if abs(theirs[i][j] - x) > 4 * spread[i][j] + LEAST_DIFFERENCE * max(1.0, abs(x))}
    return Comparison(theirs, ours, differing)
