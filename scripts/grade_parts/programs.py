"""Programs that are handed in: built and run for every test, in a sandbox of bubblewrap; where root finds
none that works, as in a container, as a user who may read nothing of root's."""
import argparse
import os
import pathlib
import shutil
import subprocess
import tempfile

from grade_parts.assignment import SECONDS_OF_BUILD, SECONDS_OF_RUN
from lib.judging.hand_in import KINDS
from lib.judging.judge import HandIn as Judge
from lib.judging.program import ProgramError, confined, expect_repetition, hand_in, outcome, run_program
from lib.judging.reference import kinds_of
from lib.judging.verdict import WRONG, Cause, FileVerdict, Verdict
from lib.rim.command import CommandFailure, shown
from lib.rim.places import place
from lib.running.pipe_tools import Tools

NOBODY = 65534
AS_NOBODY = ("setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "--no-new-privs",
             "--bounding-set=-all", "--inh-caps=-all", "--pdeathsig=KILL", "--")
LEFT = ("find", "/tmp", "/var/tmp", "/dev/shm", "-mindepth", "1", "-maxdepth", "1", "-user", str(NOBODY))
REMOVE = ("-exec", "sh", "-c", 'chmod -R u+rwx -- "$@"; rm -rf -- "$@"', "sh", "{}", "+")
MOST_BYTES, MOST_FILES = 64 << 20, 500  # of a hand-in that is built
MOST_LINES = 10                         # of a compiler's messages, as shown
MEMORY, PROCESSES = 1024, 64


def protection(command, read, hidden):
    """A Sandbox, and words that go before the command. Raises a CommandFailure where there is neither."""
    asked = argparse.Namespace(read=list(read), env=[], sandbox="auto")
    box = confined.sandbox(command, asked, [pathlib.Path(path) for path in hidden])
    if box.words:
        return box, ()
    if os.geteuid() == 0 and shutil.which("setpriv") and succeeds([*AS_NOBODY, "true"]):
        for path in hidden:
            if succeeds([*AS_NOBODY, "test", "-x", path]):
                raise CommandFailure(f"{shown(str(path))} may be read by a program that is handed in, which "
                                     "root runs as nobody: chmod go= it, or install bubblewrap")
        return box, AS_NOBODY
    raise CommandFailure(f"a program is run only in a sandbox, or by root as nobody: {box.reason}")


def succeeds(words):
    return not subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode


def right_ones():
    """The folders of what gives the right answer: the tools, and the reference beside the pack."""
    tools, pack = Tools().folder, place("tests/conformance", "share/pipeline/conformance")
    return [*([] if (tools / "sh").exists() else [tools]), pack.parent]


def expect_protection(hidden):
    """Raises the CommandFailure of a machine that protects from no program, before there is any work."""
    _, before = protection(["true"], (), hidden)
    if before and tempfile.tempdir:  # the command's own folder, in which nobody is to work
        os.chmod(tempfile.tempdir, 0o711)


def unpack(contents, folder):
    """Writes the files of a hand-in into a folder, without the folders that hold all of them."""
    paths = contents.paths
    while paths and all(len(path) > 1 and path[0] == paths[0][0] for path in paths):
        paths = [path[1:] for path in paths]
    if len(paths) > MOST_FILES:
        raise ProgramError(f"it has more than {MOST_FILES} files")
    left = MOST_BYTES
    for path, inner in zip(paths, contents.paths):
        try:
            data = contents.data(inner, left)
            target = folder.joinpath(*path)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(data)
            target.chmod(0o755)
        except MemoryError:
            raise
        except Exception as error:  # whatever an archive raises that is none
            raise ProgramError(f"{shown('/'.join(path))} cannot be unpacked "
                               f"({type(error).__name__})") from None
        left -= len(data)
        if left < 0:
            raise ProgramError(f"its files have more than {MOST_BYTES >> 20} MiB")


def give(folder, user):
    """Gives a folder and all in it to a user; no link is followed."""
    for place, folders, files in os.walk(folder):
        for name in (".", *folders, *files):
            os.chown(os.path.join(place, name), user, user, follow_symlinks=False)


class Built:
    """A program that has been built in top/program/files."""

    def __init__(self, contents, program, top, hidden):
        self.program, self.top, self.hidden = program, top, hidden
        self.folder = top / "program/files"
        self.folder.mkdir(parents=True)
        unpack(contents, self.folder)
        for folder in (top, top / "program"):
            folder.chmod(0o711)
        if program.build:
            self.build()
        self.box, self.before = protection(words := self.command(), [self.folder], hidden)
        self.words = [*self.before, *words]

    def build(self):
        words = ["sh", "-c", self.program.build]
        box, before = protection(words, (), self.hidden)
        if before:
            give(self.folder, NOBODY)
        try:
            outcome([*before, *words], b"", self.folder,
                    confined.Limits(SECONDS_OF_BUILD, MEMORY, PROCESSES), box)
        finally:
            if before:
                give(self.folder, 0)
                self.remove_what_is_left()

    def remove_what_is_left(self):
        """Removes what it has made, as nobody, in folders that all may write to, since a file was last made
        in top."""
        succeeds([*AS_NOBODY, *LEFT, "-cnewer", str(self.top), *REMOVE])

    def command(self):
        """The words that run it, with the paths of its own files."""
        first, *others = self.program.run
        words = [self.own(first) if "/" in first else first, *map(self.own, others)]
        if self.program.stage == "zbuf" and not any("{config}" in word for word in words):
            words.append("{config}")
        try:
            return [confined.program_path(words[0]), *words[1:]]
        except confined.Refused as refused:
            raise ProgramError(shown(str(refused)).replace(f"{self.folder}/", "")) from None

    def own(self, word):
        path, folder = self.folder / word, os.path.realpath(self.folder)
        if word.startswith(("/", "-")) or not path.exists():
            return word
        if os.path.commonpath((folder, os.path.realpath(path))) != folder:
            raise ProgramError(f"{word} is a link that leads out of the hand-in")
        return str(path)

    def files(self, test):
        """The Files by kind that it makes for a test; raises a ProgramError."""
        given, before = test.given
        options = argparse.Namespace(time_limit=SECONDS_OF_RUN, memory=MEMORY, processes=PROCESSES,
                                     address_space=None, program=self.words, box=self.box)
        limit = max(test.reference.limit(kind) for kind in test.kinds)
        with confined.temporary_folder("run.", self.top) as top, confined.opened_folder(top / "work") as work:
            if self.before:
                top.chmod(0o711)
                os.chown(work, NOBODY, NOBODY)
            try:
                output, _ = run_program(options, test.reference.scene_data, test.reference.config or b"1 1\n",
                                        given, top, limit)
            finally:
                if self.before:
                    self.remove_what_is_left()
            return hand_in(self.program.stage, output, before, work)


def verdicts(contents, tests, limits):
    """Draws (files, verdict, remark) for each test. `limits` are graders.Limits."""
    program, hidden = limits.program, limits.hidden
    with confined.temporary_folder("grade.") as top:
        try:
            built = Built(contents, program, top, hidden)
        except ProgramError as error:
            reason = f"The program cannot be built: {error}{messages(error.errors)}"
            for i, test in enumerate(tests):
                yield {}, failure(test, "The program cannot be built"), "" if i else reason
            return
        for test in tests:
            try:
                files = built.files(test)
            except ProgramError as error:
                reason = f"the program failed: {error}"
                yield {}, failure(test, reason), f"{test.name}: {reason}"
                continue
            verdict = Judge(files, test.reference, kinds_of(test.reference.config)).judge()
            expect_repetition(program.stage, verdict, files, lambda test=test: built.files(test))
            yield files, Verdict(verdict.of(program.stage)), ""


def failure(test, reason):
    stage = test.settings.program.stage
    return Verdict([FileVerdict(stage, KINDS[kind][0] if stage == "zbuf" else "stdout", WRONG,
                                causes=[Cause("", reason)]) for kind in test.kinds])


def messages(errors):
    """The last lines that a compiler wrote. What a program writes in a test is not shown: it might be the
    test."""
    lines = errors.decode(errors="backslashreplace").strip().splitlines()[-MOST_LINES:]
    return "".join("\n" + shown(line.expandtabs())[:200] for line in lines)
