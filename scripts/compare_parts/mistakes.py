"""The common errors, recognized by their effect on the numbers of a stage.

Some show in the numbers alone (`hints_from_numbers`). Others depend on the scene: for those the tools themselves compute
the output with the error (`hints_from_scene`), so that no second pipeline hides here.
"""
import math

from compare_parts.differences import exceeds
from lib.input_file import read_input
from lib.pipe_tools import ToolFailure
from lib.projection import tangents
from lib.stage_text import parse_stage_text
from lib.vectors import axes

UNIT = 1e-7  # in the last of 7 decimals
CLOSE = 2e-6  # for numbers calculated from numbers that were printed with 7 decimals

SWAPPED = "rows and columns of the rotation are swapped (the matrix is the transpose of the right one)"
UP_AS_GIVEN = "up is used as it is given, not made perpendicular to the line of sight (u = r x l)"
RADIANS = "degrees are taken for radians"
NO_DIVIDE = "the divide by w is missing"
FLIPPED = "handedness is flipped: {} has the opposite sign everywhere"
EYE_ADDED = "the eye is added instead of subtracted"
FLIPPED_OR_ADDED = "z has the opposite sign everywhere: handedness is flipped, or " + EYE_ADDED
ARITHMETIC_ERRORS = (OverflowError, ValueError, ZeroDivisionError)  # raised by numbers that allow no hint
ROUNDING = "all differences are of one unit in the last decimal: rounding"


def is_close(theirs, expected):
    """Whether two lists of points are equal up to rounding."""
    return len(theirs) == len(expected) and all(
        abs(a - b) <= CLOSE * max(1, abs(b)) for p, q in zip(theirs, expected) for a, b in zip(p, q))


def fitted(targets, *columns):
    """The factors for which the weighted columns add up to the targets, by least squares; None if undetermined."""
    def dot(u, v):
        return math.fsum(x * y for x, y in zip(u, v))

    if len(columns) == 1:
        square = dot(columns[0], columns[0])
        return None if square < 1e-12 else (dot(columns[0], targets) / square,)
    p, q = columns
    a, b, c = dot(p, p), dot(p, q), dot(q, q)
    determinant = a * c - b * b
    if determinant < 1e-9 * max(1e-12, a * c):
        return None
    d, e = dot(p, targets), dot(q, targets)
    return (d * c - e * b) / determinant, (a * e - b * d) / determinant


def hint_of_rounding(theirs, ours):
    pairs = [(a, b) for p, q in zip(theirs, ours) for a, b in zip(p, q)]
    return ROUNDING if not any(exceeds(a, b, UNIT) for a, b in pairs) else None


def hint_of_handedness(theirs, ours):
    for axis in range(3):
        flipped = [tuple(-x if i == axis else x for i, x in enumerate(p)) for p in ours]
        if flipped != ours and is_close(theirs, flipped):
            # Adding the eye instead moves all points by the same vector, which flips z only if all points share it.
            return FLIPPED_OR_ADDED if axis == 2 and is_close(ours, [(x, y, ours[0][2]) for x, y, _ in ours]) else FLIPPED.format("xyz"[axis])
    return None


def hint_of_divide(theirs, ours):
    """Each vertex is its correct position times a factor of its own."""
    factors, expected = [], []
    for p, q in zip(theirs, ours):
        square = sum(x * x for x in q)
        factors.append(sum(x * y for x, y in zip(p, q)) / square if square > 1e-12 else None)
        expected.append(q if factors[-1] is None else tuple(factors[-1] * x for x in q))
    known = [factor for factor in factors if factor is not None]
    if len(known) >= 3 and all(factor > 0 for factor in known) and is_close(theirs, expected) and any(abs(factor - 1) > 1e-3 for factor in known):
        least, most = f"{min(known):.4g}", f"{max(known):.4g}"
        return f"{NO_DIVIDE} (x, y and z are {least}{'' if least == most else ' to ' + most} times what they should be)"
    return None


def hint_of_up(theirs, ours):
    """In view space only y is wrong: it contains a part of z."""
    factors = fitted([p[1] for p in theirs], [q[1] for q in ours], [q[2] for q in ours])
    if factors is None or abs(factors[1]) < 1e-4:
        return None
    return UP_AS_GIVEN if is_close(theirs, [(x, factors[0] * y + factors[1] * z, z) for x, y, z in ours]) else None


def window_factors(theirs, ours):
    """The factors of x and y, if nothing else is wrong."""
    kx = fitted([p[0] for p in theirs], [q[0] for q in ours])
    ky = fitted([p[1] for p in theirs], [q[1] for q in ours])
    if kx is None or ky is None or not is_close(theirs, [(kx[0] * x, ky[0] * y, z) for x, y, z in ours]):
        return None
    return kx[0], ky[0]


def hint_of_window(theirs, ours):
    factors = window_factors(theirs, ours)
    if factors is None or all(abs(k - 1) < 1e-4 for k in factors):
        return None
    return f"x is {factors[0]:.6g} and y {factors[1]:.6g} times what it should be: the field of view, or the aspect"


def hints_from_numbers(theirs, ours):
    """A hint from the points alone, the simplest that fits; at most one."""
    if len(theirs) != len(ours) or not ours:
        return []
    for hint_of in (hint_of_rounding, hint_of_handedness, hint_of_window, hint_of_up, hint_of_divide):
        try:
            hint = hint_of(theirs, ours)
        except ARITHMETIC_ERRORS:
            continue
        if hint:
            return [hint]
    return []


def with_angles(scene, changed):
    """The scene's text with every angle of a rotation replaced."""
    lines, is_expected = [], False
    for line in scene.split("\n"):
        words = line.split("#")[0].split()
        if words and words[0] == "rotate":
            is_expected, words = True, words[1:]
            lines.append("rotate")
        elif not (is_expected and words):
            lines.append(line)
        if is_expected and words:
            lines.append(" ".join([repr(changed(float(words[0]))), *words[1:]]))
            is_expected = False
    return "\n".join(lines)


class Suspects:
    """A scene's output with each known error, stage by stage; `tools` compute it."""

    def __init__(self, tools, scene_path):
        self.tools = tools
        self.path = scene_path
        self.scene = read_input(scene_path).decode("utf-8-sig", errors="replace")
        self.camera = parse_stage_text(tools.output("model", scene_path).decode(), "model").header

    def points(self, tool, *words, stdin):
        return parse_stage_text(self.tools.output(tool, *words, "--digits", "exact", stdin=stdin).decode(), tool).points

    def of_model(self):
        for change, hint in ((lambda angle: -angle, SWAPPED), (math.degrees, RADIANS + " by the rotations")):
            yield hint, self.points("model", "--bare", stdin=with_angles(self.scene, change).encode())

    def of_view(self, stage1):
        eye, look, up = (tuple(map(float, self.camera[name])) for name in ("eye", "look", "up"))
        r, u, l = axes(eye, look, up)
        back = tuple(-x for x in l)
        # A camera whose axes are the columns of (r, u, back).
        _, column_y, column_z = zip(r, u, back)
        words = ["--eye", *eye, "--look", *(e - c for e, c in zip(eye, column_z)), "--up", *column_y]
        yield SWAPPED, self.points("view", "--bare", *map(repr_of, words), stdin=stage1)
        yield EYE_ADDED, self.with_eye_added(stage1)

    def with_eye_added(self, stage1):
        """The same axes, with the eye mirrored through the origin."""
        eye, look = (tuple(map(float, self.camera[name])) for name in ("eye", "look"))
        words = ["--eye", *(-e for e in eye), "--look", *(x - 2 * e for x, e in zip(look, eye)), "--up", *self.camera["up"]]
        return self.points("view", "--bare", *map(repr_of, words), stdin=stage1)

    def of_window(self, theirs, ours):
        """A hint if the field of view was taken as radians."""
        factors = window_factors(theirs, ours)
        if factors is None or "perspective" not in self.camera:
            return None
        right = tangents(self.camera)
        wrong = tangents(self.camera, lambda angle: angle)
        if all(abs(k * w - t) <= 1e-4 * abs(t) for k, w, t in zip(factors, wrong, right)):
            return RADIANS + " in the field of view"
        return None


def repr_of(word):
    return word if isinstance(word, str) else repr(word)


def hints_from_scene(suspects, stage, theirs, ours, previous=b""):
    """At most one hint for stage 1, 2 or 3 of a scene; `previous` is the text the stage read."""
    try:
        hint = hint_from_scene(suspects, stage, theirs, ours, previous)
    except (ToolFailure, *ARITHMETIC_ERRORS):  # the tools refuse the text or the camera
        return []
    return [hint] if hint else []


def hint_from_scene(suspects, stage, theirs, ours, previous):
    if stage == 3:
        return suspects.of_window(theirs, ours)
    is_flipped = stage == 2 and hint_of_handedness(theirs, ours) == FLIPPED_OR_ADDED
    drawn = suspects.of_model() if stage == 1 else suspects.of_view(previous)
    for hint, points in drawn:
        if points != ours and is_close(theirs, points) and not is_close(ours, points):
            return FLIPPED_OR_ADDED if is_flipped and hint == EYE_ADDED else hint
    return FLIPPED.format("z") if is_flipped else None
