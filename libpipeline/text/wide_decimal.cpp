#include "libpipeline/text/wide_decimal.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pipeline {
namespace {

/// A whole number of any size: 32-bit limbs, the least significant first, no leading zero limb.
class WholeNumber {
 public:
  explicit WholeNumber(std::uint64_t value) {
    for (; value != 0; value >>= 32) limbs_.push_back(static_cast<std::uint32_t>(value));
  }

  [[nodiscard]] bool is_zero() const { return limbs_.empty(); }
  [[nodiscard]] bool bit(std::size_t index) const {
    return index / 32 < limbs_.size() && ((limbs_[index / 32] >> (index % 32)) & 1u) != 0;
  }
  /// True if any bit below `index` is set.
  [[nodiscard]] bool any_bit_below(std::size_t index) const {
    for (std::size_t i = 0; i < index && i / 32 < limbs_.size(); ++i)
      if (bit(i)) return true;
    return false;
  }

  void multiply_add(std::uint32_t factor, std::uint32_t summand) {
    std::uint64_t carry = summand;
    for (std::uint32_t& limb : limbs_) {
      carry += std::uint64_t{limb} * factor;
      limb = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) limbs_.push_back(static_cast<std::uint32_t>(carry));
  }

  void shift_left(std::size_t bits) {
    if (is_zero()) return;
    limbs_.insert(limbs_.begin(), bits / 32, 0);
    multiply_add(std::uint32_t{1} << (bits % 32), 0);
  }

  void shift_right(std::size_t bits) {
    const std::size_t whole = std::min(bits / 32, limbs_.size());
    limbs_.erase(limbs_.begin(), limbs_.begin() + static_cast<std::ptrdiff_t>(whole));
    const unsigned rest = bits % 32;
    for (std::size_t i = 0; rest != 0 && i < limbs_.size(); ++i) {
      const std::uint32_t above = i + 1 < limbs_.size() ? limbs_[i + 1] : 0;
      limbs_[i] = (limbs_[i] >> rest) | (above << (32 - rest));
    }
    drop_leading_zeros();
  }

  /// Divides by `divisor` and returns the remainder.
  std::uint32_t divide(std::uint32_t divisor) {
    std::uint64_t remainder = 0;
    for (std::size_t i = limbs_.size(); i-- > 0;) {
      remainder = (remainder << 32) | limbs_[i];
      limbs_[i] = static_cast<std::uint32_t>(remainder / divisor);
      remainder %= divisor;
    }
    drop_leading_zeros();
    return static_cast<std::uint32_t>(remainder);
  }

  void add(const WholeNumber& other) {
    limbs_.resize(std::max(limbs_.size(), other.limbs_.size()) + 1, 0);
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      carry += std::uint64_t{limbs_[i]} + (i < other.limbs_.size() ? other.limbs_[i] : 0);
      limbs_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    drop_leading_zeros();
  }

  /// Subtracts a number that is not larger.
  void subtract(const WholeNumber& other) {
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      const std::int64_t digit =
          std::int64_t{limbs_[i]} - (i < other.limbs_.size() ? std::int64_t{other.limbs_[i]} : 0) + borrow;
      limbs_[i] = static_cast<std::uint32_t>(digit);
      borrow = digit < 0 ? -1 : 0;
    }
    drop_leading_zeros();
  }

 private:
  void drop_leading_zeros() {
    while (!limbs_.empty() && limbs_.back() == 0) limbs_.pop_back();
  }

  std::vector<std::uint32_t> limbs_;
};

/// |value| = mantissa * 2^exponent.
std::pair<std::uint64_t, int> split(double value) {
  int exponent = 0;
  const double fraction = std::frexp(std::fabs(value), &exponent);
  return {static_cast<std::uint64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

/// Divides by 2^bits, rounding to the nearest whole number, ties to even.
void shift_right_rounded(WholeNumber& number, std::size_t bits) {
  if (bits == 0) return;
  const bool half = number.bit(bits - 1);
  const bool more = number.any_bit_below(bits - 1);
  number.shift_right(bits);
  if (half && (more || number.bit(0))) number.add(WholeNumber(1));
}

}  // namespace

char* print_exact_sum(char* out, double hi, double lo, int decimals) {
  const auto [hi_mantissa, hi_exponent] = split(hi);
  const auto [lo_mantissa, lo_exponent] = split(lo);
  const int exponent = lo == 0 ? hi_exponent : std::min(hi_exponent, lo_exponent);
  WholeNumber sum(hi_mantissa);
  sum.shift_left(static_cast<std::size_t>(hi_exponent - exponent));
  WholeNumber low(lo_mantissa);
  if (lo != 0) low.shift_left(static_cast<std::size_t>(lo_exponent - exponent));
  if (std::signbit(hi) == std::signbit(lo)) {
    sum.add(low);
  } else {
    sum.subtract(low);
  }
  for (int i = 0; i < decimals; ++i) sum.multiply_add(10, 0);
  if (exponent >= 0) {
    sum.shift_left(static_cast<std::size_t>(exponent));
  } else {
    shift_right_rounded(sum, static_cast<std::size_t>(-exponent));
  }

  std::string digits;  // the least significant first
  while (!sum.is_zero()) {
    std::uint32_t nine_digits = sum.divide(1'000'000'000);
    for (int i = 0; i < 9; ++i, nine_digits /= 10)
      digits.push_back(static_cast<char>('0' + nine_digits % 10));
  }
  while (!digits.empty() && digits.back() == '0') digits.pop_back();
  const auto decimal_count = static_cast<std::size_t>(decimals);
  if (digits.size() <= decimal_count) digits.append(decimal_count + 1 - digits.size(), '0');
  if (decimal_count > 0) digits.insert(decimal_count, 1, '.');
  if (std::signbit(hi)) digits.push_back('-');
  return std::reverse_copy(digits.begin(), digits.end(), out);
}

}  // namespace pipeline
