"""Compares a student's five files with ours: each of our stages reads the output of the student's previous stage, so that
an error counts once."""
import dataclasses
import os
import pathlib
import tempfile

from compare_parts.differences import compare_pictures, compare_stage_texts, compare_z_buffers, same_in_other_colors
from compare_parts.mistakes import Suspects, hint_of_rounding, hints_but_for_the_eye, hints_from_numbers, hints_from_scene
from lib.command import shown
from lib.input_file import InputError, name_of, read_input
from lib.pictures import PictureError, picture_of, read_picture
from lib.pipe_tools import ToolFailure
from lib.stage_text import StageTextError, parse_stage_text, real, text_of

# For numbers of 7 decimals that were calculated from numbers of 7 decimals; depths have 6.
COORDINATE_TOLERANCE = 1e-6
DEPTH_TOLERANCE = 2e-6
HALF_A_UNIT = 5.1e-8  # of 7 decimals


@dataclasses.dataclass
class Judgment:
    stage: str
    file: str
    verdict: str             # right, wrong, missing, unreadable
    remark: str = ""
    differences: object = None
    hints: list = dataclasses.field(default_factory=list)

    @property
    def is_right(self):
        return self.verdict == "right"


def parse_z_buffer(text, path):
    """Rows of depths, one a line."""
    rows = []
    for number, line in enumerate(text.split("\n"), 1):
        try:
            rows.append([real(word) for word in line.split()])
        except ValueError:
            raise StageTextError(f"{name_of(path)}:{number}: expected depths, found '{shown(line.strip()[:40])}'") from None
    while rows and not rows[-1]:  # rows at the end may be empty
        rows.pop()
    return rows


def unreadable(tool, name, error):
    """The Judgment of a file that raised an InputError, StageTextError or PictureError."""
    if isinstance(error, InputError):
        return Judgment(tool, name, "missing" if error.is_missing else "unreadable", error.reason)
    return Judgment(tool, name, "unreadable", str(error))


def stage_text_of(points):
    """Bare stage text, lossless."""
    return "".join(" ".join(map(repr, p)) + "\n" * (1 + (i % 3 == 2)) for i, p in enumerate(points)).encode()


class FiveFiles:
    def __init__(self, tools, folder, scene, config, tolerance=None):
        self.tools, self.scene, self.config = tools, scene, config
        self.folder = folder
        self.contents = {}  # of the student's files, filled on demand
        self.suspects = Suspects(tools, scene)
        self.tolerance = COORDINATE_TOLERANCE if tolerance is None else tolerance
        self.depth_tolerance = max(DEPTH_TOLERANCE, self.tolerance)

    def judge(self):
        """A Judgment for each of the five files."""
        text1 = self.tools.output("model", "--digits", "exact", self.scene)
        text2 = self.tools.output("view", "--digits", "exact", stdin=text1)
        text3 = self.tools.output("project", "--digits", "exact", stdin=text2)
        given1 = self.given("stage1.txt", text1)
        given2 = self.given("stage2.txt", text2)
        given3 = self.given("stage3.txt", text3)
        yield self.stage("model", 1, [lambda: text1])
        yield self.stage("view", 2, [lambda: self.ours("view", given1), lambda: text2], given1)
        yield self.stage("project", 3, [lambda: self.ours("project", given2), lambda: self.without_clipping(given2), lambda: text3], given2)
        try:
            drawn = list(self.pixels(given3))
        except ToolFailure:  # zbuf refuses their text, though its numbers can be compared
            drawn = list(self.pixels(text3))
        yield from drawn

    def data(self, name):
        """The bytes of the student's file, read once. Never waits for a pipe."""
        if name not in self.contents:
            self.contents[name] = read_input(os.path.join(self.folder, name), only_regular=True)
        return self.contents[name]

    def stage_text(self, name):
        return parse_stage_text(text_of(self.data(name), name), name)

    def given(self, name, instead):
        """The student's text, or ours if theirs cannot be read."""
        try:
            return self.data(name) if self.stage_text(name).triangles else instead
        except (InputError, StageTextError):
            return instead

    def ours(self, tool, text, *words):
        return self.tools.output(tool, "--scene", self.scene, "--digits", "exact", *words, stdin=text)

    def without_clipping(self, text):
        """The projection of a text without any clipping, although vertices lie behind the eye (a course's program that does not
        clip, given a wrong view space). A vertex behind the eye is mirrored through the eye before projecting: x / w and y / w
        stay the same, and z / w = A + B / z follows from A + B / -z of the mirrored vertex.
        """
        camera = self.suspects.camera
        near, far = map(float, camera["perspective"][2:4] if "perspective" in camera else camera["frustum"][4:])
        points = parse_stage_text(text_of(text, ""), "").points
        turned = [tuple(-x for x in p) if p[2] > 0 else p for p in points]
        done = parse_stage_text(self.ours("project", stage_text_of(turned), "--clip", "none").decode(), "").points
        twice_a = 2 * (far + near) / (far - near)
        return stage_text_of((x, y, twice_a - z) if p[2] > 0 else (x, y, z) for p, (x, y, z) in zip(points, done))

    def candidates(self, makers):
        """The texts that would be right, the likeliest first. Keeping unrounded numbers in memory is right, too."""
        for maker in makers:
            try:
                yield parse_stage_text(maker().decode(), "ours")
            except (ToolFailure, KeyError):
                pass  # a tool refuses the student's text, or the camera is orthographic; the last maker depends on neither

    def stage(self, tool, number, makers, previous=b""):
        name = f"stage{number}.txt"
        try:
            theirs = self.stage_text(name)
        except (InputError, StageTextError) as error:
            return unreadable(tool, name, error)
        candidates = list(self.candidates(makers))
        compared = [compare_stage_texts(theirs, ours, self.tolerance, is_relative=True) for ours in candidates]
        for differences in compared:
            if not differences.found:
                is_same = any(hint_of_rounding(theirs.points, ours.points, HALF_A_UNIT) for ours in candidates)
                return Judgment(tool, name, "right", "" if is_same else "differs by rounding alone", differences)
        for ours, differences in zip(candidates, compared):
            if len(theirs.points) == len(ours.points):
                hints = hints_from_scene(self.suspects, number, theirs.points, ours.points, previous)
                hints = hints or hints_from_numbers(theirs.points, ours.points)
                return Judgment(tool, name, "wrong", "", differences, hints if tool == "view" else hints_but_for_the_eye(hints))
        return Judgment(tool, name, "wrong", "", compared[0])

    def pixels(self, stage3):
        with tempfile.TemporaryDirectory() as folder:
            ours, image = pathlib.Path(folder, "z_buffer.txt"), pathlib.Path(folder, "out.bmp")
            self.tools.run("zbuf", self.config, "--z-buffer", ours, "--image", image, stdin=stage3)
            yield self.z_buffer(ours)
            yield self.picture(image)

    def z_buffer(self, ours):
        name = "z_buffer.txt"
        try:
            theirs, ours = (parse_z_buffer(text_of(data, name), name) for data in (self.data(name), ours.read_bytes()))
        except (InputError, StageTextError) as error:
            return unreadable("zbuf", name, error)
        differences = compare_z_buffers(theirs, ours, self.depth_tolerance, is_relative=True)
        return Judgment("zbuf", name, "wrong" if differences.found else "right", "", differences)

    def picture(self, ours):
        name = "out.bmp"
        try:
            theirs, ours = picture_of(self.data(name), name), read_picture(ours)
        except (InputError, PictureError) as error:
            return unreadable("zbuf", name, error)
        differences, _ = compare_pictures(theirs, ours, 0)
        if not differences.found:
            return Judgment("zbuf", name, "right", "", differences)
        if not differences.unlike and same_in_other_colors(theirs, ours):
            return Judgment("zbuf", name, "right", "the same picture in other colors", differences)
        hints = []
        if not differences.unlike and theirs[2][::-1] == ours[2]:
            hints = ["the picture is upside down"]
        return Judgment("zbuf", name, "wrong", "", differences, hints)


def verdict_of(judgments):
    """One sentence: the first stage that went wrong, and the later ones with errors of their own."""
    wrong = [judgment for judgment in judgments if not judgment.is_right]
    if not wrong:
        return "all five files are right"
    first = wrong[0]
    words = f"the first stage that went wrong is {first.stage} ({first.file} is {first.verdict})"
    if first.hints:
        words += ": " + first.hints[0]
    others = [judgment.file for judgment in wrong[1:]]
    return words + (f"; by themselves wrong are also {', '.join(others)}" if others else "; what follows is right, given that")
