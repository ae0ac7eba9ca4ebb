"""Scenes with spheres, for commands that show what project and zbuf do: those draw triangles alone."""
import os
import stat

from lib.rim.command import CommandFailure
from lib.rim.input_file import BLOCK, name_of
from lib.running.pipe_tools import ToolFailure

REFUSED = "expected triangles alone, found a sphere: "


def expect_no_spheres(tools, path, name=None, way=None):
    """Raises a CommandFailure that names the place of a sphere in a scene, by `name` if the file is a copy,
    and tells a `way` to draw it, if the command knows one that model's message lacks. Whatever else is wrong
    with the scene is left to others."""
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
    """True if a regular file holds the bytes: a matter of milliseconds, where model takes its time. Not by
    mmap: signals do not interrupt it, and SIGBUS ends it if the file shrinks."""
    try:
        with open(path, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NONBLOCK)) as file:
            data, is_regular = b"", stat.S_ISREG(os.fstat(file.fileno()).st_mode)
            while is_regular and (block := file.read(BLOCK)):
                data = data[-len(word):] + block
                if word in data:
                    return True
    except OSError:
        pass
    return False
