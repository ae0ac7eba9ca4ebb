#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace pipeline {

// 128-bit integers, which GCC and Clang have on every 64-bit system under a name that is not standard C++.
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

/// The count of bits without leading zeros; 0 for 0.
inline int bit_length(UInt128 value) {
  const auto high = static_cast<std::uint64_t>(value >> 64);
  const auto low = static_cast<std::uint64_t>(value);
  return (high != 0 ? 128 : 64) - std::countl_zero(high != 0 ? high : low);
}

/// An inverse as factor * 2^exponent; the factor is truncated to 128 bits, the highest of which is 1.
struct BinaryInverse {
  UInt128 factor = 0;
  int exponent = 1;
};

/// 1 / divisor, by long division of a power of two, bit by bit; `divisor` is from 1 to 2^127.
constexpr BinaryInverse binary_inverse(UInt128 divisor) {
  BinaryInverse inverse;
  for (UInt128 rest = 1; (inverse.factor >> 127) == 0; rest <<= 1, --inverse.exponent) {
    const bool bit = rest >= divisor;
    if (bit) rest -= divisor;
    inverse.factor = inverse.factor << 1 | (bit ? 1 : 0);
  }
  return inverse;
}

/// 2^exponent, for a normal double.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// The value as a double, with a relative error of at most 2^-53 + 2^-61: bits below the first 62 are cut
/// off. (The compiler's own conversion is a function call.)
inline double to_double(Int128 value) {
  const auto size = static_cast<UInt128>(value < 0 ? ~value : value);
  const int cut_off = std::max(bit_length(size) - 62, 0);
  return static_cast<double>(static_cast<std::int64_t>(value >> cut_off)) * power_of_two(cut_off);
}

/// An integer of 64 * `Limbs` bits in two's complement. Like the built-in types it does not detect overflow:
/// the caller chooses enough limbs. Loops have a fixed length and no branches, so a few limbs cost a few
/// instructions.
template <std::size_t Limbs>
class FixedInt {
 public:
  FixedInt() = default;
  FixedInt(Int128 value) {  // NOLINT(google-explicit-constructor): every value fits
    limbs_.fill(value < 0 ? ~std::uint64_t{0} : 0);
    limbs_[0] = static_cast<std::uint64_t>(value);
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): the type has 128 bits
    limbs_[1] = static_cast<std::uint64_t>(value >> 64);
  }
  /// The number of `other` in this count of limbs, if it fits.
  template <std::size_t OtherLimbs>
  explicit FixedInt(const FixedInt<OtherLimbs>& other) {
    for (std::size_t i = 0; i < Limbs; ++i) limbs_[i] = other.limb(i);
  }

  [[nodiscard]] bool is_negative() const { return (limbs_[Limbs - 1] >> 63) != 0; }
  /// The 64 bits of a limb; beyond the last one, copies of the sign bit.
  [[nodiscard]] std::uint64_t limb(std::size_t index) const {
    return index < Limbs ? limbs_[index] : is_negative() ? ~std::uint64_t{0} : 0;
  }

  friend FixedInt operator+(const FixedInt& a, const FixedInt& b) {
    FixedInt sum;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      const UInt128 total = UInt128{a.limbs_[i]} + b.limbs_[i] + carry;
      sum.limbs_[i] = static_cast<std::uint64_t>(total);
      carry = static_cast<std::uint64_t>(total >> 64);
    }
    return sum;
  }
  friend FixedInt operator-(const FixedInt& a, const FixedInt& b) {
    FixedInt difference;
    std::uint64_t borrow = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      const UInt128 total = UInt128{a.limbs_[i]} - b.limbs_[i] - borrow;
      difference.limbs_[i] = static_cast<std::uint64_t>(total);
      borrow = static_cast<std::uint64_t>(total >> 64) & 1u;
    }
    return difference;
  }
  friend FixedInt operator-(const FixedInt& a) { return FixedInt(0) - a; }
  friend FixedInt operator*(const FixedInt& a, const FixedInt& b) {
    FixedInt product(0);
    for (std::size_t i = 0; i < Limbs; ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; i + j < Limbs; ++j) {
        const UInt128 total = UInt128{a.limbs_[i]} * b.limbs_[j] + product.limbs_[i + j] + carry;
        product.limbs_[i + j] = static_cast<std::uint64_t>(total);
        carry = static_cast<std::uint64_t>(total >> 64);
      }
    }
    return product;
  }
  friend FixedInt operator*(int a, const FixedInt& b) {
    FixedInt product;
    const auto factor = static_cast<std::uint64_t>(a < 0 ? -std::int64_t{a} : a);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < Limbs; ++i) {
      const UInt128 total = UInt128{factor} * b.limbs_[i] + carry;
      product.limbs_[i] = static_cast<std::uint64_t>(total);
      carry = static_cast<std::uint64_t>(total >> 64);
    }
    return a < 0 ? -product : product;
  }
  /// a * 2^bits.
  friend FixedInt operator<<(const FixedInt& a, int bits) {
    FixedInt shifted(0);
    const auto whole = static_cast<std::size_t>(bits / 64);
    const int rest = bits % 64;
    for (std::size_t i = whole; i < Limbs; ++i) {
      const std::uint64_t below = i > whole ? a.limbs_[i - whole - 1] : 0;
      shifted.limbs_[i] = (a.limbs_[i - whole] << rest) | (below >> 1 >> (63 - rest));
    }
    return shifted;
  }
  friend std::strong_ordering operator<=>(const FixedInt& a, const FixedInt& b) {
    const FixedInt difference = a - b;
    if (difference.is_negative()) return std::strong_ordering::less;
    return difference.limbs_ == FixedInt(0).limbs_ ? std::strong_ordering::equal
                                                   : std::strong_ordering::greater;
  }
  friend bool operator==(const FixedInt& a, const FixedInt& b) { return a.limbs_ == b.limbs_; }

 private:
  std::array<std::uint64_t, Limbs> limbs_;
};

/// The count of bits without the sign bit and its copies.
template <std::size_t Limbs>
int bit_length(const FixedInt<Limbs>& value) {
  const std::uint64_t sign = value.is_negative() ? ~std::uint64_t{0} : 0;
  std::size_t limbs = Limbs;
  while (limbs > 0 && value.limb(limbs - 1) == sign) --limbs;
  return limbs == 0 ? 0 : static_cast<int>(64 * limbs) - std::countl_zero(value.limb(limbs - 1) ^ sign);
}

/// value / 2^bits, rounded down; the result must fit in 63 bits.
template <std::size_t Limbs>
std::int64_t cut(const FixedInt<Limbs>& value, int bits) {
  const auto whole = static_cast<std::size_t>(bits / 64);
  const int rest = bits % 64;
  return static_cast<std::int64_t>((value.limb(whole) >> rest) | (value.limb(whole + 1) << 1 << (63 - rest)));
}

/// value / 2^exponent as a double, with a relative error of at most 2^-53 + 2^-61; infinite or 0 out of
/// range.
template <std::size_t Limbs>
double to_double(const FixedInt<Limbs>& value, int exponent) {
  const int cut_off = std::max(bit_length(value) - 62, 0);
  const auto kept = static_cast<double>(cut(value, cut_off));
  const int shift = cut_off - exponent;
  return shift > -1000 && shift < 1000 ? kept * power_of_two(shift) : std::ldexp(kept, shift);
}

// Besides + - * and comparisons, exact geometry needs bit_length, to_double and cut of an integer type; they
// have the same names for 64 bits, 128 bits and a FixedInt.

inline int bit_length(Int128 value) {
  return bit_length(static_cast<UInt128>(value < 0 ? ~value : value));
}

inline double to_double(std::int64_t value, int exponent) {
  return static_cast<double>(value) * power_of_two(-exponent);
}
inline double to_double(Int128 value, int exponent) {
  return to_double(value) * power_of_two(-exponent);
}

inline std::int64_t cut(std::int64_t value, int bits) {
  return value >> bits;
}
inline std::int64_t cut(Int128 value, int bits) {
  return static_cast<std::int64_t>(value >> bits);
}

/// A positive integer divisor with its inverse.
template <typename Int>
class Divisor {
 public:
  Divisor() = default;
  explicit Divisor(const Int& value) : value_(value) {
    if constexpr (kMayBeHuge) exponent_ = bit_length(value);
    inverse_ = 1 / in_range(value);
  }

  [[nodiscard]] const Int& value() const { return value_; }

  /// The smallest whole c in [0, most] with c * value >= dividend, or `most` if there is none; `most` is at
  /// most 2^20. The quotient in doubles is off by less than 2^-30, so it leaves two candidates; the exact
  /// remainder decides.
  [[nodiscard]] int quotient_rounded_up(const Int& dividend, int most) const {
    const double estimate = in_range(dividend) * inverse_;
    // The conversion truncates (-1, 0) to 0; smaller estimates are rare, and their branch is predicted.
    const double clamped = std::min(std::max(estimate, -1.0), static_cast<double>(most));
    const int near =
        static_cast<int>(clamped + 0.5);  // NOLINT(bugprone-incorrect-roundings): one less is as good
    return std::min(near + static_cast<int>(near * value_ < dividend), most);
  }

 private:
  static constexpr bool kMayBeHuge = !std::is_same_v<Int, std::int64_t> && !std::is_same_v<Int, Int128>;

  /// number / 2^exponent_ as a double; infinite if that is too large, which does no harm.
  [[nodiscard]] double in_range(const Int& number) const {
    if constexpr (kMayBeHuge) return to_double(number, exponent_);
    if constexpr (std::is_same_v<Int, Int128>) return to_double(number);
    if constexpr (std::is_same_v<Int, std::int64_t>) return static_cast<double>(number);
  }

  Int value_ = 1;
  int exponent_ = 0;
  double inverse_ = 1;
};

}  // namespace pipeline
