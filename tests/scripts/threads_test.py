#!/usr/bin/env python3
"""Commands that start many pipes let zbuf and trace draw on one thread each.

usage: threads_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import unittest

from toolbox import BIN, DRAWING, SOURCE, ToolTest

SCENE = """3 1 6
0 0 0
0 1 0
40 1.25 1 30 ratio
light 3 4 5 1 1 1
triangle
-1 -1 0
1 -1 0
0 1 0
end
"""


class ManyPipes(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("50 40\n")
        pathlib.Path("scene.txt").write_text(SCENE)
        self.log = pathlib.Path("calls").resolve()
        self.bin = pathlib.Path("bin").resolve()
        self.bin.mkdir()
        for tool in BIN.iterdir():
            if tool.name in DRAWING:
                wrapper = self.bin / tool.name
                wrapper.write_text(f'#!/bin/sh\necho "{tool.name} $*" >> {self.log}\nexec {tool} "$@"\n')
                wrapper.chmod(0o755)
            else:
                (self.bin / tool.name).symlink_to(tool)

    def drawn_by(self, name, *words):
        """The tools that a command has drawn with, each on one thread."""
        self.log.write_text("")
        done = subprocess.run([SOURCE / "scripts" / name, *map(str, words)], capture_output=True, text=True,
                              timeout=120, env={**os.environ, "BIN": str(self.bin)})
        self.assertEqual(done.returncode, 0, done.stderr)
        questions = ("--help", "png:/dev/null")  # what a tool can do, before it draws
        calls = [line for line in self.log.read_text().splitlines() if not any(q in line for q in questions)]
        for call in calls:
            self.assertEqual(call.count("--threads 1 "), 1, f"{name}: {call}")
        return {call.split()[0] for call in calls}

    def test_farm(self):
        if not shutil.which("parallel"):
            self.skipTest("GNU parallel is missing")
        self.assertEqual(self.drawn_by("farm", "scene.txt", "config.txt", "--parts", 2, "-o", "farm.ppm"),
                         {"zbuf"})

    def test_film(self):
        if not shutil.which("parallel"):
            self.skipTest("GNU parallel is missing")
        words = ["scene.txt", "config.txt", "--turn", 0.1, "-o"]
        self.assertEqual(self.drawn_by("film", *words, "drawn"), {"zbuf"})
        self.assertEqual(self.drawn_by("film", *words, "traced", "--trace"), {"trace"})

    def test_trade(self):
        self.assertEqual(self.drawn_by("trade", "scene.txt", "config.txt", "--rounds", 1, "--all"),
                         set(DRAWING))

    def test_grade(self):
        for folder in ("tests", "hand-ins/one"):
            pathlib.Path(folder, "a").mkdir(parents=True)
        shutil.copy("scene.txt", "tests/a")
        shutil.copy("config.txt", "tests/a")
        subprocess.run([SOURCE / "scripts/stages", "scene.txt", "config.txt", "hand-ins/one/a"], check=True,
                       env={**os.environ, "BIN": str(BIN)})
        self.assertEqual(self.drawn_by("grade", "hand-ins", "tests", "-o", "graded"), {"zbuf"})

    def test_check_stage(self):
        words = ["--scene", "scene.txt", "--config", "config.txt", "--", BIN / "project"]
        self.assertEqual(self.drawn_by("check-stage", "project", "--sandbox", "no", *words), {"zbuf"})


if __name__ == "__main__":
    unittest.main()
