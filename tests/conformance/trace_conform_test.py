#!/usr/bin/env python3
"""trace passes the cases of zbuf under the rule `center`, their texts in NDC put before a parallel
projection.

usage: trace_conform_test.py BIN_DIR SOURCE_DIR
"""
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN = pathlib.Path(sys.argv.pop()).resolve()
PACK = SOURCE / "tests/conformance"
sys.path.insert(0, str(PACK))
from conform_parts.cases import read_cases  # noqa: E402


class Trace(unittest.TestCase):
    def test_passes_all_cases_but_those_of_projected_texts(self):
        """A text in view space has neither the column w nor `projected`, `clipped` or `bounds ndc`."""
        done = subprocess.run([
            sys.executable, PACK / "conform", "--sandbox", "no", "--tap", "--stage", "zbuf", "--rule",
            "center", "--", PACK / "trace_from_ndc.sh", BIN / "trace", "{config}", "--no-shadows",
            "--no-recursion", "{options}"], stdout=subprocess.PIPE, text=True, timeout=600)
        wrong = re.findall(r"^not ok \d+ - (\S+)$", done.stdout, re.M)
        projected = {
            case.short_name
            for case in read_cases("zbuf")
            if re.search(rb"^(attributes w|projected|clipped|bounds)\b", case.read("input.txt"), re.M)}
        # Texts that zbuf refuses because they have not been through project.
        of_view = {
            "refused-lights-of-no-projection", "refused-text-of-view", "refused-frustum-not-projected",
            "refused-ortho-not-projected", "refused-sphere"}
        of_zbuf = {
            "rows", "rows-all", "rows-first", "rows-last", "algorithm-scanline", "algorithm-zbuffer",
            "depth-epsilon"}
        of_zbuf |= {
            case.short_name
            for case in read_cases("zbuf") if case.short_name.startswith("wireframe-")}
        # Lost where the text is put behind a header.
        of_ends = {"lines-byte-order-mark", "refused-end-without-a-line-feed"}
        self.assertLessEqual({name.removeprefix("zbuf/")
                              for name in wrong}, projected | of_view | of_zbuf | of_ends, done.stdout)
        right = re.findall(r"^ok \d+ - zbuf/\S+$", done.stdout, re.M)
        self.assertEqual(len(right) + len(wrong), len(read_cases("zbuf")), done.stdout[-4000:])


if __name__ == "__main__":
    unittest.main()
