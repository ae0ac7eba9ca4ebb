"""The part of the page that --trace adds: trace's picture, and the trees of rays of its pixels."""
import itertools
import math
import pathlib
import re
import tempfile

from inspect_parts.packing import packed
from lib.maths.vectors import axes
from lib.rim.input_file import MAX_BYTES
from lib.running.pipe_tools import opaque_background
from lib.showing.pictures import read_picture

MOST_TREES = 4000  # a few megabytes of text


def middles(count, step):
    """Every `step`-th of `count` columns or rows, from the middle of the first `step` on."""
    return range(min(step // 2, count - 1), count, step)


def ray_trees(inspection, words):
    """The trees, trace's picture in base64, and its notes; `words` are trace's options."""
    stage2, columns, rows = inspection.lossless["view"], inspection.columns, inspection.rows
    step = next(step for step in itertools.count(1)
                if math.ceil(columns / step) * math.ceil(rows / step) <= MOST_TREES)
    probes = [
        word for row in middles(rows, step) for column in middles(columns, step)
        for word in ("--probe", f"{column},{row}")]
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder, "out.ppm")
        output = ["--z-buffer", "none", "--image", image]
        done = inspection.tools.run("trace", inspection.config, *words, *opaque_background(stage2), *probes,
                                    *output, stdin=stage2, most=MAX_BYTES)
        _, _, pixels = read_picture(image)
    lines, notes = [], []
    for line in done.stderr.decode(errors="replace").splitlines():
        is_of_ray = re.match(r"(trace: )?\d+,\d+: ", line)
        (lines if is_of_ray else notes).append(line if ": note: " in line else line.removeprefix("trace: "))
    header = map(str.split, stage2.split(b"\n\n", 1)[0].decode().splitlines())
    lights = [list(map(float, words[1:4])) for words in header if words[:1] == ["light"]]
    eye, look, up = (tuple(map(float, inspection.header[name])) for name in ("eye", "look", "up"))
    camera = [eye, *axes(eye, look, up)]
    rays = {"step": step, "lines": "\n".join(lines), "lights": lights, "camera": camera}
    return rays, packed("B", b"".join(pixels)), notes
