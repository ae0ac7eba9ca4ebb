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
from toolbox import CAMERA, DRAWING, TRIANGLE, command

KILLS = 40  # of each stage


class KilledStages(OlderImageTest):
    """A stage is killed (SIGKILL) after a random part of the scene has been sent."""

    SCENE = CAMERA + TRIANGLE * 3000 + "end\n"
    STAGES = (["model", "--framed"], ["view"], ["project"], ["zbuf", "--expect-framed", "config.txt"])
    TRACED = (["model", "--framed"], ["view"], ["trace", "--expect-framed", "config.txt"])

    def start_pipe(self, stages):
        """The processes, and the pipe end that takes the scene."""
        processes, before, feed = [], subprocess.PIPE, None
        for tool, *options in stages:
            last = tool in DRAWING
            process = subprocess.Popen(command(tool, *options), stdin=before, stderr=subprocess.DEVNULL,
                                       stdout=subprocess.DEVNULL if last else subprocess.PIPE)
            if feed is None:
                feed = process.stdin
            else:
                before.close()
            before = process.stdout
            processes.append(process)
        return processes, feed

    def run_pipe(self, stages, victim, sent):
        """Kills stage `victim` (None for no stage) after so many bytes; returns the exit statuses."""
        processes, feed = self.start_pipe(stages)
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

    def check(self, stages):
        done = [0] * len(stages)
        self.assertEqual(self.run_pipe(stages, None, 0), done)
        good = pathlib.Path("out.bmp").read_bytes()
        rng = random.Random(7)
        refused = 0
        for victim in range(len(stages)):
            for _ in range(KILLS):
                pathlib.Path("out.bmp").write_bytes(OLD_IMAGE)
                sent = rng.randrange(len(self.SCENE) + 1)
                with self.subTest(victim=stages[victim][0], sent=sent):
                    statuses = self.run_pipe(stages, victim, sent)
                    image = pathlib.Path("out.bmp").read_bytes()
                    # A stage that had already finished when the signal came is no loss.
                    self.assertEqual(image, good if statuses[-1] == 0 else OLD_IMAGE)
                    self.assertTrue(statuses[victim] == -signal.SIGKILL or statuses == done, statuses)
                    self.assertEqual(self.files(), ["config.txt", "out.bmp", "scene.txt"])
                    refused += statuses[-1] != 0
        self.assertGreater(refused, KILLS * len(stages) / 2,
                           "most stages were done before the signal came: nothing was tested")

    def test_no_picture_of_a_part_ever_appears(self):
        self.check(self.STAGES)

    def test_nor_a_traced_one(self):
        self.check(self.TRACED)


if __name__ == "__main__":
    unittest.main()
