#include "libpipeline/scanline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "libpipeline/coverage.h"
#include "libpipeline/visibility.h"
#include "libpipeline/zbuffer.h"
#include "tests/random_numbers.h"

namespace pipeline {
namespace {

using Picture = std::vector<std::string>;
using Scene = std::vector<Triangle>;

// Pixels of size 1, centres at -3.5, -2.5 ... 3.5 in x and y: all small halves are exact.
constexpr ScreenConfig kEightByFour = {8, 4, -4, -2, 0, 2};
// The screens on which coordinates are decimals of at most 7 places; their doubles are read as such.
constexpr std::uint16_t kAllDecimals = 0x1ff;

/// The colour of triangle `index`: never black.
Color color_of(std::size_t index) {
  return Color::from_rgb(static_cast<std::uint32_t>(index + 1));
}

struct Frame {
  std::vector<double> depths;
  std::vector<std::uint32_t> colors;

  void add(const VisibleRow& row) {
    depths.insert(depths.end(), row.depths.begin(), row.depths.end());
    for (const Color color : row.colors) colors.push_back(color.rgb());
  }
  /// Bit by bit: 0 is not -0.
  friend bool operator==(const Frame& a, const Frame& b) {
    return a.colors == b.colors && a.depths.size() == b.depths.size() &&
           std::memcmp(a.depths.data(), b.depths.data(), a.depths.size() * sizeof(double)) == 0;
  }
};

template <typename Coverage, typename Depth>
Frame zbuffer_frame(const Scene& scene, const ScreenConfig& screen, std::uint16_t marks = kAllDecimals) {
  const Coverage coverage(screen);
  ZBuffer<Depth> buffer(screen);
  for (std::size_t i = 0; i < scene.size(); ++i)
    for_each_span(coverage.rows({scene[i], nullptr, marks}),
                  [&](const Span& span) { buffer.draw(span, color_of(i)); });
  Frame frame;
  buffer.for_each_row([&](const VisibleRow& row) { frame.add(row); });
  return frame;
}

template <typename Coverage, typename Depth>
Frame scanline_frame(const Scene& scene, const ScreenConfig& screen, std::uint16_t marks = kAllDecimals) {
  Scanline<Coverage, Depth> scanline(screen);
  for (std::size_t i = 0; i < scene.size(); ++i) scanline.draw({scene[i], nullptr, marks}, color_of(i));
  Frame frame;
  scanline.for_each_row([&](const VisibleRow& row) { frame.add(row); });
  return frame;
}

/// The visible triangles as letters: a is the first triangle, a dot the background.
template <typename Coverage = CenterCoverage, typename Depth = DepthF64>
Picture picture_of(const Scene& scene, const ScreenConfig& screen = kEightByFour) {
  const Frame frame = scanline_frame<Coverage, Depth>(scene, screen);
  Picture picture(static_cast<std::size_t>(screen.rows));
  for (std::size_t i = 0; i < frame.colors.size(); ++i)
    picture[i / static_cast<std::size_t>(screen.columns)] +=
        frame.colors[i] == 0 ? '.' : static_cast<char>('a' + static_cast<int>(frame.colors[i]) - 1);
  return picture;
}

/// A rectangle as two triangles, at the depth z + slope * x.
Scene rectangle(double left, double right, double bottom, double top, double z, double slope = 0) {
  const auto corner = [&](double x, double y) { return Vec3{x, y, z + slope * x}; };
  return {{corner(left, bottom), corner(right, bottom), corner(right, top)},
          {corner(left, bottom), corner(right, top), corner(left, top)}};
}

Scene operator+(Scene a, const Scene& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Scanline, WithoutTrianglesThereIsTheBackground) {
  const Scanline<NearestCoverage, DepthF64> scanline(kEightByFour, Color(1, 2, 3));
  int row_count = 0;
  scanline.for_each_row([&](const VisibleRow& row) {
    ++row_count;
    EXPECT_EQ(std::vector<double>(row.depths.begin(), row.depths.end()), std::vector<double>(8, 2));
    EXPECT_EQ(std::vector<Color>(row.colors.begin(), row.colors.end()),
              std::vector<Color>(8, Color(1, 2, 3)));
  });
  EXPECT_EQ(row_count, 4);
}

TEST(Scanline, TheTextbooksTwoPolygons) {
  // Foley et al., figure 15.34: two triangles, of which the nearer overlaps the other on some scanlines only.
  EXPECT_EQ(
      picture_of({{{{-4, -2, 1}, {0, 2, 1}, {1, -2, 1}}}, {{{-1, -2, 0.5}, {4, -2, 0.5}, {2, 0.5, 0.5}}}}),
      (Picture{
          "...a....",
          "..aa....",
          ".aaaabb.",
          "aaaabbbb",
      }));
}

TEST(Scanline, TheNearerTriangleIsSeenWhateverTheOrder) {
  // A centre on the diagonal belongs to the triangle on its right.
  const Scene near_scene = rectangle(-2, 2, -1, 1, 0.5), far_scene = rectangle(-4, 4, -2, 2, 1);
  EXPECT_EQ(picture_of(near_scene + far_scene), (Picture{
                                                    "dddddddc",
                                                    "ddbbbacc",
                                                    "ddbaaacc",
                                                    "dccccccc",
                                                }));
  EXPECT_EQ(picture_of(far_scene + near_scene), (Picture{
                                                    "bbbbbbba",
                                                    "bbdddcaa",
                                                    "bbdcccaa",
                                                    "baaaaaaa",
                                                }));
}

// Triangles so large that every row of the screen is one interval of each.
Triangle half_plane(double z, double slope) {
  const auto corner = [&](double x, double y) { return Vec3{x, y, z + slope * x}; };
  return {corner(-100, -100), corner(100, -100), corner(0, 200)};
}

TEST(Scanline, AnIntervalIsSplitWherePolygonsInterpenetrate) {
  // The depths are equal at x = 0.75, between two centres.
  EXPECT_EQ(picture_of({half_plane(1, 0.125), half_plane(1.1875, -0.125)}), Picture(4, "aaaaabbb"));
  EXPECT_EQ(picture_of({half_plane(1.1875, -0.125), half_plane(1, 0.125)}), Picture(4, "bbbbbaaa"));
}

TEST(Scanline, WhereTheyMeetAtACentreTheEarlierIsSeen) {
  // The depths are equal at x = 0.5, the centre of column 4.
  EXPECT_EQ(picture_of({half_plane(1, 0.125), half_plane(1.125, -0.125)}), Picture(4, "aaaaabbb"));
  EXPECT_EQ(picture_of({half_plane(1.125, -0.125), half_plane(1, 0.125)}), Picture(4, "bbbbaaaa"));
}

TEST(Scanline, ThreePolygonsCrossInOneInterval) {
  // b is below the crossing of a and c: 1 + x/8, 0.9, 1 - x/8.
  EXPECT_EQ(picture_of({half_plane(1, 0.125), half_plane(0.9, 0), half_plane(1, -0.125)}),
            Picture(4, "aaabbccc"));
}

TEST(Scanline, TrianglesThatInterpenetrateMeetInASlantedLine) {
  // z = 1 + x / 8 + y / 16 and its mirror image: equal where x = -y / 2.
  const auto plane = [](double sign) {
    const auto corner = [&](double x, double y) { return Vec3{x, y, 1 + sign * (x / 8 + y / 16)}; };
    return Triangle{corner(-100, -100), corner(100, -100), corner(0, 200)};
  };
  EXPECT_EQ(picture_of({plane(1), plane(-1)}), (Picture{
                                                   "aaabbbbb",
                                                   "aaaabbbb",
                                                   "aaaabbbb",
                                                   "aaaaabbb",
                                               }));
}

TEST(Scanline, OfEqualDepthsTheEarlierPolygonIsSeen) {
  const Scene pair = {half_plane(1, 0.125), half_plane(1, 0.125)};
  EXPECT_EQ(picture_of(pair), Picture(4, "aaaaaaaa"));
}

TEST(Scanline, APolygonEndsWhereTheNextBegins) {
  const Triangle left = {{{-4, -100, 1}, {-4, 100, 1}, {0, 0, 1}}};
  const Triangle right = {{{4, -100, 1}, {4, 100, 1}, {0, 0, 1}}};
  EXPECT_EQ(picture_of({left, right})[1], "aaaabbbb");
}

TEST(Scanline, APolygonBeginsAndEndsInTheColumnsOfAnother) {
  const Triangle triangle = {{{-2, -2, 1}, {-2, 2, 1}, {3, 0, 1}}};
  Triangle nearer = triangle, farther = triangle;
  for (Vec3& p : nearer) p.z = 0.5;
  for (Vec3& p : farther) p.z = 1.5;
  EXPECT_EQ(picture_of({farther, nearer, triangle}), (Picture{
                                                         "..b.....",
                                                         "..bbbb..",
                                                         "..bbbb..",
                                                         "..b.....",
                                                     }));
}

TEST(Scanline, SpansOfOnePixelAreSeen) {
  const auto needle = [](double x, double z) {
    return Triangle{{{x - 0.1, -3, z}, {x + 0.1, -3, z}, {x, 100, z}}};
  };
  EXPECT_EQ(picture_of(
                {needle(-0.5, 0.5), half_plane(1, 0), needle(1.5, 0.5), needle(2.5, 1.5), needle(1.5, 0.25)}),
            Picture(4, "bbbabebb"));
}

TEST(Scanline, TheFrontLimitIsSeenAndTheRearLimitIsNot) {
  EXPECT_EQ(picture_of({half_plane(0.625, 0.25)}), Picture(4, ".aaaaaaa"));  // 0 at column 1
  EXPECT_EQ(picture_of({half_plane(1.25, 0.5)}), Picture(4, ".aaaa..."));    // 0 at column 1, 2 at column 5
  EXPECT_EQ(picture_of({half_plane(0.75, -0.5)}), Picture(4, "..aaaa.."));   // 2 at column 1, 0 at column 5
  EXPECT_EQ(picture_of({half_plane(1, 8)}), Picture(4, "........"));         // never between them at a centre
}

TEST(Scanline, WhatIsInFrontOfTheFrontLimitHidesNothing) {
  EXPECT_EQ(picture_of({half_plane(-0.5, 0), half_plane(1, 0)}), Picture(4, "bbbbbbbb"));
  EXPECT_EQ(picture_of({half_plane(0, 0.5), half_plane(1.75, 0)}), Picture(4, "bbbbaaaa"));
}

/// Coplanar triangles share no vertex, so each has its own rounded depths, now one is below, now the other.
Scene coplanar_pair() {
  const auto on_plane = [](double x, double y) { return Vec3{x, y, 0.9 + 0.0123 * x + 0.0456 * y}; };
  return {{on_plane(-0.913, -0.977), on_plane(0.931, -0.853), on_plane(0.117, 0.971)},
          {on_plane(-0.871, 0.911), on_plane(0.953, 0.819), on_plane(-0.073, -0.983)}};
}

TEST(Scanline, CoplanarTrianglesWhoseRoundedDepthsAlternateAreComparedPixelByPixel) {
  constexpr ScreenConfig kSixty = {60, 60, -1, -1, 0, 2};
  const Frame frame = scanline_frame<NearestCoverage, DepthF64>(coplanar_pair(), kSixty);
  EXPECT_TRUE(frame == (zbuffer_frame<NearestCoverage, DepthF64>(coplanar_pair(), kSixty)));
  // It is a trap: inside one row the owner changes many times.
  int most_changes = 0;
  for (std::size_t row = 0; row < 60; ++row) {
    int changes = 0;
    for (std::size_t i = 60 * row + 1; i < 60 * row + 60; ++i)
      changes += frame.colors[i] != frame.colors[i - 1];
    most_changes = std::max(most_changes, changes);
  }
  EXPECT_GE(most_changes, 8);
}

TEST(Scanline, DepthsThatAreStoredAsEqualAreEqual) {
  // 2^-18 is 32 steps of 24 bits on a scale from 0 to 2, 2^-27 is 1/16 of one.
  const Scene farther_first = {half_plane(1 + 0x1p-18, 0.01), half_plane(1, 0.01)};
  EXPECT_EQ((picture_of<CenterCoverage, DepthF64>(farther_first)), Picture(4, "bbbbbbbb"));
  EXPECT_EQ((picture_of<CenterCoverage, DepthU24>(farther_first)), Picture(4, "bbbbbbbb"));
  for (const ScreenConfig screen :
       {ScreenConfig{1000, 2, -4, -2, 0, 2}, ScreenConfig{999, 2, -4, -2, 0, 3}}) {
    const Scene scene = {half_plane(1 + 0x1p-27, 0.01), half_plane(1, 0.01)};
    EXPECT_TRUE((scanline_frame<CenterCoverage, DepthU24>(scene, screen) ==
                 zbuffer_frame<CenterCoverage, DepthU24>(scene, screen)));
    EXPECT_TRUE((scanline_frame<CenterCoverage, DepthF32>(scene, screen) ==
                 zbuffer_frame<CenterCoverage, DepthF32>(scene, screen)));
  }
}

TEST(Scanline, KeepsTheDigitsThatDoublesDoNotHold) {
  // A vertex on a centre but for 1e-20, to the left or to the right.
  for (const double low_part : {-1e-20, 1e-20}) {
    const Triangle triangle = {{{0.5, -3, 1}, {3, -3, 1}, {0.5, 3, 1}}};
    Triangle low_parts = {};
    low_parts[0].x = low_parts[2].x = low_part;
    Scanline<CenterCoverage, DepthF64> scanline(kEightByFour);
    scanline.draw({triangle, &low_parts, 0}, color_of(0));
    Frame frame;
    scanline.for_each_row([&](const VisibleRow& row) { frame.add(row); });
    ZBufferAlgorithm<CenterCoverage, DepthF64> buffer(kEightByFour);
    buffer.draw({triangle, &low_parts, 0}, color_of(0));
    Frame expected;
    buffer.for_each_row([&](const VisibleRow& row) { expected.add(row); });
    EXPECT_TRUE(frame == expected);
  }
}

TEST(Scanline, RowsCanBeAskedForTwice) {
  Scanline<NearestCoverage, DepthF64> scanline(kEightByFour);
  scanline.draw({half_plane(1, 0.25)}, color_of(0));
  Frame first, second;
  scanline.for_each_row([&](const VisibleRow& row) { first.add(row); });
  scanline.for_each_row([&](const VisibleRow& row) { second.add(row); });
  EXPECT_TRUE(first == second);
}

/// The ends of a triangle's rows in doubles, either as the textbook finds them, x at an edge's first scanline
/// and then x += dx, or with x calculated anew on every scanline.
class RoundedRows {
 public:
  enum class X { by_increments, anew };

  RoundedRows(const PixelGrid& grid, const Triangle& p_ndc, X x)
      : grid_(grid), x_(x), columns_(static_cast<std::size_t>(grid.rows)) {
    for (std::size_t i = 0; i < 3; ++i) add_edge(p_ndc[i], p_ndc[(i + 1) % 3]);
  }

  /// How many of the row's two ends are not the span's.
  [[nodiscard]] int wrong_ends(const Span& span) const {
    const std::vector<double> found = ends(span.row);
    if (found.size() != 2) return 2;
    return static_cast<int>(found[0] != span.first_column) +
           static_cast<int>(found[1] != span.last_column + 1);
  }

  /// The first column and the one after the last, where two edges cross the row.
  [[nodiscard]] std::vector<double> ends(int row) const {
    std::vector<double> ends = columns_[static_cast<std::size_t>(row)];
    std::sort(ends.begin(), ends.end());
    for (double& end : ends) end = std::clamp(std::ceil(end), 0.0, 1.0 * grid_.columns);
    return ends;
  }
  void add_edge(Vec3 upper, Vec3 lower) {
    if (upper.y < lower.y) std::swap(upper, lower);
    const auto first_row_below = [&](double y) {
      return static_cast<int>(std::clamp(std::ceil((grid_.top_y - y) / grid_.dy), 0.0, 1.0 * grid_.rows));
    };
    const double slope = (lower.x - upper.x) / (lower.y - upper.y);
    const int first_row = first_row_below(upper.y), end_row = first_row_below(lower.y);
    const auto column_at = [&](int row) {
      return (upper.x + (grid_.y_of(row) - upper.y) * slope - grid_.left_x) / grid_.dx;
    };
    double column = column_at(first_row);
    for (int row = first_row; row < end_row; ++row, column -= slope * grid_.dy / grid_.dx)
      columns_[static_cast<std::size_t>(row)].push_back(x_ == X::anew ? column_at(row) : column);
  }

  PixelGrid grid_;
  X x_;
  std::vector<std::vector<double>> columns_;
};

TEST(Scanline, IncrementalXWouldGiveOtherColumns) {
  // Vertices with two decimals, as people write them, on 1000 rows.
  ScreenConfig screen = {1000, 1000, -1, -1, -1, 1};
  screen.left_is_decimal = screen.bottom_is_decimal = true;
  const CenterCoverage exact(screen);
  RandomNumbers random(1);
  int end_count = 0, wrong_by_increments = 0, wrong_anew = 0;
  for (int i = 0; i < 1000; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle) p = {random.whole(-100, 100) / 100.0, random.whole(-100, 100) / 100.0, 0};
    const RoundedRows by_increments(PixelGrid(screen), triangle, RoundedRows::X::by_increments);
    const RoundedRows anew(PixelGrid(screen), triangle, RoundedRows::X::anew);
    for_each_span(exact.rows({triangle, nullptr, kAllDecimals}), [&](const Span& span) {
      end_count += 2;
      wrong_by_increments += by_increments.wrong_ends(span);
      wrong_anew += anew.wrong_ends(span);
    });
  }
  EXPECT_EQ(end_count, 1020230);
  EXPECT_EQ(wrong_by_increments, 6816);
  EXPECT_EQ(wrong_anew, 4028);
}

/// Scenes that look for trouble: the same depths, shared edges, crossings, triangles without area, off the
/// screen, in front of and behind the limits, and coplanar ones.
class RandomScenes {
 public:
  explicit RandomScenes(std::uint64_t seed) : random_(seed) {}

  ScreenConfig screen() {
    ScreenConfig screen;
    screen.columns = random_.whole(0, 9) == 0 ? random_.whole(60, 200) : random_.whole(1, 24);
    screen.rows = random_.whole(1, 8);
    screen.left_is_decimal = screen.bottom_is_decimal = true;
    if (random_.whole(0, 3) == 0) {
      screen.front = -0.25;
      screen.rear = decimal(0.1, 0.5);
    }
    if (random_.whole(0, 49) == 0) {
      screen.front = -1e300;
      screen.rear = 1e300;
    }
    return screen;
  }

  Scene scene() {
    Scene scene;
    new_plane();
    depth_kind_ = random_.whole(0, 6);
    coordinate_kind_ = random_.whole(0, 3);
    const int count = random_.whole(0, 9) == 0 ? random_.whole(20, 60) : random_.whole(1, 9);
    while (static_cast<int>(scene.size()) < count) {
      if (random_.whole(0, 5) == 0) new_plane();
      Triangle triangle = {vertex(), vertex(), vertex()};
      switch (random_.whole(0, 9)) {
        case 0:
          triangle[2] = triangle[random_.bits() % 2];  // without area
          break;
        case 1:
          if (!scene.empty()) triangle = scene[random_.bits() % scene.size()];  // once more
          break;
        case 2:
        case 3:
        case 4:  // with a shared edge
          if (!scene.empty()) {
            const Triangle& neighbour = scene[random_.bits() % scene.size()];
            triangle[0] = neighbour[1];
            triangle[1] = neighbour[0];
          }
          break;
        default:
          break;
      }
      scene.push_back(triangle);
    }
    return scene;
  }

 private:
  double decimal(double low, double high) { return std::round(random_.between(low, high) * 1e7) / 1e7; }
  double coordinate() {
    const double size = random_.whole(0, 9) == 0 ? 20 : 1.3;
    switch (coordinate_kind_) {
      case 0:
        return random_.whole(-10, 10) / 8.0;
      case 1:
        return random_.whole(-13, 13) / 10.0;
      default:
        return decimal(-size, size);
    }
  }
  Vec3 vertex() {
    Vec3 p = {coordinate(), coordinate(), 0};
    p.z = depth_at(p);
    return p;
  }
  double depth_at(const Vec3& p) {
    switch (depth_kind_) {
      case 0:
        return 0.25;
      case 1:
        return random_.whole(-4, 4) / 4.0;
      case 2:
        return random_.whole(0, 30) == 0 ? random_.with_exponent(-40, 60) : decimal(-1.5, 1.5);
      case 3:  // nearly coplanar: to the last printed digit
        return decimal(0, 0) + std::round((plane_.z + plane_.x * p.x + plane_.y * p.y) * 1e7) / 1e7;
      case 4:
      case 5:  // coplanar, as far as doubles can be
        return plane_.z + plane_.x * p.x + plane_.y * p.y;
      default:
        return decimal(-1.2, 1.2);
    }
  }
  void new_plane() { plane_ = {decimal(-0.5, 0.5), decimal(-0.5, 0.5), decimal(-0.5, 0.5)}; }

  RandomNumbers random_;
  Vec3 plane_;
  int depth_kind_ = 0;
  int coordinate_kind_ = 0;
};

template <typename Coverage, typename Depth>
void expect_the_same(const Scene& scene, const ScreenConfig& screen, int number) {
  const Frame expected = zbuffer_frame<Coverage, Depth>(scene, screen);
  const Frame found = scanline_frame<Coverage, Depth>(scene, screen);
  ASSERT_TRUE(expected == found) << "scene " << number << ", " << scene.size() << " triangles, "
                                 << screen.columns << " x " << screen.rows << " pixels";
}

template <typename Coverage>
void expect_the_same_in_all_formats(const Scene& scene, const ScreenConfig& screen, int number) {
  expect_the_same<Coverage, DepthF64>(scene, screen, number);
  expect_the_same<Coverage, DepthF32>(scene, screen, number);
  expect_the_same<Coverage, DepthU24>(scene, screen, number);
}

void expect_the_same_in_random_scenes(int scene_count, std::uint64_t seed) {
  RandomScenes random(seed);
  for (int i = 0; i < scene_count; ++i) {
    const ScreenConfig screen = random.screen();
    const Scene scene = random.scene();
    expect_the_same_in_all_formats<NearestCoverage>(scene, screen, i);
    expect_the_same_in_all_formats<CenterCoverage>(scene, screen, i);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Scanline, RandomScenesAreTheZBuffers) {
  expect_the_same_in_random_scenes(1000, 1);
}

TEST(ScanlineLong, AHundredThousandRandomScenesAreTheZBuffers) {
  expect_the_same_in_random_scenes(100000, 2);
}

TEST(Scanline, AnOverdrawOfManyLayersIsTheZBuffers) {
  // Large triangles, many crossings.
  RandomNumbers random(3);
  Scene scene;
  for (int i = 0; i < 400; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.1, 1.1)};
    scene.push_back(triangle);
  }
  constexpr ScreenConfig kScreen = {300, 60, -1, -1, -1, 1};
  EXPECT_TRUE((scanline_frame<NearestCoverage, DepthF64>(scene, kScreen, 0) ==
               zbuffer_frame<NearestCoverage, DepthF64>(scene, kScreen, 0)));
  EXPECT_TRUE((scanline_frame<CenterCoverage, DepthU24>(scene, kScreen, 0) ==
               zbuffer_frame<CenterCoverage, DepthU24>(scene, kScreen, 0)));
}

}  // namespace
}  // namespace pipeline
