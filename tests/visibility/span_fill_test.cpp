#include "libpipeline/visibility/span_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "tests/numbers/testable_targets.h"

namespace pipeline {
namespace {

// Ten blocks of pixels and a part of one.
constexpr int kColumns = 10 * kBlockColumns + 13;
constexpr Viewport kOneRow = {kColumns, 1, -1, -1, 0.25, 0.75};

/// Every claim is tested with every depth format and every kernel for it that this processor can run.
template <typename Depth>
class SpanFillTest : public testing::Test {
 protected:
  template <typename Expect>
  void for_each_kernel(const Expect& expect) const {
    const auto& kernels = span_fill_kernels<Depth>();
    for (const std::size_t target : testable_targets(kernels)) {
      SCOPED_TRACE(kTargets[target]);
      expect(kernels[target]);
    }
  }
};
template <typename List>
struct TestedTypesOf;
template <typename... Formats>
struct TestedTypesOf<TypeList<Formats...>> {
  using Types = testing::Types<Formats...>;
};
struct NameOfFormat {
  template <typename Depth>
  static std::string GetName(int) {
    return std::string(Depth::kName);
  }
};
TYPED_TEST_SUITE(SpanFillTest, TestedTypesOf<DepthFormats>::Types, NameOfFormat);

template <typename Depth>
struct PixelRow {
  // Behind its pixels are those of the next row, as in a z-buffer.
  explicit PixelRow(const Depth& format)
      : depths(2 * kColumns, format.store(kOneRow.rear)), tags(2 * kColumns) {}

  std::vector<typename Depth::Stored> depths;
  std::vector<PixelTag> tags;

  friend bool operator==(const PixelRow&, const PixelRow&) = default;
};

/// The effect of a span on a row, pixel by pixel.
template <typename Depth>
void draw_slowly(PixelRow<Depth>& row, const Span& span, PixelTag tag, const Depth& format) {
  for (int column = span.first_column; column <= span.last_column; ++column) {
    const auto i = static_cast<std::size_t>(column);
    const auto stored = format.store(span.depth(column));
    if (stored >= row.depths[i]) continue;
    row.depths[i] = stored;
    row.tags[i] = tag;
  }
}

template <typename Depth>
void draw_with(FillSpan<Depth> kernel, PixelRow<Depth>& row, const Span& span, PixelTag tag,
               const Depth& format, typename Depth::Stored* farthest = nullptr) {
  kernel(SpanFill<Depth>{span, tag, format, kColumns, row.depths.data(), row.tags.data(), farthest});
}

/// Spans of every length from every column, with depths that tie, cross the limits, or are not finite.
template <typename Depth>
void expect_pixels_of_a_loop(FillSpan<Depth> kernel) {
  const Depth format(kOneRow);
  PixelRow<Depth> expected(format), found(format);
  std::mt19937_64 random(1);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  std::uint32_t number = 0;
  for (int first = 0; first < 41; ++first) {
    for (int last = first; last < 41; ++last) {
      const double slope = between(0, 50) == 0 ? 1e308 : between(-8, 8) / 3000.0;
      const Span span = {0, first, last, {0.1, 0.1, between(0, 9) * 0.5, between(0, 64) / 64.0, slope}};
      const PixelTag tag = ++number;
      draw_slowly(expected, span, tag, format);
      draw_with(kernel, found, span, tag, format);
      ASSERT_TRUE(found == expected) << "columns " << first << " to " << last;
      if (number % 100 == 0) found = expected = PixelRow<Depth>(format);
    }
  }
}

/// Depths along a row that could break a bound: layers that differ by an ulp or not at all, slopes smaller
/// than rounding, and slopes so large that depths are not finite.
class RandomSpans {
 public:
  explicit RandomSpans(std::uint64_t seed) : random_(seed) {}

  Span next() {
    const int a = between(0, kColumns - 1), b = between(0, kColumns - 1);
    Span span = {0, std::min(a, b), std::max(a, b), {}};
    if (between(0, 2) == 0) span.first_column = 0, span.last_column = kColumns - 1;
    // In NDC, as from the coverage rule nearest, or in half columns from the middle, as from center.
    const double middle = span.first_column + span.last_column;
    if (between(0, 1) == 0)
      span.depth = {-1 + 1.0 / kColumns, 2.0 / kColumns, between(-9, 9) / 9.0, 0, 0};
    else
      span.depth = {0, 2, middle, 0, 0};
    span.depth.z0 = 0.5 + between(-3, 3) * 0x1p-53 + between(-1, 1) * between(0, 20) * 0x1p-24;
    constexpr std::array<double, 8> kSlopes = {0, 0x1p-60, 1e-18, 0x1p-53, 1e-9, 1e-4, 0.3, 1e308};
    span.depth.slope = between(-1, 1) * kSlopes[static_cast<std::size_t>(between(0, 7))];
    return span;
  }
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

 private:
  std::mt19937_64 random_;
};

template <typename Depth>
void expect_blocks_to_change_nothing(FillSpan<Depth> kernel) {
  const Depth format(kOneRow);
  RandomSpans spans(2);
  for (int picture = 0; picture < 400; ++picture) {
    PixelRow<Depth> expected(format), found(format);
    HierarchicalDepth<Depth> farthest({0, 1}, kColumns);
    for (std::uint32_t number = 1; number <= 40; ++number) {
      const Span span = spans.next();
      const PixelTag tag = number;
      draw_slowly(expected, span, tag, format);
      draw_with(kernel, found, span, tag, format, farthest.row(0));
      ASSERT_TRUE(found == expected) << "picture " << picture << ", span " << number;
      for (int column = 0; column < kColumns; ++column)
        ASSERT_LE(found.depths[static_cast<std::size_t>(column)], farthest.row(0)[column / kBlockColumns]);
    }
  }
}

/// A block is skipped as soon as its farthest pixel is nearer: the bound must be not only true but tight.
template <typename Depth>
void expect_to_learn_the_farthest_depth(FillSpan<Depth> kernel) {
  const Depth format(kOneRow);
  PixelRow<Depth> row(format);
  HierarchicalDepth<Depth> farthest({0, 1}, kColumns);
  const auto draw = [&](int first, int last, double z) {
    draw_with(kernel, row, {0, first, last, {0, 1, 0, z, 0}}, PixelTag(), format, farthest.row(0));
  };
  const auto farthest_of_block = [&](int block) { return farthest.row(0)[block]; };
  draw(0, kColumns - 1, 0.625);
  for (int block = 0; block <= 10; ++block) EXPECT_EQ(farthest_of_block(block), format.store(0.625));
  draw(10, kColumns - 1, 0.5);
  draw(0, kColumns - 1, 0.5625);   // visible in the first ten columns, the others are nearer
  draw(0, kColumns - 1, 0.59375);  // visible nowhere
  EXPECT_EQ(farthest_of_block(0), format.store(0.5625));
  for (int block = 1; block <= 10; ++block) EXPECT_EQ(farthest_of_block(block), format.store(0.5));
  draw(0, kBlockColumns - 1, 0.375);
  EXPECT_EQ(farthest_of_block(0), format.store(0.375));
  // The last block ends with the row.
  draw(10 * kBlockColumns, 10 * kBlockColumns + 4, 0.375);
  draw(10 * kBlockColumns + 5, kColumns - 1, 0.4375);
  draw(10 * kBlockColumns, kColumns - 1, 0.46875);  // visible nowhere
  EXPECT_EQ(farthest_of_block(10), format.store(0.4375));
}

TYPED_TEST(SpanFillTest, DrawsThePixelsOfALoop) {
  this->for_each_kernel(expect_pixels_of_a_loop<TypeParam>);
}
TYPED_TEST(SpanFillTest, HiddenBlocksArePassedOverAndNoOthers) {
  this->for_each_kernel(expect_blocks_to_change_nothing<TypeParam>);
}
TYPED_TEST(SpanFillTest, TellsTheFarthestOfABlock) {
  this->for_each_kernel(expect_to_learn_the_farthest_depth<TypeParam>);
}

}  // namespace
}  // namespace pipeline
