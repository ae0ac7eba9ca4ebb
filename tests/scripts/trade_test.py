#!/usr/bin/env python3
"""scripts/trade: what it measures is what arithmetic says, and the command line it names gives the picture it
promises. No claim depends on time.

usage: trade_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import subprocess
import unittest
import xml.etree.ElementTree

from lib.running.owners import NOBODY
from lib.running.pipe import DEFAULT, Pipe, Setting
from lib.running.pipe_tools import Tools, without_inner_location
from lib.showing.figures import Quartiles
from toolbox import BIN, CAMERA, SOURCE, ToolTest, pipe, run
from trade_parts.choice import Choice, Limits, Row, cheapest, least_wrong, steady
from trade_parts.levers import settings
from trade_parts.losses import Loss
from trade_parts.report import about_pixels, about_ties, about_times
from trade_parts.timing import (AGAIN, CHEAPER, DEARER, EMPTY, TIE, UNTOLD, Counts, Times, median_interval)

LEAST = {
    "--digits 5", "default", "--digits 9", "--digits 12", "--digits exact", "--precision double",
    "--depth f32", "--depth u24"}  # what every scene feels
CERTIFIED = "--digits 12 --certify -"
# Two walls 1e-6 apart, the hidden one first, seen from 3 away: in NDC their z differ by 2e-8 or so, less than
# seven digits tell.
LAYERS = "0 0 3\n0 0 0\n0 1 0\n60 1 0.1 100\n" + "".join(f"triangle\n-1 -1 {z}\n1 -1 {z}\n0 1 {z}\n"
                                                         for z in ("0", "0.000001")) + "end\n"


def trade(*words, **settings):
    return subprocess.run([SOURCE / "scripts/trade", *words], capture_output=True, text=True,
                          timeout=120, env={
                              "BIN": str(BIN), "PATH": f"{BIN}:/usr/bin:/bin", "LANG": "C.UTF-8"}, **settings)


def tables(text):
    """{coverage, or rays: {setting: {column: cell}}}"""
    found, header = {}, None
    for line in text.split("\n"):
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if cells[1:2] == ["net"]:
            header = cells
            rows = found.setdefault(cells[0].split()[-1], {})
        elif line.startswith("| ") and set(cells[0]) != {"-"}:
            rows[cells[0]] = dict(zip(header, cells))
    return found


def command_line(text):
    return text.rstrip("\n").split("\n")[-1].strip()


def picture(line):
    subprocess.run(["bash", "-c", line], check=True, env={"PATH": f"{BIN}:/usr/bin:/bin"},
                   capture_output=True)
    return pathlib.Path("out.bmp").read_bytes()


class Measures(ToolTest):
    def test_a_scene_that_feels_no_other_lever_is_measured_with_the_least(self):
        done = trade("scene.txt", "config.txt", "--rounds", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = tables(done.stdout)
        self.assertEqual({rule: set(rows)
                          for rule, rows in found.items()},
                         {"center": LEAST | {CERTIFIED}, "nearest": {"default", "--digits exact"}})
        self.assertEqual(found["center"]["--digits exact"]["wrong pixels"], "0")
        self.assertEqual(found["center"][CERTIFIED]["wrong pixels"], "0")
        self.assertGreater(float(found["center"][CERTIFIED]["CPU"].split()[0]), 0)

    def test_every_lever_that_is_felt_has_a_row(self):
        """A lit open tent that the right plane cuts, its back and a wall behind it that an epsilon hides."""
        triangles = [[(0, -1, 0), (1, -1, -1), (0, 1, 0)], [(0, -1, 0), (0, 1, 0), (-1, -1, -1)],
                     [(1, 0, 0), (9, 0, 0), (9, 1, 0)], [(9, 0, 0), (9, 1, 0), (9, 0, -1)],
                     *([(-3, -1, z), (2, -1, z), (0.5, 2, z)] for z in (-2, -1.999995)),
                     [(0, 0.5, 0.5), (0, 1, 0.5), (0.5, 0.5, 0.5)]]
        pathlib.Path(
            "scene.txt").write_text("0 0 3\n0 0 0\n0 1 0\n60 1 1 10\nlight 1 2 3 1 1 1\nattributes normal\n" +
                                    "".join("triangle\n" + "".join(f"{x} {y} {z} {x} {y} 1\n"
                                                                   for x, y, z in corners)
                                            for corners in triangles) + "end\n")
        done = trade("scene.txt", "config.txt", "--rounds", "1", "--all")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        found = tables(done.stdout)
        self.assertEqual(
            set(found["center"]), LEAST | {
                "--clip frustum", "--clip reject", "--cull back", "--clip reject --cull back",
                "--depth-epsilon 1e-6", "--shading flat", "--shading gouraud", "--samples 2", CERTIFIED})
        self.assertEqual(set(found["rays"]),
                         {f"trace --sampling {name}"
                          for name in ("basic", "jittered", "adaptive")})
        lines = done.stdout.split("\n\nThe simplest")[0].splitlines()
        self.assertLessEqual((max(map(len, lines)), sum(map(len, found.values()))), (80, 22))

    def test_levels_are_the_mean_of_what_colors_differ_by(self):
        sample = SOURCE / "samples/shaded-torus"
        shown = {}
        for words in ("", "--shading flat"):
            exact = ["--digits", "exact"] * (not words)
            text = pipe(["model", *exact, sample / "scene.txt"], ["view", *exact], ["project", *exact])
            run("zbuf", sample / "config.txt", "--coverage", "center", *words.split(), "-o", "out.ppm",
                "--z-buffer", "z.txt", stdin=text)
            shown[words] = pathlib.Path("out.ppm").read_bytes().split(b"255\n", 1)[1]
        self.assertEqual(len(set(map(len, shown.values()))), 1)
        done = trade(sample / "scene.txt", sample / "config.txt", "--rounds", "1")
        covered = int(re.search(r"covers (\d+) pixels", done.stdout)[1])
        total = sum(abs(a - b) for a, b in zip(*shown.values()))
        rows = tables(done.stdout)["center"]
        self.assertEqual(rows["--shading flat"]["levels"], f"{total / covered / 3:.2f}")
        self.assertEqual(rows["--digits exact"]["levels"], "0.00")

    def test_every_pixel_that_differs_from_the_exact_picture_is_wrong(self):
        """Of two triangles that share an edge, `nearest` shows the other one in some pixels."""
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n-1 -1 0\n1 -0.9 0\n0.9 1 0\n"
                                             "triangle\n-1 -1 0\n0.9 1 0\n-0.9 0.8 0\nend\n")
        pathlib.Path("config.txt").write_text("50 40\n")
        shown = {}
        for rule in ("nearest", "center"):
            text = pipe(["model", "--digits", "exact", "scene.txt"], ["view", "--digits", "exact"],
                        ["project", "--digits", "exact"])
            run("zbuf", "config.txt", "--coverage", rule, "-o", "out.ppm", "--z-buffer", "none", stdin=text)
            body = pathlib.Path("out.ppm").read_bytes().split(b"255\n", 1)[1]
            shown[rule] = [body[i:i + 3] for i in range(0, len(body), 3)]
        differing = sum(a != b for a, b in zip(shown["nearest"], shown["center"]))
        self.assertGreater(differing, 20)
        rows = tables(trade("scene.txt", "config.txt", "--rounds", "1").stdout)
        self.assertEqual(rows["nearest"]["--digits exact"]["wrong pixels"].split()[0], str(differing))
        rows = tables(trade("scene.txt", "config.txt", "--rounds", "1", "--rule", "nearest").stdout)
        self.assertEqual((rows.keys(), rows["nearest"]["--digits exact"]["wrong pixels"]), ({"nearest"}, "0"))

    def test_bytes_are_those_of_the_three_texts(self):
        texts = [pathlib.Path("scene.txt").read_bytes()]
        for tool in ("model", "view", "project"):
            texts.append(pipe([tool], stdin=texts[-1]))
        done = trade("scene.txt", "config.txt", "--rounds", "1", "--rule", "nearest")
        self.assertIn(
            f"\ndefault: 1.00 times the default's CPU time, {sum(map(len, texts[1:]))} B in the pipes,\n",
            done.stdout)

    def test_the_gap_is_what_one_step_of_the_depth_is_worth(self):
        """Dz at the distance w is a gap of w^2 Dz (far - near) / (2 far near): 9 Dz 9 / 20 here. A parallel
        projection has (far - near) / 2, and u24 has (rear - front) / 2^24 beside the digits."""
        walls = "triangle\n-1 -1 0\n1 -1 0\n0 1 0\nend\n"
        for camera, per_step in (("60 1 1 10", 4.05), ("ortho -2 2 -2 2 1 10", 4.5)):
            pathlib.Path("scene.txt").write_text(f"0 0 3\n0 0 0\n0 1 0\n{camera}\n{walls}")
            rows = tables(trade("scene.txt", "config.txt", "--rounds", "1").stdout)["center"]
            for name, step in (("--digits 5", 1e-5), ("default", 1e-7), ("--digits 9", 1e-9),
                               ("--depth u24", 1e-7 + 2 / 2**24)):
                gap = per_step * step
                self.assertAlmostEqual(float(rows[name]["gap"]), gap, delta=0.015 * gap)

    def test_layers_that_seven_digits_cannot_tell_apart_take_nine(self):
        pathlib.Path("scene.txt").write_text(LAYERS)
        pathlib.Path("config.txt").write_text("40 40\n")
        done = trade("scene.txt", "config.txt", "--rounds", "1")
        rows = tables(done.stdout)["center"]
        covered = re.search(r"covers (\d+) pixels", done.stdout)[1]
        self.assertEqual(rows["default"]["wrong pixels"], f"{covered}/{covered} (100 %)")
        self.assertEqual([rows[name]["wrong pixels"] for name in ("--digits 9", "--digits 12")], ["0"] * 2)
        self.assertLess(float(rows["--digits 9"]["gap"]), 1e-6)  # which is between the layers
        self.assertLess(1e-6, float(rows["default"]["gap"]))

    def test_scenes_that_are_clipped_or_lit_are_compared_by_triangle(self):
        for name in ("wide-clipped", "inside", "colored-lights"):
            done = trade(SOURCE / f"samples/{name}/scene.txt", SOURCE / f"samples/{name}/config.txt",
                         "--rounds", "1")
            self.assertEqual(done.returncode, 0, name)
            rows = tables(done.stdout)["center"]
            self.assertEqual(rows["--digits 12"]["wrong pixels"], "0", name)
            self.assertIn("--clip frustum", rows, name)
            self.assertEqual(
                "trade: note: --clip reject --coverage center is left out: project: expected a "
                "vertex in front" in done.stderr, "--clip reject" not in rows, name)

    def test_options_of_project_are_passed_on(self):
        backs = trade("scene.txt", "config.txt", "--rounds", "1", "--cull", "front")
        self.assertEqual(backs.returncode, 2)
        self.assertIn("trade: the picture of the exact run is empty", backs.stderr)
        fronts = trade("scene.txt", "config.txt", "--rounds", "1", "--cull", "back", "--clip", "none")
        self.assertRegex(fronts.stdout, r"\| pipeline project .*--clip none --cull back \|")
        self.assertEqual(set(tables(fronts.stdout)["center"]), LEAST)


class Answers(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("scene.txt").write_text(LAYERS)
        pathlib.Path("config.txt").write_text("40 40\n")

    def test_the_command_line_gives_the_lossless_picture(self):
        for rule in ("nearest", "center"):
            done = trade("scene.txt", "config.txt", "--rounds", "1", "--rule", rule)
            self.assertEqual(done.returncode, 0)
            self.assertIn("The simplest with 0 wrong pixels:\n", done.stdout)  # one round tells nothing
            exact = " | ".join(f"{tool} --digits exact" for tool in ("model scene.txt", "view", "project"))
            lossless, default = (picture(f"{words} | zbuf --coverage {rule} config.txt > z.txt")
                                 for words in (exact, "model scene.txt | view | project"))
            self.assertEqual(picture(command_line(done.stdout)), lossless)
            self.assertNotEqual(default, lossless)

    def test_what_is_right_by_luck_is_not_named(self):
        sample = SOURCE / "samples/two-walls"
        done = trade(sample / "scene.txt", sample / "config.txt", "--rounds", "1")
        self.assertEqual(tables(done.stdout)["center"]["--digits 9"]["wrong pixels"], "0")
        self.assertIn("\n--digits 9 --coverage center: 787 wrong with the eye moved a little\n", done.stdout)
        self.assertIn("pipeline model --digits 12 ", command_line(done.stdout))

    def test_files_with_odd_names_and_standard_input_are_named_as_given(self):
        os.rename("scene.txt", "my scene's.txt")
        done = trade("my scene's.txt", "config.txt", "--rounds", "1", "--max-wrong", "100%")
        self.assertTrue(picture(command_line(done.stdout)))
        done = trade("-", "config.txt", "--rounds", "1", "--max-wrong", "100", input=LAYERS)
        self.assertTrue(picture(f"cat 'my scene'\"'\"s.txt | ({command_line(done.stdout)})"))

    def test_if_no_setting_will_do_the_nearest_is_named(self):
        done = trade("scene.txt", "config.txt", "--rounds", "1", "--max-wrong", "0", "--max-cpu", "0.001")
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertIn(
            "No setting has 0 wrong pixels and at most 0.001 times the default's CPU time. The nearest is\n",
            done.stdout)
        self.assertTrue(picture(command_line(done.stdout)))

    def test_the_plot_names_every_setting(self):
        trade("scene.txt", "config.txt", "--rounds", "1", "--max-cpu", "3", "--plot", "plot.svg")
        texts = [
            element.text
            for element in xml.etree.ElementTree.parse("plot.svg").iter("{http://www.w3.org/2000/svg}text")]
        self.assertLessEqual({"default", "--digits exact --coverage center", "--coverage center --depth u24"},
                             set(texts))


class Mistakes(ToolTest):
    def check(self, message, *words, status=2):
        done = trade(*words)
        self.assertEqual((done.returncode, done.stdout), (status, ""))
        self.assertEqual(done.stderr.split("\n")[-2], message)

    def test_those_of_a_scene_and_of_a_config_are_the_tools_own(self):
        pathlib.Path("bad.txt").write_text(CAMERA + "triangle\n0 0 0\n1 0 x\n0 1 0\nend\n")
        self.check("trade: model: bad.txt:7:5: expected the z of vertex 2 of 3, found 'x'", "bad.txt",
                   "config.txt")
        pathlib.Path("size.txt").write_text("0 8\n")
        done = run("zbuf", "size.txt")
        self.check("trade: " + done.stderr.decode().strip(), "scene.txt", "size.txt")
        self.check("trade: cannot read none.txt: No such file or directory", "none.txt", "config.txt")

    def test_a_sphere_is_the_scenes_and_names_the_ways_to_draw_it(self):
        scene = LAYERS.replace("end\n", "sphere 0 0 0 1\nend\n")
        pathlib.Path("scene.txt").write_text(scene)
        message = (":13:1: expected triangles alone, found a sphere: trace draws it, and model --facets N "
                   "makes triangles of it\n")
        done = trade("scene.txt", "config.txt")
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (2, "", "trade: model: scene.txt" + message))
        done = trade("-", "config.txt", input=scene)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (2, "", "trade: model: <stdin>" + message))

    def test_an_empty_picture_has_nothing_to_compare(self):
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n0 0 9\n1 0 9\n0 1 9\nend\n")
        self.check(
            "trade: the picture of the exact run is empty: there is nothing to compare. Run the pipe "
            "to see why", "scene.txt", "config.txt")

    def test_limits_are_numbers(self):
        for option, word, expected in (("--max-wrong", "-1", "a number of at least 0"),
                                       ("--max-cpu", "0", "a number greater than 0"),
                                       ("--max-wrong", "nan", "a number of at least 0"),
                                       ("--rounds", "0", "a whole number from 1 to 1000000")):
            self.check(f"trade: argument {option}: expected {expected}, found '{word}' (try trade --help)",
                       "scene.txt", "config.txt", f"{option}={word}")

    def test_a_plot_that_cannot_be_written_is_named(self):
        done = trade("scene.txt", "config.txt", "--rounds", "1", "--plot", "none/plot.svg")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "trade: cannot open none/plot.svg: No such file or directory\n"))


class Owners(ToolTest):
    def test_they_are_the_triangles_whose_colors_zbuf_shows(self):
        """zbuf gives triangle N draws 3N, 3N + 1 and 3N + 2 of the course's generator."""
        state, colors = 1, {bytes(3): NOBODY}
        sample = SOURCE / "samples/torus"
        for number in range((sample / "scene.txt").read_text().count("triangle")):
            color = []
            for _ in range(3):
                state = (214013 * state + 2531011) % 2**32
                color.append((state >> 16 & 0x7fff) % 256)
            colors.setdefault(bytes(color), number)
        for rule in ("nearest", "center"):
            text = pipe(["model", sample / "scene.txt"], ["view"], ["project"])
            run("zbuf", sample / "config.txt", "--coverage", rule, "-o", "out.ppm", "--z-buffer", "none",
                stdin=text)
            shown = pathlib.Path("out.ppm").read_bytes().split(b"255\n", 1)[1]
            owners = Pipe(Tools(BIN), sample / "scene.txt", sample / "config.txt", [], ".").owners(
                Setting(coverage=rule))
            self.assertGreater(len(set(owners)), 500)
            self.assertEqual([colors[shown[i:i + 3]] for i in range(0, len(shown), 3)], list(owners))


def row(setting=DEFAULT, ratio=1, wrong=0):
    return Row(setting, Quartiles(ratio, ratio, ratio), ratio, ratio, 100, Loss(wrong, 1e-7, None), 1000)


def verdict_of(**told):
    """For cheapest: by what `told` has for "a_b", where a and b are digits; DEARER for others."""
    return lambda a, b: told.get(f"of_{a.digits}_{b.digits}", DEARER)


class Choices(unittest.TestCase):
    five, seven, nine = row(Setting("5"), 0.8, 50), row(wrong=2), row(Setting("9"), 3)
    rows = [five, seven, nine]

    def test_limits_hold_to_the_last_pixel(self):
        self.assertTrue(Limits(percent_wrong=0.2).are_met_by(row(wrong=2)))
        self.assertFalse(Limits(percent_wrong=0.19).are_met_by(row(wrong=2)))
        self.assertFalse(Limits(percent_wrong=0).are_met_by(row(wrong=1)))
        self.assertTrue(Limits(ratio=3).are_met_by(self.nine))
        self.assertFalse(Limits(percent_wrong=0, ratio=2.99).are_met_by(self.nine))

    def test_without_a_limit_of_wrong_pixels_the_fewest_are_asked_for(self):
        self.assertEqual(least_wrong(self.rows, Limits()).percent_wrong, 0)
        self.assertEqual(least_wrong(self.rows, Limits(ratio=2)).percent_wrong, 0.2)
        self.assertIsNone(least_wrong(self.rows, Limits(ratio=0.1)).percent_wrong)
        self.assertEqual(least_wrong(self.rows, Limits(percent_wrong=7)).percent_wrong, 7)

    def test_the_default_gives_way_only_to_what_is_cheaper(self):
        self.assertEqual(cheapest(self.rows, verdict_of(of_5_7=CHEAPER)), Choice(self.five))
        self.assertEqual(cheapest(self.rows, verdict_of(of_5_7=TIE)), Choice(self.seven, ties=(self.five,)))
        self.assertEqual(cheapest(self.rows, verdict_of()), Choice(self.seven))

    def test_if_a_cheaper_one_cannot_be_told_the_simplest_is_named_and_no_other(self):
        self.assertEqual(cheapest(self.rows, verdict_of(of_5_7=UNTOLD)),
                         Choice(self.seven, untold=(self.five,)))
        # Had 5 been told cheaper than 7, it would stand against 9 now: both may be the answer.
        self.assertEqual(cheapest(self.rows, verdict_of(of_5_7=UNTOLD, of_9_7=CHEAPER)),
                         Choice(self.seven, untold=(self.five, self.nine)))
        # Whether 5 is cheaper than 7 does not matter where 9 is cheaper than both.
        self.assertEqual(cheapest(self.rows, verdict_of(of_5_7=UNTOLD, of_9_7=CHEAPER, of_9_5=CHEAPER)),
                         Choice(self.nine))

    def test_a_setting_that_is_right_by_luck_is_not_chosen(self):
        wrong = {self.five.setting: 787, self.seven.setting: 2, self.nine.setting: 0}
        chosen = steady([self.five, self.seven, self.nine], verdict_of(of_5_7=CHEAPER),
                        Limits(percent_wrong=0), wrong.get)
        self.assertEqual(chosen, Choice(self.nine, lucky=((self.five, 787), (self.seven, 2))))
        self.assertIn("\n--digits 5: 787 wrong with the eye moved a little\n", about_pixels(chosen))
        self.assertIsNone(steady([self.five], verdict_of(), Limits(percent_wrong=0), wrong.get))

    def test_the_answer_tells_of_ties_and_of_a_busy_machine(self):
        self.assertEqual(about_ties(Choice(self.seven)), "")
        self.assertEqual(
            about_ties(Choice(self.seven, ties=(self.five,))),
            "\nThese cost the same, as far as anybody notices; this is the simplest:"
            "\n    --digits 5")
        self.assertIn("\nThe cheapest is unknown (busy machine, or too few rounds): this is the simplest.\n",
                      about_ties(Choice(self.seven, untold=(self.five,))))


class Clock(unittest.TestCase):
    """On recorded times: eight rounds, the second of which another program slows down."""
    load = (1.0, 3.0, 1.0, 1.1, 1.0, 0.9, 1.0, 1.05)

    def times(self, five, again=(1.0,) * 8, default=2.0):
        return Times({
            EMPTY: [1.0] * 8, DEFAULT: [default * x for x in self.load], AGAIN: [
                default * x * y for x, y in zip(self.load, again)],
            Setting("5"): [default * x * y for x, y in zip(self.load, five)]})

    def verdict(self, five, again=(1.0,) * 8):
        return self.times(five, again).verdict(Setting("5"), DEFAULT)

    def test_the_median_lies_between_order_statistics_in_99_of_100_samples(self):
        self.assertEqual(median_interval([3, 1, 2, 4, 5, 6, 7]), (0, float("inf")))  # 2 of 2^7 are outside
        self.assertEqual(median_interval([3, 1, 2, 4, 5, 6, 7, 8]), (1, 8))  # 2 of 2^8
        self.assertEqual(median_interval(range(1, 12)), (1, 11))  # (1 + 11) 2 of 2^11 would be 1.2 %
        self.assertEqual(median_interval(range(1, 13)), (2, 11))  # (1 + 12) 2 of 2^12 are 0.6 %

    def test_load_that_slows_a_round_does_not_count(self):
        self.assertEqual(self.verdict((0.8,) * 8), CHEAPER)
        self.assertEqual(self.verdict((1.0,) * 8), TIE)
        self.assertEqual(self.verdict((0.95,) * 8), TIE)
        self.assertEqual(self.verdict((1.3,) * 8), DEARER)

    def test_a_setting_that_is_cheaper_in_every_round_is_cheaper(self):
        """By a sign test: of eight rounds, all; by how much does not matter beyond the median."""
        self.assertEqual(self.verdict((0.73, 0.99, 0.6, 0.73, 0.5, 0.73, 0.98, 0.7)), CHEAPER)
        self.assertEqual(self.verdict((0.73, 1.01, 0.6, 0.73, 0.5, 0.73, 0.98, 0.7)), UNTOLD)
        self.assertEqual(self.verdict((0.73, 1.2, 1.1, 1.3, 0.8, 1.1, 1.2, 1.1)), TIE)

    def test_counts_are_compared_as_they_are(self):
        counts = Counts({EMPTY: 50, DEFAULT: 100,
                         Setting("5"): 89,
                         Setting("9"): 91,
                         Setting("12"): 101}, "bytes")
        self.assertEqual([counts.verdict(Setting(digits), DEFAULT) for digits in ("5", "9", "12")],
                         [CHEAPER, TIE, DEARER])
        self.assertEqual((counts.ratio(Setting("5")), counts.net(Setting("5"))), (0.89, 0.78))

    def test_a_run_that_hardly_takes_longer_than_starting_is_too_short(self):
        for default, is_too_short in ((1.1, True), (2.0, False)):
            times = self.times((1.0,) * 8, default=default)
            self.assertEqual((times.are_too_short, "tell nothing" in about_times(times)),
                             (is_too_short, is_too_short), default)


class Notes(unittest.TestCase):
    def test_the_line_of_a_text_that_the_user_never_sees_is_left_out(self):
        uncertain = "and of 2 more are not certain: numbers cancel here, and 31 digits are too few"
        self.assertEqual(
            without_inner_location(
                f"view: note: /tmp/x/model --digits exact.txt:4:1: the digits of this vertex {uncertain}",
                "/tmp/x"), f"view: note: the digits of a vertex {uncertain}")
        for note in (f"model: note: scene.txt:4:1: the digits of this vertex {uncertain}",
                     "zbuf: note: the picture is empty: no triangle came"):
            self.assertEqual(without_inner_location(note, "/tmp/x"), note)


class CommandLines(unittest.TestCase):
    def test_only_what_differs_from_the_default_is_written(self):
        pipeline = Pipe(None, "s", "c", ["--cull", "back"], ".")
        self.assertEqual(
            pipeline.command_line(Setting("9", "double", coverage="center", depth="f32"), "-a b", "-c"),
            "pipeline model --digits 9 --precision double -- '-a b' | pipeline view --digits 9 "
            "--precision double"
            " | pipeline project --digits 9 --precision double --cull back"
            " | pipeline zbuf --coverage center --depth f32 -- -c > z_buffer.txt")
        self.assertEqual(
            pipeline.command_line(DEFAULT, "-", "c"),
            "pipeline model | pipeline view | pipeline project --cull back | pipeline zbuf c > z_buffer.txt")

    def test_a_lever_that_the_user_has_set_is_not_tried(self):
        tried = {str(setting) for setting in settings("nearest", without=["clip", "cull"])}
        self.assertEqual([name for name in tried if "clip" in name or "cull" in name], [])


if __name__ == "__main__":
    unittest.main()
