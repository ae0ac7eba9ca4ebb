"""A program in the place of a stage: its input, its run, and its output as a hand-in."""
import contextlib
import os
import sys
import tempfile

from lib.judging.hand_in import KINDS, File, fitting_names
from lib.judging.verdict import WRONG, Cause, cause_of
from lib.rim.command import shown
from lib.rim.input_file import InputError
from lib.rim.places import place
from lib.running.pipe_tools import OPAQUE_NOTE, opaque_background, with_opaque_background

sys.path.append(str(place("tests/conformance", "share/pipeline/conformance")))
from conform_parts import confined  # noqa: E402
from conform_parts.trial import hint_of_header  # noqa: E402, F401
from conform_parts.workers import end_all  # noqa: E402, F401

STAGES = {"model": None, "view": "stage1", "project": "stage2",
          "zbuf": "stage3"}  # with the kind of file that each reads
WRITES = {"model": "stage1", "view": "stage2", "project": "stage3", "zbuf": "depths"}


def input_of(stage, scene, tools, is_bare):
    """The text for the stage."""
    bare = ["--bare"] if is_bare else []
    with tools.file(scene) as path:
        runs = [["model", *(bare if stage == "view" else [])], ["view", "--scene", path, *bare],
                ["project", "--scene", path]][:[*STAGES].index(stage)]
        text = tools.through(*runs, stdin=scene)
    if stage == "zbuf" and opaque_background(text):
        print(f"{os.path.basename(sys.argv[0])}: note: {OPAQUE_NOTE}", file=sys.stderr)
        return with_opaque_background(text)
    return text


class ProgramError(Exception):
    """The program's failure, its stderr, and whether it waited until its time was over."""
    def __init__(self, reason, errors=b"", is_asleep=False):
        super().__init__(reason)
        self.errors, self.is_asleep = errors, is_asleep


def without_comments(scene):
    """A scene's bytes as assignments have them."""
    lines = [(line, line.split(b"#")[0].rstrip()) for line in scene.splitlines()]
    return b"".join(rest + b"\n" for line, rest in lines if rest or not line.strip())


def run_program(options, scene, config, given, top, limit):
    """The stdout and stderr of a program that gets the bytes `given`; raises a ProgramError. It works in
    top/work, and {scene} and {config} in its words are files with those bytes."""
    limits = confined.limits_of(options, options.time_limit)._replace(output=limit)
    words = options.box.words and [*options.box.words, "--ro-bind", top / "given", top / "given"]
    box = options.box._replace(words=words)
    (top / "given").mkdir()
    program = options.program
    for name, data in (("scene", scene), ("config", config)):
        path = top / f"given/{name}.txt"
        path.write_bytes(data)
        program = [word.replace("{%s}" % name, str(path)) for word in program]
    return outcome(program, given, top / "work", limits, box)


def outcome(words, given, folder, limits, box):
    """The stdout and stderr of a command that works in a folder; raises a ProgramError."""
    with tempfile.TemporaryFile() as stdin:
        stdin.write(given)
        stdin.seek(0)
        ending = confined.run_apart(words, stdin, folder, limits, box)
    if ending is None:
        raise ProgramError("it has ended the process that ran it")
    if ending.status != 0:
        reason = f"it {ending.why}" if ending.why else f"its exit status is {ending.status}"
        raise ProgramError(reason, ending.stderr, ending.why.startswith(confined.NO_END))
    return ending.stdout, ending.stderr


def hand_in(stage, output, given, folder):
    """The Files by kind that the judge needs for one stage; `folder` is the descriptor of the program's."""
    files = {} if stage == "model" else {STAGES[stage]: File("the input", given)}
    if stage != "zbuf":
        return {**files, WRITES[stage]: File("stdout", output)}
    fitting = fitting_names(os.listdir(folder))
    for kind in ("depths", "picture"):
        name, *others = fitting[kind] or [KINDS[kind][0]]
        files[kind] = File(shown(name), others=tuple(map(shown, others)))
        try:
            files[kind].data = confined.read_output(name, folder, confined.LARGEST_FILE)
        except confined.Refused as error:
            files[kind].error = InputError(name, str(error))
    return files if files["depths"].data else {**files, "depths": File("stdout", output)}


def expect_repetition(stage, verdict, files, run):
    """Blames randomness for wrong files without a cause if another `run`, which gives Files, differs."""
    wrong = [file for file in verdict.of(stage) if file.verdict == WRONG]
    if not wrong or any(file.causes for file in wrong):
        return
    with contextlib.suppress(ProgramError):
        if run()[WRITES[stage]].data != files[WRITES[stage]].data:
            numbers = Cause("", "Some numbers are random: two runs of the program on the same text differ")
            for file in wrong:
                file.causes = [cause_of("zbuf/random-pixels") if stage == "zbuf" else numbers]
