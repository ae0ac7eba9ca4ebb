"""The cheapest setting that meets what was asked."""
import dataclasses

from trade_parts.pipe import DEFAULT

ALIKE = 1.03  # nobody notices 3 % of CPU time


@dataclasses.dataclass(frozen=True)
class Row:
    """What a setting takes and loses."""
    setting: object
    seconds: object      # Quartiles
    ratio: object        # Quartiles of the CPU time over the default's
    size: int            # bytes in the three pipes
    wrong: int           # pixels
    neighbors: int
    covered: int         # pixels of the lossless run
    vertex_error: float  # in pixels
    digits_lost: int

    @property
    def percent_wrong(self):
        return 100 * self.wrong / self.covered


@dataclasses.dataclass(frozen=True)
class Limits:
    """What was asked; None is: no matter."""
    percent_wrong: float = None
    ratio: float = None

    def over(self, row):
        """How many times too much a row takes or loses; at most 1 meets the limits. A pixel more keeps this
        finite for a limit of 0."""
        pixel = 100 / row.covered
        over_wrong = 0 if self.percent_wrong is None else (row.percent_wrong + pixel) / (self.percent_wrong +
                                                                                         pixel)
        return max(over_wrong, 0 if self.ratio is None else row.ratio.median / self.ratio)

    def are_met_by(self, row):
        return self.over(row) <= 1


def least_wrong(rows, limits):
    """The limits with the fewest wrong pixels to be had, if none were asked for."""
    within = [row.percent_wrong for row in rows if limits.are_met_by(row)]
    return dataclasses.replace(
        limits, percent_wrong=min(within)) if within and limits.percent_wrong is None else limits


def cheapest(rows, are_times_too_short):
    """The row with the least CPU time, and those that take as long by the quartiles, within 3 %: of these it
    has the fewest bytes; then it is the most exact, and the nearest to the default."""
    least = min(rows, key=lambda row: row.ratio.median)
    alike = [row for row in rows if are_times_too_short or row.ratio.first <= ALIKE * least.ratio.third]
    return min(
        alike, key=lambda row:
        (row.size, row.wrong, row.vertex_error, row.setting != DEFAULT, len(str(row.setting)))), alike


def nearest(rows, limits):
    """The row that misses the limits least."""
    return min(rows, key=limits.over)
