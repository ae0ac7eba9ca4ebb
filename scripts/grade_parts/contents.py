"""What a hand-in holds: a folder or an archive, whose files are listed and read in memory. Nothing is
unpacked to the disk, no link is followed, and no more is read than a limit allows."""
import gzip
import io
import os
import stat
import tarfile
import zipfile

MOST_FILES = 20_000
MOST_DEPTH = 12             # folders inside each other
MOST_BYTES = 1 << 28        # of an archive, and of what a compressed tar swells to
SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz")
FLAGS = os.O_RDONLY | os.O_CLOEXEC | os.O_NOCTTY | os.O_NONBLOCK | os.O_NOFOLLOW


class ContentsError(Exception):
    """A hand-in that cannot be read; the text says why."""


class Contents:
    """`paths` are those of the regular files, as tuples of names; `remarks` tell what else there was."""

    def __init__(self):
        self.files, self.skipped = {}, {}

    @property
    def paths(self):
        return list(self.files)

    @property
    def remarks(self):
        return [
            f"{count} {'entry' if count == 1 else 'entries'} not looked at: {why}"
            for why, count in self.skipped.items()]

    def add(self, parts, handle, is_regular, kind=""):
        """Notes an entry, unless it is one that is passed over."""
        if any(part.startswith(".") and part != ".." or part == "__MACOSX" for part in parts):
            return
        why = "their paths lead out" if ".." in parts or not parts else "" if is_regular else kind
        why = why or (f"more than {MOST_DEPTH} folders deep" if len(parts) > MOST_DEPTH + 1 else "")
        if why:
            self.skipped[why] = self.skipped.get(why, 0) + 1
        else:
            self.files[parts] = handle
            check_count(len(self.files))


def check_count(count):
    if count > MOST_FILES:
        raise ContentsError(f"it holds more than {MOST_FILES} files")


def parts_of(name):
    """The path of an archive's member; empty if it is absolute."""
    name = name.replace("\\", "/")
    return () if name.startswith("/") or name[1:3] == ":/" else tuple(part for part in name.split("/")
                                                                      if part not in ("", "."))


class FolderContents(Contents):
    def __init__(self, path):
        super().__init__()
        self.root = os.open(path, FLAGS | os.O_DIRECTORY)
        self.entries = 0
        self.list_folder((), self.root)

    def list_folder(self, parts, descriptor):
        folders = []
        with os.scandir(descriptor) as entries:
            for entry in entries:
                self.entries += 1
                check_count(self.entries)
                here = (*parts, entry.name)
                if entry.is_dir(follow_symlinks=False):
                    folders.append(here)
                else:
                    self.add(here, here, entry.is_file(follow_symlinks=False),
                             "links" if entry.is_symlink() else "devices and pipes")
        for here in folders:
            if len(here) > MOST_DEPTH:
                self.add((*here, ""), None, False, "deeper folders")
                continue
            try:
                inner = os.open(here[-1], FLAGS | os.O_DIRECTORY, dir_fd=descriptor)
            except OSError as error:
                self.add(here, None, False, error.strerror)
                continue
            try:
                self.list_folder(here, inner)
            finally:
                os.close(inner)

    def read(self, parts, limit):
        """At most limit + 1 bytes of a file."""
        descriptor = os.dup(self.root)
        try:
            for i, name in enumerate(parts):
                inner = os.open(name, FLAGS | (os.O_DIRECTORY if i < len(parts) - 1 else 0),
                                dir_fd=descriptor)
                os.close(descriptor)
                descriptor = inner
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                raise ContentsError("not a regular file")
            with os.fdopen(os.dup(descriptor), "rb") as file:
                return file.read(limit + 1)
        finally:
            os.close(descriptor)


class ZipContents(Contents):
    def __init__(self, file):
        super().__init__()
        self.archive = zipfile.ZipFile(file)
        check_count(len(self.archive.infolist()))
        for info in self.archive.infolist():
            if not info.filename.endswith("/"):
                kind = stat.S_IFMT(info.external_attr >> 16)
                self.add(parts_of(info.filename), info, kind in (0, stat.S_IFREG),
                         "links" if kind == stat.S_IFLNK else "devices and pipes")

    def read(self, parts, limit):
        with self.archive.open(self.files[parts]) as file:
            return file.read(limit + 1)


class TarContents(Contents):
    def __init__(self, file):
        super().__init__()
        self.archive = tarfile.open(fileobj=file, mode="r:")
        for count, member in enumerate(self.archive, 1):
            check_count(count)
            if not member.isdir():
                self.add(parts_of(member.name), member, member.isreg(),
                         "links" if member.issym() or member.islnk() else "devices and pipes")

    def read(self, parts, limit):
        return self.archive.extractfile(self.files[parts]).read(limit + 1)


def unpacked(file):
    """The tar in a compressed one."""
    data = gzip.GzipFile(fileobj=file).read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ContentsError(f"it swells to more than {MOST_BYTES >> 20} MiB")
    return io.BytesIO(data)


def contents_of(path):
    """The Contents of a folder or an archive; raises a ContentsError."""
    try:
        if os.path.isdir(path) and not os.path.islink(path):
            return FolderContents(path)
        file = os.fdopen(os.open(path, FLAGS), "rb")
        status = os.fstat(file.fileno())
        if not stat.S_ISREG(status.st_mode):
            raise ContentsError("expected a folder or an archive")
        if status.st_size > MOST_BYTES:
            raise ContentsError(f"it is larger than {MOST_BYTES >> 20} MiB")
        begin = file.read(2)
        file.seek(0)
        if begin == b"PK":
            return ZipContents(file)
        return TarContents(unpacked(file) if begin == b"\x1f\x8b" else file)
    except ContentsError:
        raise
    except MemoryError:
        raise
    except OSError as error:
        raise ContentsError("a link is not followed" if os.path.
                            islink(path) else error.strerror or "it cannot be read as an archive") from None
    except Exception as error:  # whatever zipfile, tarfile and zlib raise for an archive that is none
        raise ContentsError(f"it cannot be read as an archive ({type(error).__name__})") from None
