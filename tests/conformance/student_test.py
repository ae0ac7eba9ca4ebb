#!/usr/bin/env python3
"""The student's program is right without a switch, and with one it makes exactly that mistake.

usage: student_test.py STUDENT BIN_DIR SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import reference

student, bin_dir, source = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(3))
from lib.judging.mistakes import sentences  # noqa: E402
from lib.showing.pictures import read_picture  # noqa: E402
from sample_files import sample_file  # noqa: E402

PLAIN = ("one-triangle", "two-triangles", "torus", "tilted-camera", "nested-transforms", "worked-example")
FIVE = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
MISTAKES, HABITS = [*sentences()], [*sentences("habits.txt")]


def switches(*names):
    return [word for name in names for word in ("--habit" if name in HABITS else "--mistake", name)]


def run(program, *words, stdin=b"", folder=None):
    """The program's stdout, in bytes."""
    done = subprocess.run([program, *words], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          cwd=folder)
    if done.returncode != 0:
        raise AssertionError(f"{program} {words}: {done.stderr.decode()}")
    return done.stdout


def five(scene, config, *names):
    """The five files of the student's program: {name: bytes}."""
    with tempfile.TemporaryDirectory() as folder:
        run(student, "all", scene, config, "--folder", folder, *switches(*names))
        return {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}


def drawn(program, *words, stdin):
    """The depth text and the picture that a zbuf writes."""
    with tempfile.TemporaryDirectory() as folder:
        depths = run(program, *words, stdin=stdin, folder=folder)
        return depths, read_picture(pathlib.Path(folder, "out.bmp"))


def numbers(text):
    return [float(word) for word in text.split()]


def points(text):
    """The points of a stage text, behind its header."""
    return [numbers(line) for line in text.decode().split("\n") if line and not line[0].isalpha()]


CAMERA = "0 0 5\n0 0 0\n0 1 0\n60 0.5 1 3\n"
TAN15, TAN30, TAN60 = (math.tan(math.radians(degrees)) for degrees in (15, 30, 60))
COS, SIN = math.cos(90), math.sin(90)  # of 90 radians
HALF = math.sqrt(0.5)
C, S = math.cos(math.radians(90 * HALF)), math.sin(math.radians(90 * HALF))

# The commands before a point 1 2 3, its right image, and that with the mistake.
MODEL = {
    "multiplied-on-the-left": ("translate\n10 0 0\nscale\n2 2 2", (12, 4, 6), (22, 4, 6)),
    "push-and-pop-ignored": ("push\ntranslate\n10 0 0\npop", (1, 2, 3), (11, 2, 3)),
    "pop-ignored": ("push\ntranslate\n10 0 0\npop", (1, 2, 3), (11, 2, 3)),
    "push-of-the-identity": ("translate\n10 0 0\npush", (11, 2, 3), (1, 2, 3)),
    "pop-to-the-identity": ("translate\n10 0 0\npush\ntranslate\n0 5 0\npop", (11, 2, 3), (1, 2, 3)),
    "second-push-lost": ("push\npush\ntranslate\n10 0 0\npop\ntranslate\n0 5 0\npop", (1, 2, 3), (1, 7, 3)),
    "push-does-not-nest": ("push\ntranslate\n10 0 0\npush\ntranslate\n0 5 0\npop\npop", (1, 2, 3), (11, 2,
                                                                                                    3)),
    "pop-takes-one-transform": ("push\ntranslate\n10 0 0\ntranslate\n0 5 0\npop", (1, 2, 3), (11, 2, 3)),
    "axis-not-normalized": ("rotate\n90 0 0 2", (-2, 1, 3), (-4, 2, 12)),
    "angle-in-radians": ("rotate\n90 0 0 1", (-2, 1, 3), (COS - 2 * SIN, SIN + 2 * COS, 3)),
    "rotation-transposed": ("rotate\n90 0 0 1", (-2, 1, 3), (2, -1, 3)),
    "rotation-element-from-the-wrong-column": ("rotate\n90 0 0 1", (-2, 1, 3), (-5, 1, 3)),
    "angle-negated": ("rotate\n90 0 0 1", (-2, 1, 3), (2, -1, 3)),
    "translation-added": ("scale\n2 2 2\ntranslate\n10 0 0", (22, 4, 6), (12, 4, 6)),
    "rotation-without-a-term": ("rotate\n180 0 0 1", (-1, -2, 3), (-1, -2, 0)),  # 1 for 1 - cos
    "rotation-on-the-left": ("translate\n10 0 0\nrotate\n90 0 0 1", (8, 1, 3), (-2, 11, 3)),
    # By 90 / sqrt(2) degrees about x after those about y.
    "rotation-by-euler-angles": ("rotate\n90 1 1 0", (1.5 + 3 * HALF, 1.5 - 3 * HALF, HALF),
                                 (C + 3 * S, 2 * C - S * (3 * C - S), 2 * S + C * (3 * C - S))),}

# The camera looks along x, with an up that is not of unit length: where 7 4 9 is.
ALONG_X = "eye 1 2 3\nlook 5 2 3\nup 0 2 0\n"
VIEW = {
    "translation-after-rotation": (ALONG_X, (6, 2, -6), (8, 2, -10)),
    "eye-added": (ALONG_X, (6, 2, -6), (12, 6, -8)),
    "no-translation": (ALONG_X, (6, 2, -6), (9, 4, -7)),
    "rotation-transposed": (ALONG_X, (6, 2, -6), (-6, 2, 6)),
    "eye-and-look-exchanged": (ALONG_X, (6, 2, -6), (-6, 2, 2)),
    "look-is-a-direction": ("eye -4 0 -1\nlook 0 0 -1\nup 0 1 0\n", (10, 4, -11), (11, 4, 10)),
    "l-not-unit": (ALONG_X, (6, 2, -6), (6, 8, -24)),
    "l-not-negated": (ALONG_X, (6, 2, -6), (6, 2, 6)),
    "up-is-a-point": (ALONG_X, (6, 2, -6), (2, -6, -6)),
    "up-is-0-1-0": ("eye 1 2 3\nlook 5 2 3\nup 0 0 2\n", (-2, 6, -6), (6, 2, -6)),
    "r-not-unit": (ALONG_X, (6, 2, -6), (12, 4, -6)),
    "r-is-up-cross-l": (ALONG_X, (6, 2, -6), (-6, -2, -6)),
    "up-as-given": (ALONG_X, (6, 2, -6), (6, 4, -6)),
    "u-is-l-cross-r": (ALONG_X, (6, 2, -6), (6, -2, -6)),
    "matrix-transposed": (ALONG_X, (6, 2, -6), (-9, 4, 7)),
    "l-is-eye-minus-look": (ALONG_X, (6, 2, -6), (-6, 2, 6)),
    "left-handed": (ALONG_X, (6, 2, -6), (-6, 2, 6)),
    "no-rotation": (ALONG_X, (6, 2, -6), (6, 2, 6)),
    "cross-product-sign": (ALONG_X, (6, 2, -6), (6, -2, -6)),}

# Where 4 6 -8 is under perspective 60 0.5 2 6.
X, Y, Z = 0.5 / TAN15, 0.75 / TAN30, 1.25
PROJECT = {
    "fov-in-radians": (0.5 / math.tan(15), 0.75 / math.tan(30), Z),
    "fov-not-halved": (0.5 / TAN30, 0.75 / TAN60, Z),
    "fovx-equals-fovy": (0.5 / TAN30, Y, Z),
    "fovx-divided-by-aspect": (0.5 / TAN60, Y, Z),
    "r-is-t-times-aspect": (1 / TAN30, Y, Z),
    "r-and-t-swapped": (0.5 / TAN30, 0.75 / TAN15, Z),
    "near-and-far-swapped": (X, Y, -1.25),
    "missing-two": (X, Y, 1.625),
    "z-row-sign": (X, Y, -1.25),
    "w-is-plus-z": (-X, -Y, -Z),
    "last-element-is-one": (8 / 9 * X, 8 / 9 * Y, 8 / 9 * Z),
    "matrix-transposed": (X / 6, Y / 6, 15 / 48),  # z' = -2 z - 1, w' = -6 z
    "depth-from-0-to-1": (X, Y, 1.125),
    "depth-is-linear": (X, Y, 2),  # 2 (8 - 2) / (6 - 2) - 1
    "z-not-divided": (X, Y, 10),
    "no-divide": (8 * X, 8 * Y, 8 * Z),
    "divided-twice": (X / 8, Y / 8, Z / 8),
    "depth-in-view-space": (X, Y, -8),
    "depth-divided-twice": (X, Y, Z / 8),
    "tangent-halved": (1 / TAN30, 1.5 / TAN60, Z),
    "near-left-out": (2 * X, 2 * Y, Z),}

WINDOW = "8 8\n-1\n-1\n0 1\n"  # pixels of 0.25 x 0.25, centers at -0.875, -0.625 and so on


def corner(z0=0.5, z1=0.5, z2=0.5, low=-0.7, high=0.72):
    """A triangle with its right angle at the bottom left."""
    return (low, low, z0), (high, low, z1), (low, high, z2)


def twice(triangle):
    return tuple((2 * x, 2 * y, z) for x, y, z in triangle)


def rows(*pixels):
    """A picture of 8 x 8, from the beginnings of its rows."""
    return [row.ljust(8, ".") for row in (*pixels, *[""] * (8 - len(pixels)))]


def stairs(letter="a"):
    return rows(".", *["." + letter * count for count in range(1, 7)])


# Triangles, the config, the right picture, and that with the mistake.
ZBUF = {
    "no-half-pixel-in-x": ([
        corner()], WINDOW, stairs(), rows("", *["." + "a" * count for count in range(2, 8)])),
    "no-half-pixel-in-y": ([
        corner()], WINDOW, stairs(), rows("", "", *["." + "a" * count for count in range(2, 7)])),
    "shifted-by-a-column": ([
        corner()], WINDOW, stairs(), rows("", *[".." + "a" * count for count in range(1, 7)])),
    "shifted-by-a-row": ([
        corner()], WINDOW, stairs(), rows("", "", *["." + "a" * count for count in range(1, 7)])),
    "column-short": ([corner()], WINDOW, stairs(), rows("", *["." + "a" * count for count in range(6)])),
    "row-short": ([corner()], WINDOW, stairs(), rows("", *["." + "a" * count for count in range(1, 6)])),
    "window-is-one": ([twice(
        corner())], "8 8\n-2\n-2\n0 1\n", stairs(), rows(*["a" * count for count in range(1, 9)])),
    "front-limit-ignored": ([corner(-0.5, -0.5, -0.5)], WINDOW, rows(), stairs()),
    "rear-limit-ignored": ([corner(1.5, 1.5, 1.5)], WINDOW, rows(), stairs()),
    "farthest-wins": ([corner(z, z, z) for z in (0.25, 0.75, 0.5)], WINDOW, stairs(), stairs("b")),
    "last-wins": ([corner(z, z, z) for z in (0.25, 0.75, 0.5)], WINDOW, stairs(), stairs("c")),
    "one-color": ([corner(z, z, z) for z in (0.5, 0.25)], WINDOW, stairs("b"), stairs("a")),
    "flat-depth": ([corner(0, 0.3, 0.6)], WINDOW, stairs(), stairs()),
    "upside-down": ([corner()], WINDOW, stairs(), stairs()[::-1]),
    "text-upside-down": ([corner()], WINDOW, stairs(), stairs()),
    "mirrored": ([corner()], WINDOW, stairs(), [row[::-1] for row in stairs()]),
    "depth-limits-are-one": ([corner(-0.5, -0.5, -0.5)], WINDOW, rows(), stairs()),
    "starts-at-zero": ([corner()], WINDOW, stairs(), rows()),
    "one-winding": ([corner()[::-1]], WINDOW, stairs(), rows()),
    "half-triangle": ([((-0.7, -0.7, 0.5), (0.72, 0, 0.5), (-0.7, 0.72, 0.5))], WINDOW,
                      rows(".", ".a", ".aaa", ".aaaaa", ".aaaaa", ".aaa",
                           ".a"), rows(".", ".a", ".aaa", ".aaaaa")),
    # From 0.2 on the left to 0.8 on the right; with the mistake, the other way round.
    "depths-not-sorted": ([corner(0.2, 0.8, 0.2),
                           corner()], WINDOW, rows(".", ".a", ".aa", ".aaa", ".aaab", ".aaabb", ".aaabbb"),
                          rows(".", ".a", ".aa", ".aaa", ".baaa", ".bbaaa", ".bbbaaa")),
    "vertices-at-whole-pixels": ([corner(
        low=-0.6, high=0.8)], WINDOW, rows("", *["." + "a" * count for count in range(2, 7)]),
                                 rows(*["." + "a" * count for count in range(1, 8)])),
    "width-minus-one": ([corner()], WINDOW, stairs(), rows("", *[
        "." + "a" * count for count in range(1, 6)])),
    "column-long": ([corner()], WINDOW, stairs(), rows("", *["." + "a" * count for count in range(2, 8)])),
    "rows-and-columns-exchanged": ([
        corner()], WINDOW, stairs(), rows("", *["." * row + "a" * (7 - row) for row in range(1, 7)])),
    "row-long": ([corner()], WINDOW, stairs(), rows(".", *["." + "a" * count for count in range(1, 8)])),
    "min-for-max": ([corner()], WINDOW, stairs(), rows(".", *[".aaaaaaa"] * 6)),
    # A square in two: all edges, and the diagonal, go through centers.
    "strict-edges": ([((-0.625, -0.625, 0.5), (0.625, -0.625, 0.5), (0.625, 0.625, 0.5)),
                      ((-0.625, -0.625, 0.5), (0.625, 0.625, 0.5), (-0.625, 0.625, 0.5))], WINDOW,
                     rows("", ".bbbbba", ".bbbbaa", ".bbbaaa", ".bbaaaa", ".baaaaa",
                          ".aaaaaa"), rows("", "", "..bbb", "..bb.a", "..b.aa", "...aaa")),
    "random-pixels": ([corner()], WINDOW, stairs(), None),
    "left-and-bottom-exchanged": ([tuple((x, 2 * y, z) for x, y, z in corner())], "8 8\n-1\n-2\n0 1\n",
                                  stairs(), rows(*["..aa"] * 4, *["..aaa"] * 4)),
    "one-depth-a-row": (
        [corner(0.2, 0.8, 0.2), corner()],
        WINDOW,  # from 0.2 on the left to 0.8 on the right
        rows(".", ".a", ".aa", ".aaa", ".aaab", ".aaabb", ".aaabbb"),
        stairs()),
    "turned-by-180-degrees": ([corner()], WINDOW, stairs(), [row[::-1] for row in stairs()[::-1]]),
    "no-depth-passes": ([corner()], WINDOW, stairs(), rows()),
    "black-picture": ([corner()], WINDOW, stairs(), rows()),
    "many-colors": ([corner()], WINDOW, stairs(), stairs("?")),
    "last-triangle-missing": ([corner(z, z, z) for z in (0.5, 0.25)], WINDOW, stairs("b"), stairs("a")),
    "triangle-missing": ([corner(z, z, z) for z in (0.75, 0.25, 0.5)], WINDOW, stairs("b"), stairs("c")),}


def picture(triangles, config, *names):
    """The student's depths, a list of numbers for each row, and picture: a letter a triangle, '.' for black,
    '?' for else."""
    stage3 = "".join("%r %r %r\n" % point for triangle in triangles for point in triangle)
    with tempfile.NamedTemporaryFile("w") as file:
        file.write(config)
        file.flush()
        depths, (width, _, image) = drawn(student, "zbuf", file.name, *switches(*names),
                                          stdin=stage3.encode())
    letters = {bytes(3): ".", **dict(zip((bytes(reference.generated_color(i)) for i in range(5)), "abcde"))}
    return ([numbers(line) for line in depths.decode().split("\n")[:-1]], [
        "".join(letters.get(row[3 * i:3 * i + 3], "?") for i in range(width)) for row in image])


class Lists(unittest.TestCase):
    def test_the_program_has_a_switch_for_every_line_of_the_lists(self):
        self.assertEqual(run(student, "switches").decode().split(), MISTAKES + HABITS)

    def test_the_tables_here_have_every_mistake(self):
        tables = {"model": MODEL, "view": VIEW, "project": PROJECT, "zbuf": ZBUF}
        self.assertEqual([f"{stage}/{name}" for stage, table in tables.items() for name in table], MISTAKES)

    def test_an_unknown_name_is_refused(self):
        done = subprocess.run([student, "model", "--mistake", "model/none"], stdin=subprocess.DEVNULL,
                              stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 2)


class Right(unittest.TestCase):
    def test_the_stages_of_the_plain_samples_with_all_numbers_kept(self):
        for name in PLAIN:
            with self.subTest(sample=name):
                sample = source / "samples" / name
                files = five(sample / "scene.txt", sample / "config.txt", "all/exact-in-memory")
                for file in FIVE[:3]:
                    self.assertEqual(points(files[file]), points(sample_file(bin_dir, sample, file)), file)

    def test_the_pictures_of_all_samples_without_colors(self):
        for name in (*PLAIN, "wide-clipped"):
            with self.subTest(sample=name):
                sample = source / "samples" / name
                text = sample_file(bin_dir, sample, "stage3.txt")
                stage3 = b"".join(line for line in text.splitlines(True) if not line[:1].isalpha())
                depths, image = drawn(student, "zbuf", sample / "config.txt", stdin=stage3)
                self.assertTrue(depths == (sample / "z_buffer.txt").read_bytes(), "the depths differ")
                if b"triangle" not in text:
                    self.assertTrue(image == read_picture(sample / "out.bmp"), "the picture differs")

    def test_stages_joined_by_pipes_need_no_scene(self):
        sample = source / "samples/tilted-camera"
        text = (sample / "scene.txt").read_bytes()
        for stage in ("model", "view", "project"):
            text = run(student, stage, stdin=text)
        self.assertEqual(text, five(sample / "scene.txt", sample / "config.txt")["stage3.txt"])

    def test_the_camera_of_a_scene_for_texts_without_a_header(self):
        scene = source / "samples/tilted-camera/scene.txt"
        text = run(student, "model", "--bare", stdin=scene.read_bytes())
        for stage in ("view", "project"):
            self.assertFalse(any(line[:1].isalpha() for line in text.decode().split("\n")))
            text = run(student, stage, "--bare", "--scene", scene, stdin=text)
        self.assertEqual(text, five(scene, scene.with_name("config.txt"))["stage3.txt"])

    def test_depths_are_those_of_the_plane(self):
        depths, _ = picture([corner(0, 0.3, 0.6)], WINDOW)
        for row in range(1, 7):
            for column, depth in enumerate(depths[row], 1):
                x, y = -0.875 + 0.25 * column, 0.875 - 0.25 * row
                self.assertLess(abs(depth - (0.3 * (x + 0.7) + 0.6 * (y + 0.7)) / 1.42), 1e-6)


class OneMistake(unittest.TestCase):
    def assert_point(self, text, expected):
        for x, y in zip(points(text)[0], expected):
            self.assertAlmostEqual(x, y, delta=1e-7)

    def test_of_model(self):
        for name, (commands, right, wrong) in MODEL.items():
            with self.subTest(mistake=name):
                scene = (CAMERA + commands + "\ntriangle\n1 2 3\n0 0 0\n1 0 0\nend\n").encode()
                self.assertNotEqual(right, wrong)
                self.assert_point(run(student, "model", stdin=scene), right)
                self.assert_point(run(student, "model", *switches("model/" + name), stdin=scene), wrong)

    def test_of_view(self):
        for name, (camera, right, wrong) in VIEW.items():
            with self.subTest(mistake=name):
                text = (camera + "perspective 60 1 1 3\n7 4 9\n0 0 0\n1 0 0\n\n").encode()
                self.assertNotEqual(right, wrong)
                self.assert_point(run(student, "view", stdin=text), right)
                self.assert_point(run(student, "view", *switches("view/" + name), stdin=text), wrong)

    def test_of_project(self):
        text = b"perspective 60 0.5 2 6\n4 6 -8\n0 0 -1\n1 0 -1\n\n"
        self.assert_point(run(student, "project", stdin=text), (X, Y, Z))
        for name, wrong in PROJECT.items():
            with self.subTest(mistake=name):
                self.assertNotEqual((X, Y, Z), wrong)
                self.assert_point(run(student, "project", *switches("project/" + name), stdin=text), wrong)

    def test_of_zbuf(self):
        for name, (triangles, config, right, wrong) in ZBUF.items():
            with self.subTest(mistake=name):
                (depths, image), (wrong_depths, wrong_image) = (picture(triangles, config, *names)
                                                                for names in ((), ("zbuf/" + name,)))
                self.assertEqual(image, right)
                if wrong is None:  # some of the right pixels, others in every run
                    runs = {tuple(picture(triangles, config, "zbuf/" + name)[1]) for _ in range(20)}
                    self.assertGreater(len(runs), 1)
                    self.assertTrue(
                        all(pixel in "." + other for run in runs
                            for pixel, other in zip("".join(run), "".join(right))))
                    continue
                self.assertEqual(wrong_image, wrong)
                self.assertEqual([len(row) for row in depths], [8 - row.count(".") for row in image])
                counts = [8 - row.count(".") for row in (right if name == "black-picture" else wrong_image)]
                self.assertEqual([len(row) for row in wrong_depths],
                                 counts[::-1] if name == "text-upside-down" else counts)
                if name == "flat-depth":
                    self.assertEqual({depth for row in wrong_depths for depth in row}, {0.3})
                elif name != "text-upside-down":
                    self.assertNotEqual(right, wrong)


class Habit(unittest.TestCase):
    def model(self, *names):
        scene = CAMERA + "scale\n0.5 1 1\ntriangle\n0.24691357 12.5 -0.000123456\n0 0 0\n1 0 0\nend\n"
        return run(student, "model", "--bare", *switches(*names), stdin=scene.encode())

    def test_numbers_and_lines_look_different(self):
        for name, line in {
                "six-digits": b"0.123457 12.5 -0.000123456\n", "four-decimals": b"0.1235 12.5000 -0.0001\n",
                "blanks-at-line-ends": b"0.1234568 12.5000000 -0.0001235 \n",
                "carriage-returns": b"0.1234568 12.5000000 -0.0001235\r\n"}.items():
            with self.subTest(habit=name):
                self.assertTrue(self.model().startswith(b"0.1234568 12.5000000 -0.0001235\n"))
                self.assertTrue(self.model("all/" + name).startswith(line), self.model("all/" + name))

    def test_numbers_kept_in_memory_are_not_rounded(self):
        sample = source / "samples/tilted-camera"
        kept, read = (five(sample / "scene.txt", sample / "config.txt", "all/four-decimals",
                           *names)["z_buffer.txt"] for names in (("all/exact-in-memory",), ()))
        right = five(sample / "scene.txt", sample / "config.txt")["z_buffer.txt"]
        self.assertEqual(len(kept.split()), len(right.split()))
        self.assertLess(max(abs(x - y) for x, y in zip(numbers(kept.decode()), numbers(right.decode()))),
                        1e-5)
        self.assertNotEqual(kept, read)

    def test_other_pixels(self):
        triangle = corner(low=-0.6, high=0.8)
        nearest = rows("", *["." + "a" * count for count in range(2, 7)])
        self.assertEqual(picture([triangle], WINDOW)[1], nearest)
        self.assertEqual(
            picture([triangle], WINDOW, "zbuf/center")[1],
            rows("", "", *[".." + "a" * count for count in range(1, 5)]))
        self.assertEqual(
            picture([triangle], WINDOW, "zbuf/truncated-ends")[1],
            rows("", *["." + "a" * count for count in range(1, 6)]))

    def test_the_center_rule_is_ours(self):
        for name in ("torus", "tilted-camera", "nested-transforms"):
            with self.subTest(sample=name):
                sample = source / "samples" / name
                stage3 = sample_file(bin_dir, sample, "stage3.txt")
                theirs = drawn(student, "zbuf", sample / "config.txt", *switches("zbuf/center"),
                               stdin=stage3)[1]
                ours = drawn(bin_dir / "zbuf", sample / "config.txt", "--coverage", "center", stdin=stage3)[1]
                self.assertTrue(theirs == ours, "the pictures differ")

    def test_depths_between_rounded_ends(self):
        triangle = corner(0, 0.71, 0)  # z = (x + 0.7) / 2, so 0.6725 at the right end of row 6
        depths, _ = picture([triangle], WINDOW, "zbuf/rounded-ends-depth")
        self.assertEqual(depths[6], [0, 0.1345, 0.269, 0.4035, 0.538, 0.6725])
        self.assertEqual(picture([triangle], WINDOW)[0][6][0], 0.0375)

    def test_slivers(self):
        line = (-0.6, -0.6, 0.5), (0.1, 0.1, 0.5), (0.6, 0.6, 0.5)
        self.assertEqual(picture([line], WINDOW)[1], rows("", "", ".....a", "....a", "...a", "..a"))
        self.assertEqual(picture([line], WINDOW, "zbuf/no-slivers")[1], rows())

    def test_equal_depths(self):
        self.assertEqual(picture([corner(), corner()], WINDOW)[1], stairs("a"))
        self.assertEqual(picture([corner(), corner()], WINDOW, "zbuf/later-of-equals")[1], stairs("b"))

    def test_everything_printed(self):
        depths, image = picture([corner()], WINDOW, "zbuf/everything-printed")
        self.assertEqual(image, stairs())
        self.assertEqual(depths, [[1.0 if pixel == "." else 0.5 for pixel in row] for row in stairs()])

    def test_other_colors(self):
        self.assertEqual(picture([corner()], WINDOW, "zbuf/other-colors"),
                         (picture([corner()], WINDOW)[0], stairs("?")))

    def test_other_formulas(self):
        """Depths so large that a double has six decimals differ in the last of them; nothing else does."""
        triangle, window = ((-0.7, -0.6, 1e10), (0.8, -0.5, 3e10), (0.1, 0.9, 7e10)), "8 8\n-1\n-1\n0 1e11\n"
        depths, image = picture([triangle], window)
        other_depths, other_image = picture([triangle], window, "zbuf/other-formulas")
        self.assertEqual(image, other_image)
        self.assertNotEqual(depths, other_depths)
        for z, other in zip(sum(depths, []), sum(other_depths, [])):
            self.assertLess(abs(z - other), 1e-3)

    def test_other_file_names(self):
        sample = source / "samples/worked-example"
        files = five(sample / "scene.txt", sample / "config.txt", "zbuf/other-file-names")
        right = five(sample / "scene.txt", sample / "config.txt")
        self.assertEqual({*files}, {*FIVE[:3], "z-buffer.txt", "output.bmp"})
        self.assertEqual([files["z-buffer.txt"], files["output.bmp"]],
                         [right["z_buffer.txt"], right["out.bmp"]])


if __name__ == "__main__":
    unittest.main()
