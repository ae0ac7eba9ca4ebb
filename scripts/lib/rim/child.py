"""Child processes: the cost of one, and the end of all."""
import contextlib
import ctypes
import os
import signal
import time

PATIENCE = 3  # seconds before a process that does not end is killed
PR_SET_CHILD_SUBREAPER = 36


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
