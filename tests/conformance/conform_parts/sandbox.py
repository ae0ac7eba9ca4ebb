"""A program's view in a sandbox of bubblewrap: read-only the system and what belongs to the program,
and the folder that it may write."""
import os
import pathlib
import re
import stat
import sys
import tempfile

# What a program in a folder `bin` needs of its installation.
BESIDE_BIN = ("lib", "lib64", "libexec", "conf", "pyvenv.cfg")
DEVICES = ("null", "zero", "full", "random", "urandom", "tty")  # those that bubblewrap takes from the system
SYSTEM = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/usr", "/etc", "/opt", "/nix", "/gnu")
PATH_IN_TEXT = re.compile(r"""(?<![^\s'"=:,;|&<>(])/[^\s'"=:,;|&<>()]+""")  # of the shell, or of a list


def words_for(command, paths, hidden):
    """Words of bubblewrap for a command that may read further paths, but nothing below `hidden`."""
    words = ["--unshare-all", "--die-with-parent", "--cap-drop", "ALL"]
    # Root's number opens the settings in /proc/sys without a capability.
    words += [*system_words(), "--proc", "/proc", "--remount-ro", "/proc", "--dev", "/dev"]
    paths = sorted({*needed(command), *map(os.path.abspath, paths)})
    for path in paths:
        words += ["--ro-bind", path, path]
    hidden = [os.path.realpath(path) for path in hidden if path.is_dir()]
    names = [(path, os.path.relpath(each, os.path.realpath(path))) for path in paths for each in hidden]
    below = [
        os.path.join(path, name) for path, name in names if not name.startswith("..")]  # through links, too
    for path in without_those_inside({*hidden, *below}):  # bubblewrap makes none in what is hidden
        words += ["--tmpfs", path, "--remount-ro", path]
    folders = [
        each for each in os.get_exec_path()
        if not any(is_below(os.path.realpath(each), path) for path in hidden)]
    return [*words, "--setenv", "PATH", os.pathsep.join(folders)]


def folders_of_tools(command=None, read=()):
    """Folders of our own tools, which give the right answer: $BIN, that of the command that runs, those
    beside the pack and those on the PATH, and where links in them lead. None that holds the system's
    programs, or that a command for the sandbox names, or what it may read: it calls them on purpose."""
    top = pathlib.Path(__file__).resolve().parents[3]
    folders = [
        os.environ.get("BIN") or "/nowhere",
        os.path.dirname(sys.argv[0]), top / "build/release/bin", top.parent / "libexec/pipeline"]
    folders += [each for each in os.get_exec_path() if os.path.exists(os.path.join(each, "trace"))]
    found = set()
    for folder in folders:
        if os.path.exists(os.path.join(folder, "zbuf")):
            tools = (os.path.join(folder, tool) for tool in ("zbuf", "model", "view", "project"))
            found.update([os.path.realpath(folder), *(os.path.dirname(os.path.realpath(x)) for x in tools)])
    named = ""
    if command:
        program = os.path.realpath(command[0])
        named = " ".join((*command, program, *map(os.path.realpath, read)))
        if os.path.basename(program) == "pipeline":
            named += f" {os.path.dirname(os.path.dirname(program))}/libexec/pipeline/tools"
    return [path for path in sorted(found) if path not in named and not os.path.exists(f"{path}/sh")]


def without_those_inside(paths):
    """The paths that lie in no other one of them, sorted."""
    return sorted(path for path in paths if not any(path.startswith(other + "/") for other in paths))


def is_below(path, folder):
    return os.path.commonpath((path, folder)) == folder


def words_of_folder(folder, words):
    """These, with the folder that the program may write, also where libraries share memory."""
    uses_memory = any(str(word).startswith("/dev/shm/") for word in (folder, *words))
    shared = [] if uses_memory else ["--bind", folder, "/dev/shm"]
    return [
        *words, *shared, *device_words(pathlib.Path(folder).parent / "dev"), "--bind", folder, folder,
        "--remount-ro", "/dev", "--remount-ro", "/", "--chdir", folder, "--"]


def device_words(folder):
    """Words of bubblewrap that put devices in a folder in place of the system's, whose modes root's number
    changes without a capability. None where the system's are not its own, or these could not be opened."""
    words = []
    if os.getuid() != 0:
        return words
    try:
        os.makedirs(folder, exist_ok=True)
        for name in DEVICES:
            path = folder / name
            if not path.exists():
                os.mknod(path, stat.S_IFCHR, os.stat(f"/dev/{name}").st_rdev)
                os.chmod(path, 0o666)
            words += ["--dev-bind", path, f"/dev/{name}"]
        os.close(os.open(folder / "null", os.O_WRONLY))
    except OSError:
        return []
    return words


def system_words():
    """Words of bubblewrap that show the system's folders, of /etc what everybody may read."""
    words = []
    for path in filter(os.path.exists, SYSTEM):
        words += ["--symlink", os.readlink(path), path] if os.path.islink(path) else ["--ro-bind", path, path]
    return words + (hiding_words("/etc") if os.getuid() == 0 else [])


def hiding_words(folder):
    """Words of bubblewrap that hide what not everybody may read in a folder."""
    words = []
    for entry in os.scandir(folder):
        if entry.is_symlink():
            continue
        if not entry.stat().st_mode & stat.S_IROTH:
            empty = ["--tmpfs", entry.path, "--remount-ro"] if entry.is_dir() else ["--ro-bind", os.devnull]
            words += [*empty, entry.path]
        elif entry.is_dir():
            words += hiding_words(entry.path)
    return words


def needed(command):
    """The paths that a command reads: the folders of its files and those on the PATH, with the installations
    that they are the `bin` of. Of a folder of many things, such as the home, it is the files alone."""
    shared = [os.path.expanduser("~"), tempfile.gettempdir(), "/tmp", "/var/tmp", "/home/any"]

    def is_shared(folder):
        real = os.path.realpath(folder)
        return any(os.path.commonpath((real, os.path.realpath(path))) == real for path in shared)

    named = [path for word in command for path in (word, *PATH_IN_TEXT.findall(word)) if os.path.isabs(path)]
    paths = {folder for folder in os.get_exec_path() if os.path.isabs(folder) and os.path.isdir(folder)}
    for path in {*named, *map(os.path.realpath, named)}:
        folder = path if os.path.isdir(path) else os.path.dirname(path)
        if os.path.exists(path):
            paths.add(path if is_shared(folder) else folder)
    paths |= {
        beside
        for path in paths if os.path.basename(path) == "bin" for name in BESIDE_BIN
        if os.path.exists(beside := os.path.join(os.path.dirname(path), name))}
    there = re.compile(rf"({'|'.join(SYSTEM)}|/dev(?!/shm)|/proc)(/|$)")
    return without_those_inside({path for path in paths if not is_shared(path) and not there.match(path)})
