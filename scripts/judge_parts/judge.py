"""The judge: what is true of a hand-in, stage by stage.

Each stage is judged by the numbers that it may have read, those of the stage's file before it or the exact
ones in memory, so that a mistake counts once. A stage is right if it reproduces the numbers under any
combination of what the assignment leaves open; else wrong by the mistake that reproduces them; else, in stage
4, by another rule at the borders; else wrong without a cause.
"""
import collections

from judge_parts.hand_in import STAGE_OF, File
from judge_parts.pixels import PixelJudge
from judge_parts.points import read_points
from judge_parts.digits import of_one_program
from judge_parts.matrices import image
from judge_parts.reference import kinds_of, reference
from judge_parts.shown import Shown, read_colors, read_depths
from judge_parts.stage_judge import Outcome, Reading, StageJudge, undecided_outcome
from judge_parts.verdict import (
    ANOTHER_RULE, GOOD, MISSING, RIGHT, TOO_FEW_DIGITS, UNDECIDED, UNREADABLE, WRONG, FileVerdict, Verdict)
from lib.input_file import InputError
from lib.pictures import PictureError
from lib.stage_text import StageTextError

KINDS_IN_WORDS = {
    "extra": "a pixel that no triangle covers", "missing": "a pixel that a triangle covers is empty",
    "depth": "another depth", "other": "another triangle"}
FAR = 1e15
# triangles that clipping at six planes makes of one: more cannot come from the scene, and drawing them has no
# end
MOST_PARTS = 7
PRINTED = "pixels without a triangle are printed"


def judge(files, scene, config=None):
    """The Verdict on a hand-in: `files` are its Files by kind (hand_in.find_files), `scene` and `config` the
    bytes of those files. Without a config the first three stages are judged. Raises a JudgeError if there is
    nothing to judge by; whatever a file of the hand-in holds only costs that file its verdict."""
    return HandIn(files, reference(scene, config), kinds_of(config)).judge()


class HandIn:
    def __init__(self, files, ours, kinds):
        self.ours = ours
        self.files = {kind: files.get(kind) or File(kind) for kind in kinds}
        self.kinds = kinds
        self.failed = {}  # the verdicts of files that cannot be read

    def judge(self):
        points = self.read_stages()
        judge = StageJudge(self.ours.scene, self.ours.world)
        memory, before, verdicts = self.ours.world, None, []
        for kind, stage in (("stage1", "model"), ("stage2", "view"), ("stage3", "project")):
            theirs = points[kind]
            outcome = None
            readings = [Reading(before.points, before.units)
                        ] if before is not None and is_of_this_world(before.points) else []
            if memory is not None:
                readings.append(Reading.exact(memory))
            if theirs is not None and not theirs.points:
                outcome = self.of_empty_text(stage, kind, readings)
            elif theirs and stage == "model":
                outcome = judge.model(self.files[kind].name, theirs)
            elif theirs:
                outcome = self.after_model(judge, stage, kind, theirs, readings)
                if outcome.verdict.verdict == WRONG and verdicts[-1].verdict == WRONG:
                    # A program may write other numbers into a file than it goes on with.
                    by_right = self.after_model(judge, stage, kind, theirs,
                                                [Reading.exact(self.right_before(stage))])
                    if by_right.verdict.verdict in GOOD:
                        by_right.verdict.remarks.append(
                            f"by the right numbers, which are not those of {verdicts[-1].file}")
                        outcome = by_right
            if outcome is None:
                outcome = Outcome(self.failed[kind], self.right_memory(stage, readings))
            if theirs is not None and theirs.strays:
                outcome.verdict.remarks.append(theirs.strays)
            self.add_others(kind, outcome.verdict)
            verdicts.append(outcome.verdict)
            memory, before = outcome.memory, theirs
        if "picture" in self.kinds:
            verdicts += self.pixels(before, memory,
                                    self.right_ndc() if verdicts[-1].verdict == WRONG else None)
        verdicts[0].remarks += self.ours.remarks
        return Verdict(verdicts)

    def after_model(self, judge, stage, kind, theirs, readings):
        if stage == "view":
            return judge.view(self.files[kind].name, theirs, readings)
        return judge.project(self.files[kind].name, theirs, readings, self.clipped(readings))

    def right_before(self, stage):
        """The right points that a stage after model reads."""
        return self.ours.world if stage == "view" else [
            image(self.ours.scene.of_view(), p, False) for p in self.ours.world]

    def right_memory(self, stage, readings):
        """The points after a stage whose file is missing, if the stage is right."""
        if stage == "model" or not readings:
            return self.ours.world if stage == "model" else None
        m = self.ours.scene.of_view() if stage == "view" else self.ours.scene.of_project()
        return [image(m, p, stage == "project") for p in readings[-1].points]

    def clipped(self, readings):
        """What may be left of the points if project clips them, for each reading."""
        return [points for reading in readings if (points := self.ours.clipped(reading.points)) is not None]

    def of_empty_text(self, stage, kind, readings):
        """The Outcome of a text without triangles: right if nothing may be left of what the stage has
        read."""
        name = self.files[kind].name
        given = [self.ours.world] if stage == "model" else [reading.points for reading in readings]
        if not all(given) or stage == "project" and not all(self.clipped(readings)):
            return Outcome(FileVerdict(stage, name, RIGHT, differing=0), [])
        if not given:
            return undecided_outcome(stage, name)
        return Outcome(
            FileVerdict(
                stage, name, WRONG,
                remarks=["there is no triangle in it" if self.files[kind].data.strip() else "it is empty"]))

    def right_ndc(self):
        """What a program may have drawn by that writes other numbers into its file."""
        return [image(self.ours.scene.of_project(), p, True) for p in self.right_before("project")]

    # reading
    def read(self, kind, parse):
        """What `parse` makes of a file's bytes and name; None, and a verdict in `failed`, if it cannot be
        read."""
        file = self.files[kind]
        try:
            return parse(file.within(self.ours.limit(kind)), file.name)
        except InputError as error:
            verdict = MISSING if error.is_missing else UNREADABLE
            self.failed[kind] = FileVerdict(STAGE_OF[kind], file.name, verdict,
                                            remarks=[] if error.is_missing else [error.reason])
        except (StageTextError, PictureError) as error:
            self.failed[kind] = FileVerdict(STAGE_OF[kind], file.name, UNREADABLE, remarks=[str(error)])
        return None

    def read_stages(self):
        kinds = [kind for kind in self.kinds if kind.startswith("stage")]
        points = {kind: self.read(kind, read_points) for kind in kinds}
        given = [kind for kind in kinds if points[kind] is not None]
        for kind, digits in zip(given, of_one_program([points[kind].digits for kind in given])):
            points[kind].digits = digits
        return points

    def add_others(self, kind, verdict):
        others = self.files[kind].others
        if others:
            verdict.remarks.append(f"not looked at: {', '.join(others)}")

    # stage 4
    def pixels(self, stage3, memory, right_ndc):
        """The FileVerdicts of the depths and of the picture; `right_ndc` if stage3.txt does not have it."""
        window = self.ours.window
        depths = self.read("depths", read_depths)
        colors = self.read("picture",
                           lambda data, name: read_colors(data, name, window, self.ours.background))
        verdicts = {kind: self.failed.get(kind) for kind in ("depths", "picture")}
        if self.ours.has_own_colors and colors is not None:
            verdicts["picture"], colors = self.verdict_of_colors(colors), None
        readings = {}
        if stage3 is not None and len(stage3) <= MOST_PARTS * len(self.ours.world):
            readings["file"] = (stage3.points, stage3.units)
        is_defined = memory is not None and all(x == x for p in memory for x in p)
        if is_defined:
            readings["memory" if readings else "file"] = (memory, Reading.exact(memory).units)
        if readings and right_ndc and all(x == x for p in right_ndc for x in p):
            readings["right"] = (right_ndc, Reading.exact(right_ndc).units)
        if depths is not None and depths.rows and depths.digits.are_too_few:
            verdicts["depths"] = FileVerdict("zbuf", self.files["depths"].name, TOO_FEW_DIGITS,
                                             remarks=[f"it shows {depths.digits}"])
            depths = None
        if (depths is not None or colors is not None) and readings:
            shown = Shown(colors, depths, window.width, window.height, float(window.rear))
            finding = PixelJudge(readings, window, shown).judge()
            for kind, given in (("depths", depths), ("picture", colors)):
                if given is not None:
                    verdicts[kind] = self.verdict_of_pixels(kind, finding, shown)
        for kind, verdict in verdicts.items():
            if verdict is None:
                verdicts[kind] = verdict = undecided_outcome("zbuf", self.files[kind].name).verdict
            self.add_others(kind, verdict)
        return list(verdicts.values())

    def verdict_of_colors(self, colors):
        """The FileVerdict of a picture whose triangles have colors of their own, or light: every color
        counts, by either rule of coverage."""
        name, verdicts = self.files["picture"].name, []
        for coverage, verdict, rule in (("nearest", RIGHT, ""), ("center", ANOTHER_RULE, "the center rule")):
            ours = self.ours.picture(self.files["stage3"].data or b"", coverage)
            if ours is None:
                return FileVerdict("zbuf", name, UNDECIDED, remarks=["zbuf refuses their stage3.txt"])
            places = [(r, i)
                      for r, (row, line) in enumerate(zip(ours, colors))
                      for i, color in enumerate(line)
                      if row[3 * i:3 * i + 3] != color]
            verdicts.append(
                FileVerdict("zbuf", name, WRONG if places else verdict, "" if places else rule,
                            differing=len(places), compared=len(ours) * len(colors[0]), places=places))
        return min(verdicts, key=lambda verdict: verdict.differing)

    def verdict_of_pixels(self, kind, finding, shown):
        name = self.files[kind].name
        mismatch = finding.mismatch
        if mismatch is None:
            return FileVerdict("zbuf", name, UNDECIDED, remarks=finding.remarks)
        places = (mismatch.of_depths if kind == "depths" else mismatch.of_picture)
        verdict = FileVerdict("zbuf", name, RIGHT, finding.rule, differing=len(places),
                              compared=mismatch.drawn, places=places)
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
        if places and not verdict.is_good:
            row, column = min(places)
            verdict.first = f"row {row}, column {column}: " + KINDS_IN_WORDS[mismatch.pixels[row, column]]
        if verdict.rule and verdict.verdict == RIGHT:
            verdict.verdict = ANOTHER_RULE
        if kind == "picture" and verdict.is_good and self.has_other_colors(shown):
            verdict.remarks.append("in other colors")
        return verdict

    def has_other_colors(self, shown):
        """Whether most pixels with a triangle have a color that zbuf gives to none of the scene's. Which
        triangle a pixel shows is not asked: the text that it was judged by may lack some, and hold others in
        parts."""
        ours = set(generated_colors(len(self.ours.world) // 3))
        counts = collections.Counter(color for row in shown.colors for color in row
                                     if color != shown.background)
        return 2 * sum(count for color, count in counts.items() if color not in ours) > sum(counts.values())


def is_of_this_world(points):
    """Whether the points are so near that the numbers of the next stage are finite."""
    return all(abs(x) < FAR for p in points for x in p)


def generated_colors(count):
    """The colors that zbuf gives to the first triangles, as bytes (docs/stages.md, Z10)."""
    state = 1
    for _ in range(count):
        color = []
        for _ in range(3):
            state = (214013 * state + 2531011) % 2**32
            color.append((state >> 16 & 0x7fff) % 256)
        yield bytes(color)
