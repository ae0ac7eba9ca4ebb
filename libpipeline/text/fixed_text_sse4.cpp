#include "libpipeline/text/vertex_lines.h"

#ifdef PIPELINE_HAS_X86_KERNELS

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstdint>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/powers_of_ten.h"
#include "libpipeline/text/eight_digits.h"

#define PIPELINE_SSE4 __attribute__((target("sse4.2,bmi")))

namespace pipeline {
namespace {

constexpr std::uint64_t kSignBit = std::uint64_t{1} << 63;

// ---- reading ----

/// For each count of digits before the point, the source bytes of the last sixteen digits: those before the
/// point, and `decimals` after it. The row of an impossible count selects the point, which is not a digit and
/// fails the test; without a point (16) the count alone fails it.
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

/// How to read numbers with a count of decimals.
struct ReadForm {
  const DigitShuffles& shuffles;
  std::size_t
      end;  // the separator's position after that of the point, which it takes if there are no decimals
  double units_per_one;

  explicit ReadForm(std::size_t decimals)
      : shuffles(kDigitShuffles[decimals]),
        end(decimals > 0 ? decimals + 1 : 0),
        units_per_one(kPowersOfTen[decimals]) {}
};

/// Reads one number and the separator after it; clears bits of `good` if the form differs.
PIPELINE_SSE4 inline const char* read_number(const char* p, const ReadForm& form, char separator,
                                             std::uint64_t& bits, int& good) {
  const std::uint64_t sign = *p == '-' ? kSignBit : 0;
  p += sign >> 63;
  const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
  const __m128i point = _mm_set1_epi8(form.end > 0 ? '.' : separator);
  const auto points = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi8(text, point)));
  const auto count = static_cast<unsigned>(std::countr_zero(points | 0x10000u));
  const __m128i shuffle = _mm_load_si128(reinterpret_cast<const __m128i*>(form.shuffles.rows[count].data()));
  const __m128i digits = _mm_shuffle_epi8(_mm_sub_epi8(text, _mm_set1_epi8('0')), shuffle);
  const __m128i in_range = _mm_cmpeq_epi8(_mm_min_epu8(digits, _mm_set1_epi8(9)), digits);
  const bool is_in_place = (count < 16) & (p[count + form.end] == separator);
  good &= _mm_movemask_epi8(in_range) & (is_in_place ? 0xffff : 0);
  // Joins neighboring digits, then pairs, then fours, until 8 digits are one number.
  const __m128i pairs = _mm_maddubs_epi16(digits, _mm_set1_epi16(10 | (1 << 8)));
  const __m128i fours = _mm_madd_epi16(pairs, _mm_set1_epi32(100 | (1 << 16)));
  const __m128i packed = _mm_packus_epi32(fours, fours);
  const __m128i eights = _mm_madd_epi16(packed, _mm_set1_epi32(10000 | (1 << 16)));
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights));
  const std::uint64_t units = (both & 0xffffffff) * 100'000'000 + (both >> 32);
  // Below 2^53 the conversion is exact, so the quotient is the nearest double to the decimal.
  const double value = static_cast<double>(static_cast<std::int64_t>(units)) / form.units_per_one;
  bits = std::bit_cast<std::uint64_t>(value) | sign;
  return p + count + form.end + 1;
}

template <TriangleFrame frame>
PIPELINE_SSE4 FixedTextPart read_fixed_text(std::string_view text, int decimals,
                                            std::span<Triangle> triangles) {
  const ReadForm form(static_cast<std::size_t>(decimals));
  FixedTextPart part;
  const char* p = text.data();
  const char* const end = p + text.size();
  for (Triangle& triangle : triangles) {
    if (p >= end) break;
    std::array<std::uint64_t, 9> bits;
    const char* q = vertex_lines<frame>(p);
    if (q == nullptr) break;
    int good = 0xffff;
    for (std::size_t v = 0; v < 3; ++v) {
      q = read_number(q, form, ' ', bits[3 * v], good);
      q = read_number(q, form, ' ', bits[3 * v + 1], good);
      q = read_number(q, form, '\n', bits[3 * v + 2], good);
    }
    if (frame == TriangleFrame::stage_text && *q++ != '\n') break;
    if (good != 0xffff || q > end) break;
    triangle = std::bit_cast<Triangle>(bits);
    p = q;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(p - text.data());
  return part;
}

using ReadForms = std::array<ReadForm, 3>;

/// Reads the numbers that a vertex line has in a group, and w after the position; null if the form differs.
template <std::size_t group, std::size_t group_count>
[[gnu::always_inline]] PIPELINE_SSE4 inline const char* read_group(const char* p, const ReadForm& form,
                                                                   const FixedColumns& columns,
                                                                   std::size_t triangle, std::size_t vertex,
                                                                   LastRead& last) {
  Vec3& numbers = columns.groups[group][triangle][vertex];
  if (group == kRepeatedGroup && last.is_at(p)) {
    numbers = last.numbers();
    return p + last.length();
  }
  constexpr char kEnd = group + 1 == group_count ? '\n' : ' ';
  const bool w_follows = group == 0 && !columns.w.empty();
  const char* const begin = p;
  int good = 0xffff;
  std::array<std::uint64_t, 3> bits;
  p = read_number(p, form, ' ', bits[0], good);
  p = read_number(p, form, ' ', bits[1], good);
  p = read_number(p, form, w_follows ? ' ' : kEnd, bits[2], good);
  if (good != 0xffff) return nullptr;
  numbers = std::bit_cast<Vec3>(bits);
  if (group == kRepeatedGroup) last.set(begin, p, numbers);
  return w_follows ? read_w(p, kEnd, columns.w[triangle][vertex]) : p;
}

/// Reads a vertex line; null if the form differs.
template <std::size_t group_count>
[[gnu::always_inline]] PIPELINE_SSE4 inline const char* read_line(const char* p, const ReadForms& forms,
                                                                  const FixedColumns& columns,
                                                                  std::size_t triangle, std::size_t vertex,
                                                                  LastRead& last) {
  p = read_group<0, group_count>(p, forms[0], columns, triangle, vertex, last);
  if constexpr (group_count > 1)
    if (p != nullptr) p = read_group<1, group_count>(p, forms[1], columns, triangle, vertex, last);
  if constexpr (group_count > 2)
    if (p != nullptr) p = read_group<2, group_count>(p, forms[2], columns, triangle, vertex, last);
  return p;
}

template <std::size_t group_count>
PIPELINE_SSE4 FixedTextPart read_groups(std::string_view text, TriangleFrame frame,
                                        const GroupDecimals& decimals, const FixedColumns& columns) {
  const auto form = [&](std::size_t group) { return ReadForm(static_cast<std::size_t>(decimals[group])); };
  const ReadForms forms = {form(0), form(1), form(2)};
  const char* const end = text.data() + text.size();
  LastRead last;
  FixedTextPart part;
  for (std::size_t i = 0; i < columns.triangle_count() && part.length < text.size(); ++i) {
    const char* p = vertex_lines(text.data() + part.length, frame);
    for (std::size_t vertex = 0; vertex < 3 && p != nullptr; ++vertex)
      p = p < end ? read_line<group_count>(p, forms, columns, i, vertex, last) : nullptr;
    if (p == nullptr || (p = triangle_end(p, frame)) == nullptr || p > end) break;
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(p - text.data());
  }
  return part;
}

FixedTextPart read_columns(std::string_view text, TriangleFrame frame, const GroupDecimals& decimals,
                           const FixedColumns& columns) {
  switch (columns.group_count()) {
    case 1:
      return read_groups<1>(text, frame, decimals, columns);
    case 2:
      return read_groups<2>(text, frame, decimals, columns);
    default:
      return read_groups<3>(text, frame, decimals, columns);
  }
}

// ---- printing ----

PIPELINE_SSE4 inline char* write_number(char* out, const PrintedForm& form, bool is_negative,
                                        std::uint32_t first, std::uint32_t last) {
  const __m128i digits = sixteen_digits(first, last);
  const __m128i text =
      _mm_add_epi8(digits, _mm_load_si128(reinterpret_cast<const __m128i*>(kPointAndZeros.data())));
  const auto filled = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpgt_epi8(digits, _mm_setzero_si128())));
  const auto leading_zero_count = static_cast<unsigned>(std::countr_zero(filled | form.last_whole_digit));
  const __m128i shuffle =
      _mm_loadu_si128(reinterpret_cast<const __m128i*>(form.shuffle.data() + leading_zero_count));
  *out = '-';
  out += is_negative ? 1 : 0;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(text, shuffle));
  return out + form.length - leading_zero_count;
}

/// The nine coordinates of a triangle as whole units of the last decimal, split before their last eight
/// digits.
struct SplitUnits {
  alignas(16) std::array<std::int32_t, 12> first;
  alignas(16) std::array<std::int32_t, 12> last;
  unsigned negative = 0;  // bit i: coordinate i is negative and does not round to 0
};

/// False if a coordinate is too large, not finite, or too close to a tie.
PIPELINE_SSE4 inline bool split(const double* coordinates, double scale, SplitUnits& split_units) {
  const __m128d sign_bit = _mm_set1_pd(-0.0);
  const __m128d rounder = _mm_set1_pd(kWholeRounder);
  const __m128d below_half = _mm_set1_pd(kBelowHalf);
  __m128d good = _mm_castsi128_pd(_mm_set1_epi32(-1));
  unsigned negative = 0;
  for (std::size_t i = 0; i < 10; i += 2) {
    const __m128d value = i < 8 ? _mm_loadu_pd(coordinates + i) : _mm_load_sd(coordinates + i);
    const __m128d scaled = _mm_mul_pd(_mm_andnot_pd(sign_bit, value), _mm_set1_pd(scale));
    const __m128d units = _mm_sub_pd(_mm_add_pd(scaled, rounder), rounder);
    const __m128d distance = _mm_andnot_pd(sign_bit, _mm_sub_pd(scaled, units));
    // The same test as DecimalUnits::is_certain.
    const __m128d reach = _mm_add_pd(distance, _mm_mul_pd(scaled, _mm_set1_pd(kProductError)));
    good = _mm_and_pd(
        good, _mm_and_pd(_mm_cmplt_pd(reach, below_half), _mm_cmplt_pd(units, _mm_set1_pd(kUnitsLimit))));
    // units / 10^8, off by at most one; the exact remainder corrects it.
    const __m128d eight_digits = _mm_set1_pd(1e8);
    __m128d first = _mm_floor_pd(_mm_mul_pd(units, _mm_set1_pd(1e-8)));
    __m128d last = _mm_sub_pd(units, _mm_mul_pd(first, eight_digits));
    const __m128d too_large = _mm_cmplt_pd(last, _mm_setzero_pd());
    const __m128d too_small = _mm_cmpge_pd(last, eight_digits);
    first = _mm_sub_pd(first, _mm_and_pd(too_large, _mm_set1_pd(1)));
    first = _mm_add_pd(first, _mm_and_pd(too_small, _mm_set1_pd(1)));
    last = _mm_add_pd(last, _mm_and_pd(too_large, eight_digits));
    last = _mm_sub_pd(last, _mm_and_pd(too_small, eight_digits));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&split_units.first[i]), _mm_cvttpd_epi32(first));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(&split_units.last[i]), _mm_cvttpd_epi32(last));
    const __m128d below_zero = _mm_and_pd(value, _mm_cmpgt_pd(units, _mm_setzero_pd()));
    negative |= static_cast<unsigned>(_mm_movemask_pd(below_zero)) << i;
  }
  split_units.negative = negative;
  return _mm_movemask_pd(good) == 3;
}

PIPELINE_SSE4 FixedTextPart write_fixed_text(std::span<const Triangle> triangles, int decimals, char* out) {
  const PrintedForm form = kPrintedForms[static_cast<std::size_t>(decimals)];
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  FixedTextPart part;
  char* const begin = out;
  for (const Triangle& triangle : triangles) {
    SplitUnits units;
    if (!split(&triangle[0].x, scale, units)) break;
    for (unsigned i = 0; i < 9; ++i) {
      out =
          write_number(out, form, ((units.negative >> i) & 1u) != 0,
                       static_cast<std::uint32_t>(units.first[i]), static_cast<std::uint32_t>(units.last[i]));
      *out++ = i % 3 == 2 ? '\n' : ' ';
    }
    *out++ = '\n';
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(out - begin);
  return part;
}

PIPELINE_SSE4 FixedTextPart write_columns(const ConstFixedColumns& columns, int decimals, char* out) {
  const PrintedForm form = kPrintedForms[static_cast<std::size_t>(decimals)];
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  const std::size_t group_count = columns.group_count();
  LastPrinted last;
  FixedTextPart part;
  char* const begin = out;
  for (std::size_t i = 0; i < columns.triangle_count(); ++i) {
    std::array<SplitUnits, 3> units;
    const bool repeats = group_count > kRepeatedGroup && last.is_of(columns.groups[kRepeatedGroup][i]);
    for (std::size_t group = 0; group < group_count; ++group)
      if (!(repeats && group == kRepeatedGroup) &&
          !split(&columns.groups[group][i][0].x, scale, units[group]))
        return part;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (std::size_t group = 0; group < group_count; ++group) {
        if (repeats && group == kRepeatedGroup) {
          out = last.print(out);
          continue;
        }
        const char* const group_begin = out;
        for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
          out = write_number(out, form, ((units[group].negative >> k) & 1u) != 0,
                             static_cast<std::uint32_t>(units[group].first[k]),
                             static_cast<std::uint32_t>(units[group].last[k]));
          *out++ = ' ';
        }
        if (group == kRepeatedGroup && vertex == 2)
          last.set(columns.groups[group][i][vertex], group_begin, out);
        if (group == 0 && !columns.w.empty()) out = write_w(out, columns.w[i][vertex]);
      }
      out[-1] = '\n';
    }
    *out++ = '\n';
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(out - begin);
  }
  return part;
}

}  // namespace

constinit const FixedTextKernel kSse4Kernel = {"sse4",
                                               read_fixed_text<TriangleFrame::stage_text>,
                                               read_fixed_text<TriangleFrame::scene>,
                                               read_columns,
                                               write_fixed_text,
                                               write_columns};

bool processor_has_sse4() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("bmi");
}

}  // namespace pipeline

#endif
