"""The losses of the settings on a scene of scripts/measure/extremes, and the tools' notes about them."""
import dataclasses
import math
import operator
import pathlib
import re
import sys
import tempfile
import unittest
from fractions import Fraction

from lib.running.owners import NOBODY
from lib.running.pipe import Pipe, Setting
from lib.running.pipe_tools import ToolFailure, Tools
from lib.text.stage_text import triangle_lines
from parts.extremes_scenes import SIZE, scene_text
from parts.extremes_truth import reference, true_owners, true_vertices

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "tests/reference"))
import leeway  # noqa: E402

ROUNDED = [
    Setting(digits) for digits in ("5", "7", "9", "12", "exact")]  # digits are promised to be right, or noted
SETTINGS = [*ROUNDED, Setting(precision="double"), Setting("exact", "double")]
MOST_DIGITS = 17
STAGES = ("model", "view", "project")
SPARSE = 32  # single digits are checked for every 32nd triangle


def centered(setting):
    """The setting with the rule `center`, by which each pixel belongs to one triangle."""
    return dataclasses.replace(setting, coverage="center")


def measured(job):
    """Rows for one case: (folder of the tools, case)."""
    bin_dir, case = job
    text = scene_text(case)
    truth = true_vertices(text)
    owners = true_owners(truth, SIZE)
    with tempfile.TemporaryDirectory() as folder:
        scene, config = pathlib.Path(folder, "scene.txt"), pathlib.Path(folder, "config.txt")
        scene.write_text(text)
        config.write_text(f"{SIZE} {SIZE}\n")
        pipe = Pipe(Tools(bin_dir, has_many_pipes=True), scene, config, [], folder)
        lossless = list(pipe.owners(centered(Setting("exact"))))
        return [{
            "axis": case.axis, "value": f"{case.value:g}",
            "setting": str(setting), "covered": sum(owner != NOBODY for owner in owners), **losses(
                pipe, centered(setting), truth, owners, lossless), "wrong_without_note": wrong_without_note(
                pipe.tools, text, setting.digits) if setting in ROUNDED else ""} for setting in SETTINGS]


def losses(pipe, setting, truth, owners, lossless):
    picture = list(pipe.owners(setting))
    uncertain = uncertain_pixels(pipe, setting)
    wrong = {place for place, (owner, right) in enumerate(zip(picture, owners)) if owner != right}
    path, _, notes = pipe.text(setting)
    done = pipe.tools.run("zbuf", *pipe.words("zbuf", setting), "--z-buffer", "none", "--image",
                          pipe.folder / "out.ppm", pipe.config, path)
    notes += done.stderr.decode().splitlines()
    return {
        "digits_right": f"{digits_right(path, truth):.2f}", "wrong_pixels": len(wrong),
        "pixels_unlike_lossless": sum(map(operator.ne, picture,
                                          lossless)), "note": shortened(notes[0]) if notes else "",
        "uncertain_pixels": "refused" if uncertain is None else len(uncertain),
        "wrong_though_certain": "" if uncertain is None else len(wrong - uncertain)}


def uncertain_pixels(pipe, setting):
    """The pixels that zbuf --certify calls uncertain; None if the tools refuse to write bounds."""
    certified = dataclasses.replace(setting, certify="-")
    try:
        path, _, _ = pipe.text(certified)
    except ToolFailure:
        return None
    report = pipe.tools.output("zbuf", *pipe.words("zbuf", certified), "--image", pipe.folder / "out.ppm",
                               pipe.config, path).split()[4:]
    return {int(row) * SIZE + int(column) for row, column in zip(report[::2], report[1::2])}


def shortened(note):
    """A note in short: the stage and the subject."""
    stage, words = re.fullmatch(r"(\w+): note: (?:\S+:\d+:\d+: )?(.*)", note).groups()
    kinds = {
        "which of two surfaces": "close surfaces", "where the edges are": "moved edges",
        "not certain": "uncertain digits", "picture": "empty picture"}
    return f"{stage}: " + next((name for words_of_it, name in kinds.items() if words_of_it in words), words)


def digits_right(path, truth):
    """The number of right digits of the vertices in NDC, relative to the scene's extent, along the axis with
    the fewest; none if triangles are missing."""
    extents = [
        max(p[i] for triangle in truth for p in triangle) - min(p[i] for triangle in truth for p in triangle)
        for i in range(3)]
    errors, missing = [Fraction(0)] * 3, set(range(len(truth)))
    with open(path, "rb") as file:
        for number, corners in triangle_lines(file):
            missing.discard(number)
            for corner, p in zip(corners, truth[number]):
                errors = [
                    max(error, abs(Fraction(word.decode()) - x))
                    for error, word, x in zip(errors, corner.split(), p)]
    if missing:
        return 0.0
    shares = [2 * error / extent for error, extent in zip(errors, extents)]
    return max(0.0, min(MOST_DIGITS, -math.log10(max(*shares, Fraction(1, 10**MOST_DIGITS)))))


def sparse(text):
    """The scene with every n-th triangle."""
    lines = text.split("\n")
    begin = lines.index("triangle")
    triangles = [lines[at:at + 4] for at in range(begin, len(lines) - 2, 4)]
    return "\n".join([
        *lines[:begin], *(line for triangle in triangles[::SPARSE] for line in triangle), "end"]) + "\n"


def wrong_without_note(tools, text, digits):
    """The number of stages that print a wrong digit, by the specification and the numbers that the stage
    read, without a note."""
    data, count = sparse(text).encode(), 0
    for stage in STAGES:
        done = tools.run(stage, "--digits", digits, stdin=data)

        def reference_text(decimals, stage=stage, data=data):
            return getattr(reference, stage)(data, reference.read_options(stage, ["--digits", decimals]))

        try:
            leeway.expect_same_text(unittest.TestCase(), done.stdout, reference_text(digits),
                                    lambda: reference_text("17"), data, bool(done.stderr))
        except AssertionError:
            count += 1
        data = done.stdout
    return count
