"""The CPU time of the pipe with each setting."""
import random
import statistics
import time

from lib.figures import quartiles
from trade_parts.pipe import DEFAULT

SECONDS = 30  # for all rounds together, if their number is not given
LEAST_ROUNDS, MOST_ROUNDS = 3, 25
EMPTY = "empty"


class Times:
    """Of each setting and of the empty scene, round by round."""

    def __init__(self, runs):
        self.rounds = len(runs[DEFAULT])
        self.start_up = statistics.median(runs[EMPTY])
        self.seconds = {setting: quartiles(values) for setting, values in runs.items() if setting != EMPTY}
        self.seconds_of_default = self.seconds[DEFAULT].median
        # Round by round, since other load on the machine slows all runs of a round.
        self.ratios = {
            setting: quartiles([a / b for a, b in zip(runs[setting], runs[DEFAULT])])
            for setting in self.seconds}
        noise = max(quartiles(runs[EMPTY]).spread, self.seconds[DEFAULT].spread, self.start_up / 4)
        self.are_too_short = self.seconds_of_default - self.start_up <= noise


def measured(pipe, settings, rounds, progress):
    """The Times of all settings. A round runs each once, in a new order, so that other load on the machine
    affects all alike."""
    dice, empty = random.Random(1), pipe.empty_scene()
    turns = [(DEFAULT, empty), *((setting, None) for setting in dict.fromkeys([DEFAULT, *settings]))]
    runs = {EMPTY if scene else setting: [] for setting, scene in turns}
    begin = time.monotonic()
    for turn in turns:  # to warm the caches, and to see how long a round takes
        pipe.cpu_seconds(*turn)
    rounds = rounds or max(LEAST_ROUNDS, min(round(SECONDS / (time.monotonic() - begin)), MOST_ROUNDS))
    for i in range(rounds):
        progress(f"round {i + 1} of {rounds}")
        for setting, scene in dice.sample(turns, len(turns)):
            runs[EMPTY if scene else setting].append(pipe.cpu_seconds(setting, scene))
    return Times(runs)
