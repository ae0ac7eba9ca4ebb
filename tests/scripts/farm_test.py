#!/usr/bin/env python3
"""scripts/farm: the picture and the depths are those of one pipe, whatever the parts, the machines, and who is killed.

usage: farm_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import random
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "scripts"))
from lib.pictures import read_picture  # noqa: E402
from ssh_server import SshServer  # noqa: E402
from toolbox import BIN, SOURCE, ToolTest, pipe, run  # noqa: E402

FARM = SOURCE / "scripts/farm"
CAMERA = "1 0.5 4\n0 0 0\n0 1 0\n50 1.25 1 30 ratio\n"
LIGHT = "push\ntranslate 0 1 0\nlight\n1 2 3 1 0.9 0.8\npop\nlight\n-3 1 2 0.4 0.4 1\nambient 0.2 0.2 0.2\nmaterial 1 0.8 0.5 8\nbackground 5 10 15\n"
SETTINGS = ([], ["--coverage", "center", "--samples", "2"], ["--wireframe", "--clip", "frustum", "--depth", "f32"])
OF_PROJECT = ("--clip", "--cull", "--aspect")


def setUpModule():  # noqa: N802
    if not shutil.which("parallel"):
        raise unittest.SkipTest("GNU parallel is missing")


def scene(is_lit, count=400):
    rng = random.Random(7)
    text = CAMERA + LIGHT * is_lit
    for i in range(count):
        x, y, z = (rng.uniform(-2.5, 2.5) for _ in range(3))
        text += "push\nrotate %d 1 2 3\n" % rng.randrange(360) if i % 3 == 0 else ""
        text += "triangle\n" + "".join(f"{x + rng.uniform(-0.5, 0.5):.7f} {y + rng.uniform(-0.5, 0.5):.7f} {z + rng.uniform(-0.5, 0.5):.7f}\n" for _ in range(3))
        text += "pop\n" if i % 3 == 2 else ""
    return text + "end\n"


def logged(folder, output):
    """(host, start, exit status) of the job that made the output, from the job log: its last run."""
    rows = [line.split("\t", 8) for line in pathlib.Path(folder, "jobs.log").read_text().splitlines()[1:]]
    found = [(row[1], float(row[2]), int(row[6])) for row in rows if f"output={output};" in row[8]]
    return found[-1]


def stat_of(process):
    """(name, parent) of a process."""
    stat = pathlib.Path(f"/proc/{process}/stat").read_text()
    return stat[stat.index("(") + 1:stat.rindex(")")], int(stat[stat.rindex(")") + 2:].split()[1])


def ancestors(process):
    """The process and those above it, as (id, name)."""
    found = []
    while process > 1:
        name, parent = stat_of(process)
        found.append((process, name))
        process = parent
    return found


def chain_to_zbuf(word, above):
    """The ancestors of the zbuf that has the word in its command line and runs below the process `above`, as soon as there is one."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        for path in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                command = (path / "cmdline").read_bytes().decode(errors="replace").split("\0")
                if not command[0].endswith("/zbuf") or word not in command:
                    continue
                chain = ancestors(int(path.name))
                if above in dict(chain):
                    return chain
            except OSError:
                continue  # it has ended meanwhile
        time.sleep(0.01)
    raise AssertionError(f"no zbuf of {word} has run")


class FarmTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("50 40\n")
        self.bin = BIN

    def use_slow_tools(self, script="sleep 1.5", slow="view"):
        """Tools of which one takes its time, so that a job can be killed in its midst."""
        self.bin = pathlib.Path("slow").absolute()
        self.bin.mkdir()
        for name in {"model", "view", "project", "zbuf", "split", "join"} - {slow}:
            (self.bin / name).symlink_to(BIN / name)
        (self.bin / slow).write_text(f'#!/bin/sh\n{script}\nexec {BIN}/{slow} "$@"\n')
        (self.bin / slow).chmod(0o755)

    def words(self, settings, *more):
        return [FARM, "scene.txt", "config.txt", *settings, "-o", "farm.ppm", "--z-buffer", "farm.txt", *more]

    def farm(self, settings, *more):
        return subprocess.run(self.words(settings, *more), capture_output=True, text=True, timeout=200, env={**os.environ, "BIN": str(self.bin)})

    def expect(self, settings, is_lit):
        """The files of one pipe, with which those of farm are compared."""
        pathlib.Path("scene.txt").write_text(scene(is_lit))
        at = next((i for i, word in enumerate(settings) if word in OF_PROJECT), len(settings))
        depths = pipe(["model"], ["view"], ["project", *settings[at:at + 2]], ["zbuf", "config.txt", *settings[:at], *settings[at + 2:], "-o", "one.ppm"],
                      stdin=pathlib.Path("scene.txt").read_text())
        self.expected = depths, pathlib.Path("one.ppm").read_bytes()

    def assert_as_expected(self):
        self.assertTrue(pathlib.Path("farm.txt").read_bytes() == self.expected[0], "the depths differ")
        self.assertTrue(pathlib.Path("farm.ppm").read_bytes() == self.expected[1], "the images differ")

    def check(self, settings, *more):
        for name in ("farm.ppm", "farm.txt"):
            pathlib.Path(name).unlink(missing_ok=True)
        done = self.farm(settings, *more)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        self.assert_as_expected()
        return done.stderr


class Local(FarmTest):
    def test_parts_and_bands(self):
        for is_lit in (False, True):
            for settings in SETTINGS:
                self.expect(settings, is_lit)
                for cut in (["--parts", "20"], ["--parts", "3", "--bands", "3"], ["--parts", "1", "--bands", "4"]):
                    with self.subTest(is_lit=is_lit, settings=settings, cut=cut):
                        self.assertEqual(self.check(settings, *cut), "")
                        self.assertFalse(pathlib.Path("farm.ppm.farm").exists())

    def test_other_formats(self):
        self.expect([], True)
        pipe(["model"], ["view"], ["project"], ["zbuf", "config.txt", "-o", "one.bmp"], stdin=scene(True))
        for name in ("farm.bmp", "farm.png"):
            for cut in (["--parts", "4"], ["--bands", "3"]):
                done = subprocess.run([FARM, "scene.txt", "config.txt", "-o", name, *cut], capture_output=True, env={**os.environ, "BIN": str(BIN)})
                self.assertEqual((done.returncode, done.stderr), (0, b""))
                self.assertEqual(read_picture(name), read_picture("one.bmp"))
        self.assertEqual(pathlib.Path("farm.bmp").read_bytes(), pathlib.Path("one.bmp").read_bytes())

    def test_an_empty_picture_is_noted_once(self):
        pathlib.Path("scene.txt").write_text(CAMERA + "triangle\n0 0 9\n1 0 9\n0 1 9\n" * 9 + "end\n")
        done = self.farm([])
        self.assertEqual((done.returncode, done.stderr), (0, "zbuf: note: the picture is empty: no triangle came\n"))

    def test_a_killed_worker(self):
        for is_lit in (False, True):
            self.expect([], is_lit)
            shutil.rmtree("slow", ignore_errors=True)
            self.use_slow_tools()
            process = subprocess.Popen(self.words([], "--parts", "4", "--keep", "--", "--jobs", "2"), env={**os.environ, "BIN": str(self.bin)},
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            victim, _ = chain_to_zbuf("seen-0-0-2.txt", process.pid)[0]
            time.sleep(0.3)
            os.kill(victim, signal.SIGKILL)
            killed = time.time()
            _, said = process.communicate(timeout=200)
            self.assertEqual(process.returncode, 0, said)
            self.assert_as_expected()
            self.assertGreater(logged("farm.ppm.farm", "seen-0-0-2.txt")[1], killed, "the worker was not in its midst, or was not started again")
            shutil.rmtree("farm.ppm.farm")

    def test_a_second_run_does_what_is_left(self):
        self.expect([], True)
        self.use_slow_tools(f'case "$*" in *parts/3.txt) [ -e {pathlib.Path.cwd()}/mended ] || exit 3 ;; esac', "model")
        done = self.farm([], "--parts", "5", "--", "--jobs", "1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("farm: no picture: 1 of 5 parts are missing, the first is seen-0-0-3.txt (of parts/3.txt); farm.ppm.farm/jobs.log tells where they ran, ", done.stderr)
        self.assertIn("seen-0-0-3.txt: zbuf: ", done.stderr)
        self.assertFalse(pathlib.Path("farm.ppm").exists() or pathlib.Path("farm.txt").exists())
        before = {path.name: path.stat().st_mtime_ns for path in pathlib.Path("farm.ppm.farm").glob("seen*")}
        self.assertEqual(len(before), 4)
        pathlib.Path("mended").touch()
        self.check([], "--parts", "5", "--keep")
        after = {path.name: path.stat().st_mtime_ns for path in pathlib.Path("farm.ppm.farm").glob("seen*")}
        self.assertEqual({name: after[name] for name in before}, before)
        # Another scene is drawn anew.
        self.expect([], False)
        self.bin = BIN
        self.check([], "--parts", "5")


class OtherMachines(FarmTest):
    def test_hosts_of_which_some_fail(self):
        """Four hosts: to one the connection is killed, on one the disk is full, one does not answer."""
        listener = socket.create_server(("127.0.0.1", 0), backlog=20)
        self.addCleanup(listener.close)
        full = "ulimit -f 1; eval \\\"$SSH_ORIGINAL_COMMAND\\\""
        server = SshServer(self, ["w1", "w2", "w3", "w4"], {"w3": full}, {"w4": listener.getsockname()[1]})
        hosts = ["--", *server.words, "--sshlogin", "1/w1,1/w2,1/w3,1/w4"]
        for is_lit in (False, True):
            for settings in SETTINGS:
                with self.subTest(is_lit=is_lit, settings=settings):
                    self.expect(settings, is_lit)
                    shutil.rmtree("slow", ignore_errors=True)
                    self.use_slow_tools("sleep 0.5")
                    process = subprocess.Popen(self.words(settings, "--parts", "4", "--keep", *hosts), env={**os.environ, "BIN": str(self.bin)},
                                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
                    victim = next(i for i, name in chain_to_zbuf("seen-0-0-1.txt", server.process.pid) if name.startswith("sshd"))
                    self.assertNotEqual(victim, server.process.pid)
                    os.kill(victim, signal.SIGKILL)
                    killed = time.time()
                    _, said = process.communicate(timeout=200)
                    self.assertEqual(process.returncode, 0, said)
                    self.assert_as_expected()
                    jobs = [logged("farm.ppm.farm", f"seen-0-0-{i}.txt") for i in range(1, 5)]
                    self.assertGreater(jobs[0][1], killed, "the connection was not in its midst, or was not made again")
                    self.assertLessEqual({host for host, *_ in jobs}, {"w1", "w2"})
                    self.assertEqual({status for *_, status in jobs}, {0})
                    shutil.rmtree("farm.ppm.farm")


class Refusals(FarmTest):
    def test_what_cannot_be_distributed(self):
        self.expect([], False)
        for words, reason in ((["--probe", "1,2"], "expected no --probe: it tells of triangles that are hidden, and a part does not know what hides them"),
                              (["--fragments=f.txt"], "expected no --fragments: it lists triangles that are hidden, and a part does not know what hides them"),
                              (["--stats", "-"], "expected no --stats: it counts triangles that are hidden"),
                              (["--parts", "0"], "expected a whole number from 1 to 9999, found '0'"), (["--seen", "x"], "unrecognized arguments: --seen x")):
            done = self.farm(words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn(reason, done.stderr)

    def test_what_the_tools_refuse(self):
        self.expect([], False)
        done = self.farm(["--samples", "99"])
        self.assertEqual((done.returncode, done.stderr), (1, "farm: zbuf: --samples: expected a whole number from 1 to 16, found '99' (try zbuf --help)\n"))
        pathlib.Path("scene.txt").write_text("0 0 5\n")
        done = self.farm([])
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Afarm: split: \S*scene.txt:2:1: expected the four lines of the camera, found the end of the input\n\Z")
        pathlib.Path("scene.txt").write_text(scene(False).replace("end\n", "triangle\n0 0 0\n1 0 0\n0 x 0\nend\n"))
        done = self.farm([], "--parts", "3")
        self.assertEqual(done.returncode, 1)
        self.assertIn("seen-0-0-3.txt: model: parts/3.txt:", done.stderr)
        self.assertIn("farm: no picture: 1 of 3 parts are missing, the first is seen-0-0-3.txt (of parts/3.txt)", done.stderr)
        self.assertFalse(pathlib.Path("farm.ppm").exists())


class JoinImages(FarmTest):
    def test_bands_of_every_format(self):
        text = pipe(["model"], ["view"], ["project"], stdin=scene(True))
        rng = random.Random(2)
        for columns, extension in ((50, "ppm"), (51, "bmp"), (50, "bmp"), (53, "png")):
            cuts = sorted(rng.sample(range(1, 40), 3))
            pipe(["zbuf", "--size", f"{columns}x40", "-o", f"whole.{extension}"], stdin=text)
            names = [f"{first}.{extension}" for first in [0, *cuts]]
            for name, first, end in zip(names, [0, *cuts], [*cuts, 40]):
                pipe(["zbuf", "--size", f"{columns}x40", "--rows", f"{first}:{end}", "-o", name], stdin=text)
            done = subprocess.run([SOURCE / "scripts/join-images", *names, "-o", f"joined.{extension}"], capture_output=True)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertEqual(read_picture(f"joined.{extension}"), read_picture(f"whole.{extension}"))
            if extension != "png":
                self.assertEqual(pathlib.Path(f"joined.{extension}").read_bytes(), pathlib.Path(f"whole.{extension}").read_bytes())

    def test_what_is_wrong(self):
        triangle = "0 0 0\n1 0 0\n0 1 0\n"
        for name, size in (("a.ppm", "5x4"), ("b.ppm", "6x4"), ("c.bmp", "5x4"), ("d.png", "5x4")):
            self.assertEqual(run("zbuf", "--size", size, "-o", name, stdin=triangle).returncode, 0)
        for name in ("a.ppm", "c.bmp", "d.png"):
            pathlib.Path("cut." + name[-3:]).write_bytes(pathlib.Path(name).read_bytes()[:-20])
        pathlib.Path("text").write_text("0 0 0\n")
        for words, message in ((["a.ppm", "b.ppm"], "b.ppm: expected a PPM of 5 columns as a.ppm, found a PPM of 6"), (["a.ppm", "c.bmp"], "c.bmp: expected a PPM of 5 columns as a.ppm, found a BMP of 5"),
                               (["cut.ppm"], "cut.ppm: expected 71 bytes, found 51"), (["cut.bmp"], "cut.bmp: expected 118 bytes, found 98"), (["text"], "text: expected a BMP, PPM or PNG"),
                               (["gone"], "cannot read gone: No such file or directory"), (["d.png", "cut.png"], "cut.png: ")):
            done = subprocess.run([SOURCE / "scripts/join-images", *words, "-o", "out.ppm"], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr[:len(message) + 13], f"join-images: {message}")
            self.assertFalse(pathlib.Path("out.ppm").exists())


if __name__ == "__main__":
    unittest.main()
