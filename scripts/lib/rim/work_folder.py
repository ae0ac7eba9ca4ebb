"""A folder that a command works in and may remove: new or empty at first, and marked from then on."""
import contextlib
import fcntl
import os
import pathlib
import stat

from lib.rim.command import CommandFailure, errors, shown, unbroken
from lib.rim.output_file import OutputError, make_folders, write_file

OURS = ".pipeline-"  # how a mark begins, and what a killed tool may leave


class WorkFolder:
    """The mark is a file with the command in its name and, if the folder is no output, its `use`. It stays,
    so that a retry may take the folder, and is removed with it."""
    def __init__(self, path, command, use=""):
        self.path, self.command, self.use = pathlib.Path(path), command, use
        self.mark = self.path / (OURS + command + use)
        self.lock = None  # a descriptor of the mark

    def __truediv__(self, name):
        return self.path / name

    @contextlib.contextmanager
    def taken(self, is_own=lambda _: False):
        """Takes the folder for a block. If the block fails, removes the folder if it holds nothing but the
        mark; and, with its own files, if it was new and an output cannot be written."""
        try:
            with unbroken():
                self.take()
            yield
        except BaseException as failure:
            if self.lock is not None:
                self.remove(is_own) if self.is_new and isinstance(failure,
                                                                  OutputError) else self.remove_bare()
            raise

    def take(self):
        """Makes the folder, or takes one that is empty or has the mark. Any other is an error."""
        make_folders(self.path.parent)
        try:
            with contextlib.suppress(FileExistsError):
                os.mkdir(self.path)
            self.expect_ours()
            self.is_new = not self.mark.exists()
            lock = os.open(self.mark, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if self.mark.exists() and os.path.samestat(os.fstat(lock), os.lstat(self.mark)):
                self.lock = lock
            else:
                os.close(lock)  # another run has just removed the folder
                self.take()
        except BlockingIOError:
            raise CommandFailure(f"another {self.command} works in {shown(self.path)}") from None
        except OSError as error:
            raise CommandFailure(f"cannot make the folder {shown(self.path)}: {error.strerror}") from None

    def expect_ours(self):
        status, name = os.lstat(self.path), shown(self.path)
        if not stat.S_ISDIR(status.st_mode):
            kind = "link" if stat.S_ISLNK(status.st_mode) else "file"
            raise CommandFailure(f"expected a folder, or nothing, found the {kind} {name}")
        if status.st_uid != os.geteuid():  # who could change what is run in it
            raise CommandFailure(f"expected a folder of one's own, found {name} of another user")
        names = sorted(os.listdir(self.path))
        if names and self.mark.name not in names:
            raise CommandFailure(
                f"expected a new or empty folder, or one that {self.command} has made"
                f"{' to work in' * bool(self.use)}, found {name}, which holds {shown(names[0])}")

    def write(self, name, data):
        if is_other(self / name):
            (self / name).unlink()
        write_file(self / name, data)

    def move(self, names, other):
        """Moves files to another folder, in place of those there."""
        for name in names:
            with errors("replace", other / name, OutputError):
                os.replace(self / name, other / name)

    def remove_files(self, is_own):
        """Removes files by their paths in the folder, and folders that this leaves empty."""
        for folder, _, files in os.walk(self.path, topdown=False):
            paths = [os.path.join(folder, name) for name in files]
            own = [
                path for path in paths if path != str(self.mark) and is_own(os.path.relpath(path, self.path))]
            for path in own:
                os.unlink(path)
            if own and folder != str(self.path) and self.mark.exists():
                with contextlib.suppress(OSError):
                    os.removedirs(folder)  # not self.path, which holds the mark

    def remove_others(self, is_own):
        """Removes links (not their targets), pipes and devices where files or folders will be."""
        for folder, folders, files in os.walk(self.path):
            for path in (os.path.join(folder, name) for name in folders + files):
                if is_other(path) and is_own(os.path.relpath(path, self.path)):
                    os.unlink(path)

    def remove(self, is_own):
        """Removes the folder; if others have put something into it, that and the mark stay."""
        self.remove_files(lambda name: is_own(name) or os.path.basename(name).startswith(OURS))
        self.remove_bare()

    def remove_bare(self):
        """Removes the folder if it holds nothing but the mark."""
        if self.path.exists() and os.listdir(self.path) == [self.mark.name]:
            os.unlink(self.mark)
            os.rmdir(self.path)


def is_other(path):
    """True for a link, a pipe or a device: none of these is ours, and neither is what a link leads to."""
    return os.path.lexists(path) and stat.S_IFMT(os.lstat(path).st_mode) not in (stat.S_IFREG, stat.S_IFDIR)
