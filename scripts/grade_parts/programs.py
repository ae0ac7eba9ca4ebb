"""Programs that are handed in: built and run for every test, in a sandbox of bubblewrap; if that fails, as in
a container, root runs each as its own user, who may read nothing of root's."""
import argparse
import contextlib
import ctypes
import functools
import os
import pathlib
import pwd
import stat
import subprocess
import tempfile
import time

from grade_parts.assignment import CLOCK, SECONDS_OF_BUILD, SECONDS_OF_RUN
from lib.judging.hand_in import KINDS
from lib.judging.judge import HandIn as Judge
from lib.judging.program import ProgramError, confined, expect_repetition, hand_in, outcome, run_program
from lib.judging.reference import kinds_of
from lib.judging.verdict import UNDECIDED, WRONG, Cause, FileVerdict, Verdict
from lib.rim.command import CommandFailure, shown
from lib.rim.places import place

FIRST_USER, USERS = 61184, 4336  # numbers that a container has, and that no package gives to a user
LOCAL = ("ext4", "xfs", "btrfs", "zfs", "overlay", "tmpfs", "devtmpfs", "mqueue", "f2fs")  # file systems
DEPTH = 6  # of the search for folders that all may write
MOST_BYTES, MOST_FILES = 64 << 20, 500  # of a hand-in that is built
MOST_LINES = 10  # of a compiler's messages, as shown
MEMORY, PROCESSES = 1024, 64


def protection(command, read, hidden, user):
    """A Sandbox, or one without words but with a user. Raises a CommandFailure if neither is possible."""
    asked = argparse.Namespace(read=list(read), env=[], sandbox="or another user")
    box = confined.sandbox(command, asked, [pathlib.Path(path) for path in hidden])
    if box.words:
        return box
    if os.geteuid() == 0 and succeeds(user, "true"):
        if names := " ".join(shown(str(path)) for path in hidden if succeeds(user, "test", "-x", path)):
            raise CommandFailure("a program that is handed in, which root runs as another user, may read "
                                 f"what it should not: chmod go= {names}, or install bubblewrap")
        return box._replace(user=user)
    raise CommandFailure(f"a program is run only in a sandbox, or by root as another user: {box.reason}")


def take_user():
    """The number of a user who has no name and no process. It becomes a group of this process, by which
    others see that it is taken: of two that take one at once, at least one sees the other."""
    own, named = os.getgroups(), {user.pw_uid for user in pwd.getpwall()}
    for number in (FIRST_USER + (os.getpid() + i) % USERS for i in range(USERS)):
        if number not in named and number not in own:
            with contextlib.suppress(PermissionError):  # only root runs programs as others
                os.setgroups([*own, number])
            if number not in users_of_others():
                return number
    os.setgroups(own)
    raise CommandFailure(f"all users from {FIRST_USER} to {FIRST_USER + USERS - 1} are taken")


def users_of_others():
    """The users and groups of all other processes."""
    for name in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError), open(f"/proc/{name}/status", "rb") as file:  # it may have ended
            for line in file if int(name) != os.getpid() else ():
                if line.startswith((b"Uid:", b"Groups:")):
                    yield from map(int, line.split()[1:])


def run_as(user, words):
    return subprocess.run(words, capture_output=True, user=user, group=user, extra_groups=[], cwd="/")


def succeeds(user, *words):
    with contextlib.suppress(OSError):
        return not run_as(user, words).returncode
    return False


def right_ones():
    """The folders of programs with the right answers: the tools, and the reference beside the pack."""
    return [*confined.folders_of_tools(), place("tests/conformance", "share/pipeline/conformance").parent]


def expect_protection(hidden):
    """Raises a CommandFailure, before there is any work, if nothing protects this machine from programs.
    Without a sandbox, prints the risks and returns True."""
    box = protection(["true"], (), hidden, take_user())
    if box.user is not None:
        places_for_all()
        print(
            f"no sandbox ({box.reason}): each program runs as a user of its own, with network, abstract "
            "sockets and System V segments, which are removed after its run", flush=True)
        os.umask(0o077)  # results of others show the right pictures
        if tempfile.tempdir:  # the command's own folder, in which they are to work
            os.chmod(tempfile.tempdir, 0o711)
    return box.user is not None


@functools.lru_cache
def places_for_all():
    """Folders that a user without a name may write."""
    with open("/proc/self/mounts") as file:
        tops = {top for _, top, kind, *_ in map(str.split, file) if kind in LOCAL and os.path.isdir(top)}
    words = ["find", "/", *tops, "-xdev", "-maxdepth", str(DEPTH), "-type", "d", "-writable", "-print0"]
    return run_as(take_user(), words).stdout.split(b"\0")[:-1]


def remove_what_is_left(users, since):
    """Removes all that users have made since a time: files in places_for_all(), segments, semaphores and
    queues of System V, and message queues of POSIX."""
    theirs = [word for user in users for word in ("-o", "-uid", str(user))][1:]
    others = ["-uid", f"-{FIRST_USER}", "-o", "-uid", f"+{FIRST_USER + USERS - 1}"]
    # by -execdir, as programs may put links in place of folders; it refuses relative folders on the PATH
    subprocess.run([
        "find", *places_for_all(), "-mindepth", "1", "(", *theirs, ")", "-newerct", f"@{since}", "-prune",
        "-execdir", "rm", "-rf", "--", "{}", "+", "-o", "(", *others, ")", "-prune"],
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd="/", env={
                       "PATH": os.pathsep.join(filter(os.path.isabs, os.get_exec_path()))})
    for kind in ("shm", "sem", "msg"):
        with open(f"/proc/sysvipc/{kind}") as file:
            names, *rows = map(str.split, file)
        remove = getattr(ctypes.CDLL(None), f"{kind}ctl")
        for row in rows:
            if row[names.index("cuid")] in theirs:
                remove(int(row[1]), 0, 0)  # 0 is IPC_RMID
    with tempfile.TemporaryDirectory() as queues:  # POSIX's, where the system mounts them nowhere
        subprocess.run([
            "unshare", "--mount", "sh", "-c", 'mount -t mqueue none "$0" && exec find "$0" "$@" -delete',
            queues, "(", *theirs, ")"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def expect_runnable(user, program):
    """Raises Unusable if the program, or the interpreter in its first line, exists but the user may not run
    it."""
    with open(program, "rb") as file:
        first = os.fsdecode(file.readline(256))
    words = first[2:].split() if first.startswith("#!") else []
    words = [word for word in words if "=" not in word and not word.startswith("-")]
    for name in (program, *words[:1 + (words[:1] == ["/usr/bin/env"])]):
        found = [path for folder in os.get_exec_path() if os.path.exists(path := os.path.join(folder, name))]
        if found and not any(succeeds(user, "test", "-x", path) for path in found):
            raise Unusable(f"{shown(found[0])} may not be run by another user, as whom root runs programs "
                           "without bubblewrap")


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
        except Exception as error:  # what is no archive may raise anything
            raise ProgramError(f"{shown('/'.join(path))} cannot be unpacked "
                               f"({type(error).__name__})") from None
        left -= len(data)
        if left < 0:
            raise ProgramError(f"its files have more than {MOST_BYTES >> 20} MiB")


def give(folder, user, owner=0):
    """Gives a folder and the owner's entries in it to a user, for others to read. Links are not followed;
    files with several hard links are left alone, since the others may be anywhere."""
    for place, folders, files in os.walk(folder):
        for path in (os.path.join(place, name) for name in (".", *folders, *files)):
            status = os.lstat(path)
            if status.st_uid == owner and (stat.S_ISDIR(status.st_mode) or status.st_nlink == 1):
                os.chown(path, user, user, follow_symlinks=False)
                if not stat.S_ISLNK(status.st_mode):
                    own = status.st_mode & 0o500
                    os.chmod(path, status.st_mode & 0o777 | own >> 3 | own >> 6)


class Unusable(Exception):
    """The user of a hand-in cannot run a program of the system, which is no fault of the hand-in."""


class Built:
    """A program that has been built in top/program/files. A `user` runs it, if there is no sandbox."""
    def __init__(self, contents, program, top, hidden, user):
        self.program, self.top, self.hidden, self.user = program, top, hidden, user
        self.start = time.time()
        self.folder = top / "program/files"
        self.folder.mkdir(parents=True)
        unpack(contents, self.folder)
        for folder in (top, top / "program"):
            folder.chmod(0o711)
        if user is not None:  # no other enters the folder
            os.chown(top, 0, user)
            top.chmod(0o710)
        if program.build:
            self.build()
        self.words = self.command()
        if user is not None:
            expect_runnable(user, self.words[0])
        self.box = protection(self.words, [self.folder], hidden, user)

    def build(self):
        words = ["sh", "-c", self.program.build]
        box = protection(words, (), self.hidden, self.user)
        if self.user is not None:
            give(self.folder, self.user)
        try:
            limits = confined.Limits(SECONDS_OF_BUILD, MEMORY, PROCESSES, clock=CLOCK)
            outcome(words, b"", self.folder, limits, box)
        finally:
            if self.user is not None:
                remove_what_is_left([self.user], self.start)
                give(self.folder, 0, self.user)

    def command(self):
        """The words that run the program, with the paths of its own files."""
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
        """The Files by kind that the program makes for a test; raises a ProgramError."""
        options = argparse.Namespace(time_limit=SECONDS_OF_RUN, memory=MEMORY, processes=PROCESSES,
                                     address_space=None, program=self.words, box=self.box, clock=CLOCK)
        limit = max(test.reference.limit(kind) for kind in test.kinds)
        with confined.temporary_folder("run.", self.top) as top, confined.opened_folder(top / "work") as work:
            if self.user is not None:
                top.chmod(0o711)
                os.chown(work, self.user, self.user)
            try:
                output, _ = run_program(options, test.reference.scene_data, test.reference.config or b"1 1\n",
                                        test.given, top, limit)
            finally:
                if self.user is not None:
                    remove_what_is_left([self.user], self.start)
            return hand_in(self.program.stage, output, test.given, work)


def verdicts(contents, tests, limits):
    """Yields, for each test, a function that returns (files, verdict, remark): if a call takes too long, the
    next tests are still judged. `limits` are graders.Limits."""
    program, hidden = limits.program, limits.hidden
    with confined.temporary_folder("grade.") as top:
        try:
            built = Built(contents, program, top, hidden, limits.user)
        except ProgramError as error:
            reason = f"The program cannot be built: {error}{messages(error.errors)}"
            for i, test in enumerate(tests):
                found = {}, failure(test, "The program cannot be built"), "" if i else reason
                yield lambda found=found: found
            return
        for test in tests:
            yield functools.partial(verdict_of_test, built, test)


def verdict_of_test(built, test):
    """(files, verdict, remark) for one test."""
    try:
        files = built.files(test)
    except ProgramError as error:
        reason = f"the program failed: {error}"
        verdict = failure(test, reason)
        for file in verdict.files if error.is_asleep else ():
            file.verdict, file.causes = UNDECIDED, []
        return {}, verdict, f"{test.name}: {reason}"
    verdict = Judge(files, test.reference, kinds_of(test.reference.config)).judge()
    expect_repetition(built.program.stage, verdict, files, lambda: built.files(test))
    return files, Verdict(verdict.of(built.program.stage)), ""


def failure(test, reason):
    stage = test.settings.program.stage
    return Verdict([
        FileVerdict(stage, KINDS[kind][0] if stage == "zbuf" else "stdout", WRONG, causes=[Cause("", reason)])
        for kind in test.kinds])


def messages(errors):
    """The last lines that a compiler wrote. A program's own messages are not shown: they might reveal a
    test."""
    lines = errors.decode(errors="backslashreplace").strip().splitlines()[-MOST_LINES:]
    return "".join("\n" + shown(line.expandtabs())[:200] for line in lines)
