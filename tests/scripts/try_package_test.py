#!/usr/bin/env python3
"""scripts/maintain/try-package where it cannot do its work: it says why. What it does is its own test, and
needs a network.

usage: try_package_test.py SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAMS = ("sh", "env", "dirname", "basename", "readlink", "mkdir", "mktemp", "rm", "tail", "cat")


class TryPackage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree, self.bin = pathlib.Path(folder.name, "tree"), pathlib.Path(folder.name, "bin")
        (self.tree / "scripts/maintain/parts").mkdir(parents=True)
        for name in ("try-package", "parts/steps.sh"):
            shutil.copy(SOURCE / "scripts/maintain" / name, self.tree / "scripts/maintain" / name)
        self.put(self.tree / "build/release/libexec/pipeline/model", "")
        for name in PROGRAMS:
            self.put(self.bin / name, f'#!/bin/sh\nexec {shutil.which(name)} "$@"\n')
        self.put(self.bin / "id", "#!/bin/sh\necho 0\n")
        self.put(self.bin / "mmdebstrap", "#!/bin/sh\necho no network >&2\nexit 1\n")
        self.put(
            self.bin / "cpack",
            '#!/bin/sh\nwhile [ "$1" != -B ]; do shift; done\nmkdir -p "$2"; : > "$2/p.deb"; : > '
            '"$2/p.tar.gz"\n')

    def put(self, path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_there(self, *words):
        done = subprocess.run([self.tree / "scripts/maintain/try-package", *words], env={
            "PATH": str(self.bin), "TMPDIR": str(self.bin.parent)}, capture_output=True, text=True,
                              timeout=60)
        self.assertEqual(sorted(os.listdir(self.bin.parent)), ["bin", "tree"])  # nothing is left
        return done.returncode, done.stdout, done.stderr

    def test_a_user_is_told_that_it_needs_root(self):
        self.put(self.bin / "id", "#!/bin/sh\necho 1000\n")
        self.assertEqual(self.run_there(),
                         (77, "try-package: skipped: only root can make a root folder and enter it\n", ""))

    def test_a_missing_tool_is_named(self):
        (self.bin / "mmdebstrap").unlink()
        self.assertEqual(
            self.run_there("--quick"),
            (77, "try-package: skipped: mmdebstrap is missing (scripts/install-packages --checks)\n", ""))

    def test_without_a_network_it_is_skipped(self):
        status, output, messages = self.run_there()
        self.assertEqual((status, messages), (77, "no network\n"))
        self.assertEqual(output.splitlines()[-1],
                         "try-package: skipped: a root of bookworm could not be made: is there a network?")

    def test_a_package_that_cannot_be_made_is_a_failure(self):
        self.put(self.bin / "cpack", "#!/bin/sh\necho broken\nexit 1\n")
        status, output, messages = self.run_there()
        self.assertEqual((status, output.splitlines()[-1]),
                         (1, "FAIL  cpack makes a package and a source archive"))
        self.assertIn("broken\n", messages)

    def test_without_a_build_it_fails(self):
        (self.tree / "build/release/libexec/pipeline/model").unlink()
        self.assertEqual(self.run_there(), (1, "", "try-package: build first: scripts/build-release\n"))


if __name__ == "__main__":
    unittest.main()
