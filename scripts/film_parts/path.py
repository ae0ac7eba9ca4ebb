"""The camera over time: keys in a file, and a curve through them."""
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


def camera_of(numbers):
    """The camera of 9 numbers (eye, look, up), or of 10 with a fovY."""
    return Camera(*(tuple(numbers[i:i + 3]) for i in (0, 3, 6)), *numbers[9:])


def is_usable(camera):
    """True if the camera has a direction, an up that is not along it, and an angle of view."""
    forward = tuple(b - a for a, b in zip(camera.eye, camera.look))
    size = math.hypot(*forward) * math.hypot(*camera.up)
    return size > 0 and math.hypot(*cross(forward, camera.up)) > 1e-12 * size and has_an_angle(camera)


def has_an_angle(camera):
    return camera.fov_y is None or 0 < camera.fov_y < 180


def read_path(data, path):
    """The keys of a file, two or more, in order of time: rows of the time and the camera's numbers."""
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
        camera = camera_of(numbers[1:])
        if not has_an_angle(camera):
            raise CommandFailure(place + f"expected a fovY above 0 and below 180, found {words[10]}")
        if not is_usable(camera):
            raise CommandFailure(
                place + "expected an eye apart from the look point, and an up that is not along their line")
        if keys and numbers[0] <= keys[-1][0]:
            raise CommandFailure(place + f"expected a time after {keys[-1][0]:g}, found {words[0]}")
        if keys and len(numbers) != len(keys[0]):
            raise CommandFailure(place + "expected a fovY on every line or on none")
        keys.append(numbers)
    if len(keys) < 2:
        raise CommandFailure(f"{name_of(path)}: expected two cameras or more, found {len(keys)}")
    return keys


def slopes(times, values):
    """The slope at each key (Catmull-Rom): from the key before to the key after; at an end, to its only
    neighbor."""
    last = len(times) - 1
    return [
        (values[min(i + 1, last)] - values[max(i - 1, 0)]) / (times[min(i + 1, last)] - times[max(i - 1, 0)])
        for i in range(last + 1)]


def hermite(t, h, a, b, slope_a, slope_b):
    """The cubic from a to b with these slopes at its ends, at the fraction t of an interval of length h."""
    return (a * (1 + 2 * t) * (1 - t)**2 + slope_a * h * t * (1 - t)**2 + b * t * t * (3 - 2 * t) +
            slope_b * h * t * t * (t - 1))


def cameras_of(keys, fps, linear):
    """A camera for every frame, from the first key's time to the last key's."""
    times, *curves = zip(*keys)
    slopes_of = [slopes(times, values) for values in curves]
    # Rounding must not cost the last frame.
    count = math.floor((times[-1] - times[0]) * fps + 1e-9) + 1
    cameras, i = [], 0
    for frame in range(count):
        time = times[0] + frame / fps
        while i + 2 < len(times) and time > times[i + 1]:
            i += 1
        h = times[i + 1] - times[i]
        t = (time - times[i]) / h
        t = round(t) if abs(t - round(t)) < 1e-9 else t  # exactly at a key, though times are rounded
        if linear:
            numbers = [values[i] * (1 - t) + values[i + 1] * t for values in curves]
        else:
            numbers = [
                hermite(t, h, values[i], values[i + 1], slope[i], slope[i + 1])
                for values, slope in zip(curves, slopes_of)]
        camera = camera_of(numbers)
        if not is_usable(camera):
            raise CommandFailure(
                f"at {time:g} s the path passes through a camera that shows nothing: add a key there, or use "
                "--linear")
        cameras.append(Camera(camera.eye, camera.look, normalized(camera.up), camera.fov_y))
    return cameras
