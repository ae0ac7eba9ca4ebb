#!/usr/bin/env python3
"""A stage that the system kills inside a command: no output of a part, and a line that names the stage.

usage: killed_stages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import itertools
import os
import pathlib
import shutil
import sys
import unittest

from fly_parts.pipe import FramePipe
from lib.rim.command import CommandFailure
from lib.running.pipe_tools import Done, ToolKilled, Tools, expect_success
from toolbox import BIN, TOOLS, ToolTest, add_claims, run_script

TRACED = ("model", "view", "trace")
# command: its words, and the stages
COMMANDS = {
    "film": ("scene.txt config.txt --turn 1 --fps 1 -o x.gif", TOOLS),
    "film --trace": ("scene.txt config.txt --turn 1 --fps 1 -o x.gif", TRACED),
    "farm": ("scene.txt config.txt --parts 2 --z-buffer z.txt -o x.png", (*TOOLS, "cut-scene", "join-seen")),
    "picture": ("scene.txt config.txt -o x.png", TOOLS),
    "picture --trace": ("scene.txt config.txt -o x.png", TRACED),
    "picture --certain": ("scene.txt config.txt -o x.png", TOOLS),
    "picture --stages kept": ("scene.txt config.txt -o x.png", TOOLS),
    "stages": ("scene.txt config.txt kept", TOOLS),
    "inspect": ("scene.txt config.txt -o x.html", TOOLS),
    "inspect --trace": ("scene.txt config.txt -o x.html", ("trace",)),
    "explain": ("scene.txt config.txt --triangle 0 --pixel 3,3 --coverage center", TOOLS),
    "trade": ("scene.txt config.txt --rounds 1 --plot x.svg", TOOLS),
    "compare": ("--hand-in mine scene.txt config.txt", ("model", "project", "zbuf")),
    "check-stage": (f"view --scene scene.txt --sandbox no -- {BIN}/view", ("model", "project")),
    "grade": ("class tests -o grades", TOOLS),
}
# What is there before: all that one of them replaces.
OLDER = ("x.gif", "x.png", "z.txt", "x.html", "x.svg",
         *(f"kept/{name}" for name in ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")))
KEPT = ("bin", "x.gif.frames", "x.png.farm")  # folders of the test, and of what can be gone on with
# A tool that is killed: at once, or with half of its text out, or in.
TOOL = f'''#!{sys.executable} -I
import os, signal, subprocess, sys
words = ["{BIN}/TOOL", *sys.argv[1:]]
if any("/dev/null" in word and word != "/dev/null" for word in words) or "--help" in words:
    os.execv(words[0], words)  # whether it can be used at all
if IN_THE_MIDDLE and "TOOL" in ("zbuf", "trace"):
    text = sys.stdin.buffer.read()
    tool = subprocess.Popen(words, stdin=subprocess.PIPE, bufsize=0)
    tool.stdin.write(text[:len(text) // 2])
    tool.kill()
    tool.wait()
elif IN_THE_MIDDLE:
    text = subprocess.run(words, stdout=subprocess.PIPE).stdout
    os.write(1, text[:len(text) // 2 + 7])
os.kill(os.getpid(), signal.SIGKILL)
'''


class KilledStages(ToolTest):
    def check(self, command):
        words, stages = COMMANDS[command]
        for need in {"film": ["parallel", "ffmpeg"], "farm": ["parallel"]}.get(command.split()[0], []):
            if not shutil.which(need):
                self.skipTest(f"{need} is missing")
        corner = "triangle\n0 0 0\n1 0 {}\n0 1 0\n"
        pathlib.Path("scene.txt").write_text("1 0 5\n0 0 0\n0 1 0\n60 1 1 100\n" +
                                             "".join(map(corner.format, range(-9, 1))) + "end\n")
        for path in ("mine", "class/a"):
            self.assertEqual(run_script("stages", "scene.txt", "config.txt", path).returncode, 0)
        shutil.copytree(".", "tests/only", ignore=shutil.ignore_patterns("mine", "class", "tests"))
        for folder in ("tmp", "kept"):
            os.mkdir(folder)
        for path in OLDER:
            pathlib.Path(path).write_text("older")
        before = self.contents()
        for stage, is_in_the_middle in itertools.product(stages, (False, True)):
            with self.subTest(stage=stage, is_in_the_middle=is_in_the_middle):
                self.make_tools(stage, is_in_the_middle)
                self.kill(stage, *command.split(), *words.split())
                self.assertEqual(self.contents(), before)

    def test_what_failed_first_is_named_and_a_whole_frame_is_enough(self):
        for statuses, expected in (
                ((-13, -13, -13, 3), "zbuf: exit status 3"), ((-13, -9, 0, 1), "view: ended by SIGKILL"),
                ((0, -13, 0, 0), ""), ((-9, -9, -9, 0), ""), ((0, 1, 0, 0), "view: exit status 1")):
            tools = [Done(name, status, b"") for name, status in zip(TOOLS, statuses)]
            with self.assertRaisesRegex(CommandFailure, expected) if expected else contextlib.nullcontext():
                expect_success(*tools)

    def test_fly_shows_nothing_of_a_part(self):
        for stages, is_traced in ((TOOLS, False), (TRACED, True)):
            for stage, is_in_the_middle in itertools.product(stages, (False, True)):
                self.make_tools(stage, is_in_the_middle)
                with self.assertRaises(ToolKilled) as raised:
                    pipe = FramePipe(Tools("bin"), "scene.txt", is_traced)
                    camera = [word.split() for word in ("0 0 5", "0 0 0", "0 1 0")]
                    pipe.frame(camera, [], "8 8\n", [])
                self.assertEqual(str(raised.exception), f"{stage}: ended by SIGKILL")

    @staticmethod
    def make_tools(stage, is_in_the_middle):
        """The folder bin, with one that is killed, and none from the kill before."""
        for folder in KEPT:
            shutil.rmtree(folder, ignore_errors=True)
        os.mkdir("bin")
        for tool in BIN.iterdir():
            os.symlink(tool, f"bin/{tool.name}")
        os.unlink(f"bin/{stage}")
        pathlib.Path("bin", stage).write_text(
            TOOL.replace("TOOL", stage).replace("IN_THE_MIDDLE", str(is_in_the_middle)))
        os.chmod(f"bin/{stage}", 0o755)

    def kill(self, stage, name, *words):
        places = {"BIN": os.path.abspath("bin"), "TMPDIR": os.path.abspath("tmp")}
        done = run_script(name, *words, env={**os.environ, **places})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(f"{stage}: ended by SIGKILL", done.stderr)
        if name not in ("film", "farm", "grade"):  # which say more: how to go on, or who has no points
            self.assertEqual(done.stderr, f"{name}: {stage}: ended by SIGKILL\n")

    def contents(self):
        return {str(path): path.read_bytes() for path in pathlib.Path(".").rglob("*")
                if path.is_file() and path.parts[0] not in KEPT}


add_claims(KilledStages, [(f"{command} makes nothing of a part", command) for command in COMMANDS])

if __name__ == "__main__":
    unittest.main()
