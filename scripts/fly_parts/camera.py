"""A camera that flies: its position, its direction, and the numbers that a scene has for them."""
import dataclasses
import math

from lib.maths.vectors import axes, dot, moved, normalized, turned_about

STEP = 0.05  # of the distance between eye and look
TURN = math.radians(3)
CLOSER = 0.9  # the factor of that distance for a step of the wheel
STEEPEST = math.radians(89)  # how far an orbit climbs above the horizon, or below it


def plain(vector):
    """Numbers as words that read back as the same doubles."""
    return [repr(x + 0.0) for x in vector]


@dataclasses.dataclass(frozen=True)
class Camera:
    """The eye, the three axes and the distance to the point looked at. `words` are the camera's in the scene,
    until it moves."""
    eye: tuple
    right: tuple
    up: tuple
    forward: tuple
    distance: float
    vertical: tuple = None  # the scene's up, as a unit vector
    words: tuple = None

    @staticmethod
    def of(eye, look, up):
        """The Camera that a header's words describe."""
        eye_at, look_at, up_to = (tuple(map(float, words)) for words in (eye, look, up))
        return Camera(eye_at, *axes(eye_at, look_at, up_to), math.dist(eye_at, look_at), normalized(up_to),
                      (list(eye), list(look), list(up)))

    def lines(self):
        """Eye, look and up, three words each."""
        return self.words or (plain(self.eye), plain(self.look), plain(self.up))

    def stepped(self, right, up, forward):
        """The camera after the given number of steps along each axis."""
        step = STEP * self.distance
        eye = moved(self.eye, (right * step, self.right), (up * step, self.up),
                    (forward * step, self.forward))
        return dataclasses.replace(self, eye=eye, words=None)

    @property
    def look(self):
        return moved(self.eye, (self.distance, self.forward))

    def orbited(self, right, up):
        """The camera moved around the point looked at, by angles in radians: to the right about the
        vertical axis, and up, but never over the top."""
        height = math.asin(max(-1.0, min(1.0, -dot(self.forward, self.vertical))))
        up = max(min(-STEEPEST, height), min(max(STEEPEST, height), height + up)) - height
        ways = [
            turned_about(turned_about(way, self.right, -up), self.vertical, right)
            for way in (self.right, self.up, self.forward)]
        side, top, forward = map(normalized, ways)
        return dataclasses.replace(self, eye=moved(self.look, (-self.distance, forward)), right=side, up=top,
                                   forward=forward, words=None)

    def neared(self, steps):
        """The camera moved toward the point looked at; away from it for negative steps."""
        distance = self.distance * CLOSER**steps
        return dataclasses.replace(self, eye=moved(self.look, (-distance, self.forward)), distance=distance,
                                   words=None)

    def framing(self, center, distance):
        """The camera looking at a point, in the same direction, from a distance."""
        return dataclasses.replace(self, eye=moved(center, (-distance, self.forward)), distance=distance,
                                   words=None)

    def turned(self, right, up):
        """The camera turned on the spot, by multiples of TURN."""
        def turn(a, b, angle):
            c, s = math.cos(angle), math.sin(angle)
            return normalized(tuple(c * x + s * y for x, y in zip(a, b))), normalized(
                tuple(c * y - s * x for x, y in zip(a, b)))

        forward, side = turn(self.forward, self.right, right * TURN)
        forward, top = turn(forward, self.up, up * TURN)
        return dataclasses.replace(self, right=side, up=top, forward=forward, words=None)
