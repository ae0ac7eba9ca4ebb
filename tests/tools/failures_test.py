#!/usr/bin/env python3
"""A failure in one stage reaches the end of the pipe: an incomplete text gives no picture.

usage: failures_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import socket
import subprocess
import unittest

from toolbox import (BIN, CAMERA, DRAWING, HEADER, HEADERS, NO_TRIANGLE, SCENE, TRIANGLE, Terminal, ToolTest,
                     command, run, run_with, stage_texts, tool_inputs)

WHY = "model: <stdin>:9:1: expected 'end', which closes a scene, found the end of the input"
OLD_IMAGE = b"an older image\x00\xff"


def shell(text, **settings):
    """Runs a shell line in which the tools are on the PATH."""
    environment = {"PATH": f"{BIN}:/usr/bin:/bin"}
    return subprocess.run(["sh", "-c", text], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60,
                          env=environment, **settings)


class ErrorLines(ToolTest):
    def test_model_ends_its_output_with_one(self):
        done = run("model", stdin=CAMERA + TRIANGLE)
        self.assertEqual(
            done.stdout.decode(), HEADER + "0.0000000 0.0000000 0.0000000\n1.0000000 0.0000000 0.0000000\n"
            f"0.0000000 1.0000000 0.0000000\n\nerror {WHY}\n")

    def test_a_stage_ends_its_output_with_its_message(self):
        none, body = "cannot open none.txt: No such file or directory", "0 0 -2\n1 0 -2\n0 1 -2\n\n0 0 x\n"
        cases = [  # words, input, exit status, triangles written before, message
            *(("model", *options, CAMERA + TRIANGLE, 1, 1, WHY)
              for options in ((), ("--bare",), ("--framed",))),
            *((tool, text, 1, 0, "1:1: ") for tool, text in (("model", ""), ("view", "x"), ("project", "x"))),
            *((tool, HEADERS[tool] + body, 1, 1, "'x'") for tool in ("view", "project")),
            *((tool, operand, "", status, 0, f"{tool}: {message}") for tool in ("model", "view", "project")
              for operand, status, message in (("--bogus", 2, "expected an option"), ("none.txt", 1, none)))]
        for *words, text, status, triangles, message in cases:
            with self.subTest(words, text=text):
                done = run(*words, stdin=text)
                before, error, after = done.stdout.decode().partition("error ")
                self.assertEqual((done.returncode, error + after), (status, "error " + done.stderr.decode()))
                self.assertIn(message, after)
                self.assertEqual((before.count("\n\n"), before[-2:]), (triangles, "\n\n" * triangles))

    def test_a_tool_that_draws_writes_none_for_its_output_is_no_stage_text(self):
        for tool in DRAWING:
            self.assertEqual(run(tool, "config.txt", stdin="x").stdout, b"")
            self.assertEqual(run(tool, "--bogus").stdout, b"")

    def test_view_and_project_pass_it_on_unchanged_and_in_silence(self):
        for tool in ("view", "project"):
            done = run(tool, stdin=HEADERS[tool] + "0 0 -2\n1 0 -2\n0 1 -2\n\nerror model: a #1 mistake\n")
            self.assertEqual((done.returncode, done.stderr), (1, b""))
            self.assertTrue(done.stdout.endswith(b"\n\nerror model: a #1 mistake\n"), done.stdout)

    def test_the_last_stage_says_that_there_is_no_output(self):
        for tool in ("view", "project"):
            with open("output.txt", "wb") as output:
                done = run(tool, stdin="error model: a #1 mistake\n", stdout=output)
            self.assert_fails(done, 1, f"{tool}: no output: model failed")
            self.assertEqual(pathlib.Path("output.txt").read_text(), "error model: a #1 mistake\n")
            self.assert_fails(run(tool, stdin="error model: a #1 mistake\n", stdout=subprocess.DEVNULL), 1,
                              f"{tool}: no output: model failed")

    def test_at_a_terminal_the_message_is_enough(self):
        terminal = Terminal(self)
        self.assert_fails(run("view", stdin="error model: a mistake\n", stdout=terminal.channel), 1,
                          "view: no output: model failed")
        self.assertEqual(terminal.shown(), b"")

    def test_a_tool_that_draws_says_that_there_is_no_picture(self):
        for tool in DRAWING:
            for settings in ({}, {"stdout": subprocess.DEVNULL}):
                self.assert_fails(run(tool, "config.txt", stdin="error model: a #1 mistake\n", **settings), 1,
                                  f"{tool}: no picture: model failed")

    def test_a_reason_without_a_tool_is_told_as_it_is(self):
        for line, told in (("error my-stage: no", "my-stage failed"), ("error a b: c",
                                                                       "an earlier stage failed: a b: c"),
                           ("error no colon", "an earlier stage failed: no colon"),
                           ("error nothing", "an earlier stage failed: nothing"),
                           ("error : x", "an earlier stage failed: : x"),
                           ("error", "an earlier stage failed, without saying why")):
            self.assert_fails(run("zbuf", "config.txt", stdin=line + "\n"), 1, f"zbuf: no picture: {told}")

    def test_from_a_file_the_whole_message_is_repeated(self):
        pathlib.Path("failed.txt").write_text("error model: a #1 mistake\n")
        message = "an earlier stage failed: model: a #1 mistake"
        for tool, *operands in (("view",), ("project",), ("zbuf", "config.txt"), ("trace", "config.txt")):
            self.assert_fails(run(tool, *operands, "failed.txt"), 1, f"{tool}: failed.txt:1:1: {message}")
            self.assert_fails(run_with("< failed.txt", tool, *operands), 1, f"{tool}: <stdin>:1:1: {message}")
        # Whatever standard input is: it is not read.
        self.assert_fails(run("view", "failed.txt", stdin="0 0 0\n"), 1, f"view: failed.txt:1:1: {message}")

    def test_a_named_pipe_and_a_socket_are_pipes(self):
        os.mkfifo("pipe")
        self.assert_fails(shell("echo 'error model: no' > pipe & exec zbuf config.txt pipe"), 1,
                          "zbuf: no picture: model failed")
        ours, theirs = socket.socketpair()
        with ours, theirs:
            ours.sendall(b"error model: no\n")
            ours.shutdown(socket.SHUT_WR)
            done = subprocess.run(command("zbuf", "config.txt"), stdin=theirs, capture_output=True,
                                  timeout=60)
        self.assert_fails(done, 1, "zbuf: no picture: model failed")

    def test_nobody_misses_a_camera_where_an_error_line_says_more(self):
        for tool in ("view", "project"):
            done = run(tool, stdin="error model: no scene\n")
            self.assertEqual((done.returncode, done.stdout, done.stderr),
                             (1, b"error model: no scene\n", b""))


class WholePipe(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)

    def check_no_picture(self, line, *messages):
        self.assert_no_picture(shell(line), *messages)

    def assert_no_picture(self, done, *messages):
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout, b"")
        self.assertEqual(sorted(done.stderr.decode().splitlines()), sorted(messages))
        self.assertEqual(pathlib.Path("out.bmp").read_bytes(), OLD_IMAGE)
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])

    FAILURES = (  # the stage that fails, its words, and its message
        ("model", "--bogus", "expected an option of model, found '--bogus' (try model --help)"),
        ("model", "none.txt", "cannot open none.txt: No such file or directory"),
        ("model", "cut.txt", "cut.txt:9:1: expected 'end', which closes a scene, found the end of the input"),
        ("view", "--bogus", "expected an option of view, found '--bogus' (try view --help)"),
        ("project", "--clip x",
         "--clip: expected auto, near, frustum, reject or none, found 'x' (try project --help)"),
    )

    def test_a_mistake_in_any_stage_leaves_the_old_picture(self):
        for failing, words, message in self.FAILURES:
            pathlib.Path("cut.txt").write_text(CAMERA + TRIANGLE)
            line = " | ".join(f"{tool} {words if tool == failing else 'scene.txt' * (tool == 'model')}"
                              for tool in ("model", "view", "project"))
            done = shell(line + " | zbuf config.txt")
            pathlib.Path("cut.txt").unlink()
            with self.subTest(line):
                self.assert_no_picture(done, f"{failing}: {message}", f"zbuf: no picture: {failing} failed")

    def test_a_mistake_before_trace_leaves_the_old_picture(self):
        why = "view: expected an option of view, found '--bogus' (try view --help)"
        self.check_no_picture("model scene.txt | view --bogus | trace config.txt", why,
                              "trace: no picture: view failed")
        self.check_no_picture(
            "model scene.txt | trace config.txt",
            "trace: <stdin>:1:1: expected the output of view, found 'eye': this text has not been through "
            "view; a view of "
            "your own must drop the lines eye, look and up")
        why = "trace: --samples: expected a whole number from 1 to 16, found '0' (try trace --help)"
        done = shell("model scene.txt | view | trace --samples 0 config.txt")
        self.assertEqual((done.stderr.decode(), done.returncode), (why + "\n", 2))

    def test_a_mistake_is_told_once_and_the_last_stage_adds_a_short_line(self):
        pathlib.Path("scene.txt").write_text(CAMERA + TRIANGLE.replace("triangle", "Triangle"))
        done = shell("model scene.txt | view | project > stage3.txt")
        first, last = done.stderr.decode().splitlines()
        self.assertTrue(first.startswith("model: scene.txt:5:1: expected a command"), first)
        self.assertEqual(last, "project: no output: model failed")
        os.remove("stage3.txt")
        self.check_no_picture("model scene.txt | view | project | zbuf config.txt > /dev/null", first,
                              "zbuf: no picture: model failed")

    def test_a_mistake_in_the_config_leaves_the_old_picture(self):
        pathlib.Path("config.txt").write_text("8 x\n")
        self.check_no_picture(
            "zbuf config.txt < /dev/null", "zbuf: config.txt:1:3: expected the height in pixels, a "
            "whole number from 1 to 65535, found 'x'")

    def test_without_a_mistake_the_picture_is_replaced(self):
        done = shell("model scene.txt | view | project | zbuf config.txt")
        self.assert_quiet_success(done)
        self.assertTrue(pathlib.Path("out.bmp").read_bytes().startswith(b"BM"))
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])


class FramedText(ToolTest):
    def setUp(self):
        super().setUp()
        self.texts = dict(zip(("view", "project", "zbuf"), stage_texts(SCENE, "--framed")))
        self.texts["trace"] = self.texts["project"]

    def options(self, tool):
        return ["config.txt"] if tool in DRAWING else []

    def test_each_stage_passes_the_frame_on(self):
        for text in self.texts.values():
            self.assertTrue(text.startswith(b"framed\n"), text)
            self.assertTrue(text.endswith(b"\n\nend\n"), text)

    def test_the_picture_is_that_of_plain_text(self):
        for tool, operands, text in tool_inputs()[3:]:
            framed = run(tool, *operands, stdin=self.texts[tool])
            image = pathlib.Path("out.bmp").read_bytes()
            plain = run(tool, *operands, stdin=text)
            self.assert_quiet_success(framed)
            self.assertEqual(framed.stdout, plain.stdout)
            self.assertEqual(image, pathlib.Path("out.bmp").read_bytes())

    def test_every_prefix_is_refused_by_every_stage(self):
        for tool, text in self.texts.items():
            # The reader is the same: at all bytes in one stage, at some in the others.
            for length in range(1, len(text), 1 if tool == "zbuf" else 7):
                done = run(tool, *self.options(tool), stdin=text[:length])
                self.assertEqual(done.returncode, 1, f"{tool} takes {text[:length]}")
                self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])

    def test_a_cut_between_triangles_is_told(self):
        lines = self.texts["zbuf"].decode().removesuffix("end\n")
        self.assert_fails(
            run("zbuf", "config.txt", stdin=lines), 1,
            "zbuf: <stdin>:6:1: expected 'end', which closes a framed text, found the end of the input")

    def test_a_stage_that_has_written_nothing_at_all_is_missed_with_framed(self):
        why = "expected a framed text (model --framed), found "
        for tool, operands, text in tool_inputs()[3:]:
            self.assert_fails(run(tool, "--expect-framed", *operands, stdin=b""), 1,
                              f"{tool}: <stdin>:1:1: {why}an empty one")
            body = 2 if tool == "trace" else 1  # a header is no frame
            self.assert_fails(run(tool, "--expect-framed", *operands, stdin=text), 1,
                              f"{tool}: <stdin>:{body}:1: {why}one without 'framed'")
            self.assertEqual(self.files(), ["config.txt", "scene.txt"])
            self.assert_quiet_success(run(tool, "--expect-framed", *operands, stdin=self.texts[tool]))
            pathlib.Path("out.bmp").unlink()

    def test_bare_text_of_a_framed_one_has_no_frame(self):
        done = run("view", "--bare", stdin=self.texts["view"])
        self.assert_quiet_success(done)
        self.assertNotIn(b"e", done.stdout)

    def test_a_cut_before_bare_output_is_told(self):
        done = run("view", "--bare", stdin=self.texts["view"].removesuffix(b"end\n"))
        self.assertEqual(done.returncode, 1)

    def test_a_picture_is_not_begun_before_the_end_of_the_text(self):
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
        for tool in DRAWING:
            run(tool, "config.txt", stdin=self.texts[tool].removesuffix(b"end\n"))
            self.assertEqual(pathlib.Path("out.bmp").read_bytes(), OLD_IMAGE)


class UnframedText(ToolTest):
    def test_it_is_taken_as_it_reads(self):
        done = run("view", "--bare", stdin=HEADER + "0 0 0\n1 0 0\n0 1 0\n\n0 0 0\n1 0 0\n0 1 12")
        self.assert_quiet_success(done)
        self.assertTrue(done.stdout.endswith(b"0.0000000 1.0000000 7.0000000\n\n"), done.stdout)

    def test_a_cut_between_triangles_is_not_noticed(self):
        self.assert_quiet_success(run("zbuf", "config.txt", stdin=stage_texts()[2] * 2))
        done = run("zbuf", "config.txt", stdin=b"")
        self.assertEqual((done.stderr.decode(), done.returncode), (NO_TRIANGLE, 0))

    def test_a_cut_inside_a_triangle_is(self):
        for tool, options in (("view", []), ("project", []), ("zbuf", ["config.txt"]), ("trace", [
                "config.txt"])):
            done = run(tool, *options, stdin=HEADERS[tool] + "0 0 -2\n1 0 -2\n")
            self.assert_fails(
                done, 1,
                f"{tool}: <stdin>:7:1: expected vertex 3 of 3, found the end of the input inside a triangle")


if __name__ == "__main__":
    unittest.main()
