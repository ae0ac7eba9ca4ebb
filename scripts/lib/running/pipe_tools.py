"""The four tools, for scripts that run them: their location, and a single run."""
import contextlib
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from lib.rim.command import CommandFailure

SOURCE = pathlib.Path(__file__).resolve().parents[3]


class ToolFailure(CommandFailure):
    """A tool ended with a status other than 0; the text is its message."""


def default_folder():
    """Where an installed command, or one called through `pipeline`, has the tools beside it; else
    build/release/bin of this source tree."""
    called = pathlib.Path(sys.argv[0])
    for folder in (called.parent, called.resolve().parent):
        if os.access(folder / "zbuf", os.X_OK):
            return folder
    return SOURCE / "build/release/bin"


def without_inner_location(note, folder):
    """A note of a tool without the line of a text in `folder`, which the user never sees."""
    found = re.search(rf"{re.escape(str(folder))}/[^:]*:\d+:\d+: ", note)
    return note[:found.start()] + re.sub(r"\bof this (vertex|light)\b", r"of a \1",
                                         note[found.end():]) if found else note


TRANSPARENT = re.compile(rb"^(background (\S+) (\S+) (\S+)) \S+$",
                         re.M)  # the header line of a background with an alpha
OPAQUE_NOTE = "the scene's background is drawn opaque: a BMP has no alpha"


def opaque_background(text):
    """Words for zbuf that show the background of a tool's stage text in full, if it has an alpha, which only
    PNG holds."""
    found = TRANSPARENT.search(text[:1 << 16].split(b"\n\n")[0])
    return [
        "--background", "".join(
            f"{math.floor(float(channel) + 0.5):02x}" for channel in found.groups()[1:])] if found else []


def with_opaque_background(text):
    """The stage text, its background without an alpha."""
    return TRANSPARENT.sub(rb"\1", text, count=1) if opaque_background(text) else text


def checked(done, tool):
    """The finished run of a tool, or its message as a ToolFailure."""
    if done.returncode != 0:
        raise ToolFailure(
            done.stderr.decode(errors="replace").strip() or f"{tool}: exit status {done.returncode}")
    return done


class Tools:
    """The tools in a folder, by default $BIN, else those that belong to the command that runs. For a command
    of many pipes, zbuf and trace draw on one thread each."""

    def __init__(self, folder=None, has_many_pipes=False):
        self.one_thread = ["--threads", "1"] if has_many_pipes else []
        # Absolute, since a bare name would be looked up on the PATH, where `view` is an editor.
        self.folder = pathlib.Path(folder or os.environ.get("BIN") or default_folder()).absolute()
        if not os.access(self.folder / "zbuf", os.X_OK):
            raise ToolFailure(f"no tools in {self.folder}: build them (scripts/demo does), or set BIN")

    def command(self, tool, words):
        return [self.folder / tool, *(self.one_thread if tool in ("zbuf", "trace") else []), *map(str, words)]

    def run(self, tool, *words, stdin=b""):
        """A finished run with the bytes `stdin` as input, its stdout and stderr as bytes."""
        return checked(subprocess.run(self.command(tool, words), input=stdin, capture_output=True), tool)

    def output(self, tool, *words, stdin=b""):
        return self.run(tool, *words, stdin=stdin).stdout

    def through(self, *runs, stdin=b""):
        """What comes out of a pipe of tools, each a list of its name and its words."""
        for words in runs:
            stdin = self.output(*words, stdin=stdin)
        return stdin

    def write(self, path, tool, *words):
        """Runs a tool with its stdout in a file; its notes."""
        with open(path, "wb") as file:
            done = subprocess.run(self.command(tool, words), stdin=subprocess.DEVNULL, stdout=file,
                                  stderr=subprocess.PIPE)
        return checked(done, tool).stderr.decode(errors="replace").splitlines()

    @staticmethod
    @contextlib.contextmanager
    def file(data):
        """The path of a file with these bytes, for an option that takes no pipe."""
        with tempfile.NamedTemporaryFile() as file:
            file.write(data)
            file.flush()
            yield file.name

    def has_option(self, tool, option):
        """Whether the tool's --help lists the option."""
        return re.search(rf"(?<![\w-]){option}(?![\w-])", self.output(tool, "--help").decode()) is not None
