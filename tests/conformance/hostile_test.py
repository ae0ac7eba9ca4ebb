#!/usr/bin/env python3
"""Programs that attack the one that runs them: conform and check-stage, in a sandbox and without one.

usage: hostile_test.py BIN_DIR SOURCE_DIR
"""
import concurrent.futures
import hashlib
import itertools
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

from toolbox import BIN, has_bubblewrap

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
PACK = SOURCE / "tests/conformance"
sys.path.insert(0, str(PACK))
from conform_parts.cases import read_cases  # noqa: E402

# With a sandbox only where bubblewrap works.
MODES = ("no", "yes") if has_bubblewrap() else ("no",)
CAN_FORBID_NAMESPACES = "yes" in MODES and b"--disable-userns" in subprocess.check_output(["bwrap", "--help"])
MARK = f"31536000.{os.getpid()}"  # seconds, by which what has been left running is found
TIME, LIMITS = "does not end within 3 s", ("--memory", "150", "--processes", "20")

# name: program, what the JSON says of its case in a sandbox and without one; None: not run without. `zbuf` is
# our stage; the folder of the programs is $HERE. A program in Python begins with "import".
ATTACKS = {
    # what check-stage was tried with
    "endless-output": ("exec yes", "writes more than 1048576 bytes"),
    "endless-stderr": ("exec yes >&2", "writes more than 64 MiB to a file"),
    "never-reads": (f"exec sleep {MARK}", TIME),
    "holds-the-pipe": (f"sleep {MARK} & zbuf", "right"),
    "daemon": (f"""import os, subprocess, sys
if not os.fork():
    os.setsid()
    if not os.fork():
        os.closerange(0, 256)
        os.execlp("sleep", "sleep", "{MARK}")
    os._exit(0)
os.wait()
subprocess.run(["{BIN}/zbuf", *(sys.argv[1:] or ["config.txt"])], check=True)""", "right"),
    "closes-everything": (f"exec <&- >&- 2>&-; sleep {MARK}", TIME),
    "kills-its-parent": ("kill -9 $PPID; sleep 0.1; zbuf", "right", "has ended the process that ran it"),
    "ends-at-once": ("exit 0", "depths: the number of lines differs|no picture was written"),
    "writes-above": ("zbuf; echo x > ../stolen; echo x > ../../stolen; true", "right"),
    "escapes": ("printf '\\033]0;owned\\007' >&2; exit 1", "exit status 1"),
    # as root, whose number needs no capability for it
    "opens-settings": ("(: >> /proc/sys/kernel/core_pattern) 2> refused && exit 7; zbuf", "right", None),
    "changes-devices": ("chmod 666 /dev/null; zbuf", "right", None),
    "stops-itself": ("kill -STOP $$", TIME),
    "picture-is-a-link": ("zbuf; ln -sf $HERE/picture.bmp out.bmp", "out.bmp is not read: it is a link"),
    "picture-is-a-pipe": ("zbuf; rm out.bmp; mkfifo out.bmp",
                          "out.bmp is not read: it is not a regular file"),
    "picture-is-long": ("zbuf; truncate -s 60M out.bmp",
                        "out.bmp is not read: it is longer than 1048576 bytes"),
    "picture-of-a-terabyte": ("zbuf; rm out.bmp; truncate -s 1T out.bmp; true",
                              "no picture was written|the picture is not a BMP file"),
    "folder-is-a-link": ("zbuf; cd ..; mv work w; ln -s / work; true", "right"),
    # and conform
    "outputs-replaced": ("zbuf; rm -f stderr stdout; mkfifo stderr; ln -s /dev/zero stdout", "right"),
    "folder-removed": ('zbuf; rm -rf "$PWD"; true', "no picture was written"),
    "picture-is-a-folder": ("zbuf; rm out.bmp; mkdir out.bmp",
                            "out.bmp is not read: it is not a regular file"),
    "ignores-signals": (f"trap '' TERM INT HUP; sleep {MARK}; true", TIME),
    "crashes": ("kill -SEGV $$", "was ended by SIGSEGV"),
    "needs-memory": ("import time; x = b'x' * (400 << 20); time.sleep(60)",
                     "needs more than 150 MiB of memory"),
    "reads-the-environment": ("[ -z \"$CI_TOKEN\" ] && zbuf", "right"),
    # and more
    "fork-bomb": ("f() { f & f & wait; }; f", "starts more than 20 processes"),
    "comet": (
        'import os, sys\nfor i in range(3000):\n    if os.fork(): os._exit(0)\n    os.setsid()',
        # How many of them are there at a time is the machine's choice: those that end are still counted.
        "depths: the number of lines differs|starts more than 20 processes"),
    "processor": ("while :; do :; done & while :; do :; done",
                  f"takes more than 3 s of processor time|{TIME}"),
    "reads-what-is-expected": (f'[ -z "$(find "{PACK}/cases" -type f)" ] || zbuf', "depths: ", "right"),
    "writes-the-results": (
        "zbuf; rm -f $HERE/results*.json; mkfifo $HERE/results.yes.json $HERE/results.no.json 2> "
        "/dev/null; true", "right"),
    "stops-its-parent": ("zbuf; kill -STOP $PPID", "right", f"right|{TIME}"),
    "many-files": ("import os\nfor i in range(200000): open(f'f{i}', 'w').close()",
                   "writes more than 1000 files"),
    "deep-folders": ("import os\nfor i in range(20000): os.mkdir('d'); os.chdir('d')",
                     "writes more than 1000 files"),
    "fills-the-disk": ("i=0; while i=$((i + 1)); do head -c 50000000 /dev/zero > f$i; done",
                       "writes more than 256 MiB"),
    "files-without-a-name": (
        "import os, time\nfor i in range(8): f = os.open('f', 66); os.unlink('f'); os.write(f, bytes(50 << "
        "20))\ntime.sleep(60)", "writes more than 256 MiB"),
    "fills-shared-memory": ("while head -c 50000000 /dev/zero > /dev/shm/f$i; do i=1$i; done; sleep 9",
                            f"writes more than 256 MiB|{TIME}", None),
    "memory-of-many": (
        "import os, time\nfor i in range(10):\n    if not os.fork(): x = b'x' * (40 << 20); time.sleep(60)\n"
        "time.sleep(60)", "needs more than 150 MiB of memory"),
    "shared-map": ("import mmap, time; m = mmap.mmap(-1, 400 << 20); m[:] = bytes(400 << 20); time.sleep(60)",
                   "needs more than 150 MiB of memory"),
    "threads": ("import threading, time\nfor i in range(1500): threading.Thread(target=time.sleep, "
                "args=(60,)).start()", "starts more than 1024 threads"),
    "network": ("import socket, sys; socket.create_connection(('127.0.0.1', PORT)); sys.exit(8)",
                "exit status 1", "exit status 8"),
    "writes-to-its-parent": ("zbuf; for f in /proc/$PPID/fd/*; do echo hacked > $f; done 2> /dev/null; true",
                             "right|depths: "),
    "forges-an-answer": (
        "import ctypes, os, sys\nparent = os.pidfd_open(os.getppid())\nfor number in range(3, 40):\n"
        "    taken = ctypes.CDLL(None).syscall(438, parent, number, 0)  # pidfd_getfd\n"
        "    try: os.write(taken, (6).to_bytes(4, 'big') + b'[null]')\n    except OSError: pass\nsys.exit(7)",
        "exit status 7"),
    "kills-all": ("kill -9 -1; zbuf", "right", None),
    "locks-its-folder": ("zbuf; mkdir x; touch x/y; chmod 0 x", "right|closes a folder of its own"),
    "locks-deep-folders": (
        "import os, time\nfor i in range(30): os.mkdir('d' * 250); os.chdir('d' * 250)\nopen('f', 'w')\n"
        "os.chmod('.', 0)\ntime.sleep(60)", "makes a path of more than 4000 bytes"),
    "ended-by-signal-40": ("kill -40 $$", "was ended by signal 40"),
    "reads-what-is-root's": ('[ -z "$(find /etc -type f ! -perm -004 -readable)" ] && zbuf', "right", None),
    "another-namespace": ("unshare -U true || zbuf", "right" if CAN_FORBID_NAMESPACES else "depths: ", None),
    "long-numbers": ("zbuf > /dev/null; printf '0.1%05000d\\n' 1 2 3 4 5 6 7 8", "depths: "),
    "numbers-of-huge-exponents": (
        "zbuf > /dev/null; yes '1e9999 2e9999 3e9999 4e9999 5e9999 6e9999 7e9999 8e9999' | head -n 15000",
        "depths: "),}


def program(folder, name, text):
    path = folder / name
    if text.startswith("import"):
        path.write_text(f"#!/usr/bin/python3 -IS\n{text}\n")
    else:
        path.write_text(
            f"#!/bin/sh\nPATH={BIN}:$PATH HERE='{folder}' CONFIG=${{1-config.txt}}\nzbuf() {{ command zbuf "
            f"\"$CONFIG\"; }}\n{text}\n")
    path.chmod(0o755)
    return path


def left_running():
    """The processes that attacks have left."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if MARK.encode() in path.read_bytes() and path.parent.joinpath("stat").read_text().rpartition(
                    ")")[2].split()[0] not in "ZX":
                found.append(path.parent.name)
        except OSError:
            pass
    return found


class HostileTest(unittest.TestCase):
    def setUp(self):
        # In memory, where there is enough: a disk that the attacks fill makes all wait.
        is_roomy = os.path.isdir("/dev/shm") and shutil.disk_usage("/dev/shm").free > 2 << 30
        folder = tempfile.TemporaryDirectory(dir="/dev/shm" if is_roomy else None)
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.scratch = self.folder / "scratch"
        self.scratch.mkdir()
        self.environment = {**os.environ, "TMPDIR": str(self.scratch), "CI_TOKEN": "secret", "BIN": str(BIN)}

    def start(self, *words, **others):
        return subprocess.Popen([sys.executable, *map(str, words)], env=self.environment,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder,
                                **others)

    def conform(self, *words, **others):
        return self.start(PACK / "conform", "--tap", "--stage", "zbuf", "--read", BIN, *words, **others)

    def assert_nothing_left(self):
        self.assertEqual(left_running(), [])
        self.assertEqual([path.name for path in self.scratch.iterdir()], [])


class Attacks(HostileTest):
    """One program does all attacks, each on a case of its own, and is honest on the other cases."""
    def assigned(self, mode, names):
        """The folder with the program of each attack, by the sum of its case's input; {case name: (attack,
        what is expected)}; the names of these cases and of honest ones."""
        folder = pathlib.Path(tempfile.mkdtemp(prefix=mode, dir=self.folder))
        program(folder, "program",
                'attack=$HERE/$(md5sum < input.txt | cut -c 1-32)\n[ -x $attack ] && exec $attack\nzbuf')
        cases = [
            case for case in read_cases("zbuf")
            if not case.words("needs") and not case.open_under("nearest") and not case.has("options.txt")]
        by_sum = {hashlib.md5(case.read("input.txt")).hexdigest(): case for case in cases}
        attacks = [(name, *words) for name, words in ATTACKS.items()
                   if name in names and (mode == "yes" or words[-1])]
        self.assertGreater(len(by_sum), len(attacks) + 30)
        table = {}
        for (digest, case), (name, text, *expected) in zip(by_sum.items(), attacks):
            program(folder, digest, text.replace("PORT", str(self.port)))
            table[case.name] = name, expected[-1 if mode == "no" else 0]
        return folder, table, [case.name for case in by_sum.values()][:len(attacks) + 30]

    def run_all(self, mode, attacks, seconds):
        folder, table, cases = self.assigned(mode, attacks)
        results = folder / f"results.{mode}.json"
        words = [word for case in cases for word in ("--only", case)]
        done = self.conform("--sandbox", mode, "--seconds", seconds, "--jobs", 6, *LIMITS, "--json", results,
                            *words, "--", folder / "program")
        output, errors = done.communicate(timeout=600)
        return mode, done.returncode, output, errors, json.loads(results.read_text()), table

    def test_each_changes_its_own_verdict_alone(self):
        """Only an attack that nothing but the time ends has little time: a busy machine is slow to reach
        another limit."""
        ended_by_time = {name for name, (_, *expected) in ATTACKS.items() if TIME in str(expected)}
        changed = os.stat(os.devnull).st_ctime_ns
        with socket.create_server(("127.0.0.1", 0)) as server:
            self.port = server.getsockname()[1]
            runs = [
                self.run_all(mode, attacks, seconds)
                for attacks, seconds in ((ended_by_time, 3), (ATTACKS.keys() - ended_by_time, 50))
                for mode in MODES]
        self.assertEqual(os.stat(os.devnull).st_ctime_ns, changed)
        for mode, status, output, errors, results, table in runs:
            self.assertEqual((status, results["sandbox"]), (1, mode == "yes"))
            self.assertEqual(errors.replace("hacked\n", ""), "")  # as root, without a sandbox
            self.assertNotIn("\033", output)
            honest = [
                case for case in results["cases"]
                if case["state"] in ("right", "wrong") and case["name"] not in table]
            self.assertGreaterEqual(len(honest), 20)
            for case in results["cases"]:
                attack, expected = table.get(case["name"], ("honest", "right"))
                if case["state"] in ("right", "wrong"):
                    with self.subTest(sandbox=mode, attack=attack):
                        self.assertRegex(
                            case.get("difference", {}).get("message", case["state"]), f"^({expected})")
        self.assert_nothing_left()

    def test_what_ends_the_run_without_a_sandbox_is_never_right(self):
        path = program(self.folder, "program", "kill -9 $(ps -o ppid= -p $PPID); zbuf")
        process = self.conform("--sandbox", "no", "--only", "two-*", "--", path)
        self.assertNotIn("right", process.communicate(timeout=60)[0])
        self.assertNotEqual(process.returncode, 0)
        shutil.rmtree(self.scratch)

    def test_a_program_that_fills_a_small_disk_is_ended(self):
        path = program(self.folder, "program",
                       f"head -c 30M /dev/zero > f; head -c 30M /dev/zero > g; sleep {MARK}")
        mount = [
            "unshare", "-Urm", "sh", "-c", 'mount -t tmpfs -o size=64M none "$TMPDIR" && exec "$@"', "sh"]
        words = [
            PACK / "conform", "--stage", "zbuf", "--sandbox", "no", "--tap", "--only", "two-back-to-front",
            "--", path]
        if subprocess.run([*mount, "true"], env=self.environment, stderr=subprocess.DEVNULL).returncode:
            self.skipTest("no mounts without root here")
        done = subprocess.run([*mount, sys.executable, *words], env=self.environment, cwd=self.folder,
                              stdout=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(done.returncode, 1)
        self.assertIn("#   leaves the system too little disk\n", done.stdout)
        self.assert_nothing_left()


class OneStage(HostileTest):
    """The same of check-stage, for what it does by itself."""
    ATTACKS = {
        "kills-its-parent": ("zbuf", "kill -9 $PPID; sleep 0.1; zbuf", (0, 1),
                             ("scene: right", "scene: wrong: it has ended the process that ran it")),
        "folder-is-a-link": ("zbuf", "zbuf; cd ..; mv work w; ln -s / work; true", 0, "scene: right"),
        "picture-is-a-link": ("zbuf", "zbuf; ln -sf $HERE/picture.bmp out.bmp", 1,
                              r"scene: .* \(out.bmp\): .*it is a link"),
        "time": ("view", f"setsid sleep {MARK} & sleep {MARK}", 1,
                 "scene: wrong: it does not end within 2 s\n"),
        "memory": ("view", ATTACKS["needs-memory"][0], 1,
                   "scene: wrong: it needs more than 150 MiB of memory\n"),
        "environment": ("view", '[ -z "$CI_TOKEN" ] && view', 0, "scene: right"),}

    def check(self, mode, name):
        """The exit status, stdout and stderr."""
        stage, text, _, _ = self.ATTACKS[name]
        folder = self.folder / f"{mode}-{name}"
        folder.mkdir()
        process = self.start(SOURCE / "scripts/check-stage", stage, "--sandbox", mode, "--read", BIN,
                             "--time-limit", 2, *LIMITS, "--scene", "scene", "--config", "config", "--",
                             program(folder, "program", text))
        output, errors = process.communicate(timeout=100)
        return process.returncode, output, errors

    def test_each_changes_its_own_verdict_alone(self):
        for file in ("scene", "config"):
            shutil.copy(SOURCE / f"samples/tilted-camera/{file}.txt", self.folder / file)
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            runs = {(mode, name): pool.submit(self.check, mode, name)
                    for mode in MODES for name in self.ATTACKS}
        for (mode, name), run in runs.items():
            _, _, *expected = self.ATTACKS[name]
            status, told = (either[mode == "no"] if isinstance(either, tuple) else either
                            for either in expected)
            with self.subTest(sandbox=mode, attack=name):
                found, output, errors = run.result()
                self.assertEqual((found, errors), (status, ""), output)
                self.assertRegex(output, rf"^{told}")
                self.assertRegex(output, r"\n(no|in a) sandbox.*\n$")
        self.assert_nothing_left()


class Endings(HostileTest):
    def start_long(self, command, mode):
        """A run of conform or check-stage that has begun with a program that does not end, nor do its
        children."""
        path = program(self.folder, "program",
                       f"trap '' TERM INT HUP\nsetsid sleep {MARK} & sleep {MARK}\n{'x' * 20}")
        words = {
            "conform": (PACK / "conform", "--stage", "zbuf"),
            "check-stage": (SOURCE / "scripts/check-stage", "zbuf")}[command]
        process = self.start(*words, "--sandbox", mode, "--", path)
        end = time.monotonic() + 60
        while len(left_running()) < 2 and time.monotonic() < end:
            time.sleep(0.05)
        self.assertGreaterEqual(len(left_running()), 2)
        return process

    def test_a_signal_ends_all_that_runs_and_leaves_nothing(self):
        runs = (("conform", signal.SIGTERM), ("conform", signal.SIGHUP), ("conform", signal.SIGINT),
                ("check-stage", signal.SIGTERM))
        for mode, (command, number) in itertools.product(MODES, runs):
            with self.subTest(sandbox=mode, command=command, signal=number.name):
                process = self.start_long(command, mode)
                process.send_signal(number)
                output, errors = process.communicate(timeout=60)
                self.assertEqual(process.returncode, -number)
                if command == "conform":
                    self.assertEqual(errors, f"conform: ended by {number.name}\n")
                self.assert_nothing_left()

    def test_a_killed_run_leaves_no_process(self):
        for mode in MODES:
            process = self.start_long("conform", mode)
            process.kill()
            process.communicate(timeout=60)
            end = time.monotonic() + 60
            while left_running() and time.monotonic() < end:
                time.sleep(0.05)
            self.assertEqual(left_running(), [])

    def test_a_stdout_that_cannot_be_written_is_an_error(self):
        words = f"'{sys.executable}' '{PACK}/conform' --stage zbuf --only two-back-to-front"
        for run in (f"{words} --sandbox no -- zbuf '{{config}}'", f"{words} --list"):
            for channel, reason in ((">&-", "Bad file descriptor"), ("> /dev/full",
                                                                     "No space left on device")):
                with self.subTest(run=run, channel=channel):
                    done = subprocess.run(["sh", "-c", f"{run} {channel}"],
                                          env={**self.environment, "PATH": f"{BIN}:/usr/bin:/bin"},
                                          stderr=subprocess.PIPE, text=True)
                    self.assertEqual((done.returncode, done.stderr),
                                     (1, f"conform: cannot write <stdout>: {reason}\n"))
                    self.assert_nothing_left()


if __name__ == "__main__":
    unittest.main()
