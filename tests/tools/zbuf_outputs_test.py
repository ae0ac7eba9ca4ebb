#!/usr/bin/env python3
"""Where zbuf's image and depths go, the size in place of a config, and the background.

usage: zbuf_outputs_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import subprocess
import unittest

from toolbox import CAMERA, NO_TRIANGLE, ToolTest, command, pipe, pseudo_terminal, run, stage_texts

# The lower left half of the screen, and all of it.
HALF = "-1.0000000 -1.0000000 0.0000000\n1.0000000 -1.0000000 0.0000000\n-1.0000000 1.0000000 0.0000000\n\n"
ALL = "-9.0000000 -9.0000000 0.0000000\n9.0000000 -9.0000000 0.0000000\n0.0000000 9.0000000 0.0000000\n\n"


class OutputTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("stage3.txt").write_bytes(stage_texts()[2])

    def assert_zbuf(self, *words, stdin=""):
        """The stdout of a run that has nothing to say."""
        done = run("zbuf", *words, stdin=stdin)
        self.assert_quiet_success(done)
        return done.stdout


class Size(OutputTest):
    def test_is_that_of_a_config_without_limits(self):
        pathlib.Path("config.txt").write_text("17 9\n")
        expected = self.assert_zbuf("config.txt", "stage3.txt"), pathlib.Path("out.bmp").read_bytes()
        os.unlink("out.bmp")
        self.assertEqual((self.assert_zbuf("--size", "17x9", "stage3.txt"), pathlib.Path("out.bmp").read_bytes()), expected)
        for operands in ([], ["-"]):
            self.assertEqual(self.assert_zbuf("--size=17x9", *operands, stdin=pathlib.Path("stage3.txt").read_text()), expected[0])

    def test_keeps_the_limits_of_a_config(self):
        pathlib.Path("config.txt").write_text("34 18\n-0.5\n-0.7\n-0.9 0.9\n")
        pathlib.Path("smaller.txt").write_text("17 9\n-0.5\n-0.7\n-0.9 0.9\n")
        expected = self.assert_zbuf("smaller.txt", "stage3.txt")
        text = pathlib.Path("stage3.txt").read_text()
        self.assertEqual(self.assert_zbuf("--size", "17x9", "config.txt", "stage3.txt"), expected)
        self.assertEqual(self.assert_zbuf("--size", "17x9", "config.txt", "-", stdin=text), expected)
        self.assertEqual(self.assert_zbuf("config.txt", "--size", "17x9", stdin=text), expected)

    def test_notes_a_picture_of_another_shape_than_the_configs(self):
        pathlib.Path("config.txt").write_text("400 300\n-1\n-0.75\n-1 1\n")
        done = run("zbuf", "config.txt", "--size", "100x100", "stage3.txt")
        self.assertEqual((done.returncode, done.stderr.decode()), (0, "zbuf: note: a square of the config's 400 x 300 picture is drawn 0.75 times as wide as high: "
                                                                      "--size 100x75 keeps its shape\n"))
        self.assert_zbuf("config.txt", "--size", "101x75", "stage3.txt")  # a fraction of a pixel is no stretch
        self.assert_zbuf("--size", "100x100", "stage3.txt")

    def test_a_single_operand_that_is_no_config_is_the_input(self):
        with open("stage3.txt") as text:
            done = subprocess.run(["bash", "-c", '"$0" --size 17x9 -o - <(cat)', *command("zbuf")], stdin=text, capture_output=True)
        self.assertEqual((done.returncode, done.stderr, done.stdout), (0, b"", self.assert_zbuf("--size", "17x9", "-o", "-", "stage3.txt")))
        done = run("zbuf", "--size", "17x9", "missing.txt")
        self.assertEqual((done.returncode, done.stderr.decode()), (1, "zbuf: cannot open missing.txt: No such file or directory\n"))

    def test_has_the_largest_pictures_of_a_config(self):
        done = run("zbuf", "--size", "65535x1", "-o", "-")
        self.assertEqual((done.stdout[:14], done.stderr.decode(), done.returncode), (b"P6\n65535 1\n255", NO_TRIANGLE, 0))


class Image(OutputTest):
    def test_o_is_image(self):
        self.assert_zbuf("config.txt", "stage3.txt", "--image", "a.ppm")
        self.assert_zbuf("config.txt", "stage3.txt", "-o", "b.ppm")
        self.assertEqual(pathlib.Path("a.ppm").read_bytes(), pathlib.Path("b.ppm").read_bytes())

    def test_a_dash_is_standard_output_without_depths(self):
        self.assert_zbuf("config.txt", "stage3.txt", "-o", "a.ppm")
        for options in (["-o", "-"], ["--image", "-"], ["-o", "-", "--z-buffer", "none"]):
            self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", *options), pathlib.Path("a.ppm").read_bytes())
        self.assertEqual(self.files(), ["a.ppm", "config.txt", "scene.txt", "stage3.txt"])

    def test_the_depths_may_go_to_a_file(self):
        depths = self.assert_zbuf("config.txt", "stage3.txt", "-o", "a.ppm")
        image = self.assert_zbuf("config.txt", "stage3.txt", "-o", "-", "--z-buffer", "z.txt")
        self.assertEqual((image, pathlib.Path("z.txt").read_bytes()), (pathlib.Path("a.ppm").read_bytes(), depths))

    def test_a_full_disk_is_a_failure(self):
        with open("/dev/full", "wb") as full:
            self.assert_fails(run("zbuf", "config.txt", "stage3.txt", "-o", "-", stdout=full), 1,
                              "zbuf: cannot write /dev/stdout: No space left on device")

    def test_a_closed_pipe_is_quiet(self):
        done = subprocess.run(["bash", "-c", '"$0" "$@" | true; echo ${PIPESTATUS[0]}', *command("zbuf", "--size", "2000x2000", "stage3.txt", "-o", "-")],
                              capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr), ("1\n", ""))


class Depths(OutputTest):
    def test_may_go_nowhere(self):
        self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", "--z-buffer", "none"), b"")
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt", "stage3.txt"])

    def test_may_go_to_a_file_called_none(self):
        depths = self.assert_zbuf("config.txt", "stage3.txt")
        self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", "--z-buffer", "./none"), b"")
        self.assertEqual(pathlib.Path("none").read_bytes(), depths)

    def test_their_image_needs_no_text(self):
        self.assert_zbuf("config.txt", "stage3.txt", "--depth-image", "a.pgm")
        self.assert_zbuf("config.txt", "stage3.txt", "--depth-image", "b.pgm", "--z-buffer", "none")
        self.assertEqual(pathlib.Path("a.pgm").read_bytes(), pathlib.Path("b.pgm").read_bytes())


class Terminal(OutputTest):
    def shown(self, *words, text):
        """What the terminal and stderr show."""
        reader, terminal = pseudo_terminal()
        done = run("zbuf", *words, stdin=text, stdout=terminal)
        os.write(terminal, b"|")  # marks the end of the output
        shown = b""
        while not shown.endswith(b"|"):
            shown += os.read(reader, 65536)
        os.close(terminal)
        os.close(reader)
        self.assertEqual(done.returncode, 0)
        return shown[:-1].replace(b"\r\n", b"\n"), done.stderr.decode()

    def test_is_not_flooded_by_depths(self):
        self.assertEqual(self.shown("--size", "400x300", text=ALL), (b"", "out.bmp: 400 x 300, 100 % covered\n"))
        self.assertEqual(self.shown("--size", "4x3", "-o", "a.ppm", text=""), (b"", "a.ppm: 4 x 3, 0 % covered\n" + NO_TRIANGLE))
        # By the top-left rule, 45 of 100 pixels lie in the half: those on the diagonal are on its right edge.
        self.assertEqual(self.shown("--size", "10x10", "--coverage", "center", text=HALF), (b"", "out.bmp: 10 x 10, 45 % covered\n"))

    def test_all_and_nothing_are_exact(self):
        # 1 and 499 of 500 pixels; row 249 lies at y = 0.002, row 0 at 0.998.
        self.assertEqual(self.shown("--size", "1x500", text="0 0.0019 0\n0.1 0.0019 0\n0 0.0021 0\n")[1], "out.bmp: 1 x 500, 1 % covered\n")
        self.assertEqual(self.shown("--size", "1x500", text=ALL.replace(" 9.", " 0.997"))[1], "out.bmp: 1 x 500, 99 % covered\n")

    def test_shows_what_is_asked_for(self):
        depths = run("zbuf", "config.txt", stdin=HALF).stdout
        self.assertEqual(self.shown("config.txt", "--z-buffer", "-", text=HALF), (depths, ""))
        self.assertEqual(self.shown("config.txt", "--z-buffer", "none", text=HALF), (b"", ""))
        self.assertEqual(self.shown("config.txt", "--z-buffer", "z.txt", text=HALF), (b"", ""))
        self.assertEqual(pathlib.Path("z.txt").read_bytes(), depths)

    def test_shows_the_triangles_that_are_seen_alone(self):
        self.assertEqual(self.shown("config.txt", "--seen", "-", text=HALF), (HALF.encode(), ""))
        self.assertEqual(self.shown("config.txt", "--seen", "seen.txt", "-o", "a.ppm", text=HALF), (b"", ""))
        self.assertEqual(pathlib.Path("seen.txt").read_text(), HALF)


class Background(OutputTest):
    def corners(self, scene, *options):
        """The top right pixel, outside the triangle, and the one at the bottom left, inside."""
        stage3 = pipe(["model"], ["view"], ["project"], stdin=CAMERA + scene + "triangle\n-9 -9 0\n9 -9 0\n-9 9 0\nend\n")
        pixels = self.assert_zbuf("--size", "8x8", "-o", "-", *options, stdin=stage3)[-3 * 64:]
        return pixels[21:24].hex(), pixels[-24:-21].hex()

    def test_is_black_or_that_of_the_scene(self):
        self.assertEqual(self.corners("")[0], "000000")
        self.assertEqual(self.corners("background 1 2 3\n")[0], "010203")

    def test_of_the_option_replaces_it_and_nothing_else(self):
        lit = "light 0 0 9 1 1 1\n"
        for scene in ("", "background 1 2 3\n", "background 1 2 3\ncolor 9 8 7\n", "background 1 2 3\n" + lit):
            for color in ("ff8000", "FF8000"):
                self.assertEqual(self.corners(scene, "--background", color), ("ff8000", self.corners(scene)[1]))


if __name__ == "__main__":
    unittest.main()
