#include "libpipeline/text/fixed_text.h"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/vertex_lines.h"

// With more than four lanes, nine numbers would leave many empty.
#define PIPELINE_MAX_LANES 4
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/text/fixed_printing.cpp"
#include "libpipeline/numbers/lanes.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET == HWY_SCALAR

// Without vectors, the general printer does all.

FixedTextPart write_columns(const ConstFixedColumns&, std::size_t, int, char*) {
  return {};
}

#else

// The sixteen digits of a number.
constexpr hn::FixedTag<std::uint8_t, 16> kSixteen;

/// The form of a printed number of units with sixteen digits, the first of which is 0 and gives way to the
/// point.
struct PrintedForm {
  /// Sixteen bytes starting at byte n form a shuffle mask that drops the first n digits and moves the point
  /// to its position.
  alignas(16) std::array<std::uint8_t, 32> shuffle{};
  unsigned last_whole_digit = 0;  // a bit
  unsigned length = 0;            // of sixteen digits and, if there are decimals, the point
  unsigned length_of_zero = 0;    // without a sign

  constexpr explicit PrintedForm(unsigned decimals = 0)
      : last_whole_digit(1u << (15 - decimals)),
        length(decimals > 0 ? 17 : 16),
        length_of_zero(length + decimals - 15) {
    const unsigned point = 16 - decimals;
    for (unsigned i = 0; i < 32; ++i)
      shuffle[i] = static_cast<std::uint8_t>(i < point ? i : i == point ? 0 : i - 1);
  }
};

constexpr auto kPrintedForms = [] {
  std::array<PrintedForm, kMaxFixedDecimals + 1> forms;
  for (unsigned decimals = 0; decimals < forms.size(); ++decimals) forms[decimals] = PrintedForm(decimals);
  return forms;
}();

/// The digits to print: '0' is added to all but the first, which is 0 and becomes the point.
alignas(16) constexpr std::array<std::uint8_t, 16> kPointAndZeros = {'.', '0', '0', '0', '0', '0', '0', '0',
                                                                     '0', '0', '0', '0', '0', '0', '0', '0'};

// The types for two or four numbers at a time.
constexpr hn::RebindToUnsigned<decltype(kDoubles)> kWords;
constexpr hn::Repartition<std::uint32_t, decltype(kDoubles)> kFours;
constexpr hn::Repartition<std::uint16_t, decltype(kDoubles)> kPairs;
constexpr hn::Repartition<std::uint8_t, decltype(kDoubles)> kBytes;
using Words = hn::Vec<decltype(kWords)>;
constexpr std::size_t kBlocks = kLanes / 2;

/// Like split_sixteen in eight_digits.h, for numbers below 10^8, two in each block of sixteen bytes.
PIPELINE_INLINE auto digits_of(Words eights) {
  const auto as_fours = [](auto v) HWY_ATTR { return hn::BitCast(kFours, v); };
  const auto as_pairs = [](auto v) HWY_ATTR { return hn::BitCast(kPairs, v); };
  // x / 10000 for x < 10^8, in 64 bits.
  const auto high = hn::ShiftRight<45>(hn::MulEven(as_fours(eights), hn::Set(kFours, 0xd1b71759)));
  const auto low = hn::Sub(eights, hn::MulEven(as_fours(high), hn::Set(kFours, 10000)));
  const auto fours = as_pairs(hn::Or(high, hn::ShiftLeft<32>(low)));
  // x / 100 for x < 10^4, then x / 10 for x < 100, in 16 bits.
  const auto hundreds = hn::ShiftRight<3>(hn::MulHigh(fours, hn::Set(kPairs, 5243)));
  const auto rest = hn::Sub(fours, hn::Mul(hundreds, hn::Set(kPairs, 100)));
  const auto pairs = hn::Or(hundreds, as_pairs(hn::ShiftLeft<16>(as_fours(rest))));
  const auto tens = hn::MulHigh(pairs, hn::Set(kPairs, 6554));
  const auto ones = hn::Sub(pairs, hn::Mul(tens, hn::Set(kPairs, 10)));
  return hn::BitCast(kBytes, hn::Or(tens, hn::ShiftLeft<8>(ones)));
}

/// The way of rounding to a count of decimals.
enum class Rounding {
  unless_near_tie,
  exactly,  // only with fused multiply-add
  of_short  // only numbers without further decimals, and with no shorter exponent form
};

/// Positive numbers in units of the last decimal; clears the bits in `good` of numbers that it cannot round.
template <Rounding rounding>
PIPELINE_INLINE Doubles units_of(Doubles sizes, Doubles scale, Mask& good) {
  const auto rounder = all(kWholeRounder);
  const auto scaled = sizes * scale;
  auto units = (scaled + rounder) - rounder;
  const auto offset = scaled - units;
  if constexpr (rounding == Rounding::exactly) {
    // If the product is a tie, rounding may have made it one; the rounding error shows the side of the exact
    // product.
    const auto lost = hn::MulSub(sizes, scale, scaled);
    const auto is_tie = hn::Eq(hn::Abs(offset), all(0.5));
    units = units +
            hn::IfThenElseZero(hn::And(is_tie, hn::Gt(lost * offset, hn::Zero(kDoubles))), offset + offset);
  } else if constexpr (rounding == Rounding::unless_near_tie) {
    // The test of DecimalUnits::is_certain.
    const auto reach = hn::Abs(offset) + scaled * all(kProductError);
    good = hn::And(good, hn::Lt(reach, all(kBelowHalf)));
  } else {
    const auto is_plain = hn::And(hn::Ge(sizes, all(0.001)), hn::Lt(sizes, all(1e5)));
    good = hn::And(good, hn::And(is_plain, hn::Eq(units / scale, sizes)));
  }
  good = hn::And(good, hn::Lt(units, all(kUnitsLimit)));
  return units;
}

/// The sixteen digits of some numbers.
template <std::size_t number_count>
class Texts {
 public:
  /// False if a number is too large, not finite, or cannot be rounded in this way.
  template <Rounding rounding>
  PIPELINE_INLINE bool set(const double* p, double scale) {
    auto good = hn::Eq(hn::Zero(kDoubles), hn::Zero(kDoubles));
    negative_ = 0;
#pragma GCC unroll 5
    for (std::size_t step = 0; step < kSteps; ++step) {
      const std::size_t i = step * kLanes;
      const auto values = i + kLanes <= number_count ? hn::LoadU(kDoubles, p + i) : all(p[i]);
      add(step, values, units_of<rounding>(hn::Abs(values), all(scale), good));
    }
    return hn::AllTrue(kDoubles, good);
  }

  PIPELINE_INLINE char* write(char* out, const PrintedForm& form, std::size_t number) const {
    const std::size_t slot = slot_of(number);
    const auto leading_zero_count = std::countr_zero(filled_[slot] | form.last_whole_digit);
    const auto shuffle = hn::LoadU(kSixteen, form.shuffle.data() + leading_zero_count);
    *out = '-';
    out += negative_ >> number & 1;
    const auto text = hn::TableLookupBytes(hn::Load(kSixteen, texts_.data() + 16 * slot), shuffle);
    hn::StoreU(text, kSixteen, reinterpret_cast<std::uint8_t*>(out));
    return out + form.length - leading_zero_count;
  }
  /// Writes a number without trailing zeros or a trailing point.
  PIPELINE_INLINE char* write_short(char* out, const PrintedForm& form, std::size_t number) const {
    const unsigned digits = filled_[slot_of(number)] | form.last_whole_digit;
    const int zero_count = std::countl_zero(static_cast<std::uint16_t>(digits));
    return write(out, form, number) - zero_count -
           (digits < 2 * form.last_whole_digit ? form.length - 16 : 0);
  }

 private:
  static constexpr std::size_t kSteps = (number_count + kLanes - 1) / kLanes;

  PIPELINE_INLINE void add(std::size_t step, Doubles values, Doubles units) {
    const auto zero = hn::Zero(kDoubles), one = all(1), eight_digits = all(1e8);
    // units / 10^8, off by at most one; the exact remainder corrects it.
    const auto quotient = hn::Floor(units * all(1e-8));
    const auto rest = units - quotient * eight_digits;
    const auto correction =
        hn::IfThenElseZero(hn::Ge(rest, eight_digits), one) - hn::IfThenElseZero(hn::Lt(rest, zero), one);
    const auto first = word_of(quotient + correction), last = word_of(rest - correction * eight_digits);
    negative_ |= bits_of(hn::And(hn::Lt(values, zero), hn::Gt(units, zero))) << (step * kLanes);
    store(2 * step, digits_of(hn::InterleaveLower(kWords, first, last)));
    store(2 * step + 1, digits_of(hn::InterleaveUpper(kWords, first, last)));
  }
  /// The bits of whole numbers from 0 to 2^52.
  PIPELINE_INLINE static Words word_of(Doubles whole) {
    const auto shift = all(0x1p52);
    return hn::Xor(hn::BitCast(kWords, whole + shift), hn::BitCast(kWords, shift));
  }
  /// '0' is added to all digits but the first, which is 0 and becomes the point.
  PIPELINE_INLINE void store(std::size_t part, hn::Vec<decltype(kBytes)> digits) {
    const auto point_and_zeros = hn::LoadDup128(kBytes, kPointAndZeros.data());
    hn::Store(hn::Add(digits, point_and_zeros), kBytes, texts_.data() + 16 * kBlocks * part);
    constexpr hn::RebindToSigned<decltype(kBytes)> kWithSign;
    hn::StoreMaskBits(kWithSign, hn::Gt(hn::BitCast(kWithSign, digits), hn::Zero(kWithSign)),
                      reinterpret_cast<std::uint8_t*>(filled_.data() + kBlocks * part));
  }

  /// The slot of number i's text: the even lanes of a step come first, then the odd ones.
  static constexpr std::size_t slot_of(std::size_t i) {
    return i / kLanes * kLanes + i % 2 * kBlocks + i % kLanes / 2;
  }

  alignas(32) std::array<std::uint8_t, 16 * kLanes * kSteps> texts_;
  std::array<std::uint16_t, kLanes * kSteps + 4> filled_{};  // a bit for each digit above 0
  unsigned negative_ = 0;  // bit i: number i is negative and does not round to 0
};

/// A triangle's numbers.
template <std::size_t group_count>
struct TriangleTexts {
  std::array<Texts<9>, group_count> groups;
  Texts<4> w;
  bool has_short_w = false;  // true if w is set
};

/// Prints a vertex line.
template <std::size_t group_count, bool may_have_more>
PIPELINE_INLINE char* write_line(char* out, const PrintedForm& form, const ConstFixedColumns& columns,
                                 std::size_t triangle, std::size_t vertex,
                                 const TriangleTexts<group_count>& texts, bool repeats, LastPrinted& last) {
#pragma GCC unroll 3
  for (std::size_t group = 0; group < group_count; ++group) {
    if (repeats && group == kRepeatedGroup) {
      out = last.print(out);
    } else {
      const char* const begin = out;
#pragma GCC unroll 3
      for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
        out = texts.groups[group].write(out, form, k);
        *out++ = ' ';
      }
      if (group == kRepeatedGroup && vertex == 2)
        last.set(columns.groups[group][triangle][vertex], begin, out);
    }
    if (may_have_more && group == 0 && !columns.w.empty()) {
      out = texts.has_short_w ? texts.w.write_short(out, form, vertex)
                              : print_shortest(out, columns.w[triangle][vertex]);
      *out++ = ' ';
    }
  }
  return write_line_end(out, may_have_more ? columns.materials : std::span<const std::uint32_t>(), triangle);
}

/// Prints triangles up to one with a number that Texts::set refuses.
template <Rounding rounding, std::size_t group_count, bool may_have_more>
FixedTextPart write_lines(std::size_t first, const ConstFixedColumns& columns, int decimals, char* out) {
  // A copy: to the compiler, printed characters may alias the original.
  const PrintedForm form = kPrintedForms[static_cast<std::size_t>(decimals)];
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  LastPrinted last;
  FixedTextPart part;
  const char* const begin = out;
  for (std::size_t i = first; i < columns.triangle_count(); ++i) {
    TriangleTexts<group_count> texts;
    const bool repeats = group_count > kRepeatedGroup && last.is_of(columns.groups[kRepeatedGroup][i]);
#pragma GCC unroll 3
    for (std::size_t group = 0; group < group_count; ++group)
      if (!(repeats && group == kRepeatedGroup) &&
          !texts.groups[group].template set<rounding>(&columns.groups[group][i][0].x, scale))
        return part;
    if (may_have_more && !columns.w.empty()) {
      const auto& [a, b, c] = columns.w[i];
      texts.has_short_w = texts.w.template set<Rounding::of_short>(std::array{a, b, c, c}.data(), scale);
    }
#pragma GCC unroll 3
    for (std::size_t vertex = 0; vertex < 3; ++vertex)
      out = write_line<group_count, may_have_more>(out, form, columns, i, vertex, texts, repeats, last);
    *out++ = '\n';
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(out - begin);
  }
  return part;
}

template <Rounding rounding>
FixedTextPart write_from(std::size_t first, const ConstFixedColumns& columns, int decimals, char* out) {
  constexpr auto kWriters = []<std::size_t... form>(std::index_sequence<form...>) {
    return std::array{write_lines<rounding, form / 2 + 1, form % 2 == 1>...};
  }
  (std::make_index_sequence<2 * kMaxGroups>());
  return kWriters[columns.form()](first, columns, decimals, out);
}

/// Rounds exactly from the first near tie on: others will follow.
FixedTextPart write_columns(const ConstFixedColumns& columns, std::size_t first, int decimals, char* out) {
  const FixedTextPart part = write_from<Rounding::unless_near_tie>(first, columns, decimals, out);
  first += part.triangle_count;
  if (!HWY_NATIVE_FMA || first == columns.triangle_count()) return part;
  const FixedTextPart rest = write_from<Rounding::exactly>(first, columns, decimals, out + part.length);
  return {part.triangle_count + rest.triangle_count, part.length + rest.length};
}

#endif

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

constinit const KernelTable<WriteFixedColumns> kFixedPrintingKernels = PIPELINE_KERNEL_TABLE(write_columns);

}  // namespace pipeline

#endif
