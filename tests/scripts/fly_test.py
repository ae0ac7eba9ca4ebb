#!/usr/bin/env python3
"""scripts/fly in an invisible window: the tests send keys and compare its picture with the output of the
pipe.

usage: fly_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest
import unittest.mock

from display import MISSING, Display
from toolbox import BIN, SOURCE, TOOLS, ToolTest, end_by_signal, heed_signals, pipe, run

SCENE = """# a scene to fly through
1 2 5   # eye
0 0 0
0 1 0
60 1 1 100
light 2 3 4 1 1 1
color 200 100 50
translate 0.5 0 0
triangle
-1 -1 0
1 -1 0
0 1 0
triangle   # seen from behind
-1 -1 1
0 1 1
1 -1 1
end
"""
CONFIG = "60 40\n-1.5\n-1\n-1 1\n"


def frame_of(scene, config=CONFIG, view=(), project=(), zbuf=()):
    """The PPM the pipe writes."""
    pathlib.Path("expected.config").write_text(config)
    stage3 = pipe(["model"], ["view", *view], ["project", *project], stdin=scene)
    done = run("zbuf", "expected.config", "--image", "expected.ppm", *zbuf, stdin=stage3)
    assert done.returncode == 0, done.stderr
    return pathlib.Path("expected.ppm").read_bytes()


def setUpModule():
    if not MISSING:
        unittest.enterModuleContext(Display())


class WindowTest(ToolTest):
    """Tests in a window. Whether a frame is slow is up to the test, not to the machine."""
    def setUp(self):
        super().setUp()
        import fly_parts.window
        self.enterContext(unittest.mock.patch.object(fly_parts.window, "SLOW_SECONDS", math.inf))

    def open(self, *words, **settings):
        from fly_parts.window import FlyWindow
        self.window = FlyWindow(*words, **settings)
        self.addCleanup(self.window.close)
        # Keys are lost before the window has the focus, which it can have only when it is there.
        self.wait_until(self.window.root.winfo_viewable)
        self.window.root.focus_force()
        self.wait_until(lambda: self.window.root.focus_get() is not None)
        self.settle()

    def settle(self):
        """Handles all that the display has to tell, and draws the frame that is due."""
        self.window.root.update()
        self.window.root.winfo_pointerxy()  # the answer comes after all earlier events
        self.window.root.update()
        while self.window.pending is not None:
            self.window.root.update()

    def wait_until(self, is_true, seconds=20):
        end = time.monotonic() + seconds
        while not is_true():
            self.assertLess(time.monotonic(), end)
            self.window.root.update()
            time.sleep(0.005)

    def press(self, *keys):
        for key in keys:
            self.window.root.event_generate("<KeyPress>", keysym=key)
            self.settle()

    def shown(self):
        """The window's picture, as PPM."""
        self.window.photo.write("shown.ppm", format="ppm")
        return pathlib.Path("shown.ppm").read_bytes()


@unittest.skipIf(MISSING, f"needs {' and '.join(MISSING)}")
class Traced(WindowTest):
    def test_frames_are_those_of_trace(self):
        from lib.running.pipe_tools import Tools
        pathlib.Path("scene.txt").write_text(SCENE)
        self.open(Tools(BIN), "scene.txt", CONFIG, words=["--no-shadows"], is_traced=True)

        def traced(*words, view=()):
            pathlib.Path("expected.config").write_text(CONFIG)
            pipe(["model"], ["view", *view],
                 ["trace", "expected.config", "--no-shadows", *words, "--image", "expected.ppm"], stdin=SCENE)
            return pathlib.Path("expected.ppm").read_bytes()

        def shown_after(key):
            self.press(key)
            return self.shown()

        window, first = self.window, shown_after("h")
        self.assertEqual(first, traced())
        self.assertTrue(window.keys.winfo_manager())
        self.assertNotIn("clip", window.keys.cget("text"))
        self.assertIn("shading", window.keys.cget("text"))
        self.assertRegex(window.status.cget("text"), r"^model .*   view .*   trace \d+ ms   all ")
        self.assertEqual(shown_after("2"), traced("--shading", "flat"))
        for key in ("c", "v", "z", "x", "b", "f"):
            self.assertEqual(shown_after(key), traced("--shading", "flat"))
            self.assertEqual(window.status.cget("text"),
                             "trace needs no clipping, and has neither --cull nor --wireframe")
        self.assertEqual(shown_after("r"), first)
        self.assertNotEqual(shown_after("w"), first)
        self.assertEqual(shown_after("s"), first)


@unittest.skipIf(MISSING, f"needs {' and '.join(MISSING)}")
class Flying(WindowTest):
    def setUp(self):
        super().setUp()
        from lib.running.pipe_tools import Tools
        pathlib.Path("scene.txt").write_text(SCENE)
        # Tools that log their runs.
        for tool in TOOLS:
            shim = pathlib.Path("tools", tool)
            shim.parent.mkdir(exist_ok=True)
            shim.write_text(f'#!/bin/sh\necho {tool} >> "{os.getcwd()}/ran"\nexec "{BIN}/{tool}" "$@"\n')
            shim.chmod(0o755)
        self.open(Tools("tools"), "scene.txt", CONFIG)
        pathlib.Path("ran").unlink()

    def status(self):
        return self.window.status.cget("text")

    def ran(self):
        """The stages that have run, in the order of the pipe: they run in parallel, so any may start
        first."""
        path = pathlib.Path("ran")
        words = path.read_text().split() if path.exists() else []
        path.unlink(missing_ok=True)
        return sorted(words, key=("model", "view", "project", "zbuf").index)

    def test_the_first_frame_is_the_pipes(self):
        self.assertEqual(self.shown(), frame_of(SCENE))

    def test_steps_move_the_eye_along_its_axes(self):
        # The camera looks from (1 2 5) to the origin; a step is a twentieth of that distance.
        distance = math.sqrt(30)
        forward = tuple(-x / distance for x in (1, 2, 5))
        right = (5 / math.sqrt(26), 0, -1 / math.sqrt(26))
        up = (-2 / math.sqrt(26 * 30), 26 / math.sqrt(26 * 30), -10 / math.sqrt(26 * 30))
        for key, way in (("w", forward), ("d", right), ("q", up)):
            with self.subTest(key):
                self.press("r", key)
                eye = [x + distance / 20 * step for x, step in zip((1, 2, 5), way)]
                look = [distance / 20 * step for step in way]
                self.assertEqual(self.shown(),
                                 frame_of(SCENE, view=["--eye", *map(repr, eye), "--look", *map(repr, look)]))

    def test_to_turn_right_moves_the_scene_left(self):
        def middle(ppm):
            pixels = ppm[-7200:]
            columns = [p % 60 for p in range(2400) if any(pixels[3 * p:3 * p + 3])]
            rows = [p // 60 for p in range(2400) if any(pixels[3 * p:3 * p + 3])]
            return sum(columns) / len(columns), sum(rows) / len(rows)

        x, y = middle(self.shown())
        self.press("Right", "Right")
        self.assertLess(middle(self.shown())[0], x - 2)
        self.press("r", "Up", "Up")
        self.assertGreater(middle(self.shown())[1], y + 2)

    def drag(self, right, down):
        picture = self.window.picture
        picture.event_generate("<ButtonPress-1>", x=10, y=10)
        picture.event_generate("<B1-Motion>", x=10 + right, y=10 + down)
        picture.event_generate("<ButtonRelease-1>", x=10 + right, y=10 + down)
        self.settle()

    def eye(self):
        return tuple(map(float, self.window.settings.camera.lines()[0]))

    def test_a_drag_orbits_around_the_point_looked_at(self):
        self.drag(100, 0)  # 0.4 degrees for each pixel: the scene turns to the right, the camera to the left
        angle = math.radians(-40)
        eye = (math.cos(angle) + 5 * math.sin(angle), 2, 5 * math.cos(angle) - math.sin(angle))
        for got, want in zip(self.eye(), eye, strict=True):
            self.assertAlmostEqual(got, want, places=12)
        self.assertEqual(self.shown(),
                         frame_of(SCENE, view=["--eye", *map(repr, self.eye()), "--look", "0", "0", "0"]))
        self.press("r")
        self.drag(0, 20)  # 8 degrees higher
        height = math.asin(2 / math.sqrt(30)) + math.radians(8)
        self.assertAlmostEqual(self.eye()[1], math.sqrt(30) * math.sin(height), places=12)
        self.assertAlmostEqual(math.hypot(*self.eye()), math.sqrt(30), places=12)

    def test_the_wheel_goes_nearer_and_back(self):
        first = self.shown()
        self.window.picture.event_generate("<Button-4>")
        self.settle()
        for got, want in zip(self.eye(), (0.9, 1.8, 4.5), strict=True):
            self.assertAlmostEqual(got, want, places=12)
        self.assertEqual(self.shown(),
                         frame_of(SCENE, view=["--eye", *map(repr, self.eye()), "--look", "0", "0", "0"]))
        self.window.picture.event_generate("<Button-5>")
        self.settle()
        self.assertEqual(self.shown(), first)

    def test_it_says_where_the_scene_is_and_home_brings_it_back(self):
        lost = self.window.lost
        self.assertFalse(lost.winfo_ismapped())
        self.press(*["Right"] * 60)  # 180 degrees
        self.assertTrue(lost.winfo_ismapped())
        self.assertRegex(lost.cget("text"),
                         r"^nothing is in sight: the scene is behind you, [\d.]+ away\nHome brings it back$")
        self.press(*["Left"] * 30)
        self.assertIn("the scene is to the left, ", lost.cget("text"))
        self.press("Home")
        self.assertFalse(lost.winfo_ismapped())
        # All of it is in sight, and fills most of the window.
        eye, look, up = self.window.settings.camera.lines()
        printed = pipe(["model"], ["view", "--eye", *eye, "--look", *look, "--up", *up], ["project"],
                       stdin=SCENE).decode().split("\n")
        reach = [
            max(abs(float(line.split()[axis])) for line in printed if line and not line[0].isalpha())
            for axis in (0, 1)]
        self.assertTrue(0.5 < max(reach) <= 1, reach)

    def test_h_shows_the_keys_and_hides_them(self):
        self.assertFalse(self.window.keys.winfo_ismapped())
        self.press("h")
        self.assertTrue(self.window.keys.winfo_ismapped())
        for key in ("Home", "Escape", "drag", "wheel", "c v"):
            self.assertIn(key, self.window.keys.cget("text"))
        self.press("h")
        self.assertFalse(self.window.keys.winfo_ismapped())

    def test_it_opens_wide_enough_with_the_scenes_aspect(self):
        from lib.running.pipe_tools import Tools
        from fly_parts.window import FlyWindow
        # 1280 x 1024 is the screen: of a large config, what is left beside the window's other parts.
        for config, line, size in ((CONFIG, "60 1 1 100", (640, 427)), (None, "60 1.6 1 100 ratio", (640,
                                                                                                     400)),
                                   (None, "frustum -2 2 -1 1 1 9", (640, 320)), ("4000 1000\n", "60 1 1 100",
                                                                                 (1152, 288))):
            with self.subTest(line):
                pathlib.Path("wide.txt").write_text(SCENE.replace("60 1 1 100", line))
                window = FlyWindow(Tools(BIN), "wide.txt", config, least_width=640)
                try:
                    self.wait_until(window.root.winfo_viewable)
                    window.root.update()
                    self.assertEqual((window.picture.winfo_width(), window.picture.winfo_height()), size)
                    self.assertEqual(window.photo.width(), size[0])
                finally:
                    window.close()

    def test_r_takes_everything_back(self):
        first = self.shown()
        self.press("w", "Left", "c", "z", "2", "b", "i", "j")
        self.assertNotEqual(self.shown(), first)
        self.press("r")
        self.assertEqual(self.shown(), first)

    def test_options_are_those_of_the_tools(self):
        culled = ["--clip", "frustum", "--cull", "back"]
        for key, words in (("c", culled[:2]), ("b", culled)):
            self.press(key)
            self.assertEqual(self.shown(), frame_of(SCENE, project=words))
        for key, model in (("1", "none"), ("2", "flat"), ("3", "gouraud"), ("4", "phong")):
            self.press(key)
            self.assertEqual(self.shown(), frame_of(SCENE, project=culled, zbuf=["--shading", model]))
        self.press("v", "b", "4")
        self.assertEqual(self.shown(), frame_of(SCENE, zbuf=["--shading", "phong"]))

    def test_z_opens_a_gap_at_the_sides_alone(self):
        """Of a wall just before far, which fills the picture."""
        from lib.showing.pictures import read_picture
        wall = "0 0 0\n0 0 -1\n0 1 0\n90 1 1 100\ntriangle\n-999 -999 -99\n999 -999 -99\n0 999 -99\nend\n"
        pathlib.Path("wall.txt").write_text(wall)
        self.open(self.window.tools, "wall.txt", "61 41\n-1.5\n-1\n-1 1\n")
        self.press("z", "z")
        self.shown()
        covered = [[any(row[i:i + 3]) for i in range(0, len(row), 3)] for row in read_picture("shown.ppm")[2]]
        self.assertEqual(covered,
                         [[abs(x - 30) * 3 / 61 <= 0.9 and abs(y - 20) * 2 / 41 <= 0.9 for x in range(61)]
                          for y in range(41)])

    def test_the_wireframe_is_zbufs(self):
        for words in (["--wireframe"], ["--wireframe", "all"], []):
            self.press("f")
            self.assertEqual(self.shown(), frame_of(SCENE, zbuf=words))

    def test_the_first_light_moves(self):
        self.press("l")
        step = math.sqrt(30) / 20
        self.assertEqual(self.shown(), frame_of(SCENE.replace("light 2 3 4", f"light {2 + step!r} 3 4")))
        self.press("u", "i")
        self.assertEqual(
            self.shown(),
            frame_of(SCENE.replace("light 2 3 4", f"light {2 + step!r} {3 + step!r} {4 - step!r}")))

    def test_a_frame_runs_the_stages_behind_what_changed(self):
        for keys, stages in ((["w"], ["view", "project", "zbuf"]), (["Left"], ["view", "project", "zbuf"]), ([
                "i"], ["view", "project", "zbuf"]), (["c"], ["project", "zbuf"]), (["b"], [
                    "project", "zbuf"]), (["2"], ["zbuf"]), (["2"], []), (["p"], [])):
            self.press(*keys)
            self.assertEqual(self.ran(), stages, keys)

    def test_the_status_line_tells_what_was_reused(self):
        self.press("c")
        self.assertRegex(
            self.status(),
            r"^model reused +view reused +project \d+ ms +zbuf \d+ ms +all \d+ ms +60x40 +--clip frustum$")

    def test_another_size_runs_zbuf_alone_and_keeps_the_shape(self):
        root, picture = self.window.root, self.window.picture
        below = root.winfo_height() - picture.winfo_height()
        root.geometry(f"700x{below + 80}")
        self.wait_until(lambda: picture.winfo_height() == 80)
        self.settle()
        self.assertEqual(self.ran(), ["zbuf"])
        self.assertEqual(self.shown(), frame_of(SCENE, "120 80\n" + CONFIG.split("\n", 1)[1]))

    def test_a_slow_frame_is_drawn_small_first(self):
        import fly_parts.window
        patched = unittest.mock.patch.multiple
        with patched(fly_parts.window, SLOW_SECONDS=0, REST_MS=10**6):
            self.window.whole_seconds = 1
            self.press("w")
        self.assertIn("15x10", self.status())
        self.assertTrue(self.shown().startswith(b"P6\n15 10\n"))
        self.assertEqual(self.ran(), ["view", "project", "zbuf"])
        with patched(fly_parts.window, SLOW_SECONDS=0, REST_MS=1):
            self.press("w")
            self.wait_until(lambda: "60x40" in self.status())
        self.assertEqual(self.ran(), ["view", "project", "zbuf", "zbuf"])

    def test_p_writes_a_scene_that_gives_this_frame(self):
        for keys in (["w", "w", "Left", "Up"], ["j", "k"]):
            self.press(*keys, "p")
            self.assertEqual(self.status(), "wrote fly.txt")
            written = pathlib.Path("fly.txt").read_text()
            self.assertEqual(frame_of(written), self.shown(), keys)
            self.assertIn("# eye", written)
            self.assertIn("# a scene to fly through", written)

    def test_P_writes_the_picture(self):
        from lib.showing.pictures import read_picture
        self.press("d", "P")
        pathlib.Path("shown.ppm").write_bytes(self.shown())
        self.assertEqual(read_picture("fly.png"), read_picture("shown.ppm"))

    def test_a_stage_that_dies_in_each_frame_is_named_and_leaves_the_picture(self):
        from lib.running.pipe_tools import Tools, ToolCrash
        first = self.shown()
        pathlib.Path("tools/project").write_text("#!/bin/sh\nkill -9 $$\n")
        for key in ("w", "d", "b"):
            self.press(key)
            self.assertEqual((self.status(), self.shown()), ("project: ended by SIGKILL", first))
        with self.assertRaisesRegex(ToolCrash, "project: ended by SIGKILL"):
            self.open(Tools("tools"), "scene.txt", CONFIG)
        os.unlink("scene.txt")
        self.press("p")
        self.assertEqual(self.status(), "cannot read scene.txt: No such file or directory")
        pathlib.Path("scene.txt").write_text("0 0 5\n")  # an editor has written a part of it
        self.press("p")
        self.assertEqual(self.status(), "the scene ends before its projection")
        os.unlink("scene.txt")
        os.mkfifo("scene.txt")
        self.press("p")
        self.assertEqual(self.status(), "cannot read scene.txt: Not a regular file")

    def test_what_a_tool_refuses_is_said_and_taken_back(self):
        from lib.running.pipe_tools import Tools
        pathlib.Path("dark.txt").write_text("\n".join(
            line for line in SCENE.split("\n") if not line.startswith("light")))
        self.open(Tools(BIN), "dark.txt", CONFIG)
        first = self.shown()
        self.press("4")
        self.assertIn("expected a light for --shading", self.status())
        self.press("c", "v")
        self.assertEqual(self.shown(), first)
        self.press("i")
        self.assertEqual(self.status(), "the scene has no light")


class Framing(unittest.TestCase):
    def distance(self, projection, radius=1.0):
        from fly_parts.framing import Ball, framing_distance
        keyword, *words = projection.split()
        return framing_distance(Ball((0, 0, 0), radius), {keyword: words})

    def test_the_ball_touches_no_side_of_the_window(self):
        # The narrower half of the field is 30 degrees, whose sine is 1/2; 26.565 degrees, whose tangent is
        # 1/2; 45 degrees.
        for projection, sine in (("perspective 60 1 0.1 100",
                                  1 / 2), ("perspective 60 2 0.1 100 ratio",
                                           1 / 2), ("perspective 90 0.5 0.1 100 ratio", 1 / math.sqrt(5)),
                                 ("frustum -0.3 0.3 -0.1 0.1 0.1 100", 1 / math.sqrt(2))):
            self.assertAlmostEqual(self.distance(projection), 1.05 / sine, msg=projection)

    def test_the_ball_is_around_triangles_and_spheres(self):
        from fly_parts.framing import Ball
        sphere = b"sphere\n1 2 3\n5 2 3\n1 6 3\n1 2 7\n\n"
        self.assertEqual(Ball.around(b"eye 0 0 1\n\n" + sphere), Ball((1, 2, 3), 4))
        self.assertEqual(Ball.around(b"eye 0 0 1\n\n" + sphere + b"13 2 3\n13 2 3\n13 2 3\n\n"),
                         Ball((5, 2, 3), 8))
        self.assertIsNone(Ball.around(b"eye 0 0 1\n\n"))

    def test_near_and_far_are_kept_where_that_can_be(self):
        self.assertAlmostEqual(self.distance("perspective 10 1 0.1 6"),
                               6 - 1.05)  # cut by the window rather than by far
        self.assertAlmostEqual(self.distance("perspective 10 1 3 4"), 3 + 1.05)  # by far rather than by near
        self.assertAlmostEqual(self.distance("ortho -1 1 -1 1 2 9"), 2 + 1.05)
        self.assertAlmostEqual(self.distance("ortho -1 1 -1 1 -5 9"), 1.05)
        self.assertGreater(self.distance("perspective 60 1 0.1 100", 0.0), 0)

    def test_directions_are_told_from_the_camera(self):
        from fly_parts.camera import Camera
        from fly_parts.framing import Ball, direction
        camera = Camera.of("0 0 5".split(), "0 0 0".split(), "0 1 0".split())
        for center, words in (((0, 0, 0), "straight ahead, 5 away"), ((0, 0, 8), "behind you, 3 away"),
                              ((9, 0, 5), "to the right, 9 away"), ((-9, 0, 9),
                                                                    "behind you, to the left, 9.85 away"),
                              ((0, 9, 0), "above, 10.3 away"), ((-3, -4, 5), "to the left, below, 5 away")):
            self.assertEqual(direction(camera, Ball(center, 0.1)), words)


@unittest.skipIf(MISSING, f"needs {' and '.join(MISSING)}")
class Ending(ToolTest):
    def test_a_signal_ends_it_without_a_traceback(self):
        pathlib.Path("scene.txt").write_text(SCENE)
        for number in (signal.SIGINT, signal.SIGTERM):
            # It prints the folder of its frames when its window waits.
            program = (
                "import sys; sys.path.insert(0, sys.argv[1]); sys.dont_write_bytecode = True; sys.argv[1:] = "
                "['scene.txt']\n"
                "from importlib.machinery import SourceFileLoader as Loader; from fly_parts.window import "
                "FlyWindow\n"
                "draw = FlyWindow.tell; FlyWindow.tell = lambda window, *words: "
                "(draw(window, *words), print(window.pipe.folder.name, flush=True))\n"
                "Loader('__main__', sys.path[0] + '/fly').load_module()")
            process = subprocess.Popen([sys.executable, "-c", program, SOURCE / "scripts"],
                                       stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                       env={**os.environ, "BIN": str(BIN)}, preexec_fn=heed_signals)
            folder = process.stdout.readline().rstrip()
            self.assertIn(b"frame.ppm", os.listdir(folder))
            self.assertEqual((end_by_signal(process, number)[1].decode(), process.returncode),
                             (f"fly: ended by {number.name}\n", -number))
            self.assertFalse(os.path.exists(folder))


class TransparentBackground(ToolTest):
    def test_is_shown_in_full(self):
        sys.path.insert(0, str(SOURCE / "scripts"))
        from fly_parts.pipe import FramePipe
        from lib.running.pipe_tools import Tools
        images = []
        for alpha in ("", " 128"):
            pathlib.Path("scene.txt").write_text(
                f"0 0 5\n0 0 0\n0 1 0\n60 1 1 100\nbackground 200 100.5 50{alpha}\ntriangle\n-1 -1 0\n1 -1 "
                f"0\n0 1 0\nend\n")
            frames = FramePipe(Tools(BIN), "scene.txt")
            images.append(frames.frame([["0", "0", "5"], ["0", "0", "0"], ["0", "1", "0"]], [], "20 20\n",
                                       []))
            frames.close()
        self.assertEqual(images[0][-3:], bytes((200, 101, 50)))
        self.assertEqual(*images)


class Messages(ToolTest):
    def test_what_is_wrong_is_told_in_a_line(self):
        with_sphere = SCENE.replace("triangle", "sphere 0 0 0 1\ntriangle", 1)
        for text, words, status, message in (
            (SCENE, [
                "--samples", "3"], 2, "--samples is for trace: it needs --trace (try fly --help)"), (SCENE, [
                    "--max-depth", "3"], 2, "--max-depth is for trace: it needs --trace (try fly --help)"),
            ("1 2 x\n", [], 1, "model: scene.txt:1:5: expected the z of the eye, found 'x'"),
            (with_sphere, [], 1,
             "model: scene.txt:9:1: expected triangles alone, found a sphere: --trace draws it"),
            (SCENE, [], 1, "no display name and no $DISPLAY environment variable")):
            if status == 1 and MISSING:
                self.skipTest(f"needs {' and '.join(MISSING)}")
            pathlib.Path("scene.txt").write_text(text)
            done = subprocess.run([SOURCE / "scripts/fly", "scene.txt", *words], capture_output=True,
                                  text=True, timeout=60, env={"BIN": str(BIN), "PATH": "/usr/bin:/bin"})
            self.assertEqual((done.returncode, done.stderr), (status, f"fly: {message}\n"))


if __name__ == "__main__":
    unittest.main()
