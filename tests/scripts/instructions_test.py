#!/usr/bin/env python3
"""scripts/measure/bench --instructions compares every row with its committed count. The tools and valgrind
are scripts here: no instruction is counted.

usage: instructions_test.py SOURCE_DIR
"""
import contextlib
import csv
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
from importlib.machinery import SourceFileLoader
from unittest import mock

SOURCE_DIR = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE_DIR / "scripts/measure"))

from parts import instructions  # noqa: E402
from parts.instruction_rows import ROWS, Row

HEADER = "row,kernel,compiler,instructions\n"
VIEW, ZBUF = Row("one view", "view one-world.txt", "scalar"), Row("one zbuf", "zbuf tiny.txt one-screen.txt",
                                                                  "scalar")
# Reports the count from the tool's file beside this script, and records its own environment and arguments.
VALGRIND = """#!/bin/sh
tool=${3#bin/}
env > "$0.environment"
echo "$@" > "$0.words"
[ ! -e "$0.$tool.message" ] || { cat "$0.$tool.message" >&2; exit 1; }
echo "==1== Collected : $(cat "$0.$tool")" >&2
"""


class Instructions(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.tools, self.valgrind, self.counts = (self.folder / "tools", self.folder / "path/valgrind",
                                                  self.folder / "instructions.csv")
        for name in ("tools", "path"):
            (self.folder / name).mkdir()
        for tool in ("model", "view", "project", "zbuf", "trace"):
            (self.tools / tool).write_text("GCC: (Debian 12.2.0-14+deb12u1) 12.2.0\0")
            self.take(tool, 1_000_000)
        self.valgrind.write_text(VALGRIND)
        self.valgrind.chmod(0o755)
        for patch in (mock.patch.dict(os.environ, PATH=f"{self.valgrind.parent}:{os.environ['PATH']}"),
                      mock.patch("platform.machine", return_value="x86_64")):
            patch.start()
            self.addCleanup(patch.stop)

    def take(self, tool, count):
        pathlib.Path(f"{self.valgrind}.{tool}").write_text(f"{count}\n")

    def commit(self, *lines):
        self.counts.write_text(HEADER + "".join(line + "\n" for line in lines))

    def hold(self, *rows, **options):
        """The exit status and the lines it prints."""
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            status = instructions.hold(self.tools, self.counts, rows=rows, **options)
        return status, printed.getvalue().splitlines()

    def test_rows_within_one_percent_pass(self):
        self.commit("one view,scalar,GCC 12.2.0,1000000", "one zbuf,scalar,GCC 12.2.0,1000000")
        self.take("view", 1_010_000)
        self.take("zbuf", 990_000)
        status, lines = self.hold(VIEW, ZBUF)
        self.assertEqual((status, lines[-1]), (0, "2 passed, 0 failed"))
        self.assertRegex(lines[1], r"^one view +scalar +1,000,000 +1,010,000 +\+1\.00 %$")
        self.assertRegex(lines[2], r"^one zbuf +scalar +1,000,000 +990,000 +-1\.00 %$")
        self.assertEqual(len(lines), 4)

    def test_rows_that_differ_are_named(self):
        said = pathlib.Path(f"{self.valgrind}.view.message")
        for kernel, count, message, failed, line in (
            ("scalar", 980_000, None, 0, "faster: one view: -2.00 %, commit the new count with --accept"),
            ("scalar", 1_010_100, None, 1, "failed: one view: 1,000,000 instructions committed, 1,010,100 "
             "counted, +1.01 %"), ("avx2", 1_000_000, None, 1, "failed: one view: no count is committed, "
                                   "1,000,000 instructions counted; commit it with --accept"),
            ("scalar", 1_000_000, "==1== Callgrind\nview: one-world.txt:1:1: wrong\n", 1, "failed: one view: "
             "view one-world.txt failed with status 1: view: one-world.txt:1:1: wrong")):
            self.commit(f"one view,{kernel},GCC 12.2.0,1000000", "one zbuf,scalar,GCC 12.2.0,1000000")
            self.take("view", count)
            if message:
                said.write_text(message)
            status, lines = self.hold(VIEW, ZBUF)
            self.assertEqual((status, lines[-2:]), (failed, [line, f"{2 - failed} passed, {failed} failed"]))

    def test_another_compiler_skips_the_row_and_is_named(self):
        self.commit("one view,scalar,GCC 12.2.0,1", "one zbuf,scalar,GCC 12.2.0,1000000")
        # Programs linked by clang contain GCC's startup objects.
        (self.tools /
         "view").write_text("GCC: (Debian 12.2.0-14+deb12u1) 12.2.0\0Debian clang version 14.0.6\0")
        status, lines = self.hold(VIEW, ZBUF)
        self.assertEqual((status, lines[-1]), (0, "1 passed, 0 failed, 1 skipped"))
        self.assertRegex(
            lines[1],
            r"^one view +scalar +skipped: built by clang 14\.0\.6, the committed count is for GCC 12\.2\.0$")

    def test_a_processor_without_the_kernel_skips_the_row(self):
        self.commit("one view,scalar,GCC 12.2.0,1000000")
        with mock.patch("parts.instructions.processor_flags", return_value={"sse4_2", "bmi1", "bmi2",
                                                                            "avx2"}):
            status, lines = self.hold(VIEW, Row("a view", "view one-world.txt", "avx2"))
        self.assertEqual((status, lines[-1]), (0, "1 passed, 0 failed, 1 skipped"))
        self.assertRegex(lines[2], r"^a view +avx2 +skipped: this processor has no fma$")

    def test_accept_writes_what_was_counted_and_keeps_the_rest(self):
        self.commit("gone,scalar,GCC 12.2.0,5", "a view,avx2,GCC 12.2.0,7",
                    "one view,scalar,GCC 11.1.0,900000")
        with mock.patch("parts.instructions.processor_flags", return_value=set()):
            status, lines = self.hold(VIEW, Row("a view", "view one-world.txt", "avx2"), ZBUF, accept=True)
        self.assertEqual((status, lines[-1]), (0, "2 passed, 0 failed, 1 skipped"))
        self.assertEqual(
            self.counts.read_text(), HEADER + "one view,scalar,GCC 12.2.0,1000000\na view,avx2,GCC 12.2.0,7\n"
            "one zbuf,scalar,GCC 12.2.0,1000000\n")

    def test_the_tools_run_in_an_environment_of_their_own(self):
        with mock.patch.dict(os.environ, LC_ALL="de_DE.UTF-8", PIPELINE_KERNEL="avx2", SOMETHING="else"):
            self.hold(VIEW, accept=True)
        given = {
            line
            for line in pathlib.Path(f"{self.valgrind}.environment").read_text().splitlines()
            if line.split("=")[0] not in ("PWD", "OLDPWD", "SHLVL", "_")}  # the shell's own
        self.assertEqual(given, {"PATH=/usr/bin:/bin", "LC_ALL=C", "PIPELINE_KERNEL=scalar"})
        self.assertEqual(
            pathlib.Path(f"{self.valgrind}.words").read_text(),
            "--tool=callgrind --callgrind-out-file=/dev/null bin/view one-world.txt\n")

    def bench(self, *options, **environment):
        return subprocess.run([
            sys.executable, SOURCE_DIR / "scripts/measure/bench", "--instructions", "--bin", self.tools,
            "--output", self.folder, *options], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                              env={**os.environ, **environment})

    @unittest.skipUnless(os.uname().machine == "x86_64", "the counts are those of x86-64")
    def test_the_command_accepts_and_then_holds(self):
        command = SourceFileLoader("bench", str(SOURCE_DIR / "scripts/measure/bench")).load_module()

        def bench(*options):  # on empty texts: to write the scenes takes its time
            words = ["bench", "--instructions", "--bin", str(self.tools), "--output", str(self.folder)]
            texts = mock.patch.dict(instructions.TEXTS, dict.fromkeys(instructions.TEXTS, str))
            with texts, mock.patch.object(sys, "argv", [*words, *options]):
                with contextlib.redirect_stdout(
                        io.StringIO()) as printed, self.assertRaises(SystemExit) as ended:
                    command.main()
            return ended.exception.code, printed.getvalue()

        self.assertEqual(bench("--accept")[0], 0)
        self.assertIn('"view: plain, scalar",scalar,GCC 12.2.0,1000000\n', self.counts.read_text())
        self.take("view", 1_020_000)
        status, printed = bench()
        self.assertEqual(status, 1)
        self.assertIn(
            "failed: view: plain, scalar: 1,000,000 instructions committed, 1,020,000 counted, +2.00 %\n",
            printed)

    def test_without_valgrind_every_row_is_skipped(self):
        done = self.bench(PATH=str(self.tools))
        self.assertEqual(done.returncode, 0)
        self.assertEqual(
            done.stdout.splitlines()[-2:],
            ["NOTHING WAS COUNTED, for the reasons above", f"0 passed, 0 failed, {len(ROWS)} skipped"])
        self.assertFalse(self.counts.exists())
        self.assertEqual(self.bench("--accept", PATH=str(self.tools)).returncode, 1)
        # Other things that cannot be done are told before anything is counted.
        for words, status in ((["--accept", "--output", "nowhere"], 1), (["--rounds", "0"], 2)):
            done = self.bench(*words)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (status, "", 1))

    def test_every_row_has_its_count_committed(self):
        with open(SOURCE_DIR / "scripts/measure/results/instructions.csv", newline="") as file:
            committed = [(line["row"], line["kernel"]) for line in csv.DictReader(file)]
        self.assertEqual(committed, [(row.name, row.kernel) for row in ROWS])
        self.assertEqual(len(set(row.name for row in ROWS)), len(ROWS))


if __name__ == "__main__":
    unittest.main()
