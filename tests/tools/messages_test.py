#!/usr/bin/env python3
"""Every error gets one line on stderr: the tool, the location, the expected and the found text. The cases are
in messages.txt; more of what readers say is in tests/scene and tests/stream.

usage: messages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import dataclasses
import itertools
import os
import pathlib
import re
import shlex
import unittest

import toolbox
from toolbox import BIN, SOURCE, ToolTest, add_claims, alternatives, run


@dataclasses.dataclass
class Case:
    command: str
    input: str = ""
    stderr: str = ""


def with_texts(text, texts):
    """The text with those that {NAME} and {3*NAME} are for."""
    return re.sub(r"\{(?:(\d+)\*)?([A-Z_]+)\}", lambda found: int(found[1] or 1) * texts[found[2]], text)


def read_cases():
    """The cases by their claims, and the texts by their names."""
    cases, texts = [], dict(vars(toolbox))
    for line in pathlib.Path(__file__).with_name("messages.txt").read_text().splitlines():
        if definition := re.fullmatch(r"([A-Z_]+) = (.*)", line):
            texts[definition[1]] = with_texts(definition[2], texts)
        elif line.startswith("$ "):
            command, claim = line[2:].rsplit("  # ", 1)
            cases.append((claim, Case(command)))
        elif line.startswith("< "):
            cases[-1][1].input += line[2:]
        elif line.startswith("> "):
            cases[-1][1].stderr += line[2:] + "\n"
        elif line and not line.startswith("#"):
            raise ValueError(f"messages.txt: neither command, input nor answer: {line}")
    return cases, texts


CASES, TEXTS = read_cases()


def ways(case):
    """(command, input as bytes) with each of the alternatives {a|b} of both."""
    for way in alternatives(f"{case.command}\0{case.input}"):
        command, text = way.split("\0")
        texts = {**TEXTS, "HEADER": toolbox.HEADERS.get(tool_of(command.split(" | ")[-1]), "")}
        yield command, with_texts(text, texts).encode("latin-1").decode("unicode_escape").encode("latin-1")


def tool_of(stage):
    return next(word for word in stage.split() if "=" not in word)


class Messages(ToolTest):
    def check(self, case):
        for command, text in ways(case):
            with self.subTest(command, text=text[-200:]):
                self.check_one(command, text, case.stderr)

    def check_one(self, command, text, stderr):
        pathlib.Path("input.txt").write_bytes(text)
        *before, last = command.encode().decode("unicode_escape").split(" | ")
        for stage in before:
            text = toolbox.pipe(shlex.split(stage), stdin=text)
        settings = dict(word.split("=") for word in last.split() if word.startswith("PIPELINE_"))
        tool, *words = shlex.split(last)[len(settings):]
        if not (BIN / tool).exists():
            self.skipTest(f"{tool} has not been built")
        done = run(tool, *words, stdin=text, env={**os.environ, **settings})
        expected = stderr.replace("TOOL", tool)
        lines = expected.splitlines()
        status = 0 if all(": note: " in line for line in lines) else 1 + expected.endswith(" --help)\n")
        self.assertEqual((done.stderr.decode(), done.returncode), (expected, status))
        if status:
            self.assertEqual(self.files(), ["config.txt", "input.txt", "scene.txt"])


add_claims(Messages, CASES)


class Samples(ToolTest):
    def test_none_has_digits_that_are_not_certain(self):
        scenes = sorted(SOURCE.glob("samples/*/scene.txt"))
        self.assertGreaterEqual(len(scenes), 8)
        for scene, digits in itertools.product(scenes, ("7", "9", "exact")):
            text = scene.read_bytes()
            for stage in ("model", "view", "project"):
                done = run(stage, "--digits", digits, stdin=text)
                text = done.stdout
                self.assertNotIn(b"certain", done.stderr, f"{stage} --digits {digits} {scene}")
                self.assertEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
