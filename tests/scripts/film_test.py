#!/usr/bin/env python3
"""scripts/film: frames are those of the pipe, whatever the order and number of jobs; what is interrupted goes
on.

usage: film_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest
from unittest import mock

from ssh_server import SshServer
from toolbox import BIN, SOURCE, ToolTest, pipe, run, run_script, tools_with

FILM = SOURCE / "scripts/film"
ENVIRONMENT = {**os.environ, "BIN": str(BIN)}
SCENE = """3 1 6
0 0 0
0 1 0
40 1.25 1 30 ratio
triangle
-1 -1 0
1 -1 0
0 1 0
triangle
-1 0 -1
1 0 1
0 0.5 -2
end
"""
CONFIG = "50 40\n"
KEYS = [(0, (3, 1, 6), (0, 0, 0), (0, 1, 0), 40), (1, (5, 2, 3), (0, 0.5, 0), (0, 1, 0.2), 30),
        (3, (4, 4, 1), (0, 0, 0), (0, 0, 1), 60)]
PATH = "# time eye look up fovY\n" + "".join(f"{t} {' '.join(map(str, (*eye, *look, *up)))} {fov}\n"
                                             for t, eye, look, up, fov in KEYS)


def setUpModule():  # noqa: N802
    if not shutil.which("parallel"):
        raise unittest.SkipTest("GNU parallel is missing")


def film(*words, **settings):
    return subprocess.run([FILM, *map(str, words)], capture_output=True, text=True, env=ENVIRONMENT,
                          timeout=240, **settings)


def frame(eye, look, up, fov_y=40):
    """The PNG that the pipe draws for a camera."""
    words = [" ".join(map(str, v)).split() for v in (eye, look, up)]
    pipe(["model"], ["view", "--eye", *words[0], "--look", *words[1], "--up", *words[2]],
         ["project", "--perspective",
          str(fov_y), "1.25", "1", "30", "--aspect", "ratio"], ["zbuf", "config.txt", "--image", "one.png"],
         stdin=SCENE)
    return pathlib.Path("one.png").read_bytes()


def frames(folder):
    return {path.name: path.read_bytes() for path in sorted(pathlib.Path(folder).glob("*.png"))}


def cameras(folder):
    """Eye, look and up of each frame, from the list that film keeps."""
    found = []
    for line in pathlib.Path(folder, "frames.txt").read_text().splitlines()[1:]:
        words = line.split()
        found.append([
            tuple(map(float, words[words.index(name) + 1:words.index(name) + 4]))
            for name in ("--eye", "--look", "--up")])
    return found


class FilmTest(ToolTest):
    def setUp(self):
        super().setUp()
        for name, text in (("scene.txt", SCENE), ("config.txt", CONFIG), ("path.txt", PATH)):
            pathlib.Path(name).write_text(text)

    def make(self, *words):
        done = film("scene.txt", "config.txt", *words)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))


class Pictures(FilmTest):
    def test_at_a_key_the_frame_is_the_keys(self):
        for mode in ([], ["--linear"]):
            self.make("path.txt", "--fps", "4", "-o", "out" + "".join(mode), *mode)
            drawn = frames("out" + "".join(mode))
            self.assertEqual(len(drawn), 13)
            for t, eye, look, up, fov_y in KEYS:
                length = math.hypot(*up)
                self.assertEqual(drawn[f"{4 * t:05d}.png"], frame(eye, look, [x / length for x in up], fov_y))

    def test_cameras_keep_all_their_digits(self):
        eyes = [(100000003.1234567, 1e-7, 6.0), (100000004.7654321, -3e-20, 5.0)]
        keys = [f"{t} {' '.join(map(repr, eye))} 0 0 0 0 1 0\n" for t, eye in zip((0.2, 0.5), eyes)]
        pathlib.Path("path.txt").write_text("".join(keys))
        for mode in ([], ["--linear"]):
            words = ["path.txt", "--fps", "10", *mode, "-o", "out"]
            self.assertEqual(film("scene.txt", "config.txt", *words).returncode, 0)
            found = [eye for eye, _, _ in cameras("out")]
            self.assertEqual((len(found), found[0], found[-1]), (4, *eyes))
            self.assertNotEqual(*[f"{eye[0]:.10g}" for eye in found[1:3]])

    def test_half_way_on_a_straight_line(self):
        self.make("path.txt", "--fps", "2", "--linear", "-o", "out")
        eye, look, _ = cameras("out")[1]
        self.assertEqual((eye, look), ((4, 1.5, 4.5), (0, 0.25, 0)))

    def test_half_way_on_the_curve(self):
        """Half-way in an interval of length h the cubic is the mean of its ends, plus h/8 times the
        difference of their slopes; the slopes here are (5 - 3)/1 at the first key and (4 - 3)/3 at the
        second, so x is 4 + 5/24."""
        self.make("path.txt", "--fps", "2", "-o", "out")
        self.assertAlmostEqual(cameras("out")[1][0][0], 4 + 5 / 24, 8)

    def test_a_turn_begins_at_the_camera_and_goes_around_the_middle(self):
        self.make("--turn", "2", "--fps", "4", "-o", "out")
        seen = cameras("out")
        self.assertEqual(len(seen), 8)
        self.assertEqual(seen[0][:2], [(3, 1, 6), (0, 0, 0)])
        # The middle is (0, 0, -0.5); a quarter of a turn about y takes (3, 1, 6.5) from there to (6.5, 1,
        # -3).
        for x, y in zip(seen[2][0], (6.5, 1, -3.5)):
            self.assertAlmostEqual(x, y, 8)
        # Without the last bits of sin and cos.
        self.assertEqual((seen[4][0], seen[6][0]), ((-3, 1, -7), (-6.5, 1, 2.5)))
        self.assertEqual(frames("out")["00000.png"], frame((3, 1, 6), (0, 0, 0), (0, 1, 0)))

    def test_the_bytes_do_not_depend_on_the_jobs(self):
        self.make("path.txt", "--fps", "9", "-o", "one", "--", "--jobs", "1")
        self.make("path.txt", "--fps", "9", "-o", "four", "--", "--jobs", "4")
        self.assertEqual(len(frames("one")), 28)
        self.assertEqual(frames("one"), frames("four"))


class Traced(FilmTest):
    def test_frames_are_those_of_trace(self):
        self.make("path.txt", "--fps", "1", "--trace", "--no-shadows", "--samples", "5", "-o", "out")
        for t, eye, look, up, fov_y in KEYS:
            words = [" ".join(map(str, v)).split() for v in (eye, look, [x / math.hypot(*up) for x in up])]
            stage2 = pipe(["model"], ["view", "--eye", *words[0], "--look", *words[1], "--up", *words[2]],
                          stdin=SCENE)
            run("trace", "config.txt", "--perspective", str(fov_y), "1.25", "1", "30", "--aspect", "ratio",
                "--no-shadows", "--samples", "5", "--image", "one.png", stdin=stage2)
            self.assertEqual(frames("out")[f"{t:05d}.png"], pathlib.Path("one.png").read_bytes())

    def test_traced_frames_take_the_place_of_those_of_zbuf(self):
        self.make("--turn", "1", "--fps", "2", "--samples", "2", "-o", "out")
        rasterized = frames("out")
        self.make("--turn", "1", "--fps", "2", "--samples", "2", "--trace", "-o", "out")
        traced = pipe(["model"], ["view"], ["trace", "config.txt", "--samples", "2", "--image", "one.png"],
                      stdin=SCENE)
        self.assertTrue(traced)
        self.assertEqual(frames("out")["00000.png"], pathlib.Path("one.png").read_bytes())
        self.assertNotEqual(frames("out"), rasterized)

    def test_options_without_a_meaning_are_refused(self):
        for words, reason in ((["--trace",
                                "--coverage", "center"], "--coverage means nothing with --trace"), ([
                                    "--no-recursion"], "--no-recursion is for trace: it needs --trace"), ([
                                        "--samples", "5"], "expected 1 to 4 without --trace, found 5"), ([
                                            "--trace", "--samples",
                                            "17"], "expected a whole number from 1 to 16, found '17'")):
            done = film("scene.txt", "config.txt", "--turn", "1", *words, "-o", "out")
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(reason, done.stderr)


class Interruptions(FilmTest):
    def test_what_is_killed_goes_on(self):
        process = subprocess.Popen(
            [FILM, "scene.txt", "config.txt", "--turn", "12", "-o", "out", "--", "--jobs", "2"],
            env=ENVIRONMENT, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.monotonic() + 120
        work = pathlib.Path("out/.pipeline-film-work")
        while len(list(work.glob("*.png"))) < 20 and time.monotonic() < end:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        # The jobs have groups of their own; they end at their next write to parallel, or with their frames.
        time.sleep(1)
        before = {path.name: path.stat().st_mtime_ns for path in work.glob("*.png")}
        self.assertTrue(20 <= len(before) < 300, "the run was not in its midst")
        self.make("--turn", "12", "-o", "out")
        after = {path.name: path.stat().st_mtime_ns for path in pathlib.Path("out").glob("*.png")}
        self.assertEqual(len(after), 300)
        self.assertEqual({name: after[name] for name in before}, before)
        self.make("--turn", "12", "-o", "whole")
        self.assertEqual(frames("out"), frames("whole"))

    def test_killed_while_frames_take_their_places_it_leaves_none_that_passes_for_an_older_one(self):
        words = ["--turn", "1", "--fps", "4", "-o", "out"]
        self.make(*words)
        older = frames("out")
        for place in ("out/00001.png", "out/world.txt", "out/frames.txt"):
            code = ("import os, runpy, signal, sys\nreplace = os.replace\n"
                    "def replaced(a, b):\n"
                    f"  if str(b).endswith({place!r}) and '-work/' in str(a): os.kill(os.getpid(), 9)\n"
                    "  replace(a, b)\nos.replace = replaced\n"
                    f"runpy.run_path({str(FILM)!r}, run_name='__main__')")
            done = subprocess.run([sys.executable, "-c", code, "scene.txt", "--size", "5x4", *words],
                                  env={**ENVIRONMENT, "PYTHONPATH": FILM.parent})
            self.assertEqual(done.returncode, -signal.SIGKILL)
            self.assertNotEqual(frames("out"), older)
            self.make(*words)
            self.assertEqual(frames("out"), older)

    def test_frames_of_another_scene_or_way_or_of_other_tools_are_drawn_anew(self):
        self.make("--turn", "1", "--fps", "4", "-o", "out")
        first = frames("out")
        pathlib.Path("scene.txt").write_text(SCENE.replace("0 0.5 -2", "0 0.9 -2"))
        self.make("--turn", "1", "--fps", "4", "-o", "out")
        second = frames("out")
        self.assertNotEqual(first, second)
        words = ["--turn", "1", "--fps", "2", "-o", "out"]
        self.make(*words)
        self.assertEqual(list(frames("out").values()), [second["00000.png"], second["00002.png"]])
        with mock.patch.dict(ENVIRONMENT, BIN=str(tools_with("project", 'exec $real --cull front "$@"'))):
            self.assertEqual(film("scene.txt", "config.txt", *words).returncode, 0)
        self.assertNotIn(second["00000.png"], frames("out").values())

    def test_what_is_broken_is_made_again(self):
        self.make("--turn", "1", "--fps", "4", "-o", "out")
        first = frames("out")
        os.truncate("out/00001.png", 60)
        os.truncate("out/00002.png", 0)
        data = first["00003.png"]
        pathlib.Path("out/00003.png").write_bytes(data[:-20] + bytes(4) + data[-16:])  # another checksum
        for name in ("world.txt", "config.txt", "draw.sh", "00001.png.log"):
            pathlib.Path("out", name).unlink(missing_ok=True)
            os.mkfifo(f"out/{name}")
        self.make("--turn", "1", "--fps", "4", "-o", "out")
        self.assertEqual(frames("out"), first)

    def test_a_list_of_frames_that_is_none_is_told_in_a_line(self):
        self.make("--turn", "1", "--fps", "2", "-o", "out")
        listed = pathlib.Path("out/frames.txt")
        for make, reason in ((lambda: listed.write_bytes(b""), "expected no 00000.png in "),
                             (lambda: listed.write_bytes(b"\xff"),
                              "expected no 00000.png in "), (lambda: os.mkfifo(listed), "cannot read ")):
            listed.unlink()
            make()
            done = film("scene.txt", "config.txt", "--turn", "1", "--fps", "2", "-o", "out")
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), done.stderr)
            self.assertTrue(done.stderr.startswith("film: " + reason), done.stderr)

    def test_what_parallel_prints_is_passed_on(self):
        done = film("scene.txt", "config.txt", "--turn", "1", "--fps", "9", "-o", "out", "--", "--dry-run")
        self.assertEqual((done.returncode, done.stdout.count("; draw ")), (1, 9))
        self.assertIn("film: 9 of 9 frames have not been drawn: the first is 00000.png (--eye ", done.stderr)

    def test_a_frame_that_fails_ends_the_film_and_names_its_camera(self):
        words = ["scene.txt", "config.txt", "--turn", "1", "--fps", "20", "-o", "out", "--", "--jobs", "1"]
        tools = tools_with(
            "zbuf", 'case "$*" in *00010.*) ;; *) exec $real "$@"; esac\n'
            "echo zbuf: so it is >&2\nexit 1")
        done = run_script("film", *words, env={**ENVIRONMENT, "BIN": tools})
        self.assertEqual(done.returncode, 1)
        self.assertEqual(
            done.stderr, "film: 10 of 20 frames have not been drawn: 00010 (--eye -3 1 -7 --look 0 0 "
            "-1 --up 0 1 0): zbuf: so it is; the same command draws those that are missing\n")


class Outputs(FilmTest):
    def assert_film(self, path, expected):
        words = [
            "ffprobe", "-v", "error", "-count_frames", "-show_entries",
            "stream=nb_read_frames,width,height,r_frame_rate", "-of", "csv=p=0", path]
        self.assertEqual(
            subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip(), expected)

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is missing")
    def test_a_film(self):
        for fps in (10, 200):
            for path in ("turn.mp4", "turn.gif"):
                self.make("--turn", str(10 / fps), "--fps", str(fps), "-o", path)
                self.assertFalse(pathlib.Path(path + ".frames").exists())
                if path.endswith("mp4"):
                    self.assert_film(path, f"50,40,{fps}/1,10")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is missing")
    def test_a_film_has_its_own_frames_alone(self):
        words = ["--turn", "1", "--fps", "2"]
        self.make(*words, "-o", "turn.mp4.frames")
        self.assertEqual(film("scene.txt", "config.txt", *words, "-o", "turn.mp4").returncode, 1)
        os.rename("turn.mp4.frames/.pipeline-film", "turn.mp4.frames/.pipeline-film-work")
        shutil.copy("turn.mp4.frames/00000.png", "turn.mp4.frames/00002.png")
        self.make(*words, "-o", "turn.mp4")
        self.assert_film("turn.mp4", "50,40,2/1,2")
        self.assertEqual(list(frames("turn.mp4.frames")), ["00002.png"])  # the user's

    def test_an_ffmpeg_without_the_encoder_is_found_before_the_first_frame(self):
        pathlib.Path("ffmpeg").write_text("#!/bin/sh\necho Unknown encoder >&2\nexit 1\n")
        os.chmod("ffmpeg", 0o755)
        with mock.patch.dict(ENVIRONMENT, PATH=f"{os.getcwd()}:{os.environ['PATH']}"):
            done = film("scene.txt", "config.txt", "--turn", "1", "--fps", "2", "-o", "turn.mp4")
        self.assertEqual((done.returncode, done.stderr), (1, "film: ffmpeg: Unknown encoder\n"))
        self.assertFalse(os.path.exists("turn.mp4.frames"))

    def test_other_machines(self):
        """Over a real sshd on this machine, under two names; bytes as without."""
        server = SshServer(self, ["worker1", "worker2"])
        self.make("path.txt", "--fps", "3", "-o", "near")
        self.make("path.txt", "--fps", "3", "-o", "far", "--", *server.words, "--sshlogin",
                  "1/worker1,1/worker2")
        self.assertEqual(len(frames("far")), 10)
        self.assertEqual(frames("far"), frames("near"))


class Sizes(FilmTest):
    def test_a_size_stands_for_a_config(self):
        self.make("path.txt", "--fps", "1", "-o", "out")
        for words in (["scene.txt", "path.txt", "--size", "50x40"], [
                "--size", "50x40", "scene.txt", "path.txt"], ["scene.txt", "--size", "50x40", "path.txt"]):
            shutil.rmtree("other", ignore_errors=True)
            done = film(*words, "--fps", "1", "-o", "other")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""), words)
            self.assertEqual(frames("other"), frames("out"))

    def test_the_scene_may_come_through_a_pipe(self):
        self.make("--turn", "1", "--fps", "2", "-o", "out")
        done = film("-", "--size", "50x40", "--turn", "1", "--fps", "2", "-o", "other", input=SCENE)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertEqual(frames("other"), frames("out"))

    def test_wrong_ones_are_told(self):
        for words, reason in ((["-", "--turn", "1"], "expected CONFIG or --size, found neither, and no "), ([
                "scene.txt", "config.txt", "path.txt", "--size",
                "5x4"], "expected either CONFIG or --size, found both"), ([
                    "scene.txt", "--turn", "1", "--size",
                    "5"], "expected WIDTHxHEIGHT in pixels, such as 800x600, found '5'"), ([
                        "scene.txt", "--turn", "1", "--size",
                        "0x4"], "expected WIDTHxHEIGHT in pixels, such as 800x600, found '0x4'"), ([
                            "scene.txt", "--size", "5x4"], "expected either PATH or --turn, found neither")):
            done = film(*words, "-o", "out", input="")
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn(reason, done.stderr)
        done = film("scene.txt", "--size", "5x4", "--turn", "1", "-o", "out.AVI")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn(
            "-o: expected a folder, or a film that ends in .mp4, .mkv, .webm, .gif, found 'out.AVI'",
            done.stderr)


class Refusals(FilmTest):
    def test_paths(self):
        for text, reason in (("0 1 2 3\n", "path.txt:1: expected the time, eye, look and up"),
                             ("", "path.txt: expected two cameras or more, found 0"),
                             ("# one\n0 0 0 5 0 0 0 0 1 0\n",
                              "found 1"), ("0 0 0 5 0 0 5 0 1 0\n",
                                           "path.txt:1: expected an eye apart from the look point"),
                             ("0 0 0 5 0 0 0 0 0 1\n",
                              "path.txt:1: expected an eye apart"), ("0 0 0 5 0 0 0 0 1 0 180\n",
                                                                     "path.txt:1: expected a fovY above 0"),
                             ("1 0 0 5 0 0 0 0 1 0\n\n1 0 0 6 0 0 0 0 1 0\n",
                              "path.txt:3: expected a time after 1, found 1"),
                             ("0 0 0 5 0 0 0 0 1 0 30\n1 0 0 6 0 0 0 0 1 0\n",
                              "path.txt:2: expected a fovY on every line or on none"),
                             ("0 0 0 5 0 0 0 nan 1 0\n", "path.txt:1: expected the time")):
            pathlib.Path("path.txt").write_text(text)
            for mode in ([], ["--linear"]):
                done = film("scene.txt", "config.txt", "path.txt", *mode, "-o", "out", "--fps", "25")
                self.assertEqual((done.returncode, done.stdout), (1, ""), text)
                self.assertIn(reason, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)

    def test_a_way_through_a_camera_that_shows_nothing(self):
        pathlib.Path("path.txt").write_text("0 0 0 5 0 0 0 0 1 0\n1 0 0 -5 0 0 0 0 1 0\n")
        done = film("scene.txt", "config.txt", "path.txt", "--linear", "-o", "out", "--fps", "2")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("film: at 0.5 s the path passes through a camera that shows nothing", done.stderr)

    def test_command_lines(self):
        for words in (["path.txt", "--turn", "3", "-o", "out"], ["-o", "out"], ["path.txt"], [
                "--turn", "0", "-o", "out"], ["--turn", "2", "--fps", "x", "-o", "out"]):
            self.assertEqual(film("scene.txt", "config.txt", *words).returncode, 2, words)

    def test_scenes(self):
        pathlib.Path("scene.txt").write_text("0 0 5\n")
        done = film("scene.txt", "config.txt", "--turn", "1", "-o", "out")
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("film: model: scene.txt:2:1: expected", done.stderr)

    def test_a_sphere_needs_trace(self):
        camera, body = SCENE.split("\n", 4)[:4], SCENE.split("\n", 4)[4]
        pathlib.Path("scene.txt").write_text("\n".join(camera) + "\n" +
                                             body.replace("triangle", "sphere 0 0 0 1  # one\ntriangle", 1))
        line = pathlib.Path("scene.txt").read_text().split("sphere")[0].count("\n") + 1
        done = film("scene.txt", "config.txt", "--turn", "1", "-o", "out")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (
            1, "",
            f"film: model: scene.txt:{line}:1: expected triangles alone, found a sphere: --trace draws it\n"))
        self.assertFalse(pathlib.Path("out").exists())
        self.make("--turn", "0.1", "--fps", "20", "--trace", "-o", "out")
        eye, look, up = cameras("out")[0]
        words = [
            word for name, vector in (("--eye", eye), ("--look", look), ("--up", up))
            for word in (name, *map(repr, vector))]
        pipe(["model"], ["view", *words], ["trace", "config.txt", "-o", "expected.png"],
             stdin=pathlib.Path("scene.txt").read_text())
        self.assertEqual(
            pathlib.Path("out/00000.png").read_bytes(),
            pathlib.Path("expected.png").read_bytes())

    def test_a_turn_goes_around_the_middle_of_spheres(self):
        """Not of the points that describe them."""
        pathlib.Path("scene.txt").write_text(
            "0 0 5\n0 0 0\n0 1 0\n60 1.25 1 100 ratio\nsphere 0 0 0 1\nend\n")
        self.make("--turn", "1", "--fps", "2", "--trace", "-o", "out")
        (eye, _, _), (opposite, _, _) = cameras("out")
        for a, b in zip(eye, opposite):
            self.assertAlmostEqual(a, -b, places=6)


class TransparentBackground(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("scene.txt").write_text(SCENE.replace("triangle", "background 200 100 50 0\ntriangle",
                                                           1))
        pathlib.Path("config.txt").write_text(CONFIG)

    def test_frames_of_a_folder_have_an_alpha_and_those_of_a_film_have_none(self):
        self.assertEqual(film("scene.txt", "config.txt", "--turn", "1", "--fps", "2", "-o", "out").stderr, "")
        self.assertEqual([data[24:26] for data in frames("out").values()], [b"\x08\x06"] * 2)
        if not shutil.which("ffmpeg"):
            self.skipTest("ffmpeg is missing")
        self.assertEqual(
            film("scene.txt", "config.txt", "--turn", "1", "--fps", "2", "-o", "out.mkv").stderr,
            "film: note: the scene's background is drawn opaque: a film has no alpha\n")
        subprocess.run(["ffmpeg", "-loglevel", "error", "-i", "out.mkv", "-frames:v", "1", "first.ppm"],
                       check=True, stdin=subprocess.DEVNULL)
        corner = pathlib.Path("first.ppm").read_bytes()[-3 * 50 * 40:][:3]
        self.assertTrue(all(abs(found - expected) < 12 for found, expected in zip(corner, (200, 100, 50))),
                        corner)


if __name__ == "__main__":
    unittest.main()
