"""A scene's text with another camera, and with its first light moved."""
import itertools

from lib.rim.command import CommandFailure
from lib.text.scene import filled_lines


def words_of(line):
    return line.split("#")[0].split()


def without_first_light(lines):
    """The lines without the first command `light` and its numbers."""
    for i, line in enumerate(lines):
        if words_of(line)[:1] == ["light"]:
            end = i + 1
            if len(words_of(line)) == 1:  # its numbers are on the next line that has any
                while end < len(lines) and not words_of(lines[end]):
                    end += 1
                end += 1
            return lines[:i] + lines[end:]
    return lines


def rewritten(scene, camera_lines, light=None):
    """The scene with eye, look and up replaced. `light`, six words, replaces the first light; it goes in
    front of all transforms, since its position is in world space."""
    lines = scene.split("\n")
    places = [number - 1 for number, _ in itertools.islice(filled_lines(scene), 4)]
    if len(places) < 4:  # an editor may be writing it
        raise CommandFailure("the scene ends before its projection")
    for place, words in zip(places, camera_lines):
        comment = lines[place].partition("#")
        lines[place] = " ".join(words) + ("  #" + comment[2] if comment[1] else "")
    head, rest = lines[:places[3] + 1], lines[places[3] + 1:]
    if light:
        rest = ["light " + " ".join(light), *without_first_light(rest)]
    return "\n".join(head + rest)
