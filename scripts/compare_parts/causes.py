"""Why two stage texts differ: a relation between the numbers, and with the scene the mistake that the judge
of hand-ins names."""
import math

from compare_parts.differences import exceeds
from lib.judging.points import read_points
from lib.judging.reference import Reference
from lib.judging.stage_judge import stage_outcome
from lib.judging.stage_ways import exact_images
from lib.running.pipe_tools import Tools

UNIT = 1e-7  # in the last of 7 decimals
CLOSE = 2e-6  # for numbers calculated from numbers that were printed with 7 decimals
LEAST_FACTOR = 1e-4  # the least distance from 1 that is no rounding
ROUNDING = "all differences are of one unit in the last decimal: rounding"


def hint_of_numbers(theirs, ours):
    """Describes how two lists of points are related; None if there is no simple relation."""
    if len(theirs) != len(ours) or theirs == ours:
        return None
    if not any(exceeds(a, b, UNIT) for p, q in zip(theirs, ours) for a, b in zip(p, q)):
        return ROUNDING
    return hint_of_factors(theirs, ours)


def hint_of_factors(theirs, ours):
    factors = [factor_of([p[axis] for p in theirs], [q[axis] for q in ours]) for axis in range(3)]
    is_scaled = all(
        abs(a - k * b) <= CLOSE * max(1.0, abs(a)) for p, q in zip(theirs, ours)
        for a, b, k in zip(p, q, factors))
    if not is_scaled or all(abs(k - 1) < LEAST_FACTOR for k in factors):
        return None
    x, y, z = (f"{k:.6g}" for k in factors)
    return f"x, y and z of A are {x}, {y} and {z} times those of B"


def factor_of(values, others):
    """The factor from the others to the values, by least squares; 1 if all the others are 0."""
    square = math.fsum(b * b for b in others)
    return math.fsum(a * b for a, b in zip(values, others)) / square if 1e-12 < square < math.inf else 1.0


def judged(scene, theirs, ours):
    """The FileVerdict on `theirs`, if `ours` is the output of a stage of the scene, else None. A text is its
    bytes and its name. If `ours` fits several stages, the first whose mistakes reproduce `theirs` counts."""
    reference = Reference(scene, None, Tools())
    ours, theirs = read_points(*ours), read_points(*theirs)
    verdicts = [
        verdict_of("theirs", theirs) for verdict_of in stages(reference) if verdict_of("ours", ours).is_good]
    return next((verdict for verdict in verdicts if verdict.causes), verdicts[0] if verdicts else None)


def stages(reference):
    """A function for each stage that judges points as its output, given right ones as its input."""
    yield lambda name, points: stage_outcome(reference, "model", name, points)[0]
    world = read_as_printed(reference.world)
    yield lambda name, points: stage_outcome(reference, "view", name, points, [world])[0]
    p_view = exact_images(reference.scene.matrix("view"), False, reference.world)
    view = read_as_printed(p_view)
    clipped = reference.clipped(tuple(p_view))
    others = [clipped] if clipped is not None else []
    yield lambda name, points: stage_outcome(reference, "project", name, points, [view], others)[0]


def read_as_printed(points):
    return points, [(UNIT,) * 3] * len(points)
