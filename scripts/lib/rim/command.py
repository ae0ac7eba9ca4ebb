"""How a command ends: with a status and one line on stderr, or quietly by the signal that stopped it; never
with a traceback caused by the user's files or shell."""
import contextlib
import errno
import io
import os
import re
import secrets
import shutil
import signal
import sys
import tempfile
import traceback

MINIMUM_PYTHON = (3, 9)
if sys.version_info < MINIMUM_PYTHON:
    sys.exit("{}: Python {}.{} or newer is needed, found {}.{}".format(os.path.basename(
        sys.argv[0]), *MINIMUM_PYTHON, *sys.version_info[:2]))

from lib.rim.child import end_children

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
leftovers = set()  # temporary files, and the folder of others, which go with the command, whenever it ends


class CommandFailure(Exception):
    """The command cannot do its job; the text is a sentence for the user, without the command's name."""
    is_misuse = False  # of the command line, which is always status 2


@contextlib.contextmanager
def errors(action, name, kind=CommandFailure):
    """Turns an error of the system into a failure that says what could not be done to a file."""
    try:
        yield
    except BrokenPipeError:  # a pipe's reader may leave
        raise
    except OSError as error:
        raise kind(f"cannot {action} {shown(name)}: {error.strerror}") from None


class Ended(BaseException):
    """A signal asks the command to stop."""
    def __init__(self, signal_number):
        super().__init__(signal_number)
        self.signal_number = signal_number


def shown(name):
    """A file's name, or a part of a file, fit for one line: unprintable characters are escaped."""
    def escaped(c):  # a byte that is not UTF-8 has been read as one of 128 surrogates
        return f"\\x{ord(c) - 0xdc00:02x}" if "\udc80" <= c <= "\udcff" else ascii(c)[1:-1]

    return "".join(c if c.isprintable() else escaped(c) for c in os.fspath(name))


def renamed(message, names):
    """A message with names of files, the values, in place of others, the keys."""
    names = {shown(known): shown(name) for known, name in names.items()}
    known = "|".join(map(re.escape, sorted(names, key=len, reverse=True)))  # a name may begin another one
    return re.sub(known, lambda found: names[found[0]], message) if names else message


@contextlib.contextmanager
def renaming(names):
    """Puts the values in place of the keys, names of files, in the text of a failure."""
    try:
        yield
    except CommandFailure as failure:
        failure.args = (renamed(str(failure), names),)
        raise


def run_command(main, name, failure_status=1):
    """Runs `main`, prints any error, and ends the process with the status that `main` returns (None is 0), or
    with `failure_status`. By then the output of `main` has reached stdout; if it could not, that is the
    error."""
    status, signal_number = failure_status, None
    try:
        prepare()
        status = status_of(main, name, failure_status)
        heed_no_signal()
    except Ended as end:
        signal_number = end.signal_number
        told(name, f"ended by {signal.Signals(signal_number).name}", status)
    except BrokenPipeError:
        signal_number = signal.SIGPIPE
    heed_no_signal()
    for path in leftovers:
        with contextlib.suppress(OSError):
            shutil.rmtree(path) if os.path.isdir(path) else os.unlink(path)
    silence_stdout()
    if signal_number:
        end_by(signal_number)
    sys.exit(status)


class Stdout(io.FileIO):
    """Descriptor 1; its errors name stdout."""
    def write(self, data):
        with errors("write", "<stdout>"):
            return super().write(data)


def prepare():
    """Makes sure of the standard streams, and makes the folder of temporary files."""
    for number, flags in ((0, os.O_WRONLY), (1, os.O_RDONLY), (2, os.O_RDONLY)):
        try:
            os.fstat(number)
        except OSError:  # closed: using it must fail, and no opened file may get its descriptor
            os.open(os.devnull, flags)
    sys.stderr = sys.stderr or open(os.devnull, "w")
    sys.stdout = io.TextIOWrapper(io.BufferedWriter(Stdout(1, "w", closefd=False)), errors="backslashreplace",
                                  line_buffering=os.isatty(1))
    for number in SIGNALS:
        if signal.getsignal(number) == signal.SIG_DFL:  # nohup ignores SIGHUP, and sh SIGINT behind &
            signal.signal(number, end)
    os.umask(os.umask(0o077) & 0o077)  # what it makes, it can open
    for place in filter(None, (os.environ.get("TMPDIR"), "/tmp", "/var/tmp")):
        # Hidden, so that no search for hand-ins or tests in that place finds it.
        folder = os.path.join(place, ".pipeline-" + secrets.token_hex(8))
        leftovers.add(folder)
        with contextlib.suppress(OSError):  # what needs a temporary file will say so
            os.mkdir(folder, 0o700)
            tempfile.tempdir = os.path.abspath(folder)
            break


@contextlib.contextmanager
def unbroken():
    """Delays signals to the end of the block, which must start no process: it would inherit that."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, SIGNALS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def end(signal_number, _):
    heed_no_signal()
    end_children()
    raise Ended(signal_number)


def heed_no_signal():
    for number in SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def status_of(main, name, failure_status):
    try:
        try:
            status = main() or 0
        except SystemExit as end:  # raised by argparse
            status = end.code or 0
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        raise
    except CommandFailure as failure:
        return told(name, failure, 2 if failure.is_misuse else failure_status)
    except OSError as error:
        is_about_file = error.filename and error.errno not in (errno.EMFILE, errno.ENFILE)
        where = f"{shown(os.fsdecode(error.filename))}: " if is_about_file else ""
        return told(name, where + (error.strerror or str(error)), failure_status)
    except MemoryError:
        return told(name, "not enough memory", failure_status)
    except Exception:  # an error of ours; its status must not look like an answer
        traceback.print_exc()
        return failure_status


def told(name, message, status):
    with contextlib.suppress(OSError):
        print(f"{name}: {message}", file=sys.stderr, flush=True)
    return status


def silence_stdout():
    """Keeps Python from flushing stdout again at exit, which would fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def end_by(signal_number):
    """Ends the process as the signal would have, so that a shell sees the signal."""
    signal.signal(signal_number, signal.SIG_DFL)
    os.kill(os.getpid(), signal_number)
    sys.exit(128 + signal_number)
