#!/usr/bin/env python3
"""scripts/maintain/coverage-report: its report on gcovr's counts and on the given reasons.

usage: coverage_report_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import json
import pathlib
import subprocess
import sys
import unittest

from toolbox import SOURCE, ToolTest

SOURCE_LINES = [
    "int half(int x) {", "  if (x % 2 != 0) fail(x);", "  return x / 2;", "}", "void fail(int x) {",
    "  std::abort();", "}"]
REASONS = "# A comment.\n\nNobody lives to tell.\n    lib/half.cpp: std::abort();\n"


def line(number, count, *branches):
    return {
        "line_number": number, "count": count, "branches": [{"count": taken} for taken in branches],
        "gcovr/noncode": False}


class CoverageReport(ToolTest):
    def report(self, reasons, lines, *options):
        pathlib.Path("lib").mkdir()
        pathlib.Path("lib/half.cpp").write_text("\n".join(SOURCE_LINES) + "\n")
        pathlib.Path("reasons.txt").write_text(reasons)
        pathlib.Path("counted.json").write_text(
            json.dumps({"files": [{"file": "lib/half.cpp", "lines": lines}]}))
        return subprocess.run([
            sys.executable, SOURCE / "scripts/maintain/coverage-report", "counted.json", "reasons.txt",
            *options], capture_output=True, text=True, timeout=60)

    def test_shares_and_reasons_are_printed(self):
        done = self.report(REASONS, [line(1, 3), line(2, 3, 3, 0), line(3, 3), line(6, 0)])
        self.assertEqual(done.stdout, "file          lines         branches\n"
                                      "lib/half.cpp  75.0 % (3/4)  50.0 % (1/2)\n"
                                      "all           75.0 % (3/4)  50.0 % (1/2)\n"
                                      "\n"
                                      "Not run: Nobody lives to tell.\n"
                                      "  lib/half.cpp:6: std::abort();\n")
        self.assertEqual((done.stderr, done.returncode), ("", 0))

    def test_a_line_without_a_reason_is_a_failure(self):
        done = self.report(REASONS, [line(2, 3), line(3, 0), line(6, 0)])
        self.assertTrue(
            done.stdout.endswith(
                "Not run, and reasons.txt has no reason:\n  lib/half.cpp:3: return x / 2;\n"), done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_a_reason_for_nothing_is_a_failure(self):
        done = self.report(REASONS + "    lib/half.cpp: std::exit\n", [line(1, 1), line(6, 0)])
        self.assertTrue(
            done.stdout.endswith(
                "In reasons.txt, but nowhere in the sources:\n  line 5: lib/half.cpp: std::exit\n"),
            done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_a_reason_that_is_not_needed_here_is_told(self):
        done = self.report(REASONS, [line(1, 1), line(6, 2)])
        self.assertTrue(
            done.stdout.endswith(
                "Run here, in spite of a reason in reasons.txt:\n  line 4: lib/half.cpp: std::abort();\n"),
            done.stdout)
        self.assertEqual(done.returncode, 0)

    def test_code_that_is_none_does_not_count(self):
        done = self.report(REASONS, [line(1, 1), line(6, 0) | {"gcovr/noncode": True}])
        self.assertIn("all           100.0 % (1/1)  none\n", done.stdout)

    def test_branches_are_held_to_reasons_where_asked(self):
        pathlib.Path("branches.txt").write_text("Halves are even.\n    lib/half.cpp: x % 2 != 0\n")
        lines = [line(1, 3), line(2, 3, 3, 0), line(3, 3, 0, 2), line(6, 0, 0, 0)]
        done = self.report(REASONS, lines, "--branch-reasons", "branches.txt", "--branches-of", "lib/h",
                           "lib/other")
        self.assertTrue(done.stdout.endswith("\nBranches of lib/h, lib/other: 33.3 % (2/6)\n"
                                             "\nBranches not taken: Halves are even.\n"
                                             "  lib/half.cpp:2: if (x % 2 != 0) fail(x);\n"
                                             "\nBranches not taken, and branches.txt has no reason:\n"
                                             "  lib/half.cpp:3: return x / 2;\n"), done.stdout)
        self.assertEqual((done.stderr, done.returncode), ("", 1))

    def test_branches_of_other_files_need_no_reason(self):
        pathlib.Path("branches.txt").write_text("")
        done = self.report(REASONS, [line(2, 3, 3, 0), line(6, 0)], "--branch-reasons", "branches.txt",
                           "--branches-of", "lib/other")
        self.assertEqual((done.stderr, done.returncode), ("", 0))

    def test_a_reason_for_branches_that_are_taken_is_told_and_one_for_no_line_is_a_failure(self):
        pathlib.Path("branches.txt").write_text(
            "Halves are even.\n    lib/half.cpp: x % 2 != 0\n    lib/half.cpp: x % 3\n")
        done = self.report(REASONS, [line(2, 3, 3, 1), line(6, 0)], "--branch-reasons", "branches.txt")
        self.assertTrue(
            done.stdout.endswith(
                "\nBranches taken here, in spite of a reason in branches.txt:\n  line 2: lib/half.cpp: x % "
                "2 != 0\n"
                "\nIn branches.txt, but nowhere in the sources:\n  line 3: lib/half.cpp: x % 3\n"),
            done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_reasons_have_a_form(self):
        done = self.report("    lib/half.cpp: return\n", [line(1, 1)])
        self.assertEqual(
            done.stderr,
            "reasons.txt:1: expected a reason, then lines '  FILE: TEXT', found 'lib/half.cpp: return'\n")
        self.assertEqual(done.returncode, 1)


if __name__ == "__main__":
    unittest.main()
