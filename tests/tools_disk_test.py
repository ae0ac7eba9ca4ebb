#!/usr/bin/env python3
"""Disks that fill at any byte, memory, reads, writes and renames that fail at any call, neighbours that are killed:
whatever happens, the exit status is not 0 or the output is right, an older good file stays, nothing else is left.

usage: tools_disk_test.py BIN_DIR FAULT_SHIM [UNITTEST ARGUMENT...]
"""
import errno
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

from toolbox import CAMERA, SCENE, TRIANGLE, ToolTest, command, run, stage_texts

SHIM = str(pathlib.Path(sys.argv.pop(1)).resolve())
OLD_IMAGE = b"an older image"
NOBODY = 65534


def small_inputs():
    """(tool, its operands, its input)."""
    world, view, ndc = stage_texts()
    return (("model", [], SCENE.encode()), ("view", [], world), ("project", [], view), ("zbuf", ["config.txt"], ndc))


class DiskTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("4 3\n")
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)

    def good_run(self, tool, operands, text):
        """(stdout, image) of a run that meets no fault; the older image is put back."""
        done = run(tool, *operands, stdin=text)
        self.assert_quiet_success(done)
        image = pathlib.Path("out.bmp").read_bytes()
        pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
        return done.stdout, image

    def assert_as_before(self):
        self.assertEqual(pathlib.Path("out.bmp").read_bytes(), OLD_IMAGE)
        self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])


class FilledDisk(DiskTest):
    def run_limited(self, size, tool, operands, text):
        """A run that may write no file beyond `size` bytes; stdout is a file elsewhere."""
        with tempfile.TemporaryFile() as out:
            done = run(tool, *operands, stdin=text, stdout=out,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            out.seek(0)
            return done, out.read()

    def test_at_any_byte_it_is_a_failure_and_nothing_is_left(self):
        for tool, operands, text in small_inputs():
            good, image = self.good_run(tool, operands, text)
            needed = max(len(good), len(image) if tool == "zbuf" else 0)
            for size in range(needed):
                with self.subTest(tool=tool, size=size):
                    done, _ = self.run_limited(size, tool, operands, text)
                    self.assertEqual(done.returncode, 1)
                    self.assertRegex(done.stderr.decode(), f"^{tool}: cannot write (<stdout>|out.bmp): File too large\n$")
                    self.assert_as_before()
            done, out = self.run_limited(needed, tool, operands, text)
            self.assert_quiet_success(done)
            self.assertEqual(out, good)


class Folders(DiskTest):
    def check(self, image, reason, **settings):
        done = run("zbuf", "config.txt", "--image", image, stdin=stage_texts()[2], **settings)
        self.assert_fails(done, 1, f"zbuf: cannot open {image}: {reason}")
        self.assert_as_before()

    def test_a_missing_one_is_a_failure(self):
        self.check("missing/out.bmp", "No such file or directory")

    def test_a_device_is_none(self):
        self.check("/dev/full/out.bmp", "Not a directory")

    def test_one_that_may_not_be_written_is_a_failure(self):
        if os.geteuid() != 0:
            self.skipTest("only root can become somebody else")
        os.chmod(".", 0o755)
        self.addCleanup(shutil.rmtree, tools := tempfile.mkdtemp())
        os.chmod(tools, 0o755)
        shutil.copy(command("zbuf")[0], tools)
        for image in ("new.bmp", "out.bmp"):
            done = subprocess.run([f"{tools}/zbuf", "config.txt", "--image", image], input=stage_texts()[2], capture_output=True,
                                  user=NOBODY, timeout=60)
            self.assert_fails(done, 1, f"zbuf: cannot open {image}: Permission denied")
            self.assert_as_before()


class SmallFileSystem(DiskTest):
    """File systems of the test's own, in a namespace that ends with the command."""

    def run_there(self, mount_options, words, text):
        """A command in a new file system that holds the older image; afterwards what that file system holds is listed on stdout."""
        script = ('mkdir there && mount -t tmpfs -o size=64k none there && cp out.bmp there || exit 77; cd there; mount -o "remount,$0" . || exit 77; '
                  '"$@"; status=$?; cmp -s out.bmp ../out.bmp && echo the older image; ls -A; exit $status')
        done = subprocess.run(["unshare", "--mount", "--map-root-user", "sh", "-c", script, mount_options, *words], input=text,
                              capture_output=True, timeout=60)
        shutil.rmtree("there", ignore_errors=True)
        if done.returncode == 77 or done.stderr.startswith(b"unshare: "):
            self.skipTest("mounting is not allowed here: " + done.stderr.decode().strip())
        return done

    def test_one_that_is_read_only_is_a_failure(self):
        for image, reason in (("new.bmp", "Read-only file system"), ("out.bmp", "Read-only file system")):
            done = self.run_there("ro", command("zbuf", "../config.txt", "--image", image, "--z-buffer", "../depths"), stage_texts()[2])
            self.assertEqual((done.returncode, done.stderr.decode()), (1, f"zbuf: cannot open {image}: {reason}\n"))
            self.assertEqual(done.stdout, b"the older image\nout.bmp\n")

    def test_one_that_is_full_is_a_failure_and_nothing_is_left(self):
        pathlib.Path("config.txt").write_text("200 200\n")  # an image of 120 kB
        done = self.run_there("rw", command("zbuf", "../config.txt", "--z-buffer", "../depths"), stage_texts()[2])
        self.assertEqual((done.returncode, done.stderr), (1, b"zbuf: cannot write out.bmp: No space left on device\n"))
        self.assertEqual(done.stdout, b"the older image\nout.bmp\n")


class FaultTest(DiskTest):
    """One call fails (fault_shim.cpp), for every number of the call that a run comes to."""

    def run_with_fault(self, call, number, error, tool, operands, text):
        """The run, and whether it came to the call."""
        mark = pathlib.Path(self.outside, "mark")
        mark.unlink(missing_ok=True)
        environment = {"LD_PRELOAD": SHIM, "FAULT_CALL": call, "FAULT_AT": str(number), "FAULT_ERRNO": str(error),
                       "FAULT_MARK": str(mark)}
        return run(tool, *operands, stdin=text, env=environment), mark.exists()

    def setUp(self):
        super().setUp()
        outside = tempfile.TemporaryDirectory()
        self.addCleanup(outside.cleanup)
        self.outside = outside.name


class Faults(FaultTest):
    def each_failing_call(self, call, error, *options):
        """(what failed, run, good output) until a run does not come to the call."""
        for tool, operands, text in small_inputs():
            operands = [*operands, *options]
            good, _ = self.good_run(tool, operands, text)
            for number in range(1, 100000):
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
        self.check_failures("read", errno.EIO, may_succeed=True)  # not those of the C library's start

    def test_any_close_that_fails_says_so_where_data_may_be_lost(self):
        self.check_failures("close", errno.EIO, may_succeed=True)  # not of a file that was only read

    def test_the_image_waits_for_the_close_of_standard_output(self):
        for tool, operands, text in small_inputs():
            done, was_reached = self.run_with_fault("close of stdout", 1, errno.EIO, tool, operands, text)
            self.assertTrue(was_reached)
            self.assert_fails(done, 1, f"{tool}: cannot write <stdout>: Input/output error")
            self.assert_as_before()

    def check_allocations(self, *options):
        without_memory = 0
        for which, done, good in self.each_failing_call("malloc", errno.ENOMEM, *options):
            if done.returncode == 0:  # the C library and the C++ library's start can do without some
                self.assertEqual(done.stdout, good, which)
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
            else:
                tool = which.split(",")[0]
                self.assertEqual((done.returncode, done.stderr), (1, f"{tool}: not enough memory\n".encode()), which)
                if tool != "zbuf" and done.stdout:
                    self.assertTrue(done.stdout.endswith(f"error {tool}: not enough memory\n".encode()), which)
                without_memory += 1
            self.assert_as_before()
        self.assertGreater(without_memory, 1500)

    def test_any_allocation_that_fails_is_a_failure_that_says_so(self):
        self.check_allocations()

    def test_on_threads_as_well(self):
        self.check_allocations("--threads", 2)

    def test_any_allocation_of_the_png_library_that_fails_is_a_failure(self):
        tool, operands, text = small_inputs()[3]
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
        self.assertLessEqual(messages, {"", "zbuf: not enough memory\n", "zbuf: cannot write new.png: Cannot allocate memory\n"})
        self.assertIn("zbuf: cannot write new.png: Cannot allocate memory\n", messages)

    def test_an_interrupted_read_or_write_goes_on(self):
        for call in ("read", "write"):
            for which, done, good in self.each_failing_call(call, errno.EINTR):
                self.assertEqual((done.returncode, done.stdout), (0, good), which)

    def test_threads_the_system_refuses_are_done_without(self):
        def leave_no_room_for_stacks():
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 32, resource.getrlimit(resource.RLIMIT_STACK)[1]))
            resource.setrlimit(resource.RLIMIT_AS, (1 << 31, 1 << 31))

        for tool, operands, text in small_inputs():
            good, image = self.good_run(tool, operands, text)
            done = run(tool, *operands, "--threads", 8, stdin=text, preexec_fn=leave_no_room_for_stacks)
            self.assert_quiet_success(done)
            self.assertEqual(done.stdout, good)
            self.assertEqual(pathlib.Path("out.bmp").read_bytes(), image if tool == "zbuf" else OLD_IMAGE)

    def test_a_link_or_rename_that_fails_leaves_the_old_image(self):
        tool, operands, text = small_inputs()[3]
        self.good_run(tool, operands, text)
        for call in ("link", "rename"):
            done, was_reached = self.run_with_fault(call, 1, errno.EPERM, tool, operands, text)
            if call == "link" and not was_reached:
                self.skipTest("this file system has no files without a name")
            self.assert_fails(done, 1, "zbuf: cannot replace out.bmp: Operation not permitted")
            self.assert_as_before()

    def test_a_bmp_is_written_from_its_end_where_the_file_can_seek(self):
        """The first seek only asks; without it the picture is kept until it can be written as a whole."""
        tool, operands, text = small_inputs()[3]
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
        for tool, operands, text in small_inputs():
            good, image = self.good_run(tool, operands, text)
            done = run(tool, *operands, stdin=text, env={"LD_PRELOAD": SHIM, "FAULT_SHORT": "1"})
            self.assert_quiet_success(done)
            self.assertEqual(done.stdout, good)
            self.assertEqual(pathlib.Path("out.bmp").read_bytes(), image if tool == "zbuf" else OLD_IMAGE)


class ManyFiles(FaultTest):
    """zbuf writes several files, some through libpng: all are the old ones until everything is written."""

    def each_failing_call(self, call, error, options):
        """(what failed, run, the files then, the good files) until a run does not come to the call."""
        names = [word for word in options if "." in word]
        text = stage_texts()[2]
        done = run("zbuf", "config.txt", *options, stdin=text)
        if b"without libpng" in done.stderr:
            self.skipTest("built without libpng")
        self.assert_quiet_success(done)
        good = {name: pathlib.Path(name).read_bytes() for name in names}
        for number in range(1, 100000):
            for name in names:
                pathlib.Path(name).write_bytes(OLD_IMAGE)
            done, was_reached = self.run_with_fault(call, number, error, "zbuf", ["config.txt", *options], text)
            if not was_reached:
                self.assertGreater(number, 1, f"zbuf never comes to {call}: nothing was tested")
                for name in names:
                    os.unlink(name)
                return
            which = f"{call} {number} of zbuf {options}: {done.stderr}"
            self.assertEqual(self.files(), sorted({"config.txt", "out.bmp", "scene.txt", *names}), which)
            yield which, done, {name: pathlib.Path(name).read_bytes() for name in names}, good

    def check(self, call, error, *options, some_may_be_new=False):
        for which, done, files, good in self.each_failing_call(call, error, options):
            if done.returncode == 0:  # a close of what was only read, an allocation that can be done without
                self.assertEqual((files, call in ("close", "malloc")), (good, True), which)
                continue
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1, 1), which)
            for name, content in files.items():
                self.assertIn(content, (OLD_IMAGE, good[name]) if some_may_be_new else (OLD_IMAGE,), which)

    PLAIN = ["--image", "out.ppm", "--z-buffer", "depths.txt", "--depth-image", "depths.pgm", "--fragments", "fragments.txt"]
    PNGS = ["--image", "out.png", "--depth-image", "depths.png"]

    def test_a_failing_write_or_close_leaves_every_old_file(self):
        for options in (self.PLAIN, self.PNGS):
            self.check("write", errno.ENOSPC, *options)
            self.check("close", errno.EIO, *options)

    def test_a_failing_rename_leaves_old_files_or_complete_ones(self):
        self.check("rename", errno.EPERM, *self.PLAIN, some_may_be_new=True)

    def test_a_failing_allocation_leaves_old_files_or_complete_ones(self):
        for options in (self.PLAIN, self.PNGS):
            self.check("malloc", errno.ENOMEM, *options, some_may_be_new=True)


class KilledStages(DiskTest):
    """A stage is killed (SIGKILL) when a random part of the scene has been sent."""

    SCENE = CAMERA + TRIANGLE * 3000 + "end\n"
    STAGES = (["model", "--framed"], ["view"], ["project"], ["zbuf", "--framed", "config.txt"])

    def start_pipe(self):
        """The four processes and the end to write the scene to."""
        processes, before, feed = [], subprocess.PIPE, None
        for tool, *options in self.STAGES:
            last = tool == "zbuf"
            process = subprocess.Popen(command(tool, *options), stdin=before, stderr=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL if last else subprocess.PIPE)
            if feed is None:
                feed = process.stdin
            else:
                before.close()
            before = process.stdout
            processes.append(process)
        return processes, feed

    def run_pipe(self, victim, sent):
        """Kills stage `victim` after so many bytes; None for nobody. The statuses."""
        processes, feed = self.start_pipe()
        text = self.SCENE.encode()
        try:
            feed.write(text[:sent])
            feed.flush()
            if victim is not None:
                processes[victim].send_signal(signal.SIGKILL)
            feed.write(text[sent:])
            feed.close()
        except BrokenPipeError:
            try:
                feed.close()
            except BrokenPipeError:
                pass
        return [process.wait(timeout=60) for process in processes]

    def test_no_picture_of_a_part_ever_appears(self):
        self.assertEqual(self.run_pipe(None, 0), [0, 0, 0, 0])
        good = pathlib.Path("out.bmp").read_bytes()
        rng = random.Random(7)
        refused = 0
        for victim in range(4):
            for _ in range(100):
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
                sent = rng.randrange(len(self.SCENE) + 1)
                with self.subTest(victim=self.STAGES[victim][0], sent=sent):
                    statuses = self.run_pipe(victim, sent)
                    image = pathlib.Path("out.bmp").read_bytes()
                    # A stage that had done its part before the signal came is not missed.
                    self.assertEqual(image, good if statuses[3] == 0 else OLD_IMAGE)
                    self.assertTrue(statuses[victim] == -signal.SIGKILL or statuses == [0, 0, 0, 0], statuses)
                    self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])
                    refused += statuses[3] != 0
        self.assertGreater(refused, 200, "most stages were done before the signal came: nothing was tested")


if __name__ == "__main__":
    unittest.main()
