#!/usr/bin/env python3
"""Bounds in the texts, and zbuf --certify, end to end. Reference.CertainPixels... asks whether they hold.

usage: certify_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import random
import unittest

from toolbox import CAMERA, SCENE, ToolTest, pipe, run, stage_texts

# x, y and w of clip space are those of view space; each may be off by 1/8.
NDC = "projected frustum -1 1 -1 1 1 9\nbounds ndc 0.125 0 0 0\nattributes w\n"
CENTER = ("--coverage", "center", "--certify")
WINDOW, MIDDLE = "8 8\n-4\n-4\n-1 1\n", "8 8\n-.1\n-.1\n-1 1\n"


def depth(w):
    return 1.25 - 2.25 / w


def triangle(*points):
    """A triangle in NDC of points in clip space."""
    return "".join(f"{x / w!r} {y / w!r} {depth(w)!r} {w!r}\n" for x, y, w in points) + "\n"


def wall(w, tilt=0):
    return triangle(*((x, y, w + tilt * x) for x, y in ((-1, -50), (-1, 50), (1, 0)))) if tilt else triangle(
        (-60, -20, w), (60, -20, w), (0, 80, w))


class Bounds(ToolTest):
    def test_only_texts_that_ask_have_bounds(self):
        for plain, bounded in zip(stage_texts(), stage_texts(SCENE, "--bounds")):
            self.assertNotIn(b"bounds", plain)
            self.assertEqual(bounded.count(b"bounds"), 1)
        line = b"bounds world 5.00001e-08 1.1275702593849246e-16\n"
        self.assertEqual(pipe(["model", "--bounds"], stdin=SCENE),
                         pipe(["model"], stdin=SCENE).replace(b"1 100\n", b"1 100\n" + line))

    def test_each_stage_adds_what_it_rounds(self):
        """Of 2 decimals 0.005 and of 3 0.0005, the more by a turned camera: by sqrt(3) at most."""
        text = ("eye 2 2 2\nlook 0 0 0\nup 0 0 1\northo -1 1 -1 1 1 9\nbounds world 0.005 0\n"
                "1 0 0\n0 1 0\n0 0 1\n\n")
        view = pipe(["view", "--digits", "3"], stdin=text)
        absolute = float(view.split(b"bounds view ")[1].split()[0])
        self.assertAlmostEqual(absolute, 0.005 * 3**0.5 + 0.0005, 8)
        ndc = pipe(["project", "--digits", "2"], stdin=text.split("\n", 3)[3].replace("world", "view"))
        self.assertIn(b"bounds ndc 0.005 0 0.005", ndc)

    def test_a_triangle_that_bounds_keep_from_the_screen_is_dropped(self):
        """Nearer than near / 1024 it is clipped, and nothing is left; farther away it stays whole."""
        for distance, is_possible in ((0.00096, False), (0.00097, True)):
            text = "perspective 60 1 1 100\nbounds view 1e-5 0\n0 0 -{0}\n1 0 -{0}\n0 1 -{0}\n\n".format(
                distance)
            self.assertEqual(b"\nclipped\n" in pipe(["project"], stdin=text), is_possible)

    def test_what_has_no_bounds_is_refused(self):
        sphere, bounded = CAMERA + "sphere 0 0 0 1\nend\n", "ortho -1 1 -1 1 1 9\nbounds view 0 0\n"
        zbuf = ["zbuf", "config.txt", *CENTER]
        for words, text, status, message in (
            (["model", "--bounds", "--bare"], SCENE, 2, "neither --bare nor --facets with it, found --bare"),
            (["model", "--bounds", "--facets", "4"], SCENE, 2, "found --facets"),
            (["model", "--bounds", "--precision",
              "double"], SCENE, 2, "--precision: expected extended, as bounds need it, found 'double'"),
            (["model", "--bounds"], sphere, 1, "a sphere"),
            (["project", "--cull",
              "back"], bounded, 2, "--cull: expected none with bounds in the text, found another"),
                *((["project", "--clip", mode], bounded, 2, "--clip: expected auto or near with bounds")
                  for mode in ("frustum", "reject", "none")),
            (["project", "--clip", "near", "--clip-inset", "0.5"], bounded, 2, "--clip-inset: "),
            (["project"], bounded.replace("0 0\n", "0 -1\n"), 1, "the relative bound of at least 0"),
            (["project"], bounded + "bounds view 0 0\n", 1, "expected one 'bounds'"),
            (["project"], bounded.replace("view 0", "world 0"), 1,
             "'bounds world': a stage before this one has passed on a line that holds for its input"),
            (["project"], bounded.replace(
                "0 0\n", "0 0 0 0\n"), 1, "expected the end of the line after the bounds, found '0'"),
            (["view"], "eye 0 0 5\nlook 0 0 0\nup 0 1 0\nbounds world 1e308 1e308\n", 1,
             "expected bounds that stay finite in view space"),
            (["project"], bounded.replace("view 0", "0"), 1, "expected the space 'world', 'view' or 'ndc'"),
            (["zbuf", "config.txt", "--certify",
              "c"], NDC, 2, "--certify: expected --coverage center with it, found 'nearest'"),
            ([*zbuf, "c", "--samples", "2"], NDC, 2, "--certify: expected --samples 1 with it, found '2'"),
            ([*zbuf, "-", "-o", "-"], NDC, 2, "expected a file, as --certify is standard output, found '-'"),
            ([*zbuf, "-", "--seen", "-"], NDC, 2, "--certify: expected a file, as --seen is"),
            ([*zbuf, "c", "--seen", "s"], NDC, 2, "--seen: expected a text without bounds, found 'bounds'"),
            ([*zbuf, "c"], NDC.replace("ndc 0.125 0 0 0", "view 0 0"), 1, "'bounds view': "),
            ([*zbuf, "c"], "0 0 0\n" * 3, 1, "for --certify"),
        ):
            with self.subTest(words=words):
                done = run(*words, stdin=text)
                self.assertEqual(done.returncode, status)
                self.assertIn(message, done.stderr.decode())
                self.assertNotIn("c", self.files())


class Certify(ToolTest):
    def certify(self, text, *words, config=WINDOW):
        pathlib.Path("config.txt").write_text(config)
        return run("zbuf", "config.txt", *words, *CENTER, "-", stdin=text).stdout.decode().splitlines()

    def test_pixels_are_uncertain_where_the_bounds_reach(self):
        """Near outlines a vertex moves by (1 + 1.6) / 8 / (1.5 - 1/8) = 0.24 pixels, of 1."""
        inner = {(row, column) for row in range(2, 6) for column in range(2, 6)}
        ring = {pixel for pixel in inner if {2, 5} & {*pixel}}
        diagonal = {(3, 4), (4, 3)}
        for half in (1.6, 1.4):  # around the centers of the ring, and just within them
            a, b, c, d = ((1.5 * half * x, 1.5 * half * y, 1.5)
                          for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))
            lines = self.certify(NDC + triangle(a, b, c) + triangle(a, c, d))
            self.assertEqual(lines[:2], ["certain 50", "uncertain 14"])
            self.assertEqual({tuple(map(int, line.split())) for line in lines[2:]}, ring | diagonal)
        edge_on = triangle((-2.4, 0.825, 1.5), (0, 0.825, 1.5), (2.4, 0.825, 1.5))
        self.assertEqual(self.certify(NDC + edge_on)[2:], ["3 2", "3 3", "3 4", "3 5"])

    def test_depths_are_compared_with_all_that_moves_them(self):
        """A wall moves by 1/8; one that recedes to the right by 1/8 more, as x is off by as much."""
        limits = "8 8\n-4\n-4\n%r 1\n"
        for count, text, config in ((64, wall(2) + wall(2.24), WINDOW), (0, wall(2) + wall(2.26), WINDOW),
                                    (64, wall(2, 1) + wall(2.4, 1), MIDDLE), (0, wall(2, 1) + wall(2.9, 1),
                                                                              MIDDLE),
                                    (64, wall(2), limits % depth(1.9)), (0, wall(2), limits % depth(1.8)),
                                    (64, wall(2), f"8 8\n-4\n-4\n-1 {depth(2.1)!r}\n"),
                                    (0, wall(2), f"8 8\n-4\n-4\n-1 {depth(2.2)!r}\n")):
            self.assertEqual(self.certify(NDC + text, config=config)[1], f"uncertain {count}", (text, config))
        header = "projected ortho -1 1 -1 1 -1 1\nbounds ndc 0 0 0.125 0\nattributes w\n"
        for gap, count in ((0.24, 64), (0.26, 0)):
            text = "".join(f"-60 -20 {z} 1\n60 -20 {z} 1\n0 80 {z} 1\n\n" for z in (0.1, 0.1 + gap))
            self.assertEqual(self.certify(header + text, config="8 8\n")[1], f"uncertain {count}", gap)

    def test_an_edge_on_triangle_is_no_nearer_than_what_is_shown(self):
        """Of what may be nearer, the front limit shows none, nor does what is cut at the near plane."""
        header = "frustum -1 1 -1 1 1 9\nbounds view 0.125 0\n"
        for front, slope, count in ((-1, 0.13, 16), (-1, 0.225, 0), (-3, 0.28, 16), (-3, 0.7, 0)):
            with self.subTest(front=front, slope=slope):
                vertices = "".join(f"{x} {slope * w} {-w}\n" for x, w in ((-60, -0.05), (60, -0.05), (0, 8)))
                text = pipe(["project"], stdin=header + vertices + "\n").decode()
                # The rows' centers are at 0.01 above and below the middle.
                lines = self.certify(text, config=f"8 2\n-1\n-0.02\n{front} 1\n")
                self.assertEqual(lines[1], f"uncertain {count}")

    def test_a_triangle_is_dropped_only_if_it_is_outside_for_certain(self):
        header = "frustum -1 1 -1 1 1 9\nbounds view 0.125 0\n"
        outside, possible = ("-60 -20 {0}\n60 -20 {0}\n0 80 {0}\n\n".format(z)
                             for z in ("-0.8125", "-0.9375"))
        text = pipe(["project", "--clip", "near"], stdin=header + outside).decode()
        self.assertEqual(self.certify(text)[:2], ["certain 64", "uncertain 0"])
        text = pipe(["project", "--clip", "near"], stdin=header + outside + possible).decode()
        self.assertIn("triangle 1\nclipped\n", text)
        self.assertIn("\n\n" + "0.0000000 0.0000000 1.0000000 9\n" * 3 + "\n", text)
        self.assertEqual(self.certify(text)[:2], ["certain 0", "uncertain 64"])

    def test_the_picture_and_the_depths_stay(self):
        outputs = [(run("zbuf", "config.txt", "--coverage", "center", *words,
                        stdin=NDC + wall(5)).stdout, pathlib.Path("out.bmp").read_bytes())
                   for words in ((), ("--certify", "c.txt"))]
        self.assertEqual(outputs[0], outputs[1])
        self.assertEqual(self.files(), ["c.txt", "config.txt", "out.bmp", "scene.txt"])

    def test_rows_algorithms_and_threads_change_nothing(self):
        text = NDC + wall(2, 1) + triangle((-3, 0, 2), (3, -1, 3), (0, 4, 2))
        whole = self.certify(text)
        self.assertGreater(len(whole), 2)
        self.assertEqual(self.certify(text, "--algorithm", "scanline"), whole)
        self.assertEqual(self.certify(text, "--threads", "2"), whole)
        rng, uncertain = random.Random(1), 0
        for _ in range(60):
            text = NDC + "".join(
                triangle(*((rng.uniform(-9, 9), rng.uniform(-9, 9), rng.uniform(2, 5)) for _ in range(3)))
                for _ in range(3))
            whole = self.certify(text)[2:]
            bands = [self.certify(text, "--rows", rows)[2:] for rows in ("0:3", "3:8")]
            self.assertEqual(bands[0] + bands[1], whole)
            uncertain += len(whole)
        self.assertGreater(uncertain, 300)


if __name__ == "__main__":
    unittest.main()
