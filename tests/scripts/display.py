"""An X server without a screen, for windows that nobody sees."""
import importlib.util
import os
import shutil
import subprocess

MISSING = [name for name, is_there in (("python3-tk", importlib.util.find_spec("tkinter") and importlib.util.find_spec("_tkinter")),
                                       ("xvfb", shutil.which("Xvfb"))) if not is_there]


class Display:
    """Sets DISPLAY within the `with` block."""

    def __enter__(self):
        reader, writer = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                                       pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as number:
            os.environ["DISPLAY"] = ":" + number.readline().strip()
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait(30)
