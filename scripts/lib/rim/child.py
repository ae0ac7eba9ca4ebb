"""Child processes: the stderr and the cost of one, and the end of all."""
import contextlib
import ctypes
import fcntl
import os
import signal
import subprocess
import time

PATIENCE = 3  # seconds before a process that does not end is killed
PR_SET_CHILD_SUBREAPER = 36
MOST_SAID = 1 << 16  # bytes of a process's stderr that are kept
MORE = "(the rest of its stderr is left out)"


class Said:
    """A file in memory for the stderr of a process, which can write little more than `most` bytes: at the
    end of the `with`, `text` is the first of them, and MORE if there were more. The disk may be full, and
    memory too short for a thread that reads a pipe."""
    def __init__(self, most=MOST_SAID):
        self.most = most
        self.file = os.memfd_create("stderr", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        with contextlib.suppress(OSError):  # the system refuses files of this size: no stderr gets there
            os.truncate(self.file, most + MOST_SAID)
            fcntl.fcntl(self.file, fcntl.F_ADD_SEALS, fcntl.F_SEAL_GROW | fcntl.F_SEAL_SHRINK)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        length = min(os.lseek(self.file, 0, os.SEEK_CUR), self.most + 1)
        self.text = beginning(os.pread(self.file, length, 0), self.most)
        os.close(self.file)


def beginning(data, most=MOST_SAID):
    """The first of these bytes, and MORE if there are more."""
    return bytes(data[:most]) + f"\n{MORE}\n".encode() * (len(data) > most)


def run(words, most=MOST_SAID, **settings):
    """subprocess.run, with the stderr of a Said."""
    with Said(most) as said:
        done = subprocess.run(words, stderr=said.file, **settings)
    done.stderr = said.text
    return done


def finished(process):
    """Waits for a subprocess.Popen, sets its returncode, and returns its resource usage
    (resource.struct_rusage), which Popen.wait throws away."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage


def cpu_seconds(usage):
    """User and system."""
    return usage.ru_utime + usage.ru_stime


def adopt_orphans():
    """On Linux, makes this process adopt the orphans of its children, so that end_children finds them."""
    with contextlib.suppress(AttributeError):
        ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def descendants():
    """The processes that this one has started, and their children, by /proc, so only on Linux."""
    children = {}
    for process in filter(str.isdigit, os.listdir("/proc") if os.path.isdir("/proc") else ()):
        with contextlib.suppress(OSError), open(f"/proc/{process}/stat", "rb") as file:
            text = file.read()
            state, parent = text[text.rindex(b")") + 2:].split(None, 2)[:2]
            if state != b"Z":
                children.setdefault(int(parent), []).append(int(process))
    found = [os.getpid()]
    for process in found:
        found += children.get(process, [])
    return found[1:]


def end_children():
    """Ends all processes that this one has started. GNU parallel waits for its jobs until a second signal."""
    start = time.monotonic()
    while (left := descendants()) and time.monotonic() < start + 2 * PATIENCE:
        for process in left:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(process, signal.SIGTERM if time.monotonic() < start + PATIENCE else signal.SIGKILL)
        time.sleep(0.05)
