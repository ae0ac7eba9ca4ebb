"""Stage text as numbers, each with its line."""
import codecs
import dataclasses
import itertools
import math
import re

from lib.command import CommandFailure, shown
from lib.input_file import name_of

# Beginnings of lines of a scene, not of a stage text, in which the word triangle is followed by one number.
SCENE_COMMAND = re.compile(
    r"^[ \t]*(?:(?:translate|scale|rotate|push|pop)\b|triangle[ \t\r]*(?:#|$)|triangle[ \t]+[^\s#]+[ "
    r"\t]+[^\s#])",
    re.M)
KEYWORD = re.compile("[A-Za-z]")
NUMBER = re.compile(r"[-+]?\.?[0-9]")
DECIMAL_COMMA = re.compile("[0-9],[0-9]")
NO_KEYWORDS = ("nan", "inf", "infinity")


class StageTextError(CommandFailure):
    """Not a stage text; the message names the location."""


@dataclasses.dataclass
class Vertex:
    line: int       # from 1
    numbers: tuple  # x, y, z and the attributes


@dataclasses.dataclass
class StageText:
    header: dict     # {keyword: words}; for light, those of the last one
    triangles: list  # of three vertices each
    names: list      # the scene's number of each triangle
    spheres: list = dataclasses.field(default_factory=list)  # of four vertices each

    @property
    def vertices(self):
        return [vertex for triangle in self.triangles for vertex in triangle]

    @property
    def points(self):
        return [vertex.numbers[:3] for vertex in self.vertices]


def text_of(data, path):
    """The bytes of a file as text. Bytes that are not UTF-8 do no harm in a comment, and are no number
    elsewhere."""
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) or is_utf16(data):
        raise StageTextError(f"{name_of(path)}: this is UTF-16: save it as UTF-8")
    if b"\0" in data:
        raise StageTextError(f"{name_of(path)}: this is neither a text nor a BMP, PPM or PNG")
    return data.decode("utf-8-sig", errors="surrogateescape")


def is_utf16(data):
    """Whether every other byte is 0, as in UTF-16 text of ASCII characters without a byte order mark."""
    even, odd = data[:1000:2], data[1:1000:2]
    return any(b"\0" not in letters and len(zeros) > 0 and not any(zeros)
               for letters, zeros in ((even, odd), (odd, even)))


def is_scene(text):
    return SCENE_COMMAND.search(text) is not None


def begins_with_a_camera(text):
    """Whether the first four lines are a camera's; a scene without commands consists of those alone."""
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
        return parsed(text, name_of(path), may_have_spheres)
    except StageTextError:
        if begins_with_a_camera(text):
            raise scene from None
        raise


def real(word):
    """The value of a word that the tools accept as a number, too: decimal and finite."""
    value = float(word)
    if not (math.isfinite(value) and word.isascii() and "_" not in word):
        raise ValueError
    return value


def parsed(text, name, may_have_spheres):
    header, vertices, names, next_name, passed_over = {}, [], [], 0, 0
    spheres, of_sphere = [], 0  # and how many lines of the last one are still to come
    for number, line in enumerate(text.split("\n"), 1):
        words = line.split("#")[0].split()
        if not words or words[0] in ("framed", "end"):
            continue
        if words[0] == "error":
            raise StageTextError(f"{name}:{number}: {shown(' '.join(words[1:]))}")
        if KEYWORD.match(words[0]) and words[0].lower() not in NO_KEYWORDS:
            if words[0] == "triangle":
                next_name = triangle_number(" ".join(words[1:]), f"{name}:{number}")
            elif words[0] == "clipped":  # the whole triangle in clip space; its pieces follow
                passed_over = 3
            elif words[0] == "sphere" and may_have_spheres:
                next_name, of_sphere = next_name + 1, 4
                spheres.append([])
            elif words[0] == "sphere":
                raise StageTextError(
                    f"{name}:{number}: expected triangles alone, found a sphere: trace draws it, and model "
                    f"--facets N makes triangles of it"
                )
            else:
                header[words[0]] = words[1:]
            continue
        if passed_over:
            passed_over -= 1
            continue
        try:
            numbers = tuple(real(word) for word in words)
        except ValueError:
            comma = ": write a decimal point, not a comma" if DECIMAL_COMMA.search(line) else ""
            raise StageTextError(
                f"{name}:{number}: expected numbers, found '{shown(line.strip()[:40])}'{comma}") from None
        if len(numbers) < 3:
            raise StageTextError(
                f"{name}:{number}: expected x, y and z, found "
                f"{'1 number' if len(numbers) == 1 else f'{len(numbers)} numbers'}"
            )
        if of_sphere:
            of_sphere -= 1
            spheres[-1].append(Vertex(number, numbers))
            continue
        if len(vertices) % 3 == 0:
            names.append(next_name)
            next_name += 1
        vertices.append(Vertex(number, numbers))
    if len(vertices) % 3:
        raise StageTextError(f"{name}: expected three vertices a triangle, found {len(vertices)} in all")
    if of_sphere:
        raise StageTextError(
            f"{name}: expected four vertices a sphere, found {4 - of_sphere} of the last one")
    return StageText(header, [vertices[i:i + 3] for i in range(0, len(vertices), 3)], names, spheres)


def triangle_lines(lines):
    """(number, its three vertex lines) of each triangle, or piece of one, as they come; `lines` are the bytes
    of a text that a tool has written, however long."""
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


def triangle_number(word, place):
    if not re.fullmatch("[0-9]{1,20}", word):
        raise StageTextError(f"{place}: expected a triangle's number, found '{shown(word[:40])}'")
    return int(word)
