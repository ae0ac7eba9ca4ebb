"""The tables of the scan-line algorithm on a row: edge table, polygon table, active edges and polygons with
their in-out flags, and the polygon seen up to the next edge. The numbers are zbuf's own: the fragments
between the depth limits, and the triangles that its scan line shows."""
import dataclasses
import io
import itertools
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
MAX_SEEN = 16    # letters about the polygons seen
NOTHING = -1     # the number of the background


@dataclasses.dataclass
class Edge:
    """An end of neighboring pixels of a polygon: its first pixel, or the one after its last."""
    column: int
    is_right: bool
    polygon: int
    depth: str


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
    first_here = [polygon for polygon, (first, _) in sorted(rows.items()) if first == row]
    return [
        name, f"scan line {row} of 0 to {window.height - 1}, y = {short(y)} in NDC, coverage "
        f"{stages.settings.coverage}", "", f"EDGE TABLE, row {row}: edges begin here of "
        f"{numbers(first_here)}", "", "POLYGON TABLE, of those on this row",
        *polygon_table(text, rows, depths), "",
        "ACTIVE EDGES: left ones turn their polygon's flag to in, right ones to out",
        *active_edges(edges_of(depths), shown)]


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
    """The edges on the row, from the left; of equal columns, right ones first."""
    edges = []
    for polygon, by_column in depths.items():
        for _, run in itertools.groupby(enumerate(sorted(by_column)), lambda pair: pair[1] - pair[0]):
            columns = [column for _, column in run]
            edges += [Edge(columns[0], False, polygon, by_column[columns[0]]),
                      Edge(columns[-1] + 1, True, polygon, by_column[columns[-1]])]
    return sorted(edges, key=lambda edge: (edge.column, not edge.is_right, edge.polygon))


def polygon_table(text, rows, depths):
    table = [("polygon", "rows", "plane")]
    planes = dict(planes_of(text, depths))
    for polygon in sorted(depths):
        first, last = rows[polygon]
        table.append((str(polygon), f"{first} to {last}", planes[polygon]))
    return aligned_left(table)


def planes_of(text, wanted):
    """The plane of each triangle of a text of project, as words."""
    for number, corners in triangle_lines(io.BytesIO(text)):
        if number in wanted:
            a, b, c = ([decimal_or_double(word.decode()) for word in line.split()[:3]] for line in corners)
            u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
            slope = u[0] * v[1] - u[1] * v[0]
            if slope == 0:
                yield number, "seen edge-on"
                continue
            along = (u[2] * v[1] - u[1] * v[2]) / slope, (u[0] * v[2] - u[2] * v[0]) / slope
            start = a[2] - along[0] * a[0] - along[1] * a[1]
            signs = ("-" if x < 0 else "+" for x in along)
            yield number, f"z = {short(start)}" + "".join(
                f" {sign} {short(abs(x))} {axis}" for sign, x, axis in zip(signs, along, "xy"))


def active_edges(edges, shown):
    table, active = [("column", "edge", "depth", "active polygons", "seen from here")], []
    for edge, following in zip(edges, [*edges[1:], None]):
        if edge.is_right:
            active.remove(edge.polygon)
        else:
            active.append(edge.polygon)
        words = f"{'right' if edge.is_right else 'left'} of {edge.polygon}"
        is_last = following is None or following.column > edge.column
        seen = visible(shown, edge.column, following.column) if is_last and following else ""
        table.append((str(edge.column), words, f"{float(edge.depth):.7f}", numbers(active), seen))
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
