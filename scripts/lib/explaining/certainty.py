"""Why a pixel is uncertain: how far rounding may have moved a triangle there, and what is as near as that."""
from lib.explaining.calculation import Calculation
from lib.explaining.layout import INDENT
from lib.maths.exact import double, measured
from lib.maths.window import PixelOfTriangle


def certainty_lines(stages, triangle, shown, number, fragments):
    """Lines about triangle `number`, if zbuf --certify calls the pixel of `shown`, its PixelOfTriangle,
    uncertain."""
    bounds = stages.bounds_if_uncertain(*shown.pixel)
    if not bounds:
        return []
    if not shown.has_area:
        return [f"{INDENT}uncertain: rounding may have taken the triangle's area"]
    edges_by, depth_by = reach(bounds, stages, Calculation(stages, triangle), shown)
    z = shown.depth("center")
    near = [f"edge {edge.name} is" for edge in shown.edges if abs(edge.distance) <= edges_by]
    if shown.distance > 0:
        near += [
            f"triangle {other.triangle} is" for other in fragments
            if other.triangle != number and abs(double(other.depth) - z) <= 2 * depth_by]
        near += [
            f"the {name} limit is" for name in ("front", "rear")
            if abs(getattr(shown.window, name) - z) <= depth_by]
    return [
        f"{INDENT}uncertain: rounding may have moved edges here by {measured(edges_by)} pixels, depths by "
        f"{measured(depth_by)}; {f'{near[0]} as near' if near else 'other triangles are why'}"]


def reach(bounds, stages, calculation, shown):
    """The distances that the bounds let the triangle's edges at the pixel (in pixels) and its depth there
    move, to first order."""
    absolute, relative, *rounded = bounds
    error = max(absolute + relative * max(map(abs, map(double, vertex))) for vertex in stages.view_lossless)
    projection, grid = calculation.projection, shown.window.grid
    place = grid.x_of(shown.pixel[0]), grid.y_of(shown.pixel[1])
    own = rounded[0] + rounded[1] * max(1, *map(abs, place))
    near, far, z = projection.near, projection.far, shown.depth("center")
    if projection.is_parallel:
        turn, w, by_distance = 0, 1, 2 / (far - near)
    else:
        turn, w = 1, 2 * far * near / (far + near - z * (far - near))
        by_distance = 2 * far * near / (far - near) / w**2
    scales = (abs(calculation.projection_matrix[axis][axis]) for axis in range(2))
    by_pixels = [((scale + turn * abs(at)) * error / abs(w) + own) / step
                 for scale, at, step in zip(scales, place, (grid.dx, grid.dy))]
    column, row = shown.pixel
    slopes = [
        abs(PixelOfTriangle(shown.window, shown.names, shown.points, pixel).depth("center") - z)
        for pixel in ((column + 1, row), (column, row + 1))]
    moved = sum(by * slope for by, slope in zip(by_pixels, slopes))
    return sum(by_pixels), by_distance * error + own + moved
