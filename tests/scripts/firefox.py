"""A headless Firefox, driven by its own protocol, Marionette: a length, a colon and JSON, over a socket."""
import json
import pathlib
import shutil
import socket
import subprocess
import tempfile

from browser import ELEMENT, Browser

MISSING = [] if shutil.which("firefox-esr") else ["firefox-esr"]


class Firefox:
    """Like Browser, as far as the tests of a page need it."""

    wait_for, __enter__ = staticmethod(Browser.wait_for), Browser.__enter__

    def __init__(self, width=1400, height=1000):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        folder = pathlib.Path(self.profile.name)
        (folder / "user.js").write_text('user_pref("marionette.port", 0);\n')
        self.process = subprocess.Popen([
            "firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", folder,
            "--remote-allow-system-access", f"--window-size={width},{height}"], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        port = folder / "MarionetteActivePort"
        self.wait_for(lambda: port.exists() and port.read_text())
        self.socket = socket.create_connection(("127.0.0.1", int(port.read_text())))
        self.stream = self.socket.makefile("rb")
        self.count = 0
        self.read()  # who it is
        self.call("WebDriver:NewSession", {})
        self.call("WebDriver:SetTimeouts", {"script": 120000})

    def __exit__(self, *_):
        self.stream.close()
        self.socket.close()
        self.process.terminate()
        self.process.wait(30)
        self.profile.cleanup()

    def read(self):
        length = b""
        while (letter := self.stream.read(1)) != b":":
            if not letter:
                raise AssertionError("Firefox has ended")
            length += letter
        return json.loads(self.stream.read(int(length)))

    def call(self, name, words):
        self.count += 1
        data = json.dumps([0, self.count, name, words]).encode()
        self.socket.sendall(b"%d:%s" % (len(data), data))
        _, _, error, result = self.read()
        if error:
            raise AssertionError(error["message"])
        return result

    def open(self, path):
        self.call("WebDriver:Navigate", {"url": f"file://{path}" if path != "/dev/null" else "about:blank"})

    def run(self, script, *words):
        """The result of a JavaScript function's body."""
        return self.call("WebDriver:ExecuteScript", {"script": script, "args": list(words)})["value"]

    def prefer(self, scheme):
        """Sets the reader's color scheme, light or dark."""
        self.call("Marionette:SetContext", {"value": "chrome"})
        name = "layout.css.prefers-color-scheme.content-override"
        self.run("Services.prefs.setIntPref(...arguments)", name, ["dark", "light"].index(scheme))
        self.call("Marionette:SetContext", {"value": "content"})

    def press(self, selector, keys):
        """Sends keys to an element, which takes the focus."""
        found = self.call("WebDriver:FindElement", {"using": "css selector", "value": selector})["value"]
        self.call("WebDriver:ElementSendKeys", {"id": found[ELEMENT], "text": keys})
