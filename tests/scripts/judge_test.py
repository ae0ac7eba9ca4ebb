#!/usr/bin/env python3
"""scripts/compare --hand-in: the verdicts on sets of files that our own tools and a student's stages make.

usage: judge_test.py BIN_DIR STUDENT [UNITTEST ARGUMENT...]
"""
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import unittest
from unittest import mock

from toolbox import BIN, ToolTest, run_script
import reference
import student  # takes the word after toolbox's

os.environ["BIN"] = str(BIN)
from lib.judging import fit  # noqa: E402
from lib.judging import mistakes  # noqa: E402
from lib.judging import pixel_comparing, pixel_search  # noqa: E402
from lib.judging.hand_in import File, find_files  # noqa: E402
from lib.judging.judge import judge  # noqa: E402
from lib.judging.matrices import image, perspective_matrix, view_matrix  # noqa: E402
from lib.judging.reference import JudgeError, Reference  # noqa: E402
from lib.judging.report import sentence  # noqa: E402
from lib.showing.pictures import read_picture  # noqa: E402
from lib.running.pipe_tools import Tools  # noqa: E402

SCENE = student.SCENE
CONFIG = "90 80\n-0.6\n-0.5\n-1 1\n"
OPEN = "could not be judged"
NAMES = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")


def with_rough_pi(scene, pi):
    """The scene's text with every angle of a rotation as a program takes it whose pi is rough."""
    return re.sub(r"(?<=rotate\n)\S+", lambda word: repr(float(word[0]) * pi / math.pi), scene)


def line_of_triangle(number, scene=SCENE):
    """The line of a scene with its command `triangle`, the first one being number 0."""
    return [
        i for i, line in enumerate(scene.split("\n"), 1) if line.split("#")[0].strip() == "triangle"][number]


def first_difference(one, other):
    """The row and column of the first pixel in which two pictures differ."""
    return next((r, c) for r, row in enumerate(one) for c, color in enumerate(row) if color != other[r][c])


def tool(name, *words, stdin=b""):
    return subprocess.run([BIN / name, *map(str, words)], input=stdin, capture_output=True, check=True).stdout


def print_again(name, form):
    """Writes the numbers of a text in another form."""
    lines = pathlib.Path(name).read_text().split("\n")
    pathlib.Path(name).write_text("\n".join(
        " ".join(form.format(float(word)) for word in line.split()) for line in lines))


class Pixels:
    """The depths (None where no triangle is) and the colors that our zbuf writes, to be changed and written
    again."""
    def __init__(self, folder="."):
        _, _, rows = read_picture(os.path.join(folder, "out.bmp"))
        self.colors = [[tuple(row[i:i + 3]) for i in range(0, len(row), 3)] for row in rows]
        text = pathlib.Path(folder, "z_buffer.txt").read_text().split("\n")
        self.depths = []
        for line, colors in zip(text, self.colors):
            values = iter(map(float, line.split()))
            self.depths.append([next(values) if any(color) else None for color in colors])

    def write(self, depths="z_buffer.txt", picture="out.bmp", empty=None):
        def line(row):
            return "".join(
                f"{empty if z is None else z:.6f}\t" for z in row if z is not None or empty is not None)

        pathlib.Path(depths).write_text("".join(line(row) + "\n" for row in self.depths))
        pathlib.Path(picture).write_bytes(reference.bmp(self.colors))

    def ends(self):
        """The right ends of the picture: (row, column)."""
        return [(r, max(c for c, z in enumerate(row) if z is not None)) for r, row in enumerate(self.depths)
                if any(z is not None for z in row)]

    def clear(self, row, column):
        self.depths[row][column], self.colors[row][column] = None, (0, 0, 0)


class HandIn(ToolTest):
    scene, config = SCENE, CONFIG

    def stages(self, mistake="", in_memory=False):
        for name, text in zip(NAMES, student.texts(self.scene, mistake, in_memory)):
            pathlib.Path(name).write_text(text)

    def draw(self, *options, stage3="stage3.txt"):
        pathlib.Path("config.txt").write_text(self.config)
        tool("zbuf", "config.txt", stage3, "--z-buffer", "z_buffer.txt", "--image", "out.bmp", *options)

    def hand_in(self, *options, mistake="", in_memory=False):
        self.stages(mistake, in_memory)
        self.draw(*options)

    def draw_moved(self, halves):
        """Draws the triangles half a pixel, or more, farther to the right than stage3.txt says."""
        points = (line.split() for line in pathlib.Path("stage3.txt").read_text().split("\n") if line)
        pathlib.Path("moved.txt").write_text("".join(
            f"{float(x) + halves * 1.2 / 90 / 2:.7f} {y} {z}\n" for x, y, z in points))
        self.draw(stage3="moved.txt")

    def through(self, m, number, is_divided=True):
        """Writes what a matrix makes of the right text before stage `number`."""
        self.stages()
        lines = pathlib.Path(NAMES[number - 2]).read_text().split("\n")
        images = (image(m, tuple(map(float, line.split())), is_divided) if line else () for line in lines)
        pathlib.Path(NAMES[number - 1]).write_text("\n".join(" ".join(f"{x:.7f}" for x in p) for p in images))

    def verdict(self, config=True):
        verdict = judge(find_files("."), self.scene.encode(), self.config.encode() if config else None)
        for file in verdict.files:  # never more than all
            self.assertLessEqual(file.explained + (file.differing or 0), file.compared, file)
        return verdict

    def words(self, config=True):
        return [file.verdict for file in self.verdict(config).files]

    def assert_verdicts(self, expected, status):
        verdict = self.verdict()
        self.assertEqual(([file.verdict for file in verdict.files], verdict.status), (expected, status),
                         [(f.cause, f.rule, f.remarks) for f in verdict.files])
        return verdict

    RULE = ["right", "right", "right", "right by another rule", "right by another rule"]


class Right(HandIn):
    def test_few_digits_are_judged_as_what_they_show(self):
        self.stages()
        for name in NAMES[:3]:
            print_again(name, "{:.3g}")
        self.draw()
        self.assert_verdicts(["right"] * 5, 0)

    def test_two_digits_are_too_few(self):
        self.hand_in()
        print_again("stage3.txt", "{:.1f}")
        verdict = self.verdict(config=False)
        self.assertEqual([file.verdict for file in verdict.files],
                         ["right", "right", "too few digits to judge"])
        self.assertEqual(verdict.status, 2)
        self.assertEqual(sentence(verdict), "stage3.txt: too few digits to judge")

    def test_two_digits_are_enough_for_points_that_are_far_off(self):
        self.stages("project/no-divide")
        print_again("stage3.txt", "{:.0e}")
        file = self.verdict(config=False).files[2]
        self.assertEqual((file.verdict, file.cause, file.remarks),
                         ("wrong", "", ["it shows 1 significant digit, too few to name a cause"]))
        self.assertIn("line 1, x of vertex 1 of triangle 0", file.first)

    def test_a_short_number_is_not_a_lack_of_digits(self):
        self.scene = "0 0 5\n0 0 0\n0 1 0\n60 1 1 10\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
        self.stages()
        pathlib.Path("stage1.txt").write_text("0 0 0\n1 0 0\n0 1 0\n")
        self.draw()
        self.assert_verdicts(["right"] * 5, 0)

    def test_other_colors_are_free(self):
        self.hand_in()
        pixels = Pixels()
        pixels.colors = [[tuple(255 - x for x in color) if any(color) else color for color in row]
                         for row in pixels.colors]
        pixels.write()
        verdict = self.assert_verdicts(["right"] * 5, 0)
        self.assertIn("in other colors", verdict.files[4].remarks)

    def test_our_colors_are_ours_where_a_triangle_was_dropped(self):
        self.scene = SCENE.replace("50 1.3 1 50\n",
                                   "50 1.3 1 50\ntriangle\n6 8 14\n7 8 14\n6 9 14\n")  # behind the eye
        pathlib.Path("scene.txt").write_text(self.scene)
        pathlib.Path("config.txt").write_text(CONFIG)
        run_script("stages", "scene.txt", "config.txt", ".", check=True)
        verdict = self.assert_verdicts(["right"] * 5, 0)
        self.assertEqual(verdict.files[4].remarks, [])

    def test_either_of_two_equal_depths(self):
        self.scene = "0 0 5\n0 0 0\n0 1 0\n60 1 1 10\n" + "triangle\n-1 -1 0\n1 -1 0\n0 1 0\n" * 2 + "end\n"
        self.hand_in()
        pixels = Pixels()
        first = next(color for row in pixels.colors for color in row if any(color))
        pixels.colors[40] = [(1, 2, 3) if color == first and column % 3 == 0 else color
                             for column, color in enumerate(pixels.colors[40])]
        pixels.write()
        self.assert_verdicts(["right"] * 5, 0)

    def test_triangles_without_area_are_drawn_or_not(self):
        self.scene = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 10\ntriangle\n-1 -1 0\n1 -1 0\n0 1 0\ntriangle\n-1.2 0 1\n"
                      "-1.2 1.5 1\n-1.2 1 1\nend\n")
        self.hand_in()
        self.assert_verdicts(["right"] * 5, 0)
        self.draw("--coverage", "center")
        self.assertEqual(self.verdict().status, 0)
        self.draw()
        pixels, counts = Pixels(), {}
        for row, colors in enumerate(pixels.colors):
            for column, color in enumerate(colors):
                counts.setdefault(color, []).append((row, column))
        sliver = min((places for color, places in counts.items() if any(color)), key=len)
        self.assertGreater(len(sliver), 5)
        for place in sliver:
            pixels.clear(*place)
        pixels.write()
        self.assert_verdicts(["right"] * 5, 0)


class AnotherRule(HandIn):
    def test_the_center_rule_and_a_file_name_of_the_assignment(self):
        self.hand_in()
        right = Pixels().colors
        self.draw("--coverage", "center")
        row, column = first_difference(right, Pixels().colors)
        os.rename("z_buffer.txt", "zBuffer.txt")
        verdict = self.assert_verdicts(self.RULE, 0)
        self.assertTrue(sentence(verdict).endswith(": the center rule; that counts as right"))
        self.assertTrue(verdict.files[4].first.startswith(f"row {row}, column {column}: a pixel that "))
        self.assertEqual((verdict.files[3].rule, verdict.files[3].file), ("the center rule", "zBuffer.txt"))

    def test_colors_of_the_scene_by_the_center_rule(self):
        self.stages()  # their points
        self.scene = SCENE.replace("push\n", "color 200 100 50\npush\n", 1)
        for coverage, verdict in (("nearest", "right"), ("center", "right by another rule")):
            text = tool("project", stdin=tool("view", stdin=tool("model", stdin=self.scene.encode())))
            pathlib.Path("stage3.txt").write_bytes(text)
            self.draw("--coverage", coverage)
            self.assertEqual(self.words(), ["right"] * 3 + [verdict] * 2)
        pixels = Pixels()
        row, last = pixels.ends()[40]
        pixels.colors[row][last] = (200, 100, 51)
        pixels.write()
        self.assertEqual(self.words()[4], "wrong")

    def test_a_rough_pi_is_named(self):
        for pi, word in ((3.14, "3.14"), (3.1416, "3.1416"), (22 / 7, "3.1428571")):
            with self.subTest(word):
                pathlib.Path("stage1.txt").write_bytes(
                    tool("model", "--bare", stdin=with_rough_pi(SCENE, pi).encode()))
                verdict = self.verdict(config=False).files[0]
                self.assertEqual((verdict.verdict, verdict.rule),
                                 ("right by another rule", f"pi is taken as {word}"))

    def test_what_is_printed_for_untouched_pixels(self):
        self.hand_in()
        Pixels().write(empty=1.0)
        verdict = self.assert_verdicts([*self.RULE[:4], "right"], 0)
        self.assertIn("with the rear limit", verdict.files[3].rule)

    def test_pixels_inside_are_excused_by_none_at_the_borders(self):
        for at_borders, inside, status in (1, 0, 0), (40, 0, 0), (0, 1, 1), (40, 1, 1):
            with self.subTest(at_borders=at_borders, inside=inside):
                self.hand_in()
                pixels = Pixels()
                drawn, ends = sum(z is not None for row in pixels.depths for z in row), pixels.ends()
                for place in ends[1:at_borders + 1]:
                    pixels.clear(*place)
                for i in range(inside):
                    pixels.clear(ends[40][0], ends[40][1] - 6 - i)
                pixels.write()
                file = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2 if status else self.RULE,
                                            status).files[4]
                self.assertEqual((file.cause, file.differing), ("", at_borders + inside))
                if (at_borders, inside) == (1, 0):
                    self.assertEqual(file.rule,
                                     f"another rule at the borders: 1 pixel of {drawn:,} (1 fewer)")

    def test_a_picture_is_right_whatever_the_depths_are(self):
        close = "90 80\n-0.2\n-0.2\n-1 1\n"  # which the triangles cover nearly all
        for self.config, coverage, rule in ((CONFIG, "nearest", ""), (CONFIG, "center", "the center rule"),
                                            (close, "center", "the center rule")):
            self.hand_in("--coverage", coverage)
            pixels = Pixels()
            drawn = sum(z is not None for row in pixels.depths for z in row)
            pixels.depths = [[None if z is None else z - 0.01 for z in row] for row in pixels.depths]
            pixels.write()
            depths, picture = self.assert_verdicts(
                ["right"] * 3 + ["wrong", "right by another rule" if rule else "right"], 1).of("zbuf")
            self.assertEqual((picture.rule, picture.differing, depths.cause), (rule, 0, ""))
            self.assertEqual((depths.differing, depths.compared), (drawn, drawn))
            self.assertRegex(depths.first, r"^row \d+, column \d+: another depth than that of triangle \d$")

    def test_the_background_is_the_color_that_no_triangle_has(self):
        self.config = "90 80\n-0.2\n-0.2\n-1 1\n"  # which the triangles cover nearly all
        self.hand_in("--background", "ffffff")
        _, _, rows = read_picture("out.bmp")
        bare = sum(row[i:i + 3] == b"\xff\xff\xff" for row in rows for i in range(0, len(row), 3))
        self.assertTrue(0 < bare < 90 * 80 / 10, bare)
        self.assert_verdicts(["right"] * 5, 0)
        pathlib.Path("z_buffer.txt").unlink()
        self.assertEqual(self.words()[4], "right")

    def test_empty_rows_may_be_left_out(self):
        self.hand_in()
        text = pathlib.Path("z_buffer.txt").read_text()
        pathlib.Path("z_buffer.txt").write_text("".join(line + "\n" for line in text.split("\n") if line))
        self.assert_verdicts(["right"] * 5, 0)


class Wrong(HandIn):
    def test_a_mistake_is_tried_before_the_latitude_of_borders(self):
        """Half a pixel too far to the right, and by no rule in three pixels of the borders."""
        self.stages()
        pathlib.Path("config.txt").write_text(self.config)
        subprocess.run(
            [student.STUDENT, "zbuf", "config.txt", "--folder", ".", "--mistake", "zbuf/no-half-pixel-in-x"],
            input=pathlib.Path("stage3.txt").read_bytes(), check=True)
        pixels, mistaken = Pixels(), Pixels().colors
        cleared = pixels.ends()[0:30:10]
        for place in cleared:
            pixels.clear(*place)
        pixels.write()
        verdict = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2, 1)
        file = verdict.files[4]
        self.draw()
        right = Pixels().colors
        explained = sum((r, c) not in cleared for r, row in enumerate(pixels.colors)
                        for c, color in enumerate(row) if color != right[r][c])
        self.assertEqual(([cause.name for cause in file.causes], file.differing, file.remarks),
                         (["zbuf/no-half-pixel-in-x"], 3, [
                             f"the cause explains {explained} pixels and leaves 3, the first in row "
                             "{}, column {}".format(*cleared[0])]))
        row, column = first_difference(Pixels().colors, mistaken)
        self.assertTrue(file.first.startswith(f"row {row}, column {column}: a pixel that "), file.first)

    def test_strict_edges_are_holes_on_all_of_an_edge_that_two_triangles_share(self):
        """Some of them are what rounding leaves where a center lies on an edge."""
        self.scene = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 10\ntriangle\n-2 -2 0\n0 -2 0\n0 2 0\ntriangle\n0 -2 0\n"
                      "2 -2 0\n0 2 0\nend\n")
        self.config = "31 31\n"
        for part, names in (1 / 2, []), (1, ["zbuf/strict-edges"]):
            self.hand_in()
            pixels = Pixels()
            holes = [row for row, depths in enumerate(pixels.depths) if depths[15] is not None]
            for row in holes[:int(part * len(holes))]:
                pixels.clear(row, 15)
            pixels.write()
            verdict = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2 if names else self.RULE, len(names))
            self.assertEqual([cause.name for cause in verdict.files[4].causes], names)

    def test_rows_for_columns_of_a_picture_that_is_not_square(self):
        self.hand_in()
        pixels = Pixels()
        for is_of_text, expected in ((True, ["wrong", "wrong"]), (False, ["right", "wrong"])):
            columns = Pixels()
            columns.colors = list(zip(*pixels.colors))
            columns.depths = list(zip(*pixels.depths)) if is_of_text else pixels.depths
            columns.write()
            verdict = self.assert_verdicts(["right"] * 3 + expected, 1)
            self.assertEqual([cause.name for cause in verdict.files[4].causes],
                             ["zbuf/rows-and-columns-exchanged"])

    def test_another_size_of_the_picture_is_named_and_no_other_cause_of_its_depths(self):
        self.hand_in()
        right = pathlib.Path("z_buffer.txt").read_bytes()
        for size, words in (("180 160", ""), ("45 40", ""), ("80 90", ": width and height are exchanged")):
            pathlib.Path("size.txt").write_text(CONFIG.replace("90 80", size))
            tool("zbuf", "size.txt", "stage3.txt", "--z-buffer", "z_buffer.txt", "--image", "out.bmp")
            found = size.replace(" ", " x ")
            cause = f"The picture has {found} pixels, not 90 x 80 as the config says{words}"
            verdict = self.assert_verdicts(["right"] * 3 + ["unreadable"] * 2, 1)
            self.assertEqual([(file.cause, file.first) for file in verdict.files[3:]], [(cause, "")] * 2)
            self.assertTrue(sentence(verdict).endswith(f"(z_buffer.txt and out.bmp are unreadable): {cause}"))
            pathlib.Path("z_buffer.txt").write_bytes(right)
            self.assertEqual(self.assert_verdicts(["right"] * 4 + ["unreadable"], 1).files[4].cause, cause)
            pathlib.Path("z_buffer.txt").write_bytes(right.replace(b"0.", b"0.0"))  # no cause of these
            self.assertEqual(
                self.assert_verdicts(["right"] * 3 + ["wrong", "unreadable"], 1).files[3].cause, "")

    def test_a_blank_picture_has_no_cause_but_what_would_blank_it(self):
        self.hand_in()
        pathlib.Path("z_buffer.txt").write_text("\n" * 80)
        pathlib.Path("out.bmp").write_bytes(reference.bmp([[(0, 0, 0)] * 90] * 80))
        verdict = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2, 1)
        for file in verdict.files[3:]:
            self.assertEqual(([cause.name for cause in file.causes], file.remarks),
                             (["zbuf/starts-at-zero", "zbuf/no-depth-passes"], ["nothing is drawn"]))
        tool("zbuf", "config.txt", "stage3.txt", "--z-buffer", "z_buffer.txt", "--image", "none.bmp")
        file = self.assert_verdicts(["right"] * 4 + ["wrong"], 1).files[4]
        self.assertEqual(([cause.name for cause in file.causes], file.remarks),
                         (["zbuf/black-picture"], ["nothing is drawn"]))

    def test_depths_beside_a_black_picture_are_not_called_empty(self):
        self.hand_in()
        lines = pathlib.Path("z_buffer.txt").read_text().split("\n")
        pathlib.Path("z_buffer.txt").write_text("\n".join(
            "\t".join(line.split()[:-2]) * (row % 2) for row, line in enumerate(lines)))
        pathlib.Path("out.bmp").write_bytes(reference.bmp([[(0, 0, 0)] * 90] * 80))
        depths, picture = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2, 1).files[3:]
        self.assertEqual((depths.cause, depths.remarks), ("", []))
        self.assertEqual([cause.name for cause in picture.causes], ["zbuf/black-picture"])

    def test_a_triangle_missing_in_the_picture_alone_is_named_where_another_shows_in_its_place(self):
        """Half of it lies in front of the first one, whose color then seems to be its own."""
        first, second = ("triangle\n{0} -1 {1}\n{2} -1 {1}\n{2} 1 {1}\n".format(*numbers)
                         for numbers in ((-1, 0, 1), (0, 0.5, 2)))
        self.scene = f"0 0 5\n0 0 0\n0 1 0\n60 1 1 10\n{first}{second}end\n"
        self.hand_in()
        points = pathlib.Path("stage3.txt").read_text()
        pathlib.Path("first.txt").write_text(points[:points.index("\n\n") + 2])
        tool("zbuf", "config.txt", "first.txt", "--z-buffer", "none", "--image", "out.bmp")
        file = self.assert_verdicts(["right"] * 4 + ["wrong"], 1).files[4]
        self.assertEqual([cause.name for cause in file.causes], ["zbuf/last-triangle-missing"])

    def test_two_colors_are_not_one(self):
        """The triangle in front has its color on most pixels of the one behind, too."""
        triangle = "triangle\n-{0} -1 {1}\n{0} -1 {1}\n0 1 {1}\n"
        self.scene = (f"0 0 5\n0 0 0\n0 1 0\n60 1 1 10\n{triangle.format(1, 0)}{triangle.format(0.6, 0.1)}"
                      "end\n")
        for count, names in (0, ["zbuf/one-color"]), (1, []):
            self.hand_in()
            pixels = Pixels()
            front = pixels.colors[40][45]
            others = [(r, c) for r, row in enumerate(pixels.colors) for c, color in enumerate(row)
                      if any(color) and color != front]
            for r, c in others[len(others) // 3 * count:]:
                pixels.colors[r][c] = front
            pixels.write()
            file = self.assert_verdicts(["right"] * 4 + ["wrong"], 1).files[4]
            self.assertEqual([cause.name for cause in file.causes], names)

    def test_a_cause_in_the_depths_is_that_of_a_picture_only_if_the_depths_show_it(self):
        """Depths of view space hide as one depth for each triangle does."""
        self.hand_in()
        self.through(perspective_matrix(50, 1.3, 1, 50), 3)
        points = [line.split() for line in pathlib.Path("stage2.txt").read_text().split("\n")]
        lines = [line.split() for line in pathlib.Path("stage3.txt").read_text().split("\n")]
        flat = pathlib.Path("flat.txt")
        flat.write_text("".join(
            f"{line[0]} {line[1]} {-float(p[2]) / 50}\n" if p else "\n" for line, p in zip(lines, points)))
        self.draw(stage3="flat.txt")
        for file in self.verdict().files[3:]:
            self.assertEqual([cause.name for cause in file.causes], [])

    def test_ends_rounded_up_are_worth_as_much_as_ends_truncated(self):
        """In the picture of triangles that lie half a pixel farther to a side."""
        self.scene = "0 0 5\n0 0 0\n0 1 0\n60 1 1 10\ntriangle\n-0.6 -0.5 0\n0.7 -0.6 0\n0 0.6 0.5\nend\n"
        for half, words in (-1, "truncated"), (1, "rounded up"):
            self.hand_in()
            self.draw_moved(half)
            pathlib.Path("z_buffer.txt").unlink()
            file = self.verdict().files[4]
            self.assertEqual((file.verdict, file.rule), ("right by another rule", f"ends of rows {words}"))
        for end, words in (min, "the left one"), (max, "the right one"):
            self.hand_in()
            pixels = Pixels()
            for row, depths in enumerate(pixels.depths):
                if drawn := [column for column, z in enumerate(depths) if z is not None]:
                    pixels.clear(row, end(drawn))
            pixels.write()
            self.assertEqual([(cause.name, cause.detail) for cause in self.verdict().files[4].causes],
                             [("zbuf/column-short", words)])

    def test_a_search_that_is_given_up_costs_no_points(self):
        with mock.patch.object(pixel_comparing, "MOST_WORK", 0):
            self.hand_in("--coverage", "center")
            self.assert_verdicts(self.RULE, 0)
            pixels = Pixels()
            pixels.depths, pixels.colors = pixels.depths[::-1], pixels.colors[::-1]
            pixels.write()
            verdict = self.assert_verdicts(["right"] * 3 + ["wrong"] * 2, 1)
            self.assertEqual(verdict.files[4].remarks, [pixel_search.GIVEN_UP])
        with mock.patch.object(pixel_comparing, "MOST_OPEN_WORK", 0):
            self.hand_in()
            self.assert_verdicts(["right"] * 3 + [OPEN] * 2, 2)

    def test_two_mistakes_at_once(self):
        for one, other in (("view/eye-added", "view/l-not-negated"), ("view/up-is-0-1-0", "view/r-not-unit"),
                           ("project/fovx-equals-fovy", "project/missing-two"),
                           ("model/axis-not-normalized", "model/angle-in-radians"), ("zbuf/shifted-by-a-row",
                                                                                     "zbuf/flat-depth"),
                           ("zbuf/shifted-by-a-column", "zbuf/width-minus-one"), ("zbuf/last-wins",
                                                                                  "zbuf/text-upside-down")):
            with self.subTest(one, other=other):
                stage = one.split("/")[0]
                pathlib.Path("scene.txt").write_text(self.scene)
                pathlib.Path("config.txt").write_text(self.config)
                subprocess.run([
                    student.STUDENT, "all", "scene.txt", "config.txt", "--folder", ".", "--mistake", one,
                    "--mistake", other], check=True)
                files = self.verdict().of(stage)
                file = files[-1]  # of zbuf the picture, which is wrong, too
                self.assertEqual([cause.name for cause in file.causes], [f"{one} and {other}"])
                self.assertEqual(mistakes.fix(file.causes[0].name),
                                 f"{mistakes.fix(one)} {mistakes.fix(other)}")

    def test_mistakes_in_different_rows_are_joined(self):
        x_row, y_row, z_row, w_row = perspective_matrix(50, 1.3, 1, 50)
        radians = perspective_matrix(50, 1.3, 1, 50, mistakes=["fov-in-radians"])
        ratio = perspective_matrix(50, 1.3, 1, 50, mistakes=["r-is-t-times-aspect"])
        last = f"Row 3, column 4 of the matrix (counted from 1) is {-z_row[3]:.6g}, not {z_row[3]:.6g}"
        for rows, name in (radians[:2], "project/fov-in-radians"), (ratio[:2], "project/r-is-t-times-aspect"):
            self.through((*rows, (*z_row[:3], -z_row[3]), w_row), 3)
            cause, = self.verdict(config=False).files[2].causes
            self.assertEqual((cause.name, cause.text), (name, f"{mistakes.sentence(name)[:-1]}; and: {last}"))
        self.through((tuple(3 * x for x in x_row), (0.1, *y_row[1:]), (*z_row[:3], -z_row[3]), w_row), 3)
        self.assertEqual(
            self.verdict(config=False).files[2].cause,
            f"Row 1, column 1 of the matrix (counted from 1) is {3 * x_row[0]:.5g}, not {x_row[0]:.5g}; and: "
            f"Row 2, column 1 of the matrix (counted from 1) is 0.1, not 0; and: {last}")

    def test_rows_that_are_known_where_no_mistake_is(self):
        """-r without its length, up as the scene has it, and l: three mistakes at once."""
        view = Reference(self.scene.encode(), None, Tools()).scene
        l, rows = [b - a for a, b in zip(view.eye, view.look)], []
        r = [
            view.up[1] * l[2] - view.up[2] * l[1], view.up[2] * l[0] - view.up[0] * l[2],
            view.up[0] * l[1] - view.up[1] * l[0]]
        for row in (r, view.up, l):
            rows.append((*(x / (math.hypot(*l) if row is not view.up else 1) for x in row), 3.0))
        self.through((*rows, (0, 0, 0, 1)), 2, False)
        file = self.verdict(config=False).files[1]
        self.assertEqual((file.cause, file.remarks), ("", [
            "row 1 of its matrix is -(l x up)", "row 2 of its matrix is the scene's up",
            "row 3 of its matrix is look - eye, divided by its length"]))

    def test_an_element_of_the_diagonal(self):
        t, scene = math.tan(math.radians(25)), perspective_matrix(50, 1.3, 1, 50)
        self.through(((1.3 / t, 0, 0, 0), *scene[1:]), 3)  # r = t / aspect
        self.assertEqual(
            self.verdict(config=False).files[2].cause,
            f"Row 1, column 1 of the matrix (counted from 1) is {1.3 / t:.5g}, not {scene[0][0]:.5g}")

    def in_many_colors(self):
        """Gives each pixel with a triangle a color of its own, and counts them."""
        pixels = Pixels()
        drawn = [(r, c) for r, row in enumerate(pixels.depths) for c, z in enumerate(row) if z is not None]
        for r, c in drawn:
            pixels.colors[r][c] = (r + 1, c + 1, 7)
        pixels.write()
        return len(drawn)

    def test_a_triangle_of_many_colors_is_found_before_any_search(self):
        self.hand_in()
        count = self.in_many_colors()
        with mock.patch.object(pixel_comparing, "MOST_WORK", 100_000):
            verdict = self.assert_verdicts([*["right"] * 4, "wrong"], 1)
        file = verdict.files[4]
        self.assertEqual((file.cause, file.remarks),
                         (f"A triangle has many colors ({count:,} for 5 triangles)", []))
        self.assertRegex(file.first, r"^row \d+, column \d+: one of [\d,]+ colors of triangle \d$")

    def test_many_colors_beside_another_mistake(self):
        self.hand_in()
        pixels = Pixels()
        pixels.depths, pixels.colors = pixels.depths[::-1], pixels.colors[::-1]
        pixels.write()
        count, rows = self.in_many_colors(), "The rows are in reverse order"
        self.assertEqual([file.cause for file in self.verdict().files[3:]],
                         [rows, f"{rows}; and: A triangle has many colors ({count:,} for 5 triangles)"])

    def test_a_frame_around_the_picture_is_not_many_colors(self):
        self.hand_in()
        pixels = Pixels()
        for row in (pixels.colors[0], pixels.colors[-1]):
            row[:] = [(250, c, 1) for c in range(len(row))]
        pixels.write(depths="other.txt")
        file = self.verdict().files[4]
        self.assertEqual((file.verdict, file.cause), ("wrong", ""))

    def test_a_picture_of_a_text_that_draws_nothing(self):
        """All its pixels lie at borders, but not at those of what the text draws."""
        self.hand_in()
        pixels = Pixels()
        for row in pixels.depths:
            row[:] = [None if z is None else 0.5 for z in row]
        pixels.write()
        text = pathlib.Path("stage3.txt").read_text()
        pathlib.Path("stage3.txt").write_text("".join(
            " ".join([*line.split()[:2], "5"]) + "\n" if line else "\n" for line in text.split("\n")[:-1]))
        self.assert_verdicts(["right", "right", "wrong", "wrong", "right"], 1)

    def test_the_verdict_names_what_could_not_be_judged(self):
        self.hand_in()
        self.stages("project/no-divide")
        print_again("z_buffer.txt", "0.5")
        verdict = self.verdict()
        self.assertTrue(
            sentence(verdict).endswith("; z_buffer.txt: too few digits to judge"), sentence(verdict))

    def test_model_names_the_line_of_the_scene(self):
        self.hand_in(mistake="model/rotation-transposed")
        verdict = self.verdict()
        self.assertRegex(
            sentence(verdict), "either: .*; or: .*the first wrong triangle is number 0, in line "
            "8 of the scene, after rotate in line 6")
        self.assertEqual({cause.name
                          for cause in verdict.files[0].causes},
                         {"model/rotation-transposed", "model/angle-negated"})

    def test_the_last_element_of_a_matrix(self):
        self.through((*perspective_matrix(50, 1.3, 1, 50)[:3], (0, 0, -1, 1)), 3)
        self.draw()
        verdict = self.assert_verdicts(["right", "right", "wrong", "right", "right"], 1)
        self.assertEqual([cause.name for cause in verdict.files[2].causes], ["project/last-element-is-one"])
        self.assertEqual(verdict.files[2].matrices.differing, {(3, 3)})
        self.assertAlmostEqual(verdict.files[2].matrices.theirs[3][3], 1, delta=1e-3)

    def test_a_cause_outside_the_list_is_an_element(self):
        m = [list(row) for row in view_matrix((3, 4, 7), (0.3, -0.2, 0.1), (0.2, 1, 0.1))]
        m[0][1] = m[0][2]
        self.through(m, 2)
        verdict = self.verdict(config=False)
        self.assertEqual(verdict.files[1].verdict, "wrong")
        self.assertRegex(
            verdict.files[1].cause,
            rf"^Row 1, column 2 of the matrix \(counted from 1\) is {m[0][2]:.6g}, not -0.16246\d$")

    def test_points_that_are_passed_on_unchanged_have_a_cause(self):
        self.stages()
        stage1, stage2 = (pathlib.Path(name).read_text() for name in NAMES[:2])
        points = re.findall(r"(?<=triangle\n)(.+\n.+\n.+\n)", SCENE)
        for file, text, cause in ((0, "\n".join(points),
                                   "The points are those of the scene: no transformation is carried out"),
                                  (1, stage1, "The points are those of the stage before, unchanged"),
                                  (2, stage2, "The points are those of the stage before, unchanged")):
            with self.subTest(NAMES[file]):
                self.stages()
                pathlib.Path(NAMES[file]).write_text(text)
                self.assertEqual(self.verdict(config=False).files[file].cause, cause)

    def test_a_depth_in_even_steps_fits_no_matrix(self):
        self.hand_in(mistake="project/depth-is-linear")
        verdict = self.assert_verdicts(["right", "right", "wrong", "right", "right"], 1)
        self.assertEqual([cause.name for cause in verdict.files[2].causes], ["project/depth-is-linear"])
        self.assertEqual(verdict.files[2].matrices.lines(), ["  no 4 x 4 matrix gives these numbers"])

    def test_numbers_of_nothing_known_have_no_cause(self):
        self.stages()
        for kind, name in enumerate(NAMES[:3]):
            with self.subTest(name):
                kept = pathlib.Path(name).read_text()
                lines = kept.split("\n")
                for line in (5, 13):
                    lines[line] = "0.1234567 0.2345678 -3.3456789"
                pathlib.Path(name).write_text("\n".join(lines))
                file = self.verdict(config=False).files[kind]
                self.assertEqual((file.verdict, file.causes, file.differing), ("wrong", [], 6))
                self.assertEqual(file.remarks[-1], "only triangles 1 and 3 of 5 are wrong")
                self.assertRegex(
                    file.first, r"^line 6, x of vertex 2 of triangle 1: 0\.1234567 in place of "
                    r"\S+, off by \S+$")
                pathlib.Path(name).write_text(kept)

    def test_a_mistake_of_the_picture_alone(self):
        self.hand_in()
        pixels = Pixels()
        colors = pixels.colors
        one_color = [[(9, 9, 9) if any(color) else color for color in row] for row in colors]
        for name, changed in (("upside-down", colors[::-1]), ("one-color", one_color)):
            pixels.colors = changed
            pixels.write(depths="none.txt")
            verdict = self.assert_verdicts(["right"] * 4 + ["wrong"], 1)
            self.assertEqual(verdict.files[4].causes[0].name, f"zbuf/{name}")

    def test_a_shift_by_half_a_pixel_is_no_rule_at_the_borders(self):
        self.hand_in()
        self.draw_moved(1)
        verdict = self.verdict()
        self.assertEqual(verdict.files[4].verdict, "wrong")

    def test_what_is_missing_behind_a_mistake_is_not_called_wrong(self):
        self.hand_in(mistake="view/eye-added")
        for name in NAMES[3:]:
            pathlib.Path(name).unlink()
        self.assertEqual(
            sentence(self.verdict()),
            "the first stage that went wrong is view (stage2.txt is wrong): The eye is added in place of "
            "subtracted; "
            "what follows is right, given that; not handed in: z_buffer.txt and out.bmp")

    def test_the_triangles_of_a_stage_are_counted_by_its_own_input(self):
        self.stages()
        for name, more in (("stage1.txt", 1), ("stage2.txt", 2)):
            text = pathlib.Path(name).read_text()
            pathlib.Path(name).write_text(text + more * text[:text.index("\n\n") + 2])
        verdict = self.verdict(config=False)
        self.assertEqual([file.remarks for file in verdict.files],
                         [["6 triangles in place of 5"], ["7 triangles in place of 6"],
                          ["by the right numbers, which are not those of stage2.txt"]])

    def test_the_triangles_that_are_missing_or_too_many_are_named(self):
        for kind in range(3):
            self.stages()
            kept = pathlib.Path(NAMES[kind]).read_text()
            triangles = kept.split("\n\n")[:5]

            def at(number, words="", kind=kind):
                return f", {words}line {line_of_triangle(number)} of the scene" if kind == 0 else ""

            for order, cause in (((1, 2, 3, 4), "Triangle 0 is missing" + at(0)),
                                 ((0, 1, 2, 3), "Triangle 4 is missing, the last one" + at(4)),
                                 ((0, 3, 4), "Triangles 1 and 2 are missing" + at(1, "the first one in ")),
                                 ((0, 1), "Triangles 2, 3 and 4 are missing, the last 3" +
                                  at(2, "the first one in ")),
                                 ((0, 1, 1, 2, 3, 4), "Triangle 1 is written twice, again in line 9"),
                                 ((0, 1, 2, 3, 4, 0), "Triangle 0 is written twice, again in line 21"),
                                 ((0, 1, 2, 3, 4) * 2,
                                  "Every triangle is written twice, the first one again in line 21"), ((0, 2,
                                                                                                        1),
                                                                                                       "")):
                with self.subTest(NAMES[kind], order=order):
                    pathlib.Path(NAMES[kind]).write_text("".join(triangles[i] + "\n\n" for i in order))
                    file = self.verdict(config=False).files[kind]
                    self.assertEqual((file.verdict, file.cause, file.remarks[0]),
                                     ("wrong", cause, f"{len(order)} triangles in place of 5"))
            stranger = triangles[2].replace("1", "2")
            pathlib.Path(NAMES[kind]).write_text("\n\n".join([*triangles[:2], stranger, *triangles[2:], ""]))
            self.assertEqual(
                self.verdict(config=False).files[kind].cause,
                "Triangle 2 of the text comes from no triangle of the input, first in line 9")
            pathlib.Path(NAMES[kind]).write_text(kept)

    def test_of_two_equal_triangles_nobody_knows_which_is_missing(self):
        self.scene = SCENE.replace("end\n", "triangle\n-3 -1 -3\n3 -1 -3\n0 -1 2\nend\n")
        self.stages()
        text = pathlib.Path("stage1.txt").read_text().split("\n\n")
        pathlib.Path("stage1.txt").write_text("\n\n".join(text[:5]) + "\n")
        self.assertEqual(
            self.verdict(config=False).files[0].cause,
            f"Triangle 5 is missing, the last one, line {line_of_triangle(5, self.scene)} of the scene (or "
            f"the one that is the same)")

    def test_one_vertex_that_is_treated_otherwise(self):
        right, wrong = (student.texts(SCENE, name)[0].split("\n")
                        for name in ("", "model/multiplied-on-the-left"))
        one = "Only the first vertex of each triangle is wrong, the second and third are right: "
        two = "The first and second vertex of each triangle are wrong, the third is right: "
        for vertices, words in (({0}, one), ({0, 1}, two)):
            pathlib.Path(NAMES[0]).write_text("\n".join(
                b if i % 4 in vertices else a for i, (a, b) in enumerate(zip(right, wrong))))
            self.assertEqual(
                self.verdict(config=False).files[0].cause,
                words + mistakes.sentence("model/multiplied-on-the-left")[:-1])

    def test_another_order_is_named(self):
        self.stages()
        for kind in range(3):
            kept = pathlib.Path(NAMES[kind]).read_text()
            triangles = kept.split("\n\n")
            pathlib.Path(NAMES[kind]).write_text("\n\n".join(triangles[t] for t in (0, 3, 2, 1, 4)) + "\n")
            self.assertEqual(
                self.verdict(config=False).files[kind].cause,
                "All triangles are there, but in another order: triangle 1 of the text is triangle 3")
            pathlib.Path(NAMES[kind]).write_text(kept)

    def test_a_decimal_comma_is_named(self):
        self.stages()
        pathlib.Path("stage2.txt").write_text(pathlib.Path("stage2.txt").read_text().replace(".", ","))
        file = self.verdict(config=False).files[1]
        self.assertEqual(file.verdict, "unreadable")
        self.assertRegex(
            file.remarks[0],
            "^stage2.txt:1: expected numbers, found '[-0-9, ]+': write a decimal point, not a comma")

    def test_stray_lines_are_counted_and_the_first_is_named(self):
        self.stages()
        kept = pathlib.Path("stage2.txt").read_text()
        for text, verdict, words in (
            (kept.replace("\n\n", "\ndone\n\n"), "right",
             "5 lines are neither a vertex nor a header line, 1 for each triangle: first line 4, 'done'"),
            ("points: 15\n" + kept, "right",
             "1 line is neither a vertex nor a header line: line 1, 'points: 15'"),
            (kept.replace("\n\n", "\n0.5\n\n"), "unreadable",
             "5 lines are neither a vertex nor a header line, 1 for each triangle: first line 4, '0.5'"),
            (kept.replace("\n\n", " 1\n\n"), "right",
             "5 vertex lines have more than three numbers, of which the first three count: first line 3, '"),
            (kept.replace("\n\n", "\n1 2 3\n\n"), "unreadable",
             "5 of 5 triangles (between blank lines) have another number of vertices than three: first the "
             "one in line 1, 4"), (kept.replace("\n\n", "\n"), "right", "")):
            with self.subTest(words):
                pathlib.Path("stage2.txt").write_text(text)
                file = self.verdict(config=False).files[1]
                self.assertEqual(file.verdict, verdict)
                self.assertIn(words, "; ".join(file.remarks))
                self.assertTrue(words or not file.remarks)

    def test_a_stage_that_drops_the_attributes_is_named(self):
        scene = SCENE.replace("push\n", "color 200 100 50\npush\n", 1).encode()
        right = [tool("model", stdin=scene), tool("view", stdin=tool("model", stdin=scene))]
        line, more = "the line 'attributes'", "the numbers after x, y and z"
        for pattern, by, words in ((rb"attributes.*\n", b"", line), (rb"$^", b"", ""),
                                   (rb"(?m)^((\S+ ){2}\S+)( \S+){3}$", rb"\1", more),
                                   (rb"(?m)^attributes.*\n|(?<=\d)( \S+00){3}$", b"", f"{line} and {more}")):
            pathlib.Path("stage1.txt").write_bytes(right[0])
            pathlib.Path("stage2.txt").write_bytes(re.sub(pattern, by, right[1]))
            self.scene = scene.decode()
            file = self.verdict(config=False).files[1]
            remarks = [remark for remark in file.remarks if remark.startswith("it drops")]
            self.assertEqual((file.verdict, remarks),
                             ("right", [f"it drops {words}: colors or light are lost"] if words else []))


class FollowOn(HandIn):
    """A stage is judged by what it has read, however wrong that is."""
    def drop_all(self, mistake):
        """Stages 1 and 2 with a mistake, and a project that drops what lies behind the eye."""
        self.stages(mistake)
        pathlib.Path("scene.txt").write_text(self.scene)
        pathlib.Path("stage3.txt").write_bytes(tool("project", "--scene", "scene.txt", "stage2.txt"))

    def test_a_right_text_after_a_wrong_one_is_not_accused(self):
        """A program may print other numbers than it goes on with."""
        for kind, mistake in (0, "model/angle-negated"), (1, "view/l-not-negated"), (2, "project/no-divide"):
            with self.subTest(mistake):
                self.hand_in()
                right = {name: pathlib.Path(name).read_bytes() for name in NAMES}
                self.stages(mistake)
                wrong = pathlib.Path(NAMES[kind]).read_bytes()
                for name, data in right.items():
                    pathlib.Path(name).write_bytes(wrong if name == NAMES[kind] else data)
                verdict = self.assert_verdicts(["wrong" if i == kind else "right" for i in range(5)], 1)
                self.assertIn(f"by the right numbers, which are not those of {NAMES[kind]}",
                              verdict.files[kind + 1].remarks)

    def test_nothing_may_be_left_of_a_wrong_view(self):
        self.hand_in()
        self.drop_all("view/l-not-negated")  # all lies behind the eye
        self.assertEqual(pathlib.Path("stage3.txt").read_bytes(), b"")
        self.assert_verdicts(["right", "wrong", OPEN, "right", "right"], 1)  # pixels of the right numbers
        self.draw()
        verdict = self.assert_verdicts(["right", "wrong", OPEN, OPEN, OPEN], 1)
        self.assertEqual([cause.name for cause in verdict.files[1].causes], ["view/l-not-negated"])

    def test_an_empty_text_is_wrong_where_triangles_must_be(self):
        for kind, name in enumerate(NAMES[:3]):
            with self.subTest(name):
                self.stages()
                for later in NAMES[kind:3]:
                    pathlib.Path(later).write_bytes(b"")
                self.draw()
                verdict = self.assert_verdicts(["right"] * kind + ["wrong"] + [OPEN] * (4 - kind), 1)
                self.assertEqual(verdict.files[kind].remarks, ["it is empty"])
                self.assertEqual(verdict.files[kind + 1].remarks, [f"there is too little in {name}"])

    def test_a_scene_without_triangles_is_drawn_right(self):
        self.scene = "0 0 5\n0 0 0\n0 1 0\n60 1 1 10\nend\n"
        self.hand_in()
        self.assert_verdicts(["right"] * 5, 0)

    def test_a_stage_is_not_accused_for_an_input_that_allows_no_verdict(self):
        self.stages()
        lines = pathlib.Path("stage1.txt").read_text().split("\n")
        pathlib.Path("stage1.txt").write_text("\n".join(["1e17 2e18 -3e19", *lines[1:]]))
        self.assertEqual(self.words(config=False), ["wrong", "could not be judged", "right"])


class Files(HandIn):
    def test_names_of_the_assignments_and_of_their_readers(self):
        for depths in ("z_buffer.txt", "zbuffer.txt", "z-buffer.txt", "zBuffer.txt", "z_out.txt",
                       "z_buffer_12.txt"):
            for picture in ("out.bmp", "output.bmp", "output_3.bmp", "1.bmp"):
                os.mkdir("set")
                for name in (*NAMES[:3], depths, picture):
                    pathlib.Path("set", name).touch()
                files = find_files("set")
                self.assertEqual((files["depths"].name, files["picture"].name), (depths, picture))
                shutil.rmtree("set")

    def test_of_two_files_the_assignments_own_name_counts(self):
        self.hand_in()
        pathlib.Path("z_buffer_2.txt").write_text("1\n")
        verdict = self.assert_verdicts(["right"] * 5, 0)
        self.assertIn("not looked at: z_buffer_2.txt", verdict.files[3].remarks)

    def test_what_is_missing_is_not_handed_in(self):
        self.hand_in()
        for name in NAMES:
            os.rename(name, "kept")
            verdict = self.verdict()
            self.assertEqual([file.verdict for file in verdict.files],
                             ["not handed in" if other == name else "right" for other in NAMES])
            self.assertEqual((verdict.status, sentence(verdict)),
                             (1, f"{name} is not handed in; what is there is right"))
            os.rename("kept", name)

    def test_three_stages_pass_without_a_config(self):
        self.stages()
        verdict = self.verdict(config=False)
        self.assertEqual((self.words(config=False), verdict.status, sentence(verdict)),
                         (["right"] * 3, 0, "all three files are right"))

    def test_a_scene_of_before_2020(self):
        self.hand_in()
        lines = SCENE.split("\n")
        old = []
        for i, line in enumerate(lines):
            old.append(line)
            if i == 3:
                old += ["90 80", "0 0 0"]
            if len(lines[i - 3:i]) and lines[i - 3] == "triangle":
                old.append("255 0 128")
        verdict = judge(find_files("."), "\n".join(old).encode(), CONFIG.encode())
        self.assertEqual(verdict.status, 0)
        self.assertIn("before 2020", verdict.files[0].remarks[0])

    def test_a_scene_or_a_config_that_is_refused(self):
        for scene, config, message in ((b"1 2", CONFIG.encode(), "the scene is refused: model: "),
                                       (SCENE.encode(), b"0 0\n", "the config is refused: zbuf: "),
                                       (SCENE.encode(), b"60000 60000\n",
                                        "expected a config of at most 16777216 pixels")):
            with self.assertRaises(JudgeError) as raised:
                judge({}, scene, config)
            self.assertIn(message, str(raised.exception))


class Hostile(HandIn):
    def given(self, kind, data):
        return judge({**find_files("."), kind: File(kind, data)}, SCENE.encode(), CONFIG.encode())

    def test_nothing_that_a_file_holds_ends_the_judge(self):
        self.hand_in()
        header = pathlib.Path("out.bmp").read_bytes()[:54]
        png = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII5BI", 13, b"IHDR", 5790, 5790, 8, 2, 0, 0, 0, 0)
        contents = (b"", b"\0" * 100, b"1" * 10**6, b"-" * 10**5, b"1 2 3 " * 10**5, b"1 2 3\n" * 3,
                    b"1e999 0 0\n" * 3, b"1e308 -1e308 1e308\n" * 15, b"1e-320 0 0\n" * 15, b"nan nan nan\n" *
                    15, b"9" * 5000 + b" 1 1\n", b"\xff\xfe1\0", b"1 2 3\r" * 15, b"#" * 10**6, b"BM", header,
                    header[:18] + struct.pack("<ii", 2**31 - 1, 2**31 - 1) + header[26:],
                    header[:10] + b"\xff" * 4 + header[14:], b"\x89PNG\r\n\x1a\n", png, b"P6 90 80 255\n",
                    b"P6 999999999 999999999 255\n", b"0.5\t" * 90 * 80 + b"\n")
        for kind in ("stage1", "stage2", "stage3", "depths", "picture"):
            for content in contents:
                with self.subTest(kind, content=content[:20]):
                    verdict = self.given(kind, content)
                    self.assertIn(verdict.status, (1, 2))
                    self.assertLess(max(len(" ".join(file.remarks)) for file in verdict.files), 300)
        self.assertEqual(
            self.given("picture", png).files[4].remarks,  # by its header: nothing is unpacked
            ["picture: expected 90 x 80 pixels, found 5790 x 5790"])
        self.assertEqual(self.given("picture", pathlib.Path("out.bmp").read_bytes()[:-9]).files[4].causes, [])

    def test_a_file_that_is_too_large_is_not_read_into_numbers(self):
        self.hand_in()
        verdict = self.given("stage1", b"1 2 3\n" * 10**6)
        self.assertEqual(verdict.files[0].verdict, "unreadable")
        self.assertIn("more than the scene can need", verdict.files[0].remarks[0])

    def test_no_scene_is_so_large_that_a_file_may_be_endless(self):
        ours = Reference(SCENE.encode(), b"4000 4000\n", Tools())
        self.assertEqual(ours.limit("depths"), 256 << 20)
        self.assertLess(ours.limit("stage1"), 2 << 20)
        ours.world = range(10**8)
        self.assertEqual(ours.limit("stage1"), 256 << 20)


class Fit(unittest.TestCase):
    POINTS = [(x, y, z) for x in (-1.0, 0.5, 2.0) for y in (-0.7, 1.1) for z in (-9.0, -5.5, -3.0)]

    def compared(self, theirs, ours, divides, points=None):
        points = points or self.POINTS
        return fit.compare(points, [image(theirs, p, divides) for p in points], [(1e-7,) * 3] * len(points),
                           ours, divides)

    def test_a_projection_is_found_but_for_its_factor(self):
        ours = perspective_matrix(50, 1.3, 1, 50)
        theirs = tuple(
            tuple(7 * x for x in row)
            for row in perspective_matrix(50, 1.3, 1, 50, mistakes=["r-and-t-swapped"]))
        found = self.compared(theirs, ours, True)
        self.assertEqual(found.differing, {(0, 0), (1, 1)})
        self.assertAlmostEqual(found.theirs[0][0], ours[1][1], places=5)

    def test_what_no_matrix_gives_is_not_taken_for_one(self):
        view = view_matrix((3, 4, 7), (0.3, -0.2, 0.1), (0.2, 1, 0.1))
        for divides, ours in ((True, perspective_matrix(50, 1.3, 1, 50)), (False, view)):
            images = [image(ours, p, divides) for p in self.POINTS]
            bent = [(x, y, z + 0.1 * p[0] * p[2]) for p, (x, y, z) in zip(self.POINTS, images)]
            found = fit.compare(self.POINTS, bent, [(1e-7,) * 3] * len(bent), ours, divides)
            self.assertIsNone(found.theirs)

    def test_points_in_a_plane_do_not_determine_it(self):
        flat = [(x, y, 2.0) for x in (-1.0, 0.5, 2.0) for y in (-0.7, 1.1, 3.0)]
        self.assertIsNone(
            self.compared(view_matrix((3, 4, 7), (0, 0, 0), (0, 1, 0)),
                          view_matrix((1, 2, 3), (0, 0, 0), (0, 1, 0)), False, flat))
        self.assertIsNone(
            self.compared(perspective_matrix(50, 1, 1, 9), perspective_matrix(60, 1, 1, 9), True,
                          [(x, y, -2.0) for x, y, _ in flat]))


if __name__ == "__main__":
    unittest.main()
