"""An X server without a screen, for windows that nobody sees."""
import contextlib
import importlib.util
import os
import shutil
import subprocess

MISSING = [
    name
    for name, is_there in (("python3-tk",
                            importlib.util.find_spec("tkinter") and importlib.util.find_spec("_tkinter")),
                           ("xvfb", shutil.which("Xvfb"))) if not is_there]


class Display:
    """Sets DISPLAY within the `with` block. A process should have only one: Tk keeps its connection for the
    next window, and Xlib ends the whole process when the server of any connection is gone."""
    def __init__(self, *options):
        self.options = options

    def __enter__(self):
        reader, writer = os.pipe()
        # Whatever ends this process ends the server, which would otherwise hold the test's output open.
        self.server = subprocess.Popen([
            "setpriv", "--pdeathsig", "TERM", "Xvfb", "-displayfd",
            str(writer), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", *self.options], pass_fds=[
                writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as number:
            os.environ["DISPLAY"] = ":" + number.readline().strip()
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait(30)


def display_or_none():
    return Display() if shutil.which("Xvfb") else contextlib.nullcontext()
