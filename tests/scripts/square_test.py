#!/usr/bin/env python3
"""stages, inspect and fly note a square that is drawn more than 1 % off square, and what they propose mends
it.

usage: square_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import base64
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import unittest
import zlib

from display import MISSING, Display
from lib.text.square import note_on_squares
from toolbox import BIN, SOURCE, ToolTest, end_by_signal, heed_signals, pipe, run_script

# Half of a square that faces the camera: its side is 2.
SCENE = "0 0 5\n0 0 0\n0 1 0\n{}\ntriangle\n-1 -1 0\n1 -1 0\n1 1 0\nend\n"
RATIO = "end the scene's fourth line in ratio"


def aspect(number):
    return f"let the aspect be {number} in the scene's fourth line"


def aspect_and_ratio(number):
    return aspect(number) + ", and end that line in ratio"


def box(number):
    return f"let (right - left) / (top - bottom) be {number} in the scene's fourth line"


# The fourth line, the config, the end of the note, and the fourth line mended.
NOTED = [
    ("60 1.3333333 1 50", "400 300", RATIO, "60 1.3333333 1 50 ratio"),
    ("60 1.3333333 1 50 angle", "400 300", RATIO, "60 1.3333333 1 50 ratio"),
    ("60 1.7777 1 50", "1600 900", RATIO, "60 1.7777 1 50 ratio"),
    ("60 2 1 50", "400 400\n-0.5\n-1\n-1 1", RATIO, "60 2 1 50 ratio"),
    ("60 1 1 50", "400 300", aspect_and_ratio("1.33333"), "60 1.33333 1 50 ratio"),
    ("60 1 1 50", "400 300\n-1\n-1\n-1 1\n", aspect_and_ratio("1.33333"), "60 1.33333 1 50 ratio"),
    ("60 1.3333333 1 50", "500 500", aspect("1"), "60 1 1 50"),
    ("60 1 1 50 ratio", "400 300", aspect("1.33333"), "60 1.33333 1 50 ratio"),
    ("60 1.02 1 50 ratio", "500 500", aspect("1"), "60 1 1 50 ratio"),
    ("ortho -1 1 -1 1 1 9", "400 300", box("1.33333"), "ortho -1.33333 1.33333 -1 1 1 9"),
    ("ortho 1 -1 -1 1 1 9", "400 300", box("1.33333"), "ortho 1.33333 -1.33333 -1 1 1 9"),
    ("frustum -1 1 -1 1 1 9", "200 400 # tall\r", box("0.5"), "frustum -0.5 0.5 -1 1 1 9"),]
FINE = [
    ("60 1 1 50", "500 500"),
    ("60 1 1 50", "400 300\n-1\n-0.75\n-1 1"),
    ("60 1 1 50", "1000 995"),
    ("60 1.3333333 1 50 ratio", "# a comment\n400 300"),
    ("ortho -4 4 -3 3 1 9", "400 300"),
    ("ortho -4 4 3 -3 1 9", "400 300"),]


class SquareTest(ToolTest):
    def call(self, script, projection, config, *words):
        pathlib.Path("scene.txt").write_text(SCENE.format(projection))
        pathlib.Path("config.txt").write_text(config)
        return run_script(script, "scene.txt", "config.txt", *words)

    def drawn(self, config):
        """The width of the square over its height, in pixels."""
        numbers = [float(word) for word in re.sub("#.*", "", config).split()]
        columns, rows, left, bottom = (numbers + [-1, -1])[:4]
        points = [
            tuple(map(float, line.split())) for line in pathlib.Path("stage3.txt").read_text().split("\n")
            if line]
        width, height = (max(p[axis] for p in points) - min(p[axis] for p in points) for axis in (0, 1))
        return (width * columns / -left) / (height * rows / -bottom)


class Stages(SquareTest):
    def note(self, projection, config):
        """The note, after the square is projected."""
        view = pipe(["model"], ["view"], stdin=SCENE.format(projection))
        pathlib.Path("stage3.txt").write_bytes(pipe(["project"], stdin=view))
        return note_on_squares(view.decode().partition("\n")[0].split(), config)

    def test_the_note_tells_what_is_drawn_and_its_mend_helps(self):
        for projection, config, mend, mended in NOTED:
            with self.subTest(projection=projection, config=config):
                note = self.note(projection, config)
                self.assertEqual(note,
                                 f"a square is drawn {self.drawn(config):.3g} times as wide as high: {mend}")
                self.assertGreater(abs(self.drawn(config) - 1), 0.01)
                self.assertEqual(self.note(mended, config), "")
                self.assertAlmostEqual(self.drawn(config), 1, delta=0.001)

    def test_there_is_none_for_a_square(self):
        for projection, config in FINE:
            with self.subTest(projection=projection, config=config):
                self.assertEqual(self.note(projection, config), "")
                self.assertAlmostEqual(self.drawn(config), 1, delta=0.01)

    def test_a_config_that_is_a_pipe_is_noted_or_refused(self):
        pathlib.Path("scene.txt").write_text(SCENE.format("60 1 1 50"))
        for config, status, message in (
            ("400", 1, "zbuf: /dev/fd/63:1:4: expected the height in pixels, a whole number from 1 to 65535, "
             "found the end of the line"),
            ("400 300", 0,
             f"note: a square is drawn 1.33 times as wide as high: {aspect_and_ratio('1.33333')}")):
            line = f'"{SOURCE}/scripts/stages" scene.txt <(echo {config}) five'
            done = subprocess.run(["bash", "-c", line], capture_output=True, text=True, env={
                "BIN": str(BIN), "PATH": "/usr/bin:/bin"})
            self.assertEqual((done.returncode, done.stderr, os.path.exists("five")),
                             (status, f"stages: {message}\n", status == 0))


class Inspect(SquareTest):
    def test_notes_it_on_stderr_and_on_the_page(self):
        projection, config, mend, _ = NOTED[0]
        done = self.call("inspect", projection, config)
        self.assertEqual((done.returncode, done.stderr),
                         (0, f"inspect: note: a square is drawn 0.917 times as wide as high: {mend}\n"))
        # The page's data, as inspect packs them.
        packed = max(re.findall(r"[A-Za-z0-9+/=]{200,}", pathlib.Path("report.html").read_text()), key=len)
        notes = json.loads(zlib.decompress(base64.b64decode(packed)))["notes"]
        self.assertEqual(notes, [f"note: a square is drawn 0.917 times as wide as high: {mend}"])

    def test_notes_nothing_else(self):
        self.assertEqual(self.call("inspect", *FINE[1]).stderr, "")


@unittest.skipIf(MISSING, f"needs {' and '.join(MISSING)}")
class Fly(SquareTest):
    @classmethod
    def setUpClass(cls):
        cls.enterClassContext(Display())

    def first_words(self, *words):
        """The text on fly's stderr when its window waits."""
        program = (
            "import sys; sys.path.insert(0, sys.argv[1]); sys.dont_write_bytecode = True; del sys.argv[1]\n"
            "from importlib.machinery import SourceFileLoader as Loader; from fly_parts.window import "
            "FlyWindow\n"
            "run = FlyWindow.run; FlyWindow.run = lambda window: (print('.', flush=True), run(window))\n"
            "Loader('__main__', sys.path[0] + '/fly').load_module()")
        process = subprocess.Popen([sys.executable, "-c", program, SOURCE / "scripts", *words],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   env={**os.environ, "BIN": str(BIN)}, preexec_fn=heed_signals)
        self.assertEqual(process.stdout.readline(), b".\n")
        return end_by_signal(process, signal.SIGTERM)[1].decode().removesuffix("fly: ended by SIGTERM\n")

    def test_notes_it_where_it_has_a_config_or_finds_one(self):
        pathlib.Path("scene.txt").write_text(SCENE.format("60 1.3333333 1 50"))
        pathlib.Path("config.txt").write_text("40 30\n")
        self.assertEqual(self.first_words("scene.txt", "config.txt"),
                         f"fly: note: a square is drawn 0.917 times as wide as high: {RATIO}\n")
        self.assertEqual(self.first_words("scene.txt"),
                         f"fly: note: a square is drawn 0.917 times as wide as high: {RATIO}\n")
        pathlib.Path("config.txt").unlink()
        self.assertEqual(self.first_words("scene.txt"), "")


if __name__ == "__main__":
    unittest.main()
