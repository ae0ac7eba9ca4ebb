#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/vertex_lines.h"

// Reading gains nothing from wider vectors: where a number begins depends on the one before it.
#define PIPELINE_TARGETS (HWY_SCALAR | HWY_NEON | HWY_WASM | HWY_SSE4)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/text/fixed_reading.cpp"
#include "libpipeline/numbers/lanes.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET == HWY_SCALAR

// Without vectors, the general reader does all.

template <std::size_t group_count, bool may_have_more>
FixedTextPart read_groups(std::string_view, TriangleFrame, const GroupDecimals&, const FixedColumns&) {
  return {};
}

#else

constexpr hn::FixedTag<std::uint8_t, 16> kSixteen;
constexpr hn::FixedTag<std::uint16_t, 8> kPairs;
constexpr hn::FixedTag<std::int32_t, 4> kFours;
constexpr hn::FixedTag<std::int32_t, 2> kEights;

/// For each count of digits before the point, the source bytes of the last sixteen digits: those before the
/// point, and `decimals` after it. The row of an impossible count selects the point, which fails the test for
/// digits; without a point (16) the count alone fails it.
struct DigitShuffles {
  alignas(16) std::array<std::array<std::uint8_t, 16>, 17> rows{};

  constexpr explicit DigitShuffles(unsigned decimals = 0) {
    for (unsigned count = 0; count <= 16; ++count) {
      const bool is_possible = count >= 1 && count <= 8 && count + 1 + decimals <= 16;
      const unsigned first = 16 - decimals - count;
      for (unsigned i = 0; i < 16; ++i) {
        std::uint8_t from = is_possible ? 0x80 : static_cast<std::uint8_t>(count & 15);
        if (is_possible && i >= first)
          from = static_cast<std::uint8_t>(i - first + (i >= 16 - decimals ? 1 : 0));
        rows[count][i] = from;
      }
    }
  }
};

constexpr auto kDigitShuffles = [] {
  std::array<DigitShuffles, kMaxFixedDecimals + 1> shuffles;
  for (unsigned decimals = 0; decimals < shuffles.size(); ++decimals)
    shuffles[decimals] = DigitShuffles(decimals);
  return shuffles;
}();

/// The form of numbers with a count of decimals.
struct ReadForm {
  const DigitShuffles& shuffles;
  // The separator's offset from the point; without decimals, it takes the point's place.
  std::size_t end;
  double units_per_one;

  explicit ReadForm(int decimals)
      : shuffles(kDigitShuffles[static_cast<std::size_t>(decimals)]),
        end(decimals > 0 ? static_cast<std::size_t>(decimals) + 1 : 0),
        units_per_one(kPowersOfTen[static_cast<std::size_t>(decimals)]) {}
};

/// Joins neighbors: `factor` times the first plus the second.
template <typename Joined, typename Numbers>
HWY_INLINE hn::Vec<Joined> join(Joined joined, Numbers numbers, std::int32_t factor) {
  const hn::Repartition<std::int16_t, Joined> parts;
  const auto factors = hn::BitCast(parts, hn::Set(joined, factor | 1 << 16));
  auto odd = hn::Zero(joined);
  const auto even =
      hn::ReorderWidenMulAccumulate(joined, hn::BitCast(parts, numbers), factors, hn::Zero(joined), odd);
  return hn::RearrangeToOddPlusEven(even, odd);
}

HWY_INLINE hn::Vec<decltype(kPairs)> join_digits(hn::Vec<decltype(kSixteen)> digits) {
#if HWY_ARCH_X86
  return hn::Vec<decltype(kPairs)>{_mm_maddubs_epi16(digits.raw, _mm_set1_epi16(1 << 8 | 10))};
#else
  // Ten times the first digit plus the second, in the upper byte.
  return hn::ShiftRight<8>(hn::Mul(hn::BitCast(kPairs, digits), hn::Set(kPairs, 10 << 8 | 1)));
#endif
}

/// The index of the first byte with a bit, or 16.
HWY_INLINE std::size_t first_of(unsigned bits) {
  return static_cast<std::size_t>(std::countr_zero(bits | 0x10000u));
}

/// The nearest double to a number of sixteen digits.
HWY_INLINE double number_of(hn::Vec<decltype(kSixteen)> digits, double units_per_one, bool is_negative) {
  const auto fours = hn::DemoteTo(hn::FixedTag<std::uint16_t, 4>(), join(kFours, join_digits(digits), 100));
  const auto eights = hn::BitCast(hn::FixedTag<std::uint64_t, 1>(), join(kEights, fours, 10000));
  const std::uint64_t both = hn::GetLane(eights);
  const std::uint64_t units = (both & 0xffffffff) * 100'000'000 + (both >> 32);
  // Below 2^53 the conversion is exact, so the quotient is the nearest double to the decimal.
  const double magnitude = static_cast<double>(static_cast<std::int64_t>(units)) / units_per_one;
  const std::uint64_t sign = std::uint64_t{is_negative} << 63;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | sign);
}

/// Reads w and the separator after it; null if the form differs. Equally fast for all counts of decimals,
/// with at most eight digits before the point and fifteen in all.
HWY_INLINE const char* read_short_w(const char* p, char separator, double& value) {
  const bool is_negative = *p == '-';
  const char* const first = p + (is_negative ? 1 : 0);
  const auto less_zeros =
      hn::Sub(hn::LoadU(kSixteen, reinterpret_cast<const std::uint8_t*>(first)), hn::Set(kSixteen, '0'));
  const unsigned others = bits_of(kSixteen, hn::Gt(less_zeros, hn::Set(kSixteen, 9)));
  const std::size_t count = first_of(others), end = first_of(others & (others - 1));
  if (count - 1 >= 8 || first[count] != '.' || first[end] != separator) return read_w(p, separator, value);
  const std::size_t decimals = end - count - 1;
  const auto shuffle = hn::Load(kSixteen, kDigitShuffles[decimals].rows[count].data());
  value = number_of(hn::TableLookupBytesOr0(less_zeros, shuffle), kPowersOfTen[decimals], is_negative);
  return first + end + 1;
}

template <std::size_t group_count, bool may_have_more>
class ColumnReader {
 public:
  HWY_INLINE ColumnReader(const GroupDecimals& decimals, const FixedColumns& columns)
      : forms_([&]<std::size_t... group>(std::index_sequence<group...>) {
          return std::array{ReadForm(decimals[group])...};
        }(std::make_index_sequence<group_count>())),
        columns_(columns),
        has_w_(!columns.w.empty()),
        has_material_(!columns.materials.empty()) {
    have_one_digit_.fill(true);
  }

  /// Reads the vertex lines of a triangle; null if the form differs.
  HWY_INLINE const char* read(const char* p, const char* text_end, std::size_t triangle) {
    no_digits_ = hn::Zero(kSixteen);
    is_in_place_ = true;
    counts_.fill(1);
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      if (p >= text_end) return nullptr;
#pragma GCC unroll 3
      for (std::size_t group = 0; group < group_count; ++group) {
        Vec3& numbers = columns_.groups[group][triangle][vertex];
        const bool is_last = group + 1 == group_count, has_w = may_have_more && group == 0 && has_w_;
        const char separator = is_last && !(may_have_more && has_material_) ? '\n' : ' ';
        if (group == kRepeatedGroup && last_.is_at(p)) {
          numbers = last_.numbers();
          p += last_.length();
        } else {
          const char* const begin = p;
          p = read_number(p, group, ' ', numbers.x);
          p = read_number(p, group, ' ', numbers.y);
          p = read_number(p, group, has_w ? ' ' : separator, numbers.z);
          if (group == kRepeatedGroup) last_.set(begin, p, numbers);
        }
        if (has_w && (p = read_short_w(p, separator, columns_.w[triangle][vertex])) == nullptr)
          return nullptr;
      }
      if (may_have_more && has_material_ &&
          (p = read_material(p, vertex, columns_.materials[triangle])) == nullptr)
        return nullptr;
    }
    bool have_points = true;
    for (std::size_t group = 0; group < group_count; ++group) {
      have_one_digit_[group] = counts_[group] == 1;
      have_points &= counts_[group] < 16;
    }
    const bool have_digits = hn::AllTrue(kSixteen, hn::Eq(no_digits_, hn::Zero(kSixteen)));
    return is_in_place_ && have_points && have_digits ? p : nullptr;
  }

 private:
  /// Reads one number and the separator after it.
  HWY_INLINE const char* read_number(const char* p, std::size_t group, char separator, double& value) {
    const ReadForm& form = forms_[group];
    const bool is_negative = *p == '-';
    p += is_negative ? 1 : 0;
    const char point = form.end > 0 ? '.' : separator;
    const auto text = hn::LoadU(kSixteen, reinterpret_cast<const std::uint8_t*>(p));
    std::size_t count = 1;
    if (!have_one_digit_[group] || p[1] != point) {
      count = first_of(bits_of(kSixteen, hn::Eq(text, hn::Set(kSixteen, static_cast<std::uint8_t>(point)))));
      counts_[group] |= count;
    }
    const auto shuffle = hn::Load(kSixteen, form.shuffles.rows[count].data());
    const auto digits = hn::TableLookupBytesOr0(hn::Sub(text, hn::Set(kSixteen, '0')), shuffle);
    no_digits_ = hn::Or(no_digits_, hn::SaturatedSub(digits, hn::Set(kSixteen, 9)));
    is_in_place_ &= p[count + form.end] == separator;
    value = number_of(digits, form.units_per_one, is_negative);
    return p + count + form.end + 1;
  }

  const std::array<ReadForm, group_count> forms_;  // of the groups
  const FixedColumns& columns_;
  const bool has_w_, has_material_;
  LastRead last_;
  /// True if the last numbers of each group had one digit before the point. Then a branch lets the processor
  /// go ahead to the next number, whose beginning would otherwise depend on this one; with other numbers, the
  /// branch would be mispredicted often.
  std::array<bool, group_count> have_one_digit_;
  // In the triangle being read:
  hn::Vec<decltype(kSixteen)> no_digits_;        // above 0 where another character is in place of a digit
  bool is_in_place_;                             // true if every separator is
  std::array<std::size_t, group_count> counts_;  // of digits before the point: the bits of all
};

template <std::size_t group_count, bool may_have_more>
FixedTextPart read_groups(std::string_view text, TriangleFrame frame, const GroupDecimals& decimals,
                          const FixedColumns& columns) {
  ColumnReader<group_count, may_have_more> reader(decimals, columns);
  const char* const end = text.data() + text.size();
  FixedTextPart part;
  for (std::size_t i = 0; i < columns.triangle_count() && part.length < text.size(); ++i) {
    const char* p = vertex_lines(text.data() + part.length, frame);
    if (p == nullptr || (p = reader.read(p, end, i)) == nullptr) break;
    if ((p = triangle_end(p, frame)) == nullptr || p > end) break;
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(p - text.data());
  }
  return part;
}

#endif

constexpr FixedReaders kReaders = []<std::size_t... form>(std::index_sequence<form...>) {
  return FixedReaders{read_groups<form / 2 + 1, form % 2 == 1>...};
}
(std::make_index_sequence<2 * kMaxGroups>());

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

int decimals_of_number(const char* p) {
  const auto digit_count = [](const char* from) {
    return leading_digit_count(load_eight(from) - kEightZeros);
  };
  if (*p == '-') ++p;
  p += digit_count(p);
  if (*p != '.') return 0;
  const std::size_t count = digit_count(p + 1);
  return std::min(static_cast<int>(count == 8 ? count + digit_count(p + 9) : count), kMaxFixedDecimals);
}

const FixedReaders& fixed_readers() {
  static constexpr KernelTable<const FixedReaders*> kKernels = PIPELINE_KERNEL_TABLE(kReaders);
  static const FixedReaders& readers = *chosen_kernel(kKernels);
  return readers;
}

}  // namespace pipeline

#endif
