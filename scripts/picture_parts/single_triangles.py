"""Draws single triangles of a scene, also at pixels whose centers rounding has moved across their edges."""
from lib.maths.balls import exactly
from lib.maths.matrices import applied, product
from lib.running.pipe_tools import ToolFailure
from picture_parts.exact_pixels import to_view_space

NOTHING = -1  # where no triangle is seen, as zbuf has it
EXACT = ("--digits", "exact")
NUMBERS = tuple("-0123456789")  # which begin with these
GROWTHS = (0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3)  # parts of it; the least is taken by which it covers a center


class SingleTriangles:
    def __init__(self, tools, scene, draw):
        """`scene` is text that model takes; `draw` makes a picture file, and the numbers of the triangles
        that its pixels show, of a text of project."""
        self.tools, self.draw = tools, draw
        self.to_view_space = to_view_space(scene)
        data = scene.encode(errors="surrogateescape")
        lines = tools.output("model", *EXACT, stdin=data).decode().split("\n")
        begin = next((i for i, line in enumerate(lines) if not line[:1].isalpha()), len(lines))
        self.header, self.body = lines[:begin], lines[begin:]

    def drawn(self, number, triangle, places):
        """Pairs of a picture file that shows triangle `number` alone, and those of the places that are drawn
        there. If it is NOTHING, these are all."""
        for growth in GROWTHS:
            try:
                picture, owners = self.draw(grown(self.projected(number, triangle), growth).encode())
            except ToolFailure:  # of a coordinate that is too large
                return
            found = {place for place in places if owners[place] == number}
            yield picture, found
            places = places - found
            if not places:
                return

    def projected(self, number, triangle):
        """The text of project of this triangle alone, without what rounding before has done to its position.
        That of model has four lines for each."""
        lines = self.header if number == NOTHING else [
            *self.header, f"triangle {number}", *self.body[4 * number:4 * number + 4]]
        text = self.tools.output("view", *EXACT, stdin="\n".join([*lines, ""]).encode()).decode()
        lines = text.split("\n")
        matrix = triangle and product(self.to_view_space, triangle.matrix(exactly))
        corners = [at for at, line in enumerate(lines) if line[:1] in NUMBERS]
        for at, words in zip(corners, triangle.points if triangle else ()):
            p = applied(matrix, [exactly(word) for word in words])
            lines[at] = " ".join([*(repr(float(x)) for x in p[:3]), *lines[at].split()[3:]])
        return self.tools.output("project", *EXACT, stdin="\n".join(lines).encode()).decode()


def grown(text, growth):
    """A text of project with each triangle, or piece of one, larger by this part in x and y."""
    lines, corners, passed_over = text.split("\n"), [], 0
    for at, line in enumerate(lines):
        if line == "clipped":
            passed_over = 3
        elif line[:1] in NUMBERS and passed_over:
            passed_over -= 1
        elif line[:1] in NUMBERS:
            corners.append(at)
            if len(corners) == 3:
                grow(lines, corners, growth)
                corners = []
    return "\n".join(lines)


def grow(lines, corners, growth):
    words = [lines[at].split() for at in corners]
    axes = [[float(word) for word in column] for column in list(zip(*words))[:2]]
    for axis, places in enumerate(axes):
        middle = sum(x / 3 for x in places)
        for corner, x in zip(words, places):
            corner[axis] = repr(x + growth * (x - middle))
    for at, corner in zip(corners, words):
        lines[at] = " ".join(corner)
