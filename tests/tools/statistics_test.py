#!/usr/bin/env python3
"""--stats of the four tools, against counts made here from the stage texts in exact fractions.

usage: statistics_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import random
import unittest
from fractions import Fraction

import reference
from sample_files import sample_file
from toolbox import BIN, SOURCE, ToolTest, run

SIDES = ("left", "right", "below", "above", "near", "far")
PROJECT_KEYS = ["triangles", "behind", *("outside_" + side for side in SIDES), "cut", "culled"]
ZBUF_KEYS = [
    "triangles", *("outside_" + side for side in SIDES), "without_area", "between_centers", "hidden", "seen",
    "pixels_written", "fragments_tested"]
EXTENTS = [f"{axis}_{end}" for axis in "xyz" for end in ("min", "max")]


def statistics(text):
    """The keys with their values, as words."""
    return dict(line.split(" ") for line in text.splitlines())


def triangles_of(text, reader):
    return list(reference.Stage(text.encode(), reader).triangles())


def extents(text, reader):
    """Smallest and largest coordinates, as they are written."""
    columns = list(
        zip(*(corner.written for triangle in triangles_of(text, reader) for corner in triangle.corners)))
    return {
        f"{axis}_{end}": choose(column, key=Fraction)
        for axis, column in zip("xyz", columns) for end, choose in (("min", min), ("max", max))}


def random_scene(rng, projection):
    """Triangles before, behind and around the camera, and some without area."""
    def point(reach):
        return " ".join("%.3f" % rng.uniform(-reach, reach) for _ in range(3)) + "\n"

    body = ""
    for _ in range(40):
        reach = rng.choice((1, 4, 15))
        body += "push\ntranslate\n" + point(reach) + "triangle\n" + "".join(
            point(rng.choice((0.1, 1, 9))) for _ in range(3)) + "pop\n"
    return f"0 0 3\n0 0 0\n0 1 0\n{projection}\n" + body + "end\n"


class Projected:
    """The right counts of project, from the text it reads: the planes of a frustum in view space, by
    Sutherland and Hodgman."""
    def __init__(self, window, near, far, is_parallel):
        left, right, bottom, top = window

        def side(axis, limit, sign):
            # Inside where sign * (limit * scale - p[axis]) >= 0; the scale grows with the distance, unless
            # rays are parallel.
            return lambda p: sign * (limit * (1 if is_parallel else -p[2] / near) - p[axis])

        self.is_parallel = is_parallel
        self.planes = {
            "near": lambda p: -p[2] - near, "far": lambda p: far + p[2], "left": side(0, left, -1),
            "right": side(0, right, 1), "below": side(1, bottom, -1), "above": side(1, top, 1)}

    def clipped(self, polygon, plane):
        inside, strictly = [], 0
        for p, q in zip(polygon, polygon[1:] + polygon[:1]):
            a, b = plane(p), plane(q)
            strictly += a > 0
            if a >= 0:
                inside.append(p)
            if a * b < 0:
                inside.append(tuple(x + (y - x) * a / (a - b) for x, y in zip(p, q)))
        return inside if strictly or len(inside) >= len(polygon) else []

    def place(self, triangle):
        """The key under which a triangle counts; None if a part of it is in view."""
        if not self.is_parallel and all(p[2] >= 0 for p in triangle):
            return "behind"
        for name, plane in self.planes.items():
            if all(plane(p) < 0 for p in triangle):
                return "outside_" + name
        polygon = list(triangle)
        for name, plane in self.planes.items():
            polygon = self.clipped(polygon, plane)
            if not polygon:
                return "outside_" + name
        return None


class Files(ToolTest):
    def test_every_tool_writes_its_keys_in_order(self):
        data = pathlib.Path("scene.txt").read_bytes()
        for tool, keys in (("model", ["triangles"]), ("view", [
                "triangles"]), ("project", PROJECT_KEYS), ("zbuf", ZBUF_KEYS)):
            config = ["config.txt"] if tool == "zbuf" else []
            plain = run(tool, *config, stdin=data)
            for path in ("stats.txt", "/dev/stderr"):
                done = run(tool, *config, "--stats", path, stdin=data)
                self.assertEqual((done.returncode, done.stdout), (0, plain.stdout))
                told = done.stderr.decode() if path == "/dev/stderr" else pathlib.Path(path).read_text()
                self.assertEqual(list(statistics(told)), keys + EXTENTS, tool)
            data = plain.stdout

    def test_without_triangles_there_is_no_extent(self):
        done = run("zbuf", "config.txt", "--stats", "stats.txt", stdin="")
        self.assertEqual(done.returncode, 0)
        self.assertEqual(statistics(pathlib.Path("stats.txt").read_text()), {key: "0" for key in ZBUF_KEYS})


class Extents(ToolTest):
    def test_they_are_numbers_of_the_text(self):
        rng = random.Random(1)
        for digits in ("7", "0", "12", "exact"):
            data = random_scene(rng, "60 1 1 20").encode()
            for tool, reader in (("model", "view"), ("view", "project"), ("project", "zbuf")):
                data = run(tool, "--digits", digits, "--stats", "stats.txt", stdin=data).stdout
                told = statistics(pathlib.Path("stats.txt").read_text())
                found = {key: told[key] for key in EXTENTS}
                self.assertEqual(found, extents(data.decode(), reader), (tool, digits))
            run("zbuf", "config.txt", "--stats", "stats.txt", stdin=data)
            told = statistics(pathlib.Path("stats.txt").read_text())
            self.assertEqual({key: float(told[key])
                              for key in EXTENTS},
                             {key: float(word)
                              for key, word in extents(data.decode(), "zbuf").items()}, digits)


class Places(ToolTest):
    def check(self, scene, volume, *options):
        stage2 = run("view", "--digits", "exact", stdin=run("model", stdin=scene).stdout).stdout.decode()
        done = run("project", *options, "--stats", "stats.txt", stdin=stage2)
        self.assertEqual(done.returncode, 0, done.stderr)
        told = statistics(pathlib.Path("stats.txt").read_text())
        places = [
            volume.place([corner.position for corner in triangle.corners])
            for triangle in triangles_of(stage2, "project")]
        expected = {key: str(places.count(key)) for key in PROJECT_KEYS[1:-2]}
        self.assertEqual({key: told[key] for key in expected}, expected)
        self.assertEqual((told["triangles"], told["culled"]), ("40", "0"))
        numbers = [triangle.number for triangle in triangles_of(done.stdout.decode(), "zbuf")]
        return places, numbers, told

    def test_a_frustum(self):
        rng, found = random.Random(2), set()
        for _ in range(5):
            places, numbers, told = self.check(
                random_scene(rng, "frustum -1 1.5 -1 0.75 1 8"),
                Projected((-1, Fraction(3, 2), -1, Fraction(3, 4)), 1, 8, False), "--clip", "frustum")
            found |= set(places)
            # Those in view are those that are left, and those of several pieces or with a corner outside are
            # cut.
            self.assertEqual(sorted(set(numbers)), [i for i, place in enumerate(places) if place is None])
            self.assertGreaterEqual(int(told["cut"]), sum(numbers.count(i) > 1 for i in set(numbers)))
        self.assertEqual(found, {None, *PROJECT_KEYS[1:-2]})

    def test_a_parallel_projection(self):
        rng, found = random.Random(3), set()
        for _ in range(5):
            found |= set(
                self.check(random_scene(rng, "ortho -2 2 -1 3 -1 6"), Projected((-2, 2, -1, 3), -1, 6,
                                                                                True))[0])
        self.assertEqual(found, {None, *PROJECT_KEYS[2:-2]})

    def test_clipping_changes_no_place(self):
        rng = random.Random(4)
        scene, volume = random_scene(rng, "frustum -1 1 -1 1 1 8"), Projected((-1, 1, -1, 1), 1, 8, False)
        for clip in ("auto", "near", "frustum"):  # reject takes no triangle that reaches behind the eye
            self.check(scene, volume, "--clip", clip)

    def test_what_is_culled_counts_as_that_alone(self):
        stage2 = run("view", stdin=run("model", stdin=random_scene(random.Random(6),
                                                                   "frustum -1 1 -1 1 1 8")).stdout).stdout
        counts = {}
        for cull in ("back", "front"):
            run("project", "--cull", cull, "--stats", "stats.txt", stdin=stage2)
            counts[cull] = statistics(pathlib.Path("stats.txt").read_text())
        run("project", "--stats", "stats.txt", stdin=stage2)
        whole = statistics(pathlib.Path("stats.txt").read_text())
        self.assertEqual(int(counts["back"]["culled"]) + int(counts["front"]["culled"]), 40)
        for key in PROJECT_KEYS[1:-2]:  # each triangle is culled in one of the two runs
            self.assertEqual(int(counts["back"][key]) + int(counts["front"][key]), int(whole[key]), key)


def drawn(text, config, pixels_of):
    """The right counts of zbuf, by drawing everything pixel by pixel."""
    front, rear = Fraction(config.front), Fraction(config.rear)
    depths, owners, counts, visible = {}, {}, dict.fromkeys(ZBUF_KEYS, 0), set()
    for number, triangle in enumerate(triangles_of(text, "zbuf")):
        counts["triangles"] += 1
        fragments = list(pixels_of(triangle, config))
        counts["fragments_tested"] += len(fragments)
        for row, column, z in fragments:
            if front <= z < rear:
                visible.add(number)
                if z < depths.get((row, column), rear):
                    depths[row, column], owners[row, column] = z, number
        if number not in visible:
            counts[reason(triangle, fragments, config)] += 1
    counts["pixels_written"], counts["seen"] = len(owners), len(set(owners.values()))
    counts["hidden"] = len(visible) - counts["seen"]
    return counts


def reason(triangle, fragments, config):
    corners = [corner.position for corner in triangle.corners]
    x, y, z = zip(*corners)
    left, bottom = Fraction(config.left), Fraction(config.bottom)
    (ax, ay, _), (bx, by, _), (cx, cy, _) = corners
    for key, holds in (("outside_near", max(z) < Fraction(config.front)),
                       ("outside_far", min(z) >= Fraction(config.rear)), ("outside_left", max(x) < left),
                       ("outside_right", min(x) > -left), ("outside_below", max(y) < bottom),
                       ("outside_above", min(y) > -bottom), ("without_area",
                                                             (bx - ax) * (cy - ay) == (cx - ax) * (by - ay)),
                       ("outside_near", any(depth < config.front
                                            for _, _, depth in fragments)), ("outside_far", bool(fragments))):
        if holds:
            return key
    for i in range(3):  # past a corner of the window: all of it is beyond an edge
        (ax, ay, _), (bx, by, _), (cx, cy, _) = corners[i:] + corners[:i]
        x, y = ay - by, bx - ax
        if x * (cx - ax) + y * (cy - ay) < 0:
            x, y = -x, -y
        if max(x * u + y * v for u in (left, -left) for v in (bottom, -bottom)) < x * ax + y * ay:
            side = ("right" if x > 0 else "left") if abs(x) > abs(y) else "above" if y > 0 else "below"
            return f"outside_{side}"
    return "between_centers"


class Pixels(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("9 7\n-0.75\n-1.25\n-0.5 0.5\n")
        self.config = reference.read_config(reference.Text(pathlib.Path("config.txt").read_bytes()))

    def text(self, rng, count):
        """Small triangles among large ones, at few depths, some off the window or without area."""
        lines = []
        for _ in range(count):
            size, x, y = rng.choice((0.02, 0.3, 3)), rng.uniform(-1.2, 1.2), rng.uniform(-1.6, 1.6)
            points = [[
                x + rng.uniform(-size, size), y + rng.uniform(-size, size),
                rng.choice((-0.6, -0.25, 0, 0.25, 0.6))] for _ in range(3)]
            if rng.random() < 0.5:
                points[1][2] = points[2][2] = points[0][2]
            if rng.random() < 0.1:
                points[2] = points[1]
            lines += [" ".join("%.7f" % c for c in p) for p in points] + [""]
        return "\n".join(lines)

    def told(self, text, *options, kernel="avx2"):
        done = run("zbuf", "config.txt", "--image", "out.ppm", "--stats", "stats.txt", *options, stdin=text,
                   env=os.environ | {"PIPELINE_KERNEL": kernel})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, statistics(pathlib.Path("stats.txt").read_text())

    def test_counts_by_both_rules(self):
        rng, found = random.Random(7), set()
        for rule, pixels_of in (("nearest", reference.nearest), ("center", reference.center)):
            for count in (1, 3, 30, 60):
                text = self.text(rng, count)
                depths, told = self.told(text, "--coverage", rule)
                expected = drawn(text, self.config, pixels_of)
                self.assertEqual({key: int(told[key]) for key in ZBUF_KEYS}, expected, (rule, text))
                self.assertEqual(len(depths.split()), expected["pixels_written"])
                found |= {key for key in ZBUF_KEYS if expected[key] > 0}
        self.assertEqual(found, set(ZBUF_KEYS))

    def test_they_depend_on_no_algorithm_thread_or_kernel(self):
        text = self.text(random.Random(8), 3000)
        for rule in ("nearest", "center"):
            _, expected = self.told(text, "--coverage", rule)
            for options in (["--algorithm", "scanline"], ["--threads", "4"], ["--samples", "2"], [
                    "--wireframe"]):
                self.assertEqual(self.told(text, "--coverage", rule, *options)[1], expected, (rule, options))
            self.assertEqual(self.told(text, "--coverage", rule, kernel="scalar")[1], expected, rule)

    def test_they_change_nothing_else(self):
        for sample in sorted(path.parent for path in SOURCE.glob("samples/*/scene.txt")):
            ndc = sample_file(BIN, sample, "stage3.txt")
            plain = run("zbuf", sample / "config.txt", "--image", "plain.ppm", stdin=ndc)
            done = run("zbuf", sample / "config.txt", "--image", "counted.ppm", "--stats", "stats.txt",
                       stdin=ndc)
            self.assertEqual((done.stdout, done.stderr), (plain.stdout, plain.stderr))
            self.assertEqual(pathlib.Path("counted.ppm").read_bytes(), pathlib.Path("plain.ppm").read_bytes())
            told = statistics(pathlib.Path("stats.txt").read_text())
            self.assertEqual(int(told["pixels_written"]), len(done.stdout.split()), sample.name)
            self.assertEqual(int(told["triangles"]), sum(int(told[key]) for key in ZBUF_KEYS[1:-2]),
                             sample.name)

    def test_fragments_are_those_of_the_report(self):
        text = self.text(random.Random(9), 50)
        _, told = self.told(text, "--fragments", "fragments.txt")
        self.assertEqual(int(told["fragments_tested"]),
                         len(pathlib.Path("fragments.txt").read_text().splitlines()))


if __name__ == "__main__":
    unittest.main()
