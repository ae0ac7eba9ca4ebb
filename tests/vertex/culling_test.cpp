#include <gtest/gtest.h>

#include "libpipeline/text/error.h"
#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

/// The sign of the determinant with rows (x, y, w), which is the sign of the area in NDC. Exact for
/// coordinates of any size.
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

TEST(Culling, FollowsTheExactDeterminantOfTrianglesSeenFromTheEdge) {
  RandomNumbers random(8);
  for (int i = 0; i < 3'000 && !HasFatalFailure(); ++i) {
    const Vec3 a = random_point(random, 100);
    const Vec3 b = random_point(random, 100);
    const double s = random.between(-1, 2);
    const double t = random.between(-1, 2);
    // In the plane through the eye, a and b, up to rounding.
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
      CoordinateRounder rounder(Precision::in_doubles, {7}, "stage2.txt");
      ProjectionStage stage(kSimple, ClipMode::reject, cull, rounder);
      TriangleBatch p_ndc;
      try {
        stage.project(batch_of({t}), p_ndc);
      } catch (const InputError&) {  // the image of a triangle that is not culled overflows
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

TEST(Culling, PiecesOfAClippedTriangleKeepItsWinding) {
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

}  // namespace
}  // namespace pipeline
