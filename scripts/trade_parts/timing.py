"""The CPU time of the pipe with each setting."""
import math
import random
import statistics
import time

from lib.running.pipe import DEFAULT
from lib.showing.figures import quartiles

SECONDS = 30  # for all rounds together, if their number is not given
LEAST_ROUNDS, MOST_ROUNDS = 8, 25
ROUNDS_OF_DEAR = 3  # settings that cost several times the default
EMPTY, AGAIN = "empty", "again"  # the scene without triangles; the default once more, which shows the noise
CHEAPER, TIE, DEARER, UNTOLD = "cheaper", "tie", "dearer", "untold"
NOTICED = 0.9  # who saves less than a tenth of the CPU time saves nothing
CHANCE = 0.01  # that a median lies outside its interval


def median_interval(values):
    """Where the median lies of what these are a sample of: in 99 of 100 samples between two of their order
    statistics (W. R. Thompson, 1936). Anywhere, if they are too few."""
    values, count = sorted(values), len(values)
    outside, rank = 0.0, -1
    while rank + 1 < count / 2 and outside + 2 * math.comb(count, rank + 1) / 2**count <= CHANCE:
        rank += 1
        outside += 2 * math.comb(count, rank) / 2**count
    return (values[rank], values[-1 - rank]) if rank >= 0 else (0.0, math.inf)


class Times:
    """Of each setting and of the empty scene, round by round."""
    def __init__(self, runs):
        self.runs, self.rounds = runs, len(runs[DEFAULT])
        self.start_up = statistics.median(runs[EMPTY])
        self.seconds = {
            setting: quartiles(values)
            for setting, values in runs.items() if setting not in (EMPTY, AGAIN)}
        self.seconds_of_default = self.seconds[DEFAULT].median
        low, high = median_interval(self.ratios(AGAIN, DEFAULT))
        self.noise = max(high, 1 / low if low else math.inf)  # at least 1

    @property
    def are_too_short(self):
        return self.seconds_of_default - self.start_up <= self.start_up / 4

    def ratios(self, setting, other):
        """Round by round, since other load on the machine slows all runs of a round; as many as both have."""
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
        """The CPU time of a setting relative to another, by the rounds: the interval of their
        ratio, widened by as much as the default differs from itself, lies on one side of what is noticed."""
        low, high = median_interval(self.ratios(setting, other))
        low, high = low / self.noise, high * self.noise
        if high < NOTICED:
            return CHEAPER
        return UNTOLD if low < NOTICED else TIE if low <= 1 else DEARER


def measured(pipe, settings, rounds, progress):
    """The Times of all settings. A round runs each once, in a new order, so that other load on the machine
    affects all alike."""
    dice, empty = random.Random(1), pipe.empty_scene()
    turns = [(EMPTY, DEFAULT, empty), (AGAIN, DEFAULT, None),
             *((setting, setting, None) for setting in dict.fromkeys([DEFAULT, *settings]))]
    runs = {name: [] for name, _, _ in turns}
    cheap = [turn for turn in turns if turn[0] in (EMPTY, AGAIN) or not turn[0].is_dear]
    begin = time.monotonic()
    for _, *turn in cheap:  # to warm the caches, and to see how long a round takes
        pipe.cpu_seconds(*turn)
    rounds = rounds or max(LEAST_ROUNDS, min(round(SECONDS / (time.monotonic() - begin)), MOST_ROUNDS))
    for i in range(rounds):
        progress(f"round {i + 1} of {rounds}")
        now = turns if i < ROUNDS_OF_DEAR else cheap
        for name, *turn in dice.sample(now, len(now)):
            runs[name].append(pipe.cpu_seconds(*turn))
    return Times(runs)
