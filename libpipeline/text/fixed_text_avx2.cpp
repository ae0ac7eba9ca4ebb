#include "libpipeline/text/vertex_lines.h"

#ifdef PIPELINE_HAS_X86_KERNELS

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstdint>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/powers_of_ten.h"

#define PIPELINE_AVX2 __attribute__((target("avx2,bmi,fma")))

namespace pipeline {
namespace {

/// Four coordinates as whole units of the last decimal, split before their last eight digits.
struct SplitUnits {
  __m128i first;
  __m128i last;
  unsigned negative;  // bit i: coordinate i is negative and does not round to 0
};

/// Clears the lanes of `good` whose coordinate is too large or not finite or, unless `exactly`, too close to
/// a tie.
template <bool exactly>
PIPELINE_AVX2 inline SplitUnits split(__m256d values, __m256d scale, __m256d& good) {
  const __m256d sign_bit = _mm256_set1_pd(-0.0);
  const __m256d rounder = _mm256_set1_pd(kWholeRounder);
  const __m256d one = _mm256_set1_pd(1);
  const __m256d eight_digits = _mm256_set1_pd(1e8);
  const __m256d sizes = _mm256_andnot_pd(sign_bit, values);
  const __m256d scaled = _mm256_mul_pd(sizes, scale);
  __m256d units = _mm256_sub_pd(_mm256_add_pd(scaled, rounder), rounder);
  const __m256d offset = _mm256_sub_pd(scaled, units);
  const __m256d distance = _mm256_andnot_pd(sign_bit, offset);
  if constexpr (exactly) {
    // A product that is a tie was rounded to it, or is it. What the rounding lost tells on which side it was.
    const __m256d lost = _mm256_fmsub_pd(sizes, scale, scaled);
    const __m256d is_tie = _mm256_cmp_pd(distance, _mm256_set1_pd(0.5), _CMP_EQ_OQ);
    const __m256d is_beyond = _mm256_cmp_pd(_mm256_mul_pd(lost, offset), _mm256_setzero_pd(), _CMP_GT_OQ);
    units =
        _mm256_add_pd(units, _mm256_and_pd(_mm256_and_pd(is_tie, is_beyond), _mm256_add_pd(offset, offset)));
  } else {
    // The same test as DecimalUnits::is_certain.
    const __m256d reach = _mm256_add_pd(distance, _mm256_mul_pd(scaled, _mm256_set1_pd(kProductError)));
    good = _mm256_and_pd(good, _mm256_cmp_pd(reach, _mm256_set1_pd(kBelowHalf), _CMP_LT_OQ));
  }
  good = _mm256_and_pd(good, _mm256_cmp_pd(units, _mm256_set1_pd(kUnitsLimit), _CMP_LT_OQ));
  // units / 10^8, off by at most one; the exact remainder corrects it.
  const __m256d quotient = _mm256_floor_pd(_mm256_mul_pd(units, _mm256_set1_pd(1e-8)));
  const __m256d rest = _mm256_sub_pd(units, _mm256_mul_pd(quotient, eight_digits));
  const __m256d too_large = _mm256_cmp_pd(rest, _mm256_setzero_pd(), _CMP_LT_OQ);
  const __m256d too_small = _mm256_cmp_pd(rest, eight_digits, _CMP_GE_OQ);
  const __m256d step = _mm256_sub_pd(_mm256_and_pd(too_small, one), _mm256_and_pd(too_large, one));
  const __m256d below_zero = _mm256_and_pd(values, _mm256_cmp_pd(units, _mm256_setzero_pd(), _CMP_GT_OQ));
  return {_mm256_cvttpd_epi32(_mm256_add_pd(quotient, step)),
          _mm256_cvttpd_epi32(_mm256_sub_pd(rest, _mm256_mul_pd(step, eight_digits))),
          static_cast<unsigned>(_mm256_movemask_pd(below_zero))};
}

/// Like sixteen_digits in eight_digits.h, for two numbers, one in each half.
PIPELINE_AVX2 inline __m256i sixteen_digits(__m128i first_and_last) {
  const __m256i eights = _mm256_cvtepu32_epi64(first_and_last);
  // x / 10000 for x < 10^8, in 64 bits.
  const __m256i high = _mm256_srli_epi64(_mm256_mul_epu32(eights, _mm256_set1_epi64x(0xd1b71759)), 45);
  const __m256i low = _mm256_sub_epi32(eights, _mm256_mul_epu32(high, _mm256_set1_epi64x(10000)));
  const __m256i fours = _mm256_or_si256(high, _mm256_slli_epi64(low, 32));
  // x / 100 for x < 10^4, then x / 10 for x < 100, in 16 bits.
  const __m256i hundreds = _mm256_srli_epi16(_mm256_mulhi_epu16(fours, _mm256_set1_epi16(5243)), 3);
  const __m256i rest = _mm256_sub_epi16(fours, _mm256_mullo_epi16(hundreds, _mm256_set1_epi16(100)));
  const __m256i pairs = _mm256_or_si256(hundreds, _mm256_slli_epi32(rest, 16));
  const __m256i tens = _mm256_mulhi_epu16(pairs, _mm256_set1_epi16(6554));
  const __m256i ones = _mm256_sub_epi16(pairs, _mm256_mullo_epi16(tens, _mm256_set1_epi16(10)));
  return _mm256_or_si256(tens, _mm256_slli_epi16(ones, 8));
}

/// `filled` has a bit for each character that is a digit above 0.
PIPELINE_AVX2 inline char* write_number(char* out, const PrintedForm& form, unsigned is_negative,
                                        __m128i text, unsigned filled) {
  const auto leading_zero_count = static_cast<unsigned>(std::countr_zero(filled | form.last_whole_digit));
  const __m128i shuffle =
      _mm_loadu_si128(reinterpret_cast<const __m128i*>(form.shuffle.data() + leading_zero_count));
  *out = '-';
  out += is_negative & 1;
  _mm_storeu_si128(reinterpret_cast<__m128i*>(out), _mm_shuffle_epi8(text, shuffle));
  return out + form.length - leading_zero_count;
}

PIPELINE_AVX2 inline char* write_two(char* out, const PrintedForm& form, __m128i first_and_last,
                                     unsigned negative, char first_separator, char second_separator) {
  const __m256i characters =
      _mm256_broadcastsi128_si256(_mm_load_si128(reinterpret_cast<const __m128i*>(kPointAndZeros.data())));
  const __m256i digits = sixteen_digits(first_and_last);
  const __m256i text = _mm256_add_epi8(digits, characters);
  const auto filled =
      static_cast<unsigned>(_mm256_movemask_epi8(_mm256_cmpgt_epi8(digits, _mm256_setzero_si256())));
  out = write_number(out, form, negative, _mm256_castsi256_si128(text), filled & 0xffff);
  *out++ = first_separator;
  out = write_number(out, form, negative >> 1, _mm256_extracti128_si256(text, 1), filled >> 16);
  *out++ = second_separator;
  return out;
}

/// Stops before a triangle with a coordinate that `split` refuses.
template <bool exactly>
PIPELINE_AVX2 FixedTextPart write_triangles(std::span<const Triangle> triangles, int decimals, char* out) {
  const PrintedForm& form = kPrintedForms[static_cast<std::size_t>(decimals)];
  const __m256d scale = _mm256_set1_pd(kPowersOfTen[static_cast<std::size_t>(decimals)]);
  FixedTextPart part;
  char* const begin = out;
  for (const Triangle& triangle : triangles) {
    const double* const p = &triangle[0].x;
    __m256d good = _mm256_castsi256_pd(_mm256_set1_epi32(-1));
    const SplitUnits a = split<exactly>(_mm256_loadu_pd(p), scale, good);
    const SplitUnits b = split<exactly>(_mm256_loadu_pd(p + 4), scale, good);
    const SplitUnits c = split<exactly>(_mm256_zextpd128_pd256(_mm_load_sd(p + 8)), scale, good);
    if (_mm256_movemask_pd(good) != 0xf) break;
    out = write_two(out, form, _mm_unpacklo_epi32(a.first, a.last), a.negative, ' ', ' ');
    out = write_two(out, form, _mm_unpackhi_epi32(a.first, a.last), a.negative >> 2, '\n', ' ');
    out = write_two(out, form, _mm_unpacklo_epi32(b.first, b.last), b.negative, ' ', '\n');
    out = write_two(out, form, _mm_unpackhi_epi32(b.first, b.last), b.negative >> 2, ' ', ' ');
    // The last number has no partner; the text of the empty lane is overwritten.
    char* const after_empty_lane =
        write_two(out, form, _mm_unpacklo_epi32(c.first, c.last), c.negative, '\n', '\n');
    out = after_empty_lane - form.length_of_zero - 1;
    *out++ = '\n';
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(out - begin);
  return part;
}

/// Exactly from the first tie on: where there is one, others follow.
FixedTextPart write_fixed_text(std::span<const Triangle> triangles, int decimals, char* out) {
  const FixedTextPart part = write_triangles<false>(triangles, decimals, out);
  if (part.triangle_count == triangles.size()) return part;
  const FixedTextPart rest =
      write_triangles<true>(triangles.subspan(part.triangle_count), decimals, out + part.length);
  return {part.triangle_count + rest.triangle_count, part.length + rest.length};
}

/// Prints three numbers and a blank after each; clears lanes of `good` as `split` does.
template <bool exactly>
PIPELINE_AVX2 inline char* write_three(char* out, const PrintedForm& form, const Vec3& numbers, __m256d scale,
                                       __m256d& good) {
  const __m256d values = _mm256_maskload_pd(&numbers.x, _mm256_setr_epi64x(-1, -1, -1, 0));
  const SplitUnits units = split<exactly>(values, scale, good);
  out = write_two(out, form, _mm_unpacklo_epi32(units.first, units.last), units.negative, ' ', ' ');
  // The last number has no partner; the text of the empty lane is overwritten.
  char* const after_empty_lane =
      write_two(out, form, _mm_unpackhi_epi32(units.first, units.last), units.negative >> 2, ' ', ' ');
  return after_empty_lane - form.length_of_zero - 1;
}

/// Prints the numbers that a vertex line has in a group, and w after the position.
template <bool exactly, std::size_t group>
[[gnu::always_inline]] PIPELINE_AVX2 inline char* write_group(char* out, const PrintedForm& form,
                                                              const ConstFixedColumns& columns,
                                                              std::size_t triangle, std::size_t vertex,
                                                              __m256d scale, __m256d& good,
                                                              LastPrinted& last) {
  const Vec3& numbers = columns.groups[group][triangle][vertex];
  if (group == kRepeatedGroup && last.is_of(numbers)) return last.print(out);
  const char* const begin = out;
  out = write_three<exactly>(out, form, numbers, scale, good);
  if (group == kRepeatedGroup) last.set(numbers, begin, out);
  return group == 0 && !columns.w.empty() ? write_w(out, columns.w[triangle][vertex]) : out;
}

/// Stops before a triangle with a number that `split` refuses.
template <bool exactly, std::size_t group_count>
PIPELINE_AVX2 FixedTextPart write_groups(std::size_t first, const ConstFixedColumns& columns, int decimals,
                                         char* out) {
  const PrintedForm& form = kPrintedForms[static_cast<std::size_t>(decimals)];
  const __m256d scale = _mm256_set1_pd(kPowersOfTen[static_cast<std::size_t>(decimals)]);
  LastPrinted last;
  FixedTextPart part;
  const char* const begin = out;
  for (std::size_t i = first; i < columns.triangle_count(); ++i) {
    __m256d good = _mm256_castsi256_pd(_mm256_set1_epi32(-1));
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      out = write_group<exactly, 0>(out, form, columns, i, vertex, scale, good, last);
      if constexpr (group_count > 1)
        out = write_group<exactly, 1>(out, form, columns, i, vertex, scale, good, last);
      if constexpr (group_count > 2)
        out = write_group<exactly, 2>(out, form, columns, i, vertex, scale, good, last);
      out[-1] = '\n';
    }
    if (_mm256_movemask_pd(good) != 0xf) break;
    *out++ = '\n';
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(out - begin);
  }
  return part;
}

/// Exactly from the first tie on: where there is one, others follow.
template <std::size_t group_count>
FixedTextPart write_columns_of(const ConstFixedColumns& columns, int decimals, char* out) {
  const FixedTextPart part = write_groups<false, group_count>(0, columns, decimals, out);
  if (part.triangle_count == columns.triangle_count()) return part;
  const FixedTextPart rest =
      write_groups<true, group_count>(part.triangle_count, columns, decimals, out + part.length);
  return {part.triangle_count + rest.triangle_count, part.length + rest.length};
}

FixedTextPart write_columns(const ConstFixedColumns& columns, int decimals, char* out) {
  switch (columns.group_count()) {
    case 1:
      return write_columns_of<1>(columns, decimals, out);
    case 2:
      return write_columns_of<2>(columns, decimals, out);
    default:
      return write_columns_of<3>(columns, decimals, out);
  }
}

}  // namespace

constinit const WriteFixedText kWriteFixedTextAvx2 = write_fixed_text;
constinit const WriteFixedColumns kWriteFixedColumnsAvx2 = write_columns;

bool processor_has_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("fma");
}

}  // namespace pipeline

#endif
