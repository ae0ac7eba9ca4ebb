#!/usr/bin/env python3
"""samples/turntable: make draws the frames that are missing or stale, and no others.

usage: turntable_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import unittest

from toolbox import BIN, SOURCE, ToolTest, pipe

SAMPLE = SOURCE / "samples/worked-example"


class Turntable(ToolTest):
    def setUp(self):
        super().setUp()
        for name in ("scene.txt", "config.txt"):
            shutil.copy(SAMPLE / name, name)

    def make(self, *words):
        """Runs make on a scene whose camera is at (0 0 2) and looks at the origin; gives what it printed."""
        environment = {
            name: value
            for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
        return subprocess.run([
            "make", "-f", SOURCE / "samples/turntable/Makefile", f"BIN={BIN}", "SCENE=scene.txt",
            "CONFIG=config.txt", "OUT=out", "MIDDLE=0 0 0", "RADIUS=2", "HEIGHT=0", "FRAMES=4", *words],
                              capture_output=True, text=True, env=environment)

    def runs(self, tool, done):
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.count(f"{BIN}/{tool} ")

    def expected(self, *eye):
        """The picture that the pipe draws from there."""
        scene = pathlib.Path("scene.txt").read_bytes()
        pipe(["model"], ["view", "--eye", *eye, "--look", "0", "0", "0", "--up", "0", "1", "0"],
             ["project", "--aspect", "ratio"],
             ["zbuf", "--coverage", "center", "--samples", "3", "config.txt", "--image", "one.png"],
             stdin=scene)
        return pathlib.Path("one.png").read_bytes()

    def test_the_eye_goes_around(self):
        done = self.make("-j2")
        self.assertEqual((self.runs("model", done), self.runs("zbuf", done)), (1, 4))
        self.assertEqual(sorted(os.listdir("out")), ["000.png", "001.png", "002.png", "003.png", "world.txt"])
        for frame, eye in enumerate((("0", "0", "2"), ("2", "0", "0"), ("0", "0", "-2"), ("-2", "0", "0"))):
            self.assertEqual(pathlib.Path(f"out/{frame:03d}.png").read_bytes(), self.expected(*eye), frame)

    def test_only_what_is_missing_or_stale_is_drawn(self):
        self.make()
        os.unlink("out/002.png")
        done = self.make()
        self.assertEqual((self.runs("model", done), self.runs("zbuf", done)), (0, 1))
        self.assertEqual(self.runs("zbuf", self.make()), 0)
        later = pathlib.Path("out/003.png").stat().st_mtime + 10
        os.utime("config.txt", (later, later))
        done = self.make("-n")
        self.assertEqual((self.runs("model", done), self.runs("zbuf", done)), (0, 4))
        os.utime("scene.txt", (later + 10, later + 10))
        done = self.make("-n")
        self.assertEqual((self.runs("model", done), self.runs("zbuf", done)), (1, 4))

    def test_a_frame_that_fails_leaves_no_picture(self):
        pathlib.Path("scene.txt").write_text("0 0 5\n")
        done = self.make()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("model: ", done.stderr)
        self.assertEqual(os.listdir("out"), [])
        shutil.copy(SAMPLE / "scene.txt", "scene.txt")
        done = self.make("MIDDLE=0 0 2", "RADIUS=0")  # an eye at the point it looks at
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("view: ", done.stderr)
        self.assertEqual(os.listdir("out"), ["world.txt"])

    def test_the_film(self):
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is missing")
        self.assertEqual(self.make("film").returncode, 0)
        self.assertGreater(pathlib.Path("out/turntable.mp4").stat().st_size, 0)


if __name__ == "__main__":
    unittest.main()
