#include "libpipeline/visibility/scanline.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/numbers/random_numbers.h"
#include "tests/visibility/visible_frames.h"

namespace pipeline {
namespace {

using Picture = std::vector<std::string>;

// Pixels of size 1, centers at -3.5, -2.5 ... 3.5 in x and y: all small halves are exact.
constexpr Viewport kEightByFour = {8, 4, -4, -2, 0, 2};

/// The visible triangles as letters: a is the first triangle, a dot the background.
template <typename Coverage = CenterCoverage, typename Depth = DepthF64>
Picture picture_of(const Scene& scene, const Viewport& screen = kEightByFour) {
  const Frame frame = scanline_frame<Coverage, Depth>(scene, screen);
  Picture picture(static_cast<std::size_t>(screen.rows));
  for (std::size_t i = 0; i < frame.tags.size(); ++i)
    picture[i / static_cast<std::size_t>(screen.columns)] +=
        frame.tags[i] == 0 ? '.' : static_cast<char>('a' + static_cast<int>(frame.tags[i]) - 1);
  return picture;
}

TEST(Scanline, WithoutTrianglesThereIsTheBackground) {
  const Scanline<NearestCoverage, DepthF64> scanline(kEightByFour, PixelTag{0x010203});
  int row_count = 0;
  scanline.for_each_row([&](const VisibleRow& row) {
    ++row_count;
    EXPECT_EQ(std::vector<double>(row.depths.begin(), row.depths.end()), std::vector<double>(8, 2));
    EXPECT_EQ(std::vector<PixelTag>(row.tags.begin(), row.tags.end()),
              std::vector<PixelTag>(8, PixelTag{0x010203}));
  });
  EXPECT_EQ(row_count, 4);
}

TEST(Scanline, TheTextbooksTwoPolygons) {
  // Foley et al., figure 15.34: two triangles; the nearer one overlaps the other on some scanlines only.
  EXPECT_EQ(
      picture_of({{{{-4, -2, 1}, {0, 2, 1}, {1, -2, 1}}}, {{{-1, -2, 0.5}, {4, -2, 0.5}, {2, 0.5, 0.5}}}}),
      (Picture{
          "...a....",
          "..aa....",
          ".aaaabb.",
          "aaaabbbb",
      }));
}

TEST(Scanline, DepthsThatAFloatCannotTellApartAreEqualAlsoOnPlanesThatBeginFarAway) {
  // The depth at x is 1 + x / 2000; a float next to 1 has steps of 6 * 10^-8.
  const auto plane = [](double nearer) {
    return Triangle{Vec3{-1000, -10, 0.5 - nearer}, Vec3{-1000, 10, 0.5 - nearer},
                    Vec3{1000, 0, 1.5 - nearer}};
  };
  const Picture first(4, "aaaaaaaa"), second(4, "bbbbbbbb");
  EXPECT_EQ((picture_of<NearestCoverage, DepthF32>({plane(0), plane(1e-9)})), first);
  EXPECT_EQ((picture_of<NearestCoverage, DepthF32>({plane(0), plane(1e-6)})), second);
  EXPECT_EQ((picture_of<NearestCoverage, DepthF64>({plane(0), plane(1e-9)})), second);
}

// Triangles so large that each has one interval covering the whole row, on every row of the screen.
Triangle half_plane(double z, double slope) {
  const auto corner = [&](double x, double y) { return Vec3{x, y, z + slope * x}; };
  return {corner(-100, -100), corner(100, -100), corner(0, 200)};
}

/// Coplanar triangles without a common vertex: each has its own rounded depths, and now one is smaller, now
/// the other.
Scene coplanar_pair() {
  const auto on_plane = [](double x, double y) { return Vec3{x, y, 0.9 + 0.0123 * x + 0.0456 * y}; };
  return {{on_plane(-0.913, -0.977), on_plane(0.931, -0.853), on_plane(0.117, 0.971)},
          {on_plane(-0.871, 0.911), on_plane(0.953, 0.819), on_plane(-0.073, -0.983)}};
}

TEST(Scanline, CoplanarTrianglesWhoseRoundedDepthsAlternateAreComparedPixelByPixel) {
  constexpr Viewport kSixty = {60, 60, -1, -1, 0, 2};
  const Frame frame = scanline_frame<NearestCoverage, DepthF64>(coplanar_pair(), kSixty);
  EXPECT_TRUE(frame == (zbuffer_frame<NearestCoverage, DepthF64>(coplanar_pair(), kSixty)));
  // The scene is a real trap: within one row the owner changes many times.
  int most_changes = 0;
  for (std::size_t row = 0; row < 60; ++row) {
    int changes = 0;
    for (std::size_t i = 60 * row + 1; i < 60 * row + 60; ++i) changes += frame.tags[i] != frame.tags[i - 1];
    most_changes = std::max(most_changes, changes);
  }
  EXPECT_GE(most_changes, 8);
}

TEST(Scanline, DepthsThatAreStoredAsEqualAreEqual) {
  // 2^-18 is 32 steps of 24 bits on a scale from 0 to 2, 2^-27 is 1/16 of one.
  const Scene farther_first = {half_plane(1 + 0x1p-18, 0.01), half_plane(1, 0.01)};
  EXPECT_EQ((picture_of<CenterCoverage, DepthF64>(farther_first)), Picture(4, "bbbbbbbb"));
  EXPECT_EQ((picture_of<CenterCoverage, DepthU24>(farther_first)), Picture(4, "bbbbbbbb"));
  for (const Viewport& screen : {Viewport{1000, 2, -4, -2, 0, 2}, Viewport{999, 2, -4, -2, 0, 3}}) {
    const Scene scene = {half_plane(1 + 0x1p-27, 0.01), half_plane(1, 0.01)};
    EXPECT_TRUE((scanline_frame<CenterCoverage, DepthU24>(scene, screen) ==
                 zbuffer_frame<CenterCoverage, DepthU24>(scene, screen)));
    EXPECT_TRUE((scanline_frame<CenterCoverage, DepthF32>(scene, screen) ==
                 zbuffer_frame<CenterCoverage, DepthF32>(scene, screen)));
  }
}

TEST(Scanline, KeepsTheDigitsThatDoublesDoNotHold) {
  // A vertex within 1e-20 of a center, to the left or to the right.
  for (const double low_part : {-1e-20, 1e-20}) {
    const Triangle triangle = {{{0.5, -3, 1}, {3, -3, 1}, {0.5, 3, 1}}};
    Triangle low_parts = {};
    low_parts[0].x = low_parts[2].x = low_part;
    Scanline<CenterCoverage, DepthF64> scanline(kEightByFour);
    scanline.draw({triangle, &low_parts, 0}, tag_of(0));
    Frame frame;
    scanline.for_each_row([&](const VisibleRow& row) { frame.add(row); });
    ZBufferAlgorithm<CenterCoverage, DepthF64> buffer(kEightByFour);
    buffer.draw({triangle, &low_parts, 0}, tag_of(0));
    Frame expected;
    buffer.for_each_row([&](const VisibleRow& row) { expected.add(row); });
    EXPECT_TRUE(frame == expected);
  }
}

TEST(Scanline, RowsCanBeAskedForTwice) {
  Scanline<NearestCoverage, DepthF64> scanline(kEightByFour);
  scanline.draw({half_plane(1, 0.25)}, tag_of(0));
  Frame first, second;
  scanline.for_each_row([&](const VisibleRow& row) { first.add(row); });
  scanline.for_each_row([&](const VisibleRow& row) { second.add(row); });
  EXPECT_TRUE(first == second);
}

}  // namespace
}  // namespace pipeline
