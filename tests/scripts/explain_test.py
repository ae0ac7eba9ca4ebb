#!/usr/bin/env python3
"""scripts/explain: its numbers match the sample files, the tools and exact references, and its words the case
at hand.

usage: explain_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import os
import pathlib
import random
import unittest
from fractions import Fraction
from types import SimpleNamespace

from lib.explaining.calculation import Calculation, agrees
from lib.explaining.stages import Settings, Stages
from lib.maths.window import PixelOfTriangle, Window
from lib.running.pipe_tools import Tools
from lib.text.scene import find_triangle
from sample_files import sample_file
from toolbox import BIN, CAMERA, SOURCE, ToolTest, run, run_script, tools_with

SAMPLES = sorted(scene.parent for scene in SOURCE.glob("samples/*/scene.txt"))
MAX_LINES = 60


def explain(*words, stdin=None, **settings):
    return run_script("explain", *words, input=stdin, **settings)


def coordinates(report, section):
    """The words of the three coordinates that a section of a report ends its vertex lines with, before the
    window's."""
    lines = report[report.index(section):].split("\n\n")[0].split("\n")
    rows = [line.split() for line in lines if line.startswith("  ")]
    rows = [row for row in rows if len(row[0]) == 1 and len(row) > 3 and "=" not in row and "|" not in row]
    if section == "DIVIDE":
        return [row[1:4] for row in rows]
    return [row[-3:] for row in rows]


def triangles_of(text):
    """{number: the words of its pieces' vertices} of a stage text."""
    found, number, passed_over, vertices = {}, 0, 0, []
    for line in text.decode().splitlines():
        words = line.split()
        if passed_over:
            passed_over -= 1
        elif words and words[0] == "triangle":
            number = int(words[1])
        elif words and words[0] == "clipped":
            passed_over = 3
        elif words and not words[0][0].isalpha():
            vertices.append(words[:3])
            if len(vertices) == 3:
                found.setdefault(number, []).append(vertices)
                number, vertices = number + 1, []
    return found


class Samples(ToolTest):
    def test_reports_have_the_coordinates_of_the_committed_files(self):
        self.assertGreaterEqual(len(SAMPLES), 11)
        choice = random.Random(19)
        for sample in SAMPLES:
            world, view, ndc = (triangles_of(sample_file(BIN, sample, f"stage{n}.txt")) for n in (1, 2, 3))
            for number in {0, len(world) - 1, choice.randrange(len(world))}:
                with self.subTest(sample=sample.name, triangle=number):
                    done = explain(sample / "scene.txt", sample / "config.txt", "--triangle", number)
                    self.assertEqual((done.stderr, done.returncode), ("", 0))
                    self.assertNotIn("exact arithmetic", done.stdout)
                    self.assertEqual(coordinates(done.stdout, "MODEL"), world[number][0])
                    self.assertEqual(coordinates(done.stdout, "VIEW"), view[number][0])
                    pieces = ndc.get(number, [])
                    printed = coordinates(done.stdout, "DIVIDE") if pieces else []
                    fan = [vertex for i, piece in enumerate(pieces) for vertex in (piece[2:] if i else piece)]
                    self.assertEqual(printed, fan)

    def test_reports_are_short_and_name_the_triangle_that_is_seen(self):
        choice = random.Random(20)
        for sample in SAMPLES:
            window = Window((sample / "config.txt").read_text())
            stage3 = sample_file(BIN, sample, "stage3.txt")
            for coverage in ("nearest", "center"):
                pixel = f"{choice.randrange(window.width)},{choice.randrange(window.height)}"
                with self.subTest(sample=sample.name, coverage=coverage, pixel=pixel):
                    probed = run("zbuf", "--coverage", coverage, "--probe", pixel, sample / "config.txt",
                                 stdin=stage3).stderr.decode()
                    kept = [
                        line.split()[3].rstrip(",") for line in probed.splitlines()
                        if line.endswith(": kept")]
                    done = explain(sample / "scene.txt", sample / "config.txt", "--triangle",
                                   kept[-1] if kept else 0, "--pixel", pixel, "--coverage", coverage)
                    self.assertEqual((done.stderr, done.returncode), ("", 0))
                    self.assertLessEqual(done.stdout.count("\n"), MAX_LINES)
                    self.assertIn(
                        f"the pixel shows triangle {kept[-1]}\n" if kept else "shows the background\n",
                        done.stdout)
                    self.assertNotIn("zbuf itself", done.stdout)


class Words(ToolTest):
    """What a report says of a triangle whose case is known."""
    def report(self, commands, *words, config="8 8\n", camera=CAMERA):
        pathlib.Path("scene.txt").write_text(camera + commands + "end\n")
        pathlib.Path("config.txt").write_text(config)
        done = explain("scene.txt", "config.txt", *words)
        self.assertEqual((done.stderr, done.returncode), ("", 0))
        self.assertLessEqual(done.stdout.count("\n"), MAX_LINES)
        self.assertNotIn("exact arithmetic", done.stdout)
        self.assertNotIn("itself", done.stdout)
        return done.stdout

    # In NDC what it is in the scene, but for the sign of z. In 8 x 8 pixels centers are at -0.875, -0.625,
    # ...
    FLAT = "0 0 0\n0 0 -1\n0 1 0\northo -1 1 -1 1 -1 1\n"
    # Corners at the centers of the pixels (1, 6), (5, 6) and (1, 2).
    ON_CENTERS = "triangle\n-0.625 -0.625 0\n0.375 -0.625 0\n-0.625 0.375 0\n"

    def on_centers(self, pixel, rule="center"):
        return self.report(self.ON_CENTERS, "--triangle", 0, "--pixel", pixel, "--coverage", rule,
                           camera=self.FLAT)

    def test_the_window_has_pixel_centers_at_whole_numbers(self):
        report = self.on_centers("2,5")
        self.assertIn(
            "  0  -0.6250000  -0.6250000  0.0000000  ->  1.0000  6.0000\n"
            "  1   0.3750000  -0.6250000  0.0000000  ->  5.0000  6.0000\n"
            "  2  -0.6250000   0.3750000  0.0000000  ->  1.0000  2.0000\n"
            "  area 8.00 pixels, counterclockwise: this is its front\n", report)

    def test_distances_are_those_of_the_center_in_pixels(self):
        self.assertIn(
            "  edge 0-1   1.0000 pixels inside a bottom edge\n"
            "  edge 1-2   1.4142 pixels inside a right edge\n"
            "  edge 2-0   1.0000 pixels inside a left edge\n"
            "  covered: the center is inside\n"
            "  depth = 0.5000 z0 + 0.2500 z1 + 0.2500 z2 = 0.0000000000\n", self.on_centers("2,5"))

    def test_a_center_on_a_right_edge_is_not_owned(self):
        report = self.on_centers("3,4")
        self.assertIn("  edge 1-2   exactly on a right edge: not owned\n", report)
        self.assertIn("  not covered: points on a right edge belong to the triangle beyond it\n", report)
        self.assertIn("no triangle covers this pixel: it shows the background\n", report)

    def test_a_background_with_an_alpha_is_no_obstacle(self):
        pathlib.Path("config.txt").write_text("8 8\n")
        triangle = "triangle\n-1 -1 0\n1 -1 0\n0 1 0\nend\n"
        reports = []
        for alpha in ("", " 0"):
            pathlib.Path("scene.txt").write_text(CAMERA + f"background 1 2 3{alpha}\n" + triangle)
            done = explain("scene.txt", "config.txt", "--triangle", "0", "--pixel", "4,4")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            reports.append(done.stdout)
        self.assertEqual(*reports)

    def test_a_center_on_a_left_edge_is_owned(self):
        report = self.on_centers("1,4")
        self.assertIn("  edge 2-0   exactly on a left edge: owned\n", report)
        self.assertIn("  covered: points on left and top edges belong to the triangle\n", report)

    def test_a_center_outside_says_which_edge(self):
        report = self.on_centers("4,4")
        self.assertIn("  edge 1-2   0.7071 pixels outside a right edge\n", report)
        self.assertIn("  not covered: the center is outside edge 1-2\n", report)

    def test_the_rule_nearest_shows_the_ends_of_the_row(self):
        report = self.on_centers("3,4", "nearest")
        self.assertIn("  edge 1-2   exactly on a right edge\n", report)
        self.assertIn(
            "  row 4 crosses it from column 1.0000 to 3.0000: pixels 1 to 3 are nearest\n  covered: 3 is one "
            "of these\n", report)
        self.assertIn("  not covered: 4 is right of these\n", self.on_centers("4,4", "nearest"))
        self.assertIn("  not covered: the line through the centers of row 1 does not cross the triangle\n",
                      self.on_centers("4,1", "nearest"))

    def test_doubles_that_round_a_tie_the_other_way_are_shown(self):
        # 0.5 is halfway between 0.45 and 0.55, the centers of columns 14 and 15; in doubles it is nearer to
        # the first.
        report = self.report("triangle\n0 0 0\n0.5 0 0\n0.5 0.5 0\n", "--triangle", 0, "--pixel", "15,5",
                             config="20 20\n", camera=self.FLAT)
        self.assertIn(
            "  row 5 crosses it from column 14.0000 to 14.5000: pixels 14 to 15 are nearest\n"
            "  in doubles, as zbuf calculates, from 13.999999999999998 to 14.499999999999998: pixels "
            "14 to 14\n"
            "  not covered: 15 is right of these\n", report)

    def test_who_is_seen_and_why(self):
        walls = "".join(
            f"triangle\n-9 -9 {z}\n9 -9 {z}\n0 9 {z}\n" for z in ("-0.5", "-0.25", "-0.75", "-0.25"))
        report = self.report(walls, "--triangle", 2, "--pixel", "4,4", camera=self.FLAT)
        self.assertIn(
            "  at this pixel, in the order they are drawn:\n"
            "       triangle 0   depth 0.5    kept, the first one\n"
            "       triangle 1   depth 0.25   kept, nearer than triangle 0\n"
            "  ->   triangle 2   depth 0.75   lost, behind triangle 1\n"
            "       triangle 3   depth 0.25   lost, equal and later than triangle 1\n"
            "  the pixel shows triangle 1: 0.25 is nearer than 0.75\n", report)
        report = self.report(walls, "--triangle", 3, "--pixel", "4,4", camera=self.FLAT)
        self.assertIn("  the pixel shows triangle 1: it is as near and came earlier\n", report)

    def test_of_many_fragments_some_are_left_out(self):
        walls = "".join(f"triangle\n-9 -9 {z / 100}\n9 -9 {z / 100}\n0 9 {z / 100}\n" for z in range(-90, 90))
        report = self.report(walls, "--triangle", 100, "--pixel", "4,4", camera=self.FLAT)
        self.assertEqual(report.count("\n"), MAX_LINES)
        self.assertIn(
            "  ->   triangle 100   depth -0.1    kept, nearer than triangle 99\n       triangle 179   depth "
            "-0.89   kept, nearer than triangle 178\n", report)
        self.assertRegex(
            report, r"in the order they are drawn \(1\d of 180\):\n       triangle 0 .*\n       triangle 1 ")
        self.assertRegex(
            report,
            r"\n       triangle 179 .*\n  the pixel shows triangle 179: -0.89 is nearer than -0.1\n\Z")

    def test_limits_of_depth(self):
        report = self.report("triangle\n-9 -9 -2\n9 -9 -2\n0 9 -2\n", "--triangle", 0, "--pixel", "4,4",
                             camera=self.FLAT)
        self.assertIn("  wholly beyond the rear limit 1: no pixel shows it\n", report)
        self.assertIn(
            "lost, beyond the rear limit\n  none of them is between the limits: the pixel shows the "
            "background\n", report)

    def test_why_a_pixel_is_uncertain(self):
        """In each of three stages, the last of 7 decimals is off by up to half a unit in x, y and z, and a
        pixel is 1/4."""
        line = "  uncertain: rounding may have moved edges here by 1.2e-6 pixels, depths by 1.5e-7; %s\n"
        self.assertIn(line % "edge 1-2 is as near", self.on_centers("3,4"))
        self.assertNotIn("uncertain", self.on_centers("2,5") + self.on_centers("3,4", "nearest"))
        walls = [f"triangle\n-9 -9 {z}\n9 -9 {z}\n0 9 {z}\n" for z in ("-.25", "-.25000004", "1")]
        for text, number, why in ((walls[0] + walls[1], 0,
                                   "triangle 1 is as near"), (walls[2], 0, "the front limit is as near"),
                                  (walls[0] + "triangle\n-1 -1 -.5\n-.5 -1 -.5\n-1 -.5 -.5\n" + walls[0], 1,
                                   "other triangles are why")):
            report = self.report(text, "--triangle", number, "--pixel", "4,4", "--coverage", "center",
                                 camera=self.FLAT)
            self.assertTrue(report.endswith(line % why), report)

    def test_the_transforms_in_force(self):
        report = self.report("translate\n1 2 3\npush\nscale\n9 9 9\npop\nrotate 90 0 0 1\n" + self.ON_CENTERS,
                             "--triangle", 0)
        self.assertIn("triangle 0 of 1, numbered from 0: scene.txt, line 12\n", report)
        self.assertIn(
            "  line 5  translate 1 2 3                   M = | 0  -1  0  1 |\n"
            "  line 11  rotate 90 0 0 1                      | 1   0  0  2 |\n"
            "                                                | 0   0  1  3 |\n"
            "                                                | 0   0  0  1 |\n"
            "  0  -0.625  -0.625  0  ->  1.6250000  1.3750000  3.0000000\n", report)

    def test_of_many_transforms_the_last_are_shown(self):
        report = self.report("rotate 1 0 0 1\n" * 90 + self.ON_CENTERS, "--triangle", 0)
        self.assertIn(
            "  (87 transforms before these)              M = | 0  -1  0  0 |\n  line 92  rotate 1 0 0 1      "
            "                 | 1   0  0  0 |\n", report)

    def test_a_triangle_that_is_cut(self):
        # From z = 0 to behind the eye at z = 5: where z is 4, 1 before the eye, is four ninths of the way to
        # z = 9.
        report = self.report("triangle\n0 -1 0\n0 -1 9\n9 -1 0\n", "--triangle", 0, "--pixel", "6,5")
        self.assertRegex(report, r"  1 +0\.0000000 .* -4\.0000000   behind the eye\n")
        self.assertRegex(
            report,
            r"  a +0\.0000000 +-1\.7320508 +-1\.0000000 +1\.0000000   where the near plane cuts edge 0-1\n")
        self.assertRegex(
            report,
            r"  b +8\.6602540 +-1\.7320508 +-1\.0000000 +1\.0000000   where the near plane cuts edge 1-2\n")
        self.assertIn("  cut: what is left are the triangles 0-a-b, 0-b-2\n", report)

    def test_a_triangle_of_nine_corners(self):
        # The plane x + y + z = 0 meets the cube in a hexagon, and the triangle cuts off three of its corners.
        # Fragments enough to fill any page lie behind.
        walls = "triangle\n-90 -90 -0.9\n90 -90 -0.9\n0 90 -0.9\n" * 40
        for rule in ("nearest", "center"):
            report = self.report("triangle\n0 -1.8 1.8\n1.8 0 -1.8\n-1.8 1.8 0\n" + walls, "--triangle", 0,
                                 "--pixel", "4,4", "--clip", "frustum", "--coverage", rule, camera=self.FLAT)
            self.assertIn(
                "  (5 more)\n  cut: what is left are the triangles a-b-c, a-c-d, a-d-e, a-e-f, a-f-g, "
                "a-g-h, a-h-i\n", report)
            self.assertIn("  the pixel shows triangle 0\n", report)

    def test_what_is_dropped_says_why(self):
        behind = self.report("triangle\n0 0 6\n1 0 6\n0 1 7\n", "--triangle", 0, "--pixel", "4,4")
        self.assertIn("  dropped: all corners are outside the near plane\n\nPIXEL ", behind)
        culled = self.report("triangle\n0 0 0\n1 0 0\n0 1 0\n", "--triangle", 0, "--cull", "front")
        self.assertIn(
            "its corners run counterclockwise as the eye sees them: it shows its front, which --cull "
            "front drops\n", culled)
        outside = self.report("triangle\n90 0 0\n91 0 0\n90 1 0\n", "--triangle", 0)
        self.assertIn("  wholly right of the picture: no pixel shows it\n", outside)
        outside = self.report("triangle\n90 0 0\n91 0 0\n90 1 0\n", "--triangle", 0, "--clip", "reject")
        self.assertIn("  dropped: all corners are outside the right plane\n", outside)

    def test_a_triangle_seen_edge_on(self):
        report = self.report("triangle\n0 0 0\n0 0 1\n0 0 2\n", "--triangle", 0, "--pixel", "4,4",
                             "--coverage", "center")
        self.assertIn("  no area: it is seen edge-on\n", report)
        self.assertIn("  not covered: a triangle without area covers no center\n", report)

    def test_the_aspect_rule_may_stand_in_the_header(self):
        camera = {"eye": "0 0 5".split(), "look": "0 0 0".split(), "up": "0 1 0".split()}
        for words, rule, scale in (("60 2 1 100", None, 1 / math.tan(math.pi / 3)),
                                   ("60 2 1 100 ratio", None, 0.5 / math.tan(math.pi / 6)),
                                   ("60 2 1 100 ratio", "angle", 1 / math.tan(math.pi / 3)),
                                   ("60 2 1 100 angle", "ratio", 0.5 / math.tan(math.pi / 6))):
            stages = SimpleNamespace(settings=Settings(aspect=rule),
                                     camera=lambda words=words: camera | {"perspective": words.split()},
                                     world_lossless=["0 0 0".split()] * 3,
                                     view_lossless=["0 0 -5".split()] * 3)
            triangle = find_triangle(CAMERA + self.ON_CENTERS + "end\n", 0)
            self.assertAlmostEqual(float(Calculation(stages, triangle).projection_matrix[0][0]), scale,
                                   places=14)

    def test_without_a_pixel_one_is_suggested(self):
        self.assertTrue(
            self.report(self.ON_CENTERS, "--triangle", 0, camera=self.FLAT).endswith(
                "\n\nwith --pixel 2,5, in its middle, the report goes on at that pixel\n"))


class Messages(ToolTest):
    def assert_misuse(self, done, message):
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1]),
                         (2, f"explain: {message} (try explain --help)"))

    def test_a_wrong_scene_or_config_is_the_tools_message(self):
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n0 0 0\n1 0 zero\n")
        self.assert_fails_with(
            "explain: model: scene.txt:7:5: expected the z of vertex 2 of 3, found 'zero'\n")
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n0 0 0\n1 0 0\n0 1 0\nend\n")
        pathlib.Path("config.txt").write_text("8 0\n")
        self.assert_fails_with(
            "explain: zbuf: config.txt:1:3: expected the height in pixels, a whole number from 1 to 65535, "
            "found '0'\n")
        pathlib.Path("config.txt").write_text("8 8\n")
        for tool, lines, message in (("view", 2, "expected three vertex lines of triangle 0, found fewer"),
                                     ("view", 0, "expected three vertex lines of triangle 0, found fewer"),
                                     ("project", 2, "expected three vertices a triangle, found 2 in all")):
            tools = tools_with(tool, f'$real "$@" | head -n {lines}')
            self.assert_fails_with(f"explain: {tool}: {message}\n", env={**os.environ, "BIN": str(tools)})

    def assert_fails_with(self, message, **settings):
        done = explain("scene.txt", "config.txt", "--triangle", 0, **settings)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (1, message, ""))

    def test_a_sphere_names_the_ways_to_draw_it(self):
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n0 0 0\n1 0 0\n0 1 0\nsphere 0 0 0 1\nend\n")
        self.assert_fails_with(
            "explain: model: scene.txt:9:1: expected triangles alone, found a sphere: trace draws it, and "
            "model --facets N makes triangles of it\n")

    def test_a_missing_file_is_named(self):
        done = explain("none.txt", "config.txt", "--triangle", 0)
        self.assertEqual((done.returncode, done.stderr),
                         (1, "explain: cannot read none.txt: No such file or directory\n"))

    def test_a_triangle_beyond_the_last_says_how_many_there_are(self):
        self.assert_misuse(explain("scene.txt", "config.txt", "--triangle", 1),
                           "--triangle: expected 0, found 1: scene.txt has 1 triangle")
        sample = SOURCE / "samples/two-triangles"
        self.assert_misuse(
            explain(sample / "scene.txt", "config.txt", "--triangle", 2),
            f"--triangle: expected a number from 0 to 1, found 2: {sample}/scene.txt has 2 triangles")
        pathlib.Path("scene.txt").write_text(CAMERA + "end\n")
        self.assert_misuse(explain("scene.txt", "config.txt", "--triangle", 0),
                           "--triangle: expected no number, found 0: scene.txt has 0 triangles")

    def test_a_pixel_outside_says_the_size(self):
        for pixel in ("8,0", "0,8"):
            self.assert_misuse(explain("scene.txt", "config.txt", "--triangle", 0, "--pixel", pixel),
                               "--pixel: expected COLUMN,ROW from 0,0 to 7,7: the picture has 8 x 8 pixels")
        for pixel in ("8", "a,b", "1,2,3"):
            self.assert_misuse(explain("scene.txt", "config.txt", "--triangle", 0, "--pixel", pixel),
                               f"argument --pixel: expected COLUMN,ROW, found '{pixel}'")

    def test_scenes_may_be_pipes(self):
        by_pipe = explain("-", "config.txt", "--triangle", 0, "--pixel", "4,4",
                          stdin=pathlib.Path("scene.txt").read_text())
        self.assertEqual((by_pipe.returncode, by_pipe.stderr), (0, ""))
        by_name = explain("scene.txt", "config.txt", "--triangle", 0, "--pixel", "4,4")
        self.assertEqual(by_pipe.stdout, by_name.stdout.replace("scene.txt", "<stdin>"))

    def test_nothing_is_left_behind(self):
        explain("scene.txt", "config.txt", "--triangle", 0, "--pixel", "4,4")
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])


class RandomTriangles(ToolTest):
    """Exact arithmetic rounds to what the tools print, whatever the camera, the transforms and the
    options."""
    def test_stages_agree_with_the_tools(self):
        choice = random.Random(5)

        def point(size):
            return " ".join(f"{choice.uniform(-size, size):.{choice.choice((0, 2, 7))}f}" for _ in range(3))

        for index in range(40):
            kind = choice.choice(("70 1.3 0.5 30", "70 1.3 0.5 30", "ortho -3 4 -2.5 2 0.5 20",
                                  "frustum -1 1.5 -0.5 1 0.7 30"))
            commands = "".join(
                choice.choice((f"rotate {choice.choice((90, 45, 30, 17.3))} 1 {point(2)[:2]} 0.5\n",
                               f"translate {point(3)}\n", f"scale {point(2)}\n"))
                for _ in range(choice.randrange(5)))
            text = f"{point(5)}\n{point(1)}\n0 1 0.25\n{kind}\n{commands}" + "".join(
                f"triangle {point(6)}\n{point(6)}\n{point(6)}\n" for _ in range(4)) + "end\n"
            pathlib.Path("scene.txt").write_text(text)
            settings = Settings(choice.choice(("7", "12", "exact")), choice.choice((None, "ratio")),
                                choice.choice((None, "near", "frustum")),
                                choice.choice((None, "back", "front")))
            stages = Stages(Tools(BIN), "scene.txt", "config.txt", settings)
            for number in range(4):
                with self.subTest(scene=index, triangle=number, text=text, settings=settings):
                    stages.send(number)
                    calculation = Calculation(stages, find_triangle(text, number))
                    self.assertEqual(len(calculation.ndc), len(stages.ndc))
                    for printed, points in ((stages.world, calculation.world), (stages.view,
                                                                                calculation.view),
                                            *zip(stages.ndc, calculation.ndc)):
                        for words, exact in zip(printed, points):
                            self.assertTrue(agrees(words, exact, settings.digits),
                                            (words, list(map(float, exact))))


class RandomPairs(ToolTest):
    """Coverage and depth of a triangle at a pixel are zbuf's by both rules; the reference judges zbuf."""

    COUNT = 2000
    # Numbers so round that centers lie on edges and ends of rows halfway between pixels, and numbers that are
    # not.
    CONFIGS = ("16 12\n-1\n-0.75\n-1 1\n", "20 20\n", "30 7\n-0.9\n-0.35\n0 0.9\n")
    TRIANGLES_AT_ONCE, PIXELS_EACH = 50, 10

    def triangle(self, choice):
        step = choice.choice((1, 1250000, 625000, 500000, 333333))
        xy = [[choice.randrange(-12000000, 12000001) // step * step for _ in range(2)] for _ in range(3)]
        depths = [choice.randrange(-5000000, 9000000)] * 3 if choice.random() < 0.2 else [
            choice.randrange(-5000000, 9000000) for _ in range(3)]
        return [tuple(Fraction(n, 10**7) for n in (*p, z)) for p, z in zip(xy, depths)]

    def test_agree_with_zbuf(self):
        choice = random.Random(self.COUNT)
        covered = {"nearest": 0, "center": 0}
        for start in range(0, self.COUNT, self.TRIANGLES_AT_ONCE * self.PIXELS_EACH):
            config = choice.choice(self.CONFIGS)
            window = Window(config)
            triangles = [self.triangle(choice) for _ in range(self.TRIANGLES_AT_ONCE)]
            drawn = self.drawn(config, triangles)
            for number, points in enumerate(triangles):
                for _ in range(self.PIXELS_EACH):
                    pixel = self.pixel_near(choice, window, points)
                    found = PixelOfTriangle(window, "012", points, pixel)
                    with self.subTest(config=config, points=points, pixel=pixel):
                        for rule in covered:
                            covered[rule] += found.is_covered(rule)
                            self.assertEqual(found.is_covered(rule), (number, *pixel) in drawn[rule])
                            if found.is_covered(rule) and found.has_area:
                                self.check_depth(window, points, pixel, found.depth(rule),
                                                 drawn[rule][(number, *pixel)])
        for rule, count in covered.items():
            self.assertTrue(0.2 * self.COUNT < count < 0.8 * self.COUNT, (rule, count))

    def drawn(self, config, triangles):
        """{rule: {(triangle, column, row): depth}} of all fragments that zbuf finds."""
        pathlib.Path("config.txt").write_text(config)
        text = "".join("".join(" ".join(f"{float(x):.7f}" for x in p) + "\n" for p in points) + "\n"
                       for points in triangles)
        found = {}
        for rule in ("nearest", "center"):
            done = run("zbuf", "--coverage", rule, "--fragments", "fragments.txt", "--image", "out.ppm",
                       "config.txt", stdin=text)
            self.assertEqual(done.returncode, 0, done.stderr)
            found[rule] = {}
            for line in pathlib.Path("fragments.txt").read_text().splitlines():
                words = line.replace(",", " ").replace(":", " ").split()
                found[rule][int(words[3]), int(words[0]), int(words[1])] = float(words[5])
        return found

    def pixel_near(self, choice, window, points):
        """A pixel that often lies in the triangle, or at its edge."""
        weights = [choice.random() for _ in range(3)]
        x, y = (sum(w * p[i]
                    for w, p in zip(map(Fraction, weights), points)) / Fraction(sum(map(Fraction, weights)))
                for i in (0, 1))
        column = math.floor((x - window.left) * window.width / (-2 * window.left)) + choice.choice(
            (0, 0, 0, -1, 1))
        row = math.floor((-window.bottom - y) * window.height / (-2 * window.bottom)) + choice.choice(
            (0, 0, 0, -1, 1))
        return min(max(column, 0), window.width - 1), min(max(row, 0), window.height - 1)

    def check_depth(self, window, points, pixel, found, drawn):
        """By the normal of the triangle's plane, and against zbuf's. On the row of the highest or lowest
        corner, rounding decides whether `nearest` has the depth of that corner instead."""
        (ax, ay, az), u, v = points[0], *([q - p for p, q in zip(points[0], other)] for other in points[1:])
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        x = window.left + (2 * pixel[0] + 1) * -window.left / window.width
        y = -window.bottom - (2 * pixel[1] + 1) * -window.bottom / window.height
        of_plane = az - (normal[0] * (x - ax) + normal[1] * (y - ay)) / normal[2]
        if y in (min(p[1] for p in points), max(p[1] for p in points)):
            self.assertIn(found, [of_plane, *(p[2] for p in points if p[1] == y)])
        else:
            self.assertEqual(found, of_plane)
        # A triangle that is nearly seen edge-on is steep: the rounding of x in doubles moves its depth.
        slope = (abs(normal[0]) + abs(normal[1])) / abs(normal[2])
        self.assertLessEqual(abs(found - Fraction(drawn)), (1 + slope)**2 * Fraction(1, 10**15))


class TheStack(ToolTest):
    # The table of the assignment, "Managing Push and Pop": the state after each of its lines, top first.
    TABLE = {
        "push": ("I", "I"), "T1": ("T1", "I"), "push ": ("T1", "T1", "I"), "R1": ("T1 R1", "T1", "I"),
        "pop": ("T1", "I"), "S1": ("T1 S1", "I"), "push  ": ("T1 S1", "T1 S1", "I"),
        "R2": ("T1 S1 R2", "T1 S1", "I"), "pop ": ("T1 S1", "I"), "S2": ("T1 S1 S2", "I"), "pop  ": ("I",)}
    ARGUMENTS = {"T": "translate 1 2 3", "R": "rotate 90 0 0 1", "S": "scale 2 2 2"}

    def test_is_the_table_of_the_assignment(self):
        code = [self.ARGUMENTS.get(line[0], line.strip()) for line in self.TABLE]
        report = explain("-", "--stack", stdin=CAMERA + "\n".join([*code, "end"]))
        rows = report.stdout.split("\n")[3:3 + len(code)]
        self.assertEqual([tuple(row[34:].split(" | ")) for row in rows], [*self.TABLE.values()])
        self.assertIn("R1 = | 0  -1  0  0 |\n     | 1   0  0  0 |\n", report.stdout)

    def test_fits_a_terminal_and_names_every_triangle_with_its_matrix(self):
        deep = CAMERA + "".join(f"push\nrotate {i} 0 0.123456789012345 1e-5\ntranslate {i} {i} {i}\n"
                                for i in range(30)) + "triangle\n0 0 0\n1 0 0\n0 1 0\n" * 2 + "end\n"
        for words, text in ((["-"], deep), *(([sample / "scene.txt"], None) for sample in SAMPLES)):
            report = explain(*words, "--stack", stdin=text)
            self.assertEqual([line for line in report.stdout.splitlines()[1:] if len(line) > 79], [])
            if text:
                self.assertRegex(
                    report.stdout, r" triangles 0 to 1 +a point p becomes R1 T1 R2 T2 \.\.\. "
                    r"[^|]*\(60 factors\)")

    def test_refuses_what_it_cannot_use(self):
        for words, found in ((["config.txt"], "'config.txt'"), (["--pixel", "1,1"], "--pixel")):
            done = explain("-", *words, "--stack", stdin="")
            self.assertEqual((done.returncode, done.stderr),
                             (2, "explain: --stack: expected neither CONFIG nor --pixel with it, "
                              f"found {found} (try explain --help)\n"))
        done = explain("-", "--stack", stdin="0 0 0\n")
        self.assertRegex(f"{done.returncode} {done.stderr}", r"^1 explain: model: <stdin>:2:1: expected")


class TheScanLine(ToolTest):
    """Three triangles, each of one depth, on ten rows; every number by hand."""
    SCENE = ("0 0 0\n0 0 -1\n0 1 0\northo -1 1 -1 1 0 2\n"
             "triangle\n-0.95 -1 -0.5\n0.95 -1 -0.5\n0.95 0.9 -0.5\n"
             "triangle\n-0.75 -0.75 -1.5\n0.6 -0.75 -1.5\n-0.75 0.6 -1.5\n"
             "triangle\n-0.95 -0.55 -1.25\n0.95 -0.55 -1.25\n0 0.95 -1.25\nend\n")

    def report(self, row):
        pathlib.Path("ten.txt").write_text("10 10\n")
        return explain("-", "ten.txt", "--scan-line", row, "--coverage", "center", stdin=self.SCENE)

    def test_has_the_tables_of_a_row(self):
        self.assertEqual(
            self.report(5).stdout, """<stdin>
scan line 5 of 0 to 9, y = -0.1 in NDC, coverage center

EDGE TABLE, row 5: the edges that begin there
  none

POLYGON TABLE, of those on this row
  polygon   rows     plane
  0         1 to 9   z = -0.5 + 0 x + 0 y
  1         2 to 8   z = 0.5 + 0 x + 0 y
  2         1 to 7   z = 0.25 + 0 x + 0 y

ACTIVE EDGES: left ones turn their polygon's flag to in, right ones to out
  column   edge         depth        active polygons   seen from here
  1        left of 1    0.5000000    1                 1
  2        left of 2    0.2500000    1, 2              2
  5        right of 1   0.5000000    2
  5        left of 0    -0.5000000   2, 0              0
  8        right of 2   0.2500000    0                 0
  10       right of 0   -0.5000000   none
""")
        self.assertIn(
            """EDGE TABLE, row 1: the edges that begin there
  column     last row   per row      polygon
  3.708333   7          -0.6333333   2
  5.291667   7          0.6333333    2
  8.25       9          -1           0
  9.25       9          0            0
""",
            self.report(1).stdout)
        self.assertIn("\n  none: every pixel shows the background\n", self.report(0).stdout)

    def test_has_the_colors_of_polygons_as_shading_info(self):
        corners = ["-0.95 -1 -0.5 {}", "0.95 -1 -0.5 {}", "0.95 0.9 -0.5 {}"]
        triangle = "triangle\n" + "\n".join(corners) + "\n"
        self.SCENE = ("0 0 0\n0 0 -1\n0 1 0\northo -1 1 -1 1 0 2\nattributes color\n" +
                      triangle.format("255 0 0", "255 0 0", "0 0 12.5") + triangle.format(*3 * ["9 8 7"]) +
                      "end\n")
        self.assertIn(
            """
SHADING INFO: red, green and blue; of each corner, where these differ
  polygon   color
  0         255 0 0, 255 0 0, 0 0 12.5
  1         9 8 7

ACTIVE EDGES""",
            self.report(5).stdout)

    def test_fits_a_terminal(self):
        for sample in SAMPLES:
            lines = explain(sample / "scene.txt", sample / "config.txt", "--scan-line", 30).stdout.split("\n")
            self.assertEqual([line for line in lines[1:] if len(line) > 79], [])

    def test_is_of_a_row_of_the_picture_and_no_pixel(self):
        self.assertEqual(
            self.report(10).stderr, "explain: --scan-line: expected a number from 0 to 9, "
            "found 10 (try explain --help)\n")
        done = explain("-", "ten.txt", "--scan-line", "1", "--pixel", "1,1", stdin=self.SCENE)
        self.assertEqual((done.returncode, done.stderr),
                         (2, "explain: --pixel: expected --triangle with it, found --scan-line "
                          "(try explain --help)\n"))


class LongRandomPairs(RandomPairs):
    COUNT = 100000


if __name__ == "__main__":
    unittest.main()
