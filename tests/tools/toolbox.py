"""Shared by the end-to-end tests: runs the real tools and checks all their output and files.

A test script takes the folder of the binaries, then unittest's own arguments.
"""
import functools
import itertools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

BIN = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else sys.exit(__doc__)
SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
TOOLS = ("model", "view", "project", "zbuf")
DRAWING = ("zbuf", "trace")  # trace stands in for project and zbuf
ALL_TOOLS = (*TOOLS, "trace")

# Lines 1 to 4 of a scene; its commands start on line 5.
CAMERA = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n"
TRIANGLE = "triangle\n0 0 0\n1 0 0\n0 1 0\n"
SCENE = CAMERA + TRIANGLE + "end\n"
HEADER = "eye 0 0 5\nlook 0 0 0\nup 0 1 0\nperspective 60 1 1 100\n"
# The header that each tool reads, always in four lines: earlier stages have used up what is a comment.
HEADERS = {
    "view": HEADER, "project": "# eye\n# look\n# up\nperspective 60 1 1 100\n",
    "zbuf": "# eye\n# look\n# up\n# projection\n"}
HEADERS["trace"] = HEADERS["project"]
CONFIG = "8 8\n"
NO_TRIANGLE = "zbuf: note: the picture is empty: no triangle came\n"  # on stderr


def command(tool, *options):
    return [str(BIN / tool), *map(str, options)]


def run(tool, *options, stdin="", **settings):
    """The finished run: returncode, stdout and stderr (bytes)."""
    data = stdin.encode() if isinstance(stdin, str) else stdin
    channel = {} if "stdin" in settings else {"input": data}
    settings.setdefault("stdout", subprocess.PIPE)
    return subprocess.run(command(tool, *options), stderr=subprocess.PIPE, timeout=60, **channel, **settings)


def run_with(channels, tool, *options, **settings):
    """The same, but the shell redirects its channels ("<&-", ">&-")."""
    words = ["sh", "-c", 'exec "$0" "$@" ' + channels, *command(tool, *options)]
    return subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60, **settings)


def run_script(name, *words, **settings):
    """The finished run of a script with these tools; its output is text."""
    settings = {
        "capture_output": True, "text": True, "timeout": 300,
        "env": {**os.environ, "BIN": str(BIN), "LANG": "C.UTF-8"}, **settings}
    return subprocess.run([SOURCE / "scripts" / name, *map(str, words)], **settings)


@functools.cache
def has_bubblewrap():
    line = "bwrap --unshare-all --ro-bind / / --proc /proc true"
    return not subprocess.run(["sh", "-c", line], stderr=subprocess.DEVNULL).returncode


def tools_with(tool, script):
    """A new folder of the tools, in which one is a script of sh; the real one is $real there."""
    folder = pathlib.Path(f"with-{tool}").absolute()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for path in BIN.iterdir():
        (folder / path.name).symlink_to(path)
    (folder / tool).unlink()
    (folder / tool).write_text(f"#!/bin/sh\nreal={BIN}/{tool}\n{script}\n")
    (folder / tool).chmod(0o755)
    return folder


def pipe(*stages, stdin=SCENE, **settings):
    """The stdout of a pipe of tools, each a list of words; every stage has to succeed."""
    data = stdin.encode() if isinstance(stdin, str) else stdin
    for tool, *options in stages:
        done = run(tool, *options, stdin=data, **settings)
        if done.returncode != 0:
            raise AssertionError(f"{tool}: exit {done.returncode}: {done.stderr.decode()}")
        data = done.stdout
    return data


def stage_texts(scene=SCENE, *model_options):
    """The output of model, view and project for a scene."""
    stage1 = pipe(["model", *model_options], stdin=scene)
    stage2 = pipe(["view"], stdin=stage1)
    return stage1, stage2, pipe(["project"], stdin=stage2)


def tool_inputs(scene=SCENE):
    """(tool, its operands, its input) for each tool."""
    world, view, ndc = stage_texts(scene)
    return (("model", [], scene.encode()), ("view", [], world), ("project", [], view), ("zbuf", [
        "config.txt"], ndc), ("trace", ["config.txt"], view))


def expect_mesh2scene():
    """Skips the tests of a module where the command has not been built."""
    if not (BIN / "mesh2scene").exists():
        raise unittest.SkipTest("mesh2scene has not been built (PIPELINE_MODELS)")


def pseudo_terminal():
    """The two ends of a new pseudo-terminal; skips the test if the system has none, as in a container without
    /dev/pts."""
    try:
        return os.openpty()
    except OSError as error:
        raise unittest.SkipTest(f"no pseudo-terminal: {error.strerror}") from None


class Terminal:
    """A pseudo-terminal that is open until the test ends; programs write to its `channel`."""
    def __init__(self, test):
        self.reader, self.channel = pseudo_terminal()
        for end in (self.reader, self.channel):
            test.addCleanup(os.close, end)

    def shown(self):
        """The bytes that it shows."""
        os.write(self.channel, b"|")  # marks their end
        shown = b""
        while not shown.endswith(b"|"):
            shown += os.read(self.reader, 65536)
        return shown[:-1]


def end_by_signal(process, number):
    """The text that a waiting process has written to stdout and stderr when the signal has ended it. Python
    may be about to wait when a signal arrives and would then notice it only after the next one, so the signal
    is sent until the process ends."""
    for _ in range(60):
        process.send_signal(number)
        try:
            return process.communicate(timeout=1)
        except subprocess.TimeoutExpired:
            pass
    raise AssertionError(f"the process is still there after signal {number}")


def heed_signals():
    """To be called by a process before it becomes a script: a job in the background starts with SIGINT
    ignored, and nohup ignores SIGHUP."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


class ToolTest(unittest.TestCase):
    """A test that runs in a folder of its own."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        pathlib.Path("config.txt").write_text(CONFIG)
        pathlib.Path("scene.txt").write_text(SCENE)

    def assert_fails(self, done, status, message):
        """The exit status, and exactly one line on stderr."""
        self.assertEqual((done.stderr.decode(), done.returncode), (message + "\n", status))

    def assert_quiet_success(self, done):
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))

    def files(self):
        return sorted(os.listdir("."))


def alternatives(text):
    """The texts with one of the parts of each {a|b}."""
    parts = re.split(r"\{([^{}|]*(?:\|[^{}|]*)+)\}", text)
    ways = (part.split("|") if i % 2 else [part] for i, part in enumerate(parts))
    return ["".join(way) for way in itertools.product(*ways)]


def add_claims(case, rows):
    """Adds one test for each row (claim, arguments of `case.check`...)."""
    for claim, *row in rows:

        def test(self, row=tuple(row)):
            self.check(*row)

        name = "test_" + re.sub(r"\W+", "_", claim.strip())
        if hasattr(case, name):
            raise ValueError(f"two claims of the same name: {claim}")
        setattr(case, name, test)
