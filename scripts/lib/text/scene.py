"""The triangles of a scene that `model` has accepted: line, numbers, and the transforms in force."""
import dataclasses
import functools
import itertools

from lib.maths.exact import double
from lib.maths.matrices import IDENTITY, TRANSFORMS, product
from lib.text.projection import with_keyword

CAMERA_LINES = 4
SETTINGS = ("attributes", "background", "light", "ambient", "material", "absorption", "paint", "attenuation")
# The words of commands and their lines of arguments, as in libpipeline/scene/scene_commands.h.
ARGUMENT_LINES = {
    "triangle": 3, "push": 0, "pop": 0, "end": 0,
    **dict.fromkeys(("sphere", *TRANSFORMS, "color", "use", *SETTINGS), 1)}


@dataclasses.dataclass
class Command:
    line: int
    keyword: str
    arguments: list  # lists of words, one for each line

    def matrix(self, number=double):
        return TRANSFORMS[self.keyword]([number(word) for word in self.arguments[0]])


@dataclasses.dataclass
class SceneTriangle:
    line: int
    points: list  # the x, y and z of three vertices, as written
    columns: list  # the count of each vertex's further numbers
    in_force: object  # the last transform and those before it: (Command, (Command, ...)), or None

    @property
    def transforms(self):
        """The Commands, in the order of the scene."""
        return listed(self.in_force)

    def matrix(self, number=double):
        """The product of the transforms: each is multiplied from the right, so that the last one is applied
        first. `number` makes numbers of words."""
        matrices = (transform.matrix(number) for transform in self.transforms)
        return functools.reduce(product, matrices, IDENTITY)


def filled_lines(text):
    """The number and the words of each line that has some."""
    return ((number, words) for number, line in enumerate(text.split("\n"), 1)
            if (words := line.split("#")[0].split()))


def projection_words(text):
    """The words of the fourth line that has some; none if there is no such line."""
    return next(itertools.islice((words for _, words in filled_lines(text)), CAMERA_LINES - 1, None), [])


def camera(text):
    """The words of eye, look, up and, with its keyword, the projection."""
    *position, projection = (words for _, words in itertools.islice(filled_lines(text), CAMERA_LINES))
    return *position, with_keyword(projection)


def commands(text):
    """The commands of a scene, in order."""
    filled = filled_lines(text)
    for _ in range(CAMERA_LINES):
        next(filled)
    for number, (keyword, *rest) in filled:
        count = ARGUMENT_LINES[keyword]
        arguments = [rest] if rest else []  # the first line of arguments may begin beside the keyword
        while len(arguments) < count:
            arguments.append(next(filled)[1])
        yield Command(number, keyword, arguments)


def find_triangles(text):
    """Every SceneTriangle, in order."""
    in_force, saved = None, []
    for command in commands(text):
        if command.keyword in TRANSFORMS:
            in_force = (command, in_force)
        elif command.keyword == "push":
            saved.append(in_force)
        elif command.keyword == "pop":
            in_force = saved.pop()
        elif command.keyword == "triangle":
            lines = command.arguments
            yield SceneTriangle(command.line, [words[:3] for words in lines], len(lines[0]) - 3, in_force)


def find_triangle(text, number):
    """The SceneTriangle of a number counted from 0."""
    return next(itertools.islice(find_triangles(text), number, None))


def listed(in_force):
    transforms = []
    while in_force:
        transform, in_force = in_force
        transforms.append(transform)
    return transforms[::-1]
