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


def tradeoff(folder, *options):
    subprocess.run([source / "scripts/measure/tradeoff", "--quick", "--bin", bin_dir, "--out", folder, *options], check=True)


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
        cls.scenes = list(dict.fromkeys(row["scene"] for row in rows))
        cls.settings = list(dict.fromkeys(row["setting"] for row in rows))
        cls.report = (cls.folder / "tradeoff.md").read_text()

    def value(self, scene, setting, column):
        return float(self.rows[scene, setting][column])

    def values(self, column):
        """A column's values by scene and setting, if measured."""
        return {key: float(row[column]) for key, row in self.rows.items() if row[column]}

    def test_every_value_that_the_tools_offer_is_measured(self):
        for tool, option in (("model", "precision"), ("zbuf", "coverage"), ("zbuf", "depth")):
            help_text = subprocess.run([bin_dir / tool, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
            offered = re.search(rf"--{option} (\S+)", help_text)[1].split("|")
            self.assertEqual({row[option] for row in self.rows.values()}, set(offered))

    def test_every_setting_is_in_every_table(self):
        for setting in self.settings:
            name = setting if setting == "default" else f"`{setting}`"
            in_tables = sum(line.startswith(f"| {name} |") for line in self.report.splitlines())
            self.assertGreaterEqual(in_tables, 5, setting)

    def test_every_setting_is_measured_on_every_scene(self):
        self.assertEqual(len(self.rows), len(self.scenes) * len(self.settings))
        self.assertEqual(len(self.values("vertex_error_pixels")), 10 * len(self.settings))
        self.assertEqual(len(self.values("ratio_median")), 4 * len(self.settings))

    def test_every_number_is_one(self):
        names = {"scene", "setting", "digits", "precision", "coverage", "depth", "machine", "runs_seconds"}
        for row in self.rows.values():
            for column in row.keys() - names:
                if row[column]:
                    self.assertTrue(math.isfinite(float(row[column])) and float(row[column]) >= 0, (column, row))

    def test_a_lossless_run_is_right(self):
        for scene in self.scenes:
            for setting in ("--digits exact", "--digits exact --coverage center"):
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
            # In view space half a unit h of the last decimal moves x by cot(20 degrees) / 2.2 h, because nothing is
            # nearer than 2.2, and by h / 2.2 through the distance: 1.71 h. A world vertex moves sqrt(3) h.
            half = 0.5 * 10.0**-digits
            bound = math.hypot(1, 1) * (1 + 1.71 + 1.71 * math.sqrt(3)) * half * SCREEN / 2
            self.assertLess(self.value("unit", setting, "vertex_error_pixels"), bound)
            self.assertGreater(self.value("unit", setting, "vertex_error_pixels"), half / 4 * SCREEN / 2)

    def test_smaller_objects_lose_as_many_digits_as_they_are_smaller(self):
        for small, setting, same_for_unit in (("1e-3", "--digits 9", "--digits 6"), ("1e-5", "--digits 12", "default")):
            ratio = (self.value(small, setting, "vertex_error_pixels") /
                     self.value("unit", same_for_unit, "vertex_error_pixels"))
            self.assertTrue(0.1 < ratio < 10, ratio)

    def test_only_digits_and_precision_move_vertices(self):
        for (scene, setting), error in self.values("vertex_error_pixels").items():
            row = self.rows[scene, setting]
            if row["digits"] == "7" and row["precision"] == "extended":
                self.assertEqual(error, self.value(scene, "default", "vertex_error_pixels"))

    def test_two_layers_need_two_digits_more_for_a_hundred_times_the_range(self):
        # The planes are 1.6e-7, 1.6e-9 and 1.6e-11 or more apart in depth; rounding removes at most one unit of the last
        # decimal.
        for scene, enough, too_few in (("layers 1e2", "default", "--digits 5"), ("layers 1e4", "--digits 9", "default"),
                                       ("layers 1e6", "--digits 12", "--digits 9")):
            self.assertEqual(self.value(scene, enough, "wrong_pixels"), 0, scene)
            self.assertGreater(self.value(scene, too_few, "wrong_pixels"), 0, scene)

    def test_floats_round_depths_by_half_an_ulp(self):
        # 2^-25 at most below 1, on top of half a unit of the seventh decimal and its effect through the slope in x and y.
        for scene in ("layers 1e2", "layers 1e4", "layers 1e6"):
            error = self.value(scene, "--depth f32", "depth_error_max")
            self.assertTrue(2.0**-25 < error < 2.0**-25 + 6e-8, error)

    def test_pixels_show_the_triangle_at_their_center_where_coverage_is_by_centers(self):
        for scene in dict.fromkeys(scene for scene, _ in self.values("off_center_pixels")):
            self.assertEqual(self.value(scene, "--digits exact --coverage center", "off_center_pixels"), 0)
            covered = self.value(scene, "default", "covered_pixels")
            self.assertGreater(self.value(scene, "--digits exact", "off_center_pixels"), 0.01 * covered)

    def test_the_default_is_one_default(self):
        self.assertEqual({value for key, value in self.values("ratio_max").items() if key[1] == "default"}, {1})

    def test_the_plot_has_a_title_for_each_panel_and_names_every_setting(self):
        texts = [element.text for element in xml.etree.ElementTree.parse(self.folder / "tradeoff.svg").iter()]
        for words in ("How far vertices move", "How much hidden shows", "How true edges are",
                      "7 (default)", "5", "6", "9", "12", "exact", "double", "center", "f32"):
            self.assertIn(words, texts)

    def test_smooth_edges_and_light_are_measured(self):
        with open(self.folder / "lighting.csv", newline="") as file:
            difference = {(row["scene"], row["setting"]): float(row["difference_mean"]) for row in csv.DictReader(file)}
        for scene in ("shaded-torus", "inside"):
            row = [difference[scene, f"--samples {count}"] for count in (8, 4, 2)] + [difference[scene, "default"]]
            self.assertEqual(row[0], 0)
            self.assertEqual(row, sorted(row))
            self.assertLess(difference[scene, "default"], difference[scene, "--shading flat"])
        # Dropping triangles that are outside changes no picture.
        for setting in ("--clip near", "--clip frustum", "--clip reject"):
            self.assertLess(abs(difference["shaded-torus", setting] - difference["shaded-torus", "default"]), 0.2, setting)

    def test_culling_is_measured_on_a_closed_ball(self):
        with open(self.folder / "culling.csv", newline="") as file:
            rows = {row["coverage"]: row for row in csv.DictReader(file)}
        for row in rows.values():
            self.assertEqual((row["triangles"], row["channels"]), ("256", str(3 * 60 * 45)))
            for tool in ("project", "zbuf"):
                if row.get(f"{tool}_instructions"):
                    self.assertLess(int(row[f"{tool}_instructions_culled"]), int(row[f"{tool}_instructions"]))
        # Backs are hidden, but `nearest` draws those at the silhouette up to half a pixel beyond it.
        self.assertEqual(rows["center"]["channels_changed"], "0")
        self.assertGreater(int(rows["nearest"]["channels_changed"]), 0)
        self.assertIn(f"{int(rows['nearest']['channels_changed']):,} of 8,100 |", (self.folder / "lighting.md").read_text())

    def test_tables_and_plot_can_be_drawn_again_without_measuring(self):
        plot = (self.folder / "tradeoff.svg").read_text()
        (self.folder / "tradeoff.md").unlink()
        (self.folder / "tradeoff.svg").unlink()
        tradeoff(self.folder, "--redraw")
        self.assertEqual((self.folder / "tradeoff.md").read_text(), self.report)
        self.assertEqual((self.folder / "tradeoff.svg").read_text(), plot)


if __name__ == "__main__":
    unittest.main()
