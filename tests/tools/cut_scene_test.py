#!/usr/bin/env python3
"""cut-scene, model --first and join-seen, end to end: the parts' stage 1, joined, is that of the whole, to
the last byte.

usage: cut_scene_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import fcntl
import itertools
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import unittest

import random_scenes
from random_scene import CAMERA, scene_of_parts
from toolbox import SOURCE, TRIANGLE, ToolTest, command, heed_signals, pipe, run, run_with

SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12)) * 2  # fewer with sanitizers, see CMakeLists.txt


class Split(ToolTest):
    def split(self, scene, count, folder="parts"):
        """(file, first number) of each part."""
        pathlib.Path("scene.txt").write_bytes(scene.encode())
        shutil.rmtree(folder, ignore_errors=True)
        done = run("cut-scene", "scene.txt", count, "-o", folder)
        self.assert_quiet_success(done)
        parts = [(line.split()[0], int(line.split()[1])) for line in done.stdout.decode().splitlines()]
        self.assertEqual([path for path, _ in parts],
                         [f"{folder}/{name}" for name in sorted(os.listdir(folder))])
        return parts

    def check(self, scene, count, *options):
        parts = self.split(scene, count)
        texts = [f"stage1.{i}" for i in range(len(parts))]
        for text, (path, first) in zip(texts, parts):
            pathlib.Path(text).write_bytes(pipe(["model", "--first", first, *options, path]))
        done = run("join-seen", *texts)
        self.assert_quiet_success(done)
        self.assertEqual(done.stdout, pipe(["model", *options, "scene.txt"]))
        return parts


class Scenes(Split):
    def test_random_scenes(self):
        most = 0
        for seed in range(SCENE_COUNT):
            rng = random.Random(seed)
            scene = random_scenes.scene(rng, rng.randrange(1, 160))
            options = rng.choice(([], ["--framed"], ["--digits", "exact"], ["--digits", "3", "--framed"]))
            for count in (1, 2, 7, 300):
                with self.subTest(seed=seed, count=count, options=options):
                    most = max(most, len(self.check(scene, count, *options)))
        self.assertGreater(most, 50)  # then most parts are one triangle

    def test_scenes(self):
        scenes = {path.parent.name: path.read_text() for path in SOURCE.glob("samples/*/scene.txt")}
        scenes["lights inside push and pop"] = scene_of_parts(True)
        with_sphere = TRIANGLE + "push\nrotate 10 0 0 1\nsphere\n0.1 -0.2 0.3 1.25\npop\n"
        scenes["spheres"] = CAMERA + "color 1 2 3\n" + with_sphere * 9 + "end\n"
        for name, text in scenes.items():
            with self.subTest(name):
                self.check(text, 5, "--framed")

    def test_parts_are_of_about_the_same_size(self):
        parts = self.split(CAMERA + TRIANGLE * 1000 + "end\n", 4)
        for (_, first), expected in zip(parts, (0, 250, 500, 750)):
            self.assertLessEqual(abs(first - expected), 1)
        parts = self.split(CAMERA + TRIANGLE * 3 + "end\n", 10)
        self.assertEqual([first for _, first in parts], [0, 1, 2])
        self.assertEqual(len(self.split(CAMERA + "translate 1 2 3\nend\n", 3)), 1)

    def test_large_blocks(self):
        """More than is read at once, and transforms in force that grow."""
        rng = random.Random(3)
        body = "".join(f"translate\n{rng.uniform(-0.01, 0.01):.7f} 0 0\n" * (i % 50 == 0) + TRIANGLE
                       for i in range(30000))
        self.check(CAMERA + body + "end\n", 6)


class Joins(ToolTest):
    def test_one_frame_is_written(self):
        pathlib.Path("a").write_text("framed\n0 0 0\n1 0 0\n0 1 0\n\nend\n")
        done = run("join-seen", "--timing", "a", "a")
        self.assertEqual(done.stdout,
                         b"framed\n0 0 0\n1 0 0\n0 1 0\n\ntriangle 0\n0 0 0\n1 0 0\n0 1 0\n\nend\n")
        self.assertRegex(done.stderr, rb"\Ajoin-seen: 2 triangles in ")

    def test_what_is_wrong(self):
        whole = "framed\neye 1 2 3\n0 0 0\n1 0 0\n0 1 0\n\nend\n"
        texts = {
            "a": whole, "cut": whole[:-4], "other": whole.replace("3\n", "4\n", 1), "plain": whole[7:-4],
            "empty": "", "failed": "framed\neye 1 2 3\nerror model: no memory\n"}
        for name, text in texts.items():
            pathlib.Path(name).write_text(text)
        header = "expected the header of the first text, found another one before here"
        framed = "expected a framed text (model --framed), found"
        messages = {
            "a cut": "cut:7:1: expected 'end', which closes a framed text, found the end of the input",
            "a other": f"other:3:1: {header}", "a plain": f"plain:2:1: {header}",
            "--expect-framed plain": f"plain:2:1: {framed} one without 'framed'",
            "--expect-framed empty a": f"empty:1:1: {framed} an empty one",
            "a gone": "cannot open gone: No such file or directory",
            "a failed": "failed:3:1: an earlier stage failed: model: no memory"}
        for words, message in messages.items():
            done = run("join-seen", *words.split())
            self.assert_fails(done, 1, f"join-seen: {message}")
            error = "model: no memory" if "failed" in words else f"join-seen: {message}"
            self.assertTrue(done.stdout.endswith(f"error {error}\n".encode()))


class Refusals(ToolTest):
    # The commands of a scene, and what is wrong with it.
    SCENES = (
        (TRIANGLE + "pop\nend\n", "9:1: expected a matrix that 'push' has saved, found 'pop' without one"),
        (TRIANGLE, "9:1: expected 'end', which closes a scene, found the end of the input"),
        (TRIANGLE + "light\n1 2 3 1 1 1\n" + TRIANGLE + "end\n",
         "9:1: expected 'light' before the first object, found 'light' after it"),
        (TRIANGLE + "color\n1 2 3\n" + TRIANGLE + "end\n",
         "9:1: expected 'color' before the first object, found 'color' after it"),
        (TRIANGLE + "end\nend\n", "10:1: expected nothing after 'end', found 'end'"),
        ("turn 1 2 3\nend\n", "5:1: expected a command of a scene, found 'turn'"),
        ("push 1\nend\n", "5:6: expected the end of the line after 'push', found '1'"),
    )

    def test_scenes(self):
        for commands, message in self.SCENES:
            pathlib.Path("scene.txt").write_text(CAMERA + commands)
            shutil.rmtree("parts", ignore_errors=True)
            self.assert_fails(run("cut-scene", "scene.txt", "2"), 1, f"cut-scene: scene.txt:{message}")
            self.assertNotEqual(run("model", "scene.txt").returncode, 0)

    def test_command_lines(self):
        pathlib.Path("scene.txt").write_text(CAMERA + TRIANGLE + "end\n")
        for words in ("join-seen", "cut-scene", "cut-scene scene.txt", "cut-scene scene.txt 0",
                      "cut-scene scene.txt x", "cut-scene scene.txt 100000", "cut-scene /dev/null 2",
                      "model --first -1 scene.txt", "model --first x scene.txt",
                      "model --first 3 --bare scene.txt"):
            self.assertEqual(run(*words.split()).returncode, 2, words)
        os.mkdir("full")
        pathlib.Path("full/x").write_text("")
        self.assert_fails(
            run("cut-scene", "scene.txt", "2", "-o", "full"), 1,
            "cut-scene: full: expected a new folder, or an empty one, found one with files in it")
        self.assertIn(b"\ntriangle 8796093022207\n", run("model", "--first", 2**43 - 1, "scene.txt").stdout)


class Endings(ToolTest):
    """A cut-scene that fails leaves what it found, and the same command succeeds once the reason is gone."""

    GOOD = CAMERA + TRIANGLE * 40 + "end\n"
    FOLDERS = ("parts", "new/and/below/", "empty", "mine/new")

    def setUp(self):
        super().setUp()
        pathlib.Path("scene.txt").write_text(self.GOOD)
        for folder in ("empty", "mine"):
            os.mkdir(folder)
        pathlib.Path("mine/note").write_text("")
        (unread, self.closed_pipe), (waiting, self.full_pipe) = os.pipe(), os.pipe()
        os.close(unread)
        for end in (self.closed_pipe, waiting, self.full_pipe):
            self.addCleanup(os.close, end)
        with contextlib.suppress(PermissionError):
            fcntl.fcntl(self.full_pipe, 1031, 1 << 20)  # F_SETPIPE_SZ, the size that cut-scene asks for
        os.set_blocking(self.full_pipe, False)
        os.write(self.full_pipe, bytes(1 << 20))  # as many as it takes
        os.set_blocking(self.full_pipe, True)

    def end_by(self, number, folder):
        """Ends it while it waits for room in a pipe, once all parts are written."""
        with subprocess.Popen(command("cut-scene", "scene.txt", "4", "-o", folder), stdout=self.full_pipe,
                              stderr=subprocess.PIPE, preexec_fn=heed_signals) as waiting:
            while not os.path.exists(f"{folder}/4.txt"):
                self.assertIsNone(waiting.poll())
            waiting.send_signal(number)
            waiting.wait(60)
            return subprocess.CompletedProcess((), waiting.returncode, b"", waiting.stderr.read())

    def test_all_is_as_before(self):
        small = (len(CAMERA + TRIANGLE) * 2,) * 2  # less than a part has
        words = ("cut-scene", "scene.txt", "4", "-o")
        ended = "ended by a signal; unfinished files are removed"
        failures = [
            (1, "cannot write <stdout>: No space left on device", lambda *out: run_with(">/dev/full", *out)),
            (1, "cannot write <stdout>: Bad file descriptor", lambda *out: run_with(">&-", *out)),
            (1, "cannot write .*: File too large",
             lambda *out: run(*out, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, small))),
            (1, None, lambda *out: run(*out, stdout=self.closed_pipe)),
            (1, "cut.txt:165:1: expected 'end', .*", lambda *out: run(out[0], "cut.txt", *out[2:])),
            *((-number, ended, lambda *out, number=number: self.end_by(number, out[-1]))
              for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))]
        pathlib.Path("cut.txt").write_text(self.GOOD.replace("end\n", ""))
        before = sorted(pathlib.Path(".").rglob("*"))
        for (status, message, fail), folder in itertools.product(failures, self.FOLDERS):
            with self.subTest(message=message, folder=folder):
                done = fail(*words, folder)
                self.assertEqual(done.returncode, status)
                expected = rf"cut-scene: {message}\n" if message else ""
                self.assertRegex(done.stderr.decode(), rf"\A{expected}\Z")
                self.assertEqual(sorted(pathlib.Path(".").rglob("*")), before)
        for folder in self.FOLDERS:
            self.assertEqual(run(*words, folder).returncode, 0)
            self.assertEqual(sorted(os.listdir(folder)), ["1.txt", "2.txt", "3.txt", "4.txt"])


if __name__ == "__main__":
    unittest.main()
