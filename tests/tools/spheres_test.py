#!/usr/bin/env python3
"""Spheres, from the scene to the picture of trace: as text, as facets, and by what must not change them.

usage: spheres_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import unittest

from toolbox import CAMERA, TRIANGLE, ToolTest, pipe, run

REFUSED = ("expected triangles alone, found a sphere: trace draws it, and model --facets N makes "
           "triangles of it\n")
LIGHT = "light 3 5 6 1 1 1\nambient 0.2 0.2 0.2\nmaterial 1 0.8 0.4 20\n"
SPHERE = "sphere\n0.1 -0.2 0.3 1.25\n"
CONFIG = "200 200\n"


def scene(*commands, camera=CAMERA):
    return camera + "".join(commands) + "end\n"


def traced(text, *options, config=CONFIG, model_options=(), view_options=()):
    """(depth text, image) of a scene."""
    pathlib.Path("trace_config.txt").write_text(config)
    z = pipe(["model", *model_options], ["view", *view_options],
             ["trace", "trace_config.txt", "--image", "traced.ppm", *options], stdin=text)
    return z, pathlib.Path("traced.ppm").read_bytes()


def depths(z):
    return [[float(word) for word in line.split("\t")[:-1]] for line in z.decode().split("\n")[:-1]]


class Text(ToolTest):
    def test_four_points_and_the_columns_but_the_normal(self):
        done = pipe(
            ["model"],
            stdin=scene("color 1 2 3\nattributes normal\ntranslate 1 0 0\nscale 1 2 3\nsphere 0 1 0 2\n"))
        self.assertEqual(
            done.decode().split("\n", 5)[5], "".join(
                f"{p} 1.0000000 2.0000000 3.0000000\n"
                for p in ("1.0000000 2.0000000 0.0000000", "3.0000000 2.0000000 0.0000000",
                          "1.0000000 6.0000000 0.0000000", "1.0000000 2.0000000 6.0000000")).join([
                              "sphere\n", "\n"]))

    def test_the_points_take_the_way_of_vertices(self):
        """As the corners of triangles, they get the same digits in all stages."""
        words = "rotate 33 1 2 3\ntranslate 0.1 0.2 0.3\nscale 1.5 0.7 -2\n"
        points = ("0.1 0.2 0.3", "1.35 0.2 0.3", "0.1 1.45 0.3", "0.1 0.2 1.55")
        triangles = "".join("triangle\n" + f"{p}\n" * 3 for p in points)
        camera = "3 1 4\n0 0 0\n0.1 1 0\n60 1 1 100\n"
        for options in ([], ["--digits", "exact"], ["--digits", "15"]):
            as_sphere, as_triangles = (pipe(["model", *options], ["view", *options], stdin=scene(
                words, part, camera=camera)).decode() for part in ("sphere\n0.1 0.2 0.3 1.25\n", triangles))
            lines = [line for line in as_triangles.split("\n") if line and not line.startswith("perspective")]
            self.assertEqual([line for line in as_sphere.split("\n") if line and line[0] in "-0123456789"],
                             lines[::3])

    def test_each_of_the_four_points_is_noted_once(self):
        done = run(
            "model", stdin=scene("rotate 33 1 2 3\ntranslate 1e33 0 0\nrotate 33 1 2 3\n"
                                 "translate -1e33 1e20 0\nsphere 0.1 0.2 0.3 1\n"))
        self.assertIn(b"the digits of this vertex and of 3 more are not certain", done.stderr)

    def test_counts_as_one_object(self):
        """Its number and its three draws of color are its own, drawn or not."""
        text = scene(SPHERE, TRIANGLE, camera="0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n")
        self.assertNotIn(b"triangle", pipe(["model"], stdin=text))
        faceted = pipe(["model", "--facets", "2"], stdin=text).decode()
        self.assertEqual(faceted.count("triangle 0\n"), 7)
        self.assertEqual(faceted.count("triangle"), 7)
        # The triangle has the color of the second object on both roads, and so it has after another triangle.
        _, first = traced(scene(SPHERE, "translate 0 0 3\n", TRIANGLE))
        _, second = traced(scene("triangle\n9 9 0\n9 8 0\n8 9 0\n", "translate 0 0 3\n", TRIANGLE))
        center = len(b"P6\n200 200\n255\n") + 3 * (200 * 60 + 130)
        self.assertEqual(first[center:center + 3], second[center:center + 3])
        self.assertNotEqual(second[center:center + 3], bytes(3))

    def test_statistics_count_objects(self):
        run("model", "--stats", "stats.txt", stdin=scene(SPHERE, TRIANGLE, SPHERE))
        self.assertIn("triangles 3\n", pathlib.Path("stats.txt").read_text())

    def test_extents_are_those_of_the_surface(self):
        def ranges(tool, text):
            lines = dict(
                line.split()
                for line in run(tool, "--stats", "/dev/stderr", stdin=text).stderr.decode().splitlines())
            return [tuple(float(lines[f"{axis}_{end}"]) for end in ("min", "max")) for axis in "xyz"]

        self.assertEqual(ranges("model", scene("sphere 1 2 3 0.5\n")), [(0.5, 1.5), (1.5, 2.5), (2.5, 3.5)])
        turned = scene("rotate 45 0 0 1\nscale 3 1 1\nsphere 0 0 0 1\n")
        reach = math.sqrt((9 + 1) / 2)  # of an ellipse turned by 45 degrees, in x and y
        for (low, high), expected in zip(ranges("model", turned), (reach, reach, 1)):
            self.assertAlmostEqual(low, -expected, places=6)
            self.assertAlmostEqual(high, expected, places=6)
        with_triangle = scene("sphere 0 0 0 1\ntriangle\n5 0 0\n6 0 0\n5 -7 0\n",
                              camera="0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n")
        self.assertEqual(ranges("view", pipe(["model"], stdin=with_triangle)), [(-1, 6), (-7, 1), (-6, -4)])


class Refusals(ToolTest):
    def expect(self, done, message):
        self.assertEqual((done.returncode, done.stderr.decode()), (1, message))

    def test_stages_of_triangles_name_both_ways(self):
        text = scene(TRIANGLE, SPHERE)
        pathlib.Path("scene.txt").write_text(text)
        pathlib.Path("stage1.txt").write_bytes(pipe(["model"], stdin=text))
        pathlib.Path("stage2.txt").write_bytes(pipe(["view"], stdin=pathlib.Path("stage1.txt").read_bytes()))
        self.expect(run("model", "--bare", "scene.txt"), "model: scene.txt:9:1: " + REFUSED)
        self.expect(run("view", "--bare", "stage1.txt"), "view: stage1.txt:9:1: " + REFUSED)
        self.expect(run("project", "stage2.txt"), "project: stage2.txt:6:1: " + REFUSED)
        pathlib.Path("bare.txt").write_text("sphere\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        pathlib.Path("config.txt").write_text(CONFIG)
        self.expect(run("zbuf", "config.txt", "bare.txt"), "zbuf: bare.txt:1:1: " + REFUSED)

    def test_a_flattened_sphere_has_no_volume(self):
        pathlib.Path("scene.txt").write_text(scene("rotate 30 1 1 1\nscale 1 0 1\n", SPHERE))
        flat = "expected transforms that leave a sphere its volume, found a scale by 0\n"
        self.expect(run("model", "scene.txt"), "model: scene.txt:7:1: " + flat)
        self.expect(run("model", "--facets", "4", "scene.txt"), "model: scene.txt:7:1: " + flat)
        pathlib.Path("stage2.txt").write_text(
            "perspective 60 1 1 100\n\nsphere\n0 0 -5\n1 0 -5\n0 1 -5\n1 1 -5\n")
        pathlib.Path("config.txt").write_text(CONFIG)
        self.expect(run("trace", "config.txt", "stage2.txt"),
                    "trace: stage2.txt:4:1: expected a sphere with a volume, found four points in a plane\n")

    def test_a_radius_is_above_0_and_not_lost(self):
        for words in ("0 0 0 0", "0 0 0 -1", "1e20 0 0 1", "0 0 1e308 1.7e308"):
            done = run("model", stdin=scene(f"sphere {words}\n"))
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.decode(),
                             r"<stdin>:5:\d+: expected a radius above 0 that changes the coordinates")
        for words in ("0 0 0", "0 0 0 1 2", "x 0 0 1"):
            self.assertEqual(run("model", stdin=scene(f"sphere {words}\n")).returncode, 1)

    def test_vertex_colors_do_not_color_it(self):
        done = run("model", stdin=scene("attributes color\nsphere 0 0 0 1\n"))
        self.assertIn("expected 'color' before a sphere", done.stderr.decode())
        self.assertEqual(
            run("model", stdin=scene("attributes color\ncolor 1 2 3\nsphere 0 0 0 1\n")).returncode, 0)

    def test_facets_are_2_to_10000_belts(self):
        for count in ("1", "0", "10001", "x", "-4", "2.5"):
            self.assertEqual(run("model", "--facets", count, stdin=scene(SPHERE)).returncode, 2)


class Facets(ToolTest):
    def test_triangles_before_an_error_have_normals(self):
        cut = "triangle\n0 0 0\n1 0 0\n0 1 0\n" * 2 + "triangle\n0 0 0\n"
        done = run("model", "--facets", "2", stdin=scene(cut))
        message = "<stdin>:15:1: expected the x of vertex 2 of 3, found 'end'\n"
        corners = "".join(
            f"{x} 0.0000000 0.0000000 0.0000000 1.0000000\n"
            for x in ("0.0000000 0.0000000", "1.0000000 0.0000000", "0.0000000 1.0000000")) + "\n"
        self.assertEqual((done.returncode, done.stderr.decode()), (1, f"model: {message}"))
        self.assertTrue(done.stdout.decode().endswith(2 * corners + f"error model: {message}"), done.stdout)

    def test_normals_of_edges_and_scales_of_any_size(self):
        for corners, normal, *scales in (
            ("0 0 0\n1e155 0 0\n0 1e155 0", "0 0 1"),
            ("0 0 0\n0 1e-200 0\n0 0 1e-200", "1 0 0"),
            ("0 0 0\n1e-200 0 0\n0 0 1e200", "0 -1 0"),
            ("-1.5e308 0 0\n1.5e308 0 0\n-1.5e308 3e307 4e307", "0 -0.8 0.6"),
            ("1e155 -3 1\n0 1e155 0.5\n-1 1e155 1", "0.4082483 0.4082483 0.8164966"),
            ("1e200 0 0\n1e200 0 0\n0 1e200 0", "0 0 0"),
            ("0 0 0\n1e200 1e200 0\n1e200 1e200 1e-200", "0.7071068 -0.7071068 0"),
                # 2^27 + 1 times 2^27 + 3 is one less than the square of 2^27 + 2, which doubles do not show.
            ("0 0 0\n134217729 134217730 0\n134217730 134217731 0", "0 0 -1"),
            ("0 0 0\n0 0 1\n1 0 0", "0 1 0", "scale 1e-200 1e200 1\n"),
            ("0 0 0\n1 0 0\n0 1e-3 1", "0 -0.6 0.8", "scale 5e-324 1e3 0.75\n"),
            ("0 0 0\n1 0 0\n0 1 0", "0 -0.6 -0.8",
             "rotate 143.13010235415598 1 0 0\nscale -1e155 1 1e-160\n"),
        ):
            text = pipe(["model", "--facets", "2"], stdin=scene(*scales, f"triangle\n{corners}\n")).decode()
            normals = [line.split()[3:] for line in text.splitlines()[-4:-1]]
            self.assertEqual(normals, 3 * [[f"{float(x):.7f}" for x in normal.split()]], corners)
        for body in (SPHERE, TRIANGLE):
            done = run("model", "--facets", "4", stdin=scene(
                "rotate 30 1 2 3\nscale 1 1e200 1e-200\nrotate 9 3 2 1\n", body))
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (1, "model: <stdin>:9:1: expected scales that leave a normal its digits, "
                              "found some that differ by more than 31 digits\n"))

    def test_come_in_batches_and_with_normals_for_all(self):
        text = pipe(["model", "--facets", "64"], stdin=scene("rotate 10 1 0 0\n", SPHERE, TRIANGLE,
                                                             "scale 1 -1 2\n", SPHERE, TRIANGLE))
        body = text.decode().split("\n", 5)
        self.assertEqual(body[4], "attributes normal")
        vertices = [
            list(map(float, line.split())) for line in body[5].split("\n")
            if line and line[0] in "-0123456789"]
        self.assertEqual(len(vertices), 3 * (2 * 4 * 64 * 63 + 2))
        for vertex in vertices:
            self.assertEqual(len(vertex), 6)
            self.assertAlmostEqual(math.hypot(*vertex[3:]), 1, delta=1e-6)

    def test_have_their_front_outside_even_if_mirrored(self):
        for words in ("", "scale -1 1 1\n", "scale 2 -1 -1\n", "scale -1 -1 -1\n"):
            projected = pipe(["model", "--facets", "20"], ["view"], ["project", "--cull", "back"],
                             stdin=scene(words, SPHERE))
            pathlib.Path("config.txt").write_text("50 50\n")
            closed = pipe(["model", "--facets", "20"], ["view"], ["project"], stdin=scene(words, SPHERE))
            pictures = [
                pipe(["zbuf", "--coverage", "center", "config.txt"], stdin=text)
                for text in (projected, closed)]
            self.assertEqual(*pictures)

    def test_converge_to_the_sphere(self):
        """The mean error of depths falls by 4 where facets are halved: a slope of -2 on a logarithmic
        scale."""
        wall = "triangle\n-200 -200 -50\n200 -200 -50\n0 300 -50\n"  # so that rows of depths have all columns
        text = scene(wall, "scale 1.5 0.8 1\nrotate 40 1 2 3\n", SPHERE)
        exact = depths(traced(text)[0])
        errors = []
        counts = (8, 16, 32, 64, 128)
        for count in counts:
            found = depths(traced(text, model_options=["--facets", str(count)])[0])
            both = [(a, b) for row, other in zip(exact, found) for a, b in zip(row, other, strict=True)
                    if max(a, b) < 0.9]
            self.assertGreater(len(both), 4000)
            errors.append(sum(abs(a - b) for a, b in both) / len(both))
        slope = math.log(errors[-1] / errors[0]) / math.log(counts[-1] / counts[0])
        self.assertAlmostEqual(slope, -2, delta=0.1, msg=str(errors))


class Symmetry(ToolTest):
    """A change that leaves a sphere as it is leaves its picture, byte by byte."""
    def test_quarter_turns(self):
        text = LIGHT + "color 200 150 100\n{}sphere\n0 0 0 1.5\n"
        expected = traced(scene(text.format("")))
        for axis in ("1 0 0", "0 1 0", "0 0 1"):
            for angle in (90, 180, -90, 450):
                self.assertEqual(traced(scene(text.format(f"rotate {angle} {axis}\n"))), expected)
        self.assertEqual(traced(scene(text.format("scale -1 1 -1\n"))), expected)

    def test_powers_of_two(self):
        """The whole scene in other units; 3 / 2^20 has more than 7 decimals."""
        exact = ["--digits", "exact"]

        def unit(k):
            s = 2.0**k
            camera = f"0 {0.25 * s!r} {5 * s!r}\n0 0 0\n0 1 0\n60 1 {s!r} {100 * s!r}\n"
            return traced(
                scene(
                    f"light {3 * s!r} {5 * s!r} {6 * s!r} 1 1 1\ncolor 200 150 100\n",
                    f"sphere\n{0.125 * s!r} {-0.25 * s!r} 0 {1.25 * s!r}\nscale 1 0.5 1\nrotate 30 0 0 1\n",
                    f"sphere\n{s!r} {1.5 * s!r} 0 {0.5 * s!r}\n", camera=camera), model_options=exact,
                view_options=exact)

        expected = unit(0)
        for k in (-20, -3, 4, 30):
            self.assertEqual(unit(k), expected, k)

    def test_shading_models_are_alike(self):
        """Without facets, flat and gouraud light every point, too."""
        text = scene(LIGHT, "color 200 150 100\n", SPHERE)
        expected = traced(text, "--shading", "phong")
        self.assertEqual(traced(text, "--shading", "flat"), expected)
        self.assertEqual(traced(text, "--shading", "gouraud"), expected)


class Limits(ToolTest):
    """Rays see the first side that is between the depth limits."""
    def test_the_front_limit_cuts_it_open(self):
        camera = "0 0 0\n0 0 -1\n0 1 0\northo -2 2 -2 2 0 10\n"
        text = scene("sphere\n0 0 -5 1\n", camera=camera)
        whole = depths(traced(text, config="40 40\n")[0])
        opened = depths(traced(text, config="40 40\n-1\n-1\n0 1\n")[0])
        self.assertAlmostEqual(min(min(row) for row in whole if row), -0.2, delta=0.01)
        self.assertAlmostEqual(max(max(row) for row in opened if row), 0.2, delta=0.01)
        for row, other in zip(whole, opened):
            self.assertEqual([round(-z, 6) for z in row], other)

    def test_of_sides_at_one_depth_that_of_the_earlier_sphere_is_seen(self):
        camera = "0 0 0\n0 0 -1\n0 1 0\northo -2 2 -2 2 0.5 9\n"
        text = scene("sphere\n0 0 -2 1\n", "sphere\n0 0 -4 1\n", camera=camera)
        image = traced(text, config="3 3\n-1\n-1\n-0.5 1\n")[1]
        self.assertEqual(image[-15:-12], bytes((41, 35, 190)))  # the middle of 3 x 3 pixels

    def test_the_eye_may_be_within(self):
        camera = "0 0 0\n0 0 -1\n0 1 0\n60 1 1 100\n"
        z = depths(traced(scene("sphere\n0 0 0 10\n", camera=camera))[0])
        self.assertEqual({len(row) for row in z}, {200})
        near, far, corner = 1.0, 100.0, 0.995 * math.tan(math.radians(30))
        w = 10 / math.sqrt(1 + 2 * corner * corner)
        self.assertAlmostEqual(z[0][0], (far + near) / (far - near) - 2 * far * near / (far - near) / w,
                               delta=1e-6)

    def test_what_is_behind_the_eye_is_not_seen(self):
        z, _ = traced(scene("sphere\n0 0 10 1\n"))
        self.assertEqual(z.strip(), b"")


class EmptyPictures(ToolTest):
    """One note tells where the spheres are, or why they look like the background."""
    EMPTY = "trace: note: the picture is empty: "
    CAMERA = "0 0 5\n0 0 0\n0 1 0\n90 1 1 100\n"  # the window is as wide as the distance, to either side

    def noted(self, *commands, camera=CAMERA, config="40 40\n", options=()):
        view = pipe(["model"], ["view"], stdin=scene(*commands, camera=camera))
        pathlib.Path("trace_config.txt").write_text(config)
        done = run("trace", "trace_config.txt", "--image", "traced.ppm", *options, stdin=view)
        self.assertEqual(done.returncode, 0)
        if done.stderr:
            self.assertEqual(
                len(set(pathlib.Path("traced.ppm").read_bytes().split(b"\n", 3)[3]) - {0, 1, 200}), 0)
        return done.stderr.decode()

    def expect(self, note, *commands, **settings):
        self.assertEqual(self.noted(*commands, **settings), note and note + "\n")

    def test_spheres_outside_are_told_where(self):
        for words, place in (("12 0 0 1", "right of"), ("-12 0 0 1", "left of"), ("0 12 0 1", "above"),
                             ("0 -12 0 1", "below")):
            self.expect(self.EMPTY + f"the sphere is {place} the window", f"sphere {words}\n")
            self.expect(self.EMPTY + f"the sphere is {place} the window", f"sphere {words}\n",
                        camera=self.CAMERA.replace("90 1 1 100", "ortho -10 10 -10 10 1 100"))
        self.expect(
            self.EMPTY +
            "the sphere is behind the eye (z from 2 to 4 in view space; the camera looks down -z: turn it "
            "around, or move it back by more "
            "than 4)", "sphere 0 0 8 1\n")
        self.expect(
            self.EMPTY +
            "the sphere is beyond the rear limit (z from -106 to -104 in view space, the limit is -100, the "
            "camera's far)", "sphere 0 0 -100 1\n")
        self.expect(
            self.EMPTY +
            "the sphere is before the front limit (z from -0.75 to -0.25 in view space, the limit is -1, the "
            "camera's near)", "sphere 0 0 4.5 0.25\n")
        # z = 101 / 99 - 200 / (99 w) in NDC is 0 where w = 200 / 101.
        self.expect(
            self.EMPTY +
            "the sphere is beyond the rear limit (z from -6 to -4 in view space, the limit of the config "
            "is -1.98)", "sphere 0 0 0 1\n", config="40 40\n-1\n-1\n-1 0\n")
        self.expect(self.EMPTY + "the sphere is met by no ray between the limits of Z",
                    "sphere 0.001 0.001 0 0.0001\n")

    def test_a_sphere_that_is_stretched_is_where_its_surface_is(self):
        """Of the ellipsoid with the half axes 3 and 1 along x = y and across, the plane x = 5 in front of a
        parallel camera touches the one at 5 - sqrt((9 + 1) / 2)."""
        camera, words = self.CAMERA.replace(
            "90 1 1 100", "ortho -10 5 -10 10 1 100"), "rotate 45 0 0 1\nscale 3 1 1\nsphere 0 0 0 1\n"
        window = "150 200\n-1\n-1\n-1 1\n"  # 0.1 a pixel
        reach = math.sqrt(5)
        self.expect("", f"translate {5 + reach - 0.2} 0 0\n" + words, camera=camera, config=window, options=[
            "--no-shadows"])
        self.expect(self.EMPTY + "the sphere is right of the window",
                    f"translate {5 + reach + 0.001} 0 0\n" + words, camera=camera, config=window)

    def test_several_reasons_and_triangles(self):
        self.expect(
            self.EMPTY +
            "none of 3 spheres shows: 1 behind the eye (z from 4 to 6 in view space; the camera looks down "
            "-z: turn it around, or move it back by "
            "more than 6), 2 left of the window", "sphere 0 0 10 1\n", "sphere -12 0 0 1\n",
            "sphere -13 0 0 1\n")
        self.expect(
            self.EMPTY +
            "the sphere is left of the window; the triangle is right of the window (x from 2 to 2.2, the "
            "window from -1 to 1)", "sphere -12 0 0 1\n", "triangle\n10 0 0\n11 0 0\n10 1 0\n")
        self.expect("", "sphere -12 0 0 1\n", TRIANGLE)
        self.expect("", "triangle\n10 0 0\n11 0 0\n10 1 0\n", SPHERE)

    def test_seen_but_as_black_as_the_background(self):
        black = "trace: note: the picture is black: "
        unlit = (black +
                 "no light reaches the side that is seen (put a light on the eye's side; ambient 0.2 0.2 0.2 "
                 "would show it from anywhere)")
        shadow = (
            black +
            "all that is seen is in shadow (--no-shadows lights it; ambient 0.2 0.2 0.2 would show it, too)")
        self.expect(black + "its colors are 0", "color 0 0 0\n", SPHERE)
        self.expect(black + "its colors lie between 0 and 1, but channels run from 0 to 255",
                    "color 1 0.5 0\n", SPHERE)
        self.expect(unlit, "light 0 0 -9 1 1 1\n", SPHERE)
        self.expect("", "light 0 0 -9 1 1 1\nambient 0.2 0.2 0.2\n", SPHERE)
        in_shadow = ("light 0 0 9 1 1 1\n", "sphere 0 0 0 1\n", "sphere 0 0 9 0.5\n")
        self.expect(shadow, *in_shadow)
        self.expect("", *in_shadow, options=["--no-shadows"])
        self.expect("", "ambient 0.2 0.2 0.2\n", *in_shadow)
        # The same of triangles alone.
        wall, lid = "triangle\n-9 -9 -4\n9 -9 -4\n0 9 -4\n", "triangle\n-30 -30 7\n30 -30 7\n0 30 7\n"
        self.expect(shadow, "light 0 0 9 1 1 1\n", wall, lid)
        self.expect("", "light 0 0 9 1 1 1\n", wall)
        self.expect(
            black + "the light on the side that is seen is too weak (its intensity is 0.003; 1 is full)",
            "light 0 0 9 0.003 0.003 0.003\n", SPHERE)
        self.expect(
            black + "the material reflects no light but the ambient (of 'material KA KD KS N', KD and KS are "
            "0)", "light 0 0 9 1 1 1\nmaterial 1 0 0 1\n", SPHERE)
        mirror = "material 1 1 0 1 1 1 1\n"
        self.expect(black + "mirrors and glass alone are seen, and they show a black background", mirror,
                    SPHERE)
        self.expect(black + "rays that may bring light are cut (--max-depth, --min-contribution)", mirror,
                    SPHERE, options=["--max-depth", "0"])
        self.expect("", mirror, "background 9 0 0\n", SPHERE, options=["--max-depth", "0"])
        self.expect("trace: note: the picture is empty: what is seen has the color of the background",
                    "background 200 200 200\nmaterial 1 1 0 1 0 1.5 0\n", SPHERE, options=[
                        "--min-contribution", "1e-6"])


if __name__ == "__main__":
    unittest.main()
