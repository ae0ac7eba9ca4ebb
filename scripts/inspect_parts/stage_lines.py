"""A text of our own tools, line by line."""
import dataclasses

NUMBER_BEGINS = tuple("-0123456789")


@dataclasses.dataclass
class StageLines:
    """A text of our own tools: its header, {keyword: words}; the number and first line of each triangle (or
    piece of one) and of each sphere; and `count`, one more than the last number."""
    lines: list
    header: dict
    names: list
    first_lines: list
    spheres: list
    count: int = 0

    @staticmethod
    def of(text):
        """Parses our own text, faster than parse_stage_text, which accepts any."""
        lines = text.split("\n")
        found = StageLines(lines, {}, [], [], [])
        number, corners = 0, 0  # the next triangle's number, and the lines of the current one still to come
        for at, line in enumerate(lines, 1):
            if line[:1] in NUMBER_BEGINS:
                if corners == 0:
                    found.names.append(number)
                    found.first_lines.append(at)
                    number, corners = number + 1, 3
                corners -= 1
            elif line.startswith("triangle "):
                number = int(line[9:])
            elif line == "clipped":  # the whole triangle in clip space; its pieces follow
                corners = 3
            elif line == "sphere":  # no triangle, but it has a number
                found.spheres.append((number, at + 1))
                number, corners = number + 1, 4
            elif line and not found.names and not found.spheres:
                found.header[line.split()[0]] = line.split()[1:]
        found.count = number
        return found

    def points(self):
        """The vertices of all triangles, one by one."""
        for line in self.first_lines:
            for text in self.lines[line - 1:line + 2]:
                yield tuple(map(float, text.split(" ", 3)[:3]))
