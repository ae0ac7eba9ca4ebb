"""A note where a scene's squares are not drawn as squares."""
import re

from lib.text.projection import tangents

FOURTH_LINE = " in the scene's fourth line"


def note_on_squares(projection, config):
    """A note if a projection (the words of a header line) and the text of a config draw a square that faces
    the camera more than 1 % off square: by how much, and how to correct it. Else an empty text."""
    columns, rows, left, bottom, *_ = [*map(float, re.sub(r"#.*", "", config).split()), -1, -1]
    keyword, *words = projection
    # The aspect that a window with square pixels would have.
    square, has_ratio = columns * bottom / (rows * left), words[4:] == ["ratio"]
    if keyword == "perspective":
        horizontal, vertical = tangents({keyword: words})
        window = horizontal / vertical
    else:
        window = abs((float(words[1]) - float(words[0])) / (float(words[3]) - float(words[2])))
    if is_close(window, square):
        return ""
    mend = f"let the aspect be {square:.6g}{FOURTH_LINE}"
    if keyword != "perspective":
        mend = f"let (right - left) / (top - bottom) be {square:.6g}{FOURTH_LINE}"
    elif not has_ratio and is_close(float(words[1]), square):
        mend = "end the scene's fourth line in ratio"
    elif not has_ratio and not is_close(square, 1):
        mend += ", and end that line in ratio"
    return f"a square is drawn {square / window:.3g} times as wide as high: {mend}"


def is_close(a, b):
    return a <= 1.01 * b and b <= 1.01 * a
