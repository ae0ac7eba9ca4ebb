#!/usr/bin/env python3
"""The tools' input and options: the accepted forms of a text, and the effect of each option.

usage: options_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import subprocess
import unittest

from toolbox import (
    ALL_TOOLS, BIN, CAMERA, HEADER, HEADERS, SCENE, SOURCE, ToolTest, add_claims, pipe, run, stage_texts,
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


class FormsOfAScene(ToolTest):
    def check(self, scene):
        expected = pipe(["model", "--framed"], stdin=PLAIN)
        self.assertEqual(pipe(["model", "--framed"], stdin=scene).decode(), expected.decode())


add_claims(FormsOfAScene, [
    ("lines may end in carriage return and newline", PLAIN.replace("\n", "\r\n")),
    ("blanks may be tabs", PLAIN.replace(" ", "\t")),
    ("blanks may stand around words", re.sub(r"^|$| ", " \t", PLAIN, flags=re.MULTILINE)),
    ("blank lines may stand anywhere", "\n" + PLAIN.replace("\n", "\n \n\n")),
    ("comments may stand anywhere", "# c\n" + PLAIN.replace("\n", " # triangle 1 2 3\n#c\n")),
    ("the last line needs no newline", PLAIN.removesuffix("\n")),
    ("comments may follow the end", PLAIN + "\n# done"),
    ("arguments may stand on the commands line", re.sub(r"(translate|rotate|scale|triangle)\n", r"\1 ",
                                                        PLAIN)),
    ("numbers may have a plus sign", re.sub(r"(^| )(\d)", r"\1+\2", PLAIN, flags=re.MULTILINE)),
    ("numbers may have exponents", re.sub(r"(\d+(\.\d+)?)", r"\1e0", PLAIN)),
    ("numbers may have many zeros",
     re.sub(r"\d+(\.\d+)?", lambda n: "00" + n[0] + ("000" if n[1] else ".000"), PLAIN)),
    ("numbers may lack a zero before the point", PLAIN.replace("0.", ".")),
    ("a byte order mark may stand at the start", "\ufeff" + PLAIN), ])


def with_reversed_header(text):
    lines = text.splitlines(True)
    header = [line for line in lines if line[0].isalpha()]
    return "".join(header[::-1] + lines[len(header):])


class FormsOfStageText(ToolTest):
    def check(self, change):
        for tool, text in zip(("view", "project", "zbuf"), stage_texts(PLAIN)):
            changed = change(text.decode())
            expected = pipe([tool, *OPERANDS[tool]], stdin=text)
            self.assertEqual(pipe([tool, *OPERANDS[tool]], stdin=changed), expected)


add_claims(FormsOfStageText, [
    ("lines may end in carriage return and newline", lambda text: text.replace("\n", "\r\n")),
    ("blanks may be tabs", lambda text: text.replace(" ", "\t ")),
    ("comments may stand anywhere", lambda text: "# c\n" + re.sub(r"(?<=.)\n", " # c\n#c\n", text)),
    ("the last line needs no newline", lambda text: text.rstrip("\n")),
    ("more blank lines may stand between triangles", lambda text: text.replace("\n\n", "\n\n\t\n\n")),
    ("header lines may stand in any order", with_reversed_header),
    ("triangles may say the number they have", lambda text: re.sub(
        r"((?:.+\n){3}\n)((?:.+\n){3}\n)$", r"triangle 0\n\1triangle 1\n\2", text)),
])


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
                         "CONFIG", "--size WIDTHxHEIGHT", "-o,--image FILE", "--z-buffer FILE",
                         "--background RRGGBB", "--sampling basic|regular|jittered|adaptive", "--samples N",
                         "--threshold N", "--threads N"],
        }
        for tool in ALL_TOOLS:
            text = run(tool, "--help").stdout.decode()
            for word in common + words[tool]:
                self.assertIn(word, text)

    def test_no_line_of_help_is_longer_than_100_characters(self):
        for tool in ALL_TOOLS:
            self.assertEqual([
                line for line in run(tool, "--help").stdout.decode().split("\n")
                if len(line) > 100 or line != line.rstrip()], [])

    def test_help_has_its_options_in_groups(self):
        groups = {
            "model": ["Numbers", "Output"],
            "view": ["Numbers", "Camera", "Light", "Output"],
            "project": ["Numbers", "Projection", "Clipping", "Output"],
            "zbuf": ["Output", "Pixels", "Color and light", "Debugging"],
            "trace": ["Output", "Projection", "Pixels", "Color and light", "Debugging"],
        }
        for tool in ALL_TOOLS:
            found = re.findall(r"^(\w[\w ]*):$", run(tool, "--help").stdout.decode(), re.M)
            self.assertEqual(found, ["Operands", *groups[tool], "General", "Examples"])

    def test_the_examples_of_help_do_what_they_show(self):
        path = f"{BIN}:{os.environ['PATH']}"
        for tool in ALL_TOOLS:
            examples = re.search(r"^Examples:\n((?:  .*\n)+)",
                                 run(tool, "--help").stdout.decode(), re.M)[1].splitlines()
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


class DigitsAndHeaders(ToolTest):
    SCENE = ("0.1 0 5e-3\n0 0 0\n0 1 0\n60 1.25 1e-3 1e20\ntriangle\n0.1 -0 1e-9\n-1e-9 1 2.5\n123456789 0 "
             "-3\nend\n")
    HEADER = "eye 0.1 0 0.005\nlook 0 0 0\nup 0 1 0\nperspective 60 1.25 0.001 1e+20\n"

    def test_headers_are_exact_whatever_the_digits(self):
        for digits in ("0", "7", "17", "exact"):
            self.assertTrue(
                pipe(["model", "--digits", digits], stdin=self.SCENE).decode().startswith(self.HEADER))

    def test_seven_decimals_are_the_rule(self):
        self.assertEqual(pipe(["model"], stdin=self.SCENE), pipe(["model", "--digits", "7"],
                                                                 stdin=self.SCENE))
        self.assertEqual(pipe(["model", "--bare"], stdin=self.SCENE).decode(),
                         "0.1000000 0.0000000 0.0000000\n0.0000000 1.0000000 2.5000000\n"
                         "123456789.0000000 0.0000000 -3.0000000\n\n")

    def test_exact_digits_are_the_shortest_that_read_back(self):
        self.assertEqual(pipe(["model", "--bare", "--digits", "exact"], stdin=self.SCENE).decode(),
                         "0.1 0 1e-09\n-1e-09 1 2.5\n123456789 0 -3\n\n")

    def test_each_stage_removes_what_it_consumed(self):
        stage1, stage2, stage3 = (text.decode().splitlines() for text in stage_texts())
        self.assertEqual(stage1[:4], HEADER.splitlines())
        self.assertEqual([line for line in stage2 if line[:1].isalpha()], ["perspective 60 1 1 100"])
        self.assertEqual([line for line in stage3 if line[:1].isalpha()], [])

    def test_an_ortho_travels_as_it_was_written(self):
        scene = SCENE.replace("60 1 1 100", "ortho -1 2.5 -3 4 -5 6")
        self.assertIn("\northo -1 2.5 -3 4 -5 6\n", pipe(["model"], stdin=scene).decode())
        self.assertTrue(
            pipe(["model"], ["view"], stdin=scene).decode().startswith("ortho -1 2.5 -3 4 -5 6\n"))

    def test_bare_text_is_triangles_alone(self):
        for tool, text in (("model", SCENE), ("view", pipe(["model"]))):
            whole, bare = pipe([tool], stdin=text).decode(), pipe([tool, "--bare"], stdin=text).decode()
            self.assertEqual(bare, "".join(line for line in whole.splitlines(True) if not line[0].isalpha()))


class NumbersOfTriangles(ToolTest):
    BEHIND = "0 0 2\n1 0 2\n0 1 2\n\n"
    ACROSS = "0 0 2\n1 0 -2\n0 1 -2\n\n"
    HEADER = "perspective 60 1 1 100\n"

    def numbers(self, text, *options):
        lines = pipe(["project", *options], stdin=self.HEADER + text).decode().splitlines()
        return [line for line in lines if line.startswith("triangle")]

    def test_they_are_not_written_where_counting_is_right(self):
        self.assertEqual(self.numbers(VIEW_SPACE * 3), [])

    def test_they_are_written_after_a_dropped_triangle(self):
        self.assertEqual(self.numbers(VIEW_SPACE + self.BEHIND + VIEW_SPACE * 2), ["triangle 2"])

    def test_they_are_written_before_the_second_piece(self):
        self.assertEqual(self.numbers(VIEW_SPACE + self.ACROSS + VIEW_SPACE), ["triangle 1"])

    def test_they_are_passed_on_by_view(self):
        text = HEADER + "0 0 0\n1 0 0\n0 1 0\n\ntriangle 7\n" + "0 0 0\n1 0 0\n0 1 0\n\n" * 2
        lines = pipe(["view"], stdin=text).decode().splitlines()
        self.assertEqual([line for line in lines if line.startswith("triangle")], ["triangle 7"])

    def test_they_choose_the_color(self):
        triangle = "-1 -1 0\n1 -1 0\n0 1 0\n\n"
        pictures = []
        for text in (triangle, "triangle 1\n" + triangle, "5 5 5\n5 5 5\n5 5 5\n\n" + triangle):
            pipe(["zbuf", "config.txt", "--image", "out.ppm"], stdin=text)
            pictures.append(pathlib.Path("out.ppm").read_bytes())
        self.assertNotEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[1], pictures[2])


class OneLightMore(ToolTest):
    def test_it_comes_behind_those_of_the_scene(self):
        triangle = "triangle\n1 2 3\n4 5 6\n7 8 9\nend\n"
        for own in ("", "light 7 8 9 0.5 0.5 0.5\n"):
            added = pipe(["model"], ["view", "--light", "1e2", "-2", ".5", "1", "0", "0.25"],
                         stdin=CAMERA + own + triangle)
            written = pipe(["model"], ["view"],
                           stdin=CAMERA + own + "light 100 -2 0.5 1 0 0.25\n" + triangle)
            self.assertEqual(added, written)

    def test_it_needs_a_header_and_six_numbers(self):
        light = ["--light", "1", "2", "3", "1", "1"]
        self.assert_fails(run("view", "--bare", *light, "1"), 2,
                          "view: expected --bare or --light, found both (try view --help)")
        self.assert_fails(run("view", *light, "-1", stdin=HEADER), 2,
                          "view: --light: expected the blue of the light of at least 0, found '-1' "
                          "(try view --help)")


class CameraPrecedence(ToolTest):
    """Options override --scene, and --scene overrides the header, part by part."""

    def view(self, *options, header=""):
        return pipe(["view", "--bare", *options],
                    stdin=header + "1 2 3\n0 0 0\n0 0 0\n\n").decode().splitlines()[0]

    def write_scene(self, first_lines):
        pathlib.Path("camera.txt").write_text(first_lines + "nonsense that nobody reads\n")

    def test_the_header_gives_the_camera(self):
        self.assertEqual(self.view(header="eye 1 2 5\nlook 1 2 0\nup 0 1 0\n"),
                         "0.0000000 0.0000000 -2.0000000")

    def test_the_scene_comes_before_the_header(self):
        self.write_scene("1 2 6\n1 2 0\n0 1 0\n60 1 1 100\n")
        self.assertEqual(self.view("--scene", "camera.txt", header=HEADER), "0.0000000 0.0000000 -3.0000000")

    def test_options_come_before_the_scene(self):
        self.write_scene("1 2 6\n1 2 0\n0 1 0\n60 1 1 100\n")
        self.assertEqual(self.view("--scene", "camera.txt", "--eye", "1", "2", "7", header=HEADER),
                         "0.0000000 0.0000000 -4.0000000")

    def test_options_come_before_the_header(self):
        self.assertEqual(self.view("--eye", "0", "0", "8", header=HEADER), "1.0000000 2.0000000 -5.0000000")

    def test_the_projection_of_an_option_replaces_any_other(self):
        self.write_scene(CAMERA)
        for options in (["--scene", "camera.txt"], []):
            text = pipe(["view", *options, "--ortho", "-1", "1", "-1", "1", "0", "9"], stdin=HEADER).decode()
            self.assertEqual(text, "ortho -1 1 -1 1 0 9\n")

    def test_the_projection_of_a_scene_replaces_that_of_the_header(self):
        self.write_scene(CAMERA.replace("60 1 1 100", "frustum -1 1 -1 1 1 9"))
        self.assertEqual(
            pipe(["view", "--scene", "camera.txt"], stdin=HEADER).decode(), "frustum -1 1 -1 1 1 9\n")

    def test_project_takes_its_projection_the_same_way(self):
        self.write_scene(CAMERA.replace("60 1 1 100", "ortho -1 1 -1 1 1 5"))
        by_header = pipe(["project"], stdin="ortho -1 1 -1 1 1 3\n" + VIEW_SPACE)
        by_scene = pipe(["project", "--scene", "camera.txt"], stdin="ortho -1 1 -1 1 1 3\n" + VIEW_SPACE)
        by_option = pipe(["project", "--scene", "camera.txt", "--ortho", "-1", "1", "-1", "1", "1", "3"],
                         stdin=VIEW_SPACE)
        self.assertEqual(by_header, by_option)
        self.assertTrue(by_header.startswith(b"0.0000000 0.0000000 0.0000000\n"))
        self.assertTrue(by_scene.startswith(b"0.0000000 0.0000000 -0.5000000\n"))

    RATIO_SCENE = SCENE.replace("60 1 1 100", "60 1.5 1 100 ratio")

    def test_the_aspect_rule_of_a_scene_travels_with_its_projection(self):
        stage1, stage2, _ = stage_texts(self.RATIO_SCENE)
        for text in (stage1, stage2):
            self.assertIn("perspective 60 1.5 1 100 ratio\n", text.decode())
        self.assertNotIn(b"angle", pipe(["model"], stdin=self.RATIO_SCENE.replace("ratio", "angle")))

    def test_the_aspect_rule_of_a_scene_is_that_of_the_option(self):
        stage1 = pipe(["model"], stdin=self.RATIO_SCENE)
        by_scene = pipe(["view"], ["project"], stdin=stage1)
        by_option = pipe(["view"], ["project", "--aspect", "ratio"], stdin=stage1.replace(b" ratio", b""))
        by_angle = pipe(["view"], ["project"], stdin=stage1.replace(b" ratio", b""))
        self.assertEqual(by_scene, by_option)
        self.assertNotEqual(by_scene, by_angle)
        self.assertEqual(pipe(["view"], ["project", "--aspect", "angle"], stdin=stage1), by_angle)

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

    def test_project_takes_every_projection_as_an_option(self):
        for words in ("--perspective 90 1 1 3", "--frustum -1 1 -1 1 1 3", "--ortho -2 2 -2 2 1 3"):
            vertices = pipe(["project", *words.split()], stdin=VIEW_SPACE).decode().splitlines()
            self.assertTrue(vertices[1].startswith("0.5000000 0.0000000 "), vertices)

    def test_negative_numbers_are_values_and_no_options(self):
        expected = self.view(header="eye -1 -2 -5\nlook -0.5 -2 -0.001\nup -0.5 -1 -0\n")
        self.assertEqual(
            self.view("--eye", "-1", "-2", "-5", "--look", "-.5", "-2", "-1e-3", "--up", "-.5", "-1", "-0"),
            expected)

    def test_an_option_may_replace_a_header_that_is_missing(self):
        self.assertEqual(self.view("--eye", "0", "0", "5", "--look", "0", "0", "0", "--up", "0", "1", "0"),
                         "1.0000000 2.0000000 -2.0000000")


if __name__ == "__main__":
    unittest.main()
