"""Numbers as exact fractions. Only sines, cosines and square roots are not fractions: they are calculated to
DIGITS digits."""
import decimal
import functools
import math
from decimal import Decimal
from fractions import Fraction

DIGITS = 120
CONTEXT = decimal.Context(prec=DIGITS, Emin=decimal.MIN_EMIN, Emax=decimal.MAX_EMAX)
SHORT = decimal.Context(prec=7, Emin=decimal.MIN_EMIN, Emax=decimal.MAX_EMAX)
MAX_DENOMINATOR_BITS = 4096
DECIMALS_IN_TEXT = 7  # the most at which zbuf's exact rule takes a number as the decimal in the text
MAX_EXACT_DECIMAL = Decimal("1e22")


def double(word):
    """The value of a word as the tools read it: its nearest double."""
    return Fraction(float(word))


def decimal_or_double(word):
    """The value of a word where coverage is exact: the decimal itself if it has at most 7 decimals, else its
    nearest double."""
    is_plain = "e" not in word.lower() and len(word.partition(".")[2]) <= DECIMALS_IN_TEXT
    return Fraction(word) if is_plain and abs(Decimal(word)) < MAX_EXACT_DECIMAL else double(word)


def as_decimal(x, context=CONTEXT):
    return context.divide(Decimal(x.numerator), Decimal(x.denominator))


@functools.singledispatch  # lib.maths.balls registers variants
def trimmed(x):
    """x, to DIGITS digits if its denominator has grown very long."""
    return x if x.denominator.bit_length() <= MAX_DENOMINATOR_BITS else Fraction(as_decimal(x))


def exact_root(x):
    """The square root if it is a fraction, else None."""
    numerator, denominator = math.isqrt(max(0, x.numerator)), math.isqrt(x.denominator)
    is_exact = numerator**2 == x.numerator and denominator**2 == x.denominator
    return Fraction(numerator, denominator) if is_exact else None


@functools.singledispatch
def root(x):
    """The square root, exact where it is a fraction."""
    found = exact_root(x)
    return Fraction(CONTEXT.sqrt(as_decimal(x))) if found is None else found


def pi():
    """16 arctan(1/5) - 4 arctan(1/239) (Machin, 1706)."""
    def arctan_of_inverse(n):
        return sum(Fraction((-1)**k, (2 * k + 1) * n**(2 * k + 1)) for k in range(DIGITS))

    return trimmed(16 * arctan_of_inverse(5) - 4 * arctan_of_inverse(239))


PI = pi()


@functools.singledispatch
def sine_cosine_below_45(degrees):
    """Sine and cosine of an angle from -45 to 45 degrees, by the series of exp(i x)."""
    with decimal.localcontext(CONTEXT):
        x = as_decimal(degrees * PI / 180)
        sums, term, k = [Decimal(0)] * 4, Decimal(1), 0  # of the terms in 1, i, -1, -i
        while term and (k < 4 or term.adjusted() > x.adjusted() - DIGITS - 5):
            sums[k % 4] += term
            k += 1
            term *= x / k
        return Fraction(sums[1] - sums[3]), Fraction(sums[0] - sums[2])


def sine_cosine(degrees):
    """Sine and cosine, exact for multiples of 90 degrees; the sine of 30 degrees is exactly 1/2, and those of
    45 degrees are equal."""
    quarters = round(degrees / 90)
    rest = degrees - 90 * quarters
    if abs(rest) == 45:
        cosine = root(abs(rest) / 90)
        sine = cosine if rest > 0 else -cosine
    elif abs(rest) == 30:
        sine, cosine = rest / 60, root(abs(rest) / 40)
    else:
        sine, cosine = sine_cosine_below_45(rest)
    return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[quarters % 4]


def cotangent(degrees):
    sine, cosine = sine_cosine(degrees)
    return Fraction(1) if cosine is sine else cosine / sine


def fixed(x, decimals):
    """x with a number of decimals, rounded to nearest, ties to even, no sign on zero. A number that DIGITS
    digits cannot tell from a tie counts as one."""
    x = Fraction(round(x * 10**60), 10**60)
    units = round(x * 10**decimals)
    digits = str(abs(units)).rjust(decimals + 1, "0")
    whole, fraction = digits[:len(digits) - decimals], digits[len(digits) - decimals:]
    return ("-" if units < 0 else "") + whole + ("." + fraction if decimals else "")


def coordinate(x, digits):
    """x as the tools print it, `digits` being the word of --digits."""
    if digits != "exact":
        return fixed(x, int(digits))
    return repr(float(x)).removesuffix(".0")


def short(x):
    """x with up to 7 digits, for reading."""
    if x == 0:
        return "0"
    rounded = SHORT.normalize(as_decimal(Fraction(x), SHORT))
    return f"{rounded:f}" if -5 <= rounded.adjusted() <= 9 else f"{rounded:e}"


def measured(x, decimals=4):
    """x with some decimals; in scientific notation if it is huge, or so small that it would read as 0."""
    if abs(x) >= 10**15:
        return f"{as_decimal(x):.6e}"
    text = fixed(x, decimals)
    return f"{as_decimal(x):.1e}" if x != 0 and not text.strip("-0.") else text
