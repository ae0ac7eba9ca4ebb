"""Sentences of docs/ that rest on measured figures. A comment behind such a sentence, on the same line, names
them:

    ... costs 1.7 times as much <!-- rests on: cpu(plain, --digits exact) / cpu(plain, default) about 1.7 -->

A figure is COLUMN(SCENE, SETTING), or the quotient of two. `about N` is within a sixth of N, which the
sentence has to contain; `in A..B` includes both. Several are separated by `;`.
"""
import re

NOTE = re.compile(r"<!-- rests on: (.*?) -->")
FIGURE = r"\w+\([^()]+\)"
CLAIM = re.compile(rf"({FIGURE})(?: / ({FIGURE}))? (?:about (\S+)|in (\S+)\.\.(\S+))")
ABOUT = 7 / 6
COLUMNS = {  # what a column is called in a claim: (column, is it for a triangle)
    "cpu": ("cpu_seconds", True),
    "wall": ("wall_seconds", True),
    "instructions": ("instructions", False),
    "bytes": ("bytes", False),
    "memory": ("mib", False),
    "empty": ("empty_cpu_seconds", False),
    "vertex_error": ("vertex_error_pixels", False),
    "difference": ("difference_mean", False),
    "changed": ("channels_changed", False),
    "depth_error": ("depth_error_median", False),
}


def figure(words, results):
    """The figure's value, or None if it was not measured."""
    name, scene, setting = re.fullmatch(r"(\w+)\((\w[^,]*), (.+)\)", words).groups()
    if name in ("fighting", "swallowed"):  # the scene is a distance
        row = results.epsilon.get((setting, scene))
        return float(row[name]) if row else None
    if name in ("wrong", "off_center"):
        parts = ["wrong_pixels", "flipped_pixels"] if name == "wrong" else ["off_center_pixels"]
        return None if results.cell(scene, setting, parts[0]) is None else results.share(
            scene, setting, *parts)
    column, is_per_triangle = COLUMNS[name]
    return (results.per_triangle if is_per_triangle else results.cell)(scene, setting, column)


def value_of(claim, results):
    one, other = (figure(words, results) if words else 1.0 for words in claim.group(1, 2))
    return None if one is None or not other else one / other


def broken_claim(claim, sentence, results):
    """What is wrong with a claim, or None."""
    value = value_of(claim, results)
    if value is None:
        return "was not measured"
    about, low, high = claim.group(3, 4, 5)
    if about:
        if not re.search(rf"(?<![\d.]){re.escape(about)}(?![\d]|\.\d)", sentence):
            return f"is not in the sentence, which ought to have {about}"
        low, high = float(about) / ABOUT, float(about) * ABOUT
    return None if float(low) <= value <= float(high) else f"is {value:.3g}"


def claims(page):
    """(sentence, claim) for each claim of a page; a note that is none ends the script."""
    for line in page.splitlines():
        sentence = NOTE.sub("", line)
        for note in NOTE.findall(line):
            for words in note.split("; "):
                claim = CLAIM.fullmatch(words)
                if not claim:
                    raise SystemExit(f"no claim: {words}")
                yield sentence, claim


def broken_claims(page, results):
    """A line for each claim that does not hold."""
    for sentence, claim in claims(page):
        if wrong := broken_claim(claim, sentence, results):
            yield f"'{claim[0]}' {wrong}: {sentence.strip()}"
