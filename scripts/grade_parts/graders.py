"""Grades hand-ins in parallel, each in a process of its own with limits of time and memory: what a hand-in
does to it, it does to itself."""
import contextlib
import dataclasses
import fcntl
import hashlib
import multiprocessing
import multiprocessing.connection
import os
import resource
import signal
import tempfile
import time
import traceback

from grade_parts.contents import ContentsError, contents_of
from grade_parts.difference import pictures
from grade_parts.hand_ins import files_for, looked_for
from grade_parts.hints import fixes, gives, in_words
from grade_parts.programs import verdicts
from lib.judging.hand_in import KINDS
from lib.judging.judge import HandIn as Judge
from lib.judging.verdict import OPEN, WRONG, Verdict

LARGEST_FILE = 1 << 30  # that a tool may write for a hand-in
MEBIBYTE = 1 << 20


@dataclasses.dataclass
class GradedTest:
    name: str
    score: float
    max_score: float
    verdict: Verdict
    words: str       # for the student, with as much as the hints give away
    fixes: list
    pictures: list   # of (caption, data: URI)
    by_teacher: str = ""  # what a line of the overrides has changed or said


@dataclasses.dataclass
class Graded:
    tests: list = dataclasses.field(default_factory=list)  # of GradedTest
    max_score: float = 0.0
    remarks: list = dataclasses.field(default_factory=list)
    failure: str = ""  # why it could not be judged
    wrong: dict = dataclasses.field(default_factory=dict)  # {(test, file): hash} of what is not right

    @property
    def score(self):
        return sum(test.score for test in self.tests)

    @property
    def is_judged(self):
        return not self.failure and not any(file.verdict in OPEN
                                            for test in self.tests
                                            for file in test.verdict.files)


@dataclasses.dataclass
class Limits:
    seconds: float
    mebibytes: int
    jobs: int
    hidden: tuple = ()  # folders that no program may read
    program: object = None  # an assignment.Program, if that is what is handed in


def grade(path, tests, level, limits):
    """The Graded of the hand-in at a path."""
    try:
        contents = contents_of(path)
    except ContentsError as error:
        return failed(tests, f"It could not be read: {error}.")
    graded = Graded(max_score=sum(test.max_score for test in tests), remarks=contents.remarks)
    judged = verdicts(contents, tests, limits) if limits.program else (
        judge_files(contents, test, len(tests) == 1) for test in tests)
    for test, (files, verdict, remark) in zip(tests, judged):
        graded.remarks += [remark] * bool(remark)
        shown = pictures(test, files, verdict) if gives(level, "stage") else []
        for kind, file in zip(test.kinds, verdict.files):
            file.worth = test.settings.another_rule
            file.places = []  # the pictures have them; there may be millions
            if file.verdict == WRONG and (data := kind in files and files[kind].data):
                graded.wrong[test.name, KINDS[kind][0]] = hashlib.sha256(data).digest()
        graded.tests.append(
            GradedTest(test.name, test.score(verdict.files), test.max_score, verdict,
                       in_words(verdict, level), fixes(verdict, level), shown))
    return graded


def judge_files(contents, test, is_only_test):
    """The Files of a test, the Verdict on them, and what was looked for if there are none."""
    files = files_for(contents, test, is_only_test)
    verdict = Judge(files, test.reference, test.kinds).judge()
    is_found = any(not file.is_missing for file in files.values())
    return files, verdict, "" if is_found else looked_for(test, is_only_test)


def failed(tests, reason):
    return Graded(max_score=sum(test.max_score for test in tests), failure=reason)


def end_with_writers_of(reader, writer):
    """Has the system kill this process group when grade is gone, the last that may write into the pipe."""
    os.close(writer)
    fcntl.fcntl(reader, fcntl.F_SETOWN, -os.getpgid(0))
    fcntl.fcntl(reader, fcntl.F_SETSIG, signal.SIGKILL)
    fcntl.fcntl(reader, fcntl.F_SETFL, os.O_ASYNC)
    if not multiprocessing.parent_process().is_alive():
        os.killpg(0, signal.SIGKILL)


def work(connection, path, tests, level, limits, scratch, pipe):
    """The process of a hand-in."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)
    os.setpgid(0, 0)
    end_with_writers_of(*pipe)
    tempfile.tempdir = scratch
    most = limits.mebibytes * MEBIBYTE  # a program that is run has limits of its own
    resource.setrlimit(resource.RLIMIT_AS, (
        most, resource.getrlimit(resource.RLIMIT_AS)[1] if limits.program else most))
    resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE,) * 2)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        graded = grade(path, tests, level, limits)
    except MemoryError:
        graded = failed(tests,
                        f"It could not be judged: that needs more than {limits.mebibytes} MiB of memory.")
    except Exception as error:  # an error of ours: it costs this hand-in its verdict, and must be seen
        traceback.print_exc()
        graded = failed(tests, f"It could not be judged: {type(error).__name__}.")
    connection.send(graded)


class Running:
    """The process of one hand-in, with a folder for what its tools write."""

    def __init__(self, path, tests, level, limits):
        context = multiprocessing.get_context("fork")  # what is right has been calculated once, for all
        self.tests, self.limits = tests, limits
        self.connection, theirs = context.Pipe(duplex=False)
        self.scratch = tempfile.TemporaryDirectory()
        os.chmod(self.scratch.name, 0o711)  # a program that is run as another user works in it
        reader, self.alive = os.pipe()
        words = theirs, path, tests, level, limits, self.scratch.name, (reader, self.alive)
        self.process = context.Process(target=work, args=words)
        self.process.start()
        theirs.close()
        os.close(reader)
        self.end = time.monotonic() + limits.seconds
        if limits.program:
            self.end += limits.program.seconds(len(tests))

    def result(self):
        """Its Graded, now that it is done or out of time."""
        if not self.connection.poll():
            return failed(self.tests,
                          f"It could not be judged: that takes longer than {self.limits.seconds:g} s.")
        try:
            return self.connection.recv()
        except EOFError:
            return failed(self.tests,
                          "It could not be judged: its judge was ended, perhaps for lack of memory.")

    def stop(self):
        """Ends the process, and the tools that it has started."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.kill()
        self.process.join()
        self.connection.close()
        os.close(self.alive)
        self.scratch.cleanup()


def grade_all(hand_ins, tests, level, limits):
    """Draws (HandIn, Graded), in the order in which they are done."""
    waiting, running = list(reversed(hand_ins)), {}
    try:
        while waiting or running:
            while waiting and len(running) < limits.jobs:
                hand_in = waiting.pop()
                one = Running(hand_in.path, tests, level, limits)
                running[one.connection] = hand_in, one
            rest = min(one.end for _, one in running.values()) - time.monotonic()
            multiprocessing.connection.wait(list(running), max(0.0, rest))
            for connection, (hand_in, one) in list(running.items()):
                if connection.poll() or time.monotonic() >= one.end:
                    graded = one.result()
                    one.stop()
                    del running[connection]
                    yield hand_in, graded
    finally:
        for _, one in running.values():
            one.stop()
