#!/usr/bin/env python3
"""Disks that fill up at any byte, folders and file systems that are not writable: the exit status is not 0,
an older good file stays, and nothing else is left.

usage: disk_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import resource
import shutil
import subprocess
import tempfile
import unittest

from older_files import OlderImageTest
from toolbox import DRAWING, command, run, stage_texts, tool_inputs

NOBODY = 65534


class FilledDisk(OlderImageTest):
    def run_limited(self, size, tool, operands, text):
        """A run that may write no file beyond `size` bytes; stdout is a file in another folder."""
        with tempfile.TemporaryFile() as out:
            done = run(tool, *operands, stdin=text, stdout=out,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            out.seek(0)
            return done, out.read()

    def test_at_any_byte_it_is_a_failure_and_nothing_is_left(self):
        for tool, operands, text in tool_inputs():
            good, image = self.good_run(tool, operands, text)
            needed = max(len(good), len(image) if tool in DRAWING else 0)
            for size in range(needed):
                with self.subTest(tool=tool, size=size):
                    done, _ = self.run_limited(size, tool, operands, text)
                    self.assertEqual(done.returncode, 1)
                    self.assertRegex(done.stderr.decode(),
                                     f"^{tool}: cannot write (<stdout>|out.bmp): File too large\n$")
                    self.assert_as_before()
            done, out = self.run_limited(needed, tool, operands, text)
            self.assert_quiet_success(done)
            self.assertEqual(out, good)


class Folders(OlderImageTest):
    def check(self, image, reason, **settings):
        for tool, operands, text in tool_inputs()[3:]:
            done = run(tool, *operands, "--image", image, stdin=text, **settings)
            self.assert_fails(done, 1, f"{tool}: cannot open {image}: {reason}")
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
            done = subprocess.run([f"{tools}/zbuf", "config.txt", "--image", image], input=stage_texts()[2],
                                  capture_output=True, user=NOBODY, timeout=60)
            self.assert_fails(done, 1, f"zbuf: cannot open {image}: Permission denied")
            self.assert_as_before()


class SmallFileSystem(OlderImageTest):
    """Private file systems, in a namespace that ends with the command."""
    def run_there(self, mount_options, words, text):
        """Runs a command in a new file system that holds the older image, then lists that file system on
        stdout."""
        script = (
            'mkdir there && mount -t tmpfs -o size=64k none there && cp out.bmp there || exit 77; cd there; '
            'mount -o "remount,$0" . || exit 77; '
            '"$@"; status=$?; cmp -s out.bmp ../out.bmp && echo the older image; ls -A; exit $status')
        done = subprocess.run(
            ["unshare", "--mount", "--map-root-user", "sh", "-c", script, mount_options, *words], input=text,
            capture_output=True, timeout=60)
        shutil.rmtree("there", ignore_errors=True)
        if done.returncode == 77 or done.stderr.startswith(b"unshare: "):
            self.skipTest("mounting is not allowed here: " + done.stderr.decode().strip())
        return done

    def test_one_that_is_read_only_is_a_failure(self):
        for image in ("new.bmp", "out.bmp"):
            done = self.run_there(
                "ro", command("zbuf", "../config.txt", "--image", image, "--z-buffer", "../depths"),
                stage_texts()[2])
            self.assertEqual((done.returncode, done.stderr.decode()),
                             (1, f"zbuf: cannot open {image}: Read-only file system\n"))
            self.assertEqual(done.stdout, b"the older image\nout.bmp\n")

    def test_one_that_is_full_is_a_failure_and_nothing_is_left(self):
        pathlib.Path("config.txt").write_text("200 200\n")  # an image of 120 kB
        for tool, _, text in tool_inputs()[3:]:
            done = self.run_there("rw", command(tool, "../config.txt", "--z-buffer", "../depths"), text)
            self.assertEqual((done.returncode, done.stderr),
                             (1, f"{tool}: cannot write out.bmp: No space left on device\n".encode()))
            self.assertEqual(done.stdout, b"the older image\nout.bmp\n")


if __name__ == "__main__":
    unittest.main()
