"""What a rule of stage 4 leaves unexplained, and what has been found."""
import collections
import dataclasses

from lib.judging.raster import Rule


@dataclasses.dataclass
class Mismatch:
    """The pixels that a rule does not explain: {(row, column): kind}, where kind is extra, missing, other or
    depth."""
    rule: Rule
    reading: str
    pixels: dict = dataclasses.field(default_factory=dict)
    drawn: int = 0       # pixels with a triangle, by the rule
    offsets: dict = dataclasses.field(default_factory=dict)  # of depths, at these pixels
    colors: dict = dataclasses.field(default_factory=dict)  # of each triangle, by the majority of its pixels
    visible: collections.Counter = dataclasses.field(default_factory=collections.Counter)
    owners: dict = dataclasses.field(default_factory=dict)  # by the rule, of these pixels
    triangle_count: int = 0
    by_color: dict = None
    unplaced: set = None  # triangles that share their color with a larger one, or show no pixel

    @property
    def of_shape(self):
        return [place for place, kind in self.pixels.items() if kind in ("extra", "missing")]

    def of_color(self, color):
        """The triangles that a color may stand for: those whose color it is, else those that have none to
        themselves."""
        if self.by_color is None:
            self.by_color = collections.defaultdict(set)
            for t, own in self.colors.items():
                self.by_color[own].add(t)
            largest = {max(group, key=lambda t: self.visible[t]) for group in self.by_color.values()}
            self.unplaced = set(range(self.triangle_count)) - largest
        return self.by_color.get(color) or self.unplaced

    def shows_another(self, place, pixels):
        """Whether a pixel with a triangle has the color of another one than by the rule."""
        row, column = place
        return pixels.drawn[row][column] and self.owners.get(place, -1) not in self.of_color(
            pixels.colors[row][column])

    def of(self, kind):
        """The pixels that differ in the depths or in the picture."""
        own = "other" if kind == "picture" else "depth"
        return [place for place, found in self.pixels.items() if found in ("extra", "missing", own)]


@dataclasses.dataclass
class Finding:
    """What has been found about stage 4."""
    verdict: str                # exact, borders, mistake, unknown
    mismatch: Mismatch = None
    rule: str = ""              # in words, if it is another one
    causes: list = dataclasses.field(default_factory=list)
    touches: tuple = ("depths", "picture")  # the files that the mistake spoils
    remarks: list = dataclasses.field(default_factory=list)
