"""How far the vertices of a setting are from those of the exact run."""
import itertools
import math

from lib.stage_text import triangle_lines


def numbers_of(line):
    return tuple(map(float, line.split(None, 3)[:3]))


class Screen:
    """Where the window of a config shows what is in NDC, in doubles."""

    def __init__(self, window):
        self.limits = -float(window.left), -float(window.bottom)  # on the right and at the top
        self.size = window.width, window.height

    def pixels_between(self, true, p):
        """How far two positions of a vertex are apart, in pixels; where both are outside the window, as much
        as reaches it."""
        reach = max(1, *(abs(x) / high for x, high in zip(true, self.limits)))
        dx, dy = ((x - t) / (2 * high) * count / reach
                  for t, x, high, count in zip(true, p, self.limits, self.size))
        return math.hypot(dx, dy)


def vertex_pairs(true_path, path):
    """(line of the lossless text, line) of each vertex; not of triangles that were cut into other numbers of
    pieces."""
    with open(true_path, "rb") as true_file, open(path, "rb") as file:
        groups = [
            itertools.groupby(triangle_lines(lines), key=lambda triangle: triangle[0])
            for lines in (true_file, file)]
        heads = [next(group, None) for group in groups]
        while all(heads):
            behind = [i for i in (0, 1) if heads[i][0] <= heads[1 - i][0]]
            if len(behind) == 2:
                pieces = [[corner for _, corners in head[1] for corner in corners] for head in heads]
                if len(pieces[0]) == len(pieces[1]):
                    yield from zip(*pieces)
            for i in behind:
                heads[i] = next(groups[i], None)


def largest_error(true_path, path, screen):
    """In pixels, of a vertex of the text of project at `path` against the exact one."""
    largest = 0.0
    pixels = [count / (2 * high) for count, high in zip(screen.size, screen.limits)]
    for true_line, line in vertex_pairs(true_path, path):
        if true_line == line:
            continue
        true, p = numbers_of(true_line), numbers_of(line)
        dx, dy = p[0] - true[0], p[1] - true[1]
        # Of millions of vertices few exceed those before them; the window only makes errors smaller.
        if (dx * pixels[0])**2 + (dy * pixels[1])**2 > largest**2:
            largest = max(largest, screen.pixels_between(true, p))
    return largest
