#!/usr/bin/env python3
"""Where zbuf's image and depths go, the size in place of a config, and the background.

usage: zbuf_outputs_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import ast
import os
import pathlib
import random
import re
import struct
import subprocess
import unittest
import zlib

from lib.showing import pictures
from toolbox import CAMERA, NO_TRIANGLE, Terminal, ToolTest, command, pipe, run, run_script, stage_texts

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
        self.assertEqual(
            (self.assert_zbuf("--size", "17x9", "stage3.txt"), pathlib.Path("out.bmp").read_bytes()),
            expected)
        for operands in ([], ["-"]):
            self.assertEqual(
                self.assert_zbuf("--size=17x9", *operands, stdin=pathlib.Path("stage3.txt").read_text()),
                expected[0])

    def test_keeps_the_limits_of_a_config(self):
        pathlib.Path("config.txt").write_text("34 18\n-0.5\n-0.7\n-0.9 0.9\n")
        pathlib.Path("smaller.txt").write_text("17 9\n-0.5\n-0.7\n-0.9 0.9\n")
        expected = self.assert_zbuf("smaller.txt", "stage3.txt")
        text = pathlib.Path("stage3.txt").read_text()
        self.assertEqual(self.assert_zbuf("--size", "17x9", "config.txt", "stage3.txt"), expected)
        self.assertEqual(self.assert_zbuf("--size", "17x9", "config.txt", "-", stdin=text), expected)
        self.assertEqual(self.assert_zbuf("config.txt", "--size", "17x9", stdin=text), expected)

    def test_notes_a_picture_of_another_shape_than_the_configs(self):
        for words in ("1 400 400x10 1.6e+04 1x400", "400 1 10x1 0.025 400x1", "400 300 100x100 0.75 100x75"):
            width, height, size, times, fitting = words.split()
            pathlib.Path("config.txt").write_text(f"{width} {height}\n-1\n-0.75\n-1 1\n")
            done = run("zbuf", "config.txt", "--size", size, "stage3.txt")
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (0, f"zbuf: note: a square of the config's {width} x {height} picture is drawn "
                              f"{times} times as wide as high: --size {fitting} keeps its shape\n"))
        self.assert_zbuf("config.txt", "--size", "101x75", "stage3.txt")  # by a fraction of a pixel
        self.assert_zbuf("--size", "100x100", "stage3.txt")

    def test_a_single_operand_that_is_no_config_is_the_input(self):
        with open("stage3.txt") as text:
            done = subprocess.run(["bash", "-c", '"$0" --size 17x9 -o - <(cat)', *command("zbuf")],
                                  stdin=text, capture_output=True)
        self.assertEqual((done.returncode, done.stderr, done.stdout),
                         (0, b"", self.assert_zbuf("--size", "17x9", "-o", "-", "stage3.txt")))
        done = run("zbuf", "--size", "17x9", "missing.txt")
        self.assertEqual((done.returncode, done.stderr.decode()),
                         (1, "zbuf: cannot open missing.txt: No such file or directory\n"))

    def test_has_the_largest_pictures_of_a_config(self):
        done = run("zbuf", "--size", "65535x1", "-o", "-")
        self.assertEqual((done.stdout[:14], done.stderr.decode(), done.returncode),
                         (b"P6\n65535 1\n255", NO_TRIANGLE, 0))


class Image(OutputTest):
    def test_o_is_image(self):
        self.assert_zbuf("config.txt", "stage3.txt", "--image", "a.ppm")
        self.assert_zbuf("config.txt", "stage3.txt", "-o", "b.ppm")
        self.assertEqual(pathlib.Path("a.ppm").read_bytes(), pathlib.Path("b.ppm").read_bytes())

    def test_a_dash_is_standard_output_without_depths(self):
        self.assert_zbuf("config.txt", "stage3.txt", "-o", "a.ppm")
        for options in (["-o", "-"], ["--image", "-"], ["-o", "-", "--z-buffer", "none"]):
            self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", *options),
                             pathlib.Path("a.ppm").read_bytes())
        self.assertEqual(self.files(), ["a.ppm", "config.txt", "scene.txt", "stage3.txt"])

    def test_the_depths_may_go_to_a_file(self):
        depths = self.assert_zbuf("config.txt", "stage3.txt", "-o", "a.ppm")
        image = self.assert_zbuf("config.txt", "stage3.txt", "-o", "-", "--z-buffer", "z.txt")
        self.assertEqual((image, pathlib.Path("z.txt").read_bytes()),
                         (pathlib.Path("a.ppm").read_bytes(), depths))

    def test_a_prefix_chooses_the_format(self):
        formats = [("ppm", b"P6"), ("png", b"\x89PNG"), ("bmp", b"BM")]
        for name, magic in formats:
            self.assert_zbuf("config.txt", "stage3.txt", "-o", f"a.{name}")
            self.assert_zbuf("config.txt", "stage3.txt", "-o", f"{name}:b.ppm")
            image = pathlib.Path(f"a.{name}").read_bytes()
            self.assertTrue(image.startswith(magic))
            self.assertEqual(pathlib.Path("b.ppm").read_bytes(), image)
            if name != "bmp":
                self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", "-o", f"{name}:-"), image)
        self.assert_fails(
            run("zbuf", "config.txt", "stage3.txt", "-o", "bmp:-"), 2,
            "zbuf: --image: bmp:-: expected ppm:- or png:-, as a BMP is written from its end, found 'bmp:-' "
            "(try zbuf --help)")
        self.assert_fails(
            run("zbuf", "config.txt", "stage3.txt", "-o", "png:"), 2,
            "zbuf: --image: png:: expected a file name after the format, found nothing (try zbuf --help)")
        self.assert_fails(
            run("zbuf", "config.txt", "stage3.txt", "-o", "png:x.npy", "--depth-array", "x.npy"), 2,
            "zbuf: expected a place of its own for every output, found the same one for --image 'x.npy' and "
            "--depth-array 'x.npy' (try zbuf --help)")


class Depths(OutputTest):
    def test_may_go_nowhere(self):
        self.assertEqual(self.assert_zbuf("config.txt", "stage3.txt", "--z-buffer", "none"), b"")
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt", "stage3.txt"])

    def array(self, name="depths.npy", kind="<f8"):
        """The shape and the numbers of a file, by NumPy's page on the format, version 1.0."""
        data = pathlib.Path(name).read_bytes()
        magic, major, minor, length = struct.unpack_from("<6sBBH", data)
        self.assertEqual((magic, major, minor, (10 + length) % 64, data[9 + length:10 + length]),
                         (b"\x93NUMPY", 1, 0, 0, b"\n"))
        header = ast.literal_eval(data[10:10 + length].decode("latin-1"))
        self.assertEqual((header["descr"], header["fortran_order"]), (kind, False))
        return header["shape"], [
            number for number, in struct.iter_unpack({"<f8": "<d", "<i8": "<q"}[kind], data[10 + length:])]

    def test_their_array_has_all_digits(self):
        """The text is that of the numbers, and they are the ones that --fragments has."""
        pathlib.Path("config.txt").write_text("40 30\n")
        text = self.assert_zbuf("config.txt", "stage3.txt", "--depth-array", "depths.npy", "--fragments",
                                "fragments.txt").decode()
        (rows, columns), depths = self.array()
        numbers = [f"{depth:.6f}\t" if depth == depth else "" for depth in depths]
        lines = ["".join(numbers[columns * row:columns * (row + 1)]) for row in range(rows)]
        self.assertEqual("\n".join(lines) + "\n", text)
        fragments = pathlib.Path("fragments.txt").read_text()
        kept = re.findall(r"^(\d+),(\d+): .* depth (\S+): kept", fragments, re.M)
        nearest = {int(row) * columns + int(column): float(depth) for column, row, depth in kept}
        self.assertGreater(len(nearest), 9)
        self.assertEqual({i: depth for i, depth in enumerate(depths) if depth == depth}, nearest)
        self.assert_zbuf("config.txt", "stage3.txt", "--rows", "1:3", "--depth-array", "depths.npy")
        self.assertEqual(self.array()[0], (2, columns))

    def test_far_depths_are_those_of_the_text(self):
        pathlib.Path("config.txt").write_text("9 7\n-1\n-1\n-1e12 1e12\n")
        stage3 = b"-0.9 -0.8 123456789012.3\n0.9 -0.7 987654321098.7\n0.1 0.9 77777777777.7\n"
        for rule in ("center", "nearest"):
            text = self.assert_zbuf("config.txt", "--coverage", rule, "--depth-array", "depths.npy",
                                    stdin=stage3)
            depths = [depth for depth in self.array()[1] if depth == depth]
            self.assertEqual(depths, [float(word) for word in text.split()])
            self.assert_zbuf("config.txt", "--coverage", rule, "--depth-array", "depths.npy", "--z-buffer",
                             "none", stdin=stage3)
            self.assertEqual([depth for depth in self.array()[1] if depth == depth], depths)

    def test_the_triangles_are_those_of_the_fragments(self):
        """Of many, lit and not, whatever else keeps them; and none is let go of too early."""
        random_ = random.Random(7)
        text = "light 1 1 3 1 1 1\n" + "".join(
            f"triangle {3 * i}\n" +
            "".join(f"{x + random_.uniform(-size, size):.3f} {y + random_.uniform(-size, size):.3f} {z:.3f}\n"
                    for _ in range(3)) for i in range(20000)
            for x, y, z, size in [[random_.uniform(-1, 1) for _ in "xyz"] + [random_.choice((.01, .02, .5))]])
        pathlib.Path("config.txt").write_text("30 20\n")
        for stage3 in (text.split("\n", 1)[1], "projected ortho -1.5 1.5 -1 1 1 9\n" + text):
            for words in ((), ("--algorithm", "scanline"), ("--seen", "seen.txt"), ("--threads", "2")):
                with self.subTest(words=words, is_lit=stage3.startswith("projected")):
                    self.assert_zbuf("config.txt", "--triangle-array", "triangles.npy", "--fragments",
                                     "fragments.txt", "-o", "a.ppm", *words, stdin=stage3.encode())
                    seen = [-1] * 600
                    for column, row, number in re.findall(r"^(\d+),(\d+): triangle (\d+), .*: kept",
                                                          pathlib.Path("fragments.txt").read_text(), re.M):
                        seen[30 * int(row) + int(column)] = int(number)
                    self.assertEqual(self.array("triangles.npy", "<i8"), ((20, 30), seen))

    def test_their_array_is_that_of_rays(self):
        view = pipe(["view", "--digits", "exact"], stdin=stage_texts()[0])
        pathlib.Path("stage3.txt").write_bytes(pipe(["project", "--digits", "exact"], stdin=view))
        pathlib.Path("config.txt").write_text("40 30\n")
        self.assert_zbuf("config.txt", "stage3.txt", "--coverage", "center", "--depth-array", "depths.npy",
                         "--triangle-array", "triangles.npy")
        drawn = self.array(), self.array("triangles.npy", "<i8")
        self.assert_quiet_success(
            run("trace", "config.txt", "--depth-array", "depths.npy", "--triangle-array", "triangles.npy",
                "--z-buffer", "none", stdin=view))
        self.assertEqual(repr((self.array(), self.array("triangles.npy", "<i8"))), repr(drawn))

    def test_their_array_has_one_sample_a_pixel(self):
        for option in ("--depth-array", "--triangle-array"):
            self.assert_fails(run("zbuf", "config.txt", option, "depths.npy", "--samples", "2", stdin=b""), 2,
                              f"zbuf: {option}: expected --samples 1 with it, found '2' (try zbuf --help)")


class OnATerminal(OutputTest):
    def shown(self, *words, text):
        """The texts on the terminal and on stderr."""
        terminal = Terminal(self)
        done = run("zbuf", *words, stdin=text, stdout=terminal.channel)
        self.assertEqual(done.returncode, 0)
        return terminal.shown().replace(b"\r\n", b"\n"), done.stderr.decode()

    def test_is_not_flooded_by_depths(self):
        self.assertEqual(self.shown("--size", "40x20", text=ALL), (b"", "out.bmp: 40 x 20, 100 % covered\n"))
        self.assertEqual(self.shown("--size", "4x3", "-o", "a.ppm", text=""),
                         (b"", "a.ppm: 4 x 3, 0 % covered\n" + NO_TRIANGLE))
        # By the top-left rule, 45 of 100 pixels lie in the half: those on the diagonal are on its right edge.
        self.assertEqual(self.shown("--size", "10x10", "--coverage", "center", text=HALF),
                         (b"", "out.bmp: 10 x 10, 45 % covered\n"))

    def test_all_and_nothing_are_exact(self):
        # 1 and 499 of 500 pixels; row 249 lies at y = 0.002, row 0 at 0.998.
        self.assertEqual(
            self.shown("--size", "1x500", text="0 0.0019 0\n0.1 0.0019 0\n0 0.0021 0\n")[1],
            "out.bmp: 1 x 500, 1 % covered\n")
        self.assertEqual(
            self.shown("--size", "1x500", text=ALL.replace(" 9.", " 0.997"))[1],
            "out.bmp: 1 x 500, 99 % covered\n")

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
        stage3 = pipe(["model"], ["view"], ["project"],
                      stdin=CAMERA + scene + "triangle\n-9 -9 0\n9 -9 0\n-9 9 0\nend\n")
        pixels = self.assert_zbuf("--size", "8x8", "-o", "-", *options, stdin=stage3)[-3 * 64:]
        return pixels[21:24].hex(), pixels[-24:-21].hex()

    def test_of_the_option_replaces_it_and_nothing_else(self):
        lit = "light 0 0 9 1 1 1\n"
        for scene in ("", "background 1 2 3\n", "background 1 2 3\ncolor 9 8 7\n",
                      "background 1 2 3\n" + lit):
            for color in ("ff8000", "FF8000"):
                self.assertEqual(self.corners(scene, "--background", color),
                                 ("ff8000", self.corners(scene)[1]))


class TransparentBackground(OutputTest):
    """PNGs with alpha. The triangle of CORNER covers the lower left of the picture, and the diagonal cuts
    pixels in halves."""
    CORNER = "attributes color\n" + "".join(f"{x} {y} 0 250 120 7\n"
                                            for x, y in ((-1, -1), (1, -1), (-1, 1))) + "\n"

    def setUp(self):
        super().setUp()
        if ".png" not in run("zbuf", "--help").stdout.decode():
            self.skipTest("built without libpng")

    def picture(self, path):
        """The rows of an RGBA image, as lists of (red, green, blue, alpha)."""
        data = pathlib.Path(path).read_bytes()
        width, height, *kind = struct.unpack_from(">IIBBBBB", data, 16)
        self.assertEqual(kind, [8, 6, 0, 0, 0])
        pixels = zlib.decompress(b"".join(
            body for name, body in pictures.png_chunks(data) if name == b"IDAT"))
        rows, above = [], bytes(4 * width)
        for at in range(0, len(pixels), 4 * width + 1):
            above = pictures.unfiltered(pixels[at], pixels[at + 1:at + 1 + 4 * width], above, 4)
            rows.append([tuple(above[i:i + 4]) for i in range(0, 4 * width, 4)])
        self.assertEqual(len(rows), height)
        return rows

    def test_an_invisible_one_leaves_the_mean_of_the_covered_samples_and_their_share(self):
        for tool in self.ways(self.CORNER):
            for samples in ("1", "2", "4"):
                tool("--background", "01020300", "--samples", samples, "-o", "out.png")
                rows = self.picture("out.png")
                for row in range(8):
                    for column in range(8):
                        expected = (250, 120, 7, 255) if column < row else (1, 2, 3, 0)
                        if column == row:  # the top-left rule gives the diagonal, a right edge, to nobody
                            share = {"1": 0, "2": 1, "4": 6}[samples]
                            alpha = (2 * 255 * share + int(samples)**2) // (2 * int(samples)**2)
                            expected = (250, 120, 7, alpha) if share else (1, 2, 3, 0)
                        self.assertEqual(rows[row][column], expected, (samples, row, column))

    def ways(self, text):
        """Calls of zbuf, by both algorithms and on threads, and of trace, that draw the same text."""
        view = "ortho -1 1 -1 1 1 3\n" + "".join(
            line.replace(" 0 250", " -2 250") + "\n" for line in text.splitlines())
        zbuf = ["zbuf", "--size", "8x8", "--coverage", "center", "--z-buffer", "none"]
        yield lambda *words: self.assert_quiet_success(run(*zbuf, *words, stdin=text))
        yield lambda *words: self.assert_quiet_success(
            run(*zbuf, "--algorithm", "scanline", *words, stdin=text))
        yield lambda *words: self.assert_quiet_success(run(*zbuf, "--threads", "3", *words, stdin=text))
        yield lambda *words: self.assert_quiet_success(
            run("trace", "--size", "8x8", "--z-buffer", "none", *words, stdin=view))

    def test_a_translucent_one_weighs_as_much_as_its_alpha(self):
        for tool in self.ways(self.CORNER):
            tool("--background", "00ff0055", "--samples", "2", "-o", "out.png")
            # One of four samples: alpha (255 + 3 * 85) / 4; half of the weight is the triangle's.
            self.assertEqual(self.picture("out.png")[3][3], (125, 188, 4, 128))
            self.assertEqual(self.picture("out.png")[0][7], (0, 255, 0, 85))

    def test_of_the_scene_is_as_that_of_the_option(self):
        for tool in self.ways("background 7 8 9 63.5\n" + self.CORNER):
            tool("--samples", "3", "-o", "scene.png")
            tool("--samples", "3", "-o", "option.png", "--background", "07080940")
            self.assertEqual(pathlib.Path("scene.png").read_bytes(), pathlib.Path("option.png").read_bytes())
            tool("--background", "070809", "-o", "opaque.png")
            self.assertEqual(pathlib.Path("opaque.png").read_bytes()[24:26], b"\x08\x02")

    def test_an_opaque_one_changes_no_byte(self):
        for background in ("background 7 8 9\n", ""):
            self.assertEqual(pipe(["model"], stdin=CAMERA + background.replace("9\n", "9 255\n") + "end\n"),
                             pipe(["model"], stdin=CAMERA + background + "end\n"))
            for name in ("out.png", "out.ppm", "out.bmp"):
                for tool in self.ways(background + self.CORNER):
                    tool("--background", "0a0b0c", "-o", name)
                    expected = pathlib.Path(name).read_bytes()
                    tool("--background", "0a0b0cff", "-o", name)
                    self.assertEqual(pathlib.Path(name).read_bytes(), expected)

    def test_a_wireframe_lies_over_it(self):
        self.assert_zbuf("--size", "8x8", "--z-buffer", "none", "--wireframe", "--background", "01020300",
                         "-o", "out.png", stdin=self.CORNER)
        self.assertEqual({pixel[3] for row in self.picture("out.png") for pixel in row}, {0, 255})

    def test_a_picture_of_the_backgrounds_color_is_not_empty_over_it(self):
        text = self.CORNER.replace("250 120 7", "0 0 0")
        self.assert_zbuf("--size", "8x8", "--z-buffer", "none", "--background", "00000000", "-o", "out.png",
                         stdin=text)
        self.assertEqual(self.picture("out.png")[7][0], (0, 0, 0, 255))

    def test_bands_are_joined(self):
        words = ["--size", "8x8", "--z-buffer", "none", "--samples", "2", "--background", "01020300"]
        self.assert_zbuf(*words, "-o", "whole.png", stdin=self.CORNER)
        for name, rows in (("a.png", "0:3"), ("b.png", "3:4"), ("c.png", "4:8")):
            self.assert_zbuf(*words, "--rows", rows, "-o", name, stdin=self.CORNER)
        self.assertEqual(
            run_script("join-images", "a.png", "b.png", "c.png", "-o", "joined.png", text=False).stderr, b"")
        self.assertEqual(self.picture("joined.png"), self.picture("whole.png"))
        self.assert_zbuf(*words[:-1], "010203", "--rows", "3:4", "-o", "opaque.png", stdin=self.CORNER)
        done = run_script("join-images", "a.png", "opaque.png", "-o", "joined.png", text=False)
        self.assertEqual(
            (done.returncode, done.stderr.decode()),
            (1,
             "join-images: opaque.png: expected a PNG with alpha of 8 columns as a.png, found a PNG of 8\n"))

    def test_only_a_png_holds_it(self):
        expected = "expected an opaque background, or -o FILE.png: no other image can be transparent, found "
        for name in ("out.bmp", "out.ppm", "-"):
            done = run("zbuf", "--size", "8x8", "--background", "01020300", "-o", name, stdin=self.CORNER)
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (2, f"zbuf: --background: {expected}an alpha of 0 (try zbuf --help)\n"))
            done = run("zbuf", "--size", "8x8", "-o", name, stdin="background 1 2 3 254\n" + self.CORNER)
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (1, f"zbuf: <stdin>:1:12: {expected}an alpha of 254\n"))
        self.assert_zbuf("--size", "8x8", "--seen", "-",
                         stdin="background 1 2 3 254\n" + self.CORNER)  # no image


if __name__ == "__main__":
    unittest.main()
