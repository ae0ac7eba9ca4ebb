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

/// Projections at the limits of a camera's parameters, with vertices in view.
struct Extreme {
  const char* what;
  Perspective perspective;
  double width, height;  // of the view at distance `depth`
  double depth;
};
constexpr Extreme kExtremes[] = {
    {"far / near 1e12", {60, 1, 1, 1e12}, 1e6, 1e6, 1e6},
    {"far / near 1e12, close", {60, 1, 1e-6, 1e6}, 1, 1, 1},
    {"far - near 1e-12", {60, 1, 1, 1 + 1e-12}, 1, 1, 1 + 4e-13},
    {"far - near one bit", {60, 1, 1, 1 + 0x1p-52}, 1, 1, 1},
    {"fovY 1e-10", {1e-10, 1, 1, 1e6}, 1e-7, 1e-7, 1e5},
    {"fovY 179.999999999999", {179.999999999999, 1, 1, 100}, 1e14, 1e14, 2},
    {"fovX close to 180", {90, 2 - 0x1p-51, 1, 100}, 1e14, 1, 2},
    {"planes at 1e-300", {60, 1, 1e-300, 3e-300}, 1e-300, 1e-300, 2e-300},
    {"planes at 1e300", {60, 1, 1e300, 3e300}, 1e300, 1e300, 2e300},
    {"planes at both ends", {60, 1, 1e-300, 1e300}, 1e300, 1e300, 1e300},
    {"subnormal near plane", {60, 1, 0x1p-1070, 1}, 1, 1, 1},
    {"subnormal planes", {60, 1, 0x3p-1074, 0x9p-1074}, 0x40p-1074, 0x40p-1074, 0x7p-1074},
    {"tiny fovY and far away", {1e-300, 1, 1, 1e300}, 1e-2, 1e-2, 1e300},
};

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfExtremeCameras) {
  for (const NumberFormat format : kFormats) {
    for (const Extreme& extreme : kExtremes) {
      RandomNumbers random(4);
      std::vector<Vec3> vertices(30);
      const double nearest = std::max(extreme.perspective.near, 0.9 * extreme.depth);
      for (Vec3& p : vertices)
        p = {extreme.width * random.between(-1, 1), extreme.height * random.between(-1, 1),
             -random.between(nearest, extreme.depth)};
      vertices[0] = {0, 0, -extreme.depth};
      vertices[1] = {0, 0, -extreme.perspective.near};
      vertices[2] = {0, 0, -extreme.perspective.far};
      expect_images<4096>(extreme.perspective, vertices, format, Real<4096>(1e10));
      ASSERT_FALSE(HasFailure()) << extreme.what << ", " << format.decimals << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfExtremeWindows) {
  const Projection windows[] = {
      Frustum{-1e300, 1e300, -1e300, 1e300, 1e-10, 1e-9},
      Frustum{-1e-300, 1e-300, -1e-300, 1e-300, 1e-10, 1},
      Orthographic{-1e308, 1e308, -1e-308, 1e-308, -1e308, 1.7e308},
      Orthographic{0, 0x1p-1074, 0, 0x1p-1074, 0, 0x1p-1074},
      Orthographic{1e15, 1e15 + 1, -1, 1e15, 1e15, 1e15 + 2},
  };
  for (const NumberFormat format : kFormats) {
    for (const Projection& projection : windows) {
      const auto window = reference_projection<4096>(projection);
      RandomNumbers random(5);
      std::vector<Vec3> vertices(12);
      for (Vec3& p : vertices) {
        const double distance =
            (window.near + (window.far - window.near) * Real<4096>(random.between(0, 1))).nearest_double();
        const Real<4096> wider = window.is_perspective ? Real<4096>(distance) / window.near : Real<4096>(1);
        p.x = ((window.left + (window.right - window.left) * Real<4096>(random.between(0, 1))) * wider)
                  .nearest_double();
        p.y = ((window.bottom + (window.top - window.bottom) * Real<4096>(random.between(0, 1))) * wider)
                  .nearest_double();
        p.z = -distance;
      }
      expect_images<4096>(projection, vertices, format, Real<4096>(1));
      ASSERT_FALSE(HasFailure()) << "projection " << &projection - windows << ", " << format.decimals
                                 << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfANarrowWindowFarFromTheAxis) {
  const Frustum window = {1e8, 1e8 + 0x1p-20, -1e8, -1e8 + 0x1p-20, 1, 1e9};
  const std::vector<Vec3> vertices = {
      {1e8, -1e8, -1}, {2e8 + 0x1p-20, -2e8 + 0x1p-21, -2}, {1e10, -1e10, -100.5}};
  expect_images<448>(window, vertices, {7}, 1);
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

TEST(Projection, TheNearAndFarPlanesAreExactlyMinusOneAndOne) {
  const TriangleBatch batch = batch_of({{Vec3{0, 0, -0.1}, Vec3{0, 0, -7}, Vec3{1, 1, -0.1}}});
  const Result result = projected(batch, transform_of(Perspective{33, 1, 0.1, 7}), ClipMode::automatic,
                                  CullMode::nothing, {.shortest = true});
  EXPECT_EQ(result.p_ndc.triangles[0][0].z, -1);
  EXPECT_EQ(result.p_ndc.triangles[0][1].z, 1);
}

TEST(Projection, AnOverflowNamesTheVertexsLocation) {
  const TriangleBatch batch = batch_of({{Vec3{0, 0, -1e-5}, Vec3{1e306, 0, -1e-5}, Vec3{0, 1, -1e-5}}});
  const ProjectionTransform close = {true, 1, 0, 1, 0, 1e-5, 1};
  try {
    projected(batch, close, ClipMode::automatic);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "stage2.txt:2:1: expected a vertex whose image is within a double's range, found an "
                 "overflow of its x");
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
