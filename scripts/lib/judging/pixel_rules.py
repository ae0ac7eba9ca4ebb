"""The rules of stage 4 to try, as changes of raster.Rule: those that are open, and mistakes of programs."""
import itertools

from lib.judging.raster import FLAT_ROW, FLAT_TRIANGLE

CENTER = {"left": "up", "right": "down"}
OUR_ENDS = ({"left": "rounded", "right": "rounded"}, CENTER)
ENDS = ({"left": left, "right": right}
        for left, right in itertools.product(("truncated", "rounded", "down", "up"), repeat=2))
OPEN_ENDS = [*OUR_ENDS, *(ends for ends in ENDS if ends not in OUR_ENDS)]
OPEN_DEPTHS = [{}, {"depth": "between ends"}, {"depth": "between ends", "clamp": 1}, {
    "depth": "between ends", "clamp": 0}, {"depth": "from left"}, {"depth": "from left", "clamp": 0}]
# mistakes that draw nothing, most of them only in some scenes
BLANK = ("starts-at-zero", "one-winding", "no-depth-passes", "black-picture")
MOST_PAIRS = 4  # of mistakes that explain the same, before none is named


def flipped(how):
    """Both files flipped, the picture alone, and the text alone."""
    return [{"picture_flip": how, "text_flip": how}, {"picture_flip": how}, {"text_flip": how}]


# {mistake, or several at once: the ways to make it, in the order to try}. A way that does less than the
# mistake's sentence claims comes after all others.
WAYS = {
    "no-half-pixel-in-x": [{"half_x": False}],
    "no-half-pixel-in-y": [{"half_y": False}],
    "no-half-pixel-in-x no-half-pixel-in-y": [{"half_x": False, "half_y": False}],
    "shifted-by-a-column": [
        {"shift": (step, 0), "is_cut_first": is_cut} for step in (1, -1) for is_cut in (True, False)],
    "shifted-by-a-row": [{"shift": (0, step)} for step in (1, -1)],
    "column-short": [{"column_more": -1}, {"columns_before": -1}],
    "row-short": [{"row_short": True}],
    "column-short row-short": [{"column_more": -1, "row_short": True}],
    "column-long": [{"column_more": 1}, {"columns_before": 1}],
    "row-long": [{"row_long": True}],
    "min-for-max": [{"columns": "to the border"}, {"columns": "from the border"}, {
        "columns": "at the left end"}, {"columns": "at the right end"}],
    "width-minus-one": [{"is_one_less": True}],
    "strict-edges": [{"is_strict": True}],
    "vertices-at-whole-pixels": [{"corners": "whole"}, {"corners": "rounded"}],
    "width-minus-one vertices-at-whole-pixels": [{"is_one_less": True, "corners": "whole"}],
    "one-winding": [{"winding": 1}, {"winding": -1}],
    "half-triangle": [{"half": "upper"}, {"half": "lower"}],
    "starts-at-zero": [{"starts_at_zero": True}],
    "depths-not-sorted": [{"ends_z": "as met"}, {"ends_z": "exchanged"}, {"corners": "sorted down"}, {
        "corners": "sorted up"}],
    "window-is-one": [{"window": "one"}, {"window": "one", "is_depth_one": True}],
    "left-and-bottom-exchanged": [{"window": "exchanged"}],
    "front-limit-ignored": [{"has_front": False}],
    "rear-limit-ignored": [{"has_rear": False}],
    "front-limit-ignored rear-limit-ignored": [{"has_front": False, "has_rear": False}],
    "farthest-wins": [{"keep": "farthest"}],
    "last-wins": [{"keep": "last"}],
    "flat-depth": [{"flat": flat} for flat in FLAT_TRIANGLE],
    "one-depth-a-row": [{"flat": flat} for flat in FLAT_ROW],
    "no-depth-passes": [{"keep": "none"}],
    "black-picture": [{"keep": "none"}],
    "upside-down": flipped("upside down")[:2],
    "text-upside-down": flipped("upside down")[2:],
    "mirrored": flipped("mirrored"),
    "turned-by-180-degrees": flipped("turned"),
    "rows-and-columns-exchanged": flipped("transposed"),
    "depth-limits-are-one": [{"is_depth_one": True}],}
MISTAKES = [(tuple(names.split()), changes) for names, ways in WAYS.items() for changes in ways]


def pairs(mistakes):
    """(names, changes) for each two of some MISTAKES that change different things."""
    for (names, one), (others, other) in itertools.combinations(mistakes, 2):
        flips = [any("flip" in key for key in changes) for changes in (one, other)]
        is_single = len(names) == len(others) == 1 and names != others
        if is_single and one.keys().isdisjoint(other) and not all(flips):
            yield (*names, *others), {**one, **other}


def can_matter(changes, window, shown):
    """True if a change can make a difference in this window, to the files that are there."""
    has_both = shown.colors and shown.depths
    return not (changes.get("window") == "one" and (window.left, window.bottom) == (-1, -1)
                or changes.get("window") == "exchanged" and window.left == window.bottom
                or changes.get("keep") == "none" or changes.get("is_depth_one") and
                (window.front, window.rear) == (-1, 1) or changes.get("starts_at_zero") and window.rear == 0
                or "transposed" in changes.values() and window.width != window.height
                or changes.get("text_flip", "") != changes.get("picture_flip", "") and not has_both)


def open_rules(window, readings, has_depths):
    """(rank, changes) of the rules left open, the usual ones first; of depth only where that matters."""
    dx = -2 * float(window.left)
    is_beyond = any(abs(p[0]) > dx / 2 for points, _ in readings.values() for p in points)
    depths = [
        rule for rule in OPEN_DEPTHS[:None if has_depths else 1] if is_beyond or rule.get("clamp") is None]
    rules = [((i > 1) + (j > 0), {**ends, **depth}) for i, ends in enumerate(OPEN_ENDS)
             for j, depth in enumerate(depths)
             if is_beyond or ends == CENTER or "down" not in ends.values()]  # columns are not negative then
    return sorted(rules, key=lambda pair: pair[0])
