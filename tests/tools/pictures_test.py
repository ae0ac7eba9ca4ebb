#!/usr/bin/env python3
"""The pictures that zbuf makes besides the default one: PNG, depth images, several samples a pixel, a depth
epsilon, a wireframe; and depths between extreme limits.

usage: pictures_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import random
import struct
import unittest
import zlib

from toolbox import NO_TRIANGLE, ToolTest, pipe, run

COLUMNS, ROWS = 37, 23
NEEDS_PNG = b"without libpng" in run("zbuf", "config.txt", "--image", "x.png").stderr


def triangles(*corners_of):
    return "".join(
        "".join(f"{x:.7f} {y:.7f} {z:.7f}\n" for x, y, z in corners) + "\n" for corners in corners_of)


def random_triangles(seed, count):
    rng = random.Random(seed)
    return triangles(
        *([[rng.uniform(-1.3, 1.3), rng.uniform(-1.3, 1.3),
            rng.uniform(-1, 1)] for _ in range(3)] for _ in range(count)))


def wall_at(word):
    """A triangle that fills the picture, of the depth written as `word`."""
    return f"-9 -9 {word}\n9 -9 {word}\n0 9 {word}\n"


def wall(z):
    return wall_at(f"{z:.7f}") + "\n"


def read_png(path):
    """Width, height, bits and the bytes of the pixels, decoded by the format's specification (RFC 2083)."""
    data = pathlib.Path(path).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, chunks = 8, {}
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(kind + body)
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    width, height, bits, color_type = struct.unpack_from(">IIBB", chunks[b"IHDR"])
    step = {2: 3, 0: 1}[color_type] * bits // 8
    raw, before, rows = zlib.decompress(chunks[b"IDAT"]), bytes(step * width), b""
    for row in range(height):
        kind, line = raw[row * (step * width + 1)], bytearray(
            raw[row * (step * width + 1) + 1:][:step * width])
        for i in range(step * width):
            left, up, corner = (line[i - step], before[i], before[i - step]) if i >= step else (0, before[i],
                                                                                                0)
            guess = left + up - corner
            paeth = min((left, up, corner), key=lambda p: abs(guess - p))
            line[i] = (line[i] + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
        before = bytes(line)
        rows += before
    return width, height, bits, rows


class Pictures(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n")

    def zbuf(self, stage3, *options, note=""):
        """The depth text."""
        done = run("zbuf", "config.txt", *options, stdin=stage3)
        self.assertEqual((done.stderr.decode(), done.returncode), (note, 0))
        return done.stdout

    def pixels(self, stage3, *options, columns=COLUMNS, rows=ROWS, note=""):
        self.zbuf(stage3, "--image", "out.ppm", *options, note=note)
        data = pathlib.Path("out.ppm").read_bytes()
        header = f"P6\n{columns} {rows}\n255\n".encode()
        self.assertTrue(data.startswith(header))
        return data[len(header):]


class Png(Pictures):
    def setUp(self):
        super().setUp()
        if NEEDS_PNG:
            self.skipTest("built without libpng")

    def test_a_png_has_the_pixels_of_the_ppm(self):
        stage3 = random_triangles(1, 20)
        self.zbuf(stage3, "--image", "out.PNG")
        self.assertEqual(read_png("out.PNG"), (COLUMNS, ROWS, 8, self.pixels(stage3)))

    def test_a_depth_png_has_the_pixels_of_the_pgm(self):
        stage3 = random_triangles(2, 20)
        self.zbuf(stage3, "--depth-image", "depth.png")
        self.zbuf(stage3, "--depth-image", "depth.pgm")
        data = pathlib.Path("depth.pgm").read_bytes()
        header = f"P5\n{COLUMNS} {ROWS}\n65535\n".encode()
        self.assertTrue(data.startswith(header))
        self.assertEqual(read_png("depth.png"), (COLUMNS, ROWS, 16, data[len(header):]))


class DepthImages(Pictures):
    def brightness(self, stage3, note=""):
        self.zbuf(stage3, "--depth-image", "depth.pgm", note=note)
        data = pathlib.Path("depth.pgm").read_bytes()[-2 * COLUMNS * ROWS:]
        return struct.unpack(f">{COLUMNS * ROWS}H", data)

    def test_near_is_bright(self):
        # Half-way between the limits, at the front, and a quarter before the rear: 0.125 * 65535 = 8191.875.
        for z, expected in ((0, 32768), (-1, 65535), (0.75, 8192)):
            self.assertEqual(set(self.brightness(wall(z))), {expected})

    def test_nothing_is_black(self):
        self.assertEqual(set(self.brightness("", note=NO_TRIANGLE)), {0})

    def test_it_goes_from_limit_to_limit(self):
        pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n-1\n-1\n0.2 0.7\n")
        self.assertEqual(set(self.brightness(wall(0.5))), {26214})  # 0.4 * 65535

    def test_it_goes_from_limit_to_limit_however_far_they_are_apart(self):
        # The smallest double, limits whose difference is none, and a third of the way between such limits.
        for front, rear, z, expected in (("0", "5e-324", "0", 65535), ("-1.5e308", "1.5e308", "-1.5e308",
                                                                       65535), ("-1.5e308", "1.5e308",
                                                                                "-0.5e308", 43690)):
            pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n-1\n-1\n{front} {rear}\n")
            self.assertEqual(set(self.brightness(wall_at(z))), {expected}, (front, rear, z))

    def test_every_pixel_is_that_of_the_text(self):
        stage3 = random_triangles(3, 5)
        text = self.zbuf(stage3).decode()
        depths = [float(word) for word in text.split()]
        seen = [value for value in self.brightness(stage3) if value > 0]
        self.assertEqual(len(seen), len(depths))
        for value, depth in zip(seen, depths):
            self.assertLess(abs(value - 65535 * (1 - depth) / 2), 0.55)


class Samples(Pictures):
    def means(self, data, count):
        """The means of count x count pixels, of an image that is so many times as large; halves rounded
        up."""
        wide = COLUMNS * count
        result = bytearray()
        for row in range(ROWS):
            for column in range(COLUMNS):
                for channel in range(3):
                    total = sum(data[3 * ((row * count + i) * wide + column * count + k) + channel]
                                for i in range(count) for k in range(count))
                    result.append((2 * total + count * count) // (2 * count * count))
        return bytes(result)

    def test_a_pixel_is_the_mean_of_its_samples(self):
        stage3 = random_triangles(4, 12)
        for coverage in ("nearest", "center"):
            for count in (2, 3):
                pathlib.Path("config.txt").write_text(f"{COLUMNS * count} {ROWS * count}\n")
                large = self.pixels(stage3, "--coverage", coverage, columns=COLUMNS * count,
                                    rows=ROWS * count)
                pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n")
                self.assertEqual(self.pixels(stage3, "--coverage", coverage, "--samples", count),
                                 self.means(large, count))

    def test_depths_stay_those_of_the_centers(self):
        stage3 = random_triangles(5, 12)
        text = self.zbuf(stage3, "--depth-image", "one.pgm")
        self.assertEqual(self.zbuf(stage3, "--samples", "4", "--depth-image", "many.pgm"), text)
        self.assertEqual(pathlib.Path("many.pgm").read_bytes(), pathlib.Path("one.pgm").read_bytes())

    def test_threads_and_algorithms_agree(self):
        stage3 = random_triangles(6, 3000)
        expected = self.pixels(stage3, "--samples", "3")
        for options in (["--threads", "2"], ["--threads", "5"], ["--algorithm", "scanline"]):
            self.assertEqual(self.pixels(stage3, "--samples", "3", *options), expected)


class DepthEpsilon(Pictures):
    def depths_seen(self, stage3, *options):
        return set(self.zbuf(stage3, *options).decode().split())

    def test_every_depth_format_takes_it(self):
        for depth in ("f64", "f32", "u24"):
            self.assertEqual(
                self.depths_seen(wall(0.5) + wall(0.25), "--depth", depth, "--depth-epsilon", "0.3"),
                {"0.500000"})

    def test_the_scanline_algorithm_has_none(self):
        done = run("zbuf", "config.txt", "--depth-epsilon", "0.1", "--algorithm", "scanline")
        self.assert_fails(
            done, 2, "zbuf: --depth-epsilon: expected 0 with --algorithm scanline, which keeps no order of "
            "drawing, found '0.1' (try zbuf --help)")


class DepthLimits(Pictures):
    """The limits of Z may be as far apart as the depth format allows; messages.txt has those that are
    refused."""
    def expect_depth(self, format_name, front, rear, z, expected):
        pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n-1\n-1\n{front} {rear}\n")
        for options in ([], ["--algorithm", "scanline"], ["--coverage", "center"], [
                "--depth-epsilon", "1e300"]):
            with self.subTest(depth=format_name, front=front, rear=rear, z=z, options=options):
                words = self.zbuf(wall_at(z), "--depth", format_name, *options).decode().split()
                self.assertEqual({float(word) for word in words}, {expected})
                self.assertEqual(len(words), COLUMNS * ROWS)

    def test_a_double_holds_all(self):
        for z in ("-1.7e308", "1.6e308", "0"):
            self.expect_depth("f64", "-1.7e308", "1.7e308", z, float(z))

    def test_a_float_holds_floats(self):
        for z in ("-3.4e38", "3.3e38", "0.5"):
            self.expect_depth("f32", "-3.4028235e38", "3.4028235e38", z,
                              struct.unpack("f", struct.pack("f", float(z)))[0])

    def test_24_bits_hold_what_is_a_double_apart(self):
        # The front limit is exact. A step is 1.7e308 / (2^24 - 1), so 1.23e307 is 1213880.85 steps.
        self.expect_depth("u24", "-0.85e308", "0.85e308", "-0.85e308", -0.85e308)
        self.expect_depth("u24", "0", "1.7e308", "1.23e307", 1213881 * (1.7e308 / 16777215))

    def test_what_lies_outside_the_limits_of_a_float_is_not_drawn(self):
        pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n-1\n-1\n-3e38 3e38\n")
        for z in ("-1e39", "1e39", "-1e308", "1e308"):
            side, limit = ("before the front", "-3e+38") if z.startswith("-") else ("beyond the rear",
                                                                                    "3e+38")
            note = (f"zbuf: note: the picture is empty: the triangle is {side} limit (z is {float(z):.4g}, "
                    f"the limit of the config is {limit})\n")
            self.assertEqual(self.zbuf(wall_at(z), "--depth", "f32", note=note).split(), [])

    def test_a_depth_epsilon_sees_differences_beyond_a_double(self):
        pathlib.Path("config.txt").write_text(f"{COLUMNS} {ROWS}\n-1\n-1\n-1.7e308 1.7e308\n")
        stage3 = wall_at("1e308") + "\n" + wall_at("-1e308")
        self.assertEqual({float(word)
                          for word in self.zbuf(stage3, "--depth-epsilon", "1.7e308").split()}, {-1e308})


def distance_to_segment(p, a, b):
    along, way = (b[0] - a[0], b[1] - a[1]), (p[0] - a[0], p[1] - a[1])
    t = (way[0] * along[0] + way[1] * along[1]) / (along[0]**2 + along[1]**2)
    t = min(1, max(0, t))
    return math.hypot(way[0] - t * along[0], way[1] - t * along[1])


class Wireframes(Pictures):
    SCENE = "0 0 0\n0 0 -1\n0 1 0\n90 1 1 10\nLIGHTcolor 255 255 255\ntriangle\n"
    # At the sides, all corners are in front of the eye: one is in the picture, or two, or none and one beyond
    # the far plane. At the eye, one corner is far behind it, or two.
    CUT_AT_SIDES = ("-1 1.5 -5\n9 -3 -4\n-4 -9 -6\n", "-1 -1 -4\n1.3 -2 -5\n3 40 -6\n",
                    "-9 -3 -5\n9 -4 -6\n1 90 -40\n")
    CUT_AT_THE_EYE = ("-1 -1 -2.9\n2 -1.3 -3\n3 4 7\n", "0.5 0.6 -5\n3 -9 4\n-4 -7 9\n")

    def wireframe(self, scene, clip):
        stage3 = pipe(["model"], ["view"], ["project", "--clip", clip], stdin=scene + "end\n")
        return self.pixels(stage3, "--wireframe", "--coverage", "center", "--shading", "none")

    def test_silhouettes_are_unbroken_and_no_pixel_is_far_from_an_edge(self):
        """Of a pyramid that is seen from above."""
        rng, step_count, lit_count = random.Random(6), 0, 0

        def on_screen(p):
            return (p[0] + 1) * COLUMNS / 2 - 0.5, (1 - p[1]) * ROWS / 2 - 0.5

        for _ in range(9):
            turn = rng.uniform(0, 1)
            base = [(0.9 * math.cos(turn + i), 0.9 * math.sin(turn + i), 0.5) for i in range(6)]
            apex = (rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4), -0.5)
            image = self.pixels("".join(triangles([apex, p, q]) for p, q in zip(base, base[1:] + base[:1])),
                                "--wireframe")
            lit = {(i % COLUMNS, i // COLUMNS) for i in range(COLUMNS * ROWS) if any(image[3 * i:3 * i + 3])}
            points = [*map(on_screen, base)]
            outline = [*zip(points, points[1:] + points[:1])]
            spokes = [(on_screen(apex), point) for point in points]
            for p in lit:
                self.assertLessEqual(min(distance_to_segment(p, *edge) for edge in outline + spokes),
                                     0.5 + 1e-6)
            for p, q in outline:
                axis = int(abs(p[0] - q[0]) < abs(p[1] - q[1]))
                for along in range(math.ceil(min(p[axis], q[axis])), math.floor(max(p[axis], q[axis])) + 1):
                    part = (along - p[axis]) / (q[axis] - p[axis])
                    across = math.ceil(p[1 - axis] + part * (q[1 - axis] - p[1 - axis]) - 0.5)
                    step_count += 1
                    lit_count += ((across, along) if axis else (along, across)) in lit
        self.assertGreater(step_count, 500)
        self.assertGreaterEqual(lit_count, 0.99 * step_count)

    def test_cuts_are_no_edges(self):
        for corners in self.CUT_AT_SIDES:
            for light in ("", "light 0 0 0 1 1 1\n"):
                scene = self.SCENE.replace("LIGHT", light) + corners
                whole = self.wireframe(scene, "none")
                self.assertGreater(sum(map(bool, whole)), 12)
                self.assertEqual(self.wireframe(scene, "frustum"), whole)

    def test_cuts_at_the_near_plane_are_no_edges(self):
        for corners in self.CUT_AT_THE_EYE:
            plain, lit = (self.wireframe(self.SCENE.replace("LIGHT", light) + corners, "near")
                          for light in ("", "light 0 0 0 1 1 1\n"))
            self.assertGreater(sum(map(bool, plain)), 12)
            self.assertEqual(plain, lit)

    def test_an_edge_between_two_triangles_is_drawn(self):
        quad = triangles([(-0.8, -0.8, 0), (0.8, -0.8, 0), (0.8, 0.8, 0)], [(-0.8, -0.8, 0), (0.8, 0.8, 0),
                                                                            (-0.8, 0.8, 0)])
        image = self.pixels(quad, "--wireframe")
        middle = 3 * (ROWS // 2 * COLUMNS + COLUMNS // 2)
        self.assertNotEqual(image[middle:middle + 3], bytes(3))
        self.assertEqual(image[middle + 9:middle + 12], bytes(3))

    def test_the_background_shows_between_the_edges(self):
        image = self.pixels(
            "background 1 2 3\n" + wall(0), "--wireframe",
            note="zbuf: note: the picture is empty: --wireframe shows edges alone, and none is in sight\n")
        self.assertEqual(image, bytes((1, 2, 3)) * (COLUMNS * ROWS))

    def test_all_edges_lie_over_each_other(self):
        """Of triangles of constant depth, each pixel has the color of the nearest whose edge is there."""
        rng = random.Random(4)
        shapes = [[(rng.uniform(-1.3, 1.3), rng.uniform(-1.3, 1.3), z / 20) for _ in range(3)]
                  for z in rng.sample(range(-20, 20), 12)]
        texts = [f"triangle {i}\n" + triangles(corners) for i, corners in enumerate(shapes)]
        by_depth = sorted(range(len(shapes)), key=lambda i: shapes[i][0][2])
        alone = [self.pixels(texts[i], "--wireframe") for i in by_depth]
        image = self.pixels("".join(texts), "--wireframe", "all")
        for i in range(0, len(image), 3):
            expected = next((one[i:i + 3] for one in alone if any(one[i:i + 3])), bytes(3))
            self.assertEqual(image[i:i + 3], expected)
        self.assertNotEqual(image, self.pixels("".join(texts), "--wireframe"))

    def test_algorithms_and_threads_agree(self):
        stage3 = random_triangles(9, 200)
        for words in (["--wireframe"], ["--wireframe", "all"]):
            expected = self.pixels(stage3, *words)
            for options in (["--threads", "3"], ["--algorithm", "scanline"]):
                self.assertEqual(self.pixels(stage3, *words, *options), expected)

    def test_samples_keep_the_width_of_lines(self):
        corners = triangles([(-9, -9, 0), (9, -9, 0), (0.013, 0.5, 0)])
        for words in (["--wireframe"], ["--wireframe", "all"]):
            one, many = (sum(self.pixels(corners, *words, "--samples", n, "--coverage", "center"))
                         for n in (1, 8))
            self.assertLess(abs(one / many - 1), 0.25)


if __name__ == "__main__":
    unittest.main()
