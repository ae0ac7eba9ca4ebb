"""The tests of an assignment: for each a scene, a config and a weight, and what is right."""
import dataclasses
import math
import os

from judge_parts.reference import JudgeError, Reference, kinds_of
from lib.command import CommandFailure, shown
from lib.input_file import InputError, read_input
from lib.pipe_tools import ToolFailure, Tools


@dataclasses.dataclass
class Test:
    name: str
    weight: float
    reference: Reference
    kinds: list     # of the files that a hand-in needs
    picture: list   # rows of bytes of the right picture; None without a config


def read_tests(folder):
    """The Tests in the folders of a folder, sorted by name."""
    try:
        names = sorted(entry.name
                       for entry in os.scandir(folder)
                       if entry.is_dir() and not entry.name.startswith("."))
    except OSError as error:
        raise InputError(folder, error.strerror) from None
    if not names:
        raise CommandFailure(f"{shown(folder)}: expected a folder for each test, found none")
    return [read_test(os.path.join(folder, name), name) for name in names]


def holds_tests(folder):
    """Whether there are folders in this folder, and each has a scene, which no hand-in needs."""
    try:
        have_scenes = [
            os.path.isfile(os.path.join(entry.path, "scene.txt"))
            for entry in os.scandir(folder)
            if entry.is_dir()]
    except OSError:
        return False  # what is wrong with it shows when it is read
    return bool(have_scenes) and all(have_scenes)


def read_test(folder, name):
    scene = read_input(os.path.join(folder, "scene.txt"), only_regular=True)
    config, weight = (optional(os.path.join(folder, file)) for file in ("config.txt", "weight.txt"))
    try:
        reference = Reference(scene, config, Tools())
    except JudgeError as error:
        raise CommandFailure(f"{shown(folder)}: {error}") from None
    return Test(name, weight_of(weight, folder), reference, kinds_of(config),
                right_picture(reference) if config is not None else None)


def optional(path):
    """The bytes of a file; None if there is none."""
    try:
        return read_input(path, only_regular=True)
    except InputError as error:
        if error.is_missing:
            return None
        raise


def weight_of(data, folder):
    if data is None:
        return 1.0
    try:
        weight = float(data)
    except ValueError:
        weight = math.nan
    if not 0 <= weight < math.inf:
        raise CommandFailure(
            f"{shown(folder)}/weight.txt: expected a number of at least 0, found "
            f"'{shown(data[:40].decode(errors='replace').strip())}'"
        )
    return weight


def right_picture(reference):
    """None where our project refuses the scene, as for a vertex too near to the eye."""
    text = reference.scene_data
    try:
        for tool in ("model", "view", "project"):
            text = reference.tools.output(tool, stdin=text)
    except ToolFailure:
        return None
    return reference.picture(text)
