"""Stage text as numbers, each with its line."""
import codecs
import io
import itertools
import re

from lib.maths.matrices import TRANSFORMS
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import name_of
from lib.text import plain_stage_text

# Beginnings of lines of a scene. In a stage text, the word triangle is followed by one number.
SCENE_COMMAND = re.compile(
    rf"^[ \t]*(?:(?:{'|'.join(TRANSFORMS)}|push|pop)\b|triangle[ \t\r]*(?:#|$)|triangle[ \t]+[^\s#]+[ "
    r"\t]+[^\s#])", re.M)
NUMBER = re.compile(r"[-+]?\.?[0-9]")


class StageTextError(CommandFailure):
    """Not a stage text; the message names the location."""


def text_of(data, path):
    """The bytes of a file as text. Bytes that are not UTF-8 are harmless in a comment; elsewhere they are no
    numbers."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or is_utf16(data):
        raise StageTextError(f"{name_of(path)}: this is UTF-16: save it as UTF-8")
    if b"\0" in data:
        raise StageTextError(f"{name_of(path)}: this is neither a text nor a BMP, PPM or PNG")
    return data.decode("utf-8-sig", errors="surrogateescape")


def is_utf16(data):
    """True if every other byte is 0, as in UTF-16 text of ASCII characters without a byte order mark."""
    even, odd = data[:1000:2], data[1:1000:2]
    return any(b"\0" not in letters and len(zeros) > 0 and not any(zeros)
               for letters, zeros in ((even, odd), (odd, even)))


def is_scene(text):
    return SCENE_COMMAND.search(text) is not None


def begins_with_a_camera(text):
    """True if the first four lines are a camera's; a scene without commands consists of those alone."""
    lines = (line.split("#")[0].split() for line in text.split("\n"))
    first = list(itertools.islice((words for words in lines if words), 4))
    if [len(words) for words in first[:3]] != [3, 3, 3] or len(first) < 4:
        return False
    last = first[3]
    return last[0] in ("perspective", "ortho",
                       "frustum") or len(last) > 3 and all(NUMBER.match(word) for word in last[:4])


def parse_stage_text(text, path, may_have_spheres=False):
    """The StageText of a str; `path` names the file in messages."""
    scene = StageTextError(f"{name_of(path)}: this is a scene, not a stage text: run model on it")
    if is_scene(text):
        raise scene
    try:
        return plain_stage_text.read(text, name_of(path), may_have_spheres)
    except plain_stage_text.StageTextError as error:
        raise (scene if begins_with_a_camera(text) else StageTextError(shown(str(error)))) from None


def header_of(data):
    """{keyword: words} of the header lines of a tool's text; if a keyword is repeated, its first line."""
    header = {}
    for line in itertools.takewhile(lambda line: line[:1].isalpha(), io.BytesIO(data)):
        keyword, *words = line.decode(errors="replace").split()
        header.setdefault(keyword, words)
    return header


def header_and_body(data):
    """The header lines of a tool's text of world or view space, and the other lines: three and a blank one
    for each triangle."""
    lines = data.decode().split("\n")
    begin = next((i for i, line in enumerate(lines) if not line[:1].isalpha()), len(lines))
    return lines[:begin], lines[begin:]


def triangle_lines(lines):
    """Yields (number, its three vertex lines) of each triangle, or piece of one; `lines` are the lines of a
    tool's text as bytes, of any length."""
    number, corners, passed_over = 0, [], 0
    for line in lines:
        if line[:1] in b"-0123456789":
            if passed_over:
                passed_over -= 1
                continue
            corners.append(line)
            if len(corners) == 3:
                yield number, corners
                number, corners = number + 1, []
        elif line.startswith(b"triangle "):
            number = int(line[9:])
        elif line == b"clipped\n":  # the whole triangle in clip space; its pieces follow
            passed_over = 3
        elif line == b"sphere\n":  # no triangle, but it has a number
            number, passed_over = number + 1, 4
