#!/usr/bin/env python3
"""Proofs by physics of what trace makes of light. What is expected comes from formulas of optics, written out
here.

usage: trace_light_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import math
import pathlib
import random
import re
import unittest

from toolbox import ToolTest, run
from vectors import dot, minus, unit

CAMERA = "perspective 60 1 0.1 1000\n"
EXACT = 1e-12


def distance(a, b):
    return math.dist(a, b)


def turned(p, angle, center=(0, 0, 0)):
    """The point turned about the x axis through a center, by an angle in radians."""
    x, y, z = minus(p, center)
    c, s = math.cos(angle), math.sin(angle)
    return (x + center[0], c * y - s * z + center[1], s * y + c * z + center[2])


def quad(a, b, c, d):
    """Two triangles, counterclockwise as the corners are."""
    return [(a, b, c), (a, c, d)]


def square(z, half=20.0, x=0.0, y=0.0):
    """A square that faces the eye."""
    return quad((x - half, y - half, z), (x + half, y - half, z), (x + half, y + half, z),
                (x - half, y + half, z))


def box(low, high):
    """Six sides that face outward."""
    (a, b, c), (d, e, f) = low, high
    return (quad((a, b, f), (d, b, f), (d, e, f), (a, e, f)) + quad(
        (d, b, c), (a, b, c), (a, e, c), (d, e, c)) + quad((a, b, c), (a, b, f), (a, e, f), (a, e, c)) + quad(
            (d, b, f), (d, b, c), (d, e, c), (d, e, f)) + quad(
                (a, e, f), (d, e, f), (d, e, c), (a, e, c)) + quad((a, b, c), (d, b, c), (d, b, f),
                                                                   (a, b, f)))


def turned_all(triangles, angle, center):
    return [tuple(turned(p, angle, center) for p in t) for t in triangles]


def scene(header, *objects, camera=CAMERA):
    """A text in view space of (triangles, color, material)."""
    lines = [camera + "attributes color material\n" + header]
    for triangles, color, material in objects:
        for triangle in triangles:
            lines += ["%r %r %r %s %d\n" % (*p, color, material) for p in triangle] + ["\n"]
    return "".join(lines)


MATT = "material 1 0 0 1\n"
GLASS = MATT + "material 0 0 0 1 0 1.5 0\n"  # material 1
WHITE, GRAY, BLACK = "255 255 255", "100 100 100", "0 0 0"
NUMBER = r"[-+.\de]+"
RAY = re.compile(
    rf"\d+,\d+: ( *)(\w+) weight ({NUMBER}) from ((?:{NUMBER} ?){{3}}) ?(cut)?"
    rf"(?:to (light \d+|nothing|(?:triangle|sphere) \d+)(?: (front|back) at ((?:{NUMBER} ?){{3}})| along "
    rf"((?:{NUMBER} ?){{3}}))? ?brings ((?:{NUMBER} ?){{3}}))?$")


class Ray:
    def __init__(self, line):
        match = RAY.match(line)
        assert match, line
        vector = lambda text: tuple(map(float, text.split())) if text else None  # noqa: E731
        self.depth, self.kind, self.weight = len(match[1]) // 2, match[2], float(match[3])
        self.origin, self.is_cut, self.target, self.side = vector(
            match[4]), match[5] is not None, match[6], match[7]
        self.point, self.along, self.brought = vector(match[8]), vector(match[9]), vector(match[10])

    @property
    def direction(self):
        return self.along or unit(minus(self.point, self.origin))


class LightTest(ToolTest):
    def trace(self, text, *options, size="9x9"):
        done = run("trace", "--size", size, "-o", "out.ppm", "--z-buffer", "none", *options, stdin=text)
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        return done.stderr.decode()

    def picture(self, text, *options, size="9x9"):
        """The pixels, as tuples, row after row."""
        self.trace(text, *options, size=size)
        data = pathlib.Path("out.ppm").read_bytes().split(b"\n", 3)[3]
        return [tuple(data[i:i + 3]) for i in range(0, len(data), 3)]

    def rays(self, text, *options, pixel="4,4", size="9x9"):
        lines = [
            line for line in self.trace(text, "--probe", pixel, *options, size=size).splitlines()
            if line.startswith(pixel + ":")]
        return [Ray(line) for line in lines]

    def only(self, rays, kind, depth):
        found = [ray for ray in rays if (ray.kind, ray.depth) == (kind, depth)]
        self.assertEqual(len(found), 1, [vars(ray) for ray in rays])
        return found[0]

    def assert_near(self, found, expected, error=EXACT):
        if isinstance(expected, tuple):
            self.assertEqual(len(found), len(expected))
            for a, b in zip(found, expected):
                self.assert_near(a, b, error)
        else:
            self.assertLessEqual(abs(found - expected), error * max(1, abs(expected)), (found, expected))


def snell(angle, index):
    return math.asin(math.sin(angle) / index)


def fresnel(outside, inside):
    """Unpolarized, of the angles on either side, both above 0: s by sines, p by tangents (A. Fresnel,
    1823)."""
    s = math.sin(outside - inside) / math.sin(outside + inside)
    p = math.tan(outside - inside) / math.tan(outside + inside)
    return (s * s + p * p) / 2


class Refraction(LightTest):
    def slab(self, angle, index, thickness=2.0):
        """A tilted slab in front of a wall, in the middle of the picture."""
        center = (0, 0, -10)
        slab = turned_all(box((-9, -9, -10 - thickness / 2), (9, 9, -10 + thickness / 2)), angle, center)
        return scene(MATT + f"material 0 0 0 1 0 {index!r} 0\n", (square(-40.0, 99), GRAY, 0),
                     (slab, BLACK, 1))

    def test_follows_snell_and_leaves_a_slab_displaced(self):
        thickness = 2.0
        for index in (1.1, 1.5, 2.4):
            for degrees in (5, 30, 56, 75):
                angle = math.radians(degrees)
                with self.subTest(index=index, degrees=degrees):
                    rays = self.rays(self.slab(angle, index), "--max-depth", "2")
                    inside = self.only(rays, "refracted", 1)
                    outside = next(ray for ray in rays if ray.kind == "refracted" and ray.depth == 2)
                    normal = turned((0, 0, 1), angle)
                    bent = snell(angle, index)
                    self.assert_near(math.acos(-dot(inside.direction, normal)), bent, 1e-9)
                    self.assert_near(dot(inside.direction, normal), -math.cos(bent))
                    along = turned((0, 1, 0), angle)  # the ray stays on its side of the normal
                    self.assert_near(
                        dot(inside.direction, along) * math.copysign(1, dot((0, 0, -1), along)),
                        math.sin(bent))
                    self.assert_near(outside.direction, (0.0, 0.0, -1.0))
                    displaced = thickness * math.sin(angle - bent) / math.cos(bent)
                    self.assert_near(math.hypot(outside.point[0], outside.point[1]), displaced, 1e-11)

    def test_fresnel_of_any_angle_and_of_brewsters(self):
        for index in (1.2, 1.5, 2.4):
            brewster = math.atan(index)
            for angle in (0.2, 0.7, brewster, 1.4):
                with self.subTest(index=index, angle=angle):
                    rays = self.rays(self.slab(angle, index), "--max-depth", "1", "--min-contribution", "0")
                    mirrored = self.only(rays, "mirrored", 1)
                    # At Brewster's angle the two directions are perpendicular, and only s is left, which is
                    # cos(2 i)^2 / 2.
                    expected = math.cos(2 * angle)**2 / 2 if angle == brewster else fresnel(
                        angle, snell(angle, index))
                    self.assert_near(mirrored.weight, expected)
                    self.assert_near(self.only(rays, "refracted", 1).weight, 1 - expected)

    def pane_from_behind(self, angle, index=1.5):
        """The eye is inside: it sees the back of a tilted pane."""
        pane = [t[::-1] for t in turned_all(square(-5.0, 4), angle, (0, 0, -5))]
        return scene(MATT + f"material 0 0 0 1 0 {index!r} 0\n", (pane, BLACK, 1))

    def test_all_is_reflected_beyond_the_critical_angle(self):
        for index in (1.2, 1.5, 2.4):
            critical = math.asin(1 / index)
            for offset in (-1e-3, -1e-9, 1e-9, 1e-3, 0.3):
                with self.subTest(index=index, offset=offset):
                    rays = self.rays(self.pane_from_behind(critical + offset, index), "--min-contribution",
                                     "0")
                    mirrored = self.only(rays, "mirrored", 1).weight
                    if offset > 0:
                        self.assertEqual(mirrored, 1)
                        self.assertFalse([ray for ray in rays if ray.kind == "refracted"])
                    else:
                        self.assertLess(mirrored, 1)
                        self.assert_near(self.only(rays, "refracted", 1).weight, 1 - mirrored)

    def test_a_ray_can_be_reversed(self):
        for angle in (0.1, 0.5, 0.9, 1.3):
            into = self.rays(self.slab(angle, 1.5), "--max-depth", "1", "--min-contribution", "0")
            out = self.rays(self.pane_from_behind(snell(angle, 1.5)), "--max-depth", "1",
                            "--min-contribution", "0")
            self.assert_near(
                self.only(into, "mirrored", 1).weight,
                self.only(out, "mirrored", 1).weight, 1e-11)

    def test_index_1_and_alpha_0_change_nothing(self):
        rng = random.Random(1)
        things = [(square(-12.0, 6), "200 150 90", 0)]
        for _ in range(12):
            x, y, z = rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-10, -6)
            things.append((turned_all(box((x, y, z), (x + 1, y + 0.7, z + 1.2)), rng.uniform(0, 3),
                                      (x, y, z)), "%d %d 255" % (200 + x * 9, 90 + y * 9), 0))
        air = (turned_all(box((-2.5, -2.5, -8), (2.5, 1.5, -4)), 0.4, (0, 0, -6)), BLACK, 1)
        header = ("light 3 9 -1 0.9 0.9 0.8\nambient 0.1 0.1 0.1\nmaterial 1 1 0.4 20\nmaterial 1 1 1 5 "
                  "0.7 1 0\n")
        self.assertEqual(self.picture(scene(header, *things, air), size="60x60"),
                         self.picture(scene(header, *things), size="60x60"))

    def test_two_slabs_of_index_1_are_one_of_both_thicknesses(self):
        """Of index 1 they only absorb: exp(-a d), by Beer and Lambert."""
        absorption = (0.3, 0.05, 1.7)
        header = MATT + "material 0 0 0 1 0 1 0\nabsorption %r %r %r\n" % absorption
        wall = (square(-40.0, 99), WHITE, 0)

        def slabs(*ends):
            return scene(header, wall, *((box((-9, -9, far), (9, 9, near)), BLACK, 1) for near, far in ends))

        one = self.rays(slabs((-5.0, -7.0)))[0].brought
        two = self.rays(slabs((-5.0, -5.5), (-10.0, -11.5)))[0].brought
        expected = tuple(255 * math.exp(-a * 2) for a in absorption)
        self.assert_near(one, expected)
        self.assert_near(two, expected)
        self.assertEqual(self.picture(slabs((-5.0, -7.0)))[40], tuple(round(c) for c in expected))

    def test_units_are_free(self):
        """A scene that is twice as large and absorbs half as much looks the same, to the byte, as does any
        power of 2."""
        pictures = set()
        for scale in (1, 2, 2**-10, 2**30):
            glass = turned_all(box((-2, -2, -8), (2, 1.5, -5)), 0.5, (0, 0, -6))
            header = (
                "light %r %r %r 1 1 1\nbackground 20 30 60\nmaterial 0.2 1 0.5 9\nmaterial 1 1 1 30 0.1 1.5 "
                "0.1\nabsorption %r 0 %r\n" %
                (3.0 * scale, 5.0 * scale, 1.0 * scale, 0.4 / scale, 0.1 / scale))
            objects = [(square(-9.0, 4), "220 200 150", 0), (glass, "90 200 250", 1)]
            larger = [([tuple(tuple(x * scale for x in p) for p in t) for t in ts], color, m)
                      for ts, color, m in objects]
            pictures.add(
                tuple(
                    self.picture(
                        scene(header, *larger,
                              camera="perspective 60 1 %r %r\n" % (0.125 * scale, 64.0 * scale)),
                        size="50x50")))
        self.assertEqual(len(pictures), 1)


class Mirrors(LightTest):
    def test_weigh_as_the_formula_says(self):
        reflectance, alpha = 0.3, 0.6
        # Index 1: F = 0. The mirror faces the eye, and shows what is behind it.
        header = MATT + f"material 1 0 0 1 {reflectance} 1 {alpha}\n"
        behind = [t[::-1] for t in square(7.0, 50)]
        text = scene(header, (square(-9.0, 50), "10 20 30", 0), (behind, "100 0 200", 0),
                     (square(-4.0, 3), "40 250 80", 1))
        expected = tuple(alpha * ((1 - reflectance) * own + reflectance * mirrored) + (1 - alpha) * through
                         for own, mirrored, through in zip((40, 250, 80), (100, 0, 200), (10, 20, 30)))
        rays = self.rays(text)
        self.assert_near(rays[0].brought, expected)
        self.assert_near(self.only(rays, "mirrored", 1).weight, alpha * reflectance)
        self.assert_near(self.only(rays, "mirrored", 1).point, (0.0, 0.0, 7.0))
        self.assertEqual(self.picture(text)[40], tuple(round(c) for c in expected))
        self.assertEqual(self.picture(text, "--no-recursion")[40], (40, 250, 80))
        self.assertEqual(
            self.picture(text, "--max-depth", "0")[40],
            tuple(round(alpha * (1 - reflectance) * own) for own in (40, 250, 80)))

    def test_two_mirrors_end_by_contribution(self):
        """Between parallel mirrors of reflectance R, ray n weighs R^n: the last is the last of at least E."""
        header = "material 1 0 0 1 0.9 1 1\n"
        text = scene(header, (square(-4.0, 50), BLACK, 0), ([t[::-1] for t in square(4.0, 50)], WHITE, 0))
        for least in (0.5, 1 / 510, 1e-4):
            rays = self.rays(text, "--min-contribution", repr(least), "--max-depth", "1000")
            weights = [ray.weight for ray in rays if not ray.is_cut]
            self.assertEqual(len(weights), 1 + int(math.log(least) / math.log(0.9)))
            self.assertTrue(rays[-1].is_cut)
        self.assertEqual(len(self.rays(text, "--max-depth", "7")), 9)

    def test_show_highlights_as_an_eye_at_the_end_of_the_way_sees_them(self):
        """Unfolded at mirrors that face the eye, the way is straight; J. Blinn's (n.h)^N is that of the eye's
        image."""
        mirror, shiny, shininess = 1, 2, 5
        lamp, triangle = (1.0, 3.0, 1.5), lambda z: ((-40.0, -50.0, z), (60.0, -50.0, z), (-10.0, 70.0, z))
        header = "light %r %r %r 1 1 1\nmaterial 0 0 0 1\nmaterial 0 0 0 1 1 1 1\nmaterial 0 0 0.9 %d\n" % (
            *lamp, shininess)
        one = [(square(-4.0, 2.2), BLACK, mirror), ([triangle(7.0)[::-1]], BLACK, shiny)]
        # Up to the one, down to the other behind the eye, and past the first to the wall.
        two = [(square(-4.0, 1), BLACK, mirror), ([t[::-1] for t in square(2.0, 9)], BLACK, mirror),
               ([triangle(-9.0)], BLACK, shiny)]
        slope = 2 / 9 * 0.5  # of pixel (4, 3) of 9 x 9 in a window from -0.5 to 0.5 at distance 1
        cameras = (("perspective %r 1 0.1 100\n" % (2 * math.degrees(math.atan(0.5))), True),
                   ("ortho -9 9 -9 9 0.1 100\n", False))
        for camera, is_perspective in cameras:
            for objects, wall, normal, image in ((one, 7.0, 1, -8.0), (two, -9.0, -1, 12.0)):
                if not is_perspective and objects is two:
                    continue  # a parallel ray comes back on its own way
                height = slope * abs(wall - image) if is_perspective else 2.0
                hit, center = (0.0, height, wall), tuple(sum(c) / 3 for c in zip(*triangle(wall)))
                for model, point in (("phong", hit), ("flat", center)):
                    to_eye = unit(minus(
                        (0.0, 0.0, image), point)) if is_perspective else (0.0, 0.0, -float(normal))
                    to_light = unit(minus(lamp, point))
                    half = unit(tuple(a + b for a, b in zip(to_light, to_eye)))
                    cosine = dot(half, (0.0, 0.0, -float(normal)))
                    expected = 255 * 0.9 * cosine**shininess
                    self.assertGreater(expected, 1)
                    with self.subTest(is_perspective=is_perspective, mirrors=len(objects) - 1, model=model):
                        [primary, *rest] = self.rays(scene(header, *objects, camera=camera), "--shading",
                                                     model, pixel="4,3")
                        self.assert_near([ray for ray in rest if ray.kind == "mirrored"][-1].point, hit, 1e-9)
                        self.assert_near(primary.brought, (expected,) * 3, 1e-9)

    def test_send_a_ray_of_just_the_least_contribution(self):
        """Cut is what brings less. Powers of 1/2 are exact."""
        text = scene("material 1 0 0 1 0.5 1 1\n", (square(-4.0, 50), BLACK, 0),
                     ([t[::-1] for t in square(4.0, 50)], WHITE, 0))
        rays = self.rays(text, "--min-contribution", "0.25")
        self.assertEqual([(ray.weight, ray.is_cut) for ray in rays], [(1, False), (0.5, False), (0.25, False),
                                                                      (0.125, True)])


class Shadows(LightTest):
    def test_fall_where_lines_to_the_light_are_blocked(self):
        light, half, height = (4.0, 3.0, -2.0), 1.0, -6.0
        header = "light %r %r %r 1 1 1\nmaterial 0 1 0 1\n" % light
        text = scene(header, (square(-10.0, 50), WHITE, 0), (square(height, half), GRAY, 0),
                     camera="ortho -8 8 -8 8 1 50\n")
        size = 64
        dark = [color == (0, 0, 0) for color in self.picture(text, size=f"{size}x{size}")]
        checked = 0
        for row in range(size):
            for column in range(size):
                x, y = -8 + 16 * (column + 0.5) / size, 8 - 16 * (row + 0.5) / size
                if max(abs(x), abs(y)) < half + 0.2:  # the square itself
                    continue
                part = (height - -10.0) / (light[2] - -10.0)  # of the way from the wall to the light
                reach = max(abs(x + part * (light[0] - x)), abs(y + part * (light[1] - y)))
                if abs(reach - half) < 1e-6:
                    continue
                self.assertEqual(dark[row * size + column], reach < half, (row, column))
                checked += dark[row * size + column]
        self.assertGreater(checked, 50)

    def test_of_clear_things_are_dimmed_by_the_angle_outside(self):
        """The same part is lost where light enters and where it leaves, however oblique: no light is caught
        inside."""
        index, alpha, absorption = 1.5, 0.1, (0.2, 0.4, 0.0)
        slab, lamp = box((-99, -99, -5), (99, 99, -3.5)), (9 * math.sqrt(3), 0.0, -1.0)
        text = "light %r %r %r 1 1 1\nmaterial 0 1 0 1\nmaterial 0 1 0 1 0 %r %r\nabsorption %r %r %r\n"
        # The line from (0, 0, -10) passes a ball's middle at 5 sin(a); 1.5 of its radius of 2 is beyond the
        # critical angle.
        radius, sine = 2.0, 0.3
        ball = "sphere\n" + "".join(f"{x} {y} {z} 0 0 0 1\n"
                                    for x, y, z in ((0, 0, -5), (radius, 0, -5), (0, radius, -5),
                                                    (0, 0, radius - 5))) + "\n"
        beside = (9 * sine / math.sqrt(1 - sine * sine), 0.0, -1.0)
        angle_of_ball = math.asin(5 * sine / radius)
        for light, objects, more, angle, length in ((lamp, [
            (slab, BLACK, 1)], "", math.radians(60), 1.5 / math.cos(math.radians(60))),
                                                    (beside, [], ball, angle_of_ball,
                                                     2 * radius * math.cos(angle_of_ball))):
            rays = self.rays(
                scene(text % (*light, index, alpha, *absorption), (square(-10.0, 50), WHITE, 0), *objects) +
                more)
            shadow = [
                ray for ray in rays
                if ray.kind == "shadow" and abs(ray.origin[2] +
                                                10) < 1e-9 and math.hypot(*ray.origin[:2]) < 1e-9][0]
            through = (1 - alpha) * (1 - fresnel(angle, snell(angle, index)))
            self.assert_near(shadow.brought, tuple(through**2 * math.exp(-a * length) for a in absorption),
                             1e-9)

    def test_of_clear_things_are_full_without_recursion(self):
        """ALPHA counts as 1 then. The lamp stands at 45 degrees, behind a pane that the pixel does not
        show."""
        text = scene("light 0 9 -1 1 1 1\nmaterial 0 1 0 1\nmaterial 0 1 0 1 0 1.5 0\n",
                     (square(-10.0, 50), WHITE, 0), (square(-5.0, 1, y=5.0), BLACK, 1))
        lit, angle = 255 * math.sqrt(0.5), math.radians(45)
        for options, part in (((), 1 - fresnel(angle, snell(angle, 1.5))), (("--no-recursion",), 0.0),
                              (("--no-recursion", "--no-shadows"), 1.0)):
            self.assertEqual(
                self.picture(text, "--shading", "phong", *options)[40], (round(lit * part),) * 3, options)

    def test_of_a_lamp_inside_of_glass_are_dimmed_on_the_way_out(self):
        """By exp(-a r) in a ball, or from the middle of a slab, and by one surface."""
        absorption, reach = (0.5, 0.2, 0.0), 2.0
        header = (
            CAMERA +
            "attributes color material\nlight 0 0 -5 1 1 1\nmaterial 0 1 0 1\nmaterial 0 1 0 1 0 1.5 0\n"
            "absorption %r %r %r\n" % absorption)
        wall = "".join(
            "%r %r %r 255 255 255 0\n" % p + "\n" * (i == 2) for i, p in enumerate(square(-10.0, 50)[0]))
        ball = "sphere\n" + "".join(f"{x} {y} {z} 0 0 0 1\n"
                                    for x, y, z in ((0, 0, -5), (reach, 0, -5), (0, reach, -5),
                                                    (0, 0, reach - 5))) + "\n"
        slab = "".join("%r %r %r 0 0 0 1\n" % p + "\n" * (i == 2)
                       for t in box((-9, -9, -5 - reach), (9, 9, -5 + reach)) for i, p in enumerate(t))
        expected = tuple(0.96 * math.exp(-a * reach) for a in absorption)
        for thing in (ball, slab):
            rays = self.rays(header + wall + thing)
            shadow = [
                ray for ray in rays
                if ray.kind == "shadow" and abs(ray.origin[2] +
                                                10) < 1e-9 and math.hypot(*ray.origin[:2]) < 1e-9][0]
            self.assert_near(shadow.brought, expected, 1e-9)

    def test_are_cast_by_what_the_eye_does_not_see(self):
        header = "light 0 0 5 1 1 1\nmaterial 0 1 0 1\n"
        wall = (square(-10.0, 50), WHITE, 0)
        behind = (square(2.0, 50), GRAY, 0)
        self.assertNotIn((0, 0, 0), self.picture(scene(header, wall)))
        self.assertEqual(set(self.picture(scene(header, wall, behind))), {(0, 0, 0)})
        self.assertNotIn((0, 0, 0), self.picture(scene(header, wall, behind), "--no-shadows"))

    def test_do_not_fall_on_what_casts_them(self):
        """No surface shades itself, nor its neighbors in one plane or on a bulge, near the origin or far
        away."""
        rng = random.Random(2)
        for size in (1e-6, 1, 1e6):
            for bulge in (0.0, 0.02):
                places = [[(i + rng.uniform(-0.4, 0.4), k + rng.uniform(-0.4, 0.4)) for i in range(-10, 11)]
                          for k in range(-10, 11)]
                points = [[(x * size, y * size, (-30 + 0.4 * x - bulge * (x * x + y * y)) * size)
                           for x, y in row] for row in places]
                mesh = [
                    t for low, high in zip(points, points[1:])
                    for a, b, c, d in zip(low, low[1:], high[1:], high) for t in quad(a, b, c, d)]
                header = "light %r %r %r 1 1 1\nmaterial 0.1 1 0.5 7\n" % (4 * size, 5 * size, 3 * size)
                text = scene(header, (mesh, WHITE, 0), camera="perspective 50 1 %r %r\n" % (size, 100 * size))
                with self.subTest(size=size, bulge=bulge):
                    self.assertEqual(self.picture(text, size="80x80"),
                                     self.picture(text, "--no-shadows", size="80x80"))


class Spheres(LightTest):
    """What is true of light at any surface, on one that is curved, near and far, small and large."""
    def sphere(self, center, *axes):
        axes = axes if len(axes) == 3 else [tuple(axes[0] * (i == k) for i in range(3)) for k in range(3)]
        points = [center, *(tuple(c + a for c, a in zip(center, axis)) for axis in axes)]
        return "sphere\n" + "".join("%r %r %r %s %d\n" % (*p, WHITE, 1) for p in points) + "\n"

    def test_do_not_shade_themselves(self):
        """The side that faces a light is in no shadow, as they are convex; the sphere beside is too far
        away."""
        axes = ((2.0, 0.5, 0.1), (-0.3, 1.0, 0.2), (0.0, 0.1, 0.4))
        for size in (1e-6, 1, 1e6):
            for center, shape in (((0.2, 0.1, -6.0), (2.0,)), ((0.2, 0.1, -6.0), axes), ((0.0, -1e5, -3.0),
                                                                                         (1e5 - 0.5,))):
                lights = "light %r %r %r 1 1 1\n" * 2 % tuple(k * size for k in (9, 7, -5, -3, 1, 1))
                header = lights + "material 0 1 0 1\nmaterial 0.1 1 0.5 7\n"
                shape = [tuple(x * size for x in axis)
                         for axis in shape] if len(shape) == 3 else [shape[0] * size]
                text = scene(header, camera="perspective 50 1 %r %r\n" %
                             (size, 100 * size)) + self.sphere(tuple(c * size for c in center), *shape)
                with self.subTest(size=size, center=center, axes=len(shape)):
                    lit = self.picture(text, "--no-shadows", size="90x90")
                    self.assertGreater(len(set(lit)), 100)
                    self.assertEqual(self.picture(text, size="90x90"), lit)

    def test_bend_rays_by_snell_and_dim_them_along_the_chord(self):
        """In at an angle i, out at the same one, turned by 2 (i - r); inside is a chord of 2 R cos r."""
        radius, absorption = 2.0, 0.3
        for index in (1.2, 1.5, 2.4, 0.8):
            header = (f"background 255 255 255\n{MATT}material 0 0 0 1 0 {index!r} 0\nabsorption "
                      f"{absorption} 0 0\n")
            for part in (0.0, 0.3, 0.6, 0.75):  # sin i
                text = scene(header, camera="ortho -1 1 -1 1 1 30\n") + self.sphere(
                    (-part * radius, 0.0, -9.0), radius)
                rays = self.rays(text, "--max-depth", "2", "--min-contribution", "0", pixel="0,0", size="1x1")
                angle = math.asin(part)
                bent = snell(angle, index)
                inside = self.only(rays, "refracted", 1)
                outside = next(ray for ray in rays if ray.kind == "refracted" and ray.depth == 2)
                with self.subTest(index=index, part=part):
                    self.assertEqual(inside.side, "back")
                    chord = distance(inside.origin, inside.point)
                    self.assert_near(chord, 2 * radius * math.cos(bent), 1e-9)
                    self.assert_near(dot(inside.direction, (0, 0, -1)), math.cos(angle - bent), 1e-9)
                    self.assertEqual(outside.target, "nothing")
                    reflected = fresnel(angle, bent) if part else ((index - 1) / (index + 1))**2
                    self.assert_near(inside.weight, 1 - reflected, 1e-9)
                    self.assert_near(outside.weight, (1 - reflected)**2,
                                     1e-9)  # that of blue, which nothing absorbs
                    mirrored = [ray for ray in rays if ray.kind == "mirrored" and ray.depth == 2]
                    self.assertTrue(all(
                        ray.side == "back" or ray.is_cut for ray in mirrored))  # it stays inside
                    red, blue = inside.brought[0], inside.brought[2]
                    self.assertLess(red, blue)
                    self.assert_near(red / math.exp(-absorption * chord), 255 * (1 - reflected), 1e-9)

    def test_are_seen_from_within(self):
        """The eye is 7 before the surface of clear matter and 13 from that behind it."""
        absorption = 0.1
        text = scene(f"background 255 255 255\n{GLASS}absorption {absorption} 0 0\n") + self.sphere(
            (0.0, 0.0, 3.0), 10.0)
        [primary, *rest] = self.rays(text, "--max-depth", "1")
        self.assertEqual((primary.target, primary.side), ("sphere 0", "back"))
        self.assert_near(primary.point, (0.0, 0.0, -7.0))
        self.assert_near(primary.brought, (255 * 0.96 * math.exp(-absorption * 7), 255 * 0.96, 255 * 0.96))
        mirrored = self.only(rest, "mirrored", 1)
        self.assertEqual((mirrored.side, mirrored.target), ("back", "sphere 0"))
        self.assert_near(mirrored.point, (0.0, 0.0, 13.0))
        self.assertEqual(self.only(rest, "refracted", 1).target, "nothing")
        # A mirror within sends the ray to the other side, over 4 + 13.
        mirror = (square(-4.0, 3), BLACK, 2)
        text = scene(f"{GLASS}absorption {absorption} 0 0\nmaterial 1 0 0 1 1 1 1\n", mirror) + self.sphere(
            (0.0, 0.0, 3.0), 10.0)
        mirrored = self.only(self.rays(text, "--max-depth", "2", "--background", "ffffff"), "mirrored", 1)
        self.assertEqual((mirrored.side, mirrored.target), ("back", "sphere 2"))
        self.assert_near(mirrored.point, (0.0, 0.0, 13.0))
        self.assert_near(mirrored.brought, (255 * 0.96 * math.exp(-absorption * 17), 255 * 0.96, 255 * 0.96))

    def test_that_are_stretched_mirror_about_their_gradient(self):
        """Of (x / a)^2 + (y / b)^2 + (z / c)^2 = 1 that is (x / a^2, y / b^2, z / c^2), however the half axes
        are ordered."""
        a, b, c = 2.0, 1.0, 0.5
        axes = [(a, 0.0, 0.0), (0.0, b, 0.0), (0.0, 0.0, c)]
        x, y = 0.6 * a, 0.48 * b
        z = 0.64 * c  # 0.36 + 0.2304 + 0.4096 = 1
        normal = unit((x / a**2, y / b**2, z / c**2))
        expected = tuple(d + 2 * normal[2] * n for d, n in zip((0.0, 0.0, -1.0), normal))
        for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (1, 0, 2)):
            text = scene(MATT + "material 1 0 0 1 1 1 1\n", camera="ortho -1 1 -1 1 1 30\n") + self.sphere(
                (-x, -y, -9.0), *(axes[i] for i in order))
            mirrored = self.only(self.rays(text, pixel="0,0", size="1x1"), "mirrored", 1)
            self.assert_near(mirrored.origin, (0.0, 0.0, z - 9))
            self.assert_near(mirrored.along, expected)

    def test_in_a_white_furnace_are_white(self):
        header = "background 255 255 255\nmaterial 1 0 0 1 0 1 1\nmaterial 1 0 0 1 0.5 1.5 0.2\n"
        text = scene(header) + self.sphere((-1.0, 0.0, -6.0), 1.2) + self.sphere(
            (1.4, 0.3, -7.0), (1.0, 0.3, 0.0), (-0.2, 0.6, 0.1), (0.0, 0.2, 1.4))
        self.assertEqual(
            set(self.picture(text, "--min-contribution", "1e-7", "--max-depth", "200", size="40x40")),
            {(255, 255, 255)})


class Energy(LightTest):
    def furnace(self):
        """Clear and mirroring things in front of nothing but white; the matt parts are as white."""
        rng = random.Random(5)
        header = ("background 255 255 255\nmaterial 1 0 0 1 0 1 1\nmaterial 1 0 0 1 0.5 1.5 0\nmaterial 1 0 "
                  "0 1 0.8 2.4 0.3\nmaterial 1 0 0 1 1 1 1\n")
        things = []
        for i in range(8):
            x, y, z = -3 + 2 * (i % 4), -2 + 2 * (i // 4), -8 - 0.3 * i
            things.append((turned_all(box((x, y, z), (x + 1.2, y + 1.1, z + 0.9)), rng.uniform(0, 3),
                                      (x + 0.6, y + 0.5, z)), WHITE, i % 4))
        return scene(header, *things)

    def test_is_neither_made_nor_lost(self):
        text = self.furnace()
        whole = self.picture(text, "--min-contribution", "1e-7", "--max-depth", "200", size="40x40")
        self.assertEqual(set(whole), {(255, 255, 255)})

    def test_what_is_cut_is_reported(self):
        text = self.furnace()
        for options in ((), ("--min-contribution", "0.05"), ("--max-depth", "2")):
            report = self.trace(text, "--timing", *options, size="40x40")
            most = float(re.search(r"rays cut, at most (\S+) of a pixel's color", report)[1])
            darkest = min(min(color) for color in self.picture(text, *options, size="40x40"))
            self.assertLessEqual(255 - darkest, 255 * most * 1.01 + 0.5, options)
            self.assertGreater(255 - darkest, 255 * most * 0.99 - 1, options)

    def test_what_is_cut_goes_nowhere_else(self):
        """Of a pane straight on, the smaller of F and 1 - F is cut: what is left is as before, and the
        smaller is reported."""
        for index, expected, missing in ((1.5, 0.96 * 100, 0.04), (9.0, 0.64 * 200, 0.36)):
            text = scene("background 200 200 200\n" + MATT + f"material 1 0 0 1 0 {index!r} 0\n",
                         (square(-20.0, 99), GRAY, 0), (square(-5.0, 99), BLACK, 1))
            options = ("--min-contribution", "0.5")
            self.assert_near(self.rays(text, *options)[0].brought, (expected,) * 3)
            report = self.trace(text, "--timing", *options, size="1x1")
            self.assert_near(float(re.search(r"rays cut, at most (\S+) of a pixel's color", report)[1]),
                             missing, 1e-2)
        # Neither does a surface show more of its own.
        text = scene("background 200 200 200\nmaterial 1 0 0 1 0.25 1 1\n", (square(-5.0), GRAY, 0))
        self.assert_near(self.rays(text, "--min-contribution", "0.5")[0].brought, (75.0,) * 3)

    def test_rays_out_of_colored_glass_weigh_what_its_clearest_color_leaves(self):
        text = scene("background 255 255 255\n" + GLASS + "absorption 0.5 0.3 0.9\n", (box(
            (-9, -9, -11), (9, 9, -9)), BLACK, 1))
        weight = 0.96**2 * math.exp(-0.3 * 2)
        for least, is_cut in ((0.999 * weight, False), (1.001 * weight, True)):
            outside = self.only(self.rays(text, "--min-contribution", repr(least)), "refracted", 2)
            self.assert_near(outside.weight, weight)
            self.assertEqual(outside.is_cut, is_cut)

    def test_rays_are_turned_as_often_as_allowed(self):
        """Mirrored or refracted: in a slab, either kind comes at any depth."""
        text = scene("background 255 255 255\n" + GLASS, (box((-9, -9, -11), (9, 9, -9)), BLACK, 1))
        for most in range(5):
            rays = self.rays(text, "--max-depth", str(most), "--min-contribution", "0")
            for kind in ("mirrored", "refracted"):
                found = {(ray.depth, ray.is_cut) for ray in rays if ray.kind == kind}
                self.assertEqual(found, {(depth, depth > most) for depth in range(1, most + 2)}, (kind, most))
        # Straight through both sides; what is mirrored at the first one shows the background, too.
        for most, expected in ((0, 0.0), (1, 0.04), (2, 0.04 + 0.96**2)):
            self.assert_near(self.rays(text, "--max-depth", str(most))[0].brought, (255 * expected,) * 3)

    def test_rays_of_a_probe_add_up(self):
        """What a ray brings is its own part and, by their shares, that of the rays it sends."""
        rays = self.rays(self.furnace(), "--min-contribution", "1e-7", "--max-depth", "60", pixel="12,20",
                         size="40x40")
        self.assert_near(rays[0].brought, (255.0, 255.0, 255.0), 1e-4)
        for ray in rays:
            self.assertLessEqual(ray.weight, 1)


class Reports(LightTest):
    TEXT = scene("light 0 0 -1 1 1 1\nmaterial 1 1 0 1\nmaterial 1 1 0 1 0.5 1 1\n", (square(-9.0), WHITE, 0),
                 (square(-5.0, 2), WHITE, 1))

    def test_statistics_count_rays_of_each_kind(self):
        lines = dict(line.split() for line in self.trace(self.TEXT, "--stats", "/dev/stderr").splitlines())
        # 5 x 5 of the 9 x 9 pixels show the mirror, as 2 of 5 sin 30 / cos 30 is 0.69; behind the eye there
        # is nothing.
        seen = sum((2 * (k + 0.5) / 9 - 1) * math.tan(math.radians(30)) * 5 < 2 and (2 * (k + 0.5) / 9 - 1) *
                   math.tan(math.radians(30)) * 5 > -2 for k in range(9))**2
        self.assertEqual((lines["primary_rays"], lines["shadow_rays"], lines["mirrored_rays"],
                          lines["refracted_rays"], lines["cut_rays"]), ("81", "81", str(seen), "0", "0"))
        lines = dict(line.split() for line in self.trace(self.TEXT, "--stats", "/dev/stderr",
                                                         "--no-recursion", "--no-shadows").splitlines())
        self.assertNotIn("shadow_rays", lines)

    def test_timing_names_rays_of_each_kind(self):
        self.assertRegex(
            self.trace(self.TEXT, "--timing"),
            r"8\.1e-05 million primary rays at \S+ million a second, 8\.1e-05 million shadow rays at \S+ "
            r"million a second, \S+ million mirrored rays at \S+ million a second\n\Z")

    def test_zbuf_notes_what_it_does_not_draw(self):
        note = ("zbuf: note: mirrors and glass are drawn as matte and opaque; trace, in place of project and "
                "zbuf, follows the light\n")
        ndc = run("project", stdin=self.TEXT).stdout
        self.assertEqual(run("zbuf", "--size", "9x9", "-o", "drawn.ppm", stdin=ndc).stderr.decode(), note)
        self.assertEqual(
            run("zbuf", "--size", "9x9", "--wireframe", "--depth", "f32", "-o", "drawn.ppm",
                stdin=ndc).stderr.decode(), note)
        matt = ndc.replace(b"1 1 0 1 0.5 1 1", b"1 1 0 1 0 1.5 1")  # an index alone changes nothing
        self.assertEqual(run("zbuf", "--size", "9x9", "-o", "drawn.ppm", stdin=matt).stderr.decode(), "")

    def test_a_ray_that_meets_nothing_has_its_direction(self):
        # The mirror faces the eye: the ray through the center of pixel (2, 4), two rows above the middle, is
        # sent back by it.
        height = 4 / 9 * math.tan(math.radians(30))
        mirrored = self.only(self.rays(self.TEXT, "--background", "102030", pixel="4,2"), "mirrored", 1)
        self.assertEqual((mirrored.target, mirrored.brought), ("nothing", (16, 32, 48)))
        self.assert_near(mirrored.along, unit((0.0, height, 1.0)))
        [primary] = self.rays(
            scene("light 0 0 -1 1 1 1\nmaterial 1 1 0 1\nmaterial 1 1 0 1\n", (square(-9.0, 1), WHITE, 0)),
            pixel="4,2")
        self.assertEqual(primary.target, "nothing")
        self.assert_near(primary.along, unit((0.0, height, -1.0)))

    def test_a_ray_that_meets_a_sphere_says_so(self):
        ball = "sphere\n0 0 -5 9 9 9 0\n1 0 -5 9 9 9 0\n0 1 -5 9 9 9 0\n0 0 -4 9 9 9 0\n\n"
        lines = self.trace(scene("") + ball, "--probe", "4,4").splitlines()
        self.assertEqual(lines, ["4,4: primary weight 1 from 0 0 0 to sphere 0 front at 0 0 -4 brings 9 9 9"])

    def test_a_probe_changes_no_byte(self):
        """Not even where light is not traced."""
        plain = CAMERA + "".join(
            "%r %r %r\n" % p
            for p in square(-5.0)[0]) + "\n-9 -9 3\n9 -9 3\n0 9 3\n\n-9 -9 3\n9 -9 -3\n0 9 3\n\n"
        for text in (plain, self.TEXT):
            before = self.picture(text, size="20x20")
            report = self.trace(text, "--probe", "3,3", "--probe", "10,12", size="20x20")
            self.assertEqual(before, self.picture(text, "--probe", "3,3", size="20x20"))
            self.assertEqual({line.split(":")[0] for line in report.splitlines()}, {"3,3", "10,12"})

    def test_options_out_of_range_are_refused(self):
        for words in (("--min-contribution", "-0.1"), ("--min-contribution", "2"), ("--max-depth", "1001"),
                      ("--max-depth", "-1")):
            self.assertEqual(
                run("trace", "--size", "9x9", *words, "-o", "out.ppm", stdin=self.TEXT).returncode, 2, words)


class Bytes(LightTest):
    def test_light_that_nothing_blocks_is_that_of_zbuf(self):
        """Along the other road, in view space: within a level, whatever the model of shading and the
        camera."""
        rng = random.Random(6)
        for camera in ("perspective 50 1 1 100\n", "ortho -9 9 -9 9 1 100\n"):
            mesh = [
                tuple((i + dx, k + dy, -20 - 0.02 * ((i + dx)**2 + (k + dy)**2)) for dx, dy in corners)
                for i in range(-6, 6) for k in range(-6, 6)
                for corners in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1)))]
            text = (
                camera +
                "attributes color normal\nlight 5 9 9 1 0.8 0.6\nambient 0.1 0.2 0.1\nmaterial 1 0.8 0.9 20\n"
            )
            for triangle in mesh:
                for x, y, z in triangle:
                    text += "%r %r %r %d %d %d %r %r 1\n" % (x, y, z, rng.randint(0, 255), rng.randint(
                        0, 255), 200, 0.04 * x, 0.04 * y)
                text += "\n"
            for model in ("flat", "gouraud", "phong"):
                drawn = self.picture(text, "--no-shadows", "--shading", model, size="70x70")
                traced = self.picture(text, "--shading", model, size="70x70")
                differ = [abs(a - b) for p, q in zip(drawn, traced) for a, b in zip(p, q)]
                self.assertLessEqual(max(differ), 1, (camera, model))
                self.assertGreater(len(set(traced)), 100)


if __name__ == "__main__":
    unittest.main()
