#!/usr/bin/env python3
"""Color, normals and light through model, view and project, against values worked out by hand.

usage: colors_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import decimal
import unittest

from toolbox import CAMERA, HEADER, HEADERS, ToolTest, pipe, run

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
    def test_model_writes_the_looks_and_the_columns(self):
        text = pipe(["model"], stdin=LIT).decode()
        self.assertEqual(text, (
            "eye 0 0 5\nlook 0 0 0\nup 0 1 0\nperspective 60 1 1 100\nattributes color normal\n" + LOOKS +
            "light 1 2 0 1 0.5 0\n"
            "1.0000000 0.0000000 0.0000000 255.0000000 0.0000000 127.5000000 0.0000000 0.0000000 1.0000000\n"
            "2.0000000 0.0000000 0.0000000 255.0000000 0.0000000 127.5000000 0.0000000 0.0000000 1.0000000\n"
            "1.0000000 1.0000000 0.0000000 255.0000000 0.0000000 127.5000000 0.0000000 0.0000000 "
            "1.0000000\n\n"
            "1.0000000 0.0000000 0.0000000 1.0000000 2.0000000 3.0000000 1.0000000 0.0000000 0.0000000\n"
            "2.0000000 0.0000000 0.0000000 1.0000000 2.0000000 3.0000000 1.0000000 0.0000000 0.0000000\n"
            "1.0000000 1.0000000 0.0000000 1.0000000 2.0000000 3.0000000 1.0000000 0.0000000 0.0000000\n\n"))

    def test_view_takes_the_lights_and_normals_along(self):
        # Seen from +x, a normal along +x points at the eye (+z), and +z is to the left.
        scene = LIT.replace("0 0 5\n", "5 0 0\n", 1)
        text = pipe(["model"], ["view"], stdin=scene)
        self.assertIn("light 0 2 -4 1 0.5 0\n", text.decode())
        self.assertEqual([v[6:] for v in vertices(text)], 3 * [[-1, 0, 0]] + 3 * [[0, 0, 1]])

    def test_project_copies_columns_and_drops_the_sign_of_zero(self):
        lines = [
            "0 0 -2 -0.0 255 0.5 -0.0 0 -1\n", "1 0 -2 0 -0 7 0 -0.0 1\n", "0 1 -2 -0e5 1 2.25 1 -0 -0.0\n"]
        text = HEADERS["project"] + "attributes color normal\n" + "".join(lines) + "\n"
        copied = [[0, 255, 0.5, 0, 0, -1], [0, 0, 7, 0, 0, 1], [0, 1, 2.25, 1, 0, 0]]
        for decimals in (7, 3, 16):
            done = run("project", "--digits", decimals, stdin=text)
            columns = [" ".join(line.split()[4:]) for line in done.stdout.decode().splitlines()[1:4]]
            self.assertEqual(columns,
                             [" ".join(f"{number:.{decimals}f}" for number in three) for three in copied])
        done = run("project", "--digits", "exact", stdin=text)
        columns = [" ".join(line.split()[4:]) for line in done.stdout.decode().splitlines()[1:4]]
        self.assertEqual(columns, [" ".join(map(str, three)) for three in copied])

    def test_project_adds_w_and_says_what_it_projected_by(self):
        text = pipe(["model"], ["view"], ["project"], stdin=LIT)
        header = text.decode().splitlines()[:8]
        top = float(1 / decimal.Decimal(3).sqrt())  # near tan 30 degrees: the nearest double
        self.assertEqual(header[0], f"projected frustum {-top!r} {top!r} {-top!r} {top!r} 1 100")
        self.assertEqual(header[1], "attributes w color normal")
        self.assertEqual(header[-2], "light 1 2 -5 1 0.5 0")
        self.assertTrue(all(v[3] == 5 for v in vertices(text)))

    def test_an_orthographic_projection_is_passed_on_with_lights_and_w_is_1(self):
        scene = LIT.replace("60 1 1 100", "ortho -2 2 -3 3 0 10")
        text = pipe(["model"], ["view"], ["project"], stdin=scene)
        self.assertTrue(
            text.decode().startswith("projected ortho -2 2 -3 3 0 10\nattributes w color normal\n"))
        self.assertTrue(all(v[3] == 1 for v in vertices(text)))

    def test_without_lights_the_projection_goes(self):
        scene = CAMERA + "color 1 2 3\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
        text = pipe(["model"], ["view"], ["project"], stdin=scene).decode()
        self.assertTrue(text.startswith("attributes w color\n0.0000000 0.0000000 0."), text)

    def test_project_gives_clipped_triangles_their_corners_where_there_is_light(self):
        # fovY 90, near 1, far 3: in clip space x and y stay, z is 2 d - 3 for the distance d, and w is d.
        lit = CAMERA.replace("60 1 1 100", "90 1 1 3").replace("0 0 5", "0 0 0",
                                                               1).replace("0 0 0\n0 1 0", "0 0 -1\n0 1 0")
        lit += "color 9 8 7\nLIGHTtriangle\n-1 0 -3\n1 0 -3\n0 2 0.5\nend\n"
        text = pipe(["model"], ["view"], ["project", "--digits", "2"],
                    stdin=lit.replace("LIGHT", "light 0 0 0 1 1 1\n"))
        # From d = 3 to d = -0.5 an edge crosses the near plane, d = 1, after 4/7.
        body = text.decode().split("light 0 0 0 1 1 1\n")[1]
        self.assertEqual(body, (
            "clipped\n-1 0 3 3 9 8 7\n1 0 3 3 9 8 7\n0 2 -4 -0.5 9 8 7\n\n"
            "-0.33 0.00 1.00 3 9.00 8.00 7.00\n0.33 0.00 1.00 3 9.00 8.00 7.00\n0.43 1.14 -1.00 1 9.00 8.00 "
            "7.00\n\n"
            "triangle 0\n"
            "-0.33 0.00 1.00 3 9.00 8.00 7.00\n0.43 1.14 -1.00 1 9.00 8.00 7.00\n-0.43 1.14 -1.00 1 9.00 "
            "8.00 7.00\n\n"
        ))
        self.assertNotIn(b"clipped", pipe(["model"], ["view"], ["project"], stdin=lit.replace("LIGHT", "")))

    def test_only_projected_texts_have_clipped_triangles(self):
        for tool in ("view", "project"):
            done = run(tool, stdin=HEADERS[tool] + "clipped\n")
            self.assert_fails(done, 1,
                              f"{tool}: <stdin>:5:1: expected 'triangle N' or a vertex, found 'clipped'")

    def test_a_clipped_triangle_has_w(self):
        done = run(
            "zbuf", "config.txt",
            stdin="projected ortho -1 1 -1 1 1 2\nattributes w color\nlight 0 0 0 1 1 1\nclipped\n"
            "0 0 0 -1 255 0 0\n0 0 0 0 255 0\n")
        self.assert_fails(
            done, 1,
            "zbuf: <stdin>:6:14: expected the blue of vertex 2 of 3 (x y z w r g b, by the line 'attributes "
            "w color'), found the end "
            "of the line")

    def test_bare_leaves_all_of_it_out(self):
        plain = CAMERA + "translate 1 0 0\n" + 2 * "triangle\n0 0 0\n1 0 0\n0 1 0\n" + "end\n"
        self.assertEqual(pipe(["model", "--bare"], stdin=LIT), pipe(["model", "--bare"], stdin=plain))
        self.assertEqual(pipe(["model"], ["view", "--bare"], stdin=LIT),
                         pipe(["model"], ["view", "--bare"], stdin=plain))

    def test_w_is_for_projected_texts(self):
        for tool in ("view", "project"):
            done = run(tool, stdin=HEADERS[tool] + "attributes w color\n")
            self.assert_fails(done, 1, f"{tool}: <stdin>:5:12: expected a text that is not projected yet, "
                              "found one with the column 'w', which project adds")

    def test_a_short_line_is_told_its_columns(self):
        done = run("view", stdin=HEADER + "attributes color\n0 0 0 1 2\n")
        self.assert_fails(
            done, 1,
            "view: <stdin>:6:10: expected the blue of vertex 1 of 3 (x y z r g b, by the line 'attributes "
            "color'), found the end "
            "of the line")


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

    def test_stay_normal_under_uneven_scale(self):
        # The plane x + y = 0 becomes x / 2 + y = 0, with the normal (1 2 0) / sqrt 5.
        self.assert_normal("scale 2 1 1", "1 1 0", (5 ** -0.5, 2 * 5 ** -0.5, 0))

    def test_are_mirrored_with_the_surface(self):
        self.assert_normal("scale -1 1 1", "0.6 0 0.8", (-0.6, 0, 0.8))
        self.assert_normal("scale -1 1 1", "0 0 1", (0, 0, 1))

    def test_turn_with_the_surface(self):
        self.assert_normal("rotate 90 0 0 1", "1 0 0", (0, 1, 0))

    def test_do_not_move(self):
        self.assert_normal("translate 10 20 30", "0 3 4", (0, 0.6, 0.8))

    def test_have_length_1_at_any_scale(self):
        self.assert_normal("scale 1e-200 1e-200 1e-200", "0 3 4", (0, 0.6, 0.8))
        self.assert_normal("scale 1e120 1e120 1e120", "0 3e-300 4e-300", (0, 0.6, 0.8))

    def test_of_what_is_made_flat_are_the_planes(self):
        self.assert_normal("scale 1 1 0", "0.6 0 0.8", (0, 0, 1))

    def test_without_a_direction_left_are_0(self):
        self.assertEqual(self.normal_after("scale 1 1 0", "1 0 0"), [0, 0, 0])


class Clipping(ToolTest):
    # One vertex is behind the eye: the cuts are at z = -1, half-way from (0 0 -2) to (0 0 0) in clip space.
    TEXT = ("perspective 90 1 1 100\nattributes color normal\n"
            "-3 0 -3 0 0 0 1 0 0\n3 0 -3 90 0 0 0 1 0\n0 1 1 200 40 0 0 0 1\n\n")

    def test_interpolates_attributes_in_clip_space(self):
        text = pipe(["project", "--digits", "exact"], stdin=self.TEXT)
        # w goes from 3 to -1, so it is 1 half-way: there the colors and the normals are the means.
        by_color = {tuple(v[4:7]): v for v in vertices(text)}
        self.assertEqual(set(by_color), {(0, 0, 0), (90, 0, 0), (145, 20, 0), (100, 20, 0)})
        self.assertEqual(by_color[145, 20, 0][3:], [1, 145, 20, 0, 0, 0.5, 0.5])
        self.assertEqual(by_color[100, 20, 0][3:], [1, 100, 20, 0, 0.5, 0, 0.5])
        self.assertEqual(by_color[0, 0, 0][3], 3)

    def test_gives_every_piece_its_triangles_number(self):
        text = pipe(["project"], stdin=self.TEXT + self.TEXT.split("normal\n")[1]).decode()
        self.assertEqual(text.count("triangle 0\n"), 1)
        self.assertEqual(text.count("triangle 1\n"), 1)

    def test_culled_triangles_take_their_attributes_along(self):
        back = "0 0 -2 1 1 1\n0 1 -2 1 1 1\n1 0 -2 1 1 1\n\n"
        front = "0 0 -2 9 9 9\n1 0 -2 9 9 9\n0 1 -2 9 9 9\n\n"
        text = pipe(["project", "--cull", "back"],
                    stdin="perspective 90 1 1 100\nattributes color\n" + back + front)
        self.assertTrue(text.decode().startswith("attributes w color\ntriangle 1\n"))
        self.assertEqual([v[3:] for v in vertices(text)], 3 * [[2, 9, 9, 9]])


if __name__ == "__main__":
    unittest.main()
