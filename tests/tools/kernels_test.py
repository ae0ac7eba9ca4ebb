#!/usr/bin/env python3
"""The text stages write the same bytes on every kind of processor: PIPELINE_KERNEL selects the fast paths of
an older one.

usage: kernels_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import random
import unittest

from toolbox import HEADER, HEADERS, ToolTest, run

KERNELS = ("scalar", "sse4", "avx2", "avx512")
DIGITS = ([], *(["--digits", str(decimals)] for decimals in range(18)), ["--digits", "exact"], [
    "--digits", "exact", "--precision", "double"], ["--precision", "double"])


def random_text(count):
    """Triangles in front of the eye; numbers of few and of many digits, some of them ties at the eighth
    decimal."""
    rng = random.Random(1)

    def number(low, high):
        value = rng.uniform(low, high)
        return rng.choice(("%.7f" % value, "%.7f" % value, "%.17g" % value, "%d" % value,
                           "%.8f" % ((int(value * 128) + 0.5) / 128)))

    return "".join(
        f"{number(-3, 3)} {number(-3, 3)} {number(-9, -2)}\n" + "\n" * (i % 3 == 2) for i in range(3 * count))


class Kernels(ToolTest):
    def assert_same(self, tool, *options, stdin):
        texts = {
            kernel: run(tool, *options, stdin=stdin, env=os.environ | {"PIPELINE_KERNEL": kernel})
            for kernel in KERNELS}
        for kernel, done in texts.items():
            self.assertEqual((done.stderr, done.returncode), (texts["scalar"].stderr, 0))
            self.assertTrue(done.stdout == texts["scalar"].stdout,
                            f"{tool} {options}: {kernel} prints something else")

    def test_random_texts_with_every_kind_of_digits(self):
        text = random_text(3000)
        scene = "0 0 5\n0.3 0 0\n0 1 0\n60 1 1 100\nrotate\n20 1 2 3\n" + \
            "".join("triangle\n" + triangle + "\n" for triangle in text.split("\n\n") if triangle) + "end\n"
        for digits in DIGITS:
            self.assert_same("model", *digits, stdin=scene)
            self.assert_same("view", *digits, stdin=HEADER + text)
            self.assert_same("project", *digits, stdin=HEADERS["project"] + text)
            self.assert_same("project", "--ortho", "-4", "4", "-4", "4", "1", "10", *digits, stdin=text)


if __name__ == "__main__":
    unittest.main()
