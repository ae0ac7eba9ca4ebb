"""Draws single triangles of a scene, also at pixels whose centers rounding has moved across their edges."""
from fractions import Fraction

from lib.maths.balls import exactly
from lib.maths.matrices import applied, product
from lib.running.owners import NOBODY
from lib.running.pipe_tools import ToolFailure
from lib.text.stage_text import header_and_body
from picture_parts.exact_pixels import to_view_space

EXACT = ("--digits", "exact")
GROWTHS = (0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3)  # relative; tried until the triangle covers the center


class SingleTriangles:
    def __init__(self, tools, scene, draw):
        """`scene` is text that model takes; `draw` makes of a text of project a picture file, and the numbers
        of the triangles that its pixels show."""
        self.tools, self.draw = tools, draw
        self.to_view_space = to_view_space(scene)
        self.header, self.body = header_and_body(
            tools.output("model", *EXACT, stdin=scene.encode(errors="surrogateescape")))

    def drawn(self, number, triangle, places):
        """Pairs of a picture file that shows triangle `number` alone, and the places that show it there; all
        places if `number` is NOBODY."""
        text = self.in_view_space(number)
        for growth in GROWTHS:
            try:
                picture, owners = self.draw(self.projected(text, triangle, growth))
            except ToolFailure:  # a coordinate is too large
                return
            found = {place for place in places if owners[place] == number}
            yield picture, found
            places = places - found
            if not places:
                return

    def in_view_space(self, number):
        """The text of view of this triangle alone."""
        lines = self.header if number == NOBODY else [
            *self.header, f"triangle {number}", *self.body[4 * number:4 * number + 4]]
        return self.tools.output("view", *EXACT, stdin="\n".join([*lines, ""]).encode())

    def projected(self, text, triangle, growth):
        """The text of project for a text of view, whose triangle, if any, gets its exact corners, moved away
        from its middle by the part `growth`."""
        header, body = header_and_body(text)
        points = self.exact_points(triangle) if triangle else []
        middle = [sum(axis) * Fraction(1, 3) for axis in zip(*points)]
        for at, p in enumerate(points):
            grown = [x + (x - m) * Fraction(growth) for x, m in zip(p, middle)]
            body[at] = " ".join([*(repr(float(x)) for x in grown), *body[at].split()[3:]])
        return self.tools.output("project", *EXACT, stdin="\n".join([*header, *body]).encode())

    def exact_points(self, triangle):
        """The triangle's corners in view space."""
        matrix = product(self.to_view_space, triangle.matrix(exactly))
        return [applied(matrix, [exactly(word) for word in words])[:3] for words in triangle.points]
