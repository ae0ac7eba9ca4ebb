"""Mistakes that no list has, made in the right texts of a student's program: triangles lost or doubled, one
vertex of three forgotten, and matrices with their rows in another order or with other depths. They are
calculated here from the scene's camera."""
import dataclasses

from vectors import cross, minus, unit

ORDINALS = ("first", "second", "third")


@dataclasses.dataclass
class Change:
    stage: str
    name: str
    # (texts of the scene and the stages, the stage's number, random numbers) to the changed text and the
    # words of the cause
    make: object


def points_of(text):
    return [tuple(map(float, line.split())) for line in text.split("\n") if line.strip()]


def text_of(points):
    return "".join("%.7f %.7f %.7f\n" % p + "\n" * (i % 3 == 2) for i, p in enumerate(points))


def axes(texts):
    """r, u and -l of the camera."""
    eye, look, up = (tuple(map(float, line.split())) for line in texts[0].split("\n")[:3])
    back = unit(minus(eye, look))
    r = unit(cross(up, back))
    return r, cross(back, r), back


def clip_space(texts):
    """(x, y, z, w) of each point before the divide."""
    return [(*(-view[2] * c for c in ndc), -view[2])
            for view, ndc in zip(points_of(texts[2]), points_of(texts[3]))]


def moved(function, words):
    """A change of each point of the stage's right text."""
    return lambda texts, number, rng: (text_of([function(*p) for p in points_of(texts[number])]), words)


def of_all(function, words):
    """A change that needs more than the stage's right text."""
    return lambda texts, number, rng: (text_of(function(texts)), words)


def x_row_for_z(texts):
    """Rows 1 and 3 of the projection in each other's place."""
    return [(z / w, y / w, x / w) for x, y, z, w in clip_space(texts)]


def w_row_for_z(texts):
    return [(x / z, y / z, w / z) for x, y, z, w in clip_space(texts)]


def at_some_vertices(forgotten, words):
    """Some vertices of each triangle as `forgotten` gives the points, the others right: the one that `words`
    names first by {one}, or if they name {others} first, those."""
    def make(texts, number, rng):
        k = rng.randrange(3)
        others = " and ".join(name for name in ORDINALS if name != ORDINALS[k])
        is_one = words.index("{one}") < words.index("{others}")
        points = [
            q if (i % 3 == k) == is_one else p
            for i, (p, q) in enumerate(zip(points_of(texts[number]), forgotten(texts)))]
        return text_of(points), words.format(one=ORDINALS[k], others=others)

    return make


def at_one_vertex(forgotten, cause):
    return at_some_vertices(forgotten,
                            "Only the {one} vertex of each triangle is wrong, the {others} are right" + cause)


def at_two_vertices(forgotten, cause):
    return at_some_vertices(forgotten,
                            "The {others} vertex of each triangle are wrong, the {one} is right" + cause)


def lost(texts, number, rng):
    points = points_of(texts[number])
    t = rng.randrange(len(points) // 3)
    return text_of(points[:3 * t] + points[3 * t + 3:]), f"Triangle {t} is missing"


def doubled(texts, number, rng):
    points = points_of(texts[number])
    t = rng.randrange(len(points) // 3)
    return text_of(points[:3 * t + 3] + points[3 * t:]), f"Triangle {t} is written twice"


def without_eye(texts):
    """The points as view makes them if it does not subtract the eye: they lie farther off by the eye's place
    in view space."""
    return [tuple(sum(a * b for a, b in zip(row, p)) for row in axes(texts)) for p in points_of(texts[1])]


def in_order(vertices, words):
    """The vertices of each triangle in another order."""
    def make(texts, number, rng):
        points = points_of(texts[number])
        return text_of([points[i - i % 3 + vertices[i % 3]] for i in range(len(points))]), words

    return make


def backwards(texts, number, rng):
    points = points_of(texts[number])
    return text_of([p for t in range(len(points) - 3, -1, -3)
                    for p in points[t:t + 3]]), "The triangles stand in reverse order"


ROWS = "Rows {} and {} of the matrix (counted from 1), those of {} and {}, stand in each other's place"
NOT_DIVIDED = ": The coordinates are not divided by w"
CHANGES = [
    *(Change(stage, "lost", lost) for stage in ("model", "view", "project")),
    *(Change(stage, "doubled", doubled) for stage in ("model", "view", "project")),
    *(Change(
        stage, "vertices in another order",
        in_order((0, 2, 1), "The vertices of each triangle stand in another order: first, third, second"))
      for stage in ("model", "view", "project")),
    *(Change(stage, "backwards", backwards) for stage in ("model", "view", "project")),
    Change("view", "x and y exchanged", moved(lambda x, y, z: (y, x, z), ROWS.format(1, 2, "x", "y"))),
    Change("view", "y and z exchanged", moved(lambda x, y, z: (x, z, y), ROWS.format(2, 3, "y", "z"))),
    Change("view", "rows in a circle",
           moved(lambda x, y, z: (y, z, x), "The rows of the matrix stand in the order y, z, x")),
    Change("view", "eye at one vertex", at_one_vertex(without_eye, ": The eye is not subtracted")),
    Change("view", "eye at two vertices", at_two_vertices(without_eye, ": The eye is not subtracted")),
    Change("project", "x and y exchanged", moved(lambda x, y, z: (y, x, z), ROWS.format(1, 2, "x", "y"))),
    Change("project", "x and z exchanged", of_all(x_row_for_z, ROWS.format(1, 3, "x", "z"))),
    Change("project", "z and w exchanged", of_all(w_row_for_z, ROWS.format(3, 4, "z", "w"))),
    Change("project", "depth from 1 to 0",
           moved(lambda x, y, z: (x, y, (1 - z) / 2), "The depth goes from 1 at near to 0 at far")),
    Change("project", "one vertex not divided",
           at_one_vertex(lambda texts: [p[:3] for p in clip_space(texts)], NOT_DIVIDED)),
    Change("project", "two vertices not divided",
           at_two_vertices(lambda texts: [p[:3] for p in clip_space(texts)], NOT_DIVIDED)),]
