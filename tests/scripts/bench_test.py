#!/usr/bin/env python3
"""scripts/measure/bench writes a figure for every group, and its baselines do the same work as the tools.

usage: bench_test.py BIN_DIR BASELINES SOURCE_DIR
"""
import csv
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
from xml.etree import ElementTree

BIN_DIR, BASELINES, SOURCE_DIR = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
del sys.argv[1:4]

TRIANGLE = b"1.8000000 1.2000000 2.4000000\n2.8000000 1.2000000 2.4000000\n1.8000000 2.2000000 3.4000000\n\n"
# The baselines' camera is at (1.8 1.2 2.4): in view space, unit steps from there are columns of its rotation.
FILTERED = (
    b"0.0000000 0.0000000 0.0000000\n0.8000000 0.3600000 0.4800000\n-0.6000000 1.2800000 0.0400000\n\n")


class Embree(unittest.TestCase):
    def test_its_rays_hit_as_often_as_ours(self):
        """Large triangles at random, so that floats lose no pixel."""
        if not (BASELINES / "cast_rays_embree").exists():
            self.skipTest("libembree-dev is not installed")
        dice = random.Random(3)
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as view:
            view.write("perspective 60 1 1 100\n")
            for _ in range(40):
                x, y, z = dice.uniform(-2, 2), dice.uniform(-2, 2), dice.uniform(-9, -3)
                view.write("".join(f"{x + dice.uniform(-1, 1):.7f} {y + dice.uniform(-1, 1):.7f} {z:.7f}\n"
                                   for _ in range(3)) + "\n")
            view.flush()
            hits = {
                name: int(
                    subprocess.run([BASELINES / name, "61", "47", view.name], stdout=subprocess.PIPE,
                                   check=True).stdout.split()[2])
                for name in ("cast_rays", "cast_rays_embree")}
        self.assertEqual(hits["cast_rays"], hits["cast_rays_embree"])
        self.assertTrue(200 < hits["cast_rays"] < 61 * 47)


class BenchTest(unittest.TestCase):
    def bench(self, folder, *options):
        return subprocess.run([
            sys.executable, SOURCE_DIR / "scripts/measure/bench", "--quick", "--bin", BIN_DIR, "--baselines",
            BASELINES, "--output", folder, *options], check=True, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, text=True)

    def test_every_group_has_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.bench(folder)
            with open(pathlib.Path(folder, "bench.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual({row["group"]
                              for row in rows}, {
                                  "filter", "pipe", "threads", "zbuf", "large triangles",
                                  "triangles of 3 pixels", "primary rays"})
            self.assertTrue(all(float(row["median"]) > 0 for row in rows))
            with open(pathlib.Path(folder, "yardsticks.csv"), newline="") as file:
                yardsticks = {row["name"]: row for row in csv.DictReader(file)}
            self.assertLessEqual(
                {
                    "`model`", "`view`", "`project`", "`zbuf`", "`zbuf`, lit", "the pipe", "the pipe, lit",
                    "a plain filter, `from_chars`", "a plain filter, iostream",
                    "a student's program, all four stages"}, yardsticks.keys())
            self.assertTrue(
                all(
                    float(row[column]) > 0
                    for row in yardsticks.values()
                    for column in ("wall_seconds", "mib", "copy", "read", "clock")))
            # f3d is there, or its absence is told.
            self.assertEqual("f3d, the lit model" in yardsticks, "skipped f3d" not in done.stdout)
            with open(pathlib.Path(folder, "growth.csv"), newline="") as file:
                growth = list(csv.DictReader(file))
            self.assertEqual(len(growth), 8)  # two sizes, two counts, two kinds
            self.assertTrue(all(float(row["cpu_seconds"]) > 0 for row in growth))
            ElementTree.parse(pathlib.Path(folder, "growth.svg"))

    def test_what_the_memory_cannot_hold_is_not_tried(self):
        with tempfile.TemporaryDirectory() as folder:
            self.bench(folder, "--reach")
            with open(pathlib.Path(folder, "reach.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([row["triangles"] for row in rows],
                             ["576", "576", "192", ""])  # 192, three times
            self.assertEqual([bool(row["needed_gib"]) for row in rows], [False, False, False, True])
            self.assertTrue(
                all(float(row["cpu_seconds"]) > 0 and float(row["zbuf_mib"]) > 1 for row in rows[:3]))

    def test_model_files(self):
        if not (BIN_DIR / "mesh2scene").exists():
            self.skipTest("mesh2scene is missing: no assimp")
        with tempfile.TemporaryDirectory() as folder:
            done = self.bench(folder, "--models")
            with open(pathlib.Path(folder, "models.csv"), newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual([(row["format"], row["triangles"]) for row in rows],
                             [(name, count) for count in ("392", "882") for name in ("obj", "ply", "stl")])
            for program in ("picture", "import", *(() if "skipped f3d" in done.stdout else ("f3d",))):
                for row in rows:
                    self.assertTrue(
                        float(row[program + "_wall_seconds"]) > 0 < float(row[program + "_cpu_seconds"]), row)

    def test_the_shares_of_a_row_are_arithmetic(self):
        sys.path[:0] = [str(SOURCE_DIR / "scripts/measure")]
        from parts.yardsticks import shares
        # At 2 GHz, 2 s for 10 triangles are 4e8 cycles each: 4e8 instructions take a quarter of them, 4e6
        # mispredictions 15 %.
        row = {
            "cpu_seconds": "2", "system_seconds": "0.5", "count": "10", "clock": "2", "instructions": "4e8",
            "mispredictions": "4e6", "misses": "1e6", "copy": "3.2", "text_bytes": "1"}
        self.assertEqual(
            {key: round(share, 9)
             for key, share in shares(row).items()},
            {"the system": 0.25, "instructions": 0.25, "mispredicted branches": 0.15, "memory": 0.1})

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
            text.write_text("".join("\n".join(" ".join(number()
                                                       for _ in range(3))
                                              for _ in range(3)) + "\n\n"
                                    for _ in range(4)))
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
