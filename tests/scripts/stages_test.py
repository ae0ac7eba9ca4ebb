#!/usr/bin/env python3
"""scripts/stages: all five files or none, whatever was there before, and whatever the names.

usage: stages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import os
import pathlib
import resource
import shutil
import stat
import subprocess
import sys
import threading
import unittest
from unittest import mock

from devices import null_device
from toolbox import BIN, SOURCE, ToolTest, tools_with

STAGES = SOURCE / "scripts/stages"
SAMPLE = SOURCE / "samples/worked-example"
FIVE = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
ENVIRONMENT = {"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}


def run_stages(*words, **settings):
    return subprocess.run([STAGES, *words], capture_output=True, timeout=120, env=ENVIRONMENT, **settings)


def mode_of(path):
    return stat.S_IMODE(os.stat(path).st_mode)


class Stages(ToolTest):
    def setUp(self):
        super().setUp()
        self.before = self.files()

    def stages(self, folder, scene=SAMPLE / "scene.txt", config=SAMPLE / "config.txt", **settings):
        return run_stages(scene, config, folder, **settings)

    def assert_made(self, done, folder="."):
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))
        for name in FIVE:
            self.assertEqual(pathlib.Path(folder, name).read_bytes(), (SAMPLE / name).read_bytes(), name)

    def assert_refused(self, done, message):
        self.assertEqual((done.stderr.decode(), done.returncode), (f"stages: {message}\n", 1))

    def left(self, folder="."):
        return sorted(name for name in os.listdir(folder) if folder != "." or name not in self.before)

    def test_a_wrong_command_line_is_named(self):
        for words, reason in (((), "the following arguments are required: SCENE, CONFIG, DIR"),
                              (("scene.txt",), "the following arguments are required: CONFIG, DIR"),
                              (("scene.txt", "--size", "640x480", "out"), "unrecognized arguments: --size"),
                              (("scene.txt", "config.txt", ""), "expected the name of a folder, found ''"),
                              (("scene.txt", "config.txt", "a", "b"), "unrecognized arguments: b")):
            done = run_stages(*words)
            told = f"stages: {reason} (try stages --help)\n"
            self.assertEqual((done.stderr.decode(), done.returncode), (told, 2))

    def test_a_sphere_names_the_ways_to_draw_it(self):
        pathlib.Path("scene").write_text((SAMPLE / "scene.txt").read_text().replace(
            "\nend", "\nsphere 0 0 0 1\nend"))
        line = pathlib.Path("scene").read_text().split("sphere")[0].count("\n") + 1
        self.assert_refused(
            self.stages("dir", scene="scene"),
            f"model: scene:{line}:1: expected triangles alone, found a sphere: trace draws it, and model "
            f"--facets N makes triangles of it")
        self.assertFalse(os.path.exists("dir"))

    def test_a_folder_in_a_files_place_is_refused(self):
        for name in FIVE:
            os.makedirs(f"dir/{name}")
            self.assert_refused(self.stages("dir"), f"cannot open dir/{name}: Is a directory")
            self.assertEqual((self.left("dir"), os.listdir(f"dir/{name}")), ([name], []))
            os.rmdir(f"dir/{name}")
        os.mkdir("elsewhere")
        os.symlink("../elsewhere", "dir/out.bmp")
        self.assert_refused(self.stages("dir"), "cannot open dir/out.bmp: Is a directory")
        self.assertEqual(os.listdir("elsewhere"), [])

    def test_a_file_in_the_folders_place_is_refused(self):
        pathlib.Path("dir").write_text("old")
        self.assert_refused(self.stages("dir"), "cannot make the folder dir: File exists")
        self.assertEqual(pathlib.Path("dir").read_text(), "old")

    def test_a_run_that_fails_leaves_no_folder(self):
        pathlib.Path("bad").write_text("x\n")
        os.mkdir("old")
        for folder in ("dir", "old/a/b//c/", "./dir/dir", "old/../dir", "new/../dir"):
            with self.subTest(folder):
                self.assert_refused(self.stages(folder, scene="bad"),
                                    "model: bad:1:1: expected the x of the eye, found 'x'")
                self.assertEqual((self.left(), os.listdir("old")), (["bad", "old"], []))
        with open("bad") as bad:
            self.assert_refused(self.stages("dir", scene="-", stdin=bad),
                                "model: <stdin>:1:1: expected the x of the eye, found 'x'")
        self.assertEqual(self.stages("dir", config="none").returncode, 1)
        self.assertEqual(self.left(), ["bad", "old"])
        shutil.copy(SAMPLE / "scene.txt", "scene")
        with mock.patch.dict(ENVIRONMENT, BIN=str(tools_with("zbuf", ""))):
            self.assert_refused(self.stages("scene.out", scene="scene"),
                                "zbuf: has not written all of scene.out/out.bmp, though it ended well")

    def test_an_old_folder_stays_even_if_it_is_empty(self):
        pathlib.Path("bad").write_text("x\n")
        os.mkdir("dir")
        self.stages("dir", scene="bad")
        self.assertEqual(os.listdir("dir"), [])

    def test_links_permissions_pipes_and_devices_stay(self):
        os.makedirs("dir")
        os.makedirs("there")
        pathlib.Path("dir/stage1.txt").write_text("old")
        os.chmod("dir/stage1.txt", 0o640)
        os.symlink("../there/two", "dir/stage2.txt")
        pathlib.Path("there/two\n").write_text("old")
        os.chmod("there/two\n", 0o600)
        os.symlink("../there/two\n", "there/two")
        os.symlink(os.path.abspath(null_device()), "dir/stage3.txt")
        os.symlink("../there/new", "dir/z_buffer.txt")
        os.mkfifo("dir/out.bmp")
        got = []
        reader = threading.Thread(target=lambda: got.append(pathlib.Path("dir/out.bmp").read_bytes()))
        reader.start()
        done = self.stages("dir", preexec_fn=lambda: os.umask(0o027))
        with contextlib.suppress(OSError):  # so that the reader ends if there is no writer
            os.close(os.open("dir/out.bmp", os.O_WRONLY | os.O_NONBLOCK))
        reader.join(60)
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))
        self.assertEqual(got, [(SAMPLE / "out.bmp").read_bytes()])
        self.assertEqual((mode_of("dir/stage1.txt"), mode_of("there/two"), mode_of("there/new")),
                         (0o640, 0o600, 0o640))
        for link, target, name in (("dir/stage2.txt", "../there/two", "stage2.txt"),
                                   ("dir/z_buffer.txt", "../there/new", "z_buffer.txt")):
            self.assertEqual(os.readlink(link), target)
            self.assertEqual(pathlib.Path(link).read_bytes(), (SAMPLE / name).read_bytes())
        self.assertTrue(stat.S_ISCHR(os.stat("dir/stage3.txt").st_mode))
        self.assertEqual((self.left("there"), self.left("dir")), (["new", "two", "two\n"], sorted(FIVE)))

    def test_where_there_is_no_room_all_stays(self):
        os.mkdir("dir")
        pathlib.Path("dir/stage1.txt").write_text("old")
        for folder, kept in (("dir", ["dir"]), ("new", ["dir"])):
            done = self.stages(folder, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (80, 80)))
            self.assert_refused(done, f"model: cannot write {folder}/stage1.txt: File too large")
            self.assertEqual((self.left(), self.left("dir"), pathlib.Path("dir/stage1.txt").read_text()),
                             (kept, ["stage1.txt"], "old"))

    def test_names_may_hold_anything(self):
        for name in (b"-x", b"--help", b"a b", b"a\nb\n", b"a'\"$(x)b", b"a\xffb"):
            with self.subTest(name):
                for kind in (b"scene", b"config"):
                    pathlib.Path(os.fsdecode(name + kind)).write_bytes(
                        (SAMPLE / f"{kind.decode()}.txt").read_bytes())
                self.assert_made(run_stages("--", name + b"scene", name + b"config", name), os.fsdecode(name))

    def test_notes_name_no_text_that_does_not_stay(self):
        pathlib.Path("far.txt").write_text(
            "-1e34 0.5 1e32\n0 5 9\n0 1 0\n60 1 1 10\ntriangle\n1 2 3\n4 5 6\n7 8 9\nend\n")
        notes = self.stages("out", scene="far.txt").stderr.decode().splitlines()
        self.assertIn(
            "view: note: the digits of a vertex and of 2 more are not certain: numbers cancel here, and "
            "31 digits are too few", notes)
        self.assertEqual([note for note in notes if "exact" in note or notes.count(note) > 1], [])
        pathlib.Path("near.txt").write_text(
            "0 0 5\n0 0 0\n0 1 0\n60 1 1 10\ntranslate 1e30 0 0\nrotate 33 1 2 3\ntranslate -1e30 0 0\n"
            "triangle\n1 2 3\n4 5 6\n7 8 8\nend\n")
        notes = [
            note for note in self.stages("out", scene="near.txt").stderr.decode().splitlines()
            if note.startswith("model")]
        self.assertEqual(notes, [
            "model: note: near.txt:9:1: the digits of this vertex and of 2 more are not certain: numbers "
            "cancel here, and 31 digits are too few"])

    def test_pipes_are_read_once(self):
        line = (f'"{STAGES}" <(cat "{SAMPLE}/scene.txt") <(cat "{SAMPLE}/config.txt") one && "{STAGES}" - '
                f'"{SAMPLE}/config.txt" two < "{SAMPLE}/scene.txt"')
        done = subprocess.run(["bash", "-c", line], capture_output=True, env=ENVIRONMENT)
        self.assert_made(done, "one")
        self.assert_made(done, "two")


class PlainFile(ToolTest):
    """scripts/lib/text/plain_stage_text.py, which people copy."""
    def test_it_reads_and_writes_what_the_tools_write(self):
        shutil.copy(SOURCE / "scripts/lib/text/plain_stage_text.py", "stage_text.py")
        code = ("import sys; sys.path.insert(0, '.'); import stage_text; "
                "sys.stdout.write(stage_text.write(stage_text.read(sys.stdin.read())))")
        for sample in ("worked-example", "wide-clipped", "colored-lights", "materials"):
            text = (SOURCE / "samples" / sample / "scene.txt").read_bytes()
            for tool in ("model", "view", "project"):
                text = subprocess.run([BIN / tool], input=text, capture_output=True, check=True).stdout
                if b"\nclipped\n" in text:  # its pieces alone are read
                    continue
                done = subprocess.run([sys.executable, "-I", "-c", code], input=text, capture_output=True)
                self.assertEqual((done.stdout == text, done.stderr), (True, b""), (sample, tool))


if __name__ == "__main__":
    unittest.main()
