// Numbers as exact fractions, and as doubles with the same operations.

const greatest = (a, b) => { while (b) [a, b] = [b, a % b]; return a; };
const size = n => n < 0n ? -n : n;

// The whole part of a square root, by Newton's method.
function wholeRoot(n) {
  if (n < 2n) return n;
  let x = 1n << BigInt(n.toString(2).length + 1 >> 1);
  for (;;) {
    const y = (x + n / x) >> 1n;
    if (y >= x) return x;
    x = y;
  }
}

export class Fraction {
  constructor(n, d = 1n) {
    const common = (d < 0n ? -1n : 1n) * (greatest(size(n), size(d)) || 1n);
    this.n = n / common;
    this.d = d / common;
  }

  static of(whole) { return new Fraction(BigInt(whole)); }

  // A double's value.
  static ofDouble(x) {
    let exponent = 0n;
    for (; !Number.isInteger(x); ++exponent) x *= 2;
    return new Fraction(BigInt(x), 1n << exponent);
  }

  // A word's value where coverage is exact: the decimal itself if it has at most 7 decimals, else its nearest double.
  static ofWord(word) {
    const [whole, decimals = ""] = word.split(".");
    if (/e/i.test(word) || decimals.length > 7 || Math.abs(Number(word)) >= 1e22) return Fraction.ofDouble(Number(word));
    return new Fraction(BigInt(whole.replace("-", "") + decimals) * (word.startsWith("-") ? -1n : 1n), 10n ** BigInt(decimals.length));
  }

  plus(other) { return new Fraction(this.n * other.d + other.n * this.d, this.d * other.d); }
  minus(other) { return new Fraction(this.n * other.d - other.n * this.d, this.d * other.d); }
  times(other) { return new Fraction(this.n * other.n, this.d * other.d); }
  over(other) { return new Fraction(this.n * other.d, this.d * other.n); }
  compare(other) { const difference = this.n * other.d - other.n * this.d; return difference > 0n ? 1 : difference < 0n ? -1 : 0; }
  get sign() { return this.n > 0n ? 1 : this.n < 0n ? -1 : 0; }
  get absolute() { return new Fraction(size(this.n), this.d); }
  floor() { return Number((this.n - ((this.n % this.d) + this.d) % this.d) / this.d); }

  // The square root, exact if it is a fraction, else a double.
  root() {
    const [n, d] = [wholeRoot(this.n), wholeRoot(this.d)];
    return n * n === this.n && d * d === this.d ? new Fraction(n, d) : Fraction.ofDouble(Math.sqrt(this.number));
  }

  // A double very near the value.
  get number() {
    const shift = BigInt(Math.max(0, size(this.d).toString(2).length - size(this.n).toString(2).length + 64));
    return Number((this.n << shift) / this.d) / 2 ** Number(shift);
  }

  // With a number of decimals, rounded to nearest, ties to even, no sign on zero.
  fixed(decimals) {
    const scaled = size(this.n) * 10n ** BigInt(decimals), rest = 2n * (scaled % this.d);
    let units = scaled / this.d;
    if (rest > this.d || (rest === this.d && units % 2n === 1n)) ++units;
    const digits = String(units).padStart(decimals + 1, "0"), at = digits.length - decimals;
    return (this.n < 0n && units ? "-" : "") + digits.slice(0, at) + (decimals ? "." + digits.slice(at) : "");
  }

  // With some decimals; in scientific notation if it is huge, or so small that it would read as 0.
  measured(decimals = 4) {
    if (size(this.n) >= this.d * 10n ** 15n) return this.number.toExponential(6);
    const text = this.fixed(decimals);
    return this.n && !/[1-9]/.test(text) ? this.number.toExponential(1) : text;
  }

  // With up to 7 digits, for reading.
  short() {
    const rounded = Number(this.number.toPrecision(7)), exponent = rounded ? Math.floor(Math.log10(Math.abs(rounded))) : 0;
    return exponent >= -5 && exponent <= 9 ? String(rounded) : rounded.toExponential();
  }
}

export class Double {
  constructor(number) { this.number = number; }

  static of(whole) { return new Double(whole); }

  plus(other) { return new Double(this.number + other.number); }
  minus(other) { return new Double(this.number - other.number); }
  times(other) { return new Double(this.number * other.number); }
  over(other) { return new Double(this.number / other.number); }
  compare(other) { return Math.sign(this.number - other.number); }
  floor() { return Math.floor(this.number); }
}
