#!/usr/bin/env python3
"""The files that the Python scripts write appear complete or not at all, and nothing else changes.

usage: output_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import resource
import signal
import stat
import subprocess
import sys
import threading
import unittest

from devices import IS_ROOT, full_device, null_device

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from toolbox import BIN, SOURCE, ToolTest, end_by_signal, heed_signals  # noqa: E402

SCRIPTS = SOURCE / "scripts"


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (50, 50))


def script(name, *words, **settings):
    return subprocess.run([SCRIPTS / name, *words], capture_output=True, timeout=120,
                          env={"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}, **settings)


def in_fly(python, **settings):
    """Runs a line with fly's window, for its writing only; that needs no display."""
    program = ("import sys; sys.path.insert(0, sys.argv[1]); sys.dont_write_bytecode = True\n"
               "from fly_parts.window import FlyWindow\n"
               "window = FlyWindow.__new__(FlyWindow); window.say = print\n" + python)
    return subprocess.run([sys.executable, "-c", program, SCRIPTS], capture_output=True, timeout=60, **settings)


def mode_of(path):
    return stat.S_IMODE(os.stat(path).st_mode)


class Writers:
    """Claims about every command that writes a file; `write(path)` runs one, `is_whole(bytes)` checks its output."""
    status = 1

    def assert_written(self, done):
        self.assertEqual((done.stderr.decode(), done.returncode), ("", self.good_status))

    def assert_refused(self, done, message):
        self.assertEqual((done.stderr.decode(), done.returncode), (f"{self.name}: {message}\n", self.status))

    def setUp(self):
        super().setUp()
        self.prepare()
        self.before = self.files()

    def left(self):
        return [name for name in self.files() if name not in self.before]

    def test_a_new_file_has_the_permissions_of_the_umask(self):
        for umask, mode in ((0o022, 0o644), (0o077, 0o600)):
            self.assert_written(self.write("x", preexec_fn=lambda: os.umask(umask)))
            self.assertTrue(self.is_whole(pathlib.Path("x").read_bytes()))
            self.assertEqual(mode_of("x"), mode)
            self.assertEqual(self.left(), ["x"])
            os.unlink("x")

    def test_a_replaced_file_keeps_its_permissions(self):
        for mode in (0o600, 0o640, 0o666):
            pathlib.Path("x").write_text("old")
            os.chmod("x", mode)
            self.assert_written(self.write("x"))
            self.assertTrue(self.is_whole(pathlib.Path("x").read_bytes()))
            self.assertEqual(mode_of("x"), mode)

    def test_who_has_the_old_file_open_keeps_it(self):
        pathlib.Path("x").write_text("old")
        with open("x") as old:
            self.assert_written(self.write("x"))
            self.assertEqual(old.read(), "old")

    def test_a_link_stays_and_its_target_is_replaced(self):
        os.mkdir("there")
        for exists in (False, True):
            os.symlink("second", "first") if not exists else None
            os.symlink("there/x", "second") if not exists else None
            self.assert_written(self.write("first"))
            self.assertEqual((os.readlink("first"), os.readlink("second")), ("second", "there/x"))
            self.assertTrue(self.is_whole(pathlib.Path("there/x").read_bytes()))
            self.assertEqual(os.listdir("there"), ["x"])

    def test_nobodys_file_is_in_the_way(self):
        """Predictable names, and links from them."""
        pathlib.Path("precious").write_text("mine")
        pathlib.Path("x.new").write_text("mine")
        os.symlink("precious", "y.new")
        for name in ("x", "y"):
            self.assert_written(self.write(name))
        self.assertEqual([pathlib.Path(name).read_text() for name in ("precious", "x.new", "y.new")], ["mine"] * 3)
        self.assertFalse(os.path.islink("x") or os.path.islink("y"))

    def test_a_pipe_is_written_to_and_stays(self):
        os.mkfifo("pipe")
        got = []
        reader = threading.Thread(target=lambda: got.append(pathlib.Path("pipe").read_bytes()))
        reader.start()
        self.assert_written(self.write("pipe"))
        reader.join(60)
        self.assertTrue(self.is_whole(got[0]))
        self.assertTrue(stat.S_ISFIFO(os.stat("pipe").st_mode))

    def test_a_device_is_written_to_and_stays(self):
        null, full = null_device(), full_device()
        os.symlink(null, "link")
        self.assert_written(self.write("link"))
        self.assertTrue(os.path.islink("link") and stat.S_ISCHR(os.stat(null).st_mode))
        self.assert_refused(self.write(full), f"cannot write {full}: No space left on device")
        self.assertTrue(stat.S_ISCHR(os.stat(full).st_mode))

    def test_standard_output_is_written_to_and_stays(self):
        os.symlink("/proc/self/fd/1", "out")
        with open("log", "wb") as log:
            inode = os.fstat(log.fileno()).st_ino
            words = self.words("out")
            done = subprocess.run(words, stdout=log, stderr=subprocess.PIPE, timeout=120, env={"BIN": str(BIN), "PATH": "/usr/bin:/bin"})
        self.assert_written(done)
        self.assertEqual((os.stat("log").st_ino, os.readlink("out")), (inode, "/proc/self/fd/1"))
        self.assertTrue(self.is_whole(pathlib.Path("log").read_bytes()))

    def test_what_cannot_be_written_is_named(self):
        os.mkdir("folder")
        os.symlink("loop", "loop")
        for path, message in (("folder", "open folder: Is a directory"), ("none/x", "open none/x: No such file or directory"),
                              ("loop", "open loop: Too many levels of symbolic links")):
            self.assert_refused(self.write(path), f"cannot {message}")

    @unittest.skipIf(IS_ROOT, "root may write everything")
    def test_a_protected_file_is_not_replaced(self):
        pathlib.Path("x").write_text("old")
        os.chmod("x", 0o444)
        self.assert_refused(self.write("x"), "cannot open x: Permission denied")

    def test_where_there_is_no_room_the_old_file_stays(self):
        pathlib.Path("x").write_text("old")
        for name in ("x", "new"):
            self.assert_refused(self.write(name, preexec_fn=limit_files), f"cannot write {name}: File too large")
        self.assertEqual(pathlib.Path("x").read_text(), "old")
        self.assertEqual(self.left(), ["x"])

    def test_names_may_hold_anything(self):
        for name in (b"-x", b"a b", b"a\nb", b"a'\"b", b"a\xffb"):
            self.assert_written(self.write(name))
            self.assertTrue(self.is_whole(pathlib.Path(os.fsdecode(name)).read_bytes()))

    def write(self, path, **settings):
        return subprocess.run(self.words(path), capture_output=True, timeout=120,
                              env={"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}, **settings)


class Compare(Writers, ToolTest):
    name, good_status, status = "compare", 1, 2

    def prepare(self):
        pixels = bytes(i * i * 7 % 251 for i in range(48))
        pathlib.Path("a").write_bytes(b"P6 4 4 255\n" + pixels)
        pathlib.Path("b").write_bytes(b"P6 4 4 255\n" + pixels[::-1])

    def words(self, path):
        return [SCRIPTS / "compare", "a", "b", b"--image=" + os.fsencode(path)]

    def is_whole(self, data):
        return data.startswith(b"\x89PNG") and b"IEND" in data


class Inspect(Writers, ToolTest):
    name, good_status = "inspect", 0

    def prepare(self):
        pathlib.Path("config.txt").write_text("8 8\n")

    def words(self, path):
        return [SCRIPTS / "inspect", "scene.txt", "config.txt", b"--output=" + os.fsencode(path)]

    def is_whole(self, data):
        return data.startswith(b"<!") and data.rstrip().endswith(b"</html>")

    def test_where_there_is_no_room_the_old_file_stays(self):
        """zbuf's own files fit on the disk, the page does not."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (10000, 10000))
        pathlib.Path("x").write_text("old")
        for name in ("x", "new"):
            self.assert_refused(self.write(name, preexec_fn=limit), f"cannot write {name}: File too large")
        self.assertEqual(pathlib.Path("x").read_text(), "old")
        self.assertEqual(self.left(), ["x"])

    def test_scene_and_config_may_be_named_anything_and_be_pipes(self):
        for name in (b"-x", b"--", b"a\nb", b"a'\"b", b"a\xffb"):
            for kind in ("scene", "config"):
                pathlib.Path(os.fsdecode(name + kind.encode())).write_bytes(pathlib.Path(f"{kind}.txt").read_bytes())
            self.assert_written(script("inspect", "-o", "page", "--", name + b"scene", name + b"config"))
        pathlib.Path("page").unlink()
        line = f'"{SCRIPTS}/inspect" -o page <(cat scene.txt) <(cat config.txt) && "{SCRIPTS}/inspect" -o page - config.txt < scene.txt'
        self.assert_written(subprocess.run(["bash", "-c", line], capture_output=True, env={"BIN": str(BIN), "PATH": "/usr/bin:/bin"}))
        self.assertTrue(self.is_whole(pathlib.Path("page").read_bytes()))

    def test_a_signal_leaves_nothing(self):
        os.mkfifo("pipe")
        for number in (signal.SIGINT, signal.SIGTERM):
            process = subprocess.Popen([SCRIPTS / "inspect", "pipe", "config.txt", "-o", "page"], stderr=subprocess.PIPE, env={"BIN": str(BIN), "PATH": "/usr/bin:/bin"},
                                       preexec_fn=heed_signals)
            with open("pipe", "wb"):
                self.assertEqual(end_by_signal(process, number)[1], b"")
            self.assertEqual(process.returncode, -number)
        self.assertEqual(self.left(), ["pipe"])


class Fly(ToolTest):
    """p and P write through the same module; the window shows the error."""

    def test_what_it_writes_is_whole(self):
        os.mkdir("folder")
        pathlib.Path("old").write_text("old")
        os.symlink("old", "link")
        full = full_device()
        done = in_fly(f"window.write('link', lambda: b'new'); window.write('folder', lambda: b'new'); window.write('{full}', lambda: b'new')")
        self.assertEqual(done.stderr.decode(), "")
        self.assertEqual(done.stdout.decode(), f"wrote link\ncannot open folder: Is a directory\ncannot write {full}: No space left on device\n")
        self.assertEqual((os.readlink("link"), pathlib.Path("old").read_text()), ("old", "new"))

    def test_comments_stay_as_they_are(self):
        pathlib.Path("-scene").write_bytes(b"\xef\xbb\xbf# gr\xfcn\r\n0 0 5\r\n0 0 0\r\n0 1 0\r\n60 1 1 100 # gr\xfcn\r\nend\r\n")
        done = in_fly("from types import SimpleNamespace as Any\n"
                      "window.scene, window.is_light_moved, window.settings = './-scene', False, Any(camera=Any(lines=lambda: [['1', '2', '3'], ['0', '0', '0'], ['0', '1', '0']]))\n"
                      "sys.stdout.buffer.write(window.scene_text())")
        self.assertEqual((done.stderr, done.stdout), (b"", b"# gr\xfcn\r\n1 2 3\n0 0 0\n0 1 0\n60 1 1 100 # gr\xfcn\r\nend\r\n"))

    def test_a_config_that_is_none_is_zbufs_message(self):
        for name, text, message in (("-c", "x y\n", r"zbuf: \./-c:1:1: expected .*"), ("c", "", r"zbuf: c:1:1: expected .*")):
            pathlib.Path(name).write_text(text)
            done = script("fly", "--", "scene.txt", name)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr.decode(), rf"\Afly: {message}\n\Z")


class MakeTorus(ToolTest):
    def run_in_shell(self, channels):
        return subprocess.run(["bash", "-c", f'"{SCRIPTS}/make-torus" --around 200 {channels}; echo ${{PIPESTATUS[0]}} >&2'], capture_output=True)

    def test_its_output_is_checked(self):
        self.assertEqual(self.run_in_shell("> /dev/full").stderr, b"make-torus: cannot write <stdout>: No space left on device\n1\n")
        self.assertEqual(self.run_in_shell(">&-").stderr, b"make-torus: cannot write <stdout>: Bad file descriptor\n1\n")
        self.assertEqual(self.run_in_shell("| head -n 1").stderr, b"141\n")

    def test_what_makes_no_torus_is_refused(self):
        for option, value, expected in (("around", "2", "a whole number of at least 3"), ("tube", "x", "a whole number of at least 3"),
                                        ("major", "0", "a number greater than 0"), ("minor", "nan", "a number greater than 0")):
            done = script("make-torus", f"--{option}={value}")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"argument --{option}: expected {expected}, found '{value}'", done.stderr.decode())


class OwnFiles(ToolTest):
    """Descriptors the scripts write to; these tests write nothing themselves."""

    def test_names_of_the_process_own_files(self):
        sys.path.insert(0, str(SCRIPTS))
        from lib.output_file import own_descriptor, target_of
        for path, number in (("/dev/stdout", 1), ("/dev/stderr", 2), ("/dev/fd/12", 12), ("/proc/self/fd/3", 3),
                             ("/dev/stdin", None), ("/dev/null", None), ("/dev/fd/x", None), ("dev/stdout", None), ("/dev/stdout/", None)):
            self.assertEqual(own_descriptor(path), number, path)
        os.symlink("/dev/stdout", "first")
        os.symlink("first", "second")
        self.assertEqual(target_of("second"), "/dev/stdout")


class Tools(ToolTest):
    def test_the_current_folder_may_be_theirs(self):
        """Not the programs of the same names on the PATH."""
        for tool in ("model", "view", "project", "zbuf"):
            os.symlink(BIN / tool, tool)
        done = subprocess.run([SCRIPTS / "inspect", "scene.txt", "config.txt"], capture_output=True, env={"BIN": ".", "PATH": "/usr/bin:/bin"})
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))


if __name__ == "__main__":
    unittest.main()
