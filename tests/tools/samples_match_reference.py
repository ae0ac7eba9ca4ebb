#!/usr/bin/env python3
"""The files committed in samples/ match reference_pipeline.py; the torus matches make-torus.

usage: samples_match_reference.py SOURCE_DIR
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import reference_pipeline
import reference_shading

source = pathlib.Path(sys.argv.pop())
all_samples = sorted(scene.parent for scene in source.glob("samples/*/scene.txt"))
lit_samples = [sample for sample in all_samples if "\nlight " in (sample / "scene.txt").read_text()]
samples = [sample for sample in all_samples if sample not in lit_samples]


def pixels_of_bmp(data, width, height):
    """Rows of (red, green, blue) from the top."""
    stride = (3 * width + 3) // 4 * 4
    rows = [data[54 + stride * row:][:3 * width] for row in reversed(range(height))]
    return [[tuple(row[3 * i:3 * i + 3][::-1]) for i in range(width)] for row in rows]


def positions(stage3):
    """The x y z of a projected text's vertices, without its header and the triangles in clip space."""
    lines = [line.split() for line in stage3.decode().splitlines()]
    while "clipped" in (first := [line[0] if line else "" for line in lines]):
        at = first.index("clipped")
        del lines[at:at + 4]
    return [word for line in lines if len(line) > 3 and line[0][-1].isdigit() for word in line[:3]]


class Samples(unittest.TestCase):
    def test_expected_files_are_those_of_the_reference(self):
        self.assertGreaterEqual(len(samples), 6)
        for sample in samples:
            files = reference_pipeline.pipeline((sample / "scene.txt").read_text(), (sample / "config.txt").read_text())
            for name, data in files.items():
                with self.subTest(sample=sample.name, file=name):
                    self.assertTrue((sample / name).read_bytes() == data, "differs")

    def test_lit_samples_show_what_rays_find(self):
        self.assertEqual(len(lit_samples), 4)
        for sample in lit_samples:
            scene = reference_shading.LitScene((sample / "scene.txt").read_text())
            config = reference_pipeline.Config((sample / "config.txt").read_text())
            files, owners = reference_pipeline.stages(scene, config)
            with self.subTest(sample=sample.name):
                for name in ("stage1.txt", "stage2.txt", "z_buffer.txt"):
                    self.assertTrue((sample / name).read_bytes() == files[name], name + " differs")
                words = [word for line in files["stage3.txt"].decode().splitlines() if not line.startswith("triangle")
                         for word in line.split()]
                self.assertTrue(positions((sample / "stage3.txt").read_bytes()) == words, "stage3.txt differs")
                image = pixels_of_bmp((sample / "out.bmp").read_bytes(), config.width, config.height)
                expected = reference_shading.lit_image(scene, config, owners, "phong")
                worst = max(abs(min(255, c) - d) for row, other in zip(expected, image)
                            for a, b in zip(row, other) for c, d in zip(a, b))
                # Half a unit for rounding, and a little for the decimals of stage 3.
                self.assertLess(worst, 0.55)

    def test_the_lit_scenes_are_written_by_their_script(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, source / "scripts/maintain/make-lit-samples", folder], check=True)
            for sample in lit_samples:
                for name in ("scene.txt", "config.txt"):
                    self.assertEqual((pathlib.Path(folder) / sample.name / name).read_text(), (sample / name).read_text())

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
