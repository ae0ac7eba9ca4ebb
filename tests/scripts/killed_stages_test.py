#!/usr/bin/env python3
"""A stage that the system kills inside a command: no output of a part, and a line that names the stage. A
command that a signal ends: all that it has started ends, too, and no temporary file is left.

usage: killed_stages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from fly_parts.pipe import FramePipe
from lib.running.pipe_tools import FRAMING, ToolCrash, Tools
from toolbox import (BIN, SOURCE, TOOLS, ToolTest, add_claims, end_by_signal, heed_signals, run_script)

TRACED = ("model", "view", "trace")
# command: its words, and the stages
COMMANDS = {
    "film": ("scene.txt config.txt --turn 1 --fps 9 -o x.gif", TOOLS),
    "film --trace": ("scene.txt config.txt --turn 1 --fps 1 -o x.gif", TRACED),
    "film --turn 1": ("scene.txt config.txt --fps 9 -o film", TOOLS),
    "farm": ("scene.txt config.txt --parts 2 --z-buffer z.txt -o x.png", (*TOOLS, "cut-scene", "join-seen")),
    "picture": ("scene.txt config.txt -o x.png", TOOLS),
    "picture --trace": ("scene.txt config.txt -o x.png", TRACED),
    "picture --certain": ("scene.txt config.txt -o x.png", TOOLS),
    "picture --stages kept": ("scene.txt config.txt -o x.png", TOOLS),
    "stages": ("scene.txt config.txt kept", TOOLS),
    "inspect": ("scene.txt config.txt -o x.html", TOOLS),
    "inspect --trace": ("scene.txt config.txt -o x.html", ("trace",)),
    "explain": ("scene.txt config.txt --triangle 0 --pixel 3,3 --coverage center", TOOLS),
    "trade": ("scene.txt config.txt --rounds 1 --plot x.svg", TOOLS),
    "compare": ("--hand-in mine scene.txt config.txt", ("model", "project", "zbuf")),
    "check-stage": (f"view --scene scene.txt --sandbox no -- {BIN}/view", ("model", "project")),
    "grade": ("class tests -o grades", TOOLS),}
# What is there before: all that one of them replaces.
OLDER = ("x.gif", "x.png", "z.txt", "x.html", "x.svg",
         *(f"kept/{name}" for name in ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")))
# Which expect all of a text and of a file, whoever ends well; and of depths.
FRAMED, DEPTHS = ("film", "farm", "picture", "stages", "inspect", "trade"), ("farm", "stages", "inspect")
# Folders of the test, and of what can be gone on with.
KEPT = ("bin", "x.gif.frames", "x.png.farm", "film/.pipeline-film-work")
NO_TRIANGLE = r"--triangle: expected no number, found 0: scene.txt has 0 triangles \(try explain --help\)"
KILLED, FAILED = "ended by SIGKILL", "exit status 3"
KILLS = {"at once": KILLED, "in the middle": KILLED, "after all": KILLED, "fails": FAILED}
MORE = "(the rest of its stderr is left out)"
# A tool that is killed: at once, or with half of its text out, or in, or with all and a note; or fails then,
# or after much on stderr; or does not end; or ends well with a part, or with half of the depths.
TOOL = f'''#!{sys.executable} -I
import os, signal, subprocess, sys
words = ["{BIN}/TOOL", *sys.argv[1:]]
if any("/dev/null" in word and word != "/dev/null" for word in words) or "--help" in words:
    os.execv(words[0], words)  # whether it can be used at all
if "MOMENT" == "never":
    with open(os.path.dirname(sys.argv[0]) + "/started", "a") as file: print(os.getpid(), file=file)
    os.execvp("sleep", ["sleep", "1000"])
if "MOMENT" == "in the middle" and "TOOL" in ("zbuf", "trace"):
    text = sys.stdin.buffer.read()
    tool = subprocess.Popen(words, stdin=subprocess.PIPE, bufsize=0)
    tool.stdin.write(text[:len(text) // 2])
    tool.kill()
    tool.wait()
elif "MOMENT" == "in the middle":
    text = subprocess.run(words, stdout=subprocess.PIPE).stdout
    os.write(1, text[:len(text) // 2 + 7])
elif "MOMENT" == "ends well":
    if "TOOL" in ("model", "view", "project"):  # without the last triangle, and the frame
        os.write(1, subprocess.run(words, stdout=subprocess.PIPE).stdout.rsplit(b"\\n\\n", 2)[0] + b"\\n\\n")
    sys.exit()
elif "MOMENT" == "babbles":
    sys.stderr.write("TOOL: once more\\n" * (1 << 19))
    sys.exit(3)
elif "MOMENT" == "half":
    text = subprocess.run(words, stdout=subprocess.PIPE).stdout
    os.write(1, text[:len(text) // 2])
    for option, path in zip(words, words[1:]):
        if option == "--z-buffer" and os.path.isfile(path): os.truncate(path, os.path.getsize(path) // 2)
    sys.exit()
elif "MOMENT" == "empty": sys.exit()
elif "MOMENT" == "no text":
    os.write(1, b"\\xff\\n\\n")
    sys.exit()
elif "MOMENT" == "half a picture":
    status = subprocess.run(words).returncode
    for option, path in zip(words, words[1:]):
        path = path.split(":")[-1]
        if option == "--image" and os.path.isfile(path): os.truncate(path, os.path.getsize(path) - 1)
    sys.exit(status)
elif "MOMENT" in ("after all", "fails"):
    status = subprocess.run(words).returncode
    if "MOMENT" == "after all": print("TOOL: note: a\\n\\nzbuf: status 7\\n", file=sys.stderr)
    if "MOMENT" == "fails": sys.exit(status or 3)
os.kill(os.getpid(), signal.SIGKILL)
'''

# A command, with a call in it that first sends it a signal, outside of a folder for retries.
SIGNALED = '''
import fcntl, os, re, runpy, signal, sys
def signaled(*arguments):
    if not re.search("(farm|work)/", str(arguments[-1])):
        setattr(module, name, real)
        os.kill(os.getpid(), signal.SIGTERM)
    return real(*arguments)
call, command = sys.argv[1:3]
module, name = globals()[call.split(".")[0]], call.split(".")[1]
real = getattr(module, name)
setattr(module, name, signaled)
sys.argv[:3] = [sys.path[0]] = [os.environ["SCRIPTS"] + "/" + command]
sys.path[0] = os.environ["SCRIPTS"]
runpy.run_path(sys.argv[0], run_name="__main__")
'''


class KilledStages(ToolTest):
    def check(self, command):
        words, stages = COMMANDS[command]
        for need in {"film": ["parallel", "ffmpeg"], "farm": ["parallel"]}.get(command.split()[0], []):
            if not shutil.which(need):
                self.skipTest(f"{need} is missing")
        corner = "triangle\n0 0 0\n1 0 {}\n0 1 0\n"
        pathlib.Path("scene.txt").write_text("1 0 5\n0 0 0\n0 1 0\n60 1 1 100\n" +
                                             "".join(map(corner.format, range(-9, 1))) + "end\n")
        for path in ("mine", "class/a"):
            self.assertEqual(run_script("stages", "scene.txt", "config.txt", path).returncode, 0)
        shutil.copytree(".", "tests/only", ignore=shutil.ignore_patterns("mine", "class", "tests"))
        for folder in ("tmp", "kept"):
            os.mkdir(folder)
        for path in OLDER:
            pathlib.Path(path).write_text("older")
        if "-o film" in words:  # of other frames, one more
            run_script("film", "scene.txt", "--size=9x9", "--turn=1", "--fps=10", "-o", "film", check=True)
        before, signals = self.contents(), (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)

        def kill(stage, moment, expected):
            with self.subTest(stage=stage, moment=moment):
                self.make_tools(stage, moment)
                self.kill(expected, *command.split(), *words.split())
                self.assertEqual(self.contents(), before)

        for stage, moment in itertools.product(stages, KILLS):
            kill(stage, moment, f"{stage}: {KILLS[moment]}")
        if command in DEPTHS:
            kill("zbuf", "half", "zbuf: has not written all of the depths, .*")
        if command.split()[0] in FRAMED:
            for stage in stages:
                kill(stage, "ends well", r"(?!.*\.pipeline-)\S.*")
            drawing = "trace" if "--trace" in command else "zbuf"
            kill(
                drawing, "half a picture",
                r"\d of \d frames have not been drawn: .*" if command.startswith("film") else
                rf"{drawing}: has not written all of (?!.*\.pipeline-)[\w/]+\.\w+, though it ended well")
        else:
            no_camera = "model: has written no camera, though it ended well"
            kill("model", "empty", NO_TRIANGLE if command == "explain" else no_camera)
            kill("model", "no text", "model: has written bytes that are no text, though it ended well")
        number = list(COMMANDS).index(command)
        with self.subTest(signal=signals[number % 3], stage=stages[number % len(stages)]):
            self.make_tools(stages[number % len(stages)], "never")
            self.end(signals[number % 3], *command.split(), *words.replace("kept", "new/five").split())
            self.assertEqual(self.contents(), before)
        # compare takes what the others of its tools say for a scene that they refuse.
        stage = stages[number % len(stages) if command != "compare" else 0]
        with self.subTest(babbles=stage):
            self.make_tools(stage, "babbles")
            done = run_script(*command.split(), *words.split(), env=self.places())
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(f"once more\n{stage}: once", done.stderr)
            self.assertIn(MORE, done.stderr)
            self.assertLess(len(done.stderr), 1 << 17)
            self.assertEqual(self.contents(), before)

    def test_what_appears_together_waits_for_no_signal(self):
        """Sent at the first call that puts an output in place, or that takes the folder of work."""
        os.mkdir("tests")
        shutil.copytree(".", "tests/only", ignore=shutil.ignore_patterns("tests"))
        run_script("stages", "scene.txt", "config.txt", "class/a", check=True)
        calls = (("os.replace", "stages scene.txt config.txt new",
                  5), ("os.replace", "picture scene.txt config.txt --stages new -o new/x.png", 4),
                 ("os.replace", "farm scene.txt config.txt --parts 1 --z-buffer new/z.txt -o new/x.png",
                  2), ("os.replace", "film scene.txt config.txt --turn 1 --fps 2 -o new/f",
                       6), ("os.replace", "grade class tests -o new/g",
                            5), ("fcntl.flock", "film scene.txt config.txt --turn 1 --fps 2 -o new/f",
                                 0), ("fcntl.flock", "farm scene.txt config.txt -o new/x.png",
                                      0), ("fcntl.flock", "grade class tests -o new/g", 0))
        for call, words, outputs in calls:
            with self.subTest(call=call, words=words):
                if words.split()[0] in ("farm", "film") and not shutil.which("parallel"):
                    continue
                shutil.rmtree("new", ignore_errors=True)
                os.mkdir("new")
                command = [sys.executable, "-c", SIGNALED, call, *words.split()]
                done = subprocess.run(command, capture_output=True, text=True,
                                      env={**os.environ, "BIN": str(BIN), "SCRIPTS": str(SOURCE / "scripts")})
                self.assertIn(f"{words.split()[0]}: ended by SIGTERM\n", done.stderr)
                made = [path for path, data in self.contents().items() if path.startswith("new/") and data]
                made = [path for path in made if not (outputs and "farm/" in path)]  # for the retry
                self.assertEqual(len(made), outputs, made)

    def test_fly_and_a_framed_pipe_of_ones_own_show_nothing_of_a_part(self):
        pathlib.Path("out.bmp").write_text("older")
        before = self.contents()
        for stages, moment in itertools.product((TOOLS, TRACED), ("at once", "in the middle")):
            for stage in stages:
                self.make_tools(stage, moment)
                with self.assertRaises(ToolCrash) as raised:
                    pipe = FramePipe(Tools("bin"), "scene.txt", stages == TRACED)
                    camera = [word.split() for word in ("0 0 5", "0 0 0", "0 1 0")]
                    pipe.frame(camera, [], "8 8\n", [])
                self.assertEqual(str(raised.exception), f"{stage}: ended by SIGKILL")
                files = {"model": "scene.txt", stages[-1]: "config.txt"}
                line = " | ".join(" ".join([f"bin/{tool}", *FRAMING.get(tool, []),
                                            files.get(tool, "")]) for tool in stages)
                self.assertNotEqual(subprocess.run(["sh", "-c", line], capture_output=True).returncode, 0)
                self.assertEqual(self.contents(), before, (stage, moment))

    def test_a_full_disk_hides_no_reason(self):
        """Of temporary files, of depths, and of a picture."""
        os.mkdir("tmp")
        self.make_tools("view", "at once")
        full = ("mount -t tmpfs -o size=16k none tmp || exit 77; echo older > tmp/x.png; "
                'cat /dev/zero > tmp/zeros 2> /dev/null; "$0" "$@" && exit 1; cat tmp/x.png; ls -A tmp')
        for name, words, bin_folder, reason in (
            ("farm", "-o x.png --parts=1", "bin", "seen-0-1.txt: view: ended by SIGKILL; "),
            ("farm", "-o x.png --bands=2 --z-buffer=tmp/x.png", BIN, "tmp/x.png: No space left on device\n"),
            ("picture", "-o tmp/x.png", BIN,
             "picture: zbuf: cannot write tmp/x.png: No space left on device\n")):
            done = subprocess.run([
                "unshare", "--mount", "--map-root-user", "sh", "-c", full, SOURCE / "scripts" / name,
                "scene.txt", "config.txt", *words.split()], capture_output=True, text=True,
                                  env={**self.places(), "BIN": str(bin_folder)})
            if done.returncode == 77 or done.stderr.startswith("unshare: "):
                self.skipTest("mounting is not allowed here: " + done.stderr)
            self.assertIn(reason, done.stderr)
            self.assertFalse(os.path.exists("x.png"))
            reasons = [line for line in done.stderr.splitlines() if ": note: " not in line]
            self.assertEqual((len(reasons), done.stdout), (1, "older\nx.png\nzeros\n"))

    @staticmethod
    def make_tools(stage, moment):
        """The folder bin, with a tool that is killed at a moment, and none from the kill before."""
        for folder in KEPT:
            shutil.rmtree(folder, ignore_errors=True)
        os.mkdir("bin")
        for tool in BIN.iterdir():
            os.symlink(tool, f"bin/{tool.name}")
        os.unlink(f"bin/{stage}")
        pathlib.Path("bin", stage).write_text(TOOL.replace("TOOL", stage).replace("MOMENT", moment))
        os.chmod(f"bin/{stage}", 0o755)

    def places(self):
        return {**os.environ, "BIN": os.path.abspath("bin"), "TMPDIR": os.path.abspath("tmp")}

    def end(self, number, name, *words):
        process = subprocess.Popen([SOURCE / "scripts" / name, *words], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, preexec_fn=heed_signals, env=self.places())
        started = pathlib.Path("bin/started")
        while not started.exists() and process.poll() is None:
            time.sleep(0.02)
        said = end_by_signal(process, number)[1].decode()
        self.assertEqual((process.returncode, said), (-number, f"{name}: ended by {number.name}\n"))
        self.assertFalse([pid for pid in started.read_text().split() if os.path.exists(f"/proc/{pid}/exe")])

    def kill(self, expected, name, *words):
        done = run_script(name, *words, env=self.places())
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, expected)
        if name != "grade":  # which tells who has no points
            pattern = f"(.*: )?{expected}(; .*)?" if name in ("film", "farm") else expected  # how to go on
            notes = r"^\d{5} \(--eye .*\): \w+: note: .*\n"  # on frames that have been drawn before
            said = re.sub(notes, "", done.stderr, flags=re.M) if name == "film" else done.stderr
            self.assertRegex(said, rf"\A{name}: {pattern}\n\Z")

    def contents(self):
        return {
            str(path): path.is_file() and path.read_bytes()
            for path in pathlib.Path(".").rglob("*") if not str(path).startswith(KEPT)}


add_claims(KilledStages, [(f"{command} makes nothing of a part", command) for command in COMMANDS])

if __name__ == "__main__":
    unittest.main()
