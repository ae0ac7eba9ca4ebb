#!/usr/bin/env python3
"""The files that the Python scripts write appear complete or not at all, and nothing else changes.

usage: output_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import fcntl
import os
import pathlib
import resource
import shutil
import signal
import socket
import stat
import subprocess
import sys
import threading
import unittest

from devices import IS_ROOT, full_device, null_device
from toolbox import BIN, SCENE, SOURCE, ToolTest, tools_with

SCRIPTS = SOURCE / "scripts"
PLAIN = {"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}


def script(name, *words, **settings):
    settings = {"env": {**PLAIN, "HOME": os.getcwd()}, **settings}
    return subprocess.run([SCRIPTS / name, *words], capture_output=True, timeout=120, **settings)


def mode_of(path):
    return stat.S_IMODE(os.stat(path).st_mode)


class Writers:
    """Claims about every command that writes a file; `write(path)` runs one, `is_whole(bytes)` checks its
    output."""
    status = 1
    max_size = 50  # of a file, where there is no room

    def limit_files(self):
        resource.setrlimit(resource.RLIMIT_FSIZE, (self.max_size, self.max_size))

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
        for umask, mode in ((0o022, 0o644), (0o077, 0o600), (0o777, 0o600)):
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
        self.assertEqual([pathlib.Path(name).read_text() for name in ("precious", "x.new", "y.new")],
                         ["mine"] * 3)
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
            done = subprocess.run(words, stdout=log, stderr=subprocess.PIPE, timeout=120, env=PLAIN)
        self.assert_written(done)
        self.assertEqual((os.stat("log").st_ino, os.readlink("out")), (inode, "/proc/self/fd/1"))
        self.assertTrue(self.is_whole(pathlib.Path("log").read_bytes()))

    def test_what_cannot_be_written_is_named(self):
        os.mkdir("folder")
        os.symlink("loop", "loop")
        for path, message in (("folder", "open folder: Is a directory"),
                              ("none/x", "open none/x: No such file or directory"),
                              ("loop", "open loop: Too many levels of symbolic links")):
            self.assert_refused(self.write(path), f"cannot {message}")

    @unittest.skipIf(IS_ROOT, "root may write everything")
    def test_a_protected_file_is_not_replaced(self):
        pathlib.Path("x").write_text("old")
        os.chmod("x", 0o444)
        self.assert_refused(self.write("x"), "cannot open x: Permission denied")

    def test_where_there_is_no_room_the_old_file_stays(self):
        pathlib.Path("x").write_text("old")
        for name, shown in (("x", "x"), ("new", "new"), (b"a\xffb", r"a\xffb")):
            self.assert_refused(self.write(name, preexec_fn=self.limit_files),
                                f"cannot write {shown}: File too large")
        self.assertEqual(pathlib.Path("x").read_text(), "old")
        self.assertEqual(self.left(), ["x"])

    def test_names_may_hold_anything(self):
        for name in (b"-x", b"a b", b"a\nb", b"a'\"b", b"a\xffb", b"a." + b"x" * 253):
            self.assert_written(self.write(name))
            self.assertTrue(self.is_whole(pathlib.Path(os.fsdecode(name)).read_bytes()))

    def write(self, path, **settings):
        return subprocess.run(self.words(path), capture_output=True, timeout=120, env=PLAIN, **settings)


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

    def test_standard_output_is_written_to_and_stays(self):
        """There is the table already."""
        os.symlink("/proc/self/fd/1", "out")
        self.assert_refused(
            self.write("out"), "expected a place of its own for every output, found the same one "
            "for standard output and --image 'out' (try compare --help)")


class Inspect(Writers, ToolTest):
    name, good_status = "inspect", 0
    max_size = 10000  # zbuf's own files fit on the disk, the page does not

    def prepare(self):
        pathlib.Path("config.txt").write_text("8 8\n")

    def words(self, path):
        return [SCRIPTS / "inspect", "scene.txt", "config.txt", b"--output=" + os.fsencode(path)]

    def is_whole(self, data):
        return data.startswith(b"<!") and data.rstrip().endswith(b"</html>")

    def test_scene_and_config_may_be_named_anything_and_be_pipes(self):
        for name in (b"-x", b"--", b"a\nb", b"a'\"b", b"a\xffb"):
            for kind in ("scene", "config"):
                pathlib.Path(os.fsdecode(name + kind.encode())).write_bytes(
                    pathlib.Path(f"{kind}.txt").read_bytes())
            self.assert_written(script("inspect", "-o", "page", "--", name + b"scene", name + b"config"))
        pathlib.Path("page").unlink()
        line = (f'"{SCRIPTS}/inspect" -o page <(cat scene.txt) <(cat config.txt) && "{SCRIPTS}/inspect" -o '
                f'page - config.txt < scene.txt')
        self.assert_written(subprocess.run(["bash", "-c", line], capture_output=True, env=PLAIN))
        self.assertTrue(self.is_whole(pathlib.Path("page").read_bytes()))


class Picture(Writers, ToolTest):
    """A tool writes the file."""
    name, good_status = "picture: zbuf", 0
    max_size = 1000

    def prepare(self):
        pathlib.Path("config.txt").write_text("40 40\n")

    def words(self, path):
        return [SCRIPTS / "picture", "scene.txt", "config.txt", b"--output=bmp:" + os.fsencode(path)]

    def is_whole(self, data):
        return data.startswith(b"BM") and len(data) == 54 + 40 * 40 * 3

    def test_a_tool_that_writes_nothing_leaves_the_old_file(self):
        tools = str(tools_with("zbuf", "cat > /dev/null"))
        for command, words, path in (("picture", "-o x.png", "x.png"), ("stages", "five", "five/out.bmp")):
            words = ["scene.txt", "config.txt", *words.split()]
            self.assertEqual(script(command, *words).returncode, 0)
            before = pathlib.Path(path).read_bytes()
            done = script(command, *words, env={**PLAIN, "BIN": tools})
            self.assertEqual(
                (done.returncode, done.stderr.decode(), pathlib.Path(path).read_bytes()),
                (1, f"{command}: zbuf: has not written all of {path}, though it ended well\n", before))

    def test_a_format_may_be_a_name(self):
        self.assert_written(self.write(b"bmp"))
        self.assertTrue(self.is_whole(pathlib.Path("bmp").read_bytes()))


class MakeTorus(ToolTest):
    def run_in_shell(self, channels):
        return subprocess.run(
            ["bash", "-c", f'"{SCRIPTS}/make-torus" --around 200 {channels}; echo ${{PIPESTATUS[0]}} >&2'],
            capture_output=True)

    def test_its_output_is_checked(self):
        self.assertEqual(
            self.run_in_shell("> /dev/full").stderr,
            b"make-torus: cannot write <stdout>: No space left on device\n1\n")
        self.assertEqual(
            self.run_in_shell(">&-").stderr, b"make-torus: cannot write <stdout>: Bad file descriptor\n1\n")
        self.assertEqual(self.run_in_shell("| head -n 1").stderr, b"141\n")


class Separate(ToolTest):
    """An output that is an input or another output is a misuse: nothing runs, and both are named."""

    # A command, its words, with {} for an output, and the file that this must not be, with its name.
    CASES = (
        ("inspect", "scene.txt config.txt -o {}", "SCENE 'scene.txt'"),
        ("inspect", "scene.txt config.txt --theirs theirs -o {}", "--theirs 'theirs/stage1.txt'"),
        ("trade", "scene.txt config.txt --plot {}", "CONFIG 'config.txt'"),
        ("fly", "scene.txt config.txt --scene-out {}", "SCENE 'scene.txt'"),
        ("fly", "scene.txt --picture-out {}", "CONFIG 'config.txt'"),
        ("picture", "model.png -o {}", "MODEL 'model.png'"),
        ("stages", "five/stage1.txt config.txt five", "SCENE 'five/stage1.txt'"),
        ("farm", "scene.txt config.png -o {}", "CONFIG 'config.png'"),
        ("farm", "scene.txt config.txt -o x.png --z-buffer {}", "SCENE 'scene.txt'"),
        ("film", "scene.gif config.txt --turn 1 -o {}", "SCENE 'scene.gif'"),
        ("film", "five/world.txt config.txt --turn 1 -o five", "SCENE 'five/world.txt'"),
        ("join-images", "a.png b.png -o {}", "BAND 'b.png'"),
        ("compare", "a.png b.png --image {}", "A B 'a.png'"),
        ("compare", "a.png b.png --image {} --scene scene.txt", "SCENE 'scene.txt'"),
        ("grade", "hand-ins tests -o {}", "TESTS 'tests'"),
        ("fly", "scene.txt --scene-out one --picture-out {}", "--scene-out 'one'"),
        ("farm", "scene.txt config.txt -o one.png --z-buffer {}", "-o 'one.png'"),
        ("picture", "model.png --stages five -o {}", "--stages 'five/stage2.txt'"),
        ("stages", "stage1.txt config.txt new/..", "SCENE 'stage1.txt'"),
        ("picture", "model.png --stages new -o png:new/stage2.txt", "--stages 'new/stage2.txt'"),
    )

    def assert_refused(self, command, words, name, **settings):
        before = self.files()
        done = subprocess.run(
            [SCRIPTS / command, *words],
            stderr=subprocess.PIPE,
            text=True,
            timeout=60,
            env=PLAIN,
            **{"stdout": subprocess.PIPE, **settings},
        )
        self.assertEqual((done.returncode, done.stdout or "", self.files()), (2, "", before), done.stderr)
        self.assertRegex(
            done.stderr,
            rf"\A{command}: expected a place of its own for every output, "
            rf"found the same one for .* \(try {command} --help\)\n\Z",
        )
        self.assertIn(name, done.stderr)

    def test_it_is_refused_by_every_name(self):
        for folder in ("theirs", "five", "tests", "hand-ins"):
            os.mkdir(folder)
        for i, (command, words, name) in enumerate(self.CASES):
            path = name.split("'")[1]
            if not os.path.exists(path) and "'one" not in name and "stage2" not in name:
                pathlib.Path(path).write_text("mine")
            os.symlink(path, "link.png")
            aliases = ["./" + path, "link.png"]
            if os.path.isfile(path):
                os.link(path, "same.png")
                aliases.append("same.png")
            alias = aliases[i % len(aliases)]
            if command in ("farm", "film") and alias[-4:] not in (".png", ".gif") and "z-buffer" not in words:
                alias = "./" + path
            with self.subTest(command, words=words, alias=alias):
                self.assert_refused(command, words.format(alias).split(), name)
            for left in ("link.png", "same.png"):
                pathlib.Path(left).unlink(missing_ok=True)

    def test_no_output_is_a_file_called_minus_or_has_no_name(self):
        told = (("-", "no standard output, found '-' (./- for one of this name)"),
                ("", "the name of a file, found ''"))
        for command, words in (("inspect", "./- config.txt -o"), ("trade", "./- config.txt --plot"),
                               ("farm", "./- config.txt -o x.png --z-buffer"), ("film", "./- -o"),
                               ("fly", "./- --scene-out"), ("fly", "./- --picture-out"),
                               ("join-images", "./- ./- -o"), ("compare", "./- ./- --image"),
                               ("grade", "hand-ins tests -o"), ("grade", "--kit plain tests -o")):
            for name, expected in told:
                pathlib.Path("-").write_text("mine")
                done = script(command, *words.split(), name, *["--turn=1"] * (command == "film"))
                self.assertEqual(
                    (done.returncode, done.stdout, done.stderr.decode(), pathlib.Path("-").read_text()),
                    (2, b"", f"{command}: {words.split()[-1]}: expected {expected} (try {command} --help)\n",
                     "mine"))

    def test_standard_input_is_an_input(self):
        with open("scene.txt") as scene:
            self.assert_refused("inspect", ["-", "config.txt", "-o", "scene.txt"], "SCENE '-'", stdin=scene)

    def test_standard_output_is_an_output(self):
        os.mkdir("five")
        for name in ("theirs", "five/stage1.txt"):
            pathlib.Path(name).write_text("0 0 0\n")
        for command, words, path, name in (
            ("explain", "scene.txt config.txt --triangle 0", "config.txt", "CONFIG 'config.txt'"),
            ("compare", "theirs scene.txt", "theirs", "A B 'theirs'"),
            ("compare", "--hand-in five scene.txt", "scene.txt", "SCENE 'scene.txt'"),
            ("compare", "--hand-in five scene.txt", "five/stage1.txt", "THEIR_DIR 'five/stage1.txt'"),
            ("check-stage", "view --scene scene.txt -- ./theirs", "scene.txt", "SCENE 'scene.txt'"),
            ("check-stage", "view --scene scene.txt -- ./theirs", "theirs", "PROGRAM './theirs'"),
        ):
            text = pathlib.Path(path).read_text()
            with self.subTest(command, words=words, path=path), open(path, "a") as file:
                self.assert_refused(command, words.split(), name, stdout=file)
                self.assertEqual(pathlib.Path(path).read_text(), text)

    def test_a_socket_may_be_standard_input_and_output(self):
        pathlib.Path("same").write_text("0 0 0\n" * 3)
        ours, theirs = socket.socketpair()
        with ours, theirs:
            ours.sendall(pathlib.Path("same").read_bytes())
            ours.shutdown(socket.SHUT_WR)
            done = subprocess.run([SCRIPTS / "compare", "-", "same"], stdin=theirs, stdout=theirs,
                                  stderr=subprocess.PIPE, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_devices_may_be_named_twice(self):
        done = script("farm", "scene.txt", "config.txt", "-o", "x.png", "--z-buffer", "/dev/null", "--help")
        self.assertEqual((done.returncode, done.stderr), (0, b""))
        os.symlink(null_device(), "null.png")
        pathlib.Path("a.ppm").write_bytes(b"P6 1 1 255\nabc")
        done = script("compare", "a.ppm", "a.ppm", "--image", "null.png", stdin=subprocess.DEVNULL)
        self.assertEqual((done.returncode, done.stderr), (0, b""))


class Folders(ToolTest):
    """A folder that a command works in is new or empty, or it has made it: no other is written to."""

    SETTINGS = {
        "farm": ("scene.txt config.txt --parts 2 -o x.png", "x.png.farm", 1),
        "film": ("scene.txt config.txt --turn 0.1 -o x.gif", "x.gif.frames", 1),
        "grade": ("hand-ins tests -o out", "out", 2),}
    MARKS = {"farm": ".pipeline-farm", "film": ".pipeline-film-work"}
    FRAMES = "scene.txt config.txt --turn 0.1 -o frames"  # of film

    def setUp(self):
        super().setUp()
        for program in ("parallel", "ffmpeg"):
            if not shutil.which(program):
                self.skipTest(f"{program} is missing")
        for folder in ("tests/one", "hand-ins/ada", "elsewhere"):
            os.makedirs(folder)
        shutil.copy("scene.txt", "tests/one")
        pathlib.Path("elsewhere/precious").write_text("mine")

    def all_files(self):
        return sorted(
            (str(path), path.read_bytes() if path.is_file() else None) for path in pathlib.Path().rglob("*"))

    def assert_refused(self, command, words, status, message):
        before = self.all_files()
        done = script(command, *words.split())
        self.assertEqual((done.returncode, done.stdout, done.stderr.decode()),
                         (status, b"", f"{command}: {message}\n"))
        self.assertEqual(self.all_files(), before)

    def test_nothing_of_the_user_may_be_in_one(self):
        """What is the command's own there, by name, is removed."""
        for command, words, place in (("farm", "{} config.txt -o x.png", "SCENE: x.png.farm/parts/1.txt"),
                                      ("farm", "scene.txt config.txt -o x.png --z-buffer {}",
                                       "--z-buffer: x.png.farm/seen-0-0.txt"),
                                      ("film", "scene.txt {} --turn 1 -o x.gif",
                                       "CONFIG: x.gif.frames/config.txt"),
                                      ("film", "scene.txt {} --turn 1 -o x",
                                       "CONFIG: x/.pipeline-film-work/config.txt"),
                                      ("grade", "hand-ins tests -o out --overrides {}",
                                       "--overrides: out/grades.csv")):
            name, path = place.split(": ")
            os.makedirs(os.path.dirname(path), exist_ok=True)
            pathlib.Path(path).write_text("mine")
            folder = os.path.dirname(path).removesuffix("/parts")
            with self.subTest(command, path=path):
                self.assert_refused(
                    command, words.format(path), 2, f"{name}: expected a place outside of '{folder}', "
                    f"found '{path}' (try {command} --help)")

    def test_another_is_refused(self):
        film_in_a_folder = ("film", (self.FRAMES, "frames", 1))
        for command, (words, folder, status) in (*self.SETTINGS.items(), film_in_a_folder):
            with self.subTest(command, folder=folder):
                os.mkdir(folder)
                for name in ("00000.png", "config.txt"):
                    pathlib.Path(folder, name).write_text("mine")
                shown = os.path.realpath(folder) if folder in ("frames", "out") else folder
                self.assert_refused(
                    command,
                    words,
                    status,
                    f"expected a new or empty folder, or one that {command} has made"
                    f"{' to work in' * ('.gif' in folder)}, found {shown}, which holds 00000.png",
                )
                shutil.rmtree(folder)

    def test_no_link_and_no_file_stands_for_one(self):
        for command in ("farm", "film"):
            words, folder, status = self.SETTINGS[command]
            os.symlink("elsewhere", folder)
            self.assert_refused(command, words, status,
                                f"expected a folder, or nothing, found the link {folder}")
            os.unlink(folder)
            pathlib.Path(folder).write_text("mine")
            self.assert_refused(command, words, status,
                                f"expected a folder, or nothing, found the file {folder}")

    @unittest.skipUnless(IS_ROOT, "only root makes folders of other users")
    def test_another_users_folder_is_refused(self):
        """Whoever owns the folder could change what is run there."""
        words, folder, status = self.SETTINGS["farm"]
        os.mkdir(folder)
        pathlib.Path(folder, ".pipeline-farm").touch()
        os.chown(folder, 12345, 12345)
        self.assert_refused(
            "farm",
            words,
            status,
            f"expected a folder of one's own, found {folder} of another user",
        )

    def test_two_runs_do_not_share_one(self):
        words, folder, status = self.SETTINGS["farm"]
        os.mkdir(folder)
        with open(f"{folder}/.pipeline-farm", "w") as mark:
            fcntl.flock(mark, fcntl.LOCK_EX)
            self.assert_refused("farm", words, status, f"another farm works in {folder}")

    def test_what_is_not_ours_stays_in_one(self):
        """The files of the user in a folder that bears the mark, and what their links point at."""
        for command in ("farm", "film"):
            words, folder, _ = self.SETTINGS[command]
            os.mkdir(folder)
            pathlib.Path(folder, self.MARKS[command]).touch()
            pathlib.Path(folder, "20241.png").write_text("mine")
            os.symlink("../elsewhere/precious", pathlib.Path(folder, "config.txt"))
            for name in (".pipeline-x.gif", ".pipeline-x.png"):  # what one might guess
                os.path.lexists(name) or os.symlink("elsewhere/precious", name)
            self.assertEqual(script(command, *words.split()).returncode, 0)
            self.assertEqual(sorted(os.listdir(folder)), [self.MARKS[command], "20241.png"])
            self.assertEqual(pathlib.Path("elsewhere/precious").read_text(), "mine")

    def test_links_in_one_are_not_followed(self):
        """Where jobs, parallel or ffmpeg would write, without a look at what is there."""
        planted = {"farm": ("jobs.log", "seen-0-0-1.txt", "parts"), "film": ("frames.txt", "film.gif")}
        for command, links in planted.items():
            words, folder, _ = self.SETTINGS[command]
            os.mkdir(folder)
            pathlib.Path(folder, self.MARKS[command]).touch()
            for link in links:
                os.symlink("../elsewhere" if link == "parts" else "../elsewhere/precious", f"{folder}/{link}")
            done = script(command, *words.split())
            self.assertEqual((done.returncode, os.path.exists(folder)), (0, False), done.stderr)
            self.assertEqual(os.listdir("elsewhere"), ["precious"])
            self.assertEqual(pathlib.Path("elsewhere/precious").read_text(), "mine")

    def test_a_frame_or_a_link_that_film_has_not_drawn_is_in_the_way(self):
        os.mkdir("frames")
        pathlib.Path("frames/.pipeline-film").touch()
        frame = pathlib.Path("frames/00001.png")
        for put in (lambda: frame.symlink_to("../elsewhere/new"), lambda: frame.write_text("mine")):
            put()
            self.assert_refused(
                "film", self.FRAMES, 1, "expected no 00001.png in "
                f"{os.path.realpath('frames')} that film has not drawn")
            frame.unlink()

    def test_the_list_of_frames_names_no_other_file_to_remove(self):
        self.assertEqual(script("film", *self.FRAMES.split()).returncode, 0)
        pathlib.Path("frames/notes.md").write_text("mine")
        with open("frames/frames.txt", "a") as file:
            file.write("notes.md x\n")
        self.assertEqual(script("film", *self.FRAMES.split()).returncode, 0)
        self.assertEqual(pathlib.Path("frames/notes.md").read_text(), "mine")

    def test_empty_folders_of_the_user_stay_in_one(self):
        self.assertEqual(script("film", *self.FRAMES.split()).returncode, 0)
        os.makedirs("frames/mine/too")
        self.assertEqual(script("film", *self.FRAMES.split()).returncode, 0)
        self.assertTrue(os.path.isdir("frames/mine/too"))

    def test_an_empty_one_is_taken_and_goes(self):
        words, folder, _ = self.SETTINGS["farm"]
        os.mkdir(folder)
        self.assertEqual(script("farm", *words.split()).returncode, 0)
        self.assertFalse(os.path.exists(folder))

    def test_an_output_that_cannot_be_is_told_before_any_work(self):
        for command in ("farm", "film"):
            words = self.SETTINGS[command][0]
            os.makedirs(words.split()[-1], exist_ok=True)
            self.assert_refused(command, words, 1, f"cannot open {words.split()[-1]}: Is a directory")

    def test_names_may_hold_anything(self):
        for name in ("a%05d '\"$(x)b", "a\nb", "-x"):
            os.mkdir(name)
            for command, words, output in (
                ("film", "--turn 0.1", "x.gif"),
                ("film", "--turn 0.1", "frames"),
                ("farm", "--bands 2", "x.png"),
            ):
                words = ["scene.txt", "config.txt", *words.split(), f"--output={name}/{output}"]
                self.assertEqual(script(command, *words).returncode, 0)
            self.assertEqual(sorted(os.listdir(name)), ["frames", "x.gif", "x.png"])


class Beginnings(ToolTest):
    def test_a_signal_may_come_at_once(self):
        """Just when the folder of temporary files is there."""
        os.mkdir("tmp")
        done = subprocess.run(
            [
                sys.executable, "-c", "import os, signal\nfrom lib.rim.command import run_command\n"
                "make = os.mkdir\n"
                "os.mkdir = lambda *words: (make(*words), os.kill(os.getpid(), signal.SIGTERM))\n"
                "run_command(lambda: 0, 'command')"], capture_output=True, text=True,
            env={**PLAIN, "PYTHONPATH": str(SCRIPTS), "PYTHONDONTWRITEBYTECODE": "1", "TMPDIR": "tmp"})
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGTERM, "command: ended by SIGTERM\n"))
        self.assertEqual(os.listdir("tmp"), [])


class Channels(ToolTest):
    def test_a_closed_channel_is_no_file_of_ours(self):
        """What is opened first must not get the descriptor of standard input, output or error."""
        for closed in ("<&-", "2>&-", "<&- 2>&-"):
            done = subprocess.run(
                ["sh", "-c", f'"{SCRIPTS}/inspect" - config.txt -o page {closed}'],
                input=b"",
                capture_output=True,
                env=PLAIN,
            )
            self.assertEqual((done.returncode, done.stdout, self.files()),
                             (1, b"", ["config.txt", "scene.txt"]), closed)
            self.assertEqual(
                done.stderr,
                b"" if "2>" in closed else b"inspect: cannot read <stdin>: Bad file descriptor\n")


class OwnFiles(ToolTest):
    """Descriptors the scripts write to; these tests write nothing themselves."""
    def test_names_of_the_process_own_files(self):
        sys.path.insert(0, str(SCRIPTS))
        from lib.rim.output_file import own_descriptor, target_of
        for path, number in (("/dev/stdout", 1), ("/dev/stderr", 2), ("/dev/fd/12", 12),
                             ("/proc/self/fd/3", 3), ("/dev/stdin", None), ("/dev/null", None),
                             ("/dev/fd/x", None), ("dev/stdout", None), ("/dev/stdout/", None)):
            self.assertEqual(own_descriptor(path), number, path)
        os.symlink("/dev/stdout", "first")
        os.symlink("first", "second")
        self.assertEqual(target_of("second"), "/dev/stdout")


class Tools(ToolTest):
    def test_the_current_folder_may_be_theirs(self):
        """Not the programs of the same names on the PATH."""
        for tool in ("model", "view", "project", "zbuf"):
            os.symlink(BIN / tool, tool)
        done = subprocess.run([SCRIPTS / "inspect", "scene.txt", "config.txt"], capture_output=True,
                              env={**PLAIN, "BIN": "."})
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))


if __name__ == "__main__":
    unittest.main()
