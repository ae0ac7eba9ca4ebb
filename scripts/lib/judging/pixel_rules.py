"""What the assignment leaves open in stage 4, and the mistakes that are made there, as changes of
raster.Rule."""
import itertools

from lib.judging.raster import COLUMNS, ENDS_IN_WORDS

CENTER = {"left": "up", "right": "down"}
OPEN_ENDS = [{}, CENTER
             ] + [{"left": left, "right": right}
                  for left, right in itertools.product(("truncated", "rounded", "down", "up"), repeat=2)
                  if (left, right) not in (("rounded", "rounded"), ("up", "down"),
                                           ("up", "up"))]  # up and up is a shift by half a pixel
OPEN_DEPTHS = [{}, {"depth": "between ends"}, {"depth": "between ends", "clamp": 1}, {
    "depth": "between ends", "clamp": 0}, {"depth": "from left"}, {"depth": "from left", "clamp": 0}]
# Mistakes that draw nothing in many scenes.
BLANK = ("starts-at-zero", "one-winding")
# Mistakes by their names, with what they change, in more than one way where programs differ. A way that does
# less than the mistake's sentence says comes after all others.
MISTAKES = [
    (("no-half-pixel-in-x", ), {"half_x": False}), (("no-half-pixel-in-y", ), {"half_y": False}),
    (("no-half-pixel-in-x", "no-half-pixel-in-y"), {"half_x": False, "half_y": False}),
    *((("shifted-by-a-column", ), {"shift": (step, 0), "is_cut_first": is_cut})
      for step in (1, -1)
      for is_cut in (True, False)), *((("shifted-by-a-row", ), {"shift": (0, step)}) for step in (1, -1)),
    (("column-short", ), {"column_more": -1}), (("row-short", ), {"row_short": True}),
    (("column-short", "row-short"), {"column_more": -1, "row_short": True}),
    (("column-long", ), {"column_more": 1}), (("row-long", ), {"row_long": True}),
    *((("min-for-max", ), {"columns": columns}) for columns in filter(None, COLUMNS)),
    (("width-minus-one", ), {"is_one_less": True}), (("strict-edges", ), {"is_strict": True}),
    *((("vertices-at-whole-pixels", ), {"corners": corners}) for corners in ("whole", "rounded")),
    (("width-minus-one", "vertices-at-whole-pixels"), {"is_one_less": True, "corners": "whole"}),
    *((("one-winding", ), {"winding": winding}) for winding in (1, -1)),
    *((("half-triangle", ), {"half": half}) for half in ("upper", "lower")),
    (("starts-at-zero", ), {"starts_at_zero": True}),
    *((("depths-not-sorted", ), change) for change in (
        {"ends_z": "as met"}, {"ends_z": "exchanged"}, {"corners": "sorted down"}, {"corners": "sorted up"})),
    (("window-is-one", ), {"is_window_one": True}),
    (("window-is-one", ), {"is_window_one": True, "is_depth_one": True}),
    (("front-limit-ignored", ), {"has_front": False}), (("rear-limit-ignored", ), {"has_rear": False}),
    (("front-limit-ignored", "rear-limit-ignored"), {"has_front": False, "has_rear": False}),
    (("farthest-wins", ), {"keep": "farthest"}), (("last-wins", ), {"keep": "last"}),
    *((("flat-depth", ), {"flat": flat}) for flat in ("mean", "first", "second", "third", "least", "most")),
    (("upside-down", ), {"picture_flip": "upside down", "text_flip": "upside down"}),
    (("upside-down", ), {"picture_flip": "upside down"}),
    (("text-upside-down", ), {"text_flip": "upside down"}),
    (("mirrored", ), {"picture_flip": "mirrored", "text_flip": "mirrored"}),
    (("mirrored", ), {"picture_flip": "mirrored"}), (("mirrored", ), {"text_flip": "mirrored"}),
    (("rows-and-columns-exchanged", ), {"picture_flip": "transposed", "text_flip": "transposed"}),
    (("rows-and-columns-exchanged", ), {"picture_flip": "transposed"}),
    (("rows-and-columns-exchanged", ), {"text_flip": "transposed"}),
    (("depth-limits-are-one", ), {"is_depth_one": True}),
]


def pairs():
    """(names, changes) for each two mistakes that change different things."""
    for (names, one), (others, other) in itertools.combinations(MISTAKES, 2):
        flips = [any("flip" in key for key in changes) for changes in (one, other)]
        is_single = len(names) == len(others) == 1 and names != others
        if is_single and one.keys().isdisjoint(other) and not all(flips):
            yield (*names, *others), {**one, **other}


def in_words(rule):
    """The open rules in which a rule differs from ours."""
    words = []
    if (rule.left, rule.right) == ("up", "down"):
        words.append("the center rule")
    elif rule.left == rule.right != "rounded":
        words.append(f"ends of rows {ENDS_IN_WORDS[rule.left]}")
    elif rule.left != rule.right:
        words.append(f"left ends of rows {ENDS_IN_WORDS[rule.left]}, right ends {ENDS_IN_WORDS[rule.right]}")
    if rule.depth == "between ends":
        words.append("depths between the rounded ends of a row")
    elif rule.depth == "from left":
        words.append("depths counted on from the left end of a row")
    return ", ".join(words)
