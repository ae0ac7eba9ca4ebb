"""The freedom that the specification leaves where the reference calculates exactly: F1 to F7."""
import decimal
import re
from fractions import Fraction

import reference

CLOSE = Fraction(1, 10**12)  # depths nearer to each other than this may be ordered either way
EITHER_SIDE = decimal.Decimal("1e-7")  # of a color


def expect_same_text(case, got, want, precise, read, is_noted=False):
    """Both texts of a stage are equal, but for what is open; `precise()` is `want` with 17 decimals, `read`
    what the stage read. If the tool has noted that digits are lost, 28 are right."""
    if got == want:
        return
    vertices = [
        line.split(b"#")[0].split() for line in read.split(b"\n") if line.strip()[:1] in b"+-.0123456789"]
    numbers = [
        abs(float(word)) for words in vertices for word in words
        if re.fullmatch(rb"[-+]?[0-9.]+(e[-+]?[0-9]+)?", word)]
    smallest = 2.0**-60 * max(numbers, default=1)
    # the first column that F3 is about
    color_or_normal = 4 if b"attributes w" in want or b"\nclipped" in want else 3
    case.assertEqual(got.count(b"\n"), want.count(b"\n"))
    for got_line, want_line, precise_line in zip(*(text.decode().split("\n")
                                                   for text in (got, want, precise()))):
        words = zip(got_line.split(" "), want_line.split(" "), precise_line.split(" "))
        for column, (a, b, x) in enumerate(words if got_line != want_line else ()):
            if a != b:
                unit = Fraction(1, 10**len(a.partition(".")[2]))
                is_tie = abs(abs(Fraction(a) - Fraction(x)) - unit / 2) < unit / 2**20
                is_close = column >= color_or_normal and abs(Fraction(a) - Fraction(x)) < CLOSE + unit / 2
                is_lost = is_noted and abs(Fraction(a) - Fraction(b)) <= max(
                    abs(Fraction(b)) / 10**28,
                    Fraction(smallest) / 2**30)
                case.assertTrue(is_tie or is_close or is_lost or a == "0" and abs(float(b)) <= smallest,
                                (got_line, want_line, precise_line))


def expect_same_picture(case, triangles, stage, config, options, model_name, depth_text, image):
    """The depths and the image are those of the reference, or at each pixel one that is open."""
    depths, seen = reference.draw(triangles, config, options["--coverage"])
    with decimal.localcontext(reference.SHADING):
        picture = reference.shade(seen, stage.header, config, model_name)
    if depth_text == reference.depth_text(depths, config.rear) and image == reference.bmp(
        [[*map(reference.rounded, row)] for row in picture]):
        return
    rivals = close_fragments(triangles, config, options["--coverage"], depths, seen)
    expect_same_depths(case, depth_text, depths, config, rivals)
    case.assertEqual(image[:54], reference.bmp([[(0, 0, 0)] * config.width] * config.height)[:54])
    for row, column, rgb in pixels_of(image, config):
        if not is_shown(rgb, picture[row][column]):
            others = [
                alone(triangle, row, column, stage, config, model_name)
                for triangle in rivals.get((row, column), ())]
            case.assertTrue(any(other is None or is_shown(rgb, other) for other in others),
                            (row, column, rgb, picture[row][column]))


def close_fragments(triangles, config, coverage, depths, seen):
    """For pixels where doubles may see another triangle (F5): those triangles, and None for the background.
    Of one place, or of one depth, doubles have the same depth as well."""
    rivals = {}
    for triangle in triangles:
        for row, column, z in getattr(reference, coverage)(triangle, config):
            winner, is_flat = seen[row][column], len({corner.position[2] for corner in triangle.corners}) == 1
            is_at_limit = not is_flat and min(abs(z - config.front), abs(
                z - config.rear)) < CLOSE or coverage == "nearest" and has_no_sure_slope(triangle)
            is_close = config.front <= z < depths[row][column] + CLOSE and triangle is not winner
            if is_at_limit:
                rivals.setdefault((row, column), []).append(None)
            if is_at_limit or is_close and not (winner and depths_are_alike(triangle, winner)):
                rivals.setdefault((row, column), []).append(triangle)
    return rivals


def depths_are_alike(a, b):
    """True if two triangles stand at one place, or each has one depth."""
    places = [[corner.position for corner in triangle.corners] for triangle in (a, b)]
    return places[0] == places[1] or all(len({z for _, _, z in place}) == 1 for place in places)


def expect_same_depths(case, text, depths, config, rivals):
    rows = text.decode().split("\n")
    case.assertEqual(len(rows), config.height + 1)
    for row, (line, want) in enumerate(zip(rows, depths)):
        if any(None in rivals.get((row, column), ()) for column in range(config.width)):
            continue  # one more or one less on this row
        want, words = [z for z in want if z < config.rear], line.split("\t")[:-1]
        case.assertEqual(len(words), len(want), (row, line))
        for word, z in zip(words, want):
            case.assertTrue(
                word == reference.fixed(z, 6) or abs(Fraction(word) - z) < Fraction(1, 2 * 10**6) + CLOSE,
                (row, word, float(z)))


def pixels_of(image, config):
    """(row, column, (red, green, blue)) of a BMP file."""
    stride = (3 * config.width + 3) // 4 * 4
    for row in range(config.height):
        for column in range(config.width):
            at = 54 + stride * (config.height - 1 - row) + 3 * column
            yield row, column, tuple(image[at:at + 3][::-1])


def is_shown(rgb, color):
    """True if a color may be rounded so (L6, F6)."""
    sides = [reference.rounded([channel + side for channel in color]) for side in (-EITHER_SIDE, EITHER_SIDE)]
    return all(c in pair for c, *pair in zip(rgb, *sides))


def alone(triangle, row, column, stage, config, model_name):
    """The color of a pixel if it shows this triangle; None for no triangle."""
    seen = [[None] * config.width for _ in range(config.height)]
    seen[row][column] = triangle
    with decimal.localcontext(reference.SHADING):
        return triangle and reference.shade(seen, stage.header, config, model_name)[row][column]


def has_no_sure_slope(triangle):
    """True if doubles may take a triangle for one that is seen edge-on (F5)."""
    a, b, c = (corner.position[:2] for corner in triangle.corners)
    terms = (b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1])
    return 0 < abs(terms[0] - terms[1]) <= (abs(terms[0]) + abs(terms[1])) / 2**50
