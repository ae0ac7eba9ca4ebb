"""Finds what most of the wrong numbers of a run have in common."""
import statistics

from .judge import NUMBER

AXES = ("x", "y", "z")
MOST_POINTS = 200  # of a case
FEWEST = 6  # wrong numbers that may tell something


def is_close(a, b):
    return abs(a - b) <= 2e-6 * max(1.0, abs(a), abs(b))


def wrong_points(expected, found, is_stage_text):
    """Pairs of what a vertex should be and what it is, where they differ; of depths, numbers in tuples of
    one."""
    texts = [[line.split() for line in text.decode("latin-1").splitlines() if line.split()]
             for text in (expected, found)]
    size, pairs = 3 if is_stage_text else 1, []
    if list(map(len, texts[0])) != list(map(len, texts[1])):
        return ()
    for lines in zip(*texts):
        if all(NUMBER.fullmatch(word) for line in lines for word in line):
            want, got = (list(map(float, line)) for line in lines)
            for at in range(0, 1 if is_stage_text else len(want), size):
                pair = tuple(want[at:at + size]), tuple(got[at:at + size])
                pairs += [pair] * (not all(map(is_close, *pair)))
    return tuple(pairs[:MOST_POINTS])


def guesses(axis, axes, wrong):
    """(what an axis may be, the test of a vertex and its number) to try, the plainest first."""
    yield "negated", lambda want, got: is_close(got, -want[axis])
    for other in range(len(axes)):
        if other != axis:
            yield f"what {axes[other]} should be", lambda want, got, k=other: is_close(got, want[k])
            yield f"what {axes[other]} should be, negated", lambda want, got, k=other: is_close(got, -want[k])
    yield "0", lambda want, got: is_close(got, 0)
    yield "cut to whole numbers", lambda want, got: got == int(want[axis])
    factor = statistics.median_low(got / want[axis] if want[axis] else 0 for want, got in wrong)
    yield f"{factor:.6g} times what should be", lambda want, got: is_close(got, factor * want[axis])
    offset = statistics.median_low(got - want[axis] for want, got in wrong)
    yield f"{'greater' if offset > 0 else 'less'} by {abs(offset):.6g}", lambda want, got: is_close(
        got, want[axis] + offset)


def sentence(points):
    """A sentence on what three of four wrong numbers share: "87 of 89 wrong numbers: x and z are negated";
    empty if nothing."""
    axes = AXES if points and len(points[0][0]) == 3 else ("the depths",)
    found, total, explained = {}, 0, 0
    for axis, name in enumerate(axes):
        wrong = [(want, got[axis]) for want, got in points if not is_close(want[axis], got[axis])]
        total += len(wrong)
        if wrong:
            tried = [
                (sum(test(*pair) for pair in wrong), words) for words, test in guesses(axis, axes, wrong)]
            hits, words = max(tried, key=lambda item: item[0])
            if 2 * hits > len(wrong):
                explained += hits
                found.setdefault(words, []).append(name)
    if total < FEWEST or 4 * explained < 3 * total:
        return ""
    parts = [
        f"{listed(names)} {'are' if names != names[:1] or axes != AXES else 'is'} {words}"
        for words, names in found.items()]
    return f"{explained} of {total} wrong numbers: {', '.join(parts)}"


def listed(names):
    return " and ".join([", ".join(names[:-1]), names[-1]] if names[:-1] else names)
