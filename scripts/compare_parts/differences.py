"""How two lists of numbers, or two pictures, differ."""
import dataclasses
import math


def exceeds(a, b, tolerance):
    """Whether a and b differ by more than the tolerance and by more than reading decimals as doubles can add."""
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
        return f"{self.place}: {self.a:.10g} and {self.b:.10g}"


@dataclasses.dataclass
class Differences:
    """Compares `things`."""
    things: str
    tolerance: float
    compared: int = 0
    differing: int = 0
    first: Pair = None
    largest: Pair = None
    unlike: list = dataclasses.field(default_factory=list)  # differences that no pair of numbers shows

    def add(self, place, a, b):
        """Compares a and b; `place` returns their position as text."""
        self.compared += 1
        if a == b or not exceeds(a, b, self.tolerance):
            return False
        self.differing += 1
        pair = Pair(place(), a, b)
        self.first = self.first or pair
        if self.largest is None or pair.size > self.largest.size:
            self.largest = pair
        return True

    @property
    def found(self):
        return self.differing > 0 or bool(self.unlike)

    def rows(self):
        """Pairs of a name and a value, for a table."""
        yield f"{self.things} compared", str(self.compared)
        yield f"{self.things} that differ", str(self.differing)
        if self.largest:
            yield "largest difference", f"{self.largest.size:.3g}, {self.largest}"
            yield "first difference", str(self.first)
        for words in self.unlike:
            yield "not alike", words


def compare_stage_texts(a, b, tolerance):
    """The Differences of two StageTexts."""
    result = Differences("numbers", tolerance)
    for keyword in [*a.header, *(keyword for keyword in b.header if keyword not in a.header)]:
        if keyword in a.header and keyword in b.header and a.header[keyword] != b.header[keyword]:
            result.unlike.append(f"header line {keyword}: {' '.join(a.header[keyword])} and {' '.join(b.header[keyword])}")
    if len(a.triangles) != len(b.triangles):
        result.unlike.append(f"{len(a.triangles)} and {len(b.triangles)} triangles")
    for t, (triangle_a, triangle_b) in enumerate(zip(a.triangles, b.triangles)):
        for v, (vertex_a, vertex_b) in enumerate(zip(triangle_a, triangle_b)):
            for i, (x, y) in enumerate(zip(vertex_a.numbers, vertex_b.numbers)):
                result.add(lambda: f"line {vertex_a.line}, {'xyz'[i] if i < 3 else f'column {i + 1}'} of vertex {v + 1} of triangle {t}", x, y)
            if len(vertex_a.numbers) != len(vertex_b.numbers) and not result.unlike:
                result.unlike.append(f"line {vertex_a.line}: {len(vertex_a.numbers)} and {len(vertex_b.numbers)} numbers")
    return result


def compare_z_buffers(a, b, tolerance):
    """The Differences of two z-buffer texts, each a list of rows of numbers."""
    result = Differences("depths", tolerance)
    if len(a) != len(b):
        result.unlike.append(f"{len(a)} and {len(b)} rows")
    uneven = [(row, len(line_a), len(line_b)) for row, (line_a, line_b) in enumerate(zip(a, b)) if len(line_a) != len(line_b)]
    if uneven:
        row, count_a, count_b = uneven[0]
        rows = f"1 row shows another number of pixels, row {row}" if len(uneven) == 1 else f"{len(uneven)} rows show another number of pixels, first row {row}"
        result.unlike.append(f"{rows}: {count_a} and {count_b}")
    for row, (line_a, line_b) in enumerate(zip(a, b)):
        if len(line_a) == len(line_b):
            for i, (x, y) in enumerate(zip(line_a, line_b)):
                result.add(lambda: f"line {row + 1}, number {i + 1}", x, y)
    return result


def compare_pictures(a, b, tolerance):
    """The Differences of two pictures, by the channel that differs most in each pixel, and the pixels that differ."""
    result, mask = Differences("pixels", tolerance), set()
    (width_a, height_a, rows_a), (width_b, height_b, rows_b) = a, b
    if (width_a, height_a) != (width_b, height_b):
        result.unlike.append(f"{width_a} x {height_a} and {width_b} x {height_b} pixels")
        return result, mask
    for row, (line_a, line_b) in enumerate(zip(rows_a, rows_b)):
        if line_a == line_b:
            result.compared += width_a
            continue
        for column in range(width_a):
            pixel_a, pixel_b = line_a[3 * column:3 * column + 3], line_b[3 * column:3 * column + 3]
            channel = max(range(3), key=lambda i: abs(pixel_a[i] - pixel_b[i]))
            name = ("red", "green", "blue")[channel]
            if result.add(lambda: f"column {column}, row {row}, {name}", pixel_a[channel], pixel_b[channel]):
                mask.add((column, row))
    return result, mask


def difference_picture(b, mask):
    """Picture b in pale gray, with the pixels of the mask in red."""
    width, height, rows = b
    painted = []
    for row, line in enumerate(rows):
        gray = bytearray()
        for column in range(width):
            shade = 255 - sum(line[3 * column:3 * column + 3]) // 6
            gray += bytes((220, 0, 30)) if (column, row) in mask else bytes((shade,) * 3)
        painted.append(bytes(gray))
    return width, height, painted
