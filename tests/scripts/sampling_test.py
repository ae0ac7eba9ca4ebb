#!/usr/bin/env python3
"""Runs scripts/measure/sampling on tiny pictures, and holds the committed figures to what the page says of
them.

usage: sampling_test.py BIN_DIR SOURCE_DIR
"""
import csv
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN_DIR = pathlib.Path(sys.argv.pop()).resolve()


def rows_in(folder):
    with open(pathlib.Path(folder, "sampling.csv"), newline="") as file:
        return {(row["samples"], int(row["n"])): row for row in csv.DictReader(file)}


class Quick(unittest.TestCase):
    def test_every_way_to_sample_has_its_rays_and_its_error(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([
                SOURCE / "scripts/measure/sampling", "--quick", "--rounds", "2", "--bin", BIN_DIR, "--output",
                folder], check=True)
            rows = rows_in(folder)
        offered = subprocess.run([BIN_DIR / "trace", "--help"], stdout=subprocess.PIPE, text=True,
                                 check=True).stdout
        ways = offered.split("--sampling ", 1)[1].split()[0].split("|")
        self.assertEqual({name.split(",")[0] for name, _ in rows}, {*ways, "random"})
        for (name, n), row in rows.items():
            if not name.startswith("adaptive"):
                self.assertEqual(float(row["rays"]), n * n, (name, n))
            else:
                self.assertGreaterEqual(float(row["rays"]), 5)
                self.assertLessEqual(float(row["rays"]), n * n)
            self.assertGreater(float(row["error"]), 0)


class Committed(unittest.TestCase):
    """What docs/ray-tracing.md says."""

    rows = rows_in(SOURCE / "scripts/measure/results")

    def errors(self, name, counts=(2, 4, 8)):
        return [float(self.rows[name, n]["error"]) for n in counts]

    def test_the_error_of_jittered_samples_falls_faster_than_that_of_random_ones(self):
        def slope(name):
            few, *_, many = self.errors(name)
            return math.log(many / few) / math.log(64 / 4)
        jittered, rand = slope("jittered"), slope("random, for comparison")
        self.assertAlmostEqual(rand, -0.5, delta=0.06)
        self.assertLess(jittered, rand - 0.1)

    def test_adaptive_sampling_saves_rays_more_than_it_loses(self):
        for n in (5, 8):
            whole, chosen = self.rows["jittered", n], self.rows["adaptive, threshold 8", n]
            self.assertLess(float(chosen["rays"]), 0.7 * float(whole["rays"]))
            self.assertLess(float(chosen["error"]), 1.5 * float(whole["error"]))


if __name__ == "__main__":
    unittest.main()
