#!/usr/bin/env python3
"""The conformance pack passes a right program of a student's, and fails each of its mistakes under the right
heading.

usage: conform_student_test.py STUDENT SOURCE_DIR
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
STUDENT = pathlib.Path(sys.argv.pop()).resolve()
PACK = SOURCE / "tests/conformance"
MISTAKES = re.findall(r"^([a-z]+/[^:\s]+): ", (PACK / "mistakes.txt").read_text(), re.M)
# No points can tell these apart.
ALIKE = [{"model/push-and-pop-ignored", "model/pop-ignored"},
         {"model/rotation-transposed", "model/angle-negated"},
         {"project/near-and-far-swapped", "project/z-row-sign"}]
OTHER_RULES = ("zbuf/truncated-ends", "zbuf/rounded-ends-depth", "zbuf/everything-printed")
HARMLESS = ("all/six-digits", "all/four-decimals", "all/blanks-at-line-ends", "all/carriage-returns")


def results(stage, *switches, options=()):
    """The exit status, the results as JSON, and the report of the student's program."""
    words = ["zbuf", "{config}"] if stage == "zbuf" else [stage, "--bare", "--scene", "{scene}"]
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "results.json")
        done = subprocess.run([
            sys.executable, PACK / "conform", "--sandbox", "no", "--tap", "--stage", stage, "--assignment",
            "--json", path, *options, "--", STUDENT, *words, *switches], stdout=subprocess.PIPE, text=True,
                              timeout=600)
        return done.returncode, json.loads(path.read_text()), done.stdout


class Student(unittest.TestCase):
    def assert_right(self, stage, *words, **others):
        status, found, report = results(stage, *words, **others)
        self.assertEqual((status, found["counts"]["wrong"]), (0, 0), report[-3000:])
        self.assertGreater(found["counts"]["right"], 80)

    def test_a_right_program_passes(self):
        for stage in ("model", "view", "project", "zbuf"):
            with self.subTest(stage=stage):
                self.assert_right(stage)

    def test_a_right_program_passes_by_its_own_rule(self):
        self.assert_right("zbuf", "--habit", "zbuf/center", options=["--rule", "center"])
        status, found, report = results("zbuf", "--habit", "zbuf/center")
        self.assertEqual((status, [heading["names"] for heading in found["mistakes"]]), (1, [[]]))
        self.assertIn("\n# By --rule center all of these are right.\n", report)

    def test_a_program_may_do_all_stages_at_once(self):
        for number, stage in enumerate(("model", "view", "project"), 1):
            with self.subTest(stage=stage):
                script = (f"{STUDENT} all scene.txt config.txt --folder . --habit all/exact-in-memory; cat "
                          f"stage{number}.txt")
                done = subprocess.run([
                    sys.executable, PACK / "conform", "--sandbox", "no", "--tap", "--stage", stage,
                    "--assignment", "--", "sh", "-c", script], stdout=subprocess.PIPE, text=True)
                self.assertEqual(done.returncode, 0, done.stdout[-3000:])

    def test_what_the_assignment_leaves_open_is_not_counted(self):
        for habit in ("zbuf/later-of-equals", "zbuf/no-slivers"):
            with self.subTest(habit=habit):
                status, found, _ = results("zbuf", "--habit", habit)
                self.assertEqual((status, found["counts"]["wrong"]), (0, 0))
                self.assertEqual(results("zbuf", "--habit", habit, options=["--count-open"])[0], 1)
        self.assert_right("zbuf", "--habit", "zbuf/other-colors")

    def test_digits_and_formatting_are_free(self):
        for habit in HARMLESS:
            for stage in ("model", "project"):
                with self.subTest(habit=habit, stage=stage):
                    self.assert_right(stage, "--habit", habit)

    def test_each_mistake_fails_under_its_heading_and_no_other(self):
        for mistake in (*MISTAKES, *OTHER_RULES):
            with self.subTest(mistake=mistake):
                status, found, report = results(
                    mistake.split("/")[0], "--habit" if mistake in OTHER_RULES else "--mistake", mistake)
                names = next((pair for pair in ALIKE if mistake in pair), {mistake})
                self.assertEqual((status, [set(heading["names"]) for heading in found["mistakes"]]),
                                 (1, [names]))
                self.assertIn(f"\n# {' or '.join(sorted(names))}: {found['counts']['wrong']} cases\n", report)

    def test_two_mistakes_have_two_headings(self):
        _, found, _ = results("model", "--mistake", "model/axis-not-normalized", "--mistake",
                              "model/push-of-the-identity")
        self.assertLessEqual({("model/axis-not-normalized",), ("model/push-of-the-identity",)},
                             {tuple(heading["names"])
                              for heading in found["mistakes"]})


if __name__ == "__main__":
    unittest.main()
