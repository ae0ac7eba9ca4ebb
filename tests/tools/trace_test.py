#!/usr/bin/env python3
"""trace writes what project --digits exact | zbuf --coverage center write: the rasterizer and the ray tracer judge each other.

usage: trace_test.py BIN_DIR [UNITTEST ARGUMENT...]
TRACE_SCENES is the number of random scenes (default 60).
"""
import os
import pathlib
import random
import re
import sys
import unittest

from toolbox import CAMERA, CONFIG, SCENE, SOURCE, ToolTest, pipe, pseudo_terminal, run

sys.path.insert(0, str(SOURCE / "tests/reference"))
import random_scenes  # noqa: E402

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
    def pixels(self):
        return self.pixel_count

    def check(self, view_text, config, *options, projection=()):
        """Both ways give the same depths, picture and notes on an empty picture."""
        pathlib.Path("config.txt").write_text(config)
        ndc = run("project", "--digits", "exact", *projection, stdin=view_text)
        raster = run("zbuf", "config.txt", "--coverage", "center", "-o", "raster.ppm", *options, stdin=ndc.stdout)
        traced = run("trace", "config.txt", *projection, "-o", "traced.ppm", *options, stdin=view_text)
        self.assertEqual((ndc.returncode, raster.returncode), (traced.returncode,) * 2, traced.stderr.decode())
        if traced.returncode != 0:
            return
        if traced.stdout != raster.stdout or pathlib.Path("raster.ppm").read_bytes() != pathlib.Path("traced.ppm").read_bytes():
            self.fail(f"trace {config!r} {options} {projection} differs from project | zbuf on\n"
                      + (view_text if isinstance(view_text, str) else view_text.decode())[:4000])

    def check_window(self, triangles, config, projection="ortho -1 1 -1 1 1 3", *options):
        self.check(projection + "\n" + triangles_text(triangles), config, *options)

    def test_agrees_on_the_samples(self):
        for folder in sorted(path.parent for path in (SOURCE / "samples").glob("*/scene.txt")):
            for digits in ((), ("--digits", "exact")):
                with self.subTest(folder.name, digits=digits):
                    view = pipe(["model", *digits], ["view", *digits], stdin=(folder / "scene.txt").read_bytes())
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
        """Corners of the cells are centers of 20 x 20 pixels, in front of a parallel and of a pinhole camera."""
        places = [(2 * i + 1 - 20) / 20 for i in range(-1, 21)]
        for scale, projection in ((1, "ortho -1 1 -1 1 1 3"), (2, "frustum -1 1 -1 1 1 8"), (1.3, "frustum -0.5 0.75 -1 1 1 8")):
            for depth in ("-2", None):
                points = [[("%.7g" % (scale * x), "%.7g" % (scale * y), depth or "%.7g" % (-2 - 0.01 * (i % 3) - 0.02 * (k % 2)))
                           for i, x in enumerate(places)] for k, y in enumerate(places)]
                with self.subTest(projection=projection, depth=depth):
                    self.check_window(quads(points), "20 20\n", projection)
                    self.check_window(quads(points), "20 20\n", projection, "--samples", "3")

    def test_agrees_on_terrains_of_tidy_decimals(self):
        rng = random.Random(1)
        for decimals in (1, 2, 3):
            size = 40
            points = [[("%.*f" % (decimals, (i - size / 2) * 0.25), "%.*f" % (decimals, rng.uniform(-1.5, -0.5)),
                        "%.*f" % (decimals, -1 - k * 0.25)) for i in range(size)] for k in range(size)]
            with self.subTest(decimals=decimals):
                self.check_window(quads(points), "100 100\n", "perspective 60 1 1 100")
                self.check_window(quads(points), "50 40\n", "perspective 90 1.25 0.01 1000", "--samples", "2")

    def test_agrees_on_twin_layers(self):
        """The second layer is behind the first, in front of it, or in the same place."""
        for gap in ("1e-5", "1e-7", "1e-10", "1e-15", "0", "-1e-7", "-1e-15"):
            z = [-5, -5 - float(gap)]
            layers = [((-2, -2, d), (2, -2, d), (2, 2, d)) for d in z] + [((-2, -2, d), (2, 2, d), (-2, 2, d)) for d in z]
            tilted = [tuple((repr(x), repr(y), repr(d + 0.3 * x + 0.1 * y)) for x, y, d in t) for t in layers]
            with self.subTest(gap=gap):
                for config in ("30 30\n", "30 30\n-0.7\n-0.6\n0 1\n"):
                    self.check_window(layers, config, "perspective 40 1 1 100")
                    self.check_window(tilted, config, "perspective 40 1 1 100")

    def test_agrees_on_cut_triangles(self):
        """Triangles that reach behind the eye, lit or not."""
        rng = random.Random(2)
        for header in ("", "attributes color normal\nlight 1 2 -1 1 1 1\nambient 0.2 0.2 0.2\n", "attributes color\n"):
            for _ in range(6):
                triangles = []
                for _ in range(12):
                    corners = [["%.3g" % rng.uniform(-4, 4), "%.3g" % rng.uniform(-4, 4), "%.3g" % rng.uniform(-9, 3)] for _ in range(3)]
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
            points = [[(repr(x * scale), repr(y * scale), repr((-2 - 0.1 * x * y) * scale)) for x in range(-3, 4)] for y in range(-3, 4)]
            with self.subTest(scale=scale):
                self.check_window(quads(points), "21 21\n", "frustum %r %r %r %r %r %r" % tuple(scale * n for n in (-1, 1, -1, 1, 1, 9)))
                self.check_window(quads(points), "21 21\n", "ortho %r %r %r %r %r %r" % tuple(scale * n for n in (-1, 1, -1, 1, 1, 9)))

    def test_agrees_in_odd_windows(self):
        rng = random.Random(3)
        for _ in range(20):
            config = "%d %d\n-%s\n-%s\n%s %s\n" % (rng.randint(1, 60), rng.randint(1, 60), rng.choice(("1", "0.3", "7.25", "1e-3", "0.1234567")),
                                                 rng.choice(("1", "0.3", "7.25", "0.7654321")), rng.choice(("-1", "0", "0.5", "-3")),
                                                 rng.choice(("1", "0.75", "0.9999", "2")))
            triangles = [[tuple("%.2f" % rng.uniform(-3, 3) for _ in "xy") + ("%.2f" % rng.uniform(-9, -0.01),) for _ in range(3)] for _ in range(40)]
            self.check_window(triangles, config, rng.choice(("perspective 60 1 1 10", "ortho -3 3 -3 3 1 8", "frustum 2 -1 -1 3 1 8")))


class Threads(ToolTest):
    def test_change_no_byte(self):
        view = pipe(["model"], ["view"], stdin=(SOURCE / "samples/shaded-torus/scene.txt").read_bytes())
        outputs = set()
        for count in ("0", "1", "2", "5"):
            done = run("trace", "--size", "90x70", "--threads", count, "-o", "out.ppm", "--samples", "2", stdin=view)
            self.assert_quiet_success(done)
            outputs.add(done.stdout + pathlib.Path("out.ppm").read_bytes())
        self.assertEqual(len(outputs), 1)


class Speed(ToolTest):
    VIEW = b"perspective 60 1 1 100\n" + b"-1 -1 -4\n1 -1 -4\n0 1 -4\n\n" * 3

    def test_is_reported(self):
        done = run("trace", "--size", "40x30", "--timing", "-o", "out.ppm", stdin=self.VIEW)
        self.assertRegex(done.stderr.decode(), r"trace: 3 triangles in .*; build [\d.]+ s, 0\.0012 million primary rays at "
                                               r"\S+ million a second, \S+ million exactly\n\Z")

    def test_is_shown_on_a_terminal(self):
        mine, theirs = pseudo_terminal()
        with os.fdopen(mine, "rb", buffering=0) as terminal:
            with open("view.txt", "wb") as view:
                view.write(b"perspective 60 1 1 100\n" + b"-1 -1 -4\n1 -1 -4\n0 1 -4\n\n" * 20)
            import subprocess
            from toolbox import command
            process = subprocess.Popen(command("trace", "--size", "3000x2000", "--threads", "1", "-o", "out.ppm", "view.txt"),
                                       stdout=subprocess.DEVNULL, stderr=theirs)
            os.close(theirs)
            shown = b""
            try:
                while chunk := terminal.read(1000):
                    shown += chunk
            except OSError:  # the end of a terminal
                pass
            self.assertEqual(process.wait(), 0)
        self.assertRegex(shown.decode(), r"\rtrace: \d+ rays, [\d.e+-]+ million a second")


class Memory(ToolTest):
    def test_is_at_most_200_bytes_a_plain_triangle(self):
        def peak(count, threads):
            rng = random.Random(4)
            with open("view.txt", "w") as view:
                view.write("perspective 60 1 1 100\n")
                for _ in range(count):
                    x, y, z = rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-9, -2)
                    view.write("%.7f %.7f %.7f\n%.7f %.7f %.7f\n%.7f %.7f %.7f\n\n" % (x, y, z, x + 0.01, y, z, x, y + 0.01, z))
            pid = os.posix_spawn(str(run.__globals__["BIN"] / "trace"), ["trace", "--size", "64x64", "--threads", threads, "-o", "out.ppm",
                                                                        "--z-buffer", "none", "view.txt"], os.environ)
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
        self.assertEqual(run("trace", "config.txt", "--perspective", "60", "1", "1", "100", stdin=bare).stdout, expected)
        self.assertTrue(expected.strip())

    def test_a_text_of_another_stage_is_refused(self):
        self.assert_fails(run("trace", "config.txt", stdin=pipe(["model"], stdin=SCENE)), 1,
                          "trace: <stdin>:1:1: expected the output of view, found 'eye': this text has not been through view; "
                          "a view of your own must drop the lines eye, look and up")

    def test_no_camera_is_an_error(self):
        self.assert_fails(run("trace", "config.txt", stdin=""), 1,
                          "trace: <stdin>:1:1: expected a projection (a header line perspective, frustum or ortho; or --scene; or "
                          "--perspective, --frustum or --ortho), found none")

    def test_an_empty_picture_is_noted(self):
        done = run("trace", "config.txt", stdin="perspective 60 1 1 100\n-1 -1 4\n1 -1 4\n0 1 4\n\n")
        self.assertEqual(done.stderr.decode(), "trace: note: the picture will be empty: the triangle is behind the eye (z is 4 in "
                         "view space; the camera looks down -z: turn it around, or move it back by more than 4)\n")

    def test_an_earlier_failure_leaves_no_picture(self):
        done = run("trace", "config.txt", stdin=self.VIEW + "error view: nothing\n")
        self.assertEqual(done.returncode, 1)
        self.assertFalse(pathlib.Path("out.bmp").exists())

    def test_a_frame_is_insisted_on(self):
        self.assertEqual(run("trace", "config.txt", "--framed", stdin=self.VIEW).returncode, 1)
        self.assert_quiet_success(run("trace", "config.txt", "--framed", stdin="framed\n" + self.VIEW + "end\n"))

    def test_statistics_count_rays(self):
        done = run("trace", "config.txt", "--stats", "-", "--samples", "2", stdin=self.VIEW)
        self.assertRegex(done.stderr.decode(), r"triangles 1\n(\w+ 0\n)*primary_rays 320\n\Z")  # 64 centers, 256 samples

    def test_shading_needs_lights(self):
        done = run("trace", "config.txt", "--shading", "phong", stdin=self.VIEW)
        self.assert_fails(done, 1, "trace: <stdin>:2:1: expected a light for --shading (a header line light), found none")


if __name__ == "__main__":
    unittest.main()
