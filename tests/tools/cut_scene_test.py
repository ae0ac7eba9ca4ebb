#!/usr/bin/env python3
"""cut-scene, model --first and join-seen, end to end: the parts' stage 1, joined, is that of the whole, to
the last byte.

usage: cut_scene_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import fcntl
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import unittest

import random_scenes
from random_scene import scene_of_parts
from toolbox import SOURCE, ToolTest, command, heed_signals, run, run_with

SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12)) * 2  # fewer with sanitizers, see CMakeLists.txt
CAMERA = "1 0.5 4\n0 0 0\n0 1 0\n50 1.25 1 30 ratio\n"
TRIANGLE = "triangle\n0 0 0\n1 0 0\n0 1 0\n"


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

    def stage1(self, parts, *options):
        """The files of the parts' stage 1."""
        for i, (path, first) in enumerate(parts):
            done = run("model", "--first", first, *options, path)
            self.assertEqual(done.returncode, 0, done.stderr)
            pathlib.Path(f"stage1.{i}").write_bytes(done.stdout)
        return [f"stage1.{i}" for i in range(len(parts))]

    def check(self, scene, count, *options):
        parts = self.split(scene, count)
        done = run("join-seen", *self.stage1(parts, *options))
        self.assert_quiet_success(done)
        whole = run("model", "scene.txt", *options)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        self.assertEqual(done.stdout, whole.stdout)
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

    def test_lights_inside_push_and_pop(self):
        self.check(scene_of_parts(True), 7)

    def test_samples(self):
        for sample in sorted(SOURCE.glob("samples/*/scene.txt")):
            with self.subTest(sample=sample.parent.name):
                self.check(sample.read_text(), 5, "--framed")

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


class Joins(Split):
    def refuse(self, message, *words):
        done = run("join-seen", *words)
        self.assertEqual((done.returncode, done.stderr.decode()), (1, f"join-seen: {message}\n"))
        self.assertTrue(done.stdout.endswith(f"error join-seen: {message}\n".encode()))

    def test_one_frame_is_written(self):
        for name in "ab":
            pathlib.Path(name).write_text("framed\n0 0 0\n1 0 0\n0 1 0\n\nend\n")
        self.assertEqual(
            run("join-seen", "a", "b").stdout,
            b"framed\n0 0 0\n1 0 0\n0 1 0\n\ntriangle 0\n0 0 0\n1 0 0\n0 1 0\n\nend\n")

    def test_what_is_wrong(self):
        whole = "framed\neye 1 2 3\n0 0 0\n1 0 0\n0 1 0\n\nend\n"
        pathlib.Path("a").write_text(whole)
        pathlib.Path("cut").write_text(whole[:-4])
        pathlib.Path("other").write_text(whole.replace("3\n", "4\n", 1))
        pathlib.Path("plain").write_text(whole.replace("framed\n", "").replace("end\n", ""))
        pathlib.Path("failed").write_text("framed\neye 1 2 3\nerror model: no memory\n")
        pathlib.Path("empty").write_text("")
        self.refuse("cut:7:1: expected 'end', which closes a framed text, found the end of the input", "a",
                    "cut")
        self.refuse("other:3:1: expected the header of the first text, found another one before here", "a",
                    "other")
        self.refuse("plain:2:1: expected the header of the first text, found another one before here", "a",
                    "plain")
        self.refuse("plain:2:1: expected a framed text (model --framed), found one without 'framed'",
                    "--expect-framed", "plain")
        self.refuse("empty:1:1: expected a framed text (model --framed), found an empty one",
                    "--expect-framed", "empty", "a")
        self.refuse("cannot open gone: No such file or directory", "a", "gone")
        done = run("join-seen", "a", "failed")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"model: no memory", done.stderr)
        self.assertIn(b"error model: no memory\n", done.stdout)
        self.assertEqual(run("join-seen").returncode, 2)


class Refusals(Split):
    def test_scenes(self):
        for scene, message in (
            (CAMERA + TRIANGLE + "pop\nend\n",
             "scene.txt:9:1: expected a matrix that 'push' has saved, found 'pop' without one"),
            (CAMERA + TRIANGLE,
             "scene.txt:9:1: expected 'end', which closes a scene, found the end of the input"),
            (CAMERA + TRIANGLE + "light\n1 2 3 1 1 1\n" + TRIANGLE + "end\n",
             "scene.txt:9:1: expected 'light' before the first triangle, found 'light' after it"),
            (CAMERA + TRIANGLE + "color\n1 2 3\n" + TRIANGLE + "end\n",
             "scene.txt:9:1: expected 'color' before the first triangle, found 'color' after it"),
            (CAMERA + TRIANGLE + "end\nend\n", "scene.txt:10:1: expected nothing after 'end', found 'end'"),
            (CAMERA + "turn 1 2 3\nend\n", "scene.txt:5:1: expected a command of a scene, found 'turn'"),
            (CAMERA + "push 1\nend\n", "scene.txt:5:6: expected the end of the line after 'push', found '1'"),
            ("0 0 5\n", "scene.txt:2:1: expected the four lines of the camera, found the end of the input")):
            pathlib.Path("scene.txt").write_text(scene)
            shutil.rmtree("parts", ignore_errors=True)
            done = run("cut-scene", "scene.txt", "2")
            self.assertEqual((done.returncode, done.stderr.decode()), (1, f"cut-scene: {message}\n"), scene)
            self.assertNotEqual(run("model", "scene.txt").returncode, 0)

    def test_a_number_that_is_wrong_is_models(self):
        self.assertEqual(
            len(self.split(CAMERA + TRIANGLE * 3 + TRIANGLE.replace("1 0 0", "1 x 0") + "end\n", 2)), 2)
        self.assertEqual(run("model", "parts/1.txt").returncode, 0)
        self.assertIn(b"model: parts/2.txt:11:3: expected", run("model", "--first", 2, "parts/2.txt").stderr)

    def test_command_lines(self):
        pathlib.Path("scene.txt").write_text(CAMERA + TRIANGLE + "end\n")
        for words in (["scene.txt"], [], ["scene.txt", "0"], ["scene.txt", "x"], ["scene.txt", "100000"], [
                "/dev/null", "2"]):
            self.assertEqual(run("cut-scene", *words).returncode, 2, words)
        os.mkdir("full")
        pathlib.Path("full/x").write_text("")
        done = run("cut-scene", "scene.txt", "2", "-o", "full")
        self.assertEqual(
            (done.returncode, done.stderr),
            (1, b"cut-scene: full: expected a new folder, or an empty one, found one with files in it\n"))
        for words in (["--first", "-1"], ["--first", "x"], ["--first", "3", "--bare"]):
            self.assertEqual(run("model", *words, "scene.txt").returncode, 2, words)
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
        for end in (ends := os.pipe()):
            self.addCleanup(os.close, end)
        self.full_pipe = ends[1]
        with contextlib.suppress(PermissionError):
            fcntl.fcntl(self.full_pipe, 1031, 1 << 20)  # F_SETPIPE_SZ, the size that cut-scene asks for
        os.set_blocking(self.full_pipe, False)
        with contextlib.suppress(BlockingIOError):
            while os.write(self.full_pipe, bytes(4096)):
                pass
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

    def with_closed_pipe(self, *words):
        read, write = os.pipe()
        os.close(read)
        with os.fdopen(write, "wb") as output:
            return run(*words, stdout=output)

    def test_all_is_as_before(self):
        small = (len(CAMERA + TRIANGLE) * 2,) * 2  # less than a part has
        words = ("cut-scene", "scene.txt", "4", "-o")
        ended = "ended by a signal; unfinished files are removed"
        for status, message, fail in (
            (1, "cannot write <stdout>: No space left on device", lambda *out: run_with(">/dev/full", *out)),
            (1, "cannot write <stdout>: Bad file descriptor", lambda *out: run_with(">&-", *out)),
            (1, "cannot write .*: File too large",
             lambda *out: run(*out, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, small))),
            (1, None, self.with_closed_pipe), (1, "cut.txt:165:1: expected 'end', .*",
                                               lambda *out: run(out[0], "cut.txt", *out[2:])),
                *((-number, ended, lambda *out, number=number: self.end_by(number, out[-1]))
                  for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP))):
            for folder in self.FOLDERS:
                pathlib.Path("cut.txt").write_text(self.GOOD.replace("end\n", ""))
                before = sorted(pathlib.Path(".").rglob("*"))
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
