#!/usr/bin/env python3
"""Every error gets one line on stderr: the tool, the location, the expected and the found text. More of what
readers say is in tests/scene and tests/stream.

usage: messages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import unittest

from toolbox import BIN, CAMERA, HEADER, HEADERS, SOURCE, TRIANGLE, ToolTest, add_claims, run

COMMANDS = "a command (triangle, sphere, translate, scale, rotate, push, pop or end)"
FIRST_COMMANDS = COMMANDS[:-1] + (
    "; before the first triangle also color, attributes, background, light, ambient, "
    "material or attenuation)")
VERTICES = "0 0 0\n1 0 0\n0 1 0\n"
MATERIALS = "attributes material\nmaterial 1 1 0 1\nmaterial 0 0 1 5\n"
IN_RANGE = "expected a vertex whose image is within a double's range"
IN_FRONT = "expected a vertex in front of the eye (z below 0; --clip auto cuts the others)"


class SceneMessages(ToolTest):
    def check(self, scene, message):
        pathlib.Path("scene.txt").write_bytes(scene.encode("latin-1"))
        self.assert_fails(run("model", "scene.txt"), 1, "model: scene.txt:" + message)


SCENES = [
    # The camera.
    ("the eye has a z", "0 0\n", "1:4: expected the z of the eye, found the end of the line"),
    ("a number may be too large", "0 0 1e309\n",
     "1:5: expected the z of the eye within a double's range, found '1e309'"),
    ("a line has an end", "0" * 2000000,
     "1:1048577: expected the end of the line, found more than 1048576 characters"),
    # The commands.
    ("commands in British spelling are guessed", CAMERA + "colour 1 2 3\n",
     f"5:1: expected {FIRST_COMMANDS}, found 'colour' (did you mean color?)"),
    ("a misspelled aspect rule is guessed", "0 0 5\n0 0 0\n0 1 0\n60 1 1 100 raito\n",
     "4:12: expected ratio, angle or the end of the line after far, found 'raito' (did you mean ratio?)"),
    ("an aspect rule is in lower case", "0 0 5\n0 0 0\n0 1 0\n60 1 1 100 Ratio\n",
     "4:12: expected ratio, angle or the end of the line after far, found 'Ratio' (keywords are lower case)"),
    ("misspelled attributes are guessed", CAMERA + "attributes colour\n",
     "5:12: expected attributes of [color] [normal], in this order, found 'colour' (did you mean color?)"),
    ("translate has three numbers", CAMERA + "translate\n1 2\n",
     "6:4: expected the z of the translation, found the end of the line"),
    # Appearance.
    ("a color has three channels", CAMERA + "color 1 2\n",
     "5:10: expected the blue of the color, found the end of the line"),
    ("a channel is not negative", CAMERA + "background 1 2 -1\n",
     "5:16: expected the blue of the background from 0 to 255, found '-1'"),
    ("a scene may end before a color", CAMERA + "color\n",
     "6:1: expected the arguments of 'color', found the end of the input"),
    ("colors and materials may change behind triangles",
     CAMERA + "material 1 1 0 1\nmaterial 1 1 0 2\nabsorption 1 1 1\ncolor 1 2 3\n" + TRIANGLE + "cube\n",
     f"13:1: expected {COMMANDS[:-1]}; also color and use), found 'cube'"),
    ("the background stands once", CAMERA + "background 1 2 3\n  background 1 2 3\n",
     "6:3: expected one 'background', found a second one after scene.txt:5:12"),
    ("columns that are announced are there", CAMERA + "attributes color normal\ntriangle\n0 0 0 1 2 3\n",
     "7:12: expected the normal's x of vertex 1 of 3 (x y z r g b nx ny nz, by the line 'attributes color "
     "normal'), found the end of the line"),
    ("a light may leave a doubles range", CAMERA + "scale 1 1e300 1\nlight\n  0 -1e300 0 1 1 1\nend\n",
     "7:3: expected a light whose image is within a double's range, found an overflow of its y"),
    ("ambient light takes nothing away", CAMERA + "ambient -1 0 0\n",
     "5:9: expected the red of the ambient light of at least 0, found '-1'"),
    ("a material that is used stands above", CAMERA + "material 1 1 0 1\nmaterial 1 1 0 1\nuse 2\n",
     "7:5: expected the number of a material above, a whole number below 2, found '2'"),
    ("a material has a shininess", CAMERA + "material 1 1 1\n",
     "5:15: expected the shininess, a whole number below 2^64, found the end of the line"),
    ("attenuation is not negative", CAMERA + "attenuation 1 -1 0\n",
     "5:15: expected the linear attenuation of at least 0, found '-1'")]
add_claims(SceneMessages, SCENES)


class StageMessages(ToolTest):
    """The three readers of stage text find the same errors; each reads its own header, in place of HEADER."""
    def check(self, text, message):
        for tool, *options in (["view"], ["project"], ["zbuf", "config.txt"]):
            pathlib.Path("stage.txt").write_text(text.replace(HEADER, HEADERS[tool]))
            with self.subTest(tool=tool):
                self.assert_fails(run(tool, *options, "stage.txt"), 1, f"{tool}: stage.txt:{message}")


add_claims(StageMessages, [
    ("header lines come before the triangles", HEADER + VERTICES + "\nup 0 1 0\n",
     "9:1: expected header lines before the first triangle, found 'up'"),
    ("a material is one of the header's", MATERIALS + HEADER + "0 0 0 2\n",
     "8:7: expected the material of vertex 1 of 3 (x y z material, by the line 'attributes material'), a "
     "whole number below 2, found '2'"),
    ("a material is a whole number", MATERIALS + HEADER + "0 0 0 1.0\n",
     "8:7: expected the material of vertex 1 of 3 (x y z material, by the line 'attributes material'), a "
     "whole number below 2, found '1.0'"),
    ("a vertex has the columns of its attributes", "attributes color\n" + HEADER + "0 0 0 1 1\n",
     "6:10: expected the blue of vertex 1 of 3 (x y z r g b, by the line 'attributes color'), found the end "
     "of the line"),
    ("a coordinate may be too large", HEADER + "0 0 0\n1 0 0\n0 1e999 0\n",
     "7:3: expected the y of vertex 3 of 3 within a double's range, found '1e999'"),])


class CameraMessages(ToolTest):
    def check(self, words, stdin, status, message):
        tool, *options = words.split()
        self.assert_fails(run(tool, *options, stdin=stdin), status, f"{tool}: {message}")


CAMERA_FORM = "a camera (header lines eye, look and up; or --scene; or --eye, --look and --up)"
CAMERAS = [
    ("view needs a whole camera", "view", "eye 0 0 5\n# c\n\n 0 0 0\n", 1,
     f"<stdin>:4:2: expected {CAMERA_FORM}, found no look or up"),
    ("view says which option is missing", "view --eye 0 0 5 --look 0 0 0", VERTICES, 1,
     f"<stdin>:1:1: expected {CAMERA_FORM}, found no up"),
    ("fovX may be far too large", "project", "perspective 100 1e308 1 9\n", 1,
     "<stdin>:1:13: expected fovX = fovY * aspect above 0 and below 180 degrees (or --aspect ratio; in a "
     "scene, the word ratio at the end), found 100 * 1e+308"),
    ("a vertex on the eye plane cannot be divided", "project --clip none",
     "perspective 60 1 1 9\n0 0 -2\n1 0 0\n0 1 -2\n", 1, f"<stdin>:3:1: {IN_FRONT}, found z = 0"),
    ("a vertex behind the eye cannot be divided", "project --clip none",
     "perspective 60 1 1 9\n0 0 2\n1 0 -2\n0 1 -2\n", 1, f"<stdin>:2:1: {IN_FRONT}, found z = 2"),
    (
        "a cut may be too near to the eye",
        "project",
        "perspective 120 1 1e-200 1e200\n1.8 -0.4 0.4\n-0.3 -1.1 1.0\n0.9 -0.6 -2.0\n",
        1,
        # The first cut is on the edge from vertex 2 to vertex 3, a third of the way along.
        "<stdin>:3:1: expected a cut that 31 digits can tell from the eye plane (a larger near helps), found "
        "one nearer to it"),
    ("a light may leave a doubles range in view", "view",
     "eye -1e308 0 0\nlook 0 0 0\nup 0 1 0\nlight  1.7e308 0 0 1 1 1\n", 1,
     "<stdin>:4:8: expected a light whose image is within a double's range, found an overflow of its z"),
    ("what is projected is not put before the camera", "view", "attributes w color\n" + HEADER, 1,
     "<stdin>:1:12: expected a text that is not projected yet, found one with the column 'w', which "
     "project adds"),
    ("what is projected is not projected again", "project", "perspective 60 1 1 9\nattributes w\n", 1,
     "<stdin>:2:12: expected a text that is not projected yet, found one with the column 'w', which "
     "project adds"),
    ("a w is above 0", "zbuf config.txt", "attributes w\n0 0 0 0\n", 1,
     "<stdin>:2:7: expected the w of vertex 1 of 3 (x y z w, by the line 'attributes w') above 0, found '0'"),
    ("shading needs a light", "zbuf config.txt --shading flat", "background 1 2 3\n" + VERTICES, 1,
     "<stdin>:2:1: expected a light for --shading (a header line light), found none"),
    ("light needs a projection", "zbuf config.txt", "light 1 1 1 1 1 1\n" + VERTICES, 1,
     "<stdin>:2:1: expected a header line 'projected frustum L R B T N F' (or ortho) in a text with lights, "
     "found none: "
     "this text has not been through project"),
    ("a whole of a clipped triangle is in clip space", "zbuf config.txt", "clipped\n0 0 0\n", 1,
     "<stdin>:2:6: expected the w of vertex 1 of 3 (x y z w, by the line 'attributes w'), found the end of "
     "the line"),
    ("a frame may be asked for", "zbuf config.txt --expect-framed", VERTICES, 1,
     "<stdin>:1:1: expected a framed text (model --framed), found one without 'framed'"),
    ("a frame of nothing may be asked for", "zbuf config.txt --expect-framed", "", 1,
     "<stdin>:1:1: expected a framed text (model --framed), found an empty one"),
    ("a scene besides the input is a file", "view --scene -", "", 2,
     "--scene: expected a file, as INPUT is standard input, found '-' (try view --help)"),
    ("a scene besides the input exists", "view --scene none.txt", "", 1,
     "cannot open none.txt: No such file or directory"),
    ("a camera of option and header makes sense", "view --look 0 0 5", HEADER, 2,
     "--look: expected a point other than the eye to look at, found 0 0 5 (try view --help)")]
add_claims(CameraMessages, CAMERAS)


class VertexPlaces(ToolTest):
    """An error found by calculating is reported at the vertex, by every kernel."""

    GOOD = "0.0000000 0.0000000 -2.0000000"
    # A vertex's line, and the column of its first number.
    LINES = (("{}", 1), ("  {}", 3), ("\t {}", 3), ("{} # here", 1), ("   {}\r", 4), (" {} \t", 2))

    def assert_placed(self, tool, *options, header, frame, x, reason):
        """The error is the x of vertex 2 of triangle 1000; `frame` makes a triangle of three lines."""
        for vertex in (f"{x} 0 -2", f"{x} 0.000000000 -2e0"):
            for form, column in self.LINES:
                good = "".join(frame(*3 * (self.GOOD,)) for _ in range(1000))
                bad = frame(self.GOOD, form.format(vertex), self.GOOD)
                text = header + good + bad + good
                line = (header + good + bad).split(vertex)[0].count("\n") + 1
                for kernel in ("scalar", "sse4", "avx2", "avx512"):
                    with self.subTest(tool=tool, form=form, kernel=kernel):
                        done = run(tool, *options, stdin=text, env=os.environ | {"PIPELINE_KERNEL": kernel})
                        self.assert_fails(done, 1, f"{tool}: <stdin>:{line}:{column}: {reason}")

    @staticmethod
    def of_scene(*vertices):
        return "triangle\n" + "\n".join(vertices) + "\n"

    @staticmethod
    def of_stage_text(*vertices):
        return "\n".join(vertices) + "\n\n"

    def test_model(self):
        self.assert_placed("model", header=CAMERA + "scale 1e305 1 1\n", frame=self.of_scene, x="12345.5",
                           reason=f"{IN_RANGE}, found an overflow of its x")

    def test_view(self):
        # Turned by 180 degrees about y, then the eye is subtracted: 1.7e308 + 1.7e308.
        self.assert_placed("view", header="eye 1.7e308 0 0\nlook 1.7e308 0 1\nup 0 1 0\n",
                           frame=self.of_stage_text, x="-1.7e308",
                           reason=f"{IN_RANGE}, found an overflow of its x")

    def test_project(self):
        # 1 / tan(1e-305 degrees / 2) is 1.1e307.
        self.assert_placed("project", header="perspective 1e-305 1 1 9\n", frame=self.of_stage_text,
                           x="99999.5", reason=f"{IN_RANGE}, found an overflow of its x")

    def test_project_without_clipping(self):
        for form, column in self.LINES:
            text = self.of_stage_text(*3 * (self.GOOD,)) * 1000 + self.of_stage_text(
                self.GOOD, self.GOOD, form.format("1 1 2.50"))
            with self.subTest(form=form):
                done = run("project", "--clip", "none", "--perspective", 60, 1, 1, 9, stdin=text)
                self.assert_fails(done, 1, f"project: <stdin>:4003:{column}: {IN_FRONT}, found z = 2.5")

    def test_the_columns_that_follow_a_vertex_change_nothing(self):
        text = CAMERA + "color 1 2 3\nscale 1 1e305 1\ntriangle\n0 0 0\n  0 99999.5 0\n0 0 0\nend\n"
        for scene in (text, text.replace("99999.5 0\n", "999995e-1 0\n")):
            self.assert_fails(run("model", stdin=scene), 1,
                              f"model: <stdin>:9:3: {IN_RANGE}, found an overflow of its y")

    def test_a_vertex_on_the_line_of_its_triangle(self):
        scene = CAMERA + "scale 1 1 1e305\n  triangle\t 0 0 99999.5\n0 0 0\n0 0 0\nend\n"
        self.assert_fails(run("model", stdin=scene), 1,
                          f"model: <stdin>:6:13: {IN_RANGE}, found an overflow of its z")

    def test_digits_that_are_not_certain(self):
        # 1e30 is added before a rotation and subtracted after it: none of 31 digits is left.
        scene = (
            CAMERA +
            "translate 1e30 0 0\nrotate 33 1 2 3\ntranslate -1e30 0 0\ntriangle\n  1 2 3\n4 5 6\n7 8 8\nend\n"
        )
        done = run("model", stdin=scene)
        self.assertEqual(
            (done.stderr.decode(), done.returncode),
            ("model: note: <stdin>:9:3: the digits of this vertex and of 2 more are not certain: "
             "numbers cancel here beyond 31 digits\n", 0))

    def test_digits_that_are_not_certain_are_counted(self):
        lost = "push\ntranslate 1e31 0 0\nrotate 120 1 1 1\nrotate 240 1 1 1\ntranslate -1e31 0 0\n"
        lights = "light 1 2 3 1 1 1\n"
        triangles = "triangle\n1 2 3\n4 5 6\n7 8 10\n"
        beyond = "are not certain: numbers cancel here beyond 31 digits\n"
        for text, notes in (
            (lost + lights + "pop\n" + triangles, [f"10:7: the digits of this light {beyond}"]),
            (lost + 3 * lights + "pop\n" + triangles, [
                f"10:7: the digits of this light and of 2 more {beyond}"]),
            (triangles + lost + "scale 0 0 1\ntriangle\n0 0 0\n1 0 0\n0 1 0\npop\n", [
                f"16:1: the digits of this vertex and of 2 more {beyond}"]),
                # Enough for more than one part of a text; what stands behind it takes the parts back.
            (lost + lights + 3000 * triangles + "pop\n" + triangles, [
                f"10:7: the digits of this light {beyond}",
                f"12:1: the digits of this vertex and of 8999 more {beyond}"])):
            with self.subTest(notes=notes):
                done = run("model", "--digits", "exact", stdin=CAMERA + text + "end\n")
                self.assertEqual((done.stderr.decode(), done.returncode),
                                 ("".join("model: note: <stdin>:" + note for note in notes), 0))

    def test_the_digits_of_one_vertex(self):
        # Cut at w = 1e-20: one cut lies on the axis, of the other's x no digit is right.
        done = run("project", "--clip", "near", "--perspective", 90, 1, "1e-20", 10,
                   stdin="0 0 -2\n0 0 2\n 1 0 1\n")
        self.assertEqual(
            (done.stderr.decode(), done.returncode),
            ("project: note: <stdin>:3:2: the digits of this vertex are not certain: numbers cancel here "
             "beyond 31 digits\n", 0))

    def test_digits_of_a_light_in_view_space(self):
        text = "eye -1e34 0.5 1e32\nlook 0 5 9\nup 0 1 0\n  light 1 2 3 1 1 1\n"
        done = run("view", stdin=text)
        self.assertEqual(
            (done.stderr.decode(), done.returncode),
            ("view: note: <stdin>:4:9: the digits of this light are not certain: numbers cancel here beyond "
             "31 digits\n", 0))

    def test_no_sample_has_digits_that_are_not_certain(self):
        scenes = sorted(SOURCE.glob("samples/*/scene.txt"))
        self.assertGreaterEqual(len(scenes), 8)
        for scene in scenes:
            for digits in ("7", "9", "exact"):
                text = scene.read_bytes()
                for stage in ("model", "view", "project"):
                    done = run(stage, "--digits", digits, stdin=text)
                    text = done.stdout
                    self.assertNotIn(b"certain", done.stderr, f"{stage} --digits {digits} {scene}")
                    self.assertEqual(done.returncode, 0)

    def test_a_window_of_a_lit_perspective_has_to_fit_a_double(self):
        text = "perspective 179.9999999999 1 1e305 1e306\nlight 0 0 0 1 1 1\n"
        self.assert_fails(
            run("project", stdin=text), 1,
            "project: <stdin>:1:13: expected a perspective whose window is within a double's range, found an "
            "overflow of its width")


class ConfigMessages(ToolTest):
    def check(self, config, message):
        pathlib.Path("config.txt").write_text(config)
        self.assert_fails(run("zbuf", "config.txt"), 1, "zbuf: config.txt:" + message)
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])


add_claims(ConfigMessages, [
    ("nothing follows the limits", "8 8\n-1\n-1\n0 1\n5\n",
     "5:1: expected nothing after the limits of Z, found '5'"),])


class DepthFormatMessages(ToolTest):
    def check(self, words, message):
        depth, front, rear = words.split()
        pathlib.Path("config.txt").write_text(f"8 8\n-1\n-1\n{front} {rear}\n")
        for options in ([], ["--algorithm", "scanline"], ["--probe", "1,1"]):
            done = run("zbuf", "config.txt", "--depth", depth, *options)
            self.assert_fails(done, 2,
                              f"zbuf: --depth {depth}: expected limits of Z {message} (try zbuf --help)")
            self.assertEqual(self.files(), ["config.txt", "scene.txt"])


FLOAT = "from -3.4028235e+38 to 3.4028235e+38"
APART = "1e-300 to 1.7976931e+308 apart"
add_claims(DepthFormatMessages, [
    ("the front limit is a float", "f32 -1e308 1", f"{FLOAT}, found -1e+308 and 1"),
    ("the rear limit is a float", "f32 -1 3.4028236e38", f"{FLOAT}, found -1 and 3.4028236e+38"),
    ("the limits are two floats", "f32 1 1.00000001",
     "that are two different floats, found 1 and 1.00000001"),
    ("a float may underflow to the other limit", "f32 0 1e-46",
     "that are two different floats, found 0 and 1e-46"),
    ("24 bits need a distance of the limits", "u24 -1e308 1e308", f"{APART}, found -1e+308 and 1e+308"),
    ("24 bits need a distance that can be divided", "u24 0 9.9e-301", f"{APART}, found 0 and 9.9e-301"),])


class OptionMessages(ToolTest):
    def check(self, words, message):
        tool, *options = words.split()
        self.assert_fails(run(tool, *options), 2, f"{tool}: {message} (try {tool} --help)")


OLD_NAMES = (
    *((tool, "--threads", "one thread does the work") for tool in ("model", "view", "project")),
    *((tool, "--framed", "now --expect-framed") for tool in ("zbuf", "trace", "join-seen")),
    ("mesh2scene", "--up", "now --up-axis"),
)
DIGITS = "--digits: expected a number of decimals from 0 to 17, or exact"
add_claims(OptionMessages, [
    ("model knows its options", "model --bogus", "expected an option of model, found '--bogus'"),
    ("view knows its options", "view --framed", "expected an option of view, found '--framed'"),
    ("project knows its options", "project --bare", "expected an option of project, found '--bare'"),
    ("misspelled options with a value are guessed", "model --digit=exact",
     "expected an option of model, found '--digit=exact' (did you mean --digits?)"),
    ("options are in lower case", "view --Eye 1 2 3",
     "expected an option of view, found '--Eye' (did you mean --eye?)"),
    *((f"{tool} names what {option} is now", f"{tool} {option} 1 scene.txt",
       f"expected an option of {tool}, found '{option}' ({now})")
      for tool, option, now in OLD_NAMES if (BIN / tool).exists()),
    ("short options are no options either", "model -x", "expected an option of model, found '-x'"),
    ("options are not abbreviated", "model --dig 3", "expected an option of model, found '--dig'"),
    ("zbuf takes two operands", "zbuf config.txt a b", "expected no further operand, found 'b'"),
    ("a size is one word", "zbuf --size 400 300",
     "--size: expected WIDTHxHEIGHT in pixels, such as 400x300, found '400'"),
    ("image and depths are not both stdout", "zbuf config.txt -o - --z-buffer -",
     "--z-buffer: expected a file or none, as the image is standard output, found '-'"),
    *((f"counts of {tool} are not written among its data", f"{tool} --stats -",
       "--stats: expected a file, as standard output carries the data (/dev/stderr shows them), found '-'")
      for tool in ("model", "view", "project", "zbuf", "trace") if (BIN / tool).exists()),
    ("a background has six digits", "zbuf config.txt --background ff800",
     "--background: expected RRGGBB or RRGGBBAA, hexadecimal digits, found 'ff800'"),
    ("the digits of a background are hexadecimal", "zbuf config.txt --background ff80g0",
     "--background: expected RRGGBB or RRGGBBAA, hexadecimal digits, found 'ff80g0'"),
    ("digits are a number", "model --digits many", f"{DIGITS}, found 'many'"),
    ("digits are at most 17", "view --digits 18", f"{DIGITS}, found '18'"),
    ("digits are not negative", "project --digits -1", f"{DIGITS}, found '-1'"),
    ("digits have a value", "model --digits", "--digits: expected one value (N|exact), found none"),
    ("digits are said once", "model --digits 1 --digits 2",
     "--digits: expected one value (N|exact), found 2"),
    ("precision is a known word", "view --precision best",
     "--precision: expected double or extended, found 'best'"),
    ("bare has no value", "view --bare=no-thanks", "--bare: expected no value, found 'no-thanks'"),
    ("bare text has no frame", "model --bare --framed", "expected --bare or --framed, found both"),
    ("aspect is a known word", "project --aspect wide", "--aspect: expected angle or ratio, found 'wide'"),
    ("clip is a known word", "project --clip all",
     "--clip: expected auto, near, frustum, reject or none, found 'all'"),
    ("cull is a known word", "project --cull both", "--cull: expected back or front, found 'both'"),
    ("cull has a value", "project --cull", "--cull: expected one value (back|front), found none"),
    ("coverage is a known word", "zbuf config.txt --coverage best",
     "--coverage: expected nearest or center, found 'best'"),
    ("algorithm is a known word", "zbuf config.txt --algorithm best",
     "--algorithm: expected zbuffer or scanline, found 'best'"),
    ("depth is a known word", "zbuf config.txt --depth best",
     "--depth: expected f64, f32 or u24, found 'best'"),
    ("an image has an extension", "zbuf config.txt --image out",
     "--image: out: expected an image file that ends in .bmp, .ppm or .png, found a name without extension"),
    ("an image of depths has a known format", "zbuf config.txt --depth-image d.bmp",
     "--depth-image: d.bmp: expected a depth image file that ends in .pgm or .png, found '.bmp'"),
    ("there are at most 256 threads", "zbuf config.txt --threads 257",
     "--threads: expected a whole number from 0 to 256, found '257'"),
    ("threads are a number", "zbuf --threads two",
     "--threads: expected a whole number from 0 to 256, found 'two'"),
    ("threads are whole", "zbuf --threads 2.0",
     "--threads: expected a whole number from 0 to 256, found '2.0'"),
    ("threads have a value", "zbuf --threads", "--threads: expected one value (N), found none"),
    ("samples are counted", "zbuf config.txt --samples 17",
     "--samples: expected a whole number from 1 to 16, found '17'"),
    ("rows in turn take one thread", "zbuf config.txt --algorithm scanline --threads 2",
     "--threads: expected 1 with --algorithm scanline, which goes through the rows in turn, found '2'"),
    ("an epsilon is not negative", "zbuf config.txt --depth-epsilon -1",
     "--depth-epsilon: expected a number of at least 0, found '-1'"),
    ("a probe lies in the picture", "zbuf config.txt --probe 8,7",
     "--probe: expected COLUMN,ROW, from 0,0 to 7,7, found '8,7'"),
    ("a probe has a row", "zbuf config.txt --probe 1",
     "--probe: expected COLUMN,ROW, from 0,0 to 7,7, found '1'"),
    ("an inset is below 1", "project --clip near --clip-inset 1",
     "--clip-inset: expected a number from 0 to less than 1, found '1'"),
    ("an inset is not negative", "project --clip near --clip-inset=-0.1",
     "--clip-inset: expected a number from 0 to less than 1, found '-0.1'"),
    ("an inset needs planes", "project --clip-inset 0.1",
     "--clip-inset: expected --clip near, frustum or reject with it, found none of these"),
    ("config and input are not both stdin", "zbuf -",
     "CONFIG: expected a file, as INPUT is standard input, found '-'"),
    ("an eye has three numbers", "view --eye 1 2 --up 0 1 0", "--eye: expected 3 values (X Y Z), found 2"),
    ("an eye has only three numbers", "view --eye 1 2 3 --eye 1 2 3",
     "--eye: expected 3 values (X Y Z), found 6"),
    ("an eye has numbers", "view --eye 1 2 3x", "--eye: expected the z of the eye, found '3x'"),
    ("look has numbers", "view --look nan 2 3", "--look: expected the x of the point looked at, found 'nan'"),
    ("up is not zero", "view --up 0 0 0", "--up: expected an up direction, found 0 0 0"),
    ("options make a camera", "view --eye 1 2 3 --look 1 2 3",
     "--look: expected a point other than the eye to look at, found 1 2 3"),
    ("a perspective has four numbers", "project --perspective 60 1 1",
     "--perspective: expected 4 values (FOVY ASPECT NEAR FAR), found 3"),
    ("a perspective makes sense", "project --perspective 60 1 9 1",
     "--perspective: expected far beyond near, found '1'"),
    ("a perspective of an option has a fovX", "project --perspective 90 2 1 9",
     "--perspective: expected fovX = fovY * aspect above 0 and below 180 degrees (or --aspect ratio; in a "
     "scene, the word ratio at the end), found 90 * 2"),
    ("a frustum has a near above 0", "view --frustum -1 1 -1 1 0 9",
     "--frustum: expected near above 0, found '0'"),
    ("an ortho has six numbers", "view --ortho -1 1 -1 1 0",
     "--ortho: expected 6 values (L R B T N F), found 5"),
    ("there is one projection among the options", "project --perspective 60 1 1 9 --ortho -1 1 -1 1 1 9",
     "--perspective: expected one projection, found a second one after --ortho"),])


class FileMessages(ToolTest):
    def check(self, words, message):
        tool, *options = words.split()
        self.assert_fails(run(tool, *options), 1, f"{tool}: {message}")


add_claims(FileMessages, [
    ("an input that is missing is named by model", "model none.txt",
     "cannot open none.txt: No such file or directory"),
    ("a config that is missing is named", "zbuf none.txt", "cannot open none.txt: No such file or directory"),
    ("a size is no config", "zbuf 400x300",
     "cannot open 400x300: No such file or directory (did you mean --size 400x300?)"),
    ("an input may be a folder", "model .", "cannot read .: Is a directory"),
    ("a folder of the image may be missing", "zbuf config.txt --image no/out.bmp",
     "cannot open no/out.bmp: No such file or directory"),
    ("a folder of the depths may be missing", "zbuf config.txt --z-buffer no/z.txt",
     "cannot open no/z.txt: No such file or directory"),])


class SizeMessages(ToolTest):
    def test_a_bmp_is_below_4_gib(self):
        # Rows of 3 * 40000 bytes: 54 + 120000 * 40000.
        pathlib.Path("config.txt").write_text("40000 40000\n")
        expected = ("expected an image that fits into the 4 GiB of a .bmp file (--image FILE.ppm has no such "
                    "limit), ")
        for options, name in ([], "out.bmp"), (["--image", "wide.BMP"], "wide.BMP"):
            for algorithm in "zbuffer", "scanline":
                done = run("zbuf", "config.txt", *options, "--algorithm", algorithm)
                self.assert_fails(done, 1,
                                  f"zbuf: {name}: {expected}found 40000 x 40000 pixels, 4800000054 bytes")
                self.assertEqual(self.files(), ["config.txt", "scene.txt"])


class OneLine(ToolTest):
    def test_a_message_stays_on_its_line_whatever_a_file_is_called(self):
        self.assert_fails(run("model", "a\nb"), 1, "model: cannot open a\\x0ab: No such file or directory")

    def test_an_empty_file_name_is_shown(self):
        self.assert_fails(run("model", ""), 1, "model: cannot open '': No such file or directory")
        for tool, option in (("zbuf", "--certify"), ("zbuf", "--z-buffer"), ("project", "--scene"),
                             ("view", "--stats")):
            self.assert_fails(run(tool, option, ""), 2,
                              f"{tool}: {option}: expected a file's name, found nothing (try {tool} --help)")

    def test_a_mistake_behind_the_first_block_is_found_on_its_line(self):
        text = CAMERA + TRIANGLE * 20000 + "triangle 0 0 0\n0 0 x\n"
        self.assert_fails(run("model", stdin=text), 1,
                          "model: <stdin>:80006:5: expected the z of vertex 2 of 3, found 'x'")


if __name__ == "__main__":
    unittest.main()
