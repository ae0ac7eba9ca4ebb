"""A headless Chromium, driven by plain WebDriver requests (W3C) to chromedriver."""
import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
import urllib.error
import urllib.request

MISSING = [name for name in ("chromium", "chromedriver") if shutil.which(name) is None]
ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the standard's key of a reference to an element


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class CannotStart(unittest.SkipTest):
    """There is no browser here; the tests that need one are skipped, with its reason."""


class Browser:
    """A browser with a window of a given size, closed at the end of the `with` block."""
    def __init__(self, width=1400, height=1000):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        port = free_port()
        self.address = f"http://127.0.0.1:{port}"
        self.driver = subprocess.Popen(["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        self.session = ""
        try:
            self.start(width, height)
        except (AssertionError, OSError) as error:
            self.end()
            raise CannotStart("chromium cannot start: " + ", ".join(str(error).splitlines())) from None

    def start(self, width, height):
        self.wait_for(self.is_up)
        # By a pipe, since a bare machine may have no /etc/hosts, in which chromedriver finds localhost.
        words = [
            "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            "--disable-dev-shm-usage", "--remote-debugging-pipe", f"--user-data-dir={self.profile.name}",
            f"--window-size={width},{height}"]
        # A large page is busy for long on a busy machine before it answers: as long as a call may take.
        made = self.call(
            "POST", "/session", {
                "capabilities": {
                    "alwaysMatch": {
                        "timeouts": {"script": 120000}, "goog:chromeOptions": {"args": words},
                        "goog:loggingPrefs": {"browser": "ALL"}}}})
        self.session = "/session/" + made["sessionId"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.session:
            self.call("DELETE", "")
        self.end()

    def end(self):
        self.driver.terminate()
        self.driver.wait(30)
        self.profile.cleanup()

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + self.session + path, data,
                                         {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=120) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(json.load(error)["value"]["message"]) from None

    def is_up(self):
        if self.driver.poll() is not None:
            raise AssertionError(f"chromedriver ended with status {self.driver.returncode}")
        try:
            return self.call("GET", "/status")["ready"]
        except OSError:
            return False

    @staticmethod
    def wait_for(is_true, seconds=60):
        end = time.monotonic() + seconds
        while not is_true():
            if time.monotonic() > end:
                raise AssertionError("the browser did not get there in time")
            time.sleep(0.05)

    def open(self, path):
        self.call("POST", "/url", {"url": f"file://{path}"})

    def run(self, script, *words):
        """The result of a JavaScript function's body."""
        return self.call("POST", "/execute/sync", {"script": script, "args": list(words)})

    def element(self, selector):
        return self.call("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def point(self, selector, x, y, is_click=False):
        """Moves the pointer to a point in an element, counted from its top left corner, and clicks there."""
        self.run("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", selector)
        left, top = self.run(
            "const box = document.querySelector(arguments[0]).getBoundingClientRect(); return [box.left, "
            "box.top]", selector)
        actions = [{"type": "pointerMove", "duration": 0, "x": round(left + x), "y": round(top + y)}]
        if is_click:
            actions += [{"type": "pointerDown", "button": 0}, {"type": "pointerUp", "button": 0}]
        self.call(
            "POST", "/actions", {
                "actions": [{
                    "type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
                    "actions": actions}]})

    def click(self, selector, x, y):
        self.point(selector, x, y, is_click=True)

    def press(self, selector, keys):
        """Sends keys to an element, which takes the focus."""
        self.call("POST", f"/element/{self.element(selector)}/value", {"text": keys})

    def devtools(self, command, **words):
        """Calls a command of Chromium's DevTools protocol."""
        return self.call("POST", "/goog/cdp/execute", {"cmd": command, "params": words})

    def resize(self, width, height):
        """Gives the page so many pixels."""
        self.devtools("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1,
                      mobile=False)

    def prefer(self, scheme):
        """Sets the reader's color scheme, light or dark."""
        self.devtools("Emulation.setEmulatedMedia", features=[{
            "name": "prefers-color-scheme", "value": scheme}])

    def accessibility(self):
        """(role, name) of what a screen reader finds, in order."""
        nodes = self.devtools("Accessibility.getFullAXTree")["nodes"]
        return [(node["role"]["value"], node.get("name", {}).get("value", "")) for node in nodes
                if not node["ignored"]]

    def screenshot(self):
        return base64.b64decode(self.call("GET", "/screenshot"))

    def complaints(self):
        """The errors that the page logged."""
        return [
            entry["message"] for entry in self.call("POST", "/se/log", {"type": "browser"})
            if entry["level"] == "SEVERE"]
