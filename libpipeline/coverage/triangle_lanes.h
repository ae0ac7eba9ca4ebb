// No include guard: included once for each target, see numbers/vector_targets.h.

#include <array>
#include <cstddef>
#include <cstring>

#include "libpipeline/coverage/exact_grid.h"
// AVX-512 would convert masks to vectors and back all the time, and take up to a tenth longer.
#ifdef PIPELINE_ALL_KERNELS
#define PIPELINE_TARGETS (HWY_SCALAR | HWY_NEON | HWY_WASM | HWY_SSE4 | HWY_AVX2)
#else
#define PIPELINE_TARGETS (HWY_SCALAR | HWY_NEON | HWY_WASM | HWY_AVX2)
#endif
#include "libpipeline/numbers/lanes.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET != HWY_SCALAR

/// Loads numbers `i` and `i` + 1 of each of some triangles.
HWY_INLINE void load_two(const TaggedTriangle* triangles, std::size_t i, Doubles& first, Doubles& second) {
  static_assert(sizeof(Triangle) == 9 * sizeof(double));
  constexpr hn::FixedTag<double, 2> kTwo;
  const auto two = [&](std::size_t lane)
                       HWY_ATTR { return hn::LoadU(kTwo, &triangles[lane].triangle.p_ndc[0].x + i); };
#if HWY_TARGET == HWY_AVX2
  const Doubles even = hn::Combine(kDoubles, two(2), two(0)), odd = hn::Combine(kDoubles, two(3), two(1));
#else
  const Doubles even = two(0), odd = two(1);
#endif
  first = hn::InterleaveLower(kDoubles, even, odd);
  second = hn::InterleaveUpper(kDoubles, even, odd);
}

/// The vertices of some triangles.
HWY_INLINE std::array<Vectors, 3> vertices_of(const TaggedTriangle* triangles) {
  std::array<Vectors, 3> result;
  load_two(triangles, 0, result[0].x, result[0].y);
  load_two(triangles, 2, result[0].z, result[1].x);
  load_two(triangles, 4, result[1].y, result[1].z);
  load_two(triangles, 6, result[2].x, result[2].y);
  load_two(triangles, 7, result[2].y, result[2].z);
  return result;
}

/// left_x and dx of a depth.
using Axis = std::array<double, 2>;

/// A struct of Doubles and Masks alone, with the numbers of one lane in all lanes. With bit_cast, GCC 12
/// would copy the struct twice.
template <typename Lanes>
HWY_INLINE Lanes lane_of(const Lanes& some, std::size_t lane) {
  Lanes result;
  const char* const from = reinterpret_cast<const char*>(&some) + lane * sizeof(double);
#pragma GCC unroll 32
  for (std::size_t i = 0; i < sizeof(Lanes); i += sizeof(Doubles)) {
    double number;
    std::memcpy(&number, from + i, sizeof number);
    const Doubles in_all = all(number);
    std::memcpy(reinterpret_cast<char*>(&result) + i, &in_all, sizeof in_all);
  }
  return result;
}

/// The spans that a kernel finds in its lanes.
class LaneSpans {
 public:
  /// Sets the columns; a lane has a span if its last column is not before the first.
  HWY_INLINE void set_columns(Doubles row, Doubles first, Doubles last) {
    constexpr hn::Rebind<int, decltype(kDoubles)> kInts;
    const auto firsts = hn::DemoteTo(kInts, first), lasts = hn::DemoteTo(kInts, last);
    const auto steps = hn::IfThenZeroElse(hn::Gt(firsts, lasts), hn::Set(kInts, sizeof(TaggedSpan)));
    hn::StoreInterleaved4(hn::DemoteTo(kInts, row), firsts, lasts, steps, kInts, columns_[0].data());
  }
  /// Sets the points where depths are known.
  HWY_INLINE void set_points(Doubles x0, Doubles z0) {
    hn::StoreInterleaved2(x0, z0, kDoubles, points_[0].data());
  }

  /// Writes a lane's span to `spans`; returns the place of the next, `spans` again if this one has no pixel.
  /// `axis` is left_x and dx of its depth. Branch-free: whether it has a pixel is unpredictable.
  HWY_INLINE TaggedSpan* append(std::size_t lane, const Axis& axis, double slope, PixelTag tag,
                                TaggedSpan* spans) const {
    // A depth is five doubles; the fourth number, the size, is not part of a span.
    static_assert(offsetof(Span, depth) == sizeof columns_[lane] && sizeof(SpanDepth) == 5 * sizeof(double));
    Span& span = spans->span;
    std::memcpy(static_cast<void*>(&span), &columns_[lane], sizeof columns_[lane]);
    std::memcpy(&span.depth.left_x, &axis, sizeof axis);
    std::memcpy(&span.depth.x0, &points_[lane], sizeof points_[lane]);
    span.depth.slope = slope;
    spans->tag = tag;
    return reinterpret_cast<TaggedSpan*>(reinterpret_cast<char*>(spans) + columns_[lane][3]);
  }

 private:
  // Row, first and last column, and the size of a span if there is one, else 0.
  alignas(16) std::array<std::array<int, 4>, kLanes> columns_;
  alignas(16) std::array<std::array<double, 2>, kLanes> points_;
};

// The loops of the kernels: they prepare some triangles at a time, and then work on a row of each or, if one
// of them is tall or not ordinary, on one triangle after the other, several rows at a time.
//
// `Rule` is the part in which kernels differ:
//   rows(triangle)                 the rows of one triangle, by its coverage rule;
//   prepared(triangles, range)     some triangles prepared for their rows in `range`: `sources`, begin_row,
//                                  end_row(), and the lanes that are `ordinary`;
//   some_rows(sources, rows)       a row of each of some triangles, or some rows of one: `spans`,
//                                  set_depths(), and the lanes that are ordinary();
//   slope(some, lane, rows, row)   the slope of the depth in lane `row` of `rows`, for the triangle in `lane`
//                                  of `some`;
//   axis()                         left_x and dx of all depths.
// Lanes that are not ordinary are left to rows().

/// A set of lanes, one bit each.
struct LaneSet {
  [[nodiscard]] bool has(std::size_t lane) const { return (bits >> lane & 1) != 0; }
  [[nodiscard]] bool has_all() const { return bits == kAll; }

  static constexpr unsigned kAll = (1u << kLanes) - 1;
  unsigned bits = kAll;
};

/// Appends the spans of one of some triangles, several rows at a time. Not inlined, so that its caller is.
template <typename Rule, typename TriangleLanes>
[[gnu::noinline]] TaggedSpan* append_triangle(const Rule& rule, const TriangleLanes& some, std::size_t lane,
                                              const TaggedTriangle& triangle, const RowRange& range,
                                              TaggedSpan* spans) {
  if (!some.ordinary.has(lane)) return append_spans(rule.rows(triangle), triangle.tag, range, spans);
  const auto sources = lane_of(some.sources, lane);
  const Axis axis = rule.axis();
  const int end = static_cast<int>(number_in(some.end_row(), lane));
  for (int row = static_cast<int>(number_in(some.begin_row, lane)); row < end;) {
    auto rows = rule.some_rows(sources, hn::Iota(kDoubles, row));
    rows.set_depths(sources);
    for (std::size_t i = 0; i < kLanes && row < end; ++i, ++row) {
      if (!rows.ordinary().has(i)) {
        spans = append_spans(rule.rows(triangle), triangle.tag, {row, row + 1}, spans);
        continue;
      }
      spans = rows.spans.append(i, axis, rule.slope(some, lane, rows, i), triangle.tag, spans);
    }
  }
  return spans;
}

/// Appends the spans of some triangles, a row of each at a time: short triangles have too few rows to fill
/// the lanes.
template <typename Rule, typename TriangleLanes>
TaggedSpan* append_triangles(const Rule& rule, const TriangleLanes& some, const TaggedTriangle* triangles,
                             const RowRange& range, TaggedSpan* spans) {
  constexpr int kMaxLowRows = 8;
  const double most = hn::GetLane(hn::MaxOfLanes(kDoubles, some.end_row() - some.begin_row));
  bool are_ordinary = some.ordinary.has_all() && most <= kMaxLowRows;
  const int count = are_ordinary ? static_cast<int>(most) : 0;
  std::array<typename Rule::RowLanes, kMaxLowRows> low;
  // Separate loops: if iterations are short, a processor can look ahead to the next ones.
  for (int i = 0; i < count; ++i) {
    auto& rows = low[static_cast<std::size_t>(i)];
    rows = rule.some_rows(some.sources, some.begin_row + all(i));
    are_ordinary &= rows.ordinary().has_all();
  }
  if (!are_ordinary) {
    for (std::size_t lane = 0; lane < kLanes; ++lane)
      spans = append_triangle(rule, some, lane, triangles[lane], range, spans);
    return spans;
  }
  for (int i = 0; i < count; ++i) low[static_cast<std::size_t>(i)].set_depths(some.sources);
  // The same count of rows for each, covered or not: the count of covered rows is unpredictable.
  const Axis axis = rule.axis();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const PixelTag tag = triangles[lane].tag;
    for (int i = 0; i < count; ++i) {
      const auto& rows = low[static_cast<std::size_t>(i)];
      spans = rows.spans.append(lane, axis, rule.slope(some, lane, rows, lane), tag, spans);
    }
  }
  return spans;
}

#endif

PIPELINE_END_KERNELS();
