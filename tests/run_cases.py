#!/usr/bin/env python3
"""Runs a unittest script, which may import what tests share and the modules of scripts. Then prints a line
'N skipped: REASON' for each reason that kept cases from running.

usage: run_cases.py SCRIPT [ARGUMENT...]

The exit status is unittest's, but 77 if every case was skipped: ctest's SKIP_RETURN_CODE for all scripts.
"""
import collections
import pathlib
import runpy
import sys
import unittest


class Program(unittest.TestProgram):
    """Replaces unittest.main."""
    def runTests(self):  # noqa: N802
        self.exit = False
        super().runTests()
        # A case counts once for each reason, however many of its parts (subTest) gave it.
        skipped = {(getattr(case, "test_case", case), " ".join(reason.split())): None
                   for case, reason in self.result.skipped}
        for reason, count in collections.Counter(reason for _, reason in skipped).items():
            print(f"{count} skipped: {reason}", file=sys.stderr)
        if not self.result.wasSuccessful():
            sys.exit(1)
        cases = {case
                 for case, _ in skipped
                 if isinstance(case, unittest.TestCase)}  # a skipped class is not a case
        sys.exit(77 if skipped and len(cases) == self.result.testsRun else 0)


if len(sys.argv) < 2:
    sys.exit(__doc__)
del sys.argv[0]
sys.path[0] = str(pathlib.Path(sys.argv[0]).resolve().parent)
TESTS = pathlib.Path(__file__).resolve().parent
sys.path += [str(TESTS / room) for room in ("tools", "scripts", "reference", "conformance", "../scripts")]
unittest.main = Program
runpy.run_path(sys.argv[0], run_name="__main__")
