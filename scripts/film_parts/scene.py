"""The scene of a film, as model writes it."""
import math
import pathlib
import tempfile

from film_parts.path import Camera
from lib.maths.vectors import cross, moved, normalized
from lib.rim.command import CommandFailure
from lib.rim.input_file import name_of, read_input
from lib.text.projection import line_of
from lib.text.square import note_on_squares
from lib.text.stage_text import header_of, text_of


class Scene:
    """The scene in world space, as model writes it, and the text of the config, both as bytes."""
    def __init__(self, tools, path, config):
        with tempfile.TemporaryDirectory() as folder:
            stats = pathlib.Path(folder, "stats.txt")
            self.world = tools.output("model", "--framed", "--stats", stats, path,
                                      stdin=read_input(path) if path == "-" else b"")
            self.stats = dict(line.split() for line in stats.read_text().splitlines())
        self.config = config
        header = header_of(self.world)
        if self.stats.get("triangles") == "0" or not {"eye", "look", "up"} <= set(header):
            raise CommandFailure(f"expected a scene with triangles, found none in {name_of(path)}")
        self.camera = Camera(*(tuple(map(float, header[name])) for name in ("eye", "look", "up")))
        self.perspective = header.get("perspective")
        self.square_note = note_on_squares(line_of(header.get), text_of(config, "CONFIG"))

    def projection_words(self, camera):
        """The options of project for a camera with its own angle."""
        if camera.fov_y is None:
            return []
        if self.perspective is None:
            raise CommandFailure("a fovY changes a perspective, and the scene has none")
        _, aspect, near, far, *rule = self.perspective
        words = ["--perspective", number(camera.fov_y), aspect, near, far]
        return [*words, *(["--aspect", *rule] if rule else [])]


def number(x):
    """The shortest text that reads back as this number."""
    return repr(float(x) + 0.0).removesuffix(".0")


def cosine_and_sine(frame, count):
    """The cosine and sine of the turn up to a frame; exact at quarter turns."""
    quarters, rest = divmod(4 * frame, count)
    angle = math.tau / 4 * rest / count
    cosine, sine = math.cos(angle), math.sin(angle)
    for _ in range(quarters):
        cosine, sine = -sine, cosine
    return cosine, sine


def turned(p, middle, axis, cosine, sine):
    """A point turned about an axis of length 1 through the middle (Rodrigues)."""
    v = tuple(a - b for a, b in zip(p, middle))
    along = sum(a * b for a, b in zip(axis, v))
    return moved(p, (cosine - 1, v), (sine, cross(axis, v)), (along * (1 - cosine), axis))


def turn(scene, seconds, fps):
    """A camera for each frame of one turn of the scene's camera about the up direction through the scene's
    middle. The first frame is not repeated at the end, so that the film can be played in a loop."""
    count = max(2, round(seconds * fps))
    ends = [(float(scene.stats[axis + "_min"]), float(scene.stats[axis + "_max"])) for axis in "xyz"]
    middle, axis = [sum(pair) / 2 for pair in ends], normalized(scene.camera.up)
    turns = (cosine_and_sine(frame, count) for frame in range(count))
    points = (scene.camera.eye, scene.camera.look)
    return [Camera(*(turned(p, middle, axis, *at) for p in points), axis) for at in turns]
