#!/usr/bin/env python3
"""Beginners' mistakes get the answers that mistakes.txt records, to the letter.

usage: mistakes_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import mistakes
from toolbox import BIN, SOURCE

BASE, MISTAKES = mistakes.load()
SCRIPTS = SOURCE / "scripts"


class Mistakes(unittest.TestCase):
    maxDiff = None

    def test_there_are_at_least_76_and_no_two_share_a_name(self):
        names = [mistake.name for mistake in MISTAKES]
        self.assertGreaterEqual(len(names), 76)
        self.assertEqual(sorted(set(names)), sorted(names))

    def test_each_has_a_command_and_a_difference(self):
        for mistake in MISTAKES:
            self.assertTrue(mistake.command, mistake.name)

    def test_the_files_without_a_mistake_get_no_word(self):
        for scene in ("scene.txt", "lit.txt"):
            command = "model %s | view | project | zbuf config.txt" % scene
            right = mistakes.Mistake("", "none", "", 0, BASE, {}, command)
            self.assertEqual(mistakes.run(right, BIN, SCRIPTS), (0, ""))

    def test_an_edit_has_to_match(self):
        with tempfile.TemporaryDirectory() as folder:
            data = pathlib.Path(folder, "mistakes.txt")
            data.write_text(
                "--- scene.txt\n0 0 5\n=== no-such-line: A title\nscene.txt:\n- 0 0 6\n+ 0 0 7\n$ true\n")
            with self.assertRaisesRegex(ValueError, "3: the lines of 'no-such-line' do not occur once"):
                mistakes.load(data)

    def test_the_pages_are_up_to_date(self):
        subprocess.run([sys.executable, SOURCE / "scripts/maintain/make-mistakes-page", "--check"],
                       check=True)


def add(mistake):
    def test(self):
        status, stderr = mistakes.run(mistake, BIN, SCRIPTS)
        self.assertEqual(stderr, mistake.stderr)
        self.assertEqual(status, mistake.status)

    setattr(Mistakes, "test_" + mistake.name.replace("-", "_"), test)


for one in MISTAKES:
    add(one)

if __name__ == "__main__":
    unittest.main()
