#!/usr/bin/env python3
"""Random scenes through the pipe: every printed word is a number, never nan, inf or a zero with a sign.

The seed is fixed, so that a failure can be repeated.
usage: numbers_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import random
import re
import unittest

from toolbox import ToolTest, run

TAME = [
    "0", "-0", "1", "-1", "0.5", "-0.5", "2", "3", "-0.00000005", "0.00000005", "1e-8", "-1e-9", "0.1",
    "-0.3", "1e3", "-7"]
WILD = TAME + [
    "1e-320", "-5e-324", "1e-200", "-1e-100", "1e15", "-1e16", "123456789.123456789", "1e100", "-1e150"]
EXTREME = WILD + ["1e308", "-1.7976931348623157e308", "1e-308", "1e200", "-1e290"]
ANGLES = ["0", "-0", "30", "45", "90", "-90", "180", "270", "360", "-360", "1e9", "1e-9", "33.3", "1e300"]

NUMBER = re.compile(r"-?\d+(\.\d+)?(e[+-]\d+)?")
NEGATIVE_ZERO = re.compile(r"-0(\.0*)?")


class Scenes:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def vec3(self, numbers):
        return " ".join(self.random.choice(numbers) for _ in range(3))

    def command(self, numbers):
        kind = self.random.choice([
            "translate", "scale", "rotate", "push", "pop", "triangle", "triangle", "triangle"])
        if kind == "triangle":
            return "triangle\n" + "".join(self.vec3(numbers) + "\n" for _ in range(3))
        if kind == "rotate":
            return (f"rotate {self.random.choice(ANGLES)} "
                    f"{self.vec3(['0', '1', '-2', '1e-200', '-0'])[:-1]}3\n")
        return kind + (" " + self.vec3(numbers) if kind in ("translate", "scale") else "") + "\n"

    def small_scene(self, numbers):
        """Commands that leave the matrix unchanged: no pop reaches below its push."""
        lines, depth = [], 0
        for _ in range(self.random.randrange(1, 12)):
            line = self.command(numbers)
            if line == "pop\n" and depth == 0:
                continue
            depth += (line == "push\n") - (line == "pop\n")
            lines.append(line)
        return "push\n" + "".join(lines) + "pop\n" * (depth + 1)

    def camera(self, numbers):
        projection = self.random.choice([
            "60 1 1 100", "90 1.5 0.001 1e9", "1e-3 1 1e-9 1e-8", "120 1 1e-200 1e200",
            "ortho -1 1 -2 2 -10 1e10", "frustum -1 2 -0.5 0.5 0.1 1000"])
        return f"{self.vec3(numbers)}\n{self.vec3(numbers)}\n{self.vec3(numbers)}\n{projection}\n"


class PrintedNumbers(ToolTest):
    def check_text(self, tool, text):
        for line in text.decode().splitlines():
            words = line.split()
            if not words or words[0] == "error":
                continue
            for word in words[1:] if words[0][0].isalpha() else words:
                if not NUMBER.fullmatch(word) or NEGATIVE_ZERO.fullmatch(word):
                    self.fail(f"{tool} prints {word} in {line!r}")

    def run_stage(self, tool, options, text):
        """The output, good or bad; a failure prints one line on stderr."""
        done = run(tool, *options, stdin=text)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        messages = [
            line for line in done.stderr.decode().splitlines() if not line.startswith(f"{tool}: note: ")]
        self.assertEqual(len(messages), done.returncode, done.stderr)
        self.check_text(tool, done.stdout)
        return done

    def check_scene(self, scene, choose):
        """How many of the four stages accept the output of the previous one."""
        digits = ["--digits", choose(["0", "1", "7", "7", "7", "17", "exact"])]
        clip = ["--clip", choose(["auto", "near", "frustum", "reject"])]
        with open("config.txt", "w") as config:
            config.write(choose(["8 8\n", "16 3\n-1\n-2\n-1 1\n", "5 7\n-0.5\n-0.25\n0 2\n"]))
        stages = [("model", digits), ("view", digits), ("project", digits + clip), ("zbuf", ["config.txt"])]
        text = scene
        for count, (tool, options) in enumerate(stages):
            done = self.run_stage(tool, options, text)
            if done.returncode != 0:
                return count
            text = done.stdout
        return len(stages)

    def check_scenes(self, seed, run_count, scenes_per_run, numbers, camera_numbers):
        scenes = Scenes(seed)
        depths = []
        for i in range(run_count):
            body = "".join(scenes.small_scene(numbers) for _ in range(scenes_per_run))
            with self.subTest(run=i):
                depths.append(
                    self.check_scene(scenes.camera(camera_numbers) + body + "end\n", scenes.random.choice))
        return sum(depth == 4 for depth in depths) / run_count

    def test_tame_numbers(self):
        self.assertGreater(self.check_scenes(1, 40, 60, TAME, TAME), 0.3,
                           "most scenes fail: they test nothing")

    def test_wild_numbers(self):
        self.assertGreater(self.check_scenes(2, 40, 30, WILD, WILD), 0.1,
                           "most scenes fail: they test nothing")

    def test_extreme_numbers(self):
        self.check_scenes(3, 150, 1, EXTREME, EXTREME)


if __name__ == "__main__":
    unittest.main()
