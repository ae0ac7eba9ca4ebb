"""A folder that a command works in and may remove: new or empty at first, and marked from then on."""
import contextlib
import fcntl
import os
import pathlib
import stat

from lib.rim.command import CommandFailure, shown
from lib.rim.output_file import OutputError, make_folders, write_file

OURS = ".pipeline-"  # so begin a mark, and what a tool that was killed may leave


class WorkFolder:
    """The mark is an empty file that names the command. It stays for a retry, and goes with the folder."""
    def __init__(self, path, command):
        self.path, self.command = pathlib.Path(path), command
        self.mark = self.path / (OURS + command)
        self.lock = None  # a descriptor of the mark

    def __truediv__(self, name):
        return self.path / name

    def take(self):
        """Makes the folder, or takes one that is empty or has the mark. Any other is an error."""
        make_folders(self.path.parent)
        try:
            with contextlib.suppress(FileExistsError):
                os.mkdir(self.path)
            self.expect_ours()
            self.lock = os.open(self.mark, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if not (self.mark.exists() and os.path.samestat(os.fstat(self.lock), os.lstat(self.mark))):
                os.close(self.lock)  # another run has just removed the folder
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
            raise CommandFailure(f"expected a new or empty folder, or one that {self.command} has made, "
                                 f"found {name}, which holds {shown(names[0])}")

    def write(self, name, data):
        if is_other(self / name):
            (self / name).unlink()
        try:
            write_file(self / name, data)
        except OutputError:
            self.remove(lambda _: False)  # where it holds nothing but the mark
            raise

    def remove_files(self, is_own):
        """Removes files by their paths in the folder, and folders that this leaves empty."""
        for folder, _, files in os.walk(self.path, topdown=False):
            paths = [os.path.join(folder, name) for name in files]
            own = [
                path for path in paths if path != str(self.mark) and is_own(os.path.relpath(path, self.path))]
            for path in own:
                os.unlink(path)
            while own and folder != str(self.path):
                try:
                    os.rmdir(folder)
                except OSError:
                    break
                folder = os.path.dirname(folder)

    def remove_others(self, is_own):
        """Removes links, not what they point at, pipes and devices, where there will be files or folders."""
        for folder, folders, files in os.walk(self.path):
            for path in (os.path.join(folder, name) for name in folders + files):
                if is_other(path) and is_own(os.path.relpath(path, self.path)):
                    os.unlink(path)

    def remove(self, is_own):
        """Removes the folder; if others have put something into it, all but that and the mark."""
        self.remove_files(lambda name: is_own(name) or os.path.basename(name).startswith(OURS))
        if self.path.exists() and os.listdir(self.path) == [self.mark.name]:
            os.unlink(self.mark)
            os.rmdir(self.path)


def is_other(path):
    """True if it is a link, a pipe or a device, which is not ours, nor is a link's target."""
    return os.path.lexists(path) and stat.S_IFMT(os.lstat(path).st_mode) not in (stat.S_IFREG, stat.S_IFDIR)
