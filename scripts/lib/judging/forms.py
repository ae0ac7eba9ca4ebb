"""Mistakes outside the list that show in the matrix as a whole, and changes of a single element."""
import itertools

AXES = "xyzw"


def other_forms(stage, ours, divides):
    """(text, matrix, whether it divides) of what may have become of the whole matrix."""
    yield from ((text, m, divides) for text, m in exchanged_rows(stage, ours))
    if stage == "project":
        reversed_z = tuple((w - z) / 2 for z, w in zip(*ours[2:]))
        yield "The depth goes from 1 at near to 0 at far, in place of -1 to 1", (*ours[:2], reversed_z,
                                                                                 ours[3]), divides


def exchanged_rows(stage, ours):
    """(text, matrix) for each other order of the rows of x, y and z; in project, w may change places with one
    of them."""
    for order in itertools.permutations(range(4)):
        moved = [i for i in range(4) if order[i] != i]
        if not moved or 3 in moved and (stage != "project" or len(moved) > 2):
            continue
        m = tuple(ours[i] for i in order)
        if len(moved) == 2:
            i, j = moved
            yield (
                f"Rows {i + 1} and {j + 1} of the matrix (counted from 1), those of {AXES[i]} and {AXES[j]}, "
                "stand in each other's place"), m
        else:
            yield f"The rows of the matrix stand in the order {', '.join(AXES[i] for i in order[:3])}", m


def changed_elements(stage, ours):
    """(text, matrix) of one row with the opposite sign, or of one element that is another number."""
    count = 4 if stage == "project" else 3
    for i in range(count):
        yield f"Row {i + 1} of the matrix (counted from 1) has the opposite sign", tuple(
            tuple(-x for x in row) if k == i else row for k, row in enumerate(ours))
    numbers = {0.0, 1.0, -1.0, *(sign * abs(x) for row in ours for x in row for sign in (1, -1))}
    for i, j in itertools.product(range(count), range(4)):
        for value in sorted((numbers | {2 * ours[i][j], ours[i][j] / 2}) - {ours[i][j]}):
            m = tuple(
                tuple(value if (k, n) == (i, j) else x
                      for n, x in enumerate(row))
                for k, row in enumerate(ours))
            yield (f"Row {i + 1}, column {j + 1} of the matrix (counted from 1) is {value:.6g}, "
                   f"not {ours[i][j]:.6g}"), m
