"""Input files, read once and only up to a limit."""
import contextlib
import hashlib
import os
import stat
import tempfile

from lib.rim.command import CommandFailure, renaming, shown
from lib.rim.output_file import write_file

MAX_BYTES = 1 << 29
BLOCK = 1 << 20


class InputError(CommandFailure):
    """A file that cannot be read; `reason` is the text without the file's name."""
    def __init__(self, path, reason, is_missing=False):
        super().__init__(f"cannot read {name_of(path)}: {reason}")
        self.reason = reason
        self.is_missing = is_missing


def name_of(path):
    """The name of an input in messages."""
    return "<stdin>" if path == "-" else shown(path)


@contextlib.contextmanager
def input_errors(path):
    try:
        yield
    except OSError as error:
        raise InputError(path, error.strerror, isinstance(error, FileNotFoundError)) from None


def read_input(path, only_regular=False):
    """The bytes of a file, or of standard input if the path is `-`. With `only_regular`, a pipe or a device
    raises an InputError instead of being waited for. Input longer than MAX_BYTES always does."""
    with input_errors(path):
        if path == "-" and not only_regular:
            return read_all(0, path)
        # Opening a pipe waits for its writer, unless O_NONBLOCK is set.
        flags = os.O_NOCTTY | (os.O_NONBLOCK if only_regular else 0)
        with open(path, "rb", opener=lambda name, mode: os.open(name, mode | flags)) as file:
            if only_regular and not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
                raise InputError(path, "Not a regular file")
            return read_all(file.fileno(), path)


def read_all(descriptor, path):
    data = bytearray()
    while block := os.read(descriptor, BLOCK):
        data += block
        if len(data) > MAX_BYTES:
            raise InputError(path, f"it is longer than {MAX_BYTES >> 20} MiB")
    return bytes(data)


def digest(path):
    """The SHA-256 of a file, read block by block."""
    state = hashlib.sha256()
    with input_errors(path), open(path, "rb") as file:
        while block := file.read(BLOCK):
            state.update(block)
    return state.hexdigest()


def states(*paths):
    """The identity, size and time of each file: another program that writes to one changes them."""
    found = map(os.stat, paths)
    return [(status.st_dev, status.st_ino, status.st_size, status.st_mtime_ns) for status in found]


def is_same_stream(a, b):
    """True if two paths name the same pipe, which can be read only once."""
    with contextlib.suppress(OSError):
        a, b = (os.fstat(0) if path == "-" else os.stat(path) for path in (a, b))
        return os.path.samestat(a, b) and (stat.S_ISFIFO(a.st_mode) or stat.S_ISSOCK(a.st_mode))
    return False


@contextlib.contextmanager
def readable_again(*paths):
    """Paths to the same inputs that can be opened more than once and that no tool takes for an option. An
    input that is not a regular file is copied to one, removed at the end; failures name the input."""
    if paths.count("-") > 1:
        raise CommandFailure("expected '-' once, as standard input can be read only once")
    with tempfile.TemporaryDirectory() as folder:
        copies = [path_again(path, os.path.join(folder, str(i))) for i, path in enumerate(paths)]
        with renaming({copy: name_of(path) for copy, path in zip(copies, paths)}):
            yield copies


def path_again(path, folder):
    if path != "-":
        with input_errors(path):
            if stat.S_ISREG(os.stat(path).st_mode):
                return os.path.join(os.curdir, path) if path.startswith("-") else path
    data = read_input(path)
    os.mkdir(folder)
    copy = os.path.join(folder, "stdin" if path == "-" else os.path.basename(path))
    write_file(copy, data)
    return copy
