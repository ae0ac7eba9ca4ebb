"""The tables of the scan-line algorithm on a row: edge table, polygon table, active edges and polygons with
their in-out flags, and the polygon seen up to the next edge. The numbers are zbuf's own: the fragments
between the depth limits, and the triangles that its scan line shows."""
import io
import itertools
import math
import pathlib
import tempfile
from fractions import Fraction

from lib.explaining.layout import INDENT, aligned_left
from lib.explaining.stages import FRAGMENT
from lib.maths.exact import decimal_or_double, short
from lib.maths.vectors import cross, dot
from lib.running.owners import NOBODY, owners_in
from lib.text.stage_text import header_of, triangle_lines

MAX_NUMBERS = 3  # of a list of polygons
MAX_SEEN = 16  # letters about the polygons seen


def scan_line_lines(stages, window, name, row):
    """The report on a row of the picture."""
    with tempfile.TemporaryDirectory() as folder:
        log, array = pathlib.Path(folder, "fragments.txt"), pathlib.Path(folder, "triangles.npy")
        stages.zbuf(stages.projected, "--algorithm", "scanline", "--fragments", log, "--triangle-array",
                    array)
        rows, depths = polygons_of(log, row)
        shown = owners_in(array)[row * window.width:(row + 1) * window.width]
    pieces = [(polygon, [line.decode().split() for line in lines])
              for polygon, lines in triangle_lines(io.BytesIO(stages.projected)) if polygon in depths]
    corners = [(polygon, [tuple(map(decimal_or_double, words[:3])) for words in vertices])
               for polygon, vertices in pieces]
    planes = {polygon: plane(*points) for polygon, points in corners}
    lines = [
        name, f"scan line {row} of 0 to {window.height - 1}, y = {short(window.grid.y_of(row))} in NDC, "
        f"coverage {stages.settings.coverage}"]
    lines += table(f"EDGE TABLE, row {row}: the edges that begin there",
                   ("column", "last row", "per row", "polygon"), sorted(edges_from(
                       row, corners, window, rows)), "none")
    lines += table(
        "POLYGON TABLE, of those on this row", ("polygon", "rows", "plane"),
        ((polygon, "{} to {}".format(*rows[polygon]), planes[polygon]) for polygon in sorted(depths)))
    if "color" in (attributes := header_of(stages.projected).get("attributes", [])):
        lines += table("SHADING INFO: red, green and blue; of each corner, where these differ",
                       ("polygon", "color"), colors_of(pieces, 3 + ("w" in attributes)))
    return lines + table("ACTIVE EDGES: left ones turn their polygon's flag to in, right ones to out",
                         ("column", "edge", "depth", "active polygons", "seen from here"),
                         active_edges(sorted(ends_of(depths)),
                                      shown), "none: every pixel shows the background")


def table(title, heads, rows, none=""):
    """The lines of a table, whose rows hold words and numbers; `none` replaces one without rows."""
    words = [[short(x) if isinstance(x, Fraction) else str(x) for x in row] for row in rows]
    return ["", title, *(aligned_left([heads, *words]) if words or not none else [INDENT + none])]


def polygons_of(log, row):
    """The first and the last row of every polygon, and the depths on one row: {polygon: {column: word}}."""
    rows, depths = {}, {}
    with open(log, encoding="ascii") as file:
        for line in file:
            *numbers, depth, fate = FRAGMENT.match(line).groups()
            if fate.endswith(" limit"):
                continue
            column, at, polygon = map(int, numbers)
            first, last = rows.get(polygon, (at, at))
            rows[polygon] = (min(first, at), max(last, at))
            if at == row:
                depths.setdefault(polygon, {})[column] = depth
    return rows, depths


def ends_of(depths):
    """(column, is_left, polygon, depth) for the first pixel in and after each run of a polygon."""
    for polygon, by_column in depths.items():
        for column, depth in by_column.items():
            if column - 1 not in by_column:
                yield column, True, polygon, depth
            if column + 1 not in by_column:
                yield column + 1, False, polygon, depth


def edges_from(row, triangles, window, rows):
    """(column, last row, columns per row, polygon) of the non-horizontal edges that begin on a row."""
    for polygon, corners in triangles:
        places, (first, last) = [window.place(p) for p in corners], rows[polygon]
        for ends in zip(places, places[1:] + places[:1]):
            (column, top), (other, bottom) = sorted(ends, key=lambda place: place[1])
            if top < bottom and max(first, math.ceil(top)) == row <= bottom:
                per_row = (other - column) / (bottom - top)
                yield column + (row - top) * per_row, min(last, math.floor(bottom)), per_row, polygon


def colors_of(pieces, start):
    """(polygon, words) for each piece; colors begin at the word `start` of a vertex line."""
    for polygon, vertices in sorted(pieces):
        colors = [" ".join(f"{float(word):.6g}" for word in words[start:start + 3]) for words in vertices]
        yield polygon, ", ".join(colors) if len({*colors}) > 1 else colors[0]


def plane(a, b, c):
    """The plane of a triangle, in words."""
    normal = cross(*([q - p for p, q in zip(a, other)] for other in (b, c)))
    if normal[2] == 0:
        return "seen edge-on"
    start, *along = (x / normal[2] for x in (dot(normal, a), -normal[0], -normal[1]))
    return f"z = {short(start)}" + "".join(f" {'-' if x < 0 else '+'} {short(abs(x))} {axis}"
                                           for x, axis in zip(along, "xy"))


def active_edges(ends, shown):
    active = []
    for (column, is_left, polygon, depth), (end, *_) in zip(ends, ends[1:] + ends[-1:]):
        active = active + [polygon] if is_left else [other for other in active if other != polygon]
        words = f"{'left' if is_left else 'right'} of {polygon}"
        yield column, words, f"{float(depth):.7f}", numbers(active), visible(shown[column:end])


def visible(shown):
    """The polygons seen in some columns, with the count of each if there are several."""
    runs = [("nothing" if number == NOBODY else str(number), len([*run]))
            for number, run in itertools.groupby(shown)]
    words = [f"{word} ({count})" if len(runs) > 1 else word for word, count in runs]
    text = ", ".join(words)
    return text if len(text) <= MAX_SEEN else words[0] + ", ..."


def numbers(polygons):
    rest = f" +{len(polygons) - MAX_NUMBERS}" if len(polygons) > MAX_NUMBERS else ""
    return (", ".join(map(str, polygons[:MAX_NUMBERS])) or "none") + rest
