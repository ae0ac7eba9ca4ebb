"""The whole report: what happens to one triangle, stage by stage, and at a pixel."""
from lib.explaining.calculation import Calculation
from lib.explaining.certainty import certainty_lines
from lib.explaining.pixel_section import pixel_section, winner_lines
from lib.explaining.stage_sections import model_section, project_section, view_section, window_section
from lib.maths.exact import decimal_or_double

MAX_LINES = 60


def report(stages, triangle, window, name, options):
    number = options.triangle
    lines, pieces = triangle_report(stages, triangle, window, name, number)
    if not options.pixel:
        return lines + suggestion(window, pieces)
    coverage, fragments, shown = pixel_section(stages, window, pieces, number, options.pixel)
    lines += ["", *coverage]
    certainty = certainty_lines(stages, triangle, shown, number, fragments) if shown else []
    return lines + winner_lines(fragments, number, MAX_LINES - len(lines) - len(certainty)) + certainty


def triangle_report(stages, triangle, window, name, number):
    """The lines about triangle `number`, and its pieces in NDC: pairs of names and points."""
    calculation = Calculation(stages, triangle)
    columns = [
        f"color and light take {triangle.columns} more numbers per vertex, which the geometry does not need"
    ] * (triangle.columns > 0)
    lines = [
        f"triangle {number} of {stages.count}, numbered from 0: {name}, line {triangle.line}", *columns, "",
        *model_section(stages, triangle, calculation), "", *view_section(stages, calculation), "",
        *project_section(calculation)]
    pieces = [([vertex.name for vertex in piece], [tuple(map(decimal_or_double, vertex)) for vertex in words])
              for piece, words in zip(calculation.clipped.pieces, stages.ndc)]
    if pieces:
        lines += ["", *window_section(stages, calculation, window)]
    if len(stages.ndc) != len(calculation.clipped.pieces):
        lines.append(f"  project itself has written {len(stages.ndc)} triangles")
    return lines, pieces


def suggestion(window, pieces):
    """The pixel in the middle of a triangle, if there is one."""
    if pieces:
        column, row = (round(sum(numbers) / 3) for numbers in zip(*map(window.place, pieces[0][1])))
        if 0 <= column < window.width and 0 <= row < window.height:
            return ["", f"with --pixel {column},{row}, in its middle, the report goes on at that pixel"]
    return []
