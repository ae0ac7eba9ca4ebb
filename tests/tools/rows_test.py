#!/usr/bin/env python3
"""zbuf --rows, end to end: bands of a picture, joined, are the picture.

usage: rows_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import random
import resource
import subprocess
import unittest

import seen_test
from toolbox import BIN, pipe, run

SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12))  # fewer with sanitizers, see CMakeLists.txt


def rows_of(ppm):
    """The rows of a PPM, each as bytes."""
    magic, size, most, pixels = ppm.split(b"\n", 3)
    columns, rows = map(int, size.split())
    assert (magic, most, len(pixels)) == (b"P6", b"255", 3 * columns * rows)
    return [pixels[3 * columns * row:3 * columns * (row + 1)] for row in range(rows)]


def bands_of(rng, rows):
    cuts = sorted(rng.sample(range(1, rows), rng.randrange(1, 5)))
    return list(zip([0, *cuts], [*cuts, rows]))


class Bands(seen_test.Seen):
    """Random scenes with equal depths, several colors, lights and cuts, and options of all kinds."""

    HEADERS = (
        "", "background 10 20 30\ncolor 200 100 50\n",
        "attributes color normal\nbackground 9 9 9\nlight 1 2 3 1 1 1\nambient 0.2 0.2 0.2\nmaterial 1 "
        "1 0.5 8\n", "attributes normal\nlight 3 1 3 1 0.5 1\n",
        "attributes normal\nmaterial 1 1 0 1\nmaterial 0.2 0.5 1 9\nlight 3 1 3 1 0.5 1\n")

    def scene(self, rng, kind, count):
        coordinate = lambda: rng.choice((rng.uniform(-2, 2), rng.randrange(-4, 5) / 2))

        def vertex(z):
            words = [coordinate(), coordinate(), z if z is not None else coordinate()]
            if "attributes color" in kind:
                words += [rng.randrange(256) for _ in range(3)]
            if "normal" in kind:
                words += [rng.uniform(-1, 1), rng.uniform(-1, 1), 1]
            return " ".join(f"{word:.5g}" for word in words) + "\n"

        lines = "1 0.5 4\n0 0 0\n0 1 0\n50 1 2.5 8\n" + kind
        for _ in range(count):
            z = rng.choice((None, None, 0, 0.5))
            if kind.count("material") > 1 and rng.random() < 0.5:
                lines += f"use {rng.randrange(2)}\n"
            lines += "triangle\n" + "".join(vertex(z) for _ in range(3))
        return lines + "end\n"

    def options(self, rng, kind):
        options = [
            "--coverage",
            rng.choice(("nearest", "center")), "--depth",
            rng.choice(("f64", "f32", "u24"))]
        if rng.random() < 0.4:
            options += ["--samples", str(rng.choice((2, 3)))]
        if rng.random() < 0.3:
            options += ["--wireframe"]
        if "light" in kind and rng.random() < 0.5:
            options += ["--shading", rng.choice(("flat", "gouraud", "phong", "none"))]
        return options

    def ndc(self, rng, kind, count):
        clip = rng.choice(("near", "frustum", "reject", "auto"))
        digits = rng.choice(("3", "7", "exact"))
        return pipe(["model", "--digits", digits, *rng.choice(
            ([], ["--framed"]))], ["view", "--digits", digits],
                    ["project", "--clip", clip, "--digits", digits], stdin=self.scene(rng, kind, count))

    def test_what_is_seen_of_a_band_gives_the_band(self):
        pathlib.Path("config.txt").write_text("40 30\n")
        for seed, kind in itertools.product(range(SCENE_COUNT), self.HEADERS):
            rng = random.Random(seed)
            ndc, options = self.ndc(rng, kind, 60), self.options(rng, kind)
            first, end = rng.choice(bands_of(rng, 30))
            with self.subTest(seed=seed, kind=kind, options=options, rows=(first, end)):
                self.check(ndc, *options, "--rows", f"{first}:{end}")

    def test_bands_joined_are_the_whole(self):
        pathlib.Path("config.txt").write_text("40 30\n-1.1\n-0.9\n-0.9 0.95\n")
        ways = (["--threads", "3"], ["--algorithm", "scanline"], [])
        for seed, kind in itertools.product(range(SCENE_COUNT), self.HEADERS):
            rng = random.Random(1000 + seed)
            ndc, options = self.ndc(rng, kind, 60), self.options(rng, kind)
            if rng.random() < 0.2:
                options += ["--depth-epsilon", "0.01"]
            depths, image = self.picture(ndc, *options, "--depth-image", "depths.pgm", "--fragments",
                                         "fragments.txt")
            fragments = pathlib.Path("fragments.txt").read_text().splitlines()
            gray = pathlib.Path("depths.pgm").read_bytes().split(b"\n", 3)[3]
            found, rows, grays, kept = b"", [], b"", []
            with self.subTest(seed=seed, kind=kind, options=options):
                for first, end in bands_of(rng, 30):
                    way = rng.choice(ways[2 * ("--depth-epsilon" in options):])
                    band = self.picture(ndc, *options, *way, "--rows", f"{first}:{end}", "--depth-image",
                                        "depths.pgm", "--fragments", "fragments.txt")
                    found += band[0]
                    rows += rows_of(band[1])
                    grays += pathlib.Path("depths.pgm").read_bytes().split(b"\n", 3)[3]
                    kept += pathlib.Path("fragments.txt").read_text().splitlines()
                self.assertEqual(found, depths)
                self.assertEqual(rows, rows_of(image))
                self.assertEqual(grays, gray)
                self.assertEqual(sorted(kept), sorted(fragments))

    def test_bands_of_a_picture_with_many_rows(self):
        """So many that drawing cuts them into bands of its own."""
        pathlib.Path("config.txt").write_text("9 3000\n")
        rng = random.Random(5)
        for count, kind in ((40, ""), (3000, self.HEADERS[2])):
            ndc = self.ndc(rng, kind, count)
            depths, image = self.picture(ndc)
            for way in ([], ["--threads", "2"], ["--algorithm", "scanline"], ["--samples", "2"]):
                if way[:1] == ["--samples"]:
                    depths, image = self.picture(ndc, *way)
                bands = [
                    self.picture(ndc, *way, "--rows", f"{first}:{end}") for first, end in bands_of(rng, 3000)]
                self.assertEqual(b"".join(band[0] for band in bands), depths, way)
                self.assertEqual(sum((rows_of(band[1]) for band in bands), []), rows_of(image), way)


class Words(seen_test.Seen):
    TRIANGLES = ("-0.9 0.1 0\n0.9 0.1 0\n0 0.9 0\n\n-0.9 -0.9 0\n0.9 -0.9 0\n0 -0.1 0\n\n-3 -3 0\n-2 -3 0\n"
                 "-2 -2 0\n\n")

    def test_statistics_count_what_is_in_the_rows(self):
        pathlib.Path("config.txt").write_text("20 20\n")
        self.zbuf("--stats", "stats.txt", "--rows", "0:10", stdin=self.TRIANGLES)
        stats = dict(line.split() for line in pathlib.Path("stats.txt").read_text().splitlines())
        self.assertEqual(
            {key: stats[key]
             for key in ("triangles", "seen", "hidden", "outside_left", "outside_rows")},
            {"triangles": "3", "seen": "1", "hidden": "0", "outside_left": "1", "outside_rows": "1"})
        self.zbuf("--stats", "whole.txt", stdin=self.TRIANGLES)
        whole = dict(line.split() for line in pathlib.Path("whole.txt").read_text().splitlines())
        self.assertNotIn("outside_rows", whole)
        self.assertEqual(2 * int(stats["pixels_written"]), int(whole["pixels_written"]))

    def test_only_a_whole_picture_is_noted_as_empty(self):
        pathlib.Path("config.txt").write_text("20 20\n")
        for text, note in ((self.TRIANGLES, b""),
                           ("attributes color\n2 2 0 9 9 9\n3 2 0 9 9 9\n2 3 0 9 9 9\n\n",
                            b"zbuf: note: the picture is empty: the triangle is right")):
            for options in ([], ["--wireframe"]):
                done = run("zbuf", "config.txt", "--rows", "9:10", *options, stdin=text)
                self.assertEqual(done.returncode, 0)
                self.assertEqual(done.stderr[:len(note)] if note else done.stderr, note)

    def test_probes_are_in_the_rows(self):
        pathlib.Path("config.txt").write_text("20 20\n")
        done = run("zbuf", "config.txt", "--rows", "5:9", "--probe", "10,5", stdin=self.TRIANGLES)
        self.assertIn(b"zbuf: 10,5: triangle 0, depth 0: kept\n", done.stderr)
        done = run("zbuf", "config.txt", "--rows", "5:9", "--probe", "10,9", stdin=self.TRIANGLES)
        self.assertEqual(
            (done.returncode, done.stderr),
            (2, b"zbuf: --probe: expected COLUMN,ROW, from 0,5 to 19,8, found '10,9' (try zbuf --help)\n"))

    def test_rows_that_are_not_there_are_refused(self):
        pathlib.Path("config.txt").write_text("20 20\n")
        which = "A:B, the first row and the one after the last, from 0:1 to 19:20"
        for rows in ("", "3", "3:3", "4:3", "0:21", "-1:3", "a:b", "1:2:3", ":", "0:99999999999999999999",
                     "1.0:2"):
            done = run("zbuf", "config.txt", "--rows", rows, stdin=self.TRIANGLES)
            self.assertEqual((done.returncode, done.stdout), (2, b""), rows)
            self.assertEqual(
                done.stderr.decode(),
                f"zbuf: --rows: expected {which if rows else 'A:B, such as 0:100'}, found '{rows}' (try zbuf "
                f"--help)\n")
            self.assertFalse(pathlib.Path("out.bmp").exists())

    def test_a_band_needs_memory_for_itself_alone(self):
        """A whole picture of 20000 x 20000 needs 4.8 GB, its band of 100 rows 24 MB."""
        if b"__asan_init" in (BIN / "zbuf").read_bytes():
            self.skipTest("AddressSanitizer needs more memory than the limit")
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1 << 28, 1 << 28))
        words = [BIN / "zbuf", "--size", "20000x20000", "--z-buffer", "none", "-o", "band.ppm"]
        wall = b"-9 -9 0\n9 -9 0\n0 9 0\n\n"
        done = subprocess.run([*words, "--rows", "700:800"], input=wall, capture_output=True,
                              preexec_fn=limit)
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        self.assertEqual(
            pathlib.Path("band.ppm").stat().st_size, 3 * 20000 * 100 + len("P6\n20000 100\n255\n"))
        done = subprocess.run(words, input=wall, capture_output=True, preexec_fn=limit)
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
