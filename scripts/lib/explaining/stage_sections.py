"""The report on the stages model, view and project: a list of lines for each. The coordinates shown are the
tools'."""
from lib.explaining.calculation import agrees
from lib.explaining.clipping import outside_of, winding
from lib.explaining.layout import INDENT, aligned, beside, matrix_lines
from lib.maths.exact import coordinate, decimal_or_double, fixed, measured, short

MAX_TRANSFORMS = 4  # as many as a matrix has rows
MAX_CUTS = 4
CORNERS = "012"


def vertex_lines(rows, printed, points, digits):
    """Rows of words, one for each vertex. If the tool `printed` other numbers than exact arithmetic gives,
    the exact ones follow."""
    lines = []
    for line, words, point in zip(aligned(rows), printed, points):
        lines.append(line)
        if not agrees(words, point, digits):
            lines.append(f"{INDENT}   exact arithmetic: {' '.join(coordinate(x, digits) for x in point)}")
    return lines


def model_section(stages, triangle, calculation):
    shown = triangle.transforms if len(
        triangle.transforms) <= MAX_TRANSFORMS else triangle.transforms[1 - MAX_TRANSFORMS:]
    left_out = len(triangle.transforms) - len(shown)
    facts = [f"({left_out} transforms before these)"] if left_out else []
    facts += [f"line {t.line}  {t.keyword} {' '.join(t.arguments[0])}"
              for t in shown] or ["no transform is in force"]
    rows = [[name, *p, "->", *world] for name, p, world in zip(CORNERS, triangle.points, stages.world)]
    return [
        "MODEL    world = M p      M is the product of the transforms in force; the last one acts first",
        *beside(facts, matrix_lines("M", calculation.model_matrix)),
        *vertex_lines(rows, stages.world, calculation.world, stages.settings.digits)]


def view_section(stages, calculation):
    camera = stages.camera()
    facts = [f"{name:4}  {' '.join(camera[name])}" for name in ("eye", "look", "up")]
    rows = [[name, *words] for name, words in zip(CORNERS, stages.view)]
    return [
        "VIEW     view = V world   V moves the eye to the origin and turns the camera to look down -z",
        *beside(facts, matrix_lines("V", calculation.view_matrix)),
        *vertex_lines(rows, stages.view, calculation.view, stages.settings.digits)]


def projection_facts(projection):
    words = projection.words
    if projection.kind != "perspective":
        left, right, bottom, top, near, far = words
        return [
            projection.kind, f"left {left}, right {right}", f"bottom {bottom}, top {top}",
            f"near {near}, far {far}"]
    fov_y, aspect, near, far = words
    if projection.aspect_rule == "ratio":
        rule = "tan(fovX/2) = aspect tan(fovY/2)"
    else:
        rule = f"fovX = fovY aspect = {short(projection.numbers[0] * projection.numbers[1])}"
    return [f"fovY {fov_y}, aspect {aspect}", rule, f"near {near}", f"far  {far}"]


def place_of(corner):
    """The place of a point in clip space, in words."""
    if corner[3] <= 0:  # there the window's sides have changed places
        return "behind the eye"
    planes = outside_of(corner)
    return "outside " + ", ".join(planes) if planes else "inside"


def project_section(calculation):
    clipped = calculation.clipped
    rows = [[name, *(fixed(x, 7) for x in p)] for name, p in zip(CORNERS, calculation.corners)]
    notes = [place_of(p) for p in calculation.corners]
    cuts = [vertex for vertex in clipped.polygon if vertex.cut]
    for vertex in cuts[:MAX_CUTS]:
        rows.append([vertex.name, *(fixed(x, 7) for x in vertex.point)])
        notes.append(vertex.cut)
    lines = aligned(rows)
    width = max(map(len, lines))
    result = clipped.reason
    more = [f"{INDENT}({len(cuts) - MAX_CUTS} more)"] * (len(cuts) > MAX_CUTS)
    if clipped.fate == "cut":
        pieces = ", ".join("-".join(vertex.name for vertex in piece) for piece in clipped.pieces)
        result = f"cut: what is left is the triangle {pieces}" if len(
            clipped.pieces) == 1 else f"cut: what is left are the triangles {pieces}"
    volume = "; w is 1" if calculation.projection.is_parallel else "; w is the distance ahead of the eye"
    return [
        f"PROJECT  clip = P view    P makes the view volume -w <= x, y, z <= w{volume}",
        *beside(projection_facts(calculation.projection), matrix_lines("P", calculation.projection_matrix)),
        *(f"{line.ljust(width)}   {note}" for line, note in zip(lines, notes)), *more, INDENT + result]


def window_section(stages, calculation, window):
    """The divide and the window transform, vertex by vertex."""
    printed, points = {}, {}
    for piece, texts, exact in zip(calculation.clipped.pieces, stages.ndc, calculation.ndc):
        for vertex, words, point in zip(piece, texts, exact):
            printed[vertex.name], points[vertex.name] = words, point
    places = [window.place(tuple(map(decimal_or_double, words))) for words in printed.values()]
    rows = [[name, *words, "->", measured(column), measured(row)]
            for (name, words), (column, row) in zip(printed.items(), places)]
    x_scale, y_scale = (f"* {pixels} / {short(-2 * limit)}"
                        for pixels, limit in ((window.width, window.left), (window.height, window.bottom)))
    return [
        "DIVIDE   ndc = (x y z) / w        what is far away gets small; a smaller z is nearer",
        f"WINDOW   column = (x - {short(window.left)}) {x_scale} - 0.5, row = ({short(-window.bottom)} - y) "
        f"{y_scale} - 0.5: centers are whole".replace("- -", "+ "),
        *vertex_lines(rows, printed.values(), points.values(), stages.settings.digits), INDENT +
        extent(calculation, window, places, [decimal_or_double(words[2]) for words in printed.values()])]


def extent(calculation, window, places, depths):
    """A line on the triangle's size in the picture, or the reason why it is not visible."""
    columns, rows = zip(*places)
    beyond = {
        "left of the picture": max(columns) < -0.5, "right of the picture": min(columns) > window.width - 0.5,
        "above the picture": max(rows) < -0.5, "below the picture": min(rows) > window.height - 0.5,
        f"before the front limit {short(window.front)}": max(depths) < window.front,
        f"beyond the rear limit {short(window.rear)}": min(depths) >= window.rear}
    for where, is_beyond in beyond.items():
        if is_beyond:
            return f"wholly {where}: no pixel shows it"
    area = abs(sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(places, places[1:] + places[:1]))) / 2
    if area == 0:
        return "no area: it is seen edge-on"
    turn = "counterclockwise: this is its front" if winding(
        calculation.corners) > 0 else "clockwise: this is its back"
    return f"area {measured(area, 2)} pixels, {turn}"
