"""The CPU time of the pipe with each setting."""
import math
import random
import shutil
import statistics
import time

from lib.running.pipe import DEFAULT
from lib.showing.figures import quartiles

SECONDS = 30  # for all rounds together, if their number is not given
LEAST_ROUNDS, MOST_ROUNDS = 8, 25
ROUNDS_OF_DEAR = 3  # settings that cost several times the default
EMPTY, AGAIN = "empty", "again"  # the scene without triangles; the default once more, which shows the noise
CHEAPER, TIE, DEARER, UNTOLD = "cheaper", "tie", "dearer", "untold"
CPU_TIME = "CPU time"
NOTICED = 0.9  # a ratio above it, less than a tenth saved, counts as no saving
CHANCE = 0.01  # that a median lies outside its interval


def median_interval(values):
    """A 99 % confidence interval of the median, between two order statistics of the sample (W. R. Thompson,
    1936); unbounded if the sample is too small."""
    values, count = sorted(values), len(values)
    outside, rank = 0.0, -1
    while rank + 1 < count / 2 and outside + 2 * math.comb(count, rank + 1) / 2**count <= CHANCE:
        rank += 1
        outside += 2 * math.comb(count, rank) / 2**count
    return (values[rank], values[-1 - rank]) if rank >= 0 else (0.0, math.inf)


class Times:
    """Times of each setting and of the empty scene, round by round."""
    unit = CPU_TIME

    def __init__(self, runs):
        self.runs, self.rounds = runs, len(runs[DEFAULT])
        self.start_up = statistics.median(runs[EMPTY])
        self.seconds = {
            setting: quartiles(values)
            for setting, values in runs.items() if setting not in (EMPTY, AGAIN)}
        self.seconds_of_default = self.seconds[DEFAULT].median

    @property
    def are_too_short(self):
        return self.seconds_of_default - self.start_up <= self.start_up / 4

    @property
    def are_too_few(self):
        return median_interval(self.runs[DEFAULT])[1] == math.inf

    def ratios(self, setting, other):
        """The ratios in rounds that both have: other load on the machine slows all runs of a round."""
        return [a / b for a, b in zip(self.runs[setting], self.runs[other])]

    def ratio(self, setting):
        return statistics.median(self.ratios(setting, DEFAULT))

    def net(self, setting):
        """The ratio without the start of four programs; NaN if the default hardly takes longer."""
        if self.are_too_short:
            return math.nan
        return max(0.0,
                   self.seconds[setting].median - self.start_up) / (self.seconds_of_default - self.start_up)

    def verdict(self, setting, other):
        """A verdict on the CPU time of a setting and another, paired by rounds: CHEAPER if a sign test finds
        their ratio below 1, and its median is below NOTICED."""
        ratios = self.ratios(setting, other)
        low, high = median_interval(ratios)
        median = statistics.median(ratios)
        if high < 1 and median < NOTICED:
            return CHEAPER
        return UNTOLD if low < NOTICED and median < 1 else TIE if low <= 1 else DEARER


class Counts(Times):
    """Instructions or bytes of each setting and of the empty scene, in place of times: alike in every run."""
    def __init__(self, counts, unit):
        super().__init__({setting: [count] for setting, count in counts.items()})
        self.unit = unit

    are_too_short = are_too_few = False

    def verdict(self, setting, other):
        ratio = self.ratios(setting, other)[0]
        return CHEAPER if ratio < NOTICED else TIE if ratio <= 1 else DEARER


def counted(pipe, turns, progress):
    """The Counts of instructions or, without valgrind, of the three texts' bytes."""
    turns, counts = [turn for turn in turns if not turn[1].is_traced], {}
    if shutil.which("valgrind") is None:
        sizes = {name: pipe.text(setting)[1] if name != EMPTY else 0 for name, setting, _ in turns}
        return Counts(sizes, "bytes")
    for name, setting, scene in turns:
        progress(f"the instructions of {setting}")
        counts[name] = pipe.instructions(setting, scene)
    return Counts(counts, "instructions")


def measured(pipe, settings, rounds, progress):
    """The Times of all settings, or their Counts if runs are too short to time. A round runs each setting
    once, expensive ones only in the first ROUNDS_OF_DEAR, in a new order: other load affects all alike."""
    dice, empty = random.Random(1), pipe.empty_scene()
    turns = [(EMPTY, DEFAULT, empty), (AGAIN, DEFAULT, None),
             *((setting, setting, None) for setting in dict.fromkeys([DEFAULT, *settings]))]
    runs = {name: [] for name, _, _ in turns}
    cheap = [turn for turn in turns if turn[0] in (EMPTY, AGAIN) or not turn[0].is_dear]
    begin = time.monotonic()
    first = {name: [pipe.cpu_seconds(*turn)] for name, *turn in cheap}  # warms the caches, and shows how long
    most = 2 if shutil.which("valgrind") else 1.25
    if not rounds and min(first[DEFAULT], first[AGAIN]) <= [most * seconds for seconds in first[EMPTY]]:
        return counted(pipe, [turn for turn in turns if turn[0] != AGAIN], progress)
    rounds = rounds or max(LEAST_ROUNDS, min(round(SECONDS / (time.monotonic() - begin)), MOST_ROUNDS))
    for i in range(rounds):
        progress(f"round {i + 1} of {rounds}")
        now = turns if i < ROUNDS_OF_DEAR else cheap
        for name, *turn in dice.sample(now, len(now)):
            runs[name].append(pipe.cpu_seconds(*turn))
    return Times(runs)
