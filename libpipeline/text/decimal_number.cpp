#include "libpipeline/text/number_parser.h"

#include <array>
#include <bit>
#include <cstdint>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/fixed_int.h"
#include "libpipeline/text/eight_digits.h"

namespace pipeline {
namespace {

constexpr int kMaxDecimals = 24;  // three words of eight digits

/// 10^-n.
constexpr auto kInversePowers = [] {
  std::array<BinaryInverse, kMaxDecimals + 1> inverses;
  UInt128 power = 1;
  for (BinaryInverse& inverse : inverses) {
    inverse = binary_inverse(power);
    power *= 10;
  }
  return inverses;
}();

/// The nearest double to digits / 10^decimals; false where the product is too close to a tie to decide.
bool divide_by_power_of_ten(std::uint64_t digits, int decimals, double& value) {
  constexpr std::uint64_t kExactLimit = std::uint64_t{1} << 53;
  const auto n = static_cast<std::size_t>(decimals);
  if (digits < kExactLimit && n < kPowersOfTen.size()) {
    // Both are exact in doubles, so the quotient is rounded once.
    value = static_cast<double>(digits) / kPowersOfTen[n];
    return true;
  }
  if (digits == 0) {
    value = 0;
    return true;
  }
  // digits * 10^-n to 128 bits. Truncating the power and truncating here each lose less than one unit, or two
  // after the shift, so the product is too small by less than kError.
  constexpr UInt128 kError = 4;
  const BinaryInverse& power = kInversePowers[n];
  const int shift = std::countl_zero(digits);
  const std::uint64_t factor = digits << shift;
  UInt128 product = static_cast<UInt128>(factor) * static_cast<std::uint64_t>(power.factor >> 64);
  product += (static_cast<UInt128>(factor) * static_cast<std::uint64_t>(power.factor)) >> 64;
  int exponent = power.exponent - shift + 64;
  if ((product >> 127) == 0) {
    product <<= 1;
    --exponent;
  }
  constexpr int kCutBits = 128 - 53;
  constexpr UInt128 kHalf = UInt128{1} << (kCutBits - 1);
  const UInt128 rest = product & (2 * kHalf - 1);
  if (rest <= kHalf && rest + kError >= kHalf) return false;
  // The mantissa's leading bit adds 1 to the exponent field, and a carry out of the mantissa adds another 1.
  const auto mantissa = static_cast<std::uint64_t>(product >> kCutBits) + (rest >= kHalf ? 1 : 0);
  value = std::bit_cast<double>((static_cast<std::uint64_t>(exponent + kCutBits + 1074) << 52) + mantissa);
  return true;
}

/// Reads up to eight digits and returns their count.
int read_digits(const char* p, std::uint64_t& number) {
  const std::uint64_t less_zeros = load_eight(p) - kEightZeros;
  const std::size_t count = leading_digit_count(less_zeros);
  number = count == 0 ? 0 : join_leading_digits(less_zeros, count);
  return static_cast<int>(count);
}

/// Continues after eight decimals; null if there are too many digits. `digit_count` is the count of `digits`.
const char* read_more_decimals(const char* p, std::uint64_t& digits, int digit_count, int& decimals) {
  // Nearly all numbers have at most nine decimals more, and at most 19 digits in all, which fit in 64 bits.
  std::uint64_t next = 0;
  const int next_count = read_digits(p, next);
  // Branch-free: a ninth digit is unpredictable.
  const auto ninth = static_cast<unsigned>(p[next_count]) - '0';
  const bool has_ninth = ninth <= 9;
  if (digit_count + next_count < 19 && !(has_ninth && is_digit(p[9]))) {
    digits = digits * kWholePowersOfTen[static_cast<std::size_t>(next_count)] + next;
    digits = digits * (has_ninth ? 10 : 1) + (has_ninth ? ninth : 0);
    decimals += next_count + (has_ninth ? 1 : 0);
    return p + next_count + (has_ninth ? 1 : 0);
  }
  for (int count = 8; count == 8 && decimals < kMaxDecimals;) {
    std::uint64_t behind = 0;
    count = read_digits(p, behind);
    if (__builtin_mul_overflow(digits, kWholePowersOfTen[static_cast<std::size_t>(count)], &digits) ||
        __builtin_add_overflow(digits, behind, &digits))
      return nullptr;
    p += count;
    decimals += count;
  }
  return is_digit(*p) ? nullptr : p;
}

}  // namespace

const char* read_decimal_number(const char* p, DecimalNumber& number) {
  const std::uint64_t sign = *p == '-' ? std::uint64_t{1} << 63 : 0;
  p += sign >> 63;
  std::uint64_t digits = 0;
  const int whole_count = read_digits(p, digits);
  p += whole_count;
  int decimals = 0;
  double magnitude = 0;
  if (*p == '.') {
    std::uint64_t behind = 0;
    decimals = read_digits(++p, behind);
    p += decimals;
    digits = digits * kWholePowersOfTen[static_cast<std::size_t>(decimals)] + behind;
  }
  if (decimals < 8) {
    if (whole_count + decimals == 0 || (whole_count == 8 && decimals == 0 && is_digit(*p))) return nullptr;
    // Below 10^15, so both are exact in doubles.
    magnitude = static_cast<double>(static_cast<std::int64_t>(digits)) /
                kPowersOfTen[static_cast<std::size_t>(decimals)];
  } else {
    p = read_more_decimals(p, digits, whole_count + decimals, decimals);
    if (p == nullptr || !divide_by_power_of_ten(digits, decimals, magnitude)) return nullptr;
  }
  number = {std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | sign), decimals};
  return p;
}

}  // namespace pipeline
