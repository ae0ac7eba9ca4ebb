"""Pictures whose triangles have many colors, which no search for a rule can explain."""
import collections
import dataclasses

from lib.judging.pixel_words import place_in_words
from lib.judging.verdict import WRONG, cause_of, joined


def blames_many_colors(verdict, shown, context, mismatch):
    """Adds many colors to the causes in a picture's FileVerdict; False unless, where a Mismatch finds
    nothing, more pixels lack their triangle's main color than the Mismatch has."""
    drawing = context.drawing(mismatch.reading, mismatch.rule)
    pixels = shown.pixels(mismatch.rule.picture_flip, mismatch.rule.text_flip)
    seen = {(row, column): (t, pixels.colors[row][column])
            for row in range(context.window.height) for column, t in enumerate(drawing.row(row)[0])
            if t >= 0 and pixels.drawn[row][column] and (row, column) not in mismatch.pixels}
    counts = collections.Counter(seen.values())
    main = {t: color for (t, color), _ in reversed(counts.most_common())}
    places = {place: t for place, (t, color) in seen.items() if color != main[t]}
    if len(places) <= len(mismatch.of("picture")):
        return False
    detail = f"{len(shown.own_colors):,} for {mismatch.triangle_count:,} triangles"
    many = cause_of("zbuf/many-colors", detail)
    verdict.causes = [
        dataclasses.replace(joined([cause, many]), detail=detail)
        for cause in verdict.causes if cause.name != "zbuf/one-color"] or [many]
    verdict.remarks += [f"with {verdict.rule}"] if verdict.rule else []
    verdict.verdict, verdict.rule = WRONG, ""
    verdict.differing += len(places)
    if verdict.explained:  # they differ all the same
        verdict.explained -= len(places.keys() & context.of_one_file("picture").plain.of("picture"))
    verdict.places = sorted({*verdict.places, *places})
    place, t = min(places.items())
    count = sum(t == other for other, _ in counts)
    verdict.first = f"{place_in_words(place, context.window.width)}: one of {count:,} colors of triangle {t}"
    return True
