"""Stage text as numbers, each with the line it stands on."""
import dataclasses
import math


class StageTextError(Exception):
    """Not a stage text; the message says where."""


@dataclasses.dataclass
class Vertex:
    line: int       # from 1
    numbers: tuple  # x, y, z and what the attributes add


@dataclasses.dataclass
class StageText:
    header: dict     # of a keyword's words; of light, those of the last one
    triangles: list  # of three vertices each
    names: list      # the scene's number of each triangle

    @property
    def vertices(self):
        return [vertex for triangle in self.triangles for vertex in triangle]

    @property
    def points(self):
        return [vertex.numbers[:3] for vertex in self.vertices]


def real(word):
    value = float(word)
    if not math.isfinite(value):
        raise ValueError
    return value


def parse_stage_text(text, file):
    """The StageText of a str; `file` is its name in messages."""
    header, vertices, names, next_name, passed_over = {}, [], [], 0, 0
    for number, line in enumerate(text.split("\n"), 1):
        words = line.split("#")[0].split()
        if not words or words[0] in ("framed", "end"):
            continue
        if words[0] == "error":
            raise StageTextError(f"{file}:{number}: {' '.join(words[1:])}")
        if words[0][0].isalpha() and words[0].lower() not in ("nan", "inf"):
            if words[0] == "triangle":
                next_name = int(words[1])
            elif words[0] == "clipped":  # the whole triangle in clip space; its pieces follow
                passed_over = 3
            else:
                header[words[0]] = words[1:]
            continue
        if passed_over:
            passed_over -= 1
            continue
        try:
            numbers = tuple(real(word) for word in words)
        except ValueError:
            raise StageTextError(f"{file}:{number}: expected numbers, found '{line.strip()[:40]}'") from None
        if len(numbers) < 3:
            raise StageTextError(f"{file}:{number}: expected x, y and z, found {len(numbers)} numbers")
        if len(vertices) % 3 == 0:
            names.append(next_name)
            next_name += 1
        vertices.append(Vertex(number, numbers))
    if len(vertices) % 3:
        raise StageTextError(f"{file}: expected three vertices a triangle, found {len(vertices)} in all")
    return StageText(header, [vertices[i:i + 3] for i in range(0, len(vertices), 3)], names)
