"""The runs whose instructions scripts/measure/bench --instructions counts, and their inputs.

The inputs come from integers alone, so that every version of Python writes the same bytes.
"""
import dataclasses

UNIT = 10**7  # lengths are integers in units of the seventh decimal
CAMERA = "eye 1.8 1.2 2.4\nlook 0 0 0\nup 0 1 0\n"
PROJECTION = "perspective 40 1 1 10\n"
LIGHTS = "ambient 0.1 0.1 0.1\nmaterial 1 0.8 0.6 30\nlight -3 2.5 -1 1 0.6 0.5\nlight 3 2 0.5 0.3 0.5 1\n"


class Integers:
    """The linear congruential generator of D. E. Knuth's MMIX, without its 24 low bits."""
    def __init__(self):
        self.state = 1

    def within(self, reach):
        """An integer from -reach to reach."""
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 24) % (2 * reach + 1) - reach


def decimal(number):
    whole, rest = divmod(abs(number), UNIT)
    return f"{'-' * (number < 0)}{whole}.{rest:07}"


def triangles(count, reach, size, middle_z=0, columns=()):
    """Bare stage text: corners within `size` (x, y, z) of a middle that lies within `reach` of (0 0
    middle_z), followed by `columns`."""
    integers, lines = Integers(), []
    for _ in range(count):
        middle = [offset + integers.within(limit) for offset, limit in zip((0, 0, middle_z), reach)]
        for _ in range(3):
            numbers = [center + integers.within(limit) for center, limit in zip(middle, size)]
            numbers += [5 * UNIT + integers.within(4 * UNIT)] * ("w" in columns)
            numbers += [(128 + integers.within(127)) * UNIT for _ in range(3 * ("color" in columns))]
            numbers += [integers.within(UNIT) for _ in range(3 * ("normal" in columns))]
            lines.append(" ".join(map(decimal, numbers)) + " 1" * ("material" in columns))
        lines.append("")
    return "\n".join(lines) + "\n"


def in_world(count, **columns):
    return triangles(count, (UNIT,) * 3, (UNIT // 50,) * 3, **columns)


def in_view(count, **columns):
    return triangles(count, (UNIT,) * 3, (UNIT // 50,) * 3, middle_z=-4 * UNIT, **columns)


def across_the_frustum(count, **columns):
    """Triangles in view space: about half cross planes of the frustum, the near one included, and some lie
    outside."""
    return triangles(count, (2 * UNIT, 2 * UNIT, 3 * UNIT), (UNIT,) * 3, middle_z=-4 * UNIT, **columns)


def mostly_outside(count):
    """Triangles in view space, 97 % of them outside the frustum."""
    return triangles(count, (9 * UNIT, 9 * UNIT, 3 * UNIT), (UNIT // 50,) * 3, middle_z=-4 * UNIT)


def with_more_digits(stage_text, digits):
    return "\n".join(" ".join(number + digits for number in line.split()) for line in stage_text.split("\n"))


def small_on_screen(count, **columns):
    """Triangles of about three pixels each on a 500 x 500 screen."""
    return triangles(count, (UNIT,) * 3, (UNIT // 130, UNIT // 130, UNIT // 500), **columns)


def large_on_screen(count, **columns):
    return triangles(count, (UNIT // 10,) * 3, (UNIT * 9 // 10,) * 3, **columns)


def header(space, columns):
    """The header lines of a text in this space."""
    names = f"attributes {' '.join(columns)}\n" if columns else ""
    return {
        "scene": "",
        "world": CAMERA + PROJECTION,
        "view": PROJECTION,
        "screen": "projected frustum -0.4 0.4 -0.4 0.4 1 10\n" * bool(columns),
    }[space] + names + (LIGHTS if columns else "")


def lit(space, make, count, repeats=1, columns=("color", "normal")):
    columns = ("w",) * (space == "screen") + columns
    return header(space, columns) + make(count, columns=columns) * repeats


def small_and_lit(*columns):
    """Small triangles with lights. They have no w: random ones would differ more than a model's."""
    return header("screen", columns) + small_on_screen(8000, columns=columns)


PLY = """ply
format ascii 1.0
element vertex {}
property float x
property float y
property float z
element face {}
property list uchar int vertex_indices
end_header
"""


def model_file(form, side):
    """A terrain of two triangles for each of side x side squares, as the text of a model file."""
    integers, across = Integers(), side + 1
    points = [
        " ".join(map(decimal, (x * UNIT, integers.within(UNIT), y * UNIT))) + "\n" for y in range(across)
        for x in range(across)]
    corners = [y * across + x for y in range(side) for x in range(side)]
    faces = [face for i in corners for face in ((i, i + across, i + 1), (i + 1, i + across, i + across + 1))]
    if form == "stl":
        facets = ("vertex ".join(["", *(points[i] for i in face)]) for face in faces)
        around = "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n".format
        return "solid terrain\n" + "".join(map(around, facets)) + "endsolid terrain\n"
    if form == "obj":
        return "".join(f"v {point}" for point in points) + "".join("f {} {} {}\n".format(*(i + 1
                                                                                           for i in face))
                                                                   for face in faces)
    return PLY.format(len(points), len(faces)) + "".join(points) + "".join("3 {} {} {}\n".format(*face)
                                                                           for face in faces)


def scene(stage_text, before_each="", after_each="", columns=(), head=""):
    """A scene with the triangles of a bare stage text, and commands around each."""
    camera = "".join(line.split(" ", 1)[1] + "\n" for line in (CAMERA + PROJECTION).splitlines())
    body = "".join(f"{before_each}triangle\n{triangle}\n{after_each}" for triangle in stage_text.split("\n\n")
                   if triangle)
    return camera + head + header("scene", columns) + body + "end\n"


def odd_numbers(stage_text):
    """The same vertices with exponents and up to 16 digits."""
    return "\n".join(
        " ".join(f"{number}123456e-1" for number in line.split()) for line in stage_text.split("\n"))


def with_materials(count, repeats):
    columns = "color", "normal", "material"
    return header("world", columns) + "material 1 1 0 1\n" + in_world(count, columns=columns) * repeats


def far_off():
    """A scene whose triangles, and the eye, are 6.4 million units from the origin."""
    near, far = "1.8 1.2 2.4\n0 0 0\n", "4000001.8 5000001.2 100002.4\n4000000 5000000 100000\n"
    head = "translate 4e6 5e6 1e5\nrotate 25 3 1 2\n"
    return scene(in_world(2000) * 4, head=head).replace(near, far, 1)


TURNED = "push\ntranslate 0.25 -0.5 0.125\nrotate 30 1 2 3\nscale 0.5 2 1.5\n"

TEXTS = {
    "one-scene.txt": lambda: scene(in_world(1)),
    "one-world.txt": lambda: header("world", ()) + in_world(1),
    "one-view.txt": lambda: header("view", ()) + in_view(1),
    "one-screen.txt": lambda: small_on_screen(1),
    "scene.txt": lambda: scene(in_world(2000) * 15),
    "turned-scene.txt": lambda: scene(in_world(600), TURNED + TURNED, "pop\npop\n"),
    "far-off-scene.txt": far_off,
    "odd-scene.txt": lambda: scene(odd_numbers(in_world(2000)) * 3),
    "lit-scene.txt": lambda: scene(
        in_world(2000, columns=("color", "normal")) * 4, columns=("color", "normal")),
    "world.txt": lambda: header("world", ()) + in_world(2000) * 25,
    "lit-world.txt": lambda: lit("world", in_world, 2000, 6),
    "short-world.txt": lambda: header("world", ()) + in_world(2000) * 10,
    "view.txt": lambda: header("view", ()) + in_view(2000) * 25,
    "short-view.txt": lambda: header("view", ()) + in_view(2000) * 10,
    "lit-view.txt": lambda: lit("view", in_view, 2000, 6),
    "crossing.txt": lambda: header("view", ()) + across_the_frustum(2000) * 3,
    "lit-crossing.txt": lambda: lit("view", across_the_frustum, 2000, 2),
    "outside.txt": lambda: header("view", ()) + mostly_outside(2000) * 10,
    "small-9.txt": lambda: with_more_digits(small_on_screen(20_000), "23"),
    "small-17.txt": lambda: with_more_digits(small_on_screen(20_000), "1234567891"),
    "small.txt": lambda: small_on_screen(40_000),
    "large.txt": lambda: large_on_screen(1500),
    "few-large.txt": lambda: large_on_screen(100),
    "lit-screen.txt": lambda: lit("screen", large_on_screen, 100),
    "small-lit-screen.txt": lambda: lit("screen", in_world, 2000),
    "config.txt": lambda: "500 500\n",
    "narrow.txt": lambda: "300 300\n",
    "tiny.txt": lambda: "4 4\n",}

TEXTS |= {
    "one-color-scene.txt": lambda: scene(in_world(2000) * 8, head="color 200 190 170\n" + LIGHTS),
    "one-color-world.txt": lambda: lit("world", in_world, 2000, 8, ("color",)),
    "one-color-view.txt": lambda: lit("view", in_view, 2000, 8, ("color",)),
    "one-color-screen.txt": lambda: small_and_lit("color"),
    "colored-screen.txt": lambda: small_and_lit("color", "normal"),
    **{f"terrain.{form}": lambda form=form: model_file(form, 60)
       for form in ("obj", "stl", "ply")},
    "material-world.txt": lambda: with_materials(2000, 6),
    "crlf-world.txt": lambda: TEXTS["short-world.txt"]().replace("\n", "\r\n"),}


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    words: str  # the tool and its arguments; a pipe has " | " between tools
    kernel: str = "avx2"

    @property
    def tool(self):
        return self.words.split()[0]


NO_IMAGE = "--image /dev/null"

ROWS = [
    Row("model: one triangle", "model one-scene.txt"),
    Row("view: one triangle", "view one-world.txt"),
    Row("project: one triangle", "project one-view.txt"),
    Row("zbuf: one triangle", f"zbuf tiny.txt one-screen.txt {NO_IMAGE}"),
    Row("model: plain", "model scene.txt"),
    Row("view: plain", "view world.txt"),
    Row("view: plain, sse4", "view world.txt", "sse4"),
    Row("view: plain, scalar", "view world.txt", "scalar"),
    Row("project: plain", "project view.txt"),
    Row("model: transforms", "model turned-scene.txt"),
    Row("model: exponents and 16 digits", "model odd-scene.txt"),
    Row("model: one color and light", "model one-color-scene.txt"),
    Row("view: one color and light", "view one-color-world.txt"),
    Row("project: one color and light", "project one-color-view.txt"),
    Row("zbuf: one color and light", f"zbuf config.txt one-color-screen.txt {NO_IMAGE}"),
    Row("zbuf: normals and colors", f"zbuf config.txt colored-screen.txt {NO_IMAGE}"),
    *(Row(f"mesh2scene: {form.upper()}", f"mesh2scene terrain.{form}") for form in ("obj", "stl", "ply")),
    Row(
        "pipe: PLY, 3 x 3 samples", "mesh2scene terrain.ply | model | view | project | "
        f"zbuf narrow.txt {NO_IMAGE} --samples 3 --threads 1"),
    Row("model: lit", "model lit-scene.txt"),
    Row("view: lit", "view lit-world.txt"),
    Row("project: lit", "project lit-view.txt"),
    Row("view: materials", "view material-world.txt"),
    Row("view: lines that end with CR LF", "view crlf-world.txt"),
    Row("view: exact digits", "view short-world.txt --digits exact"),
    Row("view: 5 digits", "view short-world.txt --digits 5"),
    Row("view: 9 digits", "view short-world.txt --digits 9"),
    Row("view: 12 digits", "view short-world.txt --digits 12"),
    Row("project: 9 digits", "project short-view.txt --digits 9"),
    Row("model: 9 digits", "model scene.txt --digits 9"),
    Row("model: exact digits", "model scene.txt --digits exact"),
    Row(
        "pipe: far-off eye, 9 digits", "model far-off-scene.txt --digits 9 | view --digits 9 | "
        f"project --digits 9 | zbuf narrow.txt {NO_IMAGE} --coverage center"),
    Row("view: double precision", "view world.txt --precision double"),
    Row("project: exact digits", "project short-view.txt --digits exact"),
    Row("project: double precision", "project view.txt --precision double"),
    Row("project: clipped at the near plane", "project crossing.txt --clip near"),
    Row("project: clipped at the frustum", "project crossing.txt --clip frustum"),
    Row("project: lit, clipped at the frustum", "project lit-crossing.txt --clip frustum"),
    Row("project: outside, rejected", "project outside.txt --clip reject"),
    Row("project: outside, clipped", "project outside.txt --clip frustum"),
    Row("project: culled", "project view.txt --cull back"),
    Row("zbuf: small, nearest", f"zbuf config.txt small.txt {NO_IMAGE}"),
    Row("zbuf: small, nearest, scalar", f"zbuf config.txt small.txt {NO_IMAGE}", "scalar"),
    Row("zbuf: small, center", f"zbuf config.txt small.txt {NO_IMAGE} --coverage center"),
    Row("zbuf: small, center, 9 digits", f"zbuf config.txt small-9.txt {NO_IMAGE} --coverage center"),
    Row("zbuf: small, center, 17 digits", f"zbuf config.txt small-17.txt {NO_IMAGE} --coverage center"),
    Row("zbuf: large, nearest", f"zbuf config.txt large.txt {NO_IMAGE}"),
    Row("zbuf: large, center", f"zbuf config.txt large.txt {NO_IMAGE} --coverage center"),
    Row("zbuf: small, scan-line", f"zbuf config.txt small.txt {NO_IMAGE} --algorithm scanline"),
    Row("zbuf: large, scan-line", f"zbuf config.txt few-large.txt {NO_IMAGE} --algorithm scanline"),
    Row("zbuf: flat", f"zbuf narrow.txt lit-screen.txt {NO_IMAGE} --shading flat"),
    Row("zbuf: gouraud", f"zbuf narrow.txt lit-screen.txt {NO_IMAGE} --shading gouraud"),
    Row("zbuf: phong", f"zbuf narrow.txt lit-screen.txt {NO_IMAGE} --shading phong"),
    Row("zbuf: phong, small, 3 x 3 samples",
        f"zbuf narrow.txt small-lit-screen.txt {NO_IMAGE} --samples 3 --threads 1"),
    Row("zbuf: 2 x 2 samples", f"zbuf config.txt few-large.txt {NO_IMAGE} --samples 2"),
    Row("zbuf: float depths", f"zbuf config.txt large.txt {NO_IMAGE} --depth f32"),
    Row("zbuf: 24-bit depths", f"zbuf config.txt large.txt {NO_IMAGE} --depth u24"),
    Row("zbuf: depths into a file", f"zbuf config.txt large.txt {NO_IMAGE} --z-buffer depths.txt"),
    Row("zbuf: PNG", "zbuf narrow.txt small.txt --image image.png"),
    Row("zbuf: wireframe", f"zbuf config.txt few-large.txt {NO_IMAGE} --wireframe"),
    Row("trace: 3 x 3 samples",
        f"trace lit-view.txt --size 80x60 {NO_IMAGE} --z-buffer none --samples 3 --threads 1"),]
