#!/usr/bin/env python3
"""The text stages say the same with any number of threads: texts, messages, exit statuses.

usage: threads_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import random
import re
import unittest

from toolbox import CAMERA, HEADER, SCENE, SOURCE, TRIANGLE, ToolTest, run, stage_texts
from streaming_test import LiveTool

THREADS = (2, 3, 8)


def random_text(count, seed, columns=""):
    """Triangles before and behind the eye plane; now and then a comment, a number, digits that take long arithmetic."""
    rng = random.Random(seed)
    lines = []
    for i in range(count):
        if rng.random() < 0.01:
            lines.append(f"triangle {10 * i}")
        for _ in range(3):
            decimals = rng.choice((7, 7, 7, 7, 3, 17))
            point = " ".join("%.*f" % (decimals, rng.uniform(-3, 3)) for _ in range(3))
            lines.append(point + columns + (" # a comment" if rng.random() < 0.01 else ""))
        lines.append("")
    return "\n".join(lines) + "\n"


def plain_text(count, seed):
    """Triangles in the form nearly all text has, which threads read part by part."""
    rng = random.Random(seed)
    return "".join("%.7f %.7f %.7f\n" % (rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-9, 3)) + "\n" * (i % 3 == 2) for i in range(3 * count))


def with_mistake(text, rng):
    """One byte of the text changed, left out or added, or the text cut there."""
    place = rng.randrange(len(text))
    new = rng.choice(["", "\n", " ", "x", "-", "7", "#", ".", "e", "\r", None])
    return text[:place] + (new + text[place + rng.randrange(2):] if new is not None else "")


def without_times(stderr):
    """What --timing says, but for the times."""
    return re.sub(rb"in [0-9.]+ s \(.*?\)|[0-9.]+ MB/s", b"", stderr)


class Threads(ToolTest):
    def assert_same(self, tool, *options, stdin):
        """The run on one thread, which all others equal."""
        alone = run(tool, *options, stdin=stdin)
        for count in THREADS:
            together = run(tool, *options, "--threads", count, stdin=stdin)
            self.assertEqual((without_times(together.stderr), together.returncode), (without_times(alone.stderr), alone.returncode))
            self.assertTrue(together.stdout == alone.stdout, f"{tool} {options}: {count} threads print something else")
        return alone

    def test_every_sample(self):
        for scene in sorted(SOURCE.glob("samples/*/scene.txt")):
            stage1, stage2, _ = stage_texts(scene.read_text())
            self.assert_same("model", stdin=scene.read_bytes())
            self.assert_same("view", stdin=stage1)
            self.assert_same("project", stdin=stage2)

    def test_many_triangles(self):
        text = random_text(20000, 1)
        for options in ([], ["--digits", "exact"], ["--precision", "double"], ["--digits", "2"]):
            self.assert_same("view", *options, stdin=HEADER + text)
        for options in ([], ["--cull", "back"], ["--clip", "frustum"], ["--clip", "reject", "--cull", "front"]):
            done = self.assert_same("project", *options, stdin="perspective 60 1 1 100\n" + text)
            # What is cut nowhere may reach behind the eye.
            self.assertEqual(done.returncode, 1 if "reject" in options else 0)

    def test_plain_triangles(self):
        text = plain_text(20000, 7)
        for options in ([], ["--digits", "exact"], ["--digits", "9"]):
            self.assert_same("view", *options, stdin=HEADER + text)
        for options in ([], ["--cull", "back", "--timing"], ["--clip", "frustum"]):
            self.assert_same("project", *options, stdin="perspective 60 1 1 100\n" + text)
        self.assert_same("view", stdin=HEADER.replace("eye", "framed\neye", 1) + text + "end\n")

    def test_other_text_between_plain_triangles(self):
        other = ["# a comment\n", "triangle 5\n", "1 2 3\n4 5 6\n7 8 9\n\n", "\n\n", "1e0 2 3\r\n4 5 6\r\n7 8 9\r\n"]
        text = "".join(plain_text(count, count) + other[i % len(other)] for i, count in enumerate((20000, 1000, 30000, 1, 25000, 2000)))
        self.assert_same("view", stdin=HEADER + text)
        self.assert_same("project", "--cull", "front", stdin="perspective 60 1 1 100\n" + text)

    def test_any_mistake_between_plain_triangles(self):
        text, rng = plain_text(4000, 8), random.Random(9)
        failures = 0
        for _ in range(20):
            failures += self.assert_same("view", stdin=HEADER + with_mistake(text, rng)).returncode
        self.assertGreater(failures, 5)

    def test_scenes_of_plain_triangles(self):
        triangles = "".join("triangle\n" + lines + "\n" for lines in plain_text(5000, 10).split("\n\n") if lines)
        self.assert_same("model", stdin=CAMERA + triangles + "push\nrotate\n30 1 2 3\n" + 5 * triangles + "pop\n" + triangles + "end\n")
        rng = random.Random(11)
        for _ in range(10):
            self.assert_same("model", stdin=CAMERA + with_mistake(triangles, rng) + "end\n")

    def test_columns(self):
        text = "attributes color normal\n" + random_text(5000, 2, " 10 20 30 0 1 0")
        self.assert_same("view", stdin=HEADER + text)
        self.assert_same("project", "--clip", "near", stdin="perspective 60 1 1 100\n" + text)

    def test_scenes_with_many_matrices(self):
        scene = CAMERA + "".join(f"push\nrotate\n{i} 1 2 3\n{TRIANGLE}pop\n" for i in range(3000)) + "end\n"
        self.assert_same("model", stdin=scene)

    def test_a_mistake_behind_many_triangles(self):
        text = random_text(3000, 3)
        for mistake in ("1 2 3\n4 5 six\n", "eye 1 2 3\n", "1 2 3\n\n", "error model: it broke\n", "1 2 3"):
            done = self.assert_same("view", stdin=HEADER + text + mistake + text)
            self.assertEqual(done.returncode, 1)
            self.assertEqual(done.stdout.count(b"\n\n"), 3000)

    def test_a_vertex_that_has_no_image(self):
        text = random_text(3000, 4)
        view = self.assert_same("view", "--eye", "-1e308", "0", "0", "--look", "0", "0", "0", "--up", "0", "1", "0",
                                stdin=text + "1.7e308 0 0\n0 0 0\n0 0 0\n\n" + text)
        self.assertIn(b"overflow", view.stderr)
        project = self.assert_same("project", "--clip", "none", "--perspective", "60", "1", "1", "100",
                                   stdin="0 0 -1\n1 0 -1\n0 1 -1\n\n" * 5000 + text)
        self.assertIn(b"a vertex in front of the eye", project.stderr)
        self.assertGreaterEqual(project.stdout.count(b"\n\n"), 5000)

    def test_a_mistake_behind_a_vertex_that_has_no_image(self):
        done = self.assert_same("project", "--clip", "none", "--perspective", "60", "1", "1", "100",
                                stdin="0 0 -1\n1 0 -1\n0 1 -1\n\n" * 2000 + "0 0 1\n0 0 1\n0 0 1\n\nnonsense\n")
        self.assertIn(b"<stdin>:8001:1: ", done.stderr)

    def test_what_is_noted_of_the_digits(self):
        small = "1e-6 0 0\n0 1e-6 0\n0 0 1e-6\n\n" * 3000
        done = self.assert_same("view", stdin="eye 0 0 0\nlook 0 0 -1\nup 0 1 0\n" + small)
        self.assertIn(b"--digits exact", done.stderr)

    def test_framed_texts(self):
        stage1, stage2, _ = stage_texts(SCENE, "--framed")
        self.assert_same("view", stdin=stage1)
        self.assert_same("project", stdin=stage2)
        self.assertEqual(self.assert_same("view", stdin=stage1[:-4]).returncode, 1)

    def test_empty_texts(self):
        self.assert_same("view", stdin=HEADER)
        self.assert_same("project", stdin="ortho -1 1 -1 1 0 1\n")

    def test_a_full_disk(self):
        with open("/dev/full", "wb") as full:
            done = run("view", "--threads", 2, stdin=HEADER + random_text(20000, 5), stdout=full)
        self.assert_fails(done, 1, "view: cannot write <stdout>: No space left on device")

    def test_a_reader_that_leaves(self):
        pathlib.Path("text.txt").write_text(HEADER + random_text(20000, 6))
        with LiveTool("view", "--threads", "2", "text.txt") as view:
            view.process.stdout.read(1)
            view.process.stdout.close()
            view.process.stdout = None
            self.assertNotEqual(view.finish(), 0)

    def test_triangles_are_passed_on_while_the_input_is_open(self):
        with LiveTool("view", "--threads", "2") as view:
            view.send(HEADER + "0 0 0\n1 0 0\n0 1 0\n\n")
            self.assertEqual(view.receive(1), 1)
            view.send("0 0 0\n1 0 0\n0 1 0\n\n" * 1000)
            self.assertEqual(view.receive(1001), 1001)
            self.assertEqual(view.finish(), 0)

    def test_triangles_are_passed_on_whatever_stands_behind_them(self):
        texts = {"view": HEADER + 2048 * "0 0 0\n1 0 0\n0 1 0\n\n", "model": CAMERA + 2048 * TRIANGLE}
        for tool, behind in (("view", "triangle 1\n" * 8), ("view", "# " + 150000 * "c"), ("view", "# c\n" * 20000),
                             ("model", "push\npop\n" * 3), ("model", "# " + 150000 * "c")):
            with LiveTool(tool, "--threads", "2") as live:
                live.send(texts[tool] + behind)
                self.assertEqual(live.receive(2048), 2048, (tool, behind[:10]))

    def test_a_byte_order_mark_between_triangles(self):
        plain = plain_text(6000, 12)
        done = self.assert_same("view", stdin=HEADER + plain + "\ufeff" + plain)
        self.assertEqual(done.returncode, 1)

    def test_the_number_of_threads_is_limited(self):
        for count in ("0", "257", "-1", "x"):
            self.assertEqual(run("view", "--threads", count).returncode, 2)


if __name__ == "__main__":
    unittest.main()
