"""Processes that work side by side and end with all that they have started, also with what has left its
parents and its session."""
import collections
import contextlib
import ctypes
import json
import os
import signal
import sys
import time
import traceback
from multiprocessing.connection import Pipe, wait

PATIENCE = 30  # seconds beyond its limit in which a process must answer, and in which the killed must end
INTERVAL = 0.002  # seconds between two looks at whether the killed have ended
PR_SET_PDEATHSIG, PR_SET_DUMPABLE, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 1, 4, 36, 38
LIBC = ctypes.CDLL(None)


def prctl(option, value):
    if hasattr(LIBC, "prctl"):  # only Linux has it
        LIBC.prctl(option, ctypes.c_ulong(value), 0, 0, 0)


@contextlib.contextmanager
def first_in_line():
    """Within, this process runs before all ordinary ones, where the system lets it (root): thousands of
    processes that a program starts do not keep it from ending them. What it starts is ordinary."""
    with contextlib.suppress(AttributeError, OSError):
        os.sched_setscheduler(0, os.SCHED_RR | os.SCHED_RESET_ON_FORK, os.sched_param(1))
    try:
        yield
    finally:
        with contextlib.suppress(AttributeError, OSError):
            os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))


def descendants(keep=(), most=sys.maxsize):
    """The processes that this one has started, and that those have, but for those of `keep` and theirs. No
    more are looked for once there are more than `most`."""
    found, todo = [], [os.getpid()]
    while todo and len(found) <= most:
        with contextlib.suppress(OSError):
            folder = f"/proc/{todo.pop()}/task"
            for task in os.listdir(folder):
                with open(f"{folder}/{task}/children") as file:
                    children = [pid for pid in map(int, file.read().split()) if pid not in keep]
                found += children
                todo += children
    return found


def end_all(keep=()):
    """Ends the descendants of this process, also those that have left their parents and their session."""
    end, ended = time.monotonic() + PATIENCE, set()
    while (pids := descendants(keep)) and time.monotonic() < end:
        if ended.issuperset(pids):  # they are killed, and about to end
            time.sleep(INTERVAL)
        ended.update(pids)
        for pid in pids:
            with contextlib.suppress(OSError):
                os.kill(pid, signal.SIGKILL)
        for pid in pids:
            with contextlib.suppress(OSError):
                os.waitpid(pid, os.WNOHANG)


class Worker:
    """A process that answers a number by task(number), as JSON: a program that gets hold of the connection
    can send data alone."""
    def __init__(self, task, others):
        self.connection, theirs = Pipe()
        self.pid = os.fork()
        if not self.pid:
            # So that the connection ends with the process that began it, even if that is killed before this
            # one has asked to be told.
            for worker in (self, *others):
                worker.connection.close()
            serve(theirs, task)
        theirs.close()

    def give(self, number, seconds):
        self.number, self.end = number, time.monotonic() + seconds + PATIENCE
        with contextlib.suppress(OSError):  # it may have been killed
            self.connection.send_bytes(b"%d" % number)

    def answer(self):
        try:
            return json.loads(self.connection.recv_bytes())
        except (EOFError, OSError, ValueError, RecursionError):
            return None


def serve(connection, task):
    """The life of a Worker."""
    def stop(number, _):  # no signal is ignored, as that would pass on to the programs
        if number == signal.SIGTERM:
            raise SystemExit

    try:
        os.setpgid(0, 0)  # so that who kills its parent's group leaves it to end what it has started
        prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
        prctl(PR_SET_CHILD_SUBREAPER, 1)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, stop)
        with contextlib.suppress(EOFError, BrokenPipeError, ConnectionError, SystemExit):
            while True:
                connection.send_bytes(json.dumps(task(int(connection.recv_bytes()))).encode())
    except Exception:  # an error of ours
        traceback.print_exc()
    finally:
        os._exit(0)


def spread(task, count, jobs, seconds):
    """Yields task(i), i from 0 to `count` - 1, in order, worked out by `jobs` processes, and read from JSON;
    None where one has been killed or does not answer, `seconds` being what it is given. All that they have
    started ends with them."""
    prctl(PR_SET_CHILD_SUBREAPER, 1)
    prctl(PR_SET_DUMPABLE, 0)  # so that the programs of a user who is not root cannot write here
    left, done, workers = collections.deque(range(count)), {}, []
    try:
        for number in range(count):
            while number not in done:
                while left and len(workers) < jobs:
                    workers.append(Worker(task, workers))
                    workers[-1].give(left.popleft(), seconds)
                ready = wait([worker.connection for worker in workers], timeout=1)
                for worker in list(workers):
                    if worker.connection in ready:
                        done[worker.number] = answer = worker.answer()
                        if answer is not None and left:
                            worker.give(left.popleft(), seconds)
                            continue
                    elif time.monotonic() > worker.end:
                        done[worker.number] = None
                    else:
                        os.kill(worker.pid, signal.SIGCONT)  # a program may have stopped it
                        continue
                    workers.remove(worker)
                    os.kill(worker.pid, signal.SIGKILL)
                    end_all(keep={worker.pid for worker in workers})
            yield done.pop(number)
    finally:
        end_all()
