"""The tables of the scan-line algorithm on a row: edge table, polygon table, active edges and polygons with
their in-out flags, and the polygon seen up to the next edge. The numbers are zbuf's own: the fragments
between the depth limits, and the triangles that its scan line shows."""
import collections
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
    lines += table(f"EDGE TABLE, row {row}: the edges that begin there", "column, last row, per row, polygon",
                   sorted(edges_from(row, corners, window, rows)), "none")
    lines += table("POLYGON TABLE, of those on this row", "polygon, rows, plane",
                   ((n, f"{min(rows[n])} to {max(rows[n])}", planes[n]) for n in sorted(depths)))
    if "color" in (attributes := header_of(stages.projected).get("attributes", [])):
        start = 3 + ("w" in attributes)
        lines += table(
            "SHADING INFO: red, green and blue; of each corner, where these differ", "polygon, color",
            ((n, colors(words[start:start + 3] for words in corners)) for n, corners in sorted(pieces)))
    return lines + table("ACTIVE EDGES: left ones turn their polygon's flag to in, right ones to out",
                         "column, edge, depth, active polygons, seen from here", active_edges(
                             depths, shown), "none: every pixel shows the background")


def table(title, heads, rows, none=""):
    """The lines of a table, whose rows hold words and numbers; `none` replaces one without rows."""
    words = [[short(x) if isinstance(x, Fraction) else str(x) for x in row] for row in rows]
    return ["", title, *(aligned_left([heads.split(", "), *words]) if words or not none else [INDENT + none])]


def polygons_of(log, row):
    """The rows of every polygon, and the depths on one row: {polygon: {column: word}}."""
    rows, depths = collections.defaultdict(set), collections.defaultdict(dict)
    with open(log, encoding="ascii") as file:
        for *numbers, depth, fate in (FRAGMENT.match(line).groups() for line in file):
            column, at, polygon = map(int, numbers)
            if not fate.endswith(" limit"):
                rows[polygon].add(at)
                if at == row:
                    depths[polygon][column] = depth
    return rows, depths


def edges_from(row, triangles, window, rows):
    """(column, last row, columns per row, polygon) of the non-horizontal edges that begin on a row."""
    for polygon, corners in triangles:
        for ends in itertools.combinations(map(window.place, corners), 2):
            (column, top), (other, bottom) = sorted(ends, key=lambda place: place[1])
            if top < bottom and max(min(rows[polygon]), math.ceil(top)) == row <= bottom:
                per_row = (other - column) / (bottom - top)
                last = min(max(rows[polygon]), math.floor(bottom))
                yield column + (row - top) * per_row, last, per_row, polygon


def colors(corners):
    words = [" ".join(f"{float(word):.6g}" for word in corner) for corner in corners]
    return ", ".join(words) if len({*words}) > 1 else words[0]


def plane(a, b, c):
    """The plane of a triangle, in words."""
    normal = cross(*([q - p for p, q in zip(a, other)] for other in (b, c)))
    if normal[2] == 0:
        return "seen edge-on"
    z, x, y = (short(n / normal[2]) for n in (dot(normal, a), -normal[0], -normal[1]))
    return f"z = {z} + {x} x + {y} y".replace("+ -", "- ")


def active_edges(depths, shown):
    """The first pixel in and after each run of a polygon, and what is active and seen from there."""
    ends = sorted((column if is_left else column + 1, is_left, polygon, depth)
                  for polygon, by_column in depths.items() for column, depth in by_column.items()
                  for is_left in (False, True) if column + (-1 if is_left else 1) not in by_column)
    active = []
    for (column, is_left, polygon, depth), (end, *_) in zip(ends, ends[1:] + ends[-1:]):
        active = active + [polygon] if is_left else [other for other in active if other != polygon]
        rest = f" +{len(active) - MAX_NUMBERS}" if len(active) > MAX_NUMBERS else ""
        numbers = ", ".join(map(str, active[:MAX_NUMBERS])) or "none"
        words = f"{'left' if is_left else 'right'} of {polygon}"
        yield column, words, f"{float(depth):.7f}", numbers + rest, visible(shown[column:end])


def visible(shown):
    """The polygons seen in some columns, with the count of each if there are several."""
    runs = [("nothing" if number == NOBODY else str(number), len([*run]))
            for number, run in itertools.groupby(shown)]
    words = [f"{word} ({count})" if len(runs) > 1 else word for word, count in runs]
    text = ", ".join(words)
    return text if len(text) <= MAX_SEEN else words[0] + ", ..."
