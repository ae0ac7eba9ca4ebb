"""The tables of the scan-line algorithm on a row: edge table, polygon table, active edges and polygons with
their in-out flags, and the polygon seen up to the next edge. The numbers are zbuf's own: the fragments
between the depth limits, and the triangles that its scan line shows."""
import io
import itertools
import math
import pathlib
import re
import struct
import tempfile
from fractions import Fraction

from lib.explaining.layout import aligned_left
from lib.maths.exact import decimal_or_double, short
from lib.text.stage_text import triangle_lines

FRAGMENT = re.compile(r"(\d+),(\d+): triangle (\d+), depth (\S+): (.*)")
OUTSIDE = ("lost, before the front limit", "lost, beyond the rear limit")
MAX_NUMBERS = 3  # of a list of polygons
MAX_SEEN = 16  # letters about the polygons seen
NOTHING = -1  # the number of the background


def scan_line_lines(stages, window, name, row):
    """The report on a row of the picture."""
    text = stages.projected_whole(("--digits", "exact"))
    with tempfile.TemporaryDirectory() as folder:
        log, array = pathlib.Path(folder, "fragments.txt"), pathlib.Path(folder, "triangles.npy")
        stages.zbuf(text, "--fragments", log)
        stages.zbuf(text, "--algorithm", "scanline", "--triangle-array", array)
        rows, depths = polygons_of(log, row)
        shown = numbers_of_row(array, window.width, row)
    y = -window.bottom + (2 * row + 1) * Fraction(window.bottom) / window.height
    triangles = [*corners_of(text, depths)]
    return [
        name, f"scan line {row} of 0 to {window.height - 1}, y = {short(y)} in NDC, coverage "
        f"{stages.settings.coverage}", "", f"EDGE TABLE, row {row}: the edges that begin there",
        *edge_table(triangles, window, rows, row), "", "POLYGON TABLE, of those on this row",
        *polygon_table(triangles, rows, depths), *shading_info(text, depths), "",
        "ACTIVE EDGES: left ones turn their polygon's flag to in, right ones to out",
        *active_edges(sorted(edges_of(depths)), shown)]


def polygons_of(log, row):
    """The first and the last row of every polygon, and the depths on one row: {polygon: {column: word}}."""
    rows, depths = {}, {}
    with open(log, encoding="ascii") as file:
        for line in file:
            column, at, polygon, depth, fate = FRAGMENT.match(line).groups()
            if fate in OUTSIDE:
                continue
            first, last = rows.get(int(polygon), (int(at), int(at)))
            rows[int(polygon)] = (min(first, int(at)), max(last, int(at)))
            if int(at) == row:
                depths.setdefault(int(polygon), {})[int(column)] = depth
    return rows, depths


def numbers_of_row(array, width, row):
    """A row of an .npy file of 64-bit integers."""
    data = array.read_bytes()
    start = 10 + int.from_bytes(data[8:10], "little") + 8 * width * row
    return struct.unpack(f"<{width}q", data[start:start + 8 * width])


def edges_of(depths):
    """(column, is_left, polygon, depth) for the first pixel in and after each run of a polygon."""
    for polygon, by_column in depths.items():
        for column, depth in by_column.items():
            if column - 1 not in by_column:
                yield column, True, polygon, depth
            if column + 1 not in by_column:
                yield column + 1, False, polygon, depth


def corners_of(text, wanted):
    """(number, three points) of each wanted triangle, or piece of one, in a text of project."""
    for number, lines in triangle_lines(io.BytesIO(text)):
        if number in wanted:
            yield number, [[decimal_or_double(word.decode()) for word in line.split()[:3]] for line in lines]


def edge_table(triangles, window, rows, row):
    """The non-horizontal edges whose first row is this one, from left to right."""
    found = []
    for polygon, corners in triangles:
        places, (first, last) = [window.place(p) for p in corners], rows[polygon]
        for ends in zip(places, places[1:] + places[:1]):
            (column, top), (other, bottom) = sorted(ends, key=lambda place: place[1])
            if top < bottom and max(first, math.ceil(top)) == row <= bottom:
                per_row = (other - column) / (bottom - top)
                found.append((column + (row - top) * per_row, min(last,
                                                                  math.floor(bottom)), per_row, polygon))
    return aligned_left([("column", "last row", "per row", "polygon")] +
                        [(short(column), str(end), short(per_row), str(polygon))
                         for column, end, per_row, polygon in sorted(found)]) if found else ["  none"]


def polygon_table(triangles, rows, depths):
    planes = {polygon: plane(*corners) for polygon, corners in triangles}
    return aligned_left([("polygon", "rows", "plane")] +
                        [(str(polygon), "{} to {}".format(*rows[polygon]), planes[polygon])
                         for polygon in sorted(depths)])


def shading_info(text, wanted):
    """The colors of wanted polygons or pieces of them, if the scene has colors."""
    columns = re.search(rb"^attributes (.*)", text, re.M)
    if not columns or b"color" not in columns[1].split():
        return []
    start = 4 if b"w" in columns[1].split() else 3
    table = [("polygon", "color")]
    for number, lines in sorted(of_one for of_one in triangle_lines(io.BytesIO(text)) if of_one[0] in wanted):
        colors = [" ".join(f"{float(word):.6g}" for word in line.split()[start:start + 3]) for line in lines]
        table.append((str(number), ", ".join(colors) if len({*colors}) > 1 else colors[0]))
    return ["", "SHADING INFO: red, green and blue; of each corner, where these differ", *aligned_left(table)]


def plane(a, b, c):
    """The plane of a triangle, in words."""
    u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
    slope = u[0] * v[1] - u[1] * v[0]
    if slope == 0:
        return "seen edge-on"
    along = (u[2] * v[1] - u[1] * v[2]) / slope, (u[0] * v[2] - u[2] * v[0]) / slope
    start = a[2] - along[0] * a[0] - along[1] * a[1]
    return f"z = {short(start)}" + "".join(f" {'-' if x < 0 else '+'} {short(abs(x))} {axis}"
                                           for x, axis in zip(along, "xy"))


def active_edges(edges, shown):
    table, active = [("column", "edge", "depth", "active polygons", "seen from here")], []
    for (column, is_left, polygon, depth), (end, *_) in zip(edges, edges[1:] + edges[-1:]):
        active = active + [polygon] if is_left else [other for other in active if other != polygon]
        seen = visible(shown, column, end) if end > column else ""
        words = f"{'left' if is_left else 'right'} of {polygon}"
        table.append((str(column), words, f"{float(depth):.7f}", numbers(active), seen))
    return aligned_left(table) if edges else ["  none: every pixel shows the background"]


def visible(shown, column, end):
    runs = [(number, len(list(run))) for number, run in itertools.groupby(shown[column:end])]
    words = ["nothing" if number == NOTHING else str(number) for number, _ in runs]
    if len(words) > 1:
        words = [f"{word} ({count})" for word, (_, count) in zip(words, runs)]
    text = ", ".join(words)
    return text if len(text) <= MAX_SEEN else words[0] + ", ..."


def numbers(polygons):
    if not polygons:
        return "none"
    rest = f" +{len(polygons) - MAX_NUMBERS}" if len(polygons) > MAX_NUMBERS else ""
    return ", ".join(map(str, polygons[:MAX_NUMBERS])) + rest
