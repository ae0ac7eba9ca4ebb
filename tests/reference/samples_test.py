#!/usr/bin/env python3
"""The files committed in samples/ are those of the reference; the torus is what its script writes.

usage: samples_test.py SOURCE_DIR [LARGEST]

Calculates scenes of at most LARGEST bytes, by default 10,000, and pictures of at most ten times as many
pixels: larger ones take seconds to minutes.
"""
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import unittest

import leeway
import reference

largest = int(sys.argv.pop()) if len(sys.argv) > 2 and sys.argv[-1].isdigit() else 10_000
source = pathlib.Path(sys.argv.pop()).resolve()
sums = (source / "samples/SHA256SUMS").read_text().splitlines()
samples = sorted(scene.parent for scene in source.glob("samples/*/scene.txt"))
lit_samples = [sample for sample in samples if "\nlight " in (sample / "scene.txt").read_text()]


def stage(name, data, *words):
    return getattr(reference, name)(data, reference.read_options(name, list(words)))


class Samples(unittest.TestCase):
    def test_expected_files_are_those_of_the_reference(self):
        """Made as by Makefile.samples: the stages pass on all digits, and zbuf reads stage3.txt."""
        self.assertGreaterEqual(len(samples), 13)
        self.assertGreaterEqual(len(lit_samples), 6)
        for sample in samples:
            if (sample / "scene.txt").stat().st_size > largest:
                continue
            with self.subTest(sample=sample.name):
                files = {path.name: path.read_bytes() for path in sample.glob("*.*")}

                def is_committed(name, text):
                    """Large texts are committed as checksums."""
                    if name in files:
                        return text == files[name]
                    return f"{hashlib.sha256(text).hexdigest()}  {sample.name}/{name}" in sums

                stage1 = stage("model", files["scene.txt"], "--digits", "exact")
                stage2 = stage("view", stage1, "--digits", "exact")
                stage3 = stage("project", stage2)
                self.assertTrue(is_committed("stage1.txt", stage("model", files["scene.txt"], "--bare")))
                self.assertTrue(is_committed("stage2.txt", stage("view", stage1, "--bare")))
                given = files.get("stage3.txt", stage3)  # a checksum would not know which digits are open
                leeway.expect_same_text(self, given, stage3,
                                        lambda: stage("project", stage2, "--digits", "17"), stage2)
                text, config = reference.Stage(given, "zbuf"), reference.read_config(
                    reference.Text(files["config.txt"]))
                if config.width * config.height > 10 * largest:
                    continue
                leeway.expect_same_picture(
                    self, list(text.triangles()), text, config, {"--coverage": "nearest"},
                    reference.shading_model(text, None), files["z_buffer.txt"], files["out.bmp"])

    def test_the_reference_is_a_program_with_the_options_of_the_tools(self):
        sample = source / "samples/worked-example"

        def run(*words, stdin):
            return subprocess.run([sys.executable, source / "tests/reference/reference.py", *words],
                                  input=stdin, capture_output=True)

        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder, "picture.bmp")
            stage1 = run("model", "--framed", stdin=(sample / "scene.txt").read_bytes()).stdout
            stage2 = run("view", "--eye", "0", "0", "2", "--digits", "exact", stdin=stage1).stdout
            stage3 = run("project", "--perspective", "60", "1", "1", "1e1", stdin=stage2).stdout
            depths = run("zbuf", sample / "config.txt", "--expect-framed", "--image", image, stdin=stage3)
            self.assertEqual((depths.returncode, depths.stderr, depths.stdout),
                             (0, b"", (sample / "z_buffer.txt").read_bytes()))
            self.assertEqual(image.read_bytes(), (sample / "out.bmp").read_bytes())
        refused = run("project", stdin=b"# c\northo 1 1 -1 1 1 9\n")
        self.assertEqual((refused.returncode, refused.stdout[:21]), (1, b"error project: line 2:"[:21]))
        self.assertIn(b"reference project: line 2:", refused.stderr)
        for words in (["zbuf"], ["model", "--digits", "18"], ["view", "--eye", "0", "0"], [
                "project", "--eye", "0", "0", "0"], ["trace"], []):
            self.assertEqual(run(*words, stdin=b"").returncode, 2, words)

    def test_the_torus_is_written_by_its_script(self):
        scene = subprocess.run([sys.executable, source / "scripts/make-torus"], stdout=subprocess.PIPE,
                               check=True).stdout
        self.assertTrue((source / "samples/torus/scene.txt").read_bytes() == scene, "differs")

    def test_the_worked_examples_reach_stage_3_as_the_assignment_gives_them(self):
        given = {
            "one-triangle": "0.50 0.00 0.50  -0.50 0.00 0.50  0.00 0.50 0.50",
            "two-triangles": "1.5 0 0.5  -0.5 0 0.5  0 1.5 0.5  0.5 0 0.25  -1.0 0 0.25  0 0.5 0.25"}
        for name, numbers in given.items():
            with self.subTest(sample=name):
                stage3 = (source / "samples" / name / "stage3.txt").read_text()
                self.assertEqual([float(word) for word in stage3.split()],
                                 [float(word) for word in numbers.split()])


if __name__ == "__main__":
    unittest.main()
