"""The files of results that a run writes."""
import contextlib
import errno
import os
import pathlib
import secrets
import stat

from . import confined


class ResultFile:
    """An open device or pipe, or a path without links: opened before a program can replace it. `option` and
    `name` are as the caller has typed them."""
    def __init__(self, option, name):
        self.option, self.name, self.stream = option, name, None
        with self.errors():
            if os.path.exists(name) and not os.path.isfile(name):
                self.stream = open(name, "w", encoding="utf-8")
            elif os.path.exists(name) and not os.access(name, os.W_OK):
                raise OSError(errno.EACCES, os.strerror(errno.EACCES))
        self.path = pathlib.Path(name).resolve()

    @contextlib.contextmanager
    def errors(self):
        try:
            yield
        except OSError as error:
            raise OSError(error.errno, error.strerror, self.name) from None

    def write(self, text):
        """Writes text, to a path completely or not at all, in place of whatever is there."""
        part = None if self.stream else self.path.with_name(f".{secrets.token_hex(8)}{self.path.suffix}")
        try:
            with self.errors(), self.stream or open(part, "x", encoding="utf-8") as stream:
                stream.write(text)
                if part and self.path.exists():
                    os.chmod(part, stat.S_IMODE(self.path.stat().st_mode) & 0o777)
            if part:
                with self.errors():
                    part.replace(self.path)
        finally:
            if part:
                part.unlink(missing_ok=True)


def expect_separate(files, command):
    """Raises a confined.Refused if results would replace or join standard output, a file of the command, or
    one another. `files` are pairs of an option and a name."""
    for option, name in files:
        others = ["standard output", *command, *(other for _, other in files if other is not name)]
        for other in others:
            with contextlib.suppress(OSError):
                is_same = os.path.samestat(os.stat(name), os.stat(1 if other == "standard output" else other))
                if is_same and not stat.S_ISCHR(os.stat(name).st_mode):
                    raise confined.Refused(
                        f"{option} {name}: expected a place of its own, found that of {other}")
    paths = [os.path.realpath(name) for _, name in files]
    if len(set(paths)) < len(paths):
        (first, _), (option, name) = files
        raise confined.Refused(f"{option} {name}: expected a place of its own, found that of {first}")
