#!/usr/bin/env python3
"""Changes to a scene that must change nothing, or only one stated thing, over random scenes through the real
tools.

usage: properties_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import random
import unittest

from toolbox import ToolTest, pipe, run

SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12))  # fewer with sanitizers, see CMakeLists.txt


class Scene:
    """A random scene as pieces of text: a camera that looks at the surroundings of the origin, and triangles
    there."""
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.eye, self.look, self.up = (self.numbers(3, 1) for _ in range(3))
        self.eye = [8 + self.eye[0], 1 + self.eye[1], self.eye[2]]
        self.up = [0.25, 1, 0.125]
        self.triangles = [[self.numbers(3, 2) for _ in range(3)] for _ in range(25)]

    def numbers(self, count, limit):
        # Whole multiples of 2^-12, so that scaling and moving by them is exact.
        return [self.random.randrange(-limit * 4096, limit * 4096) / 4096 for _ in range(count)]

    def text(self, before="", triangles=None, scale=1):
        row = lambda numbers: " ".join(repr(scale * number) for number in numbers) + "\n"
        camera = row(self.eye) + row(self.look) + row(self.up) + f"50 1.25 {scale * 0.5!r} {scale * 40!r}\n"
        body = "".join(
            "triangle\n" + "".join(map(row, t)) for t in (self.triangles if triangles is None else triangles))
        return camera + before + body + "end\n"


class Properties(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("60 40\n")

    def scenes(self):
        for seed in range(SCENE_COUNT):
            with self.subTest(seed=seed):
                yield Scene(seed)

    def ndc(self, text, *digits):
        return pipe(["model", *digits], ["view", *digits], ["project", "--clip", "near", *digits], stdin=text)

    def picture(self, ndc, *options):
        """(depths, image) of an NDC text."""
        done = run("zbuf", "config.txt", *options, stdin=ndc)
        self.assertEqual(done.returncode, 0)
        # One of these triangles may be in no pixel.
        self.assertRegex(done.stderr.decode(), "^(zbuf: note: the picture is empty: .*\n)?$")
        return done.stdout, pathlib.Path("out.bmp").read_bytes()

    def drawn(self, stdout):
        """The depths, row by row; the text has only those of covered pixels."""
        return [[float(word) for word in line.split()] for line in stdout.decode().split("\n")]

    def test_push_anything_pop_changes_nothing_behind_it(self):
        for scene in self.scenes():
            row = lambda: " ".join(map(repr, scene.numbers(3, 3)))
            anything = (f"push\ntranslate {row()}\nrotate {scene.random.uniform(-400, 400)!r} 1 2 3\npush\n"
                        f"scale {row()}\npop\nscale {row()}\npop\n")
            self.assertEqual(
                run("model", stdin=scene.text(anything)).stdout,
                run("model", stdin=scene.text()).stdout)

    def test_scaling_the_world_and_its_camera_by_a_power_of_two_changes_nothing(self):
        for scene in self.scenes():
            expected = self.ndc(scene.text(), "--digits", "exact")
            self.assertGreater(expected.count(b"\n\n"), 10)
            for scale in (2.0**40, 2.0**-30):
                self.assertEqual(self.ndc(scene.text(scale=scale), "--digits", "exact"), expected)

    def test_rotating_or_reversing_the_vertices_keeps_what_is_covered(self):
        for scene in self.scenes():
            bodies = [body.split("\n")[:4] for body in self.numbered(self.ndc(scene.text()))]
            for coverage in ("nearest", "center"):
                covered = set()
                for order in ((1, 2, 3), (2, 3, 1), (3, 2, 1), (1, 3, 2)):
                    text = "".join(
                        "\n".join([body[0], *(body[i] for i in order)]) + "\n\n" for body in bodies)
                    self.picture(text, "--coverage", coverage, "--fragments", "fragments.txt")
                    fragments = pathlib.Path("fragments.txt").read_text()
                    covered.add(frozenset(line.partition(", depth")[0] for line in fragments.splitlines()))
                self.assertEqual(len(covered), 1)

    def numbered(self, ndc):
        """The triangles of an NDC text, each with its line 'triangle N'."""
        bodies, number = [], 0
        for body in ndc.decode().split("\n\n")[:-1]:
            if body.startswith("triangle"):
                line, body = body.split("\n", 1)
                number = int(line.split()[1])
            bodies.append(f"triangle {number}\n{body}\n\n")
            number += 1
        return bodies

    def test_the_order_of_triangles_matters_only_between_equal_depths(self):
        for scene in self.scenes():
            bodies = self.numbered(self.ndc(scene.text(), "--digits", "exact"))
            for coverage in ("nearest", "center"):
                expected = self.picture("".join(bodies), "--coverage", coverage)
                scene.random.shuffle(bodies)
                # These triangles cross; no two have the same depth at a pixel's center.
                self.assertEqual(self.picture("".join(bodies), "--coverage", coverage), expected)

    def test_of_equal_depths_the_first_stays_and_the_depths_are_the_same(self):
        flat = "-1 -1 0.5\n1 -1 0.5\n-1 1 0.5\n\n"
        other = "-1 -1 0.5\n1 -1 0.5\n1 1 0.5\n\n"
        first = self.picture("triangle 0\n" + flat + "triangle 1\n" + other)
        second = self.picture("triangle 1\n" + other + "triangle 0\n" + flat)
        self.assertEqual(first[0], second[0])
        self.assertNotEqual(first[1], second[1])

    def test_a_triangle_in_pieces_covers_what_it_covered(self):
        for scene in self.scenes():
            for _ in range(10):
                # The pieces share a corner on the edge from b to c; all coordinates are decimals.
                a, b, c = ([2 * scene.random.randrange(-600, 600) for _ in range(2)] for _ in range(3))
                d = [(b[i] + c[i]) // 2 for i in range(2)]
                text = lambda *points: "".join("triangle 0\n" + "".join(
                    f"{x / 1000:.3f} {y / 1000:.3f} 0.25\n" for x, y in t) + "\n" for t in points)
                whole = self.picture(text((a, b, c)), "--coverage", "center")
                self.assertEqual(self.picture(text((a, b, d), (a, d, c)), "--coverage", "center"), whole)


if __name__ == "__main__":
    unittest.main()
