"""A file that appears complete or not at all, as the tools' own files do (libpipeline/text/output_file.h)."""
import contextlib
import errno
import os
import re
import secrets
import stat

from lib.rim.command import CommandFailure, errors, leftovers, renaming, unbroken

MAX_LINKS = 40  # the kernel's limit
OWN_FILE = re.compile(r"/dev/(?:(stdout)|(stderr)|fd/(\d+))|/proc/self/fd/(\d+)")


class OutputError(CommandFailure):
    """A file that cannot be written."""


def own_descriptor(path):
    """The N of a path that names this process's open file N, else None. Such a file must not be replaced,
    even if it is a regular one."""
    found = OWN_FILE.fullmatch(path)
    if not found:
        return None
    return 1 if found[1] else 2 if found[2] else int(found[3] or found[4])


def target_of(path):
    """The path where the symbolic links that start at `path` end, whether or not a file exists there."""
    for _ in range(MAX_LINKS):
        if own_descriptor(path) is not None or not os.path.islink(path):
            return path
        path = os.path.join(os.path.dirname(path), os.readlink(path))
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))


def place_of(path):
    """The identity of a file, whatever its name, as in libpipeline/text/output_file.h; `-` is standard input.
    None for a device or a socket, which may be named twice, unless it is an open file of this process."""
    try:
        target = target_of(path)
        own = 0 if path == "-" else own_descriptor(target)
        try:
            status = os.stat(target) if own is None else os.fstat(own)
        except FileNotFoundError:
            folder = os.path.dirname(target) or os.curdir
            if not os.path.isdir(folder):  # a command may make it, also before `..`
                real = os.path.realpath(target)
                return place_of(real) if os.path.isdir(os.path.dirname(real)) else real
            status = os.stat(folder)
            return status.st_dev, status.st_ino, os.path.basename(target)
    except OSError:
        return None
    kind = stat.S_IFMT(status.st_mode)
    return own if kind in (stat.S_IFCHR, stat.S_IFBLK, stat.S_IFSOCK) else (status.st_dev, status.st_ino, "")


class OutputFile:
    """The file is written beside its target, in the same folder and under an unpredictable name; `commit`
    moves it to the target. Without `commit`, the end of the `with` removes it, and an older file stays.

    A new file gets the permissions that the umask leaves; a replaced one keeps its own, and a read-only one
    is not replaced. A symbolic link stays, and the file it points at is replaced. An existing file that is
    not regular (a device, a pipe), /dev/stdout and the like are written directly.
    """
    def __init__(self, path):
        self.path = os.fspath(path)
        self.temporary = None  # the path it is written to; None if directly
        self.descriptor = status = None
        with errors("open", self.path, OutputError):
            self.target = target_of(self.path)
            own = own_descriptor(self.target)
            with contextlib.suppress(FileNotFoundError):
                status = os.stat(self.target)
            if own is not None:
                self.descriptor = os.dup(own)
            elif status and not stat.S_ISREG(status.st_mode):
                self.descriptor = os.open(self.target, os.O_WRONLY | os.O_NOCTTY | os.O_CLOEXEC)
            elif status and not os.access(self.target, os.W_OK):
                raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
            elif not self.target:
                raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
            else:
                self.open_beside(status)

    def open_beside(self, status):
        mode = stat.S_IMODE(status.st_mode) & 0o777 if status else 0o666
        folder, extension = os.path.dirname(self.target), os.path.splitext(self.target)[1]
        extension = extension if len(extension) <= 8 else ""  # none that names a format
        name = os.path.join(folder, f".pipeline-{secrets.token_hex(8)}{extension}")
        leftovers.add(name)
        self.descriptor = os.open(name, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, mode)
        self.temporary = name
        if status:  # the umask does not apply to an existing file
            with contextlib.suppress(OSError):
                os.fchmod(self.descriptor, mode)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        with contextlib.suppress(OSError):
            if self.descriptor is not None:
                os.close(self.descriptor)
        if self.temporary:
            with contextlib.suppress(OSError):
                os.unlink(self.temporary)

    def write(self, data):
        rest = memoryview(data)
        with errors("write", self.path, OutputError):
            while rest:
                rest = rest[os.write(self.descriptor, rest):]

    def copy(self, file):
        """Writes the rest of an open file."""
        while block := file.read(1 << 20):
            self.write(block)

    def close(self):
        with errors("write", self.path, OutputError):
            descriptor, self.descriptor = self.descriptor, None
            if descriptor is not None:
                os.close(descriptor)

    def commit(self):
        self.close()
        if self.temporary:
            with errors("replace", self.path, OutputError):
                os.replace(self.temporary, self.target)
            self.temporary = None


def write_file(path, data):
    """Writes the bytes as the complete content of a file."""
    with OutputFile(path) as file:
        file.write(data)
        file.commit()


def commit_all(files):
    """Puts OutputFiles in place together, whatever signal comes meanwhile."""
    for file in files:
        file.close()
    with unbroken():
        for file in files:
            file.commit()


@contextlib.contextmanager
def replaced_at_end(*paths, others=()):
    """Temporary paths beside `paths` for tools to write to. The files replace those at `paths` if the block
    succeeds, and the OutputFiles `others` appear; errors name `paths`. Devices, pipes and files that cannot
    be written are left to the tools."""
    with contextlib.ExitStack() as stack:
        files = {}
        for path in paths:
            with contextlib.suppress(OutputError):
                if path not in (None, "-") and (os.path.isfile(path) or not os.path.exists(path)):
                    files[path] = stack.enter_context(OutputFile(path))
        beside = {path: file.temporary for path, file in files.items() if file.temporary}
        with renaming({temporary: path for path, temporary in beside.items()}):
            yield [beside.get(path, path) for path in paths]
        commit_all([*(files[path] for path in beside), *others])


def expect_writable(path):
    """Raises the OutputError that writing would end in, before there is any work; a pipe is left alone."""
    if not stat.S_ISFIFO(os.stat(path).st_mode if os.path.exists(path) else 0):
        OutputFile(path).__exit__()


@contextlib.contextmanager
def output_files(folder, names):
    """OutputFiles in a folder, which is made if necessary; without a commit, nothing that was made stays."""
    made, missing = [], os.fspath(folder)  # with its `..`, as the system reads it
    while missing and not os.path.lexists(missing):
        made.append(missing)
        missing = os.path.dirname(missing)
    try:
        make_folders(folder)
        with contextlib.ExitStack() as stack:
            yield [stack.enter_context(OutputFile(os.path.join(folder, name))) for name in names]
    finally:
        for path in made:
            with contextlib.suppress(OSError):  # it is not empty, or `..`
                os.rmdir(path)


def make_folders(path):
    with errors("make the folder", path, OutputError):
        os.makedirs(path, exist_ok=True)
