// The coverage rule `center` against a second implementation by another method: exact edge functions,
// evaluated at every pixel near the triangle, and the top-left rule as textbooks state it.

#include <gtest/gtest.h>

#include <functional>
#include <iostream>

#include "libpipeline/numbers/fixed_int.h"
#include "tests/coverage/center_reference.h"
#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

struct Screen {
  int columns;
  int rows;
  std::int64_t limit_x;  // in units of 10^-7, like all below
  std::int64_t limit_y;

  [[nodiscard]] Viewport config() const {
    return decimal_screen(columns, rows, -static_cast<double>(limit_x) / 1e7,
                          -static_cast<double>(limit_y) / 1e7);
  }
};

/// The edge function of a directed edge at pixel centers, in units that make all values integers; y points
/// up.
class EdgeFunction {
 public:
  EdgeFunction(const Screen& s, std::array<std::int64_t, 2> from, std::array<std::int64_t, 2> to)
      : screen_(s) {
    const Int128 w = s.columns, h = s.rows;
    dx_ = (to[0] - from[0]) * w;
    dy_ = (to[1] - from[1]) * h;
    from_x_ = from[0] * w;
    from_y_ = from[1] * h;
  }
  [[nodiscard]] Int128 at(int row, int column) const {
    const Int128 x = Int128{2 * column + 1 - screen_.columns} * screen_.limit_x;
    const Int128 y = Int128{screen_.rows - 1 - 2 * row} * screen_.limit_y;
    return dx_ * (y - from_y_) - dy_ * (x - from_x_);
  }
  /// For a counter-clockwise triangle: whether the edge is a top or a left edge.
  [[nodiscard]] bool owns_its_points() const { return dy_ < 0 || (dy_ == 0 && dx_ < 0); }
  [[nodiscard]] Int128 per_column() const { return -dy_ * 2 * screen_.limit_x; }

 private:
  Screen screen_;
  Int128 dx_, dy_, from_x_, from_y_;
};

/// The pixels of a row where all three functions accept; calls visit(column, is_inside).
struct Reference {
  Reference(const Screen& s, UnitTriangle t) {
    const EdgeFunction ab(s, t[0], t[1]);
    // Twice the area is the edge function at the third vertex, whose sign is the same for all points on its
    // side.
    const Int128 area =
        Int128{t[1][0] - t[0][0]} * (t[2][1] - t[0][1]) - Int128{t[2][0] - t[0][0]} * (t[1][1] - t[0][1]);
    has_area = area != 0;
    if (area < 0) std::swap(t[1], t[2]);
    edges = {EdgeFunction(s, t[0], t[1]), EdgeFunction(s, t[1], t[2]), EdgeFunction(s, t[2], t[0])};
  }
  bool has_area = false;
  std::vector<EdgeFunction> edges;
};

struct PixelBox {
  int first_row, last_row, first_column, last_column;
};

/// The pixels within two of the triangle's bounding box.
PixelBox box_around(const Screen& s, const UnitTriangle& t) {
  const auto [left, right] = std::minmax({t[0][0], t[1][0], t[2][0]});
  const auto [bottom, top] = std::minmax({t[0][1], t[1][1], t[2][1]});
  const auto column = [&](std::int64_t x) {
    return static_cast<int>((x + s.limit_x) * s.columns / (2 * s.limit_x));
  };
  const auto row = [&](std::int64_t y) {
    return static_cast<int>((s.limit_y - y) * s.rows / (2 * s.limit_y));
  };
  return {std::clamp(row(top) - 2, 0, s.rows - 1), std::clamp(row(bottom) + 2, 0, s.rows - 1),
          std::clamp(column(left) - 2, 0, s.columns - 1), std::clamp(column(right) + 2, 0, s.columns - 1)};
}

bool is_like_reference(const Screen& s, const UnitTriangle& t, const std::vector<Span>& spans) {
  const Reference reference(s, t);
  const PixelBox box = box_around(s, t);
  auto span = spans.begin();
  for (int row = box.first_row; row <= box.last_row; ++row) {
    std::array<Int128, 3> values, steps;
    std::array<Int128, 3> least;
    for (std::size_t i = 0; i < 3; ++i) {
      values[i] = reference.edges[i].at(row, box.first_column);
      steps[i] = reference.edges[i].per_column();
      least[i] = reference.edges[i].owns_its_points() ? 0 : 1;
    }
    const bool has_span = span != spans.end() && span->row == row;
    for (int column = box.first_column; column <= box.last_column; ++column) {
      const bool is_inside =
          reference.has_area && values[0] >= least[0] && values[1] >= least[1] && values[2] >= least[2];
      const bool is_covered = has_span && column >= span->first_column && column <= span->last_column;
      if (is_inside != is_covered) return false;
      for (std::size_t i = 0; i < 3; ++i) values[i] += steps[i];
    }
    if (!has_span) continue;
    if (span->first_column < box.first_column || span->last_column > box.last_column) return false;
    ++span;
  }
  return span == spans.end();
}

/// The same decision in doubles, to show that exactness is necessary.
bool is_wrong_in_doubles(const Screen& s, const UnitTriangle& units, const std::vector<Span>& spans) {
  const Viewport config = s.config();
  Triangle p = triangle_of(units).p;
  const auto edge = [](const Vec3& a, const Vec3& b, double x, double y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
  };
  if (edge(p[0], p[1], p[2].x, p[2].y) < 0) std::swap(p[1], p[2]);
  const auto accepts = [&](const Vec3& a, const Vec3& b, double x, double y) {
    const double value = edge(a, b, x, y);
    return value > 0 || (value == 0 && (b.y < a.y || (b.y == a.y && b.x < a.x)));
  };
  const PixelBox box = box_around(s, units);
  auto span = spans.begin();
  for (int row = box.first_row; row <= box.last_row; ++row) {
    const double y = config.top_y() - row * config.dy();
    const bool has_span = span != spans.end() && span->row == row;
    for (int column = box.first_column; column <= box.last_column; ++column) {
      const double x = config.left_x() + column * config.dx();
      const bool is_inside =
          accepts(p[0], p[1], x, y) && accepts(p[1], p[2], x, y) && accepts(p[2], p[0], x, y);
      if (is_inside != (has_span && column >= span->first_column && column <= span->last_column)) return true;
    }
    if (has_span) ++span;
  }
  return false;
}

constexpr std::array<Screen, 5> kScreens = {{
    {500, 500, 10'000'000, 10'000'000},
    {640, 480, 10'000'000, 7'500'000},
    {1023, 767, 10'000'000, 10'000'000},
    {333, 1001, 15'000'001, 9'999'999},
    {50, 50, 10'000'000, 10'000'000},
}};

using Family = std::function<UnitTriangle(RandomNumbers&, const Screen&)>;

/// A point on the screen, or slightly outside.
std::array<std::int64_t, 2> any_point(RandomNumbers& random, const Screen& s) {
  return {static_cast<std::int64_t>(random.between(-1.02, 1.02) * static_cast<double>(s.limit_x)),
          static_cast<std::int64_t>(random.between(-1.02, 1.02) * static_cast<double>(s.limit_y))};
}

std::array<double, 2> pixel_size(const Screen& s) {
  return {2 * static_cast<double>(s.limit_x) / s.columns, 2 * static_cast<double>(s.limit_y) / s.rows};
}

UnitTriangle about_ten_pixels(RandomNumbers& random, const Screen& s) {
  const auto center = any_point(random, s);
  const auto size = pixel_size(s);
  UnitTriangle t{};
  for (auto& p : t)
    for (std::size_t k = 0; k < 2; ++k)
      p[k] = center[k] + static_cast<std::int64_t>(random.between(-4.6, 4.6) * size[k]);
  return t;
}

UnitTriangle on_half_pixels(RandomNumbers& random, const Screen& s) {
  const auto size = pixel_size(s);
  const std::array<int, 2> counts = {s.columns, s.rows};
  UnitTriangle t{};
  std::array<int, 2> center = {random.whole(-counts[0], counts[0]), random.whole(-counts[1], counts[1])};
  for (auto& p : t)
    for (std::size_t k = 0; k < 2; ++k)
      p[k] = std::llround((center[k] + random.whole(-10, 10)) * size[k] / 2);
  return t;
}

/// Two vertices anywhere or on half pixels, the third next to the line through them.
UnitTriangle sliver(RandomNumbers& random, const Screen& s) {
  const auto size = pixel_size(s);
  UnitTriangle t = random.bits() % 2 == 0 ? about_ten_pixels(random, s) : on_half_pixels(random, s);
  const double along = random.bits() % 4 == 0 ? random.whole(-1, 3) / 2.0 : random.between(-0.1, 1.1);
  for (std::size_t k = 0; k < 2; ++k) {
    const double off = random.bits() % 2 == 0 ? random.between(-1e-2, 1e-2) * size[k] : random.whole(-2, 2);
    t[1][k] += 4 * (t[1][k] - t[0][k]);
    t[2][k] =
        std::llround(static_cast<double>(t[0][k]) + along * static_cast<double>(t[1][k] - t[0][k]) + off);
  }
  return t;
}

UnitTriangle on_hundredths(RandomNumbers& random, const Screen& s) {
  constexpr int kHundredth = 100'000;
  const auto center = any_point(random, s);
  UnitTriangle t{};
  for (auto& p : t)
    for (std::size_t k = 0; k < 2; ++k) p[k] = (center[k] / kHundredth + random.whole(-4, 4)) * kHundredth;
  return t;
}

void expect_like_reference(const char* name, const Family& family, int count, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<ExactGrid> grids;
  grids.reserve(kScreens.size());
  for (const Screen& s : kScreens) grids.emplace_back(s.config());
  long pixel_count = 0, wrong_in_doubles = 0;
  for (int i = 0; i < count; ++i) {
    const std::size_t k = static_cast<std::size_t>(i) % kScreens.size();
    const UnitTriangle units = family(random, kScreens[k]);
    const TextTriangle triangle = triangle_of(units);
    const std::vector<Span> spans = spans_of(CenterRows(grids[k], triangle.exact()));
    ASSERT_TRUE(is_like_reference(kScreens[k], units, spans)) << name << ", triangle " << i;
    for (const Span& span : spans) pixel_count += span.last_column - span.first_column + 1;
    if (is_wrong_in_doubles(kScreens[k], units, spans)) ++wrong_in_doubles;
  }
  std::cout << name << ": " << count << " triangles, " << pixel_count << " pixels; plain doubles get "
            << wrong_in_doubles << " triangles wrong ("
            << 100.0 * static_cast<double>(wrong_in_doubles) / count << " %)\n";
}

#define PIPELINE_FAMILY(Name, words, triangle, seed)               \
  TEST(CenterFamilies, Name) {                                     \
    expect_like_reference(words, triangle, 100'000, seed);         \
  }                                                                \
  TEST(CenterFamilies, Long##Name) {                               \
    expect_like_reference(words, triangle, 10'000'000, 10 + seed); \
  }

PIPELINE_FAMILY(AboutTenPixels, "about ten pixels", about_ten_pixels, 1)
PIPELINE_FAMILY(OnHalfPixels, "on half pixels", on_half_pixels, 2)
PIPELINE_FAMILY(Slivers, "slivers", sliver, 3)
PIPELINE_FAMILY(OnHundredths, "on hundredths", on_hundredths, 4)

}  // namespace
}  // namespace pipeline
