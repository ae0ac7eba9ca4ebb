"""A progress bar on stderr, if that is a terminal."""
import sys
import time

CELLS = 30


class Progress:
    """Progress through a number of steps; `in_per_cent` shows the share that is done and the time left, as if
    all steps were equally long."""
    def __init__(self, total, in_per_cent=False):
        self.total, self.in_per_cent = total, in_per_cent
        self.begin = time.monotonic()
        self.is_shown = sys.stderr is not None and sys.stderr.isatty()

    def reach(self, done):
        if self.is_shown:
            filled = CELLS * done // max(1, self.total)
            print(f"\r[{'#' * filled}{'.' * (CELLS - filled)}] {self.told(done)}\033[K", end="",
                  file=sys.stderr, flush=True)

    def told(self, done):
        if not self.in_per_cent:
            return f"{done}/{self.total}"
        seconds = time.monotonic() - self.begin
        left = f", {seconds * (self.total - done) / done:.0f} s left" if done else ""
        return f"{done / self.total:.0%}{left}"

    def __enter__(self):
        self.reach(0)
        return self

    def __exit__(self, *_):
        if self.is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
