"""Runs scripts/measure/tradeoff on its tiny scenes and compares its results with arithmetic.

usage: tradeoff_test.py BIN_DIR SOURCE_DIR
"""
import csv
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

source = pathlib.Path(sys.argv.pop()).resolve()
bin_dir = pathlib.Path(sys.argv.pop()).resolve()

SCREEN = 64  # columns and rows of the tiny scenes
DIGITS = ["--digits 5", "--digits 6", "default", "--digits 9", "--digits 12"]
ERROR_SETTINGS = {
    *DIGITS, "--digits 15", "--digits exact", "--precision double", "--digits exact --precision double",
    "--coverage center", "--depth f32", "--depth u24", "--digits 9 --coverage center",
    "--digits exact --coverage center"}


def tradeoff(folder, *options):
    subprocess.run(
        [source / "scripts/measure/tradeoff", "--quick", "--bin", bin_dir, "--output", folder, *options],
        check=True)


class Tradeoff(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        tradeoff(cls.folder)
        with open(cls.folder / "tradeoff.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        cls.rows = {(row["scene"], row["setting"]): row for row in rows}

    def value(self, scene, setting, column):
        return float(self.rows[scene, setting][column])

    def values(self, column):
        """A column's values by scene and setting, if measured."""
        return {key: float(row[column]) for key, row in self.rows.items() if row[column]}

    def test_every_value_that_the_tools_offer_is_measured(self):
        words = [row["setting"].split() for row in self.rows.values()]
        for tool, option, default in (("model", "precision", "extended"), ("zbuf", "coverage", "nearest"),
                                      ("zbuf", "depth", "f64"), ("zbuf", "shading",
                                                                 "phong"), ("project", "clip", "auto")):
            help_text = subprocess.run([bin_dir / tool, "--help"], stdout=subprocess.PIPE, text=True,
                                       check=True).stdout
            offered = set(re.search(rf"--{option} (\S+)", help_text)[1].split("|"))
            measured = {
                setting[i + 1]
                for setting in words
                for i in range(0,
                               len(setting) - 1, 2)
                if setting[i] == f"--{option}"}
            # Without cutting, a triangle behind the eye is an error.
            self.assertEqual(offered - {default, "none" * (option == "clip")}, measured, option)

    def test_errors_and_costs_are_measured_of_the_settings_that_change_numbers(self):
        self.assertEqual(len(self.values("vertex_error_pixels")), 10 * len(ERROR_SETTINGS))
        costs = self.values("cpu_seconds")
        self.assertEqual({scene
                          for scene, _ in costs}, {
                              "plain", "color", "normals", "plain planet", "plain pivot", "fill", "ball",
                              "half", "torus", "inside"})
        self.assertLessEqual(ERROR_SETTINGS, {setting for scene, setting in costs if scene == "plain"})
        for scene in ("plain", "normals", "fill", "torus", "inside"):
            self.assertIn((scene, "trace"), costs)
            self.assertLess(self.value(scene, "trace", "bytes"),
                            self.value(scene, "default", "bytes"))  # of two pipes in place of three
        for column in ("empty_cpu_seconds", "wall_seconds", "mib", "bytes"):
            self.assertEqual(self.values(column).keys(), costs.keys())

    def test_medians_lie_between_quartiles(self):
        for column in ("cpu_seconds", "wall_seconds", "ratio"):
            for scene, setting in self.values(column):
                low, median, high = (self.value(scene, setting, column + end) for end in ("_q1", "", "_q3"))
                self.assertTrue(low <= median <= high, (scene, setting, column))

    def test_text_has_the_bytes_that_its_digits_take(self):
        # Nine numbers a triangle in each of three pipes; "default" has seven decimals.
        for setting, digits in zip(DIGITS, (5, 6, 7, 9, 12)):
            self.assertAlmostEqual(
                self.value("plain", setting, "bytes") - self.value("plain", "default", "bytes"),
                27 * (digits - 7), delta=1)

    def test_every_number_is_one(self):
        names = {"scene", "title", "setting", "size", "machine", "counter"}
        for row in self.rows.values():
            for column in row.keys() - names:
                if row[column]:
                    self.assertTrue(
                        math.isfinite(float(row[column])) and float(row[column]) >= 0, (column, row))

    def test_a_lossless_run_is_right(self):
        for scene, setting in self.values("covered_pixels"):
            if setting in ("--digits exact", "--digits exact --coverage center"):
                row = self.rows[scene, setting]
                for column in ("vertex_error_pixels", "flipped_pixels", "wrong_pixels", "neighbor_pixels",
                               "depth_error_max"):
                    if row[column]:
                        self.assertEqual(float(row[column]), 0, (scene, setting, column))

    def test_more_digits_move_vertices_less(self):
        for scene in ("unit", "1e-3", "1e-5", "planet", "telescope"):
            errors = [self.value(scene, setting, "vertex_error_pixels") for setting in DIGITS]
            self.assertEqual(errors, sorted(errors, reverse=True), scene)
            self.assertLess(0, errors[-1])

    def test_vertices_of_a_unit_object_move_as_far_as_three_roundings_take_them(self):
        for setting, digits in zip(DIGITS, (5, 6, 7, 9, 12)):
            # In view space half a unit h of the last decimal moves x by cot(20 degrees) / 2.2 h, because
            # nothing is nearer than 2.2, and by h / 2.2 through the distance: 1.71 h. A world vertex moves
            # sqrt(3) h.
            half = 0.5 * 10.0**-digits
            bound = math.hypot(1, 1) * (1 + 1.71 + 1.71 * math.sqrt(3)) * half * SCREEN / 2
            self.assertLess(self.value("unit", setting, "vertex_error_pixels"), bound)
            self.assertGreater(self.value("unit", setting, "vertex_error_pixels"), half / 4 * SCREEN / 2)

    def test_smaller_objects_lose_as_many_digits_as_they_are_smaller(self):
        for small, setting, same_for_unit in (("1e-3", "--digits 9", "--digits 6"), ("1e-5", "--digits 12",
                                                                                     "default")):
            ratio = (self.value(small, setting, "vertex_error_pixels") /
                     self.value("unit", same_for_unit, "vertex_error_pixels"))
            self.assertTrue(0.1 < ratio < 10, ratio)

    def test_only_digits_and_precision_move_vertices(self):
        for (scene, setting), error in self.values("vertex_error_pixels").items():
            if "--digits" not in setting and "--precision" not in setting:
                self.assertEqual(error, self.value(scene, "default", "vertex_error_pixels"))

    def test_two_layers_need_two_digits_more_for_a_hundred_times_the_range(self):
        # The planes are 1.6e-7, 1.6e-9 and 1.6e-11 or more apart in depth; rounding removes at most one unit
        # of the last decimal.
        for scene, enough, too_few in (("layers 1e2", "default", "--digits 5"),
                                       ("layers 1e4", "--digits 9", "default"), ("layers 1e6", "--digits 12",
                                                                                 "--digits 9")):
            self.assertEqual(self.value(scene, enough, "wrong_pixels"), 0, scene)
            self.assertGreater(self.value(scene, too_few, "wrong_pixels"), 0, scene)

    def test_floats_round_depths_by_half_an_ulp(self):
        # 2^-25 at most below 1, on top of half a unit of the seventh decimal and its effect through the slope
        # in x and y.
        for scene in ("layers 1e2", "layers 1e4", "layers 1e6"):
            error = self.value(scene, "--depth f32", "depth_error_max")
            self.assertTrue(2.0**-25 < error < 2.0**-25 + 6e-8, error)

    def test_pixels_show_the_triangle_at_their_center_where_coverage_is_by_centers(self):
        for scene in dict.fromkeys(scene for scene, _ in self.values("off_center_pixels")):
            self.assertEqual(self.value(scene, "--digits exact --coverage center", "off_center_pixels"), 0)
            covered = self.value(scene, "default", "covered_pixels")
            self.assertGreater(self.value(scene, "--digits exact", "off_center_pixels"), 0.01 * covered)

    def test_the_default_is_one_default(self):
        self.assertEqual({value
                          for key, value in self.values("ratio_q3").items()
                          if key[1] == "default"}, {1})

    def test_the_plot_has_a_title_for_each_panel_and_names_every_setting(self):
        texts = [element.text for element in xml.etree.ElementTree.parse(self.folder / "tradeoff.svg").iter()]
        for words in ("CPU", "Text", "How far vertices move", "Hidden that shows", "Pixels off center"):
            self.assertIn(words, texts)
        self.assertLessEqual(ERROR_SETTINGS, {(words or "").removesuffix(" *") for words in texts})

    def test_smooth_edges_and_light_are_measured(self):
        difference = self.values("difference_mean")
        for scene in ("torus", "inside"):
            row = [difference[scene, f"--samples {count}"]
                   for count in (8, 4, 2)] + [difference[scene, "default"]]
            self.assertEqual(row[0], 0)
            self.assertEqual(row, sorted(row))
            self.assertLess(difference[scene, "default"], difference[scene, "--shading flat"])
        # Dropping triangles that are outside changes no picture.
        for setting in ("--clip near", "--clip frustum", "--clip reject"):
            self.assertLess(abs(difference["torus", setting] - difference["torus", "default"]), 0.2, setting)

    def test_culling_is_measured_on_a_closed_ball(self):
        for rule in ("", " --coverage center"):
            row = self.rows["ball", f"--cull back{rule}"]
            self.assertEqual((row["triangles"], row["channels"]), ("256", str(3 * 60 * 45)))
            # Backs are hidden, but `nearest` draws those at the silhouette up to half a pixel beyond it.
            self.assertEqual(int(row["channels_changed"]) == 0, "center" in rule)

    def test_culling_saves_instructions(self):
        for rule in ("", " --coverage center"):
            row = self.rows["ball", f"--cull back{rule}"]
            if not row["instructions"]:
                self.skipTest(row["counter"])
            plain = self.value("ball", rule.strip() or "default", "instructions")
            self.assertLess(float(row["instructions"]), plain)

    def test_where_half_is_outside_rejecting_it_saves_text(self):
        # Half of the text behind project, one of three; what is cut at the border is written in pieces, and
        # as a whole, too.
        self.assertLess(self.value("half", "--clip reject", "bytes"),
                        0.95 * self.value("half", "default", "bytes"))
        for setting in ("--clip frustum", "--clip reject"):
            self.assertEqual(self.value("ball", setting, "bytes"), self.value("ball", "default", "bytes"))

    def test_depth_epsilon_hides_the_gaps_that_arithmetic_says(self):
        with open(self.folder / "epsilon.csv", newline="") as file:
            rows = {(row["setting"], int(row["distance"])):
                    {key: float(row[key])
                     for key in ("fighting", "swallowed")}
                    for row in csv.DictReader(file)}
        near, far = 1, 1000
        for distance in (5, 50, 500):
            # NDC z = (f + n) / (f - n) - 2 f n / ((f - n) d); a gap g at distance d changes it by 2 f n / (f
            # - n) (1 / (d - g) - 1 / d).
            for words, epsilon in (("--depth-epsilon 1e-5", 1e-5), ("--depth-epsilon 1e-4", 1e-4),
                                   ("--digits exact --depth-epsilon 1e-9", 1e-9)):
                ndc = epsilon * (far - near) / (2 * far * near)
                gap = distance - 1 / (1 / distance + ndc)
                # Strips get nearer by 10 % each, and 7 decimals add at most one unit of the last to the
                # difference.
                rounding = 0 if "exact" in words else 1e-7 / epsilon
                measured = rows[words, distance]["swallowed"]
                self.assertTrue(gap * 0.9 * (1 - rounding) <= measured <= gap * (1 + rounding) * 1.001,
                                (words, distance, gap, measured))
            self.assertEqual(rows["--digits exact", distance]["swallowed"], 0)
            # Two surfaces in one plane fight, whether their vertices are rounded to 7 decimals or to doubles.
            for words in ("default", "--digits exact"):
                self.assertGreater(rows[words, distance]["fighting"], 0.05)
            self.assertEqual(rows["--depth-epsilon 1e-6", distance]["fighting"], 0)

    def test_the_plot_can_be_drawn_again_without_measuring(self):
        plot = (self.folder / "tradeoff.svg").read_text()
        (self.folder / "tradeoff.svg").unlink()
        tradeoff(self.folder, "--redraw")
        self.assertEqual((self.folder / "tradeoff.svg").read_text(), plot)


if __name__ == "__main__":
    unittest.main()
