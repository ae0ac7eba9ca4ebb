"""Differences that no matrix explains: triangles that a text lacks or has too many of, another order of them,
and mistakes in a few triangles or in the same vertex of each."""
import dataclasses
import itertools

from lib.judging.verdict import Cause

ORDINALS = ("first", "second", "third")
VERTICES = [slice(k, None, 3) for k in range(3)]
MOST_NAMED = 5
MOST_COMPARED = 1_000_000  # pairs of triangles, in search of the one that is written again


def left_over_for_certain(few, many, is_same):
    """The indices of `many` that `few` lacks, if `few` is a part of it in the same order, else None; and True
    if there is no other choice, as there is between equal items."""
    def left_over(order):
        left, rest = [], [*few][::-order]  # the next one last
        for number, item in [*enumerate(many)][::order]:
            if rest and is_same(rest[-1], item):
                rest.pop()
            else:
                left.append(number)
        return None if rest else sorted(left)

    left = left_over(1)
    return left, left is not None and left == left_over(-1)


def listed(numbers):
    """Numbers in words; of many, only the first ones."""
    words = [str(number) for number in numbers]
    if len(words) > MOST_NAMED + 1:
        words[MOST_NAMED:] = [f"{len(words) - MOST_NAMED} more"]
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def named(numbers):
    return f"triangle{'' if len(numbers) == 1 else 's'} {listed(numbers)}"


def missing(few, many, is_same, scene_lines=()):
    """Which of `many` are missing in `few`, as a sentence; empty if the others do not come in order.
    `scene_lines` are the lines in which they stand in the scene, if those help."""
    left, is_certain = left_over_for_certain(few, many, is_same)
    if not left or not few:
        return ""
    text = f"{named(left).capitalize()} {'is' if len(left) == 1 else 'are'} missing"
    if left == list(range(len(few), len(many))):
        text += ", the last one" if len(left) == 1 else f", the last {len(left)}"
    if scene_lines:
        text += f", {'' if len(left) == 1 else 'the first one in '}line {scene_lines[left[0]]} of the scene"
    return text + ("" if is_certain else " (or what is the same as one of them)"
                   if len(left) > 1 else " (or the one that is the same)")


def added(many, few, is_same, lines):
    """Which triangles of a text (`many`, which begin in `lines`) are too many; as missing() otherwise."""
    left, _ = left_over_for_certain(few, many, lambda item, other: is_same(other, item))
    if not left:
        return ""
    if len(left) * len(few) > MOST_COMPARED:
        return f"{len(left)} triangles of the text are too many, first the one in line {lines[left[0]]}"
    copies = {
        i: next((number for number, item in enumerate(few) if is_same(many[i], item)), None)
        for i in left}
    if None in copies.values():
        strange = [i for i in left if copies[i] is None]
        return (f"{named(strange).capitalize()} of the text {'comes' if len(strange) == 1 else 'come'} from "
                f"no triangle of the input, first in line {lines[strange[0]]}")
    if sorted(copies.values()) == list(range(len(few))) and len(few) > 1:
        return f"Every triangle is written twice, the first one again in line {lines[left[0]]}"
    again = sorted(set(copies.values()))
    return (f"{named(again).capitalize()} {'is' if len(again) == 1 else 'are'} written "
            f"{'twice' if len(again) == len(left) else 'more than once'}, again in line {lines[left[0]]}")


def reordered(written, right, is_same):
    """The other order of triangles, or of the vertices of each, as a sentence; empty if there is none."""
    for order in itertools.permutations(range(3)):
        if order != (0, 1, 2) and all(is_same(a, [b[i] for i in order]) for a, b in zip(written, right)):
            names = ", ".join(ORDINALS[i] for i in order)
            return f"The vertices of each triangle stand in another order: {names}"
    if len(written) > 1 and all(map(is_same, written, reversed(right))):
        return "The triangles stand in reverse order"
    if len(written)**2 > MOST_COMPARED:
        return ""
    left, first = list(range(len(right))), None
    for number, item in enumerate(written):
        found = next((i for i in left if is_same(item, right[i])), None)
        if found is None:
            return ""
        left.remove(found)
        first = first or (number, found) if number != found else first
    return (f"All triangles are there, but in another order: triangle {first[0]} of the text is triangle "
            f"{first[1]}" if first else "")


def causes_at_vertices(result, count, is_right_at, causes_at):
    """The causes if one or two vertices of each of `count` triangles are wrong. `result` lists the
    differences; `is_right_at` is True for a slice of points that are right, `causes_at` explains slices."""
    wrong = [k for k in range(3) if not is_right_at(VERTICES[k])]
    counts = [len({i for i, *_ in result if i % 3 == k}) for k in wrong]
    if not 0 < len(wrong) < 3 or min(counts) < max(2, count / 2):
        return []
    names, others = (" and ".join(ORDINALS[k] for k in range(3) if (k in wrong) == is_wrong)
                     for is_wrong in (True, False))
    text = (f"Only the {names} vertex of each triangle is wrong, the {others} are right"
            if len(wrong) == 1 else f"The {names} vertex of each triangle are wrong, the {others} is right")
    inner = causes_at([VERTICES[k] for k in wrong])
    return [dataclasses.replace(cause, text=f"{text}: {cause.text}") for cause in inner] or [Cause("", text)]
