"""The scenes of scripts/measure/tradeoff that run long enough to be timed."""
import dataclasses
import math
import pathlib
import random

from parts import tradeoff_setting
from parts.tradeoff_scenes import EYE, TURN, camera

SAMPLES = pathlib.Path(__file__).resolve().parents[3] / "samples"
LIGHT = ["ambient 0.15 0.15 0.2", "material 1 0.8 0.5 40", "light -3 2 5 0.9 0.9 0.85"]
# a smaller scene has so many times fewer rows, columns and rings: its triangles are as large in pixels
SHRINKING = 5


@dataclasses.dataclass(frozen=True)
class CostScene:
    name: str
    title: str
    settings: tuple
    size: tuple               # columns and rows of the picture
    head: tuple               # lines
    triangles: object = None  # gives the texts of triangles, three lines each, for `detail`
    detail: tuple = ()
    whole: str = ""           # the text instead, for a scene that is there
    is_counted: bool = True   # its instructions, too

    def write(self, path):
        """Gives the number of triangles."""
        if self.whole:
            path.write_text(self.whole)
            return self.whole.count("triangle\n")
        count = 0
        with open(path, "w") as file:
            file.writelines(line + "\n" for line in self.head)
            for triangle in self.triangles(*self.detail):
                file.write("triangle\n" + triangle)
                count += 1
            file.write("end\n")
        return count

    def write_empty(self, path):
        path.write_text(
            self.whole.split("triangle\n")[0] + "end\n" if self.whole else "\n".join([*self.head, "end"]) +
            "\n")

    def smaller(self):
        """A scene to count instructions of, whose triangles are as large in pixels and as often hidden as
        this one's."""
        if len(self.detail) < 2 or self.detail[0] < 200:
            return self
        return dataclasses.replace(self, size=tuple(length // SHRINKING for length in self.size),
                                   detail=tuple(count // SHRINKING for count in self.detail))


def mesh(point, rings, sectors):
    """The 2 * RINGS * SECTORS triangles of a mesh whose ring i has the vertices point(i, k), as text."""
    above = [point(0, k) for k in range(sectors)]
    for i in range(rings):
        below = [point(i + 1, k) for k in range(sectors)]
        for k in range(sectors):
            right = (k + 1) % sectors
            yield above[k] + above[right] + below[right]
            yield above[k] + below[right] + below[k]
        above = below


def bumpy(rings, sectors, look_of=lambda *_: "", offset=0, digits=7):
    """The ball of tradeoff_scenes.ball; look_of(u, v, r) is the text behind the coordinates of a vertex."""
    def point(i, k):
        u, v = math.pi * (i + 0.5) / (rings + 1), math.tau * k / sectors
        r = 0.85 + 0.15 * math.sin(5 * u) * math.cos(7 * v)
        p = (r * math.sin(u) * math.cos(v), r * math.cos(u), r * math.sin(u) * math.sin(v))
        return " ".join("%.*g" % (digits, offset + x) for x in p) + look_of(u, v, r) + "\n"

    return mesh(point, rings, sectors)


def color_and_normal(u, v, r):
    r_u, r_v = 0.75 * math.cos(5 * u) * math.cos(7 * v), -1.05 * math.sin(5 * u) * math.sin(7 * v)
    outward = (math.sin(u) * math.cos(v), math.cos(u), math.sin(u) * math.sin(v))
    down, around = (math.cos(u) * math.cos(v), -math.sin(u), math.cos(u) * math.sin(v)), (-math.sin(v), 0,
                                                                                          math.cos(v))
    normal = [r * o - r_u * d - r_v / math.sin(u) * a for o, d, a in zip(outward, down, around)]
    length = math.hypot(*normal)
    color = [128 + 127 * x for x in outward]
    return " %.0f %.0f %.0f" % tuple(color) + " %.6f %.6f %.6f" % tuple(x / length for x in normal)


def bumpy_with_looks(rings, sectors):
    return bumpy(rings, sectors, color_and_normal)


def bumpy_far_off(rings, sectors):
    return bumpy(rings, sectors, offset=1e9, digits=17)


def closed_ball(rings, sectors):
    """2 * (RINGS - 1) * SECTORS triangles with normals. No gap at the poles: of each cell there, the triangle
    without area is left out."""
    def point(i, k):
        u, v = math.pi * i / rings, math.tau * k / sectors
        n = (math.sin(u) * math.cos(v), math.cos(u),
             math.sin(u) * math.sin(v)) if 0 < i < rings else (0, 1 - 2 * (i > 0), 0)
        return ("%.7g %.7g %.7g" % n + " %.7g %.7g %.7g\n" % n)

    return (triangle for triangle in mesh(point, rings, sectors) if len(set(triangle.splitlines())) == 3)


def rectangles(count):
    """Oblique rectangles as large as the picture, not sorted by depth."""
    dice = random.Random(1)
    for _ in range(count):
        # At 45 degrees the picture is twice as wide as its distance.
        a, b, c, d = ("%.7g %.7g %.7g\n" % (x * z, y * z, -z) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))
                      for z in [dice.uniform(1, 10)])
        yield a + b + c
        yield a + c + d


def cost_scenes(quick):
    million, size = ((8, 12), (64, 64)) if quick else ((500, 1000), (500, 500))
    ball_detail, ball_size = ((9, 16), (60, 45)) if quick else ((129, 256), (480, 360))
    large = (64, 64) if quick else (1400, 1400)
    eye = camera(EYE, (0, 0, 0), 40, 1, 10)
    center = (4e6, 5e6, 1e5)
    planet_eye = camera([c + x for c, x in zip(center, EYE)], center, 40, 1, 10)
    closed = ["color 235 150 60", "attributes normal", *LIGHT]

    def aimed(look):
        return ("1.8 1.2 2.4", look, "0 1 0", "40 1.3333333333333333 1 10", *closed)

    settings, is_counted = tradeoff_setting, not quick  # Valgrind alone takes half a second to start
    yield CostScene("plain", "a ball with bumps, plain", settings.PLAIN, size, (*eye, *TURN), bumpy, million,
                    is_counted=is_counted)
    yield CostScene("color", "the same with a color and a light", settings.COLOR, size,
                    (*eye, "color 235 150 60", *LIGHT, *TURN), bumpy, million, is_counted=is_counted)
    yield CostScene("normals", "the same with a color and a normal at each vertex, and a light",
                    settings.NORMALS, size, (*eye, "attributes color normal", *LIGHT, *TURN),
                    bumpy_with_looks, million, is_counted=is_counted)
    yield CostScene("plain planet", "the plain ball, and the eye, 6.4e6 from the origin",
                    settings.CANCELLATION, size, (*planet_eye, "translate", "4e6 5e6 1e5", *TURN), bumpy,
                    million, is_counted=is_counted)
    yield CostScene("plain pivot", "the plain ball, its vertices 1e9 from the origin and moved back to it",
                    settings.CANCELLATION, size, (*eye, *TURN, "translate", "-1e9 -1e9 -1e9"), bumpy_far_off,
                    million, is_counted=is_counted)
    yield CostScene("fill", "200 rectangles as large as the picture", settings.FILL, large,
                    tuple(camera((0, 0, 0), (0, 0, -1), 90, 1, 10)), rectangles, (200, ), is_counted=False)
    yield CostScene("ball", "a closed ball with normals", settings.CULLING, ball_size, aimed("0 0 0"),
                    closed_ball, ball_detail)
    yield CostScene("half", "the same, half of it outside the picture", settings.CULLING, ball_size,
                    aimed("1.25 0 -0.94"), closed_ball, ball_detail, is_counted=is_counted)
    for name, sample, title in (("torus", "shaded-torus", "torus"), ("inside", "inside", "room from inside")):
        # A viewer inside a room has triangles behind the eye, which must be clipped.
        possible = tuple(s for s in settings.SHADING if name != "inside" or s.value("--clip") != "reject")
        yield CostScene(name, title, possible, (60, 45) if quick else (480, 360), (),
                        whole=(SAMPLES / sample / "scene.txt").read_text(), is_counted=False)
