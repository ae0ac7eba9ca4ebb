#!/usr/bin/env python3
"""The pipeline as docs/scene.md, docs/stage-text.md and docs/stages.md define it: slow, exact, and in the order of those pages.

usage: reference.py model|view|project|zbuf [OPTION...] < INPUT > OUTPUT, with the options of the tools (OPTIONS, below)

A comment behind each function names the paragraphs that it carries out. Numbers are fractions; sines and roots, which no fraction
holds, have 800 decimals. The program needs only the standard library, and shares no code with libpipeline.
"""
# yapf: disable: a rule of the specification is a line.
import decimal, math, pathlib, re, struct, sys  # noqa: E401
from collections import namedtuple
from decimal import Decimal
from fractions import Fraction

DECIMALS = 800
decimal.setcontext(decimal.Context(prec=DECIMALS + 330, Emax=10**6, Emin=-10**6))
SHADING = decimal.Context(prec=50, Emax=10**9, Emin=-10**9)
LARGEST = 2**1024 - 2**970  # from here on the nearest double is infinite

Part = namedtuple("Part", "line kind numbers rule", defaults=(None,))  # a line of a camera or of a header
Vertex = namedtuple("Vertex", "line position w color normal written material", defaults=(None,) * 5)  # written: the words of x, y, z
Triangle = namedtuple("Triangle", "number corners whole", defaults=(None,))  # whole: the corners in clip space, if it is a piece

# scene.md: lines, words and numbers
class Refused(Exception): pass  # S5, O3: its arguments are the line (0 is the command line), and what breaks a rule there

class Line:  # S1b, S2: the words of a line, which are taken one after the other
    def __init__(self, number, text):
        text, self.comment, _ = text.partition("#")
        self.number, self.words = number, [word for word in re.split("[ \t]+", text.rstrip(" \t\r")) if word]

    def refuse(self, expected):  # S5
        raise Refused(self.number, f"expected {expected}, found {self.words[0] if self.words else 'the end of the line'}")

    def take(self, *choices):  # S2: the next word if it is one of these, else None
        return self.words.pop(0) if self.words and self.words[0] in choices else None

    def real(self):  # S3: the next number
        is_number = self.words and re.fullmatch(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?", self.words[0])
        if not is_number or math.isinf(float(self.words[0])):
            self.refuse("a number in a double's range")
        return Fraction(float(self.words.pop(0)))

    def reals(self, *conditions):  # S3: a number for each condition, which takes it and those before it, the last first
        numbers = ()
        for condition in conditions:
            numbers = (self.real(), *numbers)
            if not condition(*numbers):
                raise Refused(self.number, f"{float(numbers[0])}: not a number that may stand here")
        return numbers[::-1]

    def whole(self):  # S4: the next whole number
        if not self.words or not re.fullmatch("[0-9]+", self.words[0]) or int(self.words[0]) >= 2**64:
            self.refuse("a whole number")
        return int(self.words.pop(0))

    def end(self):  # S10, T1: nothing else stands on the line
        if self.words:
            self.refuse("the end of the line")

class Text:  # S1: a text, read line by line
    def __init__(self, data):
        self.lines, self.at = data.removeprefix(b"\xef\xbb\xbf").decode("latin-1").split("\n"), 0
        self.is_ended = self.lines[-1] == ""
        self.lines = self.lines[:-1] if self.is_ended else self.lines

    def line(self, missing):  # S1, S1a, S5 to S5b: the next line, blank or not
        if self.at == len(self.lines):
            raise Refused(self.at + 1, f"expected {missing}, found the end of the text")
        self.at += 1
        if len(self.lines[self.at - 1]) > 2**20:
            raise Refused(self.at, "a line of more than 2^20 bytes")
        return Line(self.at, self.lines[self.at - 1])

    def filled_line(self, missing=None):  # S1c, S5: the next line with a word; at the end None, if nothing is missing
        while missing or self.at < len(self.lines):
            if (line := self.line(missing)).words:
                return line
        return None

    def expect_end(self):  # S14, T13, C3: only blank lines follow
        if line := self.filled_line():
            line.refuse("nothing more")

# scene.md: the camera, commands, color and light
ANY, POSITIVE = (lambda x, *before: True), (lambda x, *before: x > 0)
NOT_NEGATIVE, CHANNEL = (lambda x, *before: x >= 0), (lambda x, *before: 0 <= x <= 255)
DEPTHS = [lambda far, near, *before: far > near]
WINDOW = [ANY, lambda right, left: right != left, ANY, lambda top, bottom, *before: top != bottom]
# S6, S7, S12, S17 to S21: the numbers behind a keyword, by their conditions.
ARGUMENTS = {
    "eye": [ANY] * 3, "look": [ANY] * 3, "up": [ANY] * 3, "translate": [ANY] * 3, "scale": [ANY] * 3,
    "rotate": [ANY] * 3 + [lambda z, y, x, angle: any((x, y, z))],
    "perspective": [lambda degrees: 0 < degrees < 180, POSITIVE, POSITIVE] + DEPTHS,
    "frustum": WINDOW + [POSITIVE] + DEPTHS, "ortho": WINDOW + [ANY] + DEPTHS,
    "color": [CHANNEL] * 3, "background": [CHANNEL] * 3,  # and perhaps an alpha, in read_part
    "ambient": [NOT_NEGATIVE] * 3, "light": [ANY] * 3 + [NOT_NEGATIVE] * 3,
    "material": [NOT_NEGATIVE] * 3,  # and the rest, in read_part
    "absorption": [NOT_NEGATIVE] * 3, "paint": [CHANNEL] * 3,
    "attenuation": [NOT_NEGATIVE] * 2 + [lambda x, *before: x >= 0 and any((x, *before))]}
COLUMNS = {"w": [POSITIVE], "color": [CHANNEL] * 3, "normal": [ANY] * 3}  # and the material, in read_vertex
POSITION, PROJECTIONS = ("eye", "look", "up"), ("perspective", "frustum", "ortho")
OPTICS = [lambda x: 0 <= x <= 1, lambda x, *before: Fraction(0.01) <= x <= 100, lambda x, *before: 0 <= x <= 1]
ONCE, REPEATED = ("background", "ambient", "attenuation"), ("material", "light", "absorption", "paint")

def read_part(line, keyword):  # S6 to S8, S12, S17 to S21, T2 to T6a: the rest of a line, behind the keyword if it is there
    numbers = line.reals(*ARGUMENTS[keyword])
    if keyword == "material":
        numbers += (line.whole(),) if re.fullmatch("[0-9]+", "".join(line.words[:1])) else line.reals(lambda x: 0 <= x < 2**64 and x.denominator == 1)
        numbers += line.reals(*OPTICS) if line.words else (0, 1, 1)
    if keyword == "background" and line.words:  # S18: an alpha of 255 is as good as none
        numbers += tuple(alpha for alpha in line.reals(CHANNEL) if alpha < 255)
    rule = line.take("angle", "ratio") if keyword == "perspective" else None
    line.end()
    return Part(line.number, keyword, numbers, rule)

def add_to_material(header, part, at):  # S19c, S19e: the one above
    above = header.get("material", [Part(at, "none", (), {part.kind: part})])[-1]
    if part.kind in (above.rule or {}):
        raise Refused(at, f"{part.kind}: without a material of its own")
    header["material"][-1] = above._replace(rule={**(above.rule or {}), part.kind: part})

def check_camera(camera):  # S9: of the parts that are there
    eye, look, up = (camera.get(name) for name in POSITION)
    if up and not any(up.numbers):
        raise Refused(up.line, "an up direction of 0 0 0")
    if eye and look and eye.numbers == look.numbers:
        raise Refused(look.line, "the eye looks at itself")
    if eye and look and up and not any(cross(minus(look.numbers, eye.numbers), up.numbers)):
        raise Refused(up.line, "an up direction parallel to the view direction")

def read_camera(text):  # S6, S9
    camera = {name: read_part(text.filled_line(name), name) for name in POSITION}
    line = text.filled_line("the projection")
    camera["projection"] = read_part(line, line.take("frustum", "ortho") or "perspective")
    check_camera(camera)
    return camera

def read_commands(text, header):  # S10 to S17, S23: yields keyword, line and arguments; puts into `header` what is the same for all triangles
    columns, color, material, has_triangle, keyword = (), None, 0, False, None
    while keyword != "end":
        line = text.filled_line("end")
        at, keyword, arguments = line.number, line.take("triangle", "push", "pop", "end", "attributes", "use", "sphere", *ARGUMENTS), None
        may_be_late = keyword == "color" and "color" in header.get("attributes", ())
        is_late = has_triangle and keyword in ("color", "attributes", *ONCE, *REPEATED) and not may_be_late
        is_second = keyword in ONCE and keyword in header or keyword == "attributes" and columns
        if keyword in (None, *POSITION, *PROJECTIONS) or is_late or is_second:
            raise Refused(at, f"{keyword}: not a command that may stand here")
        if keyword in ("push", "pop", "end"):
            line.end()
        elif not line.words:
            line = text.filled_line("arguments")
        if keyword == "triangle":
            arguments, has_triangle = [corner._replace(material=material) for corner in read_triangle(text, line, columns, color)], True
        elif keyword == "sphere":
            arguments, has_triangle = [point._replace(color=color, material=material) for point in read_sphere(line, columns, color)], True
        elif keyword == "use":
            material = read_material_number(line, header)
            line.end()
        elif keyword == "attributes":
            columns = read_columns(line, ("color", "normal"))
        elif keyword in ARGUMENTS:
            arguments = read_part(line, keyword)
            at, color = line.number, arguments.numbers if keyword == "color" else color
            if keyword in ("absorption", "paint"):
                add_to_material(header, arguments, at)
            header.update({keyword: arguments} if keyword in ONCE else {keyword: header.get(keyword, []) + [arguments]} if keyword == "material" else {})
        header["attributes"] = [name for name in ("color", "normal") if name in columns or name == "color" and color]
        header["attributes"] += ["material"] * (len(header.get("material", ())) > 1)
        yield keyword, at, arguments
    text.expect_end()

def read_triangle(text, line, columns, color):  # S11, S16, S17: the corners
    corners = []
    while len(corners) < 3:
        line = line if line.words else text.filled_line("a vertex")
        corners.append(read_vertex(line, {name: COLUMNS[name] for name in columns}))
        if corners[-1].normal and not any(corners[-1].normal):
            raise Refused(line.number, "a normal of 0 0 0")
    return corners if "color" in columns else [corner._replace(color=color) for corner in corners]

def read_sphere(line, columns, color):  # S24, M10: the four points
    if "color" in columns and not color:
        raise Refused(line.number, "no color for a sphere")
    x, y, z, r = (float(number) for number in line.reals(ANY, ANY, ANY, lambda radius, *before: radius > 0))
    line.end()
    if not all(c < c + r < math.inf for c in (x, y, z)):
        raise Refused(line.number, "a radius that is lost")
    points = ((x, y, z), (x + r, y, z), (x, y + r, z), (x, y, z + r))
    return [Vertex(line.number, tuple(map(Fraction, point)), None, None, None, None, None) for point in points]

def read_material_number(line, header):  # S23, T9
    at = line.number
    number = line.whole()
    if number >= max(1, len(header.get("material", ()))):
        raise Refused(at, "a material that is not there")
    return number

def read_columns(line, names):  # S16, T5
    columns = [name for name in names if line.take(name)]
    if not columns or line.words:
        line.refuse("attributes in their order")
    return columns

def read_vertex(line, columns, header=None):  # S11, S16, T9
    written, position = line.words[:3], line.reals(ANY, ANY, ANY)
    values = {name: line.reals(*columns[name]) for name in COLUMNS if name in columns}
    material = read_material_number(line, header) if "material" in columns else None
    line.end()
    return Vertex(line.number, position, values.get("w", (None,))[0], values.get("color"), values.get("normal"), written, material)

# scene.md: the config
Config = namedtuple("Config", "width height left bottom front rear written")  # written: the words of left and bottom
def read_config(text):  # C1 to C3
    line = text.filled_line("the size")
    size, numbers, written = (line.whole(), line.whole()), (), ()
    line.end()
    if not all(1 <= count <= 65535 for count in size):
        raise Refused(line.number, "a size beyond 1 to 65535")
    if not (line := text.filled_line()):
        return Config(*size, *map(Fraction, (-1, -1, -1, 1)), ("-1", "-1"))
    for conditions in [[lambda limit: Fraction(1e-200) <= -limit <= Fraction(1e200)]] * 2 + [[ANY] + DEPTHS]:
        line = line or text.filled_line("the limits")
        written += (line.words[0],)
        numbers += line.reals(*conditions)
        line = line.end()
    text.expect_end()
    return Config(*size, *numbers, written)

# stage-text.md: reading
USED_UP = {"view": ("projected",), "project": (*POSITION, "projected"), "zbuf": POSITION + PROJECTIONS}
SPACES = {"view": "world", "project": "view", "zbuf": "ndc"}  # T28, T29
class Stage:  # T1 to T16: a stage text as `reader` reads it; `header` has its parts by keyword, any projection as `projection`
    def __init__(self, data, reader, is_bare=False):
        self.text, self.reader, self.header, self.is_bare = Text(data), reader, {}, is_bare
        while (line := self.text.filled_line()) and self.read_header(line):
            pass
        self.first, self.end_of_header = line, line.number if line else self.text.at + 1
        check_camera(self.header)

    def read_header(self, line):  # T1 to T7b, T14, T28, T29: whether the line belongs to the header
        keyword = line.take("framed", "projected", "attributes", "bounds", *POSITION, *PROJECTIONS, *ONCE, *REPEATED)
        name = "projection" if keyword in ("projected", *PROJECTIONS) else keyword
        if keyword in USED_UP[self.reader] or name in self.header and name not in REPEATED:
            raise Refused(line.number, f"{keyword}: a second one, or a text that is not for {self.reader}")
        if keyword == "framed":
            self.header[name] = line.end() or True
        elif keyword == "bounds":
            line.take(SPACES[self.reader]) or line.refuse(f"{SPACES[self.reader]}, the space of this text")
            self.header[name] = line.reals(*[NOT_NEGATIVE] * (4 if self.reader == "zbuf" else 2))
            line.end()
        elif keyword == "attributes":
            self.header[name] = read_columns(line, ("w", "color", "normal", "material"))
            if "w" in self.header[name] and self.reader != "zbuf":
                raise Refused(line.number, "a text that has been projected")
        elif keyword:
            kind = line.take("frustum", "ortho") or line.refuse("frustum or ortho") if keyword == "projected" else keyword
            part = read_part(line, kind)
            if name in ("absorption", "paint"):
                add_to_material(self.header, part, line.number)
            else:
                self.header[name] = self.header.get(name, []) + [part] if name in REPEATED else part
        return bool(keyword)

    def triangles(self):  # T8, T10 to T13, T26, T27: one after the other, with spheres
        columns = {name: COLUMNS.get(name) for name in self.header.get("attributes", ())}
        number, whole, number_of_whole, end = 0, None, None, "end" if "framed" in self.header else None
        line = self.first or self.text.filled_line(end)
        while line:
            if line.words[0][0] in "0123456789+-.":
                whole = whole if number == number_of_whole else None
                triangle = Triangle(number, self.corners(line, columns), whole)
                if whole and triangle.corners[0].material != whole[0].material:
                    raise Refused(line.number, "another material than the whole triangle")
                yield triangle
                number += 1
            elif line.take("triangle"):
                number = line.whole()
                line.end()
            elif self.reader == "view" and not self.is_bare and line.take("sphere"):
                line.end()
                yield Triangle(number, self.points(columns), None)
                number += 1
            elif self.reader == "zbuf" and line.take("clipped"):
                line.end()
                whole, number_of_whole = self.corners(self.text.line("a vertex"), {**columns, "w": [ANY]}), number
            elif end and line.take("end"):
                line.end()
                if line.number == len(self.text.lines) and not self.text.is_ended:
                    raise Refused(line.number, "an end without its line feed")
                return self.text.expect_end()
            else:
                line.refuse("a vertex, or 'triangle N'")
            line = self.text.filled_line(end)

    def points(self, columns):  # T26: the four vertex lines of a sphere
        points, columns = [], {name: of for name, of in columns.items() if name != "normal"}
        while len(points) < 4:
            line = self.text.line("a point of a sphere")
            if line.words:
                points.append(read_vertex(line, columns, self.header))
                if (points[-1].color, points[-1].material) != (points[0].color, points[0].material):
                    raise Refused(line.number, "another color or material than the center")
            elif not line.comment:
                raise Refused(line.number, "a blank line inside a sphere")
        return points

    def corners(self, line, columns):  # T8, T9: three vertex lines; `line` is the first, or a comment before it
        corners = []
        while len(corners) < 3:
            if line.words:
                corners.append(read_vertex(line, columns, self.header))
                if corners[-1].material != corners[0].material:
                    raise Refused(line.number, "another material than the first vertex")
            elif not line.comment:
                raise Refused(line.number, "a blank line inside a triangle")
            line = self.text.line("a vertex") if len(corners) < 3 else None
        return corners

# stage-text.md: writing
def settled(x):  # T21: x without the error of its sines and roots, which would decide ties
    return x if x.denominator < 2**1400 else Fraction(round(x * 2**1400), 2**1400)

def fixed(x, decimals):  # T19
    units = round(settled(x) * 10**decimals)
    digits = str(abs(units)).rjust(decimals + 1, "0")
    return "-" * (units < 0) + digits[:len(digits) - decimals] + "." * (decimals > 0) + digits[len(digits) - decimals:]

def shortest(x):  # T20: Python's repr has the digits
    double = float(settled(x))
    _, digits, exponent = Decimal(repr(abs(double))).normalize().as_tuple()
    digits = "".join(map(str, digits))
    scientific = digits[0] + "." * (len(digits) > 1) + digits[1:] + "e%+03d" % (len(digits) - 1 + exponent)
    padded = digits.rjust(1 - exponent, "0")
    plain = str(int(abs(double))) if exponent >= 0 else padded[:exponent] + "." + padded[exponent:]
    return "-" * (double < 0) + min(plain, scientific, key=len)

WRITTEN = ("background", "ambient", "material", "attenuation", "light")  # T17, in this order
class Writer:  # T17 to T20: the lines of a stage text
    def __init__(self, header, options):
        self.is_bare, self.next = "--bare" in options, 0
        self.columns, self.end = ([], []) if self.is_bare else (header.get("attributes", []), ["end"] * ("framed" in header))
        self.digits = shortest if options["--digits"] == "exact" else lambda x: fixed(x, int(options["--digits"]))
        self.lines = [] if self.is_bare else list(self.header(header))

    def header(self, header):  # T2 to T7, T13, T17
        if "framed" in header:
            yield "framed"
        for name in [name for name in (*POSITION, "projection", "projected") if name in header]:
            _, kind, numbers, rule = header[name]
            yield " ".join(["projected"] * (name == "projected") + [kind, *map(shortest, numbers)] + ["ratio"] * (rule == "ratio"))
        if self.columns:
            yield " ".join(["attributes", *self.columns])
        for part in sum((header.get(name, []) if name in REPEATED else [header[name]] for name in WRITTEN if name in header), []):
            words = [*map(shortest, part.numbers[:3]), *map(str if part.kind == "material" else shortest, part.numbers[3:4]), *map(shortest, part.numbers[4:])]
            yield " ".join([part.kind, *(words[:4] if part.kind == "material" and part.numbers[4:] == (0, 1, 1) else words)])
            for name in [name for name in ("absorption", "paint") if part.kind == "material" and name in (part.rule or {})]:
                if name == "paint" or any(part.rule[name].numbers):
                    yield " ".join([name, *map(shortest, part.rule[name].numbers)])

    def add(self, triangle):  # T8 to T10, T11a, T18, T26
        if triangle.number != self.next and not self.is_bare:
            self.lines.append(f"triangle {triangle.number}")
        self.next = triangle.number + 1
        if triangle.whole:
            self.lines += ["clipped", *(self.vertex(corner, shortest, ["w", *self.columns]) for corner in triangle.whole), ""]
        is_sphere = len(triangle.corners) == 4  # T26
        columns = [name for name in self.columns if not (is_sphere and name == "normal")]
        self.lines += [*["sphere"] * is_sphere, *(self.vertex(corner, self.digits, columns) for corner in triangle.corners), ""]

    def vertex(self, corner, text_of, columns):  # T9, T19, T20
        words = [*map(text_of, corner.position), *(shortest(corner.w) for _ in "w" if "w" in columns)]
        words += [text_of(x) for name in ("color", "normal") if name in columns for x in getattr(corner, name)]
        return " ".join([*words, *(str(corner.material) for _ in "m" if "material" in columns)])

    def text(self): return "".join(line + "\n" for line in self.lines + self.end).encode()  # T13a, T18

def depth_text(depths, rear): return "".join("".join(fixed(z, 6) + "\t" for z in row if z < rear) + "\n" for row in depths).encode()  # T23

def is_cut(p, q): return any(p[axis] == q[axis] in (1, -1) for axis in range(3))  # T24b
def edges_of(triangles, is_lit):  # T24b: of each triangle the corners with which one begins that is drawn
    drawn = [[0, 1, 2] for _ in triangles]
    for index, triangle in enumerate(triangles):
        points, before = [corner.position for corner in triangle.corners], triangles[index - 1] if index else None
        if triangle.whole or not is_lit:
            drawn[index] = [i for i in range(3) if not is_cut(points[i], points[(i + 1) % 3])]
        if before and before.number == triangle.number and [before.corners[i].position for i in (0, 2)] == points[:2]:
            drawn[index - 1], drawn[index] = ([i for i in drawn[index - is_before] if i != 2 * is_before] for is_before in (1, 0))
    return drawn

def edge_pixels(triangle, edges, config, width):  # T24a: (row, column, depth); edges are `width` samples wide
    points = on_grid(triangle, config)
    for p, q in ((points[i], points[(i + 1) % 3]) for i in edges):
        axis = int(abs(q[0] - p[0]) < abs(q[1] - p[1]))  # 1: an edge with a pixel in each row
        low, high = sorted((p, q), key=lambda end: end[axis])
        for along in inside(low[axis], high[axis], config[axis]) if low[axis] < high[axis] else ():
            middle = mean(((high[axis] - along) / (high[axis] - low[axis]), (along - low[axis]) / (high[axis] - low[axis])), (low, high))
            for across in inside(middle[1 - axis] - Fraction(width, 2), math.ceil(middle[1 - axis] + Fraction(width, 2)) - 1, config[1 - axis]):
                yield (along, across, middle[2]) if axis else (across, along, middle[2])

def is_hidden(z, triangle, seen_z, config, width):  # T24c: an edge of depth z where the triangle is seen with that depth
    (a, b, c), sizes = (corner.position for corner in triangle.corners), (-2 * config.left / config.width, -2 * config.bottom / config.height)
    normal = cross(minus(b, a), minus(c, a))
    reach = sum(abs(normal[axis] / normal[2]) * sizes[axis] * width * Fraction(501, 1000) for axis in (0, 1)) if normal[2] else LARGEST
    return z > min(seen_z + reach, max(a[2], b[2], c[2]))

def wireframe(triangles, config, width, is_lit, surfaces):  # T24c: for each pixel the triangle that it shows, or None; without surfaces none hides
    shown = {}
    for order, (triangle, edges) in enumerate(zip(triangles, edges_of(triangles, is_lit))):
        a, b, c = (corner.position for corner in triangle.corners)
        is_clockwise = cross(minus(b, a), minus(c, a))[2] <= 0
        for row, column, z in edge_pixels(triangle, edges, config, width):
            if config.front <= z < config.rear:
                shown[row, column] = min(shown.get((row, column), (config.rear,)), (z, is_clockwise, order))
    seen = [[None] * config.width for _ in range(config.height)]
    for (row, column), (z, _, order) in shown.items():
        surface = surfaces and surfaces[1][row][column]
        if not (surface and is_hidden(z, surface, surfaces[0][row][column], config, width)):
            seen[row][column] = triangles[order]
    return seen

def bmp(rows):  # T24: the file; a row is a list of (red, green, blue)
    pixels = b"".join(b"".join(bytes((b, g, r)) for r, g, b in row) + bytes(-3 * len(row) % 4) for row in reversed(rows))
    header = ("<2s6I2H6I", b"BM", 54 + len(pixels), 0, 54, 40, len(rows[0]), len(rows), 1, 24, 0, len(pixels), 0, 0, 0, 0)
    return struct.pack(*header) + pixels

# stages.md: numbers
def minus(a, b): return tuple(p - q for p, q in zip(a, b))  # N2
def plus(*vectors): return tuple(map(sum, zip(*vectors)))  # N2
def times(factor, a): return tuple(factor * p for p in a)  # N2
def mean(weights, vectors): return plus(*map(times, weights, vectors))  # N2, P9, L4a: the sum of vectors times numbers
def dot(a, b): return sum(p * q for p, q in zip(a, b))  # N2
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])  # N2

def root(x):  # N1, N2: exact for the square of a fraction, else with many digits
    if isinstance(x, Decimal):
        return x.sqrt()
    top, bottom = math.isqrt(x.numerator), math.isqrt(x.denominator)
    is_square = top * top == x.numerator and bottom * bottom == x.denominator
    return Fraction(top, bottom) if is_square else Fraction((Decimal(x.numerator) / Decimal(x.denominator)).sqrt())

def unit(a):  # N2: divided by its largest coordinate first, as roots of very small numbers lose digits
    a = times(1 / max(map(abs, a)), a) if any(a) else a
    return times(1 / root(dot(a, a)), a) if any(a) else a

def kept(vector):  # N1: where sines and roots have made fractions long, to far more digits than those have
    return tuple(x if x.denominator < 2**8000 else Fraction(round(x * 2**7000), 2**7000) for x in vector)

def arctan_of_inverse(n): return sum(Decimal((-1) ** k) / ((2 * k + 1) * n ** (2 * k + 1)) for k in range(DECIMALS))  # N3
PI = 16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)  # Machin 1706; arctan(1/n) = 1/n - 1/(3 n³) + 1/(5 n⁵) - ...

def sine_and_cosine(degrees):  # N3: from exp(i x) = 1 + i x + (i x)²/2! + ..., rounded, so that the sine of 30 degrees is 1/2
    degrees %= 360
    x = Decimal(degrees.numerator) / Decimal(degrees.denominator) * PI / 180
    sums, term, k = [Decimal(0)] * 4, Decimal(1), 0  # of the terms in 1, i, -1, -i
    while abs(term) > Decimal(10) ** (-DECIMALS - 300):
        sums[k % 4] += term
        k += 1
        term *= x / k
    return tuple(Fraction(round(Fraction(part) * 10**DECIMALS), 10**DECIMALS) for part in (sums[1] - sums[3], sums[0] - sums[2]))
def tangent(degrees): return Fraction(*sine_and_cosine(degrees))  # N3

def expect_finite(numbers, line):  # N4, P11
    if max(map(abs, numbers)) >= LARGEST:
        raise Refused(line, "a number beyond a double's range")
    return numbers

# stages.md: model
UNITS = tuple(tuple(map(Fraction, row)) for row in ((1, 0, 0), (0, 1, 0), (0, 0, 1)))

class Matrix(namedtuple("Matrix", "columns offset", defaults=(UNITS, (0, 0, 0)))):  # M1: the images of the unit vectors and of 0
    def moved(self, p):  # M1: x times the first column + y times the second + z times the third + the offset
        return plus(mean(p, self.columns), self.offset)

    def __matmul__(self, other):  # M2: the matrix that applies `other` first
        return Matrix(tuple(kept(mean(column, self.columns)) for column in other.columns), kept(self.moved(other.offset)))

    def determinant(self): return dot(self.columns[0], cross(self.columns[1], self.columns[2]))  # M10

    def normal(self, n):  # M7, T22
        x, y, z = self.columns
        cofactors = (cross(y, z), cross(z, x), cross(x, y))
        size = max(map(abs, x + y + z)) or 1
        side = -1 if settled(dot(x, cofactors[0]) / size**3) < 0 else 1
        return unit(tuple(settled(side * p / size**2) for p in mean(n, cofactors)))

def transform(keyword, numbers):  # M3, M4: the T of a command
    if keyword == "translate":
        return Matrix(offset=numbers)
    if keyword == "scale":
        return Matrix(tuple(map(times, numbers, UNITS)))
    (sine, cosine), a = sine_and_cosine(numbers[0]), unit(numbers[1:])
    return Matrix(tuple(plus(times(cosine, x), times((1 - cosine) * dot(a, x), a), times(sine, cross(a, x))) for x in UNITS))

def model(data, options):  # M1 to M10, N4: the text of stage 1
    text = Text(data)
    header, matrix, saved, triangles = {**read_camera(text), "light": []}, Matrix(), [], []
    for keyword, line, arguments in read_commands(text, header):
        if keyword == "sphere" and ("--bare" in options or matrix.determinant() == 0):
            raise Refused(line, "a sphere without a volume, or in a bare text")
        if keyword in ("triangle", "sphere"):
            triangles.append(Triangle(len(triangles), [corner._replace(
                position=expect_finite(matrix.moved(corner.position), corner.line),
                normal=corner.normal and matrix.normal(corner.normal)) for corner in arguments]))
        elif keyword in ("translate", "scale", "rotate"):
            matrix = matrix @ transform(keyword, arguments.numbers)
        elif keyword == "push":
            saved.append(matrix)
        elif keyword == "pop" and not saved:
            raise Refused(line, "pop without push")
        elif keyword == "pop":
            matrix = saved.pop()
        elif keyword == "light":
            position = expect_finite(matrix.moved(arguments.numbers[:3]), line)
            header["light"].append(arguments._replace(numbers=position + arguments.numbers[3:]))
    writer = Writer({**header, "framed": True} if "--framed" in options else header, options)
    for triangle in triangles:
        writer.add(triangle)
    return writer.text()

# stages.md: view
def camera_of(stage, options, names):  # V1, P1: from options, scene and header; `names` are those of the options
    given = {"projection" if name in PROJECTIONS else name: read_part(Line(0, " ".join(options["--" + name])), name)
             for name in names if "--" + name in options}
    scene = read_camera(Text(pathlib.Path(options["--scene"]).read_bytes())) if "--scene" in options else {}
    camera = {name: part for name, part in {**stage.header, **scene, **given}.items() if name in ("projection", *names)}
    check_camera(camera)
    return camera

def view(data, options):  # V1, V2: the text of stage 2
    stage = Stage(data, "view", "--bare" in options)
    camera = camera_of(stage, options, POSITION + PROJECTIONS)
    if not all(name in camera for name in POSITION):
        raise Refused(stage.end_of_header, "no camera")
    eye, look, up = (camera[name].numbers for name in POSITION)
    l, r = unit(minus(look, eye)), unit(cross(minus(look, eye), up))
    axes = (r, cross(r, l), times(-1, l))

    def seen(p, line):  # V2, N4
        return expect_finite(tuple(dot(axis, minus(p, eye)) for axis in axes), line)

    header = {name: part for name, part in {**stage.header, **camera}.items() if name not in POSITION}
    header["light"] = [part._replace(numbers=seen(part.numbers[:3], part.line) + part.numbers[3:]) for part in header.get("light", ())]
    writer = Writer(header, options)
    for triangle in stage.triangles():
        writer.add(triangle._replace(corners=[corner._replace(
            position=seen(corner.position, corner.line),
            normal=corner.normal and unit(tuple(dot(axis, corner.normal) for axis in axes))) for corner in triangle.corners]))
    return writer.text()

# stages.md: project
Volume = namedtuple("Volume", "left right bottom top near far is_ortho")
Clip = namedtuple("Clip", "x y z w weights")  # a point of clip space, and its shares of the triangle's corners
def volume_of(part, rule=None):  # P2: of a projection
    if part.kind != "perspective":
        return Volume(*part.numbers, part.kind == "ortho")
    fov_y, aspect, near, far = part.numbers
    is_ratio = (rule or part.rule) == "ratio"
    if not is_ratio and fov_y * aspect >= 180:
        raise Refused(part.line, "fovX = FOVY ASPECT is not below 180 degrees")
    top = near * tangent(fov_y / 2)
    right = top * aspect if is_ratio else near * tangent(fov_y * aspect / 2)
    return Volume(-right, right, -top, top, near, far, False)

def to_clip_space(p, volume, weights):  # P3: with the distance at which the window stands, near or (for ortho) 1
    (left, right, bottom, top, near, far, is_ortho), (x, y, d) = volume, (p[0], p[1], -p[2])
    window, w, z = (1, Fraction(1), 2 * d - (near + far)) if is_ortho else (near, d, (d - near) * far - (far - d) * near)
    return Clip((2 * window * x - (right + left) * w) / (right - left), (2 * window * y - (top + bottom) * w) / (top - bottom),
                z / (far - near), w, weights)

def is_culled(corners, cull):  # P5
    a, b, c = ((p.x, p.y, p.w) for p in corners)
    winding = dot(a, cross(b, c))
    return cull == "back" and winding < 0 or cull == "front" and winding > 0

def clipped(corners, volume, mode, inset):  # P6, P7: the polygon that is left; none of a dropped triangle
    if mode == "none" or mode == "auto" and (volume.is_ortho or all(1024 * p.w >= volume.near for p in corners)):
        return corners
    planes = [(axis, sign) for axis in (2, 0, 1) for sign in (1, -1)][:6 if mode in ("frustum", "reject") else 1]
    distances = [lambda p, axis=axis, sign=sign: p.w * (1 - inset) + sign * p[axis] for axis, sign in planes]
    if any(all(distance(p) < 0 for p in corners) for distance in distances):
        return []
    polygon = corners
    for distance in distances if mode != "reject" else ():
        polygon = cut(polygon, distance)
    return polygon

def cut(polygon, distance):  # P8, P9: the part inside one plane
    kept_points = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        a, b = distance(p), distance(q)
        if a >= 0:
            kept_points.append(p)
        if a * b < 0:
            share = (1 - a / (a - b), a / (a - b))
            kept_points.append(Clip(*mean(share, (p[:4], q[:4])), mean(share, (p.weights, q.weights))))
    return kept_points if any(distance(p) > 0 for p in polygon) or len(kept_points) == len(polygon) else []

def divided(p, corners, has_columns):  # P4, P9, N4: the vertex in NDC of a point of clip space; `corners` are the triangle's in view space
    line = corners[max(range(3), key=lambda i: p.weights[i])].line
    if p.w <= 0:
        raise Refused(line, "a vertex that is not in front of the eye")
    color, normal = (values[0] and mean(p.weights, values) for values in ([c.color for c in corners], [c.normal for c in corners]))
    return Vertex(line, expect_finite(times(1 / p.w, p[:3]), line), p.w if has_columns else None, color, normal, material=corners[0].material)

def project(data, options):  # P1 to P11, T4, T5, T11a: the text of stage 3
    stage = Stage(data, "project")
    part = camera_of(stage, options, PROJECTIONS).get("projection")
    if not part:
        raise Refused(stage.end_of_header, "no projection")
    volume, inset = volume_of(part, options.get("--aspect")), Fraction(float(options["--clip-inset"]))
    header = {name: value for name, value in stage.header.items() if name != "projection"}
    if "attributes" in header:
        header["attributes"] = ["w", *header["attributes"]]
    if "light" in header:
        header["projected"] = Part(0, "ortho" if volume.is_ortho else "frustum", expect_finite(volume[:4], part.line) + volume[4:6])
    writer = Writer(header, options)
    for triangle in stage.triangles():
        corners = [to_clip_space(corner.position, volume, share) for corner, share in zip(triangle.corners, UNITS)]
        polygon = [] if is_culled(corners, options.get("--cull")) else clipped(corners, volume, options["--clip"], inset)
        vertices = [divided(p, triangle.corners, "attributes" in header) for p in polygon]
        whole = [corner._replace(position=p[:3], w=p.w) for corner, p in zip(triangle.corners, corners)]
        if polygon == corners or "light" not in header or any(abs(x) >= LARGEST for corner in whole for x in corner.position):
            whole = None
        for i in range(1, len(vertices) - 1):
            writer.add(Triangle(triangle.number, [vertices[0], vertices[i], vertices[i + 1]], whole if i == 1 else None))
    return writer.text()

# stages.md: zbuf, coverage and depth
def between(p, q, t): return p + t * (q - p) if abs(q - p) < math.inf else (1 - t) * p + t * q  # Z2b
def crossings(corners, y):  # Z2a, Z2b: where edges meet the horizontal line at y: (x, z) from the left. In doubles for `nearest`, or exactly
    found = []
    for p, q in ((0, 1), (1, 2), (2, 0)):
        low, high = sorted((corners[p], corners[q]), key=lambda corner: corner[1])
        if low[1] <= y <= high[1] and low[1] != high[1]:
            is_finite = high[1] - low[1] < math.inf
            t = (y - low[1]) / (high[1] - low[1]) if is_finite else (y / 2 - low[1] / 2) / (high[1] / 2 - low[1] / 2)
            found.append((high[0], high[2]) if y == high[1] else tuple(between(low[axis], high[axis], t) for axis in (0, 2)))
    return sorted(found)

def inside(first, last, count):  # Z3: the rows or columns of the picture from first, rounded up, to last, rounded down
    return range(math.ceil(max(0, min(first, count))), math.floor(max(-1, min(last, count - 1))) + 1)

def nearest(triangle, config):  # Z1 to Z4: the pixels, (row, column, depth)
    left, bottom = float(config.left), float(config.bottom)
    dx, dy = -2 * left / config.width, -2 * bottom / config.height
    x_0, top = left + dx / 2, -bottom - dy / 2
    exact_corners = [corner.position for corner in triangle.corners]
    corners = [tuple(map(float, corner)) for corner in exact_corners]
    lowest, _, highest = sorted(corner[1] for corner in corners)
    for row in inside((top - highest) / dy, (top - lowest) / dy, config.height):
        y = top - row * dy
        met = crossings(corners, y)
        if len(met) >= 2:
            (x_left, z_left), *_, (x_right, z_right) = crossings(exact_corners, Fraction(y))
            slope = 0 if met[0][0] == met[-1][0] or x_left == x_right else (z_right - z_left) / (x_right - x_left)
            start = z_left - x_left * slope if slope else min(z_left, z_right)
            first = max(-1.0, min((met[0][0] - x_0) / dx + 0.5, config.width))
            for column in inside(math.floor(first), (met[-1][0] - x_0) / dx + 0.5, config.width):
                yield row, column, start + Fraction(x_0 + column * dx) * slope

def exact(word):  # Z6: the value of a written x, y or limit
    is_decimal = re.fullmatch(r"[+-]?[0-9]*(\.[0-9]{0,7})?", word) and abs(float(word)) < 1e22
    return Fraction(word if is_decimal else float(word))

def on_grid(triangle, config):  # Z1, Z6: the corners, x and y in columns and rows, y downwards
    left, bottom = map(exact, config.written[:2])
    dx, dy = -2 * left / config.width, -2 * bottom / config.height
    return [((exact(x) - left) / dx - Fraction(1, 2), (-bottom - exact(y)) / dy - Fraction(1, 2), corner.position[2])
            for corner in triangle.corners for x, y, _ in (corner.written,)]

def center(triangle, config):  # Z5, Z7: the same for `center`
    points = on_grid(triangle, config)
    whole = math.lcm(*(x.denominator for point in points for x in point[:2]))  # times it, x and y are whole numbers
    a, b, c = ((int(x * whole), int(y * whole), z) for x, y, z in points)
    area = side_of_edge(c[0], c[1], a, b)
    b, c = (b, c) if area > 0 else (c, b)  # clockwise as seen
    xs, ys, zs = zip(a, b, c)
    for row in inside(Fraction(min(ys), whole), Fraction(max(ys), whole), config.height if area else 0):
        for column in inside(Fraction(min(xs), whole), Fraction(max(xs), whole), config.width):
            weights = [side_of_edge(column * whole, row * whole, *edge) for edge in ((b, c), (c, a), (a, b))]
            if all(weight > 0 or weight == 0 and is_left_or_top(*edge) for weight, edge in zip(weights, ((b, c), (c, a), (a, b)))):
                yield row, column, dot(weights, zs) / abs(area)

# Z5: above 0 on the inner side of the edge from p to q, 0 on it; clockwise, a left edge goes up, and a top edge to the right.
def side_of_edge(x, y, p, q): return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])  # Z5
def is_left_or_top(p, q): return q[1] < p[1] or q[1] == p[1] and q[0] > p[0]  # Z5, Z5a

def draw(triangles, config, coverage, epsilon=0):  # Z8, Z9: for each pixel the depth, and the triangle that it shows or None; lists of rows
    depths, seen = ([[value] * config.width for _ in range(config.height)] for value in (config.rear, None))
    for triangle in triangles:
        for row, column, z in (center if coverage == "center" else nearest)(triangle, config):
            if config.front <= z < depths[row][column] - (epsilon if seen[row][column] else 0):
                depths[row][column], seen[row][column] = z, triangle
    return depths, seen

def generated_color(number):  # Z10: after n draws s is m^n + 2531011 (m^n - 1) / (m - 1), with m = 214013
    m = 214013
    powers = [pow(m, 3 * number + n, (m - 1) * 2**32) for n in (1, 2, 3)]
    return [(power + 2531011 * ((power - 1) // (m - 1))) % 2**32 // 2**16 % 2**15 % 256 for power in powers]

# stages.md: zbuf, color and light
Surface = namedtuple("Surface", "clip positions normals colors material")  # of the corners: x, y and w in clip space; in view space
Lighting = namedtuple("Lighting", "ambient attenuation lights is_ortho material")
def in_decimals(vector): return tuple(Decimal(x.numerator) / x.denominator for x in vector)  # L7: with 50 digits

def shading_model(stage, chosen):  # L1, T15, Z11
    is_lit, has_normals = "light" in stage.header, "normal" in stage.header.get("attributes", ())
    if is_lit and "projection" not in stage.header:
        raise Refused(stage.end_of_header, "lights without projected")
    if "background" in stage.header and any(alpha + Fraction(1, 2) < 255 for alpha in stage.header["background"].numbers[3:]):  # Z11: this writes BMP
        raise Refused(stage.header["background"].line, "a background with an alpha, which no BMP holds")
    if not is_lit and chosen not in (None, "none"):
        raise Refused(stage.end_of_header, "--shading without a light")
    return chosen or ("phong" if is_lit and has_normals else "flat" if is_lit else "none")

def surface_of(triangle, volume, model_name, paints):  # L2, L4, Z10
    corners, clip, positions, material = triangle.whole or triangle.corners, [], [], triangle.corners[0].material or 0
    for corner in corners:
        (x, y, z), w = corner.position, corner.w
        if w is None:
            w = 1 if not volume or volume.is_ortho else 2 * volume.far * volume.near / (volume.far * (1 - z) + volume.near * (1 + z))
        x, y, z, w = in_decimals((x, y, z, w) if triangle.whole else (x * w, y * w, z * w, w))
        clip.append((x, y, w))
        positions.append(to_view_space((x, y, z), w, volume))
    face = cross(minus(positions[1], positions[0]), minus(positions[2], positions[0]))
    own = (paints[material] or (255, 255, 255)) if any(paints) else generated_color(triangle.number)
    return Surface(clip, positions, [in_decimals(c.normal) if c.normal and model_name != "flat" else face for c in corners],
                   [in_decimals(c.color or own) for c in corners], material)

def to_view_space(p, w, volume):  # L2: P3, solved for the point
    if not volume:
        return p
    left, right, bottom, top, near, far = in_decimals(volume[:6])
    z, window = (-((far - near) * p[2] + near + far) / 2, 1) if volume.is_ortho else (-w, near)
    return (((right - left) * p[0] + (right + left) * w) / (2 * window), ((top - bottom) * p[1] + (top + bottom) * w) / (2 * window), z)

def weights_at(clip, x, y):  # L3
    a, b, c = ((p[0] - x * p[2], p[1] - y * p[2]) for p in clip)
    areas = [q[0] * r[1] - q[1] * r[0] for q, r in ((b, c), (c, a), (a, b))]
    is_turned = sum(areas) < -max(map(abs, areas)) * Decimal(2) ** -120  # a sum nearer to 0 is rounding's
    areas = [max(0, -area if is_turned else area) for area in areas]
    return times(1 / sum(areas), areas) if any(areas) else (1, 0, 0)

def lit(p, normal, color, lighting):  # L5
    (ambient, diffuse, specular, shininess), (constant, linear, quadratic) = lighting.material, lighting.attenuation
    v, n = (0, 0, Decimal(1)) if lighting.is_ortho else unit(times(-1, p)), unit(normal)
    n = times(-1, n) if dot(n, v) < 0 else n
    result = tuple(ambient * light * channel for light, channel in zip(lighting.ambient, color))
    for light in lighting.lights:
        way = minus(light[:3], p)
        d, l = root(dot(way, way)), unit(way)
        if d > 0 and dot(n, l) > 0:
            shine = max(Decimal(0), min(Decimal(1), dot(n, unit(plus(l, v)))))
            highlight = 255 * specular * (shine ** shininess if shininess else 1)
            at_p = times(1 / (constant + linear * d + quadratic * d * d), light[3:])
            result = tuple(sum_ + i * (diffuse * dot(n, l) * channel + highlight) for sum_, i, channel in zip(result, at_p, color))
    return result

def shaded(surface, model_name, lighting, weights):  # L4a: the color at a point of a surface
    weights = [Decimal(1) / 3] * 3 if model_name == "flat" else weights
    if model_name == "gouraud":
        return mean(weights, [tuple(map(clamped, lit(*corner, lighting))) for corner in zip(*surface[1:4])])
    point = [mean(weights, values) for values in surface[1:4]]
    return point[2] if model_name == "none" else lit(*point, lighting)

def clamped(channel): return max(Decimal(0), min(Decimal(255), channel))  # L4a, L6
def rounded(color): return tuple(math.floor(clamped(channel) + Decimal("0.5") + Decimal(2) ** -20) for channel in color)  # L6

def shade(seen, header, config, model_name):  # L1 to L5, Z10: the picture, in colors that are not yet rounded; `seen` is that of draw
    volume = volume_of(header["projection"]) if "projection" in header else None
    defaults = {"background": (0, 0, 0), "ambient": (0, 0, 0), "attenuation": (1, 0, 0)}
    background, *looks = (in_decimals(header[name].numbers[:3] if name in header else default) for name, default in defaults.items())
    materials = [in_decimals(part.numbers[:4]) for part in header.get("material", ())] or [in_decimals((1, 1, 0, 1))]
    paints = ["paint" in (part.rule or {}) and part.rule["paint"].numbers for part in header.get("material", ())]
    lights = [in_decimals(light.numbers) for light in header.get("light", ())]
    lightings = [Lighting(*looks, lights, volume and volume.is_ortho, material) for material in materials]
    left, bottom = in_decimals((config.left, config.bottom))
    surfaces, picture = {}, [[background] * config.width for _ in seen]
    for row, column in [(row, column) for row, line in enumerate(seen) for column, triangle in enumerate(line) if triangle]:
        triangle = seen[row][column]
        surface = surfaces.get(id(triangle)) or surfaces.setdefault(id(triangle), surface_of(triangle, volume, model_name, paints))
        x, y = left - left * (2 * column + 1) / config.width, bottom * (2 * row + 1) / config.height - bottom
        picture[row][column] = shaded(surface, model_name, lightings[surface.material], weights_at(surface.clip, x, y))
    return picture

def mean_of_samples(picture, count):  # Z12: of each count x count pixels
    blocks = [[sum((line[x:x + count] for line in picture[y:y + count]), []) for x in range(0, len(picture[0]), count)]
              for y in range(0, len(picture), count)]
    return [[rounded(times(Decimal(1) / count**2, plus(*block))) for block in line] for line in blocks]

def zbuf(data, options):  # Z1 to Z13, L1 to L7, T15, T23 to T24c, T30: the z-buffer text; writes the image
    config, stage = read_config(Text(pathlib.Path(options["CONFIG"]).read_bytes())), Stage(data, "zbuf")
    if "--expect-framed" in options and "framed" not in stage.header:
        raise Refused(stage.end_of_header, "a text that is not framed")
    model_name = shading_model(stage, options.get("--shading"))
    triangles, count = list(stage.triangles()), int(options["--samples"])
    rules = options["--coverage"], Fraction(float(options["--depth-epsilon"]))
    depths, seen = draw(triangles, config, *rules)
    samples = config._replace(width=config.width * count, height=config.height * count)
    surfaces = (depths, seen) if count == 1 else draw(triangles, samples, *rules)
    seen = surfaces[1]
    if "--wireframe" in options:
        seen = wireframe(triangles, samples, count, "light" in stage.header, options["--wireframe"] != "all" and surfaces)
    with decimal.localcontext(SHADING):
        image = [[rounded(color) for color in row] for row in shade(seen, stage.header, samples, model_name)]
        image = image if count == 1 else mean_of_samples(image, count)
    rows = slice(*map(int, options["--rows"].split(":"))) if "--rows" in options else slice(None)  # Z13
    pathlib.Path(options["--image"]).write_bytes(bmp(image[rows]))
    return depth_text(depths[rows], config.rear)

# The command line
DIGITS = [*map(str, range(18)), "exact"]
OPTIONS = {  # words that follow, or their count
    "model": {"--bare": 0, "--framed": 0, "--digits": DIGITS},
    "view": {"--bare": 0, "--digits": DIGITS, "--scene": 1, **{"--" + name: len(ARGUMENTS[name]) for name in POSITION + PROJECTIONS}},
    "project": {"--digits": DIGITS, "--scene": 1, "--aspect": ["angle", "ratio"], "--cull": ["back", "front"], "--clip-inset": 1,
                "--clip": ["auto", "near", "frustum", "reject", "none"], **{"--" + name: len(ARGUMENTS[name]) for name in PROJECTIONS}},
    "zbuf": {"--expect-framed": 0, "--image": 1, "--coverage": ["nearest", "center"], "--algorithm": ["zbuffer", "scanline"],
             "--samples": [*map(str, range(1, 17))], "--rows": 1, "--depth-epsilon": 1, "--wireframe": ["all"], "--shading": ["none", "flat", "gouraud", "phong"]}}

def read_options(stage, words):  # O1 to O3, V1, P1: the options by name, with their defaults
    options = {"--digits": "7", "--clip": "auto", "--clip-inset": "0", "--image": "out.bmp", "--coverage": "nearest", "--samples": "1",
               "--depth-epsilon": "0"}
    if stage == "zbuf" and words:
        options["CONFIG"] = words.pop(0)
    while words or stage not in OPTIONS or stage == "zbuf" and "CONFIG" not in options:
        word, *words = words or ["STAGE or CONFIG"]
        form = OPTIONS.get(stage, {}).get(word, -1)
        count = form if isinstance(form, int) else int(words[:1] == form) if word == "--wireframe" else 1
        if not 0 <= count <= len(words) or count == 1 and form != 1 and words[0] not in form:
            print(f"reference: {word}: not understood\n{__doc__}", file=sys.stderr)
            sys.exit(2)
        options[word], words = words[:count] if count > 1 else words[0] if count else True, words[count:]
    return options

def main():  # S5, T12
    stage, *words = sys.argv[1:] or [None]
    options = read_options(stage, words)
    try:
        sys.stdout.buffer.write(globals()[stage](sys.stdin.buffer.read(), options))
    except Refused as refusal:
        message = "line %d: %s" % refusal.args
        sys.stdout.write(f"error {stage}: {message}\n" * (stage != "zbuf"))
        print(f"reference {stage}: {message}", file=sys.stderr)
        sys.exit(1 if refusal.args[0] else 2)

if __name__ == "__main__":
    main()
