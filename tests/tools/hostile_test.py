#!/usr/bin/env python3
"""Texts that nobody would write: cut at any byte, huge, or no text at all. The result is one message with its
location, or the output for the text as it now reads, in little memory.

usage: hostile_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import resource
import subprocess
import unittest

from toolbox import CAMERA, DRAWING, HEADER, HEADERS, SCENE, ToolTest, add_claims, command, tool_inputs

# A ball of glass that absorbs, in front of a mirror, under a lamp.
LIT_SPHERE = ("ortho -1 1 -1 1 1 9\nattributes color material\nmaterial 1 1 0 1 0.9 1 1\n"
              "material 1 1 1 9 0 1.5 0.1\nabsorption 0.3 0 2\nlight 1 2 0 1 1 1\n"
              "sphere\n0 0 -3 9 9 9 1\n1 0 -3 9 9 9 1\n0 1 -3 9 9 9 1\n0 0 -2 9 9 9 1\n\n"
              "-9 -9 -5 80 90 200 0\n9 -9 -5 80 90 200 0\n0 9 -5 80 90 200 0\n").encode()
HAS_ASAN = b"__asan_init" in pathlib.Path(command("zbuf")[0]).read_bytes()  # which needs more memory
MOUNTED = [
    "unshare", "--mount", "--map-root-user", "sh", "-c",
    'mount --bind meminfo /proc/meminfo || exit 77; "$0" "$@"']


def damaged(text):
    """The text cut at any byte, and with bytes changed: of a long one every third (all are changed in
    tests/stream/corrupted_text_test.cpp)."""
    yield from (text[:length] for length in range(len(text)))
    for position in range(0, len(text), 1 if len(text) < 60 else 3):
        for byte in (0, 9, 10, ord("#"), ord("-"), ord("7"), ord("e"), 0xff):
            yield text[:position] + bytes([byte]) + text[position + 1:]


def placed_or(is_whole):
    """Each text is refused with its place, or read in silence, but for a note on an empty picture, and
    is_whole(it, its output)."""
    def judge(test, runs):
        for text, done in runs:
            if done.returncode == 0:
                test.assertRegex(done.stderr, rb"\A(\w+: note: .*\n)?\Z", text)
                test.assertTrue(is_whole(text, done.stdout), (text, done.stdout))
            else:
                test.assertEqual((done.returncode, done.stderr.count(b"\n")), (1, 1), done.stderr)
                place = re.match(rb"\w+: <stdin>:(\d+):(\d+): ", done.stderr)
                test.assertIsNotNone(place, done.stderr)
                lines = text.split(b"\n") + [b""]
                line, column = map(int, place.groups())
                test.assertLessEqual(line, len(lines))
                test.assertLessEqual(column, len(lines[line - 1]) + 1)
        test.assertGreater(sum(done.returncode == 0 for _, done in runs), 20)

    return judge


def has_line(line):
    """All outputs are the same, without a message, and have this line or depth."""
    def judge(test, runs):
        for _, done in runs:
            test.assert_quiet_success(done)
            test.assertEqual(done.stdout, runs[0][1].stdout)
            test.assertIn(line.encode(), re.split(rb"[\n\t]", done.stdout))

    return judge


def refused(test, runs):
    (_, done), = runs
    test.assertRegex(done.stderr, rb"\A\w+: not enough memory\n\Z")
    test.assertEqual((done.returncode, done.stdout, os.path.exists("out.ppm")), (1, b"", False))


def drawn(test, runs):
    (_, done), = runs
    test.assert_quiet_success(done)
    test.assertTrue(os.path.exists("out.ppm"))


def has_whole_triangles(_, out):
    return len(re.findall(rb"(?m)^-?\d", out)) % 3 == 0


THIRD, SHORT_THIRD = "0." + "3" * 1_000_000, "0.33333333333333333333333333333333"
STAGES = {tool: text for tool, _, text in tool_inputs()}
FLAT = b"-1 -1 0\n2.9 -1 0\n-1 2.9 0\n\n"
# A claim, the tool, its options, the texts that it reads one after another, and who judges the runs.
CASES = [
    ("a damaged scene is read as it reads or refused", "model", "", damaged(
        SCENE.encode()), placed_or(lambda _, out: out.count(b"\n\n") == 1)),
    *((f"so is a damaged text for {tool}", tool, "", damaged(STAGES[tool]), placed_or(has_whole_triangles))
      for tool in ("view", "project")),
    *((f"so is a damaged text for {tool}", tool, "config.txt", damaged(
        STAGES[tool]), placed_or(lambda _, out: True)) for tool in DRAWING),
    ("so is a damaged text of a sphere", "trace", "--size 4x3", damaged(LIT_SPHERE),
     placed_or(lambda _, out: out.count(b"\n") == 3)),
    ("so is a damaged config", "zbuf", "- /dev/null", damaged(b"12 8\n-0.5\n-0.25\n-1 1\n"),
     placed_or(lambda text, out: out.count(b"\n") == int(text.split()[1]))),
    ("a number of a million digits is a number in a scene", "model", "", [
        f"{CAMERA}triangle\n{THIRD} 0 0\n1 0 0\n0 1 0\nend\n"], has_line("0.3333333 0.0000000 0.0000000")),
    ("so is one that view reads", "view", "", [
        f"{HEADER}{THIRD} 0 -2\n1 0 -2\n0 1 -2\n"], has_line("0.3333333 0.0000000 -7.0000000")),
    # A third of 1 / tan 30 degrees, over the distance 2; 101 / 99 - 200 / (99 * 2).
    ("so is one that project reads", "project", "", [
        f"{HEADERS['project']}{THIRD} 0 -2\n1 0 -2\n0 1 -2\n"], has_line("0.2886751 0.0000000 0.0101010")),
    *(row for options, line in (("", "0.000000"), ("-o - --z-buffer none", "P6")) for row in (
        (f"so is one that zbuf reads, with {line}", "zbuf", f"third.txt --coverage center {options}",
         [f"{third} 0 0\n-1 -1 0\n0 1 0\n" for third in (THIRD, SHORT_THIRD)], has_line(line)),
        (f"so is one that a config has, with {line}", "zbuf", f"- third.ndc --coverage center {options}",
         [f"8 8\n-{third}\n-1\n-1 1\n" for third in (THIRD, SHORT_THIRD)], has_line(line)))),
    *((f"a picture of {tool} larger than memory is refused{' without depths' * bool(options)}", tool,
       f"--size 65535x65535 --image out.ppm {options}", [HEADERS[tool] + "0 0 -2\n1 0 -2\n0 1 -2\n\n"
                                                         ], refused) for tool in DRAWING
      for options in ("", "--z-buffer none")),
    # Linux would allocate it, and kill whoever fills it.
    *((f"of {size} pixels in {depth}, a picture is {judge.__name__} where less memory is left", "zbuf",
       f"--size {size} --depth {depth} --threads 2 --z-buffer none -o out.ppm", [FLAT], judge, MOUNTED)
      for size, depth, judge in (("1000x1000", "f64", drawn), ("1000x2200", "u24", refused),
                                 ("2000x2000", "f64", refused))),]


class Hostile(ToolTest):
    def check(self, tool, options, texts, judge, around=()):
        if HAS_ASAN and judge in (refused, drawn):
            self.skipTest("AddressSanitizer needs more memory than the limit")
        pathlib.Path("third.txt").write_text(f"8 8\n-{THIRD}\n-1\n-1 1\n")
        pathlib.Path("third.ndc").write_text(f"{THIRD} 0 0\n-1 -1 0\n0 1 0\n")
        pathlib.Path("meminfo").write_text(
            "MemTotal: 99999999 kB\nMemAvailable: 16000 kB\nSwapFree: 300 kB\n")
        before, limits = self.files(), resource.getrlimit(resource.RLIMIT_DATA)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_DATA, limits)
        if not HAS_ASAN:  # what this process starts has its limit
            resource.setrlimit(resource.RLIMIT_DATA, (256 << 20, limits[1]))
        words = [*around, *command(tool, *options.split())]
        texts = [text.encode() if isinstance(text, str) else text for text in texts]
        runs = [(text, subprocess.run(words, input=text, capture_output=True, timeout=60)) for text in texts]
        if runs[0][1].returncode == 77 or runs[0][1].stderr.startswith(b"unshare: "):
            self.skipTest("mounting is not allowed here: " + runs[0][1].stderr.decode().strip())
        judge(self, runs)
        self.assertLessEqual(set(self.files()) - set(before), {"out.bmp", "out.ppm"})


add_claims(Hostile, CASES)

if __name__ == "__main__":
    unittest.main()
