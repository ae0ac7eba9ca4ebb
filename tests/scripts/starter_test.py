#!/usr/bin/env python3
"""The starter folders of docs/starter: check-stage tells the first thing to do, and text goes in and out.

usage: starter_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import unittest

from toolbox import BIN, SOURCE, ToolTest
from toolbox import run as run_tool

# For a camera that looks down -z, view only subtracts the eye: a line that stands where each says what to do.
SCENE = ("# eye, look, up\n1 2 5\n1 2 0\n0 1 0\n60 1 1 100 ratio\ntranslate 0 0 0\ntriangle  # one\n0 0 0\n"
         "1 0 0.5\n0 1 0\nscale\n1 1 1\ntriangle\n1 1 1\n2 1 1\n1 3 -1\nend\n")
PYTHON = "    return [x - e for x, e in zip(p, eye)]\n"
CPP = "  return {p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]};\n"
JAVA = "        p = new double[] {p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]};\n"


class Starters(ToolTest):
    def expect(self, language, name, build, run, line, method):
        shutil.copytree(SOURCE / "docs/starter" / language, ".", dirs_exist_ok=True)
        pathlib.Path("scene").write_text(SCENE)
        text = pathlib.Path(name).read_text()
        self.assertLessEqual(text.count("\n"), 120)
        subprocess.run(build, check=True)
        for stage, to_do in (("model", "transformed"), ("view", method), ("project", "to_ndc")):
            done = self.check(stage, [], run)
            self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout)
            first = done.stdout.partition("to do: ")[2].lower().replace("_", "")
            self.assertTrue(first.startswith(f"{to_do.lower().replace('_', '')}() in {name.lower()}"), first)
        world = subprocess.run([*run, "model"], input=SCENE, text=True, capture_output=True).stdout
        self.assertEqual(
            [line.split() for line in world.splitlines()],
            [line.split() for line in run_tool("model", stdin=SCENE).stdout.decode().splitlines()])
        at = text.rindex("\n", 0, text.index(f"{method}() in")) + 1
        pathlib.Path(name).write_text(text[:at] + line + text[text.index("\n", at) + 1:])
        subprocess.run(build, check=True)
        done = self.check("view", ["--scene", "scene"], run)
        self.assertEqual((done.returncode, done.stdout.partition("\n")[0]), (0, "scene: right"), done.stdout)
        done = self.check("model", ["--scene", "scene"], run)
        self.assertEqual((done.returncode, done.stdout.partition("\n")[0]), (0, "scene: right"), done.stdout)

    def check(self, stage, options, run):
        words = [
            SOURCE / "scripts/check-stage", stage, "--sandbox", "no", "--time-limit", "100", *options, "--",
            *run, stage]
        return subprocess.run(words, text=True, capture_output=True, timeout=250,
                              env={**os.environ, "BIN": str(BIN)})

    def test_python(self):
        self.expect("python", "stage.py", ["true"], ["python3", "stage.py"], PYTHON, "to_view")

    @unittest.skipUnless(shutil.which("g++"), "no g++")
    def test_cpp(self):
        build = ["g++", "-std=c++11", "-Wall", "-o", "stage", "stage.cpp"]
        self.expect("cpp", "stage.cpp", build, ["./stage"], CPP, "to_view")

    @unittest.skipUnless(shutil.which("javac"), "no JDK")
    def test_java(self):
        self.expect("java", "Stage.java", ["true"], ["java", "Stage.java"], JAVA, "toView")


if __name__ == "__main__":
    unittest.main()
