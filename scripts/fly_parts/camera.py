"""A camera that flies: its position, its direction, and the numbers that a scene has for them."""
import dataclasses
import math

from lib.vectors import axes, moved, normalized

STEP = 0.05  # of the distance between eye and look
TURN = math.radians(3)


def plain(vector):
    """Numbers as words that read back as the same doubles."""
    return [repr(x + 0.0) for x in vector]


@dataclasses.dataclass(frozen=True)
class Camera:
    """The eye, the three axes and the distance to the point looked at. `words` are the scene's, until the camera moves."""
    eye: tuple
    right: tuple
    up: tuple
    forward: tuple
    distance: float
    words: tuple = None

    @staticmethod
    def of(eye, look, up):
        """From the words of a header."""
        eye_at, look_at, up_to = (tuple(map(float, words)) for words in (eye, look, up))
        return Camera(eye_at, *axes(eye_at, look_at, up_to), math.dist(eye_at, look_at), (list(eye), list(look), list(up)))

    def lines(self):
        """Eye, look and up, three words each."""
        return self.words or (plain(self.eye), plain(moved(self.eye, (self.distance, self.forward))), plain(self.up))

    def stepped(self, right, up, forward):
        """Moved by the given number of steps along each axis."""
        step = STEP * self.distance
        eye = moved(self.eye, (right * step, self.right), (up * step, self.up), (forward * step, self.forward))
        return dataclasses.replace(self, eye=eye, words=None)

    def turned(self, right, up):
        """Turned on the spot, by the given numbers of turns."""
        def turn(a, b, angle):
            c, s = math.cos(angle), math.sin(angle)
            return normalized(tuple(c * x + s * y for x, y in zip(a, b))), normalized(tuple(c * y - s * x for x, y in zip(a, b)))

        forward, side = turn(self.forward, self.right, right * TURN)
        forward, top = turn(forward, self.up, up * TURN)
        return dataclasses.replace(self, right=side, up=top, forward=forward, words=None)
