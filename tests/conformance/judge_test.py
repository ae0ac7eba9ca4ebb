#!/usr/bin/env python3
"""The judge on random scenes and a student's program: right without a switch and with every harmless habit; with a mistake wrong, by its
true cause, wherever its numbers differ. No cause is false, and no stage accused but the mistake's.

usage: judge_test.py STUDENT BIN_DIR SOURCE_DIR [SCENES [SHARE]]

Of each scene every SHARE-th switch is tried (by default every fourth), others at the next scene. The scenes are the same in every run.
"""
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

arguments = [sys.argv.pop(1) for _ in sys.argv[1:]]
student, bin_dir, source = (pathlib.Path(path).resolve() for path in arguments[:3])
scene_count, share = (int(word) for word in (*arguments[3:], *("20", "4")[len(arguments) - 3:]))
os.environ["BIN"] = str(bin_dir)
sys.path[:0] = [str(source / "scripts"), str(source / "tests/conformance")]
import course_scenes  # noqa: E402
from judge_parts.hand_in import find_files  # noqa: E402
from judge_parts.judge import judge  # noqa: E402
from lib.stage_text import parse_stage_text  # noqa: E402

LEAST_NAMED = 0.9  # of the mistakes whose numbers differ
FILES_OF = {"model": ("stage1.txt",), "view": ("stage2.txt",), "project": ("stage3.txt",), "zbuf": ("z_buffer.txt", "out.bmp")}


def listed(name):
    lines = (source / "tests/conformance" / name).read_text().splitlines()
    return [line.split(":")[0] for line in lines if line and not line.startswith("#")]


MISTAKES, HABITS = listed("mistakes.txt"), listed("habits.txt")


def tool(name, *words, stdin=b""):
    return subprocess.run([bin_dir / name, *words], input=stdin, stdout=subprocess.PIPE, check=True).stdout


class Scene:
    def __init__(self, seed):
        rng = random.Random(seed)
        self.scene = course_scenes.scene(rng).encode()
        stage3 = tool("project", "--clip", "none", stdin=tool("view", stdin=tool("model", stdin=self.scene)))
        depths = [p[2] for p in parse_stage_text(stage3.decode(), "stage3").points]
        self.config = course_scenes.config(rng, depths).encode()
        self.right = self.run()[0]

    def run(self, *switches):
        """The files of the student's program, and the Verdict."""
        words = [word for name in switches for word in ("--habit" if name in HABITS else "--mistake", name)]
        with tempfile.TemporaryDirectory() as top:
            scene, config, folder = (os.path.join(top, name) for name in ("scene.txt", "config.txt", "theirs"))
            pathlib.Path(scene).write_bytes(self.scene)
            pathlib.Path(config).write_bytes(self.config)
            os.mkdir(folder)
            subprocess.run([student, "all", scene, config, "--folder", folder, *words], check=True)
            files = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
            return files, judge(find_files(folder), self.scene, self.config)


def described(verdict):
    return [(file.file, file.verdict, file.rule, [cause.name for cause in file.causes], file.remarks) for file in verdict.files]


class Judged(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenes = []
        seed = 0
        while len(cls.scenes) < scene_count:
            try:
                cls.scenes.append(Scene(seed))
            except subprocess.CalledProcessError:  # a vertex behind the eye
                pass
            seed += 1

    def each(self, switches):
        """(number of the scene, Scene, switch), a share of the switches for each scene."""
        for number, scene in enumerate(self.scenes):
            for switch in switches[number % share::share]:
                yield number, scene, switch

    def test_right_without_a_switch(self):
        for number, scene in enumerate(self.scenes):
            with self.subTest(scene=number):
                verdict = scene.run()[1]
                self.assertEqual({file.verdict for file in verdict.files}, {"right"}, described(verdict))

    def test_right_with_every_habit(self):
        for number, scene, habit in self.each(HABITS):
            with self.subTest(habit, scene=number):
                verdict = scene.run(habit)[1]
                self.assertEqual(verdict.status, 0, described(verdict))

    def test_a_mistake_is_found_and_named(self):
        differing, named = 0, []
        for number, scene, mistake in self.each(MISTAKES):
            stage = mistake.partition("/")[0]
            files, verdict = scene.run(mistake)
            with self.subTest(mistake, scene=number):
                self.assertEqual([file.verdict for file in verdict.files if file.stage != stage and not file.is_good], [], described(verdict))
                if all(files[name] == scene.right[name] for name in FILES_OF[stage]):
                    self.assertEqual(verdict.status, 0, described(verdict))
                    continue
                differing += 1
                causes = {name for file in verdict.of(stage) for cause in file.causes for name in cause.name.split(" and ")}
                if causes:
                    self.assertIn(mistake, causes)
                    named.append(mistake)
        self.assertGreater(differing, len(self.scenes))
        self.assertGreaterEqual(len(named), LEAST_NAMED * differing)


if __name__ == "__main__":
    unittest.main()
