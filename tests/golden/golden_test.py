#!/usr/bin/env python3
"""Every version reads and reproduces the golden texts: the samples' files, and what flows in the pipe between
the stages.

samples/SHA256SUMS pins the samples' files, of which the largest are not kept; pipes.sha256 pins what comes
out of COMMANDS. A line of either is never changed, so that old files can be read
for ever: who wants another scene adds a sample, and its lines with --add. Texts with all digits (--digits
exact) are those of tests/reference, which has no choice either: the shortest form is defined (stage-text.md,
T20). Only colors and normals are free behind the 7th decimal (stages.md, F3), so they are pinned with 7.

usage: golden_test.py BIN_DIR SOURCE_DIR [--add SAMPLE]
"""
import hashlib
import pathlib
import subprocess
import sys
import tempfile
import unittest
from decimal import Decimal

ADDED = [sys.argv.pop() for _ in [sys.argv.pop(-2)]] if "--add" in sys.argv else []
SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN = pathlib.Path(sys.argv.pop()).resolve()
SUMS, PIPES = SOURCE / "samples/SHA256SUMS", SOURCE / "tests/golden/pipes.sha256"
import reference  # noqa: E402

SMALL = ("nested-transforms", "one-triangle", "orthographic", "tilted-camera", "two-triangles",
         "wide-clipped", "worked-example")  # for the reference
FILES = ("scene.txt", "config.txt", "stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
# What is made of a sample's files, or of what a command before has made: name, stage and options, input.
COMMANDS = (("model", "model", "scene.txt"), ("view", "view", "model"), ("project", "project", "view"),
            ("zbuf", "zbuf config.txt", "project"), ("model --framed", "model --framed", "scene.txt"),
            ("view --framed", "view", "model --framed"), ("project --framed", "project", "view --framed"),
            ("model --digits exact", "model --digits exact",
             "scene.txt"), ("view exact", "view --digits exact", "model --digits exact"),
            ("project exact", "project --digits exact",
             "view exact"), ("stage1.txt", "model --bare", "scene.txt"), ("stage2.txt", "view --bare",
                                                                          "model --digits exact"),
            ("stage3.txt", "project", "view exact"), ("z_buffer.txt", "zbuf config.txt", "stage3.txt"),
            ("view of stage1.txt", "view --scene scene.txt",
             "stage1.txt"), ("project of stage2.txt", "project --scene scene.txt",
                             "stage2.txt"), ("zbuf center", "zbuf config.txt --coverage center",
                                             "project exact"))


def pinned(path):
    """{a sample's file, or a sample and a command: its hash}"""
    return dict(line.split("  ", 1)[::-1] for line in path.read_text().splitlines())


def sha256(data):
    return hashlib.sha256(data).hexdigest()


def defined(data):
    """A stage text with colors and normals as far as they are defined."""
    lines = data.decode().split("\n")
    columns = next((line.split()[1:] for line in lines if line.startswith("attributes ")), [])
    first = 4 if "w" in columns else 3
    for i, line in enumerate(lines):
        words = line.split(" ")
        if columns and words[0][:1] in tuple("-0123456789"):
            lines[i] = " ".join(words[:first] +
                                [f"{round(Decimal(word), 7) + 0:.7f}" for word in words[first:]])
    return "\n".join(lines).encode()


def pin(name, data):
    """The hash that pins what a command has made."""
    return sha256(defined(data) if name.endswith("exact") else data)


def run_commands(sample, tools=BIN):
    """{name: bytes} of all commands on a sample; a picture is called NAME picture."""
    made = {name: (sample / name).read_bytes() for name in ("scene.txt", "config.txt")}
    for name, command, source in COMMANDS:
        tool, *words = command.split()
        with tempfile.TemporaryDirectory() as folder:
            for file in ("scene.txt", "config.txt"):
                pathlib.Path(folder, file).write_bytes(made[file])
            done = subprocess.run([tools / tool, *words], input=made[source], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, cwd=folder)
            if done.returncode:
                raise AssertionError(f"{sample.name}: {command}: {done.stderr.decode()}")
            made[name] = done.stdout
            if tool == "zbuf":
                made["out.bmp" if name == "z_buffer.txt" else f"{name} picture"] = pathlib.Path(
                    folder, "out.bmp").read_bytes()
    return made


def samples():
    names = dict.fromkeys(path.partition("/")[0] for path in pinned(SUMS))
    return [SOURCE / "samples" / name for name in names]


class Golden(unittest.TestCase):
    def test_the_samples_are_as_they_were(self):
        for path, hash_ in pinned(SUMS).items():
            file = SOURCE / "samples" / path
            if file.exists() or file.name in ("scene.txt", "config.txt", "out.bmp"):
                self.assertEqual(sha256(file.read_bytes()), hash_,
                                 f"{path} has changed: leave it, and add a sample of another name")

    def test_every_sample_is_golden(self):
        self.assertEqual({path.parent for path in SOURCE.glob("samples/*/scene.txt")}, set(samples()))
        self.assertEqual(set(pinned(SUMS)),
                         {f"{sample.name}/{name}"
                          for sample in samples() for name in FILES})

    def test_every_stage_reads_and_reproduces_the_texts(self):
        sums, pipes = pinned(SUMS), pinned(PIPES)
        for sample in samples():
            made = run_commands(sample)
            for name in made:
                with self.subTest(sample=sample.name, made=name):
                    if name.endswith(" --framed"):
                        plain = made[name.removesuffix(" --framed")]
                        self.assertEqual(made[name], b"framed\n" + plain + b"end\n")
                        continue
                    hash_ = sums.get(f"{sample.name}/{name}") or pipes.get(f"{sample.name}: {name}")
                    self.assertEqual(pin(name, made[name]), hash_)

    def test_texts_with_all_digits_are_those_of_the_reference(self):
        for sample in SMALL:
            data = (SOURCE / "samples" / sample / "scene.txt").read_bytes()
            for name, stage in (("model --digits exact", reference.model), ("view exact", reference.view),
                                ("project exact", reference.project)):
                with self.subTest(sample=sample, made=name):
                    data = stage(data, reference.read_options(stage.__name__, ["--digits", "exact"]))
                    self.assertEqual(pin(name, data), pinned(PIPES)[f"{sample}: {name}"])


def add(name):
    sample = SOURCE / "samples" / name
    if any(path.startswith(f"{name}/") for path in pinned(SUMS)):
        sys.exit(f"golden_test: {name} is pinned already")
    made = run_commands(sample)
    with open(SUMS, "a") as file:
        file.writelines(f"{sha256(made[part])}  {name}/{part}\n" for part in FILES)
    with open(PIPES, "a") as file:
        file.writelines(f"{pin(part, data)}  {name}: {part}\n" for part, data in made.items()
                        if part not in FILES and not part.endswith(" --framed"))


if __name__ == "__main__":
    if ADDED:
        add(*ADDED)
    else:
        unittest.main()
