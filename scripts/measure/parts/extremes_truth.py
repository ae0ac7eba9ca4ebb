"""The truth about a scene: its vertices in NDC by exact arithmetic, rounded nowhere between the stages, and
the triangle at each pixel. The arithmetic is taken from the specification's program,
tests/reference/reference.py."""
import pathlib
import sys
from fractions import Fraction

from lib.running.owners import NOBODY

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "tests/reference"))
import reference  # noqa: E402

BITS = 300  # of a coordinate in NDC after the point: far more than any pixel needs


def settled(x, bits=BITS):
    return Fraction(round(x * 2**bits), 2**bits)


def kept(vector):
    """Rounds numbers with sines and roots, which grow by multiplication, to more bits than coordinates
    need."""
    return tuple(settled(x, 4 * BITS) for x in vector)


def true_vertices(text):
    """The three points of each triangle in NDC."""
    scene = reference.Text(text.encode())
    camera = reference.read_camera(scene)
    eye, look, up = (camera[name].numbers for name in reference.POSITION)
    forward = reference.unit(reference.minus(look, eye))
    right = reference.unit(reference.cross(reference.minus(look, eye), up))
    axes = [kept(axis) for axis in (right, reference.cross(right, forward), reference.times(-1, forward))]
    volume = reference.volume_of(camera["projection"])
    volume = reference.Volume(*kept(volume[:4]), *volume[4:])
    matrix, known = reference.Matrix(), {}

    def to_ndc(p):
        if p not in known:
            seen = reference.minus(matrix.moved(p), eye)
            clip = reference.to_clip_space(tuple(reference.dot(axis, seen) for axis in axes), volume,
                                           (1, 0, 0))
            known[p] = tuple(settled(x / clip.w) for x in clip[:3])
        return known[p]

    triangles = []
    for keyword, _, arguments in reference.read_commands(scene, {}):
        if keyword == "triangle":
            triangles.append([to_ndc(corner.position) for corner in arguments])
        elif keyword != "end":
            matrix, known = matrix @ reference.transform(keyword, arguments.numbers), {}
            matrix = reference.Matrix(tuple(map(kept, matrix.columns)), kept(matrix.offset))
    return triangles


def true_owners(triangles, size):
    """The triangle (lib.running.owners) at each pixel of a picture of `size` columns and rows, by the rule
    `center`."""
    far = (1, 1)
    depths, owners = {}, [NOBODY] * size * size  # a depth is a numerator and a denominator, which is above 0
    for number, triangle in enumerate(triangles):
        # Columns and rows, times a power of two that makes them whole numbers.
        points = [((x + 1) * size / 2 - Fraction(1, 2), (1 - y) * size / 2 - Fraction(1, 2), z)
                  for x, y, z in triangle]
        a, b, c = ([int(x * 2**(BITS + 1)) for x in p] for p in points)
        unit = 2**(BITS + 1)
        area = reference.side_of_edge(c[0], c[1], a, b)
        if area == 0:
            continue
        b, c = (b, c) if area > 0 else (c, b)  # clockwise as seen
        edges = ((b, c), (c, a), (a, b))
        for row in reference.inside(Fraction(min(a[1], b[1], c[1]), unit),
                                    Fraction(max(a[1], b[1], c[1]), unit), size):
            for column in reference.inside(Fraction(min(a[0], b[0], c[0]), unit),
                                           Fraction(max(a[0], b[0], c[0]), unit), size):
                weights = [reference.side_of_edge(column * unit, row * unit, p[:2], q[:2]) for p, q in edges]
                if all(weight > 0 or weight == 0 and reference.is_left_or_top(p, q)
                       for weight, (p, q) in zip(weights, edges)):
                    z, w = sum(weight * p[2] for weight, p in zip(weights, (a, b, c))), abs(area) * unit
                    nearest, below = depths.get((row, column), far)
                    if -w <= z and z * below < nearest * w:
                        depths[row, column], owners[row * size + column] = (z, w), number
    return owners
