"""The findings on the two files of stage 4, together and each by itself; and pictures whose triangles have
many colors, which no search for a rule can explain."""
import collections
import dataclasses

from lib.judging.borders import BorderRule
from lib.judging.pixel_rules import CENTER
from lib.judging.pixel_search import by_open_rule, exact, finding_of, sample_rows, unknown
from lib.judging.pixel_words import place_in_words
from lib.judging.raster import Rule
from lib.judging.verdict import WRONG, cause_of, joined


class Findings:
    """The Findings of a pixel_comparing.Context: `of_all` files, and `of` one. A file that is right by itself
    is right whatever the other holds; else its own rule counts."""
    def __init__(self, context, picture=None):
        """`picture` is the Finding of a picture that need not be searched."""
        self.context, self.of_one = context, {"picture": picture} if picture else {}
        # If one of two files shows nothing, each is judged alone.
        blank = context.shown.blank.values()
        self.is_apart = picture or any(blank) and not all(blank) and context.plain.drawn
        self.of_all = None if self.is_apart else finding_of(context)

    def of(self, kind):
        if kind not in self.of_one:
            alone = self.context.of_one_file(kind)
            self.of_one[kind] = finding_of(alone) if self.is_apart else (
                self.own_finding(kind, alone) if len(self.context.shown.blank) == 2 else self.of_all)
        return self.of_one[kind]

    def own_finding(self, kind, alone):
        found = self.own_by_rule(kind, alone)
        if not self.explains_most(kind, found):
            found = self.by_the_rule_of_the_picture() if kind == "depths" else finding_of(alone)
        return found if self.explains_most(kind, found) else unknown(self.context.plain)

    def explains_most(self, kind, finding):
        """True if a cause explains more pixels of a file than it leaves, and the other file does not
        contradict it: a cause in the depths cannot explain the picture alone, nor one in the outlines the
        text alone."""
        if finding.verdict != "mistake" or kind not in finding.touches:
            return True
        plain, rule = self.context.plain, finding.mismatch.rule
        if plain.of(kind) and 2 * len(finding.mismatch.of(kind)) >= len(plain.of(kind)):
            return False
        if rule.picture_flip or rule.text_flip or kind == "picture" and not rule.is_of_depths:
            return True
        other = "picture" if kind == "depths" else "depths"
        before, after = (len(mismatch.of(other))
                         for mismatch in (plain, self.context.compare(finding.mismatch.reading, rule)))
        return 2 * after < before or before == after == 0

    def own_by_rule(self, kind, alone):
        both = self.of_all
        spoils_one = both.verdict == "mistake" and len(both.touches) == 1
        is_blank = both.mismatch is self.context.plain and all(self.context.shown.blank.values())
        if both.verdict == "exact" or spoils_one or is_blank:
            return both
        if both.verdict == "unknown":
            return self.own_if_both_are_unknown(kind, alone)
        if both.verdict != "mistake":
            return by_open_rule(alone, sample_rows(alone, alone.plain)) or both
        found = (exact(alone.compare(reading, rule, limit=0), alone.shown)
                 for rule in (Rule(), Rule(**CENTER)) for reading in self.context.readings)
        # A picture of one color may come from a mistake found.
        return next((one for one in found if one and one.verdict == "exact"), both)

    def own_if_both_are_unknown(self, kind, alone):
        found = finding_of(alone)
        if kind == "depths" and found.verdict == "unknown":
            return self.by_the_rule_of_the_picture()
        if kind == "depths" or found.verdict not in ("exact", "borders"):
            return found
        by_both = self.context.compare(found.mismatch.reading, found.mismatch.rule)
        return found if BorderRule(self.context, by_both).shows_each_triangle else self.of_all

    def by_the_rule_of_the_picture(self):
        """The Finding of depths that nothing explains."""
        found = self.of("picture")
        if found.verdict not in ("exact", "borders"):
            return self.of_all
        return unknown(self.context.compare(found.mismatch.reading, found.mismatch.rule))


def mismatch_to_show(context, finding, is_wrong):
    """The Mismatch to show for a Finding: the pixels that its mistake explains, if it `is_wrong` by one, and
    those that its rule changes, if it is another one than ours."""
    found, rule = finding.mismatch, finding.mismatch.rule
    is_by_mistake = is_wrong and finding.causes
    if not (is_by_mistake or finding.rule and not found.pixels):
        return found
    before = Rule(rule.left, rule.right, rule.depth, rule.clamp) if is_by_mistake else Rule()
    mismatch = context.compare(found.reading, before)
    explained = {place: kind for place, kind in mismatch.pixels.items() if place not in found.pixels}
    return dataclasses.replace(mismatch, pixels=explained)


def blames_many_colors(verdict, shown, context, mismatch):
    """Makes many colors the cause of a picture's FileVerdict, or a further one beside its own; False if
    fewer pixels of a Shown have another color than most of their triangle, where a Mismatch leaves the
    outlines right, than differ by themselves."""
    rule, seen, counts = mismatch.rule, {}, collections.defaultdict(collections.Counter)
    drawing = context.drawing(mismatch.reading, rule)
    pixels = shown.pixels(rule.picture_flip, rule.text_flip)
    for row in range(context.window.height):
        for column, t in enumerate(drawing.row(row)[0]):
            if t >= 0 and pixels.drawn[row][column] and (row, column) not in mismatch.pixels:
                seen[row, column] = t
                counts[t][pixels.colors[row][column]] += 1
    main = {t: colors.most_common(1)[0][0] for t, colors in counts.items()}
    places = {(row, column): t for (row, column), t in seen.items() if pixels.colors[row][column] != main[t]}
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
    explained = places.keys() & context.of_one_file("picture").plain.of("picture") if verdict.explained else (
    )
    verdict.explained -= len(explained)  # they differ all the same
    verdict.places = sorted({*verdict.places, *places})
    place, t = min(places.items())
    verdict.first = (f"{place_in_words(place, context.window.width)}: one of {len(counts[t]):,} colors of "
                     f"triangle {t}")
    return True
