#!/usr/bin/env python3
"""In scenes with colors or lights, zbuf lets go of triangles that nobody sees: its memory is bounded, the
picture stays.

usage: kept_triangles_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import random
import subprocess
import unittest

from streaming_test import LiveTool
from toolbox import ToolTest, run

COLORED = "attributes w color\n"
LIT = ("attributes w color normal\nmaterial 0.5 1 0.5 8\nlight 1 2 3 1 1 1\nprojected frustum -0.5 0.5 -0.5 "
       "0.5 1 100\n")
MEBIBYTE = 1024  # in the units of /proc, which are KiB
# zbuf looks for unseen triangles when it keeps this many; in a larger picture, one for each pixel or four of
# them.
LEAST = 16384


def triangles(count, seed, size, has_normals):
    """Small triangles all over the screen, in no order."""
    numbers = random.Random(seed)
    uniform = numbers.uniform
    lines = []
    for _ in range(count):
        x, y, z = uniform(-1, 1), uniform(-1, 1), uniform(-0.9, 0.9)
        for _ in range(3):
            line = "%.7f %.7f %.7f %.3f %.2f %.2f %.2f" % (x + uniform(-size, size), y + uniform(
                -size, size), z, 2 + z, uniform(0, 255), uniform(0, 255), uniform(0, 255))
            if has_normals:
                a, b = uniform(-1.5, 1.5), uniform(-1.5, 1.5)
                line += " %.7f %.7f %.7f" % (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b),
                                             math.sin(b))
            lines.append(line + "\n")
        lines.append("\n")
    return "".join(lines)


class KeptTriangles(ToolTest):
    """The scan-line algorithm keeps all triangles."""
    def check(self, text, *options, config="40 40\n", note=""):
        pathlib.Path("config.txt").write_text(config)
        pictures = []
        for algorithm in (["--algorithm", "scanline"], [], ["--threads", "3"]):
            done = run("zbuf", "config.txt", *algorithm, *options, stdin=text)
            self.assertEqual((done.stderr.decode(), done.returncode), (note, 0))
            pictures.append((done.stdout, pathlib.Path("out.bmp").read_bytes()))
        self.assertEqual(pictures[1], pictures[0])
        self.assertEqual(pictures[2], pictures[0])

    def test_the_picture_does_not_change(self):
        text = triangles(5 * LEAST, 1, 0.05, has_normals=True)
        for options in ([], ["--shading", "flat"], ["--shading", "gouraud"], ["--wireframe"], [
                "--samples", "2"], ["--coverage", "center"]):
            with self.subTest(options=options):
                self.check(LIT + text, *options)

    def test_nor_do_their_materials(self):
        """Of three: each has a color of its own where it is lit."""
        header = LIT.replace("normal\n", "normal material\n").replace(
            "light", "material 0 0.5 0 1\nmaterial 1 0 1 3\nlight")
        rows = triangles(3 * LEAST, 2, 0.05, has_normals=True).split("\n")
        text = "".join(f"{row} {i // 4 % 3}\n" if row else "\n" for i, row in enumerate(rows))
        self.check(header + text, "--shading", "flat")
        three = pathlib.Path("out.bmp").read_bytes()
        self.check(header + "".join(f"{row} 0\n" if row else "\n" for row in rows), "--shading", "flat")
        self.assertNotEqual(pathlib.Path("out.bmp").read_bytes(), three)

    def test_nor_if_every_triangle_hides_those_before(self):
        walls = "".join(
            f"-9 -9 {-i / LEAST / 4:.9f} 1 {i % 256} 0 0\n9 -9 {-i / LEAST / 4:.9f} 1 0 {i % 256} 0\n0 9 "
            f"{-i / LEAST / 4:.9f} 1 0 0 9\n\n" for i in range(3 * LEAST))
        self.check(COLORED + walls, config="4 4\n")

    def test_statistics_and_notes_speak_of_those_let_go_of_too(self):
        """A bright far wall, and black ones before it; one of them reaches far out."""
        def wall(z, color, right="9"):
            return f"-9 -9 {z:.6f} 1 {color}\n{right} -9 {z:.6f} 1 {color}\n0 9 {z:.6f} 1 {color}\n\n"

        black = "".join(wall(-i / LEAST / 4, "0 0 0", "70" if i == 5 else "9") for i in range(3 * LEAST))
        is_black = "zbuf: note: the picture is black: its colors are 0\n"
        for first, z_max in ((wall(0.5, "0 0 0"), "0.5"), (wall(0.75, "0 200 0"), "0.75")):
            self.check(COLORED + first + black, "--stats", "stats.txt", config="4 4\n", note=is_black)
            lines = pathlib.Path("stats.txt").read_text().splitlines()
            last = f"{-(3 * LEAST - 1) / LEAST / 4:.6f}"
            for line in (f"triangles {3 * LEAST + 1}", f"hidden {3 * LEAST}", "seen 1", "pixels_written 16",
                         "x_max 70", f"z_min {last}", f"z_max {z_max}"):
                self.assertIn(line, lines)

    def test_pieces_of_one_triangle_may_be_kept_and_let_go_apart(self):
        """Two pieces make a square; with --wireframe the edge between them is not drawn, wherever the store
        is full."""
        numbers = random.Random(3)
        texts = []
        for i in range(2 * LEAST):
            x, y, z = numbers.uniform(-1, 1), numbers.uniform(-1, 1), numbers.uniform(-0.9, 0.9)
            a, b, c, d = (f"{x + dx:.7f} {y + dy:.7f} {z:.7f} 1 {i % 251} 100 200\n"
                          for dx, dy in ((0, 0), (0.2, 0), (0.2, 0.2), (0, 0.2)))
            texts.append(f"{a}{b}{c}\ntriangle {i}\n{a}{c}{d}\n")
        # One piece more or less before them: then the store is full between two pieces once.
        single = "5 5 0 1 0 0 0\n6 5 0 1 0 0 0\n5 6 0 1 0 0 0\n\n"
        for before in ("", "triangle 70000\n" + single + "triangle 0\n"):
            for words in (["--wireframe"], ["--wireframe", "all"]):
                self.check(COLORED + before + "".join(texts), *words)


class Memory(ToolTest):
    """At most 2 x samples x the bytes of a triangle, and 20 MiB."""

    TRIANGLE = 288
    EDGES = 72

    def check(self, text, samples, triangle_size, *options):
        with LiveTool("zbuf", "config.txt", *options, stdout=subprocess.DEVNULL) as live:
            live.send(text)
            memory = live.peak_memory()
            self.assertEqual(live.finish(), 0)
        limit = 2 * samples * triangle_size // 1024 + 20 * MEBIBYTE
        self.assertLess(memory, limit, options)
        # All of them would need more.
        self.assertGreater(text.count("\n\n") * triangle_size // 1024, limit)

    def test_it_is_bounded_by_the_picture(self):
        pathlib.Path("config.txt").write_text("60 60\n")
        text = LIT + triangles(120_000, 4, 0.02, has_normals=True)
        image = ["--image", "/dev/null"]
        self.check(text, 60 * 60, self.TRIANGLE, *image)
        self.check(text, 60 * 60, self.TRIANGLE + self.EDGES, "--wireframe", "--threads", "3", *image)
        self.check(text, 120 * 120, self.TRIANGLE, "--samples", "2", *image)
        # Three lines of columns, an entry for them, and a blank line.
        self.check(text, 60 * 60, text.index("\n\n") - len(LIT) + 24, "--seen", "-")


if __name__ == "__main__":
    unittest.main()
