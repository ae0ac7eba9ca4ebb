"""Stages 1 to 3 of a hand-in: right, or with the mistake that reproduces their numbers."""
import itertools
import math

from lib.judging import matching
from lib.judging.model_habits import ROUGH_PIS
from lib.judging.points import EXACT, described, differences, differs
from lib.judging.stage_ways import PI, MatrixWays, ModelWays, exact_reading
from lib.judging.verdict import (ANOTHER_RULE, RIGHT, TOO_FEW_DIGITS, UNDECIDED, WRONG, Cause, FileVerdict)

ALL = slice(None)
MOST_WRONG = 0.5  # of all triangles, to be called a few
NO_POINTS = "the stages before give no points to judge it by"


def stage_outcome(ours, stage, name, theirs, readings=(), clipped=()):
    """The FileVerdict of a Reference, `ours`, on `theirs`, the Points that a program wrote; and the exact
    points that it probably has in memory, None if unknown. `readings` are what view or project may have had
    as input, numbers in memory last. `clipped` has what our project makes of each: right, too."""
    scene = ours.scene
    if stage == "model":
        return outcome_among(name, theirs, ModelWays(scene, ours.world))
    for points in reversed(clipped):  # the exact ones are what the program may have in memory
        exact = zip(*exact_reading(points))
        if len(points) == len(theirs) and not differs(theirs.points, used_digits(theirs), exact):
            return right_verdict(stage, name, theirs), points
    if not readings:
        return undecided(stage, name), None
    right = [("", scene.matrix(stage), stage == "project")]
    if stage == "project" and scene.projection.kind == "perspective":
        right += [(PI.format(pi), scene.of_project(pi=pi), True) for pi in ROUGH_PIS]
    return outcome_among(name, theirs, MatrixWays(stage, scene, readings, right))


def outcome_among(name, theirs, ways):
    """As stage_outcome, among the ways in which a text may have come about."""
    digits = used_digits(theirs)

    def fits(way, parts=(ALL,)):
        return any(not any(
            differs(theirs.points[part], digits, itertools.islice(images, part.start, None, part.step))
            for part, images in zip(parts, of_one)) for of_one in zip(*(way.images() for _ in parts)))

    def fitting(candidates, parts=(ALL,), most=math.inf):
        """The Ways that fit, the first with each cause; nothing if more than `most` would do."""
        found = {}
        for way in candidates:
            if way.cause.text not in found and fits(way, parts):
                found[way.cause.text] = way
        return list(found.values()) if len(found) <= most else []

    def single_mistakes(parts=(ALL,)):
        return next(filter(None, (fitting(candidates, parts) for candidates in ways.single())), [])

    if not ways.has_count(len(theirs)):
        expected = [[*images] for way in ways.right for images in way.images()]
        return count_verdict(ways, name, theirs, expected, digits), None
    for way in ways.right:
        if fits(way):
            return right_verdict(ways.stage, name, theirs, way.cause.text), way.memory()
    found = single_mistakes()
    if not found and theirs.digits.are_too_few:  # wrong if they differ by more than those hide
        result = nearest(ways.right, theirs, theirs.digits)
        verdict = wrong(ways.stage, name, theirs, result) if result else FileVerdict(
            ways.stage, name, TOO_FEW_DIGITS)
        verdict.remarks.append(f"it shows {theirs.digits}" + ", too few to name a cause" * bool(result))
        return verdict, None
    result = nearest(ways.right[:1], theirs, digits)
    verdict = wrong(ways.stage, name, theirs, result)
    count, right = len(theirs) // 3, ways.right
    if found:
        verdict.causes = ways.with_details([way.cause for way in found], result)
    else:
        found = next(filter(None, (fitting(some, most=most) for some, most in ways.several())), [])
        verdict.causes = [way.cause for way in found] or causes_of_triangles(
            theirs, right[0].images(), digits, matching.reordered) or matching.causes_at_vertices(
                result, count, lambda part: any(fits(way, [part]) for way in right),
                lambda parts: [way.cause for way in single_mistakes(parts)])
        verdict.remarks += [ways.place(result)] if ways.stage == "model" else []
    few = sorted({i // 3 for i, *_ in result})
    if not verdict.causes and 0 < len(few) <= MOST_WRONG * count:
        verdict.remarks.append(
            f"only {matching.named(few)} of {count} {'is' if len(few) == 1 else 'are'} wrong")
    if ways.stage != "model":
        ways.add_matrix(verdict, theirs)
    return verdict, found[0].memory() if found else None


def used_digits(theirs):
    """The digits to compare with: those shown, or EXACT if these are too few to identify a mistake."""
    return EXACT if theirs.digits.are_too_few else theirs.digits


def nearest(ways, theirs, digits):
    """What differs from the nearest points that some Ways give."""
    images = itertools.chain(*(way.images() for way in ways))
    return min((differences(theirs.points, digits, some) for some in images), key=len)


def count_verdict(ways, name, theirs, expected, digits):
    """The verdict on a text of another count of triangles than `expected`, lists of points with their slacks.
    The cause is which triangle is missing or too many, if all others are right."""
    count, right_count = len(theirs) // 3, len(expected[0]) // 3

    def matched(written, right, is_same):
        return (matching.missing(written, right, is_same, ways.scene_lines)
                if len(written) < len(right) else matching.added(written, right, is_same, theirs.lines[::3]))

    return FileVerdict(ways.stage, name, WRONG, causes=causes_of_triangles(theirs, expected, digits, matched),
                       remarks=[f"{count} triangle{'' if count == 1 else 's'} in place of {right_count}"])


def causes_of_triangles(theirs, expected, digits, matched):
    """The cause that a function of `matching` finds in a text beside one of the lists expected, if any."""
    written, *right = ([points[i:i + 3] for i in range(0, len(points), 3)]
                       for points in map(list, (theirs.points, *expected)))
    texts = (matched(written, triangles, lambda one, other: not differs(one, digits, other))
             for triangles in right)
    return [Cause("", text) for text in itertools.islice(filter(None, texts), 1)]


def undecided(stage, name, why=NO_POINTS):
    return FileVerdict(stage, name, UNDECIDED, remarks=[why])


def right_verdict(stage, name, theirs, rule=""):
    word = ANOTHER_RULE if rule else RIGHT
    verdict = FileVerdict(stage, name, word, rule, differing=0, compared=3 * len(theirs))
    decimals = theirs.digits.decimals
    if (theirs.digits.significant if decimals is None else decimals) < 7:
        verdict.remarks.append(f"to the {theirs.digits} it shows")
    return verdict


def wrong(stage, name, theirs, result):
    """The verdict on a text of which `result` differs."""
    by_size = sorted(result, key=lambda found: -abs(found[2] - found[3]))
    largest, first = (described(some[0], theirs.lines) if some else "" for some in (by_size, result))
    return FileVerdict(stage, name, WRONG, differing=len(result), compared=3 * len(theirs), largest=largest,
                       first=first)
