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
