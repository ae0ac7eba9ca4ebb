#!/usr/bin/env python3
"""The advice in docs/ is what scripts/measure/tradeoff measured, and a claim that does not hold is found.

usage: claims_test.py SOURCE_DIR
"""
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
sys.path[:0] = [str(SOURCE / "scripts/measure")]

from parts.tradeoff_claims import broken_claims, claims  # noqa: E402
from parts.tradeoff_report import REASONS  # noqa: E402
from parts.tradeoff_results import Results  # noqa: E402

RESULTS = SOURCE / "scripts/measure/results"
ACCURACY = (SOURCE / "docs/accuracy.md").read_text()


def made_up(**numbers):
    """Results of one scene: the default at 100, `--digits 5` with other numbers, all without errors unless
    given."""
    common = {
        "scene": "plain", "title": "", "machine": "", "counter": "", "triangles": "10", "wrong_pixels": "0",
        "flipped_pixels": "0", "covered_pixels": "50", "bytes": "100", "cpu_seconds": "100",
        "cpu_seconds_q1": "99", "cpu_seconds_q3": "101"}
    return Results([{**common, "setting": "default"}, {**common, "setting": "--digits 5", **numbers}],
                   [{"setting": "default", "distance": "5", "fighting": "0.5", "swallowed": "1e-6"}])


class Advice(unittest.TestCase):
    def test_every_claim_of_the_docs_is_what_was_measured(self):
        results = Results.of(RESULTS)
        for page in sorted((SOURCE / "docs").glob("*.md")):
            self.assertEqual(list(broken_claims(page.read_text(), results)), [], page.name)

    def test_every_advice_rests_on_figures(self):
        rows = re.findall(r"^\| .* \|$", ACCURACY.split("| you have |")[1].split("\n\n")[0], re.MULTILINE)
        self.assertGreater(len(rows), 4)
        self.assertEqual([row for row in rows if not list(claims(row))], [])

    def test_every_number_of_an_advice_is_in_a_claim(self):
        """A number before 'times' or '%' can be wrong after the next measurement, except in a console."""
        advice = re.sub(r"^```.*?^```", "", ACCURACY, flags=re.DOTALL | re.MULTILINE)
        for line in advice.split("<!-- tradeoff: begin -->")[0].splitlines():
            words = re.sub(r"<!--.*?-->", "", line)
            stated = set(re.findall(r"(?<![\w.-])(\d+(?:\.\d+)?)(?= times| %)", words))
            self.assertLessEqual(stated, {claim[3] for _, claim in claims(line)}, line)

    def test_every_setting_that_is_beaten_has_a_reason_to_stay(self):
        results = Results.of(RESULTS)
        self.assertEqual([setting for setting in results.beaten() if setting not in REASONS], [])
        self.assertEqual([setting for setting in REASONS if setting not in results.judged], [])


class Claims(unittest.TestCase):
    def broken(self, sentence, **numbers):
        return list(broken_claims(sentence, made_up(**numbers)))

    def test_a_number_in_the_sentence_is_within_a_sixth(self):
        sentence = ("It takes 1.5 times as long. <!-- rests on: cpu(plain, --digits 5) / cpu(plain, default) "
                    "about 1.5 -->")
        for cpu in ("130", "150", "174"):
            self.assertEqual(self.broken(sentence, cpu_seconds=cpu), [])
        for cpu, ratio in (("128", "1.28"), ("176", "1.76")):
            self.assertEqual(self.broken(sentence, cpu_seconds=cpu), [
                f"'cpu(plain, --digits 5) / cpu(plain, default) about 1.5' is {ratio}: It takes 1.5 times "
                f"as long."
            ])

    def test_a_number_has_to_be_in_the_sentence(self):
        note = " <!-- rests on: bytes(plain, --digits 5) / bytes(plain, default) about 1 -->"
        for sentence in ("as many", "11 times", "1.5 times", "0.1 times"):
            self.assertIn("is not in the sentence", self.broken(sentence + note)[0], sentence)
        self.assertEqual(self.broken("1 time." + note), [])

    def test_a_range_includes_its_ends(self):
        sentence = "Nothing is wrong. <!-- rests on: wrong(plain, --digits 5) in 0..0.02 -->"
        self.assertEqual(self.broken(sentence, wrong_pixels="1"), [])
        self.assertEqual(len(self.broken(sentence, wrong_pixels="1", flipped_pixels="1")), 1)

    def test_one_sentence_rests_on_several_figures(self):
        sentence = ("Less. <!-- rests on: bytes(plain, --digits 5) in 1..99; cpu(plain, default) in 10..10; "
                    "fighting(5, default) in 0.5..0.5 -->")
        self.assertEqual(self.broken(sentence, bytes="80"), [])
        self.assertEqual(len(self.broken(sentence, bytes="100")), 1)

    def test_what_was_not_measured_holds_nothing(self):
        for figure in ("cpu(lit, default)", "cpu(plain, --digits 6)", "memory(plain, default)",
                       "swallowed(6, default)", "wrong(lit, default)"):
            self.assertIn("was not measured", self.broken(f"x <!-- rests on: {figure} in 0..9 -->")[0])

    def test_a_note_that_is_no_claim_is_an_error(self):
        with self.assertRaises(SystemExit):
            self.broken("x <!-- rests on: cpu(plain, default) -->")


class Beaten(unittest.TestCase):
    def test_worse_in_one_column_and_better_in_none_is_beaten(self):
        for worse in ({"bytes": "104"}, {"wrong_pixels": "1"}, {
                "cpu_seconds": "110", "cpu_seconds_q1": "102", "cpu_seconds_q3": "120"}):
            self.assertEqual(made_up(**worse).beaten(), {"--digits 5": ["default"]}, worse)

    def test_better_in_one_column_is_not(self):
        for better in ({"bytes": "90"}, {"cpu_seconds": "90", "cpu_seconds_q1": "89",
                                         "cpu_seconds_q3": "98"}):
            self.assertEqual(made_up(wrong_pixels="1", **better).beaten(), {}, better)

    def test_costs_within_three_per_cent_are_the_same(self):
        self.assertEqual(
            made_up(bytes="102", cpu_seconds="102.5", cpu_seconds_q1="102", cpu_seconds_q3="103").beaten(),
            {})

    def test_times_whose_quartiles_overlap_are_the_same(self):
        self.assertEqual(made_up(cpu_seconds="110", cpu_seconds_q1="100", cpu_seconds_q3="120").beaten(), {})

    def test_without_errors_there_is_no_verdict(self):
        self.assertEqual(
            made_up(bytes="200", covered_pixels="", wrong_pixels="", flipped_pixels="").beaten(), {})


unittest.main()
