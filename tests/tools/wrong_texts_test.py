#!/usr/bin/env python3
"""A text in the wrong place is refused by its name: a stage was left out, or the text is none of a stage.

usage: wrong_texts_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import subprocess
import unittest

from toolbox import CAMERA, NO_TRIANGLE, SCENE, TRIANGLE, ToolTest, add_claims, command, pipe, run

A_MODEL = ("expected a scene, but this looks like a model file: 'pipeline picture' draws it, mesh2scene "
           "makes a scene of it")

LIT = CAMERA + "light 0 0 5 1 1 1\n" + TRIANGLE + "end\n"
COLORED = CAMERA + "color 1 2 3\n" + TRIANGLE + "end\n"
NOT_VIEWED = "this text has not been through view; a view of your own must drop the lines eye, look and up"
NOT_VIEWED_AND_PROJECTED = ("this text has not been through view and project; stages of your own must drop "
                            "the camera's lines")
NOT_PROJECTED = "this text has not been through project; a project of your own must drop this line"
PROJECTED = "this text has been through project already"
WITH_W = "expected a text that is not projected yet, found one with the column 'w', which project adds"
CAMERA_FORM = "a camera (header lines eye, look and up; or --scene; or --eye, --look and --up)"
PROJECTION_FORM = ("a projection (a header line perspective, frustum or ortho; or --scene; or --perspective, "
                   "--frustum or --ortho)")
OPERANDS = {"model": [], "view": [], "project": [], "zbuf": ["config.txt"]}


class ForgottenStages(ToolTest):
    def check(self, scene, stages, message):
        """All stages but the last succeed; the last one refuses their text. Pictures are not made."""
        *before, last = stages.split()
        text = pipe(*([tool] for tool in before), stdin=scene)
        done = run(last, *OPERANDS[last], stdin=text)
        self.assert_fails(done, 1, f"{last}: <stdin>:{message}")
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])


add_claims(ForgottenStages, [
    ("view is forgotten, or comes after project", SCENE, "model project",
     f"1:1: expected the output of view, found 'eye': {NOT_VIEWED}"),
    ("view and project are forgotten", SCENE, "model zbuf",
     f"1:1: expected the output of project, found 'eye': {NOT_VIEWED_AND_PROJECTED}"),
    ("project is forgotten", SCENE, "model view zbuf",
     f"1:1: expected the output of project, found 'perspective': {NOT_PROJECTED}"),
    ("an ortho is a projection", SCENE.replace("60 1 1 100", "ortho -1 1 -1 1 1 9"), "model view zbuf",
     f"1:1: expected the output of project, found 'ortho': {NOT_PROJECTED}"),
    ("a frustum is a projection", SCENE.replace("60 1 1 100", "frustum -1 1 -1 1 1 9"), "model view zbuf",
     f"1:1: expected the output of project, found 'frustum': {NOT_PROJECTED}"),
    ("project is forgotten where there is light", LIT, "model view zbuf",
     "1:1: expected the output of project, found 'perspective': this text has not been through project; a "
     "project of your own must "
     "write 'projected frustum L R B T N F' (or ortho) in its place"),
    ("model is run twice", SCENE, "model model",
     "1:1: expected a scene, but this looks like the output of model: view reads that"),
    ("view is run twice", SCENE, "model view view",
     f"2:1: expected {CAMERA_FORM}, found no eye, look or up: this text has been through view already"),
    ("project is run twice", SCENE, "model view project project",
     f"1:1: expected {PROJECTION_FORM}, found none: this text is bare, or has been through project already"),
    ("project is run twice where there is light", LIT, "model view project project",
     f"1:1: expected the output of view, found 'projected': {PROJECTED}"),
    ("project is run twice where there is color", COLORED, "model view project project", f"1:12: {WITH_W}"),
    ("view comes after project", SCENE, "model view project view",
     f"1:1: expected {CAMERA_FORM}, found no eye, look or up: this text is bare, or has been through "
     f"project already"),
    ("view comes after project where there is light", LIT, "model view project view",
     f"1:1: expected the output of model, found 'projected': {PROJECTED}"),
    ("view comes after project where there is color", COLORED, "model view project view", f"1:12: {WITH_W}"),
    ("model comes after view", SCENE, "model view model",
     "1:1: expected a scene, but this looks like the output of view: project reads that"),
    ("model comes after project where there is light", LIT, "model view project model",
     "1:1: expected a scene, but this looks like the output of project: zbuf reads that"),
    ("model comes after project where there is color", COLORED, "model view project model",
     "1:1: expected a scene, but this looks like the output of project: zbuf reads that"),
    ("a scene goes to view", SCENE, "view",
     "1:1: expected the output of model, but this looks like a scene: model reads those"),
    ("a scene goes to project", SCENE, "project",
     "1:1: expected the output of view, but this looks like a scene: model reads those"),
    ("a scene goes to zbuf", SCENE, "zbuf",
     "1:1: expected the output of project, but this looks like a scene: model reads those"),
    ("an OBJ file goes to model", "# made by hand\no tent\nv 0 0 0\n", "model", "2:1: " + A_MODEL),
    ("an OBJ file of vertices goes to model", "v 0 0 0\nv 1 0 0\n", "model", "1:1: " + A_MODEL),
    ("a PLY file goes to model", "ply\nformat ascii 1.0\n", "model", "1:1: " + A_MODEL),
    ("an STL file goes to model", "solid cube\n facet normal 0 0 1\n", "model", "1:1: " + A_MODEL),
    ("a glTF file goes to model", '{"asset": {"version": "2.0"}}', "model", "1:1: " + A_MODEL),
    ("a binary glTF file goes to model", "glTF\x02\0\0\0", "model", "1:1: " + A_MODEL),
    ("a config goes to model", "8 8\n-1\n-1\n-1 1\n", "model",
     "1:1: expected a scene, but this looks like a config: zbuf reads those"),
    ("a short config goes to view", "8 8", "view",
     "1:1: expected the output of model, but this looks like a config: zbuf reads those"),])


class Lines(ToolTest):
    """A header line that does not belong there is found wherever it stands in the header."""
    def check(self, tool, options, text, message):
        done = run(tool, *options.split(), stdin=text)
        self.assert_fails(done, 1, f"{tool}: <stdin>:{message}")


add_claims(Lines, [
    ("look alone", "project", "", "perspective 60 1 1 9\n look 0 0 0\n",
     f"2:2: expected the output of view, found 'look': {NOT_VIEWED}"),
    ("up alone", "project", "", "# c\n\nup 0 1 0\n",
     f"3:1: expected the output of view, found 'up': {NOT_VIEWED}"),
    ("a projection of the options changes nothing", "project", "--perspective 60 1 1 9", "eye 0 0 0\n",
     f"1:1: expected the output of view, found 'eye': {NOT_VIEWED}"),
    ("a frame changes nothing", "project", "", "framed\neye 0 0 0\nend\n",
     f"2:1: expected the output of view, found 'eye': {NOT_VIEWED}"),
    ("a camera of the options changes nothing", "view", "--eye 0 0 5 --look 0 0 0 --up 0 1 0",
     "projected ortho -1 1 -1 1 1 9\n", f"1:1: expected the output of model, found 'projected': {PROJECTED}"),
    ("after attributes", "zbuf", "config.txt", "attributes w color\nperspective 60 1 1 9\n",
     f"2:1: expected the output of project, found 'perspective': {NOT_PROJECTED}"),
    ("lights need to be projected, lit or not", "zbuf", "config.txt --shading none", "light 0 0 5 1 1 1\n",
     "2:1: expected a header line 'projected frustum L R B T N F' (or ortho) in a text with lights, found "
     "none: this text has not been "
     "through project"),
    ("projected stands once", "zbuf", "config.txt",
     "projected ortho -1 1 -1 1 1 9\nprojected frustum -1 1 -1 1 1 9\n",
     "2:1: expected one 'projected', found a second one after <stdin>:1:17"),
    ("projected has a frustum or an ortho", "zbuf", "config.txt", "projected perspective 60 1 1 9\n",
     "1:11: expected frustum or ortho, found 'perspective'"),
    ("projected does not stand alone", "zbuf", "config.txt", "projected\n",
     "1:10: expected frustum or ortho, found the end of the line"),
    ("what was projected has six planes", "zbuf", "config.txt", "projected frustum -1 1 -1 1 1\n",
     "1:30: expected far, found the end of the line"),
    ("projected stands in the header", "zbuf", "config.txt",
     "0 0 0\n1 0 0\n0 1 0\n\nprojected ortho -1 1 -1 1 1 9\n",
     "5:1: expected header lines before the first triangle, found 'projected'"),])


class Recognized(ToolTest):
    """Some of what a beginning may look like, and what is no sign of anything."""
    def check(self, tool, text, message):
        pathlib.Path("text").write_bytes(text.encode() if isinstance(text, str) else text)
        self.assert_fails(run(tool, *OPERANDS[tool], "text"), 1, f"{tool}: text:{message}")


A_SCENE = "1:1: expected the output of model, but this looks like a scene: model reads those"
add_claims(Recognized, [
    ("a scene without triangles", "view", CAMERA + "end\n", A_SCENE),
    ("a scene with a byte order mark and carriage returns", "view", "\ufeff" + SCENE.replace("\n", "\r\n"),
     A_SCENE),
    ("a scene behind comments and blank lines", "view", "# a scene\n\n\n" + SCENE.replace("\n", " # c\n"),
     "4" + A_SCENE[1:]),
    ("an orthographic scene", "view", SCENE.replace("60 1 1 100", "ortho -1 1 -1 1 1 9"), A_SCENE),
    ("a scene without its projection", "view", SCENE.replace("60 1 1 100\n", ""), A_SCENE),
    ("a scene without its camera", "view", "translate 1 0 0\n" + TRIANGLE, A_SCENE),
    ("a triangle with its vertex beside it", "view", "triangle 0 0 0\n1 0 0\n0 1 0\n", A_SCENE),
    ("triangle N is of a stage text", "view", "triangle 7\n1 0 0\n0 1 0\n0 0 1\n",
     f"1:1: expected {CAMERA_FORM}, found no eye, look or up: this text is bare, or has been through "
     f"project already"),
    ("an empty text is nothing", "project", "", f"1:1: expected {PROJECTION_FORM}, found none"),
    ("a config of nothing is none", "model", "0 0\n",
     "1:4: expected the z of the eye, found the end of the line"),
    ("a point that lacks a number makes no config", "model", "8 8\n0 0 0\n0 1 0\n60 1 1 100\n",
     "1:4: expected the z of the eye, found the end of the line"),
    ("lights do not tell a stage text from a scene without its camera", "model",
     "light 0 0 5 1 1 1\n" + TRIANGLE, "1:1: expected the x of the eye, found 'light'"),
    ("an error line says more", "project", "eye 0 0 5\nlook 0 0 0\nerror model: no scene\n",
     "3:1: an earlier stage failed: model: no scene"),
    ("a framed text is known behind its frame", "model", "framed\neye 0 0 5\n",
     "1:1: expected a scene, but this looks like the output of model: view reads that"),])


class Configs(ToolTest):
    def check(self, text, message):
        pathlib.Path("text").write_text(text)
        self.assert_fails(run("zbuf", "text", "scene.txt"), 1,
                          "zbuf: text:1:1: expected a config, but this looks like " + message)


add_claims(Configs, [
    ("a scene is no config", SCENE, "a scene: model reads those"),
    ("the output of model is no config", "eye 0 0 5\n", "the output of model: view reads that"),
    ("the output of view is no config", "perspective 60 1 1 9\n", "the output of view: project reads that"),
    ("the output of project is no config", "projected ortho -1 1 -1 1 1 9\n",
     "the output of project: is the config before it missing?"),
    ("config and input are in their order", "0 0 0.5\n1 0 0.5\n0 1 0.5\n\n0 0 0.5\n",
     "triangles: CONFIG comes before INPUT"),])


class Unlike(ToolTest):
    def test_a_scene_as_camera_is_a_scene(self):
        pathlib.Path("stage1.txt").write_bytes(pipe(["model"]))
        for tool in ("view", "project"):
            self.assert_fails(
                run(tool, "--scene", "stage1.txt", stdin="0 0 0\n"), 1,
                f"{tool}: stage1.txt:1:1: expected a scene, but this looks like the output of model: view "
                f"reads that")

    def test_text_without_a_header_is_taken_as_it_reads(self):
        text = pipe(["model", "--bare"], ["view", "--bare", "--scene", "scene.txt"])
        view = pipe(["view", "--perspective", "60", "1", "1", "100"],
                    stdin="eye 0 0 5\nlook 0 0 0\nup 0 1 0\n" + text.decode())
        self.assertTrue(view.startswith(b"perspective 60 1 1 100\n"))
        for tool, *options in (["project", "--scene", "scene.txt"], ["zbuf", "config.txt"]):
            done = run(tool, *options, stdin=text)
            self.assert_quiet_success(done)
            text = done.stdout

    def test_a_bare_text_passes_every_stage_twice(self):
        text = pipe(["view", "--bare", "--scene", "scene.txt"], ["view", "--bare", "--scene", "scene.txt"],
                    ["project", "--scene", "scene.txt"], stdin=pipe(["model", "--bare"]))
        self.assert_quiet_success(run("zbuf", "config.txt", stdin=text))

    def test_a_stage_does_not_wait_for_more_than_a_line(self):
        with subprocess.Popen(command("view"), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as waiting:
            waiting.stdin.write(b"0 0 5\n")
            waiting.stdin.flush()
            self.assertEqual(waiting.wait(60), 1)
            self.assertIn(b"found no eye, look or up", waiting.stderr.read())

    def test_a_scene_that_comes_line_by_line_is_none_the_less_read(self):
        with subprocess.Popen(command("model", "--bare"), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as slow:
            for line in SCENE.splitlines(keepends=True):
                for part in (line[:2], line[2:]):
                    slow.stdin.write(part.encode())
                    slow.stdin.flush()
            out, err = slow.communicate(timeout=60)
        self.assertEqual((out, err), (pipe(["model", "--bare"]), b""))


# What Vim 9.0 writes into a pipe that it is given to edit, shortened; the second as on a terminal of type
# dumb.
VIM = (b"\x1b[?106;1000h\x1b[?1002h\x1b[?1049h\x1b[22;0;0t\x1b[>4;2m\x1b[?1h\x1b="
       b"\x1b[?2004h\x1b[1;24r\x1b[2;1H\x1b[1m~          \x1b[3;1H~",
       b"\x0c\x1b[2;1H~                    \x1b[3;1H~                 ")


class AnotherView(ToolTest):
    MESSAGE = "but this looks like an editor's screen: was Vim's view run in place of ours?"

    def test_its_screen_is_recognized(self):
        for screen in VIM:
            for end in (b"", b"\r\n", b"\n0 0 0\n"):
                self.assert_fails(run("project", stdin=screen + end), 1,
                                  f"project: <stdin>:1:1: expected the output of view, {self.MESSAGE}")
                self.assert_fails(run("zbuf", "config.txt", stdin=screen + end), 1,
                                  f"zbuf: <stdin>:1:1: expected the output of project, {self.MESSAGE}")

    def test_a_comment_may_be_colored(self):
        done = run("zbuf", "config.txt", stdin="# \x1b[31mred\x1b[0m\n")
        self.assertEqual((done.stderr.decode(), done.returncode), (NO_TRIANGLE, 0))


if __name__ == "__main__":
    unittest.main()
