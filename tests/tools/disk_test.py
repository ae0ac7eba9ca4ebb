#!/usr/bin/env python3
"""Disks that fill up at any byte, folders and file systems that are not writable: the exit status is not 0,
an older good file stays, and nothing else is left.

usage: disk_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import resource
import shutil
import subprocess
import tempfile
import unittest

from older_files import OlderImageTest
from toolbox import ALL_TOOLS, DRAWING, add_claims, command, run, tool_inputs

INPUTS = {tool: text for tool, _, text in tool_inputs()}


def run_here(_, tool, words):
    yield run(tool, *words, stdin=INPUTS[tool])


def run_at_every_byte(test, tool, words):
    """Runs that may write no file beyond 0 bytes, 1, ..., all but one; stdout is a file elsewhere."""
    good, image = test.good_run(tool, words, INPUTS[tool])
    needed = max(len(good), len(image) if tool in DRAWING else 0)
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    test.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, limits)
    for size in range(needed + 1):
        with tempfile.TemporaryFile() as out:
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, limits[1]))
            done = run(tool, *words, stdin=INPUTS[tool], stdout=out)
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
            if size < needed:
                yield done
            else:
                test.assert_quiet_success(done)
                out.seek(0)
                test.assertEqual(out.read(), good)


def run_as_nobody(test, tool, words):
    if os.geteuid() != 0:
        test.skipTest("only root can become somebody else")
    os.chmod(".", 0o755)
    with tempfile.TemporaryDirectory() as tools:
        os.chmod(tools, 0o755)
        shutil.copy(command(tool)[0], tools)
        yield subprocess.run([f"{tools}/{tool}", *words], input=INPUTS[tool], capture_output=True, user=65534,
                             timeout=60)


def file_system(mount_options):
    """Runs in a new file system, with the older image alone, in a namespace that ends with the command."""
    script = (
        'mkdir there && mount -t tmpfs -o size=64k none there && cp out.bmp there || exit 77; cd there; '
        f'mount -o "remount,{mount_options}" . || exit 77; "$0" "$@"; status=$?; '
        'cmp out.bmp ../out.bmp && [ "$(ls -A)" = out.bmp ] || echo "not as before"; exit $status')

    def run_there(test, tool, words):
        done = subprocess.run(
            ["unshare", "--mount", "--map-root-user", "sh", "-c", script, *command(tool, *words)],
            input=INPUTS[tool], capture_output=True, timeout=60)
        shutil.rmtree("there", ignore_errors=True)
        if done.returncode == 77 or done.stderr.startswith(b"unshare: "):
            test.skipTest("mounting is not allowed here: " + done.stderr.decode().strip())
        test.assertEqual(done.stdout, b"")
        yield done

    return run_there


ELSEWHERE = "--z-buffer ../depths --image"
OURS = ("new.bmp", "out.bmp")
# A claim, the tools it holds for, their options, how they are run, and the one message of every run.
CASES = (
    ("at any byte it may be full", ALL_TOOLS, "", run_at_every_byte,
     "cannot write (<stdout>|out.bmp): File too large"),
    ("a folder may be missing", DRAWING, "--image missing/out.bmp", run_here,
     "cannot open missing/out.bmp: No such file or directory"),
    ("a device is no folder", DRAWING, "--image /dev/full/out.bmp", run_here,
     "cannot open /dev/full/out.bmp: Not a directory"),
    *((f"a folder may be closed to {name}", [
        "zbuf"], f"--image {name}", run_as_nobody, f"cannot open {name}: Permission denied")
      for name in OURS),
    *((f"a file system may be closed to {name}", [
        "zbuf"], f"{ELSEWHERE} {name}", file_system("ro"), f"cannot open {name}: Read-only file system")
      for name in OURS),
    ("a file system may be full", DRAWING, f"{ELSEWHERE} out.bmp --size 200x200", file_system("rw"),
     "cannot write out.bmp: No space left on device"),
)


class Disk(OlderImageTest):
    def check(self, tools, options, run_all, message):
        for tool in tools:
            words = options.split()
            if tool in DRAWING and "--size" not in words:
                words += ["--size", "6x6"]
            for i, done in enumerate(run_all(self, tool, words)):
                with self.subTest(tool=tool, run=i):
                    self.assertRegex(done.stderr.decode(), rf"\A{tool}: {message}\n\Z")
                    self.assertEqual(done.returncode, 1)
                    self.assert_as_before()


add_claims(Disk, CASES)

if __name__ == "__main__":
    unittest.main()
