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
import time
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAMS = "sh env dirname basename readlink mkdir mktemp rm tail cat timeout sleep".split()
SKIPPED = "try-package: skipped: "


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

    def run_there(self, *words, started=None):
        """The status and what is printed; a signal ends it when the file `started` appears."""
        process = subprocess.Popen([self.tree / "scripts/maintain/try-package", *words], env={
            "PATH": str(self.bin), "TMPDIR": str(self.bin.parent)}, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        while started and not started.exists() and process.poll() is None:
            time.sleep(0.05)
        if started:
            process.terminate()
        output, messages = process.communicate(timeout=60)
        self.assertEqual(sorted(os.listdir(self.bin.parent)), ["bin", "tree"])  # nothing is left
        return process.returncode, output, messages

    def test_where_it_cannot_work_it_says_why(self):
        status, output, messages = self.run_there()
        self.assertEqual(
            (status, output.splitlines()[-1], messages),
            (77, f"{SKIPPED}a root of bookworm could not be made: is there a network?", "no network\n"))
        (self.tree / "build/release/libexec/pipeline/model").unlink()
        self.assertEqual(self.run_there(), (1, "", "try-package: build first: scripts/build-release\n"))
        (self.bin / "mmdebstrap").unlink()
        self.assertEqual(self.run_there("--quick"),
                         (77, f"{SKIPPED}mmdebstrap is missing (scripts/install-packages --checks)\n", ""))
        self.put(self.bin / "id", "#!/bin/sh\necho 1000\n")
        self.assertEqual(self.run_there(),
                         (77, f"{SKIPPED}only root can make a root folder and enter it\n", ""))

    def test_a_package_that_cannot_be_made_is_a_failure(self):
        self.put(self.bin / "cpack", "#!/bin/sh\necho broken\nexit 1\n")
        status, output, messages = self.run_there()
        self.assertEqual((status, output.splitlines()[-1]),
                         (1, "FAIL  cpack makes a package and a source archive"))
        self.assertIn("broken\n", messages)

    def test_a_signal_ends_the_step_that_runs(self):
        for name in ("mmdebstrap", "cpack"):  # the first waits for its child whatever signal comes
            self.put(self.bin / name, '#!/bin/sh\ntrap : TERM\n: > "$0.started"\nsleep 99\nexit 1\n')
            self.assertEqual(self.run_there(started=self.bin / f"{name}.started")[0], 1)


if __name__ == "__main__":
    unittest.main()
