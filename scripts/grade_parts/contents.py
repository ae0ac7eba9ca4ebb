"""The contents of a hand-in: a folder or an archive, whose files are listed and read in memory. Nothing is
unpacked to the disk, no link is followed, and no more is read than a limit allows."""
import contextlib
import functools
import gzip
import io
import os
import stat
import tarfile
import zipfile

from lib.rim.command import shown

MOST_FILES = 20_000
LONGEST_NAME = 200  # as a remark has it
MOST_DEPTH = 12  # folders inside each other
MOST_BYTES = 1 << 28  # of an archive, and of what a compressed tar swells to
MOST_ARCHIVES = 4  # in a hand-in
SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz")
UNREAD = (".rar", ".7z", ".tar.xz", ".txz", ".tar.bz2", ".tbz2", ".tar.zst")  # archives, but not read
OTHERS = {  # how they begin
    b"Rar!": "RAR", b"7z\xbc\xaf": "7-Zip", b"\xfd7zX": "xz", b"BZh": "bzip2",
    b"\x28\xb5\x2f\xfd": "Zstandard"}
IRREGULAR = ("devices and pipes", "links")  # by whether an entry is a link
FLAGS = os.O_RDONLY | os.O_CLOEXEC | os.O_NOCTTY | os.O_NONBLOCK | os.O_NOFOLLOW


class ContentsError(Exception):
    """A hand-in that cannot be read; the text says why."""


def without_suffix(name):
    suffix = next(filter(name.lower().endswith, (*SUFFIXES, *UNREAD)), "")
    return name[:len(name) - len(suffix)] or name


class Contents:
    """The regular files, as `paths` of tuples of names; `remarks` list the other entries. Archives among the
    files, as Moodle hands them out, are read, too, but not archives within these."""
    def __init__(self):
        self.files, self.skipped, self.inner, self.failed = {}, {}, {}, []

    @property
    def paths(self):
        return [*self.files, *(path for path in self.inner if path not in self.files)]

    @property
    def remarks(self):
        return [
            f"{count} {'entry' if count == 1 else 'entries'} not looked at: {why}"
            for why, count in self.skipped.items()] + self.failed

    def look_into_archives(self):
        archives = [path for path in sorted(self.files) if path[-1].lower().endswith(SUFFIXES)]
        for path in archives[:MOST_ARCHIVES]:
            try:
                data = self.data(path, MOST_BYTES)
                if len(data) > MOST_BYTES:
                    raise ContentsError(f"it is larger than {MOST_BYTES >> 20} MiB")
                archive = archive_of(io.BytesIO(data))
            except MemoryError:
                raise
            except Exception as error:  # whatever zipfile, tarfile and zlib raise for what is no archive
                reason = str(error) if isinstance(error, ContentsError) else NO_ARCHIVE.format(error)
                self.failed.append(f"{shown('/'.join(path))[:LONGEST_NAME]}: {reason}"[:2 * LONGEST_NAME])
                continue
            del self.files[path]
            for parts in archive.paths:
                self.inner[(*path[:-1], without_suffix(path[-1]), *parts)] = archive, parts
            for why, count in archive.skipped.items():
                self.skipped[why] = self.skipped.get(why, 0) + count
            check_count(len(self.files) + len(self.inner))

    def data(self, path, limit):
        """At most limit + 1 bytes of a file."""
        archive, parts = (self, path) if path in self.files else self.inner[path]
        with archive.files[parts]() as file:
            return file.read(limit + 1)

    def add(self, parts, opened, is_regular, kind=""):
        """Notes an entry, which `opened` opens, unless it is hidden or __MACOSX."""
        if any(part.startswith(".") and part != ".." or part == "__MACOSX" for part in parts):
            return
        why = "their paths lead out" if ".." in parts or not parts else "" if is_regular else kind
        why = why or (f"more than {MOST_DEPTH} folders deep" if len(parts) > MOST_DEPTH + 1 else "")
        if why:
            self.skipped[why] = self.skipped.get(why, 0) + 1
        else:
            self.files[parts] = opened
            check_count(len(self.files))


def check_count(count):
    if count > MOST_FILES:
        raise ContentsError(f"it holds more than {MOST_FILES} files")


def parts_of(name):
    """The path of an archive's member; empty if it is absolute."""
    name = name.replace("\\", "/")
    return () if name.startswith("/") or name[1:3] == ":/" else tuple(
        part for part in name.split("/") if part not in ("", "."))


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
                    opened = functools.partial(self.opened, here)
                    self.add(here, opened, entry.is_file(follow_symlinks=False),
                             IRREGULAR[entry.is_symlink()])
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

    def opened(self, parts):
        """A regular file, opened by way of its folders, none of them by a link."""
        descriptor = self.root
        with contextlib.ExitStack() as stack:
            for i, name in enumerate(parts, 1):
                flags = FLAGS | (os.O_DIRECTORY if i < len(parts) else 0)
                descriptor = os.open(name, flags, dir_fd=descriptor)
                stack.callback(os.close, descriptor)
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                raise ContentsError("not a regular file")
            return os.fdopen(os.dup(descriptor), "rb")


def zip_contents(file):
    found, archive = Contents(), zipfile.ZipFile(file)
    check_count(len(archive.infolist()))
    for info in archive.infolist():
        if not info.filename.endswith("/"):
            kind, opened = stat.S_IFMT(info.external_attr >> 16), functools.partial(archive.open, info)
            is_regular = kind in (0, stat.S_IFREG)
            found.add(parts_of(info.filename), opened, is_regular, IRREGULAR[kind == stat.S_IFLNK])
    return found


def tar_contents(file):
    found, archive = Contents(), tarfile.open(fileobj=file, mode="r:")
    for count, member in enumerate(archive, 1):
        check_count(count)
        if not member.isdir():
            opened, is_link = functools.partial(archive.extractfile, member), member.issym() or member.islnk()
            found.add(parts_of(member.name), opened, member.isreg(), IRREGULAR[is_link])
    return found


def unpacked(file):
    """The tar file in a .tar.gz."""
    data = gzip.GzipFile(fileobj=file).read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise ContentsError(f"it swells to more than {MOST_BYTES >> 20} MiB")
    return io.BytesIO(data)


NO_ARCHIVE = "it cannot be read as an archive ({0.__class__.__name__})"


def archive_of(file):
    begin = file.read(4)
    file.seek(0)
    kind = next((name for start, name in OTHERS.items() if begin.startswith(start)), "")
    if kind:
        raise ContentsError(f"a {kind} archive is not read: expected a folder, .zip, .tar or .tar.gz")
    if begin.startswith(b"PK"):
        return zip_contents(file)
    return tar_contents(unpacked(file) if begin.startswith(b"\x1f\x8b") else file)


def contents_of(path):
    """The Contents of a folder or an archive; raises a ContentsError."""
    try:
        contents = outer_contents(path)
        contents.look_into_archives()
        return contents
    except (ContentsError, MemoryError):
        raise
    except OSError as error:
        raise ContentsError("a link is not followed" if os.path.
                            islink(path) else error.strerror or "it cannot be read as an archive") from None
    except Exception as error:  # whatever zipfile, tarfile and zlib raise for what is no archive
        raise ContentsError(NO_ARCHIVE.format(error)) from None


def outer_contents(path):
    if os.path.isdir(path) and not os.path.islink(path):
        return FolderContents(path)
    file = os.fdopen(os.open(path, FLAGS), "rb")
    status = os.fstat(file.fileno())
    if not stat.S_ISREG(status.st_mode):
        raise ContentsError("expected a folder or an archive")
    if status.st_size > MOST_BYTES:
        raise ContentsError(f"it is larger than {MOST_BYTES >> 20} MiB")
    return archive_of(file)
