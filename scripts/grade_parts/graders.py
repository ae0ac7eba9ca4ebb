"""Grades hand-ins in parallel, each in a process of its own with limits of time and memory: a hand-in that
breaks its process harms itself alone, and keeps the tests judged before."""
import contextlib
import dataclasses
import fcntl
import functools
import hashlib
import multiprocessing
import multiprocessing.connection
import os
import resource
import signal
import tempfile
import time
import traceback

from grade_parts.assignment import CLOCK
from grade_parts.contents import ContentsError, contents_of
from grade_parts.difference import pictures
from grade_parts.hand_ins import files_for, looked_for
from grade_parts.hints import fixes, gives, in_words
from grade_parts.programs import Unusable, remove_what_is_left, take_user, verdicts
from lib.judging.hand_in import KINDS, STAGE_OF
from lib.judging.judge import HandIn as Judge
from lib.judging.pixel_words import AT_BORDERS
from lib.judging.program import confined, end_all
from lib.judging.reference import kinds_of
from lib.judging.verdict import OPEN, UNDECIDED, WRONG, FileVerdict, Verdict
from lib.rim.child import adopt_orphans
from lib.running.pipe_tools import ToolCrash

ENDED = "It could not be judged: its judge was ended, perhaps for lack of memory."
LARGEST_FILE = 1 << 30  # that a tool may write for a hand-in
LEAST_SECONDS = 6  # to start a judge; a judge that only waits is ended, too
MEBIBYTE = 1 << 20


@dataclasses.dataclass
class GradedTest:
    name: str
    score: float
    max_score: float
    verdict: Verdict
    words: str  # for the student, with as much as the hints give away
    fixes: list
    pictures: list  # of (caption, data: URI)
    by_teacher: str = ""  # what a line of the overrides has changed or said


@dataclasses.dataclass
class Graded:
    tests: list = dataclasses.field(default_factory=list)  # of GradedTest
    max_score: float = 0.0
    remarks: list = dataclasses.field(default_factory=list)
    failure: str = ""  # why it could not be judged, also the first of the remarks
    wrong: dict = dataclasses.field(default_factory=dict)  # {(test, file): hash} of what is not right

    @property
    def score(self):
        return sum(test.score for test in self.tests)

    @property
    def is_judged(self):
        return not self.failure and not any(file.verdict in OPEN for test in self.tests
                                            for file in test.verdict.files)


@dataclasses.dataclass
class Limits:
    seconds: float  # of the processor, for each test of a hand-in
    mebibytes: int
    jobs: int
    hidden: tuple = ()  # folders that no program may read
    program: object = None  # an assignment.Program, if that is what is handed in
    needs_user: bool = False  # each program runs as a user of its own, as there is no sandbox
    user: object = None


class TooLong(BaseException):
    """More processor time than allowed; no handler of a bad file's errors stops it."""


@contextlib.contextmanager
def processor_seconds(seconds):
    """Raises TooLong in a block that takes more seconds of the processor, however busy the machine is."""
    def give_up(*_):
        raise TooLong

    signal.signal(signal.SIGPROF, give_up)
    signal.setitimer(signal.ITIMER_PROF, seconds, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def grade(path, tests, level, limits, keep):
    """The Graded of the hand-in at a path; `keep` gets each GradedTest as soon as it is there."""
    late = f"that takes longer than {limits.seconds:g} s of the processor"
    try:
        with processor_seconds(limits.seconds):
            contents = contents_of(path)
    except ContentsError as error:
        return failed(tests, f"It could not be read: {error}.")
    except TooLong:
        return failed(tests, f"It could not be read: {late}.")
    graded, accused = Graded(max_score=sum(test.max_score for test in tests), remarks=contents.remarks), {}
    of_files = (functools.partial(judge_files, contents, test, len(tests) == 1) for test in tests)
    judges = verdicts(contents, tests, limits) if limits.program else of_files
    for test in tests:
        try:
            with processor_seconds(limits.seconds):
                files, verdict, remark = next(judges)()
                made = graded_test(test, files, verdict, level, graded.wrong)
                if any(file.stage == "zbuf" and file.causes for file in verdict.files):
                    accused[len(graded.tests)] = test, files
        except (TooLong, StopIteration):  # the latter after a program that took too long to unpack
            made, remark = not_judged(test, level), f"{test.name}: it could not be judged: {late}"
        graded.remarks += [remark] * bool(remark)
        graded.tests.append(made)
        keep(made)
    if any(AT_BORDERS in file.rule for made in graded.tests for file in made.verdict.files):
        with contextlib.suppress(TooLong):
            for number, (test, files) in accused.items():
                with processor_seconds(limits.seconds):
                    judge_borders_first(graded, number, test, files, level)
    with contextlib.suppress(TooLong), processor_seconds(limits.seconds):
        take_back_causes(graded, tests, level)
    return graded


def take_back_causes(graded, tests, level):
    """Removes a mistake of model as cause if another test that shows it has the file right, or wrong without
    a cause: the hand-in does not make the mistake, or not alone."""
    files = [
        (made, test, file) for made, test in zip(graded.tests, tests) for file in made.verdict.of("model")]
    others = [test for _, test, file in files if file.is_good or file.verdict == WRONG and not file.causes]
    for made, _, file in files:
        against = {
            cause.name: test.name
            for cause in file.causes for test in others if any(
                test.reference.scene.shows(name.removeprefix("model/"))
                for name in cause.name.split(" and "))}
        if not against:
            continue
        file.remarks += [
            f"resembles: {cause}; but {against[cause.name]} rules it out as sole cause"
            for cause in file.causes if cause.name in against]
        file.causes = [cause for cause in file.causes if cause.name not in against]
        made.words, made.fixes = in_words(made.verdict, level), fixes(made.verdict, level)


def judge_borders_first(graded, number, test, files, level):
    """Judges a test again if the hand-in is right by another rule at the borders in another test: what one
    scene tolerates, no other may call a mistake."""
    before, kinds = graded.tests[number].verdict, kinds_of(test.reference.config)
    verdict = Judge(files, test.reference, kinds, borders_first=True).judge()
    by_stage = Verdict([file for file in verdict.files if before.of(file.stage)])
    if all(file.is_good for file in by_stage.of("zbuf")):
        graded.wrong = {key: digest for key, digest in graded.wrong.items() if key[0] != test.name}
        graded.tests[number] = graded_test(test, files, by_stage, level, graded.wrong)


def graded_test(test, files, verdict, level, wrong):
    """The GradedTest of a Verdict. Notes in `wrong` the hashes of files that are not right."""
    shown = pictures(test, files, verdict) if gives(level, "stage") else []
    for kind, file in zip(test.kinds, verdict.files):
        file.worth = test.settings.another_rule
        file.places = []  # the pictures have them; there may be millions
        if file.verdict == WRONG and (data := kind in files and files[kind].data):
            wrong[test.name, KINDS[kind][0]] = hashlib.sha256(data).digest()
    return GradedTest(test.name, test.score(verdict.files), test.max_score, verdict, in_words(verdict, level),
                      fixes(verdict, level), shown)


def not_judged(test, level):
    verdict = Verdict([FileVerdict(STAGE_OF[kind], KINDS[kind][0], UNDECIDED) for kind in test.kinds])
    return graded_test(test, {}, verdict, level, {})


def judge_files(contents, test, is_only_test):
    """The Files of a test, the Verdict on them, and the places searched if there are none."""
    files = files_for(contents, test, is_only_test)
    verdict = Judge(files, test.reference, test.kinds).judge()
    is_found = any(file.data is not None or file.error for file in files.values())
    return files, verdict, "" if is_found else looked_for(test, is_only_test)


def failed(tests, reason):
    return Graded(max_score=sum(test.max_score for test in tests), failure=reason, remarks=[reason])


def end_with_writers_of(reader, writer):
    """Makes the system kill this process group when grade, the pipe's last writer, has ended."""
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
    os.umask(0o022)  # a user of its own reads what is handed in
    end_with_writers_of(*pipe)
    tempfile.tempdir = scratch
    # A program that is run has limits of its own.
    confined.set_limit(resource.RLIMIT_AS, limits.mebibytes * MEBIBYTE, limits.program is not None)
    confined.set_limit(resource.RLIMIT_FSIZE, LARGEST_FILE)
    confined.set_limit(resource.RLIMIT_CORE, 0)
    try:
        graded = grade(path, tests, level, limits, connection.send)
    except (MemoryError, ToolCrash) as error:  # a tool without memory is ended by a signal
        reason = f"{error}, perhaps as it" if isinstance(error, ToolCrash) else "that"
        graded = failed(
            tests, f"It could not be judged: {reason} needs more than {limits.mebibytes} MiB of memory.")
    except Unusable as error:
        graded = failed(tests, f"It could not be judged: {error}.")
    except Exception as error:  # an error of ours: it costs this hand-in its verdict, and must be seen
        traceback.print_exc()
        graded = failed(tests, f"It could not be judged: {type(error).__name__}.")
    connection.send(graded)


class Running:
    """The process of one hand-in, with a folder for what its tools write."""
    def __init__(self, path, tests, level, limits, user):
        context = multiprocessing.get_context("fork")  # what is right has been calculated once, for all
        self.tests, self.limits, self.user, self.start = tests, limits, user, time.time()
        self.connection, theirs = context.Pipe(duplex=False)
        self.scratch = tempfile.TemporaryDirectory()
        os.chmod(self.scratch.name, 0o711)  # a program that is run as another user works in it
        reader, self.alive = os.pipe()
        limits = dataclasses.replace(limits, user=user)
        words = theirs, path, tests, level, limits, self.scratch.name, (reader, self.alive)
        self.process = context.Process(target=work, args=words)
        self.process.start()
        theirs.close()
        os.close(reader)
        self.kept = []  # of GradedTest
        self.seconds = CLOCK * max(limits.seconds * len(tests), LEAST_SECONDS)
        self.end = time.monotonic() + self.seconds
        if limits.program:
            self.end += limits.program.seconds(len(tests))

    def result(self):
        """The hand-in's Graded when its process is done, has ended or is out of time; None before."""
        while self.connection.poll():
            try:
                received = self.connection.recv()
            except EOFError:
                return self.with_kept(ENDED)
            if isinstance(received, GradedTest):
                self.kept.append(received)
            else:
                return self.with_kept(received.failure) if received.failure else received
        if time.monotonic() < self.end:
            return None
        return self.with_kept(f"It could not be judged: that takes longer than {self.seconds:g} s.")

    def with_kept(self, reason):
        """The Graded of a failure, with the tests that were judged before."""
        graded = failed(self.tests, reason)
        if self.kept:
            graded.tests = self.kept + [not_judged(test, "none") for test in self.tests[len(self.kept):]]
        return graded

    def stop(self, others):
        """Ends the process and all processes that it has started, but not the `others`."""
        self.process.kill()
        self.process.join()
        end_all(keep={one.process.pid for one in others if one is not self})
        self.connection.close()
        os.close(self.alive)
        if self.user is not None:
            remove_what_is_left([self.user], self.start)
        self.scratch.cleanup()


def grade_all(hand_ins, tests, level, limits):
    """Yields (HandIn, Graded), in the order of completion."""
    waiting, running, start = list(reversed(hand_ins)), {}, time.time()
    users = [take_user() if limits.needs_user else None for _ in range(min(limits.jobs, len(hand_ins)))]
    adopt_orphans()
    try:
        while waiting or running:
            while waiting and users:
                hand_in = waiting.pop()
                one = Running(hand_in.path, tests, level, limits, users.pop())
                running[one.connection] = hand_in, one
            rest = min(one.end for _, one in running.values()) - time.monotonic()
            multiprocessing.connection.wait(list(running), max(0.0, rest))
            for connection, (hand_in, one) in list(running.items()):
                if graded := one.result():
                    one.stop([each for _, each in running.values()])
                    users.append(one.user)
                    del running[connection]
                    yield hand_in, graded
    finally:
        for _, one in running.values():
            one.stop(())
            users.append(one.user)
        if limits.needs_user:
            remove_what_is_left(users, start)
