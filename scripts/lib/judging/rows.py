"""Mistakes of view or project that lie in different rows of the matrix: each row is judged by itself, and the
names of what explains them are joined."""
import itertools

from lib.judging.fit import cause_of_elements
from lib.judging.matrix_mistakes import changed_elements, listed
from lib.judging.pixel_rules import MOST_PAIRS
from lib.judging.points import differs
from lib.judging.verdict import joined

AXES = range(3)
SAME = 1e-9  # of two numbers, against 1 and their size


def causes(ways, theirs, digits, comparison):
    """The Causes of Points that are each one mistake or more, if every coordinate that is wrong is explained
    by one that leaves the others as they are. `comparison` is the fitted matrix beside ours."""
    def fits(way, axes):
        return any(not differs(theirs.points, digits, images, axes) for images in way.images(slice(None)))

    wrong = {axis for axis in AXES if not any(fits(way, [axis]) for way in ways.right)}
    if len(wrong) < 2:
        return []
    found = {}
    for candidates in (listed, lambda stage, _: changed_elements(stage, ways.ours, ways.divides)):
        for way in ways.made(candidates(ways.stage, ways.scene)):
            axes = frozenset(touched(way, ways.right[0]))
            if axes and axes <= wrong and axes != wrong and fits(way, axes):
                found.setdefault(axes, []).append(way.cause)
        if candidates is listed:
            named = {*found}
    for axes in {*found} - named:  # more than one element would do
        found[axes] = [cause for cause in found[axes] if len(found[axes]) == 1]
    for axis in wrong:
        found.setdefault(frozenset({axis}), cause_of_elements(comparison, [axis]))
    return choices_of(found, wrong)


def touched(way, right):
    """The axes on which a Way gives other numbers than the right one."""
    (images, *_), (others, *_) = way.images(slice(None)), right.images(slice(None))
    return {
        axis
        for (p, _), (q, _) in zip(images, others) for axis in AXES
        if not abs(p[axis] - q[axis]) <= SAME * max(1.0, abs(q[axis]))}


def choices_of(found, wrong):
    """The fewest of {axes: Causes} that together explain all wrong axes, each once; nothing if there are more
    than MOST_PAIRS choices."""
    for count in range(2, len(wrong) + 1):
        choices = [
            choice for some in itertools.combinations(found, count)
            if sum(map(len, some)) == len(wrong) and frozenset().union(*some) == wrong
            for choice in itertools.product(*(found[axes] for axes in sorted(some, key=min)))]
        if choices:
            return [*map(joined, choices)] if len(choices) <= MOST_PAIRS else []
    return []
