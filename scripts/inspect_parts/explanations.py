"""The reports of explain on each triangle."""
from inspect_parts.stage_lines import StageLines
from lib.explaining.report import triangle_report
from lib.explaining.stages import Settings, words_of, words_of_triangle
from lib.maths.window import Window
from lib.text.scene import find_triangles

MAX_EXPLAINED_TRIANGLES = 1000  # some milliseconds each


class StagesOfPage:
    """Takes the place of lib.explaining.stages.Stages, for triangle `number` of an Inspection; `lossless` has
    the StageLines of model and view with all digits."""
    def __init__(self, inspection, lossless, number):
        self.settings, self.count = Settings(), inspection.count
        self.header = inspection.header
        self.world, self.world_lossless, self.view, self.view_lossless = (words_of_triangle(
            sum(lines_in(texts[tool], number), []), tool,
            number) for tool in ("model", "view") for texts in (inspection.lines, lossless))
        self.ndc = [*map(words_of, lines_in(inspection.lines["project"], number))]

    def camera(self):
        return self.header


def lines_in(text, number):
    """The vertex lines of each piece of a triangle in a text, a StageLines."""
    return [
        text.lines[line - 1:line + 2] for name, line in zip(text.names, text.first_lines) if name == number]


def explanations(inspection, scene_text, config_text):
    """The report on each triangle, with the names of its pieces' corners, which reports on pixels need; empty
    for a large scene, or one with spheres."""
    if inspection.count > MAX_EXPLAINED_TRIANGLES or inspection.lines["model"].spheres:
        return []
    window, found = Window(config_text), []
    lossless = {tool: StageLines.of(inspection.lossless[tool].decode()) for tool in ("model", "view")}
    for number, triangle in enumerate(find_triangles(scene_text)):
        lines, pieces = triangle_report(StagesOfPage(inspection, lossless, number), triangle, window,
                                        inspection.name, number)
        found.append({"text": "\n".join(lines), "corners": [names for names, _ in pieces]})
    return found
