#!/usr/bin/env python3
"""zbuf --probe and --fragments, end to end: their reports match zbuf's picture.

usage: fragments_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import collections
import pathlib
import random
import re
import unittest

from toolbox import NO_TRIANGLE, SOURCE, ToolTest, pipe, run

LINE = re.compile(r"(\d+),(\d+): triangle (\d+), depth (\S+): (kept|lost, .*)")
# Without colors of their own.
SAMPLES = sorted(path for path in SOURCE.glob("samples/*/stage3.txt") if "attributes" not in path.read_text())
# In a 4 x 4 picture, pixel (1, 2) has its center at (-0.25, -0.25).
LIMITS = "4 4\n-1\n-1\n0 1\n"


def wall(z):
    return f"-9 -9 {z}\n9 -9 {z}\n0 9 {z}\n\n"


def colors_by_number(count):
    """The course's generator: triangle N has draws 3N to 3N + 2."""
    state, drawn = 1, []
    for _ in range(3 * count):
        state = (214013 * state + 2531011) % 2**32
        drawn.append((state >> 16 & 0x7fff) % 256)
    return list(zip(drawn[0::3], drawn[1::3], drawn[2::3]))


def random_triangles(count, seed):
    """Triangles at few depths, some beyond the limits, so that every fate occurs."""
    numbers = random.Random(seed)

    def vertex(z):
        return f"{numbers.uniform(-1.5, 1.5):.7f} {numbers.uniform(-1.5, 1.5):.7f} {z:.7f}\n"

    text = ""
    for _ in range(count):
        depths = [numbers.choice([-0.1, 0, 0.25, 0.5, 0.75, 1, 1.1])] * 3 if numbers.random() < 0.5 else [
            numbers.uniform(-0.2, 1.2) for _ in range(3)]
        text += "".join(vertex(z) for z in depths) + "\n"
    return text


class Fragments(ToolTest):
    def zbuf(self, *options, stdin, config=LIMITS):
        pathlib.Path("config.txt").write_text(config)
        done = run("zbuf", "config.txt", "--image", "out.ppm", *options, stdin=stdin)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def probe(self, stdin, place="1,2"):
        return self.zbuf("--probe", place, stdin=stdin).stderr.decode().splitlines()

    def test_every_fate_is_told_with_its_reason(self):
        self.assertEqual(self.probe("".join(map(wall, (0.5, 0.25, 0.75, 0.25, -0.5, 1)))), [
            "zbuf: 1,2: triangle 0, depth 0.5: kept", "zbuf: 1,2: triangle 1, depth 0.25: kept",
            "zbuf: 1,2: triangle 2, depth 0.75: lost, behind triangle 1",
            "zbuf: 1,2: triangle 3, depth 0.25: lost, equal and later than triangle 1",
            "zbuf: 1,2: triangle 4, depth -0.5: lost, before the front limit",
            "zbuf: 1,2: triangle 5, depth 1: lost, beyond the rear limit"])

    def test_a_pixel_without_triangles_says_so(self):
        self.assertEqual(self.probe(""), ["zbuf: 1,2: no fragment", NO_TRIANGLE.rstrip()])

    def test_triangles_are_named_as_in_the_scene(self):
        self.assertEqual(self.probe("triangle 41\n" + wall(0.5)), ["zbuf: 1,2: triangle 41, depth 0.5: kept"])

    def test_several_probes_tell_one_after_the_other(self):
        done = self.zbuf("--probe", "3,3", "--probe", "0,0", stdin=wall(0.5) + wall(0.25))
        self.assertEqual([line.split()[1] for line in done.stderr.decode().splitlines()],
                         ["3,3:", "3,3:", "0,0:", "0,0:"])

    def test_the_input_may_follow_a_probe(self):
        pathlib.Path("stage3.txt").write_text(wall(0.5))
        self.assertEqual(
            self.zbuf("--probe", "1,2", "stage3.txt", stdin="").stderr,
            b"zbuf: 1,2: triangle 0, depth 0.5: kept\n")

    def test_a_probe_off_the_screen_is_misuse(self):
        for word in ("8,0", "0,8", "1", "1,", "-1,2", "1,2,3", "a,b"):
            done = run("zbuf", "config.txt", f"--probe={word}", stdin="")
            self.assert_fails(
                done, 2,
                f"zbuf: --probe: expected COLUMN,ROW, from 0,0 to 7,7, found '{word}' (try zbuf --help)")
        self.assertFalse(pathlib.Path("out.bmp").exists())

    def assert_tells_what_is_drawn(self, config, stage3, *options):
        """The last fragment kept at each pixel gives its depth, and its color if the text has none; a pixel
        without one shows the background."""
        is_plain = not stage3.lstrip()[:1].isalpha()
        done = self.zbuf("--fragments", "fragments.txt", *options, stdin=stage3, config=config)
        columns, rows = map(int, config.split()[:2])
        kept = {}
        for line in pathlib.Path("fragments.txt").read_text().splitlines():
            column, row, triangle, depth, fate = LINE.fullmatch(line).groups()
            if fate == "kept":
                kept[int(column), int(row)] = int(triangle), float(depth)
        colors = colors_by_number(1 + max((triangle for triangle, _ in kept.values()), default=0))
        pixels = pathlib.Path("out.ppm").read_bytes()[-3 * columns * rows:]
        for row, line in enumerate(done.stdout.decode().splitlines()):
            shown = [
                f"{kept[column, row][1] + 0.0:.6f}" for column in range(columns) if (column, row) in kept]
            self.assertEqual(["0.000000" if word == "-0.000000" else word for word in shown], line.split(),
                             row)
            for column in range(columns if is_plain else 0):
                at = 3 * (row * columns + column)
                color = colors[kept[column, row][0]] if (column, row) in kept else (0, 0, 0)
                self.assertEqual(tuple(pixels[at:at + 3]), color, (column, row))

    def test_samples_are_explained(self):
        self.assertTrue(SAMPLES)
        for stage3 in SAMPLES:
            with self.subTest(stage3=str(stage3)):
                self.assert_tells_what_is_drawn((stage3.parent / "config.txt").read_text(),
                                                stage3.read_bytes())

    def test_every_rule_and_format_is_explained(self):
        stage3 = random_triangles(300, 8)
        for coverage in ("nearest", "center"):
            for depth in ("f64", "f32", "u24"):
                with self.subTest(coverage=coverage, depth=depth):
                    self.assert_tells_what_is_drawn("40 30\n-1\n-1\n0 1\n", stage3, "--coverage", coverage,
                                                    "--depth", depth)

    def test_a_depth_epsilon_is_explained(self):
        self.assert_tells_what_is_drawn("40 30\n-1\n-1\n0 1\n", random_triangles(300, 8), "--depth-epsilon",
                                        "0.1")
        done = self.zbuf("--probe", "1,2", "--depth-epsilon", "0.1", stdin=wall(0.5) + wall(0.45))
        self.assertIn(b"zbuf: 1,2: triangle 1, depth 0.45: lost, nearer by too little than triangle 0\n",
                      done.stderr)

    def test_probes_tell_what_the_file_tells(self):
        stage3 = random_triangles(300, 9)
        places = [f"{column},{row}" for column, row in ((0, 0), (7, 3), (20, 15), (39, 29))]
        words = [word for place in places for word in ("--probe", place)]
        done = self.zbuf("--fragments", "fragments.txt", *words, stdin=stage3, config="40 30\n")
        lines = pathlib.Path("fragments.txt").read_text().splitlines()
        of_the_places = [
            "zbuf: " + line for place in places for line in lines if line.startswith(place + ":")]
        self.assertEqual(done.stderr.decode().splitlines(), of_the_places)

    def test_every_fate_turns_up_in_what_was_compared(self):
        self.zbuf("--fragments", "fragments.txt", stdin=random_triangles(300, 8),
                  config="40 30\n-1\n-1\n0 1\n")
        fates = collections.Counter(
            re.sub(r" (than )?triangle \d+", "",
                   line.split(": ")[2]) for line in pathlib.Path("fragments.txt").read_text().splitlines())
        self.assertEqual(
            set(fates), {
                "kept", "lost, behind", "lost, equal and later", "lost, before the front limit",
                "lost, beyond the rear limit"})

    def test_threads_and_algorithms_change_nothing(self):
        stage3 = random_triangles(5000, 10)
        told = set()
        for options in ([], ["--threads", "2"], ["--threads", "7"], ["--algorithm", "scanline"]):
            done = self.zbuf("--probe", "20,15", "--fragments", "fragments.txt", *options, stdin=stage3,
                             config="40 30\n")
            told.add((done.stderr, done.stdout, pathlib.Path("fragments.txt").read_bytes()))
        self.assertEqual(len(told), 1)

    def test_the_picture_does_not_change(self):
        stage3 = random_triangles(300, 11)
        plain = self.zbuf(stdin=stage3).stdout, pathlib.Path("out.ppm").read_bytes()
        asked = self.zbuf("--fragments", "/dev/null", "--probe", "0,0",
                          stdin=stage3).stdout, pathlib.Path("out.ppm").read_bytes()
        self.assertEqual(plain, asked)

    def test_what_is_lit_is_explained_as_well(self):
        scene = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\nlight 0 0 5 1 1 1\n"
                 "triangle\n-9 -9 0\n9 -9 0\n0 9 0\ntriangle\n-9 -9 1\n9 -9 1\n0 9 1\nend\n")
        stage3 = pipe(["model"], ["view"], ["project"], stdin=scene)
        told = self.zbuf("--probe", "1,2", stdin=stage3, config="4 4\n").stderr.decode().splitlines()
        self.assertEqual([line.rsplit(": ", 1)[1] for line in told], ["kept", "kept"])


if __name__ == "__main__":
    unittest.main()
