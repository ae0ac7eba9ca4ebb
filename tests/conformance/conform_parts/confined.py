"""Programs of others: each runs with limits, in a folder of its own and, where bubblewrap works, in a sandbox
that shows it nothing else. It ends with all that it has started."""
import collections
import contextlib
import errno
import functools
import itertools
import math
import os
import pathlib
import resource
import select
import shutil
import signal
import stat
import subprocess
import tempfile
import time

from .sandbox import folders_of_tools, words_for, words_of_folder
from .workers import PR_SET_NO_NEW_PRIVS, descendants, end_all, first_in_line, prctl, spread

MEBIBYTE = 1 << 20
LARGEST_FILE, MOST_WRITTEN, MOST_FILES = 64 * MEBIBYTE, 256 * MEBIBYTE, 1000
LONGEST_PATH = 4000  # bytes; the system reaches nothing by one of more than 4095
MOST_OPEN, MOST_THREADS = 256, 1024
MOST_OF_USER = 8192  # processes and threads of a user who is not root, so that a program cannot take all
PR_CAPBSET_DROP, CAP_DAC_OVERRIDE = 24, 1
LEAST_LEFT = 8  # of what the system had left of memory and disk, a part of this must stay, whoever takes it
MOST_ERRORS = MEBIBYTE  # of stderr that is kept, the last ones
INTERVAL = 0.03  # seconds between two looks at what a program uses
NO_NAMESPACES = ("--unshare-user", "--disable-userns")  # of the program's own; bubblewrap knows it since 0.8
PASSED_ON = ("PATH", "LANG", "LC_ALL")
HINTS = {
    errno.EACCES: "; chmod +x makes a file a program",
    errno.ENOEXEC: "; a script begins with a line like #!/usr/bin/env python3"}

NO_END = "does not end within"
# seconds of processors; MiB of resident memory and a number of processes, of all that the program starts
# together; MiB of address space of each process, if not None; bytes of stdout; seconds of the clock for each
# of a processor
Limits = collections.namedtuple("Limits", "seconds memory processes address_space output clock",
                                defaults=(10, 1024, 64, None, MEBIBYTE, 1))
# status: None if it could not be started or did not end by itself: then `why` is the reason, a verb and more
Ending = collections.namedtuple("Ending", "status why stdout stderr", defaults=(b"", b""))
# words: of bubblewrap, empty without it; reason: why it is not used; variables: names of those passed on;
# user: whose number root runs the program with, if not root's own
Sandbox = collections.namedtuple("Sandbox", "words reason variables user", defaults=((), "", (), None))


class Refused(Exception):
    """The text is a sentence about a program that cannot be started, or a file that is not read."""


def add_options(parser):
    add, default = parser.add_argument, Limits()
    add("--memory", type=int, default=default.memory, metavar="MIB",
        help="memory for all processes of a run together (default: %(default)s)")
    add("--address-space", type=int, metavar="MIB", help="address space for each process (default: no limit)")
    add("--processes", type=int, default=default.processes, metavar="N",
        help="processes of a run at a time (default: %(default)s)")
    add("--env", action="append", default=[], metavar="NAME",
        help="an environment variable that the program gets beside PATH, LANG and LC_ALL; may be repeated")
    add(
        "--sandbox", choices=("auto", "yes", "no"), default="auto",
        help="run the program in a sandbox: always, never, or where bubblewrap works (auto, the default; "
        "root runs none elsewhere)")
    add("--read", action="append", default=[], metavar="PATH",
        help="a file or folder that the program may read in its sandbox, too; may be repeated")


def limits_of(options, seconds):
    """The Limits of the options; raises a Refused."""
    if not 0 < seconds < math.inf or min(options.memory, options.processes, options.address_space or 1) < 1:
        raise Refused("expected limits of time, memory and processes above 0")
    return Limits(seconds, options.memory, options.processes, options.address_space, clock=getattr(
        options, "clock", 1))


def program_path(word):
    """Where the program of a command's first word is; raises a Refused if it cannot be started."""
    path = os.path.abspath(word) if os.sep in word else shutil.which(word)
    number = errno.ENOENT
    if path and os.path.exists(path):
        number = 0 if os.path.isfile(path) and os.access(path, os.X_OK) else errno.EACCES
    if not number and os.access(path, os.R_OK):
        with open(path, "rb") as file:
            start = file.read(64)
        number = 0 if start.startswith((b"#!", b"\x7fELF")) or b"\0" in start else errno.ENOEXEC
    if number:
        raise Refused(f"cannot run {word}: {os.strerror(number)}{HINTS.get(number, '')}")
    return path


def sandbox(command, options, hidden):
    """The Sandbox for a command, which hides our own tools, too, unless the command names them. Raises a
    Refused if it does not work, and one is asked for or the program would have root's rights unasked."""
    for path in options.read:
        if not os.path.exists(path):
            raise Refused(f"--read {path}: {os.strerror(errno.ENOENT)}")
    hidden = [*hidden, *map(pathlib.Path, folders_of_tools(command, options.read))]
    bwrap, reason = shutil.which("bwrap"), "bubblewrap is not installed"
    for more in (NO_NAMESPACES, ()) if options.sandbox != "no" and bwrap else ():
        words = [bwrap, *more, *words_for(command, options.read, hidden)]
        with temporary_folder("confined.") as top, opened_folder(top / "work"):
            done = run_apart(["true"], subprocess.DEVNULL, top / "work", Limits(), Sandbox(words))
        if done and done.status == 0:
            return Sandbox(words, "", options.env)
        complaint = (done.stderr.decode(errors="replace").strip() or done.why) if done else ""
        reason = "bubblewrap does not work here: " + (complaint or "no reason given").splitlines()[-1]
    if options.sandbox == "yes":
        raise Refused(reason)
    if options.sandbox == "auto" and os.geteuid() == 0:
        raise Refused(
            f"{reason}, and without a sandbox a program would be run as root: --sandbox no does that "
            "with a program that you trust")
    return Sandbox((), "--sandbox no" if options.sandbox == "no" else reason, options.env)


def told(box):
    """A line on whether there was a sandbox."""
    if box.reason:
        return f"no sandbox ({box.reason})"
    return "in a sandbox: no network, and no files but the program's own (--read shows it more)"


def run_apart(words, stdin, folder, limits, box):
    """The same as run, by a process of its own; None if that has been killed."""
    def task(_):
        hard = resource.getrlimit(resource.RLIMIT_AS)[1]  # the caller's own limit is none of the program's
        resource.setrlimit(resource.RLIMIT_AS, (hard, hard))
        status, why, *texts = run(words, stdin, folder, limits, box)
        return [status, why, *(text.decode("latin-1") for text in texts)]

    [answer] = spread(task, 1, 1, limits.clock * limits.seconds)
    return answer and Ending(*answer[:2], *(text.encode("latin-1") for text in answer[2:]))


def run(words, stdin, folder, limits, box):
    """The Ending of a program that works in `folder`; the folder around it belongs to this run alone."""
    environment = {name: os.environ[name] for name in (*PASSED_ON, *box.variables) if name in os.environ}
    environment.update(HOME=str(folder), TMPDIR=str(folder))
    space = limits.address_space and (resource.RLIMIT_AS, limits.address_space * MEBIBYTE)
    if box.words:
        words = [*words_of_folder(folder, box.words), *words]
    else:
        drop_capabilities()
    user = {} if box.user is None else {"user": box.user, "group": box.user, "extra_groups": []}
    confine_self(limits)
    with tempfile.TemporaryFile() as stdout, tempfile.TemporaryFile() as stderr:
        try:
            process = subprocess.Popen(words, stdin=stdin, stdout=stdout, stderr=stderr, cwd=folder,
                                       start_new_session=True, env=environment, **user,
                                       preexec_fn=functools.partial(set_limit, *space) if space else None)
        except OSError as error:
            return Ending(None, f"cannot be run: {error.strerror}")
        why = "was stopped"
        with first_in_line():
            try:
                why = watch(process, pathlib.Path(folder).parent, limits)
            finally:
                with contextlib.suppress(OSError):
                    os.killpg(process.pid, signal.SIGKILL)  # at once, so that none can start another
                process.wait()
                end_all()
        status = process.returncode
        if box.words and status - 128 in signal.valid_signals():  # so bubblewrap tells of a signal
            status = 128 - status
        sizes = [os.fstat(file.fileno()).st_size for file in (stdout, stderr)]
        why = why or reason_of(status, sizes, limits)
        return Ending(None if why else status, why, os.pread(stdout.fileno(), limits.output, 0),
                      os.pread(stderr.fileno(), MOST_ERRORS, max(0, sizes[1] - MOST_ERRORS)))


def largest_file(limits):
    return max(LARGEST_FILE, limits.output + MEBIBYTE)


def confine_self(limits):
    """Limits that this process passes on to the programs that it starts: a function called in between would
    cost more than a short program."""
    prctl(PR_SET_NO_NEW_PRIVS, 1)
    set_limit(resource.RLIMIT_FSIZE, largest_file(limits))
    set_limit(resource.RLIMIT_NOFILE, MOST_OPEN)
    set_limit(resource.RLIMIT_CORE, 0)
    set_limit(resource.RLIMIT_NPROC, MOST_OF_USER)


def drop_capabilities():
    """Has what this process starts from now on run without root's capabilities, but that to read and write
    any file: it may look neither into this process nor for its connection."""
    for capability in range(64):
        if capability != CAP_DAC_OVERRIDE:
            prctl(PR_CAPBSET_DROP, capability)


def set_limit(name, value, may_be_raised=False):
    """Sets a limit, or leaves a lower one that only root could raise."""
    hard = resource.getrlimit(name)[1]
    value = value if hard == resource.RLIM_INFINITY else min(value, hard)
    resource.setrlimit(name, (value, hard if may_be_raised else value))


def reason_of(status, sizes, limits):
    """Why an ending is none that the program has chosen, or its output is too long; else empty."""
    if sizes[0] > limits.output:
        return f"writes more than {limits.output} bytes, more than can be needed"
    if -status == signal.SIGXFSZ or max(sizes) >= largest_file(limits):
        return f"writes more than {largest_file(limits) // MEBIBYTE} MiB to a file"
    name = next((each.name for each in signal.Signals if each == -status), f"signal {-status}")
    return f"was ended by {name}" if status < 0 else ""


def watch(process, folder, limits):
    """Waits for the end of a program; the reason if a limit is reached before, else empty."""
    end, before = time.monotonic() + limits.clock * limits.seconds, room(folder)
    with contextlib.ExitStack() as stack:
        poll = None
        with contextlib.suppress(AttributeError, OSError):  # older systems
            descriptor = os.pidfd_open(process.pid)
            stack.callback(os.close, descriptor)
            poll = select.poll()
            poll.register(descriptor, select.POLLIN)
        while (left := end - time.monotonic()) > 0:
            if has_ended(process, poll, min(left, INTERVAL)):
                return ""
            if why := excess(folder, limits) or shortage(before, room(folder)):
                return why
    return f"{NO_END} {limits.clock * limits.seconds:g} s"


def has_ended(process, poll, seconds):
    if poll:
        return bool(poll.poll(math.ceil(seconds * 1000)))
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(seconds)
    return process.returncode is not None


def room(folder):
    """How much memory, and disk of a folder, the system has left, as far as it tells."""
    left = {}
    with contextlib.suppress(OSError, StopIteration), open("/proc/meminfo") as file:
        left["memory"] = next(int(line.split()[1]) for line in file if line.startswith("MemAvailable:"))
    with contextlib.suppress(OSError):
        status = os.statvfs(folder)
        left["disk"] = status.f_bavail * status.f_frsize
    return left


def shortage(before, now):
    """What programs that hide what they use have left too little of, as a reason; empty if nothing."""
    for kind in before.keys() & now.keys():
        if now[kind] < before[kind] // LEAST_LEFT:
            return f"leaves the system too little {kind}"
    return ""


def excess(folder, limits):
    """What the processes of a program use too much of, as a reason; empty if nothing."""
    pids = descendants(most=limits.processes)
    if len(pids) > limits.processes:
        return f"starts more than {limits.processes} processes"
    ticks, threads, pages = map(sum, zip((0, 0, 0), *map(usage, pids)))
    if ticks > limits.seconds * os.sysconf("SC_CLK_TCK"):
        return f"takes more than {limits.seconds:g} s of processor time"
    if threads > MOST_THREADS:
        return f"starts more than {MOST_THREADS} threads"
    most = limits.memory * MEBIBYTE
    if pages * resource.getpagesize() > most and sum(map(memory, pids)) > most:
        return f"needs more than {limits.memory} MiB of memory"
    return excess_of_files(folder, pids)


def excess_of_files(folder, pids):
    """The same of the files in a folder, and of open ones without a name."""
    found, used, folders = [], {}, [folder]
    while folders:
        try:
            with os.scandir(folders.pop()) as entries:
                added = list(itertools.islice(entries, MOST_FILES + 1))
        except PermissionError:
            return "closes a folder of its own"
        except OSError:  # it may be gone
            continue
        folders += [entry.path for entry in added if entry.is_dir(follow_symlinks=False)]
        found += added
        if len(found) > MOST_FILES:  # no look at each, which takes its time where more are made
            return f"writes more than {MOST_FILES} files"
        if any(len(os.fsencode(entry.path)) > LONGEST_PATH for entry in added):
            return f"makes a path of more than {LONGEST_PATH} bytes"
    used.update(inode_and_bytes(entry.path) for entry in found)
    for pid in pids:
        with contextlib.suppress(OSError):
            used.update(inode_and_bytes(entry.path, is_open=True) for entry in os.scandir(f"/proc/{pid}/fd"))
    return f"writes more than {MOST_WRITTEN // MEBIBYTE} MiB" if sum(used.values()) > MOST_WRITTEN else ""


def inode_and_bytes(path, is_open=False):
    with contextlib.suppress(OSError):
        status = os.stat(path, follow_symlinks=is_open)
        if stat.S_ISREG(status.st_mode) and not (is_open and status.st_nlink):
            return (status.st_dev, status.st_ino), status.st_blocks * 512
    return None, 0


def usage(pid):
    """The processor time in ticks, also of ended children, the threads, and the resident pages of a
    process."""
    with contextlib.suppress(OSError), open(f"/proc/{pid}/stat", "rb") as file:
        fields = file.read().rpartition(b")")[2].split()
        return sum(map(int, fields[11:15])), int(fields[17]), int(fields[21])
    return 0, 0, 0


def memory(pid):
    """The resident bytes of a process; of those that it shares with others its share."""
    with contextlib.suppress(OSError), open(f"/proc/{pid}/smaps_rollup") as file:
        return sum(1024 * int(line.split()[1]) for line in file if line.startswith("Pss:"))
    return usage(pid)[2] * resource.getpagesize()


@contextlib.contextmanager
def temporary_folder(prefix, parent=None):
    """A new folder, which is removed with all that a program has put there."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix=prefix, dir=parent))
    try:
        yield folder
    finally:
        with contextlib.suppress(OSError, RecursionError):
            shutil.rmtree(folder)
        if os.path.lexists(folder):
            # by -execdir, as a path may be too long; that takes only absolute folders on the PATH
            opened = [
                "find", folder, "-type", "d", "!", "-perm", "-700", "-execdir", "chmod", "700", "{}", ";"]
            environment = {"PATH": os.pathsep.join(filter(os.path.isabs, os.get_exec_path()))}
            for words in (opened, ["rm", "-rf", "--", folder]):
                subprocess.run(words, stderr=subprocess.DEVNULL, env=environment)


@contextlib.contextmanager
def opened_folder(path):
    """The descriptor of a new folder for a program, which may put another in its place."""
    path.mkdir()
    descriptor = os.open(path, os.O_RDONLY)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def read_output(name, folder, limit):
    """The bytes of a file in a folder, an open descriptor; None if there is none. Nothing is waited for and
    no link followed: a Refused has the reason."""
    try:
        descriptor = os.open(name, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_NOCTTY, dir_fd=folder)
    except FileNotFoundError:
        return None
    except OSError as error:
        raise Refused("it is a link" if error.errno == errno.ELOOP else error.strerror) from None
    try:
        if not stat.S_ISREG(os.fstat(descriptor).st_mode):
            raise Refused("it is not a regular file")
        data = b""
        while len(data) <= limit and (block := os.read(descriptor, limit + 1)):
            data += block
    finally:
        os.close(descriptor)
    if len(data) > limit:
        raise Refused(f"it is longer than {limit} bytes, more than can be needed")
    return data
