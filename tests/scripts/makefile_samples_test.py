#!/usr/bin/env python3
"""Makefile.samples, on a copy of the samples.

usage: makefile_samples_test.py BIN_DIR SOURCE_DIR
"""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

source = pathlib.Path(sys.argv.pop()).resolve()
bin_dir = pathlib.Path(sys.argv.pop()).resolve()
TOOLS = ("model", "view", "project", "zbuf")
NEWER = 10  # seconds: more than any clock's resolution

FAILING_TOOL = """#!/bin/sh
echo '1 2 3'
echo 'a failure' >&2
exit 1
"""


class MakefileSamples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.bin = self.root / "bin"
        self.bin.mkdir()
        for tool in TOOLS:
            shutil.copy2(bin_dir / tool, self.bin)
        shutil.copy2(source / "Makefile.samples", self.root)
        for name in ("nested-transforms", "wide-clipped"):
            shutil.copytree(source / "samples" / name, self.root / "samples" / name)

    def file(self, sample, name):
        return self.root / "samples" / sample / name

    def replace(self, tool, text):
        """Replaces a tool by a script."""
        (self.bin / tool).unlink()
        (self.bin / tool).write_text(text)
        (self.bin / tool).chmod(0o755)

    def make(self, *words):
        return self.call_make("-f", "Makefile.samples", "BIN=bin", "OUT=out", *words)

    def call_make(self, *words, folder="."):
        environment = {
            name: value
            for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS")}
        return subprocess.run(["make", *words], cwd=self.root / folder, env=environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

    def make_well(self, *words):
        done = self.make(*words)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def runs_of_tools(self, *words):
        """How often each tool was called."""
        printed = self.make_well(*words)
        return {tool: printed.count("bin/%s " % tool) for tool in TOOLS}

    def touch(self, path):
        later = max(file.stat().st_mtime for file in self.root.rglob("*")) + NEWER
        os.utime(path, (later, later))

    def test_all_samples_come_out_as_committed(self):
        self.assertIn("10 passed, 0 failed", self.make_well("check"))

    def test_a_sample_with_a_traced_picture_is_traced_too(self):
        shutil.copy2(bin_dir / "trace", self.bin)
        self.make_well()
        drawn = subprocess.run([
            bin_dir / "trace",
            self.file("wide-clipped", "config.txt"), self.root / "out/wide-clipped/stage2.exact",
            "--z-buffer", "none", "-o", self.root / "expected.bmp"], capture_output=True, text=True,
                               check=True)
        self.assertEqual(drawn.stderr, "")
        shutil.copy(self.file("nested-transforms", "out.bmp"), self.file("wide-clipped", "traced.bmp"))
        self.assertIn("FAIL  samples/wide-clipped/traced.bmp differs from out/wide-clipped/traced.bmp",
                      self.make("check").stdout)
        told = self.make_well("diff", f"COMPARE={source}/scripts/compare")
        self.assertIn("wide-clipped: trace is the first stage that has changed (traced.bmp)", told)
        self.assertIn("nested-transforms: nothing has changed", told)
        self.make_well("accept")
        self.assertEqual(
            self.file("wide-clipped", "traced.bmp").read_bytes(), (self.root / "expected.bmp").read_bytes())
        self.assertIn("11 passed, 0 failed", self.make_well("check"))
        self.assertIn("wide-clipped: nothing has changed", self.make_well("diff"))
        self.assertFalse((self.root / "out/nested-transforms/traced.bmp").exists())
        self.touch(self.bin / "trace")
        printed = self.make_well()
        self.assertEqual([printed.count(f"bin/{tool} ") for tool in (*TOOLS, "trace")], [0, 0, 0, 0, 1])

    def test_a_scene_for_trace_alone(self):
        """Its own files, and those of the others stay as they are."""
        shutil.copy2(bin_dir / "trace", self.bin)
        shutil.copytree(source / "samples/spheres", self.root / "samples/spheres")
        made = ["stage1.txt", "stage2.txt", "traced.bmp", "z_buffer.txt"]
        self.assertIn("14 passed, 0 failed", self.make_well("-j2", "check"))
        texts = {"stage1.exact", "stage2.exact"}
        self.assertEqual(sorted({path.name for path in (self.root / "out/spheres").iterdir()} - texts), made)
        self.assertEqual((self.root / "out/spheres/stage1.txt").read_text().count("sphere\n"), 5)
        printed = self.make_well()
        self.assertEqual([printed.count(f"bin/{tool} ") for tool in (*TOOLS, "trace")], [0] * 5)
        self.touch(self.file("spheres", "config.txt"))
        printed = self.make_well()
        self.assertEqual([printed.count(f"bin/{tool} ") for tool in (*TOOLS, "trace")], [0, 0, 0, 0, 1])
        scene = self.file("spheres", "traced-scene.txt")
        scene.write_text(scene.read_text().replace("sphere 2.1 0.71", "sphere 2.1 0.81"))
        self.touch(scene)
        for name in ("stage1.txt", "stage2.txt", "z_buffer.txt", "traced.bmp"):
            self.assertIn(f"FAIL  samples/spheres/{name} differs", self.make("check").stdout)
        told = self.make_well("diff", f"COMPARE={source}/scripts/compare")
        self.assertIn("spheres: model is the first stage that has changed (stage1.txt)", told)
        self.assertIn("of point 1 of sphere 2: 0.81 in A, 0.71 in B", told)
        shutil.copy(self.root / "out/spheres/stage1.txt", self.file("spheres", "stage1.txt"))
        shutil.copy(self.root / "out/spheres/stage2.txt", self.file("spheres", "stage2.txt"))
        self.assertIn("spheres: trace is the first stage that has changed (z_buffer.txt)",
                      self.make_well("diff", f"COMPARE={source}/scripts/compare"))
        self.make_well("accept")
        self.assertIn("14 passed, 0 failed", self.make_well("check"))

    def test_parallel_jobs_do_the_same(self):
        self.assertEqual(self.runs_of_tools("-j2"), {"model": 4, "view": 4, "project": 2, "zbuf": 2})
        self.assertIn("10 passed, 0 failed", self.make_well("-j2", "check"))

    def test_nothing_is_remade_when_nothing_changed(self):
        self.make_well()
        self.assertEqual(self.runs_of_tools(), {"model": 0, "view": 0, "project": 0, "zbuf": 0})

    def test_a_config_concerns_zbuf_alone(self):
        self.make_well()
        self.touch(self.file("wide-clipped", "config.txt"))
        self.assertEqual(self.runs_of_tools(), {"model": 0, "view": 0, "project": 0, "zbuf": 1})

    def test_a_scene_concerns_every_stage_of_its_sample(self):
        self.make_well()
        self.touch(self.file("wide-clipped", "scene.txt"))
        self.assertEqual(self.runs_of_tools(), {"model": 2, "view": 2, "project": 1, "zbuf": 1})

    def test_a_tool_concerns_its_stage_and_those_after_it(self):
        self.make_well()
        self.touch(self.bin / "view")
        self.assertEqual(self.runs_of_tools(), {"model": 0, "view": 4, "project": 2, "zbuf": 2})

    def test_check_names_the_file_that_differs(self):
        self.file("wide-clipped", "stage2.txt").write_text("0 0 0\n")
        done = self.make("check")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("FAIL  samples/wide-clipped/stage2.txt differs from out/wide-clipped/stage2.txt\n",
                      done.stdout)
        self.assertIn("9 passed, 1 failed\n", done.stdout)

    def test_a_sum_stands_for_a_file(self):
        texts = [self.file("wide-clipped", "stage3.txt").read_bytes(), b"0 0 0\n"]
        self.file("wide-clipped", "stage3.txt").unlink()
        for text, counts in zip(texts, ("10 passed, 0 failed", "9 passed, 1 failed")):
            (self.root / "samples/SHA256SUMS"
             ).write_text(f"{hashlib.sha256(text).hexdigest()}  wide-clipped/stage3.txt\n")
            self.assertIn(counts, self.make("check").stdout)
        self.assertIn(
            "wide-clipped: project is the first stage that has changed "
            "(stage3.txt, of which only the sum is kept)\n", self.make_well("diff"))
        self.make_well("accept")
        self.assertFalse(self.file("wide-clipped", "stage3.txt").exists())

    def test_diff_says_that_nothing_has_changed(self):
        self.make_well()
        self.assertEqual(self.make_well("diff"),
                         "nested-transforms: nothing has changed\nwide-clipped: nothing has changed\n")

    def test_diff_shows_the_first_stage_that_has_changed(self):
        stages = (("stage1.txt", "model"), ("stage2.txt", "view"), ("stage3.txt", "project"),
                  ("z_buffer.txt", "zbuf"), ("out.bmp", "zbuf"))
        self.make_well()
        for name, stage in reversed(stages):  # those behind it differ, too
            data = self.file("wide-clipped", name).read_bytes()
            if name == "out.bmp":
                self.file("wide-clipped",
                          name).write_bytes(data[:-4] + bytes(255 - byte for byte in data[-4:-3]) + data[-3:])
            else:
                text, digit = data.decode(), re.search("[1-8]", data.decode())
                self.file("wide-clipped",
                          name).write_text(text[:digit.start()] + str(int(digit[0]) + 1) + text[digit.end():])
            printed = self.make_well("diff", f"COMPARE={source}/scripts/compare").split("\n")
            self.assertEqual(printed[:2], [
                "nested-transforms: nothing has changed",
                f"wide-clipped: {stage} is the first stage that has changed ({name})"])
            self.assertIn(f"out/wide-clipped/{name} and samples/wide-clipped/{name}", printed[2])
            self.assertEqual(
                [line.split()[-2] for line in printed if " that differ " in line or " differing " in line],
                ["1"], printed)

    def test_diff_misses_a_file_that_was_not_accepted(self):
        self.make_well()
        self.file("wide-clipped", "stage3.txt").unlink()
        self.assertIn("wide-clipped: stage3.txt of project has not been accepted yet\n",
                      self.make_well("diff"))

    def test_diff_fails_if_files_cannot_be_compared(self):
        self.file("wide-clipped", "stage2.txt").write_text("0 0 0\n", "utf-16")
        done = self.make("diff", f"COMPARE={source}/scripts/compare")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("wide-clipped: view is the first stage that has changed (stage2.txt)\n", done.stdout)

    def test_digits_concern_the_text_files_and_what_is_drawn_of_them(self):
        self.make_well()
        self.assertEqual(self.runs_of_tools("DIGITS=exact"), {"model": 2, "view": 2, "project": 2, "zbuf": 2})
        self.assertEqual(self.runs_of_tools("DIGITS=exact"), {"model": 0, "view": 0, "project": 0, "zbuf": 0})
        scene = self.file("wide-clipped", "scene.txt")
        for name, stages in (("stage1.txt", "bin/model --bare --digits exact"), (
                "stage3.txt",
                "bin/model --digits exact | bin/view --digits exact | bin/project --digits exact")):
            with open(scene, "rb") as stdin:
                expected = subprocess.run(stages, shell=True, cwd=self.root, stdin=stdin,
                                          stdout=subprocess.PIPE, check=True).stdout
            self.assertEqual((self.root / "out/wide-clipped" / name).read_bytes(), expected)

    def test_the_folder_may_be_any(self):
        before = {path: path.stat().st_mtime_ns for path in (self.root / "samples").rglob("*")}
        for folder in ("mine", "elsewhere/mine", str(self.root / "there")):
            shutil.copytree(source / "samples/worked-example", self.root / folder / "a")
            words = ["-f", "Makefile.samples", "BIN=bin", "-j2", f"DIR={folder}"]
            done = self.call_make(*words, "check")
            self.assertEqual((done.stdout.split("\n")[-2], done.returncode), ("5 passed, 0 failed", 0))
            (self.root / folder / "a/stage1.txt").unlink()
            self.assertEqual(self.call_make(*words, "accept").returncode, 0)
            self.assertEqual((self.root / folder / "a/stage1.txt").read_bytes(),
                             (source / "samples/worked-example/stage1.txt").read_bytes())
        self.assertEqual(sorted(os.listdir(self.root / "build")), ["elsewhere", "mine", "there"])
        self.assertEqual({path: path.stat().st_mtime_ns
                          for path in (self.root / "samples").rglob("*")}, before)

    def test_a_folder_without_samples_is_said_to_have_none(self):
        done = self.make("DIR=bin")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no folder in bin has a scene.txt", done.stdout)

    def test_a_failing_tool_leaves_no_half_target(self):
        for tool, targets in (("model", ("stage1.exact", "stage1.txt")),
                              ("view", ("stage2.exact", "stage2.txt")), ("project", ("stage3.txt",))):
            with self.subTest(tool=tool):
                shutil.rmtree(self.root / "out", ignore_errors=True)
                kept = (self.bin / tool).read_bytes()
                self.replace(tool, FAILING_TOOL)
                self.assertNotEqual(self.make("-k").returncode, 0)
                for target in targets:
                    self.assertFalse((self.root / "out" / "wide-clipped" / target).exists(), target)
                (self.bin / tool).write_bytes(kept)

    def test_missing_tools_are_said_to_be_missing(self):
        (self.bin / "view").unlink()
        done = self.make()
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("bin/view is not there: build the tools", done.stdout)


if __name__ == "__main__":
    unittest.main()
