#!/usr/bin/env python3
"""trace --no-shadows writes what project --digits exact | zbuf --coverage center write: the rasterizer and
the ray tracer judge each other.

usage: trace_test.py BIN_DIR [UNITTEST ARGUMENT...]
TRACE_SCENES is the number of random scenes (default 60).
"""
import math
import os
import pathlib
import random
import subprocess
import unittest

import random_scenes
from toolbox import CAMERA, SOURCE, ToolTest, command, pipe, pseudo_terminal, run

SCENE_COUNT = int(os.environ.get("TRACE_SCENES", "60"))


def triangles_text(triangles):
    return "".join("".join("%s %s %s\n" % vertex for vertex in triangle) + "\n" for triangle in triangles)


def quads(points):
    """Two triangles for each cell of a grid of points."""
    for upper, lower in zip(points, points[1:]):
        for a, b, c, d in zip(upper, upper[1:], lower, lower[1:]):
            yield a, c, d
            yield a, d, b


class Referee(ToolTest):
    def check(self, view_text, config, *options, projection=()):
        """Both ways give the same depths, picture and notes on an empty picture."""
        pathlib.Path("config.txt").write_text(config)
        ndc = run("project", "--digits", "exact", *projection, stdin=view_text)
        raster = run("zbuf", "config.txt", "--coverage", "center", "-o", "raster.ppm", *options,
                     stdin=ndc.stdout)
        traced = run("trace", "config.txt", "--no-shadows", "--no-recursion", *projection, "-o", "traced.ppm",
                     *options, stdin=view_text)
        self.assertEqual((ndc.returncode, raster.returncode), (traced.returncode,) * 2,
                         traced.stderr.decode())
        if traced.returncode != 0:
            return
        if traced.stdout != raster.stdout or pathlib.Path("raster.ppm").read_bytes() != pathlib.Path(
                "traced.ppm").read_bytes():
            self.fail(f"trace {config!r} {options} {projection} differs from project | zbuf on\n" +
                      (view_text if isinstance(view_text, str) else view_text.decode())[:4000])

    def check_window(self, triangles, config, projection="ortho -1 1 -1 1 1 3", *options):
        self.check(projection + "\n" + triangles_text(triangles), config, *options)

    def test_agrees_on_the_samples(self):
        for folder in sorted(path.parent for path in (SOURCE / "samples").glob("*/scene.txt")):
            for digits in ((), ("--digits", "exact")):
                with self.subTest(folder.name, digits=digits):
                    view = pipe(["model", *digits], ["view", *digits],
                                stdin=(folder / "scene.txt").read_bytes())
                    config = (folder / "config.txt").read_text()
                    self.check(view, config)
                    self.check(view, config, "--samples", "2")

    def test_agrees_on_random_scenes(self):
        for seed in range(SCENE_COUNT):
            rng = random.Random(seed)
            scene = random_scenes.scene(rng)
            config = random_scenes.config(rng, scene)
            digits = rng.choice(([], ["--digits", "exact"], ["--digits", "3"]))
            options = rng.choice(([], [], ["--samples", str(rng.randint(2, 5))]))
            if "\nlight" in scene:
                options = options + random_scenes.shading(rng)
            projection = rng.choice(([], [], ["--aspect", "ratio"]))
            model = run("model", *digits, stdin=scene)
            view = run("view", *digits, stdin=model.stdout)
            with self.subTest(seed=seed):
                self.check(view.stdout, config, *options, projection=projection)

    def test_agrees_where_every_center_is_on_an_edge(self):
        """Corners of the cells are centers of 20 x 20 pixels, in front of a parallel and of a pinhole
        camera."""
        places = [(2 * i + 1 - 20) / 20 for i in range(-1, 21)]
        for scale, projection in ((1, "ortho -1 1 -1 1 1 3"), (2, "frustum -1 1 -1 1 1 8"),
                                  (1.3, "frustum -0.5 0.75 -1 1 1 8")):
            for depth in ("-2", None):
                points = [[("%.7g" % (scale * x), "%.7g" % (scale * y), depth
                            or "%.7g" % (-2 - 0.01 * (i % 3) - 0.02 * (k % 2))) for i, x in enumerate(places)]
                          for k, y in enumerate(places)]
                with self.subTest(projection=projection, depth=depth):
                    self.check_window(quads(points), "20 20\n", projection)
                    self.check_window(quads(points), "20 20\n", projection, "--samples", "3")

    def test_agrees_on_twin_layers(self):
        """The second layer is behind the first, in front of it, or in the same place."""
        for gap in ("1e-5", "1e-7", "1e-10", "1e-15", "0", "-1e-7", "-1e-15"):
            z = [-5, -5 - float(gap)]
            layers = [((-2, -2, d), (2, -2, d), (2, 2, d)) for d in z] + [
                ((-2, -2, d), (2, 2, d), (-2, 2, d)) for d in z]
            tilted = [tuple((repr(x), repr(y), repr(d + 0.3 * x + 0.1 * y)) for x, y, d in t) for t in layers]
            with self.subTest(gap=gap):
                for config in ("30 30\n", "30 30\n-0.7\n-0.6\n0 1\n"):
                    self.check_window(layers, config, "perspective 40 1 1 100")
                    self.check_window(tilted, config, "perspective 40 1 1 100")

    def test_agrees_on_cut_triangles(self):
        """Triangles that reach behind the eye, lit or not."""
        rng = random.Random(2)
        for header in ("", "attributes color normal\nlight 1 2 -1 1 1 1\nambient 0.2 0.2 0.2\n",
                       "attributes color\n"):
            for _ in range(6):
                triangles = []
                for _ in range(12):
                    corners = [[
                        "%.3g" % rng.uniform(-4, 4),
                        "%.3g" % rng.uniform(-4, 4),
                        "%.3g" % rng.uniform(-9, 3)] for _ in range(3)]
                    for corner in corners:
                        corner += ["%d" % rng.randint(0, 255) for _ in range(3)] * ("color" in header)
                        corner += rng.choice((["0", "0", "1"], ["0.6", "0.8", "0"])) * ("normal" in header)
                    triangles.append("\n".join(map(" ".join, corners)) + "\n\n")
                text = "perspective 70 1 0.5 50\n" + header + "".join(triangles)
                options = ["--shading", rng.choice(("flat", "gouraud", "phong"))] * ("light" in header)
                self.check(text, "40 30\n", *options)
                self.check(text, "20 20\n-0.5\n-0.8\n-0.5 0.9\n", "--samples", "2", *options)

    def test_agrees_at_the_ends_of_doubles(self):
        for scale in (1e-150, 1e-30, 1e30, 1e150):
            points = [[(repr(x * scale), repr(y * scale), repr((-2 - 0.1 * x * y) * scale))
                       for x in range(-3, 4)] for y in range(-3, 4)]
            with self.subTest(scale=scale):
                self.check_window(
                    quads(points), "21 21\n",
                    "frustum %r %r %r %r %r %r" % tuple(scale * n for n in (-1, 1, -1, 1, 1, 9)))
                self.check_window(quads(points), "21 21\n",
                                  "ortho %r %r %r %r %r %r" % tuple(scale * n for n in (-1, 1, -1, 1, 1, 9)))


class Threads(ToolTest):
    def test_change_no_byte(self):
        view = pipe(["model"], ["view"], stdin=(SOURCE / "samples/shaded-torus/scene.txt").read_bytes())
        for options in (["--samples", "2"], ["--sampling", "jittered"], [
                "--sampling", "adaptive", "--threshold", "40"]):
            outputs = set()
            for count in ("0", "1", "2", "5"):
                done = run("trace", "--size", "90x70", "--threads", count, "-o", "out.ppm", *options,
                           stdin=view)
                self.assert_quiet_success(done)
                outputs.add(done.stdout + pathlib.Path("out.ppm").read_bytes())
            self.assertEqual(len(outputs), 1, options)


def pixels_of(path):
    """The channels of a .ppm image."""
    return pathlib.Path(path).read_bytes().split(b"\n", 3)[3]


class Samples(ToolTest):
    """Where the rays of a pixel go."""

    SIZE = 32

    def setUp(self):
        super().setUp()
        # A fan of thin triangles: an edge in nearly every pixel.
        rim = [(1.3 * math.cos(0.16 * i + 0.05), 1.3 * math.sin(0.16 * i + 0.05)) for i in range(40)]
        corners = [((0.11, 0.07), rim[i], rim[i + 1]) for i in range(0, 39, 2)]
        self.view = "ortho -1 1 -1 1 1 3\n" + triangles_text([
            tuple((repr(x), repr(y), "-2") for x, y in t) for t in corners])

    def traced(self, *options, size=SIZE, view=None):
        """The channels of the picture, and how many rays it took."""
        done = run("trace", "--size", f"{size}x{size}", "-o", "out.ppm", "--z-buffer", "none", "--stats",
                   "stats.txt", *options, stdin=self.view if view is None else view)
        self.assert_quiet_success(done)
        counts = dict(line.split() for line in pathlib.Path("stats.txt").read_text().splitlines())
        return pixels_of("out.ppm"), int(counts["primary_rays"])

    def error(self, pixels, exact):
        """The root of the mean square of the differences."""
        return math.sqrt(sum((a - b)**2 for a, b in zip(pixels, exact)) / len(exact))

    def test_basic_is_one_ray_through_the_center(self):
        self.assertEqual(self.traced("--sampling", "basic"), self.traced())
        self.assertEqual(self.traced()[1], self.SIZE**2)

    def test_regular_is_what_samples_alone_mean(self):
        for count in ("1", "3"):
            self.assertEqual(self.traced("--sampling", "regular", "--samples", count),
                             self.traced("--samples", count))
        self.assertEqual(self.traced("--sampling", "regular"), self.traced("--samples", "5"))

    def test_adaptive_without_a_threshold_is_jittered(self):
        for count in ("1", "2", "3", "4", "5", "16"):
            self.assertEqual(self.traced("--sampling", "adaptive", "--threshold", "0", "--samples", count),
                             self.traced("--sampling", "jittered", "--samples", count))

    def test_adaptive_takes_all_samples_where_the_first_five_differ_by_the_threshold(self):
        """A step of 40 levels, by the channel, from the left half of the picture to the right one, in the
        middle of a pixel."""
        steps = "".join(
            f"{x0} -1 -2 {c}\n{x1} -1 -2 {c}\n{x1} 3 -2 {c}\n\n{x0} -1 -2 {c}\n{x1} 3 -2 {c}\n{x0} 3 "
            f"-2 {c}\n\n" for x0, x1, c in ((-1, 0, "10 100 30"), (0, 1, "10 140 30")))
        view = "ortho -1 1 -1 1 1 3\nattributes color\n" + steps
        size, count = 9, 5
        for threshold, is_refined in (("40", True), ("41", False)):
            _, rays = self.traced("--sampling", "adaptive", "--threshold", threshold, size=size, view=view)
            self.assertEqual(rays, 5 * size**2 + is_refined * size * (count**2 - 5), threshold)

    def test_no_ray_falls_between_triangles(self):
        """Cells whose corners are centers of pixels and of samples cover the picture, in one color."""
        places = ["%.7g" % (i / 20) for i in range(-21, 22)]
        points = [[(x, y, "-2") for x in places] for y in places]
        view = "ortho -1 1 -1 1 1 3\nattributes color\n" + "".join("".join("%s %s %s 200 100 50\n" % vertex
                                                                           for vertex in triangle) + "\n"
                                                                   for triangle in quads(points))
        for options in (["--sampling", "jittered", "--samples", "1"], ["--sampling", "jittered"], [
                "--sampling", "adaptive"]):
            pixels, _ = self.traced(*options, "--background", "00ff00", view=view, size=20)
            self.assertEqual(set(zip(pixels[::3], pixels[1::3], pixels[2::3])), {(200, 100, 50)})

    def test_the_mean_of_jittered_samples_tends_to_that_of_regular_ones(self):
        exact, _ = self.traced("--samples", "16")
        errors = [
            self.error(self.traced("--sampling", "jittered", "--samples", n)[0], exact)
            for n in (1, 2, 4, 8, 16)]
        self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertLess(errors[-1], 1.5)

    def test_depths_stay_those_of_the_centers(self):
        expected = run("trace", "config.txt", stdin=self.view).stdout
        for sampling in ("jittered", "adaptive"):
            self.assertEqual(
                run("trace", "config.txt", "--sampling", sampling, stdin=self.view).stdout, expected)

    def test_colors_that_nobody_can_see_are_noted(self):
        """What the threads have seen comes together."""
        view = "ortho -1 1 -1 1 1 3\nattributes color\n-1 -1 -2 %s\n1 -1 -2 0 0 0\n0 1 -2 0 0 0\n\n"
        black = "trace: note: the picture is black: its colors are 0\n"
        for color, why in (("0 0 0", black), ("90 0 0", "")):
            for options in ([], ["--sampling", "jittered"]):
                done = run("trace", "--size", "40x40", "--threads", "3", *options, stdin=view % color)
                self.assertEqual((done.stderr.decode(), done.returncode), (why, 0))

    def test_light_that_model_has_noted_is_not_noted_again(self):
        view = "perspective 60 1 1 9\nlight 0 0 0 %d 9 9\n-1 -1 -2\n1 -1 -2\n0 1 -2\n"
        for red, is_noted in ((255, False), (9, True)):
            done = run("trace", "--size", "9x9", "-o", "out.ppm", stdin=view % red)
            self.assertEqual(b"too bright" in done.stderr, is_noted)

    def test_a_background_that_lets_through_is_mixed_as_zbuf_mixes_it(self):
        ndc = run("project", "--digits", "exact", stdin=self.view).stdout
        for background in ("11223380", "ff000000"):
            options = ["--size", "20x20", "--samples", "3", "--background", background, "--z-buffer", "none"]
            drawn = run("zbuf", *options, "--coverage", "center", "-o", "drawn.png", stdin=ndc)
            if b"without libpng" in drawn.stderr:
                self.skipTest("built without libpng")
            self.assert_quiet_success(drawn)
            self.assert_quiet_success(run("trace", *options, "-o", "traced.png", stdin=self.view))
            self.assertEqual(pathlib.Path("drawn.png").read_bytes(), pathlib.Path("traced.png").read_bytes())
            pathlib.Path("drawn.png").unlink()

    def test_options_that_do_not_go_together_are_refused(self):
        for options, message in (([
                "--sampling", "basic", "--samples",
                "3"], "--samples: expected 1 with --sampling basic, which has one ray a pixel, found '3'"), ([
                    "--threshold", "3"
                ], "--threshold: expected --sampling adaptive, which alone has one, found no --sampling"), ([
                    "--sampling", "jittered", "--threshold", "8"
                ], "--threshold: expected --sampling adaptive, which alone has one, found jittered"), ([
                    "--sampling", "adaptive", "--threshold",
                    "256"], "--threshold: expected a whole number from 0 to 255, found '256'"), ([
                        "--sampling", "adaptive", "--samples",
                        "17"], "--samples: expected a whole number from 1 to 16, found '17'"), ([
                            "--sampling", "random"
                        ], "--sampling: expected basic, regular, jittered or adaptive, found 'random'")):
            self.assert_fails(run("trace", "config.txt", *options, stdin=self.view), 2,
                              f"trace: {message} (try trace --help)")
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])


class Speed(ToolTest):
    VIEW = b"perspective 60 1 1 100\n" + b"-1 -1 -4\n1 -1 -4\n0 1 -4\n\n" * 3

    def test_is_reported(self):
        done = run("trace", "--size", "40x30", "--timing", "-o", "out.ppm", stdin=self.VIEW)
        self.assertRegex(
            done.stderr.decode(),
            r"trace: 3 triangles in .*; build [\d.]+ s, 0\.0012 million primary rays at "
            r"\S+ million a second\n\Z")

    def test_is_shown_on_a_terminal(self):
        with open("view.txt", "wb") as view:
            view.write(b"perspective 60 1 1 100\n" + b"-1 -1 -4\n1 -1 -4\n0 1 -4\n\n" * 20)
        for samples in ("2", "4", "8"):  # until the run takes long enough for the machine
            if shown := self.shown_on_a_terminal("--size", "1500x1000", "--samples", samples):
                break
        self.assertRegex(shown, r"\rtrace: \d+ %, \d+ s left, [\d.e+-]+ million rays a second")

    def shown_on_a_terminal(self, *options):
        mine, theirs = pseudo_terminal()
        with os.fdopen(mine, "rb", buffering=0) as terminal:
            process = subprocess.Popen(
                command("trace", *options, "--threads", "1", "-o", "out.ppm", "view.txt"),
                stdout=subprocess.DEVNULL, stderr=theirs)
            os.close(theirs)
            shown = b""
            try:
                while chunk := terminal.read(1000):
                    shown += chunk
            except OSError:  # the end of a terminal
                pass
            self.assertEqual(process.wait(), 0)
        return shown.decode()


class Memory(ToolTest):
    def test_is_at_most_200_bytes_a_plain_triangle(self):
        def peak(count, threads):
            rng = random.Random(4)
            with open("view.txt", "w") as view:
                view.write("perspective 60 1 1 100\n")
                for _ in range(count):
                    x, y, z = rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-9, -2)
                    view.write("%.7f %.7f %.7f\n%.7f %.7f %.7f\n%.7f %.7f %.7f\n\n" %
                               (x, y, z, x + 0.01, y, z, x, y + 0.01, z))
            pid = os.posix_spawn(str(run.__globals__["BIN"] / "trace"), [
                "trace", "--size", "64x64", "--threads", threads, "-o", "out.ppm", "--z-buffer", "none",
                "view.txt"], os.environ)
            _, status, usage = os.wait4(pid, 0)
            self.assertEqual(status, 0)
            return usage.ru_maxrss * 1024

        few, many = 20_000, 150_000
        for threads in ("1", "2"):
            self.assertLess((peak(many, threads) - peak(few, threads)) / (many - few), 200, threads)


class Options(ToolTest):
    VIEW = "perspective 60 1 1 100\n-1 -1 -4\n1 -1 -4\n0 1 -4\n\n"

    def test_camera_from_options_scene_and_header(self):
        bare = self.VIEW.split("\n", 1)[1]
        pathlib.Path("scene.txt").write_text(CAMERA + "end\n")
        expected = run("trace", "config.txt", stdin=self.VIEW).stdout
        self.assertEqual(run("trace", "config.txt", "--scene", "scene.txt", stdin=bare).stdout, expected)
        self.assertEqual(
            run("trace", "config.txt", "--perspective", "60", "1", "1", "100", stdin=bare).stdout, expected)
        self.assertTrue(expected.strip())

    def test_no_camera_is_an_error(self):
        self.assert_fails(
            run("trace", "config.txt", stdin=""), 1,
            "trace: <stdin>:1:1: expected a projection (a header line perspective, frustum or ortho; or "
            "--scene; or "
            "--perspective, --frustum or --ortho), found none")

    def test_an_empty_picture_is_noted(self):
        done = run("trace", "config.txt", stdin="perspective 60 1 1 100\n-1 -1 4\n1 -1 4\n0 1 4\n\n")
        self.assertEqual(
            done.stderr.decode(),
            "trace: note: the picture will be empty: the triangle is behind the eye (z is 4 in "
            "view space; the camera looks down -z: turn it around, or move it back by more than 4)\n")

    def test_statistics_count_rays(self):
        done = run("trace", "config.txt", "--stats", "/dev/stderr", "--samples", "2", stdin=self.VIEW)
        self.assertRegex(done.stderr.decode(),
                         r"triangles 1\n(\w+ 0\n)*primary_rays 320\n\Z")  # 64 centers, 256 samples

    def test_shading_needs_lights(self):
        done = run("trace", "config.txt", "--shading", "phong", stdin=self.VIEW)
        self.assert_fails(
            done, 1, "trace: <stdin>:2:1: expected a light for --shading (a header line light), found none")


if __name__ == "__main__":
    unittest.main()
