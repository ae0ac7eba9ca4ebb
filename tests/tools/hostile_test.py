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

from toolbox import (
    CAMERA, DRAWING, HEADER, HEADERS, NO_TRIANGLE, SCENE, TRIANGLE, ToolTest, command, run, tool_inputs)

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

    def test_every_prefix_of_a_scene_is_refused_but_one_that_has_its_end(self):
        text = SCENE.encode()
        for length in range(len(text) - 1):
            self.assert_placed(run("model", stdin=text[:length]), "model", text[:length])
        self.assert_quiet_success(run("model", stdin=text[:-1]))

    def test_every_prefix_of_a_stage_text_is_read_as_it_reads_or_refused(self):
        for tool, options, text in tool_inputs()[1:]:
            whole = 0
            for length in range(len(text)):
                done = run(tool, *options, stdin=text[:length])
                if done.returncode != 0:
                    self.assert_placed(done, tool, text[:length])
                else:
                    # Three vertices are complete, or none.
                    body = [line for line in text[:length].split(b"\n") if re.match(rb"-?\d", line)]
                    self.assertIn(len(body), (0, 3), text[:length])
                    notes = {"zbuf": NO_TRIANGLE, "trace": NO_TRIANGLE.replace("zbuf", "trace")}
                    self.assertEqual(done.stderr.decode(), "" if body else notes.get(tool, ""))
                    whole += 1
            self.assertGreater(whole, 0)

    def test_a_cut_text_of_a_sphere_and_light_is_traced_as_it_reads_or_refused(self):
        read = []
        for length in range(len(LIT_SPHERE) + 1):
            text = LIT_SPHERE[:length]
            done = run("trace", "--size", "4x3", stdin=text)
            if done.returncode != 0:
                self.assert_placed(done, "trace", text)
                continue
            self.assertRegex(done.stderr, rb"\A(trace: note: the picture is (black|empty): .*\n)?\Z")
            read.append(text.count(b"\n0 0 -2") + text.count(b"\n0 9 -5"))
        self.assertEqual(set(read), {0, 1, 2})  # nothing, the sphere, both

    def test_a_changed_byte_of_a_sphere_and_light_is_too(self):
        read = 0
        for position in range(len(LIT_SPHERE)):
            for byte in (10, ord("-"), ord("7"), 0xff):
                changed = LIT_SPHERE[:position] + bytes([byte]) + LIT_SPHERE[position + 1:]
                done = run("trace", "--size", "4x3", stdin=changed)
                if done.returncode == 0:
                    self.assertRegex(done.stderr, rb"\A(trace: note: .*\n)?\Z", changed)
                    self.assertEqual(done.stdout.count(b"\n"), 3, changed)
                    read += 1
                else:
                    self.assert_placed(done, "trace", changed)
        self.assertGreater(read, 100)

    def test_every_prefix_of_a_config_is_refused_or_has_its_lines(self):
        text = b"12 8\n-0.5\n-0.25\n-1 1\n"
        for length in range(len(text)):
            pathlib.Path("config.txt").write_bytes(text[:length])
            done = run("zbuf", "config.txt")
            numbers = text[:length].split()
            complete = len(numbers) == 6 or (len(numbers) == 2 and text[:length].count(b"\n") <= 1)
            self.assertEqual(done.returncode, 0 if complete and numbers[-1] != b"-" else 1,
                             (text[:length], done.stderr))

    def test_a_changed_byte_is_refused_with_its_place_or_read_as_it_reads(self):
        text = SCENE.encode()
        for position in range(len(text)):
            for byte in (0, 9, 10, ord("#"), ord("-"), ord("7"), ord("e"), 0xff):
                changed = text[:position] + bytes([byte]) + text[position + 1:]
                done = run("model", stdin=changed)
                if done.returncode == 0:
                    self.assertEqual((done.stderr, done.stdout.count(b"\n\n")), (b"", 1), changed)
                else:
                    self.assert_placed(done, "model", changed)

    def test_a_changed_byte_of_a_config_is_too(self):
        text = b"12 8\n-0.5\n-0.25\n-1 1\n"
        read = 0
        for position in range(len(text)):
            for byte in (0, 9, 10, ord("#"), ord("-"), ord("7"), ord("e"), 0xff):
                changed = text[:position] + bytes([byte]) + text[position + 1:]
                pathlib.Path("config.txt").write_bytes(changed)
                done = run("zbuf", "config.txt")
                if done.returncode == 0:
                    # The output has as many rows as the text gives.
                    rows = int(changed.split()[1])
                    self.assertEqual((done.stderr, done.stdout.count(b"\n")), (NO_TRIANGLE.encode(), rows),
                                     changed)
                    read += 1
                else:
                    self.assertEqual((done.returncode, done.stderr.count(b"\n")), (1, 1), changed)
                    line, column = map(int,
                                       re.match(rb"zbuf: config.txt:(\d+):(\d+): ", done.stderr).groups())
                    self.assertLessEqual(column, len((changed.split(b"\n") + [b""])[line - 1]) + 1, changed)
        self.assertGreater(read, 20)

    def test_a_nul_is_no_blank_and_no_end(self):
        bad_vertex = "0 0\0 -2\n"
        for tool, text, line in (("model", CAMERA + "triangle\n" + bad_vertex,
                                  6), ("view", HEADER + bad_vertex, 5), ("project",
                                                                         HEADERS["project"] + bad_vertex, 5),
                                 ("zbuf", bad_vertex, 1), ("trace", HEADERS["trace"] + bad_vertex, 5)):
            pathlib.Path("config.txt").write_text("8 8\n")
            done = run(tool, *["config.txt"] * (tool in DRAWING), stdin=text)
            self.assert_fails(done, 1,
                              rf"{tool}: <stdin>:{line}:3: expected the y of vertex 1 of 3, found '0\x00' "
                              "(is this UTF-16? save it as UTF-8)")
        pathlib.Path("config.txt").write_text("8 8\0\n")
        self.assert_fails(
            run("zbuf", "config.txt"), 1, "zbuf: config.txt:1:3: expected the height in pixels, "
            r"a whole number from 1 to 65535, found '8\x00' (is this UTF-16? save it as UTF-8)")

    def test_a_byte_order_mark_is_skipped_at_the_beginning_alone(self):
        self.assert_quiet_success(run("model", stdin=b"\xef\xbb\xbf" + SCENE.encode()))
        done = run("model", stdin=SCENE.replace("triangle", "\ufefftriangle"))
        self.assert_placed(done, "model", SCENE.replace("triangle", "\ufefftriangle").encode())

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

    def test_a_line_of_a_million_words_is_refused_at_the_first_that_is_too_much(self):
        done = self.run_limited("view", HEADER + "0 0 -2 " + "1 " * 500_000 + "\n")
        self.assert_fails(
            done, 1,
            "view: <stdin>:5:8: expected the end of the line after the z of vertex 1 of 3, found '1'")

    def test_a_line_is_read_up_to_its_limit(self):
        limit = 1 << 20
        self.assert_quiet_success(self.run_limited("model", "#" * limit + "\n" + SCENE))
        done = self.run_limited("model", "#" * (limit + 1) + "\n" + SCENE)
        self.assert_fails(
            done, 1,
            f"model: <stdin>:1:{limit + 1}: expected the end of the line, found more than {limit} characters")

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
        pathlib.Path("whole.txt").write_text("-1 -1 0\n3 -1 0\n-1 3 0\n\n")
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

    def test_a_size_beyond_the_limit_is_refused_at_its_place(self):
        for text, column, what in (("65536 1", 1, "width"), ("1 65536", 3, "height"), ("0 1", 1, "width"),
                                   ("200.5 200", 1, "width"),
                                   ("1 99999999999999999999", 3, "height")):
            pathlib.Path("config.txt").write_text(text + "\n")
            found = text.split()[0 if column == 1 else 1]
            self.assert_fails(
                run("zbuf", "config.txt"), 1, f"zbuf: config.txt:1:{column}: expected the {what} in pixels, "
                f"a whole number from 1 to 65535, found '{found}'")

    def test_a_triangles_number_may_be_as_large_as_64_bits_hold(self):
        largest = (1 << 64) - 1
        done = run("project", stdin=HEADERS["project"] + f"triangle {largest}\n" + VERTICES)
        self.assert_quiet_success(done)
        self.assertTrue(done.stdout.startswith(f"triangle {largest}\n".encode()), done.stdout)
        self.assert_placed(run("project", stdin=HEADERS["project"] + f"triangle {largest + 1}\n" + VERTICES),
                           "project", (HEADERS["project"] + f"triangle {largest + 1}\n" + VERTICES).encode())


if __name__ == "__main__":
    unittest.main()
