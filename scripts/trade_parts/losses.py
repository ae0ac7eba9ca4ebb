"""The losses of each setting against the picture that exact arithmetic shows."""
import dataclasses
import filecmp
import functools
import itertools
import math
import operator
import sys

from lib.maths.vectors import cross, moved
from lib.rim.command import CommandFailure
from lib.running.owners import NOBODY
from lib.running.pipe import DEFAULT, exact
from lib.running.pipe_tools import ToolFailure, without_inner_location
from lib.text.projection import KEYWORDS, window_of
from lib.text.stage_text import triangle_lines

SAMPLES_OF_TRUTH = "8"
MOVES_AHEAD, MOVES_ASIDE = (-0.0002, 0.02), (0.003, -0.02)  # of the distance to the point looked at


@dataclasses.dataclass(frozen=True)
class Loss:
    wrong: int  # pixels that show another triangle, or none; None with trace, which numbers no triangles
    gap: float  # between layers, in the scene's units; None with trace, which has no text of project
    levels: float  # of 256, the mean over the channels of the pixels covered; None if none was asked for
    notes: tuple = ()  # of the stages
    uncertain: int = None  # pixels; None if nobody can tell


class Layers:
    """The distance at which two layers at the farthest vertex in the picture differ in depth."""
    def __init__(self, camera, window, vertices):
        """`camera` is the words of the projection, `vertices` are the exact vertex lines."""
        keyword, words = (camera[0], camera[1:]) if camera[0] in KEYWORDS else ("perspective", camera)
        self.near, self.far = window_of({keyword: words})[-2:]
        self.is_parallel, self.window = keyword == "ortho", window
        self.z = max((z for z in (float(line.split(None, 3)[2]) for line in vertices) if z <= window.rear),
                     default=1.0)

    def gap(self, setting):
        depths = {
            "f64": math.ulp(self.z), "f32": 2**29 * math.ulp(self.z),
            "u24": (self.window.rear - self.window.front) / (2**24 - 1)}
        step = depths[setting.depth] + float(setting.depth_epsilon)
        step += 0 if setting.digits == "exact" else 10.0**-int(setting.digits)
        if self.is_parallel:
            return step * (self.far - self.near) / 2
        # The distance, of z = (far + near - 2 far near / distance) / (far - near), is scale / remaining.
        scale = 2 * self.far * self.near / (self.far - self.near)
        remaining = 2 * self.near / (self.far - self.near) + 1 - self.z
        return scale * step / remaining / (remaining + step)


class Truth:
    """The exact picture, and the losses of settings against it."""
    def __init__(self, pipe, rule, window, is_smooth):
        self.pipe, self.setting = pipe, exact(rule)
        self.base = dataclasses.replace(DEFAULT, coverage=rule)
        path, _, notes = pipe.text(self.setting)
        for note in notes:
            print(f"trade: the exact run: {without_inner_location(note, pipe.folder)}", file=sys.stderr)
        self.owners = pipe.owners(self.setting)
        self.covered = sum(owner != NOBODY for owner in self.owners)
        if not self.covered:
            raise CommandFailure(
                "the picture of the exact run is empty: there is nothing to compare. Run the pipe to see why")
        with open(path, "rb") as text:
            header = itertools.takewhile(lambda line: line[:1].isalpha(), text)
            self.is_lit = any(line.startswith(b"light ") for line in header)
            text.seek(0)
            vertices = (line for _, corners in triangle_lines(text) for line in corners)
            self.layers = Layers(pipe.camera()[3], window, vertices)
        self.smooth = {"samples": SAMPLES_OF_TRUTH} if is_smooth else {}

    @functools.cached_property
    def moved_pipes(self):
        """Pipes with the eye moved a little, and the triangles that they show exactly."""
        eye, look, up = (tuple(map(float, line[-3:])) for line in self.pipe.camera()[:3])
        ahead = [q - p for p, q in zip(eye, look)]
        aside, found = cross(ahead, up), []
        length, width = math.hypot(*ahead), math.hypot(*aside)
        aside = [x / width * length for x in aside]
        steps = [(part, ahead) for part in MOVES_AHEAD] + [(part, aside) for part in MOVES_ASIDE]
        for i, step in enumerate(steps):
            pipe = self.pipe.with_eye(moved(eye, step), self.pipe.folder / f"eye {i}")
            found.append((pipe, pipe.owners(self.setting)))
            pipe.forget_texts(self.setting.of_texts)
        return found

    def wrong_if_moved(self, setting):
        """The most wrong pixels in a picture with the eye moved a little: with few digits all pixels may be
        right by luck."""
        most = 0
        for pipe, owners in self.moved_pipes:
            most = max(most, sum(map(operator.ne, pipe.owners(setting), owners)))
            pipe.forget_texts(setting.of_texts)
        return most

    def uncertain(self, setting):
        """The number of pixels that `zbuf --certify` calls uncertain; None if it is refused."""
        path = self.pipe.folder / "uncertain.txt"
        certified, bounded = (dataclasses.replace(setting, certify=word) for word in (str(path), "-"))
        self.pipe.forget_texts(bounded.of_texts)
        try:
            text = self.pipe.text(bounded)[0]
            self.pipe.tools.run("zbuf", *self.pipe.words("zbuf", certified), "--image",
                                self.pipe.folder / "out.ppm", "--z-buffer", "none", self.pipe.config, text)
        except ToolFailure:
            return None
        return int(dict(line.split()[:2] for line in path.read_text().splitlines())["uncertain"])

    @functools.cache
    def colors(self, is_traced):
        sampling = "regular" if is_traced else "none"
        return self.pipe.colors(dataclasses.replace(self.setting, sampling=sampling, **self.smooth))

    def levels(self, setting):
        errors = map(operator.sub, self.pipe.colors(setting), self.colors(setting.is_traced))
        return sum(map(abs, errors)) / (3 * self.covered)

    @functools.cache
    def feels(self, setting):
        """True if the setting changes something; of two levers, if each does."""
        base = dataclasses.replace(self.base, digits=setting.digits)
        single = [dataclasses.replace(base, **{name: getattr(setting, name)}) for name in ("clip", "cull")]
        return all(map(self.feels, single)) if base not in single else self.changes(setting)

    def changes(self, setting):
        """True if clipping, culling, epsilon or shading changes the text or the picture, or if --certify is
        not refused; True for other levers."""
        try:
            if setting.certify != DEFAULT.certify:
                return bool(self.pipe.text(setting))
            if setting.shading != DEFAULT.shading:
                return self.is_lit and self.pipe.colors(setting) != self.pipe.colors(self.base)
            if setting.depth_epsilon != DEFAULT.depth_epsilon:
                return self.pipe.owners(setting) != self.pipe.owners(self.base)
            return (setting.clip, setting.cull) == (DEFAULT.clip, DEFAULT.cull) or not filecmp.cmp(
                self.pipe.text(setting)[0],
                self.pipe.text(self.base)[0], shallow=False)
        except ToolFailure as failure:
            message = without_inner_location(str(failure), self.pipe.folder)
            print(f"trade: note: {setting} is left out: {message}", file=sys.stderr)
            return False

    def loss(self, setting, in_color):
        levels = self.levels(setting) if in_color else None
        if setting.is_traced:
            return Loss(None, None, levels)
        wrong = sum(map(operator.ne, self.pipe.owners(setting), self.owners))
        notes = tuple(without_inner_location(note, self.pipe.folder) for note in self.pipe.text(setting)[2])
        return Loss(wrong, self.layers.gap(setting), levels, notes, self.uncertain(setting))


def losses(truth, settings, progress):
    """{setting: Loss} for the settings that matter in the scene, in their order. A text is kept only while
    settings need it."""
    settings, found = list(settings), {}
    progress("shading")
    unfelt = {setting for setting in settings if setting.is_of_color and not truth.feels(setting)}
    in_color = any(setting.is_of_color for setting in settings if setting not in unfelt)
    for key in dict.fromkeys(setting.of_texts for setting in settings):
        for setting in (setting for setting in settings if setting.of_texts == key and setting not in unfelt):
            progress(f"the errors of {setting}")
            if setting.is_of_color or truth.feels(setting):
                found[setting] = truth.loss(setting, in_color)
        if key not in (truth.base.of_texts, truth.setting.of_texts):
            truth.pipe.remove_texts(key)
    return {setting: found[setting] for setting in settings if setting in found}
