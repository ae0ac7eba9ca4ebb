"""An assignment: its tests, each with a scene, a config, a weight and the right output; and the settings of
assignment.txt for points, hints, and the program that is handed in."""
import contextlib
import dataclasses
import math
import os
import re
import shlex

from grade_parts.hints import LEVELS
from lib.judging.hand_in import KINDS, STAGE_OF
from lib.judging.program import STAGES, input_of, without_comments
from lib.judging.reference import JudgeError, Reference, kinds_of
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import InputError, input_errors, read_input
from lib.running.pipe_tools import ToolFailure, ToolOutOfMemory, Tools

SETTINGS = "assignment.txt"
KIND_OF = {name: kind for kind, (name, _) in KINDS.items()}
MOST_POINTS = 1_000_000  # and weights
SECONDS_OF_BUILD, SECONDS_OF_RUN = 60, 10  # of the processor
CLOCK = 10  # seconds by the clock for one of the processor, which a busy machine needs


@dataclasses.dataclass
class Program:
    """A program that is handed in for a stage: shell words that build it and run it."""
    stage: str
    build: str = ""
    run: list = dataclasses.field(default_factory=list)
    is_bare: bool = False
    packages: list = dataclasses.field(default_factory=list)  # of Debian, which a kit installs

    def seconds(self, test_count):
        """The most that the program may take; it runs twice if it is wrong without a known cause."""
        return CLOCK * (SECONDS_OF_BUILD + 2 * SECONDS_OF_RUN * test_count)


@dataclasses.dataclass
class Settings:
    """The settings of assignment.txt; the defaults apply without one."""
    hints: str = "cause"
    points: dict = dataclasses.field(default_factory=dict)  # by the kind of a file
    weights: dict = dataclasses.field(default_factory=dict)  # by the name of a test
    another_rule: float = 1.0  # the value of a file that is right by another rule
    required: list = dataclasses.field(default_factory=list)  # kinds without which a test earns nothing
    program: Program = None


@dataclasses.dataclass
class Test:
    name: str
    weight: float
    reference: Reference
    kinds: list  # of the files that are judged
    picture: list  # rows of bytes of the right picture; None without a config
    settings: Settings
    given: tuple = ()  # what a program reads, and the same as bare text

    def share(self, kind):
        """The points of a file."""
        points = self.settings.points
        return self.weight * (points.get(kind, 0) if points else 1 / len(self.kinds))

    @property
    def max_score(self):
        return self.weight * sum(self.settings.points.get(kind, 0)
                                 for kind in self.kinds) if self.settings.points else self.weight

    def score(self, files):
        """The points of a test, by the FileVerdicts of its files."""
        good = {kind: file for kind, file in zip(self.kinds, files) if file.is_good}
        if not all(kind in good for kind in self.settings.required if kind in self.kinds):
            return 0.0
        if len(good) == len(self.kinds) and not any(file.rule for file in files):
            return self.max_score
        return sum(
            self.share(kind) * (self.settings.another_rule if file.rule else 1)
            for kind, file in good.items())


def read_tests(folder):
    """The Tests in the folders of a folder, sorted by name, and the Settings."""
    with input_errors(folder):
        names = sorted(
            entry.name for entry in os.scandir(folder) if entry.is_dir() and not entry.name.startswith("."))
    if not names:
        raise CommandFailure(f"{shown(folder)}: expected a folder for each test, found none")
    odd = next((name for name in names if shown(name) != name), None)
    if odd is not None:
        raise CommandFailure(f"{shown(folder)}: expected names that can be printed, found '{shown(odd)}'")
    data = optional(os.path.join(folder, SETTINGS))
    settings = read_settings(data or b"", os.path.join(folder, SETTINGS), names)
    return [read_test(os.path.join(folder, name), name, settings) for name in names], settings


def read_settings(data, path, tests):
    """The Settings in the bytes of an assignment.txt."""
    settings, others = Settings(), {}
    for number, line in enumerate(data.decode(errors="replace").splitlines(), 1):
        word, _, rest = line.strip().partition(" ")
        try:
            if word in ("build", "run", "input", "packages"):
                others[word] = rest.strip()
            elif word and not word.startswith("#"):
                set_one(settings, word, rest.strip(), tests)
        except ValueError as error:
            raise CommandFailure(f"{shown(path)}:{number}: {shown(str(error))}") from None
    try:
        complete(settings, others)
    except ValueError as error:
        raise CommandFailure(f"{shown(path)}: {shown(str(error))}") from None
    return settings


def set_one(settings, word, rest, tests):
    """Applies a line."""
    if word == "hints":
        settings.hints = one_of(LEVELS, rest)
    elif word == "points":
        name, value = pair(rest)
        settings.points[KIND_OF[one_of(KIND_OF, name)]] = amount(value)
    elif word == "weight":
        name, value = pair(rest)
        settings.weights[one_of(tests, name)] = amount(value)
    elif word == "another-rule":
        settings.another_rule = amount(rest, most=1)
    elif word == "required":
        settings.required.append(KIND_OF[one_of(KIND_OF, rest)])
    elif word == "program":
        settings.program = Program(one_of(STAGES, rest))
    else:
        raise ValueError("expected hints, points, weight, another-rule, required, program, build, run, "
                         f"input or packages, found '{word}'")


def complete(settings, others):
    """Adds the settings about the program."""
    program = settings.program
    if not program and others:
        raise ValueError(f"expected a line 'program STAGE' for '{min(others)}', found none")
    if program:
        program.build, program.run = others.get("build", ""), shlex.split(others.get("run", ""))
        program.packages = others.get("packages", "").split()
        for name in program.packages:  # root installs them
            if not re.fullmatch(r"[a-z0-9][a-z0-9+.-]+", name):
                raise ValueError(f"expected names of Debian packages, found '{name}'")
        program.is_bare = one_of(("header", "bare"), others.get("input", "header")) == "bare"
        if not program.run:
            raise ValueError("expected a line 'run COMMAND' for the program, found none")
    if settings.points and not sum(settings.points.values()):
        raise ValueError("expected points above 0 for a file")


def one_of(words, word):
    if word not in words:
        raise ValueError(f"expected {', '.join(words)}, found '{word}'")
    return word


def pair(text):
    name, _, value = text.rpartition(" ")
    if not name:
        raise ValueError(f"expected a name and a number, found '{text}'")
    return name.strip(), value


def amount(text, most=MOST_POINTS):
    """A number of points."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 <= value <= most:
        raise ValueError(f"expected a number of 0 to {most:,}, found '{text[:40].strip()}'")
    return value


def holds_tests(folder):
    """True if this folder holds folders and each has a scene, which hand-ins lack."""
    with contextlib.suppress(OSError):  # what is wrong with it shows when it is read
        folders = [entry.path for entry in os.scandir(folder) if entry.is_dir()]
        return bool(folders) and all(os.path.isfile(os.path.join(path, "scene.txt")) for path in folders)
    return False


def read_test(folder, name, settings):
    scene = read_input(os.path.join(folder, "scene.txt"), only_regular=True)
    config, weight = (optional(os.path.join(folder, file)) for file in ("config.txt", "weight.txt"))
    program = settings.program
    try:
        reference = Reference(scene, config, Tools(has_many_pipes=True))
    except JudgeError as error:
        raise CommandFailure(f"{shown(folder)}: {error}") from None
    try:
        default = 1.0 if weight is None else amount(weight.decode(errors="replace"))
        weight = settings.weights.get(name, default)
    except ValueError as error:
        raise CommandFailure(f"{shown(folder)}/weight.txt: {shown(str(error))}") from None
    kinds = [kind for kind in kinds_of(config) if not program or STAGE_OF[kind] == program.stage]
    if not kinds:
        raise CommandFailure(f"{shown(folder)}: expected a config.txt, which zbuf needs, found none")
    given = input_of(program.stage, without_comments(scene), Tools(), program.is_bare) if program else b""
    return Test(name, weight, reference, kinds,
                right_picture(reference) if "picture" in kinds else None, settings, given)


def optional(path):
    """The bytes of a file; None if there is none."""
    try:
        return read_input(path, only_regular=True)
    except InputError as error:
        if error.is_missing:
            return None
        raise


def right_picture(reference):
    """The right picture; None where our project refuses the scene, as for a vertex too near to the eye."""
    try:
        return reference.picture(reference.stage3)
    except ToolOutOfMemory:
        raise
    except ToolFailure:
        return None
