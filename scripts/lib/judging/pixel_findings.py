"""The findings on the two files of stage 4, together and each by itself."""
import functools

from lib.judging.borders import BorderRule
from lib.judging.pixel_rules import CENTER
from lib.judging.pixel_search import by_open_rule, exact, finding_of, sample_rows, unknown
from lib.judging.raster import Rule


class Findings:
    """The Findings of a pixel_comparing.Context: `of_all` files, and `of` one. A file that is right by itself
    is right whatever the other holds; else its own rule counts."""
    def __init__(self, context, picture=None):
        """`picture` is the Finding of a picture that need not be searched."""
        self.context, self.picture, self.of = context, picture, functools.cache(self.of)
        # If one of two files shows nothing, each is judged alone.
        blank = context.shown.blank.values()
        self.is_apart = picture or any(blank) and not all(blank) and context.plain.drawn
        self.of_all = None if self.is_apart else finding_of(context)

    def of(self, kind):
        if self.picture and kind == "picture":
            return self.picture
        alone = self.context.of_one_file(kind)
        if self.is_apart or len(self.context.shown.blank) < 2:
            return finding_of(alone) if self.is_apart else self.of_all
        found = self.own_by_rule(kind, alone)
        if not self.explains_most(kind, found):
            found = self.by_the_rule_of_the_picture() if kind == "depths" else finding_of(alone)
        return found if self.explains_most(kind, found) else unknown(self.context.plain)

    def explains_most(self, kind, finding):
        """True if a cause explains more pixels of a file than it leaves, and the other file allows it: a
        cause in the depths cannot explain the picture alone, nor one in the outlines the text alone."""
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
            found = finding_of(alone)
            if kind == "depths":
                return self.by_the_rule_of_the_picture() if found.verdict == "unknown" else found
            if found.verdict not in ("exact", "borders"):
                return found
            by_both = self.context.compare(found.mismatch.reading, found.mismatch.rule)
            return found if BorderRule(self.context, by_both).shows_each_triangle else both
        if both.verdict != "mistake":
            return by_open_rule(alone, sample_rows(alone, alone.plain)) or both
        found = (exact(alone.compare(reading, rule, limit=0), alone.shown)
                 for rule in (Rule(), Rule(**CENTER)) for reading in self.context.readings)
        # A picture of one color may come from a mistake found.
        return next((one for one in found if one and one.verdict == "exact"), both)

    def by_the_rule_of_the_picture(self):
        """The Finding of depths that nothing explains."""
        found = self.of("picture")
        if found.verdict not in ("exact", "borders"):
            return self.of_all
        return unknown(self.context.compare(found.mismatch.reading, found.mismatch.rule))
