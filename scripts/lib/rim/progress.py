"""A progress bar on stderr, if that is a terminal."""
import sys
import time

CELLS = 30


class Progress:
    """Progress through a number of steps; `in_per_cent` shows the share that is done and the time left, as if
    all steps were equally long."""
    def __init__(self, total, in_per_cent=False):
        self.total, self.done, self.in_per_cent = total, 0, in_per_cent
        self.begin = time.monotonic()
        self.is_shown = sys.stderr is not None and sys.stderr.isatty()

    def step(self):
        self.reach(self.done + 1)

    def reach(self, done):
        self.done = done
        self.show()

    def told(self):
        if not self.in_per_cent:
            return f"{self.done}/{self.total}"
        seconds = time.monotonic() - self.begin
        left = f", {seconds * (self.total - self.done) / self.done:.0f} s left" if self.done else ""
        return f"{self.done / self.total:.0%}{left}"

    def show(self):
        if self.is_shown:
            filled = CELLS * self.done // max(1, self.total)
            print(f"\r[{'#' * filled}{'.' * (CELLS - filled)}] {self.told()}\033[K", end="", file=sys.stderr,
                  flush=True)

    def __enter__(self):
        self.show()
        return self

    def __exit__(self, *_):
        if self.is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
