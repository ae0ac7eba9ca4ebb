"""What `--depth-epsilon` removes, and what it hides: the share of pixels in which two surfaces in one plane
fight, and the largest gap between a surface and one behind it that no longer shows, at three distances."""
import math
import tempfile

from parts.tradeoff_errors import Bench
from parts.tradeoff_scenes import Scene, camera, grid
from parts.tradeoff_setting import TOOLS, Setting

DISTANCES = (5, 50, 500)
NEAR, FAR = 1, 1000
FOV_Y = 45
FIRST, SECOND = b"\xff\0\0", b"\0\xff\0"  # the colors of the surface that is drawn first, and of the other
SETTINGS = [
    Setting(words) for words in ("", *(f"--depth-epsilon 1e-{n}" for n in (7, 6, 5, 4)), "--digits exact",
                                 *(f"--digits exact --depth-epsilon 1e-{n}" for n in (15, 12, 9)))]
STRIPS_A_DECADE = 24
STRIPS = 11 * STRIPS_A_DECADE


def colored(first, second, size, distance):
    """A scene of two surfaces."""
    lines = camera((0, 0, 0), (0, 0, -1), FOV_Y, NEAR, FAR)
    for color, triangles in ((FIRST, first), (SECOND, second)):
        lines.append("color %d %d %d" % tuple(color))
        for triangle in triangles:
            lines += ["triangle", *(" ".join("%.17g" % x for x in vertex) for vertex in triangle)]
    return Scene(f"at {distance}", "", "\n".join([*lines, "end"]) + "\n", *size, 0)


def one_plane(distance, size):
    """The same oblique plane twice, divided differently: every pixel should show the first."""
    reach = 1.5 * distance * math.tan(math.radians(FOV_Y / 2))

    def plane(cells):
        def point(i, k):
            x, y = (reach * (2 * n / cells - 1) for n in (k, i))
            return x, y, -distance + 0.3 * x + 0.2 * y
        return grid(cells, cells, point)

    return colored(plane(24), plane(31), size, distance)


def gaps(distance):
    """The gaps between the strips and what is behind them, from the left, half the distance first."""
    return [0.5 * distance * 10 ** (-k / STRIPS_A_DECADE) for k in range(STRIPS)]


def strips(distance, size):
    """A wall, and vertical strips before it that are nearer by less and less."""
    slope = math.tan(math.radians(FOV_Y / 2))

    def rectangle(left, right, z):
        """From `left` to `right` of the picture, from -1 to 1."""
        corners = [
            (x * slope * z, y * slope * z, -z) for x, y in ((left, -1), (right, -1), (right, 1), (left, 1))]
        return [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])]

    places = [2 * k / STRIPS - 1 for k in range(STRIPS + 1)]
    nearer = [
        triangle for k, gap in enumerate(gaps(distance))
        for triangle in rectangle(places[k], places[k + 1], distance - gap)]
    return colored(rectangle(-1.1, 1.1, distance), nearer, size, distance)


def picture(bin_dir, scene, setting):
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(bin_dir, folder, scene)
        bench.run(TOOLS[3], setting, bench.projected(setting))
        return bench.pixels()


def measured(bin_dir, quick):
    """A row for each setting and distance."""
    size, pixels_a_strip = ((64, 64) if quick else (400, 400)), 4
    for setting in SETTINGS:
        for distance in DISTANCES:
            plane = picture(bin_dir, one_plane(distance, size), setting)
            row = picture(bin_dir, strips(distance, (pixels_a_strip * STRIPS, 1)), setting)
            # The last pixel of a strip may be the next one's.
            hidden = [gap for k, gap in enumerate(gaps(distance)) if row[pixels_a_strip * k + 1] != SECOND]
            yield {
                "setting": str(setting), "distance": distance,
                "fighting": sum(color == SECOND
                                for color in plane) / len(plane), "swallowed": max(hidden, default=0.0)}
