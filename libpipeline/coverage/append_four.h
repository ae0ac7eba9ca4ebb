#pragma once

#include "libpipeline/coverage/four_doubles.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <array>
#include <cstddef>

#include "libpipeline/coverage/four_spans.h"
#include "libpipeline/coverage/kernel.h"

namespace pipeline {

// The loops of every kernel that prepares four triangles at a time, and then works on a row of each or, where
// one of them is tall or not ordinary, on one triangle after the other, four rows at a time.
//
// `Rule` is the part in which kernels differ:
//   rows(triangle)                 the rows of one triangle, by its coverage rule;
//   four(triangles, range)         four triangles prepared for their rows in `range`: `sources`, begin_row,
//                                  end_row(), and the lanes that are `ordinary`;
//   four_rows(sources, rows)       a row of each of four triangles, or four rows of one: `spans`,
//                                  set_depths(), and the lanes that are ordinary(), unless all are;
//   slope(four, lane, rows, row)   the slope of the depth in lane `row` of `rows`, for the triangle in `lane`
//                                  of `four`;
//   axis()                         left_x and dx of all depths.
// Lanes that are not ordinary are left to rows().

constexpr std::size_t kFour = 4;

/// One bit for each of four lanes.
struct LaneSet {
  [[nodiscard]] bool has(std::size_t lane) const { return (bits >> lane & 1) != 0; }
  [[nodiscard]] bool has_all() const { return bits == kAll; }

  static constexpr int kAll = (1 << kFour) - 1;
  int bits = kAll;
};

/// Appends the spans of one of four triangles: four rows at a time.
template <typename Rule, typename FourTriangles>
PIPELINE_AVX2 TaggedSpan* append_triangle(const Rule& rule, const FourTriangles& four, std::size_t lane,
                                          const TaggedTriangle& triangle, const RowRange& range,
                                          TaggedSpan* spans) {
  if (!four.ordinary.has(lane)) return append_spans(rule.rows(triangle), triangle.tag, range, spans);
  const auto sources = four.sources.of(lane);
  const __m128d axis = rule.axis();
  const int end = static_cast<int>(four.end_row()[lane]);
  for (int row = static_cast<int>(four.begin_row[lane]); row < end;) {
    auto rows = rule.four_rows(sources, all(row) + _mm256_setr_pd(0, 1, 2, 3));
    rows.set_depths(sources);
    for (std::size_t i = 0; i < kFour && row < end; ++i, ++row) {
      if constexpr (requires { rows.ordinary(); })
        if (!rows.ordinary().has(i)) {
          spans = append_spans(rule.rows(triangle), triangle.tag, {row, row + 1}, spans);
          continue;
        }
      spans = rows.spans.append(i, axis, rule.slope(four, lane, rows, i), triangle.tag, spans);
    }
  }
  return spans;
}

/// Appends the spans of four triangles: a row of each at a time, because short ones have too few rows to fill
/// four lanes.
template <typename Rule, typename FourTriangles>
PIPELINE_AVX2 TaggedSpan* append_triangles(const Rule& rule, const FourTriangles& four,
                                           const TaggedTriangle* triangles, const RowRange& range,
                                           TaggedSpan* spans) {
  constexpr int kMaxLowRows = 8;
  const double most = largest_of(four.end_row() - four.begin_row);
  bool are_ordinary = four.ordinary.has_all() && most <= kMaxLowRows;
  const int count = are_ordinary ? static_cast<int>(most) : 0;
  std::array<typename Rule::FourRows, kMaxLowRows> low;
  // Separate loops: a processor can look ahead beyond the current iteration if iterations are short.
  for (int i = 0; i < count; ++i) {
    auto& rows = low[static_cast<std::size_t>(i)];
    rows = rule.four_rows(four.sources, four.begin_row + all(i));
    if constexpr (requires { rows.ordinary(); }) are_ordinary &= rows.ordinary().has_all();
  }
  if (!are_ordinary) {
    for (std::size_t lane = 0; lane < kFour; ++lane)
      spans = append_triangle(rule, four, lane, triangles[lane], range, spans);
    return spans;
  }
  for (int i = 0; i < count; ++i) low[static_cast<std::size_t>(i)].set_depths(four.sources);
  // The same number of rows of each, covered or not: how many are covered is unpredictable.
  const __m128d axis = rule.axis();
  for (std::size_t lane = 0; lane < kFour; ++lane) {
    const PixelTag tag = triangles[lane].tag;
    for (int i = 0; i < count; ++i) {
      const auto& rows = low[static_cast<std::size_t>(i)];
      spans = rows.spans.append(lane, axis, rule.slope(four, lane, rows, lane), tag, spans);
    }
  }
  return spans;
}

/// A function of a CoverageKernel: appends the spans of all triangles.
template <typename Rule>
PIPELINE_AVX2 TaggedSpan* append_four_by_four(const Rule& rule, std::span<const TaggedTriangle> triangles,
                                              const RowRange& range, TaggedSpan* spans) {
  for (; triangles.size() >= kFour; triangles = triangles.subspan(kFour))
    spans = append_triangles(rule, rule.four(triangles.data(), range), triangles.data(), range, spans);
  for (const TaggedTriangle& triangle : triangles)
    spans = append_spans(rule.rows(triangle), triangle.tag, range, spans);
  return spans;
}

}  // namespace pipeline

#endif
