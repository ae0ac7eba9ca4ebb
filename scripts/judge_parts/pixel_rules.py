"""What the assignment leaves open in stage 4, and the mistakes that are made there, as changes of
raster.Rule."""
import itertools

from judge_parts.raster import ENDS_IN_WORDS
from judge_parts.verdict import Cause, cause_of

CENTER = {"left": "up", "right": "down"}
OPEN_ENDS = [{}, CENTER
             ] + [{"left": left, "right": right}
                  for left, right in itertools.product(("truncated", "rounded", "down", "up"), repeat=2)
                  if (left, right) not in (("rounded", "rounded"), ("up", "down"),
                                           ("up", "up"))]  # up and up is a shift by half a pixel
OPEN_DEPTHS = [{}, {"depth": "between ends"}, {"depth": "between ends", "clamp": 1}, {
    "depth": "between ends", "clamp": 0}, {"depth": "from left"}, {"depth": "from left", "clamp": 0}]
# Of the mistakes this one is not in the list.
DEPTHS_ARE_ONE = "The depth limits are -1 and 1 in place of those of the config"
# Mistakes by their names, with what they change, in more than one way where programs differ. A way that does
# less than the mistake's sentence says comes after all others.
MISTAKES = [
    (("no-half-pixel-in-x", ), {"half_x": False}), (("no-half-pixel-in-y", ), {"half_y": False}),
    (("no-half-pixel-in-x", "no-half-pixel-in-y"), {"half_x": False, "half_y": False}),
    *((("shifted-by-a-column", ), {"shift": (step, 0), "is_cut_first": is_cut})
      for step in (1, -1)
      for is_cut in (True, False)), *((("shifted-by-a-row", ), {"shift": (0, step)}) for step in (1, -1)),
    (("column-short", ), {"column_short": True}), (("row-short", ), {"row_short": True}),
    (("column-short", "row-short"), {"column_short": True, "row_short": True}),
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
    ((DEPTHS_ARE_ONE, ), {"is_depth_one": True}),
]


def cause_of_all(names):
    """The cause of one mistake, or of several made together."""
    causes = [Cause("", name) if name == DEPTHS_ARE_ONE else cause_of("zbuf/" + name) for name in names]
    if len(causes) == 1:
        return causes[0]
    return Cause(" and ".join(cause.name for cause in causes),
                 "; and: ".join(cause.text.rstrip(".") for cause in causes))


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
