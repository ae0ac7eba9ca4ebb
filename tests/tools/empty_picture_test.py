#!/usr/bin/env python3
"""A picture that shows nothing: one stage notes the reason on stderr; any other picture draws no remark.

usage: empty_picture_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import random
import unittest

from toolbox import CAMERA, HEADERS, NO_TRIANGLE, SOURCE, TRIANGLE, ToolTest, add_claims, run

NONE_CAME = NO_TRIANGLE.rstrip()
EMPTY = "zbuf: note: the picture is empty: "
WILL_BE_EMPTY = "project: note: the picture will be empty: "
WINDOW = "the window from -1 to 1)"
LIT = "light 0 0 -9 1 1 1\n"
BLACK = "zbuf: note: the picture is black: "
GRAZED = (BLACK + "light only grazes the side that is seen, or is of another color: put a white light in "
          "front of it")
CORNER = "triangle\n-1e4 -9 0 0 0 0\n1e4 -9 0 0 0 0\n0 1e5 0 255 255 255\n"
FLOOR = "".join(f"triangle\n-99 -1 -99\n99 -1 {z}\n{x} -1 99\n" for x, z in ((-99, 99), (99, -99)))


def stderr_of(scene, config, options):
    """The messages of the four stages of a pipe, one after the other."""
    data, told = scene.encode(), []
    for tool in ("model", "view", "project", "zbuf"):
        words = [config] if tool == "zbuf" else []
        done = run(tool, *words, *options.get(tool, ()), stdin=data)
        if done.returncode != 0:
            raise AssertionError(f"{tool}: exit {done.returncode}: {done.stderr.decode()}")
        data = done.stdout
        told += done.stderr.decode().splitlines()
    return told


def claim(text, body, *told, camera=CAMERA, config="8 8\n", **options):
    """A row of the table: the scene's body, the lines on stderr, and options by tool."""
    return text, camera + body + "end\n", config, options, list(told)


class Notes(ToolTest):
    def check(self, scene, config, options, told):
        pathlib.Path("config.txt").write_text(config)
        self.assertEqual(stderr_of(scene, "config.txt", options), told)


NOTES = [
    # Noted by model.
    claim("a scene may be empty", "", "model: note: the picture will be empty: the scene has no triangle",
          NONE_CAME),
    claim(
        "a scale by 0", "scale 0 0 0\n" + TRIANGLE,
        "model: note: <stdin>:5:1: this scale by 0 leaves the triangle without area; 1 keeps a direction "
        "as it is", EMPTY + "the triangle is without area on the screen, as when seen edge-on"),
    claim(
        "a scale by 0 among others",
        "rotate 30 1 1 1\nscale 1 2 3\nscale 1 0 1\nrotate 9 3 2 1\nscale 0 1 1\n" + 3 * TRIANGLE,
        "model: note: <stdin>:7:1: this scale by 0 leaves all 3 triangles without area; 1 keeps a direction "
        "as it is", EMPTY + "all 3 triangles are without area on the screen, as when seen edge-on"),
    claim("a scale by 0 that a triangle escapes", "push\nscale 0 0 0\n" + TRIANGLE + "pop\n" + TRIANGLE),
    claim("a scale by 0 along the normal", "scale 1 1 0\n" + TRIANGLE),
    # Noted by project.
    claim(
        "all behind the eye", "translate 0 0 7\n" + TRIANGLE + "translate 0 0 4\n" + TRIANGLE, WILL_BE_EMPTY +
        "all 2 triangles are behind the eye (z from 2 to 6 in view space; the camera looks down -z: turn it "
        "around, or move it back by more than 6)", NONE_CAME),
    claim("too near to be divided", "translate 0 0 4.9999\n" + TRIANGLE,
          WILL_BE_EMPTY + "the triangle is nearer than the near plane (z is -0.0001)", NONE_CAME),
    claim("culled", TRIANGLE, WILL_BE_EMPTY + "the triangle is dropped by --cull", NONE_CAME, project=[
        "--cull", "front"]),
    claim(
        "outside, clipped", "translate 20 0 0\n" + TRIANGLE + "translate -40 0 0\n" + TRIANGLE,
        WILL_BE_EMPTY + "none of 2 triangles is left: 1 left of the view volume, 1 right of the view volume",
        NONE_CAME, project=["--clip", "frustum"]),
    claim("outside, rejected", "translate 0 20 0\n" + TRIANGLE,
          WILL_BE_EMPTY + "the triangle is above the view volume", NONE_CAME, project=["--clip", "reject"]),
    claim("past a corner of the view volume", "triangle\n0 6 0\n6 0 0\n6 6 0\n",
          WILL_BE_EMPTY + "the triangle is above the view volume", NONE_CAME, project=["--clip", "frustum"]),
    claim(
        "behind and culled", "translate 0 0 9\n" + TRIANGLE + "translate 0 0 -9\n" + TRIANGLE, WILL_BE_EMPTY +
        "none of 2 triangles is left: 1 behind the eye (z is 4 in view space; the camera looks down -z: turn "
        "it around, or move it back by more than 4), 1 dropped by --cull", NONE_CAME, project=[
            "--cull", "front"]),
    claim(
        "radians", "translate 1 0 0\n" + TRIANGLE,
        "project: note: nothing is in view, but with a fovY of 60 degrees in place of 1.047, 1 triangle "
        "would be: angles are in degrees; was this one in radians?",
        EMPTY + "the triangle is right of the window (x from 21.88 to 43.77, " + WINDOW,
        camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n"),
    claim(
        "radians, clipped", "translate 1 0 0\n" + TRIANGLE,
        "project: note: nothing is in view, but with a fovY of 60 degrees in place of 1.047, 1 triangle "
        "would be: angles are in degrees; was this one in radians?", NONE_CAME,
        camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n", project=["--clip", "frustum"]),
    claim("no radians where no angle would help", "translate 100 0 0\n" + TRIANGLE,
          EMPTY + "the triangle is right of the window (x from 2188 to 2210, " + WINDOW,
          camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n"),
    claim(
        "radians, and one triangle fills the picture", "translate -0.3 -0.3 0\n" + TRIANGLE,
        "project: note: no vertex is in view, but with a fovY of 60 degrees in place of 1.047, those of 1 "
        "triangle would be: angles are in degrees; was this one in radians?",
        camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n"),
    claim("a telescope before a wall", "scale 100 100 1\ntranslate -0.3 -0.3 0\n" + TRIANGLE,
          camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n"),
    claim(
        "a light with channels up to 255", "light 0 0 5 255 200 128\n" + TRIANGLE,
        "model: note: <stdin>:5:7: a light of 255 is 255 times full light: 1 is full, so divide by 255 if "
        "this is a color"),
    claim(
        "ambient light with channels up to 255", "ambient 0 64 0\n" + LIT + TRIANGLE,
        "model: note: <stdin>:5:9: ambient light of 64 is 64 times full light: 1 is full, so divide by 255 "
        "if this is a color"),
    claim(
        "a bright light", "light 0 0 5 16 8 4\n" + TRIANGLE,
        "zbuf: note: the picture is white: the light or a material is too bright (1 is full, "
        "also for KA, KD and KS; several lights add up)"),
    claim(
        "too much light that shows no edge",
        "light 0 0 5 255 255 255\n" + TRIANGLE + "translate -1.5 0 -1\n" + TRIANGLE,
        "model: note: <stdin>:5:7: a light of 255 is 255 times full light: 1 is full, so divide by 255 if "
        "this is a color"),
    claim("a bright light that fades", "attenuation 0 0 1\nlight 0 0 5 100 100 100\n" + TRIANGLE),
    claim("a telescope", TRIANGLE, camera="0 0 5\n0 0 0\n0 1 0\n1.0472 1 1 100\n"),
    # Noted by zbuf.
    claim("right of the window", "translate 100 0 0\n" + TRIANGLE,
          EMPTY + "the triangle is right of the window (x from 34.64 to 34.99, " + WINDOW),
    claim("left of the window", "translate -100 0 0\n" + TRIANGLE,
          EMPTY + "the triangle is left of the window (x from -34.64 to -34.29, " + WINDOW),
    claim("above the window", "translate 0 100 0\n" + TRIANGLE,
          EMPTY + "the triangle is above the window (y from 34.64 to 34.99, " + WINDOW),
    claim("below the window", "translate 0 -100 0\n" + TRIANGLE,
          EMPTY + "the triangle is below the window (y from -34.64 to -34.29, " + WINDOW),
    claim("past the window's corner", "triangle\n1.6 9 0\n9 1.6 0\n9 9 0\n",
          EMPTY + "the triangle is above the window, past its corner (y from 0.5543 to 3.118, " + WINDOW),
    claim("before the front limit", "translate 0 0 4.5\n" + TRIANGLE,
          EMPTY + "the triangle is before the front limit (z is -3.02, the limit is -1, the camera's near)"),
    claim("beyond the rear limit", "translate 0 0 -200\n" + TRIANGLE,
          EMPTY + "the triangle is beyond the rear limit (z is 1.01, the limit is 1, the camera's far)"),
    claim(
        "at the rear limit, as near is too small", TRIANGLE, EMPTY +
        "the triangle is at the camera's far, which shows nothing (z is 1, perhaps rounded: a near that is "
        "too close to the eye leaves z no digits)", camera="0 0 5\n0 0 0\n0 1 0\n60 1 1e-7 5e9\n"),
    claim("beyond the rear limit by the last digit", "translate 0 0 -95.0001\n" + TRIANGLE,
          EMPTY + "the triangle is beyond the rear limit (z is 1.00000002, the limit is 1, the camera's far)",
          project=["--digits", "10"]),
    claim("between pixel centers", "scale 0.01 0.01 1\n" + TRIANGLE,
          EMPTY + "the triangle is between pixel centers (a pixel is 0.25 by 0.25)"),
    claim("between pixel centers but on samples", "scale 0.4 0.4 1\ntranslate -0.9 -0.9 0\n" + TRIANGLE,
          zbuf=["--samples", "4"]),
    claim("without area", "triangle\n0 0 0\n1 0 0\n2 0 0\n",
          "model: note: <stdin>:6:1: the vertices of this triangle lie on a line, so it has no area",
          EMPTY + "the triangle is without area on the screen, as when seen edge-on"),
    claim(
        "several reasons", "translate 100 0 0\n" + 2 * TRIANGLE + "translate -200 0 0\n" + TRIANGLE,
        EMPTY + f"none of 3 triangles shows: 1 left of the window (x from -34.64 to -34.29, {WINDOW}, "
        f"2 right of the window (x from 34.64 to 34.99, {WINDOW}"),
    claim(
        "a window of its own", "translate 0.9 0 0\n" + TRIANGLE, EMPTY +
        "the triangle is right of the window (x from 0.3118 to 0.6582, the window from -0.25 to 0.25)",
        config="8 8\n-0.25\n-0.5\n-1 1\n"),
    # Triangles show, but as black as the background.
    claim("colors between 0 and 1", "color 1 0.5 0\n" + TRIANGLE,
          "zbuf: note: the picture is black: its colors lie between 0 and 1, but channels run from 0 to 255"),
    claim("colors between 0 and 1, lit", "color 1 0.5 0\nambient 1 1 1\n" + LIT + TRIANGLE,
          "zbuf: note: the picture is black: its colors lie between 0 and 1, but channels run from 0 to 255"),
    claim("colors of 0", "color 0 0 0\n" + TRIANGLE, "zbuf: note: the picture is black: its colors are 0"),
    claim("colors of 0 on another background", "background 0 9 0\ncolor 0 0 0\n" + TRIANGLE),
    claim("one color above 1",
          "color 1 1 1\n" + TRIANGLE + "color 255 0 0\n" + TRIANGLE + "translate 0 0 0.5\n" + TRIANGLE),
    claim(
        "a light behind the surface", LIT + TRIANGLE,
        "zbuf: note: the picture is black: no light reaches the side that is seen (put a light on the eye's "
        "side; ambient 0.2 0.2 0.2 would show it from anywhere)"),
    claim(
        "a weak light", "light 0 0 5 0.002 0.002 0.001\ncolor 200 200 200\n" + TRIANGLE,
        "zbuf: note: the picture is black: the light on the side that is seen is too weak (its intensity is "
        "0.002; 1 is full)"),
    claim(
        "a weak light before the surface and a strong one behind it",
        "light 0 0 5 0.002 0 0\nlight 0 0 -5 1 1 1\ncolor 200 200 200\n" + TRIANGLE,
        "zbuf: note: the picture is black: the light on the side that is seen is too weak (its intensity is "
        "0.002; 1 is full)", zbuf=["--shading", "gouraud"]),
    claim(
        "lights of no intensity", "light 0 0 5 0 0 0\nlight 1 0 5 0 0 0\ncolor 200 200 200\n" + TRIANGLE,
        "zbuf: note: the picture is black: every light has the intensity 0 (the last three numbers of "
        "'light'; 1 is full)"),
    claim(
        "a light weakened by its distance",
        "attenuation 1 0 100\nlight 0 0 5 1 1 1\ncolor 200 200 200\n" + TRIANGLE,
        "zbuf: note: the picture is black: the light on the side that is seen is too weak (its intensity is "
        "1, and attenuation weakens it: '1 0 0' would not)"),
    claim("a light that grazes, hardly weakened",
          "attenuation 1 0.0001 0\nlight 100 0 0.5 1 1 1\n" + TRIANGLE, GRAZED),
    claim("a light of another color", "light 0 0 5 1 0 0\ncolor 0 0 200\n" + TRIANGLE, GRAZED),
    claim("the black corner of a triangle", "attributes color\n" + CORNER,
          BLACK + "no channel of its colors is above 8, but channels run from 0 to 255"),
    claim("a floor below the eye", "light 0 1e6 0 1 1 1\ncolor 200 180 0\n" + FLOOR),
    claim(
        "a material of no share", "material 1 0 0 1\nlight 0 0 5 1 1 1\ncolor 200 200 200\n" + TRIANGLE,
        "zbuf: note: the picture is black: the material reflects no light but the ambient (of 'material KA "
        "KD KS N', KD and KS are 0)"),
    claim("a light behind the surface, as the note advises", "ambient 0.2 0.2 0.2\n" + LIT + TRIANGLE),
    claim("a silhouette", "background 255 255 255\n" + LIT + TRIANGLE),
    claim("the color of the background", "background 255 255 255\ncolor 255 255 255\n" + TRIANGLE,
          EMPTY + "what is seen has the color of the background"),
    claim("no edge in sight", "scale 99 99 1\ntranslate -0.3 -0.3 0\n" + TRIANGLE,
          EMPTY + "--wireframe shows edges alone, and none is in sight", zbuf=["--wireframe"]),
    claim("edges behind a triangle that fills the picture",
          TRIANGLE + "scale 99 99 1\ntranslate -0.3 -0.3 1\n" + TRIANGLE, config="99 99\n", zbuf=[
              "--wireframe", "all"])]
add_claims(Notes, NOTES)

# Samples that show what a note tells of: zbuf draws matt what is glass; 7 digits cannot tell two walls apart.
ARE_NOTED = {"glass-and-mirrors", "two-walls"}


class Silence(ToolTest):
    def test_every_sample(self):
        for scene in sorted(SOURCE.glob("samples/*/scene.txt")):
            for options in ((), ("--coverage", "center"), ("--samples", "2"), ("--algorithm", "scanline"),
                            ("--wireframe",)):
                with self.subTest(scene=scene.parent.name, options=options):
                    noted = stderr_of(scene.read_text(), scene.parent / "config.txt", {"zbuf": options})
                    self.assertEqual([line for line in noted if " the picture is " in line], [])
                    if scene.parent.name not in ARE_NOTED:
                        self.assertEqual(noted, [])

    def test_a_stage_in_the_middle_that_reads_nothing(self):
        for tool in ("view", "project"):
            self.assert_quiet_success(run(tool, stdin=HEADERS[tool]))
            with open("out.txt", "wb") as file:
                last = run(tool, stdin=HEADERS[tool], stdout=file)
            self.assertEqual((last.stderr.decode(), last.returncode),
                             (f"{tool}: note: the input has no triangles\n", 0))


class FirstVisible(ToolTest):
    """The note is there exactly if no pixel has a depth, whatever the rule, the format, the algorithm and the
    kernel."""
    def random_text(self, rng):
        def vertex():
            reach = rng.choice((1.02, 1.3, 3))
            return "%.7f %.7f %.7f\n" % (rng.uniform(-reach, reach), rng.uniform(
                -reach, reach), rng.choice((-1.2, -1, 0.999, 1, 1.0000001, 1.2)))

        return "".join("".join(vertex() for _ in range(3)) + "\n" for _ in range(rng.choice((1, 1, 2, 3))))

    def test_random_triangles_at_the_limits(self):
        rng, outcomes = random.Random(5), []
        pathlib.Path("config.txt").write_text("3 3\n")
        for number in range(150):
            text = self.random_text(rng)
            options = [
                "--coverage",
                rng.choice(("nearest", "center")), "--depth",
                rng.choice(("f64", "f32", "u24")), "--algorithm",
                rng.choice(("zbuffer", "scanline"))]
            kernel = rng.choice(("scalar", "avx2"))
            with self.subTest(text=text, options=options):
                done = run("zbuf", "config.txt", "--image", "out.ppm", *options, stdin=text,
                           env=os.environ | {"PIPELINE_KERNEL": kernel})
                is_empty = done.stdout.split() == []
                self.assertEqual(done.stderr.decode().startswith(EMPTY), is_empty, done.stderr)
                outcomes.append(is_empty)
        self.assertGreater(outcomes.count(True), 20)
        self.assertGreater(outcomes.count(False), 20)

    def test_a_visible_triangle_after_many_others(self):
        pathlib.Path("config.txt").write_text("8 8\n")
        lost = "9 9 0\n10 9 0\n9 10 0\n\n" * 5000
        self.assert_quiet_success(
            run("zbuf", "config.txt", "--image", "out.ppm", stdin=lost + "-1 -1 0\n1 -1 0\n0 1 0\n"))


if __name__ == "__main__":
    unittest.main()
