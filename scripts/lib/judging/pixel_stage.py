"""Stage 4 of a hand-in, from its readings to the verdicts on the depths and on the picture."""
import collections
import dataclasses
import itertools
import types

from lib.judging.pixel_comparing import Context
from lib.judging.pixel_search import Findings, unknown
from lib.judging.pixel_words import counted, difference_in_words, place_in_words
from lib.judging.raster import Rule, TooMuch
from lib.judging.shown import Shown
from lib.judging.stage_judge import NO_POINTS
from lib.judging.stage_ways import exact_reading
from lib.judging.verdict import (ANOTHER_RULE, RIGHT, TOO_FEW_DIGITS, UNDECIDED, UNREADABLE, WRONG, Cause,
                                 FileVerdict, cause_of, joined)

# A picture has many colors if it has more than COLORS for each triangle and SOME more: no frame and no stray
# pixel has so many.
COLORS, SOME = 2, 8


def pixel_readings(stage3, memory, right_ndc):
    """{name: (points, units)} of all that a program may have drawn: the file, the numbers in memory and, if
    its stages are wrong, the right ones, also as after three roundings."""
    readings = {}
    if stage3 is not None:
        readings["file"] = (stage3.points, stage3.units)
    for name, points in (("memory" if readings else "file", memory), ("right", right_ndc)):
        if points is not None and all(x == x for p in points for x in p):
            readings[name] = exact_reading(points)
            if name == "right":
                text = [tuple(round(x, 7) for x in p) for p in points]
                readings["right text"] = (text, [(3e-7,) * 3] * len(text))
    return readings


class PixelStage:
    """Judges depths and picture; `thin` names a stage3.txt of too few points, the rest is judge.HandIn's."""
    def __init__(self, ours, files, readings, thin, borders_first):
        self.ours, self.files, self.readings, self.thin = ours, files, readings, thin
        self.borders_first = borders_first

    def verdicts(self, depths, colors):
        """{kind: FileVerdict} of the files that could be read; either may be None."""
        verdicts = {}
        if self.ours.has_own_colors and colors is not None:
            verdicts["picture"], colors = self.verdict_of_colors(colors), None
        if depths is not None and depths.rows and depths.digits.are_too_few:
            verdicts["depths"] = self.verdict("depths", TOO_FEW_DIGITS, remarks=[f"it shows {depths.digits}"])
            depths = None
        given = [kind for kind, what in (("depths", depths), ("picture", colors)) if what is not None]
        why = NO_POINTS
        if given and self.readings:
            shown = Shown(colors, depths, self.ours.window, self.is_uncovered)
            context = Context(self.readings, self.ours.window, shown, self.borders_first)
            try:
                return verdicts | (self.verdicts_of_many_colors(given, context)
                                   or self.verdicts_of_shown(given, context, Findings(context))[0])
            except TooMuch:
                why = "there are too many pixels of triangles"
        return verdicts | {kind: self.verdict(kind, UNDECIDED, remarks=[why]) for kind in given}

    def verdict(self, kind, verdict, rule="", **fields):
        return FileVerdict("zbuf", self.files[kind].name, verdict, rule, **fields)

    def verdicts_of_many_colors(self, given, context):
        """The verdicts on a picture of too many colors: many colors, if that explains most of it; no cause,
        if even the outlines are wrong; else no verdict."""
        shown = context.shown
        count = max(map(len, (self.ours.world, *(points for points, _ in self.readings.values()))))
        if not shown.colors or len(shown.own_colors) <= COLORS * (count // 3) + SOME:
            return {}
        in_one_color = Context(self.readings, self.ours.window, shown.in_one_color())
        plain = in_one_color.plain
        if plain.count("extra", "missing") > plain.drawn:  # no color then is a triangle's
            picture = unknown(context.of_one_file("picture").plain)
            return self.verdicts_of_shown(given, context, Findings(context, picture))[0]
        verdicts, mismatch = self.verdicts_of_shown(given, in_one_color, Findings(in_one_color))
        return verdicts if blames_many_colors(verdicts["picture"], shown, in_one_color, mismatch) else {}

    def verdicts_of_shown(self, given, context, findings):
        """The verdicts on the files of a Context, and the Mismatch of the last one."""
        shown, verdicts = context.shown, {}
        for kind in given:
            best = findings.of(kind)
            verdicts[kind] = self.verdict_of_pixels(kind, best, shown)
            needs_both = best is findings.of_all and kind == "depths"  # whose pixels the picture shows
            self.add_first(verdicts[kind], kind, best, context if needs_both else context.of_one_file(kind))
            is_open = self.thin or verdicts[kind].is_good
            if is_open and shown.blank[kind] and not self.ours.draws_nothing:
                why = f"there is too little in {self.thin}" if self.thin else "nothing is in view"
                verdicts[kind] = self.verdict(kind, UNDECIDED, remarks=[why])
        return verdicts, best.mismatch

    def verdicts_of_exchanged(self, depths, colors):
        """The verdicts, if the picture's rows are our columns; the rows of the text may be, too."""
        kinds = ["picture"]
        if depths is not None:
            shown = Shown(colors, depths, self.ours.window, self.is_uncovered)
            rows = shown.listed_rows("transposed", shown.pixels().drawn)
            if any(rows):
                kinds, depths = ["depths", "picture"], dataclasses.replace(depths, rows=rows)
        verdicts = self.verdicts(depths, colors)
        for kind in kinds:
            if kind in verdicts and verdicts[kind].is_good:
                verdicts[kind].verdict, verdicts[kind].rule = WRONG, ""
                verdicts[kind].causes = [cause_of("zbuf/rows-and-columns-exchanged")]
        return verdicts

    def blame_size(self, verdicts, size, depths, colors):
        """Names a `size` other than the config's as the cause of a picture's verdict, and of the one on wrong
        depths if they have the rows of the picture's colors."""
        ours = self.ours.window
        words = "The picture has {} x {} pixels, not {} x {} as the config says"
        words += ": width and height are exchanged" * (size == (ours.height, ours.width))
        verdicts["picture"].causes = [Cause("", words.format(*size, ours.width, ours.height))]
        if colors and depths and depths.rows and not verdicts["depths"].is_good:
            window = types.SimpleNamespace(width=size[0], height=size[1], rear=ours.rear)
            if None not in Shown(colors, depths, window, tuple).pixels().depths:
                causes = verdicts["picture"].causes
                verdicts["depths"] = self.verdict("depths", UNREADABLE, causes=causes)

    def is_uncovered(self):
        """Rows, True where our picture of their points, or of ours, is background."""
        texts = [self.files["stage3"].data or b"", self.ours.stage3]
        rows = next(filter(None, map(self.ours.picture, texts)), [])
        return [[row[i:i + 3] == self.ours.background for i in range(0, len(row), 3)] for row in rows]

    def verdict_of_colors(self, colors):
        """The FileVerdict of a picture whose own colors or light count, by either rule of coverage."""
        found = []  # (whether by the center rule, the pixels that differ)
        is_right_asked = self.thin or "right" in self.readings
        texts = [self.ours.stage3, self.ours.stage3_of_exact] if is_right_asked else []
        texts += [] if self.thin else [self.files["stage3"].data or b""]
        for text, coverage in itertools.product(texts, ("nearest", "center")):
            ours = self.ours.picture(text, coverage)
            if ours is not None:
                found.append((coverage == "center", [(r, i) for r, (row, line) in enumerate(zip(ours, colors))
                                                     for i, color in enumerate(line)
                                                     if row[3 * i:3 * i + 3] != color]))
        if not found:
            return self.verdict("picture", UNDECIDED, remarks=["zbuf refuses their stage3.txt"])
        is_center, places = min(found, key=lambda one: len(one[1]))
        words = (WRONG, "") if places else (ANOTHER_RULE, "the center rule") if is_center else (RIGHT, "")
        return self.verdict("picture", *words, differing=len(places), places=places,
                            compared=len(colors) * len(colors[0]),
                            first="row {}, column {}: another color".format(*places[0]) if places else "")

    def verdict_of_pixels(self, kind, finding, shown):
        mismatch, rule = finding.mismatch, "" if finding.verdict == "unknown" else finding.rule
        places = mismatch.of(kind)
        counts = {"differing": len(places), "compared": mismatch.compared}
        verdict = self.verdict(kind, RIGHT, rule, places=places, **counts)
        if finding.verdict in ("mistake", "unknown") and kind in finding.touches:
            verdict.verdict, verdict.causes, verdict.rule = WRONG, finding.causes, ""
            verdict.remarks += [f"with {finding.rule}"] if finding.rule and finding.causes else []
        verdict.remarks += finding.remarks
        if kind == "depths" and shown.empty is not None:
            is_rear = abs(shown.empty - shown.rear) <= shown.depths.tolerance(shown.rear)
            empty = "the rear limit" if is_rear else f"{shown.empty:.7g}"
            printed = f"pixels without a triangle are printed, too, with {empty}"
            verdict.rule = "; ".join(filter(None, (verdict.rule, printed)))
        if verdict.rule and verdict.verdict == RIGHT:
            verdict.verdict = ANOTHER_RULE
        if kind == "picture" and verdict.is_good and self.has_other_colors(shown):
            verdict.remarks.append("in other colors")
        return verdict

    def add_first(self, verdict, kind, finding, context):
        """Adds the first pixel that shows why, and the ones that a named mistake does not explain."""
        if verdict.verdict == RIGHT:
            return
        unexplained, width = verdict.places, self.ours.window.width
        mismatch, rule = finding.mismatch, finding.mismatch.rule
        is_by_mistake = verdict.verdict == WRONG and finding.causes
        if is_by_mistake or finding.rule and not mismatch.pixels:
            # the pixels that the mistake explains, or that the rule changes, if it is another one than ours
            before = Rule(rule.left, rule.right, rule.depth, rule.clamp) if is_by_mistake else Rule()
            found = context.compare(mismatch.reading, before)
            explained = {place: kind for place, kind in found.pixels.items() if place not in mismatch.pixels}
            mismatch = dataclasses.replace(found, pixels=explained)
        if finding.verdict == "mistake" and verdict.causes:
            verdict.explained = len({*context.plain.of(kind)} - {*unexplained})
            verdict.compared = max(context.plain.compared, verdict.explained + len(unexplained))
            if unexplained:
                words, place = counted(verdict.explained, "pixel"), place_in_words(min(unexplained), width)
                verdict.remarks.append(
                    f"the cause explains {words} and leaves {len(unexplained):,}, the first in {place}")
        verdict.places = sorted({*unexplained, *mismatch.of(kind)})
        mismatch = mismatch if mismatch.of(kind) else finding.mismatch
        if verdict.places:
            verdict.first = difference_in_words(mismatch, min(mismatch.of(kind)), width)

    def has_other_colors(self, shown):
        """True if most pixels with a triangle have a color that zbuf gives to none, whichever they show: the
        text that the picture was judged by may lack triangles, and hold others in parts."""
        counts = collections.Counter(itertools.chain(*shown.colors))
        del counts[shown.background]
        state, channels = 1, []
        for _ in self.ours.world:  # as many as zbuf makes for its triangles (docs/stages.md, Z10)
            state = (214013 * state + 2531011) % 2**32
            channels.append((state >> 16 & 0x7fff) % 256)
        ours = {bytes(channels[i:i + 3]) for i in range(0, len(channels), 3)}
        return 2 * sum(counts[color] for color in ours) < sum(counts.values())


def blames_many_colors(verdict, shown, context, mismatch):
    """Adds the mistake many-colors to the causes in a picture's FileVerdict if, of the pixels that are
    right by a Mismatch, more lack their triangle's main color than the Mismatch has pixels; else False."""
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
