#!/usr/bin/env python3
"""model, view and project accept --threads N, which changes nothing: they work on one thread.

usage: threads_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import re
import unittest

from toolbox import CAMERA, HEADER, SOURCE, TRIANGLE, ToolTest, run, stage_texts
from streaming_test import LiveTool

FILTERS = ("model", "view", "project")


class Threads(ToolTest):
    def test_they_change_no_byte(self):
        for scene in sorted(SOURCE.glob("samples/*/scene.txt")):
            texts = (scene.read_bytes(), *stage_texts(scene.read_text()))
            for tool, text in zip(FILTERS, texts):
                expected = run(tool, stdin=text)
                for count in (1, 2, 256):
                    done = run(tool, "--threads", count, stdin=text)
                    self.assertEqual((done.returncode, done.stderr), (expected.returncode, expected.stderr))
                    self.assertTrue(done.stdout == expected.stdout, f"{tool} --threads {count} prints something else")

    @unittest.skipUnless(os.path.isdir("/proc/self/task"), "Linux alone lists the threads of a process")
    def test_they_are_not_started(self):
        for tool, start in (("model", CAMERA + TRIANGLE), ("view", HEADER + "0 0 0\n1 0 0\n0 1 0\n\n")):
            with LiveTool(tool, "--threads", "8") as live:
                live.send(start)
                self.assertEqual(live.receive(1), 1)
                self.assertEqual(len(os.listdir(f"/proc/{live.process.pid}/task")), 1)

    def test_help_says_so(self):
        for tool in FILTERS:
            self.assertRegex(re.sub(r"\s+", " ", run(tool, "--help").stdout.decode()),
                             r"--threads N Of no effect, as one thread does the work \(zbuf and trace have several\), from 1 to 256")

    def test_their_number_is_limited_as_it_was(self):
        for count in ("0", "257", "-1", "x"):
            self.assertEqual(run("view", "--threads", count).returncode, 2)


if __name__ == "__main__":
    unittest.main()
