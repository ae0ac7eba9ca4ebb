"""The projection in a stage text's header, in doubles."""
import math

KEYWORDS = ("perspective", "frustum", "ortho")


def with_keyword(words):
    """The words of a scene's fourth line, which may leave out the first one."""
    return words if words and words[0] in KEYWORDS else ["perspective", *words]


def line_of(words_of):
    """The header line of the projection, in words; `words_of` gives the words after a keyword, or None."""
    return next([keyword, *words_of(keyword)] for keyword in KEYWORDS if words_of(keyword))


def tangents(header):
    """The tangents of half the field of view of a perspective, horizontal and vertical."""
    fov_y, aspect = map(float, header["perspective"][:2])
    top = math.tan(math.radians(fov_y) / 2)
    if header["perspective"][4:] == ["ratio"]:
        return aspect * top, top
    return math.tan(math.radians(fov_y * aspect) / 2), top


def window_of(header):
    """left, right, bottom, top, near and far of a perspective, a frustum or an ortho."""
    if "perspective" not in header:
        return tuple(map(float, header.get("frustum") or header["ortho"]))
    near, far = map(float, header["perspective"][2:4])
    right, top = (near * tangent for tangent in tangents(header))
    return -right, right, -top, top, near, far
