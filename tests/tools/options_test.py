#!/usr/bin/env python3
"""The tools' operands and options, and what --help says. The pack asks for the forms of texts and the camera.

usage: options_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import re
import subprocess
import unittest

from toolbox import (ALL_TOOLS, BIN, CAMERA, HEADER, HEADERS, SCENE, SOURCE, ToolTest, pipe, run, stage_texts,
                     tool_inputs)

PLAIN = """1 2 6
1 0.5 0
0 1 0
60 1.5 1 100
translate
0.25 0 -1
push
rotate
30 1 2 3
triangle
0 0 0
1 0 0
0 1 0
pop
scale
2 2 2
triangle
0 0 1
-1 0 1
0 -1 1
end
"""
VIEW_SPACE = "0 0 -2\n1 0 -2\n0 1 -3\n\n"
OPERANDS = {"model": [], "view": [], "project": [], "zbuf": ["config.txt"]}
INPUTS = {"model": SCENE, "view": HEADER, "project": HEADERS["project"], "zbuf": ""}


class Locale(ToolTest):
    def test_a_decimal_comma_of_the_locale_changes_nothing(self):
        environment = dict(os.environ, LC_ALL="de_DE.UTF-8")
        if subprocess.run(["locale", "decimal_point"], capture_output=True, text=True,
                          env=environment).stdout != ",\n":
            self.skipTest("the locale de_DE.UTF-8 is not installed")
        texts = []
        for name in ("C", "de_DE.UTF-8"):
            environment = dict(os.environ, LC_ALL=name)
            texts.append(
                pipe(["model"], ["view"], ["project"], ["zbuf", "config.txt"], stdin=PLAIN, env=environment))
        self.assertEqual(*texts)


class Operands(ToolTest):
    def test_the_input_may_be_a_file(self):
        for tool, text in INPUTS.items():
            pathlib.Path("input.txt").write_text(text)
            self.assertEqual(pipe([tool, *OPERANDS[tool], "input.txt"], stdin="nonsense"),
                             pipe([tool, *OPERANDS[tool]], stdin=text))

    def test_a_dash_is_standard_input(self):
        for tool, text in INPUTS.items():
            self.assertEqual(pipe([tool, *OPERANDS[tool], "-"], stdin=text),
                             pipe([tool, *OPERANDS[tool]], stdin=text))

    def test_options_may_stand_behind_operands(self):
        self.assertEqual(pipe(["model", "scene.txt", "--digits", "2"]),
                         pipe(["model", "--digits", "2", "scene.txt"]))

    def test_options_may_be_joined_to_their_value(self):
        self.assertEqual(pipe(["model", "--digits=exact"]), pipe(["model", "--digits", "exact"]))

    def test_behind_two_dashes_there_are_only_operands(self):
        pathlib.Path("--bare").write_text(SCENE)
        self.assertEqual(pipe(["model", "--", "--bare"]), pipe(["model"]))

    def test_the_config_may_be_standard_input(self):
        pathlib.Path("stage3.txt").write_bytes(stage_texts()[2])
        self.assertEqual(pipe(["zbuf", "-", "stage3.txt"], stdin="8 8\n"),
                         pipe(["zbuf", "config.txt", "stage3.txt"]))


class Answers(ToolTest):
    def test_help_goes_to_stdout(self):
        for tool in ALL_TOOLS:
            for option in ("--help", "-h"):
                done = run(tool, option)
                self.assert_quiet_success(done)
                self.assertIn(f"Usage: {tool} ".encode(), done.stdout)

    def test_help_names_every_option_of_the_tool(self):
        common = ["--help", "--version", "--timing"]
        stage = ["--digits N|exact", "--precision double|extended"]
        projection = [
            "--perspective FOVY ASPECT NEAR FAR", "--frustum L R B T N F", "--ortho L R B T N F",
            "--scene FILE"]
        words = {
            "model": stage + ["--bare", "--framed"],
            "view": stage + projection + ["--bare", "--eye X Y Z", "--look X Y Z", "--up X Y Z"],
            "project": stage + projection +
            ["--aspect angle|ratio", "--clip auto|near|frustum|reject|none", "--cull back|front"],
            "zbuf": [
                "CONFIG", "--size WIDTHxHEIGHT", "-o,--image FILE", "--z-buffer FILE", "--coverage ",
                "--algorithm ", "--background RRGGBB"],
            "trace": projection + [
                "CONFIG", "--size WIDTHxHEIGHT", "-o,--image FILE", "--z-buffer FILE", "--background RRGGBB",
                "--sampling basic|regular|jittered|adaptive", "--samples N", "--threshold N", "--threads N"],}
        for tool in ALL_TOOLS:
            text = run(tool, "--help-all").stdout.decode()
            for word in common + words[tool]:
                self.assertIn(word, text)

    def test_help_is_of_80_columns_and_begins_with_usage_and_an_example(self):
        for tool, option in itertools.product(ALL_TOOLS, ("--help", "--help-all")):
            text = run(tool, option).stdout.decode()
            wrong = [line for line in text.split("\n") if len(line) > 80 or line != line.rstrip()]
            self.assertEqual(wrong, [])
            self.assertRegex(text, rf"\AUsage: {tool} .*\n( {{7}}{tool} .*\n)?\nExamples?:\n  \w")

    def test_help_without_rare_options_names_the_others_in_the_same_words(self):
        for tool in ALL_TOOLS:
            common, full = (run(tool, option).stdout.decode() for option in ("--help", "--help-all"))
            options = [re.findall(r"^  -.*\n(?: {25}.*\n)*", text, re.M) for text in (common, full)]
            self.assertEqual([option for option in options[1] if option in options[0]], options[0])
            self.assertLess(len(options[0]), len(options[1]))

    def test_help_has_its_options_in_groups(self):
        groups = {
            "model": ["Numbers", "Output"],
            "view": ["Numbers", "Camera", "Light", "Output"],
            "project": ["Numbers", "Projection", "Clipping", "Output"],
            "zbuf": ["Output", "Pixels", "Color and light", "Debugging"],
            "trace": ["Output", "Projection", "Pixels", "Color and light", "Debugging"],}
        for tool in ALL_TOOLS:
            found = re.findall(r"^(\w[\w ]*):$", run(tool, "--help").stdout.decode(), re.M)
            self.assertEqual(found, ["Example", "Operands", *groups[tool], "General"])

    def test_the_examples_of_help_do_what_they_show(self):
        path = f"{BIN}:{os.environ['PATH']}"
        for tool in ALL_TOOLS:
            examples = re.search(r"^Examples:\n((?:  .*\n)+)",
                                 run(tool, "--help-all").stdout.decode(), re.M)[1].splitlines()
            self.assertEqual(len(examples), 2)
            for example in examples:
                with self.subTest(example):
                    for name, text in zip(("stage1.txt", "stage2.txt", "stage3.txt"), stage_texts(PLAIN)):
                        pathlib.Path(name).write_bytes(text)
                    pathlib.Path("scene.txt").write_text(PLAIN)
                    self.assertIn(tool, example)
                    done = subprocess.run(["bash", "-eo", "pipefail", "-c", example], capture_output=True,
                                          env={**os.environ, "PATH": path})
                    self.assert_quiet_success(done)
                    for result in re.findall(r"(?:>|-o) (\S+)", example):
                        self.assertGreater(pathlib.Path(result).stat().st_size, 0)

    def test_help_and_version_read_no_input(self):
        for tool in ALL_TOOLS:
            for option in ("--help", "--version"):
                self.assert_quiet_success(run(tool, option, "none.txt"))

    def test_the_version_is_that_of_the_project(self):
        version = re.search(r"VERSION (\d+\.\d+\.\d+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)
        for tool in ALL_TOOLS:
            done = run(tool, "--version")
            self.assert_quiet_success(done)
            self.assertEqual(done.stdout.decode(), f"{tool} (pipeline) {version}\n")

    def test_timing_is_one_line_on_stderr_and_changes_no_byte(self):
        for tool, operands, text in tool_inputs(PLAIN):
            plain = run(tool, *operands, stdin=text)
            timed = run(tool, *operands, "--timing", stdin=text)
            self.assertEqual((timed.returncode, timed.stdout), (0, plain.stdout))
            self.assertRegex(timed.stderr.decode(), rf"\A{tool}: 2 triangles in \d+\.\d+ s .*\n\Z")

    def test_timing_counts_one_triangle_in_the_singular(self):
        for tool, operands, text in tool_inputs():
            self.assertRegex(
                run(tool, *operands, "--timing", stdin=text).stderr.decode(), rf"\A{tool}: 1 triangle in \d")

    def test_timing_says_nothing_of_a_failed_run(self):
        self.assertNotIn(b"triangles in", run("model", "--timing", stdin="x").stderr)


class OneLightMore(ToolTest):
    def test_it_comes_behind_those_of_the_scene(self):
        triangle = "triangle\n1 2 3\n4 5 6\n7 8 9\nend\n"
        for own in ("", "light 7 8 9 0.5 0.5 0.5\n"):
            added = pipe(["model"], ["view", "--light", "1e2", "-2", ".5", "1", "0", "0.25"],
                         stdin=CAMERA + own + triangle)
            written = pipe(["model"], ["view"], stdin=CAMERA + own + "light 100 -2 0.5 1 0 0.25\n" + triangle)
            self.assertEqual(added, written)

    def test_one_of_the_scene_moves(self):
        triangle = "triangle\n1 2 3\n4 5 6\n7 8 9\nend\n"
        lights = ["light 7 8 9 0.5 0.5 0.5\n", "translate 1 1 1\nlight 1 2 3 1 0 0.25\n"]
        moved = pipe(["model"], ["view", "--light-at", "1", "1e2", "-2", ".5"],
                     stdin=CAMERA + "".join(lights) + triangle)
        lights[1] = "translate 1 1 1\nlight 99 -3 -0.5 1 0 0.25\n"
        self.assertEqual(moved, pipe(["model"], ["view"], stdin=CAMERA + "".join(lights) + triangle))
        for header, number, expected in ((HEADER, "0", "a scene with a light"),
                                         (HEADER + "light 1 2 3 1 1 1\n", "1", "0, the scene's one light"),
                                         (HEADER + "light 1 2 3 1 1 1\n" * 3, "-1", "a light from 0 to 2")):
            self.assert_fails(run("view", "--light-at", number, "1", "2", "3", stdin=header), 2,
                              f"view: --light-at: expected {expected}, found '{number}' (try view --help)")

    def test_it_needs_a_header_and_six_numbers(self):
        self.assert_fails(run("view", "--bare", "--light-at", "0", "1", "2", "3"), 2,
                          "view: expected --bare or --light-at, found both (try view --help)")
        light = ["--light", "1", "2", "3", "1", "1"]
        self.assert_fails(run("view", "--bare", *light, "1"), 2,
                          "view: expected --bare or --light, found both (try view --help)")
        self.assert_fails(
            run("view", *light, "-1", stdin=HEADER), 2,
            "view: --light: expected the blue of the light of at least 0, found '-1' "
            "(try view --help)")


class CameraPrecedence(ToolTest):
    """Options override --scene, and --scene overrides the header, part by part."""
    def view(self, *options, header=""):
        return pipe(["view", "--bare", *options],
                    stdin=header + "1 2 3\n0 0 0\n0 0 0\n\n").decode().splitlines()[0]

    RATIO_SCENE = SCENE.replace("60 1 1 100", "60 1.5 1 100 ratio")

    def test_a_projection_that_is_replaced_loses_its_aspect_rule(self):
        stage1 = pipe(["model"], stdin=self.RATIO_SCENE)
        stage2 = pipe(["view", "--perspective", "60", "1.5", "1", "100"], stdin=stage1)
        self.assertTrue(stage2.startswith(b"perspective 60 1.5 1 100\n"))
        by_angle = pipe(["project"], stdin=stage2)
        self.assertEqual(pipe(["view"], ["project", "--perspective", "60", "1.5", "1", "100"], stdin=stage1),
                         by_angle)
        self.assertEqual(
            pipe(["view"], ["project", "--perspective", "60", "1.5", "1", "100", "--aspect", "ratio"],
                 stdin=stage1), pipe(["view"], ["project"], stdin=stage1))

    def test_the_aspect_rule_of_a_scene_replaces_that_of_the_header(self):
        pathlib.Path("camera.txt").write_text(self.RATIO_SCENE)
        stage1 = pipe(["model"], stdin=self.RATIO_SCENE.replace(" ratio", ""))
        expected = pipe(["model"], ["view"], ["project"], stdin=self.RATIO_SCENE)
        self.assertEqual(pipe(["view", "--scene", "camera.txt"], ["project"], stdin=stage1), expected)
        self.assertEqual(pipe(["view"], ["project", "--scene", "camera.txt"], stdin=stage1), expected)

    def test_an_aspect_rule_changes_no_other_projection(self):
        for words in ("--frustum -1 2 -1 1 1 3", "--ortho -2 2 -3 2 1 3"):
            for rule in ("ratio", "angle"):
                self.assertEqual(pipe(["project", *words.split(), "--aspect", rule], stdin=VIEW_SPACE),
                                 pipe(["project", *words.split()], stdin=VIEW_SPACE))

    def test_negative_numbers_are_values_and_no_options(self):
        expected = self.view(header="eye -1 -2 -5\nlook -0.5 -2 -0.001\nup -0.5 -1 -0\n")
        self.assertEqual(
            self.view("--eye", "-1", "-2", "-5", "--look", "-.5", "-2", "-1e-3", "--up", "-.5", "-1", "-0"),
            expected)


if __name__ == "__main__":
    unittest.main()
