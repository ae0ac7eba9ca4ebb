#!/usr/bin/env python3
"""After `picture --certain`, every pixel shows the triangle that exact arithmetic shows, but for those that
it lists; pixels that a run has called certain stay as this run drew them.

usage: certain_picture_test.py BIN_DIR SCENES [FIRST]
"""
import contextlib
import math
import operator
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

import certain_test
import exact_picture
import reference
from certain_test import BIN, FIRST, SCENES, SOURCE
from lib.maths import exact
from lib.maths.balls import Ball, Undecided
from lib.running.owners import NOBODY
from lib.showing.pictures import picture_of, read_picture

sys.path.append(str(SOURCE / "scripts/measure"))
from parts.extremes_scenes import SIZE, Case, scene_text
from parts.extremes_truth import true_owners, true_vertices
from picture_parts.certain import DIGITS, MOST_LISTED

PICTURE = SOURCE / "scripts/picture"
CAMERA = ["0 0 5", "0 0 0", "0 1 0", "ortho -1 1 -1 1 1 9"]
CONFIG = "8 8\n-1\n-1\n-1 1\n"
NUMBERED = """#!/bin/sh
all_uncertain() { echo "certain 0 uncertain 64"; for r in $(seq 0 7); do seq -f "$r %%g" 0 7; done; }
number=$(($(cat number) + 1)); echo $number > number
set -- '%s/zbuf' --background 00000$number "$@"
[ $number = 1 ] && exec "$@"
%s
"""


def triangle(*points):
    return "\n".join(["triangle", *points])


CENTERED = triangle("-.625 -.625 0", ".625 -.625 0", ".125 .875 0")  # all corners are centers


def colored(lines):
    """The scene, each triangle in a color of its own."""
    numbers = iter(range(len(lines)))
    return "\n".join(
        "color %d %d %d\n%s" % (*color_of(next(numbers)), line) if line.startswith("triangle") else line
        for line in [*lines, "end\n"])


def color_of(number):
    """That of a triangle, or None of none."""
    return (0, 0, 0) if number is None else (number % 256, 255 - number // 256, 0)


def scene(rng):
    """Half of them have layers that so many decimals confuse."""
    kind = rng.choice((7, 7, 9, 12, None, None, None, None))
    return colored(certain_test.opposed(rng, kind) if kind else certain_test.scene(rng))


class CertainPictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def picture(self, *words, folder=BIN):
        return subprocess.run([PICTURE, *words], capture_output=True, text=True,
                              env={**os.environ, "BIN": str(folder)})

    def certain(self, text, config, output="out.ppm", **settings):
        """The picture's rows of colors, the pixels listed, and whether there are more."""
        pathlib.Path("scene.txt").write_text(text)
        pathlib.Path("config.txt").write_text(config)
        done = self.picture("scene.txt", "config.txt", "--certain", "-o", output, **settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.told = done.stdout.replace("\n", " ")
        told, _, pixels = done.stdout.partition("\n")
        count, total = re.fullmatch("([0-9,]+) of ([0-9,]+) pixels are what exact arithmetic shows",
                                    told).groups()
        listed, _, more = pixels.partition(" and ")[2].partition(":")[2].partition("and")
        listed = [tuple(map(int, pixel.split(","))) for pixel in listed.split()]
        self.assertIn(len(listed), [MOST_LISTED] if more else range(MOST_LISTED + 1))
        numbers = [int(number.replace(",", "")) for number in (total, count, (more or "0").split()[0])]
        self.assertEqual(numbers[0], numbers[1] + numbers[2] + len(listed))
        return self.colors(output.removeprefix("png:")), {(row, column) for column, row in listed}, bool(more)

    def colors(self, path):
        return self.colors_of(read_picture(path)[2])

    def colors_of(self, rows):
        return [[tuple(row[i:i + 3]) for i in range(0, len(row), 3)] for row in rows]

    def drawn(self, *digits, background="000000"):
        """The colors of a run of the pipe, and the pixels that it calls uncertain."""
        text, digits = pathlib.Path("scene.txt").read_bytes(), ["--digits", *digits]
        for words in (["model", "--bounds", *digits], ["view", *digits], ["project", *digits], [
                "zbuf", "config.txt", "--coverage", "center", "--image", "run.ppm", "--certify", "-",
                "--background", background]):
            text = certain_test.run(*words, stdin=text)
        return self.colors("run.ppm"), {tuple(map(int, line.split())) for line in text.splitlines()[2:]}

    def test_no_pixel_is_wrong_but_those_listed(self):
        wrong_by_default = undecided = ties = 0
        for seed in range(FIRST, FIRST + SCENES):
            rng = random.Random(seed)
            text, config = scene(rng), rng.choice(certain_test.CONFIGS)
            true = exact_picture.Exact(text.encode(), "auto").picture(config)
            found, listed, has_more = self.certain(text, config.decode())
            by_default, _ = self.drawn("7")
            _, by_bounds = self.drawn("exact")
            undecided += len(listed)
            for row, numbers in enumerate(true):
                for column, number in enumerate(numbers):
                    color = color_of(number) if number != exact_picture.TIE else None
                    wrong_by_default += by_default[row][column] != color
                    if (row, column) not in listed and not (has_more and (row, column) > max(listed)):
                        self.assertEqual(found[row][column], color, f"seed {seed}: {row} {column}")
                        ties += (row, column) in by_bounds
        print(f"{wrong_by_default} pixels of {SCENES} pictures wrong by default; of what bounds leave "
              f"uncertain, {ties} decided and {undecided} undecided")
        self.assertGreater(wrong_by_default, SCENES)
        self.assertGreater(ties, undecided)

    def test_no_pixel_is_wrong_at_the_extremes(self):
        """Those of docs/accuracy.md; at the last of them, no more than 12 digits are taken."""
        for case in (Case("distance", 1e13), Case("depth", 1e12), Case("size", 1e-12), Case(
                "angle", 179.999), Case("angle", 1e-9)):
            text = scene_text(case)
            owners = true_owners(true_vertices(text), SIZE)
            found, listed, _ = self.certain(colored(text.splitlines()[:-1]), f"{SIZE} {SIZE}\n")
            self.assertEqual(listed, set())
            for place, owner in enumerate(owners):
                row, column = divmod(place, SIZE)
                self.assertEqual(found[row][column], color_of(None if owner == NOBODY else owner), case)

    def test_a_certain_pixel_stays_as_it_was_drawn(self):
        """Each run has a background of its own, which shows where its pixels are. A second certificate that
        calls all uncertain takes nothing back."""
        pathlib.Path("tools").mkdir()
        for tool in ("model", "view", "project"):
            os.symlink(BIN / tool, f"tools/{tool}")
        text = colored([
            *CAMERA, CENTERED, *(triangle(f"{x} {edge} -1", f"{x + 0.5} {edge} -1", f"{x} -1 -1")
                                 for x, edge in ((-0.5, "-.87500001"), (0, "-.8750000000001")))])
        for second in ('exec "$@"', '"$@"; while [ $1 != --certify ]; do shift; done; all_uncertain > $2'):
            pathlib.Path("tools/zbuf").write_text(NUMBERED % (BIN, second))
            pathlib.Path("tools/zbuf").chmod(0o755)
            pathlib.Path("number").write_text("0")
            found, listed, _ = self.certain(text, CONFIG, folder="tools")
            by_run = [
                self.drawn(digits, background=f"00000{number}")
                for number, digits in enumerate((DIGITS, "exact"), 1)]
            left = by_run[0][1]
            self.assertEqual(found, [[by_run[(row, column) in left][0][row][column] for column in range(8)]
                                     for row in range(8)])
            self.assertEqual({color for color in sum(found, []) if color[1] == 0}, {(0, 0, 1), (0, 0, 2)})
            self.assertEqual(listed, set())
            self.assertLess(by_run[1][1], left)

    def test_ties_are_decided(self):
        """The centers on a left edge are covered, those on a right or a lower one are not. Doubles are not
        thirds: they lie inside of the square's left edge and of its upper one."""
        found, listed, _ = self.certain(colored([*CAMERA, CENTERED]), CONFIG)
        self.assertEqual([found[6][column][1] > 0 for column in range(1, 7)], [False] * 6)
        self.assertEqual((found[4][2][1], found[3][5][1], listed), (255, 0, set()))
        colors = ["200 50 0", "20 70 0", "10 250 0"]  # at the corners
        square = "\n".join(
            triangle(*(f"{p} 0 {color}" for p, color in zip(points, colors)))
            for points in (("-2 2", "-2 -2", "2 2"), ("-2 -2", "2 2", "2 -2")))
        found, listed, _ = self.certain(
            "\n".join(["0 0 5", "0 0 0", "0 1 0", "ortho -3 3 -3 3 1 9", "attributes color", square,
                       "end\n"]), "3 3\n")
        drawn, _ = self.drawn("exact")
        self.assertEqual((found[0][:2], found[1][0], listed), ([(200, 50, 0),
                                                                (105, 150, 0)], (110, 60, 0), set()))
        self.assertEqual(drawn[0][:2], [(0, 0, 0)] * 2)
        self.assertEqual({found[2][0], *found[2], *(row[2] for row in found)}, {(0, 0, 0)})

    def test_no_triangle_is_lost(self):
        """On the middle of a grid whose double is not 0, behind a BOM, and with a comment that is not UTF-8;
        where doubles overflow, and where they are all error."""
        for text, size in (("\ufeff" + colored([*CAMERA, triangle("0 1 0", "0 -1 0", "1 0 0")]), 7), (colored(
            [
                *CAMERA, "rotate 30 0 0 1", "scale 5e-324 5e-324 1",
                triangle("1e308 1e308 0", "1e308 -1e308 0", "-1e308 0 0")]), 8)):
            pathlib.Path("config.txt").write_bytes(b"%d %d # \xe9\n" % (size, size))
            pathlib.Path("scene.txt").write_text(text)
            done = self.picture("scene.txt", "config.txt", "--certain", "-o", "out.ppm")
            true = exact_picture.Exact(text.encode(), "auto").picture(b"%d %d\n" % (size, size))
            self.assertEqual(done.stdout, f"{size**2} of {size**2} pixels are what exact arithmetic shows\n",
                             done.stderr)
            owners = sum(true, [])
            self.assertNotIn(exact_picture.TIE, owners)
            self.assertEqual(sum(self.colors("out.ppm"), []), list(map(color_of, owners)))

    def test_too_much_for_the_exact_program_is_told(self):
        walls = [triangle("-.9 -.7 0", ".9 -.7 0", ".1 .9 0")] * 5000
        _, listed, _ = self.certain("\n".join([*CAMERA, "color 9 9 9", *walls, "end\n"]), CONFIG)
        self.assertGreater(len(listed), 10)
        self.assertIn("with all digits (too much for the exact program), and drawn by the rules", self.told)

    def test_what_changes_meanwhile_is_refused(self):
        pathlib.Path("tools").mkdir()
        for tool in ("model", "view", "project"):
            os.symlink(BIN / tool, f"tools/{tool}")
        pathlib.Path("tools/zbuf").write_text(
            f"#!/bin/sh\necho >> $(cat changed)\nexec '{BIN}/zbuf' \"$@\"\n")
        pathlib.Path("tools/zbuf").chmod(0o755)
        pathlib.Path("scene.txt").write_text(colored([*CAMERA, CENTERED]))
        pathlib.Path("config.txt").write_text(CONFIG)
        for changed in ("scene.txt", "config.txt"):
            pathlib.Path("changed").write_text(changed)
            done = self.picture("scene.txt", "config.txt", "--certain", "-o", "out.ppm", folder="tools")
            self.assertEqual(
                (done.returncode, done.stdout, done.stderr),
                (1, "", "picture: scene.txt or its config has changed while it was drawn: draw it again\n"))
            self.assertFalse(os.path.exists("out.ppm"))

    def test_what_stays_undecided_is_listed(self):
        """After a turn, no bits tell that an edge lies on the middle column, but for its end at the origin.
        Of the same triangle twice, the first is seen."""
        turned = [*CAMERA, "rotate 45 0 0 1", triangle("0 0 0", "1 1 0", "-0.2 1 0")]
        pathlib.Path("scene.txt").write_text(colored(turned))
        pathlib.Path("config.txt").write_text("9 9\n")
        done = self.picture("scene.txt", "config.txt", "--certain", "-o", "out.ppm")
        self.assertEqual(
            (done.stdout, done.stderr),
            ("77 of 81 pixels are what exact arithmetic shows\nundecided at 4,096 bits, and drawn by the "
             "rules for ties (column,row): 4,0 4,1 4,2 4,3\n", ""))
        found, listed, _ = self.certain(colored([*turned, turned[-1]]), "8 8\n")
        self.assertEqual((listed, set(sum(found, []))), (set(), {color_of(None), color_of(0)}))

    def test_many_undecided_are_counted(self):
        """More than zbuf lists: everywhere are two triangles."""
        found, listed, _ = self.certain(colored([*CAMERA, *[triangle("-9 -9 0", "9 -9 0", "0 9 0")] * 2]),
                                        "400 300\n-1\n-1\n-1 1\n")
        self.assertEqual((listed, set(sum(found, []))), ({(0, column)
                                                          for column in range(MOST_LISTED)}, {color_of(0)}))

    def test_where_more_digits_are_refused_fewer_have_the_say(self):
        pathlib.Path("scene.txt").write_text(scene_text(Case("angle", 1e-9)))
        done = self.picture("scene.txt", "--size", f"{SIZE}x{SIZE}", "--certain", "-o", "out.ppm")
        self.assertEqual(done.stdout, "9,216 of 9,216 pixels are what exact arithmetic shows\n")
        self.assertRegex(
            done.stderr, "picture: note: no more digits than 12: view: <stdin>:97:1: expected a "
            "vertex within bounds, found numbers that cancel beyond 31 digits, or overflow\n$")

    def test_all_formats_have_the_same_pixels(self):
        text = colored([
            *CAMERA, "background 9 8 7", CENTERED,
            triangle("-1 -1 0", ".125 -1 0", "0.12500000001 1 -1")])
        pictures = [
            self.certain(text, CONFIG.replace("8 8", "9 8"), name)[0]
            for name in ("out.ppm", "out.bmp", "out.png", "png:out.file")]
        self.assertEqual(pictures[1:], pictures[:1] * 3)
        self.assertEqual(
            self.picture("scene.txt", "config.txt", "--certain", "-o", "clear.png", "--background",
                         "00000000").returncode, 0)
        for behind in (b"\t\b\a", b"abc"):  # the first is the scene's background
            _, _, rows = picture_of(pathlib.Path("clear.png").read_bytes(), "clear.png", behind)
            self.assertEqual(
                self.colors_of(rows),
                [[color if color != (9, 8, 7) else tuple(behind) for color in row] for row in pictures[0]])
        done = subprocess.run(f"{PICTURE} - <(cat config.txt) --certain < scene.txt > piped.png", shell=True,
                              executable="bash", capture_output=True, text=True,
                              env={**os.environ, "BIN": str(BIN)})
        self.assertEqual((done.stdout, done.stderr.count("exact arithmetic")), ("", 1))
        self.assertEqual(self.colors("piped.png"), pictures[0])

    def test_what_has_no_certain_pixels_is_refused_with_the_reason(self):
        pathlib.Path("scene.txt").write_text(colored([*CAMERA, CENTERED, "sphere 0 0 0 1"]))
        for words, status, reason in ((["-o", "a.png"], 1, "picture: model: scene.txt:"), ([
                "-o", "a.png", "--samples", "3"], 2, "--samples 3 does not go with --certain: a mean of"), ([
                    "-o", "a.png", "--trace"
                ], 2, "--trace does not go with --certain: zbuf tells which"), ([
                    "-o", "a.png", "--stages", "."], 2, "--stages does not go with --certain: the stages"), ([
                        "-o", "a.gif"], 2, "-o a.gif does not go with --certain: it takes a .png, .bmp"), ([
                            "-o",
                            "no/a.png"], 1, "picture: cannot open no/a.png: No such file or directory"), ([
                                "-o", "a.png", "--size",
                                "9x9"], 2, "expected no --size with CONFIG, found 9x9")):
            config = ["config.txt"] * ("--size" in words)
            done = self.picture("scene.txt", *config, "--certain", *words)
            self.assertEqual((done.returncode, done.stdout), (status, ""), words)
            self.assertIn(reason, done.stderr)
        self.assertEqual(os.listdir(), ["scene.txt"])


class Balls(unittest.TestCase):
    def setUp(self):
        self.addCleanup(setattr, Ball, "bits", Ball.bits)

    def test_what_is_calculated_with_few_bits_has_the_true_number(self):
        """Numbers stand for themselves, or are known to few bits."""
        Ball.bits, rng, decided = 24, random.Random(1), 0

        def known(x):
            """A ball around x, or x."""
            ball, off = Ball(x).rounded(), rng.randint(1, 5)
            return rng.choice(
                (Ball(x), Ball.around(ball.middle + rng.randint(-off, off), ball.radius + off,
                                      ball.exponent)))

        for _ in range(5000):
            x, y = (Fraction(rng.randint(-99, 99), rng.randint(1, 99)) * Fraction(2)**rng.randint(-40, 40)
                    for _ in "xy")
            for of in (operator.add, operator.sub, operator.mul, operator.truediv):
                with contextlib.suppress(Undecided, ZeroDivisionError):
                    self.assertTrue(has(of(known(x), known(y)), of(x, y)), (of, x, y))
            with contextlib.suppress(Undecided):
                self.assertEqual(known(x).sign, (x > 0) - (x < 0))
                decided += 1
                self.assertTrue(has(exact.root(known(x * x)), abs(x)))
        self.assertGreater(decided, 4000)

    def test_sines_and_cosines_have_the_true_number(self):
        for degrees in (0, 30, -45, 90, 17.25, 720.125, -7e10, 1e-300, math.nextafter(30, 0)):
            true = reference.sine_and_cosine(Fraction(degrees))
            for few, true in zip(exact.sine_cosine(Ball(degrees)), true):
                self.assertTrue(has(few, true, Fraction(1, 10**140)), degrees)


def has(ball, x, slack=0):
    """Whether the ball has the number x, or one as near to it as `slack`."""
    if ball.exact is not None:
        return abs(ball.exact - x) <= slack
    unit = Fraction(2)**ball.exponent
    return abs(ball.middle * unit - x) <= ball.radius * unit + slack


if __name__ == "__main__":
    unittest.main()
