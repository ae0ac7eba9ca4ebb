#!/usr/bin/env python3
"""The four tools and the reference agree on random scenes: stage by stage, on the text that the tool before
has written.

Every other scene is damaged at one stage by a random change; then both refuse it at the same line, or both
accept it.

usage: agreement_test.py BIN_DIR [SCENES] [FIRST]
"""
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

import leeway
import random_scenes
import reference

FIRST = int(sys.argv.pop()) if len(sys.argv) > 3 else 0
SCENES = int(sys.argv.pop()) if len(sys.argv) > 2 else 40
BIN = pathlib.Path(sys.argv.pop()).resolve()
STAGES = ("model", "view", "project", "zbuf")
WORDS = (b"0", b"-1", b"nan", b"1e309", b"1e300", b"x", b"0x1", b"1,5", b"256", b"1e-400", b"+", b".",
         b"1.5.2", b"#", b"ratio")
LINES = (b"pop", b"push", b"end", b"triangle", b"", b"# c", b"framed", b"1 2 3", b"triangle 7",
         b"light 1 1 1 1 1 1", b"color 1 2 3", b"attributes normal", b"background 1 2 3", b"error model: x",
         b"Triangle", b"clipped", b"material 1 1 1 1", b"attenuation 0 0 0", b"use 1", b"use 0",
         b"attributes material")


def damaged(rng, text):
    """The text with one random change."""
    lines = text.split(b"\n")
    at, other = rng.randrange(len(lines)), rng.randrange(len(lines))
    words = lines[at].split(b" ")
    change = rng.choice(("delete", "double", "swap", "word", "word", "cut", "insert", "shorten", "lengthen"))
    if change == "delete":
        del lines[at]
    elif change == "double":
        lines.insert(at, lines[at])
    elif change == "swap":
        lines[at], lines[other] = lines[other], lines[at]
    elif change == "word":
        words[rng.randrange(len(words))] = rng.choice(WORDS)
        lines[at] = b" ".join(words)
    elif change == "cut":
        lines[at:] = [b""]
    elif change == "insert":
        lines.insert(at, rng.choice(LINES))
    else:
        lines[at] = b" ".join(words[:-1] if change == "shorten" else [*words, b"1"])
    return b"\n".join(lines)


def refused_line(done):
    """The line at which a tool refused its standard input, None if it did not; the message if that names no
    line."""
    found = re.match(rb"\w+: <stdin>:(\d+)", done.stderr)
    return None if done.returncode == 0 else int(found[1]) if found else done.stderr


class Agreement(unittest.TestCase):
    def test_random_scenes(self):
        self.assertGreater(SCENES, 0)
        for index in range(FIRST, FIRST + SCENES):
            rng = random.Random(index)
            scene, options = random_scenes.scene(rng), random_scenes.options(rng)
            text, config = scene.encode(), random_scenes.config(rng, scene)
            hit = rng.choice(STAGES) if index % 2 else None
            with self.subTest(scene=index, options=options,
                              damaged=hit), tempfile.TemporaryDirectory() as folder:
                self.config, self.image = pathlib.Path(folder, "config.txt"), pathlib.Path(folder, "out.bmp")
                self.config.write_text(config)
                for stage in STAGES:
                    text = damaged(rng, text) if stage == hit else text
                    words = options[stage]
                    if stage == "zbuf":
                        is_lit = b"\nlight " in text or text.startswith(b"light ")
                        words = [
                            str(self.config), "--image",
                            str(self.image), *words, *(random_scenes.shading(rng) if is_lit else [])]
                    if (text := self.compare(stage, words, text)) is None:
                        break

    def compare(self, stage, words, text):
        """The output of a stage that tool and reference carry out; None after the last, or if both refuse the
        text."""
        done = subprocess.run([BIN / stage, *words], input=text, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=600)
        options = reference.read_options(stage, [*words])
        try:
            if stage == "zbuf":
                self.compare_picture(options, text, done)
                return None
            want = getattr(reference, stage)(text, options)
        except reference.Refused as refusal:
            # The line is not defined of a text in another format (T16), nor told where an earlier stage
            # failed (T12).
            is_told = b"looks like" not in done.stderr and not text.split(b"\n")[refusal.args[0] -
                                                                                 1:][:1] == [
                                                                                     b"error model: x"]
            self.assertEqual(done.returncode, 1, (stage, refusal, done.stderr, text))
            self.assertTrue(
                refused_line(done) == refusal.args[0] or not is_told, (stage, refusal, done.stderr, text))
            return None
        self.assertIsNone(refused_line(done), (stage, done.stderr, text))
        leeway.expect_same_text(self, done.stdout, want, lambda: getattr(reference, stage)
                                (text, {**options, "--digits": "17"}), text, b": note: <stdin>:"
                                in done.stderr)
        return done.stdout

    def compare_picture(self, options, text, done):
        stage, config = reference.Stage(text, "zbuf"), reference.read_config(
            reference.Text(self.config.read_bytes()))
        model_name = reference.shading_model(stage, options.get("--shading"))
        triangles = list(stage.triangles())
        self.assertIsNone(refused_line(done), (done.stderr, text))
        leeway.expect_same_picture(self, triangles, stage, config, options, model_name, done.stdout,
                                   self.image.read_bytes())


class CentersOnEdges(unittest.TestCase):
    """The corners are pixel centers of a screen of 4 x 4 pixels, so that centers lie on all edges (Z5)."""
    def check(self, text, picture):
        config = reference.read_config(reference.Text(b"4 4\n"))
        seen = reference.draw(reference.Stage(text, "zbuf").triangles(), config, "center")[1]
        self.assertEqual(["".join("#" if triangle else "." for triangle in row) for row in seen], picture)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "config.txt")
            path.write_text("4 4\n")
            done = subprocess.run(
                [BIN / "zbuf", path, "--coverage", "center", "--image",
                 path.with_name("out.bmp")], input=text, stdout=subprocess.PIPE)
            self.assertEqual([line.count(b"\t") for line in done.stdout.splitlines()],
                             [row.count("#") for row in picture])

    def test_top_and_left_edges_belong_to_the_triangle(self):
        self.check(b"-0.75 0.75 0\n0.75 0.75 0\n-0.75 -0.75 0\n", ["###.", "##..", "#...", "...."])

    def test_bottom_and_right_edges_do_not(self):
        self.check(b"0.75 0.75 0\n0.75 -0.75 0\n-0.75 -0.75 0\n", ["....", "..#.", ".##.", "...."])


class Wireframes(unittest.TestCase):
    """Edges (T24a to T24c) between corners on centers, on sides of pixels and of the view volume, anywhere,
    and far away; pieces and slivers among them."""
    def test_pictures_are_those_of_the_reference(self):
        for index in range(80):
            rng = random.Random(index)

            def number():
                return rng.choice(("%.7f" % rng.uniform(-1.5, 1.5), repr(rng.uniform(
                    -1.5, 1.5)), "%g" % (rng.randint(-9, 9) / 8), "1", "-1",
                                   repr(rng.uniform(-1, 1) * 10.0**rng.randint(-99, 99))))

            text = ""
            for number_of_piece in range(rng.randint(1, 6)):
                corners = [f"{number()} {number()} {rng.uniform(-1, 1):.4f}\n" for _ in range(3)]
                if text and rng.random() < 0.3:
                    text += f"triangle {last}\n"
                    corners[:2] = first, third
                else:
                    last = number_of_piece
                    text += f"triangle {last}\n"
                first, third = corners[0], corners[2]
                text += "".join(corners)
            config = rng.choice(("8 8\n", "17 5\n-1\n-1\n-0.83 0.87\n", "9 9\n-3\n-0.1234567891\n-1 1\n"))
            options = [
                "--wireframe", *rng.choice(([], ["all"])), "--samples",
                rng.choice("113"), "--coverage", ("nearest", "center")[index % 2]]
            with self.subTest(scene=index, options=options), tempfile.TemporaryDirectory() as folder:
                os.chdir(folder)
                pathlib.Path("config.txt").write_text(config)
                subprocess.run([BIN / "zbuf", "config.txt", *options, "--image", "found.bmp"],
                               input=text.encode(), check=True, capture_output=True)
                reference.zbuf(
                    text.encode(),
                    reference.read_options("zbuf", ["config.txt", *options, "--image", "expected.bmp"]))
                self.assertEqual(*(pathlib.Path(name).read_bytes() for name in ("found.bmp", "expected.bmp")),
                                 text)
                os.chdir("/")


class WideLimits(unittest.TestCase):
    """Limits between which depths have more digits than doubles (T23, F5)."""
    def test_depths_are_the_exact_ones_rounded(self):
        more = [], ["--samples", "2"], ["--algorithm", "scanline"], ["--seen", "seen.txt", "--z-buffer", "-"]
        for index in range(120):
            rng = random.Random(index)
            size, limit = 10.0**rng.choice((6, 9, 9, 12, 15)), rng.choice(("-1", "-1", "-0.7"))
            options = ["--coverage", ("nearest", "center")[index % 2], *rng.choice(more)]
            rows = slice(*rng.choice(((0, 8), (1, 7))))
            config = f"8 8\n{limit}\n-1\n{rng.choice((0, -size))} {size}\n"
            text = "".join(random_scenes.deep_triangle(rng, size) for _ in range(rng.randint(1, 6))).encode()
            with self.subTest(scene=index, options=options), tempfile.TemporaryDirectory() as folder:
                pathlib.Path(folder, "config.txt").write_text(config)
                done = subprocess.run(
                    [BIN / "zbuf", "config.txt", *options, "--rows", f"{rows.start}:{rows.stop}"], input=text,
                    cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
                screen = reference.read_config(reference.Text(config.encode()))
                depths, _ = reference.draw(reference.Stage(text, "zbuf").triangles(), screen, options[1])
                self.assertEqual(done.stdout, reference.depth_text(depths[rows], screen.rear), text)


if __name__ == "__main__":
    unittest.main()
