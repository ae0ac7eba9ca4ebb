#!/usr/bin/env python3
"""Runs a program on the inputs of a corpus.

usage: corpus.py CORPUS COMMAND...    runs COMMAND with one more argument: a folder that holds the inputs
       corpus.py --entry FILE...      prints files as entries of a corpus, to be added to one

A corpus is a text. '== NAME' begins an input; the lines after it are its bytes, with '\\xNN' for a byte that
is no printable ASCII, '\\\\' for a backslash, and '\\' at the end of a line where the input has no newline.
"""
import os
import re
import signal
import subprocess
import sys
import tempfile

COLUMNS = 110
ESCAPE = re.compile(rb"\\(?:x([0-9a-f]{2})|(\\)|\n)")


def decoded(text):
    return ESCAPE.sub(lambda match: bytes.fromhex(match[1].decode()) if match[1] else match[2] or b"", text)


def inputs(corpus):
    """(name, bytes) of each input."""
    for entry in re.split(rb"(?m)^== ", corpus)[1:]:
        name, text = entry.split(b"\n", 1)
        yield name.decode(), decoded(text)


def encoded(data):
    """The lines of an entry, at most COLUMNS wide where a break can be hidden."""
    text = "".join(
        chr(byte) if 32 <= byte < 127 and byte != 92 or byte == 10 else "\\\\" if byte ==
        92 else f"\\x{byte:02x}" for byte in data)
    lines = []
    for line in text.split("\n"):
        atoms = re.findall(r"\\x..|\\\\|.", line)
        if line.startswith("== "):
            atoms[0] = "\\x3d"
        rows = [""]
        for atom in atoms:
            if len(rows[-1]) + len(atom) >= COLUMNS:
                rows.append("")
            rows[-1] += atom
        lines.append("\\\n".join(rows))
    return "\n".join(lines) if lines[-1] == "" else "\n".join(lines) + "\\\n"


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__.split("\n\n")[1])
    if sys.argv[1] == "--entry":
        for path in sys.argv[2:]:
            with open(path, "rb") as file:
                sys.stdout.write(f"== {os.path.basename(path)}\n{encoded(file.read())}")
        return 0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # without what it made, and the command
    with open(sys.argv[1], "rb") as file, tempfile.TemporaryDirectory() as folder:
        for name, data in inputs(file.read()):
            with open(os.path.join(folder, name), "wb") as target:
                target.write(data)
        status = subprocess.call([*sys.argv[2:], folder])
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main())
