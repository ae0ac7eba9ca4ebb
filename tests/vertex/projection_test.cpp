#include "libpipeline/vertex/projection.h"

#include <gtest/gtest.h>

#include "libpipeline/text/error.h"
#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

/// Checks the images of vertices that need no clipping.
template <int bits>
void expect_images(const Projection& projection, const std::vector<Vec3>& vertices, NumberFormat format,
                   const Real<bits>& size) {
  const auto exact = reference_projection<bits>(projection);
  const Result result =
      projected(batch_of(vertices), transform_of(projection), ClipMode::automatic, CullMode::nothing, format);
  expect_printed<bits>(result.p_ndc, vertices, format, size, [&](const auto& p) { return exact.ndc(p); });
}

/// Checks 30 projections for each format; `check(random, i, format)` makes and checks one.
template <typename Check>
void expect_correctly_rounded(std::uint64_t seed, Check check) {
  for (const NumberFormat format : kFormats) {
    RandomNumbers random(seed);
    for (int i = 0; i < 30; ++i) {
      check(random, i, format);
      ASSERT_FALSE(testing::Test::HasFailure()) << "case " << i << ", " << format.decimals << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAPerspective) {
  expect_correctly_rounded(1, [](RandomNumbers& random, int i, NumberFormat format) {
    Perspective p = random_perspective(random);
    if (i % 2 != 0) p.aspect_rule = AspectRule::ratio;
    expect_images<448>(p, random_vertices_in_front(random, 30, p.near / 1000), format, 1e20);
  });
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAFrustum) {
  expect_correctly_rounded(2, [](RandomNumbers& random, int, NumberFormat format) {
    const auto number = [&] { return random_coordinate(random, 10); };
    const Frustum f = {number(), number() + 11, number() + 11, number(), 0.5, random.between(1, 1e6)};
    expect_images<448>(f, random_vertices_in_front(random, 30, 0.25), format, 1e20);
  });
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAParallelProjection) {
  expect_correctly_rounded(3, [](RandomNumbers& random, int, NumberFormat format) {
    const auto number = [&] { return random_coordinate(random, 10); };
    const Orthographic o = {number(), number() + 11, number() + 11, number(), number(), number() + 20.5};
    std::vector<Vec3> vertices(30);
    for (Vec3& p : vertices) p = random_point(random, 1e6);
    expect_images<448>(o, vertices, format, 1e20);
  });
}

TEST(Projection, AScaleKnownToFewDigitsLeavesADigitUncertain) {
  // The image is 0.12345675 + 10^-10, above the tie of seven decimals, +- 2 * 10^-10.
  constexpr double kScale = 0x1p-31, kNumber = 0.2469135002 * 0x1p30;
  for (const bool is_x : {true, false}) {
    const auto uncertain_count = [&](const Ball& scale) {
      ProjectionTransform projection = {true, 1, 0, 1, 0, 1, 100};
      (is_x ? projection.x_scale : projection.y_scale) = scale;
      const Vec3 corner = is_x ? Vec3{kNumber, 0, -1} : Vec3{0, kNumber, -1};
      CoordinateRounder rounder(Precision::extended, {7}, "stage2.txt");
      TriangleBatch p_ndc;
      ProjectionStage(projection, ClipMode::automatic, CullMode::nothing, rounder)
          .project(batch_of({{Vec3{0, 0, -1}, corner, Vec3{0, 0, -2}}}), p_ndc);
      return rounder.uncertain().count;
    };
    EXPECT_EQ(uncertain_count(kScale), 0u);
    EXPECT_EQ(uncertain_count(Ball::with_error({kScale, 0}, 0x1p-60)), 1u);
  }
}

TEST(Projection, LongPrintsNoNumberThatDiffersFromTheReference) {
  RandomNumbers random(101);
  DifferenceCount extended;
  DifferenceCount in_doubles;
  for (int i = 0; i < 1'000; ++i) {
    const Perspective p = random_perspective(random);
    const auto exact = reference_projection<448>(p);
    const std::vector<Vec3> vertices = random_vertices_in_front(random, 10'000, p.near / 1000);
    const auto reference = [&](const auto& v) { return exact.ndc(v); };
    extended.add(projected(batch_of(vertices), transform_of(p), ClipMode::automatic).p_ndc, vertices,
                 reference);
    if (i % 10 != 0) continue;
    in_doubles.add(projected(batch_of(vertices), transform_of(p), ClipMode::automatic, CullMode::nothing, {7},
                             Precision::in_doubles)
                       .p_ndc,
                   vertices, reference);
  }
  extended.report("project, extended");
  in_doubles.report("project, double");
  EXPECT_EQ(extended.different, 0u) << extended.first;
}

}  // namespace
}  // namespace pipeline
