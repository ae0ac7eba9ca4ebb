#!/usr/bin/env python3
"""The tools print correctly rounded numbers at the extremes, or report why they cannot.

usage: stability_test.py BIN_DIR [--cases FILE] [UNITTEST ARGUMENT...]

Every case runs a real tool; the reference (tests/reference) calculates the expected output at run time,
exactly. With --cases, the model, view and project cases of a JSON file run as well: {"cases": [{"id",
"stage", "title", "input", "expect7" or "expect_policy"}]}, expect7 being three numbers with 7 decimals a
vertex.
"""
import argparse
import json
import re
import sys
import unittest
from fractions import Fraction

import reference
from toolbox import CAMERA, ToolTest, add_claims, run

parser = argparse.ArgumentParser(add_help=False)
parser.add_argument("--cases")
options, rest = parser.parse_known_args(sys.argv[1:])
sys.argv[1:] = rest

PERSPECTIVE = "60 1 1 100"

# Expected output

DIGITS = ("7", "0", "3", "12", "exact")
FEW_DIGITS = ("7", "exact")
LONG = 500  # characters of an input whose exact numbers are as long


def expected(stage, text, *words):
    """The reference's output."""
    return getattr(reference, stage)(text.encode(), reference.read_options(stage, list(words))).decode()


def lines_of(points):
    return "".join(" ".join(point.split()) + "\n" for point in points)


def scene_text(commands, camera=CAMERA):
    """Commands as in a scene, `;` between lines."""
    return camera + "".join(line.strip() + "\n" for c in commands for line in c.split(";")) + "end\n"


def triangle(*points):
    return "triangle;" + ";".join(points)


UNITS = triangle("1 0 0", "0 1 0", "0 0 1")
POINTS = triangle("1 2 3", "-4 5.5 -6.25", "0.1 -0.2 0.3")
LARGE = triangle("1e6 -2e6 3e6", "999999.9999999 1e-7 0.5", "123456.7890123 -654321.0987654 1e5")


class StabilityTest(ToolTest):
    def output(self, done):
        """A tool's output, after checking that it contains no nan, no inf and no signed zero."""
        text = done.stdout.decode()
        self.assertNotRegex(text.lower(), r"\b(nan|inf|infinity)\b")
        self.assertNotRegex(text, r"(?<![\d.])-0(\.0*)?(?![\d.e])")
        return text

    def printed(self, tool, *tool_options, stdin):
        done = run(tool, *tool_options, stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return self.output(done)

    def assert_output(self, stage, text, *words):
        """The tool writes what the reference does, with any number of digits."""
        for digits in DIGITS if len(text) < LONG else FEW_DIGITS:
            options = (*words, "--digits", digits)
            self.assertEqual(self.printed(stage, *options, stdin=text), expected(stage, text, *options),
                             f"--digits {digits}")


# Model


class Model(StabilityTest):
    """Scene commands; the reference runs them too."""
    def check(self, *commands):
        self.assert_output("model", scene_text(commands), "--bare")


add_claims(Model, [
    ("a right angle about z is exact and prints no -0", "rotate;90 0 0 1", UNITS, POINTS),
    ("right angles of either sign and many turns are exact", "rotate;-450 0 1 0", "rotate;36000000630 1 0 0",
     POINTS),
    ("a half turn about a slanted axis is exact", "rotate;180 1 1 0", UNITS, POINTS),
    ("a third of a turn about the diagonal permutes the axes", "rotate;120 1 1 1", UNITS, POINTS),
    ("the sine of 30 degrees is one half, at 1e9 as well", "rotate;30 1 0 0",
     triangle("0 1e9 0", "0 0 1e9", "1 0 0")),
    ("the cosine of 60 degrees is one half, at 1e15 as well", "rotate;60 0 0 -1",
     triangle("1e15 0 0", "0 1e15 0", "1 1 1")),
    ("300 degrees have the sine of -60", "rotate;300 0 1 0", triangle("1e9 0 0", "0 0 1e9", "3 1 4")),
    ("eight turns of 45 degrees are one", "rotate;45 0 0 1", "rotate;135 0 0 1", "rotate;180 0 0 1", POINTS),
    ("two turns of 45 degrees make a right angle", "rotate;45 1 2 3", "rotate;45 1 2 3", POINTS,
     "rotate;-90 1 2 3", POINTS),
    ("1e6 degrees", "rotate;1e6 1 2 3", triangle("1000 0 0", "0 1000 0", "0 0 1000")),
    ("1e15 degrees, where a double's radians are a tenth off", "rotate;1e15 0 1 1", LARGE),
    ("1e22 degrees, the last power of ten a double holds", "rotate;1e22 3 -1 2", POINTS),
    ("1e300 degrees", "rotate;1e300 0 0 1", POINTS),
    ("an angle of 1e-300 degrees, enlarged to be seen", "scale;1e300 1e300 1", "rotate;1e-300 0 0 1",
     triangle("1e3 0 0", "0 1 0", "0 0 1")),
    ("an angle of 1e-7 degrees seen at 1e9", "rotate;1e-7 1 1 1", triangle("1e9 0 0", "0 1e9 0", "0 0 1e9")),
    ("an axis of length 1e-300", "rotate;50 1e-300 -2e-300 0.7e-300", POINTS),
    ("an axis of length 1e300", "rotate;50 1e300 -2e300 0.7e300", POINTS),
    ("an axis of the smallest doubles", "rotate;77 5e-324 1e-323 0", POINTS),
    ("an axis of the largest doubles", "rotate;77 1.7e308 -1.7e308 1.7e308", POINTS),
    ("an axis within 1e-200 of another", "rotate;33 1 1e-200 0", LARGE),
    ("scaled by 1e-300 twice and by 1e300 twice", "scale;1e-300 1e-300 1e-300", "scale;1e-300 1e-300 1e-300",
     "scale;1e300 1e300 1e300", "scale;1e300 1e300 1e300", POINTS),
    ("scaled by 1e300 twice, then down again", "scale;1e300 1e300 1e300", "scale;1e300 1e300 1e300",
     "rotate;10 1 2 3", "scale;1e-300 1e-300 1e-300", "scale;1e-300 1e-300 1e-300", POINTS),
    ("scaled by 1e-300 twice is 0 and no more", "scale;1e-300 1 1", "scale;1e-300 1 1", POINTS),
    ("scaled by 1e300 and turned while it is large", "scale;1e-300 1e-300 1e-300", "rotate;15 3 2 1",
     "scale;1e300 1e300 1e300", LARGE),
    ("what is 0 stays 0 under a scale of 1e600", "scale;1e300 1 1", "scale;1e300 1 1",
     triangle("0 1 0", "0 2 1", "0 3 3")),
    ("1e16 + 0.1 - 1e16 is 0.1", "translate;1e16 0 -1e16", "translate;0.1 0.1 0.1", "translate;-1e16 0 1e16",
     POINTS),
    ("digits beside 1e16 that a double has no room for", "translate;1e16 1e17 -1e18", POINTS),
    ("a pivot at 1e9 and back", "translate;1e9 -1e9 1e9", "rotate;33 1 2 3", "translate;-1e9 1e9 -1e9",
     POINTS),
    ("a pivot at 1e9 with 45 degrees and a scale", "translate;1e9 1e9 0", "scale;0.3 0.3 3",
     "rotate;45 0 0 1", "translate;-1e9 -1e9 0", LARGE),
    ("a translation far below the last digit decides a tie", "translate;1e-25 0 -1e-25",
     "translate;3e-30 0 -3e-30",
     triangle("0.00390625 0.00390625 0.00390625", "0.01171875 0.01171875 0.01171875", "1 2 3")),
    ("ties are rounded to even",
     triangle("0.00390625 0.01171875 -0.00390625", "-0.01171875 1.00390625 0.5", "2.5 1.5 -0.5")),
    ("half a unit and less prints as zero without a sign",
     triangle("-4e-8 4e-8 -0.0", "-5e-8 -6e-8 5.1e-8", "-1e-320 5e-324 -5e-324")),
    ("coordinates of 1e300 print all their digits",
     triangle("1e300 -1e300 0", "1.7976931348623157e308 1 0", "0 0 1")),
    ("ten levels of push, each with a rotation and a scale",
     *["push", "rotate;31 1 2 -1", "scale;1.1 0.9 1.01", "translate;1 -2 3"] * 10, LARGE, *["pop"] * 10,
     POINTS),
    ("36 times 10 degrees about a slanted axis is nothing", *["rotate;10 2 -1 2"] * 36, LARGE),])


class ModelAtLength(StabilityTest):
    def test_a_hundred_thousand_rotations_are_one_by_the_sum_of_the_angles(self):
        text = CAMERA + "rotate\n1.3 3 -2 1\n" * 10**5 + LARGE.replace(";", "\n") + "\nend\n"
        turn = reference.transform("rotate", (10**5 * Fraction(1.3), *map(Fraction, (3, -2, 1))))
        points = [
            turn.moved([Fraction(float(word)) for word in line.split()]) for line in LARGE.split(";")[1:]]
        self.assertEqual(self.printed("model", "--bare", stdin=text),
                         "".join(" ".join(reference.fixed(x, 7) for x in p) + "\n" for p in points) + "\n")

    def test_a_hundred_thousand_pushes_and_moves_are_undone(self):
        text = CAMERA + "push\ntranslate\n0.1 1e6 -1e-6\n" * 10**5 + "pop\n" * 10**5 + POINTS.replace(
            ";", "\n") + "\nend\n"
        self.assertEqual(self.printed("model", "--bare", stdin=text),
                         expected("model", scene_text([POINTS]), "--bare"))

    def test_a_million_pushes_of_one_matrix_are_undone(self):
        text = CAMERA + "push\n" * 10**6 + "pop\n" * 10**6 + POINTS.replace(";", "\n") + "\nend\n"
        self.assertEqual(self.printed("model", "--bare", stdin=text),
                         expected("model", scene_text([POINTS]), "--bare"))


# View


def seen_text(eye, look, up, points):
    return f"eye {eye}\nlook {look}\nup {up}\n" + lines_of(points)


class View(StabilityTest):
    """Eye, look, up, and points in world space."""
    def check(self, eye, look, up, *points):
        self.assert_output("view", seen_text(eye, look, up, points), "--bare")


NEAR_ORIGIN = ("1 2 3", "-4 5 -6", "0.1 0.2 -0.3")
FAR_AWAY = ("1e6 -2e6 3e6", "-123456.7890123 0.5 1e5", "999999.9999999 -1 7")
add_claims(View, [
    ("an eye 1e6 away, points beside it", "1e6 -2e6 3e6", "1000003 -1999996 3000005", "0 1 0.1",
     "1000001.5 -1999999.25 3000001.1", "1000000 -2000000 3000000", "999999.9 -2000001 3000000.3"),
    ("an eye 1e8 away that looks at the origin", "1e8 2e8 -1e8", "0 0 0", "0 1 0", *NEAR_ORIGIN),
    ("an eye 1e10 away, points within 10 of it", "3e10 -1e10 2.5e10", "30000000001 -9999999997 25000000002",
     "0.3 1 -0.2", "30000000002.5 -9999999999.25 25000000001", "30000000000.1 -10000000000.2 25000000000.3",
     "29999999995 -9999999993 25000000009.75"),
    ("an eye 1e12 away", "1e12 1e12 1e12", "1000000000001 1000000000002 999999999997", "0 0 1",
     "1000000000003.5 999999999998.25 1000000000000.125", *NEAR_ORIGIN[:2]),
    ("an eye 1e15 away", "1e15 -1e15 0.3", "1000000000000001 -999999999999998 1", "1 1 0",
     "1000000000000000.5 -1000000000000003.25 2", "1000000000000007 -999999999999999.125 -3",
     "1000000000000000 -1000000000000000 0.3"),
    ("look 1e-300 from eye", "0 0 0", "2e-300 -1e-300 3e-300", "0 1 0", *FAR_AWAY),
    ("look 1e300 from eye", "0 0 0", "2e300 -1e300 3e300", "0 1 0", *FAR_AWAY),
    ("look one bit from an eye far away", "1e15 0 0", "1000000000000000.125 0 0", "0 1 0", "1e15 1 2",
     "1000000000000003 -1 0.5", "999999999999999 7 7"),
    ("look the smallest double from eye", "0 0 0", "5e-324 0 5e-324", "0 1 0", *NEAR_ORIGIN),
    ("up of length 1e-300", "1 2 3", "4 -5 6", "1e-300 2e-300 0", *FAR_AWAY),
    ("up of length 1e300", "1 2 3", "4 -5 6", "1e300 -2e300 5e299", *FAR_AWAY),
    ("up within 1e-12 of the view direction", "0 0 0", "0.6 -0.3 0.2", "0.600000000001 -0.3 0.2",
     "100 200 300", "-300 200 100", "1 0 0"),
    ("up one bit beside the view direction", "0 0 0", "0.6 -0.3 0.2", "0.6000000000000001 -0.3 0.2",
     "100 200 300", "-300 200 100", "1 0 0"),
    ("up within 1e-12 of the direction back", "5 5 5", "4 4.5 5.5", "1 0.500000000001 -0.5", *NEAR_ORIGIN),
    ("a camera on the axes is exact and prints no -0", "0 0 5", "0 0 0", "0 1 0", *NEAR_ORIGIN),
    ("a camera that looks down", "0 10 0", "0 0 0", "0 0 -1", *NEAR_ORIGIN),
    ("a view direction of rational length has exact ties", "0 0 0", "3 0 -4", "0 1 0", "0 0 0.01171875",
     "0.01171875 0 0", "0.00390625 0.00390625 0"),
    ("a tie that the eye makes", "0.00390625 0 0", "0.00390625 0 -1", "0 1 0", "0 0.5 0.00390625",
     "0.0078125 0 -0.01171875", "1 2 3"),
    ("points of 1e300 before a camera on the axes", "0 0 0", "0 0 -1", "0 1 0", "1e300 0 0", "0 -1e300 1e300",
     "1e-300 1 1"),
    ("points that cancel down to their last bits", "0 0 0", "1 1 1", "0 1 0", "1e15 -1e15 1",
     "123456789012.345 -123456789012.344 0", "1e8 1e8 -2e8"),])


class ViewNotes(StabilityTest):
    """A vertex that needs more digits than there are is reported, and is right as far as the digits go."""
    def check(self, eye, look, up, *points):
        text = seen_text(eye, look, up, points)
        done = run("view", "--bare", stdin=text)
        self.assertEqual(done.returncode, 0)
        self.assertIn("view: note: <stdin>:4:1: ", done.stderr.decode())
        words = expected("view", text, "--bare").split()
        self.assertEqual([word[:28] for word in self.output(done).split()], [word[:28] for word in words])


add_claims(ViewNotes, [
    ("points of 1e300", "0 0 0", "1 2 2", "0 1 0", "1e300 0 0", "0 -1e300 1e300", "1e-300 1 1"),
    ("an eye at the largest doubles that looks back", "-1.7e308 0 0", "1.7e308 1 0", "0 1 0", *NEAR_ORIGIN),])

# Project


class Project(StabilityTest):
    """A projection as in a scene, and points in view space; --clip auto."""
    def check(self, projection, *points):
        keyword = "" if projection.split()[0] in ("ortho", "frustum") else "perspective "
        self.assert_output("project", keyword + projection + "\n" + lines_of(points))


add_claims(Project, [
    ("the near and the far plane are -1 and 1 to the last digit", "33 1.1 0.1 7", "0 0 -0.1", "1 1 -7",
     "0.1 0.2 -0.3"),
    ("far is 1e12 near", "60 1 1 1e12", "1 1 -1", "3 -2 -2", "5e11 -5e11 -1e12", "7 7 -123456.789",
     "1 2 -1e6", "1e9 -1e9 -1e10"),
    ("far is 1e12 near, both tiny", "60 1 1e-9 1e3", "1e-9 0 -1e-9", "1e-5 2e-5 -3e-5", "1 -1 -10"),
    ("far - near is 1e-12", "45 1.5 1 1.000000000001", "0.1 0.2 -1", "0.1 0.2 -1.000000000001",
     "0.1 0.2 -1.0000000000005"),
    ("far is the next double after near", "45 1.5 3 3.0000000000000004", "0.1 0.2 -3",
     "0.1 0.2 -3.0000000000000004", "1 1 -3.5"),
    ("fovY of 1e-10 degrees", "1e-10 1 1 1e6", "1e-7 2e-7 -100000", "-3e-8 1e-8 -12345.678", "1e-12 0 -1"),
    ("fovY of 1e-300 degrees", "1e-300 1 1 1e6", "1e-300 2e-300 -1000", "-3e-301 1e-302 -2", "0 0 -1"),
    ("fovY of 179.999999999999 degrees", "179.999999999999 1 1 100", "1e14 1e14 -2", "-3e13 5e13 -7",
     "1 2 -99"),
    ("fovX a hair below 180 degrees", "120 1.4999999999999998 1 100", "1e14 1 -2", "-3e13 5 -7", "1 2 -99"),
    ("fovX of 1e-12 degrees beside fovY of 100", "100 1e-14 1 100", "1e-13 1 -2", "-3e-14 5 -7", "0 2 -99"),
    ("planes at 1e-300", "60 1 1e-300 5e-300", "1e-300 2e-300 -3e-300", "0 1e-300 -1e-300",
     "-1e-301 0 -5e-300"),
    ("planes at 1e300", "60 1 1e300 5e300", "1e300 2e300 -3e300", "0 1e300 -1e300", "-1e299 0 -5e300"),
    ("planes at both ends of a double's range", "60 1 1e-300 1e300", "1 2 -3", "1e299 -1e299 -1e300",
     "1e-300 0 -1e-300"),
    ("a window far from the axis", "frustum 1e8 100000001 -1e8 -99999999 1 1e6", "1e8 -1e8 -1",
     "200000001 -199999999 -2", "1e10 -1e10 -100.5"),
    ("a tiny window", "frustum -1e-300 1e-300 -1e-300 2e-300 1e-10 1", "1e-300 0 -1e-10",
     "1e-291 -1e-291 -0.5", "0 0 -1"),
    ("a mirrored window", "frustum 2 -1 1 -3 1 10", "1 1 -1", "-2 3 -4", "0.1 0.2 -10"),
    ("a parallel projection with a wide box", "ortho -1e300 1e300 -1e300 1e300 -1e300 1e300",
     "1e299 -1e299 1e300", "0 5e299 0", "1 1 1"),
    ("a parallel projection with a narrow box far away",
     "ortho 1e15 1000000000000001 0 1 1e15 1000000000000002", "1000000000000000.5 0.25 -1000000000000000.5",
     "1e15 0 -1000000000000002", "1000000000000001 1 -1e15"),
    ("a parallel projection has no eye plane", "ortho -2 3 -1 1 0.5 20", "1 1 5", "2 0.5 0", "-1 -1 -3"),
    ("exact ties after the divide", "90 1 1 3", "0.00390625 0.01171875 -1", "-0.0078125 0.0234375 -2",
     "1 1 -2"),
    ("what is in front of the near plane stays whole", PERSPECTIVE, "0.1 0.2 -0.5", "0 0 -0.0009765625",
     "1 0 -0.75"),
    ("one vertex behind the eye leaves two pieces", PERSPECTIVE, "0 0 3", "1 0.5 -2", "-1 0.25 -4", "1 2 -3",
     "2 0 -3", "0 0 -3"),
    ("two vertices behind the eye leave one piece", PERSPECTIVE, "0 0 3", "1 0.5 2", "-1 0.25 -4", "1 2 -3",
     "2 0 -3", "0 0 -3"),
    ("a vertex on the eye plane is cut off", PERSPECTIVE, "1 1 0", "1 -1 -2", "-3 0.5 -4"),
    ("a vertex on the eye plane whose zero has a sign", PERSPECTIVE, "1 1 -2", "1 -1 -0.0", "-3 0.5 -4"),
    ("a vertex closer to the eye plane than near / 1024", PERSPECTIVE, "1 1 -0.0009", "1 -1 -2", "-3 0.5 -4"),
    ("a triangle behind the eye leaves nothing but its number's gap", PERSPECTIVE, "1 1 1", "2 0 1", "0 0 5",
     "1 2 -3", "2 0 -3", "0 0 -3"),
    ("pieces at 1e9 and behind the eye", PERSPECTIVE, "1e9 -1e9 1e9", "1e9 2e9 -1e9", "-1e9 0 -1.5e9"),
    ("a cut next to the eye plane", "60 1 1e-9 1e3", "1 1 1e-12", "1 -1 -2", "-3 0.5 -4"),])


class ProjectOtherwise(StabilityTest):
    def test_the_ratio_rule_widens_the_tangent(self):
        words = ("--aspect", "ratio", "--perspective", "77.7", "2.9", "0.1", "1000")
        self.assert_output("project", lines_of(("1 2 -3", "-4 5 -6", "0.1 0.2 -10")), *words)

    def test_a_triangle_behind_the_eye_is_the_same_triangle_cut_by_hand(self):
        # The near plane halves the edges to the vertex behind the eye: (a + b) / 2 and (c + a) / 2.
        whole = lines_of(("0 0 2", "1 0.5 -4", "-1 0.25 -4"))
        by_hand = lines_of(
            ("0.5 0.25 -1", "1 0.5 -4", "-1 0.25 -4", "0.5 0.25 -1", "-1 0.25 -4", "-0.5 0.125 -1"))
        with_camera = "perspective " + PERSPECTIVE + "\n"
        cut = self.printed("project", stdin=with_camera + whole)
        self.assertEqual(cut.replace("triangle 0\n", ""),
                         self.printed("project", "--clip", "none", stdin=with_camera + by_hand))

    def test_neighbors_get_the_same_points_on_the_edge_they_share(self):
        with_camera = "perspective " + PERSPECTIVE + "\n"
        left = self.printed("project", stdin=with_camera + lines_of(("0.1 0.7 3", "1.3 -0.5 -7", "-4 2 -3")))
        right = self.printed("project", stdin=with_camera + lines_of(("1.3 -0.5 -7", "0.1 0.7 3", "5 1 -2")))
        shared = set(left.splitlines()) & set(right.splitlines()) - {"", "triangle 0"}
        self.assertEqual(len(shared), 2)


# Cases from a file


def expanded(case):
    """The lines of a model case's scene after the camera. `rotrep N` stands for N rotations; `[repeat N]` in
    the title repeats each push and pop N times."""
    repeat = re.search(r"\[repeat (\d+)\]", case["title"])
    for line in case["input"]:
        word, *numbers = line.split(None, 1)
        if word == "triangle":
            yield "triangle\n" + lines_of(numbers[0].split(";"))
        elif word == "rotrep":
            count, rotation = numbers[0].split(None, 1)
            yield ("rotate\n" + rotation + "\n") * int(count)
        elif word in ("push", "pop"):
            yield (word + "\n") * (int(repeat[1]) if repeat else 1)
        else:
            yield word + "\n" + numbers[0] + "\n"


def case_run(case):
    """The options and the input of a case, and its number of vertices."""
    if case["stage"] == "model":
        count = sum(line.count(";") + 1 for line in case["input"] if line.startswith("triangle"))
        return ["--bare"], CAMERA + "".join(expanded(case)) + "end\n", count
    given = case["input"]
    points = given.get("points", ["0 0 -1"])
    vertices = lines_of(points + points[-1:] * (-len(points) % 3))
    if case["stage"] == "view":
        camera = "".join(f"{name} {given[name]}\n" for name in ("eye", "look", "up"))
        return ["--bare"], camera + vertices, len(points)
    perspective = " ".join(given[name] for name in ("fovY", "aspect", "near", "far"))
    return [], f"perspective {perspective}\n" + vertices, len(points)


class Cases(StabilityTest):
    def check(self, case):
        tool_options, text, count = case_run(case)
        done = run(case["stage"], *tool_options, stdin=text)
        words = self.output(done).split()
        if "expect7" in case:
            self.assertEqual(done.returncode, 0, done.stderr.decode())
            self.assertEqual(words[:3 * count], [word for vertex in case["expect7"] for word in vertex])
        elif re.match(r"exit!=0(?! \(or)", case["expect_policy"]):
            self.assertNotEqual(done.returncode, 0)


if options.cases:
    with open(options.cases, encoding="utf-8") as cases_file:
        add_claims(Cases, [
            (f"{case['id']} {case['title']}", case)
            for case in json.load(cases_file)["cases"] if case["stage"] in ("model", "view", "project")])

if __name__ == "__main__":
    unittest.main()
