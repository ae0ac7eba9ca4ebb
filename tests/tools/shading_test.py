#!/usr/bin/env python3
"""zbuf's colors and lights, against rays cast through the pixels.

A ray intersects the triangle in view space; color, normal and position there are weighted means of the
corners', and the lighting formula is evaluated there. So nothing is projected, and nothing is interpolated on
the screen.

usage: shading_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import decimal
import math
import pathlib
import unittest

import leeway
import reference
from toolbox import SOURCE, ToolTest, pipe, run
from vectors import cross, dot, minus, unit

SIZE = 24
EYE_AT_5 = "0 0 5\n0 0 0\n0 1 0\n"
PERSPECTIVE, ORTHOGRAPHIC = "60 1 1 100", "ortho -3 3 -3 3 1 100"
LIGHTS = [((2, 3, 4), (0.5, 0.25, 1)), ((-3, 0, 2), (0.5, 0.5, 0.25))]
AMBIENT = (0.1, 0.2, 0.1)
MATERIAL = (1, 0.75, 0.5, 12)
ATTENUATION = (1, 0.01, 0.02)
# Position, color, normal; the triangle is slanted, so that perspective shows.
CORNERS = [((-2, -2, 2), (255, 0, 0), (0, 0, 1)), ((2, -1, -3), (0, 255, 30), (0.6, 0, 0.8)),
           ((0, 2, 0), (30, 60, 255), (0, 0.8, 0.6))]
# Extends beyond the edges of the picture.
LARGE = [(tuple(2 * x for x in p), c, n) for p, c, n in CORNERS]
# The last corner is behind the eye.
CUT = [((-2, -2, 0), (255, 0, 0), (0, 0, 1)), ((2, -2, 0), (0, 255, 30), (0.6, 0, 0.8)),
       ((0, -1, 6), (30, 60, 255), (0, 0.8, 0.6))]
# The last two are, so that one edge disappears.
CUT_TWICE = [((-0.5, 1, -9), (255, 0, 0), (0, 0, 1)), ((6, -3, 9), (0, 255, 30), (0.6, 0, 0.8)),
             ((-5, -2.5, 7), (30, 60, 255), (0, 0.8, 0.6))]
MODELS = ("none", "flat", "gouraud", "phong")


def words(*numbers):
    return " ".join(map(str, numbers))


def scene_of(corners, projection, lit=True):
    lines = [EYE_AT_5 + projection, "attributes color normal", "background 10 20 30"]
    if lit:
        lines += [
            "ambient " + words(*AMBIENT), "material " + words(*MATERIAL),
            "attenuation " + words(*ATTENUATION)]
        lines += ["light " + words(*position, *intensity) for position, intensity in LIGHTS]
    lines += ["triangle"] + [words(*p, *c, *n) for p, c, n in corners] + ["end\n"]
    return "\n".join(lines)


def mean(weights, vectors):
    return tuple(dot(weights, axis) for axis in zip(*vectors))


def in_view_space(p):
    return minus(p, (0, 0, 5))


def lit(p, color, normal, eye_direction):
    """The formula at a point in view space."""
    v = unit(eye_direction)
    n = unit(normal)
    n = n if dot(n, v) >= 0 else tuple(-x for x in n)
    ka, kd, ks, shininess = MATERIAL
    result = [c * ka * a for c, a in zip(color, AMBIENT)]
    for position, intensity in LIGHTS:
        way = minus(in_view_space(position), p)
        d = math.sqrt(dot(way, way))
        light = unit(way)
        half = unit(tuple(a + b for a, b in zip(light, v)))
        att = 1 / (ATTENUATION[0] + ATTENUATION[1] * d + ATTENUATION[2] * d * d)
        if dot(n, light) <= 0:
            continue
        for i in range(3):
            result[i] += att * intensity[i] * (color[i] * kd * dot(n, light) +
                                               255 * ks * max(0, dot(n, half))**shininess)
    return tuple(result)


def expected_pixel(row, column, corners, projection, model):
    """The color at the ray's hit, or None if it misses the triangle."""
    x, y = (2 * column + 1) / SIZE - 1, 1 - (2 * row + 1) / SIZE
    is_perspective = projection == PERSPECTIVE
    slope = math.tan(math.pi / 6)
    start = (0, 0, 0) if is_perspective else (3 * x, 3 * y, 0)
    way = (x * slope, y * slope, -1) if is_perspective else (0, 0, -1)
    points = [in_view_space(p) for p, _, _ in corners]
    # Cramer's rule for start + s way = sum of weights times points.
    volumes = [dot(minus(points[i - 2], start), cross(minus(points[i - 1], start), way)) for i in range(3)]
    weights = [volume / sum(volumes) for volume in volumes]
    p = mean(weights, points)
    if min(weights) < 0 or (is_perspective and p[2] > -1):
        return None
    colors = [c for _, c, _ in corners]
    normals = [n for _, _, n in corners]

    def towards_eye(point):
        return tuple(-x for x in point) if is_perspective else (0, 0, 1)

    if model == "none":
        return mean(weights, colors)
    if model == "gouraud":
        at_corners = [lit(q, c, n, towards_eye(q)) for q, c, n in zip(points, colors, normals)]
        return mean(weights, [[min(255, channel) for channel in color] for color in at_corners])
    if model == "flat":
        middle = mean([1 / 3] * 3, points)
        face = cross(minus(points[1], points[0]), minus(points[2], points[0]))
        return lit(middle, mean([1 / 3] * 3, colors), face, towards_eye(middle))
    return lit(p, mean(weights, colors), mean(weights, normals), towards_eye(p))


class Shading(ToolTest):
    def image_of(self, stage3, *options):
        pathlib.Path("config.txt").write_text(f"{SIZE} {SIZE}\n")
        done = run("zbuf", "config.txt", "--image", "out.ppm", "--coverage", "center", *options, stdin=stage3)
        self.assert_quiet_success(done)
        data = pathlib.Path("out.ppm").read_bytes()[-3 * SIZE * SIZE:]
        return [[tuple(data[3 * (SIZE * r + c):][:3]) for c in range(SIZE)] for r in range(SIZE)]

    def assert_image(self, corners, projection, model, *options, lit=True, clip="auto"):
        stage3 = pipe(["model"], ["view"], ["project", "--clip", clip],
                      stdin=scene_of(corners, projection, lit))
        self.assertEqual(b"clipped" in stage3, lit and (corners in (CUT, CUT_TWICE) or clip == "frustum"))
        image = self.image_of(stage3, *options)
        hit_count = 0
        for row in range(SIZE):
            for column in range(SIZE):
                expected = expected_pixel(row, column, corners, projection, model)
                got = image[row][column]
                hit_count += expected is not None
                if expected is None:
                    self.assertEqual(got, (10, 20, 30), (row, column))
                else:
                    wanted = [min(255, max(0, c)) for c in expected]
                    self.assertLessEqual(max(abs(a - b) for a, b in zip(got, wanted)), 0.51,
                                         (row, column, wanted))
        self.assertGreater(hit_count, 40)

    def test_phong_lights_every_pixel(self):
        for projection in (PERSPECTIVE, ORTHOGRAPHIC):
            self.assert_image(CORNERS, projection, "phong", "--shading", "phong")

    def test_gouraud_lights_the_vertices(self):
        for projection in (PERSPECTIVE, ORTHOGRAPHIC):
            self.assert_image(CORNERS, projection, "gouraud", "--shading", "gouraud")

    def test_flat_lights_the_triangle(self):
        for projection in (PERSPECTIVE, ORTHOGRAPHIC):
            self.assert_image(CORNERS, projection, "flat", "--shading", "flat")

    def test_none_shows_the_colors(self):
        for projection in (PERSPECTIVE, ORTHOGRAPHIC):
            self.assert_image(CORNERS, projection, "none", "--shading", "none")

    def test_without_lights_the_default_is_none(self):
        self.assert_image(CORNERS, PERSPECTIVE, "none", lit=False)

    def test_with_lights_and_normals_the_default_is_phong(self):
        self.assert_image(CORNERS, PERSPECTIVE, "phong")

    def test_what_is_cut_looks_like_the_whole(self):
        for corners in (CUT, CUT_TWICE):
            for clip in ("auto", "near", "frustum"):
                for model in MODELS:
                    with self.subTest(corners=corners, clip=clip, model=model):
                        self.assert_image(corners, PERSPECTIVE, model, "--shading", model, clip=clip)

    def test_what_is_cut_at_the_sides_looks_like_the_whole(self):
        for model in MODELS:
            self.assert_image(LARGE, ORTHOGRAPHIC, model, "--shading", model, clip="frustum")

    def test_what_is_cut_without_lights_interpolates_its_colors(self):
        self.assert_image(CUT_TWICE, PERSPECTIVE, "none", lit=False)

    def test_both_algorithms_give_the_same_image(self):
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene_of(CORNERS, PERSPECTIVE))
        self.assertEqual(self.image_of(stage3), self.image_of(stage3, "--algorithm", "scanline"))

    def test_a_white_surface_under_white_ambient_light_is_white(self):
        scene = (EYE_AT_5 + PERSPECTIVE + "\ncolor 255 255 255\nambient 1 1 1\nlight 0 0 5 0 0 0\n"
                 "triangle\n-90 -90 0\n90 -90 0\n0 90 0\nend\n")
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        for model in ("flat", "gouraud", "phong"):
            self.assertEqual(set(sum(self.image_of(stage3, "--shading", model), [])), {(255, 255, 255)})

    def test_lights_alone_light_the_triangles_own_colors_flatly(self):
        # Triangle 0's color is 41 35 190; the light is straight in front of it, at the eye.
        scene = (EYE_AT_5 + PERSPECTIVE + "\nlight 0 0 5 1 1 1\nattenuation 0 0.4 0\n"
                 "triangle\n-90 -90 0\n90 -90 0\n0 180 0\nend\n")
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        # d = 5, so half of the light arrives.
        self.assertEqual(set(sum(self.image_of(stage3), [])), {(21, 18, 95)})

    def test_a_light_behind_a_surface_gives_it_no_highlight(self):
        # As fixed-function OpenGL draws it. Without the condition n.l > 0, the triangle shines at 11 to 14 of
        # 255.
        scene = (
            "0 0 3\n0 0 0\n0 1 0\n60 1 1 10\nambient 0 0 0\nmaterial 0 1 1 2\nlight 1 0 -2 1 1 1\ncolor 0 0 "
            "0\nbackground 9 9 9\n"
            "triangle\n-1 -1 0\n1 -1 0\n0 1 0\nend\n")
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        for model in ("flat", "gouraud", "phong"):
            self.assertEqual(set(sum(self.image_of(stage3, "--shading", model), [])), {(0, 0, 0), (9, 9, 9)},
                             model)

    def test_gouraud_clamps_the_colors_of_vertices_before_it_interpolates_them(self):
        # Ambient light of 2 makes 510 of the red 255 at the upper edge, and leaves the 0 at the lower one. A
        # ramp of 24 rows begins with 255 * 47/48; under phong every row is clamped by itself.
        scene = (
            "0 0 5\n0 0 0\n0 1 0\northo -1 1 -1 1 1 9\nattributes color\nambient 2 2 2\nlight 0 0 5 0 0 0\n"
            "triangle\n-1 1 0 255 0 0\n-1 -1 0 0 0 0\n3 1 0 255 0 0\ntriangle\n-1 -1 0 0 0 0\n3 -1 0 0 0 0\n"
            "3 1 0 255 0 0\nend\n"
        )
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        weights = [(2 * (SIZE - row) - 1) / (2 * SIZE) for row in range(SIZE)]
        for model, reds in (("gouraud", [255 * w
                                         for w in weights]), ("phong", [min(255, 510 * w) for w in weights])):
            expected = [[(math.floor(red + 0.5), 0, 0)] * SIZE for red in reds]
            self.assertEqual(self.image_of(stage3, "--shading", model), expected, model)

    def test_a_background_alone_leaves_the_triangles_as_they_are(self):
        scene = EYE_AT_5 + PERSPECTIVE + "\nbackground 1 2.5 3\ntriangle\n-9 -9 0\n9 -9 0\n-9 9 0\nend\n"
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        self.assertEqual(set(sum(self.image_of(stage3), [])), {(41, 35, 190), (1, 3, 3)})

    def test_shading_needs_a_light(self):
        done = run("zbuf", "config.txt", "--shading", "flat", stdin="background 0 0 0\n")
        self.assert_fails(
            done, 1, "zbuf: <stdin>:2:1: expected a light for --shading (a header line light), found none")

    def test_lights_need_the_projection(self):
        done = run("zbuf", "config.txt", stdin="light 0 0 0 1 1 1\n")
        self.assert_fails(
            done, 1,
            "zbuf: <stdin>:2:1: expected a header line 'projected frustum L R B T N F' (or ortho) in a "
            "text with lights, found none: this text has not been through project")


def without_looks(stage3):
    """A lit text as an unlit one: no header, positions only."""
    lines, result = stage3.decode().splitlines(), []
    while lines:
        line = lines.pop(0)
        if line == "clipped":
            del lines[:3]
        elif not line or line.startswith("triangle") or line[0] in "-0123456789":
            result.append(line if line.startswith("triangle") else " ".join(line.split()[:3]))
    return "\n".join(result) + "\n"


class WholeScenes(ToolTest):
    """The lit samples, small, under every model: every pixel against the reference.

    The visible triangle comes from the unlit picture: the diagonal of a flat side may belong to either half.
    """

    COLUMNS, ROWS = 60, 45

    def pixels(self, stage3, *options):
        self.assert_quiet_success(run("zbuf", "config.txt", "--image", "out.ppm", *options, stdin=stage3))
        data = pathlib.Path("out.ppm").read_bytes()[-3 * self.COLUMNS * self.ROWS:]
        pixels = [tuple(data[i:i + 3]) for i in range(0, len(data), 3)]
        return [pixels[i:i + self.COLUMNS] for i in range(0, len(pixels), self.COLUMNS)]

    def test_every_pixel_is_what_the_reference_lights(self):
        pathlib.Path("config.txt").write_text(f"{self.COLUMNS} {self.ROWS}\n")
        config = reference.read_config(reference.Text(pathlib.Path("config.txt").read_bytes()))
        for name in ("inside", "orthographic", "colored-lights"):
            scene = (SOURCE / "samples" / name / "scene.txt").read_text()
            stage3 = pipe(["model", "--digits", "exact"], ["view", "--digits", "exact"], ["project"],
                          stdin=scene)
            text = reference.Stage(stage3, "zbuf")
            by_color = {
                tuple(reference.generated_color(triangle.number)): triangle
                for triangle in text.triangles()}
            for coverage in ("nearest", "center"):
                unlit = self.pixels(without_looks(stage3), "--coverage", coverage)
                seen = [[by_color.get(pixel) for pixel in row] for row in unlit]
                for model in ("flat", "gouraud", "phong"):
                    got = self.pixels(stage3, "--shading", model, "--coverage", coverage)
                    with decimal.localcontext(reference.SHADING):
                        expected = reference.shade(seen, text.header, config, model)
                    for pixel, color in zip(sum(got, []), sum(expected, [])):
                        self.assertTrue(leeway.is_shown(pixel, color), (name, coverage, model, pixel, color))


def ball(rings, sectors):
    """The triangles of a ball of radius 1 as vertex lines with normals."""
    def corner(i, k):
        u, v = math.pi * i / rings, math.tau * k / sectors
        p = (math.sin(u) * math.cos(v), math.cos(u), math.sin(u) * math.sin(v))
        return words(*("%.9f" % x for x in p + p))

    for i in range(rings):
        for k in range(sectors):
            a, b, c, d = corner(i, k), corner(i, k + 1), corner(i + 1, k + 1), corner(i + 1, k)
            yield f"triangle\n{a}\n{b}\n{c}\n"
            yield f"triangle\n{a}\n{c}\n{d}\n"


class WholePictures(ToolTest):
    SIZE = 200

    def image_of(self, scene, *options):
        """Rows of red, green, blue."""
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        pathlib.Path("config.txt").write_text(f"{self.SIZE} {self.SIZE}\n")
        self.assert_quiet_success(run("zbuf", "config.txt", "--image", "out.ppm", *options, stdin=stage3))
        data = pathlib.Path("out.ppm").read_bytes()[-3 * self.SIZE ** 2:]
        pixels = [tuple(data[i:i + 3]) for i in range(0, len(data), 3)]
        return [pixels[i:i + self.SIZE] for i in range(0, len(pixels), self.SIZE)]

    def largest_bend(self, image):
        """The largest second difference of brightness along rows and columns in the ball, of radius 45
        pixels, away from its rim."""
        bends = []
        for i in range(70, 130):
            for k in range(70, 130):
                if math.hypot(i - 99.5, k - 99.5) > 28:
                    continue
                here = 2 * image[i][k][0]
                bends += [abs(image[i][k - 1][0] + image[i][k + 1][0] - here),
                          abs(image[i - 1][k][0] + image[i + 1][k][0] - here)]
        return max(bends)

    def test_a_ball_under_phong_shows_no_edge(self):
        scene = (EYE_AT_5.replace("0 0 5", "0 0 4") + PERSPECTIVE + "\ncolor 255 255 255\nattributes normal\n"
                 "light 300 400 900 1 1 1\n" + "".join(ball(12, 24)) + "end\n")
        # The brightness of a true ball has a second difference of about 255 / 45^2 = 0.13; rounding three
        # values adds less than 2.
        self.assertLessEqual(self.largest_bend(self.image_of(scene, "--coverage", "center")), 2)
        # Pixels whose centers lie up to half a pixel beyond an edge show the color on the edge: they lack
        # half of a pixel's rise of 255 / 45, which a second difference counts twice.
        self.assertLessEqual(self.largest_bend(self.image_of(scene, "--coverage", "nearest")), 2 + 255 / 45)
        # Flat shading shows the edges.
        self.assertGreater(self.largest_bend(self.image_of(scene, "--shading", "flat")), 10)

    def test_a_flat_surface_under_a_distant_light_is_lit_alike_by_all_models(self):
        scene = (EYE_AT_5 + PERSPECTIVE + "\ncolor 255 128 64\nattributes normal\nmaterial 1 0.9 0 1\n"
                 "ambient 0.1 0.1 0.1\nlight 3e7 4e7 5e7 0.9 0.8 0.7\ntriangle\n"
                 "-2 -2 0 -0.6 0 0.8\n2 -2 3 -0.6 0 0.8\n-2 2 0 -0.6 0 0.8\nend\n")
        images = [sum(self.image_of(scene, "--shading", model), []) for model in ("flat", "gouraud", "phong")]
        # Not black, but one color: 255 * (0.1 + 0.9 * 0.9 * (-1.8 + 4) / sqrt(50)) and so on.
        share = 0.9 * (-0.6 * 3 + 0.8 * 5) / math.sqrt(50)
        expected = [c * (0.1 + share * i) for c, i in zip((255, 128, 64), (0.9, 0.8, 0.7))]
        for pixels in zip(*images):
            self.assertTrue(pixels[0] == pixels[1] == pixels[2] == (0, 0, 0) or
                            all(abs(c - e) <= 1 for pixel in pixels for c, e in zip(pixel, expected)), pixels)
        self.assertGreater(len([pixel for pixel in images[0] if pixel != (0, 0, 0)]), 2000)

    def test_a_mirrored_scene_gives_the_mirrored_image(self):
        scene = (EYE_AT_5.replace("0 0 5", "0 0 4") + PERSPECTIVE +
                 "\nattributes color normal\nmaterial 1 0.7 0.4 20\n"
                 "MIRROR\nlight 2 3 4 1 0.8 0.6\nlight -4 -1 1 0.3 0.3 0.5\nrotate 33 1 2 3\n" +
                 "".join(line + "\n" if len(line.split()) < 6 else words(*line.split()[:3], *color,
                                                                         *line.split()[3:]) + "\n"
                         for triangle in ball(5, 7)
                         for line, color in zip(triangle.splitlines(), ("", (255, 0, 9), (20, 255, 3),
                                                                        (90, 40, 255)))) + "end\n")
        for model in MODELS:
            options = ("--shading", model, "--coverage", "center")
            image = self.image_of(scene.replace("MIRROR\n", ""), *options)
            for axis, turned in (("-1 1 1", [row[::-1] for row in image]), ("1 -1 1", image[::-1])):
                mirrored = self.image_of(scene.replace("MIRROR", "scale " + axis), *options)
                for a, b in zip(sum(turned, []), sum(mirrored, [])):
                    self.assertLessEqual(max(abs(p - q) for p, q in zip(a, b)), 1, (model, axis))


if __name__ == "__main__":
    unittest.main()
