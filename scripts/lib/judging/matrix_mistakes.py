"""The matrices that view or project may have by mistake, each as (Cause, matrix, whether it divides).
Mistakes in different rows are found row by row, and their names are joined."""
import contextlib
import itertools

from lib.judging.fit import cause_of_element, cause_of_elements
from lib.judging.matrices import TWO_SPELLINGS, negative
from lib.judging.mistakes import names_of
from lib.judging.pixel_rules import MOST_PAIRS
from lib.judging.points import differs
from lib.judging.verdict import Cause, cause_of_all, joined

DIVISIONS = {  # as in `image`; other mistakes of project divide all three once
    "no-divide": False, "divided-twice": (2, 2), "z-not-divided": (1, 0), "depth-is-linear": (1, 0),
    "depth-in-view-space": (1, 0), "depth-divided-twice": (1, 2)}
SAME = "left-handed"  # gives the numbers of l-is-eye-minus-look
AXES = "xyzw"
DIGITS = 1e-9  # that two equal numbers may differ by, against 1 and their size


def listed(stage, scene, count=1):
    """The mistakes with a name, each in the ways that programs make it, or two at once."""
    for names in itertools.combinations(names_of(stage), count):
        if count == 1 or SAME not in names and len(DIVISIONS.keys() & names) < 2:
            for m, is_divided in ways(stage, scene, names):
                yield cause_of_all(stage, names), m, is_divided


def ways(stage, scene, names):
    """(matrix, divisions) of mistakes made together; none where that fails, as with a direction of 0 0 0."""
    is_divided = next((DIVISIONS[name] for name in names if name in DIVISIONS), stage == "project")
    for spelling in range(1 + (len(names) == 1 and names[0] in TWO_SPELLINGS)):
        with contextlib.suppress(ZeroDivisionError, OverflowError):
            m = scene.matrix(stage, names, spelling)
            if m is not None:
                yield m, is_divided
                if (stage, *names) == ("view", "matrix-transposed"):  # some programs divide by its w, not 1
                    yield m, True
                if names == ("depth-in-view-space",):  # or the distance from the eye
                    yield (*m[:2], negative(m[2]), m[3]), is_divided


def other_forms(stage, ours):
    """The matrix as a whole in another form: its rows in another order, or another range of depths."""
    for order in itertools.permutations(range(4)):
        moved = [i for i in range(4) if order[i] != i]
        if not moved or 3 in moved and (stage != "project" or len(moved) > 2):
            continue  # w may change places with another row in project alone
        if len(moved) == 2:
            i, j = moved
            text = (f"Rows {i + 1} and {j + 1} of the matrix (counted from 1), those of {AXES[i]} and "
                    f"{AXES[j]}, stand in each other's place")
        else:
            text = f"The rows of the matrix stand in the order {', '.join(AXES[i] for i in order[:3])}"
        yield Cause("", text), tuple(ours[i] for i in order), stage == "project"
    if stage == "project":
        text = "The depth goes from 1 at near to 0 at far, in place of -1 to 1"
        reversed_z = tuple((w - z) / 2 for z, w in zip(*ours[2:]))
        yield Cause("", text), (*ours[:2], reversed_z, ours[3]), True


def changed_elements(stage, ours):
    """One row with the opposite sign, or one element that is another number."""
    def changed(i, row):
        return tuple(row if k == i else other for k, other in enumerate(ours))

    divides = stage == "project"
    count = 3 + divides
    for i in range(count):
        text = f"Row {i + 1} of the matrix (counted from 1) has the opposite sign"
        yield Cause("", text), changed(i, negative(ours[i])), divides
    numbers = {0.0, 1.0, -1.0, *(sign * abs(x) for row in ours for x in row for sign in (1, -1))}
    for i, j in itertools.product(range(count), range(4)):
        right = ours[i][j]
        for value in sorted((numbers | {2 * right, right / 2}) - {right}):
            row = tuple(value if n == j else x for n, x in enumerate(ours[i]))
            yield cause_of_element(i, j, value, right), changed(i, row), divides


def causes_by_rows(ways, theirs, digits, comparison):
    """The Causes of Points, each of one mistake or more, if every coordinate that is wrong is explained
    by one that leaves the others as they are. `comparison` is the fitted matrix beside ours."""
    def fits(way, axes):
        return any(not differs(theirs.points, digits, images, axes) for images in way.images())

    def touched(way):  # the axes on which it gives other numbers than the right one
        (images, *_), (others, *_) = way.images(), ways.right[0].images()
        return frozenset(axis for (p, _), (q, _) in zip(images, others) for axis in range(3)
                         if not abs(p[axis] - q[axis]) <= DIGITS * max(1.0, abs(q[axis])))

    wrong = {axis for axis in range(3) if not any(fits(way, [axis]) for way in ways.right)}
    if len(wrong) < 2:
        return []
    found = {}
    for candidates in (listed(ways.stage, ways.scene), changed_elements(ways.stage, ways.ours)):
        named = {*found}
        for way in ways.made(candidates):
            axes = touched(way)
            if axes and axes < wrong and fits(way, axes):
                found.setdefault(axes, []).append(way.cause)
    for axes in {*found} - named:  # more than one element would do
        found[axes] = [cause for cause in found[axes] if len(found[axes]) == 1]
    for axis in wrong:
        found.setdefault(frozenset({axis}), cause_of_elements(comparison, [axis]))
    # the fewest that explain all wrong axes, each once
    for count in range(2, len(wrong) + 1):
        choices = [
            choice for some in itertools.combinations(found, count)
            if sum(map(len, some)) == len(wrong) and frozenset().union(*some) == wrong
            for choice in itertools.product(*(found[axes] for axes in sorted(some, key=min)))]
        if choices:
            return [*map(joined, choices)] if len(choices) <= MOST_PAIRS else []
    return []
