#!/usr/bin/env python3
"""Full disks, closed pipes, missing channels: nothing is lost silently, nothing waits forever, nothing is
left behind.

usage: faults_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import signal
import subprocess
import time
import unittest

from toolbox import (ALL_TOOLS, CAMERA, DRAWING, HEADER, HEADERS, TRIANGLE, Terminal, ToolTest, add_claims,
                     command, run, run_with, stage_texts)

VERTICES = "0 0 -2\n1 0 -2\n0 1 -2\n\n"
OPERANDS = {"model": [], "view": [], "project": [], "zbuf": ["config.txt"], "trace": ["config.txt"]}
TRACED = "ortho -1 1 -1 1 1 3\n"
GLASS = "light 1 2 0 1 1 1\nmaterial 1 1 1 9 0.2 1.5 0.3\nabsorption 1 0 2\n"
OLD_IMAGE = b"an older image"
LARGE_PICTURES = {"zbuf": "-1 -1 0\n1 -1 0\n-1 1 0\n", "trace": TRACED + "-1 -1 -2\n1 -1 -2\n-1 1 -2\n"}


def small_and_large_inputs():
    """(tool, input) pairs with an output below and far above 64 KiB."""
    for count in (1, 5000):
        yield "model", CAMERA + TRIANGLE * count + "end\n"
        yield "view", HEADER + VERTICES * count
        yield "project", HEADERS["project"] + VERTICES * count
    yield "zbuf", "0 0 0\n0.1 0 0\n0 0.1 0\n"
    yield "trace", TRACED + "0 0 -2\n0.1 0 -2\n0 0.1 -2\n"
    yield "trace", TRACED + GLASS + "sphere\n0 0 -2\n0.1 0 -2\n0 0.1 -2\n0 0 -1.9\n"
    yield "trace", TRACED + GLASS + "sphere\n0 0 -2\n0.9 0 -2\n0 0.9 -2\n0 0 -1.1\n"
    yield from LARGE_PICTURES.items()


class FaultTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("200 200\n")  # 20,000 depths: 180 KB of text
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)

    def assert_nothing_happened(self):
        """The older image is unchanged and no temporary file is left."""
        self.assertEqual(pathlib.Path("out.bmp").read_bytes(), OLD_IMAGE)
        self.assertEqual(
            [name for name in self.files() if name not in ("config.txt", "scene.txt", "input.txt")],
            ["out.bmp"])


class Failing(FaultTest):
    def check(self, channels, runs, reason):
        """Runs (words, input) under a redirection, each of which fails for the reason alone and leaves
        nothing."""
        for words, text in runs:
            with self.subTest(words=words, size=len(text)):
                done = run_with(channels, *words, input=text.encode())
                self.assert_fails(done, 1, f"{words[0]}: {reason}")
        self.assert_nothing_happened()


EACH_INPUT = [((tool, *OPERANDS[tool]), text) for tool, text in small_and_large_inputs()]
EACH_TOOL = [((tool, *OPERANDS[tool]), "") for tool in ALL_TOOLS]
HELP = [((tool, option), "") for tool in ALL_TOOLS for option in ("--help", "--version")]
DEPTHS, IMAGE = ([((tool, "config.txt", option, "/dev/full"), text) for tool, text in LARGE_PICTURES.items()]
                 for option in ("--z-buffer", "--image"))
FULL, NO_CHANNEL = "No space left on device", "Bad file descriptor"
add_claims(Failing, (
    ("a full stdout is a failure", "> /dev/full", EACH_INPUT, f"cannot write <stdout>: {FULL}"),
    ("a full stdout is one also for a header alone", "> /dev/full", [
        (("model",), CAMERA + "end\n")], f"cannot write <stdout>: {FULL}"),
    ("help and version are data too", "> /dev/full", HELP, f"cannot write <stdout>: {FULL}"),
    ("a mistake is reported although its error line finds no room", "> /dev/full", [
        (("view",), "x\n")], "<stdin>:1:1: expected a header line, 'triangle N' or a vertex, found 'x'"),
    ("a full file of depths leaves the old image", "", DEPTHS, f"cannot write /dev/full: {FULL}"),
    ("a full image is a failure", "", IMAGE, f"cannot write /dev/full: {FULL}"),
    ("a closed stdin is a failure", "<&-", EACH_TOOL, f"cannot read <stdin>: {NO_CHANNEL}"),
    ("a folder as stdin is a failure", "< /", EACH_TOOL, "cannot read <stdin>: Is a directory"),
    ("a closed stdout is a failure", ">&-", EACH_INPUT, f"cannot write <stdout>: {NO_CHANNEL}"),
))


class ClosedReader(FaultTest):
    """The reader of the output has gone, as `head` does."""
    def run_without_reader(self, tool, text, ignore):
        pathlib.Path("input.txt").write_text(text)
        end, writing = os.pipe()
        os.close(end)
        settings = {
            "preexec_fn": lambda: signal.signal(signal.SIGPIPE, signal.SIG_IGN
                                                if ignore else signal.SIG_DFL), "restore_signals": False}
        begin = time.monotonic()
        try:
            done = run(tool, *OPERANDS[tool], "input.txt", stdout=writing, **settings)
        finally:
            os.close(writing)
        self.assertLess(time.monotonic() - begin, 3)  # a second, plus slack for a busy machine
        self.assertEqual(done.stderr, b"")
        return done.returncode

    def test_it_ends_a_filter_quietly(self):
        for tool, text in small_and_large_inputs():
            if tool in DRAWING:
                continue
            with self.subTest(tool=tool, size=len(text)):
                self.assertEqual(self.run_without_reader(tool, text, ignore=False), -signal.SIGPIPE)

    def test_it_is_a_failure_where_the_signal_is_ignored(self):
        for tool, text in small_and_large_inputs():
            with self.subTest(tool=tool, size=len(text)):
                self.assertEqual(self.run_without_reader(tool, text, ignore=True), 1)
        self.assert_nothing_happened()

    def test_a_tool_that_draws_removes_the_image_it_has_begun(self):
        for tool, text in small_and_large_inputs():
            if tool in DRAWING:
                self.assertEqual(self.run_without_reader(tool, text, ignore=False), 1)
        self.assert_nothing_happened()

    def test_it_ends_a_filter_whose_input_never_ends(self):
        endless = {
            "model": ("triangle 0 0 0\n1 0 0\n0 1 0\n", CAMERA), "view": (VERTICES, HEADER),
            "project": (VERTICES, HEADERS["project"])}
        for tool, (repeated, start) in endless.items():
            pathlib.Path("input.txt").write_text(start + repeated)
            script = ('{ cat input.txt; yes "$1"; } 2>/dev/null | { "$2"; echo $? > status; } 2> errors | '
                      'head -c 1000')
            begin = time.monotonic()
            subprocess.run([
                "sh", "-c", script, "sh",
                repeated.rstrip("\n") + ("" if tool == "model" else "\n"), *command(tool)],
                           stdout=subprocess.DEVNULL, timeout=20)
            self.assertLess(time.monotonic() - begin, 3)
            self.assertEqual(pathlib.Path("errors").read_text(), "")
            self.assertNotEqual(pathlib.Path("status").read_text().strip(), "0")


class MissingChannels(FaultTest):
    def test_a_closed_stdin_does_no_harm_where_it_is_not_read(self):
        expected = run("model", "scene.txt").stdout
        done = run_with("<&-", "model", "scene.txt")
        self.assert_quiet_success(done)
        self.assertEqual(done.stdout, expected)

    def test_no_file_takes_the_place_of_a_closed_stdout(self):
        for tool, text in LARGE_PICTURES.items():
            depths = run(tool, "config.txt", stdin=text).stdout
            image = pathlib.Path("out.bmp").read_bytes()
            done = run_with(">&-", tool, "config.txt", "--z-buffer", "z.txt", input=text.encode())
            self.assert_quiet_success(done)
            self.assertEqual(pathlib.Path("z.txt").read_bytes(), depths)
            self.assertEqual(pathlib.Path("out.bmp").read_bytes(), image)

    def test_no_file_takes_the_place_of_a_closed_stderr(self):
        pathlib.Path("config.txt").write_text("8 8\n")
        expected = run("zbuf", "config.txt", stdin=stage_texts()[2])
        image = pathlib.Path("out.bmp").read_bytes()
        done = run_with("2>&-", "zbuf", "config.txt", "--timing", input=stage_texts()[2])
        self.assertEqual((done.returncode, done.stdout), (0, expected.stdout))
        self.assertEqual(pathlib.Path("out.bmp").read_bytes(), image)

    def test_a_mistake_has_its_status_without_a_stderr(self):
        self.assertEqual(run_with("2>&-", "model", input=b"").returncode, 1)
        self.assertEqual(run_with("2>&-", "model", "--bogus").returncode, 2)

    def test_with_all_channels_closed_it_ends(self):
        for tool in ALL_TOOLS:
            self.assertEqual(run_with("<&- >&- 2>&-", tool, *OPERANDS[tool]).returncode, 1)


class OnATerminal(ToolTest):
    def test_a_mistake_is_shown_once(self):
        terminal = Terminal(self)
        self.assertEqual(run("model", stdin="x\n", stdout=terminal.channel).returncode, 1)
        self.assertEqual(terminal.shown(), b"")


if __name__ == "__main__":
    unittest.main()
