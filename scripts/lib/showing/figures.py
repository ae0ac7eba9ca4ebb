"""Measured figures: their quartiles, and their digits."""
import dataclasses
import statistics


@dataclasses.dataclass(frozen=True)
class Quartiles:
    first: float
    median: float
    third: float

    @property
    def spread(self):
        return self.third - self.first


def quartiles(values):
    """The Quartiles of one value or more."""
    return Quartiles(
        *statistics.quantiles(values, n=4, method="inclusive")) if len(values) > 1 else Quartiles(*3 * values)


def number(value, digits=2):
    """A few digits, with a power of ten only if that is shorter."""
    if value == 0:
        return "0"
    if 1e-3 <= abs(value) < 1e5:
        decimals = max(0, digits - 1 - int(f"{value:e}".split("e")[1]))
        return f"{value:.{decimals}f}"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"
