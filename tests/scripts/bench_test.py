#!/usr/bin/env python3
"""scripts/measure/bench prints a figure for every group, and its baselines do the same work as the tools.

usage: bench_test.py BIN_DIR BASELINES SOURCE_DIR
"""
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

BIN_DIR, BASELINES, SOURCE_DIR = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
del sys.argv[1:4]

TRIANGLE = b"1.8000000 1.2000000 2.4000000\n2.8000000 1.2000000 2.4000000\n1.8000000 2.2000000 3.4000000\n\n"
# The baselines' camera is at (1.8 1.2 2.4): in view space, unit steps from there are columns of its rotation.
FILTERED = (
    b"0.0000000 0.0000000 0.0000000\n0.8000000 0.3600000 0.4800000\n-0.6000000 1.2800000 0.0400000\n\n")

NINJA_LOG = """# ninja log v5
0\t9000\t1\tlibpipeline/CMakeFiles/pipeline.dir/a.cpp.o\t1
0\t1500\t1\ttools/CMakeFiles/zbuf.dir/b.cpp.o\t2
1500\t9000\t1\tbin/zbuf\t3
2000\t9000\t1\ttests/CMakeFiles/c.dir/c.cpp.o\t4
9000\t11500\t1\tlibpipeline/CMakeFiles/pipeline.dir/a.cpp.o\t5
"""  # a.cpp was compiled twice, the second time in 2.5 s


class BenchTest(unittest.TestCase):
    def test_every_group_has_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, ".ninja_log").write_text(NINJA_LOG)
            text = subprocess.check_output([
                SOURCE_DIR / "scripts/measure/bench", "--quick", "--print", "--bin", BIN_DIR, "--baselines",
                BASELINES, "--built", folder], text=True)
        tables = [[[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
                  for table in re.findall(r"(?:^\|.*\n)+", text, re.M)]
        self.assertEqual([table[0][0] for table in tables],
                         ["filter", "triangles", "`--coverage center`", "build"])
        self.assertEqual([len(table) - 2 for table in tables], [5, 2, 6, 1])
        for cell in (cell for table in tables for row in table[2:] for cell in row[1:]):
            self.assertGreater(float(cell.split()[0]), 0)
        self.assertEqual(tables[3][2][1:], ["4", "2"])

    def test_the_student_draws_what_the_tools_draw(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            sample = SOURCE_DIR / "samples/worked-example"
            subprocess.run([
                BASELINES / "student", "all", sample / "scene.txt", sample / "config.txt", "--folder", folder
            ], check=True)
            self.assertEqual((folder / "stage3.txt").read_bytes(), (sample / "stage3.txt").read_bytes())

    def test_the_plain_filters_turn_and_move_triangles(self):
        for name in ("filter_from_chars", "filter_iostream"):
            done = subprocess.run([BASELINES / name], input=TRIANGLE, capture_output=True, check=True)
            self.assertEqual(done.stdout.replace(b"-0.0000000", b"0.0000000"), FILTERED, name)

    def test_the_plain_loop_draws_the_pixels_that_zbuf_draws(self):
        rng = random.Random(1)
        number = lambda: "%.7f" % rng.uniform(-1, 1)
        with tempfile.TemporaryDirectory() as folder:
            text, config = pathlib.Path(folder, "ndc.txt"), pathlib.Path(folder, "config.txt")
            text.write_text("".join(
                "\n".join(" ".join(number() for _ in range(3)) for _ in range(3)) + "\n\n" for _ in range(4)))
            config.write_text("60 40\n")
            depths = subprocess.run(
                [BIN_DIR / "zbuf", config, text, "--coverage", "center", "--image", "/dev/null"],
                capture_output=True, check=True)
            for threads in ("1", "2"):
                done = subprocess.run([BASELINES / "draw_plainly", "60", "40", text, threads],
                                      capture_output=True, check=True)
                self.assertEqual(int(done.stdout.split()[1]), len(depths.stdout.split()))


if __name__ == "__main__":
    unittest.main()
