#!/usr/bin/env python3
"""scripts/measure/scoreboard counts what rasterizers do with pixels.

usage: scoreboard_test.py BIN_DIR SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

BIN, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
MEASURE = SOURCE / "scripts/measure"
sys.path[:0] = [str(MEASURE), str(SOURCE / "scripts")]
from lib.showing.pictures import picture_of  # noqa: E402
from parts import scoreboard_geometry as geometry  # noqa: E402
from parts import scoreboard_pictures  # noqa: E402
from parts.scoreboard_cases import Case, read_cases  # noqa: E402
from parts.scoreboard_judge import answers, judged  # noqa: E402

HALF = Fraction(1, 2)
# The adapters, and what finds out whether they can be run.
ADAPTERS = {
    "pipeline.py center": [sys.executable, MEASURE / "adapters/pipeline.py", "center", BIN],
    "pipeline.py nearest": [sys.executable, MEASURE / "adapters/pipeline.py", "nearest", BIN], **{
        words: [sys.executable, MEASURE / "adapters" / words.split()[0], *words.split()[1:]]
        for words in ("osmesa.py llvmpipe", "osmesa.py softpipe", "cairo.py none",
            "cairo.py default", "sdl2.py", "gd.py")}, "pillow.py":
        ["/usr/bin/python3", MEASURE / "adapters/pillow.py"]}


def points(*pairs, z=0):
    return [(Fraction(x), Fraction(y), Fraction(z)) for x, y in pairs]


def case(*triangles, size=4, limits=("-1", "1")):
    """A case of a picture of size x size; corners (x, y, z) in pixels."""
    words = [[[repr(2 * x / size - 1), repr(1 - 2 * y / size),
               repr(z)] for x, y, z in triangle] for triangle in triangles]
    return Case(
        "a-case", {
            "width": size, "height": size, "left": "-1", "bottom": "-1", "front": limits[0],
            "rear": limits[1], "triangles": words}, "why")


# A square from 1, 1 to 3, 3 with its diagonal through centers, and the whole of a picture of 4 x 4.
SQUARE = ((1, 1, 0.0), (3, 1, 0.0), (1, 3, 0.0)), ((3, 3, 0.0), (1, 3, 0.0), (3, 1, 0.0))
WHOLE = ((0, 0, 0.0), (4, 0, 0.0), (0, 4, 0.0)), ((4, 4, 0.0), (0, 4, 0.0), (4, 0, 0.0))


class Geometry(unittest.TestCase):
    def test_where_a_point_lies(self):
        triangle = points((0, 0), (4, 0), (0, 4))
        for turned in (triangle, triangle[::-1]):
            for p, where in (((1, 1), geometry.INSIDE), ((2, 2), geometry.EDGE), ((0, 0), geometry.EDGE),
                             ((3, 2), geometry.OUTSIDE), ((5, 0), geometry.OUTSIDE)):
                self.assertEqual(geometry.position(turned, p), where)
        self.assertEqual(geometry.position(points((0, 0), (1, 1), (2, 2)), (1, 1)), geometry.OUTSIDE)

    def test_what_is_inside_a_tiling(self):
        first, second = points((0, 0), (4, 0), (0, 4)), points((4, 4), (0, 4), (4, 0))
        for p, is_inside in (((2, 2), True), ((1, 1), True), ((0, 2), False), ((0, 0), False),
                             ((4, 0), False), ((5, 5), False)):
            self.assertEqual(geometry.is_inside_all([first, second], p), is_inside)
        around = [points((2, 2), *ends) for ends in (((4, 1), (0, 0)), ((0, 0), (1, 4)), ((1, 4), (4, 1)))]
        self.assertTrue(geometry.is_inside_all(around, (2, 2)))
        self.assertFalse(geometry.is_inside_all(around[:2], (2, 2)))

    def test_overlap(self):
        triangle = points((0, 0), (4, 0), (0, 4))
        for other, expected in ((points((4, 0), (0, 4), (4, 4)), False), (points(
            (0, 0), (-4, 0), (0, -4)), False), (triangle, True), (points(
                (1, 1), (2, 1), (1, 2)), True), (points((3, 0), (9, 0), (3, 9)), True), (points(
                    (0, 0), (2, 2), (4, 4)), False)):
            self.assertEqual(geometry.overlap(triangle, other), expected)

    def test_distances_are_those_to_the_nearest_edge(self):
        triangle = points((0, 0), (4, 0), (0, 4))
        for p, expected in (((1, 1), 1.0), ((-3, -4), 5.0), ((2, 3), 0.5 ** 0.5), ((2, -1), 1.0)):
            self.assertAlmostEqual(geometry.distance(triangle, p), expected)

    def test_depth_is_that_of_the_plane(self):
        triangle = [(Fraction(x), Fraction(y), Fraction(z)) for x, y, z in ((0, 0, 1), (4, 0, 9), (0, 4, 5))]
        self.assertEqual(geometry.depth(triangle, (1, 1)), 1 + 2 + 1)

    def test_the_area_in_a_pixel(self):
        triangle = points((0, 0), (2, 0), (0, 2))
        areas = {(column, row): geometry.area_in_pixel(triangle, column, row)
                 for column in range(3) for row in range(3)}
        self.assertEqual(areas, {**dict.fromkeys(areas, 0), (0, 0): 1, (1, 0): HALF, (0, 1): HALF})


class Cases(unittest.TestCase):
    def read(self, text, config="8 8\n", about="why: for a reason\n"):
        with tempfile.TemporaryDirectory() as name:
            pathlib.Path(name, "zbuf").mkdir()
            page = f"\n== case\n{about}-- input.txt\n{text}-- config.txt\n{config}"
            pathlib.Path(name, "zbuf/page.cases").write_text(page)
            return next(iter(read_cases(pathlib.Path(name))), None)

    def test_a_plain_case_in_pixels(self):
        read = self.read("-1 1 0.5\n1 1 0.5\n0 -1 0.5\n\n", "8 4\n-1\n-1\n0 2\n")
        self.assertEqual(read.triangles, [points((0, 0), (8, 0), (4, 4), z=HALF)])
        self.assertEqual((read.fields["front"], read.fields["rear"], read.why), ("0", "2", "for a reason"))

    def test_what_no_adapter_can_express(self):
        text = "-1 1 0\n1 1 0\n0 -1 0\n"
        self.assertIsNone(self.read("attributes color\n-1 1 0 1 2 3\n1 1 0 1 2 3\n0 -1 0 1 2 3\n"))
        self.assertIsNone(self.read(text, about="why: it is wrong\nrefused: 3\n"))
        self.assertIsNone(self.read(text, about="why: it is better\noptions: --samples 2\n"))
        self.assertIsNone(self.read(""))
        self.assertIsNone(self.read(text, about="why: it is far away\nneeds: exactness\n"))
        self.assertIsNotNone(self.read(text))

    def test_a_tiling_and_its_pixels(self):
        tiling = case(*SQUARE)
        self.assertTrue(tiling.is_tiling)
        self.assertEqual(tiling.inner_pixels, [5, 6, 9, 10])
        self.assertEqual(tiling.full_pixels, [5, 6, 9, 10])
        self.assertAlmostEqual(tiling.border_distance(5), 0.5)
        self.assertFalse(case(SQUARE[0], SQUARE[0]).is_tiling)
        self.assertFalse(case(SQUARE[0]).is_tiling)

    def test_what_is_seen(self):
        near, far, beyond = (tuple((x, y, z) for x, y, _ in WHOLE[0]) for z in (-0.5, 0.5, 1.5))
        for triangles, expected in (((near, far), 0), ((far, near), 1), ((beyond, far), 1), ((beyond, ), -1),
                                    ((near, near), None)):
            self.assertEqual(case(*triangles).seen(0, 1e-6), expected)
        self.assertIsNone(case(near, far).seen(3, 1e-6))  # its center is on the edge


class Judge(unittest.TestCase):
    """The score of a made-up rasterizer."""

    def score(self, a_case, rows, about=None, seen=None):
        """`rows`: for each triangle its rows, '#' for drawn, or numbers for the parts of 9."""
        values = {"#": 255, ".": 0, **{str(i): round(255 * i / 9) for i in range(10)}}
        answer = {"coverage": [bytes(values[c] for row in mask.split() for c in row).hex() for mask in rows]}
        answer.update({"seen": seen} if seen else {})
        full = {
            "name": "made up", "version": "1", "promise": "nothing", "grid": 0, "has_depth": seen is not None,
            **(about or {})}
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write(f"print({json.dumps(full)!r})\nprint({json.dumps(answer)!r})\n")
            file.flush()
            return judged([sys.executable, pathlib.Path(file.name)], [a_case])

    def assert_score(self, score, **expected):
        self.assertEqual({key: getattr(score, key) for key in expected}, expected)

    def test_every_pixel_owned_once(self):
        score = self.score(case(*SQUARE), ("....  .##.  .#..  ....", "....  ....  ..#.  ...."))
        self.assert_score(score, tilings=1, owners=4, gaps=0, twice=0, missed=0, extra=0, inside=2)
        self.assertEqual(list(score.failures.values()), [{}])

    def test_gaps_and_pixels_owned_twice(self):
        score = self.score(case(*SQUARE), ("....  .#..  .#..  ....", "....  ....  .##.  ...."))
        self.assert_score(score, gaps=1, twice=1, missed=0, extra=0)
        self.assertEqual(list(score.failures.values()), [{6: "gap", 9: "twice"}])

    def test_pixels_missed_and_drawn_beyond_the_edges(self):
        score = self.score(case(SQUARE[0]), ("#...  .##.  .#..  ....",))
        self.assert_score(score, tilings=0, missed=0, extra=1, rounded=0)
        score = self.score(case(SQUARE[0]), ("....  .##.  .#..  ....".replace("#", ".", 1),))
        self.assert_score(score, missed=1, extra=0)

    def test_pixels_of_the_wrong_triangle(self):
        score = self.score(case(*SQUARE), ("....  ....  .#..  ....", "....  .#..  .##.  ...."))
        self.assert_score(score, gaps=1, twice=1, missed=1, extra=1)
        self.assertEqual(list(score.failures.values()), [{5: "moved", 6: "gap", 9: "twice"}])

    def test_what_the_rounding_of_corners_explains(self):
        for grid, rounded in ((0.5, 0),
                              (1, 1)):  # the center is 0.5 from the edge; a corner moves by 0.71 of the grid
            self.assert_score(self.score(case(SQUARE[0]), ("....  ....  .#..  ....", ), {"grid": grid}),
                              missed=1, rounded=rounded)
        self.assert_score(self.score(case(*SQUARE), ("....  ....  ....  ....", ) * 2, {"grid": 1}), owners=0,
                          gaps=0)

    def test_parts_that_do_not_add_up(self):
        about = {"is_antialiased": True}
        whole = ("####  ###4  ##4.  #4..", "....  ...5  ..5#  .5##")
        self.assert_score(self.score(case(*WHOLE), whole, about), owners=16, gaps=3, twice=0, inside=0)
        self.assert_score(
            self.score(case(*WHOLE), ("####  ###9  ##9.  #9..", "....  ...5  ..5#  .5##"), about), gaps=0,
            twice=3)

    def test_depths_count_where_they_decide(self):
        near, far = (tuple((x, y, z) for x, y, _ in SQUARE[0]) for z in (-0.5, 0.5))
        mask = "....  .#..  ....  ...."  # one center is inside
        self.assert_score(self.score(case(far, near), (mask, mask), seen=[-1] * 5 + [1] + [-1] * 10),
                          compared=1, wrong_depths=0)
        self.assert_score(self.score(case(far, near), (mask, mask), seen=[-1] * 5 + [0] + [-1] * 10),
                          compared=1, wrong_depths=1)
        self.assert_score(self.score(case(far), (mask,), seen=[0] * 16), compared=0)

    def test_one_that_is_not_installed(self):
        with tempfile.NamedTemporaryFile("w", suffix=".py") as file:
            file.write("import sys\nsys.exit(print('no such library', file=sys.stderr) or 77)\n")
            file.flush()
            self.assertEqual(judged([sys.executable, pathlib.Path(file.name)], [case(*SQUARE)]),
                             "no such library")


class Pictures(unittest.TestCase):
    def test_gaps_and_doubles_are_shown_first(self):
        cases = [case(*SQUARE) for _ in range(3)]
        failures = {cases[0]: {i: "extra" for i in range(9)}, cases[1]: {1: "gap"}, cases[2]: {}}
        self.assertIs(scoreboard_pictures.worst_case(failures), cases[1])
        self.assertIsNone(scoreboard_pictures.worst_case({cases[2]: {}}))

    def test_pixels_have_the_color_of_what_is_wrong(self):
        tiling = case(*SQUARE)
        masks = [bytes(255 * (pixel in owned) for pixel in range(16)) for owned in ((5, 9), (9, 10))]
        width, height, rows = picture_of(scoreboard_pictures.drawn(tiling, masks, {6: "gap", 9: "twice"}),
                                         "a picture")
        self.assertEqual((width, height), (257, 257))

        def color(pixel):
            x, y = 64 * (pixel % 4) + 20, 64 * (pixel // 4) + 26
            return tuple(rows[y][3 * x:3 * x + 3])

        self.assertEqual(color(0), scoreboard_pictures.WHITE)
        self.assertEqual([color(pixel) for pixel in (5, 10)], list(scoreboard_pictures.TINTS[:2]))
        self.assertEqual([color(pixel) for pixel in (6, 9)],
                         [scoreboard_pictures.COLORS[kind] for kind in ("gap", "twice")])


class Adapters(unittest.TestCase):
    def test_each_draws_whole_pictures_and_empty_ones(self):
        """A triangle around the window has all pixels, one beside it none, one of half the window those of
        that half."""
        around = (-4, -4, 0.0), (40, -4, 0.0), (-4, 40, 0.0)
        beside = (9, 1, 0.0), (12, 1, 0.0), (9, 4, 0.0)
        above = (-8, 4, 0.0), (16, 4, 0.0), (4, -20, 0.0)
        for words, command in ADAPTERS.items():
            with self.subTest(adapter=words):
                answer = answers(command, [case(around, beside, above, size=8)])
                if isinstance(answer, str):
                    self.skipTest(answer)
                about, ((line),) = answer
                self.assertTrue(about["name"] and about["version"] and about["promise"])
                self.assertEqual(line["coverage"][0], b"\xff" * 64)
                self.assertEqual(line["coverage"][1], bytes(64))
                self.assertEqual(line["coverage"][2][:24] + line["coverage"][2][-24:],
                                 b"\xff" * 24 + bytes(24))

    def test_those_with_depth_show_the_nearest(self):
        near, far = (tuple((x, y, z) for x, y in ((-4, -4), (40, -4), (-4, 40))) for z in (-0.5, 0.5))
        for words, command in ADAPTERS.items():
            with self.subTest(adapter=words):
                answer = answers(command, [case(far, near, far), case(far, near, limits=("0", "1"))])
                if isinstance(answer, str):
                    self.skipTest(answer)
                about, lines = answer
                self.assertEqual(about["has_depth"], words.startswith(("osmesa", "pipeline")))
                if about["has_depth"]:
                    self.assertEqual([line["seen"] for line in lines], [[1] * 16, [0] * 16])


class Page(unittest.TestCase):
    def test_the_page_is_what_the_script_writes(self):
        """Where the same versions of everything are installed."""
        page = SOURCE / "docs/algorithms.md"
        with tempfile.TemporaryDirectory() as folder:
            copy, pictures = pathlib.Path(folder, "docs/algorithms.md"), pathlib.Path(folder, "docs/pictures")
            pictures.mkdir(parents=True)
            copy.write_text(page.read_text())
            done = subprocess.run(
                [MEASURE / "scoreboard", "--bin", BIN, "--page", copy, "--pictures", pictures],
                capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            if done.stderr:
                self.skipTest(" ".join(done.stderr.split()))
            named = [re.findall(r"^\*\*(.*)\*\* \((.*)\)\.", path.read_text(), re.M) for path in (page, copy)]
            if named[0] != named[1]:
                self.skipTest("other versions: " +
                              ", ".join(" ".join(pair) for pair in named[1] if pair not in named[0]))
            self.assertEqual(copy.read_text(), page.read_text())
            for path in sorted(pictures.iterdir()):
                self.assertTrue(path.read_bytes() == (SOURCE / "docs/pictures" / path.name).read_bytes(),
                                path.name)

    def test_our_center_rule_fails_nowhere(self):
        row = re.search(r"^\| zbuf, center \| (.*) \|$", (SOURCE / "docs/algorithms.md").read_text(), re.M)[1]
        owners, gaps, twice, inside, missed, extra, rounded, compared, wrong = map(int, row.split(" | "))
        self.assertEqual([gaps, twice, missed, extra, rounded, wrong], [0] * 6)
        self.assertTrue(owners and inside and compared)


if __name__ == "__main__":
    unittest.main()
