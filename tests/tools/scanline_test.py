#!/usr/bin/env python3
"""zbuf --algorithm scanline needs no memory for the frame; zbuf_test and C++ compare its pictures.

usage: scanline_test.py BIN_DIR [Memory|LongMemory]
"""
import os
import pathlib
import subprocess
import unittest

from toolbox import ToolTest, command


def zbuf(config, stage3, *options):
    """The depth text and the image."""
    done = subprocess.run(command("zbuf", config, stage3, "--image", "out.ppm", *options),
                          stdout=subprocess.PIPE, check=True)
    return done.stdout, pathlib.Path("out.ppm").read_bytes()


class MemoryTest(ToolTest):
    FEW = (
        "-0.01 -0.02 0.5\n0.02 -0.01 0.1\n0.0 0.02 -0.3\n\n"  # in the middle
        "-1 -1 0.9\n1 -0.9999 0.9\n1 -1 0.9\n\n"  # along the lower border
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
