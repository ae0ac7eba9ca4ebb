"""Files of a right hand-in that are emptied, blackened, cut in half, taken from another scene, or drawn with
a triangle missing: what is left whole keeps its point, and nothing else gets one."""
import itertools
import struct

import reference

NAMES = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
SUBSETS = [some for count in range(1, 6) for some in itertools.combinations(NAMES, count)]
HOWS = ("emptied", "blank", "in one place", "cut in half", "of another scene")


def rows_of(bmp):
    """The header of a BMP of 24 bits, and its rows of bytes."""
    begin, (width, height) = struct.unpack_from("<I", bmp, 10)[0], struct.unpack_from("<ii", bmp, 18)
    stride = (3 * width + 3) // 4 * 4
    return bmp[:begin], [bmp[begin + i * stride:begin + (i + 1) * stride] for i in range(abs(height))]


def damaged(name, data, how, other):
    """A file's bytes after the damage; `other` are the file's of another scene."""
    if how == "of another scene":
        return other
    if name == "out.bmp":
        header, rows = rows_of(data)
        kept = len(rows) // 2 if how == "cut in half" else 0
        return header + b"".join(rows[:kept]) + b"".join(bytes(len(row)) for row in rows[kept:])
    if how == "cut in half":
        parts = data.rstrip().split(b"\n" if name == "z_buffer.txt" else b"\n\n")
        end = b"\n" if name == "z_buffer.txt" else b"\n\n"
        return b"".join(part + end for part in parts[:len(parts) // 2])
    if how == "in one place" and name.startswith("stage"):
        return b"0 0 0\n0.0000001 0 0\n0 0.0000001 0\n\n"
    return b"\n" * 7 if how == "blank" else b""


def expected(right, files, how):
    """{name: whether it earns its point} of the files for which that is beyond doubt: a text whose former is
    damaged in the same way may be what a right stage has made of that."""
    certain = {}
    for name, before in zip(NAMES, (None, "stage1.txt", "stage2.txt", "stage3.txt", "stage3.txt")):
        is_whole = files[name] == right[name]
        if name == "out.bmp" and deep_colors(files[name]) >= deep_colors(right[name]) and not is_whole:
            continue  # no triangle is lost that can be seen well
        follows = before and files[before] != right[before] and how in ("cut in half", "of another scene")
        if is_whole or not follows:
            certain[name] = is_whole
    return certain


def deep_colors(bmp):
    """The colors, other than black, of pixels all of whose neighbors within two pixels have the same."""
    width = struct.unpack_from("<i", bmp, 18)[0]
    pixels = [[row[3 * i:3 * i + 3] for i in range(width)] for row in rows_of(bmp)[1]]
    runs = [[row[i] if row[i:i + 5] == row[i:i + 1] * 5 else b"" for i in range(width - 4)] for row in pixels]
    return {
        column[i]
        for column in zip(*runs) for i in range(len(column) - 4)
        if any(column[i]) and column[i:i + 5] == column[i:i + 1] * 5}


def generated_colors(count):
    """The colors of triangles that have none (docs/stages.md, Z10), blue first, as a BMP has them."""
    return [bytes(reference.generated_color(number)[::-1]) for number in range(count)]


def numbered_triangles(stage3):
    """(number, lines) of each triangle of a text, or piece of one."""
    found = []
    for part in stage3.rstrip().split("\n\n"):
        head, _, rest = part.partition("\n")
        is_numbered = head.startswith("triangle ")
        number = int(head.split()[1]) if is_numbered else found[-1][0] + 1 if found else 0
        found.append((number, rest if is_numbered else part))
    return found
