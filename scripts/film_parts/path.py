"""Cameras over time: a file of keys, and a curve through them."""
import math
from dataclasses import dataclass
from typing import Optional

from lib.maths.vectors import cross, normalized
from lib.rim.command import CommandFailure
from lib.rim.input_file import name_of


@dataclass(frozen=True)
class Camera:
    eye: tuple
    look: tuple
    up: tuple
    fov_y: Optional[float] = None  # degrees; None: the scene's


@dataclass(frozen=True)
class Key:
    time: float  # seconds
    camera: Camera


def is_usable(camera):
    """True if the camera has a direction, and an up that is not along it."""
    forward = tuple(b - a for a, b in zip(camera.eye, camera.look))
    size = math.hypot(*forward) * math.hypot(*camera.up)
    return size > 0 and math.hypot(*cross(forward, camera.up)) > 1e-12 * size


def read_path(data, path):
    """The keys of a file, in the order of their times; at least two."""
    keys = []
    for number, line in enumerate(data.decode(errors="replace").splitlines(), 1):
        words = line.partition("#")[0].split()
        if not words:
            continue
        place = f"{name_of(path)}:{number}: "
        try:
            numbers = [float(word) for word in words]
        except ValueError:
            numbers = []
        if len(numbers) not in (10, 11) or not all(map(math.isfinite, numbers)):
            raise CommandFailure(
                place + f"expected the time, eye, look and up, and perhaps fovY: 10 or 11 numbers, found "
                f"'{' '.join(words)[:60]}'")
        camera = Camera(tuple(numbers[1:4]), tuple(numbers[4:7]), tuple(numbers[7:10]),
                        numbers[10] if len(numbers) == 11 else None)
        if camera.fov_y is not None and not 0 < camera.fov_y < 180:
            raise CommandFailure(place + f"expected a fovY above 0 and below 180, found {words[10]}")
        if not is_usable(camera):
            raise CommandFailure(
                place + "expected an eye apart from the look point, and an up that is not along their line")
        if keys and numbers[0] <= keys[-1].time:
            raise CommandFailure(place + f"expected a time after {keys[-1].time:g}, found {words[0]}")
        if keys and (camera.fov_y is None) != (keys[0].camera.fov_y is None):
            raise CommandFailure(place + "expected a fovY on every line or on none")
        keys.append(Key(numbers[0], camera))
    if len(keys) < 2:
        raise CommandFailure(f"{name_of(path)}: expected two cameras or more, found {len(keys)}")
    return keys


def numbers_of(camera):
    return [*camera.eye, *camera.look, *camera.up, *([] if camera.fov_y is None else [camera.fov_y])]


def slopes(times, values):
    """Catmull-Rom: at a key, the slope from its neighbor before to that after; at an end, to its only
    neighbor."""
    last = len(times) - 1
    return [
        (values[min(i + 1, last)] - values[max(i - 1, 0)]) / (times[min(i + 1, last)] - times[max(i - 1, 0)])
        for i in range(last + 1)]


def hermite(t, h, a, b, slope_a, slope_b):
    """The cubic from a to b with these slopes, at the part t of an interval of length h."""
    return (a * (1 + 2 * t) * (1 - t)**2 + slope_a * h * t * (1 - t)**2 + b * t * t * (3 - 2 * t) +
            slope_b * h * t * t * (t - 1))


def cameras_of(keys, fps, linear):
    """A camera for every frame, from the first key's time to the last's."""
    times = [key.time for key in keys]
    curves = list(zip(*(numbers_of(key.camera) for key in keys)))
    slopes_of = [slopes(times, values) for values in curves]
    # The last frame is there in spite of rounding.
    count = math.floor((times[-1] - times[0]) * fps + 1e-9) + 1
    cameras, i = [], 0
    for frame in range(count):
        time = times[0] + frame / fps
        while i + 2 < len(times) and time > times[i + 1]:
            i += 1
        h = times[i + 1] - times[i]
        t = (time - times[i]) / h
        if abs(t - round(t)) < 1e-9:  # at a key, up to the rounding of times
            t = round(t)
        if linear:
            numbers = [values[i] * (1 - t) + values[i + 1] * t for values in curves]
        else:
            numbers = [
                hermite(t, h, values[i], values[i + 1], slope[i], slope[i + 1])
                for values, slope in zip(curves, slopes_of)]
        camera = Camera(tuple(numbers[0:3]), tuple(numbers[3:6]), tuple(numbers[6:9]),
                        numbers[9] if len(numbers) == 10 else None)
        if not is_usable(camera) or not (camera.fov_y is None or 0 < camera.fov_y < 180):
            raise CommandFailure(
                f"at {time:g} s the way between the cameras leads through one that shows nothing: add a key "
                f"there, or take --linear")
        cameras.append(Camera(camera.eye, camera.look, normalized(camera.up), camera.fov_y))
    return cameras
