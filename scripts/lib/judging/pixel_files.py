"""The findings on the two files of stage 4, together and each by itself."""
from lib.judging.borders import BorderRule
from lib.judging.pixel_rules import CENTER
from lib.judging.pixel_search import exact, finding_of, unknown
from lib.judging.raster import Rule, TooMuch


class Findings:
    """The Finding of a pixel_comparing.Context: `of_all` the files given, and of one of two, which is right
    if it is so by itself, whatever the other one holds, and is else counted by its own rule."""

    def __init__(self, context):
        self.context, self.of_all, self.of_one = context, finding_of(context), {}

    def of(self, kind):
        if kind not in self.of_one:
            try:
                self.of_one[kind] = self.own_finding(kind)
            except TooMuch:
                self.of_one[kind] = self.of_all
        return self.of_one[kind]

    def own_finding(self, kind):
        both = self.of_all
        spoils_one = both.verdict == "mistake" and len(both.touches) == 1
        if both.verdict == "exact" or spoils_one or self.is_of_blank_files():
            return both
        alone = self.context.of_one_file(kind)
        if both.verdict == "unknown":
            return self.own_if_both_are_unknown(kind, alone)
        rules = (Rule(), Rule(**CENTER)) if both.verdict == "mistake" else [
            Rule(**changes) for _, changes in self.context.open_rules]
        found = (exact(alone.compare(reading, rule, limit=0))
                 for rule in rules for reading in self.context.readings)
        return next((one for one in found  # a picture of one color may come from a mistake found
                     if one and (one.verdict == "exact" or both.verdict != "mistake")), both)

    def is_of_blank_files(self):
        mismatch = self.of_all.mismatch
        return mismatch is None or mismatch is self.context.plain and all(self.context.shown.are_blank)

    def own_if_both_are_unknown(self, kind, alone):
        found = finding_of(alone)
        if kind == "depths" and found.verdict == "unknown":
            return self.by_the_rule_of_the_picture()
        if kind == "depths" or found.verdict not in ("exact", "borders"):
            return found
        by_both = self.context.compare(found.mismatch.reading, found.mismatch.rule)
        return found if BorderRule(self.context, by_both).shows_each_triangle() else self.of_all

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
    try:
        before = Rule(rule.left, rule.right, rule.depth, rule.clamp) if is_by_mistake else Rule()
        mismatch = context.compare(found.reading, before)
    except TooMuch:
        return found
    mismatch.pixels = {place: kind for place, kind in mismatch.pixels.items() if place not in found.pixels}
    return mismatch
