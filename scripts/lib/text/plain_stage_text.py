"""Stage text in Python: a reader and a writer in one file, which needs no other and may be copied.

    import stage_text
    text = stage_text.read(open("stage1.txt").read(), "stage1.txt")
    for triangle in text.triangles:
        print([vertex.numbers[:3] for vertex in triangle])
    print(stage_text.write(text), end="")

docs/stage-text.md defines the text. If project has cut a triangle, its pieces are read, not the whole.
"""
import dataclasses
import math
import re

KEYWORD = re.compile("[A-Za-z]")
NUMBERS_OF = {"color": 3, "normal": 3}
NO_KEYWORDS = ("nan", "inf", "infinity")
DECIMAL_COMMA = re.compile("[0-9],[0-9]")


class StageTextError(ValueError):
    """Not a stage text; the message names the location."""


@dataclasses.dataclass
class Vertex:
    line: int  # from 1
    numbers: tuple  # x, y, z and the attributes


@dataclasses.dataclass
class StageText:
    header: dict  # {keyword: words}; of several lights, the last
    triangles: list  # of three vertices each
    names: list  # the scene's number of each triangle
    spheres: list = dataclasses.field(default_factory=list)  # of four vertices each
    header_lines: list = dataclasses.field(default_factory=list)  # the words of each, in order

    @property
    def vertices(self):
        return [vertex for triangle in self.triangles for vertex in triangle]

    @property
    def points(self):
        return [vertex.numbers[:3] for vertex in self.vertices]


def write(text, decimals=7):
    """The text of a StageText without spheres: coordinates, colors and normals with `decimals` decimals, w
    with the digits that it needs."""
    lines, expected = [" ".join(words) for words in text.header_lines], 0
    is_fixed = [True] * 3
    for word in text.header.get("attributes", []):
        is_fixed += [word in NUMBERS_OF] * NUMBERS_OF.get(word, 1)
    for name, triangle in zip(text.names, text.triangles):
        if name != expected:
            lines.append(f"triangle {name}")
        expected = name + 1
        for vertex in triangle:
            lines.append(" ".join(
                f"{x:.{decimals}f}" if fixed else shortest(x) for x, fixed in zip(vertex.numbers, is_fixed)))
        lines.append("")
    return "".join(line + "\n" for line in lines)


def shortest(x):
    """The shortest decimal that reads back as this number, without an exponent where it has few digits."""
    return str(int(x)) if x == int(x) and abs(x) < 1e15 else repr(float(x))


def real(word):
    """The value of a word, which has to be a number for the tools, too: decimal and finite."""
    value = float(word)
    if not (math.isfinite(value) and word.isascii() and "_" not in word):
        raise ValueError
    return value


def read(text, name="text", may_have_spheres=False):
    """The StageText of a str; `name` is the file's in messages. Raises a StageTextError."""
    reader = Reader(may_have_spheres)
    for number, line in enumerate(text.split("\n"), 1):
        try:
            reader.take(number, line)
        except StageTextError as error:
            raise StageTextError(f"{name}:{number}: {error}") from None
    vertices, missing = reader.vertices, reader.of_sphere
    if len(vertices) % 3:
        raise StageTextError(f"{name}: expected three vertices a triangle, found {len(vertices)} in all")
    if missing:
        raise StageTextError(f"{name}: expected four vertices a sphere, found {4 - missing} of the last one")
    reader.found.triangles = [vertices[i:i + 3] for i in range(0, len(vertices), 3)]
    return reader.found


class Reader:
    """Takes lines; its errors name no location."""
    def __init__(self, may_have_spheres):
        self.may_have_spheres, self.found = may_have_spheres, StageText({}, [], [])
        self.vertices, self.next_name = [], 0
        self.passed_over = self.of_sphere = 0  # lines of a clipped triangle, of a sphere, still to come

    def take(self, number, line):
        words = line.split("#")[0].split()
        if not words or words[0] in ("framed", "end"):
            return
        if KEYWORD.match(words[0]) and words[0].lower() not in NO_KEYWORDS:
            self.take_keyword(words)
        elif self.passed_over:
            self.passed_over -= 1
        else:
            vertex = Vertex(number, numbers_of(line, words))
            if self.of_sphere:
                self.of_sphere -= 1
                self.found.spheres[-1].append(vertex)
                return
            if len(self.vertices) % 3 == 0:
                self.found.names.append(self.next_name)
                self.next_name += 1
            self.vertices.append(vertex)

    def take_keyword(self, words):
        keyword, *rest = words
        if keyword == "error":
            raise StageTextError(" ".join(rest))
        if keyword == "triangle":
            self.next_name = triangle_number(" ".join(rest))
        elif keyword == "clipped":  # the whole triangle in clip space; its pieces follow
            self.passed_over = 3
        elif keyword != "sphere":
            self.found.header[keyword] = rest
            self.found.header_lines.append(words)
        elif self.may_have_spheres:
            self.next_name, self.of_sphere = self.next_name + 1, 4
            self.found.spheres.append([])
        else:
            raise StageTextError("expected triangles alone, found a sphere: trace draws it, and model "
                                 "--facets N makes triangles of it")


def numbers_of(line, words):
    """The numbers of a vertex line."""
    try:
        numbers = tuple(real(word) for word in words)
    except ValueError:
        comma = ": write a decimal point, not a comma" if DECIMAL_COMMA.search(line) else ""
        raise StageTextError(f"expected numbers, found '{line.strip()[:40]}'{comma}") from None
    if len(numbers) < 3:
        count = "1 number" if len(numbers) == 1 else f"{len(numbers)} numbers"
        raise StageTextError(f"expected x, y and z, found {count}")
    return numbers


def triangle_number(word):
    if not re.fullmatch("[0-9]{1,20}", word):
        raise StageTextError(f"expected a triangle's number, found '{word[:40]}'")
    return int(word)
