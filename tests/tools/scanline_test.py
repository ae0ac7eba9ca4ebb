#!/usr/bin/env python3
"""zbuf --algorithm scanline, end to end: the same bytes as the z-buffer, and no memory for the frame.

usage: scanline_test.py BIN_DIR [SameBytes|Memory|LongMemory]
"""
import os
import pathlib
import random
import subprocess
import unittest

from toolbox import SOURCE, ToolTest, command

RULES = [[coverage, depth] for coverage in ("nearest", "center") for depth in ("f64", "f32", "u24")]


def zbuf(config, stage3, *options):
    """The depth text and the image."""
    done = subprocess.run(command("zbuf", config, stage3, "--image", "out.ppm", *options),
                          stdout=subprocess.PIPE, check=True)
    return done.stdout, pathlib.Path("out.ppm").read_bytes()


def triangle(rng, size):
    """A triangle around a random point, as text, with the digits of a stage text or all those of a double."""
    x, y = rng.uniform(-1.2, 1.2), rng.uniform(-1.2, 1.2)
    form = rng.choice(("%.7f", "%.7f", "%.2f", "%.17g", "%.25f"))
    points = [[x + rng.uniform(-size, size), y + rng.uniform(-size, size),
               rng.uniform(-1.2, 1.2)] for _ in range(3)]
    return "".join(" ".join(form % c for c in point) + "\n" for point in points) + "\n"


class SameBytes(ToolTest):
    def check_all_rules(self, config, stage3):
        for coverage, depth in RULES:
            options = ["--coverage", coverage, "--depth", depth]
            expected = zbuf(config, stage3, *options, "--algorithm", "zbuffer")
            with self.subTest(stage3=str(stage3), coverage=coverage, depth=depth):
                self.assertTrue(
                    zbuf(config, stage3, *options, "--algorithm", "scanline") == expected, "differs")

    def test_every_sample(self):
        samples = sorted(SOURCE.glob("samples/*/stage3.txt"))
        self.assertGreaterEqual(len(samples), 7)
        for stage3 in samples:
            self.check_all_rules(stage3.parent / "config.txt", stage3)

    def test_many_triangles_and_large_ones(self):
        rng = random.Random(1)
        for size, count in ((0.01, 20000), (0.3, 300), (2, 40)):
            pathlib.Path("stage3.txt").write_text("".join(triangle(rng, size) for _ in range(count)))
            pathlib.Path("config.txt").write_text("400 300\n-1\n-1\n-1 0.9\n")
            self.check_all_rules("config.txt", "stage3.txt")

    def test_no_triangles(self):
        pathlib.Path("stage3.txt").write_text("")
        self.check_all_rules("config.txt", "stage3.txt")

    def test_the_z_buffer_is_the_default(self):
        self.assertIn(b"(default: zbuffer)",
                      subprocess.run(command("zbuf", "--help"), stdout=subprocess.PIPE, check=True).stdout)


class MemoryTest(ToolTest):
    FEW = ("-0.01 -0.02 0.5\n0.02 -0.01 0.1\n0.0 0.02 -0.3\n\n"  # in the middle
           "-1 -1 0.9\n1 -0.9999 0.9\n1 -1 0.9\n\n"               # along the lower border
           "-0.9 0.9 0\n-0.88 0.9 0.4\n-0.9 0.88 0.3\n\n")

    def check(self, config):
        pathlib.Path("config.txt").write_text(config)
        pathlib.Path("few.txt").write_text(self.FEW)
        words = command("zbuf", "config.txt", "few.txt", "--algorithm", "scanline", "--z-buffer", "/dev/null",
                        "--image", "/dev/null")
        process = subprocess.Popen(words)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(process.returncode, 0)
        return usage.ru_maxrss / 1024


class Memory(MemoryTest):
    def test_a_large_screen_takes_no_memory(self):
        # The z-buffer would need 65535 * 4000 * 12 bytes, 3 GB.
        self.assertLess(self.check("65535 4000\n"), 40)


class LongMemory(MemoryTest):
    def test_the_largest_screen_takes_no_memory(self):
        self.assertLess(self.check("65535 65535\n"), 40)


if __name__ == "__main__":
    unittest.main()
