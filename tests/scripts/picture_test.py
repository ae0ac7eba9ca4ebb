#!/usr/bin/env python3
"""scripts/picture: one command does what the five tools do one after the other.

usage: picture_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import resource
import signal
import subprocess
import time
import unittest

from lib.running.spheres import has_the_word
from toolbox import BIN, SOURCE, Terminal, ToolTest, expect_mesh2scene, pipe, run


def setUpModule():  # noqa: N802
    expect_mesh2scene()


def picture(*words, command="picture", **settings):
    return subprocess.run([SOURCE / "scripts" / command, *words], capture_output=True, text=True,
                          env={**os.environ, "BIN": str(BIN)}, **settings)


class Picture(ToolTest):
    def setUp(self):
        super().setUp()
        model = subprocess.run([SOURCE / "scripts/make-model", "vase", "--detail", "2"], check=True,
                               capture_output=True).stdout
        pathlib.Path("vase.obj").write_bytes(model)

    def test_the_picture_is_that_of_the_pipe(self):
        done = picture("vase.obj", "--size", "120x90", "--up-axis", "y", "--eye-from", "10", "-20", "--fov",
                       "40", "-o", "one.png")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        scene = run("mesh2scene", "--size", "120x90", "--up-axis", "y", "--eye-from", "10", "-20", "--fov",
                    "40", "vase.obj").stdout
        pipe(["model"], ["view"], ["project"],
             ["zbuf", "--size", "120x90", "--coverage", "center", "--samples", "3", "--image", "two.png"],
             stdin=scene)
        self.assertEqual(pathlib.Path("one.png").read_bytes(), pathlib.Path("two.png").read_bytes())

    def test_stages_keep_every_text(self):
        done = picture("vase.obj", "--size", "120x90", "--up-axis", "y", "--stages", "kept/here", "-o",
                       "one.png")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        texts = {
            name: pathlib.Path("kept/here", name).read_bytes()
            for name in ("scene.txt", "stage1.txt", "stage2.txt", "stage3.txt")}
        self.assertEqual(sorted(os.listdir("kept/here")), sorted(texts))
        self.assertEqual(texts["scene.txt"],
                         run("mesh2scene", "--size", "120x90", "--up-axis", "y", "vase.obj").stdout)
        for tool, source, result in (("model", "scene.txt", "stage1.txt"),
                                     ("view", "stage1.txt", "stage2.txt"), ("project", "stage2.txt",
                                                                            "stage3.txt")):
            self.assertEqual(run(tool, stdin=texts[source]).stdout, texts[result])
        picture("vase.obj", "--size", "120x90", "--up-axis", "y", "-o", "two.png")
        self.assertEqual(pathlib.Path("one.png").read_bytes(), pathlib.Path("two.png").read_bytes())

    def test_a_pipe_is_read_like_a_file(self):
        """Of a model and of a scene, as standard input and as a pipe of the shell's."""
        words = ["--size", "60x45", "-o"]
        for name in ("vase.obj", "scene.txt"):
            if name == "scene.txt":
                scene = run("mesh2scene", "--size", "60x45", "--up-axis", "y", "vase.obj").stdout
                pathlib.Path(name).write_bytes(scene)
            options = ["--up-axis", "y", *words] if name == "vase.obj" else words
            self.assertEqual(picture(name, *options, "one.png").stderr, "")
            for call in ('"$0" - "$@" two.png < ' + name, f'"$0" <(cat {name}) "$@" two.png'):
                with self.subTest(call=call):
                    done = subprocess.run(["bash", "-c", call, SOURCE / "scripts/picture", *options],
                                          capture_output=True, text=True, env={**os.environ, "BIN": str(BIN)})
                    self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                    self.assertEqual(
                        pathlib.Path("one.png").read_bytes(),
                        pathlib.Path("two.png").read_bytes())

    def test_without_a_name_a_pipe_gets_a_png(self):
        words = ["vase.obj", "--size", "60x45", "--up-axis", "y"]
        self.assertEqual(picture(*words, "-o", "one.png").stderr, "")
        for more in ([], ["-o", "png:-"]):
            done = subprocess.run([SOURCE / "scripts/picture", *words, *more], capture_output=True,
                                  env={**os.environ, "BIN": str(BIN)})
            self.assertEqual((done.stdout, done.stderr), (pathlib.Path("one.png").read_bytes(), b""))
        done = subprocess.run([SOURCE / "scripts/picture", *words], stdout=Terminal(self).channel,
                              stderr=subprocess.PIPE, env={**os.environ, "BIN": str(BIN)})
        self.assertEqual(
            (done.returncode, done.stderr),
            (2, b"picture: expected -o FILE, such as -o vase.png, found a terminal for the picture (try "
             b"picture --help)\n"))

    def test_no_way_leads_into_its_own_model(self):
        scene = "0 0 3\n0 0 0\n0 1 0\n60 1 1 9\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
        pathlib.Path("scene.txt").write_text(scene)
        os.link("scene.txt", "link.png")
        for call in ('"$0" scene.txt -o png:scene.txt', '"$0" scene.txt -o link.png',
                     '"$0" scene.txt >> scene.txt', '"$0" - < scene.txt >> scene.txt',
                     '"$0" scene.txt --stages . -o png:stage1.txt'):
            done = subprocess.run(["bash", "-c", call, SOURCE / "scripts/picture"], capture_output=True,
                                  text=True, env={**os.environ, "BIN": str(BIN)})
            self.assertEqual((done.returncode, done.stdout), (2, ""), call)
            self.assertIn("expected a place of its own for every output", done.stderr)
            self.assertEqual(pathlib.Path("scene.txt").read_text(), scene)

    def test_a_scene_is_never_drawn_out_of_shape_in_silence(self):
        scene = "0 0 3\n0 0 0\n0 1 0\n60 1 1 9\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
        os.mkdir("alone")
        pathlib.Path("alone/scene.txt").write_text(scene)
        self.assertEqual(picture("alone/scene.txt", "-o", "a.png").stderr, "")
        pathlib.Path("scene.txt").write_text(scene)
        for words in (["--size", "40x30"], []):
            pathlib.Path("config.txt").write_text("40 30\n")
            self.assertEqual(
                picture("scene.txt", *words, "-o", "a.png").stderr,
                "picture: note: a square is drawn 1.33 times as wide as high: let the aspect be 1.33333 in "
                "the scene's fourth line, and end that line in ratio, or choose another --size\n")

    def test_a_broken_scene_has_the_message_of_model(self):
        for text in ("0 0\n", "rotat\n", ""):
            pathlib.Path("scene.txt").write_text(text)
            self.assertRegex(picture("scene.txt", "-o", "a.png").stderr, r"^picture: model: scene.txt:\d+:")

    def test_trace_draws_in_place_of_project_and_zbuf(self):
        framing = ("--size", "60x45", "--up-axis", "y")
        scene = run("mesh2scene", *framing, "vase.obj").stdout
        for words, tracing in ((["--trace"], ["--samples", "3"]), ([
                "--trace", "--sampling", "adaptive", "--no-shadows", "--shading", "flat"], [
                    "--sampling", "adaptive", "--no-shadows", "--shading", "flat"]), ([
                        "--trace", "--samples", "1", "--max-depth", "0"], ["--max-depth", "0"])):
            with self.subTest(words):
                done = picture("vase.obj", *framing, *words, "--stages", "kept", "-o", "one.png")
                self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
                self.assertEqual(sorted(os.listdir("kept")), ["scene.txt", "stage1.txt", "stage2.txt"])
                pipe(["model"], ["view"],
                     ["trace", "--size", "60x45", *tracing, "--z-buffer", "none", "--image", "two.png"],
                     stdin=scene)
                self.assertEqual(pathlib.Path("one.png").read_bytes(), pathlib.Path("two.png").read_bytes())
                picture("vase.obj", *framing, *words, "-o", "three.png")
                self.assertEqual(pathlib.Path("three.png").read_bytes(), pathlib.Path("two.png").read_bytes())

    def test_a_file_that_the_model_names_is_not_replaced(self):
        pathlib.Path("named.obj").write_text("mtllib own.png\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        pathlib.Path("own.png").write_text("newmtl red\n")
        pathlib.Path("link.png").symlink_to("own.png")
        for command, output in ("picture", "./own.png"), ("picture", "link.png"), ("inspect", "own.png"):
            done = picture("named.obj", "-o", output, command=command)
            self.assertEqual(
                (done.returncode, done.stderr),
                (2, f"{command}: mesh2scene: expected a place of its own for --writes '{output}', found "
                 "'own.png', which the model names (try mesh2scene --help)\n"))
        self.assertEqual(pathlib.Path("own.png").read_text(), "newmtl red\n")

    def test_a_note_is_passed_on_with_the_models_box(self):
        corners = [
            line.split()[1:4] for line in pathlib.Path("vase.obj").read_text().splitlines()
            if line.startswith("v ")]
        columns = [[float(word) for word in column] for column in zip(*corners)]
        low, high = (" ".join(f"{side(column):.4g}" for column in columns) for side in (min, max))
        self.assertEqual(
            picture("vase.obj", "-o", "one.png").stderr,
            f"mesh2scene: note: y is taken for up, as in most OBJ files (--up-axis chooses); it reaches from "
            f"{low} to {high} (--at looks elsewhere, --zoom closer)\n")

    def test_a_search_in_a_long_file_is_ended_by_a_signal_and_by_truncation(self):
        for end in (lambda pid: os.kill(pid, signal.SIGTERM), lambda pid: os.truncate("long", 0)):
            with open("long", "wb") as file:
                file.truncate(1 << 36)
            child = os.fork()
            if not child:
                signal.signal(signal.SIGTERM, lambda *_: os._exit(0))
                os._exit(has_the_word("long", b"sphere"))
            time.sleep(0.3)
            start = time.monotonic()
            end(child)
            self.assertEqual(os.waitpid(child, 0)[1], 0)
            self.assertLess(time.monotonic() - start, 10)
        for place in range((1 << 20) - 7, (1 << 20) + 1):
            pathlib.Path("long").write_bytes(bytes(place) + b"sphere")
            self.assertTrue(has_the_word("long", b"sphere"))

    def test_of_failures_the_cause_is_told_alone(self):
        os.mkfifo("pipe")
        pathlib.Path("broken.obj").write_text("v 0 0\n")
        pathlib.Path("large.obj").write_text("#" * 1_000_001)
        for words, reason in (("missing.obj", "cannot open missing.obj: No such file or directory"),
                              ("broken.obj", "broken.obj:1:6: expected three coordinates, "),
                              ("pipe", "pipe: expected a regular file, or - for what comes through a pipe\n"),
                              ("large.obj --max-input 1", "large.obj: expected at most 1 MB "),
                              ("vase.obj --fov 0", "--fov: expected "), ("vase.obj --size 0x1",
                                                                         "--size: expected ")):
            for more in ([], ["--stages", "kept"]):
                with self.subTest(words, more=more):
                    done = picture(*words.split(), *more, "-o", "one.png")
                    status = 2 if "(try mesh2scene --help)" in done.stderr else 1
                    self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (status, "", 1),
                                     done.stderr)
                    self.assertTrue(done.stderr.startswith(f"picture: mesh2scene: {reason}"), done.stderr)
                    self.assertFalse(pathlib.Path("one.png").exists())
                    self.assertFalse(pathlib.Path("kept").exists())
        for words, status, reason in (("-o one.gif", 2,
                                       "zbuf: "), ("--stages=", 2, "expected the name of a folder, found ''"),
                                      ("-o nowhere/one.png", 1,
                                       "zbuf: cannot open nowhere/one.png: No such file")):
            done = picture("vase.obj", *words.split())
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (status, "", 1),
                             done.stderr)
            self.assertTrue(done.stderr.startswith(f"picture: {reason}"), done.stderr)

    def test_a_scene_is_drawn_with_its_own_camera(self):
        """At the size that is asked for, else the config's beside it, else in the camera's shape."""
        os.mkdir("beside")
        os.mkdir("alone")
        pathlib.Path("beside/config.txt").write_text("40 20\n-1\n-0.5\n-1 1\n")
        for folder, camera, words, drawn in (("alone", "60 2 1 100 ratio", [], [
                "project",
                "zbuf --coverage center --samples 3 --size 1200x600"]), ("alone", "ortho -1 1 -2 2 1 9", [
                    "--trace"], ["trace --samples 3 --size 600x1200"]), (".", "60 1 1 100", [
                        "--size", "60x60", "--background", "ff000080"], [
                            "project", "zbuf --coverage center --samples 3 --size 60x60 --background ff000080"
                        ]), ("beside", "60 1 1 100", ["--shading", "none"], [
                            "project",
                            "zbuf beside/config.txt --coverage center --samples 3 --shading none"])):
            scene = f"# mine\n\n0 0 5  # eye\n0 0 0\n0 1 0\n{camera}\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
            pathlib.Path(folder, "my scene.txt").write_text(scene)
            done = picture(f"{folder}/my scene.txt", *words, "-o", "one.png")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            image = ["--z-buffer", "none", "--image", "two.png"]
            pipe(["model"], ["view"],
                 *([*stage.split(), *(image if stage != "project" else [])] for stage in drawn),
                 stdin=scene.encode())
            one, two = (pathlib.Path(name).read_bytes() for name in ("one.png", "two.png"))
            self.assertEqual(one, two, camera)

    def test_a_scene_may_stand_among_its_stages(self):
        text = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
        pathlib.Path("scene.txt").write_text(text)
        done = picture("scene.txt", "--size", "60x60", "--stages", ".", "-o", "one.png")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(pathlib.Path("scene.txt").read_text(), text)
        self.assertEqual(pathlib.Path("stage1.txt").read_bytes(), run("model", "scene.txt").stdout)

    def test_a_stage_that_cannot_be_written_or_read_back_is_refused(self):
        pathlib.Path("scene.txt").write_text("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\nend\n")
        os.makedirs("kept")
        for make in (lambda: os.symlink(os.devnull, "kept/stage3.txt"), lambda: os.mkfifo("kept/stage3.txt")):
            make()
            done = picture("scene.txt", "--size", "60x60", "--stages", "kept", "-o", "one.png")
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(
                done.stderr, "picture: expected a regular file, which the next tool reads, "
                "found kept/stage3.txt\n")
            self.assertEqual((os.listdir("kept"), os.path.exists("one.png")), (["stage3.txt"], False))
            os.unlink("kept/stage3.txt")
        done = picture("scene.txt", "--stages", "kept", "-o", "one.png",
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (50, 50)))
        self.assertEqual((done.stderr, os.listdir("kept")),
                         ("picture: model: cannot write kept/stage1.txt: File too large\n", []))

    def test_a_scene_keeps_its_camera_and_colors(self):
        pathlib.Path("scene.txt").write_text("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\nend\n")
        for words in (["--zoom", "2"], ["--at", "0", "0", "0"], ["--color", "ff0000"]):
            done = picture("scene.txt", *words, "-o", "one.png")
            self.assertEqual(
                (done.returncode, done.stderr),
                (2, f"picture: expected a model for {words[0]}, found the scene scene.txt, which has its own "
                 "camera and colors: change its lines (try picture --help)\n"))

    def test_what_mesh2scene_takes_is_passed_on(self):
        words = ["--at", "0", "-1", "0.5", "--zoom", "2", "--color", "ff0000", "--size", "60x45"]
        picture("vase.obj", *words, "--background", "00000000", "--stages", "kept", "-o", "one.png")
        self.assertEqual(
            pathlib.Path("kept/scene.txt").read_bytes(),
            run("mesh2scene", *words, "vase.obj").stdout)
        image = pathlib.Path("one.png").read_bytes()
        self.assertEqual(image[25], 6)  # the color type: with an alpha

    def test_colors_of_css_and_up_axes_that_point_down(self):
        for color in ("red", "#f00", "#ff0000", "ff0000"):
            done = picture("vase.obj", "--color", color, "--background", "white", "--up-axis", "-y", "--size",
                           "40x30", "-o", f"{color}.png")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(len({path.read_bytes() for path in pathlib.Path().glob("*.png")}), 1)
        for option, color in (("--background", "blu"), ("--color", "#ff"), ("--color", "255,0,0")):
            self.assertEqual(
                picture("vase.obj", option, color, "-o", "a.png").stderr, f"picture: argument {option}: "
                f"expected RRGGBB[AA], a CSS color, or transparent, found '{color}' (try picture --help)\n")

    def test_a_model_stands_for_a_scene(self):
        done = picture("vase.obj", "--triangle", "0", command="explain")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(": the scene of vase.obj, line ", done.stdout.splitlines()[0])

    def test_misuse_is_told_in_a_line(self):
        for words, message in (("--shadows",
                                "expected an option of picture, found '--shadows' (--trace draws them)"),
                               ("--no-shadows", "--no-shadows is for trace: it needs --trace"),
                               ("--bakground red", "unrecognized arguments: --bakground red (did you mean "
                                "--background?)"), ("--eye 30 15", "unrecognized arguments: --eye 30 15"),
                               ("-o a.jpg",
                                "-o: expected a .png, .bmp or .ppm file, found 'a.jpg': draw a.png, "
                                "then: convert a.png a.jpg"), ("-o png:", "-o: expected the name of a file, "
                                                               "found 'png:'"),
                               ("--output=", "-o: expected the name of a file, found ''")):
            done = picture("vase.obj", "-o", "a.png", *words.split(" "))
            self.assertEqual((done.returncode, done.stderr),
                             (2, f"picture: {message} (try picture --help)\n"))


if __name__ == "__main__":
    unittest.main()
