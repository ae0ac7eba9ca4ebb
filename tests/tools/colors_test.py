#!/usr/bin/env python3
"""Color, normals and light through model, view and project, where the pack does not ask for it.

usage: colors_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import unittest

from toolbox import CAMERA, ToolTest, pipe

LOOKS = "background 1 2 3\nambient 0.1 0.2 0.3\nmaterial 1 0.5 0.25 100000\nattenuation 1 0 0.125\n"
LIT = CAMERA + LOOKS + """color 255 0 127.5
attributes normal
translate 1 0 0
light 0 2 0 1 0.5 0
triangle
0 0 0 0 0 2
1 0 0 0 0 2
0 1 0 0 0 2
color 1 2 3
triangle
0 0 0 1 0 0
1 0 0 1 0 0
0 1 0 1 0 0
end
"""


def vertices(text):
    """The vertex lines of a stage text as lists of numbers."""
    return [list(map(float, line.split())) for line in text.decode().splitlines()
            if line and (line[0].isdigit() or line[0] == "-")]


class ThroughTheStages(ToolTest):
    def test_bare_leaves_all_of_it_out(self):
        plain = CAMERA + "translate 1 0 0\n" + 2 * "triangle\n0 0 0\n1 0 0\n0 1 0\n" + "end\n"
        self.assertEqual(pipe(["model", "--bare"], stdin=LIT), pipe(["model", "--bare"], stdin=plain))
        self.assertEqual(pipe(["model"], ["view", "--bare"], stdin=LIT),
                         pipe(["model"], ["view", "--bare"], stdin=plain))


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
            for words in (["zbuf"], ["zbuf", "--samples", 2, "--threads", 2], ["trace"],
                          ["trace", "--no-shadows"]):
                drawing = [*words, "--size", "60x60", "-o", "-"]
                stages = [["model"], ["view"], *[["project"]] * (words[0] == "zbuf"), drawing]
                self.assertEqual(pipe(*stages, stdin=by_paint), pipe(*stages, stdin=by_color), words)


class Normals(ToolTest):
    def normal_after(self, transform, normal):
        """The printed normal of a triangle with this normal, in world space."""
        triangle = "".join(f"{p} {normal}\n" for p in ("0 0 0", "1 0 0", "0 1 0"))
        scene = CAMERA + f"attributes normal\n{transform}\ntriangle\n{triangle}end\n"
        return vertices(pipe(["model", "--digits", "exact"], stdin=scene))[0][3:]

    def assert_normal(self, transform, normal, expected):
        for got, wanted in zip(self.normal_after(transform, normal), expected):
            self.assertAlmostEqual(got, wanted, delta=1e-15)

    def test_have_length_1_at_any_scale(self):
        self.assert_normal("scale 1e-200 1e-200 1e-200", "0 3 4", (0, 0.6, 0.8))
        self.assert_normal("scale 1e120 1e120 1e120", "0 3e-300 4e-300", (0, 0.6, 0.8))

    def test_without_a_direction_left_are_0(self):
        self.assertEqual(self.normal_after("scale 1 1 0", "1 0 0"), [0, 0, 0])


class Culling(ToolTest):
    def test_takes_the_attributes_along(self):
        back = "0 0 -2 1 1 1\n0 1 -2 1 1 1\n1 0 -2 1 1 1\n\n"
        front = "0 0 -2 9 9 9\n1 0 -2 9 9 9\n0 1 -2 9 9 9\n\n"
        text = pipe(["project", "--cull", "back"],
                    stdin="perspective 90 1 1 100\nattributes color\n" + back + front)
        self.assertTrue(text.decode().startswith("attributes w color\ntriangle 1\n"))
        self.assertEqual([v[3:] for v in vertices(text)], 3 * [[2, 9, 9, 9]])


if __name__ == "__main__":
    unittest.main()
