"""What explain reports on each triangle, for the texts that the page shows: here every stage has read what the one before printed."""
from explain_parts.report import triangle_report
from explain_parts.scene import find_triangles
from explain_parts.stages import Settings, words_of
from explain_parts.window import Window

MAX_EXPLAINED_TRIANGLES = 1000  # some milliseconds each


class StagesOfPage:
    """Takes the place of explain_parts.stages.Stages, for triangle `number` of an Inspection."""

    def __init__(self, inspection, number):
        self.settings, self.count = Settings(), inspection.count
        self.header = inspection.header
        self.world = self.world_lossless = words_in(inspection.lines["model"], number)[0]
        self.view = self.view_lossless = words_in(inspection.lines["view"], number)[0]
        self.ndc = words_in(inspection.lines["project"], number)

    def camera(self):
        return self.header


def words_in(text, number):
    """The words of each piece of a triangle in a text, a StageLines."""
    return [words_of(text.lines[line - 1:line + 2]) for name, line in zip(text.names, text.first_lines) if name == number]


def explanations(inspection, scene_text, config_text):
    """For each triangle its report and, for the report on a pixel, the names of the corners of its pieces; none for a large scene."""
    if inspection.count > MAX_EXPLAINED_TRIANGLES:
        return []
    window, found = Window(config_text), []
    for number, triangle in enumerate(find_triangles(scene_text)):
        lines, pieces = triangle_report(StagesOfPage(inspection, number), triangle, window, inspection.name, number)
        found.append({"text": "\n".join(lines), "corners": [names for names, _ in pieces]})
    return found
