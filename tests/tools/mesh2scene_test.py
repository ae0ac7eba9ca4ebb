#!/usr/bin/env python3
"""usage: mesh2scene_test.py BIN [unittest's arguments]: mesh2scene on models of known triangles, in every
format of make-model, on models written here by hand, and on broken ones."""
import json
import math
import os
import pathlib
import random
import re
import resource
import socket
import struct
import unittest

from lib.maths.vectors import cross
from model_parts.formats import FORMATS
from model_parts.shapes import SHAPES, Mesh, knot, terrain, vase
from toolbox import ToolTest, command, expect_mesh2scene, pipe, run

BOX = "".join(f"v {x} {y} {z}\n" for z in (0, 1) for y in (0, 1) for x in (0, 1)) + "".join(
    f"f {face}\n" for face in ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"))
OTHER = ": expected an OBJ, STL, PLY or glTF file, found "


def setUpModule():  # noqa: N802
    expect_mesh2scene()


def scene_of(name, *options):
    done = run("mesh2scene", *options, name)
    if done.returncode != 0:
        raise AssertionError(done.stderr.decode())
    return done.stdout.decode()


def world_triangles(scene):
    """Rows of nine or more numbers for each triangle, a list of three vertices."""
    text = pipe(["model", "--digits", "exact"], stdin=scene).decode()
    rows = [line.split() for line in text.splitlines() if line and line[0] in "-0123456789."]
    vertices = [tuple(map(float, row)) for row in rows]
    return [vertices[i:i + 3] for i in range(0, len(vertices), 3)]


def header(scene):
    """The lines before the first triangle, by keyword; the camera's four by number."""
    lines = [line for line in scene.split("triangle\n", 1)[0].splitlines() if not line.startswith("#")]
    found = {"eye": lines[0], "look": lines[1], "up": lines[2], "projection": lines[3]}
    for line in lines[4:]:
        keyword, _, rest = line.partition(" ")
        found.setdefault(keyword, []).append(rest)
    return found


def float32(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def quoted(text):
    """As messages have it: at most 40 bytes."""
    return f"'{text}'" if len(text) <= 40 else f"'{text[:40]}...'"


def picture_of(scene, width, height):
    """Which pixels show a triangle, as rows."""
    pipe(["model"], ["view"], ["project"],
         ["zbuf", "--size", f"{width}x{height}", "--coverage", "center", "--image", "picture.ppm"],
         stdin=scene)
    data = pathlib.Path("picture.ppm").read_bytes()
    pixels = data[-3 * width * height:]
    background = tuple(int(float(word)) for word in header(scene)["background"][0].split())
    return [[
        tuple(pixels[3 * (row * width + k):3 * (row * width + k) + 3]) != background for k in range(width)]
            for row in range(height)]


class Formats(ToolTest):
    def test_every_format_gives_the_triangles_of_the_shape(self):
        for name, shape in SHAPES.items():
            mesh = shape(3)
            for suffix, write in FORMATS.items():
                with self.subTest(shape=name, format=suffix):
                    pathlib.Path(f"model.{suffix}").write_bytes(write(mesh))
                    found = world_triangles(scene_of(f"model.{suffix}"))
                    self.assertEqual(len(found), len(mesh.triangles))
                    for got, indices in zip(found, mesh.triangles):
                        for vertex, i in zip(got, indices):
                            for x, expected in zip(vertex[:3], mesh.vertices[i]):
                                self.assertLessEqual(abs(x - expected), 2.0**-24 * max(abs(expected), 0.25))
                            if mesh.colors and suffix != "stl":
                                for x, expected in zip(vertex[3:6], mesh.colors[i]):
                                    self.assertAlmostEqual(x, expected, 2)
                            if suffix != "stl":
                                self.assertGreater(sum(a * b for a, b in zip(vertex[-3:], mesh.normals[i])),
                                                   1 - 1e-6)

    def test_floats_keep_their_value(self):
        """A binary file's numbers come out as the shortest decimals of the same floats."""
        generator = random.Random(5)
        points = [
            tuple(float32(generator.uniform(-1, 1) * 10**generator.randint(-6, 6)) for _ in range(3))
            for _ in range(60)]
        pathlib.Path("model.stl").write_bytes(FORMATS["stl"](Mesh(
            points, [], [(i, i + 1, i + 2) for i in range(0, 60, 3)])))
        words = [
            line.split()[:3] for line in scene_of("model.stl").split("attributes", 1)[1].splitlines()
            if line[:1] in "-0123456789" and line]
        self.assertEqual([tuple(float32(float(word)) for word in row) for row in words], points)
        self.assertLessEqual(
            max(
                len(word.lstrip("-").replace(".", "").split("e")[0].strip("0")) for row in words
                for word in row), 9)

    def test_standard_input_is_read_too(self):
        done = run("mesh2scene", stdin=BOX)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(world_triangles(done.stdout.decode())), 12)


class Normals(ToolTest):
    def test_smooth_where_there_are_none(self):
        """On a vase the normals made are nearly those of the formula."""
        mesh = vase(12)
        pathlib.Path("model.stl").write_bytes(FORMATS["stl"](mesh))
        cosines = [
            sum(a * b for a, b in zip(vertex[-3:], mesh.normals[i]))
            for got, indices in zip(world_triangles(scene_of("model.stl")), mesh.triangles)
            for vertex, i in zip(got, indices)]
        self.assertGreater(min(cosines), 0.96)
        self.assertGreater(sum(cosines) / len(cosines), 0.998)

    def test_a_ball_stays_smooth_and_a_plane_plane(self):
        """On a ball of 16 by 8, every vertex has one normal, within half a step of the radius. A plate with a
        chamfer of 30 degrees has the plane's normal all over its top; so has one that goes on as a fillet."""
        def ring(i):
            u = math.pi * i / 8
            return [(math.sin(u) * math.cos(v), math.sin(u) * math.sin(v), math.cos(u))
                    for v in (math.tau * k / 16 for k in range(16))]

        points = [tuple(round(x, 6) for x in p) for i in range(9) for p in ring(i)]
        quads = [(16 * i + k, 16 * i + 16 + k, 16 * i + 16 + (k + 1) % 16, 16 * i + (k + 1) % 16)
                 for i in range(8) for k in range(16)]
        triangles = [
            t for a, b, c, d in quads for t in ((a, b, c), (a, c, d)) if len({points[i]
                                                                              for i in t}) == 3]
        pathlib.Path("ball.stl").write_bytes(FORMATS["stl"](Mesh(points, [], triangles)))
        normals = {}
        for triangle in world_triangles(scene_of("ball.stl")):
            for vertex in triangle:
                normals.setdefault(vertex[:3], set()).add(tuple(round(x, 4) for x in vertex[-3:]))
                turn = sum(p * n for p, n in zip(vertex[:3], vertex[-3:]))
                self.assertGreater(turn, math.cos(math.pi / 16))
        self.assertEqual({len(found) for found in normals.values()}, {1})
        for drops in ((0.58,), (0.03, 0.12, 0.27, 0.5)):  # below the top, where it is inset by 1, 2, ...
            rings = [(0, 0)] + [(k + 1, 0.58 if len(drops) == 1 else drop) for k, drop in enumerate(drops)]
            corners = [(x * (20 + inset), y * (15 + inset), -drop) for inset, drop in rings
                       for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            faces = "f 1 2 3 4\n" + "".join(
                f"f {4 * i + k + 5} {4 * i + (k + 1) % 4 + 5} {4 * i + (k + 1) % 4 + 1} {4 * i + k + 1}\n"
                for i in range(len(drops)) for k in range(4))
            pathlib.Path("plate.obj").write_text("".join("v %g %g %g\n" % p for p in corners) + faces)
            top = [t for t in world_triangles(scene_of("plate.obj")) if all(vertex[2] == 0 for vertex in t)]
            self.assertEqual({vertex[-3:] for t in top for vertex in t}, {(0, 0, 1)})

    def test_many_triangles_at_a_point(self):
        """Two fans of 200 triangles in planes at right angles: from a crease of 90 degrees on, one
        surface."""
        def fan(place):
            turns = [math.pi * i / 200 for i in range(201)]
            return [[(0, 0, 0), place(a), place(b)] for a, b in zip(turns, turns[1:])]

        corners = fan(lambda t: (math.cos(t), math.sin(t), 0)) + fan(lambda t: (math.cos(t), 0, -math.sin(t)))
        points = [p for triangle in corners for p in triangle]
        pathlib.Path("fans.stl").write_bytes(FORMATS["stl"](Mesh(
            points, [], [(i, i + 1, i + 2) for i in range(0, len(points), 3)])))
        for crease, expected in (("60", {(0, 0, 1), (0, 1, 0)}), ("100", {(0, round(
                math.sqrt(0.5), 3), round(math.sqrt(0.5), 3))})):
            normals = {
                tuple(round(x, 3) + 0.0 for x in vertex[-3:])
                for triangle in world_triangles(scene_of("fans.stl", "--crease", crease))
                for vertex in triangle if vertex[:3] == (0, 0, 0)}
            self.assertEqual(normals, expected, crease)

    def test_groups_and_materials_end_no_surface(self):
        """Two triangles that meet at 11 degrees share the normals of their edge whatever their groups and
        materials are, but not where their smoothing groups differ or are off."""
        points = "v 0 0 0\nv 0 1 0\nv 1 0 0.1\nv -1 0 0.1\n"
        for between, before, count in (("", "", 1), ("g b\n", "", 1), ("usemtl b\no b\n", "", 1),
                                       ("g b\n", "s 1\n", 1), ("s 2\n", "s 1\n", 2), ("g b\n", "s off\n", 2)):
            pathlib.Path("roof.obj").write_text(f"{points}{before}f 1 3 2\n{between}f 1 2 4\n")
            corners = [vertex for triangle in world_triangles(scene_of("roof.obj")) for vertex in triangle]
            self.assertEqual(len({vertex[3:] for vertex in corners if vertex[0] == 0}), count, between)

    def test_an_edge_stays_sharp_beyond_the_crease(self):
        pathlib.Path("box.obj").write_text(BOX)
        for options, is_sharp in ((["--crease", "60"], True), (["--crease", "100"], False), ([], True)):
            for triangle in world_triangles(scene_of("box.obj", *options)):
                a, b, c = (vertex[:3] for vertex in triangle)
                u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                face = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
                for vertex in triangle:
                    cosine = sum(p * q for p, q in zip(vertex[-3:], face)) / math.hypot(*face)
                    self.assertEqual(cosine > 0.999, is_sharp, options)


class Framing(ToolTest):
    def check_framed(self, scene, width, height):
        covered = picture_of(scene, width, height)
        rows = [i for i, row in enumerate(covered) if any(row)]
        columns = [k for k in range(width) if any(row[k] for row in covered)]
        self.assertTrue(rows)
        self.assertGreater(rows[0], 0)
        self.assertGreater(columns[0], 0)
        self.assertLess(rows[-1], height - 1)
        self.assertLess(columns[-1], width - 1)
        self.assertGreaterEqual(
            max((rows[-1] - rows[0] + 1) / height, (columns[-1] - columns[0] + 1) / width), 0.8)

    def test_models_fill_the_picture_and_leave_its_border(self):
        generator = random.Random(11)
        meshes = [knot(2), vase(4), terrain(4)]
        for _ in range(17):  # clouds of triangles, near and far from the origin
            sizes = [10**generator.uniform(-0.5, 0.5) for _ in range(3)]
            center = [generator.choice((0, 10**generator.uniform(-1, 3))) for _ in range(3)]
            points = [
                tuple(round(c + s * generator.uniform(-1, 1), 5) for c, s in zip(center, sizes))
                for _ in range(600)]
            meshes.append(Mesh(points, [(0, 0, 1)] * 600, [(i, i + 1, i + 2) for i in range(0, 600, 3)]))
        for number, mesh in enumerate(meshes):
            size = generator.choice(((200, 150), (150, 200), (160, 160), (320, 100)))
            options = [
                "--size",
                "%dx%d" % size, "--up-axis",
                generator.choice("xyz"), "--fov",
                str(generator.choice((5, 30, 60, 100))), "--eye-from",
                str(generator.randint(-180, 180)),
                str(generator.randint(-90, 90))]
            with self.subTest(model=number, options=options):
                pathlib.Path("model.ply").write_bytes(FORMATS["ply"](mesh))
                self.check_framed(scene_of("model.ply", *options), *size)

    def test_any_size_looks_the_same(self):
        pictures = set()
        for scale in (1, 1e-7, 1e-30, 1e9, 1e30):
            lines = BOX.splitlines(True)
            text = re.sub(r"\b1\b", repr(scale), "".join(lines[:8])) + "".join(lines[8:])
            pathlib.Path("box.obj").write_text(text)
            pictures.add(str(picture_of(scene_of("box.obj", "--up-axis", "-y"), 60, 45)))
        self.assertEqual(len(pictures), 1)

    def test_up_may_point_down(self):
        pathlib.Path("box.obj").write_text(BOX)
        for words in (["--up-axis", "-y"], ["--up-axis=-y"]):
            self.assertEqual(header(scene_of("box.obj", *words))["up"], "0 -1 0")

    def test_directions(self):
        """Straight from the front, from the right and from above, the eye is where the axes say."""
        pathlib.Path("box.obj").write_text(BOX)
        for up, front, right, above in (("y", (0, 0, 1), (1, 0, 0), (0, 1, 0)), ("z", (0, -1, 0), (1, 0, 0),
                                                                                 (0, 0, 1))):
            for angles, expected in ((("0", "0"), front), (("90", "0"), right), (("0", "90"), above),
                                     (("-90", "0"), tuple(-x for x in right))):
                parts = header(scene_of("box.obj", "--up-axis", up, "--eye-from", *angles))
                eye, look = (list(map(float, parts[key].split())) for key in ("eye", "look"))
                toward = [p - q for p, q in zip(eye, look)]
                length = math.hypot(*toward)
                for x, y in zip(toward, expected):
                    self.assertAlmostEqual(x / length, y, 3)

    def test_the_view_begins_half_way_to_the_model(self):
        """So that what is added to the scene in front of the model is drawn; it ends half of the middle's
        distance behind it."""
        pathlib.Path("box.obj").write_text(BOX)  # z from 0 to 1
        parts = header(scene_of("box.obj", "--eye-from", "0", "0"))
        eye, (near, far) = float(parts["eye"].split()[2]), map(float, parts["projection"].split()[2:4])
        self.assertAlmostEqual(near, (eye - 1) / 2, 3)
        self.assertAlmostEqual(far, eye + (eye - 0.5) / 2, 2)

    def test_up_is_the_axis_itself_and_the_view_is_the_same(self):
        """The view has the axes of azimuth and elevation, by their formula: to the right, upwards in the
        picture, and towards the eye. From straight above, where the axis shows no direction in the picture,
        `up` is the second of them."""
        pathlib.Path("knot.obj").write_bytes(FORMATS["obj"](knot(2)))
        lines = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
        for name, line in lines.items():
            axis = tuple(map(float, line.split()))
            front = (0, -1, 0) if name == "z" else (0, 0, 1)
            side = cross(axis, front)
            for azimuth, elevation in ((30, 15), (0, 0), (-130, 60), (200, -40), (77, 85), (77, -85),
                                       (77, 86), (30, 90), (-45, -90)):
                with self.subTest(up=name, azimuth=azimuth, elevation=elevation):
                    scene = scene_of("knot.obj", "--up-axis", name, "--eye-from", str(azimuth),
                                     str(elevation))
                    parts = header(scene)
                    if abs(elevation) <= 85:
                        self.assertEqual(parts["up"], line)
                    a, e = math.radians(azimuth), math.radians(elevation)
                    toward = [math.cos(a) * f + math.sin(a) * s for f, s in zip(front, side)]
                    right = [math.cos(a) * s - math.sin(a) * f for f, s in zip(front, side)]
                    back = [math.cos(e) * t + math.sin(e) * u for t, u in zip(toward, axis)]
                    up = cross(back, right)
                    eye = tuple(map(float, parts["eye"].split()))
                    distance = math.dist(eye, tuple(map(float, parts["look"].split())))
                    world = pipe(["model", "--bare", "--digits", "exact"], stdin=scene).decode().split()
                    seen = pipe(["model"], ["view", "--bare", "--digits", "exact"],
                                stdin=scene).decode().split()
                    worst = 0
                    for i in range(0, len(world), 3):
                        p = [float(x) - o for x, o in zip(world[i:i + 3], eye)]
                        for x, of_axis in zip(seen[i:i + 3], (right, up, back)):
                            worst = max(worst, abs(float(x) - sum(c * d for c, d in zip(p, of_axis))))
                    # Each number of the eye and of the look point is rounded by 0.00005 of the distance at
                    # most, which turns the picture the more the steeper the view; the knot's vertices are
                    # within 0.35 distances of the look point.
                    steepness = math.cos(e) if abs(elevation) <= 85 else 1
                    self.assertLess(worst / distance,
                                    0.35 * 0.00005 * (math.sqrt(12) + math.sqrt(8) / steepness))

    def test_the_aspect_is_that_of_the_size(self):
        pathlib.Path("box.obj").write_text(BOX)
        self.assertRegex(header(scene_of("box.obj"))["projection"], r"^30 1\.3333333333333333 .* ratio$")
        self.assertRegex(
            header(scene_of("box.obj", "--size", "100x200", "--fov", "40"))["projection"],
            r"^40 0\.5 .* ratio$")


# A camera at (0 0 5) that looks down -z, a point light, a node that moves and turns its two children, one of
# them mirrored.
def gltf_with_nodes():
    mesh = vase(1)
    document = json.loads(FORMATS["gltf"](mesh))
    s = math.sqrt(0.5)
    document["nodes"] = [
        {"name": "root", "translation": [1, 2, 3], "rotation": [0, s, 0, s], "children": [
            1, 2]},  # 90 degrees about y
        {"name": "first", "mesh": 0, "scale": [2, 1, 0.5]},
        {"name": "second", "mesh": 0, "scale": [-1, 1, 1], "translation": [0, 0, 4]},
        {"name": "eye", "camera": 0, "translation": [0, 0, 25]},
        {"name": "lamp", "translation": [7, 8, 9], "extensions": {"KHR_lights_punctual": {"light": 0}}}]
    document["scenes"] = [{"nodes": [0, 3, 4]}]
    document["cameras"] = [{
        "type": "perspective", "perspective": {"yfov": math.radians(40), "znear": 1, "zfar": 100}}]
    document["extensionsUsed"] = ["KHR_lights_punctual"]
    document["extensions"] = {
        "KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 0.5, 0.25], "intensity": 1}]}}
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0, 1]}}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    return mesh, json.dumps(document)


class Nodes(ToolTest):
    def setUp(self):
        super().setUp()
        self.mesh, text = gltf_with_nodes()
        pathlib.Path("model.gltf").write_text(text)

    def expected(self):
        def root(p):
            x, y, z = p
            return (z + 1, y + 2, -x + 3)  # rotated by 90 degrees about y, then moved

        # A mirror image turns around, so that its front stays its front.
        for place, order in ((lambda p: root((2 * p[0], p[1], 0.5 * p[2])), (0, 1, 2)), (lambda p: root(
            (-p[0], p[1], p[2] + 4)), (0, 2, 1))):
            yield from ([place(self.mesh.vertices[indices[i]]) for i in order]
                        for indices in self.mesh.triangles)

    def test_transforms_are_applied(self):
        for options in ([], ["--nodes"]):
            found = world_triangles(scene_of("model.gltf", *options))
            for a, b, c in found:
                face = cross(*([q - p for p, q in zip(a, other)] for other in (b, c)))
                self.assertGreater(sum(x * y for x, y in zip(face, a[-3:])), -1e-6)
            expected = list(self.expected())
            self.assertEqual(len(found), len(expected))
            for got, triangle in zip(found, expected):
                for vertex, point in zip(got, triangle):
                    for x, y in zip(vertex, point):
                        self.assertAlmostEqual(x, y, 5)

    def test_transforms_become_commands(self):
        scene = scene_of("model.gltf", "--nodes")
        self.assertRegex(scene, "push\ntranslate 1 2 3\nrotate 90 0 1 0\npush\nscale 2 1 0.5\n#.*\n")
        self.assertEqual(scene.count("push\n"), scene.count("pop\n"))

    def test_the_files_camera_and_light_are_taken(self):
        parts = header(scene_of("model.gltf"))
        self.assertEqual(parts["eye"], "0 0 25")
        self.assertTrue(parts["projection"].startswith("40 1.3333333333333333 1 100"), parts["projection"])
        self.assertEqual([list(map(float, light.split())) for light in parts["light"]],
                         [[7, 8, 9, 1, 0.5, 0.25]])
        self.assertNotEqual(header(scene_of("model.gltf", "--eye-from", "0", "0"))["eye"], "0 0 25")

    def test_the_files_angle_is_the_one_upwards_whatever_its_aspect(self):
        """glTF's yfov (glTF 2.0, 3.10.3.2)."""
        document = json.loads(pathlib.Path("model.gltf").read_text())
        for aspect in ({}, {"aspectRatio": 1.5}, {"aspectRatio": 16 / 9}, {"aspectRatio": 0.6}):
            for yfov in (10, 40, 95):
                document["cameras"] = [{
                    "type": "perspective", "perspective": {
                        "yfov": math.radians(yfov), "znear": 1, "zfar": 100, **aspect}}]
                pathlib.Path("model.gltf").write_text(json.dumps(document))
                found = header(scene_of("model.gltf", "--size", "300x200"))["projection"].split()
                self.assertAlmostEqual(float(found[0]), yfov, 3, aspect)
                self.assertEqual(found[1:], ["1.5", "1", "100", "ratio"])

    def test_a_spotlight_shines_all_around_and_a_note_tells(self):
        document = json.loads(pathlib.Path("model.gltf").read_text())
        document["extensions"]["KHR_lights_punctual"]["lights"] = [{
            "type": "spot", "intensity": 1, "spot": {"outerConeAngle": 0.5}}]
        pathlib.Path("model.gltf").write_text(json.dumps(document))
        done = run("mesh2scene", "--eye-from", "0", "0", "model.gltf")
        self.assertEqual(done.stderr.decode(),
                         "mesh2scene: note: model.gltf: no scene can hold its cones of spotlights\n")
        self.assertEqual(header(done.stdout.decode())["light"], ["7 8 9 1 1 1"])

    def test_a_small_scale_keeps_its_digits(self):
        document = json.loads(pathlib.Path("model.gltf").read_text())
        for scale in ("1.2345678e-05", "1.5e-20", "0.3333333"):
            document["nodes"][1]["scale"] = [float(scale)] * 3
            pathlib.Path("model.gltf").write_text(json.dumps(document))
            self.assertIn(f"scale {scale} {scale} {scale}\n", scene_of("model.gltf", "--nodes"))

    def test_a_transform_beyond_floats_is_refused(self):
        document = json.loads(pathlib.Path("model.gltf").read_text())
        document["nodes"][0]["scale"] = document["nodes"][1]["scale"] = [1e30] * 3
        pathlib.Path("model.gltf").write_text(json.dumps(document))
        for options in ([], ["--nodes"]):
            done = run("mesh2scene", *options, "model.gltf")
            self.assertEqual((done.returncode, done.stdout), (1, b""))
            self.assertIn("expected finite coordinates, found others in mesh", done.stderr.decode())

    def test_lights_that_no_scene_takes_are_left_out(self):
        document = json.loads(pathlib.Path("model.gltf").read_text())
        usual = header(scene_of("model.gltf"))["light"]
        lights = document["extensions"]["KHR_lights_punctual"]["lights"]
        for light, translation in (({"color": [-1, 0, 0]}, [0, 0, 0]), ({"color": [1, 1, 1]}, [1e39, 0, 0])):
            lights[1:] = [{"type": "point", **light}]
            document["nodes"][5:] = [{
                "translation": translation, "extensions": {"KHR_lights_punctual": {"light": 1}}}]
            document["scenes"] = [{"nodes": [0, 3, 4, 5]}]
            pathlib.Path("model.gltf").write_text(json.dumps(document))
            self.assertEqual(header(scene_of("model.gltf"))["light"], usual)

    def test_linear_colors_become_those_of_a_screen(self):
        """Half the light is not half the number: 0.5 is 187.516 of 255 (IEC 61966-2-1)."""
        self.assertEqual(header(scene_of("model.gltf"))["paint"], ["255 187.516 0"])


class Colors(ToolTest):
    def test_of_vertices(self):
        pathlib.Path("model.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property uchar red\nproperty uchar green\n"
            "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 "
            "255 0 77\n1 0 0 0 128 1\n0 1 0 9 8 7\n3 0 1 2\n")
        self.assertEqual([vertex[3:6] for vertex in world_triangles(scene_of("model.ply"))[0]], [(255, 0, 77),
                                                                                                 (0, 128, 1),
                                                                                                 (9, 8, 7)])

    def test_a_file_without_colors_looks_the_same_in_every_format(self):
        colors = set()
        for suffix, write in FORMATS.items():
            pathlib.Path(f"model.{suffix}").write_bytes(write(vase(1)))
            colors.add(header(scene_of(f"model.{suffix}"))["paint"][0])
        self.assertEqual(len(colors), 1, colors)

    def test_of_materials(self):
        pathlib.Path("model.mtl").write_text("newmtl red\nKd 1 0.2 0\nnewmtl blue\nKd 0 0 0.6\n")
        pathlib.Path("model.obj").write_text(
            "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 3 2\n")
        scene = scene_of("model.obj")
        self.assertEqual(header(scene)["paint"], ["255 51 0", "0 0 153"])
        self.assertEqual({len(vertex) for triangle in world_triangles(scene) for vertex in triangle}, {7})


STUDIO = "1 1 0.15 20"  # of meshes whose file says nothing of materials


def by_roughness(base, metallic, roughness):
    """Blinn-Phong in place of glTF's metallic and roughness factors, as docs/models.md has it."""
    shininess = min(10000, max(1, 2 / roughness**4 - 2))
    f0 = 0.04 + metallic * (max(base) - 0.04)
    return 1, 1 - metallic / 2, min(1, f0 * (shininess + 2) / 8), round(shininess)


class Materials(ToolTest):
    MTL = ("newmtl matt\nKd 0.8 0.8 0.8\nKs 0 0 0\nNs 10\nnewmtl shiny\nKa 0.4 0.2 0.1\nKd 0.8 0.2 0\nKs 0.6 "
           "0.5 0.5\nNs 64\nnewmtl other\nKd 0 0 1\n"
           "newmtl twin\nKa 0 0.15 0\nKd 0 0.3 0\nKs 0.6 0 0\nNs 64\n")

    def write_obj(self, *names):
        pathlib.Path("model.mtl").write_text(self.MTL)
        pathlib.Path("model.obj").write_text("mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" +
                                             "".join(f"usemtl {name}\nf 1 2 {3 + i % 2}\n"
                                                     for i, name in enumerate(names)))

    def lines(self, name, *options):
        """The lines of materials and colors, without the triangles."""
        scene = scene_of(name, *options)
        pipe(["model"], ["view"], ["project"], ["zbuf", "--size", "9x9", "--image", "out.ppm"], stdin=scene)
        return [line for line in scene.splitlines() if re.match("(material|paint|use|color) ", line)]

    def test_of_colors_become_factors(self):
        self.write_obj("matt", "shiny", "other", "matt")
        self.assertEqual(self.lines("model.obj"), [
            "material 1 1 0 10", "paint 204 204 204", "material 0.5 1 0.6 64", "paint 204 51 0",
            "material " + STUDIO, "paint 0 0 255", "use 1", "use 2", "use 0"])
        self.assertEqual(self.lines("model.obj", "--color", "ff8000"), [
            "material 1 1 0 10", "paint 255 128 0", "material 0.5 1 0.6 64", "paint 255 128 0",
            "material " + STUDIO, "paint 255 128 0", "use 1", "use 2", "use 0"])

    def test_one_is_enough_where_all_are_alike(self):
        self.write_obj("shiny", "twin")
        self.assertEqual(
            self.lines("model.obj"),
            ["material 0.5 1 0.6 64", "paint 204 51 0", "material 0.5 1 0.6 64", "paint 0 76.5 0", "use 1"])
        self.assertEqual(self.lines("model.obj", "--color", "0000ff"),
                         ["material 0.5 1 0.6 64", "paint 0 0 255"])
        self.write_obj("other")
        self.assertEqual(self.lines("model.obj"), ["material " + STUDIO, "paint 0 0 255"])

    def test_are_not_those_of_files_without_any(self):
        for suffix, write in FORMATS.items():
            pathlib.Path(f"model.{suffix}").write_bytes(write(vase(1)))
            self.assertEqual(self.lines(f"model.{suffix}")[:1], ["material " + STUDIO], suffix)
            self.assertNotIn("use", scene_of(f"model.{suffix}"), suffix)

    def test_of_gltf_follow_the_formula(self):
        document = json.loads(FORMATS["gltf"](vase(1)))
        kinds = [((1, 1, 1), 0, 0.5), ((1, 0.8, 0.3), 1, 0.4), ((0.1, 0.2, 0.5), 0.5, 0.75),
                 ((1, 1, 1), 0, 1), ((0.5, 0.5, 0.5), 1, 0)]
        document["materials"] = [{
            "pbrMetallicRoughness": {
                "baseColorFactor": [*base, 1], "metallicFactor": metallic, "roughnessFactor": roughness}}
                                 for base, metallic, roughness in kinds]
        primitive = document["meshes"][0]["primitives"][0]
        document["meshes"] = [{"primitives": [{**primitive, "material": i}]} for i in range(len(kinds))]
        document["nodes"] = [{"mesh": i, "translation": [i, 0, 0]} for i in range(len(kinds))]
        document["scenes"] = [{"nodes": list(range(len(kinds)))}]
        pathlib.Path("model.gltf").write_text(json.dumps(document))
        for options in ([], ["--nodes"]):
            lines = self.lines("model.gltf", *options)
            found = [
                [float(word) for word in line.split()[1:]] for line in lines if line.startswith("material")]
            self.assertEqual(len(found), len(kinds))
            for factors, (base, metallic, roughness) in zip(found, kinds):
                for value, expected in zip(factors, by_roughness(base, metallic, max(roughness, 1e-9))):
                    self.assertAlmostEqual(value, expected, delta=0.0006)
            self.assertEqual([line for line in lines if line.startswith("use")],
                             ["use 1", "use 2", "use 3", "use 4"])

    def test_are_not_without_number(self):
        count = 300
        pathlib.Path("model.mtl").write_text("".join(
            f"newmtl m{i}\nKd 1 1 1\nKs 0.5 0.5 0.5\nNs {i + 1}\n" for i in range(count)))
        pathlib.Path("model.obj").write_text("mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" +
                                             "".join(f"usemtl m{i}\nf 1 2 3\n" for i in range(count)))
        done = run("mesh2scene", "model.obj")
        lines = done.stdout.decode().splitlines()
        self.assertEqual(done.returncode, 0)
        self.assertIn(
            "mesh2scene: note: model.obj: it has more than 256 materials; meshes with further "
            "ones get the first\n", done.stderr.decode())
        self.assertEqual([line for line in lines if line.startswith("material")],
                         [f"material 1 1 0.5 {i + 1}" for i in range(256)])
        self.assertEqual([line for line in lines if line.startswith("use")],
                         [f"use {i}" for i in [*range(1, 256), 0]])

    def test_have_no_paints_where_these_were_too_many(self):
        self.write_obj(*map(str, range(300)))
        for color_count, keyword, line_count in ((256, "paint", 256), (257, "color", 300)):
            pathlib.Path("model.mtl").write_text("".join(
                f"newmtl {i}\nKd {i % color_count / 300} 0 0\n" for i in range(300)))
            lines = self.lines("model.obj")
            self.assertEqual(lines[:2], ["material " + STUDIO, keyword + " 0 0 0"])
            self.assertEqual(sum(line.startswith(keyword) for line in lines), line_count)

    def test_of_no_numbers_are_none(self):
        pathlib.Path("model.mtl").write_text("newmtl odd\nKa -1 nan inf\nKd 1 1 1\nKs 7 7 7\nNs 1e30\n")
        pathlib.Path("model.obj").write_text(
            "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl odd\nf 1 2 3\n")
        self.assertEqual(self.lines("model.obj")[0].split()[3:], ["1", "10000"])


class Refusals(ToolTest):
    def assert_refused(self, name, expected):
        done = run("mesh2scene", name)
        self.assertEqual((done.returncode, done.stdout), (1, b""), name)
        message = done.stderr.decode()
        self.assertTrue(message.startswith("mesh2scene: "), message)
        self.assertEqual(message.count("\n"), 1, message)
        self.assertRegex(message, expected)

    def test_one_message(self):
        pathlib.Path("empty.obj").write_text("")
        pathlib.Path("noise.stl").write_bytes(bytes(range(256)) * 40)
        pathlib.Path("lines.obj").write_text("v 0 0 0\nv 1 0 0\nl 1 2\n")
        pathlib.Path("point.stl").write_bytes(b" " * 80 + struct.pack("<I12fH", 1, 0, 0, 1, *[3e12] * 9, 0))
        pathlib.Path("picture.png").write_bytes(b"\x89PNG\r\n\x1a\n")
        pathlib.Path("infinite.stl").write_bytes(
            b" " * 80 + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, math.inf, 0, 0, 0, 1, 0, 0))
        pathlib.Path("far.obj").write_text("v -3e38 0 0\nv 3e38 0 0\nv 0 3e38 0\nf 1 2 3\n")
        for name, expected in (("missing.obj", "missing.obj: No such file"), (".", r"Is a directory"),
                               ("empty.obj", "empty.obj: expected a model with triangles, found none"),
                               ("noise.stl",
                                "noise.stl: expected 1397903696 triangles in a binary STL file, found 203"),
                               ("lines.obj", "model with triangles, found none, but points and lines"),
                               ("point.stl", "point.stl: expected a model with an extent"),
                               ("picture.png", f"picture.png{OTHER}a PNG picture"),
                               ("infinite.stl", "infinite.stl: expected finite coordinates")):
            with self.subTest(name):
                self.assert_refused(name, expected)

    def test_a_file_cut_anywhere_gives_a_scene_or_one_message(self):
        for suffix, write in FORMATS.items():
            data = write(vase(1))
            for size in range(0, len(data), max(1, len(data) // 8)):
                pathlib.Path(f"cut.{suffix}").write_bytes(data[:size])
                done = run("mesh2scene", f"cut.{suffix}")
                with self.subTest(format=suffix, bytes=size):
                    if done.returncode == 0:
                        world_triangles(done.stdout.decode())
                    else:
                        self.assert_refused(f"cut.{suffix}", f"cut.{suffix}:")

    def test_damaged_bytes_give_a_scene_or_one_message(self):
        generator = random.Random(3)
        for suffix, write in FORMATS.items():
            data = bytearray(write(vase(1)))
            for _ in range(10):
                broken = bytearray(data)
                for _ in range(generator.randint(1, 20)):
                    broken[generator.randrange(len(broken))] = generator.randrange(256)
                pathlib.Path(f"broken.{suffix}").write_bytes(broken)
                done = run("mesh2scene", f"broken.{suffix}")
                with self.subTest(format=suffix):
                    self.assertIn(done.returncode, (0, 1), done.stderr)
                    if done.returncode == 0:
                        world_triangles(done.stdout.decode())

    def test_a_line_that_asks_for_gigabytes_gets_none(self):
        if b"__asan_init" in pathlib.Path(command("mesh2scene")[0]).read_bytes():
            self.skipTest("AddressSanitizer ends a program whose memory is limited")
        pathlib.Path("many.ply").write_text(
            "ply\nformat ascii 1.0\nelement vertex 900000000\nproperty float x\nproperty float y\nproperty "
            "float z\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
            "3 0 1 2\n")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
        self.assert_refused(
            "many.ply",
            "many.ply: expected 900000000 of element .vertex., found the end of the file: it is cut")
        done = run("mesh2scene", stdin=pathlib.Path("many.ply").read_bytes())  # is measured, too
        self.assertRegex(done.stderr, rb"^mesh2scene: <stdin>: expected 900000000 of element")
        self.assertLessEqual(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, max(before,
                                                                                         2_000_000))  # KiB

    def test_wrong_options(self):
        pathlib.Path("box.obj").write_text(BOX)
        for options, expected in (([
                "--eye-from", "10",
                "91"], "--eye-from ELEVATION: expected a number from -90 to 90, found '91'"), ([
                    "--eye-from", "x",
                    "1"], "--eye-from AZIMUTH: expected a number from -360 to 360, found 'x'"), ([
                        "--size", "4"], "--size: expected WIDTHxHEIGHT in pixels"), ([
                            "--fov", "0"], "--fov: expected"), (["--crease", "180"], "--crease: expected")):
            done = run("mesh2scene", *options, "box.obj")
            self.assertEqual(done.returncode, 2)
            self.assertIn(expected, done.stderr.decode())


TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
SECRET = struct.pack("<9f", 7, 7, 7, 8, 7, 7, 7, 8, 7)  # bytes that would come back as coordinates


def gltf_of(*uris):
    """A triangle from each of the files."""
    count = range(len(uris))
    return json.dumps({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [*count]}],
        "nodes": [{"mesh": i} for i in count],
        "meshes": [{"primitives": [{"attributes": {"POSITION": i}}]} for i in count],
        "accessors": [{
            "bufferView": i,
            "componentType": 5126,
            "count": 3,
            "type": "VEC3",
            "min": [0, 0, 0],
            "max": [9, 9, 9],} for i in count],
        "bufferViews": [{"buffer": i, "byteLength": 36} for i in count],
        "buffers": [{"uri": uri, "byteLength": 36} for uri in uris],})


class OtherFiles(ToolTest):
    """A model opens regular files in or below its folder."""
    def setUp(self):
        super().setUp()
        pathlib.Path("home/model/parts").mkdir(parents=True)
        for name, data in (
            ("home/secret", SECRET),
            ("home/model/data", TRIANGLE),
            ("home/model/parts/data", TRIANGLE),
        ):
            pathlib.Path(name).write_bytes(data)
        os.mkfifo("home/model/fifo")
        with socket.socket(socket.AF_UNIX) as one:
            one.bind("home/model/socket")
        links = "link=parts/data chain=parts/../link folder=parts parts/up=.. out=../secret home=.. "
        links += "parts/out=../../secret zero=/dev/zero to_fifo=fifo loop=loop self=/proc/self "
        links += "gone=../nothing absolute="
        for link in (links + os.path.abspath("home/model/data")).split():
            name, target = link.split("=")
            os.symlink(target, f"home/model/{name}")

    def of_uri(self, *uris):
        pathlib.Path("home/model/a.gltf").write_text(gltf_of(*uris))
        return run("mesh2scene", "home/model/a.gltf")

    def test_below_the_folder_are_read(self):
        names = "data ./data .//parts///data parts/../data link chain folder/data parts/up/data "
        names += "folder/up/folder/../data"
        found_by_their_last_step = "/elsewhere/data home/model/data fifo/data data/../data"
        for uri in names.split() + found_by_their_last_step.split():
            with self.subTest(uri):
                done = self.of_uri(uri)
                self.assert_quiet_success(done)
                self.assertEqual(
                    [vertex[:3] for vertex in world_triangles(done.stdout.decode())[0]],
                    [(0, 0, 0), (1, 0, 0), (0, 1, 0)],
                )

    def test_elsewhere_or_of_another_kind_are_refused(self):
        secret = os.path.abspath("home/secret")
        refused = (
            "../secret parts/../../secret .. . parts parts/up/../secret /etc/passwd /dev/stdin /dev/zero out "
            "parts/out home/secret absolute zero self/environ /proc/self/environ fifo to_fifo socket "
            "loop gone")
        of_no_file = "nothing file/../../secret nothing/../../secret %2e%2e/secret ..\\secret"
        for uri in ["", secret, "file://" + secret, *refused.split(), *of_no_file.split()]:
            with self.subTest(uri):
                done = self.of_uri(uri)
                self.assertEqual((done.returncode, done.stdout), (1, b""))
                if uri == secret or uri in refused.split():
                    expected = f"regular files in or below the model's folder, found {quoted(uri)}"
                    self.assertEqual(done.stderr.decode(),
                                     f"mesh2scene: home/model/a.gltf: expected {expected}\n")

    def test_that_a_model_can_do_without_are_noted(self):
        for name in ("../secret", "fifo", "/dev/zero", "out"):
            pathlib.Path("home/model/a.obj").write_text(f"mtllib {name}\n" + BOX)
            done = run("mesh2scene", "--up-axis", "y", "home/model/a.obj")
            self.assertEqual(
                (done.returncode, done.stderr.decode()),
                (
                    0,
                    "mesh2scene: note: home/model/a.obj: expected regular files in or below the "
                    f"model's folder, found '{name}': left out\n",
                ),
            )
            self.assertEqual(len(world_triangles(done.stdout.decode())), 12)

    def test_of_a_linked_model_are_where_the_link_is(self):
        os.symlink("home/model/b.gltf", "a.gltf")
        pathlib.Path("home/model/b.gltf").write_text(gltf_of("data"))
        self.assertEqual(run("mesh2scene", "a.gltf").returncode, 1)
        pathlib.Path("data").write_bytes(TRIANGLE)
        self.assert_quiet_success(run("mesh2scene", "a.gltf"))

    def test_of_standard_input_are_none(self):
        pathlib.Path("a.mtl").write_text("newmtl red\nKd 1 0 0\n")
        done = run("mesh2scene", "--up-axis", "y", stdin="mtllib a.mtl\nusemtl red\n" + BOX)
        self.assertEqual(
            (done.returncode, done.stderr.decode()),
            (
                0,
                "mesh2scene: note: <stdin>: expected no other file, as standard input has no folder, "
                "found 'a.mtl': left out\n",
            ),
        )
        self.assertNotIn(b"255 0 0", done.stdout)

    def test_never_are_the_output(self):
        pathlib.Path("a.obj").write_text("mtllib a.mtl\n" + BOX)
        data = b"newmtl red\nKd 1 0 0\n"
        pathlib.Path("a.mtl").write_bytes(data)
        os.link("a.mtl", "b.mtl")
        for name, mode in (("a.mtl", "r+b"), ("b.mtl", "ab")):
            with open(name, mode) as output:
                done = run("mesh2scene", "a.obj", stdout=output)
            expected = "a place of its own for standard output, found 'a.mtl', which the model names"
            self.assertEqual(
                (done.returncode, done.stderr.decode()),
                (2, f"mesh2scene: expected {expected} (try mesh2scene --help)\n"),
            )
            self.assertEqual(pathlib.Path("a.mtl").read_bytes(), data)

    def test_the_model_itself_is_a_regular_file(self):
        for name in ("home/model/fifo", "home/model/socket", "/dev/zero", "/dev/null"):
            done = run("mesh2scene", name)
            self.assert_fails(
                done, 1, f"mesh2scene: {name}: expected a regular file, or - for what comes through a pipe")

    def test_may_show_a_billion_triangles(self):
        mesh = vase(20)
        document = json.loads(FORMATS["gltf"](mesh))
        document["nodes"] = [{"children": [i + 1, i + 1]} for i in range(18)] + [{"mesh": 0}]
        document["scenes"] = [{"nodes": [0]}]
        pathlib.Path("twice.gltf").write_text(json.dumps(document))
        found = 2**18 * len(mesh.triangles)
        self.assert_fails(run("mesh2scene", "twice.gltf"), 1,
                          f"mesh2scene: twice.gltf: expected at most 1000000000 triangles, found {found}")

    def test_are_limited_together(self):
        pathlib.Path("big.obj").write_text("mtllib big.mtl\n" + BOX + "#" * 600_000)
        pathlib.Path("big.mtl").write_text("#" * 600_000)
        limit = "expected at most 1 MB in all files of a model (--max-input), found more"
        self.assert_fails(run("mesh2scene", "--max-input", "1", "big.obj"), 1,
                          f"mesh2scene: big.mtl: {limit}")
        self.assert_quiet_success(run("mesh2scene", "--max-input", "2", "--up-axis", "y", "big.obj"))
        with open("big.obj", "ab") as file:
            file.truncate(10**13)  # no bytes on the disk
        self.assert_fails(run("mesh2scene", "big.obj"), 1,
                          f"mesh2scene: big.obj: {limit.replace('1', '1000')}")
        self.assert_fails(run("mesh2scene", "--max-input", "1", stdin=BOX + "#" * 1_000_000), 1,
                          f"mesh2scene: <stdin>: {limit}")


class Coarse(ToolTest):
    """A note where the steps of floats show: from 2^23 on they are 1, from 2^21 on a quarter."""

    CASES = (
        ("8388608 0 0", "8388618 0 0", "steps of 1, are coarse for an extent of 10"),
        ("2097152 -5000000 0", "2097153 -5000100 0", "steps of 0.5, are coarse for an extent of 100"),
        ("8388608 0 0", "8408608 0 0", ""),
        ("0 0 0", "1e30 0 0", ""),
        ("1.00001 1 1", "1.00002 1 1", "steps of 1.19e-07, are coarse for an extent of 1e-05"),
        ("5 5 5", "5 5 6", ""),
    )

    def test_steps_that_show_are_noted(self):
        for first, second, note in self.CASES:
            pathlib.Path("a.obj").write_text(f"v {first}\nv {second}\nv {first}\nf 1 2 3\n")
            done = run("mesh2scene", "--up-axis", "y", "a.obj")
            if note:
                note = ("mesh2scene: note: a.obj: its coordinates, floats with "
                        f"{note}: move the model to the origin\n")
            self.assertEqual((done.returncode, done.stderr.decode()), (0, note))


PLY = ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "element %s 1\nproperty list int int vertex_indices\n%send_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n%s\n")
RGB = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
FACET = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
BINARY = struct.pack("<12f", *[0] * 3, *[0] * 3, 1, 0, 0, 0, 1, 0)
V = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
USUAL = "228 222 210"
PARTLY_COLORED = ": some of its vertices have no color: they get the color of their mesh"


def stl(count, bits=0, header=b""):
    return header.ljust(80) + struct.pack("<I", count) + BINARY + struct.pack("<H", bits)


def big_endian_ply(size):
    data = struct.pack(">12fi3i", 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 3, 0, 1, 2)
    return (PLY %
            ("face", "", "")).replace("ascii", "binary_big_endian").split("0 0 0\n")[0].encode() + data[:size]


class Readers(ToolTest):
    """What people's files are like: the name, the content, how many triangles it gives, the message or the
    notes, and a color."""

    CASES = (
        ("a.stl", "\n  solid a\n" + FACET + "endsolid\n", 1),
        ("a.stl", ("solid\n" + FACET + "endsolid").upper(), 1),
        ("a.stl", stl(1, header=b"solid"), 1),
        ("a.stl", stl(1) + b"trailing", 1),
        ("named.obj", stl(1), 1),
        ("a.stl", stl(0), 1,
         ": its header announces 0 triangles, but it has data for 1 triangle: this data is drawn"),
        ("a.stl", stl(3), 0, ": expected 3 triangles in a binary STL file, found 1: it is cut"),
        ("a.stl", "solid\n" + FACET, 0, ":9:1: expected endsolid, found the end of the file"),
        ("a.stl", "solid\n" + FACET.replace("1 0 0", "1 o 0"), 0, ":5:10: expected a coordinate, found 'o'"),
        ("a.stl", "solid\n" + FACET + (FACET + "endsolid").replace("\n", " "), 2),
        ("a.stl", stl(1, header=b"Offset bracket"), 1),
        ("a.stl", stl(1, 0x8000, b"COLOR=\xff\0\0\xff"), 1, "", "255 0 0"),  # Magics: of the object
        ("a.stl", stl(1, 0x7C00, b"COLOR=\xff\0\0\xff"), 1, "", "0 0 255"),
        ("a.stl", stl(1, 0xFC00), 1, "", "255 0 0"),  # VisCAM
        ("a.stl", stl(1, 0x7C00), 1, "", USUAL),
        ("a.ply", PLY % ("tristrips", "", "4 0 1 2 3"), 2),
        ("a.ply", PLY % ("tristrips", "", "7 0 1 2 -1 1 3 2"), 2),
        ("a.ply", PLY % ("trianglestrips", "", "4 0 1 2 3"), 0,
         ": expected a model with triangles, found none, but element 'trianglestrips'"),
        ("a.ply", PLY % ("face", RGB, "4 0 1 3 2 250 20 10"), 2, "", "250 20 10"),
        ("a.ply", PLY % ("face", "property uchar red\n", "3 0 1 2 9"), 1, PARTLY_COLORED, USUAL),
        ("a.ply", (PLY % ("face", "", "3 0 1 2")).replace("z\n", "z\nproperty uchar red\n").replace(
            " 0\n", " 0 9\n"), 1, PARTLY_COLORED, USUAL),
        ("a.ply", PLY % ("face", "element edge 1\nproperty int vertex1\n", "3 0 1 2\n0"), 1,
         ": no scene can hold its points and lines"),
        ("a.ply", (PLY % ("face", RGB, "3 0 1 3 250 20 10\n3 4 5 3 250 20 10")).replace(
            "face 1", "face 2"), 0, ":18:3: expected the index of a vertex, found '4'"),
        ("a.ply", PLY % ("face", "", "3 0 1 2\n3 1 2 3"), 1, ": more follows its last element: left out"),
        ("a.ply", PLY % ("face", "", "3 0 1 2 3"), 0, ":14:9: expected the end of the line, found '3'"),
        ("a.ply", PLY % ("face", "", "3.5 0 1 2"), 0, ":14:1: expected a count, found '3.5'"),
        ("a.ply", PLY % ("face", "", "3 0 1 9"), 0, ":14:7: expected the index of a vertex, found '9'"),
        ("a.ply", PLY % ("face", "", "3 0 1 -2"), 0, ":14:7: expected the index of a vertex, found '-2'"),
        ("a.ply", PLY % ("face", "", "3 0 1"), 0, ":15:1: expected a number, found the end of the file"),
        ("a.ply", (PLY % ("face", "", "3 0 1 2")).replace(
            "int int",
            "int int64"), 0, ":8:19: expected a type of PLY, such as float, uchar or int, found 'int64'"),
        ("a.ply", big_endian_ply(64), 1, ""),
        ("a.ply", big_endian_ply(63), 0,
         ": expected more values at byte 224, found the end of the file: it is cut"),
        ("a.obj", "\ufeff" + V + "f 1 2 3\n", 1),
        ("a.obj", "  " + V + "  f 1/1/1 2/2/1 3/3/1 # it\n", 1),
        ("a.obj", V + "f -3 -2 \\\n -1\n", 1),
        ("a.obj", V + "v 1 1 0\nv 0.5 0.4 0\nf 1 5 2 4 3\n", 3),
        ("a.obj", V + "f 1 2 3\nsurf 0 1 0 1 1 2 3\n", 1,
         ": no scene can hold its free-form curves and surfaces"),
        ("a.obj", V + "f 1 2 3\ncall b.obj\n", 1, ": no scene can hold its calls of other files"),
        ("a.obj", V + "f 1//1 2//1 3//9\nvn 1 0 0\n", 1,
         ": faces come before their normals, which are made anew"),
        ("a.obj", V + "f 1 2 99\n", 0, ":4:7: expected a vertex from 1 to 3, or back from -1, found '99'"),
        ("a.obj", V + "f 0 1 2\n", 0, ":4:3: expected a vertex from 1 to 3, or back from -1, found '0'"),
        ("a.obj", V + "v -1.#IND 1 1\n", 0, ":4:3: expected a coordinate, found '-1.#IND'"),
        ("a.obj", V + "v 1 nan 1\n", 0, ":4:5: expected a coordinate, found 'nan'"),
        ("a.obj", V + "v 1 1\n", 0, ":4:6: expected three coordinates, found the end of the line"),
        ("a.obj", V + "f 1 2 3\nf 1 2\n", 1, ": no scene can hold its points and lines"),
        ("a.obj", "v 9 9 9\n" * 9 + V + "f 10 11 12\n", 1,
         ": its triangles use 3 of its 12 vertices: the others are not drawn"),
        ("a.obj", V.replace(" 0\n", " 0 255 128 0\n") + "f 1 2 3\n", 1,
         ": its colors reach to 255: 255 is taken for full, not 1", "255 128 0"),
        ("a.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 nan 0 0\nf 1 2 3\n", 1,
         PARTLY_COLORED + "\na.obj: it has colors that are negative or no numbers: they are left out", USUAL),
        ("a.gltf", "[" * 100000, 0,
         OTHER + "another, perhaps one that assimp reads: assimp export a.gltf a.glb converts it (Debian: "
         "assimp-utils)"),
        ("a.gltf", '{"a":' * 1000000, 0,
         ":1:5000001: expected JSON (unexpected end of input; expected '[', '{', or a literal), found the "
         "end of the file"),
        ("a.gltf", '{"a":' + "[" * 1000000 + "]" * 1000000 + "}", 0,
         ": expected glTF of version 2, found version ''"),
        ("a.gltf", '{"a":\n [1e999, 2]}', 0, ":2:3: expected JSON (numbers of doubles), found '1e999, 2]}'"),
        ("a.gltf", b'{"a": "x\xe9"}', 0,
         ":1:8: expected JSON (invalid string: ill-formed UTF-8 byte), found 'x\\xe9\"}'"),
        ("a.gltf", '{"asset": {"version": "2.0"}, "extensionsRequired": ["ACME_shape"]}', 0,
         ": expected extensions that are supported, found 'ACME_shape', which the file requires"),
        ("a.obj", "version https://git-lfs.github.com/spec/v1\n", 0,
         OTHER + "a Git LFS pointer, which stands for the model: git lfs pull gets it"),
        ("a.obj", b"\x1f\x8b\x08", 0, OTHER + "a file packed by gzip: zcat unpacks it"),
        ("a.obj", b"PK\x03\x04", 0, OTHER + "a ZIP archive: unzip unpacks it"),
        ("a.obj", V.encode("utf-16"), 0, OTHER + "text in UTF-16: iconv -f UTF-16 -t UTF-8 converts it"),
        ("a.obj", "\n<!DOCTYPE html><html>", 0, OTHER + "a page of HTML in place of the file"),
        *((name, text, 0, OTHER + "a program")
          for name, text in (("a.py", "import x\n"), ("a", "#!/bin/sh\n"))),
        ("a.dae", "<?xml version='1.0'?><COLLADA/>", 0, OTHER + "XML, such as COLLADA, X3D or AMF: assimp "
         "export a.dae a.glb converts it (Debian: assimp-utils)"))

    def expect(self, name, data, triangles, message="", color=None):
        with self.subTest(name=name, data=data[:80]):
            pathlib.Path(name).write_bytes(data if isinstance(data, bytes) else data.encode())
            done = run("mesh2scene", "--up-axis", "y", name)
            notes = done.stderr.decode().replace("mesh2scene: note: ", "").replace("mesh2scene: ", "")
            self.assertEqual(notes, f"{name}{message}\n" if message else "")
            self.assertEqual((done.returncode, done.stdout.count(b"triangle\n")),
                             (int(not triangles), triangles))
            if color:
                self.assertRegex(done.stdout.decode(), rf"\npaint {color}\n| 0 {color} 0 0 1\n")

    def test_files_of_people(self):
        for case in self.CASES:
            self.expect(*case)

    def test_mtl(self):
        model = "mtllib a.mtl\nusemtl m\n" + V + "f 1 2 3\n"
        for lines, color, message in (("Kd 0.8", "204 204 204", ""), ("Kd 0 0 0\nKe 15 9 0", "255 255 0", ""),
                                      ("Kd 0 0 0\nmap_Kd x.png", USUAL, ": no scene can hold its textures"),
                                      ("Kd 255 0 0", "255 0 0",
                                       ": its colors reach to 255: 255 is taken for full, not 1"),
                                      ("Kd 0 0 0\nodd words", "0 0 0",
                                       ": all of it is black: --color gives it another color")):
            pathlib.Path("a.mtl").write_text("newmtl m\n" + lines + "\n")
            self.expect("a.obj", model, 1, message, color)
        pathlib.Path("a.mtl").write_text("newmtl m\nKd 1 0 0\n")
        pathlib.Path("b c.mtl").write_text("newmtl m\nKd 1 0 0\n")
        pathlib.Path("b.mtl").write_text("newmtl n\n")
        for name in ("b c.mtl", '"b c.mtl"', "./b c.mtl", "b.mtl a.mtl"):
            self.expect("a.obj", model.replace("a.mtl", name), 1, "", "255 0 0")
        for name, message in (("c.mtl", "its material file 'c.mtl' is missing"),
                              ("c.mtl\nmtllib c.mtl", "its material file 'c.mtl' is missing"),
                              ("b.mtl", "its material 'm' is missing: its faces get the usual color")):
            self.expect("a.obj", model.replace("a.mtl", name), 1, ": " + message, USUAL)

    def test_gltf(self):
        def changed(**changes):
            mesh = Mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 0, 1)] * 3, [(0, 1, 2)])
            return {**json.loads(FORMATS["gltf"](mesh)), **changes}

        document = changed(extensionsRequired=["KHR_mesh_quantization"])
        document["buffers"].append({"byteLength": 18, "uri": "a%20b.bin"})
        pathlib.Path("a b.bin").write_bytes(struct.pack("<9h", 0, 0, 0, 32767, 0, 0, 0, 32767, 0))
        document["bufferViews"].append({"buffer": 1, "byteLength": 18})
        document["accessors"][0].update(bufferView=len(document["bufferViews"]) - 1, componentType=5122,
                                        normalized=True)
        self.expect("a.gltf", json.dumps(document), 1)
        self.assertIn("\n1 0 0 0 0 1\n", scene_of("a.gltf"))
        for far, reach in (({"zfar": 1000}, 0), ({}, 450)):
            camera = {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 1, **far}}
            document = changed(cameras=[camera], scenes=[{"nodes": [0, 1]}], nodes=[{"mesh": 0}, {
                "camera": 0, "translation": [0, 0, 300]}])
            pathlib.Path("a.gltf").write_text(json.dumps(document))
            self.assertRegex(
                run("mesh2scene", "a.gltf").stderr.decode(),
                "a.gltf: its own camera shows it on 0.0[0-9]* % of the picture: --eye-from 30 15 frames it")
            self.assertGreater(float(header(scene_of("a.gltf"))["projection"].split()[3]), reach)
        # A triangle cut by the far plane is seen, even if the corner beyond it comes first.
        document["nodes"][0]["matrix"] = [-50, 0, 598, 0, 50, 0, 598, 0, 0, 1, 0, 0, 0, -1, -300, 1]
        document["cameras"][0]["perspective"]["zfar"] = 400
        pathlib.Path("a.gltf").write_text(json.dumps(document))
        self.assert_quiet_success(run("mesh2scene", "a.gltf"))
        document = changed()
        for count, message in ((2, "whole indices below 2 in meshes[0], found 2"),
                               (4000000000, "4000000000 values in a view of 36 bytes, found the view's end")):
            document["accessors"][0]["count"] = count
            self.expect("a.gltf", json.dumps(document), 0, ": expected " + message)
        none = {"bufferView": 0, "componentType": 5121}
        document["accessors"][0] = {
            "componentType": 5126, "type": "VEC3", "count": 1400000, "sparse": {
                "count": 0, "indices": none, "values": none}}
        self.expect(
            "a.gltf", json.dumps(document), 0, ": expected at most 4 million numbers, and 16 for each "
            "byte of its files, found more in accessors[0]")
        hidden = {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}}
        self.expect("a.gltf", json.dumps(changed(nodes=[hidden])), 0,
                    ": expected a model with triangles, found none, but hidden nodes")
        # Primitives that differ in their materials are read once.
        paints = [{"pbrMetallicRoughness": {"baseColorFactor": [1, m % 2, 0]}} for m in range(5)]
        document = changed(materials=paints, nodes=[{"mesh": 0}, {"mesh": 1}], scenes=[{"nodes": [0, 1]}])
        shape = document["meshes"][0]["primitives"][0]
        document["accessors"].append({
            **document["accessors"][0], "type": "SCALAR", "count": 1000000, "sparse": {
                "count": 0, "indices": none, "values": none}})
        del document["accessors"][-1]["bufferView"]
        empty = {**shape, "mode": 5, "indices": len(document["accessors"]) - 1}
        drawn = [[{**empty, "material": n} for n in range(5)] + [{**shape, "material": m}] for m in (0, 1)]
        document["meshes"] = [{"primitives": primitives} for primitives in drawn]
        for color in ("255 0 0", "255 255 0"):
            self.expect("a.gltf", json.dumps(document), 2, "", color)
        document = changed()
        document["buffers"].append({"byteLength": 36, "uri": "c.bin"})
        pathlib.Path("c.bin").write_bytes(struct.pack("<9f", 2.5, 0, 0, 2.5, 0, 0, 2.5, 0, 0))
        document["bufferViews"].append({"buffer": 1, "byteLength": 36})
        document["accessors"].append(
            {**document["accessors"][0], "bufferView": len(document["bufferViews"]) - 1})
        document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = len(document["accessors"]) - 1
        self.expect("a.gltf", json.dumps(document), 1,
                    ": its colors reach to 2.5: they are drawn as 1, which is full", "255 0 0")
        document["accessors"].append({**document["accessors"][-1], "type": "SCALAR"})
        document["meshes"][0]["primitives"][0]["indices"] = len(document["accessors"]) - 1
        self.expect("a.gltf", json.dumps(document), 0,
                    ": expected whole indices below 3 in meshes[0], found 2.5")
        document = changed()
        document["accessors"].append({**document["accessors"][0], "count": 1})
        document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = len(document["accessors"]) - 1
        self.expect("a.gltf", json.dumps(document), 0,
                    ": expected 3 colors in COLOR_0, one for each vertex, found 1")


class Notes(ToolTest):
    def test_what_no_scene_can_hold(self):
        pathlib.Path("model.mtl").write_text("newmtl wood\nKd 1 1 1\nd 0.5\nmap_Kd wood.png\n")
        pathlib.Path("model.obj").write_text(
            "mtllib model.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\nl 1 2\n")
        done = run("mesh2scene", "--up-axis", "y", "model.obj")
        self.assertEqual(
            done.stderr.decode(),
            "mesh2scene: note: model.obj: no scene can hold its points and lines, textures or transparency\n")

    def test_which_way_is_up(self):
        pathlib.Path("box.obj").write_text(BOX)
        pathlib.Path("leaf.stl").write_text("solid\nfacet normal 0 0 1\nouter loop\nvertex -2 0.125 0\n"
                                            "vertex 1e9 0 3\nvertex 0 1e9 7\nendloop\nendfacet\nendsolid\n")
        for name, axis, box in (("box.obj", "y", "0 0 0 to 1 1 1"), ("leaf.stl", "z",
                                                                     "-2 0 0 to 1e+09 1e+09 7")):
            self.assertEqual(
                run("mesh2scene", name).stderr.decode(),
                f"mesh2scene: note: {axis} is taken for up, as in most {name[-3:].upper()} files (--up-axis "
                f"chooses); it reaches from {box} (--at looks elsewhere, --zoom closer)\n")
            self.assertEqual(run("mesh2scene", "--up-axis", "x", name).stderr.decode(), "")


if __name__ == "__main__":
    unittest.main()
