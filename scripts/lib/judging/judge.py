"""The judge: the verdicts on a hand-in, stage by stage.

Each stage is judged by the numbers that it may have read, from the file of the stage before it or, exact,
from memory, so that a mistake counts once. A stage is right if any combination of the rules that the
assignment leaves open reproduces its numbers; else wrong by the mistake that does; else, in stage 4, right by
another rule at the borders; else wrong without a cause.
"""
import math

from lib.judging.hand_in import STAGE_OF, File
from lib.judging.pixel_stage import PixelStage, pixel_readings
from lib.judging.points import dropped, holds_enough, read_points, share_digits
from lib.judging.reference import kinds_of, reference
from lib.judging.shown import read_colors, read_depths
from lib.judging.stage_judge import stage_outcome, undecided
from lib.judging.stage_ways import exact_images, exact_reading
from lib.judging.verdict import BY_THE_RIGHT, MISSING, RIGHT, UNREADABLE, WRONG, FileVerdict, Verdict
from lib.rim.input_file import InputError
from lib.showing.pictures import PictureError
from lib.text.stage_text import StageTextError

FAR = 1e15
MOST_PARTS = 7  # of a triangle, as clipping at six planes makes them; more could take forever to draw
STAGES = (("stage1", "model"), ("stage2", "view"), ("stage3", "project"))


def judge(files, scene, config=None):
    """The Verdict on a hand-in: `files` are its Files by kind (hand_in.find_files), `scene` and `config` the
    bytes of those files. Without a config the first three stages are judged. Raises a JudgeError if there is
    nothing to judge by; a bad file of the hand-in only spoils its own verdict."""
    return HandIn(files, reference(scene, config), kinds_of(config)).judge()


class HandIn:
    def __init__(self, files, ours, kinds, borders_first=False):
        """`borders_first` lets stage 4 be right by another rule at the borders before a mistake is looked
        for: a hand-in that needs such a rule for one scene has it for all."""
        self.ours, self.borders_first = ours, borders_first
        self.files = {kind: files.get(kind) or File(kind) for kind in kinds}
        self.kinds = kinds
        self.failed = {}  # the verdicts of files that cannot be read
        self.size = None  # of a picture, if it is not the config's

    def judge(self):
        points = {kind: self.read(kind, read_points) for kind, _ in STAGES}
        share_digits([some for some in points.values() if some is not None])
        memory, before, thin, verdicts = self.ours.world, None, "", []
        for kind, stage in STAGES:
            name, theirs, readings = self.files[kind].name, points[kind], self.readings(before, memory)
            is_thin = theirs is not None and not any(
                holds_enough(theirs.points, right) for right in self.right_after(stage))
            if thin and is_thin:
                verdict, memory = undecided(stage, name, f"there is too little in {thin}"), None
            elif theirs is None:
                verdict, memory = self.failed[kind], self.right_memory(stage, readings)
            else:
                verdict, memory = self.outcome(stage, kind, theirs, readings, verdicts)
            verdict.remarks += [] if theirs is None else [*theirs.remarks, *dropped(before, theirs)]
            verdicts.append(verdict)
            before, thin = theirs, ""
            if is_thin:  # the next stage is judged as if this file were missing
                memory, before, thin = self.right_memory(stage, readings), None, name
        if "picture" in self.kinds:
            verdicts += self.pixels(before, memory, thin, all(verdict.is_good for verdict in verdicts))
        for kind, verdict in zip(self.kinds, verdicts):
            if others := self.files[kind].others:
                verdict.remarks.append(f"not looked at: {', '.join(others)}")
        verdicts[0].remarks += self.ours.remarks
        return Verdict(verdicts)

    @staticmethod
    def readings(before, memory):
        """The possible inputs of a stage: the points of the file before it, and those in memory."""
        # The numbers of the next stage have to be finite.
        is_near = before is not None and all(abs(x) < FAR for p in before.points for x in p)
        found = [(before.points, before.units)] if is_near else []
        return found if memory is None else [*found, exact_reading(memory)]

    def outcome(self, stage, kind, theirs, readings, verdicts):
        """The result of stage_outcome for a readable text, after the verdicts on the stages before."""
        name = self.files[kind].name
        if not theirs.points:
            return self.of_empty_text(stage, kind, readings)
        outcome = stage_outcome(self.ours, stage, name, theirs, readings, self.clipped(stage, readings))
        failed = [verdict for verdict in verdicts if not verdict.is_good]
        if outcome[0].verdict == WRONG and failed:
            # A program may write other numbers into a file than it keeps in memory.
            right = [exact_reading(self.ours.exact["model" if stage == "view" else "view"])]
            by_right = stage_outcome(self.ours, stage, name, theirs, right, self.clipped(stage, right))
            if by_right[0].is_good:
                by_right[0].remarks.append(BY_THE_RIGHT + failed[-1].file)
                return by_right
        return outcome

    def right_after(self, stage):
        """The lists of points that are right after a stage; project may clip or not."""
        exact = self.ours.exact
        return [exact[stage], *self.clipped(stage, [exact_reading(exact["view"])])]

    def right_memory(self, stage, readings):
        """The points after a stage whose file is missing, if the stage is right."""
        if stage == "model" or not readings:
            return self.ours.world if stage == "model" else None
        return exact_images(self.ours.scene.matrix(stage), stage == "project", readings[-1][0])

    def clipped(self, stage, readings):
        """The points that may be left if project clips them, for each reading; none after other stages."""
        parts = (self.ours.clipped(tuple(points)) for points, _ in readings) if stage == "project" else ()
        return [points for points in parts if points is not None]

    def of_empty_text(self, stage, kind, readings):
        """As stage_outcome, of a text without triangles: right where there may be none."""
        name = self.files[kind].name
        if not all(self.right_after(stage)):
            return FileVerdict(stage, name, RIGHT, differing=0), []
        if not readings and stage != "model":
            return undecided(stage, name), None
        if not all(self.clipped(stage, readings)):
            return undecided(stage, name, "what it was to project may be out of view"), None
        why = "there is no triangle in it" if self.files[kind].data.strip() else "it is empty"
        return FileVerdict(stage, name, WRONG, remarks=[why]), None

    # reading
    def read(self, kind, parse):
        """A file as `parse` reads it; None, and a verdict in `failed`, if it cannot be read."""
        file = self.files[kind]
        try:
            return parse(file.within(self.ours.limit(kind)), file.name)
        except (InputError, StageTextError, PictureError) as error:
            verdict = FileVerdict(STAGE_OF[kind], file.name, MISSING)
            if not getattr(error, "is_missing", False):
                verdict.verdict, verdict.remarks = UNREADABLE, [getattr(error, "reason", str(error))]
            self.failed[kind], self.size = verdict, getattr(error, "size", None) or self.size
            return None

    def colors(self, *size):
        return self.read("picture", lambda data, name: read_colors(data, name, size, self.ours.background))

    # stage 4
    def pixels(self, stage3, memory, thin, is_right):
        """The FileVerdicts of the depths and of the picture. `thin` names a stage3.txt of too few points,
        `is_right` is True if all stages before are right."""
        width, height = self.ours.window.width, self.ours.window.height
        depths, colors, failed = self.read("depths", read_depths), self.colors(width, height), {**self.failed}
        is_small = self.size and 3 * math.prod(self.size) < self.ours.limit("picture")
        is_turned = self.size == (height, width)  # so that its rows may be our columns
        own = self.colors(*self.size) if is_small or is_turned else None  # of its own size
        exchanged = own if is_turned else None
        if stage3 is not None and len(stage3) > MOST_PARTS * len(self.ours.world):
            stage3 = None
        readings = pixel_readings(stage3, memory, None if is_right else self.right_after("project")[-1])
        judge = PixelStage(self.ours, self.files, readings, thin, self.borders_first)
        verdicts = failed | (judge.verdicts_of_exchanged(depths, [*map(list, zip(*exchanged))])
                             if exchanged else judge.verdicts(depths, colors))
        if self.size and not verdicts["picture"].causes:
            verdicts = failed | judge.verdicts(depths, None) if exchanged else verdicts
            judge.blame_size(verdicts, self.size, depths, is_small and own)
        return [verdicts["depths"], verdicts["picture"]]
