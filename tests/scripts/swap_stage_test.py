#!/usr/bin/env python3
"""A stage can be replaced by any program that reads and writes the same text.

usage: swap_stage_test.py BIN_DIR SOURCE_DIR
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

source = pathlib.Path(sys.argv.pop()).resolve()
bin_dir = pathlib.Path(sys.argv.pop()).resolve()
environment = dict(os.environ, LC_ALL="C")


def run(*command, stdin=b""):
    """The command's stdout; a first word that names a tool stands for ours."""
    tool = bin_dir / command[0]
    words = [tool if tool.exists() else command[0], *command[1:]]
    done = subprocess.run(words, input=stdin, stdout=subprocess.PIPE, env=environment, check=True)
    return done.stdout


def picture(stage3, config):
    with tempfile.TemporaryDirectory() as folder:
        image = pathlib.Path(folder, "out.bmp")
        depth = run("zbuf", config, "--image", image, stdin=stage3)
        return depth, image.read_bytes()


class SwappedStage(unittest.TestCase):
    def setUp(self):
        # Its camera looks down -z with y up, as view.awk requires.
        self.sample = source / "samples" / "nested-transforms"
        self.scene = self.sample / "scene.txt"
        self.expected = (self.sample / "z_buffer.txt").read_bytes(), (self.sample / "out.bmp").read_bytes()

    def test_four_lines_of_awk_do_for_view(self):
        for model, project in ((["--bare"], ["--scene", self.scene]), ([], []), (["--framed"], [])):
            with self.subTest(model=model):
                stage1 = run("model", *model, self.scene)
                stage2 = run("awk", "-v", "eye=0 0 12", "-f", source / "scripts/view.awk", stdin=stage1)
                stage3 = run("project", *project, stdin=stage2)
                self.assertTrue(
                    picture(stage3, self.sample / "config.txt") == self.expected, "the picture differs")

    def test_the_awk_script_passes_other_columns_on(self):
        text = b"perspective 60 1 1 30\nattributes color normal\n1 2 3 255 0 0.5 0 0 1\n"
        self.assertEqual(run("awk", "-v", "eye=0 0 12", "-f", source / "scripts/view.awk", stdin=text),
                         text.replace(b"1 2 3 ", b"1.0000000 2.0000000 -9.0000000 "))

    def test_the_awk_script_has_four_lines(self):
        lines = (source / "scripts/view.awk").read_text().splitlines()
        self.assertEqual(len([line for line in lines if not line.startswith("#")]), 4)


if __name__ == "__main__":
    unittest.main()
