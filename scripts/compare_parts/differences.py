"""How two lists of numbers, or two pictures, differ."""
import dataclasses
import math

from lib.judging.matching import left_over_for_certain, named

NAMES_OF = {"color": ["red", "green", "blue"], "normal": [f"{axis} of the normal" for axis in "xyz"]}


def exceeds(a, b, tolerance):
    """True if a and b differ by more than the tolerance and the rounding of decimals to doubles."""
    return abs(a - b) > tolerance + 4 * math.ulp(max(abs(a), abs(b)))


@dataclasses.dataclass
class Pair:
    place: str
    a: float
    b: float

    @property
    def size(self):
        return abs(self.a - self.b)

    def __str__(self):
        return f"{self.place}: {self.a:.10g} in A, {self.b:.10g} in B"


@dataclasses.dataclass
class Differences:
    """Compares `things`."""
    things: str
    tolerance: float
    compared: int = 0
    differing: int = 0
    first: Pair = None
    largest: Pair = None
    unlike: list = dataclasses.field(default_factory=list)  # other differences, in words

    def add(self, place, a, b):
        """Compares a and b; `place` returns their position as text."""
        self.compared += 1
        if a == b or not exceeds(a, b, self.tolerance):
            return False
        self.differing += 1
        self.keep(Pair(place(), a, b))
        return True

    def keep(self, pair):
        """Notes a pair that differs, if it is the first or the largest."""
        self.first = self.first or pair
        if self.largest is None or pair.size > self.largest.size:
            self.largest = pair

    @property
    def found(self):
        return self.differing > 0 or bool(self.unlike)

    def rows(self):
        """Pairs of a name and a value, for a table."""
        yield f"{self.things} compared", str(self.compared)
        yield f"{self.things} that differ", str(self.differing)
        if self.largest:
            yield "largest difference", f"{self.largest}, off by {self.largest.size:.3g}"
            yield "first difference", str(self.first)
        for words in self.unlike:
            yield "not alike", words


def compare_stage_texts(a, b, tolerance):
    """The Differences of two StageTexts."""
    result = Differences("numbers", tolerance)
    for keyword in [*a.header, *(keyword for keyword in b.header if keyword not in a.header)]:
        if keyword in a.header and keyword in b.header and a.header[keyword] != b.header[keyword]:
            result.unlike.append(
                f"header line {keyword}: {' '.join(a.header[keyword])} and {' '.join(b.header[keyword])}")
    triangles, words = paired(a.triangles, b.triangles, tolerance)
    if words:
        result.unlike.append(words)
    columns = column_names(a.header)
    compare_vertices(result, ("triangle", "vertex"), columns, triangles)
    if len(a.spheres) != len(b.spheres):
        result.unlike.append(f"{len(a.spheres)} and {len(b.spheres)} spheres")
    compare_vertices(result, ("sphere", "point"), columns, zip(range(len(a.spheres)), a.spheres, b.spheres))
    return result


def column_names(header):
    """A header's names for the numbers of a vertex."""
    return [*"xyz", *(name for word in header.get("attributes", []) for name in NAMES_OF.get(word, [word]))]


def compare_vertices(result, names, columns, pairs):
    """Adds the differences of the vertices of triangles, or of the points of spheres; `pairs` are (number,
    vertices of A, vertices of B)."""
    thing, corner = names
    for t, vertices_a, vertices_b in pairs:
        for v, (vertex_a, vertex_b) in enumerate(zip(vertices_a, vertices_b)):
            if len(vertex_a.numbers) != len(vertex_b.numbers):  # the missing ones are unknown
                if not result.unlike:
                    result.unlike.append(
                        f"line {vertex_a.line}: {len(vertex_a.numbers)} and {len(vertex_b.numbers)} numbers")
                continue
            for i, (x, y) in enumerate(zip(vertex_a.numbers, vertex_b.numbers)):
                name = columns[i] if i < len(columns) else f"column {i + 1}"
                result.add(lambda: f"line {vertex_a.line}, {name} of {corner} {v + 1} of {thing} {t}", x, y)


def paired(a, b, tolerance):
    """(number, triangle of A, triangle of B) for each pair to compare, and in words how the counts differ;
    empty if they do not. If one list is the other without some triangles, all that both have are paired."""
    if len(a) == len(b):
        return zip(range(len(a)), a, b), ""
    words = f"{len(a)} and {len(b)} triangles"

    def is_same(one, other):
        return all(
            len(p.numbers) == len(q.numbers) and not any(
                exceeds(x, y, tolerance) for x, y in zip(p.numbers, q.numbers)) for p, q in zip(one, other))

    few, many = sorted((a, b), key=len)
    left, is_certain = left_over_for_certain(few, many, is_same)
    if not few or left is None:
        return zip(range(len(few)), a, b), words
    lacking, full = "AB" if few is a else "BA"
    words += f": {lacking} lacks {named(left)} of {full}" + ("" if is_certain else " (or what is the same)")
    left_out = set(left)
    kept = [triangle for t, triangle in enumerate(many) if t not in left_out]
    return zip(range(len(few)), *((few, kept) if few is a else (kept, few))), words


def compare_z_buffers(a, b, tolerance):
    """The Differences of two z-buffer texts, each a list of rows of numbers."""
    result = Differences("depths", tolerance)
    if len(a) != len(b):
        result.unlike.append(f"{len(a)} and {len(b)} rows")
    uneven = [(row, len(line_a), len(line_b)) for row, (line_a, line_b) in enumerate(zip(a, b))
              if len(line_a) != len(line_b)]
    if uneven:
        row, count_a, count_b = uneven[0]
        rows = f"1 row shows another number of pixels, row {row}" if len(
            uneven) == 1 else f"{len(uneven)} rows show another number of pixels, first row {row}"
        result.unlike.append(f"{rows}: {count_a} and {count_b}")
    for row, (line_a, line_b) in enumerate(zip(a, b)):
        if len(line_a) == len(line_b):
            for i, (x, y) in enumerate(zip(line_a, line_b)):
                result.add(lambda: f"line {row + 1}, number {i + 1}", x, y)
    return result


def compare_pictures(a, b, tolerance):
    """The Differences of two pictures, by the channel that differs most, and {row: 1 where pixels differ}."""
    result, mask = Differences("pixels", tolerance), {}
    (width_a, height_a, rows_a), (width_b, height_b, rows_b) = a, b
    if (width_a, height_a) != (width_b, height_b):
        result.unlike.append(f"{width_a} x {height_a} and {width_b} x {height_b} pixels")
        return result, mask
    for row, (line_a, line_b) in enumerate(zip(rows_a, rows_b)):
        result.compared += width_a
        if line_a == line_b:
            continue
        sizes = [[abs(x - y) for x, y in zip(line_a[channel::3], line_b[channel::3])] for channel in range(3)]
        largest = list(map(max, *sizes))
        mask[row] = bytes(size > tolerance for size in largest)
        result.differing += sum(mask[row])
        for column in (mask[row].find(1), largest.index(max(largest))) if any(mask[row]) else ():
            channel = max(range(3), key=lambda i: sizes[i][column])
            place = f"column {column}, row {row}, {('red', 'green', 'blue')[channel]}"
            result.keep(Pair(place, line_a[3 * column + channel], line_b[3 * column + channel]))
    return result, mask


def difference_picture(b, mask):
    """Picture b in pale gray, with the pixels of the mask in red."""
    width, height, rows = b
    painted = []
    for row, line in enumerate(rows):
        grays = (bytes((255 - sum(line[i:i + 3]) // 6,) * 3) for i in range(0, 3 * width, 3))
        pixels = zip(grays, mask.get(row, bytes(width)))
        painted.append(b"".join(bytes((220, 0, 30)) if is_marked else gray for gray, is_marked in pixels))
    return width, height, painted
