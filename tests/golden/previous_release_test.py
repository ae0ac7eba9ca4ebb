#!/usr/bin/env python3
"""Stages of the previous release and of this version work together at every joint, on every sample that
release can draw.

usage: previous_release_test.py BIN_DIR SOURCE_DIR

The environment variable PIPELINE_PREVIOUS_BIN names the folder with the four tools of the previous release.
"""
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN = pathlib.Path(sys.argv.pop()).resolve()
PREVIOUS = os.environ.get("PIPELINE_PREVIOUS_BIN")
STAGES = ("model", "view", "project", "zbuf")


def reason_to_skip():
    if PREVIOUS:
        return None
    try:
        tags = subprocess.run(["git", "-C", SOURCE, "tag", "--list", "v[0-9]*", "--sort=-version:refname"],
                              capture_output=True, text=True).stdout.split()
    except OSError:  # no git
        tags = []
    return (f"PIPELINE_PREVIOUS_BIN does not name the tools of {tags[0]}"
            if tags else "there is no release yet")


def pipe(tools, sample, options):
    """The output of each stage, and the picture; None if a stage refuses its input. `tools` has a folder for
    each stage."""
    text, made = (sample / "scene.txt").read_bytes(), []
    with tempfile.TemporaryDirectory() as folder:
        for stage, bin_dir in zip(STAGES, tools):
            words = [sample / "config.txt"] if stage == "zbuf" else options if stage == "model" else []
            done = subprocess.run([pathlib.Path(bin_dir, stage), *words], input=text, stdout=subprocess.PIPE,
                                  stderr=subprocess.DEVNULL, cwd=folder)
            if done.returncode:
                return None
            text = done.stdout
            made.append(text)
        return [*made, pathlib.Path(folder, "out.bmp").read_bytes()]


@unittest.skipIf(reason_to_skip(), reason_to_skip())
class Mixed(unittest.TestCase):
    def test_stages_of_both_versions_give_the_same_output(self):
        count = 0
        for sample, options in itertools.product(
                sorted(path.parent for path in SOURCE.glob("samples/*/scene.txt")), ([], ["--framed"])):
            old = pipe([PREVIOUS] * 4, sample, options)
            if old is None:  # a scene that uses something newer
                continue
            count += 1
            for tools in itertools.product((PREVIOUS, BIN), repeat=4):
                with self.subTest(sample=sample.name, model=options, new=[
                        stage for stage, bin_dir in zip(STAGES, tools) if bin_dir == BIN]):
                    new = pipe(tools, sample, options)
                    self.assertIsNotNone(new, "a stage refuses its input")
                    self.assertEqual([name for name, a, b in zip((*STAGES, "picture"), new, old) if a != b],
                                     [], "these differ")
        self.assertGreaterEqual(count, 22, "the release draws fewer samples than there were at the first")


if __name__ == "__main__":
    unittest.main()
