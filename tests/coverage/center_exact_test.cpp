// The coverage rule `center` and its depths against rational arithmetic (GMP), for numbers of every kind.

#include <gtest/gtest.h>

#include "tests/coverage/center_rational.h"
#include "tests/coverage/center_reference.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/worst_error.h"
#include "tests/sanitizer_rounds.h"

namespace pipeline {
namespace {

/// Compares every pixel of a small screen.
void expect_exact(const TextTriangle& t, const Viewport& screen) {
  const ExactCoverage exact(t, screen);
  const std::vector<Span> spans = spans_of(CenterRows(ExactGrid(screen), t.exact()));
  auto span = spans.begin();
  for (int row = 0; row < screen.rows; ++row) {
    const bool has_span = span != spans.end() && span->row == row;
    for (int column = 0; column < screen.columns; ++column) {
      const bool is_covered = has_span && column >= span->first_column && column <= span->last_column;
      ASSERT_EQ(is_covered, exact.covers(row, column)) << "row " << row << ", column " << column;
    }
    if (has_span) ++span;
  }
}

/// Compares depths at the ends and in the middle of some rows.
void expect_depths_within_bound(const TextTriangle& t, const Viewport& screen, WorstError& worst) {
  const ExactCoverage exact(t, screen);
  const mpq_class bound = exact.largest_depth() * mpq_class(0x1p-50);
  const std::vector<Span> spans = spans_of(CenterRows(ExactGrid(screen), t.exact()));
  const std::size_t step = 1 + spans.size() / 8;
  for (std::size_t i = 0; i < spans.size(); i += step)
    for (const int column :
         {spans[i].first_column, (spans[i].first_column + spans[i].last_column) / 2, spans[i].last_column}) {
      const mpq_class error = abs(mpq_class(spans[i].depth(column)) - exact.depth(spans[i].row, column));
      ASSERT_TRUE(error <= bound) << "row " << spans[i].row << ", column " << column;
      if (bound != 0) worst.add(mpq_class(error / exact.largest_depth()).get_d());
    }
}

TextTriangle with_vertices(const Triangle& p) {
  return {p};
}

TEST(CenterExact, DoublesCoverWhatTheyCoverExactly) {
  RandomNumbers random(1);
  for (int i = 0; i < sanitizer_rounds(1500); ++i) {
    Viewport screen = {
        random.whole(1, 12), random.whole(1, 12), -random.between(0.5, 2), -random.between(0.5, 2), -1, 1};
    screen.left_is_decimal = i % 2 == 0;
    Triangle p{};
    for (Vec3& v : p) v = {random.between(-2, 2), random.between(-2, 2), 0};
    // Some coordinates near 0, and some triangles whose corners lie on a line up to rounding.
    if (i % 5 == 0) p[0].x = random.with_exponent(-120, -3);
    if (i % 7 == 0) p[2] = {(p[0].x + p[1].x) / 2, (p[0].y + p[1].y) / 2, 0};
    if (i % 11 == 0) p[1].y = p[0].y;
    expect_exact(with_vertices(p), screen);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

TEST(CenterExact, DoublesOnPixelCentersToo) {
  RandomNumbers random(2);
  for (int i = 0; i < sanitizer_rounds(1500); ++i) {
    // The size is a power of two and the limit a double, so all centers and half pixels are doubles.
    const double limit = std::ldexp(random.between(1, 2), random.whole(-1, 1));
    const Viewport screen = {8, 16, -limit, -limit, -1, 1};
    Triangle p{};
    for (Vec3& v : p) v = {random.whole(-9, 9) * limit / 8, random.whole(-18, 18) * limit / 16, 0};
    expect_exact(with_vertices(p), screen);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

TEST(CenterExact, AnyDoublesCoverWhatTheyCoverExactly) {
  RandomNumbers random(3);
  for (int i = 0; i < 400; ++i) {
    const double limit = i % 2 == 0 ? 1.0 : std::ldexp(random.between(1, 2), random.whole(-660, 660));
    const Viewport screen = {5, 4, -limit, -limit, -1, 1};
    const int range = i % 3 == 0 ? 400 : 60;
    Triangle p{};
    for (Vec3& v : p)
      v = {limit * random.with_exponent(-range, range / 2), limit * random.with_exponent(-range, range / 2),
           0};
    if (i % 4 == 3)
      p = {{{random.any_double(), random.any_double(), 0}, p[1], {random.any_double(), p[2].y, 0}}};
    expect_exact(with_vertices(p), screen);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

TEST(CenterExact, DecimalsOfEverySizeMixedWithDoubles) {
  RandomNumbers random(4);
  for (int i = 0; i < 1000; ++i) {
    const Viewport screen =
        decimal_screen(random.whole(1, 9), random.whole(1, 9), -random.whole(1, 30'000'000) / 1e7, -1);
    std::string text;
    for (int k = 0; k < 9; ++k) {
      std::string number = random.bits() % 2 == 0 ? "-" : "";
      const int digits = i % 3 == 0 ? random.whole(1, 21) : 0;
      number += digits == 0 ? "0" : std::string(1, static_cast<char>('1' + random.whole(0, 8)));
      for (int d = 1; d < digits; ++d) number += static_cast<char>('0' + random.whole(0, 9));
      number += '.';
      for (int d = random.whole(1, random.bits() % 4 == 0 ? 17 : 7); d > 0; --d)
        number += static_cast<char>('0' + random.whole(0, 9));
      text += number + (k < 8 ? " " : "");
    }
    expect_exact(triangle_of(text), screen);
    if (HasFatalFailure()) FAIL() << text;
  }
}

TEST(CenterExact, DepthsAreWithinTheirBound) {
  WorstError worst("depth under center, parts of the largest |z|");
  RandomNumbers random(5);
  for (int i = 0; i < sanitizer_rounds(3000); ++i) {
    const std::array<Viewport, 3> screens = {decimal_screen(500, 500), decimal_screen(1023, 40),
                                             Viewport{640, 480, -1.1, -0.9, -1, 1}};
    UnitTriangle units{};
    const int size = i % 2 == 0 ? 200'000 : 8'000'000;
    const std::array<int, 2> center = {random.whole(-9'000'000, 9'000'000),
                                       random.whole(-9'000'000, 9'000'000)};
    for (auto& p : units) p = {center[0] + random.whole(-size, size), center[1] + random.whole(-size, size)};
    // Depths of one size, of very different sizes, nearly equal, or of opposite sign.
    std::array<double, 3> z{};
    const double base = random.between(-1, 1);
    for (double& depth : z) {
      if (i % 4 == 0) depth = random.between(-1, 1);
      if (i % 4 == 1) depth = random.with_exponent(-40, 40);
      if (i % 4 == 2) depth = base * (1 + random.whole(-2, 2) * 0x1p-52);
      if (i % 4 == 3) depth = random.bits() % 2 == 0 ? 1 : -1;
    }
    TextTriangle t = triangle_of(units, z);
    t.decimal_marks = i % 3 == 0 ? 0 : 0b011'011'011;
    expect_depths_within_bound(t, screens[static_cast<std::size_t>(i / 2) % screens.size()], worst);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

TEST(CenterExact, DepthsOfSliversAndOfFarVerticesAreWithinTheirBound) {
  WorstError worst("depth under center, parts of the largest |z|");
  RandomNumbers random(6);
  const Viewport screen = decimal_screen(400, 300, -1, -0.75);
  for (int i = 0; i < 600; ++i) {
    UnitTriangle units{};
    const int size = i % 2 == 0 ? 10'000'000 : 1'000'000'000;
    for (auto& p : units) p = {random.whole(-size, size), random.whole(-size, size)};
    const double along = random.between(0, 1);
    for (std::size_t k = 0; k < 2 && i % 3 != 0; ++k)
      units[2][k] = units[0][k] + std::llround(along * static_cast<double>(units[1][k] - units[0][k])) +
                    20'000 * std::int64_t{random.whole(-3, 3)};
    TextTriangle t =
        triangle_of(units, {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    t.decimal_marks = 0b011'011'011;
    if (i % 5 == 0) {
      const double far = std::ldexp(1.0, random.whole(10, 200));
      for (Vec3& p : t.p) p = {p.x * far, p.y * far, p.z};
      t.decimal_marks = 0;
    }
    expect_depths_within_bound(t, screen, worst);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

// Of doubles: from a thousandth of a pixel to far beyond the screen, up to 2^30 times as long as wide.
TEST(CenterExact, DepthsInPlanesAreWithinTheirBound) {
  WorstError worst("depth under center in planes, parts of the largest |z|");
  RandomNumbers random(8);
  int plane_count = 0, other_count = 0;
  for (int i = 0; i < sanitizer_rounds(3000); ++i) {
    const Viewport screen =
        i % 2 == 0 ? decimal_screen(400, 300, -1, -0.75) : decimal_screen(1021, 3, -0.3, -0.7);
    const double size = std::exp2(random.between(-16, 16)), width = size * std::exp2(-random.between(0, 30));
    const double x = random.between(-1, 1), y = random.between(-1, 1), along = random.between(-1, 2);
    const Vec3 step = {random.between(-1, 1), random.between(-1, 1), 0};
    TextTriangle t = with_vertices(
        {Vec3{x, y, 0}, Vec3{x + size * step.x, y + size * step.y, 0},
         Vec3{x + along * size * step.x - width * step.y, y + along * size * step.y + width * step.x, 0}});
    for (Vec3& v : t.p) v.z = i % 3 == 0 ? random.with_exponent(-60, 0) : random.between(-1, 1);
    t.decimal_marks = static_cast<std::uint16_t>(random.whole(0, 1) * random.whole(0, 0776) & 0b011'011'011);
    (depth_plane(ExactGrid(screen), t.exact()) ? plane_count : other_count) += 1;
    expect_depths_within_bound(t, screen, worst);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
  EXPECT_GT(plane_count, sanitizer_rounds(1000));
  EXPECT_GT(other_count, sanitizer_rounds(300));
}

TEST(CenterExact, DepthsReadAsDecimalsAreWithinTheSameBound) {
  WorstError worst("depth under center, parts of the largest |z|");
  RandomNumbers random(7);
  const Viewport screen = decimal_screen(500, 500);
  for (int i = 0; i < 1000; ++i) {
    UnitTriangle units{};
    for (auto& p : units) p = {random.whole(-10'000'000, 10'000'000), random.whole(-10'000'000, 10'000'000)};
    const auto depth = [&] { return random.whole(-10'000'000, 10'000'000) / 1e7; };
    expect_depths_within_bound(triangle_of(units, {depth(), depth(), depth()}), screen, worst);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

}  // namespace
}  // namespace pipeline
