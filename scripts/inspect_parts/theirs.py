"""A student's files laid over ours: the judge's verdict, their points, and which vertices and pixels
differ."""
from inspect_parts.packing import packed
from lib.judging.hand_in import find_files
from lib.judging.judge import judge
from lib.judging.points import EXACT, is_off, printed_tolerance, read_points
from lib.judging.reference import reference
from lib.judging.report import remarks_of, sentence
from lib.judging.shown import read_colors
from lib.judging.verdict import FAILED
from lib.rim.command import CommandFailure, shown

KINDS = {"model": "stage1", "view": "stage2", "project": "stage3"}


class Theirs:
    """The hand-in in a folder, beside an Inspection."""
    def __init__(self, folder, inspection):
        self.folder, self.inspection = folder, inspection
        self.files = find_files(folder)
        self.ours = reference(inspection.scene_data, inspection.config_data)
        self.verdict = judge(self.files, inspection.scene_data, inspection.config_data)

    def read(self, kind, parse):
        """The result of `parse` for a file's bytes and name; None if the file cannot be read: the verdict has
        the reason."""
        try:
            return parse(self.files[kind].within(self.ours.limit(kind)), self.files[kind].name)
        except CommandFailure:
            return None

    def stage(self, tool):
        """Their points, and the indices of vertices that differ from ours in the digits they show, if
        there are as many. None if the file cannot be read, or if the page draws only every n-th triangle."""
        theirs, text = self.read(KINDS[tool], read_points), self.inspection.lines[tool]
        if theirs is None or self.inspection.step > 1:
            return None
        is_compared = len(theirs) == 3 * len(text.names)
        differing = []
        if is_compared:
            digits = EXACT if theirs.digits.are_too_few else theirs.digits
            for index, (p, q) in enumerate(zip(theirs.points, text.points())):
                tolerance = printed_tolerance(q, digits)
                if any(is_off(a, b, tolerance) for a, b in zip(p, q)):
                    differing.append(index)
        return {
            "points": packed("d", [x for p in theirs.points for x in p]), "lines": packed("i", theirs.lines),
            "isCompared": is_compared, "differing": packed("i", differing)}

    def picture(self):
        """The pixels of their picture, in base64."""
        size, ground = (self.ours.window.width, self.ours.window.height), self.ours.background
        colors = self.read("picture", lambda data, name: read_colors(data, name, size, ground))
        return colors and packed("B", b"".join(map(b"".join, colors)))

    def words_of(self, file):
        """A file's verdict; if the file is right after a wrong one, with the file it was judged by."""
        earlier = self.verdict.files[:self.verdict.files.index(file)]
        before = [other.file for other in earlier if other.verdict in FAILED]
        return file.verdict + (f", given their {before[-1]}" if file.is_good and before else "")

    def as_json(self):
        files = [{
            "stage": file.stage, "file": file.file, "verdict": self.words_of(file), "isGood": file.is_good,
            "differing": file.differing, "largest": file.largest, "remarks": "; ".join(
                remarks_of(file)), "matrices": file.matrices.lines() if file.matrices else []}
                 for file in self.verdict.files]
        stages = {tool: self.stage(tool) for tool in KINDS}
        return {
            "folder": shown(self.folder), "sentence": sentence(self.verdict), "files": files,
            "stages": stages, "picture": self.picture()}
