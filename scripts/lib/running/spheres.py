"""Scenes with spheres, for commands that show project and zbuf, which draw triangles alone."""
import contextlib
import os

from lib.rim.command import CommandFailure
from lib.rim.input_file import BLOCK, name_of
from lib.running.pipe_tools import ToolFailure

REFUSED = "expected triangles alone, found a sphere: "


def expect_no_spheres(tools, path, name=None, way=None):
    """Raises a CommandFailure that names the place of a sphere in a scene, by `name` if the file is a copy,
    and a `way` to draw it, if the command has one that model's message lacks. Other errors in the scene are
    left to the tools."""
    if not has_the_word(path, b"sphere"):
        return
    try:
        tools.write(os.devnull, "model", "--bare", path)
    except ToolFailure as failure:
        place, found, ways = str(failure).partition(REFUSED)
        if found:
            raise CommandFailure(
                place.replace(f"{path}:", f"{name_of(name or path)}:", 1) + found + (way or ways)) from None


def has_the_word(path, word):
    """True if a regular file holds the bytes: takes milliseconds, while model takes long. Not by mmap, which
    signals do not interrupt, and which SIGBUS ends if the file shrinks."""
    data, is_regular = b"", os.path.isfile(path)
    with contextlib.suppress(OSError), open(path if is_regular else os.devnull, "rb") as file:
        while block := file.read(BLOCK):
            data = data[-len(word):] + block
            if word in data:
                return True
    return False
