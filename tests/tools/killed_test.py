#!/usr/bin/env python3
"""Stages of a pipe are killed: no picture of a part of a framed scene ever appears.

usage: killed_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import random
import signal
import subprocess
import unittest

from older_files import OLD_IMAGE, OlderImageTest
from toolbox import CAMERA, TRIANGLE, command


class KilledStages(OlderImageTest):
    """A stage is killed (SIGKILL) after a random part of the scene has been sent."""

    SCENE = CAMERA + TRIANGLE * 3000 + "end\n"
    STAGES = (["model", "--framed"], ["view"], ["project"], ["zbuf", "--framed", "config.txt"])

    def start_pipe(self):
        """The four processes, and the pipe end that takes the scene."""
        processes, before, feed = [], subprocess.PIPE, None
        for tool, *options in self.STAGES:
            last = tool == "zbuf"
            process = subprocess.Popen(command(tool, *options), stdin=before, stderr=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL if last else subprocess.PIPE)
            if feed is None:
                feed = process.stdin
            else:
                before.close()
            before = process.stdout
            processes.append(process)
        return processes, feed

    def run_pipe(self, victim, sent):
        """Kills stage `victim` (None for no stage) after so many bytes; returns the exit statuses."""
        processes, feed = self.start_pipe()
        text = self.SCENE.encode()
        try:
            feed.write(text[:sent])
            feed.flush()
            if victim is not None:
                processes[victim].send_signal(signal.SIGKILL)
            feed.write(text[sent:])
            feed.close()
        except BrokenPipeError:
            try:
                feed.close()
            except BrokenPipeError:
                pass
        return [process.wait(timeout=60) for process in processes]

    def test_no_picture_of_a_part_ever_appears(self):
        self.assertEqual(self.run_pipe(None, 0), [0, 0, 0, 0])
        good = pathlib.Path("out.bmp").read_bytes()
        rng = random.Random(7)
        refused = 0
        for victim in range(4):
            for _ in range(100):
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
                sent = rng.randrange(len(self.SCENE) + 1)
                with self.subTest(victim=self.STAGES[victim][0], sent=sent):
                    statuses = self.run_pipe(victim, sent)
                    image = pathlib.Path("out.bmp").read_bytes()
                    # A stage that had already finished when the signal came is no loss.
                    self.assertEqual(image, good if statuses[3] == 0 else OLD_IMAGE)
                    self.assertTrue(statuses[victim] == -signal.SIGKILL or statuses == [0, 0, 0, 0], statuses)
                    self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])
                    refused += statuses[3] != 0
        self.assertGreater(refused, 200, "most stages were done before the signal came: nothing was tested")


if __name__ == "__main__":
    unittest.main()
