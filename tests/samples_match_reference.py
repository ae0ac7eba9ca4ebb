#!/usr/bin/env python3
"""What is committed in samples/ is what reference_pipeline.py calculates; the torus is what make-torus writes.

usage: samples_match_reference.py SOURCE_DIR
"""
import pathlib
import subprocess
import sys
import unittest

import reference_pipeline

source = pathlib.Path(sys.argv.pop())
samples = sorted(scene.parent for scene in source.glob("samples/*/scene.txt"))


class Samples(unittest.TestCase):
    def test_expected_files_are_those_of_the_reference(self):
        self.assertGreaterEqual(len(samples), 6)
        for sample in samples:
            files = reference_pipeline.pipeline((sample / "scene.txt").read_text(), (sample / "config.txt").read_text())
            for name, data in files.items():
                with self.subTest(sample=sample.name, file=name):
                    self.assertTrue((sample / name).read_bytes() == data, "differs")

    def test_the_torus_is_written_by_its_script(self):
        scene = subprocess.run([sys.executable, source / "scripts/make-torus"], stdout=subprocess.PIPE, check=True).stdout
        self.assertTrue((source / "samples/torus/scene.txt").read_bytes() == scene, "differs")

    def test_the_worked_examples_reach_stage_3_as_the_assignment_gives_them(self):
        given = {"one-triangle": "0.50 0.00 0.50  -0.50 0.00 0.50  0.00 0.50 0.50",
                 "two-triangles": "1.5 0 0.5  -0.5 0 0.5  0 1.5 0.5  0.5 0 0.25  -1.0 0 0.25  0 0.5 0.25"}
        for name, numbers in given.items():
            with self.subTest(sample=name):
                stage3 = (source / "samples" / name / "stage3.txt").read_text()
                self.assertEqual([float(word) for word in stage3.split()], [float(word) for word in numbers.split()])


if __name__ == "__main__":
    unittest.main()
