"""The place of a scene, and of a camera that has it in sight."""
import dataclasses
import math

from lib.maths.vectors import dot
from lib.text.projection import window_of
from lib.text.stage_text import triangle_lines

ROOM = 1.05  # left around the scene


@dataclasses.dataclass(frozen=True)
class Ball:
    """A ball around all vertices and spheres, centered in their box."""
    center: tuple
    radius: float

    @staticmethod
    def around(model_text):
        """The Ball of model's output, in bytes; None for a scene with neither."""
        lines = model_text.splitlines(keepends=True)
        points = [point_of(line) for _, corners in triangle_lines(lines) for line in corners]
        spheres = [
            Ball.of_sphere(*map(point_of, lines[at + 1:at + 5])) for at, line in enumerate(lines)
            if line == b"sphere\n"]
        reach = points + [
            tuple(x + sign * sphere.radius for x in sphere.center) for sphere in spheres for sign in (-1, 1)]
        if not reach:
            return None
        center = tuple((min(axis) + max(axis)) / 2 for axis in zip(*reach))
        return Ball(
            center,
            max([math.dist(center, p)
                 for p in points] + [math.dist(center, sphere.center) + sphere.radius for sphere in spheres]))

    @staticmethod
    def of_sphere(center, *ends):
        """The Ball around a sphere that the scene may have stretched along its axes."""
        return Ball(center, max(math.dist(center, end) for end in ends))


def point_of(line):
    return tuple(map(float, line.split()[:3]))


def framing_distance(ball, header):
    """The distance from the ball's center to an eye that sees the whole ball in its window, between near and
    far if possible. `header` has the projection's words by its keyword. In a parallel projection the distance
    does not change the picture."""
    left, right, bottom, top, near, far = window_of(header)
    reach = ROOM * ball.radius or 1.0
    if "ortho" in header:
        return max(near + reach, reach)
    tangent = min(map(abs, (left, right, bottom, top))) / near
    distance = reach / math.sin(math.atan(tangent))
    return max(min(distance, far - reach), near + reach)


def direction(camera, ball):
    """The place of the ball, in words: "behind you, to the left, 12 away"."""
    way = tuple(b - a for a, b in zip(camera.eye, ball.center))
    right, up, ahead = (dot(way, axis) for axis in (camera.right, camera.up, camera.forward))
    words = ["behind you"] if ahead < 0 else []
    aside = max(abs(ahead) * math.tan(math.radians(5)), ball.radius / 2)
    words += ["to the right" if right > 0 else "to the left"] * (abs(right) > aside)
    words += ["above" if up > 0 else "below"] * (abs(up) > aside)
    return ", ".join([*(words or ["straight ahead"]), f"{math.hypot(*way):.3g} away"])
