#!/usr/bin/env python3
"""Output appears while input is still arriving, and memory does not grow with the number of triangles.

usage: streaming_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import fcntl
import filecmp
import os
import pathlib
import re
import resource
import select
import subprocess
import time
import unittest

from toolbox import CAMERA, HEADER, HEADERS, SCENE, TRIANGLE, ToolTest, command, run, stage_texts

MEBIBYTE = 1024  # in the units of /proc, which are KiB
VERTICES = ("0.1234567 -1.2345678 -12.3456789\n1.1234567 -1.2345678 -12.3456789\n0.1234567 -0.2345678 "
            "-12.3456789\n")


class LiveTool:
    """A tool whose input is written piece by piece."""
    def __init__(self, tool, *options, stdout=subprocess.PIPE):
        self.process = subprocess.Popen(command(tool, *options), stdin=subprocess.PIPE, stdout=stdout,
                                        stderr=subprocess.PIPE)
        self.received = b""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        for channel in (self.process.stdin, self.process.stdout, self.process.stderr):
            if channel:
                channel.close()

    def send(self, text):
        self.process.stdin.write(text.encode() if isinstance(text, str) else text)
        self.process.stdin.flush()

    def receive(self, triangle_count, seconds=10):
        """Reads output until it has so many complete triangles, or until the time is over; returns their
        number."""
        end = time.monotonic() + seconds
        while self.received.count(b"\n\n") < triangle_count:
            ready, _, _ = select.select([self.process.stdout], [], [], max(0, end - time.monotonic()))
            block = self.process.stdout.read1() if ready else b""
            if not block:
                break
            self.received += block
        return self.received.count(b"\n\n")

    def finish(self):
        """The exit status, after the input has ended."""
        self.process.stdin.close()
        self.received += self.process.stdout.read() if self.process.stdout else b""
        return self.process.wait(timeout=60)

    def peak_memory(self):
        """The largest resident set so far in KiB: of this program alone, not of the process that started
        it."""
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmHWM:\s+(\d+) kB", status.read()).group(1))


class Streaming(ToolTest):
    def check(self, tool, start, piece, end):
        """Each piece, a triangle, leaves the tool before the next one is sent."""
        with LiveTool(tool) as live:
            live.send(start)
            for i in range(1, 6):
                live.send(piece)
                self.assertEqual(live.receive(i), i, f"{tool} waits with triangle {i} in its hands")
            live.send(end)
            self.assertEqual(live.finish(), 0)

    def test_model_passes_every_triangle_on_at_once(self):
        self.check("model", CAMERA, TRIANGLE, "end\n")

    def test_model_passes_it_on_behind_other_commands(self):
        self.check("model", CAMERA, TRIANGLE + "push\ntranslate 1 0 0\npop\n\n# c\n", "end\n")

    def test_model_passes_it_on_while_the_next_is_cut(self):
        with LiveTool("model") as live:
            live.send(CAMERA + TRIANGLE + "triangle\n0 0 0\n1 0 0\n0 ")
            self.assertEqual(live.receive(1), 1)

    def test_view_passes_every_triangle_on_at_once(self):
        self.check("view", HEADER, VERTICES + "\n", "")

    def test_project_passes_every_triangle_on_at_once(self):
        self.check("project", HEADERS["project"], VERTICES + "\n", "")

    def test_view_and_project_pass_it_on_while_the_next_is_cut(self):
        for tool in ("view", "project"):
            with LiveTool(tool) as live:
                live.send(HEADERS[tool] + VERTICES + "\n" + VERTICES[:-3])
                self.assertEqual(live.receive(1), 1)

    def test_they_pass_them_on_whatever_stands_behind(self):
        texts = {"view": HEADER + 2048 * "0 0 0\n1 0 0\n0 1 0\n\n", "model": CAMERA + 2048 * TRIANGLE}
        for tool, behind in (("view", "triangle 1\n" * 8), ("view", "# " + 150000 * "c"),
                             ("view", "# c\n" * 20000), ("model", "push\npop\n" * 3), ("model",
                                                                                       "# " + 150000 * "c")):
            with LiveTool(tool) as live:
                live.send(texts[tool] + behind)
                self.assertEqual(live.receive(2048), 2048, (tool, behind[:10]))

    def test_a_stage_refuses_a_line_at_once(self):
        with LiveTool("view") as live:
            live.send("0 0 5\n")
            self.assertEqual(live.process.wait(60), 1)
            self.assertIn(b"found no eye, look or up", live.process.stderr.read())

    def test_framed_text_is_passed_on_at_once_as_well(self):
        self.check("view", "framed\n" + HEADER, VERTICES + "\n", "end\n")


class Errors(ToolTest):
    """An error is reported after the triangles before it are written, whatever the batch size."""

    COUNT = 3000
    GOOD = "0 0 -1\n1 0 -1\n0 1 -1\n\n"

    def assert_error_behind(self, triangle_count, message, tool, *options, stdin):
        done = run(tool, *options, stdin=stdin)
        self.assertEqual(done.returncode, 1)
        self.assertIn(message, done.stdout.decode().splitlines()[-1])
        self.assertEqual(done.stdout.count(b"\n\n"), triangle_count)

    def test_in_the_text(self):
        text = self.GOOD * self.COUNT
        for mistake, message in (("1 2 3\n4 5 six\n", ":12006:5: "), ("eye 1 2 3\n", ":12005:1: "),
                                 ("1 2 3\n\n", ":12006:1: "), ("error model: it broke\n",
                                                               "it broke"), ("1 2 3 ", ":12005:7: ")):
            self.assert_error_behind(self.COUNT, message, "view", stdin=HEADER + text + mistake + text)

    def test_in_a_scene(self):
        text = TRIANGLE * self.COUNT
        for mistake, message in (("triangle\n1 2 3\n4 5 six\n", ":12007:5: "), ("pop\n", ":12005:1: ")):
            self.assert_error_behind(self.COUNT, message, "model", stdin=CAMERA + text + mistake + text)

    def test_of_a_vertex_that_has_no_image(self):
        beyond = "triangle\n1e300 0 0\n0 0 0\n0 0 0\n"
        self.assert_error_behind(
            self.COUNT + 1, ":12011:1: ", "model",
            stdin=CAMERA + TRIANGLE * self.COUNT + "scale 1e300 1 1\n" + TRIANGLE + beyond + "pop\n")
        self.assert_error_behind(self.COUNT, "overflow", "view", "--eye", "-1e308", "0", "0", "--look", "0",
                                 "0", "0", "--up", "0", "1", "0",
                                 stdin=self.GOOD * self.COUNT + "1.7e308 0 0\n0 0 0\n0 0 0\n\nnonsense\n")
        self.assert_error_behind(self.COUNT, "a vertex in front of the eye", "project", "--clip", "none",
                                 "--perspective", "60", "1", "1", "100",
                                 stdin=self.GOOD * self.COUNT + "0 0 1\n0 0 1\n0 0 1\n\nnonsense\n")


class Pieces(ToolTest):
    def test_the_sizes_in_which_text_arrives_change_nothing(self):
        inputs = zip(("model", "view", "project"), (SCENE.encode(), *stage_texts(SCENE, "--framed")))
        for tool, text in inputs:
            expected = run(tool, stdin=text).stdout
            for size in (1, 2, 7):
                with LiveTool(tool) as live:
                    for begin in range(0, len(text), size):
                        live.send(text[begin:begin + size])
                    self.assertEqual(live.finish(), 0)
                    self.assertEqual(live.received, expected)


F_SETPIPE_SZ, F_GETPIPE_SZ = 1031, 1032  # Linux; Python has names for them since 3.10


def pipe_of(size):
    """The ends of a pipe with this capacity; the test is skipped if the system allows none."""
    ends = [os.fdopen(end, mode, buffering=0) for end, mode in zip(os.pipe(), ("rb", "wb"))]
    try:
        fcntl.fcntl(ends[0], F_SETPIPE_SZ, size)
    except OSError as error:
        for end in ends:
            end.close()
        raise unittest.SkipTest(f"no pipe of {size} bytes here: {error}")
    return ends


@unittest.skipUnless(os.uname().sysname == "Linux", "the size of a pipe can be set on Linux alone")
class PipeSize(ToolTest):
    def sizes_after_a_run(self, size):
        """The capacities of a tool's input and output pipes after a run that starts with pipes of `size`."""
        mebibyte_ends = pipe_of(1 << 20)  # skips the test if the system forbids the tool's size
        for end in mebibyte_ends:
            end.close()
        source, feed = pipe_of(size)
        drain, sink = pipe_of(size)
        with source, feed, drain, sink:
            feed.write(SCENE.encode())
            feed.close()
            done = subprocess.run(command("model"), stdin=source, stdout=sink, stderr=subprocess.PIPE,
                                  timeout=60)
            self.assert_quiet_success(done)
            return fcntl.fcntl(source, F_GETPIPE_SZ), fcntl.fcntl(drain, F_GETPIPE_SZ)

    def test_a_tool_lets_its_pipes_hold_a_mebibyte(self):
        self.assertEqual(self.sizes_after_a_run(1 << 16), (1 << 20, 1 << 20))

    def test_a_tool_makes_no_pipe_smaller(self):
        self.assertEqual(self.sizes_after_a_run(1 << 21), (1 << 21, 1 << 21))


INPUTS = {
    "model": (CAMERA, "triangle\n" + VERTICES, "end\n"), "view": (HEADER, VERTICES + "\n", ""),
    "project": (HEADERS["project"], VERTICES + "\n", "")}


def peak_memory(tool, start, repeated, count, end, *options):
    """The peak memory in KiB of a tool that reads `repeated` `count` times."""
    block_count = 10_000
    with LiveTool(tool, *options, stdout=subprocess.DEVNULL) as live:
        live.send(start)
        block = repeated * block_count
        for _ in range(count // block_count):
            live.send(block)
        memory = live.peak_memory()
        live.send(end)
        status = live.finish()
        if status != 0:
            raise AssertionError(f"{tool}: exit {status}: {live.process.stderr.read().decode()}")
        return max(memory, 1)


class Memory(ToolTest):
    def test_it_does_not_grow_with_the_number_of_triangles(self):
        for tool, (start, triangle, end) in INPUTS.items():
            few = peak_memory(tool, start, triangle, 20_000, end)
            many = peak_memory(tool, start, triangle, 200_000, end)
            self.assertLess(many, few + MEBIBYTE,
                            f"{tool}: {few} KiB for 20,000 triangles, {many} KiB for 200,000")
            self.assertLess(many, 16 * MEBIBYTE, tool)

    def test_long_digits_stay_below_16_mebibytes(self):
        for tool, (start, triangle, end) in INPUTS.items():
            memory = peak_memory(tool, start, triangle, 200_000, end, "--digits", "exact")
            self.assertLess(memory, 16 * MEBIBYTE, tool)

    def test_ten_million_pushes_stay_below_64_mebibytes(self):
        self.assertLess(peak_memory("model", CAMERA, "push\n", 10_000_000, "end\n"), 64 * MEBIBYTE)

    def test_nor_does_split_take_more_for_them(self):
        pathlib.Path("scene.txt").write_text(CAMERA + "push\n" * 5_000_000 + TRIANGLE + "push\n" * 5_000_000 +
                                             "end\n")
        done = run("cut-scene", "scene.txt", "1",
                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, 2 * (64 * 2**20,)))
        self.assert_quiet_success(done)
        self.assertTrue(filecmp.cmp("scene.txt", "parts/1.txt", shallow=False))

    def test_it_does_not_grow_with_the_number_of_transforms(self):
        transform = "push\nrotate 1 0 0 1\npop\n"
        few = peak_memory("model", CAMERA, transform, 20_000, "end\n")
        many = peak_memory("model", CAMERA, transform, 200_000, "end\n")
        self.assertLess(many, few + MEBIBYTE)


class BufferMemory(ToolTest):
    """zbuf needs its buffers, 12 bytes a pixel in doubles with color, and less than 32 MiB more."""

    SIZE = 2048
    LARGE = ("-1.0000000 -1.0000000 0.5000000\n0.2000000 -1.0000000 0.5000000\n-1.0000000 1.0000000 "
             "0.5000000\n\n")
    SMALL = "0.0100000 0.0100000 0.1000000\n0.0110000 0.0100000 0.1000000\n0.0100000 0.0110000 0.1000000\n\n"

    def memory_beside_buffers(self, *options):
        """The peak memory in KiB, until the last depths are written."""
        pathlib.Path("config.txt").write_text(f"{self.SIZE} {self.SIZE}\n")
        pathlib.Path("stage3.txt").write_text((self.LARGE + self.SMALL * 999) * 200)
        with LiveTool("zbuf", "config.txt", "stage3.txt", "--image", "/dev/null", *options) as live:
            memory = 0
            while live.process.stdout.read1():
                with contextlib.suppress(OSError, AttributeError):  # it may have ended by now
                    memory = live.peak_memory()
            self.assertEqual(live.finish(), 0)
        buffers = 12 * self.SIZE**2 // 1024
        self.assertGreater(memory, buffers)
        return memory - buffers

    def test_on_any_number_of_threads(self):
        for threads in (1, 2, 8):
            self.assertLess(self.memory_beside_buffers("--threads", str(threads)), 32 * MEBIBYTE,
                            f"{threads} threads")

    def test_under_the_exact_rule(self):
        self.assertLess(self.memory_beside_buffers("--coverage", "center"), 32 * MEBIBYTE)


class LongMemory(ToolTest):
    """Takes minutes."""
    def test_ten_million_triangles_stay_below_16_mebibytes(self):
        for tool, (start, triangle, end) in INPUTS.items():
            self.assertLess(peak_memory(tool, start, triangle, 10_000_000, end), 16 * MEBIBYTE, tool)

    def test_a_million_saved_matrices_are_the_limit(self):
        pushes = "push\ntranslate 1 0 0\n"
        limit = 1 << 20
        done = run("model", stdin=CAMERA + pushes * limit + "push\nend\n")
        self.assert_fails(
            done, 1, f"model: <stdin>:{5 + 2 * limit}:1: expected at most 1048576 saved matrices, found "
            "another 'push' after a change")


if __name__ == "__main__":
    unittest.main()
