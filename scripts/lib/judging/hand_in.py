"""The files of a hand-in, under the names that the assignments and their readers have given them."""
import dataclasses
import os
import re

from lib.rim.command import shown
from lib.rim.input_file import InputError, read_input

# The kinds of files, their first name in the assignment, and a pattern for other names, in lower case
# without - _ and blanks; a student's number may stand before or after the name.
KINDS = {
    **{f"stage{i}": (f"stage{i}.txt", re.compile(rf"\d*stage{i}\d*\.txt"))
       for i in (1, 2, 3)},
    "depths": ("z_buffer.txt", re.compile(r"\d*z(buffer|buf|out)(out|output)?\d*\.txt")),
    "picture": ("out.bmp", re.compile(r"\d*(out|output|image)?\d*\.(bmp|png|ppm)")),}
STAGE_OF = {"stage1": "model", "stage2": "view", "stage3": "project", "depths": "zbuf", "picture": "zbuf"}


@dataclasses.dataclass
class File:
    """A file of the hand-in: its bytes, or the InputError of reading it."""
    name: str
    data: bytes = None
    error: InputError = None
    others: tuple = ()  # further names that might have been meant

    def within(self, limit):
        """The bytes; raises an InputError if there are none, or more than `limit`."""
        if self.data is None:
            raise self.error or InputError(self.name, "No such file", is_missing=True)
        if len(self.data) > limit:
            raise InputError(self.name, f"it is longer than {limit} bytes, more than the scene can need")
        return self.data


def plain(name):
    return re.sub(r"[-_ ]", "", name.lower())


def fitting_names(names):
    """{kind: names that look like it}: the assignment's own first, then short ones, then by their numbers."""
    numbers = {name: [int(digits[:18]) for digits in re.findall(r"\d+", name)] for name in names}
    ranked = sorted(names, key=lambda name: (len(numbers[name]), numbers[name], name))
    return {
        kind: sorted(filter(lambda name: pattern.fullmatch(plain(name)), ranked), key=own.__ne__)
        for kind, (own, pattern) in KINDS.items()}


def find_files(folder):
    """{kind: File} of a folder; each file is read at once, and no pipe or device is waited for."""
    try:
        names = os.listdir(folder)
    except OSError as error:
        raise InputError(folder, error.strerror) from None
    return {
        kind: read_file(folder, found[0], tuple(map(shown, found[1:]))) if found else File(KINDS[kind][0])
        for kind, found in fitting_names(names).items()}


def read_file(folder, name, others):
    path, top = os.path.join(folder, name), os.path.realpath(folder)
    try:
        if os.path.commonpath((top, os.path.realpath(path))) != top:
            raise InputError(path, "a link that leads out of the hand-in")
        return File(shown(name), read_input(path, only_regular=True), None, others)
    except InputError as error:
        return File(shown(name), None, error, others)
