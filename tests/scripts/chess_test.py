#!/usr/bin/env python3
"""The scene of scripts/make-chess: surfaces that face outwards, on which the pipe has nothing to note.

usage: chess_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import unittest

from toolbox import ToolTest, pipe, run, run_script
from vectors import cross, dot, minus


def scene(around):
    return run_script("make-chess", "--around", str(around), check=True).stdout


class Chess(ToolTest):
    def test_every_normal_is_on_the_side_from_which_its_triangle_is_counterclockwise(self):
        lines = scene(12).splitlines()
        count = 0
        for number, line in enumerate(lines):
            if line != "triangle":
                continue
            corners = [list(map(float, corner.split())) for corner in lines[number + 1:number + 4]]
            a, b, c = (corner[:3] for corner in corners)
            normal = cross(minus(b, a), minus(c, a))
            for corner in corners:
                self.assertAlmostEqual(dot(corner[3:], corner[3:]), 1, 3)
                self.assertGreater(dot(normal, corner[3:]), 0, lines[number:number + 4])
            count += 1
        self.assertGreater(count, 5000)

    def test_the_pipe_notes_nothing_and_backs_are_hidden(self):
        ndc = [
            pipe(["model"], ["view"], ["project", *cull], stdin=scene(6))
            for cull in ([], ["--cull", "back"])]
        options = ["--size", "160x90", "--coverage", "center", "-o", "-"]
        pictures = [run("zbuf", *options, stdin=text) for text in ndc]
        self.assertEqual([(done.returncode, done.stderr) for done in pictures], [(0, b""), (0, b"")])
        self.assertEqual(pictures[0].stdout, pictures[1].stdout)

    def test_more_segments_make_more_triangles(self):
        self.assertGreater(scene(7).count("triangle"), scene(6).count("triangle"))

    def test_a_fineness_that_is_none_is_refused(self):
        for word in ("2", "1001", "1.5", "-3", "many"):
            done = run_script("make-chess", f"--around={word}")
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(f"expected a whole number from 3 to 1000, found '{word}'", done.stderr)


if __name__ == "__main__":
    unittest.main()
