#!/usr/bin/env python3
"""Reads, writes, renames and memory requests fail at any call: the exit status is not 0 or the output is
right, an older good file stays, and nothing else is left.

usage: tools/calls_test.py BIN_DIR FAULT_SHIM [UNITTEST ARGUMENT...]
"""
import errno
import os
import pathlib
import sys
import tempfile
import unittest

from older_files import OLD_IMAGE, OlderImageTest
from toolbox import CAMERA, DRAWING, TRIANGLE, run, stage_texts, tool_inputs

SHIM = str(pathlib.Path(sys.argv.pop(1)).resolve())
EVERY = int(os.environ.get("FAULTS_EVERY", "4"))  # of the allocations, which are many, one in so many fails


class FaultTest(OlderImageTest):
    """Lets one call fail (fault_shim.cpp), for every number of the call that a run reaches."""
    def run_with_fault(self, call, number, error, tool, operands, text):
        """The run, and whether it reached the call."""
        mark = pathlib.Path(self.outside, "mark")
        mark.unlink(missing_ok=True)
        environment = {
            "LD_PRELOAD": SHIM, "FAULT_CALL": call, "FAULT_AT": str(number), "FAULT_ERRNO": str(error),
            "FAULT_MARK": str(mark)}
        return run(tool, *operands, stdin=text, env=environment), mark.exists()

    def setUp(self):
        super().setUp()
        outside = tempfile.TemporaryDirectory()
        self.addCleanup(outside.cleanup)
        self.outside = outside.name


class Faults(FaultTest):
    def each_failing_call(self, call, error, thread_count=None):
        """(failure, run, good output) until a run does not reach the call."""
        for tool, operands, text in tool_inputs():
            if call == "malloc":
                operands = [*operands, "-"]  # words, so that the command line is parsed
            if thread_count and tool in DRAWING:
                operands = [*operands, "--threads", thread_count]
            good, _ = self.good_run(tool, operands, text)
            for number in range(1, 100000, EVERY if call == "malloc" else 1):
                done, was_reached = self.run_with_fault(call, number, error, tool, operands, text)
                if not was_reached:
                    self.assert_quiet_success(done)
                    self.assertGreater(number, 1, f"{tool} never comes to {call}: nothing was tested")
                    pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
                    break
                yield f"{tool}, {call} {number}: {done.stderr}", done, good

    def check_failures(self, call, error, may_succeed=False):
        for which, done, good in self.each_failing_call(call, error):
            if may_succeed and done.returncode == 0:
                self.assertEqual(done.stdout, good, which)
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
            else:
                self.assertEqual(done.returncode, 1, which)
                self.assertEqual(len(done.stderr.splitlines()), 1, which)
            self.assert_as_before()

    def test_any_write_that_fails_is_a_failure(self):
        self.check_failures("write", errno.ENOSPC)

    def test_any_read_that_fails_is_a_failure(self):
        self.check_failures("read", errno.EIO, may_succeed=True)  # not the C library's own reads at startup

    def test_any_close_that_fails_says_so_where_data_may_be_lost(self):
        self.check_failures("close", errno.EIO,
                            may_succeed=True)  # not the close of a file that was only read

    def test_the_image_waits_for_the_close_of_standard_output(self):
        for tool, operands, text in tool_inputs():
            done, was_reached = self.run_with_fault("close of stdout", 1, errno.EIO, tool, operands, text)
            self.assertTrue(was_reached)
            self.assert_fails(done, 1, f"{tool}: cannot write <stdout>: Input/output error")
            self.assert_as_before()

    def check_allocations(self, thread_count=None):
        without_memory = 0
        for which, done, good in self.each_failing_call("malloc", errno.ENOMEM, thread_count):
            # some allocations of the C library and of the C++ library's startup are dispensable
            if done.returncode == 0:
                self.assertEqual(done.stdout, good, which)
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
            else:
                tool = which.split(",")[0]
                self.assertEqual((done.returncode, done.stderr), (1, f"{tool}: not enough memory\n".encode()),
                                 which)
                if tool not in DRAWING and done.stdout:
                    self.assertTrue(done.stdout.endswith(f"error {tool}: not enough memory\n".encode()),
                                    which)
                without_memory += 1
            self.assert_as_before()
        self.assertGreater(EVERY * without_memory, 1500)

    def test_any_allocation_that_fails_is_a_failure_that_says_so(self):
        self.check_allocations()

    def test_on_threads_as_well(self):
        self.check_allocations(thread_count=2)

    def test_while_threads_draw_a_long_text(self):
        # The triangles have several text forms.
        triangles = "".join(f"0.{i:07} 0.5 -3\n0.1234567 0.{i:07} -4\n1 2 -5.5\n\n" for i in range(6000))
        pathlib.Path("config.txt").write_text("20 20\n")
        without_memory = 0
        for count in (2, 3):
            options = ["config.txt", "--threads", count]
            good = run("zbuf", *options, stdin=triangles)
            for number in range(300, 1200, 11):
                done, _ = self.run_with_fault("malloc", number, errno.ENOMEM, "zbuf", options, triangles)
                if done.returncode == 0:
                    self.assertEqual(done.stdout, good.stdout)
                else:
                    self.assertEqual((done.returncode, done.stderr), (1, b"zbuf: not enough memory\n"))
                    without_memory += 1
        self.assertGreater(without_memory, 50)

    def test_any_allocation_of_the_png_library_that_fails_is_a_failure(self):
        tool, operands, text = tool_inputs()[3]
        operands = [*operands, "--image", "new.png"]
        if run(tool, *operands, stdin=text).returncode == 2:
            self.skipTest("a build without libpng")
        pathlib.Path("new.png").unlink()
        messages = set()
        for number in range(1, 100000):
            done, was_reached = self.run_with_fault("malloc", number, errno.ENOMEM, tool, operands, text)
            pathlib.Path("new.png").unlink(missing_ok=done.returncode != 0)
            self.assert_as_before()
            if not was_reached:
                break
            messages.add(done.stderr.decode())
        self.assertLessEqual(
            messages,
            {"", "zbuf: not enough memory\n", "zbuf: cannot write new.png: Cannot allocate memory\n"})
        self.assertIn("zbuf: cannot write new.png: Cannot allocate memory\n", messages)

    def test_an_interrupted_read_or_write_goes_on(self):
        for call in ("read", "write"):
            for which, done, good in self.each_failing_call(call, errno.EINTR):
                self.assertEqual((done.returncode, done.stdout), (0, good), which)

    def test_threads_the_system_refuses_are_done_without(self):
        for tool, operands, text in tool_inputs()[-2:]:
            good, image = self.good_run(tool, operands, text)
            for number in (1, 3):
                done, was_reached = self.run_with_fault("thread", number, errno.EAGAIN, tool,
                                                        [*operands, "--threads", 8], text)
                self.assertTrue(was_reached)
                self.assert_quiet_success(done)
                self.assertEqual((done.stdout, pathlib.Path("out.bmp").read_bytes()), (good, image))

    @unittest.skipIf(len(os.sched_getaffinity(0)) == 1, "there is one core")
    def test_threads_start_where_a_picture_is_worth_two(self):
        """A thread takes 2^21 samples; a sample counts one and four for each light, a ray or a triangle
        counts 256."""
        *_, (zbuf, _, ndc), (trace, _, view) = tool_inputs()
        lit = stage_texts(CAMERA + "light 1 2 3 1 1 1\nlight 3 2 1 1 1 1\n" + TRIANGLE + "end\n")[2]
        for tool, text, options, size, expected in ((zbuf, ndc, [], "2048x2047",
                                                     False), (zbuf, ndc, [], "2048x2048", True), (zbuf, ndc, [
                                                         "--samples", 2
                                                     ], "1024x1024", True), (zbuf, lit, [], "682x683", False),
                                                    (zbuf, lit, [], "683x683", True), (zbuf, lit, [
                                                        "--threads", 1], "683x683", False), (zbuf, lit, [
                                                            "--shading",
                                                            "none"], "683x683", False), (trace, view, [],
                                                                                         "126x130", False),
                                                    (trace, view, [], "128x128", True), (trace, view, [
                                                        "--samples", 2], "64x64", True)):
            done, was_started = self.run_with_fault("thread", 1, errno.EAGAIN, tool,
                                                    ["--size", size, "--z-buffer", "none", *options], text)
            self.assertEqual((done.returncode, was_started), (0, expected), (tool, options, size))

    def test_a_link_or_rename_that_fails_leaves_the_old_image(self):
        tool, operands, text = tool_inputs()[3]
        self.good_run(tool, operands, text)
        for call in ("link", "rename"):
            done, was_reached = self.run_with_fault(call, 1, errno.EPERM, tool, operands, text)
            if call == "link" and not was_reached:
                self.skipTest("this file system has no files without a name")
            self.assert_fails(done, 1, "zbuf: cannot replace out.bmp: Operation not permitted")
            self.assert_as_before()

    def test_a_bmp_is_written_from_its_end_where_the_file_can_seek(self):
        """The first seek is only a probe; if it fails, the picture is kept until it can be written as a
        whole."""
        tool, operands, text = tool_inputs()[3]
        good, image = self.good_run(tool, operands, text)
        done, was_reached = self.run_with_fault("seek", 1, errno.ESPIPE, tool, operands, text)
        self.assertTrue(was_reached)
        self.assert_quiet_success(done)
        self.assertEqual((done.stdout, pathlib.Path("out.bmp").read_bytes()), (good, image))
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
        done, was_reached = self.run_with_fault("seek", 2, errno.EIO, tool, operands, text)
        self.assertTrue(was_reached)
        self.assert_fails(done, 1, "zbuf: cannot write out.bmp: Input/output error")
        self.assert_as_before()

    def test_reads_and_writes_of_one_byte_change_nothing(self):
        for tool, operands, text in tool_inputs():
            good, image = self.good_run(tool, operands, text)
            done = run(tool, *operands, stdin=text, env={"LD_PRELOAD": SHIM, "FAULT_SHORT": "1"})
            self.assert_quiet_success(done)
            self.assertEqual(done.stdout, good)
            self.assertEqual(pathlib.Path("out.bmp").read_bytes(), image if tool in DRAWING else OLD_IMAGE)


class ManyFiles(FaultTest):
    """zbuf writes several files, some through libpng: until everything is written, all of them are the old
    ones."""

    TOOL = "zbuf"

    def each_failing_call(self, call, error, options):
        """(failure, run, the files then, the good files) until a run does not reach the call."""
        names = [word for word in options if "." in word]
        tool, operands, text = next(row for row in tool_inputs() if row[0] == self.TOOL)
        done = run(tool, *operands, *options, stdin=text)
        if b"without libpng" in done.stderr:
            self.skipTest("built without libpng")
        self.assert_quiet_success(done)
        good = {name: pathlib.Path(name).read_bytes() for name in names}
        for number in range(1, 100000, EVERY if call == "malloc" else 1):
            for name in names:
                pathlib.Path(name).write_bytes(OLD_IMAGE)
            done, was_reached = self.run_with_fault(call, number, error, tool, [*operands, *options], text)
            if not was_reached:
                self.assertGreater(number, 1, f"{tool} never comes to {call}: nothing was tested")
                for name in names:
                    os.unlink(name)
                return
            which = f"{call} {number} of {tool} {options}: {done.stderr}"
            self.assertEqual(self.files(), sorted({"config.txt", "out.bmp", "scene.txt", *names}), which)
            yield which, done, {name: pathlib.Path(name).read_bytes() for name in names}, good

    def check(self, call, error, *options, some_may_be_new=False):
        for which, done, files, good in self.each_failing_call(call, error, options):
            if done.returncode == 0:  # the close of a file that was only read, or a dispensable allocation
                self.assertEqual((files, call in ("close", "malloc")), (good, True), which)
                continue
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), which)
            for name, content in files.items():
                self.assertIn(content, (OLD_IMAGE, good[name]) if some_may_be_new else (OLD_IMAGE,), which)

    PLAIN = [
        "--image", "out.ppm", "--z-buffer", "depths.txt", "--depth-image", "depths.pgm", "--depth-array",
        "depths.npy", "--triangle-array", "triangles.npy", "--fragments", "fragments.txt", "--seen",
        "seen.txt", "--stats", "stats.txt"]
    PNGS = ["--image", "out.png", "--depth-image", "depths.png"]

    def test_a_failing_write_or_close_leaves_every_old_file(self):
        for options in (self.PLAIN, self.PNGS):
            self.check("write", errno.ENOSPC, *options)
            self.check("close", errno.EIO, *options)

    BMP = ["--image", "out-new.bmp"]

    def test_the_failing_close_of_any_file_that_was_written_is_a_failure(self):
        for options in (self.BMP, self.PLAIN, self.PNGS):
            messages = set()
            for which, done, files, _ in self.each_failing_call("close of data", errno.EIO, options):
                self.assertEqual((done.returncode, set(files.values())), (1, {OLD_IMAGE}), which)
                messages.add(done.stderr.decode())
            self.assertEqual(messages, {
                f"{self.TOOL}: cannot write {name}: Input/output error\n"
                for name in options if "." in name})

    def test_an_interrupted_write_or_close_of_any_file_goes_on(self):
        for options in (self.BMP, self.PLAIN, self.PNGS):
            for call in ("write", "close of data"):
                for which, done, files, good in self.each_failing_call(call, errno.EINTR, options):
                    self.assertEqual((done.returncode, done.stderr, files), (0, b"", good), which)

    def test_without_proc_files_have_temporary_names(self):
        """A tool asks whether it may replace a file, and then whether /proc is there, without which a file
        needs a name."""
        for options in (self.BMP, self.PLAIN, self.PNGS):
            names = sorted(name for name in options if "." in name)
            outcomes = [(done.stderr.decode(), set(files.values())) if done.returncode != 0 else files == good
                        for _, done, files, good in self.each_failing_call("access", errno.EACCES, options)]
            self.assertEqual(sorted(outcomes[::2]), [
                (f"{self.TOOL}: cannot open {name}: Permission denied\n", {OLD_IMAGE}) for name in names])
            self.assertEqual(outcomes[1::2], [True] * len(names))

    def test_a_failing_rename_leaves_old_files_or_complete_ones(self):
        self.check("rename", errno.EPERM, *self.PLAIN, some_may_be_new=True)

    def test_a_failing_allocation_leaves_old_files_or_complete_ones(self):
        for options in (self.PLAIN, self.PNGS):
            self.check("malloc", errno.ENOMEM, *options, some_may_be_new=True)


class ManyTracedFiles(ManyFiles):
    """So does trace."""

    TOOL = "trace"
    PLAIN = [
        "--image", "out.ppm", "--z-buffer", "depths.txt", "--depth-image", "depths.pgm", "--depth-array",
        "depths.npy", "--triangle-array", "triangles.npy", "--stats", "stats.txt"]


if __name__ == "__main__":
    unittest.main()
