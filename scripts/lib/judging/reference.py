"""Our own tools' results for a scene and a config, once for all hand-ins that are judged by them."""
import contextlib
import functools
import itertools
import math
import pathlib
import re
import tempfile

from lib.judging.hand_in import KINDS
from lib.judging.matrices import image
from lib.judging.scene import Scene
from lib.maths.window import Window
from lib.rim.command import CommandFailure
from lib.running.pipe_tools import ToolCrash, ToolFailure, ToolOutOfMemory, Tools, opaque_background
from lib.showing.pictures import read_picture
from lib.text.stage_text import parse_stage_text, text_of

EXACT = ("--digits", "exact")
OWN_COLORS = ("light", "attributes")  # header lines of scenes whose triangles are not each of one color
MEBIBYTE = 1 << 20
BYTES_OF_A_VERTEX, BYTES_OF_A_PIXEL = 500, {"depths": 40, "picture": 8}
MOST_PIXELS = 1 << 24
MOST_BYTES = 256 * MEBIBYTE  # of a file of a hand-in, however large the scene is
OLD_FORMAT = ("the scene has the form of before 2020: size, background and the colors after triangles are "
              "passed over")


class JudgeError(CommandFailure):
    """There is nothing to judge by: the scene or the config is not accepted, or too large."""


class Reference:
    def __init__(self, scene, config, tools):
        self.tools, self.config, self.remarks = tools, config, []
        self.clipped = functools.lru_cache(maxsize=4)(self.clipped)
        text, self.scene_data, model = self.accepted(text_of(scene, "the scene"))
        stage1 = parse_stage_text(model.decode(), "model")
        self.header = stage1.header
        if not {"eye", "look", "up"} <= self.header.keys():
            raise ToolCrash("model: has written no camera, though it ended well")
        self.scene = Scene(text, stage1.header)
        self.world = stage1.points
        self.window = self.accepted_window(config) if config is not None else None
        background = self.header.get("background", "000")[:3]
        self.background = bytes(math.floor(float(word) + 0.5) for word in background)
        self.has_own_colors = any(keyword in self.header for keyword in OWN_COLORS)

    def accepted(self, text):
        """The scene's text, in today's form, its bytes, and the output of model for it."""
        data = text.encode("utf-8", errors="surrogateescape")
        try:
            model = self.tools.output("model", *EXACT, stdin=data)
            if b"\nsphere\n" in model:  # which assignments lack: a message with their place
                self.tools.run("model", "--bare", stdin=data)
            return text, data, model
        except ToolFailure as failure:
            older = without_old_lines(text)
            with contextlib.suppress(JudgeError):
                if older is not None:
                    found = self.accepted(older)
                    self.remarks.append(OLD_FORMAT)
                    return found
            raise JudgeError(f"the scene is refused: {failure}") from None

    def accepted_window(self, config):
        size = text_of(config, "the config").split()[:2]
        if all(re.fullmatch("[0-9]{1,9}", word) for word in size) and math.prod(map(int, size)) > MOST_PIXELS:
            raise JudgeError(f"expected a config of at most {MOST_PIXELS} pixels, found {' x '.join(size)}")
        try:
            with self.tools.file(config) as path:
                self.tools.run("zbuf", "--image", "/dev/null", "--z-buffer", "/dev/null", path)
        except ToolFailure as failure:
            raise JudgeError(f"the config is refused: {failure}") from None
        return Window(text_of(config, "the config"))

    def limit(self, kind):
        """The bytes that a file of a hand-in may have."""
        count = self.window.width * self.window.height if kind in BYTES_OF_A_PIXEL else len(self.world)
        return min(MEBIBYTE + BYTES_OF_A_PIXEL.get(kind, BYTES_OF_A_VERTEX) * count, MOST_BYTES)

    @functools.cached_property
    def stage3(self):
        """The scene after our project, as bytes."""
        return self.tools.through(["model"], ["view"], ["project"], stdin=self.scene_data)

    @functools.cached_property
    def stage3_of_exact(self):
        """The scene after our project, from exact numbers of the stages before."""
        return self.tools.through(["model", *EXACT], ["view", *EXACT], ["project"], stdin=self.scene_data)

    @functools.cached_property
    def exact(self):
        """{stage: its exact points}, where project does not clip."""
        view, project = self.scene.matrix("view"), self.scene.matrix("project")
        in_view = [image(view, p, False) for p in self.world]
        return {"model": self.world, "view": in_view, "project": [image(project, p, True) for p in in_view]}

    @functools.cached_property
    def draws_nothing(self):
        with self.tools.file(self.config) as config:
            return not self.tools.output("zbuf", config, "--image", "/dev/null", stdin=self.stage3).strip()

    def picture(self, stage3, coverage="nearest"):
        """Our zbuf's picture for a stage text, as rows of bytes; None if it refuses the text."""
        try:
            with self.tools.file(self.config) as config, tempfile.TemporaryDirectory() as folder:
                drawn = pathlib.Path(folder, "out.ppm")
                self.tools.run("zbuf", config, "--coverage", coverage, "--z-buffer", "/dev/null", "--image",
                               drawn, *opaque_background(stage3), stdin=stage3)
                return read_picture(drawn)[2]
        except ToolOutOfMemory:
            raise
        except ToolFailure:
            return None

    def clipped(self, points):
        """The points after our project, which clips a tuple of points; None if it refuses them."""
        lines = "".join(" ".join(map(repr, p)) + "\n" * (1 + (i % 3 == 2)) for i, p in enumerate(points))
        try:
            with self.tools.file(self.scene_data) as path:
                text = self.tools.output("project", "--scene", path, *EXACT, stdin=lines.encode()).decode()
                return parse_stage_text(text, "project").points
        except ToolOutOfMemory:
            raise
        except ToolFailure:
            return None


@functools.lru_cache(maxsize=16)
def reference(scene, config):
    """The Reference for the bytes of a scene and of a config, or None for a config."""
    return Reference(scene, config, Tools(has_many_pipes=True))


def kinds_of(config):
    """The kinds of files that a hand-in needs; without a config, of the first three stages."""
    return [kind for kind in KINDS if config is not None or kind.startswith("stage")]


def without_old_lines(text):
    """A scene in today's form; None if it is not in the old one, which has the size of the screen and a
    background beside the camera, and a color after each triangle."""
    lines = text.split("\n")
    filled = [(i, words) for i, line in enumerate(lines) if (words := line.split("#")[0].split())]
    head = [*itertools.takewhile(lambda line: not line[1][0][0].isalpha(), filled)]
    dropped = {i for i, words in head if len(words) == 2}  # the size; the background is the line after it
    if len(head) > 5:
        dropped |= {i for (_, size), (i, _) in zip(head, head[1:]) if len(size) == 2}
    for (_, word), *numbers in zip(*(filled[len(head) + k:] for k in range(5))):
        if word == ["triangle"] and not any(words[0][0].isalpha() for _, words in numbers):
            dropped.add(numbers[-1][0])
    return "\n".join(line for i, line in enumerate(lines) if i not in dropped) if dropped else None
