#!/usr/bin/env python3
"""scripts/farm: the picture and the depths are those of one pipe, whatever the parts, the machines, and who
is killed.

usage: farm_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import struct
import subprocess
import time
import unittest
import unittest.mock
import zlib

from lib.showing.pictures import png_chunks, read_picture, unfiltered
from random_scene import scene_of_parts as scene
from ssh_server import SshServer
from toolbox import BIN, CAMERA, NO_TRIANGLE, SOURCE, ToolTest, pipe, run, run_script, tools_with

FARM = SOURCE / "scripts/farm"
# Options of project and of zbuf.
SETTINGS = ("", ""), ("", "--coverage center --samples 2"), ("--clip frustum", "--wireframe --depth f32")
SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12)) * 2  # fewer with sanitizers, see CMakeLists.txt
PATIENCE = 240  # seconds, far more than anything here takes
# A model that waits, so that a job can be killed in its midst, however fast or slow the machine is. It leaves
# word where it began; without its part, too.
HOLD = ('for file; do :; done; [ -e "$file" ] || pwd >> {0}/without-part; echo $$ "$PWD" > '
        '"{0}/began-${{file#parts/}}"; while [ -e "$file" ] && [ ! -e {0}/go ]; do sleep 0.05; done; '
        'exec $real "$@"')


def setUpModule():  # noqa: N802
    if not shutil.which("parallel"):
        raise unittest.SkipTest("GNU parallel is missing")


def logged(output):
    """(host, start, exit status) of the job that made the output, from the job log: its last run."""
    lines = pathlib.Path("farm.ppm.farm/jobs.log").read_text().splitlines()
    row = [line for line in lines if f"draw.sh {output} " in line][-1].split("\t")
    return row[1], float(row[2]), int(row[6])


def connection_of(process):
    """The process of sshd that it is below."""
    while not pathlib.Path(f"/proc/{process}/comm").read_text().startswith("sshd"):
        process = int(pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])
    return process


def begun(farm, count, folders=""):
    """{output: the process of its model}, as soon as so many wait in folders of this pattern."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end and farm.poll() is None:
        found = {}
        for path in pathlib.Path().glob("began-*"):
            process, _, folder = path.read_text().partition(" ")
            if os.path.exists(f"/proc/{process or 0}") and re.search(folders, folder):
                found[f"seen-0-{path.stem[6:]}.txt"] = int(process)
        if len(found) >= count:
            return found
        time.sleep(0.25)
    farm.terminate()
    raise AssertionError(f"{count} jobs have not run at a time; farm has said: {farm.communicate()[1]}")


class FarmTest(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("50 40\n")
        self.bin, self.settings = BIN, []

    def expect(self, is_lit, project="", zbuf=""):
        """The files of one pipe, with which those of farm are compared."""
        pathlib.Path("scene.txt").write_text(scene(is_lit))
        self.settings = [*project.split(), *zbuf.split()]
        depths = pipe(["model", "scene.txt"], ["view"], ["project", *project.split()],
                      ["zbuf", "config.txt", *zbuf.split(), "-o", "one.ppm"])
        self.expected = depths, pathlib.Path("one.ppm").read_bytes()

    def start(self, *words):
        words = [*self.settings, "-o", "farm.ppm", "--z-buffer", "farm.txt", *words]
        return subprocess.Popen([FARM, "scene.txt", "config.txt", *words], stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, env={**os.environ, "BIN": str(self.bin)})

    def farm(self, *words):
        """The exit status and stderr of a run, which prints nothing."""
        process = self.start(*words)
        printed, said = process.communicate(timeout=PATIENCE)
        self.assertEqual(printed, "")
        return process.returncode, said

    def end(self, process, killed):
        """Ends the wait of the slow tools after some jobs were killed."""
        time_of_death = time.time()
        pathlib.Path("go").touch()
        _, said = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 0, said)
        self.assert_as_expected()
        for output in killed:
            self.assertGreater(
                logged(output)[1], time_of_death, "the job was not in its midst, or was not started again")

    def assert_as_expected(self):
        self.assertTrue(pathlib.Path("farm.txt").read_bytes() == self.expected[0], "the depths differ")
        self.assertTrue(pathlib.Path("farm.ppm").read_bytes() == self.expected[1], "the images differ")

    def check(self, *words):
        for name in ("farm.ppm", "farm.txt"):
            pathlib.Path(name).unlink(missing_ok=True)
        self.assertEqual(self.farm(*words), (0, ""))
        self.assert_as_expected()

    def refuse(self, message, *words, status=1):
        found, said = self.farm(*words)
        self.assertRegex(said, rf"\Afarm: {message}\n\Z")
        self.assertEqual(found, status)
        self.assertFalse(pathlib.Path("farm.ppm").exists() or pathlib.Path("farm.txt").exists())


class Local(FarmTest):
    def test_parts_and_bands(self):
        cuts = (["--parts", "20"], ["--parts", "3", "--bands", "3"], ["--parts", "1", "--bands", "4"])
        for is_lit, settings in itertools.product((False, True), SETTINGS):
            self.expect(is_lit, *settings)
            for cut in cuts:
                with self.subTest(is_lit=is_lit, settings=settings, cut=cut):
                    self.check(*cut)
                    self.assertFalse(pathlib.Path("farm.ppm.farm").exists())

    def test_notes_of_bands_are_about_the_whole_picture(self):
        for y, note in ((1, ""), (9, NO_TRIANGLE)):
            pathlib.Path("scene.txt").write_text(
                f"{CAMERA}triangle\n0 {y} 0\n1 {y + 1} 0\n-1 {y + 1} 0\nend\n")
            self.assertEqual(self.farm("--bands", "2", "--z-buffer", "none"), (0, note))
            self.assertFalse(os.path.exists("none"))

    def test_a_killed_worker(self):
        self.expect(True)
        self.bin = tools_with("model", HOLD.format(pathlib.Path.cwd()))
        process = self.start("--parts", "4", "--keep", "--", "--jobs", "2")
        output, worker = begun(process, 2).popitem()
        os.kill(worker, signal.SIGKILL)
        self.end(process, [output])

    def test_a_second_run_does_what_is_left(self):
        self.expect(True)
        self.bin = tools_with(
            "model", f'case "$*" in *parts/3.txt) [ -e {pathlib.Path.cwd()}/mended ] || exit 3 ;; esac\n'
            'exec $real "$@"')
        self.refuse("no picture: 1 of 5 parts are missing: seen-0-3.txt: model: exit status 3; .*", "--parts",
                    "5", "--", "--jobs", "1")
        before = {path: path.stat().st_mtime_ns for path in pathlib.Path("farm.ppm.farm").glob("seen*")}
        self.assertEqual(len(before), 4)
        pathlib.Path("mended").touch()
        self.check("--parts", "5", "--keep")
        self.assertEqual({path: path.stat().st_mtime_ns for path in before}, before)
        # Another scene is drawn anew, and the same one by other tools.
        self.expect(False)
        self.check("--parts", "5", "--keep")
        self.bin = tools_with("project", 'exec $real --cull front "$@"')
        self.assertEqual(self.farm("--parts", "5", "--keep")[0], 0)
        self.assertNotEqual(pathlib.Path("farm.txt").read_bytes(), self.expected[0])
        self.bin = BIN
        self.check("--parts", "5", "--keep")
        # After a kill at the removal of a text: at the end, and for other settings.
        pathlib.Path("sitecustomize.py").write_text(
            "import os\nreal = os.unlink\ndef unlink(path):\n    real(path)\n"
            "    if 'seen-' in str(path): os.kill(os.getpid(), 9)\nos.unlink = unlink\n")
        for settings in ([], ["--cull", "back"]):
            with unittest.mock.patch.dict(os.environ, PYTHONPATH="."):
                self.assertEqual(self.farm(*settings, "--parts", "5")[0], -signal.SIGKILL)
            self.check("--parts", "5", "--keep")
        # A text that the disk has cut short is made anew.
        path = max(pathlib.Path("farm.ppm.farm").glob("seen*"), key=os.path.getsize)
        os.truncate(path, path.stat().st_size // 2)
        self.check("--parts", "5")


class AnyCut(ToolTest):
    """What farm's jobs do, in any cut, order of work and grouping of joins; random scenes, and options of all
    kinds."""

    PROJECT = ("", "--clip near", "--clip frustum", "--aspect ratio", "--cull back")
    ZBUF = ("--coverage center", "--depth f32", "--depth u24 --algorithm scanline", "--samples 2",
            "--samples 3 --coverage center", "--wireframe", "--depth-epsilon 0.05", "--threads 2")

    def seen_of_parts(self, rng, project, zbuf):
        """The texts of the parts, which are drawn in any order."""
        listed = pipe(["cut-scene", "scene.txt", rng.choice((2, 3, 7, 40)), "-o", "parts"])
        parts = [line.split() for line in listed.decode().splitlines()]
        for part, first in rng.sample(parts, len(parts)):
            pipe(["model", "--framed", "--first", first, part], ["view"], ["project", *project],
                 ["zbuf", "config.txt", *zbuf, "--seen", part + ".seen"], stdin=b"")
        return [part + ".seen" for part, _ in parts]

    def test_gives_the_whole(self):
        pathlib.Path("config.txt").write_text("40 30\n")
        several = fewer = 0
        for seed in range(SCENE_COUNT):
            rng = random.Random(seed)
            text = scene(rng.random() < 0.5, rng.randrange(20, 120), seed)
            pathlib.Path("scene.txt").write_bytes(text.encode())
            project, zbuf = rng.choice(self.PROJECT).split(), self.ZBUF[seed % len(self.ZBUF)].split()
            zbuf += ["--shading", rng.choice(("flat", "gouraud", "phong"))] * ("light" in text)
            with self.subTest(seed=seed, project=project, zbuf=zbuf):
                whole = pipe(["model"], ["view"], ["project", *project], stdin=text)
                depths = pipe(["zbuf", "config.txt", *zbuf, "-o", "one.ppm"], stdin=whole)
                shutil.rmtree("parts", ignore_errors=True)
                texts = self.seen_of_parts(rng, project, zbuf)
                several += len(texts) > 1 and len(set(pathlib.Path("one.ppm").read_bytes()[-3600:])) > 3
                while len(texts) > 1 and rng.random() < 0.8:
                    at = rng.randrange(len(texts) - 1)
                    end = rng.randrange(at + 2, len(texts) + 1)
                    pipe(["join-seen", "--expect-framed", *texts[at:end]],
                         ["zbuf", "config.txt", *zbuf, "--seen", texts[at]])
                    texts[at + 1:end] = []
                joined = pipe(["join-seen", "--expect-framed", *texts])
                fewer += joined.count(b"\n\n") < whole.count(b"\n\n")
                self.assertEqual(pipe(["zbuf", "config.txt", *zbuf, "-o", "many.ppm"], stdin=joined), depths)
                self.assertEqual(pathlib.Path("many.ppm").read_bytes(), pathlib.Path("one.ppm").read_bytes())
        # Else there would be nothing to prove: pictures of several parts with something in them, and
        # triangles that were left out.
        self.assertGreater(min(several, fewer), SCENE_COUNT // 2)


class OtherMachines(FarmTest):
    def test_hosts_of_which_some_fail(self):
        """Four hosts: to one the connection is killed, on one the worker, the disk of one is full, one does
        not answer."""
        listener = socket.create_server(("127.0.0.1", 0), backlog=100)
        self.addCleanup(listener.close)
        server = SshServer(self, ["w1", "w2", "w3", "w4"], full="w3", silent={
            "w4": listener.getsockname()[1]})
        hosts = ["--", *server.words, "--sshlogin", "1/w1,1/w2,1/w3,1/w4"]
        self.expect(True, *SETTINGS[1])
        self.bin = tools_with("model", HOLD.format(pathlib.Path.cwd()))
        process = self.start("--parts", "4", "--keep", *hosts)
        (one, first), (two, second), *_ = begun(process, 2, "/w[12]/").items()
        connection = connection_of(first)
        self.assertNotEqual(connection, server.process.pid)
        os.kill(connection, signal.SIGKILL)
        os.kill(second, signal.SIGKILL)
        self.end(process, [one, two])
        jobs = [logged(f"seen-0-{i}.txt") for i in range(1, 5)]
        self.assertEqual({(host, status) for host, _, status in jobs} - {("w1", 0), ("w2", 0)}, set())
        without_part = map(pathlib.Path, pathlib.Path("without-part").read_text().splitlines())
        self.assertEqual({folder.relative_to(pathlib.Path.cwd()).parts[0] for folder in without_part}, {"w3"})
        listener.settimeout(0)
        listener.accept()[0].close()  # the host that does not answer was asked


class Refusals(FarmTest):
    # A command line, and a part of what farm says.
    LINES = (
        ("--probe 1,2", "expected no --probe: it is about triangles that are hidden, and a part does not "),
        ("--fragments=f.txt", "expected no --fragments: it is about triangles that are hidden"),
        ("--stats s", "expected no --stats: it is about triangles that are hidden"),
        ("--depth-image d.pgm", "expected no --depth-image: draw it from the text of zbuf --seen"),
        ("--parts 0", "expected a whole number from 1 to 9999, found '0'"),
        ("--background 01020300",
         "--background: expected an opaque background, or -o FILE.png, found '01020300'"),
        ("--seen x", "unrecognized arguments: --seen x"),
    )

    def test_what_cannot_be_distributed(self):
        for words, reason in self.LINES:
            status, said = self.farm(*words.split())
            self.assertEqual(status, 2, words)
            self.assertIn(reason, said)

    def test_what_the_tools_refuse(self):
        self.refuse(r"zbuf: --samples: expected a whole number from 1 to 16, found '99' \(try zbuf --help\)",
                    "--samples", "99", status=2)
        pathlib.Path("scene.txt").write_text("0 0 5\n")
        self.refuse(r"cut-scene: \S*scene.txt:2:1: expected the four lines of the camera, found the end of "
                    "the input")
        text = scene(False)
        pathlib.Path("scene.txt").write_text(text.replace("end\n", "triangle\n0 0 0\n1 0 0\n0 x 0\nend\n"))
        # cut-scene reads no numbers, so model finds a wrong one.
        self.refuse(
            r"no picture: 1 of 3 parts are missing: seen-0-3.txt: model: parts/3.txt:\d+:3: expected "
            "the y of vertex 3 of 3, found 'x'; .*", "--parts", "3")
        pathlib.Path("scene.txt").write_text(text.replace("end\n", "sphere 0 0 0 1\nend\n"))
        line = text.count("\n")
        self.refuse(f"model: scene.txt:{line}:1: expected triangles alone, found a sphere: .*")
        pathlib.Path("scene.txt").unlink()
        os.symlink("/dev/zero", "scene.txt")
        self.refuse("expected a regular file, whose size tells where to cut, found scene.txt")


class JoinImages(FarmTest):
    # The files, and the beginning of the message.
    MESSAGES = (
        ("a.ppm b.ppm", "b.ppm: expected a PPM of 5 columns as a.ppm, found a PPM of 6"),
        ("a.ppm c.bmp", "c.bmp: expected a PPM of 5 columns as a.ppm, found a BMP of 5"),
        ("cut.ppm", "cut.ppm: expected 71 bytes, found 51"),
        ("cut.bmp", "cut.bmp: expected 118 bytes, found 98"),
        ("text", "text: expected a BMP, PPM, PGM or PNG"),
        ("gone", "cannot read gone: No such file or directory"),
        ("d.png cut.png", "cut.png: "),
        ("wide.png", "wide.png: expected at most 65535 columns, found 2147483647"),
        ("bomb.png", "bomb.png: expected 64 bytes of pixels, found more"),
    )

    def test_bands_of_every_format(self):
        text = pipe(["model"], ["view"], ["project"], stdin=scene(True))
        rng = random.Random(2)
        for columns, extension in ((50, "ppm"), (51, "bmp"), (50, "bmp"), (53, "png")):
            cuts = sorted(rng.sample(range(1, 40), 3))
            pipe(["zbuf", "--size", f"{columns}x40", "-o", f"whole.{extension}"], stdin=text)
            names = [f"{first}.{extension}" for first in [0, *cuts]]
            for name, first, end in zip(names, [0, *cuts], [*cuts, 40]):
                pipe(["zbuf", "--size", f"{columns}x40", "--rows", f"{first}:{end}", "-o", name], stdin=text)
            done = run_script("join-images", *names, "-o", f"joined.{extension}", text=False)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
            self.assertEqual(read_picture(f"joined.{extension}"), read_picture(f"whole.{extension}"))
            if extension != "png":
                self.assertEqual(
                    pathlib.Path(f"joined.{extension}").read_bytes(),
                    pathlib.Path(f"whole.{extension}").read_bytes())

    def test_bands_of_depth_images(self):
        text = pipe(["model"], ["view"], ["project"], stdin=scene(True))
        for extension in ("pgm", "png"):
            for rows in ("0:40", "0:13", "13:40"):
                words = ["--rows", rows, "-o", "x.ppm", "--depth-image", f"{rows}.{extension}"]
                pipe(["zbuf", "config.txt", *words], stdin=text)
            words = [f"0:13.{extension}", f"13:40.{extension}", "-o", f"joined.{extension}"]
            done = run_script("join-images", *words, text=False)
            self.assertEqual((done.returncode, done.stderr), (0, b""))
        joined, whole = (pathlib.Path(name).read_bytes() for name in ("joined.png", "0:40.png"))
        self.assertEqual(joined[:33], whole[:33])  # width, height, 16 bits gray
        gray = pathlib.Path("0:40.pgm").read_bytes()
        self.assertEqual(pathlib.Path("joined.pgm").read_bytes(), gray)
        rows = zlib.decompress(b"".join(body for kind, body in png_chunks(joined) if kind == b"IDAT"))
        above = bytes(100)
        for i in range(40):
            above = unfiltered(rows[101 * i], rows[101 * i + 1:101 * i + 101], above, 2)
            self.assertEqual(above, gray[len(gray) - 4000 + 100 * i:][:100])

    def test_what_is_wrong(self):
        triangle = "0 0 0\n1 0 0\n0 1 0\n"
        for name, size in (("a.ppm", "5x4"), ("b.ppm", "6x4"), ("c.bmp", "5x4"), ("d.png", "5x4")):
            self.assertEqual(run("zbuf", "--size", size, "-o", name, stdin=triangle).returncode, 0)
        for name in ("a.ppm", "c.bmp", "d.png"):
            pathlib.Path("cut." + name[-3:]).write_bytes(pathlib.Path(name).read_bytes()[:-20])
        pathlib.Path("text").write_text("0 0 0\n")
        png = pathlib.Path("d.png").read_bytes()
        pathlib.Path("wide.png").write_bytes(png[:16] + b"\x7f\xff\xff\xff" + png[20:])
        packed = zlib.compress(bytes(1 << 28), 9)  # where the header asks for 64 bytes
        chunk = struct.pack(">I", len(packed)) + b"IDAT" + packed + bytes(4)
        pathlib.Path("bomb.png").write_bytes(png[:33] + chunk)
        for words, message in self.MESSAGES:
            done = run_script("join-images", *words.split(), "-o", "out.ppm")
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr[:len(message) + 13], f"join-images: {message}")
            self.assertFalse(pathlib.Path("out.ppm").exists())


if __name__ == "__main__":
    unittest.main()
