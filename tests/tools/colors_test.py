#!/usr/bin/env python3
"""Paints draw what colors draw, by zbuf and by trace.

usage: colors_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import unittest

from toolbox import CAMERA, ToolTest, pipe


class Paints(ToolTest):
    def scene(self, light, paints, colors):
        bodies = ("triangle\n-1 -1 0\n1 -1 0\n0 1 0\n", "triangle\n-2 -1 4.5\n2 -1 5.5\n0 -0.5 -4\n",
                  "triangle\n0.2 0 1\n1 0 1\n0.5 1 1\n")
        return CAMERA + light + "".join(f"material 1 0.8 0.5 20\n{paint}" for paint in paints) + "".join(
            f"{color}use {k}\n{body}" for k, (color, body) in enumerate(zip(colors, bodies))) + "end\n"

    def test_draw_what_colors_draw_without_a_column(self):
        """The second triangle is cut, the third has no paint of its own."""
        for light in ("", "light 3 4 5 1 0.9 0.8\nambient 0.1 0.2 0.1\n"):
            by_paint = self.scene(light, ("paint 200 60.25 10\n", "paint 10 200 99.5\n", ""), ("", "", ""))
            by_color = self.scene(light, ("", "", ""),
                                  ("color 200 60.25 10\n", "color 10 200 99.5\n", "color 255 255 255\n"))
            self.assertNotIn(b" color", pipe(["model"], stdin=by_paint))
            for words in (["zbuf"], ["zbuf", "--samples", 2, "--threads", 2], ["trace"], [
                    "trace", "--no-shadows"]):
                drawing = [*words, "--size", "60x60", "-o", "-"]
                stages = [["model"], ["view"], *[["project"]] * (words[0] == "zbuf"), drawing]
                self.assertEqual(pipe(*stages, stdin=by_paint), pipe(*stages, stdin=by_color), words)


if __name__ == "__main__":
    unittest.main()
