"""The search for the rule, or the mistake, under which the triangles of a hand-in give exactly its pixels, in
both files of stage 4 together and in each by itself."""
import collections
import dataclasses
import functools
import itertools

from lib.judging.borders import BorderRule
from lib.judging.matching import named
from lib.judging.pixel_comparing import Attempt, Mismatch
from lib.judging.pixel_rules import BLANK, CENTER, MISTAKES, MOST_PAIRS, OUR_ENDS, pairs
from lib.judging.pixel_words import border_rule_in_words, rule_in_words
from lib.judging.raster import Rule, TooMuch
from lib.judging.verdict import BY_THE_RIGHT, cause_of, cause_of_all

SAMPLE_ROWS = 8
# A mistake is named if it leaves at most one in NEARLY of the pixels that the best open rule leaves, and
# these are at least LEAST_NEARLY.
NEARLY, LEAST_NEARLY = 8, 8
LOST = 0.9  # the share of a triangle's pixels that must look as without it, to call it missing
LEAST_HOLES = 5  # on common edges: fewer may be an accident of rounding
BY_READING = {
    "file": [], "memory": ["by the exact numbers, kept in memory"],
    **dict.fromkeys(("right", "right text"), [f"{BY_THE_RIGHT}stage3.txt"])}
GIVEN_UP = "the search for a cause was given up: it would take too many steps"
LEAST_PIXELS_OF_OTHERS = 3  # that other triangles than the largest must show, to call one color a mistake


@dataclasses.dataclass
class Finding:
    """The result for stage 4, or for one of its files."""
    verdict: str  # exact, borders, mistake, unknown
    mismatch: Mismatch = None
    rule: str = ""  # in words, if it is another one
    causes: list = dataclasses.field(default_factory=list)
    touches: tuple = ("depths", "picture")  # the files that the mistake spoils
    remarks: list = dataclasses.field(default_factory=list)


def finding_of(context):
    """The Finding of a Context. A search that is given up costs no points: open rules are not part of it."""
    plain = context.plain
    if found := exact(plain, context.shown):
        return found
    if not plain.pixels:  # there is nothing that a mistake could explain
        return unknown(plain)
    if plain.drawn and all(context.shown.blank.values()):
        center = context.compare(context.first, Rule(**CENTER), limit=0)
        return exact(center, context.shown) or of_blank(context, plain)
    rows = sample_rows(context, plain)
    if found := by_open_rule(context, rows):
        return found
    center = context.compare(context.first, Rule(**CENTER))
    best = min((plain, center), key=lambda one: (one.count("extra", "missing"), len(one.pixels)))
    found, remarks = context.borders_first and at_borders(context, best), []
    kept, context.work[0] = context.work[0], context.left[0]
    try:
        found = found or by_mistakes(context, rows, best)
    except TooMuch:
        remarks = [GIVEN_UP]
    context.left[0], context.work[0] = context.work[0], kept
    found = found or at_borders(context, best) or unknown(best)
    found.remarks += remarks
    return found


def by_mistakes(context, rows, best):
    """The Finding of one mistake, of several triangles that are missing, or of two mistakes."""
    if found := by_mistake(context, rows):
        other = without_triangles(context, best, 0)
        if other and len(other.mismatch.rule.without) == 1:  # which explains as much
            found.causes += other.causes
        return found
    some = filter(None, (without_triangles(context, best,
                                           len(best.pixels) // NEARLY), by_most_pixels(context, rows, best)))
    return min(some, key=lambda one: len(one.mismatch.pixels), default=None) or by_two_mistakes(context, rows)


def unknown(mismatch):
    kinds = (kind for kind in ("depths", "picture") if mismatch.of(kind) or not mismatch.pixels)
    return Finding("unknown", mismatch, touches=tuple(kinds))


def exact(mismatch, shown):
    """A Finding if the rule explains everything: the rule, or that all triangles have one color."""
    if mismatch is None or mismatch.pixels:
        return None
    counts = [count for _, count in mismatch.visible.most_common()]
    has_one_color = len(set(mismatch.colors.values())) == 1 and sum(counts[1:]) >= LEAST_PIXELS_OF_OTHERS
    if has_one_color and len(shown.own_colors) > 1:
        return None  # most pixels of each triangle have the color of one that hides it
    words, remarks = rule_in_words(mismatch.rule), [*BY_READING[mismatch.reading]]
    if has_one_color:
        return Finding("mistake", mismatch, words, [cause_of("zbuf/one-color")], ("picture",), remarks)
    return Finding("exact", mismatch, words, remarks=remarks)


def sample_rows(context, mismatch):
    """A few rows that distinguish rules, evenly spread: some with differences, some without."""
    def spread(values, count):
        return values if len(values) <= count else [
            values[i * (len(values) - 1) // (count - 1)] for i in range(count)]

    wrong = sorted({row for row, _ in mismatch.pixels})
    pixels = context.shown.pixels()
    filled = [
        row for row in range(context.window.height)
        if (any(pixels.drawn[row]) if pixels.drawn else pixels.listed[row])]
    return [*spread(wrong, SAMPLE_ROWS), *spread(filled, SAMPLE_ROWS // 2)]


def by_open_rule(context, rows):
    found = (exact(context.explained(reading, Rule(**changes), rows), context.shown)
             for _, changes in context.open_rules for reading in context.readings)
    return next(filter(None, found), None)


def by_mistake(context, rows):
    """The mistakes that explain everything by the usual rules; only if there is none, by others."""
    found = {}
    for rank, rules in itertools.groupby(context.open_rules, key=lambda rule: rule[0]):
        readings = [*context.readings][:None if rank < 2 else 1]
        for (_, open_changes), (names, changes) in itertools.product(rules, context.mistakes):
            if names not in found:
                rule = Rule(**{**open_changes, **changes})
                mismatches = (everything_explained(context, reading, rule, rows) for reading in readings)
                found |= {names: one for one in itertools.islice(filter(None, mismatches), 1)}
        if found:
            return mistake(context, found)
    return None


def everything_explained(context, reading, rule, rows):
    """The Mismatch, empty, of a mistake that explains all, draws something, and has no more doubtful pixels
    than it explains; else None. `rows` are looked at first."""
    mismatch = context.explained(reading, rule, rows)
    if not (mismatch and mismatch.drawn and mismatch.doubtful <= len(context.plain.pixels)):
        return None
    without_holes = dataclasses.replace(rule, is_strict=False)
    has_holes = not rule.is_strict or len(context.compare(reading, without_holes).pixels) >= LEAST_HOLES
    return mismatch if has_holes else None


def by_two_mistakes(context, rows):
    """At most MOST_PAIRS pairs of mistakes that explain all of both files, by our two rules."""
    found = {}
    some = () if context.is_one_of_two else pairs(context.mistakes)
    for (names, changes), ends in itertools.product(some, OUR_ENDS):
        if names not in found:
            mismatch = everything_explained(context, context.first, Rule(**{**ends, **changes}), rows)
            found |= {names: mismatch} if mismatch else {}
    return mistake(context, found) if 0 < len(found) <= MOST_PAIRS else None


def by_most_pixels(context, rows, best):
    """The mistakes, by our two rules, that leave at most one in NEARLY of the pixels that no open rule
    explains, and of all that differ."""
    least, found = 10**9, {}
    for _, changes in context.open_rules:
        if "depth" not in changes:
            least = min(least, Attempt(context, context.first, Rule(**changes)).count(rows, least))
    some, most = context.mistakes if least >= LEAST_NEARLY else (), least // NEARLY
    for (names, changes), ends in itertools.product(some, OUR_ENDS):
        attempt = Attempt(context, context.first, Rule(**{**ends, **changes}))
        if not attempt.has_torn_rows and attempt.count(rows, most) <= most:
            mismatch = context.compare(context.first, attempt.rule)
            if mismatch.drawn and NEARLY * len(mismatch.pixels) <= len(best.pixels) and not mismatch.has_rows:
                found.setdefault(names, mismatch)
    return mistake(context, found) if found else None


def without_triangles(context, best, limit):
    """The Finding that triangles are missing, if all their pixels look so and at most `limit` others differ.
    Such a pixel shows nothing, or another triangle, whose color then seems to be the missing one's, too."""
    counts = collections.Counter(best.owners.values())
    lost = {t for t, count in counts.items() if count >= LOST * best.areas[t]}
    in_another = {t for t in counts if len(best.by_color.get(best.colors.get(t), ())) > 1}
    rules = (Rule(**ends, without=some) for some in dict.fromkeys(map(frozenset, (lost, lost | in_another)))
             if 0 < len(some) < len(best.areas) for ends in OUR_ENDS)
    mismatches = filter(None, (context.compare(best.reading, rule, limit) for rule in rules))
    mismatch = min(mismatches, key=lambda one: len(one.pixels), default=None)
    if mismatch is None or mismatch.has_rows:
        return None
    lost, last = mismatch.rule.without, best.triangle_count - 1
    cause = cause_of("zbuf/last-triangle-missing") if lost == {last} else cause_of(
        "zbuf/triangle-missing", named(sorted(lost)))
    return Finding("mistake", mismatch, rule_in_words(mismatch.rule), [cause])


def mistake(context, found):
    """The Finding of {names: Mismatch}."""
    if any(len(names) == 1 for names in found):  # several at once only if no single one will do
        found = {names: mismatch for names, mismatch in found.items() if len(names) == 1}
    first = next(iter(found.values()))
    ends = ("the left one" if one.rule.columns_before else "the right one" if one.rule.column_more else ""
            for one in found.values())  # at which rows have another number of columns
    causes = [dataclasses.replace(cause_of_all("zbuf", names), detail=end) for names, end in zip(found, ends)]
    # It spoils one of the files if it only turns its rows.
    turned_back = dataclasses.replace(first.rule, picture_flip="", text_flip="")
    is_turn = not first.pixels and turned_back in [Rule(**changes) for _, changes in context.open_rules]
    flips = {"depths": first.rule.text_flip, "picture": first.rule.picture_flip}
    touches = tuple(kind for kind, flip in flips.items() if flip or not (is_turn and any(flips.values())))
    return Finding("mistake", first, rule_in_words(first.rule), causes, touches)


def at_borders(context, best):
    """A Finding if all differences from the nearest of our two rules lie within reach of an edge."""
    if not BorderRule(context, best).explains_all:
        return None
    return Finding("borders", best, border_rule_in_words(best, context.shown.pixels()))


def of_blank(context, plain):
    """The Finding where nothing is drawn, with all mistakes that do so; none for depths with a picture."""
    blank = BLANK[:-1] if context.shown.depths else BLANK  # the last one is of pictures alone
    ways = ((name, context.compare(context.first, Rule(**changes), limit=0))
            for (name, *_), changes in MISTAKES if name in blank)
    finding, names = unknown(plain), dict.fromkeys(name for name, one in ways if one and not one.drawn)
    if context.is_one_of_two:
        names = BLANK[-1:] if context.shown.colors else ()
    elif plain.triangle_count == 1:
        names = *names, "last-triangle-missing"
    finding.causes = [cause_of(f"zbuf/{name}") for name in names]
    finding.remarks.append("nothing is drawn")
    return finding


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
