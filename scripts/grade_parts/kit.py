"""Kits: an archive of the judge, the tools and an assignment, for a system that runs them on one hand-in.
Each kind is a module, kit_KIND.py, with its own files and its main program."""
import io
import os
import struct
import sys
import zipfile

from grade_parts.assignment import SETTINGS, optional, read_tests
from grade_parts.graders import Limits, grade_all
from grade_parts.hand_ins import HandIn
from grade_parts.programs import expect_protection
from lib.rim.input_file import read_input
from lib.rim.output_file import write_file
from lib.rim.places import HERE, place
from lib.rim.work_folder import WorkFolder
from lib.running.pipe_tools import SOURCE, Tools

TOP = "pipeline"  # the folder of a kit with what all kinds share, in the order of the source tree
ROOMS = ("grade_parts", "lib")
TOOLS = ("model", "view", "project", "zbuf")
OF_A_TEST = ("scene.txt", "config.txt", "weight.txt")
DATE = (1980, 1, 1, 0, 0, 0)  # of every file, so that the same kit has the same bytes
PT_INTERP = 3
ENTRY = '''#!/usr/bin/env -S python3 -I
"""{words}"""
import os
import sys

if not sys.flags.isolated:  # a hand-in may lie here, and modules of its own in it
    os.execv(sys.executable, [sys.executable, "-I", *sys.argv])
sys.dont_write_bytecode = True
sys.path.insert(0, {place})
# Nor may it hold programs that are called by name.
os.environ["PATH"] = os.pathsep.join(filter(os.path.isabs, os.get_exec_path()))

from grade_parts.kit_{kind} import main
from lib.rim.command import run_command

run_command(main, "{name}", failure_status=2)
'''
BESIDE = 'os.path.join(os.path.dirname(os.path.realpath(__file__)), "pipeline/scripts")'


def files_of_judge():
    """(name in TOP, bytes) for each file of the judge."""
    for room in ROOMS:
        for path in sorted((HERE.parents[2] / room).rglob("*.py")):
            yield f"scripts/{path.relative_to(HERE.parents[2])}", path.read_bytes()
    conformance = place("tests/conformance", "share/pipeline/conformance")
    for path in (*sorted(conformance.glob("conform_parts/*.py")), conformance / "mistakes.txt"):
        yield f"tests/conformance/{path.relative_to(conformance)}", path.read_bytes()


def files_of_assignment(folder, tests):
    for name in (SETTINGS, *(f"{test.name}/{file}" for test in tests for file in OF_A_TEST)):
        data = optional(os.path.join(folder, name))
        if data is not None:
            yield f"assignment/{name}", data


def write_kit(kind, folder, path):
    """Writes the kit of a kind, one of the modules, for the assignment in a folder."""
    tests, settings = read_tests(folder)
    shared = *files_of_judge(), *files_of_assignment(folder, tests)
    files = {f"{TOP}/{name}": (data, False) for name, data in shared}
    for name in TOOLS:
        data = read_input(Tools().folder / name)
        files[f"{TOP}/build/release/bin/{name}"] = data, True
        if not runs_anywhere(data):
            print(
                f"grade: note: {name} is no static program for Linux: the kit runs only where its "
                "libraries are", file=sys.stderr)
    files.update(kind.files(settings))
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, (data, is_program) in sorted(files.items()):
            info = zipfile.ZipInfo(name, DATE)
            info.create_system, info.external_attr = 3, (0o100755 if is_program else 0o100644) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)
    write_file(path, out.getvalue())


def runs_anywhere(data):
    """True if a program needs no dynamic loader: an ELF of 64 bits without PT_INTERP."""
    if not data.startswith(b"\x7fELF\x02\x01"):
        return False
    start, = struct.unpack_from("<Q", data, 32)
    size, count = struct.unpack_from("<HH", data, 54)
    return all(struct.unpack_from("<I", data, start + i * size)[0] != PT_INTERP for i in range(count))


def judged(hand_in):
    """In a kit: the Graded of a hand-in, the tests, and the level of the hints."""
    os.environ["BIN"] = str(SOURCE / "build/release/bin")  # whatever else is set
    tests, settings = read_tests(SOURCE / "assignment")
    hidden = str(SOURCE),
    needs_user = bool(settings.program) and expect_protection(hidden)
    one = HandIn(hand_in, 1, "hand-in", "")
    limits = Limits(120, 2048, 1, hidden, settings.program, needs_user)
    [(_, graded)] = grade_all([one], tests, settings.hints, limits)
    return graded, tests, settings.hints


def put(folder, name, data):
    """Writes a result. A link in its place is removed: a hand-in may have put it there."""
    WorkFolder(folder, "grade").write(name, data)
