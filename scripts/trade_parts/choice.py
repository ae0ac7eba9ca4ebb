"""The cheapest setting that meets the request, as far as the times decide it."""
import dataclasses

from trade_parts.timing import CHEAPER, TIE, UNTOLD


@dataclasses.dataclass(frozen=True)
class Row:
    """A setting with its cost and its losses. Rows are in the order of their settings, simpler ones first."""
    setting: object
    seconds: object  # Quartiles
    ratio: float  # of the CPU time to the default's
    net: float  # the same, both without the start of four programs
    size: int  # bytes in the three pipes
    loss: object  # losses.Loss
    covered: int  # pixels of the exact picture

    @property
    def percent_wrong(self):
        return 100 * self.loss.wrong / self.covered


@dataclasses.dataclass(frozen=True)
class Limits:
    """The user's limits; None is no limit."""
    percent_wrong: float = None
    ratio: float = None

    def over(self, row):
        """The factor by which a row exceeds the limits; at most 1 meets them. An added pixel keeps it finite
        for a limit of 0."""
        most, pixel = self.percent_wrong, 100 / row.covered
        over_wrong = 0 if most is None else (row.percent_wrong + pixel) / (most + pixel)
        return max(over_wrong, 0 if self.ratio is None else row.ratio / self.ratio)

    def are_met_by(self, row):
        return self.over(row) <= 1


@dataclasses.dataclass(frozen=True)
class Choice:
    row: object
    ties: tuple = ()  # rows that cost the same, as far as anybody notices
    untold: tuple = ()  # rows that may be cheaper: the times do not decide
    lucky: tuple = ()  # rows with too many wrong pixels when the eye is moved, and their number


def least_wrong(rows, limits):
    """The limits; for wrong pixels, if not limited, the fewest that the others allow."""
    within = [row.percent_wrong for row in rows if limits.are_met_by(row)]
    return dataclasses.replace(
        limits, percent_wrong=min(within)) if within and limits.percent_wrong is None else limits


def cheapest(rows, verdict):
    """The Choice among `rows`. `verdict(a, b)` compares the CPU times of the settings a and b. A setting
    gives way only to one that is cheaper beyond the noise. If another may still be cheaper, so that another
    run could name it, the simplest row, with the fewest options to type, is chosen, and `untold` has the
    others."""
    rows = sorted(rows, key=lambda row: len(row.setting.words()))  # equal ones keep their order
    best, untold = rows[0], []
    for row in rows[1:]:
        told = verdict(row.setting, best.setting)
        if told == CHEAPER:
            best = row
        elif told == UNTOLD:
            untold.append(row)
    untold = [row for row in untold if row is not best and verdict(best.setting, row.setting) != CHEAPER]
    if untold:
        return Choice(rows[0], untold=tuple(row for row in rows[1:] if row in untold or row is best))
    others = (row for row in rows if row is not best)
    return Choice(best, ties=tuple(row for row in others if verdict(row.setting, best.setting) == TIE))


def steady(rows, verdict, limits, wrong_if_moved):
    """The Choice among `rows` with few enough wrong pixels also when the eye is moved; else None."""
    rows, lucky = list(rows), []
    while rows:
        choice = cheapest(rows, verdict)
        wrong = wrong_if_moved(choice.row.setting)
        if limits.percent_wrong is None or 100 * wrong / choice.row.covered <= limits.percent_wrong:
            return dataclasses.replace(choice, lucky=tuple(lucky))
        lucky.append((choice.row, wrong))
        rows.remove(choice.row)
    return None
