#!/usr/bin/env python3
"""zbuf's colors and lights, against rays cast through the pixels.

A ray intersects the triangle in view space; color, normal and position there are weighted means of the
corners', and the lighting formula is evaluated there. So nothing is projected, and nothing is interpolated on
the screen.

usage: shading_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import unittest

from toolbox import ToolTest, pipe, run
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

    def test_each_model_lights_where_it_says(self):
        for projection in (PERSPECTIVE, ORTHOGRAPHIC):
            for model in MODELS:
                with self.subTest(projection=projection, model=model):
                    self.assert_image(CORNERS, projection, model, "--shading", model)

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


if __name__ == "__main__":
    unittest.main()
