#!/usr/bin/env python3
"""scripts/measure/bench writes a figure for every group, and its baselines do the same work as the tools.

usage: bench_test.py BIN_DIR SOURCE_DIR
"""
import csv
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

BIN_DIR, SOURCE_DIR = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
del sys.argv[1:3]

TRIANGLE = b"1.8000000 1.2000000 2.4000000\n2.8000000 1.2000000 2.4000000\n1.8000000 2.2000000 3.4000000\n\n"
# The baselines' camera is at (1.8 1.2 2.4): in view space, unit steps from there are columns of its rotation.
FILTERED = (b"0.0000000 0.0000000 0.0000000\n0.8000000 0.3600000 0.4800000\n-0.6000000 1.2800000 0.0400000\n\n")


class BenchTest(unittest.TestCase):
    def test_every_group_has_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, SOURCE_DIR / "scripts/measure/bench", "--quick", "--bin", BIN_DIR, "--baselines", BIN_DIR,
                            "--out", folder], check=True, stdin=subprocess.DEVNULL)
            with open(pathlib.Path(folder, "bench.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual({row["group"] for row in rows}, {"filter", "pipe", "threads", "zbuf", "large triangles", "triangles of 3 pixels"})
            self.assertTrue(all(float(row["median"]) > 0 for row in rows))
            self.assertIn("| filter | iostream |", pathlib.Path(folder, "bench.md").read_text())
            with open(pathlib.Path(folder, "growth.csv"), newline="") as file:
                growth = list(csv.DictReader(file))
            self.assertEqual(len(growth), 8)  # two sizes, two counts, two kinds
            self.assertTrue(all(float(row["cpu_seconds"]) > 0 for row in growth))
            ElementTree.parse(pathlib.Path(folder, "growth.svg"))

    def test_the_plain_filters_turn_and_move_triangles(self):
        for name in ("filter_from_chars", "filter_iostream"):
            done = subprocess.run([BIN_DIR / name], input=TRIANGLE, capture_output=True, check=True)
            self.assertEqual(done.stdout.replace(b"-0.0000000", b"0.0000000"), FILTERED, name)

    def test_the_plain_loop_draws_the_pixels_that_zbuf_draws(self):
        rng = random.Random(1)
        number = lambda: "%.7f" % rng.uniform(-1, 1)
        with tempfile.TemporaryDirectory() as folder:
            text, config = pathlib.Path(folder, "ndc.txt"), pathlib.Path(folder, "config.txt")
            text.write_text("".join("\n".join(" ".join(number() for _ in range(3)) for _ in range(3)) + "\n\n" for _ in range(4)))
            config.write_text("60 40\n")
            depths = subprocess.run([BIN_DIR / "zbuf", config, text, "--coverage", "center", "--image", "/dev/null"], capture_output=True, check=True)
            for threads in ("1", "2"):
                done = subprocess.run([BIN_DIR / "draw_plainly", "60", "40", text, threads], capture_output=True, check=True)
                self.assertEqual(int(done.stdout.split()[1]), len(depths.stdout.split()))


if __name__ == "__main__":
    unittest.main()
