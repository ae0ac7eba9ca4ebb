"""Runs the project's commands in the Python of a browser, where the tools are functions of the page."""
import os
import pathlib
import runpy
import shutil
import subprocess
import sys
import tempfile

import page

SCRIPTS, TOOLS = "/pipeline/scripts", "/tools"
NAMES = ("model", "view", "project", "zbuf", "trace")


def run_tool(words, *, input=b"", **_):
    """Takes the place of subprocess.run. A tool has a folder of its own, to which the files that its words
    name are brought, and from which those that it writes are taken."""
    tool, *words = map(os.fspath, words)
    names = {
        word: os.path.basename(word)
        for word in words if os.path.isfile(word) or (os.path.isabs(word) and not word.startswith("/dev/"))}
    files = {name: pathlib.Path(word).read_bytes() for word, name in names.items() if os.path.isfile(word)}
    done = page.run(os.path.basename(tool), [names.get(word, word) for word in words], input, files)
    for word, name in names.items():
        if name in done["written"]:
            pathlib.Path(word).write_bytes(bytes(done["written"][name]))
    return subprocess.CompletedProcess([tool, *words], done["status"], bytes(done["output"]),
                                       bytes(done["messages"]))


def prepare():
    subprocess.run = run_tool
    os.mkdir(TOOLS)
    for name in NAMES:
        pathlib.Path(TOOLS, name).touch(0o755)
    os.environ["BIN"] = TOOLS
    sys.path.insert(0, SCRIPTS)


def run_command(name, *words_and_files):
    """The output of a command, with its messages; the last word is a {name: bytes} of its folder."""
    *words, files = words_and_files
    folder = tempfile.mkdtemp(dir="/home")
    os.chdir(folder)
    for path, data in files.to_py().items():
        os.makedirs(os.path.dirname(path) or ".", exist_ok=True)
        pathlib.Path(path).write_bytes(data)
    streams, saved = (sys.stdout, sys.stderr), [os.dup(number) for number in (1, 2)]
    output = os.open("/output", os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND)
    try:
        for number in (1, 2):
            os.dup2(output, number)
        sys.argv = [name, *words]
        runpy.run_path(f"{SCRIPTS}/{name}", run_name="__main__")
    except SystemExit:
        pass  # the page shows what was printed
    finally:
        sys.stdout, sys.stderr = streams
        for number, original in zip((1, 2), saved):
            os.dup2(original, number)
            os.close(original)
        os.close(output)
        os.chdir("/")
        shutil.rmtree(folder)
    return pathlib.Path("/output").read_text()


prepare()
