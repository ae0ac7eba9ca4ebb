"""How finely a text shows its numbers: a tolerance can only come from the digits that are there."""
import dataclasses
import math
import re

LEAST_DIGITS = 3
MANTISSA = re.compile(r"[-+]?([0-9]*)\.?([0-9]*)")
FINEST = 17  # significant digits, of a double


@dataclasses.dataclass(frozen=True)
class Digits:
    """`decimals` is their count if every number of the text has the same, else None; `significant` the most
    digits of a number."""
    decimals: int
    significant: int
    largest: float = 1.0

    def unit(self, x):
        """The value of one unit in the last digit of x."""
        if self.decimals is not None:
            return 10.0**-self.decimals
        return 10.0**(exponent_of(x) - self.significant + 1) if x else 0.0

    @property
    def count(self):
        """The significant digits of the largest number."""
        if self.decimals is not None:
            return max(0, exponent_of(self.largest) + 1 + self.decimals) if self.largest else self.decimals
        return self.significant

    @property
    def are_too_few(self):
        return self.count < LEAST_DIGITS

    def __str__(self):
        count, what = (self.significant, "significant digit") if self.decimals is None else (self.decimals,
                                                                                             "decimal")
        return f"{count} {what}{'' if count == 1 else 's'}"


EXACT = Digits(None, FINEST)


def exponent_of(x):
    return math.floor(math.log10(abs(x))) if x else 0


def digits_of(words):
    """The Digits of the words of a text's numbers."""
    largest = max((abs(float(word)) for word in words), default=0.0)
    decimals = {decimals_of(word) for word in words}
    if len(decimals) == 1 and (fixed := decimals.pop()):
        fixed = min(fixed, FINEST)
        return Digits(fixed, max(1, min(exponent_of(largest) + 1 + fixed, FINEST)), largest)
    significant = max((len("".join(MANTISSA.match(word).groups()).lstrip("0")) for word in words), default=0)
    return Digits(None, max(1, min(significant, FINEST)), largest)


def decimals_of(word):
    """How many decimals a number shows; None if it has none, or an exponent."""
    point = word.find(".")
    return None if point < 0 or "e" in word or "E" in word else len(word) - point - 1


def of_one_program(texts):
    """The same Digits, given that one program printed all texts: numbers such as 0.5 show as many digits as
    they have, in a text whose program does not print trailing zeros."""
    loose = [digits.significant for digits in texts if digits.decimals is None]
    if not loose:
        return texts
    most = max(loose)
    return [
        Digits(None, most, digits.largest) if digits.decimals is None or digits.significant < most else digits
        for digits in texts]
