#!/usr/bin/env python3
"""Two outputs of a run that would end up in one file or one pipe are refused before anything is read or
written.

usage: outputs_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import subprocess
import unittest

from toolbox import BIN, CONFIG, SCENE, ToolTest, command, pseudo_terminal, run, stage_texts

OLD = b"an older file"
DEPTH_LINES = 8  # of the screen in config.txt


class SeparateOutputs(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("stage3.txt").write_bytes(stage_texts()[2])

    def refused(self, first, second):
        return (f"zbuf: expected a place of its own for every output, found the same one for {first} and "
                f"{second} "
                "(try zbuf --help)")

    def check_refused(self, words, first, second, note="", **settings):
        """The run is refused, after a note if there is one, and every file stays as it was."""
        before = {name: pathlib.Path(name).read_bytes() for name in self.files()}
        done = run("zbuf", "config.txt", "stage3.txt", *words.split(), **settings)
        self.assert_fails(done, 2, note + self.refused(first, second))
        self.assertEqual({name: pathlib.Path(name).read_bytes() for name in self.files()}, before)

    def check_fine(self, words, **settings):
        done = run("zbuf", "config.txt", "stage3.txt", *words.split(), **settings)
        self.assert_quiet_success(done)
        return done

    def test_one_name_serves_one_output(self):
        for options in (("--image", "--z-buffer"), ("--image", "--fragments"), ("--z-buffer", "--fragments")):
            with self.subTest(options=options):
                self.check_refused(" ".join(f"{option} x.bmp" for option in options),
                                   *(f"{option} 'x.bmp'" for option in options))
        self.check_refused("--image x.png --depth-image x.png", "--image 'x.png'", "--depth-image 'x.png'")
        self.check_refused("--z-buffer x.pgm --depth-image x.pgm", "--z-buffer 'x.pgm'",
                           "--depth-image 'x.pgm'")
        self.check_refused("--depth-array x.npy --triangle-array x.npy", "--depth-array 'x.npy'",
                           "--triangle-array 'x.npy'")
        self.check_refused("--depth-image x.pgm --fragments x.pgm", "--depth-image 'x.pgm'",
                           "--fragments 'x.pgm'")

    def test_the_triangles_that_are_seen_have_a_place_of_their_own(self):
        for option in ("--image", "--z-buffer", "--fragments"):
            self.check_refused(f"{option} x.bmp --seen ./x.bmp", f"{option} 'x.bmp'", "--seen './x.bmp'")
        self.check_refused("--depth-image x.pgm --seen x.pgm", "--depth-image 'x.pgm'", "--seen 'x.pgm'")
        self.check_refused("--seen - --fragments /dev/stdout", "--fragments '/dev/stdout'", "standard output")
        self.check_fine("--seen out.bmp")  # no image

    def test_the_image_has_its_name_also_if_nobody_gave_it(self):
        self.check_refused("--fragments out.bmp", "--image 'out.bmp'", "--fragments 'out.bmp'")

    def test_the_two_need_not_stand_next_to_each_other(self):
        self.check_refused("--z-buffer z.txt --depth-image d.pgm --fragments ./out.bmp", "--image 'out.bmp'",
                           "--fragments './out.bmp'")

    def test_other_words_for_the_folder_are_the_same_file(self):
        os.mkdir("folder")
        os.symlink(".", "here")
        for exists in (False, True):
            for name in ("./x.bmp", "folder/../x.bmp", os.path.abspath("x.bmp"), ".//x.bmp", "here/x.bmp"):
                with self.subTest(exists=exists, name=name):
                    done = run("zbuf", "config.txt", "stage3.txt", "--image", "x.bmp", "--z-buffer", name)
                    shown = name if len(name) <= 40 else name[:40] + "..."
                    self.assert_fails(done, 2, self.refused("--image 'x.bmp'", f"--z-buffer '{shown}'"))
                    self.assertEqual(os.path.exists("x.bmp"), exists)
            pathlib.Path("x.bmp").write_bytes(OLD)
        self.assertEqual(pathlib.Path("x.bmp").read_bytes(), OLD)

    def test_a_symbolic_link_is_the_file_it_leads_to(self):
        os.symlink("x.bmp", "link.txt")
        done = run("zbuf", "config.txt", "stage3.txt", "--image", "x.bmp", "--z-buffer", "link.txt")
        self.assert_fails(done, 2, self.refused("--image 'x.bmp'", "--z-buffer 'link.txt'"))
        pathlib.Path("x.bmp").write_bytes(OLD)
        self.check_refused("--image x.bmp --z-buffer link.txt", "--image 'x.bmp'", "--z-buffer 'link.txt'")

    def test_a_hard_link_is_the_same_file(self):
        pathlib.Path("x.bmp").write_bytes(OLD)
        os.link("x.bmp", "y.txt")
        self.check_refused("--image x.bmp --z-buffer y.txt", "--image 'x.bmp'", "--z-buffer 'y.txt'")

    def test_standard_output_may_be_the_file(self):
        note = "zbuf: note: depths go to standard output, here out.bmp; the picture: -o out.png\n"
        for mode in ("wb", "ab"):
            with open("out.bmp", mode) as output:
                self.check_refused("", "--image 'out.bmp'", "standard output", note, stdout=output)
        with open("out.bmp", "wb") as output:
            self.check_refused("--image x.bmp --fragments out.bmp", "standard output",
                               "--fragments 'out.bmp'", note, stdout=output)

    def test_standard_output_without_depths_is_no_output(self):
        with open("z.txt", "wb") as output:
            self.check_fine("--z-buffer z.txt", stdout=output)
        self.assertEqual(len(pathlib.Path("z.txt").read_bytes().splitlines()), DEPTH_LINES)

    def test_a_pipe_takes_one_output(self):
        self.check_refused("--fragments /dev/stdout", "standard output", "--fragments '/dev/stdout'")
        self.check_refused("--z-buffer /dev/fd/1 --fragments /proc/self/fd/1", "--z-buffer '/dev/fd/1'",
                           "--fragments '/proc/self/fd/1'")
        os.symlink("/dev/stdout", "x.ppm")
        done = run("zbuf", "config.txt", "stage3.txt", "--image", "x.ppm")
        self.assert_fails(done, 2, self.refused("--image 'x.ppm'", "standard output"))

    def test_a_descriptor_that_is_not_open_never_becomes_that_of_another_output(self):
        for number in range(3, 12):
            done = run("zbuf", "config.txt", "stage3.txt", "--image", "x.ppm", "--fragments", "f.txt",
                       "--z-buffer", f"/dev/fd/{number}")
            self.assert_fails(done, 1, f"zbuf: cannot open /dev/fd/{number}: Bad file descriptor")
            self.assertEqual(self.files(), ["config.txt", "scene.txt", "stage3.txt"])

    def test_a_named_pipe_takes_one_output(self):
        os.mkfifo("x.ppm")
        done = run("zbuf", "config.txt", "stage3.txt", "--image", "x.ppm", "--z-buffer", "x.ppm")
        self.assert_fails(done, 2, self.refused("--image 'x.ppm'", "--z-buffer 'x.ppm'"))

    def test_an_image_alone_may_go_to_the_pipe(self):
        os.symlink("/dev/stdout", "x.ppm")
        self.assertTrue(self.check_fine("--image x.ppm --z-buffer z.txt").stdout.startswith(b"P6\n8 8\n"))

    def test_a_device_takes_any_number(self):
        self.check_fine("--z-buffer /dev/null --fragments /dev/null")
        os.symlink("/dev/null", "x.bmp")
        self.check_fine("--image x.bmp --z-buffer /dev/null")
        self.check_fine("--fragments /dev/null", stdout=subprocess.DEVNULL)

    def test_a_terminal_takes_any_number(self):
        ours, theirs = pseudo_terminal()
        self.addCleanup(os.close, ours)
        with open(theirs, "wb") as terminal:
            self.check_fine("--z-buffer - --fragments /dev/stdout", stdout=terminal)

    def test_files_of_one_name_in_two_folders_are_two(self):
        os.mkdir("folder")
        self.check_fine("--image x.bmp --z-buffer folder/x.bmp")
        self.check_fine("--image x.bmp --z-buffer folder/x.bmp")

    def test_a_file_named_dash_is_not_standard_output(self):
        self.check_fine("--fragments -")
        self.assertIn("-", self.files())

    def test_standard_error_takes_one_output(self):
        for name in ("/dev/stderr", "/dev/fd/2", "/proc/self/fd/2"):
            for words in ("--stats /dev/stderr", "--probe 4,4"):
                self.check_refused(f"{words} --fragments {name}", f"--fragments '{name}'", "standard error")
        self.assertEqual(
            run("zbuf", "config.txt", "stage3.txt", "--stats", "/dev/stderr", "--probe", "4,4").returncode, 0)

    def test_standard_error_may_be_the_terminal_or_where_standard_output_goes(self):
        ours, theirs = pseudo_terminal()
        self.addCleanup(os.close, ours)
        words = command("zbuf", "config.txt", "stage3.txt", "--stats", "/dev/stderr")
        with open(theirs, "wb") as terminal:
            self.assertEqual(
                subprocess.run([*words, "--fragments", "/dev/stderr"], stdout=subprocess.PIPE,
                               stderr=terminal).returncode, 0)
        done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual((done.returncode, len(done.stdout.splitlines()) > DEPTH_LINES), (0, True))

    def test_nothing_is_read_before(self):
        with subprocess.Popen(command("zbuf", "none.txt", "--z-buffer",
                                      "out.bmp"), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as waiting:  # its input stays open
            self.assertEqual(waiting.wait(60), 2)
            self.assertEqual(waiting.stderr.read().decode(),
                             self.refused("--image 'out.bmp'", "--z-buffer 'out.bmp'") + "\n")


PICTURES = ("--image", "--z-buffer", "--depth-image", "--stats")
SCENE_TEXT, WORLD, VIEW, NDC, SCREEN, MODEL = range(6)
RUNS = (  # tool, its inputs, the words after them, the options that name an output
    ("model", {"INPUT": SCENE_TEXT}, [], ["--stats"]), ("view", {"--scene": SCENE_TEXT, "INPUT": WORLD}, [], [
        "--stats"]), ("project", {"--scene": SCENE_TEXT, "INPUT": VIEW}, [], ["--stats"]), ("zbuf", {
            "CONFIG": SCREEN, "INPUT": NDC}, [], [*PICTURES, "--fragments", "--seen"]), ("zbuf", {
                "CONFIG": SCREEN, "INPUT": NDC}, ["--coverage", "center"], ["--certify"]), ("trace", {
                    "--scene": SCENE_TEXT, "CONFIG": SCREEN, "INPUT": VIEW}, [], [*PICTURES]), ("cut-scene", {
                        "SCENE": SCENE_TEXT}, ["2"], []), ("join-seen", {
                            "PART": WORLD}, [], []), ("mesh2scene", {"INPUT": MODEL}, [], []))
SUFFIXES = {"--image": ".bmp", "--depth-image": ".pgm"}
LINKS = {"its name": None, "a symbolic link": os.symlink, "a hard link": os.link}


class InputsStay(ToolTest):
    """No output replaces, or is added to, a file that the run reads: of each tool, every output with every
    input."""
    def setUp(self):
        super().setUp()
        self.texts = [
            SCENE.encode(), *stage_texts(),
            CONFIG.encode(), b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"]

    def contents(self):
        return {name: pathlib.Path(name).read_bytes() for name in self.files()}

    def words(self, inputs, read_from_stdin, suffix):
        """The words that name the inputs, each a file of its own, and one of them standard input, unless that
        is None."""
        words = []
        for name, text in inputs.items():
            file = name.strip("-") + suffix
            pathlib.Path(file).write_bytes(self.texts[text])
            words += [name] if name.startswith("--") else []
            words.append("-" if name == read_from_stdin else file)
        return words

    def check(self, tool, inputs, more, option, taken, from_stdin, link):
        """The run whose output `option` (None: standard output) is a link to the file of the input
        `taken`."""
        suffix = ".obj" if tool == "mesh2scene" else SUFFIXES.get(option, ".txt")
        for name in self.files():
            os.remove(name)
        words = [*self.words(inputs, taken if from_stdin else None, suffix), *more]
        file = output = taken.strip("-") + suffix
        if link:
            link(file, output := "link" + suffix)
        before = self.contents()
        with open(file, "rb") as read, open(output, "r+b") as written:
            done = subprocess.run(command(tool, *words, *([option, output] if option else [])), stdin=read,
                                  stdout=subprocess.PIPE if option else written, stderr=subprocess.PIPE,
                                  timeout=60)
        if (option, taken) == ("--seen", "INPUT"):
            self.assert_quiet_success(done)
            self.assertEqual(pathlib.Path(output).read_bytes(), self.seen)
        else:
            first = "standard input" if from_stdin else f"{taken} '{file}'"
            second = f"{option} '{output}'" if option else "standard output"
            self.assert_fails(
                done, 2,
                f"{tool}: expected a place of its own for every output, found the same one for {first} and "
                f"{second} (try {tool} --help)")
            self.assertIn(done.stdout or b"", (b"", b"error " + done.stderr))
            self.assertEqual(self.contents(), before)

    def test_no_output_is_an_input_but_that_of_seen(self):
        pathlib.Path("stage3.txt").write_bytes(self.texts[NDC])
        self.seen = run("zbuf", "config.txt", "stage3.txt", "--seen", "-").stdout
        for tool, inputs, more, options in RUNS:
            if not (BIN / tool).exists():
                continue  # mesh2scene, without PIPELINE_MODELS
            for option, taken, from_stdin, way in itertools.product((*options, None), inputs, (False, True),
                                                                    LINKS):
                with self.subTest(tool=tool, option=option, input=taken, from_stdin=from_stdin, way=way):
                    self.check(tool, inputs, more, option, taken, from_stdin, LINKS[way])


if __name__ == "__main__":
    unittest.main()
