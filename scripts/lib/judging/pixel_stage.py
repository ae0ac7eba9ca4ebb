"""Stage 4 of a hand-in, from its readings to the verdicts on the depths and on the picture."""
import collections
import dataclasses
import itertools

from lib.judging import pixel_colors
from lib.judging.pixel_comparing import Context
from lib.judging.pixel_files import Findings, mismatch_to_show
from lib.judging.pixel_search import unknown
from lib.judging.pixel_words import difference_in_words, unexplained_in_words
from lib.judging.raster import TooMuch
from lib.judging.shown import Shown
from lib.judging.stage_judge import undecided_outcome
from lib.judging.stage_ways import Reading
from lib.judging.verdict import (ANOTHER_RULE, RIGHT, TOO_FEW_DIGITS, UNDECIDED, WRONG, FileVerdict, cause_of)

TOO_MUCH = "there are too many pixels of triangles"
PRINTED = "pixels without a triangle are printed"


def pixel_readings(stage3, memory, right_ndc):
    """{name: (points, units)} of what a program may have drawn: the file, the numbers in memory, and the
    right ones, also as a text has them after three roundings, if its stages are not."""
    readings = {}
    if stage3 is not None:
        readings["file"] = (stage3.points, stage3.units)
    for name, points in (("memory" if readings else "file", memory), ("right", right_ndc)):
        if points is not None and all(x == x for p in points for x in p):
            readings[name] = (points, Reading.exact(points).units)
            if name == "right":
                text = [tuple(round(x, 7) for x in p) for p in points]
                readings["right text"] = (text, [(3e-7,) * 3] * len(text))
    return readings


class PixelStage:
    """Judges depths and picture. `thin` names a stage3.txt that holds too little to judge by; `borders_first`
    is that of judge.HandIn."""
    def __init__(self, ours, files, readings, thin, borders_first):
        self.ours, self.files, self.readings, self.thin = ours, files, readings, thin
        self.borders_first = borders_first

    def verdicts(self, depths, colors):
        """{kind: FileVerdict} of what could be read; each of the two may be None."""
        verdicts = {}
        if self.ours.has_own_colors and colors is not None:
            verdicts["picture"], colors = self.verdict_of_colors(colors), None
        if depths is not None and depths.rows and depths.digits.are_too_few:
            verdicts["depths"] = FileVerdict("zbuf", self.files["depths"].name, TOO_FEW_DIGITS, remarks=[
                f"it shows {depths.digits}"])
            depths = None
        given = [kind for kind, what in (("depths", depths), ("picture", colors)) if what is not None]
        if not given:
            return verdicts

        def undecided(*why):
            return verdicts | {
                kind: undecided_outcome("zbuf", self.files[kind].name, *why).verdict
                for kind in given}

        if not self.readings:
            return undecided()
        shown = self.shown(colors, depths)
        context = Context(self.readings, self.ours.window, shown, borders_first=self.borders_first)
        counts = (len(points) // 3 for points, _ in self.readings.values())
        has_many = pixel_colors.has_many(shown, max(len(self.ours.world) // 3, *counts))
        try:
            found = has_many and self.verdicts_of_many_colors(given, context)
            return verdicts | (found or self.verdicts_of_shown(given, context, Findings(context))[0])
        except TooMuch:
            return undecided(TOO_MUCH)

    def verdicts_of_many_colors(self, given, context):
        """The verdicts if a picture has too many colors for its triangles: that these have many, if it
        explains most of the picture; that no color is a triangle's, if even the outlines are others; else
        nothing."""
        shown = context.shown
        in_one_color = Context(self.readings, self.ours.window, shown.in_one_color())
        if pixel_colors.is_another_picture(in_one_color):
            picture = unknown(context.of_one_file("picture").plain)
            return self.verdicts_of_shown(given, context, Findings(context, picture))[0]
        verdicts, mismatch = self.verdicts_of_shown(given, in_one_color, Findings(in_one_color))
        many = pixel_colors.ManyColors(shown, in_one_color, mismatch)
        if not many.explain_most:
            return {}
        many.add_to(verdicts["picture"])
        return verdicts

    def verdicts_of_shown(self, given, context, findings):
        """The verdicts on the files of a Context, and the Mismatch of the last one."""
        shown, verdicts = context.shown, {}
        for kind in given:
            best = findings.of(kind)
            verdicts[kind] = self.verdict_of_pixels(kind, best, shown)
            needs_both = best is findings.of_all and kind == "depths"  # whose pixels the picture shows
            self.add_first(verdicts[kind], kind, best, context if needs_both else context.of_one_file(kind))
            is_open = self.thin or verdicts[kind].is_good
            if is_open and shown.is_blank(kind) and not self.ours.draws_nothing:
                why = f"there is too little in {self.thin}" if self.thin else "nothing is in view"
                verdicts[kind] = undecided_outcome("zbuf", self.files[kind].name, why).verdict
        return verdicts, best.mismatch

    def shown(self, colors, depths):
        window = self.ours.window
        return Shown(colors, depths, window.width, window.height, float(window.rear), self.is_uncovered)

    def verdicts_of_exchanged(self, depths, colors):
        """The verdicts, if the picture's rows are our columns; those of the text may be, too."""
        kinds = ["picture"]
        if depths is not None:
            shown = self.shown(colors, depths)
            rows = shown.listed_rows("transposed", shown.pixels().drawn)
            if any(rows):
                kinds, depths = ["depths", "picture"], dataclasses.replace(depths, rows=rows)
        verdicts = self.verdicts(depths, colors)
        for kind in kinds:
            if kind in verdicts and verdicts[kind].is_good:
                verdicts[kind].verdict, verdicts[kind].rule = WRONG, ""
                verdicts[kind].causes = [cause_of("zbuf/rows-and-columns-exchanged")]
        return verdicts

    def is_uncovered(self):
        """Rows of whether our picture of their points, or of ours, shows the background."""
        texts = [self.files["stage3"].data or b"", self.ours.stage3]
        rows = next(filter(None, map(self.ours.picture, texts)), [])
        return [[row[i:i + 3] == self.ours.background for i in range(0, len(row), 3)] for row in rows]

    def verdict_of_colors(self, colors):
        """The FileVerdict of a picture whose triangles have colors of their own, or light: every color
        counts, by either rule of coverage."""
        name, verdicts = self.files["picture"].name, []
        is_right_asked = self.thin or "right" in self.readings
        texts = [self.ours.stage3, self.ours.stage3_of_exact] if is_right_asked else []
        texts += [] if self.thin else [self.files["stage3"].data or b""]
        rules = ("nearest", RIGHT, ""), ("center", ANOTHER_RULE, "the center rule")
        for text, (coverage, verdict, rule) in itertools.product(texts, rules):
            ours = self.ours.picture(text, coverage)
            if ours is None:
                continue
            places = [(r, i) for r, (row, line) in enumerate(zip(ours, colors))
                      for i, color in enumerate(line) if row[3 * i:3 * i + 3] != color]
            verdicts.append(
                FileVerdict("zbuf", name, WRONG if places else verdict, "" if places else rule,
                            differing=len(places), compared=len(ours) * len(colors[0]), places=places,
                            first="row {}, column {}: another color".format(*places[0]) if places else ""))
        if not verdicts:
            return FileVerdict("zbuf", name, UNDECIDED, remarks=["zbuf refuses their stage3.txt"])
        return min(verdicts, key=lambda verdict: verdict.differing)

    def verdict_of_pixels(self, kind, finding, shown):
        name = self.files[kind].name
        mismatch = finding.mismatch
        places = mismatch.of(kind)
        verdict = FileVerdict("zbuf", name, RIGHT, finding.rule, differing=len(places),
                              compared=mismatch.drawn + len(mismatch.extra), places=places)
        if finding.verdict in ("mistake", "unknown") and kind in finding.touches:
            verdict.verdict, verdict.causes, verdict.rule = WRONG, finding.causes, ""
            verdict.remarks += [f"with {finding.rule}"] if finding.rule and finding.causes else []
        elif finding.verdict == "unknown":
            verdict.rule = ""
        verdict.remarks += finding.remarks
        if kind == "depths" and shown.prints_everything:
            is_rear = abs(shown.empty - shown.rear) <= shown.depths.tolerance(shown.rear)
            printed = f"{PRINTED}, too, with " + ("the rear limit" if is_rear else f"{shown.empty:.7g}")
            verdict.rule = f"{verdict.rule}; {printed}" if verdict.rule else printed
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
        mismatch = mismatch_to_show(context, finding, verdict.verdict == WRONG)
        if finding.verdict == "mistake" and verdict.causes:
            verdict.explained = len({*context.plain.of(kind)} - {*unexplained})
            if unexplained:
                verdict.remarks.append(unexplained_in_words(unexplained, verdict.explained, width))
        verdict.places = sorted({*unexplained, *mismatch.of(kind)})
        mismatch = mismatch if mismatch.of(kind) else finding.mismatch
        if verdict.places:
            verdict.first = difference_in_words(mismatch, min(mismatch.of(kind)), width)

    def has_other_colors(self, shown):
        """True if most pixels with a triangle have a color that zbuf gives to none of the scene's. Which
        triangle a pixel shows is not asked: the text that it was judged by may lack some, and hold others in
        parts."""
        ours = set(generated_colors(len(self.ours.world) // 3))
        counts = collections.Counter(
            color for row in shown.colors for color in row if color != shown.background)
        return 2 * sum(count for color, count in counts.items() if color not in ours) > sum(counts.values())


def generated_colors(count):
    """The colors that zbuf gives to the first triangles, as bytes (docs/stages.md, Z10)."""
    state = 1
    for _ in range(count):
        color = []
        for _ in range(3):
            state = (214013 * state + 2531011) % 2**32
            color.append((state >> 16 & 0x7fff) % 256)
        yield bytes(color)
