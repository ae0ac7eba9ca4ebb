"""The report on one pixel: does the triangle cover it, how deep is it there, and which triangle is seen."""
from lib.explaining.layout import INDENT, aligned_left
from lib.maths.exact import fixed, measured, short
from lib.maths.window import OWNING, PixelOfTriangle


def pixel_section(stages, window, pieces, number, pixel):
    """Lines about the pixel and triangle `number`, whose pieces are pairs of names and points in NDC; the
    pixel's Fragments; and the PixelOfTriangle of the piece that covers the pixel, or is nearest to it."""
    fragments, rule, shown = stages.fragments(*pixel), stages.settings.coverage, None
    x, y = window.grid.x_of(pixel[0]), window.grid.y_of(pixel[1])
    lines = [
        f"PIXEL    {pixel[0]},{pixel[1]}: its center is at column {pixel[0]}, row {pixel[1]} of the window, "
        f"at ({short(x)} {short(y)}) in NDC"]
    if pieces:
        is_drawn = any(fragment.triangle == number for fragment in fragments)
        pixels = [PixelOfTriangle(window, names, points, pixel) for names, points in pieces]
        shown = max(pixels, key=lambda p: (p.is_covered(rule), p.distance))
        lines += coverage_lines(shown, rule, is_drawn)
    return lines, fragments, shown


def coverage_lines(shown, rule, is_drawn):
    lines = edge_lines(shown.edges, rule) if shown.has_area else []
    lines += center_lines(shown) if rule == "center" else nearest_lines(shown)
    is_covered = shown.is_covered(rule)
    if is_covered != is_drawn:
        lines.append(f"{INDENT}zbuf itself: {'covered' if is_drawn else 'not covered'}")
    if is_covered or is_drawn:
        lines += depth_lines(shown, rule)
    return lines


def depth_lines(pixel, rule):
    if pixel.single_crossing(rule) is not None:
        return [
            f"{INDENT}depth = {fixed(pixel.depth(rule), 10)}, where the row meets the triangle in a "
            f"single point"]
    if not pixel.has_area:
        return []
    terms = " + ".join(
        f"{measured(weight)} z{name}" for weight, name in zip(pixel.weights, pixel.names)).replace(
            "+ -", "- ")
    return [f"{INDENT}depth = {terms} = {fixed(pixel.depth(rule), 10)}"]


def edge_lines(edges, rule):
    rows = [edge_words(edge, rule) for edge in edges]
    width = max(len(number) for _, number, _ in rows)
    return [
        f"{INDENT}{name}   {words if not number else f'{number.rjust(width)} {words}'}"
        for name, number, words in rows]


def edge_words(edge, rule):
    if edge.value == 0:
        owned = f": {'owned' if edge.side in OWNING else 'not owned'}" * (rule == "center")
        return [f"edge {edge.name}", "", f"exactly on a {edge.side} edge{owned}"]
    return [
        f"edge {edge.name}",
        measured(abs(edge.distance)),
        f"pixels {'inside' if edge.value > 0 else 'outside'} a {edge.side} edge"]


def center_lines(pixel):
    if not pixel.has_area:
        return [f"{INDENT}not covered: a triangle without area covers no center"]
    outside = [edge.name for edge in pixel.edges if edge.value < 0]
    if outside:
        return [f"{INDENT}not covered: the center is outside edge {' and edge '.join(outside)}"]
    foreign = [edge for edge in pixel.edges if not edge.is_owned]
    if foreign:
        return [f"{INDENT}not covered: points on a {foreign[0].side} edge belong to the triangle beyond it"]
    on_edge = any(edge.value == 0 for edge in pixel.edges)
    return [
        f"{INDENT}covered: "
        f"{'points on left and top edges belong to the triangle' if on_edge else 'the center is inside'}"]


def nearest_lines(pixel):
    column, row = pixel.pixel
    exact, in_doubles = pixel.span(), pixel.span_in_doubles()
    lines = []
    if exact:
        lines.append(
            f"{INDENT}row {row} crosses it from column {measured(exact.left)} to {measured(exact.right)}: "
            f"pixels {exact.first} to {exact.last} are nearest")
    if in_doubles and in_doubles.ends != (exact and exact.ends):
        lines.append(
            f"{INDENT}in doubles, as zbuf calculates, from {in_doubles.left!r} to {in_doubles.right!r}: "
            f"pixels {in_doubles.first} to {in_doubles.last}")
    if not in_doubles:
        return [
            *lines, f"{INDENT}not covered: the line through the centers of row {row} does not cross the "
            f"triangle{' in doubles' if exact else ''}"]
    if not in_doubles.has(column):
        return [
            *lines,
            f"{INDENT}not covered: {column} is {'left' if column < in_doubles.first else 'right'} of these"]
    is_outside = any(edge.value < 0 for edge in pixel.edges)
    return [
        *lines, f"{INDENT}covered: {column} is one of these{', although its center is outside' * is_outside}"]


def winner_lines(fragments, number, max_lines):
    """The fragments in the order of the depth test, and the last one kept; the triangle's own are marked. If
    there are more than `max_lines`, the winner, the triangle's own and the first ones are shown."""
    if not fragments:
        return ["no triangle covers this pixel: it shows the background"]
    rows, seen = [], None
    for fragment in fragments:
        fate = fragment.fate
        if fragment.is_kept:
            fate = f"kept, nearer than triangle {seen.triangle}" if seen else "kept, the first one"
            seen = fragment
        rows.append([
            "->" if fragment.triangle == number else "", f"triangle {fragment.triangle}",
            f"depth {fragment.depth}", fate])
    order = sorted(range(len(rows)), key=lambda i:
                   (fragments[i] is not seen, fragments[i].triangle != number, i))
    shown = sorted(order[:max(1, max_lines - 2)])
    some = f" ({len(shown)} of {len(rows)})" * (len(shown) < len(rows))
    return [
        f"{INDENT}at this pixel, in the order they are drawn{some}:", *aligned_left([rows[i] for i in shown]),
        INDENT + verdict(fragments, seen, number)]


def verdict(fragments, seen, number):
    if seen is None:
        return "none of them is between the limits: the pixel shows the background"
    own = [fragment for fragment in fragments if fragment.triangle == number]
    shows = f"the pixel shows triangle {seen.triangle}"
    if not own or seen.triangle == number:
        return shows
    nearest = min(own, key=lambda fragment: float(fragment.depth))
    if float(nearest.depth) > float(seen.depth):
        return f"{shows}: {seen.depth} is nearer than {nearest.depth}"
    return f"{shows}: it is as near and came earlier" if nearest.depth == seen.depth else shows
