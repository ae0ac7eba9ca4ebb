"""The scenes of scripts/measure/tradeoff that stress numbers: small ones, to measure errors."""
import dataclasses
import math
import random


@dataclasses.dataclass(frozen=True)
class Scene:
    name: str
    title: str
    text: str
    columns: int
    rows: int
    triangle_count: int


def ball(radius, rings, sectors):
    """A ball with bumps, 2 * RINGS * SECTORS triangles: it hides parts of itself, and its edges have all
    directions."""
    def point(i, k):
        u, v = math.pi * (i + 0.5) / (rings + 1), math.tau * (k % sectors) / sectors
        r = radius * (0.85 + 0.15 * math.sin(5 * u) * math.cos(7 * v))
        return (r * math.sin(u) * math.cos(v), r * math.cos(u), r * math.sin(u) * math.sin(v))

    return grid(rings, sectors, point)


def grid(rows, columns, point):
    """Two triangles a cell; point(i, k) is the corner in row i and column k."""
    for i in range(rows):
        for k in range(columns):
            a, b, c, d = point(i, k), point(i, k + 1), point(i + 1, k + 1), point(i + 1, k)
            yield a, b, c
            yield a, c, d


def scene(name, title, camera, commands, triangles, size, digits=7):
    """Writes a scene's vertices with `digits` significant digits, as mesh files do."""
    columns, rows = size
    lines = [*camera, *commands]
    count = 0
    for triangle in triangles:
        lines.append("triangle")
        lines += [" ".join("%.*g" % (digits, x) for x in vertex) for vertex in triangle]
        count += 1
    return Scene(name, title, "\n".join([*lines, "end"]) + "\n", columns, rows, count)


def camera(eye, look, fov_y, near, far):
    words = [" ".join("%.17g" % x for x in vector) for vector in (eye, look, (0, 1, 0))]
    return [*words, "%.17g 1 %.17g %.17g" % (fov_y, near, far)]


TURN = ["rotate", "25 3 1 2"]
EYE = (1.8, 1.2, 2.4)


def ball_scene(name, title, radius, detail, size):
    eye = [radius * x for x in EYE]
    return scene(name, title, camera(eye, (0, 0, 0), 40, radius, 10 * radius), TURN, ball(radius, *detail),
                 size)


def planet(name, title, detail, size):
    center = (4e6, 5e6, 1e5)
    eye = [c + x for c, x in zip(center, EYE)]
    return scene(name, title, camera(eye, center, 40, 1, 10), ["translate", "4e6 5e6 1e5", *TURN],
                 ball(1, *detail), size)


def pivot(name, title, detail, size):
    """Its vertices lie 1e9 from the origin, and the matrix moves them back: only the differences remain."""
    triangles = ([tuple(1e9 + x for x in vertex) for vertex in triangle] for triangle in ball(1, *detail))
    return scene(name, title, camera(EYE, (0, 0, 0), 40, 1, 10), [*TURN, "translate", "-1e9 -1e9 -1e9"],
                 triangles, size, digits=17)


def telescope(name, title, detail, size):
    fov_y = 0.001
    distance = 1.15 / math.tan(math.radians(fov_y / 2))
    eye = [round(distance * x / math.hypot(*EYE)) for x in EYE]
    return scene(name, title, camera(eye, (0, 0, 0), fov_y, distance - 10, distance + 10), TURN,
                 ball(1, *detail), size)


def room(name, title, detail, size):
    """Five walls 1000 across, and eight balls; the eye looks in through the missing sixth wall."""
    cells = detail[0] // 4
    place = [1000 * i / cells - 500 for i in range(cells + 1)]
    walls = [lambda i, k: (place[k], -500, place[i]), lambda i, k: (place[k], 500, place[i]),
             lambda i, k: (place[k], place[i], -500),
             lambda i, k: (-500, place[k], place[i]), lambda i, k: (500, place[k], place[i])]
    triangles = [triangle for wall in walls for triangle in grid(cells, cells, wall)]
    dice = random.Random(1)
    for _ in range(8):
        center = [dice.uniform(-350, 350) for _ in range(3)]
        for triangle in ball(120, detail[0] // 4, detail[1] // 4):
            triangles.append([tuple(c + x for c, x in zip(center, vertex)) for vertex in triangle])
    return scene(name, title, camera((37, 11, 1300), (3, -7, 0), 60, 1, 3000), [], triangles, size)


def layers(name, title, ratio, detail, size):
    """Two oblique planes 1e-5 apart; the rear one comes first, so that it also wins where both depths are
    equal."""
    normal = [x / math.hypot(0.6, 0.3, 1) for x in (-0.6, -0.3, 1)]

    def plane(cells, lift):
        def point(i, k):
            x, y = 2 * k / cells - 1, 2 * i / cells - 1
            return tuple(p + lift * n for p, n in zip((x, y, 0.6 * x + 0.3 * y), normal))
        return grid(cells, cells, point)

    triangles = [*plane(detail[0] // 2, 0), *plane(detail[0] // 2 + 7, 1e-5)]
    return scene(name, title, camera((0, 0, 3), (0, 0, 0), 45, 10 / ratio, 10), [], triangles, size, digits=9)


def scenes_of_errors(quick):
    detail, size = ((8, 12), (64, 64)) if quick else ((48, 64), (400, 400))
    yield ball_scene("unit", "an object of size 1", 1, detail, size)
    yield ball_scene("1e-3", "an object of size 1e-3", 1e-3, detail, size)
    yield ball_scene("1e-5", "an object of size 1e-5", 1e-5, detail, size)
    yield room("room", "a room 1000 across", detail, size)
    yield planet("planet", "an object of size 1, and the eye, 6.4e6 from the origin", detail, size)
    yield pivot("pivot", "vertices 1e9 from the origin, moved back to it", detail, size)
    yield telescope("telescope", "fovY 0.001, 130,000 away", detail, size)
    for exponent in (2, 4, 6):
        yield layers("layers 1e%d" % exponent, "two layers 1e-5 apart, far/near 1e%d" % exponent,
                     10**exponent, detail, size)
