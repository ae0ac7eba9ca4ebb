"""Stage 4 of a hand-in: under which rules, or with which mistake, its pixels are exactly what its triangles
give."""
import collections
import dataclasses
import itertools
import math

from lib.judging.borders import Borders, is_shifted, shows_each
from lib.judging.matrix_causes import MOST_PAIRS
from lib.judging.mismatch import Finding, Mismatch
from lib.judging.mistakes import sentence
from lib.judging.pixel_rules import BLANK, CENTER, MISTAKES, OPEN_DEPTHS, OPEN_ENDS, in_words, pairs
from lib.judging.raster import Drawing, Grid, Rule, TooMuch, Triangles
from lib.judging.shown import DEPTH_BASE
from lib.judging.verdict import cause_of, cause_of_all

PIXELS_LOOKED_AT = 30_000  # how many differing pixels are checked for what else they could show
MOST_WORK = 40_000_000     # pixels of triangles and spans looked at, in all that is tried
SAMPLE_ROWS = 8
# A mistake leaves at most one pixel in NEARLY of those, in SAMPLE_ROWS, that the best open rule leaves; these
# are at least LEAST_NEARLY.
NEARLY, LEAST_NEARLY = 8, 8
LEAST_HOLES = 5  # on common edges, before they are no accident of rounding
LEAST_PIXELS_OF_OTHERS = 3  # that triangles beside the largest must show before one color is a mistake
# All that differs should lie within a pixel of an edge. Honest programs have a few pixels astray, for example
# where a row passes just by a vertex, and depths that depend on the ends of their row: no more is let through
# than they need.
MOST_STRAYS = 1 / 32   # of the pixels that are drawn, or not, otherwise
MOST_OTHERS = 1 / 64   # of the pixels with a triangle, that may show one which is none within a pixel
# of the pixels with a triangle, that may have a depth which it has nowhere within a pixel
MOST_DEPTHS = 1 / 5


class PixelJudge:
    """`readings` are {name: (points, units)}: the numbers of the file, those in memory, and the right ones.
    `window` has the size and the limits."""

    def __init__(self, readings, window, shown):
        self.readings, self.window, self.shown = readings, window, shown
        self.first = next(iter(readings))
        self.limits = float(window.front), float(window.rear)
        self.corner = float(window.left), float(window.bottom)
        self.made, self.work, self.plain, self.found, self.is_of_one = {}, [MOST_WORK], None, {}, False

    def drawing(self, reading, rule):
        kind = rule.half_x, rule.half_y, rule.is_one_less
        key = reading, rule.is_window_one, kind, rule.corners
        if key not in self.made:
            corner = (-1.0, -1.0) if rule.is_window_one else self.corner
            grid = Grid(self.window.width, self.window.height, *corner, *kind)
            self.made[key] = Triangles(*self.readings[reading], grid, rule.corners)
        return Drawing(self.made[key], rule, (-1.0, 1.0) if rule.is_depth_one else self.limits, self.work)

    def finding_of(self, kind, finding):
        """The Finding that fits the depths or the picture best, after that of both: a file that is right by
        itself is right, whatever the other one holds, and one that is not is counted by its own rule."""
        if kind not in self.found:
            self.found[kind] = self.found_for(kind, finding)
        return self.found[kind]

    def found_for(self, kind, finding):
        is_of_one = len(finding.touches) == 1 and finding.verdict == "mistake"
        if finding.verdict == "exact" or is_of_one or self.is_of_blank(finding):
            return finding
        alone = self.alone(kind)
        try:
            if finding.verdict == "unknown":
                found = alone.judge()
                if kind == "depths" and found.verdict == "unknown":
                    return self.by_the_rule_of_the_picture(finding)
                if kind == "depths" or found.verdict not in ("exact", "borders"):
                    return found
                both = self.compare(found.mismatch.reading, found.mismatch.rule)
                return found if self.shows_each_triangle(both) else finding
            rules = (Rule(), Rule(**CENTER)) if finding.verdict == "mistake" else self.all_open_rules()
            found = (alone.exact(alone.compare(reading, rule, limit=0))
                     for rule in rules for reading in self.readings)
            return next((one for one in found  # a picture of one color may be that of a mistake found
                         if one and (one.verdict == "exact" or finding.verdict != "mistake")), finding)
        except TooMuch:
            return finding

    def alone(self, kind):
        """The judge of one of the two files."""
        judge = PixelJudge(self.readings, self.window, self.shown.only(kind))
        judge.made, judge.is_of_one = self.made, True
        return judge

    def told(self, finding, is_wrong):
        """The Mismatch to show for a Finding: what its mistake explains, if `is_wrong` by one, and where its
        rule is another one than ours, what that changes."""
        found, rule = finding.mismatch, finding.mismatch.rule
        is_by_mistake = is_wrong and finding.causes
        if not (is_by_mistake or finding.rule and not found.pixels):
            return found
        try:
            before = Rule(rule.left, rule.right, rule.depth, rule.clamp) if is_by_mistake else Rule()
            mismatch = self.compare(found.reading, before)
        except TooMuch:
            return found
        mismatch.pixels = {place: kind for place, kind in mismatch.pixels.items()
                           if place not in found.pixels}
        return mismatch

    def is_of_blank(self, finding):
        return finding.mismatch is self.plain and all(self.shown.are_blank)

    def by_the_rule_of_the_picture(self, finding):
        """The Finding of depths that nothing explains."""
        found = self.finding_of("picture", finding)
        return self.unknown(self.compare(found.mismatch.reading, found.mismatch.rule)) if found.verdict in (
            "exact", "borders") else finding

    # One rule
    def row_mismatches(self, drawing, pixels, row, budget, drawn_row=None):
        """(column, kind) of what a row shows that the rule does not explain, colors aside. `drawn_row` is
        that of the drawing."""
        owner, depth = drawn_row or drawing.row(row)
        depths = pixels.depths[row] if pixels.depths else None
        if pixels.depths and depths is None:
            yield from self.listed_mismatches(drawing, row, (owner, depth), pixels.listed[row])
        drawn = pixels.drawn[row] if pixels.drawn else [z is not None for z in depths] if depths else None
        if drawn is None:
            return
        tolerance = self.shown.depths.tolerance if depths else None
        for column, (t, is_drawn) in enumerate(zip(owner, drawn)):
            z = depths[column] if depths and is_drawn else None
            if (t >= 0) == is_drawn and (z is None or abs(z - depth[column]) <= DEPTH_BASE
                                         or abs(z - depth[column]) <= tolerance(z)):
                continue
            budget[0] -= 1
            if budget[0] > 0 and self.could_show(drawing, row, column, is_drawn, z):
                continue
            yield column, "extra" if t < 0 else "missing" if not is_drawn else "depth"

    def could_show(self, drawing, row, column, is_drawn, z, triangles=None):
        slack = self.shown.depths.tolerance(z) if z is not None else 0.0
        return any(
            (t >= 0) == is_drawn and (z is None or low <= z <= high) and (triangles is None or t in triangles)
            for t, low, high in drawing.could_show(row, column, slack))

    def listed_mismatches(self, drawing, row, drawn_row, listed):
        """Without a pixel for each depth: the depths of a row in their order, all or those before the rear
        limit."""
        expected = [(column, z) for column, (t, z) in enumerate(zip(*drawn_row)) if t >= 0]
        if len(expected) > len(listed):
            expected = [(column, z) for column, z in expected if z < self.limits[1]]
        if len(expected) != len(listed):
            yield self.window.width, "depth"  # a column beyond the picture: somewhere in the row
            return
        for (column, z), given in zip(expected, listed):
            if abs(z - given) > self.shown.depths.tolerance(z) and not self.could_show(
                    drawing, row, column, True, given):
                yield column, "depth"

    def explains(self, reading, rule, rows):
        """Whether the rule explains all that these rows show, colors aside."""
        drawing, pixels = self.drawing(reading, rule), self.shown.pixels(rule.picture_flip, rule.text_flip)
        budget = [PIXELS_LOOKED_AT]
        return not any(True for row in rows for _ in self.row_mismatches(drawing, pixels, row, budget))

    def compare(self, reading, rule, limit=math.inf):
        """The Mismatch of a rule; None if more than `limit` pixels are not explained."""
        drawing, pixels = self.drawing(reading, rule), self.shown.pixels(rule.picture_flip, rule.text_flip)
        result = Mismatch(rule, reading, triangle_count=len(drawing.triangles.corners))
        budget, pairs = [PIXELS_LOOKED_AT], collections.Counter()
        for row in range(self.window.height):
            owner, depth = drawing.row(row)
            result.drawn += sum(t >= 0 for t in owner)
            for column, kind in self.row_mismatches(drawing, pixels, row, budget, (owner, depth)):
                result.pixels[row, column] = kind
                if column < len(owner) and owner[column] >= 0:
                    result.owners[row, column] = owner[column]
                if kind == "depth" and column < len(owner):
                    z = pixels.depths[row][column] if pixels.depths[row] else None
                    result.offsets[row, column] = abs(z - depth[column]) if z is not None else 0.0
            if len(result.pixels) > limit:
                return None
            if pixels.colors:
                pairs.update((t, color)
                             for t, color, is_drawn in zip(owner, pixels.colors[row], pixels.drawn[row])
                             if t >= 0 and is_drawn)
        if pixels.colors:
            self.compare_colors(drawing, pixels, pairs, result, budget)
        return result if len(result.pixels) <= limit else None

    def compare_colors(self, drawing, pixels, pairs, result, budget):
        """Gives every triangle the color that most of its pixels have, and finds the pixels that show another
        triangle."""
        for (t, color), _ in reversed(pairs.most_common()):
            result.colors[t] = color
        for (t, _), count in pairs.items():
            result.visible[t] += count
        if all(result.colors[t] == color for t, color in pairs):
            return
        of_color = {color: result.of_color(color) for color in {color for _, color in pairs}}
        for row in range(self.window.height):
            owner, _ = drawing.row(row)
            colors, drawn, depths = pixels.colors[row], pixels.drawn[
                row], pixels.depths[row] if pixels.depths else None
            for column, (t, color) in enumerate(zip(owner, colors)):
                if t < 0 or not drawn[column]:
                    continue
                if result.colors[t] == color or (row, column) in result.pixels:
                    continue
                budget[0] -= 1
                z = depths[column] if depths else None
                if budget[0] <= 0 or not self.could_show(drawing, row, column, True, z, of_color.get(
                        color, ())):
                    result.pixels[row, column], result.owners[row, column] = "other", t

    # All rules
    def judge(self):
        """The Finding."""
        try:
            return self.find()
        except TooMuch:
            finding = self.unknown(self.plain) if self.plain else Finding("unknown")
            finding.remarks.append("too many pixels of triangles to look for a cause")
            return finding

    def find(self):
        self.plain = plain = self.compare(self.first, Rule())
        finding = self.exact(plain)
        if finding:
            return finding
        if plain.drawn and any(self.shown.are_blank):  # where one is, no mistake is that of both
            return self.exact(self.compare(self.first, Rule(**CENTER), limit=0)) or self.of_blank(plain)
        rows = self.sample_rows(plain)
        finding = self.find_open(rows) or self.find_mistake(rows)
        if finding:
            return finding
        center = self.compare(self.first, Rule(**CENTER))
        best = min((plain, center), key=lambda mismatch: (len(mismatch.of_shape), len(mismatch.pixels)))
        return self.find_nearly(rows, best) or self.find_at_borders(best) or self.find_two(
            rows) or self.unknown(best)

    def exact(self, mismatch):
        """A Finding if the rule explains everything: that, or all triangles in one color."""
        if mismatch is None or mismatch.pixels:
            return None
        finding = Finding("exact", mismatch, in_words(mismatch.rule))
        if mismatch.reading == "memory":
            finding.remarks.append("by the exact numbers, kept in memory")
        if mismatch.reading.startswith("right"):
            finding.remarks.append("by the right numbers, which are not those of stage3.txt")
        counts = [count for _, count in mismatch.visible.most_common()]
        if len(set(mismatch.colors.values())) == 1 and sum(counts[1:]) >= LEAST_PIXELS_OF_OTHERS:
            finding.verdict, finding.causes, finding.touches = "mistake", [cause_of("zbuf/one-color")
                                                                           ], ("picture", )
        return finding

    def sample_rows(self, mismatch):
        """A few rows that tell rules apart: some with differences, some others."""
        wrong = sorted({row for row, _ in mismatch.pixels})
        pixels = self.shown.pixels()
        filled = [
            row for row in range(self.window.height)
            if (any(pixels.drawn[row]) if pixels.drawn else pixels.listed[row])]
        return [*spread(wrong, SAMPLE_ROWS), *spread(filled, SAMPLE_ROWS // 2)]

    def depth_rules(self):
        """Rules of depth that can make a difference here."""
        dx = -2 * float(self.window.left)
        is_beyond = any(abs(p[0]) > dx / 2 for points, _ in self.readings.values() for p in points)
        return [rule for rule in OPEN_DEPTHS
                if is_beyond or rule.get("clamp") is None] if self.shown.depths else OPEN_DEPTHS[:1]

    def open_rules(self):
        """(rank, changes), the usual rules first."""
        rules = [((i > 1) + (j > 0), {**ends, **depth})
                 for i, ends in enumerate(OPEN_ENDS)
                 for j, depth in enumerate(self.depth_rules())]
        return sorted(rules, key=lambda pair: pair[0])

    def all_open_rules(self):
        return [Rule(**changes) for _, changes in self.open_rules()]

    def find_open(self, rows):
        for rule in self.all_open_rules():
            for reading in self.readings:
                if self.explains(reading, rule, rows):
                    finding = self.exact(self.compare(reading, rule, limit=0))
                    if finding:
                        return finding
        return None

    def find_mistake(self, rows):
        found, rank_of_found = {}, None
        for rank, open_changes in self.open_rules():
            if found and rank > rank_of_found:
                break
            for names, changes in MISTAKES:
                if names in found or self.is_void(changes):
                    continue
                rule = Rule(**{**open_changes, **changes})
                for reading in self.readings:
                    if self.explains(reading, rule, rows) and (mismatch := self.compare(
                            reading, rule, limit=0)) and mismatch.drawn and self.has_holes(reading, rule):
                        found[names], rank_of_found = mismatch, rank
                        break
        return self.mistake(found) if found else None

    def has_holes(self, reading, rule):
        """Whether there are enough holes on edges to tell, if the rule leaves any."""
        return not rule.is_strict or len(
            self.compare(reading, dataclasses.replace(rule, is_strict=False)).pixels) >= LEAST_HOLES

    def find_two(self, rows):
        """Two mistakes at once that explain everything, by our two rules; nothing if more than MOST_PAIRS
        would do. They are asked of both files together."""
        found = {}
        for (names, changes), ends in itertools.product(() if self.is_of_one else pairs(), ({}, CENTER)):
            rule = Rule(**{**ends, **changes})
            if names not in found and not self.is_void(changes) and self.explains(self.first, rule, rows):
                mismatch = self.compare(self.first, rule, limit=0)
                is_found = mismatch and mismatch.drawn and self.has_holes(self.first, rule)
                found |= {names: mismatch} if is_found else {}
        return self.mistake(found) if 0 < len(found) <= MOST_PAIRS else None

    def find_nearly(self, rows, best):
        """The mistakes, by our two rules, that explain all but one in NEARLY of what no open rule does, and
        of all that differs."""
        def count(rule, most):
            drawing, pixels = self.drawing(self.first, rule), self.shown.pixels(rule.picture_flip,
                                                                               rule.text_flip)
            budget, width = [PIXELS_LOOKED_AT], self.window.width
            unexplained = (
                most + 1 if column == width else 1  # another number of depths explains none of the row
                for row in rows for column, _ in self.row_mismatches(drawing, pixels, row, budget))
            return sum(itertools.islice(unexplained, most + 1))

        least, found = 10**9, {}
        for ends in OPEN_ENDS:
            least = min(least, count(Rule(**ends), least))
        for names, changes in MISTAKES if least >= LEAST_NEARLY else ():
            for ends in ({}, CENTER):
                rule, most = Rule(**{**ends, **changes}), least // NEARLY
                if not (self.is_void(changes) or self.is_torn(rule)) and count(rule, most) <= most:
                    mismatch = self.compare(self.first, rule)
                    if mismatch.drawn and NEARLY * len(mismatch.pixels) <= len(best.pixels) and not any(
                            column == self.window.width for _, column in mismatch.pixels):
                        found.setdefault(names, mismatch)
        return self.mistake(found) if found else None

    def is_torn(self, rule):
        """Whether the text, flipped back, has another number of depths in a row than the picture."""
        pixels = self.shown.pixels(rule.picture_flip, rule.text_flip)
        return bool(rule.text_flip and pixels.listed) and (
            not any(pixels.listed) or bool(pixels.drawn) and None in pixels.depths)

    def mistake(self, found):
        """The Finding of {names: Mismatch}."""
        if any(len(names) == 1 for names in found):  # several at once only if no single one will do
            found = {names: mismatch for names, mismatch in found.items() if len(names) == 1}
        mismatch = next(iter(found.values()))
        return Finding("mistake", mismatch, in_words(mismatch.rule),
                       [cause_of_all("zbuf", names) for names in found], self.touched(mismatch))

    def touched(self, mismatch):
        """The files that a mistake spoils: one of them if it only turns its rows."""
        rule = mismatch.rule
        is_turn = dataclasses.replace(rule, picture_flip="", text_flip="") in self.all_open_rules()
        if is_turn and not mismatch.pixels and not (rule.picture_flip and rule.text_flip):
            if rule.picture_flip and self.shown.depths:
                return ("picture", )
            if rule.text_flip:
                return ("depths", )
        return "depths", "picture"

    def is_void(self, changes):
        """Whether a change cannot matter here."""
        window, has_both = self.window, self.shown.colors and self.shown.depths
        return bool(
            changes.get("is_window_one") and self.corner == (-1, -1)
            or changes.get("is_depth_one") and self.limits == (-1, 1)
            or changes.get("starts_at_zero") and self.limits[1] == 0
            or "transposed" in changes.values() and window.width != window.height
            or changes.get("text_flip", "") != changes.get("picture_flip", "") and not has_both)

    def find_at_borders(self, best):
        """Whether all differences from the nearest of our two rules lie within a pixel of an edge, and are no
        shift."""
        pixels = self.shown.pixels()
        drawing = self.drawing(self.first, Rule())
        if not pixels.drawn or is_shifted(drawing, pixels.drawn) or any(column >= self.window.width
                                                                        for _, column in best.pixels):
            return None
        shapes = len(best.of_shape)
        if shapes > best.drawn:
            return None  # more than all: not the borders of what there is to draw
        of_drawn = best.drawn if shapes else 0  # where no border differs, no other rule holds there
        most = {
            "stray": MOST_STRAYS * shapes, "other": MOST_OTHERS * of_drawn, "depth": MOST_DEPTHS * of_drawn}
        if not self.shows_each_triangle(best):
            return None
        beyond = collections.Counter()
        for what in self.beyond_borders(Borders(drawing.triangles, self.limits, self.work), best, pixels):
            beyond[what] += 1
            if beyond[what] > most[what]:
                return None
        return Finding("borders", best, self.at_borders_in_words(best, beyond["other"] + beyond["depth"]))

    def shows_each_triangle(self, mismatch):
        """See shows_each. A triangle whose pixels have the color and the depths of another is not shown."""
        drawing, pixels = self.drawing(mismatch.reading, mismatch.rule), self.shown.pixels()
        borders = Borders(drawing.triangles, self.limits, self.work)

        def is_other(row, column, t):
            kind = mismatch.pixels.get((row, column))
            if kind != "depth" or not pixels.colors:
                return kind is not None
            if not pixels.depths[row]:  # it cannot be told whose depth differs
                return False
            color, z = pixels.colors[row][column], pixels.depths[row][column]
            same = mismatch.of_color(color)
            if mismatch.colors.get(t) == color and t not in mismatch.unplaced:
                return False
            tolerance = self.shown.depths.tolerance(z)
            return not borders.has(t, row, column, z, tolerance) and any(
                borders.has(other, row, column, z, tolerance)
                for other in borders.near(row, column) if other in same and other != t)

        return shows_each(drawing, borders, is_other)

    def beyond_borders(self, borders, mismatch, pixels):
        """For each pixel that differs beyond a pixel from the edges: `stray` if it is drawn, or not, farther
        from the edges, or has a depth beyond the limits; `other` if no such triangle is found within a pixel,
        and `depth` if no such depth of it is."""
        for (row, column), kind in mismatch.pixels.items():
            is_drawn = pixels.drawn[row][column]
            z = pixels.depths[row][column] if pixels.depths and pixels.depths[row] else None
            tolerance = self.shown.depths.tolerance(z) if z is not None else 0.0
            seen = mismatch.of_color(pixels.colors[row][column]) if is_drawn else None
            if borders.could_show(row, column, is_drawn, z, tolerance, seen):
                continue
            is_kept = z is None or self.limits[0] - tolerance <= z < self.limits[1] + tolerance
            if not is_kept or kind in ("extra", "missing") and not borders.allows(row, column, is_drawn):
                yield "stray"
            elif kind not in ("extra", "missing"):
                yield "depth" if borders.could_show(row, column, is_drawn, None, tolerance, seen) else "other"

    def at_borders_in_words(self, mismatch, inside):
        pixels, kinds = self.shown.pixels(), collections.Counter(mismatch.pixels.values())
        shapes = kinds["extra"] + kinds["missing"]
        others = {
            place
            for place, kind in mismatch.pixels.items()
            if kind in ("depth", "other") and mismatch.shows_another(place, pixels)}
        offsets = [offset for place, offset in mismatch.offsets.items() if place not in others]
        parts = [
            f"{kinds[kind]:,} {words}" for kind, words in (("extra", "more"), ("missing", "fewer"))
            if kinds[kind]]
        words = [
            f"another rule at the borders: {counted(shapes, 'pixel')} of {mismatch.drawn:,} "
            f"({', '.join(parts)})"
        ] if shapes else []
        words += [f"{len(others):,} of {mismatch.drawn:,} show another triangle where triangles meet"
                  ] if others else []
        if offsets:
            least = "" if inside else "less than one pixel makes, "
            words.append(
                f"{len(offsets):,} {'depth differs' if len(offsets) == 1 else 'depths differ'} by {least}up "
                f"to {max(offsets):.2g}"
            )
        return "; ".join(words)

    def of_blank(self, plain):
        """The Finding where nothing is drawn, which has too many causes to name one; of one of two files,
        none that both would have."""
        finding = self.unknown(plain)
        mistakes = () if self.is_of_one else MISTAKES
        names = [name for (name, *_), changes in mistakes if name in BLANK and not any(
            t >= 0 for row in range(self.window.height)
            for t in self.drawing(self.first, Rule(**changes)).row(row)[0])]
        words = "; or: ".join(sentence(f"zbuf/{name}").rstrip(".") for name in names)
        finding.remarks += [f"nothing is drawn, as if: {words}"] if names else ["nothing is drawn"]
        return finding

    def unknown(self, plain):
        finding = Finding("unknown", plain)
        finding.touches = tuple(kind for kind in ("depths", "picture") if plain.of(kind))
        return finding


def spread(values, count):
    """At most `count` of the values, evenly spread."""
    return values if len(values) <= count else [
        values[i * (len(values) - 1) // (count - 1)] for i in range(count)]


def counted(count, noun):
    return f"{count:,} {noun}{'' if count == 1 else 's'}"
