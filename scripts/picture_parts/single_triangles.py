"""Draws single triangles of a scene, also at pixels whose centers rounding has moved across their edges."""
from lib.running.pipe_tools import ToolFailure

EXACT = ("--digits", "exact")
GROWTHS = (1e-9, 1e-6, 1e-3)  # parts of a triangle; the least is taken by which it covers a center


class SingleTriangles:
    def __init__(self, tools, scene, draw):
        """`scene` are bytes that model takes; `draw` makes a picture file, and the numbers of the triangles
        that its pixels show, of a text of project."""
        self.tools, self.draw = tools, draw
        lines = tools.output("model", *EXACT, stdin=scene).decode().split("\n")
        begin = next((i for i, line in enumerate(lines) if not line[:1].isalpha()), len(lines))
        self.header, self.body = lines[:begin], lines[begin:]

    def drawn(self, number, places):
        """Pairs of a picture file that shows triangle `number` alone, and those of the places that are drawn
        there. Without a number it shows none, and all places."""
        text = self.projected(number)
        for growth in GROWTHS:
            try:
                picture, owners = self.draw(grown(text, growth).encode())
            except ToolFailure:  # of a coordinate that has become too large
                return
            found = {place for place in places if number is None or owners[place] == number}
            yield picture, found
            places = places - found
            if not places:
                return

    def projected(self, number):
        """The text of project of this triangle alone; that of model has four lines for each."""
        lines = self.header if number is None else [
            *self.header, f"triangle {number}", *self.body[4 * number:4 * number + 4]]
        return self.tools.through(["view", *EXACT], ["project", *EXACT],
                                  stdin="\n".join([*lines, ""]).encode()).decode()


def grown(text, growth):
    """A text of project with each triangle, or piece of one, larger by this part in x and y."""
    lines, corners, passed_over = text.split("\n"), [], 0
    for at, line in enumerate(lines):
        if line == "clipped":
            passed_over = 3
        elif line[:1] not in ("", *"-0123456789"):
            continue
        elif line and passed_over:
            passed_over -= 1
        elif line:
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
