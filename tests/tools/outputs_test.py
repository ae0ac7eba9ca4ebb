#!/usr/bin/env python3
"""Two outputs of a run that would end up in one file or one pipe, or one in a file that it reads, are refused
before anything is read or written.

usage: outputs_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import itertools
import os
import pathlib
import re
import subprocess
import unittest

from toolbox import (BIN, CONFIG, SCENE, TRIANGLE, Terminal, ToolTest, add_claims, alternatives, run,
                     stage_texts)

# The second triangle is hidden.
TWO = SCENE.replace("end\n", "translate 0.2 0.2 -1\nscale 0.1 0.1 1\n" + TRIANGLE + "end\n")
WORLD, VIEW, NDC = stage_texts(TWO)
TEXTS = {
    "scene": TWO.encode(), "world": WORLD, "view": VIEW, "ndc": NDC,
    "config": CONFIG.encode(), "tent": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "seen": run(
        "zbuf", "--size", "8x8", "--seen", "-", stdin=NDC).stdout}
SUFFIXES = {"--image": ".bmp", "--depth-image": ".pgm"}


def same(first, second, tool="zbuf"):
    return (
        f"{tool}: expected a place of its own for every output, found the same one for {first} and {second} "
        f"(try {tool} --help)\n")


IMAGE = "--image 'x.bmp'"
NOTE = "zbuf: note: depths go to standard output, here out.bmp; the picture: -o out.png\n"
# A claim; a shell line that prepares; one that runs, in which Z is a run of zbuf; and what is on stderr: if
# nothing, the run succeeds.
CASES = [
    *((f"{first[2:]} and {second[2:]} have a name each", "", f"Z {first} {name} {second} {alias}",
       same(f"{first} '{name}'", f"{second} '{alias}'")) for first, second, name, alias in (
           ("--image", "--z-buffer", "x.bmp", "x.bmp"), ("--image", "--fragments", "x.bmp", "x.bmp"),
           ("--image", "--depth-image", "x.png", "x.png"), ("--image", "--seen", "x.bmp", "./x.bmp"),
           ("--z-buffer", "--fragments", "x.bmp", "x.bmp"), ("--z-buffer", "--depth-image", "x.pgm", "x.pgm"),
           ("--z-buffer", "--seen", "x.bmp", "./x.bmp"), ("--fragments", "--seen", "x.bmp", "./x.bmp"),
           ("--depth-image", "--fragments", "x.pgm", "x.pgm"), ("--depth-image", "--seen", "x.pgm", "x.pgm"),
           ("--depth-array", "--triangle-array", "x.npy", "x.npy"))),
    ("the image has its name also if nobody gave it", "", "Z --fragments out.bmp",
     same("--image 'out.bmp'", "--fragments 'out.bmp'")),
    ("with --seen there is no image", "", "Z --seen out.bmp", ""),
    ("the two need not stand next to each other", "",
     "Z --z-buffer z.txt --depth-image d.pgm --fragments ./out.bmp",
     same("--image 'out.bmp'", "--fragments './out.bmp'")),
    *((f"a file is the same {place}", "mkdir folder; ln -s . here; {|echo older > x.bmp}",
       f"Z --image x.bmp --z-buffer {name}", same(IMAGE, f"--z-buffer '{name}'"))
      for place, name in (("in this folder", "./x.bmp"), ("above another", "folder/../x.bmp"),
                          ("below the root", "$PWD/x.bmp"), ("behind two slashes", ".//x.bmp"),
                          ("in a link to the folder", "here/x.bmp"))),
    ("a symbolic link is the file it leads to", "ln -s x.bmp link.txt; {|echo older > x.bmp}",
     "Z --image x.bmp --z-buffer link.txt", same(IMAGE, "--z-buffer 'link.txt'")),
    ("a hard link is the same file", "echo older > x.bmp; ln x.bmp y.txt", "Z --image x.bmp --z-buffer y.txt",
     same(IMAGE, "--z-buffer 'y.txt'")),
    ("standard output may be the image", ": > out.bmp", "Z {>|>>} out.bmp",
     NOTE + same("--image 'out.bmp'", "standard output")),
    ("standard output may be another file", ": > out.bmp", "Z --image x.bmp --fragments out.bmp > out.bmp",
     NOTE + same("standard output", "--fragments 'out.bmp'")),
    ("standard output without depths is no output", "",
     'Z --z-buffer z.txt > z.txt && [ "$(wc -l < z.txt)" -eq 8 ]', ""),
    ("a pipe takes one output", "", "Z --fragments /dev/stdout",
     same("standard output", "--fragments '/dev/stdout'")),
    ("a pipe takes one output beside seen triangles", "", "Z --seen - --fragments /dev/stdout",
     same("--fragments '/dev/stdout'", "standard output")),
    ("a pipe has many names", "", "Z --z-buffer /dev/fd/1 --fragments /proc/self/fd/1",
     same("--z-buffer '/dev/fd/1'", "--fragments '/proc/self/fd/1'")),
    ("a link may lead to the pipe", "ln -s /dev/stdout x.ppm", "Z --image x.ppm",
     same("--image 'x.ppm'", "standard output")),
    ("a named pipe takes one output", "mkfifo x.ppm", "Z --image x.ppm --z-buffer x.ppm",
     same("--image 'x.ppm'", "--z-buffer 'x.ppm'")),
    ("an image alone may go to the pipe", "ln -s /dev/stdout x.ppm",
     'Z --image x.ppm --z-buffer z.txt > y.ppm && [ "$(head -n 2 y.ppm | tr "\\n" .)" = "P6.8 8." ]', ""),
    *((f"descriptor {i} is not open, and never becomes the one of another output", "",
       f"Z --image x.ppm --fragments f.txt --z-buffer /dev/fd/{i}",
       f"zbuf: cannot open /dev/fd/{i}: Bad file descriptor\n") for i in range(3, 12)),
    ("a device takes any number", "ln -s /dev/null x.bmp",
     "Z --z-buffer /dev/null {--fragments /dev/null|--image x.bmp|--fragments /dev/null > /dev/null}", ""),
    ("a terminal takes any number", "", 'Z --z-buffer - --fragments /dev/stdout > "$TERMINAL"', ""),
    ("files of one name in two folders are two", "mkdir folder; {|touch x.bmp folder/x.bmp}",
     "Z --image x.bmp --z-buffer folder/x.bmp", ""),
    ("a file named dash is not standard output", "", "Z --fragments - && [ -f - ]", ""),
    *((f"standard error takes one output, also as {name}", "",
       f"Z {{--stats /dev/stderr|--probe 4,4}} --fragments {name}",
       same(f"--fragments '{name}'", "standard error"))
      for name in ("/dev/stderr", "/dev/fd/2", "/proc/self/fd/2")),
    ("counts and probes may both be on standard error", "", "Z --stats /dev/stderr --probe 4,4 2> /dev/null",
     ""),
    ("standard error may be the terminal", "", 'Z --stats /dev/stderr --fragments /dev/stderr 2> "$TERMINAL"',
     ""),
    ("standard error may be where standard output goes", "",
     'Z --stats /dev/stderr > both 2>&1 && [ "$(wc -l < both)" -gt 8 ]', ""),
    ("fewer triangles are seen than there are", "", "! cmp -s ndc.txt seen.txt", ""),
    ("nothing is read before", "mkfifo waits", "exec zbuf none.txt --z-buffer out.bmp <> waits",
     same("--image 'out.bmp'", "--z-buffer 'out.bmp'")),]

PICTURES = ("--image", "--z-buffer", "--depth-image", "--stats")
ON_SCREEN = {"CONFIG": "config", "INPUT": "ndc"}
RUNS = (  # tool, its inputs, the words after them, the options that name an output
    ("model", {"INPUT": "scene"}, "", ["--stats"]),
    ("view", {"--scene": "scene", "INPUT": "world"}, "", ["--stats"]),
    ("project", {"--scene": "scene", "INPUT": "view"}, "", ["--stats"]),
    ("zbuf", ON_SCREEN, "", [*PICTURES, "--fragments", "--seen"]),
    ("zbuf", ON_SCREEN, "--coverage center", ["--certify"]),
    ("trace", {"--scene": "scene", "CONFIG": "config", "INPUT": "view"}, "", [*PICTURES]),
    ("cut-scene", {"SCENE": "scene"}, "2", []),
    ("join-seen", {"PART": "world"}, "", []),
    ("mesh2scene", {"INPUT": "tent"}, "", []),
)
WAYS = {"by its name": "", "by a symbolic link": "ln -s", "by a hard link": "ln"}


def output_into_input(run_of, option, taken, is_stdin, way):
    """The case of a run whose output `option` (None: standard output) is the file of its input `taken`."""
    tool, inputs, more, _ = run_of
    suffix = ".obj" if tool == "mesh2scene" else SUFFIXES.get(option, ".txt")
    words = [
        f"{name if name.startswith('--') else ''} {'-' if is_stdin and name == taken else text + suffix}"
        for name, text in inputs.items()]
    file = inputs[taken] + suffix
    output = "link" + suffix if WAYS[way] else file
    to_output = f"{option} {output}" if option else f"1<> {output}"
    first = "standard input" if is_stdin else f"{taken} '{file}'"
    second = f"{option} '{output}'" if option else "standard output"
    is_seen = (option, taken) == ("--seen", "INPUT")  # which may replace it
    return (f"{tool} {more} writes no {option} into its {taken}{' on standard input' * is_stdin}, {way}",
            WAYS[way] and f"{WAYS[way]} {file} {output}",
            f"{tool} {' '.join(words)} {more} {to_output} < {file}" + f" && cmp {output} seen.txt" * is_seen,
            "" if is_seen else same(first, second, tool))


CASES += [
    output_into_input(one, *way) for one in RUNS if (BIN / one[0]).exists()
    for way in itertools.product((*one[3], None), one[1], (False, True), WAYS)]


class Outputs(ToolTest):
    def check(self, preparation, line, stderr):
        for before, words in itertools.product(alternatives(preparation), alternatives(line)):
            with self.subTest(before, words=words):
                self.check_one(before, words, stderr)

    def check_one(self, preparation, line, stderr):
        """A refused run changes no file, and writes at most an error line for the next stage."""
        os.mkdir("new")
        os.chdir("new")
        line = line.replace("Z ", "zbuf config.txt ndc.txt ", 1)
        for file in re.findall(r"\b\w+\.\w+", line):
            if text := TEXTS.get(file.split(".")[0]):
                pathlib.Path(file).write_bytes(text)
        settings = {"PATH": f"{BIN}:{os.environ['PATH']}"}
        if "TERMINAL" in line:
            settings["TERMINAL"] = os.ttyname(Terminal(self).channel)
        if preparation:
            subprocess.run(preparation, shell=True, check=True)
        before = self.contents()
        done = subprocess.run(line, shell=True, env=settings, capture_output=True, timeout=60)
        status = 0 if not stderr else 1 if "cannot" in stderr else 2
        stderr = re.sub("'(/[^']{39})[^']+'", r"'\1...'", stderr.replace("$PWD", os.getcwd()))
        self.assertEqual((done.stderr.decode(), done.returncode), (stderr, status))
        if status:
            self.assertIn(done.stdout, (b"", b"error " + done.stderr))
            self.assertEqual(self.contents(), before)

    def contents(self):
        return {name: os.path.isfile(name) and pathlib.Path(name).read_bytes() for name in self.files()}


add_claims(Outputs, CASES)

if __name__ == "__main__":
    unittest.main()
