"""A program of somebody else, run with limits: of time, and of what it may write."""
import contextlib
import errno
import os
import selectors
import signal
import subprocess
import time

BLOCK = 1 << 16
MOST_ERRORS = 1 << 20  # bytes of stderr that are kept, the last ones


class ProgramError(Exception):
    """The program did not do its job; the text says why. `errors` is what it wrote to stderr."""

    def __init__(self, reason, errors=b""):
        super().__init__(reason)
        self.errors = bytes(errors)


class CannotRun(Exception):
    """The program could not be started; the text says why."""


HINTS = {
    errno.EACCES: "; chmod +x makes a file a program",
    errno.ENOEXEC: "; a script begins with a line like #!/usr/bin/env python3",
}


def run_program(words, data, folder, seconds, limit):
    """The stdout and stderr of a program that reads `data` and works in `folder`, in bytes. Raises a CannotRun if it cannot be started,
    and a ProgramError if it takes longer than `seconds`, writes more than `limit` bytes, or fails. What it has started ends with it."""
    outputs = [bytearray(), bytearray()]
    try:
        process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=folder, start_new_session=True)
    except OSError as error:
        raise CannotRun(f"cannot run {words[0]}: {error.strerror}{HINTS.get(error.errno, '')}") from None
    try:
        exchange(process, data, time.monotonic() + seconds, limit, outputs)
        status = process.wait(timeout=seconds)
    except (TimeoutError, subprocess.TimeoutExpired):
        raise ProgramError(f"it is not done after {seconds:g} s", outputs[1]) from None
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        for stream in (process.stdin, process.stdout, process.stderr):
            with contextlib.suppress(OSError):
                stream.close()
    if status != 0:
        raise ProgramError(f"it was ended by signal {-status}" if status < 0 else f"its exit status is {status}", outputs[1])
    return bytes(outputs[0]), bytes(outputs[1])


def exchange(process, data, end, limit, outputs):
    """Writes and reads as far as the program does: into `outputs` its stdout and its stderr, of which only so much is kept."""
    rest = memoryview(data)
    with selectors.DefaultSelector() as selector:
        for stream, event in ((process.stdin, selectors.EVENT_WRITE), (process.stdout, selectors.EVENT_READ), (process.stderr, selectors.EVENT_READ)):
            os.set_blocking(stream.fileno(), False)
            selector.register(stream, event)
        while selector.get_map():
            ready = selector.select(max(0.0, end - time.monotonic()))
            if not ready or time.monotonic() > end:
                raise TimeoutError
            for key, _ in ready:
                if key.fileobj is process.stdin:
                    rest = written(process.stdin, rest)
                    is_done = not rest
                else:
                    which = 0 if key.fileobj is process.stdout else 1
                    block = os.read(key.fd, BLOCK)
                    is_done = not block
                    outputs[which] += block
                    if which == 0 and len(outputs[0]) > limit:
                        raise ProgramError(f"it writes more than {limit} bytes, more than the scene can need", outputs[1])
                    del outputs[1][:-MOST_ERRORS]
                if is_done:
                    selector.unregister(key.fileobj)
                    key.fileobj.close()


def written(stream, rest):
    """What is left to write; nothing if the program does not read on."""
    try:
        return rest[os.write(stream.fileno(), rest[:BLOCK]):]
    except BrokenPipeError:
        return rest[:0]
