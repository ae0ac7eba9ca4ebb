#!/usr/bin/env python3
"""scripts/compare: its reports on texts and pictures that differ, and on students' errors.

usage: compare_test.py BIN_DIR STUDENT [UNITTEST ARGUMENT...]
"""
import functools
import math
import pathlib
import unittest

from toolbox import SOURCE, ToolTest, run, run_script
import reference
import student  # takes the word after toolbox's
from lib.judging.mistakes import sentences
from lib.showing.pictures import png, read_picture

SAMPLE = SOURCE / "samples/tilted-camera"
SCENE = (SAMPLE / "scene.txt").read_text()
WIDE = student.SCENE
TRIANGLE = "0.1000000 0.2000000 0.3000000\n1.0000000 0.0000000 0.5000000\n0.0000000 1.0000000 0.7000000\n\n"

compare = functools.partial(run_script, "compare")


def cells(table, name):
    """The second cell of the rows that begin with `name`."""
    rows = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in table.splitlines()
            if line.startswith("|")]
    return [row[1] for row in rows if row[0] == name]


def bmp(width, height, pixels):
    """A BMP whose pixels are a function of column and row."""
    return reference.bmp([[pixels(c, r) for c in range(width)] for r in range(height)])


class TwoFiles(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("wide.txt").write_text(WIDE)

    def told(self, a, b, *options, status=1):
        pathlib.Path("a").write_bytes(a if isinstance(a, bytes) else a.encode())
        pathlib.Path("b").write_bytes(b if isinstance(b, bytes) else b.encode())
        done = compare("a", "b", *options)
        self.assertEqual((done.stderr, done.returncode), ("", status), done.stdout)
        return done.stdout

    def test_the_same_text_has_no_differences(self):
        table = self.told(TRIANGLE, TRIANGLE, status=0)
        self.assertEqual((cells(table, "numbers compared"), cells(table, "numbers that differ")),
                         (["9"], ["0"]))

    def test_the_first_and_the_largest_have_their_places(self):
        table = self.told(TRIANGLE + TRIANGLE.replace("1.0000000 0.0000000 0.5", "1.0000000 0.2500000 4.5"),
                          TRIANGLE * 2)
        self.assertEqual(cells(table, "numbers that differ"), ["2"])
        self.assertEqual(cells(table, "largest difference"),
                         ["line 6, z of vertex 2 of triangle 1: 4.5 in A, 0.5 in B, off by 4"])
        self.assertEqual(cells(table, "first difference"),
                         ["line 6, y of vertex 2 of triangle 1: 0.25 in A, 0 in B"])

    def test_comments_and_blanks_do_not_count(self):
        self.told("# mine\n\n" + TRIANGLE.replace(" ", "\t ").replace("\t", " "), TRIANGLE, status=0)

    def test_a_tolerance_may_be_reached_but_not_exceeded(self):
        other = TRIANGLE.replace("0.1000000", "0.1000001")
        self.told(other, TRIANGLE, "--tolerance", "1e-7", status=0)
        self.told(other, TRIANGLE, "--tolerance", "0.99e-7")

    def test_missing_triangles_are_told(self):
        self.assertEqual(cells(self.told(TRIANGLE, TRIANGLE * 3), "not alike"),
                         ["1 and 3 triangles: A lacks triangles 1 and 2 of B (or what is the same)"])

    def test_what_one_text_lacks_is_left_out_of_the_comparison(self):
        triangles = [TRIANGLE.replace("0.1000000", f"0.{i}") for i in range(1, 6)]
        whole, cut = "".join(triangles), "".join(triangles[:1] + triangles[3:])
        for a, b, words in ((cut, whole, "3 and 5 triangles: A lacks triangles 1 and 2 of B"),
                            (whole, cut, "5 and 3 triangles: B lacks triangles 1 and 2 of A")):
            table = self.told(a, b)
            self.assertEqual(
                [cells(table, name) for name in ("numbers compared", "numbers that differ", "not alike")],
                [["27"], ["0"], [words]])
        table = self.told(triangles[4] + cut, whole)  # in another order: nothing can be said
        self.assertEqual(cells(table, "not alike"), ["4 and 5 triangles"])
        self.assertNotEqual(cells(table, "numbers that differ"), ["0"])

    def test_another_camera_is_told(self):
        self.assertEqual(cells(self.told("eye 0 0 1\n" + TRIANGLE, "eye 0 0 2\n" + TRIANGLE), "not alike"),
                         ["header line eye: 0 0 1 and 0 0 2"])

    def row(self, name, a, b, *options):
        return " ".join(cells(self.told(a, b, *options), name))

    def test_one_unit_is_rounding(self):
        self.assertIn("rounding", self.row("hint", TRIANGLE.replace("0.7000000", "0.7000001"), TRIANGLE))
        self.assertEqual(self.row("hint", TRIANGLE.replace("0.7000000", "0.7000002"), TRIANGLE), "")

    def test_factors_show_in_the_numbers(self):
        right = student.texts(SCENE)
        for mistake, stage, words in (("view/l-not-negated", 1,
                                       "x, y and z of A are 1, 1 and -1 times those of B"), ("view/eye-added",
                                                                                             1, ""),
                                      ("project/no-divide", 2, ""), ("project/last-element-is-one", 2, "")):
            with self.subTest(mistake):
                table = self.told(student.texts(SCENE, mistake)[stage], right[stage])
                self.assertEqual((" ".join(cells(table, "hint")), cells(table, "cause")), (words, []))

    def test_with_the_scene_the_mistake_is_named(self):
        right = student.texts(WIDE)
        for stage, name in enumerate(("model/pop-ignored", "view/eye-added", "project/fov-in-radians")):
            with self.subTest(name):
                wrong = student.texts(WIDE, name)[stage]
                self.assertIn(sentences()[name].rstrip("."),
                              self.row("cause", wrong, right[stage], "--scene", "wide.txt"))

    def test_the_matrix_stands_beside_the_right_one(self):
        told = self.told(
            student.texts(WIDE, "project/r-and-t-swapped")[2],
            student.texts(WIDE)[2], "--scene", "wide.txt")
        rows = told.split("| right\n")[1].splitlines()
        self.assertEqual([row.count("*") for row in rows], [1, 1, 0, 0])

    def test_a_mistake_nobody_knows_is_told_to_be_one(self):
        right = student.texts(WIDE)[1]
        lines = right.split("\n")
        lines[4] = "1.0000000 2.0000000 3.0000000"
        self.assertEqual(self.row("cause", "\n".join(lines), right, "--scene", "wide.txt"),
                         "none of those known")

    def test_a_text_of_another_scene_is_not_taken_as_right(self):
        self.assertEqual(self.row("cause", TRIANGLE, TRIANGLE.replace("0.7", "0.8"), "--scene", "wide.txt"),
                         "not looked for: b is no output of this scene's stages")

    def test_z_buffers_are_compared_row_by_row(self):
        table = self.told("\n0.5\t0.25\t\n0.1\t\n", "\n0.5\t0.5\t\n0.1\t0.2\t\n")
        self.assertEqual(cells(table, "not alike"), ["1 row shows another number of pixels, row 2: 1 and 2"])
        self.assertEqual(cells(table, "first difference"), ["line 2, number 2: 0.25 in A, 0.5 in B"])

    def test_pixels_differ_by_their_worst_channel(self):
        a = bmp(5, 3, lambda c, r: (c, r, 9 if (c, r) == (3, 1) else 0))
        table = self.told(a, bmp(5, 3, lambda c, r: (c, r, 0)), "--image", "diff.png")
        self.assertEqual(cells(table, "pixels that differ"), ["1"])
        self.assertEqual(cells(table, "first difference"), ["column 3, row 1, blue: 9 in A, 0 in B"])
        width, height, rows = read_picture("diff.png")
        red = [(c, r) for r in range(height) for c in range(width) if rows[r][3 * c] != rows[r][3 * c + 1]]
        self.assertEqual(red, [(3, 1)])

    def test_pictures_of_three_formats_are_the_same(self):
        pathlib.Path("p.bmp").write_bytes(bmp(5, 3, lambda c, r: (50 * c, 80 * r, 7)))
        pixels = b"".join(bytes((50 * c, 80 * r, 7)) for r in range(3) for c in range(5))
        self.told(pathlib.Path("p.bmp").read_bytes(), b"P6\n# comment\n5 3\n255\n" + pixels, status=0)
        self.told(pathlib.Path("p.bmp").read_bytes(), png(*read_picture("p.bmp")), status=0)

    def test_two_kinds_cannot_be_compared(self):
        pathlib.Path("a").write_text(TRIANGLE)
        pathlib.Path("b").write_bytes(bmp(1, 1, lambda c, r: (0, 0, 0)))
        done = compare("a", "b")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "compare: expected two files of a kind, found a stage text and an image\n"))

    def test_what_cannot_be_read_is_said_with_its_place(self):
        pathlib.Path("a").write_text(TRIANGLE)
        for name, text, message in (("none", None, "cannot read none: No such file or directory"),
                                    ("b", TRIANGLE + "1 2 x\n", "b:5: expected numbers, found '1 2 x'"),
                                    ("b", "1 2 3\n",
                                     "b: expected three vertices a triangle, found 1 in all")):
            if text:
                pathlib.Path(name).write_text(text)
            done = compare("a", name)
            self.assertEqual((done.returncode, done.stderr), (2, f"compare: {message}\n"))


class Five(ToolTest):
    def hand_in(self, mistake="", in_memory=True, scene=SCENE):
        """Writes the five files of a student whose zbuf is right."""
        pathlib.Path("theirs").mkdir(exist_ok=True)
        for number, text in enumerate(student.texts(scene, mistake, in_memory), 1):
            pathlib.Path(f"theirs/stage{number}.txt").write_text(text)
        self.draw()

    def draw(self):
        done = run("zbuf", SAMPLE / "config.txt", "theirs/stage3.txt", "--z-buffer", "theirs/z_buffer.txt",
                   "--image", "theirs/out.bmp")
        self.assertEqual(done.returncode, 0, done.stderr)

    def verdict(self, status=1, scene=SAMPLE / "scene.txt"):
        done = compare("--hand-in", "theirs", scene, SAMPLE / "config.txt")
        self.assertEqual((done.stderr, done.returncode), ("", status), done.stdout)
        return next(line for line in done.stdout.splitlines() if line.startswith("Verdict: ")), [
            line.split("|")[3].strip() for line in done.stdout.splitlines()[2:7]]

    def test_the_last_line_is_the_command_to_type_next(self):
        files = f"{SAMPLE}/scene.txt {SAMPLE}/config.txt"
        self.hand_in("project/no-divide")
        done = compare("--hand-in", "theirs", *files.split())
        self.assertEqual(done.stdout.splitlines()[-1], f"Next: pipeline explain {files} --triangle 0")
        self.hand_in(in_memory=False)
        self.assertEqual(self.verdict(status=0), ("Verdict: all five files are right.", ["right"] * 5))
        pathlib.Path("theirs/z_buffer.txt").write_text("0.1\t0.234567\n")
        done = compare("--hand-in", "theirs", *files.split())
        self.assertEqual(done.stdout.splitlines()[-1], f"Next: pipeline inspect {files} --theirs theirs")

    def test_cut_decimals_are_no_mistake(self):
        self.hand_in()
        data = SCENE.encode()
        for number, words in ((1, ["model"]), (2, ["view"]), (3, ["project"])):
            data = run(*words, "--digits", "exact", stdin=data).stdout
            lines = [line for line in data.decode().split("\n") if not line[:1].isalpha()]
            cut = [
                " ".join(f"{math.trunc(float(word) * 1e7) / 1e7:.7f}" for word in line.split())
                for line in lines]
            pathlib.Path(f"theirs/stage{number}.txt").write_text("\n".join(cut))
        self.draw()
        self.assertEqual(self.verdict(status=0)[1], ["right"] * 5)

    def test_the_aspect_rule_of_the_scene_is_ours_too(self):
        scene = SCENE.replace("\n41 1 2 25 ", "\n41 1.25 2 25 ratio ")
        pathlib.Path("ratio.txt").write_text(scene)
        self.hand_in(scene=scene)
        self.assertEqual(self.verdict(status=0, scene="ratio.txt")[1], ["right"] * 5)
        self.hand_in(scene=scene.replace(" ratio ", " "))
        self.assertIn("the first stage that went wrong is project", self.verdict(scene="ratio.txt")[0])
        self.hand_in("view/l-not-negated", scene=scene)
        sentence, verdicts = self.verdict(scene="ratio.txt")
        self.assertIn("the first stage that went wrong is view ", sentence)
        self.assertEqual(verdicts.count("wrong"), 1)

    def test_two_mistakes_are_both_found(self):
        self.hand_in("model/rotation-transposed")
        text = pathlib.Path("theirs/z_buffer.txt").read_text().split("\n")
        filled = next(i for i, line in enumerate(text) if line)
        text[filled] = text[filled].replace("0.", "1.")
        pathlib.Path("theirs/z_buffer.txt").write_text("\n".join(text))
        sentence, verdicts = self.verdict()
        self.assertIn("the first stage that went wrong is model", sentence)
        self.assertIn("also wrong, by themselves: z_buffer.txt", sentence)
        self.assertEqual(verdicts, ["wrong", "right", "right", "wrong", "right"])

    def test_a_wrong_scene_is_a_message(self):
        done = compare("--hand-in", "theirs", "none.txt", SAMPLE / "config.txt")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "compare: cannot read none.txt: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
