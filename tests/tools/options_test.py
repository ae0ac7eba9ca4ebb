#!/usr/bin/env python3
"""The tools' operands and options, and what --help says. The pack asks for the forms of texts and the camera.

usage: options_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import subprocess
import unittest

import toolbox
from toolbox import ALL_TOOLS, BIN, CAMERA, SOURCE, ToolTest, add_claims, alternatives, stage_texts

SCENE = CAMERA.replace("0 0 5\n0 0 0", "1 2 6\n1 0.5 0").replace("60 1 1", "60 1.5 1") + """translate
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
INPUTS = {
    "model": "scene.txt", "view": "stage1.txt", "project": "stage2.txt", "zbuf": "stage3.txt",
    "trace": "stage2.txt"}
FILES = {
    before + name: text
    for before, scene in (("", SCENE), ("one.", toolbox.SCENE))
    for name, text in zip(INPUTS.values(), (scene.encode(), *stage_texts(scene)))}
OPERANDS = {tool: "config.txt " if tool in ("zbuf", "trace") else "" for tool in ALL_TOOLS}
VERSION = re.search(r"VERSION (\d+\.\d+\.\d+)", (SOURCE / "CMakeLists.txt").read_text())[1]
STAGE, COMMON = ["--digits N|exact", "--precision double|extended"], ["--help", "--version", "--timing"]
PROJECTION = [
    "--perspective FOVY ASPECT NEAR FAR", "--frustum L R B T N F", "--ortho L R B T N F", "--scene FILE"]
DRAWN = ["CONFIG", "--size WIDTHxHEIGHT", "-o,--image FILE", "--z-buffer FILE", "--background RRGGBB"]
WORDS = {
    "model": [*STAGE, "--bare", "--framed"],
    "view": [*STAGE, *PROJECTION, "--bare", "--eye X Y Z", "--look X Y Z", "--up X Y Z"],
    "project": [
        *STAGE, *PROJECTION, "--aspect angle|ratio", "--clip auto|near|frustum|reject|none",
        "--cull back|front"],
    "zbuf": [*DRAWN, "--coverage ", "--algorithm "],
    "trace": [
        *PROJECTION, *DRAWN, "--sampling basic|regular|jittered|adaptive", "--samples N", "--threshold N",
        "--threads N"],}
GROUPS = {
    "model": ["Numbers", "Output"],
    "view": ["Numbers", "Camera", "Light", "Output"],
    "project": ["Numbers", "Projection", "Clipping", "Output"],
    "zbuf": ["Output", "Pixels", "Color and light", "Debugging"],
    "trace": ["Output", "Projection", "Pixels", "Color and light", "Debugging"],}


def same(test, *outputs):
    test.assertEqual(set(outputs), {outputs[0]})


def matches(pattern):
    return lambda test, *outputs: [test.assertRegex(text, pattern) for text in outputs]


def names(words):
    return lambda test, text: test.assertEqual([word for word in words if word not in text], [])


def is_of_80_columns(test, *texts):
    test.assertEqual(
        [line for text in texts for line in text.split("\n") if not len(line.rstrip()) == len(line) <= 80],
        [])


def shortens(test, common, full):
    """Without rare options, the help names the others in the same words."""
    common, full = (re.findall(r"^  -.*\n(?: {25}.*\n)*", text, re.M) for text in (common, full))
    test.assertEqual([option for option in full if option in common], common)
    test.assertLess(len(common), len(full))


def has_groups(groups):
    return lambda test, text: test.assertEqual(re.findall(r"^(\w[\w ]*):$", text, re.M), [
        "Example", "Operands", *groups, "General"])


def has_examples(test, text):
    """Two, which do what they show."""
    examples = re.search(r"^Examples:\n((?:  .*\n)+)", text, re.M)[1].splitlines()
    test.assertEqual(len(examples), 2)
    for example in examples:
        test.assertIn(text.split()[1], example)
        test.output(example)
        for result in re.findall(r"(?:>|-o) (\S+)", example):
            test.assertGreater(pathlib.Path(result).stat().st_size, 0)


def claims_of(tool):
    line, file = f"{tool} {OPERANDS[tool]}", INPUTS[tool]
    return (
        ("takes a file, a dash or nothing for its input", line + f"{{{file}|- < {file}|< {file}}}", same),
        ("writes help and reads nothing", f"{tool} {{--help|-h|--help none.txt}}",
         matches(f"Usage: {tool} ")),
        ("names every option in its help", f"{tool} --help-all", names([*COMMON, *WORDS[tool]])),
        ("has help of 80 columns", f"{tool} --help{{|-all}}", is_of_80_columns),
        ("begins help with usage and an example", f"{tool} --help{{|-all}}",
         matches(rf"\AUsage: {tool} .*\n( {{7}}{tool} .*\n)?\nExamples?:\n  \w")),
        ("names rare options in --help-all alone", f"{tool} --help{{|-all}}", shortens),
        ("has its options in groups", f"{tool} --help", has_groups(GROUPS[tool])),
        ("has examples in its help", f"{tool} --help-all", has_examples),
        ("has the version of the project, and reads nothing", f"{tool} --version{{| none.txt}}",
         matches(rf"\A{tool} \(pipeline\) {VERSION}\n\Z")),
        ("changes no byte by --timing", f"{line}{file} == {line}--timing {file} 2> time.txt", same),
        ("writes a line by --timing", line + f"--timing {file} 2>&1 > /dev/null",
         matches(rf"\A{tool}: 2 triangles in \d+\.\d+ s .*\n\Z")),
        ("counts one triangle in the singular", line + f"--timing one.{file} 2>&1 > /dev/null",
         matches(rf"\A{tool}: 1 triangle in \d")),
    )


SETTINGS = {
    "PATH": f"{BIN}:{os.environ['PATH']}", "CAMERA": CAMERA,
    "TRIANGLE": "triangle\n1 2 3\n4 5 6\n7 8 10\nend\n"}
RATIO = "sed 's/1.5 1 100/& ratio/' scene.txt"
P = "--perspective 60 1.5 1 100"
LIGHT, MOVED = "light 7 8 9 0.5 0.5 0.5\\n", "translate 1 1 1\\nlight {} 1 0 0.25\\n"
VERTICES = "1 2 3\\n0 0 0\\n0 0 0\\n\\n"
# A claim, lines of bash between ==, and who judges their outputs.
CASES = [
    *((f"{tool} {claim}", *row) for tool in ALL_TOOLS for claim, *row in claims_of(tool)),
    ("a decimal comma of the locale changes nothing",
     "export LC_ALL={C|de_DE.UTF-8}; model scene.txt | view | project | zbuf config.txt", same),
    ("options may stand behind operands", "model {scene.txt --digits 2|--digits 2 scene.txt}", same),
    ("options may be joined to their value", "model --digits{=| }exact scene.txt", same),
    ("behind two dashes there are only operands", "cp scene.txt ./--bare; model {-- --bare|scene.txt}", same),
    ("the config may be standard input", "zbuf {-|config.txt} stage3.txt < config.txt", same),
    ("timing says nothing of a failed run", "(model --timing 2>&1 || true)",
     matches(r"\A(?!.*triangles in)")),
    *((f"a light more comes behind {place}",
       f'printf "${{CAMERA}}{own}$TRIANGLE" | model | view --light 1e2 -2 .5 1 0 0.25 == '
       f'printf "${{CAMERA}}{own}light 100 -2 0.5 1 0 0.25\\n$TRIANGLE" | model | view', same)
      for place, own in (("none", ""), ("the scene's", LIGHT))),
    ("a light of the scene moves",
     f'printf "${{CAMERA}}{LIGHT}{MOVED.format("1 2 3")}$TRIANGLE" | model | view --light-at 1 1e2 -2 .5 == '
     f'printf "${{CAMERA}}{LIGHT}{MOVED.format("99 -3 -0.5")}$TRIANGLE" | model | view', same),
    # Options override --scene, and --scene overrides the header, part by part.
    ("a projection that is replaced loses its aspect rule",
     f"{RATIO} | model | view {P} | project == {RATIO} | model | view | project {P}", same),
    ("a header has the projection of options", f"{RATIO} | model | view {P}",
     matches(r"\Aperspective 60 1.5 1 100\n")),
    ("an aspect rule is given with a projection", f"{RATIO} | model | view | project{{| {P} --aspect ratio}}",
     same),
    ("the aspect rule of a scene replaces the one of the header",
     f"{RATIO} > c.txt; model scene.txt | view --scene c.txt | project == "
     f"model scene.txt | view | project --scene c.txt == model c.txt | view | project", same),
    *((f"an aspect rule changes nothing of {words.split()[0]}",
       f"project {words}{{| --aspect ratio| --aspect angle}} stage2.txt", same)
      for words in ("--frustum -1 2 -1 1 1 3", "--ortho -2 2 -3 2 1 3")),
    ("negative numbers are values and no options",
     f'printf "{VERTICES}" | view --bare --eye -1 -2 -5 --look -.5 -2 -1e-3 --up -.5 -1 -0 == '
     f'printf "eye -1 -2 -5\\nlook -0.5 -2 -0.001\\nup -0.5 -1 -0\\n{VERTICES}" | view --bare', same),]


class Options(ToolTest):
    def setUp(self):
        super().setUp()
        for name, text in FILES.items():
            pathlib.Path(name).write_bytes(text)

    def output(self, line):
        done = subprocess.run(["bash", "-eo", "pipefail", "-c", line], input=b"nonsense", capture_output=True,
                              env={**os.environ, **SETTINGS}, timeout=60)
        self.assert_quiet_success(done)
        return done.stdout.decode()

    def check(self, lines, judge):
        if "de_DE" in lines and subprocess.run(["locale", "decimal_point"], capture_output=True, env={
                **os.environ, "LC_ALL": "de_DE.UTF-8"}).stdout != b",\n":
            self.skipTest("the locale de_DE.UTF-8 is not installed")
        judge(self, *(self.output(way) for line in lines.split(" == ") for way in alternatives(line)))


add_claims(Options, CASES)

if __name__ == "__main__":
    unittest.main()
