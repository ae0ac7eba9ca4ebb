#!/usr/bin/env python3
"""The judge on random scenes and a student's program: right without a switch and with every harmless habit;
with a mistake wrong, by its true cause, wherever its numbers differ. No cause is false, and no stage accused
but the mistake's. The same for mistakes that no list has (changes.py): they are made in the texts of its
right run.

usage: judge_test.py STUDENT BIN_DIR SOURCE_DIR [SCENES [SHARE]]

Of each scene every SHARE-th switch is tried (by default every fourth), others at the next scene; every other
scene is drawn by the center rule. If SHARE is 1, all switches are tried on plain samples, too. The scenes
are the same in every run; the processors share them.
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
from lib.text.stage_text import parse_stage_text  # noqa: E402

NOTHING_IN_VIEW = "nothing is in view"  # of what the stages before have made
SAMPLES = ("tilted-camera", "nested-transforms", "worked-example")
DAMAGES = 4  # of each scene, besides a missing triangle
LEAST_NAMED = 0.9  # of the mistakes whose numbers differ
FILES_OF = {
    "model": ("stage1.txt", ), "view": ("stage2.txt", ), "project": ("stage3.txt", ),
    "zbuf": ("z_buffer.txt", "out.bmp")}


def listed(name):
    lines = (source / "tests/conformance" / name).read_text().splitlines()
    return [line.split(":")[0].removeprefix("judge ") for line in lines if line and line[0] != "#"]


MISTAKES, HABITS = listed("mistakes.txt"), listed("habits.txt")


def tool(name, *words, stdin=b""):
    return subprocess.run([bin_dir / name, *words], input=stdin, stdout=subprocess.PIPE, check=True).stdout


class Scene:
    def __init__(self, seed):
        self.habits = ()
        if seed in SAMPLES:
            folder = source / "samples" / seed
            self.scene, self.config = ((folder / name).read_bytes() for name in ("scene.txt", "config.txt"))
            self.right = self.run()[0]
            return
        rng = random.Random(seed)
        self.scene = course_scenes.scene(rng).encode()
        stage3 = tool("project", "--clip", "none", stdin=tool("view", stdin=tool("model", stdin=self.scene)))
        depths = [p[2] for p in parse_stage_text(stage3.decode(), "stage3").points]
        self.config = course_scenes.config(rng, depths).encode()
        self.right = self.run()[0]

    def run(self, *switches):
        """The files of the student's program, and the Verdict."""
        switches += self.habits
        words = [word for name in switches for word in ("--habit" if name in HABITS else "--mistake", name)]
        with tempfile.TemporaryDirectory() as top:
            scene, config, folder = (os.path.join(top, name)
                                     for name in ("scene.txt", "config.txt", "theirs"))
            pathlib.Path(scene).write_bytes(self.scene)
            pathlib.Path(config).write_bytes(self.config)
            os.mkdir(folder)
            subprocess.run([student, "all", scene, config, "--folder", folder, *words], check=True)
            files = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
            return files, judge(find_files(folder), self.scene, self.config)

    def verdicts(self, files):
        """{name: whether the judge gives a file its point}."""
        with tempfile.TemporaryDirectory() as top:
            for name, data in files.items():
                pathlib.Path(top, name).write_bytes(data)
            return {file.file: file.is_good for file in judge(find_files(top), self.scene, self.config).files}

    def damaged(self, rng, other):
        """(what was done, what of it, the files judged otherwise than they earn) of damaged hand-ins."""
        how, names = rng.choice(damages.HOWS), rng.choice(damages.SUBSETS)
        files = {
            name: damages.damaged(name, data, how, other[name]) if name in names else data
            for name, data in self.right.items()}
        found, wanted = self.verdicts(files), damages.expected(self.right, files, how)
        return how, names, [name for name, is_good in wanted.items() if found[name] != is_good]

    def without_a_triangle(self, rng):
        """The same of depths and a picture that lack a triangle which can be seen; None if there is none."""
        triangles = self.right["stage3.txt"].rstrip().split(b"\n\n")
        deep = damages.deep_colors(self.right["out.bmp"])
        seen = [i for i, color in enumerate(damages.generated_colors(len(triangles))) if color in deep]
        if not seen:
            return None
        lost = rng.choice(seen)
        text = "".join(f"triangle {i}\n{part.decode()}\n\n" for i, part in enumerate(triangles) if i != lost)
        with tempfile.TemporaryDirectory() as top:
            pathlib.Path(top, "config.txt").write_bytes(self.config)
            picture = os.path.join(top, "out.bmp")
            depths = tool("zbuf", os.path.join(top, "config.txt"), "-o", picture, stdin=text.encode())
            files = {**self.right, "z_buffer.txt": depths, "out.bmp": pathlib.Path(picture).read_bytes()}
        found = self.verdicts(files)
        wanted = {name: name.startswith("stage") for name in damages.NAMES}
        return "a triangle missing", lost, [name for name in damages.NAMES if found[name] != wanted[name]]

    def changed(self, change, rng):
        """The FileVerdict of a stage whose right text is changed, and the words that its cause has to begin
        with."""
        with tempfile.TemporaryDirectory() as top:
            for name, text in self.right.items():
                pathlib.Path(top, name).write_bytes(text)
            number = ("model", "view", "project").index(change.stage) + 1
            texts = [self.scene.decode(), *(self.right[f"stage{i}.txt"].decode() for i in (1, 2, 3))]
            text, words = change.make(texts, number, rng)
            pathlib.Path(top, f"stage{number}.txt").write_text(text)
            return judge(find_files(top), self.scene).of(change.stage)[0], words


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
    turn = seed % share if seed not in SAMPLES else 0
    for switch in (None, *HABITS, *MISTAKES):
        place = (MISTAKES if switch in MISTAKES else HABITS).index(switch) if switch else 0
        if switch == MISTAKES[0] and seed not in SAMPLES and seed // share % 2:
            scene.habits = ("zbuf/center",)
            right = scene.run()[0]
        if not switch or place % share == turn:
            try:
                files, verdict = scene.run(*([switch] if switch else []))
            except subprocess.CalledProcessError:  # a mistake that divides by 0 where this sample is exact
                if seed in SAMPLES:
                    continue
                raise
            for file in verdict.files:
                file.places = []  # thousands of pixels that nobody asks for
            runs.append(
                Run(seed, switch, verdict.files, verdict.status, stages_that_differ(files, right)))
    if seed in SAMPLES:
        return runs
    scene.habits = ()
    rng = random.Random(seed)
    for place, change in enumerate(changes.CHANGES):
        if place % share == turn:
            runs.append(ChangedRun(seed, change.name, *scene.changed(change, rng)))
    other = Scene(next_seed(seed)).right
    tried = [*(scene.damaged(rng, other) for _ in range(DAMAGES)), scene.without_a_triangle(rng)]
    return runs + [DamagedRun(seed, *one) for one in tried if one]


def next_seed(seed):
    """Of a scene without a vertex behind the eye."""
    try:
        Scene(seed + 1)
        return seed + 1
    except subprocess.CalledProcessError:
        return next_seed(seed + 1)


def described(run):
    return [(file.file, file.verdict, file.rule, [cause.name
                                                  for cause in file.causes], file.remarks)
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
            for runs in pool.map(runs_of, SAMPLES if share == 1 else ()):
                cls.runs += runs

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
        verdict = Scene(5003).run("all/exact-in-memory")[
            1]  # a triangle is seen so much from its edge that 7 decimals are too few
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
        print(f"{len(self.runs)} runs, {len(differing)} with a mistake that shows, {named} of those named, "
              f"{len(accepted)} taken for right", file=sys.stderr)
        for words in nameless:
            print("  not named:", words, file=sys.stderr)
        self.assertGreater(len(differing), scene_count)
        self.assertGreaterEqual(named, LEAST_NAMED * len(differing))

    def test_what_is_damaged_earns_nothing_and_what_is_whole_keeps_its_points(self):
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
