"""Pictures whose triangles have many colors, which no search for a rule can explain: they are looked for
first, and the pixels are then judged as if all had one color."""
import collections
import dataclasses

from lib.judging.pixel_words import place_in_words
from lib.judging.verdict import WRONG, cause_of, joined

# A picture has many colors if it has more than COLORS for each triangle and SOME more: no frame and no stray
# pixel has so many.
COLORS, SOME = 2, 8


def has_many(shown, triangle_count):
    """True if a picture must have many colors in a triangle."""
    return bool(shown.colors) and len(shown.own_colors) > COLORS * triangle_count + SOME


def is_another_picture(context):
    """True if more pixels of the outlines differ than there are to draw: no color then is a triangle's."""
    return len(context.plain.of_shape) > context.plain.drawn


class ManyColors:
    """The pixels of a Shown that have another color than most of their triangle, where a Mismatch leaves the
    outlines right."""
    def __init__(self, shown, context, mismatch):
        self.count, self.mismatch, self.width = len(shown.own_colors), mismatch, context.window.width
        self.triangle_count, rule = mismatch.triangle_count, mismatch.rule
        drawing = context.drawing(mismatch.reading, rule)
        pixels = shown.pixels(rule.picture_flip, rule.text_flip)
        seen, counts = {}, collections.defaultdict(collections.Counter)
        for row in range(context.window.height):
            for column, t in enumerate(drawing.row(row)[0]):
                if t >= 0 and pixels.drawn[row][column] and (row, column) not in mismatch.pixels:
                    seen[row, column] = t
                    counts[t][pixels.colors[row][column]] += 1
        main = {t: colors.most_common(1)[0][0] for t, colors in counts.items()}
        self.places = {(row, column): t
                       for (row, column), t in seen.items() if pixels.colors[row][column] != main[t]}
        self.of_triangle = {t: len(colors) for t, colors in counts.items()}

    @property
    def explain_most(self):
        """True if more pixels differ in this way than in any other."""
        return len(self.places) > len(self.mismatch.of("picture"))

    def add_to(self, verdict):
        """Makes this the cause of the picture's FileVerdict, or a further one beside its own."""
        detail = f"{self.count:,} for {self.triangle_count:,} triangles"
        many = cause_of("zbuf/many-colors", detail)
        verdict.causes = [
            dataclasses.replace(joined([cause, many]), detail=detail)
            for cause in verdict.causes if cause.name != "zbuf/one-color"] or [many]
        if verdict.rule:
            verdict.remarks.append(f"with {verdict.rule}")
        verdict.verdict, verdict.rule = WRONG, ""
        verdict.differing += len(self.places)
        verdict.places = sorted({*verdict.places, *self.places})
        place, t = min(self.places.items())
        words = f"one of {self.of_triangle[t]:,} colors of triangle {t}"
        verdict.first = f"{place_in_words(place, self.width)}: {words}"
