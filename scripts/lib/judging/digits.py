"""How finely a text shows its numbers: a tolerance can only come from the digits that are there."""
import dataclasses
import math
from decimal import Decimal

from lib.judging.pixel_words import counted

LEAST_DIGITS = 3
FINEST = 17  # significant digits, of a double


@dataclasses.dataclass(frozen=True)
class Digits:
    """`decimals` is None if not every number has the same; `significant` is the most digits of a number."""
    decimals: int
    significant: int
    largest: float = 1.0

    def unit(self, x):
        """The value of one unit in the last digit of x."""
        if self.decimals is not None:
            return 10.0**-self.decimals
        return 10.0**(exponent_of(x) - self.significant + 1) if x else 0.0

    @property
    def are_too_few(self):
        """True if the largest number shows fewer significant digits than LEAST_DIGITS."""
        count = self.significant if self.decimals is None else (exponent_of(self.largest) +
                                                                bool(self.largest) + self.decimals)
        return count < LEAST_DIGITS

    def __str__(self):
        if self.decimals is None:
            return counted(self.significant, "significant digit")
        return counted(self.decimals, "decimal")


EXACT = Digits(None, FINEST)


def exponent_of(x):
    return math.floor(math.log10(abs(x))) if x else 0


def digits_of(words):
    """The Digits of the words of a text's numbers."""
    largest = max((abs(float(word)) for word in words), default=0.0)
    numbers = [(word, Decimal(word).as_tuple()) for word in words]
    decimals = {None if "e" in word.lower() else -number.exponent for word, number in numbers}
    fixed = min(decimals.pop() or 0, FINEST) if len(decimals) == 1 else 0
    significant = exponent_of(largest) + 1 + fixed if fixed else max(
        (len(number.digits) for _, number in numbers), default=0)
    return Digits(fixed or None, max(1, min(significant, FINEST)), largest)


def share_digits(texts):
    """Corrects the Digits of texts that one program printed: numbers such as 0.5 show as many digits as they
    have, in a text whose program does not print trailing zeros."""
    most = max((text.digits.significant for text in texts if text.digits.decimals is None), default=0)
    for text in texts:
        if text.digits.decimals is None or text.digits.significant < most:
            text.digits = Digits(None, most, text.digits.largest)
