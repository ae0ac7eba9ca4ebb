"""Mistakes in some of the points alone: in the same vertex of every triangle, or in a few triangles."""
import dataclasses

from lib.judging.matching import listed
from lib.judging.verdict import Cause

VERTICES = [slice(k, None, 3) for k in range(3)]
NAMES = ("first", "second", "third")
MOST_TRIANGLES = 0.5  # of all that are wrong, to be called a few


def causes(result, count, is_right_at, causes_at):
    """The causes if each triangle is wrong at one or two vertices of its three, and the others are right.
    `result` is what differs in `count` triangles; `is_right_at` tells of a slice of the points whether all
    are right, `causes_at` explains slices."""
    wrong = [k for k in range(3) if not is_right_at(VERTICES[k])]
    counts = [len({i for i, *_ in result if i % 3 == k}) for k in wrong]
    if not 0 < len(wrong) < 3 or min(counts) < max(2, count / 2):
        return []
    names, others = (" and ".join(NAMES[k] for k in range(3) if (k in wrong) == is_wrong)
                     for is_wrong in (True, False))
    text = (f"Only the {names} vertex of each triangle is wrong, the {others} are right"
            if len(wrong) == 1 else f"The {names} vertex of each triangle are wrong, the {others} is right")
    inner = causes_at([VERTICES[k] for k in wrong])
    return [dataclasses.replace(cause, text=f"{text}: {cause.text}") for cause in inner] or [Cause("", text)]


def few_triangles(result, count):
    """A remark on which triangles are wrong, if they are few; a list of at most one."""
    wrong = sorted({i // 3 for i, *_ in result})
    if not wrong or len(wrong) > MOST_TRIANGLES * count:
        return []
    return [
        f"only triangle{'s'[:len(wrong) > 1]} {listed(wrong)} of {count} "
        f"{'is' if len(wrong) == 1 else 'are'} wrong"]
