"""Runs every command of the console blocks in README.md and docs/ and compares its output.

usage: readme_test.py BIN_DIR SOURCE_DIR

In a block ```console bash runs each line '$ COMMAND' in the source folder with the tools on the PATH; the lines up to the
next command are its expected output, stdout and stderr together.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BIN_DIR, SOURCE_DIR = (pathlib.Path(word).resolve() for word in sys.argv[1:3])


def examples():
    """Pairs of a command and its expected output."""
    for page in [SOURCE_DIR / "README.md", *sorted((SOURCE_DIR / "docs").glob("*.md"))]:
        for block in re.findall(r"^```console\n(.*?)^```$", page.read_text(), re.M | re.S):
            for example in re.split(r"^\$ ", block, flags=re.M)[1:]:
                command, _, output = example.partition("\n")
                yield command, output


class Readme(unittest.TestCase):
    def test_every_command_prints_what_the_readme_shows(self):
        count = 0
        with tempfile.TemporaryDirectory() as folder:
            for name in ("samples", "scripts"):
                shutil.copytree(SOURCE_DIR / name, pathlib.Path(folder) / name)
            path = {"PATH": f"{BIN_DIR}:{os.environ['PATH']}", "BIN": str(BIN_DIR)}
            for command, output in examples():
                with self.subTest(command):
                    run = subprocess.run(["bash", "-c", command], cwd=folder, env={**os.environ, **path},
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                    self.assertEqual(run.stdout, output)
                count += 1
        self.assertGreater(count, 5)


unittest.main(argv=sys.argv[:1])
