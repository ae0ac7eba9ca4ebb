#!/usr/bin/env python3
"""Texts that nobody would write: cut at any byte, huge, or no text at all. The result is one message with its
location, or the output for the text as it now reads, in little memory.

usage: hostile_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import re
import resource
import subprocess
import unittest

from toolbox import (CAMERA, DRAWING, HEADER, HEADERS, SCENE, ToolTest, command, run, tool_inputs)

MEMORY = 256 << 20
VERTICES = "0 0 -2\n1 0 -2\n0 1 -2\n\n"


def limit_memory():
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, MEMORY))


# A ball of glass that absorbs, in front of a mirror, under a lamp.
LIT_SPHERE = ("ortho -1 1 -1 1 1 9\nattributes color material\nmaterial 1 1 0 1 0.9 1 1\n"
              "material 1 1 1 9 0 1.5 0.1\nabsorption 0.3 0 2\nlight 1 2 0 1 1 1\n"
              "sphere\n0 0 -3 9 9 9 1\n1 0 -3 9 9 9 1\n0 1 -3 9 9 9 1\n0 0 -2 9 9 9 1\n\n"
              "-9 -9 -5 80 90 200 0\n9 -9 -5 80 90 200 0\n0 9 -5 80 90 200 0\n").encode()


class Hostile(ToolTest):
    def run_limited(self, tool, text, *options):
        if b"__asan_init" in pathlib.Path(command(tool)[0]).read_bytes():
            self.skipTest("AddressSanitizer needs more memory than the limit")
        return run(tool, *options, stdin=text, preexec_fn=limit_memory)

    def assert_placed(self, done, tool, text):
        """One message, whose line and column lie in the text."""
        self.assertEqual((done.returncode, done.stderr.count(b"\n")), (1, 1), done.stderr)
        place = re.match(rf"{tool}: <stdin>:(\d+):(\d+): ".encode(), done.stderr)
        self.assertIsNotNone(place, done.stderr)
        lines = text.split(b"\n") + [b""]
        line, column = map(int, place.groups())
        self.assertLessEqual(line, len(lines))
        self.assertLessEqual(column, len(lines[line - 1]) + 1)

    def damaged(self, text):
        """The text cut at any byte, and with bytes changed: of a long one every third (all are changed in
        tests/stream/corrupted_text_test.cpp)."""
        yield from (text[:length] for length in range(len(text)))
        for position in range(0, len(text), 1 if len(text) < 60 else 3):
            for byte in (0, 9, 10, ord("#"), ord("-"), ord("7"), ord("e"), 0xff):
                yield text[:position] + bytes([byte]) + text[position + 1:]

    def check(self, tool, options, text, is_whole):
        """Each damaged text is refused with its place, or read in silence, but for a note on an empty
        picture, and is_whole(it, the finished run)."""
        read = 0
        for changed in self.damaged(text):
            done = run(tool, *options, stdin=changed)
            if done.returncode == 0:
                self.assertRegex(done.stderr, rb"\A(\w+: note: .*\n)?\Z", changed)
                self.assertTrue(is_whole(changed, done), (changed, done.stdout))
                read += 1
            else:
                self.assert_placed(done, tool, changed)
        self.assertGreater(read, 20, tool)

    def test_a_damaged_scene_is_read_as_it_reads_or_refused(self):
        self.check("model", [], SCENE.encode(), lambda _, done: (done.stderr, done.stdout.count(b"\n\n")) ==
                   (b"", 1))

    def test_so_is_a_damaged_stage_text(self):
        def has_whole_triangles(_, done):  # three vertices are complete, or none
            return tool in DRAWING or len(re.findall(rb"(?m)^-?\d", done.stdout)) % 3 == 0

        for tool, options, text in tool_inputs()[1:]:
            self.check(tool, options, text, has_whole_triangles)
        self.check("trace", ["--size", "4x3"], LIT_SPHERE, lambda _, done: done.stdout.count(b"\n") == 3)

    def test_so_is_a_damaged_config(self):
        pathlib.Path("scene.ndc").write_text("")
        self.check("zbuf", ["-", "scene.ndc"], b"12 8\n-0.5\n-0.25\n-1 1\n",
                   lambda text, done: done.stdout.count(b"\n") == int(text.split()[1]))  # rows

    def test_a_number_of_a_million_digits_is_a_number(self):
        third = "0." + "3" * 1_000_000
        for tool, text, expected in (
            ("model", f"{CAMERA}triangle\n{third} 0 0\n1 0 0\n0 1 0\nend\n", "0.3333333 0.0000000 0.0000000"),
            ("view", f"{HEADER}{third} 0 -2\n1 0 -2\n0 1 -2\n", "0.3333333 0.0000000 -7.0000000"),
                # A third of 1 / tan 30 degrees, over the distance 2; 101 / 99 - 200 / (99 * 2).
            ("project", f"{HEADERS['project']}{third} 0 -2\n1 0 -2\n0 1 -2\n", "0.2886751 0.0000000 0.0101010"
             )):
            done = self.run_limited(tool, text)
            self.assert_quiet_success(done)
            self.assertIn(expected.encode(), done.stdout.split(b"\n"), tool)

    def test_so_is_one_that_zbuf_reads(self):
        third = "0." + "3" * 1_000_000
        pictures = []
        for number in (third, "0.33333333333333333333333333333333"):
            pathlib.Path("config.txt").write_text(f"8 8\n-{number}\n-1\n-1 1\n")
            done = self.run_limited("zbuf", f"{number} 0 0\n-1 -1 0\n0 1 0\n", "config.txt", "--coverage",
                                    "center")
            self.assert_quiet_success(done)
            pictures.append((done.stdout, pathlib.Path("out.bmp").read_bytes()))
        self.assertEqual(*pictures)
        self.assertIn(b"0.000000", pictures[0][0])

    def test_a_picture_larger_than_memory_is_refused(self):
        pathlib.Path("config.txt").write_text("65535 65535\n")
        for tool in DRAWING:
            for options in [], ["--z-buffer", "none"]:
                done = self.run_limited(tool, HEADERS[tool] + VERTICES, "config.txt", "--image", "out.ppm",
                                        *options)
                self.assert_fails(done, 1, f"{tool}: not enough memory")
                self.assertEqual(self.files(), ["config.txt", "scene.txt"])

    def test_a_picture_for_which_no_memory_is_left_is_refused(self):
        # Linux would allocate it, and kill whoever fills it.
        pathlib.Path("meminfo").write_text(
            "MemTotal: 99999999 kB\nMemAvailable: 16000 kB\nSwapFree: 300 kB\n")
        pathlib.Path("whole.txt").write_text("-1 -1 0\n2.9 -1 0\n-1 2.9 0\n\n")
        for size, depth, is_refused in (("1000x1000", "f64", False), ("1000x2200", "u24", True),
                                        ("2000x2000", "f64", True)):
            words = command("zbuf", "--size", size, "--depth", depth, "--threads", "2", "--z-buffer", "none",
                            "-o", "out.ppm", "whole.txt")
            done = subprocess.run([
                "unshare", "--mount", "--map-root-user", "sh", "-c",
                'mount --bind meminfo /proc/meminfo || exit 77; "$@"', "sh", *words], capture_output=True,
                                  timeout=60)
            if done.returncode == 77 or done.stderr.startswith(b"unshare: "):
                self.skipTest("mounting is not allowed here: " + done.stderr.decode().strip())
            message = b"zbuf: not enough memory\n" if is_refused else b""
            self.assertEqual((done.returncode, done.stderr), (int(is_refused), message), (size, depth))
            self.assertEqual(pathlib.Path("out.ppm").exists(), not is_refused)
            pathlib.Path("out.ppm").unlink(missing_ok=True)
        pathlib.Path("meminfo").unlink()
        pathlib.Path("whole.txt").unlink()
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])


if __name__ == "__main__":
    unittest.main()
