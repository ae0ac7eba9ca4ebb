#!/usr/bin/env python3
"""zbuf, end to end: the same bytes on any number of threads; its progress line.

usage: zbuf_test.py BIN_DIR
"""
import os
import pathlib
import random
import re
import subprocess
import unittest

from scanline_test import zbuf
from toolbox import CAMERA, CONFIG, SOURCE, Terminal, ToolTest, command, pipe, run

TRIANGLE = "0 0 0\n1 0 0\n0 1 0\n\n"


def random_triangle(rng, sizes):
    """Triangles of which many share their depths."""
    size = rng.choice(sizes)
    x, y, z = rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2), rng.choice((0, 0.25, rng.uniform(-1, 1)))
    points = [[x + rng.uniform(-size, size), y + rng.uniform(-size, size), z] for _ in range(3)]
    return "".join(" ".join("%.7f" % c for c in point) + "\n" for point in points) + "\n"


class Threads(ToolTest):
    def check(self, config, stage3, thread_counts=(1, 2, 3, 8)):
        for coverage in ("nearest", "center"):
            expected = zbuf(config, stage3, "--coverage", coverage, "--algorithm", "scanline")
            for count in thread_counts:
                with self.subTest(stage3=str(stage3), coverage=coverage, threads=count):
                    drawn = zbuf(config, stage3, "--coverage", coverage, "--threads", count)
                    self.assertTrue(drawn == expected, "differs")

    def test_every_sample(self):
        for stage3 in sorted(SOURCE.glob("samples/*/stage3.txt")):
            self.check(stage3.parent / "config.txt", stage3, thread_counts=(1, 3))

    def test_a_scene_of_tiny_to_huge_triangles(self):
        rng, sizes = random.Random(1), (0.01, 0.01, 0.1, 1, 1e6)
        pathlib.Path("stage3.txt").write_text("".join(random_triangle(rng, sizes) for _ in range(20000)))
        pathlib.Path("config.txt").write_text("301 203\n")
        self.check("config.txt", "stage3.txt")

    def test_many_small_triangles_with_large_ones_between_them(self):
        rng = random.Random(2)
        counts = ((10000, 0.01), (50, 1), (10000, 0.01))
        pathlib.Path("stage3.txt").write_text("".join(
            random_triangle(rng, (size,)) for count, size in counts for _ in range(count)))
        pathlib.Path("config.txt").write_text("151 83\n")
        self.check("config.txt", "stage3.txt")

    def test_many_small_triangles_with_colors_of_their_own(self):
        rng = random.Random(3)
        background = "background 255 255 255\n"
        triangles = (f"color {' '.join(str(rng.randrange(256)) for _ in range(3))}\ntriangle\n" +
                     random_triangle(rng, (0.05,)).replace("\n\n", "\n") for _ in range(8000))
        stage1 = pipe(["model"], stdin=CAMERA + background + "".join(triangles) + "end\n")
        pathlib.Path("stage3.txt").write_bytes(pipe(["view"], ["project"], stdin=stage1))
        pathlib.Path("config.txt").write_text("61 47\n")
        self.check("config.txt", "stage3.txt")

    def test_other_text_between_triangles_in_fixed_form(self):
        rng = random.Random(4)
        other = ("# a comment\n", "triangle 7\n", "0 0 0.1\n1 0 .1\n0 1 1e-1\n\n", "\n\n")
        counts = (20000, 1000, 25000, 1)
        text = "".join("".join(random_triangle(rng, (0.02,)) for _ in range(count)) + line
                       for count, line in zip(counts, other))
        pathlib.Path("stage3.txt").write_text(text)
        pathlib.Path("config.txt").write_text("91 103\n")
        self.check("config.txt", "stage3.txt")

    def test_bad_text_is_found_whatever_waits_to_be_drawn(self):
        pathlib.Path("config.txt").write_text(CONFIG)
        done = run("zbuf", "config.txt", "--threads", "3", stdin=TRIANGLE * 20000 + "x\n")
        self.assertEqual((done.returncode, done.stdout), (1, b""))
        self.assertTrue(done.stderr.startswith(b"zbuf: <stdin>:80001:1: "), done.stderr)
        self.assertFalse(pathlib.Path("out.bmp").exists())

    def test_the_scanline_algorithm_has_none(self):
        pathlib.Path("config.txt").write_text(CONFIG)
        done = run("zbuf", "config.txt", "--threads", "2", "--algorithm", "scanline", stdin=TRIANGLE)
        self.assertEqual(
            done.stderr.decode(),
            "zbuf: --threads: expected 1 with --algorithm scanline, which goes through the "
            "rows in turn, found '2' (try zbuf --help)\n")
        self.assertEqual(done.returncode, 2)


class Progress(ToolTest):
    def run_for(self, seconds, stderr):
        """Feeds triangles slowly, for so many seconds."""
        pathlib.Path("config.txt").write_text(CONFIG)
        steps = int(seconds * 10)
        feed = (f"import sys, time\nfor _ in range({steps}): print({TRIANGLE!r}, end='', flush=True); "
                f"time.sleep(0.1)")
        with subprocess.Popen(["python3", "-c", feed], stdout=subprocess.PIPE) as source:
            done = subprocess.run(command("zbuf", "config.txt"), stdin=source.stdout,
                                  stdout=subprocess.DEVNULL, stderr=stderr)
        self.assertEqual(done.returncode, 0)
        return done

    def on_a_terminal(self, seconds):
        terminal = Terminal(self)
        self.run_for(seconds, terminal.channel)
        return terminal.shown().decode()

    def test_a_terminal_gets_one_line(self):
        shown = self.on_a_terminal(2)
        self.assertRegex(shown, r"^(\rzbuf: \d+ triangles, [0-9.e-]+ million a second +)+\r\n$")
        counts = [int(count) for count in re.findall(r"(\d+) triangles", shown)]
        self.assertEqual(counts, sorted(counts))
        self.assertLessEqual(counts[-1], 20)

    def test_a_short_run_shows_nothing(self):
        self.assertEqual(self.on_a_terminal(0.3), "")

    def test_a_file_gets_nothing(self):
        self.assertEqual(self.run_for(1.5, subprocess.PIPE).stderr, b"")


class Timing(ToolTest):
    def test_the_phases_add_up_on_many_threads(self):
        pathlib.Path("config.txt").write_text("300 300\n")
        done = run("zbuf", "config.txt", "--threads", "2", "--timing", "--z-buffer", "/dev/null",
                   stdin=TRIANGLE * 50000)
        self.assertIn(b"zbuf: 50000 triangles in ", done.stderr)
        total, *phases = [float(number) for number in re.findall(r"\d+\.\d{3}", done.stderr.decode())[:4]]
        self.assertAlmostEqual(total, sum(phases), delta=0.003)


if __name__ == "__main__":
    unittest.main()
