"""The part of the page that --trace adds: trace's picture, and the trees of rays of its pixels."""
import base64
import math
import pathlib
import re
import tempfile

from lib.maths.vectors import axes
from lib.rim.input_file import MAX_BYTES
from lib.running.pipe_tools import opaque_background
from lib.showing.pictures import read_picture

MOST_TREES = 4000  # a few megabytes of text


def step_of(columns, rows, most):
    """The least step between probed pixels, across and down, at which they are at most `most`."""
    step = 1
    while math.ceil(columns / step) * math.ceil(rows / step) > most:
        step += 1
    return step


class RayTrees:
    """`words` are trace's options."""
    def __init__(self, inspection, words):
        self.header = inspection.header
        stage2 = inspection.lossless["view"]
        self.step = step_of(inspection.columns, inspection.rows, MOST_TREES)
        first = self.step // 2
        places = [
            f"{column},{row}" for row in range(min(first, inspection.rows - 1), inspection.rows, self.step)
            for column in range(min(first, inspection.columns - 1), inspection.columns, self.step)]
        probes = [word for place in places for word in ("--probe", place)]
        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder, "out.ppm")
            done = inspection.tools.run("trace", inspection.config, *words, *opaque_background(stage2),
                                        *probes, "--z-buffer", "none", "--image", image, stdin=stage2,
                                        most=MAX_BYTES)
            _, _, pixels = read_picture(image)
        self.pixels = base64.b64encode(b"".join(pixels)).decode()
        self.notes, self.lines = [], []
        for line in done.stderr.decode(errors="replace").splitlines():
            (self.lines if re.match(r"(trace: )?\d+,\d+: ", line) else
             self.notes).append(line.removeprefix("trace: ") if ": note: " not in line else line)
        self.lights = [
            list(map(float, words[1:4])) for words in map(str.split,
                                                          stage2.split(b"\n\n", 1)[0].decode().splitlines())
            if words[:1] == ["light"]]

    def as_json(self):
        eye, look, up = (tuple(map(float, self.header[name])) for name in ("eye", "look", "up"))
        return {
            "step": self.step, "lines": "\n".join(self.lines), "lights": self.lights, "camera": [
                eye, *axes(eye, look, up)]}
