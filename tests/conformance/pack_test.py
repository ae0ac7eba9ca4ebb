#!/usr/bin/env python3
"""The conformance pack is complete and in good order, and our stages and trace pass it.

usage: pack_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import re
import subprocess
import sys
import unittest
from types import SimpleNamespace

from toolbox import BIN, SOURCE

PACK = SOURCE / "tests/conformance"
sys.path.insert(0, str(PACK))
from conform_parts.cases import NEEDS, RULES, STAGES, read_cases, read_mistakes  # noqa: E402
from conform_parts.trial import Terms, judge_outputs  # noqa: E402

CASES = {stage: read_cases(stage) for stage in STAGES}
TOOLS = {stage: [BIN / stage, *(["{config}"] if stage == "zbuf" else []), "{options}"] for stage in STAGES}
TERMS = Terms([], "nearest", None, False, True, True, True, None, None, None)  # each case by its own tier


def conform(*words):
    """A run on programs that we trust, which a sandbox would make slower."""
    return subprocess.run([sys.executable, PACK / "conform", "--sandbox", "no", "--tap", *map(str, words)],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600)


class Pack(unittest.TestCase):
    def test_has_enough_cases_of_each_kind_and_at_most_1500(self):
        self.assertLessEqual(sum(map(len, CASES.values())), 1500)
        for stage, least in {"model": 120, "view": 60, "project": 150, "zbuf": 270}.items():
            accepted = [case for case in CASES[stage] if case.refused_line is None]
            for rule in ("nearest", "center"):
                self.assertGreaterEqual(sum(not case.open_under(rule) for case in accepted), least, stage)
            self.assertGreater(len(CASES[stage]) - len(accepted), 80, stage)  # must be refused
            self.assertGreater(sum(not case.words("needs") for case in accepted), 80, stage)  # as assigned

    def test_every_case_gives_a_reason_and_names_what_exists(self):
        for stage, cases in CASES.items():
            for case in cases:
                with self.subTest(case=case.name):
                    self.assertRegex(case.why, r"^[A-Za-z-].*\.$")
                    self.assertTrue(case.words("paragraphs"))
                    self.assertLessEqual(set(case.words("catches")), read_mistakes(stage).keys())
                    self.assertLessEqual(set(case.words("needs")), NEEDS.keys())
                    self.assertIn(case.tier, ("bytes", "digits"))

    def test_every_mistake_is_caught_by_several_cases_and_has_its_output_in_one(self):
        for stage, cases in CASES.items():
            for mistake in re.findall(rf"^({stage}/[^:]+):", (PACK / "mistakes.txt").read_text(), re.M):
                with self.subTest(mistake=mistake):
                    self.assertGreaterEqual(sum(mistake in case.words("catches") for case in cases), 3)
                    name = f"with-{mistake.partition('/')[2]}"
                    self.assertTrue(any(case.has(f"{name}.txt") or case.has(f"{name}.bmp") for case in cases))

    def test_is_a_few_pages_for_people(self):
        pages = [*PACK.glob("cases/*/*.cases")]
        self.assertLessEqual(len(pages), 80)
        for page in pages:
            with self.subTest(page=page.name):
                self.assertLessEqual(page.stat().st_size, 100_000)
                self.assertLessEqual(max(map(len, page.read_text("ascii").split("\n"))), 110)


class Tools(unittest.TestCase):
    def assert_all_right(self, stage, *words):
        done = conform("--stage", stage, *words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout[-4000:])
        return done

    def test_pass_every_case_to_the_byte(self):
        for stage, tool in TOOLS.items():
            with self.subTest(stage=stage):
                done = self.assert_all_right(stage, "--tier", "bytes", "--", *tool)
                self.assertTrue(done.stdout.endswith(f"# {len(CASES[stage])} right, 0 wrong\n"))

    def test_what_is_right_to_the_byte_is_right_by_each_cases_own_tier(self):
        for stage, cases in CASES.items():
            for rule in RULES if stage == "zbuf" else RULES[:1]:
                for case in cases:
                    if case.refused_line is None:
                        names = (f"depths-{rule}.txt",
                                 f"picture-{rule}.bmp") if stage == "zbuf" else ("expected.txt",)
                        outputs = SimpleNamespace(**dict(zip(("text", "image"), map(case.read, names))))
                        self.assertIsNone(judge_outputs(case, TERMS._replace(rule=rule), outputs), case.name)

    def test_pass_by_the_other_rule_and_the_other_algorithm(self):
        # A refusal is the same by all of them.
        self.assert_all_right("zbuf", "--rule", "center", "--without", "refusals", "--", *TOOLS["zbuf"],
                              "--coverage", "center")
        done = conform("--stage", "zbuf", "--without", "refusals", "--", *TOOLS["zbuf"], "--algorithm",
                       "scanline")
        # An option may be given once, and the scan line has no order of drawing.
        self.assertEqual(set(re.findall(r"^not ok \d+ - zbuf/(\S+)$", done.stdout, re.M)),
                         {"algorithm-scanline", "algorithm-zbuffer", "depth-epsilon"}, done.stdout[-4000:])

    def test_pass_in_the_manner_of_the_assignment(self):
        for stage, words in (("model", ["--bare"]), ("view", ["--bare", "--scene", "{scene}"]), ("project", [
                "--scene", "{scene}"])):
            with self.subTest(stage=stage):
                self.assert_all_right(stage, "--assignment", "--tier", "bytes", "--", BIN / stage, *words)

    def test_four_lines_of_awk_pass_where_the_camera_looks_straight_ahead(self):
        for words in (["--batch", "--", "awk"], ["--", "awk", "-v", "eye={eye}"]):
            done = self.assert_all_right("view", "--only", "straight-*", *words, "-f",
                                         SOURCE / "scripts/view.awk")
            self.assertIn("\n# 8 right, 0 wrong\n", done.stdout)

    def test_trace_passes_all_but_projected_texts(self):
        """It gets texts in NDC before a parallel projection, under the rule `center`. A text in view space
        has neither the column w nor `projected`, `clipped` or `bounds ndc`."""
        done = conform("--stage", "zbuf", "--rule", "center", "--", PACK / "trace_from_ndc.sh", BIN / "trace",
                       "{config}", "--no-shadows", "--no-recursion", "{options}")
        wrong = re.findall(r"^not ok \d+ - (\S+)$", done.stdout, re.M)
        projected = {
            case.short_name
            for case in CASES["zbuf"]
            if re.search(rb"^(attributes w|projected|clipped|bounds)\b", case.read("input.txt"), re.M)}
        # Texts that zbuf refuses because they have not been through project.
        of_view = {
            "refused-lights-of-no-projection", "refused-text-of-view", "refused-frustum-not-projected",
            "refused-ortho-not-projected", "refused-sphere"}
        of_zbuf = {
            "rows", "rows-all", "rows-first", "rows-last", "algorithm-scanline", "algorithm-zbuffer",
            "depth-epsilon"}
        of_zbuf |= {case.short_name for case in CASES["zbuf"] if case.short_name.startswith("wireframe-")}
        # Lost where the text is put behind a header.
        of_ends = {"lines-byte-order-mark", "refused-end-without-a-line-feed"}
        self.assertLessEqual({name.removeprefix("zbuf/")
                              for name in wrong}, projected | of_view | of_zbuf | of_ends, done.stdout)
        right = re.findall(r"^ok \d+ - zbuf/\S+$", done.stdout, re.M)
        self.assertEqual(len(right) + len(wrong), len(CASES["zbuf"]), done.stdout[-4000:])


if __name__ == "__main__":
    unittest.main()
