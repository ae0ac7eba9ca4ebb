"""A progress bar on stderr, if that is a terminal."""
import sys

CELLS = 30


class Progress:
    def __init__(self, total):
        self.total, self.done = total, 0
        self.is_shown = sys.stderr is not None and sys.stderr.isatty()

    def step(self):
        self.reach(self.done + 1)

    def reach(self, done):
        self.done = done
        self.show()

    def show(self):
        if self.is_shown:
            filled = CELLS * self.done // max(1, self.total)
            print(f"\r[{'#' * filled}{'.' * (CELLS - filled)}] {self.done}/{self.total}", end="",
                  file=sys.stderr, flush=True)

    def __enter__(self):
        self.show()
        return self

    def __exit__(self, *_):
        if self.is_shown:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
