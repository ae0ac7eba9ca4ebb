#!/usr/bin/env python3
"""project --clip-inset moves the planes of --clip inward.

usage: clip_inset_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import unittest

from toolbox import ToolTest, pipe, run

ORTHO = "ortho -1 1 -1 1 1 3\n"
PERSPECTIVE = "perspective 90 1 1 3\n"  # x and y are -x/z and -y/z in NDC


def wall(z, size):
    """Two triangles that form a square in view space."""
    return (f"{-size} {-size} {z}\n{size} {-size} {z}\n{size} {size} {z}\n\n"
            f"{-size} {-size} {z}\n{size} {size} {z}\n{-size} {size} {z}\n\n")


def triangles(text):
    rows = [
        list(map(float,
                 line.split()[:3])) for line in text.decode().splitlines() if line and not line[0].isalpha()]
    return [rows[i:i + 3] for i in range(0, len(rows), 3)]


def area(triangle):
    (ax, ay, _), (bx, by, _), (cx, cy, _) = triangle
    return abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2


class ClipInset(ToolTest):
    def cut(self, text, inset, clip="frustum"):
        return triangles(pipe(["project", "--clip", clip, "--clip-inset", inset], stdin=text))

    def test_what_is_left_fills_the_smaller_square(self):
        for header, z in ((ORTHO, -2), (PERSPECTIVE, -1.5)):  # both are 0 in NDC
            for inset, extent in (("0", 1), ("0.1", 0.9), ("0.5", 0.5), ("0.75", 0.25)):
                pieces = self.cut(header + wall(z, 9), inset)
                self.assertEqual(max(abs(c) for piece in pieces for x, y, _ in piece for c in (x, y)), extent)
                self.assertAlmostEqual(sum(map(area, pieces)), (2 * extent) ** 2, 6)

    def test_near_and_far_come_nearer_together(self):
        slope = ORTHO + "0 0 -0.5\n0.1 0 -3.5\n0 0.1 -3.5\n\n"  # z in NDC is the distance minus 2
        for clip, low, high in (("frustum", -0.75, 0.75), ("near", -0.75, 1.5)):
            depths = [z for piece in self.cut(slope, "0.25", clip) for *_, z in piece]
            self.assertEqual((min(depths), max(depths)), (low, high))

    def test_what_lies_between_the_planes_is_dropped(self):
        for clip in ("frustum", "reject"):
            aside = ORTHO + "0.8 0 -2\n0.9 0 -2\n0.9 0.1 -2\n\n"
            self.assertEqual(len(self.cut(aside, "0.125", clip)), 1)
            self.assertEqual(self.cut(aside, "0.25", clip), [])

    def test_what_is_inside_stays_as_it_is(self):
        text = PERSPECTIVE + "0.1 0.2 -1.4\n0.3 0 -1.6\n0 0.3 -1.5\n\n"
        self.assertEqual(self.cut(text, "0.1"), triangles(pipe(["project"], stdin=text)))

    def test_colors_are_cut_where_the_planes_stand(self):
        text = "attributes color\n" + ORTHO + "-1 0 -2 0 0 0\n1 0 -2 200 0 0\n1 1 -2 200 0 0\n\n"
        lines = pipe(["project", "--clip", "frustum", "--clip-inset", "0.5"],
                     stdin=text).decode().splitlines()
        vertices = [list(map(float, line.split())) for line in lines if line and not line[0].isalpha()]
        self.assertEqual(min(x for x, *_ in vertices), -0.5)
        for x, y, z, w, red, *_ in vertices:
            self.assertEqual((w, round(red, 6)), (1, round(100 * (x + 1), 6)))

    def test_a_lit_triangle_keeps_its_corners_in_clip_space(self):
        corners = [(-9, -9, -1.0625), (9, -9, -1.0625), (0, 9, -2.5)]
        # cot 45 degrees is 1; z = ((far + near) distance - 2 far near) / (far - near), and w is the distance.
        expected = [[x, y, ((3 + 1) * -z - 2 * 3 * 1) / (3 - 1), -z] for x, y, z in corners]
        text = "light 0 0 0 1 1 1\n" + PERSPECTIVE + "".join(f"{x} {y} {z}\n" for x, y, z in corners) + "\n"
        for inset in ("0", "0.25", "0.5"):
            for clip in ("near", "frustum"):
                lines = pipe(["project", "--clip", clip, "--clip-inset", inset],
                             stdin=text).decode().splitlines()
                if "clipped" not in lines:
                    self.assertEqual((clip, inset), ("near", "0"))  # the near plane cuts nothing there
                    continue
                at = lines.index("clipped")
                self.assertEqual([list(map(float, line.split())) for line in lines[at + 1:at + 4]], expected)

    def test_it_needs_planes_to_move(self):
        for words in ([], ["--clip", "none"], ["--clip", "auto"]):
            done = run("project", "--clip-inset", "0.1", *words, stdin=ORTHO)
            self.assertEqual((done.returncode, done.stderr.decode()), (
                2,
                "project: --clip-inset: expected --clip near, frustum or reject with it, found none of these "
                "(try project --help)\n"
            ))

    def test_an_inset_that_leaves_nothing_is_misuse(self):
        for word in ("1", "-0.1", "x", "nan", "1e400"):
            done = run("project", "--clip", "near", f"--clip-inset={word}", stdin=ORTHO)
            self.assertEqual((done.returncode, done.stderr.decode()), (
                2,
                f"project: --clip-inset: expected a number from 0 to less than 1, found '{word}' (try "
                f"project --help)\n"
            ))


if __name__ == "__main__":
    unittest.main()
