"""What a rasterizer does with the cases, counted."""
import dataclasses
import json
import subprocess

from . import scoreboard_geometry as geometry

NOT_INSTALLED = 77
DEPTH_TOLERANCE = 2.0 ** -16  # of the limits' distance: enough for buffers of 24 bits and coordinates of 24


@dataclasses.dataclass
class Score:
    """Of one rasterizer. Numbers of pixels, but for `tilings`."""
    name: str
    version: str
    promise: str
    is_antialiased: bool
    has_depth: bool
    tilings: int = 0
    owners: int = 0   # pixels of tilings of which exactly one triangle should own each
    gaps: int = 0     # those that none has
    twice: int = 0    # pixels of tilings that two or more have
    missed: int = 0   # centers inside a triangle, pixels not drawn; of all cases
    extra: int = 0    # centers outside, pixels drawn
    rounded: int = 0  # of both, those that the rounding of corners may explain
    inside: int = 0   # centers inside a triangle
    compared: int = 0  # pixels in which depth decides
    wrong_depths: int = 0  # those that show another
    failures: dict = dataclasses.field(default_factory=dict)  # case: {pixel: what is wrong}
    masks: dict = dataclasses.field(default_factory=dict)  # case: its answer


def answers(command, cases):
    """What an adapter says of itself, and its answers; or the reason why there are none, as a string."""
    text = "".join(json.dumps(case.fields) + "\n" for case in cases)
    done = subprocess.run(list(map(str, command)), input=text, capture_output=True, text=True)
    if done.returncode == NOT_INSTALLED:
        return done.stderr.strip()
    if done.returncode != 0:
        raise SystemExit(f"scoreboard: {command[1].name}: {done.stderr.strip() or done.returncode}")
    about, *lines = map(json.loads, done.stdout.splitlines())
    if len(lines) != len(cases):
        raise SystemExit(f"scoreboard: {command[1].name}: {len(lines)} answers to {len(cases)} cases")
    for line in lines:
        line["coverage"] = [bytes.fromhex(mask) for mask in line["coverage"]]
    return about, lines


def judged(command, cases):
    """The Score of an adapter, or the reason why there is none."""
    answer = answers(command, cases)
    if isinstance(answer, str):
        return answer
    about, lines = answer
    score = Score(about["name"], about["version"], about["promise"], about.get("is_antialiased", False),
                  about["has_depth"])
    for case, line in zip(cases, lines):
        failures = score.failures.setdefault(case, {})
        score.masks[case] = line["coverage"]
        if case.is_tiling:
            judge_tiling(score, case, line["coverage"], about["grid"], failures)
        if not score.is_antialiased:
            judge_coverage(score, case, line["coverage"], about["grid"], failures)
        if "seen" in line:
            judge_depth(score, case, line["coverage"], line["seen"])
    return score


def judge_tiling(score, case, masks, grid, failures):
    """Near the border of a tiling, where the rounding of corners may take a pixel away, no owner is asked
    for."""
    score.tilings += 1
    nearest = max(reach(triangle, grid) for triangle in case.triangles)
    pixels = case.full_pixels if score.is_antialiased else case.inner_pixels
    inner = {pixel for pixel in pixels if case.border_distance(pixel) > nearest}
    score.owners += len(inner)
    for pixel in range(case.width * case.height):
        parts = [mask[pixel] for mask in masks]
        if score.is_antialiased:
            # Painted over one another, white on black: what black is left.
            black = 255.0
            for part in parts:
                black *= 1 - part / 255
            is_gap, is_twice = black > 1.5, sum(parts) > 255 + len(parts) and pixel in inner
        else:
            is_gap, is_twice = not any(parts), sum(map(bool, parts)) > 1
        if is_gap and pixel in inner:
            score.gaps += 1
            failures[pixel] = "gap"
        if is_twice:
            score.twice += 1
            failures[pixel] = "twice"


def judge_coverage(score, case, masks, grid, failures):
    for pixel, positions in enumerate(case.positions):
        kinds = set()
        for triangle, where in enumerate(positions):
            is_drawn = masks[triangle][pixel] > 0
            score.inside += where == geometry.INSIDE
            if (where == geometry.INSIDE and not is_drawn) or (where == geometry.OUTSIDE and is_drawn):
                score.missed += not is_drawn
                score.extra += is_drawn
                score.rounded += case.distance(triangle, pixel) <= reach(case.triangles[triangle], grid)
                kinds.add("extra" if is_drawn else "missed")
        if kinds:
            failures.setdefault(pixel, kinds.pop() if len(kinds) == 1 else "moved")


def reach(triangle, grid):
    """How far a corner may move when it becomes floats, and then half the diagonal of a cell of the grid."""
    return -1 if grid == 0 else 0.71 * grid + 2.0**-23 * max(
        abs(float(x)) for corner in triangle for x in corner[:2])


def judge_depth(score, case, masks, seen):
    """Judges the pixels in which coverage is right and depth decides: two triangles are there, or what is
    there is beyond a limit."""
    for pixel, (found, positions) in enumerate(zip(seen, case.positions)):
        if any((mask[pixel] > 0) != (where == geometry.INSIDE) for mask, where in zip(masks, positions)):
            continue
        expected = case.seen(pixel, DEPTH_TOLERANCE)
        if expected is not None and (positions.count(geometry.INSIDE) > 1 or
                                     (expected < 0 and geometry.INSIDE in positions)):
            score.compared += 1
            score.wrong_depths += found != expected
