#!/usr/bin/env python3
"""zbuf --seen, end to end: the triangles that a pixel or sample shows, as text that gives the same picture.

usage: seen_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import random
import re
import unittest

from streaming_test import LiveTool
from toolbox import NO_TRIANGLE, SOURCE, ToolTest, pipe, run

SCENE_COUNT = int(os.environ.get("TOOLS_SCENES", 12))  # fewer with sanitizers, see CMakeLists.txt
SAMPLES = sorted(path.parent for path in SOURCE.glob("samples/*/scene.txt"))
SETTINGS = ("", "--coverage center", "--wireframe", "--shading flat", "--shading gouraud", "--samples 3",
            "--depth u24", "--depth f32 --wireframe")
STEP = 12 // SCENE_COUNT  # of these settings, every STEP-th
CLIPS = ("auto", "near", "frustum", "frustum --clip-inset 0.2")


def numbers_of(text):
    """The numbers of the triangles of a stage text without clipped ones, each once."""
    numbers, number = set(), 0
    for stated in re.findall(r"^(?:triangle (\d+)$|\n)", text.decode(), re.M):
        number = int(stated or number)
        if not stated:
            numbers.add(number)
            number += 1
    return numbers


class Seen(ToolTest):
    def zbuf(self, *options, stdin):
        done = run("zbuf", "config.txt", *options, stdin=stdin)
        self.assert_quiet_success(done)
        return done.stdout

    def picture(self, text, *options):
        """(depths, image); what is noted of mirrors and glass, or of an empty image, may be in other
        words."""
        done = run("zbuf", "config.txt", *options, "--image", "picture.ppm", stdin=text)
        self.assertRegex(done.stderr.decode(),
                         r"\A(zbuf: note: (mirrors|the picture is|all that is drawn|.* %) .*\n)*\Z")
        self.assertEqual(done.returncode, 0)
        return done.stdout, pathlib.Path("picture.ppm").read_bytes()

    def seen(self, text, *options):
        return self.zbuf(*options, "--seen", "-", stdin=text)

    def check(self, text, *options):
        seen = self.seen(text, *options)
        self.assertEqual(self.picture(seen, *options), self.picture(text, *options))
        self.assertEqual(self.seen(seen, *options), seen)


class Pictures(Seen):
    """The seen triangles give the whole picture; farm_test joins parts of a scene."""
    def test_samples_with_all_settings_are_the_same_from_what_is_seen(self):
        count = 0
        for k, sample in enumerate(SAMPLES):
            pathlib.Path("config.txt").write_bytes((sample / "config.txt").read_bytes())
            stage2 = pipe(["model", sample / "scene.txt"], ["view"], stdin="")
            is_lit = b"\nlight" in stage2
            for i, clip in enumerate(CLIPS):
                ndc = pipe(["project", "--clip", *clip.split()], stdin=stage2)
                for setting in SETTINGS[(i + k) % STEP::STEP]:
                    if "shading" in setting and not is_lit:
                        continue
                    with self.subTest(sample=sample.name, clip=clip, setting=setting):
                        self.check(ndc, *setting.split())
                        count += 1
        self.assertGreaterEqual(count, 296 // STEP)


class Owners(Seen):
    """Against the fragments that zbuf reports."""
    def fragments(self, text, *options):
        """(pixel, number) of every fragment that was kept, in order."""
        self.zbuf("--fragments", "fragments.txt", *options, stdin=text)
        kept = r"^(\S+): triangle (\d+), depth \S+: kept$"
        found = re.findall(kept, pathlib.Path("fragments.txt").read_text(), re.M)
        return [(pixel, int(number)) for pixel, number in found]

    def test_they_are_those_of_the_last_fragments_kept(self):
        """Under a depth epsilon, those of all fragments that are kept without it."""
        pathlib.Path("config.txt").write_text("25 20\n")
        for seed in range(SCENE_COUNT):
            rng = random.Random(seed)
            vertex = lambda: " ".join(f"{rng.uniform(-limit, limit):.7f}" for limit in (1.5, 1.5, 1.2)) + "\n"
            text = "".join(vertex() + vertex() + vertex() + "\n" for _ in range(300))
            for options in (["--coverage", "nearest"], ["--coverage", "center"], ["--depth", "u24"]):
                owners = dict(self.fragments(text, *options))
                seen = numbers_of(self.seen(text, *options, "--stats", "stats.txt"))
                self.assertEqual(seen, set(owners.values()))
                self.assertIn(f"seen {len(seen)}\npixels_written {len(owners)}\n",
                              pathlib.Path("stats.txt").read_text())
            kept = {number for _, number in self.fragments(text)}
            self.assertEqual(numbers_of(self.seen(text, "--depth-epsilon", "0.01")), kept)

    def test_a_sample_counts_like_a_pixel(self):
        pathlib.Path("config.txt").write_text("1 1\n")
        corner = "0.3 0.3 0\n0.9 0.3 0\n0.3 0.9 0\n\n"
        self.assertEqual(self.seen(corner, "--coverage", "center"), b"")
        self.assertEqual(self.seen(corner, "--coverage", "center", "--samples", "2"), corner.encode())

    def test_a_tall_triangle_among_small_ones_is_kept(self):
        """Batches of small triangles are drawn at once, but the spans of a tall one among them one by one."""
        pathlib.Path("config.txt").write_text("200 200\n")
        small = [f"{x / 10} 0 0\n{x / 10 + 0.05} 0 0\n{x / 10} 0.05 0\n\n" for x in range(-9, 9)]
        tall = "-0.95 -1 0.5\n-0.9 -1 0.5\n-0.95 1 0.5\n\n"
        text = "".join(small[:5]) + tall + "".join(small[5:])
        self.assertEqual(self.seen(text).decode(), text)

    def test_the_store_is_emptied_many_times(self):
        """More small triangles than are kept before the hidden ones are let go of; pieces among them."""
        pathlib.Path("config.txt").write_text("30 30\n")
        rng = random.Random(7)
        lines = []
        for i in range(60_000):
            x, y, z = (rng.uniform(-1, 1) for _ in range(3))
            a, b, c, d = (f"{x + dx:.7f} {y + dy:.7f} {z:.7f}\n"
                          for dx, dy in ((0, 0), (0.1, 0), (0.1, 0.1), (0, 0.1)))
            lines.append(f"{a}{b}{c}\n" + (f"triangle {i}\n{a}{c}{d}\n" if i % 3 == 0 else ""))
        text = "".join(lines).encode()
        seen = self.seen(text)
        self.assertEqual(seen, self.seen(text, "--algorithm", "scanline"))
        self.assertEqual(seen, self.seen(text, "--threads", "4"))
        edges = self.seen(text, "--wireframe")
        self.assertEqual(self.picture(edges, "--wireframe"), self.picture(text, "--wireframe"))
        self.assertEqual(self.picture(seen, "--samples", "1"), self.picture(text))
        # With the image at the same time, too.
        done = self.zbuf("--seen", "seen.txt", "--image", "both.ppm", "--z-buffer", "-", stdin=text)
        self.assertEqual(pathlib.Path("seen.txt").read_bytes(), seen)
        self.assertEqual((done, pathlib.Path("both.ppm").read_bytes()), self.picture(text))


class Text(Seen):
    CLIPPED = "clipped\n0 0 0 1\n1 0 0 1\n0 1 0 1\n\n"
    OTHER = CLIPPED.replace("1\n", "2\n")
    WALL, FAR = (f"-9 -9 {z}\n9 -9 {z}\n0 9 {z}\n\n" for z in (0.5, 0.9))
    LEFT, RIGHT = "-9 -9 0\n-0.1 -9 0\n-0.1 9 0\n\n", "0.1 -9 0\n9 -9 0\n0.1 9 0\n\n"
    LIT = "attributes w\nlight 0 0 9 1 1 1\nprojected frustum -1 1 -1 1 1 9\n"
    SEEN, UNSEEN = (f"{x} 0 0.5 1\n{x}.9 0 0.5 1\n{x} 9 0.5 1\n\n" for x in (0, 20))
    # A claim, a text and what is seen of it; None: all of it.
    CASES = (
        ("numbers stay as they came", "-9.0 -9 +0.50\n9e0 -9.00000000000000000001 0.5\n00 .9e1 5e-1\n\n",
         None),
        ("so do header lines and columns", "attributes w color\nbackground 1.50 2 3e0\n"
         "-9 -9 0.5 1.0 255 0.0 7\n9 -9 0.5 1 1 1 1\n0 9 0.5 2e0 3 3 3.25\n\n", None),
        ("comments and blanks around lines go",
         "# a wall\nbackground 1 2 3 # dark\n\n -9 -9\t0.5 \r\n# here\n9  -9 0.5\t# corner\n0 9 0.5\r\n",
         "background 1 2 3\n-9 -9\t0.5\n9  -9 0.5\n0 9 0.5\n\n"),
        ("a number stands where counting breaks", FAR + FAR + WALL, "triangle 2\n" + WALL),
        ("also after a gap", f"triangle 5\n{LEFT}{RIGHT}triangle 20000000000\n{FAR}",
         f"triangle 5\n{LEFT}{RIGHT}"),
        ("also where one between is hidden", f"triangle 20000000000\n{LEFT}{FAR}{RIGHT}",
         f"triangle 20000000000\n{LEFT}triangle 20000000002\n{RIGHT}"),
        ("and nowhere else", LEFT + RIGHT, None),
        ("pieces stay together with the uncut triangle",
         f"{LIT}triangle 3\n{CLIPPED}{UNSEEN}triangle 3\n{SEEN}{UNSEEN}triangle 9\n{CLIPPED}{UNSEEN}",
         f"{LIT}triangle 3\n{CLIPPED}{UNSEEN}triangle 3\n{SEEN}"),
        ("an uncut triangle without pieces goes", f"{CLIPPED}triangle 7\n{WALL}", "triangle 7\n" + WALL),
        ("one of two as well", CLIPPED + OTHER + WALL, OTHER + WALL),
        ("the last one, too", WALL + CLIPPED, WALL),
        ("a frame is passed on", f"framed\n{WALL}end\n", None),
        ("around nothing, too", "framed\nend\n", None),
        ("nothing is nothing", "", None),
    )

    def test_what_is_written(self):
        """At once, or letter by letter as the text arrives."""
        for claim, text, expected in self.CASES:
            with self.subTest(claim), LiveTool("zbuf", "config.txt", "--seen", "-") as live:
                for letter in text:
                    live.send(letter)
                self.assertEqual(live.finish(), 0)
                self.assertEqual(live.received, self.seen(text))
                self.assertEqual(live.received.decode(), text if expected is None else expected)

    def test_a_failure_ends_the_text_with_an_error_line(self):
        done = run("zbuf", "config.txt", "--seen", "-", stdin="1 2 three\n")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.decode(),
                         "error zbuf: <stdin>:1:5: expected the z of vertex 1 of 3, found 'three'\n")

    def test_an_image_is_drawn_only_if_asked_for(self):
        self.assertEqual(self.zbuf("--seen", "seen.txt", stdin=self.WALL), b"")
        self.assertEqual(self.files(), ["config.txt", "scene.txt", "seen.txt"])
        self.zbuf("-o", "a.ppm", stdin=self.WALL)
        self.assertEqual(self.zbuf("--seen", "seen.txt", "-o", "-", stdin=self.WALL),
                         pathlib.Path("a.ppm").read_bytes())
        self.assertEqual(pathlib.Path("seen.txt").read_text(), self.WALL)
        done = run("zbuf", "config.txt", "--seen", "-", "-o", "a.ppm")
        self.assertEqual((done.stdout, done.stderr.decode(), done.returncode), (b"", NO_TRIANGLE, 0))


if __name__ == "__main__":
    unittest.main()
