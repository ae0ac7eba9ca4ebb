#include "libpipeline/projection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libpipeline/error.h"
#include "tests/printed_vertices.h"

namespace pipeline {
namespace {

// x and y are left as they are at distance 1, the planes at 1 and 100.
const ProjectionTransform kSimple = {true, 1, 0, 1, 0, 1, 100};

Triangle at(double z1, double z2, double z3) {
  return {Vec3{0, 0, z1}, Vec3{1, 0, z2}, Vec3{0, 1, z3}};
}

TriangleBatch batch_of(std::initializer_list<Triangle> triangles) {
  TriangleBatch batch;
  for (const Triangle& t : triangles) {
    const std::size_t line = 4 * batch.size() + 1;
    batch.add(t, batch.size(), {line, line + 1, line + 2});
  }
  return batch;
}

struct Result {
  TriangleBatch p_ndc;
  ProjectionCounts counts;
};

Result projected(const TriangleBatch& p_view, const ProjectionTransform& projection, ClipMode clip,
                 CullMode cull = CullMode::nothing, NumberFormat format = {7},
                 Precision precision = Precision::extended) {
  CoordinateRounder rounder(precision, format, "stage2.txt");
  ProjectionStage stage(projection, clip, cull, rounder);
  Result result;
  stage.project(p_view, result.p_ndc);
  result.counts = stage.counts();
  EXPECT_EQ(rounder.first_uncertain_line(), 0u);
  return result;
}

std::vector<std::uint64_t> numbers_of(const std::vector<Triangle>& triangles, ClipMode clip) {
  TriangleBatch batch;
  for (const Triangle& t : triangles) batch.add(t, batch.size(), {1, 2, 3});
  return projected(batch, kSimple, clip).p_ndc.numbers;
}

std::string message_of(const TriangleBatch& p_view, ClipMode clip) {
  try {
    projected(p_view, kSimple, clip);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

ProjectionTransform transform_of(const Projection& projection, AspectRule rule = AspectRule::angle) {
  return clip_from_view({projection, {}}, rule);
}

/// Checks the images of vertices that need no clipping.
template <int bits>
void expect_images(const Projection& projection, AspectRule rule, const std::vector<Vec3>& vertices,
                   NumberFormat format, const Real<bits>& size) {
  const auto exact = reference_projection<bits>(projection, rule);
  const Result result = projected(batch_of(vertices), transform_of(projection, rule), ClipMode::automatic,
                                  CullMode::nothing, format);
  expect_printed<bits>(result.p_ndc, vertices, format, size, [&](const auto& p) { return exact.ndc(p); });
}

Perspective random_perspective(RandomNumbers& random) {
  const double fov_y = random.bits() % 2 == 0 ? random.between(1, 179) : random.whole(1, 179);
  const double near = std::exp2(random.between(-10, 10));
  return {fov_y, random.between(0.1, 179 / fov_y), near, near * (1 + std::exp2(random.between(-10, 30)))};
}

std::vector<Vec3> random_vertices_in_front(RandomNumbers& random, std::size_t count, double nearest) {
  std::vector<Vec3> vertices(count);
  for (Vec3& p : vertices)
    p = {random_coordinate(random, 1e6), random_coordinate(random, 1e6), -random.between(nearest, 1e6)};
  for (std::size_t i = 0; i < count; i += 4)
    vertices[i].z = -std::max(nearest, std::nearbyint(-vertices[i].z * 1e7) / 1e7);
  return vertices;
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAPerspective) {
  for (const NumberFormat format : kFormats) {
    RandomNumbers random(1);
    for (int i = 0; i < 30; ++i) {
      const Perspective p = random_perspective(random);
      const AspectRule rule = i % 2 == 0 ? AspectRule::angle : AspectRule::ratio;
      expect_images<448>(p, rule, random_vertices_in_front(random, 30, p.near / 1000), format, 1e20);
      ASSERT_FALSE(HasFailure()) << "case " << i << ", " << format.decimals << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAFrustum) {
  for (const NumberFormat format : kFormats) {
    RandomNumbers random(2);
    for (int i = 0; i < 30; ++i) {
      const auto number = [&] { return random_coordinate(random, 10); };
      const Frustum f = {number(), number() + 11, number() + 11, number(), 0.5, random.between(1, 1e6)};
      expect_images<448>(f, AspectRule::angle, random_vertices_in_front(random, 30, 0.25), format, 1e20);
      ASSERT_FALSE(HasFailure()) << "case " << i << ", " << format.decimals << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfAParallelProjection) {
  for (const NumberFormat format : kFormats) {
    RandomNumbers random(3);
    for (int i = 0; i < 30; ++i) {
      const auto number = [&] { return random_coordinate(random, 10); };
      const Orthographic o = {number(), number() + 11, number() + 11, number(), number(), number() + 20.5};
      std::vector<Vec3> vertices(30);
      for (Vec3& p : vertices) p = random_point(random, 1e6);
      expect_images<448>(o, AspectRule::angle, vertices, format, 1e20);
      ASSERT_FALSE(HasFailure()) << "case " << i << ", " << format.decimals << " decimals";
    }
  }
}

/// Projections at the ends of what a camera can say, with vertices that are in their view.
struct Extreme {
  const char* what;
  Perspective perspective;
  double width, height;  // of what is seen at distance `depth`
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
      expect_images<4096>(extreme.perspective, AspectRule::angle, vertices, format, Real<4096>(1e10));
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
      const auto window = reference_projection<4096>(projection, AspectRule::angle);
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
      expect_images<4096>(projection, AspectRule::angle, vertices, format, Real<4096>(1));
      ASSERT_FALSE(HasFailure()) << "projection " << &projection - windows << ", " << format.decimals
                                 << " decimals";
    }
  }
}

TEST(Projection, PrintsTheCorrectlyRoundedNumbersOfANarrowWindowFarFromTheAxis) {
  const Frustum window = {1e8, 1e8 + 0x1p-20, -1e8, -1e8 + 0x1p-20, 1, 1e9};
  const std::vector<Vec3> vertices = {
      {1e8, -1e8, -1}, {2e8 + 0x1p-20, -2e8 + 0x1p-21, -2}, {1e10, -1e10, -100.5}};
  expect_images<448>(window, AspectRule::angle, vertices, {7}, 1);
}

TEST(Projection, TheNearAndFarPlanesAreExactlyMinusOneAndOne) {
  const TriangleBatch batch = batch_of({{Vec3{0, 0, -0.1}, Vec3{0, 0, -7}, Vec3{1, 1, -0.1}}});
  const Result result = projected(batch, transform_of(Perspective{33, 1, 0.1, 7}), ClipMode::automatic,
                                  CullMode::nothing, {.shortest = true});
  EXPECT_EQ(result.p_ndc.triangles[0][0].z, -1);
  EXPECT_EQ(result.p_ndc.triangles[0][1].z, 1);
}

TEST(Projection, AnOverflowNamesTheVertexLine) {
  const TriangleBatch batch = batch_of({{Vec3{0, 0, -1e-5}, Vec3{1e306, 0, -1e-5}, Vec3{0, 1, -1e-5}}});
  const ProjectionTransform close = {true, 1, 0, 1, 0, 1e-5, 1};
  try {
    projected(batch, close, ClipMode::automatic);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "stage2.txt:2: expected a vertex whose image is within a double's range, found an overflow");
  }
}

// Clip modes

TEST(ClipModeAutomatic, LeavesATriangleInFrontOfTheNearPlaneWhole) {
  const Result result = projected(batch_of({at(-0.5, -0.5, -0.5)}), kSimple, ClipMode::automatic);
  EXPECT_EQ(result.p_ndc.size(), 1u);
  EXPECT_EQ(result.counts.clipped, 0u);
  EXPECT_LT(result.p_ndc.triangles[0][0].z, -1);
}

TEST(ClipModeAutomatic, BeginsBelowNearDividedBy1024) {
  const double limit = 1.0 / 1024;
  EXPECT_EQ(projected(batch_of({at(-limit, -2, -2)}), kSimple, ClipMode::automatic).counts.clipped, 0u);
  EXPECT_EQ(projected(batch_of({at(-std::nextafter(limit, 0), -2, -2)}), kSimple, ClipMode::automatic)
                .counts.clipped,
            1u);
}

TEST(ClipModeAutomatic, CutsOffWhatIsBehindTheEye) {
  const Result result = projected(batch_of({at(1, -2, -2)}), kSimple, ClipMode::automatic);
  EXPECT_EQ(result.counts.clipped, 1u);
  EXPECT_EQ(result.counts.pieces, 2u);
  EXPECT_EQ(result.p_ndc.numbers, (std::vector<std::uint64_t>{0, 0}));
}

TEST(ClipModeAutomatic, DropsATriangleWithoutAPartBehindTheNearPlane) {
  const Result result =
      projected(batch_of({at(1, -0.5, -0.5), at(-2, -2, -2)}), kSimple, ClipMode::automatic);
  EXPECT_EQ(result.counts.outside, 1u);
  EXPECT_EQ(result.p_ndc.numbers, std::vector<std::uint64_t>{1});
}

TEST(ClipModeAutomatic, AVertexOnTheEyePlaneIsCutOffWithTheSmallestNearPlaneToo) {
  const ProjectionTransform tiny = {true, 1, 0, 1, 0, 0x1p-1074, 1};
  EXPECT_EQ(projected(batch_of({at(0, -0.5, -0.5)}), tiny, ClipMode::automatic).counts.clipped, 1u);
}

TEST(ClipModeAutomatic, LeavesAParallelProjectionAlone) {
  const ProjectionTransform parallel = {false, 1, 0, 1, 0, 1, 100};
  EXPECT_EQ(projected(batch_of({at(5, 0, -200)}), parallel, ClipMode::automatic).p_ndc.size(), 1u);
}

TEST(ClipModeNear, CutsEverythingAtTheNearPlane) {
  const Result result =
      projected(batch_of({at(-0.5, -2, -2), at(-0.5, -0.5, -2), at(-2, -2, -2)}), kSimple, ClipMode::near);
  EXPECT_EQ(result.counts.clipped, 2u);
  EXPECT_EQ(result.counts.pieces, 3u);
  EXPECT_EQ(result.p_ndc.numbers, (std::vector<std::uint64_t>{0, 0, 1, 2}));
}

TEST(ClipModeNear, CutsAParallelProjectionAsWell) {
  const ProjectionTransform parallel = {false, 1, 0, 1, 0, 1, 100};
  EXPECT_EQ(projected(batch_of({at(5, -2, -2)}), parallel, ClipMode::near).counts.clipped, 1u);
}

TEST(ClipModeNear, LeavesTheFarPlaneAlone) {
  EXPECT_EQ(projected(batch_of({at(-200, -200, -2)}), kSimple, ClipMode::near).counts.clipped, 0u);
}

TEST(ClipModeFrustum, CutsAtAllSixPlanes) {
  const Triangle huge = {Vec3{-1000, -1000, -5}, Vec3{1000, -1000, -5}, Vec3{0, 1000, -5}};
  const Result result = projected(batch_of({huge}), kSimple, ClipMode::frustum);
  EXPECT_EQ(result.counts.clipped, 1u);
  for (const Triangle& piece : result.p_ndc.triangles)
    for (const Vec3& v : piece) EXPECT_LE(std::max(std::fabs(v.x), std::fabs(v.y)), 1);
}

TEST(ClipModeFrustum, DropsWhatIsOutsideWithoutBeingOutsideOfOnePlane) {
  // Its corners are left, right and above, but it passes the upper left corner of the view by.
  const Triangle passing = {Vec3{-5, 0, -1}, Vec3{0, 5, -1}, Vec3{-5, 5, -1}};
  const Result result = projected(batch_of({passing}), kSimple, ClipMode::frustum);
  EXPECT_EQ(result.p_ndc.size(), 0u);
  EXPECT_EQ(result.counts.outside, 1u);
}

TEST(ClipModeReject, DropsOnlyWhatIsOutsideOfOnePlane) {
  const Triangle left = {Vec3{-5, 0, -1}, Vec3{-3, 1, -1}, Vec3{-2, 0, -1}};
  const Triangle passing = {Vec3{-5, 0, -1}, Vec3{0, 5, -1}, Vec3{-5, 5, -1}};
  const Triangle across = {Vec3{-5, 0, -1}, Vec3{0, 0, -1}, Vec3{0, 1, -1}};
  const Result result = projected(batch_of({left, passing, across}), kSimple, ClipMode::reject);
  EXPECT_EQ(result.p_ndc.numbers, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(result.counts.outside, 1u);
  EXPECT_EQ(result.counts.clipped, 0u);
}

TEST(ClipModeReject, AVertexBehindTheEyeOfWhatIsNotDroppedIsAnError) {
  EXPECT_EQ(message_of(batch_of({at(-2, -2, 1)}), ClipMode::reject),
            "stage2.txt:3: expected a vertex in front of the eye (z below 0), found one on or behind the eye "
            "plane");
}

TEST(ClipModeNone, LeavesEverythingWhole) {
  EXPECT_EQ(numbers_of({at(-1e-9, -2, -2), at(-500, -500, -500)}, ClipMode::none),
            (std::vector<std::uint64_t>{0, 1}));
}

TEST(ClipModeNone, AVertexOnOrBehindTheEyePlaneIsAnError) {
  const std::string expected =
      "expected a vertex in front of the eye (z below 0), found one on or behind the eye plane";
  EXPECT_EQ(message_of(batch_of({at(-2, 0, -2)}), ClipMode::none), "stage2.txt:2: " + expected);
  EXPECT_EQ(message_of(batch_of({at(-2, -2, -0.0)}), ClipMode::none), "stage2.txt:3: " + expected);
  EXPECT_EQ(message_of(batch_of({at(-2, -2, -2), at(5, -2, -2)}), ClipMode::none),
            "stage2.txt:5: " + expected);
}

TEST(ClipModeNone, AParallelProjectionHasNoEyePlane) {
  const ProjectionTransform parallel = {false, 1, 0, 1, 0, 1, 100};
  EXPECT_EQ(projected(batch_of({at(5, 0, -2)}), parallel, ClipMode::none).p_ndc.size(), 1u);
}

TEST(ProjectionStage, EveryPieceHasItsTrianglesNumber) {
  EXPECT_EQ(numbers_of({at(-2, -2, -2), at(1, -2, -2), at(1, 1, 1), at(1, 1, -2), at(-2, -2, -2)},
                       ClipMode::automatic),
            (std::vector<std::uint64_t>{0, 1, 1, 3, 4}));
}

TEST(ProjectionStage, ACutTriangleIsThatCutByHand) {
  // The near plane cuts the edges at x = 3/4 and y = 3/4: the numbers have few bits on purpose.
  const Triangle crossing = {Vec3{0, 0, 2}, Vec3{1, 0, -2}, Vec3{0, 1, -2}};
  const Vec3 cut_x = {0.75, 0, -1};
  const Vec3 cut_y = {0, 0.75, -1};
  const Result whole = projected(batch_of({crossing}), kSimple, ClipMode::automatic);
  const Result by_hand = projected(batch_of({{cut_x, crossing[1], crossing[2]}, {cut_x, crossing[2], cut_y}}),
                                   kSimple, ClipMode::none);
  ASSERT_EQ(whole.p_ndc.size(), 2u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(printed_vertex(whole.p_ndc, i, {7}), printed_vertex(by_hand.p_ndc, i, {7}));
}

TEST(ProjectionStage, CutsPrintTheCorrectlyRoundedNumbers) {
  using Exact = Real<448>;
  using ExactVec3 = ReferenceVec3<448>;
  RandomNumbers random(6);
  for (int i = 0; i < 2'000; ++i) {
    const Perspective p = random_perspective(random);
    // One corner behind the eye: the polygon is cut, corner 2, corner 3, cut.
    const Triangle t = {
        Vec3{random_coordinate(random, 1e3), random_coordinate(random, 1e3), random.between(0.1, 1e3)},
        random_vertices_in_front(random, 1, p.near + 0.1)[0],
        random_vertices_in_front(random, 1, p.near + 0.1)[0]};
    const Result result = projected(batch_of({t}), transform_of(p), ClipMode::automatic);
    const auto exact = reference_projection<448>(p, AspectRule::angle);
    const auto expected_cut = [&](const Vec3& outside, const Vec3& inside) {
      const Exact share = (Exact(-p.near) - Exact(outside.z)) / (Exact(inside.z) - Exact(outside.z));
      const auto between = [&](double a, double b) { return Exact(a) + share * (Exact(b) - Exact(a)); };
      const ExactVec3 cut = {between(outside.x, inside.x), between(outside.y, inside.y), Exact(-p.near)};
      return reference_vertex(exact.ndc(cut), {7}, Exact(1));
    };
    ASSERT_EQ(result.p_ndc.size(), 2u);
    ASSERT_EQ(printed_vertex(result.p_ndc, 0, {7}), expected_cut(t[0], t[1]))
        << to_text(t[0]) << to_text(t[1]);
    ASSERT_EQ(printed_vertex(result.p_ndc, 5, {7}), expected_cut(t[0], t[2]))
        << to_text(t[0]) << to_text(t[2]);
  }
}

// Culling

/// The sign of the determinant with rows (x, y, w): that of the area in NDC. Exact for coordinates of any
/// size.
int exact_winding(const Triangle& t, bool is_perspective) {
  using Exact = Real<6500>;
  const auto w = [&](const Vec3& p) { return Exact(is_perspective ? -p.z : 1); };
  const auto minor = [](const Vec3& p, const Vec3& q) {
    return Exact(p.x) * Exact(q.y) - Exact(p.y) * Exact(q.x);
  };
  return (minor(t[1], t[2]) * w(t[0]) + minor(t[2], t[0]) * w(t[1]) + minor(t[0], t[1]) * w(t[2])).sign();
}

void expect_culled_by_winding(const Triangle& t, bool is_perspective, double x_scale) {
  const ProjectionTransform projection = {is_perspective, x_scale, 0, 1, 0, 1, 100};
  const int winding = exact_winding(t, is_perspective) * (x_scale < 0 ? -1 : 1);
  const ClipMode clip = ClipMode::automatic;
  const bool back_dropped = projected(batch_of({t}), projection, clip, CullMode::back).counts.culled == 1;
  const bool front_dropped = projected(batch_of({t}), projection, clip, CullMode::front).counts.culled == 1;
  ASSERT_EQ(back_dropped, winding < 0) << to_text(t[0]) << to_text(t[1]) << to_text(t[2]);
  ASSERT_EQ(front_dropped, winding > 0) << to_text(t[0]) << to_text(t[1]) << to_text(t[2]);
}

TEST(Culling, CounterClockwiseIsFront) {
  const TriangleBatch batch = batch_of({at(-2, -2, -2), {Vec3{0, 0, -2}, Vec3{0, 1, -2}, Vec3{1, 0, -2}}});
  EXPECT_EQ(projected(batch, kSimple, ClipMode::automatic, CullMode::back).p_ndc.numbers,
            std::vector<std::uint64_t>{0});
  EXPECT_EQ(projected(batch, kSimple, ClipMode::automatic, CullMode::front).p_ndc.numbers,
            std::vector<std::uint64_t>{1});
  EXPECT_EQ(projected(batch, kSimple, ClipMode::automatic, CullMode::front).counts.culled, 1u);
}

TEST(Culling, FollowsTheExactDeterminant) {
  RandomNumbers random(7);
  for (int i = 0; i < 3'000 && !HasFatalFailure(); ++i) {
    Triangle t;
    for (Vec3& p : t)
      p = i % 2 == 0 ? random_point(random, 100)
                     : Vec3{1.0 * random.whole(-3, 3), 1.0 * random.whole(-3, 3), 1.0 * random.whole(-9, 3)};
    expect_culled_by_winding(t, i % 5 != 0, i % 3 == 0 ? -1 : 1);
  }
}

TEST(Culling, FollowsTheExactDeterminantOfTrianglesSeenFromTheEdge) {
  RandomNumbers random(8);
  for (int i = 0; i < 3'000 && !HasFatalFailure(); ++i) {
    const Vec3 a = random_point(random, 100);
    const Vec3 b = random_point(random, 100);
    const double s = random.between(-1, 2);
    const double t = random.between(-1, 2);
    // In the plane of the eye, a and b, but for the rounding.
    const Vec3 c = {s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
    expect_culled_by_winding({a, b, c}, true, 1);
  }
}

TEST(Culling, FollowsTheExactDeterminantOfTinyAndHugeTriangles) {
  RandomNumbers random(9);
  for (int i = 0; i < 1'000 && !HasFatalFailure(); ++i) {
    const int x_exponent = random.whole(-1000, 900);
    const int z_exponent = random.whole(-1000, 900);
    Triangle t;
    for (Vec3& p : t)
      p = {random.with_exponent(x_exponent, x_exponent + 2),
           random.with_exponent(-x_exponent, 2 - x_exponent),
           -std::fabs(random.with_exponent(z_exponent, z_exponent + 2))};
    const auto winding = [&](CullMode cull) {
      CoordinateRounder rounder(Precision::plain, {7}, "stage2.txt");
      ProjectionStage stage(kSimple, ClipMode::reject, cull, rounder);
      TriangleBatch p_ndc;
      try {
        stage.project(batch_of({t}), p_ndc);
      } catch (const InputError&) {  // an overflow of what is not culled
      }
      return stage.counts().culled == 1;
    };
    const int exact = exact_winding(t, true);
    ASSERT_EQ(winding(CullMode::back), exact < 0) << to_text(t[0]) << to_text(t[1]) << to_text(t[2]);
    ASSERT_EQ(winding(CullMode::front), exact > 0) << to_text(t[0]) << to_text(t[1]) << to_text(t[2]);
  }
}

TEST(Culling, KeepsATriangleSeenExactlyFromTheEdge) {
  const TriangleBatch batch = batch_of({{Vec3{1, 1, -1}, Vec3{2, 2, -2}, Vec3{3, 1, -1}},
                                        {Vec3{0.1, 0.1, -1}, Vec3{0.2, 0.2, -3}, Vec3{0.3, 0.3, -1}}});
  EXPECT_EQ(projected(batch, kSimple, ClipMode::automatic, CullMode::back).counts.culled, 0u);
  EXPECT_EQ(projected(batch, kSimple, ClipMode::automatic, CullMode::front).counts.culled, 0u);
}

TEST(Culling, APieceOfACutTriangleTurnsAsTheWhole) {
  RandomNumbers random(10);
  for (int i = 0; i < 2'000; ++i) {
    const Triangle t = {random_point(random, 10), random_point(random, 10), random_point(random, 10)};
    const Result result = projected(batch_of({t}), kSimple, ClipMode::near);
    for (const Triangle& piece : result.p_ndc.triangles) {
      const double turn = (piece[1].x - piece[0].x) * (piece[2].y - piece[0].y) -
                          (piece[1].y - piece[0].y) * (piece[2].x - piece[0].x);
      ASSERT_TRUE(std::fabs(turn) < 1e-5 || (turn > 0) == (exact_winding(t, true) > 0))
          << to_text(t[0]) << to_text(t[1]) << to_text(t[2]);
    }
  }
}

TEST(Projection, LongPrintsNoNumberThatDiffersFromTheReference) {
  RandomNumbers random(101);
  DifferenceCount extended;
  DifferenceCount plain;
  for (int i = 0; i < 1'000; ++i) {
    const Perspective p = random_perspective(random);
    const auto exact = reference_projection<448>(p, AspectRule::angle);
    const std::vector<Vec3> vertices = random_vertices_in_front(random, 10'000, p.near / 1000);
    const auto reference = [&](const auto& v) { return exact.ndc(v); };
    extended.add(projected(batch_of(vertices), transform_of(p), ClipMode::automatic).p_ndc, vertices,
                 reference);
    if (i % 10 != 0) continue;
    plain.add(projected(batch_of(vertices), transform_of(p), ClipMode::automatic, CullMode::nothing, {7},
                        Precision::plain)
                  .p_ndc,
              vertices, reference);
  }
  extended.report("project, extended");
  plain.report("project, double");
  EXPECT_EQ(extended.different, 0u) << extended.first;
}

}  // namespace
}  // namespace pipeline
