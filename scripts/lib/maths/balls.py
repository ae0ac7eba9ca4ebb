"""Numbers known exactly or to a number of bits, so that a sign is right or undecided."""
import functools
import math
from fractions import Fraction

from lib.maths import exact

GUARD_BITS = 64  # for sums of series: fewer than 2**32 terms, each wrong by few units


class Undecided(Exception):
    """A sign that the bits do not decide."""


class Ball:
    """A fraction, `exact`; or, if `exact` is None, a number at most `radius` from `middle`, both in units of
    2**exponent."""
    __slots__ = "exact", "middle", "radius", "exponent"
    bits = 4096  # of every middle

    def __init__(self, value):
        self.exact = Fraction(value)

    @staticmethod
    def around(middle, radius, exponent):
        """A Ball, rounded to `bits` bits."""
        self = Ball.__new__(Ball)
        spare = max(0, middle.bit_length() - Ball.bits, radius.bit_length() - Ball.bits)
        self.exact, self.exponent = None, exponent + spare
        self.middle, self.radius = middle >> spare, (radius >> spare) + 2 * (spare > 0)
        return self

    @staticmethod
    def between(low, high, exponent):
        return Ball.around(low + high, high - low, exponent - 1)

    def rounded(self):
        """The same Ball as a middle, a radius and an exponent."""
        if self.exact is None:
            return self
        top, bottom = self.exact.numerator, self.exact.denominator
        exponent = top.bit_length() - bottom.bit_length() - Ball.bits
        return Ball.around((top << max(0, -exponent)) // (bottom << max(0, exponent)), 1, exponent)

    @property
    def sign(self):
        middle = self.middle if self.exact is None else self.exact
        if self.exact is None and abs(middle) <= self.radius:
            raise Undecided
        return (middle > 0) - (middle < 0)

    def __add__(self, other):
        other = ball(other)
        if self.exact is not None and other.exact is not None:
            return Ball(self.exact + other.exact)
        if self.exact == 0 or other.exact == 0:
            return other if self.exact == 0 else self
        low, high = sorted((self.rounded(), other.rounded()), key=lambda x: x.exponent)
        shift = high.exponent - low.exponent
        return Ball.around((high.middle << shift) + low.middle, (high.radius << shift) + low.radius,
                           low.exponent)

    def __mul__(self, other):
        other = ball(other)
        if self.exact is not None and other.exact is not None:
            return Ball(self.exact * other.exact)
        if self.exact == 0 or other.exact == 0:
            return Ball(0)
        a, b = self.rounded(), other.rounded()
        radius = abs(a.middle) * b.radius + abs(b.middle) * a.radius + a.radius * b.radius
        return Ball.around(a.middle * b.middle, radius, a.exponent + b.exponent)

    def __truediv__(self, other):
        other = ball(other)
        if other.sign == 0:
            raise ZeroDivisionError
        if other.exact is not None:
            return self * (1 / other.exact)
        size, bits = abs(other.middle), Ball.bits + other.middle.bit_length()
        inverse = Ball.between((1 << bits) // (size + other.radius), (1 << bits) // (size - other.radius) + 1,
                               -bits - other.exponent)
        return self * inverse * other.sign

    def __neg__(self):
        return self * -1 if self.exact is not None else Ball.around(-self.middle, self.radius, self.exponent)

    def __sub__(self, other):
        return self + -other

    def __rsub__(self, other):
        return -self + other

    def __rtruediv__(self, other):
        return Ball(other) / self

    def __abs__(self):
        return -self if self.sign < 0 else self

    def __round__(self):
        return round(self.exact)

    def __eq__(self, other):
        return (self - other).sign == 0

    def __lt__(self, other):
        return (self - other).sign < 0

    def __gt__(self, other):
        return (self - other).sign > 0

    def __float__(self):
        """A double near it, or an infinity."""
        try:
            return float(self.exact if self.exact is not None else self.middle * Fraction(2)**self.exponent)
        except OverflowError:
            return math.inf

    __radd__, __rmul__ = __add__, __mul__


def ball(x):
    return x if isinstance(x, Ball) else Ball(x)


@functools.cache
def exactly(word):
    """The value of a word as the tools read it."""
    return Ball(exact.double(word))


@exact.trimmed.register
def _(x: Ball):
    """x, rounded if its fraction has grown very long."""
    length = x.exact and max(x.exact.numerator.bit_length(), x.exact.denominator.bit_length())
    return x.rounded() if length and length > 4 * Ball.bits else x


@exact.root.register
def _(x: Ball):
    if x.exact is not None and (found := exact.exact_root(x.exact)) is not None:
        return Ball(found)
    x = x.rounded()
    if x.middle <= x.radius:
        raise Undecided
    bits = Ball.bits + (Ball.bits + x.exponent) % 2
    return Ball.between(math.isqrt((x.middle - x.radius) << bits),
                        math.isqrt((x.middle + x.radius) << bits) + 1, (x.exponent - bits) // 2)


@exact.sine_cosine_below_45.register
def _(degrees: Ball):
    """The sine and cosine of exact degrees, by the series of exp(i x), in whole units."""
    if not degrees.exact:
        return Ball(0), Ball(1)
    small = max(0, degrees.exact.denominator.bit_length() - degrees.exact.numerator.bit_length())
    bits = Ball.bits + GUARD_BITS + small
    x = round(degrees.exact * pi(bits) / 180)
    sums, term, k = [0] * 4, 1 << bits, 0  # of the terms in 1, i, -1, -i
    while term:
        sums[k % 4] += term
        k += 1
        term = math.trunc(Fraction(term * x, k << bits))
    return tuple(
        Ball.around(total, 1 << GUARD_BITS, -bits) for total in (sums[1] - sums[3], sums[0] - sums[2]))


@functools.lru_cache(16)
def pi(bits):
    """In units of 2**-bits: 16 arctan(1/5) - 4 arctan(1/239) (Machin, 1706)."""
    def arctan_of_inverse(n):
        total, power, k = 0, (1 << bits) // n, 1
        while power:
            total += power // k if k % 4 == 1 else -(power // k)
            power //= n * n
            k += 2
        return total

    return 16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239)
