#!/usr/bin/env python3
"""scripts/measure/extremes: the committed numbers are those of these tools, the truth is true, and a wrong
digit would be seen.

usage: extremes_test.py BIN_DIR SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

BIN, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
MEASURE = SOURCE / "scripts/measure"
sys.path[:0] = [str(MEASURE), str(SOURCE / "scripts")]
from lib.running.pipe_tools import Tools  # noqa: E402
from parts.extremes_measure import (  # noqa: E402
    ROUNDED, SETTINGS, digits_right, measured, shortened, wrong_without_note)
from parts.extremes_report import Results, tables  # noqa: E402
from parts.extremes_scenes import AXES, QUICK, Case, scene_text  # noqa: E402
from parts.extremes_truth import reference, true_owners, true_vertices  # noqa: E402

SCENE = """0 0 3
0 0 0
0 1 0
90 1 1 10
translate 0 0 1
triangle
1 0 0
0 1 0
0 0 1
end
"""


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


COMMITTED = rows_of(MEASURE / "results/extremes.csv")


class Numbers(unittest.TestCase):
    maxDiff = None

    def test_the_committed_ones_are_those_of_these_tools(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([MEASURE / "extremes", "--quick", "--bin", BIN, "--output", folder], check=True)
            rows = rows_of(pathlib.Path(folder, "extremes.csv"))
        self.assertEqual(len(rows), len(SETTINGS) * sum(map(len, QUICK.values())))
        keys = {(row["axis"], row["value"]) for row in rows}
        self.assertEqual(rows, [row for row in COMMITTED if (row["axis"], row["value"]) in keys])

    def test_every_value_and_setting_is_committed(self):
        wanted = [(axis, f"{value:g}", str(setting)) for axis, (_, _, values) in AXES.items()
                  for value in values for setting in SETTINGS]
        self.assertEqual([(row["axis"], row["value"], row["setting"]) for row in COMMITTED], wanted)

    def test_no_digit_is_wrong_without_a_note(self):
        checked = [row for row in COMMITTED if row["wrong_without_note"]]
        self.assertEqual(len(checked), len(COMMITTED) * len(ROUNDED) // len(SETTINGS))
        self.assertEqual([row for row in checked if row["wrong_without_note"] != "0"], [])

    def test_no_pixel_that_is_called_certain_is_wrong(self):
        """Bounds need extended precision, and what they do not hold for is refused."""
        refused = [row for row in COMMITTED if row["uncertain_pixels"] == "refused"]
        self.assertEqual([
            (row["axis"], row["value"], row["setting"]) for row in refused if "double" not in row["setting"]],
                         [("angle", "1e-09", "--digits exact")])
        self.assertEqual(len(refused), 1 + sum("double" in row["setting"] for row in COMMITTED))
        self.assertEqual({row["wrong_though_certain"] for row in COMMITTED if row not in refused}, {"0"})


class Truth(unittest.TestCase):
    def test_vertices_are_those_of_the_formulas(self):
        """fovY 90: x / distance; z is ((d - n) f - (f - d) n) / (d (f - n)). The translation moves the
        corners to 2, 2 and 1 away."""
        def z(d):
            return Fraction((d - 1) * 10 - (10 - d), 9 * d)

        wanted = [(Fraction(1, 2), 0, z(2)), (0, Fraction(1, 2), z(2)), (0, 0, z(1))]
        for got, right in zip(true_vertices(SCENE)[0], wanted, strict=True):
            for a, b in zip(got, right, strict=True):
                self.assertLess(abs(a - b), Fraction(1, 2**290))

    def test_owners_are_those_of_the_specification(self):
        """Of triangles with few digits, which the reference reads as they are."""
        triangles = [
            [[Fraction(x, 8) for x in point] for point in triangle]
            for triangle in (((-7, -7, 3), (7, -7, 3), (0, 7, -5)), ((-7, 5, 2), (7, 5, -4), (0, -6, 2)),
                             ((-3, -3, -1), (1, 5, 0), (5, 1, 0)), ((0, 0, 0), (1, 1, 1), (2, 2, 2)))]
        text = "\n\n".join("\n".join(" ".join(str(float(x)) for x in point) for point in triangle)
                           for triangle in triangles) + "\n"
        config = reference.Config(16, 16, *map(Fraction, (-1, -1, -1, 1)), ("-1", "-1"))
        _, seen = reference.draw(reference.Stage(text.encode(), "zbuf").triangles(), config, "center")
        owners = [triangle.number if triangle else -1 for row in seen for triangle in row]
        self.assertEqual(true_owners(triangles, 16), owners)
        self.assertEqual(set(owners), {-1, 0, 1, 2})

    def test_digits_count_within_the_extent(self):
        truth = [[(Fraction(0), Fraction(0), Fraction(0)), (Fraction(2), Fraction(1), Fraction(1, 100)),
                  (Fraction(1), Fraction(1), Fraction(0))]]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "text")
            for z, digits in (("0.01", 17), ("0.0100005", 4), ("0.015", 0)):
                path.write_text(f"0 0 0\n2 1 {z}\n1 1 0\n")
                self.assertAlmostEqual(digits_right(path, truth), digits, msg=z)
            path.write_text("")
            self.assertEqual(digits_right(path, truth), 0)


def tools_with(folder, tool, change):
    """Puts the tools into a folder, one of them with its output through a filter."""
    for name in ("model", "view", "project", "zbuf"):
        os.symlink(BIN / name, pathlib.Path(folder, name))
    changed = pathlib.Path(folder, tool)
    changed.unlink()
    changed.write_text(f"#!/bin/sh\n'{BIN}/{tool}' \"$@\" | {change}\n")
    changed.chmod(0o755)


class Mistakes(unittest.TestCase):
    def test_a_wrong_digit_is_found_unless_it_is_noted(self):
        text = scene_text(Case("size", 1.0))
        self.assertEqual(wrong_without_note(Tools(BIN), text, "7"), 0)
        with tempfile.TemporaryDirectory() as folder:
            tools_with(folder, "view", "sed '$!s/3$/4/'")
            self.assertEqual(wrong_without_note(Tools(folder), text, "7"), 1)

    def test_wrong_pixels_that_are_called_certain_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            tools_with(folder, "zbuf", "head -n 5")  # three uncertain ones of the report
            row = measured((folder, Case("depth", 1e6)))[1]
        self.assertEqual((row["setting"], row["uncertain_pixels"]), ("default", 3))
        self.assertEqual(row["wrong_though_certain"], row["wrong_pixels"] - 3)

    def test_notes_are_shortened_to_what_they_are_about(self):
        for note, words in (
            ("view: note: <stdin>:4:1: the digits of this vertex and of 2 more are not certain: numbers "
             "cancel here, and 31 digits are too few", "view: uncertain digits"),
            ("project: note: in 2 % of what is drawn, 7 digits are too few to tell where the edges are; try "
             "--digits 12 for every stage",
             "project: moved edges"), ("zbuf: note: the picture is empty: no triangle came",
                                       "zbuf: empty picture"), ("zbuf: note: a new one", "zbuf: a new one")):
            self.assertEqual(shortened(note), words)


class Page(unittest.TestCase):
    """What docs/accuracy.md says in words follows from the numbers."""
    results = Results(COMMITTED)

    def digits(self, axis, setting):
        return {float(row["value"]): float(row["digits_right"]) for row in self.results.of(axis, setting)}

    def test_far_from_the_origin_all_settings_have_doubles(self):
        for setting in self.results.settings[1:]:
            for value in (1e12, 1e13, 1e14, 1e15):
                self.assertAlmostEqual(
                    self.digits("distance", setting)[value],
                    self.digits("distance", "--digits exact")[value], delta=0.05)
        self.assertEqual(self.results.first("distance", "--digits exact", "wrong_pixels"), "1e13 (no note)")

    def test_depth_costs_a_digit_for_each_power_of_ten(self):
        for setting in self.results.settings:
            digits = [x for x in self.digits("depth", setting).values() if x > 0]
            for a, b in zip(digits[1:], digits[2:]):
                self.assertAlmostEqual(a - b, 1, delta=0.35, msg=setting)
        # At 1e5 it is one pixel of 6,378; notes begin at half a per cent.
        self.assertEqual(self.results.first("far / near", "default", "wrong_pixels"), "1e5 (note from 1e6)")

    def test_a_note_comes_before_a_hundredth_of_the_pixels_is_wrong_by_depth_or_size(self):
        for direction in ("far / near", "size"):
            for setting in self.results.settings:
                for row in self.results.towards(direction, setting):
                    # At 1e12 both layers have the same double for a depth.
                    is_told = not (direction == "far / near" and float(row["value"]) >= 1e12)
                    if is_told and int(row["wrong_pixels"]) * 100 >= int(row["covered"]):
                        self.assertTrue(row["note"], row)

    def test_no_size_costs_the_lossless_run_a_digit(self):
        for setting in ("--digits exact", "--digits exact --precision double"):
            digits = self.digits("size", setting).values()
            self.assertLess(max(digits) - min(digits), 0.4)

    def test_the_angle_costs_the_default_no_pixel(self):
        for direction in ("wide angle", "narrow angle"):
            self.assertEqual(self.results.first(direction, "default", "wrong_pixels"), "")

    def test_all_digits_leave_no_pixel_uncertain_but_far_away(self):
        for direction in ("far / near", "size", "wide angle"):
            self.assertEqual(self.results.uncertain(direction, "--digits exact"), "")

    def test_the_tables_are_those_of_the_numbers(self):
        self.assertIn(f"<!-- extremes: begin -->\n{tables(COMMITTED)}<!-- extremes: end -->",
                      (SOURCE / "docs/accuracy.md").read_text())


if __name__ == "__main__":
    unittest.main()
