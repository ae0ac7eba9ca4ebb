#!/usr/bin/env python3
"""The judge on random scenes and a student's program: right without a switch and with every harmless habit;
with a mistake wrong, by its true cause, wherever its numbers differ. No cause is false, and no stage accused
but the mistake's. The same for mistakes that no list has (changes.py): they are made in the texts of its
right run.

usage: judge_test.py STUDENT BIN_DIR SOURCE_DIR [SCENES [SHARE]]

Of each scene every SHARE-th switch is tried (by default every fourth), others at the next scene; every other
scene is drawn by the center rule. From MANY scenes on, all switches are tried on plain samples, too, and all
samples are damaged. The scenes are the same in every run; the processors share them.
"""
import concurrent.futures
import itertools
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
from collections import namedtuple

arguments = [sys.argv.pop(1) for _ in sys.argv[1:]]
student, bin_dir, source = (pathlib.Path(path).resolve() for path in arguments[:3])
scene_count, share = (int(word) for word in (*arguments[3:], *("20", "4")[len(arguments) - 3:]))
os.environ |= {"BIN": str(bin_dir), "STUDENT_SEED": "1"}  # of random pixels
import changes  # noqa: E402
import course_scenes  # noqa: E402
import damages  # noqa: E402
from lib.judging.hand_in import find_files  # noqa: E402
from lib.judging.judge import judge  # noqa: E402
from lib.judging.mistakes import sentences  # noqa: E402
from lib.text.stage_text import parse_stage_text  # noqa: E402
from sample_files import sample_file  # noqa: E402

NOTHING_IN_VIEW = "nothing is in view"  # of what the stages before have made
SAMPLES = ("tilted-camera", "nested-transforms", "worked-example")
SWEPT = sorted(path.parent.name for path in source.glob("samples/*/out.bmp"))
DAMAGES = 4  # of each scene, besides a missing triangle
DAMAGES_OF_SAMPLE = 5
MANY = 100
LEAST_NAMED = 0.9  # of the mistakes whose numbers differ
FILES_OF = {
    "model": ("stage1.txt",), "view": ("stage2.txt",), "project": ("stage3.txt",),
    "zbuf": ("z_buffer.txt", "out.bmp")}
# The mistakes that damages may come from, too.
BLANK = {"starts-at-zero", "one-winding", "no-depth-passes", "black-picture", "last-triangle-missing"}
TRUE_OF = {how: BLANK
           for how in damages.HOWS} | {
               "of another scene": (), "cut in half": {*BLANK, "half-triangle", "triangle-missing"}}
MISTAKES, HABITS = [*sentences()], [*sentences("habits.txt")]


def tool(name, *words, stdin=b""):
    return subprocess.run([bin_dir / name, *words], input=stdin, stdout=subprocess.PIPE, check=True).stdout


class Scene:
    def __init__(self, seed, is_ours=False):
        self.habits = ()
        if isinstance(seed, str):
            folder = source / "samples" / seed
            self.scene, self.config = ((folder / name).read_bytes() for name in ("scene.txt", "config.txt"))
            self.right = {name: sample_file(bin_dir, folder, name)
                          for name in damages.NAMES} if is_ours else self.made()
            return
        rng = random.Random(seed)
        self.scene = course_scenes.scene(rng).encode()
        stage3 = tool("project", "--clip", "none", stdin=tool("view", stdin=tool("model", stdin=self.scene)))
        depths = [p[2] for p in parse_stage_text(stage3.decode(), "stage3").points]
        self.config = course_scenes.config(rng, depths).encode()
        self.right = self.made()

    def made(self, *switches):
        """The files of the student's program."""
        switches += self.habits
        words = [word for name in switches for word in ("--habit" if name in HABITS else "--mistake", name)]
        with tempfile.TemporaryDirectory() as top:
            scene, config, folder = (os.path.join(top, name)
                                     for name in ("scene.txt", "config.txt", "theirs"))
            pathlib.Path(scene).write_bytes(self.scene)
            pathlib.Path(config).write_bytes(self.config)
            os.mkdir(folder)
            subprocess.run([student, "all", scene, config, "--folder", folder, *words], check=True)
            return {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}

    def judged(self, files, has_config=True):
        """The Verdict."""
        with tempfile.TemporaryDirectory() as top:
            for name, data in files.items():
                pathlib.Path(top, name).write_bytes(data)
            return judge(find_files(top), self.scene, self.config if has_config else None)

    def damaged(self, rng, other):
        """(what was done, to which files, those judged otherwise than they earn, or said to have a mistake)
        of a damaged hand-in."""
        how, names = rng.choice(damages.HOWS), rng.choice(damages.SUBSETS)
        files = {
            name: damages.damaged(name, data, how, other[name]) if name in names else data
            for name, data in self.right.items()}
        found, wanted = self.judged(files).files, damages.expected(self.right, files, how)
        return how, names, [
            file.file for file in found
            if wanted.get(file.file, file.is_good) != file.is_good or file.stage == "zbuf" and any(
                cause.name for cause in file.causes if cause.name.partition("/")[2] not in TRUE_OF[how])]

    def without_a_triangle(self, rng):
        """The same of depths and a picture that lack a triangle which can be seen; None if there is none."""
        triangles = damages.numbered_triangles(self.right["stage3.txt"].decode())
        deep = damages.deep_colors(self.right["out.bmp"])
        colors = enumerate(damages.generated_colors(triangles[-1][0] + 1))
        seen = [i for i, color in colors if color in deep]
        if not seen:
            return None
        lost = rng.choice(seen)
        text = "".join(f"triangle {i}\n{part}\n\n" for i, part in triangles if i != lost)
        with tempfile.TemporaryDirectory() as top:
            pathlib.Path(top, "config.txt").write_bytes(self.config)
            picture = os.path.join(top, "out.bmp")
            depths = tool("zbuf", os.path.join(top, "config.txt"), "-o", picture, stdin=text.encode())
            files = {**self.right, "z_buffer.txt": depths, "out.bmp": pathlib.Path(picture).read_bytes()}
        return "a triangle missing", lost, [
            file.file for file in self.judged(files).files if file.is_good != file.file.startswith("stage")]

    def changed(self, change, rng):
        """The FileVerdict of a stage whose right text is changed, and the words that its cause has to begin
        with."""
        number = ("model", "view", "project").index(change.stage) + 1
        texts = [self.scene.decode(), *(self.right[f"stage{i}.txt"].decode() for i in (1, 2, 3))]
        text, words = change.make(texts, number, rng)
        verdict = self.judged({**self.right, f"stage{number}.txt": text.encode()}, has_config=False)
        return verdict.of(change.stage)[0], words


# What the judge makes of one run: the scene's number, the switch (or none), the FileVerdicts, the exit
# status, and the stages whose files differ from those of the right run.
Run = namedtuple("Run", "scene switch files status differing")
ChangedRun = namedtuple("ChangedRun", "scene name file words")
DamagedRun = namedtuple("DamagedRun", "scene how files misjudged")


def stages_that_differ(files, right):
    return [
        stage for stage, names in FILES_OF.items() if any(files.get(name) != right[name] for name in names)]


def runs_of(seed):
    """The Runs of a scene, without a switch and with all that may be tried on it; None if a vertex lies
    behind the eye."""
    try:
        scene = Scene(seed)
    except subprocess.CalledProcessError:
        return None
    runs, right = [], scene.right
    turn, step = (0, 1) if seed in SAMPLES else (seed % share, share)
    for switch in (None, *HABITS, *MISTAKES):
        place = (MISTAKES if switch in MISTAKES else HABITS).index(switch) if switch else 0
        if switch == MISTAKES[0] and seed not in SAMPLES and seed // share % 2:
            scene.habits = ("zbuf/center",)
            right = scene.made()
        if not switch or place % step == turn:
            try:
                files = scene.made(*([switch] if switch else []))
            except subprocess.CalledProcessError:  # a mistake that divides by 0 where this sample is exact
                if seed in SAMPLES:
                    continue
                raise
            verdict = scene.judged(files)
            for file in verdict.files:
                file.places = []  # thousands of pixels that nobody asks for
            runs.append(Run(seed, switch, verdict.files, verdict.status, stages_that_differ(files, right)))
    if seed in SAMPLES:
        return runs
    scene.habits = ()
    rng = random.Random(seed)
    for place, change in enumerate(changes.CHANGES):
        if place % share == turn:
            runs.append(ChangedRun(seed, change.name, *scene.changed(change, rng)))
    return runs + damaged_runs(seed, scene, next_scene(seed), DAMAGES)


def damaged_runs(seed, scene, other, count):
    rng = random.Random(seed)
    tried = [*(scene.damaged(rng, other.right) for _ in range(count)), scene.without_a_triangle(rng)]
    return [DamagedRun(seed, *one) for one in tried if one]


def damaged_sample(name):
    other = SWEPT[SWEPT.index(name) - 1]
    return damaged_runs(name, Scene(name, True), Scene(other, True), DAMAGES_OF_SAMPLE)


def next_scene(seed):
    """The next one without a vertex behind the eye."""
    try:
        return Scene(seed + 1)
    except subprocess.CalledProcessError:
        return next_scene(seed + 1)


def described(run):
    return [(file.file, file.verdict, file.rule, [cause.name for cause in file.causes], file.remarks)
            for file in run.files]


class Judged(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs, cls.changed, cls.damaged, count, seeds = [], [], [], 0, itertools.count()
        with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
            while count < scene_count:
                for runs in pool.map(runs_of, itertools.islice(seeds, scene_count - count)):
                    cls.runs += [run for run in runs or [] if isinstance(run, Run)]
                    cls.changed += [run for run in runs or [] if isinstance(run, ChangedRun)]
                    cls.damaged += [run for run in runs or [] if isinstance(run, DamagedRun)]
                    count += runs is not None
            if scene_count >= MANY:
                cls.damaged += itertools.chain(*pool.map(damaged_sample, SWEPT))
                cls.runs += itertools.chain(*pool.map(runs_of, SAMPLES))

    def of(self, switches):
        return [run for run in self.runs if run.switch in switches]

    def shown(self, run):
        return self.subTest(run.switch, scene=run.scene)

    def test_right_without_a_switch(self):
        for run in self.of([None]):
            with self.shown(run):
                self.assertEqual({file.verdict for file in run.files}, {"right"}, described(run))

    def test_right_with_every_habit(self):
        for run in self.of(HABITS):
            with self.shown(run):
                self.assertEqual(run.status, 0, described(run))

    def test_right_by_exact_numbers_where_depths_need_them(self):
        scene = Scene(5003)  # a triangle is seen so much from its edge that 7 decimals are too few
        verdict = scene.judged(scene.made("all/exact-in-memory"))
        self.assertIn("by the exact numbers, kept in memory", verdict.of("zbuf")[0].remarks)
        self.assertEqual(verdict.status, 0)

    def test_no_stage_is_accused_but_the_mistakes(self):
        for run in self.of(MISTAKES):
            stage = run.switch.partition("/")[0]
            before = [*FILES_OF][:[*FILES_OF].index(stage)]
            out_of_view = [[NOTHING_IN_VIEW]] if stage in ("view", "project") else []
            with self.shown(run):
                self.assertTrue({*before}.isdisjoint(run.differing))
                self.assertEqual([
                    file.verdict for file in run.files
                    if file.stage != stage and not file.is_good and [file.remarks] != out_of_view], [],
                                 described(run))
                if stage not in run.differing:
                    self.assertEqual(run.status, 0, described(run))

    def test_a_mistake_is_named_and_no_other(self):
        differing = [run for run in self.of(MISTAKES) if run.switch.partition("/")[0] in run.differing]
        accepted = [run for run in differing if run.status == 0]
        nameless = []
        for run in differing:
            causes = {
                name
                for file in run.files for cause in file.causes for name in cause.name.split(" and ")}
            nameless += [] if run.switch in causes else [f"{run.switch} in scene {run.scene}"]
            with self.shown(run):
                self.assertTrue(run.switch in causes or not causes, described(run))
        named = len(differing) - len(nameless)
        print(
            f"{len(self.runs)} runs, {len(differing)} with a mistake that shows, {named} of those named, "
            f"{len(accepted)} taken for right", file=sys.stderr)
        for words in nameless:
            print("  not named:", words, file=sys.stderr)
        self.assertGreater(len(differing), scene_count)
        self.assertGreaterEqual(named, LEAST_NAMED * len(differing))

    def test_what_is_damaged_earns_nothing_and_what_is_whole_keeps_its_points(self):
        print(
            f"{len(self.damaged)} damaged hand-ins, {sum(bool(run.misjudged) for run in self.damaged)} "
            "misjudged", file=sys.stderr)
        self.assertGreater(len(self.damaged), scene_count * DAMAGES)
        for run in self.damaged:
            with self.subTest(run.how, scene=run.scene, files=run.files):
                self.assertEqual(run.misjudged, [])

    def test_a_change_that_no_list_has_is_named_and_no_other(self):
        nameless = []
        for run in self.changed:
            with self.subTest(run.name, scene=run.scene):
                self.assertEqual(run.file.verdict, "wrong")
                texts = [cause.text for cause in run.file.causes]
                is_named = any(text.startswith(run.words) for text in texts)
                self.assertTrue(is_named or not texts, (texts, run.words))
                nameless += [] if is_named else [f"{run.name} in scene {run.scene}"]
        print(f"{len(self.changed)} changed texts, {len(self.changed) - len(nameless)} of those named",
              file=sys.stderr)
        for words in nameless:
            print("  not named:", words, file=sys.stderr)
        self.assertGreaterEqual(len(self.changed) - len(nameless), LEAST_NAMED * len(self.changed))


if __name__ == "__main__":
    unittest.main()
