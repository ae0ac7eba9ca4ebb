#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

std::vector<std::uint64_t> numbers_of(const std::vector<Triangle>& triangles, ClipMode clip) {
  TriangleBatch batch;
  for (const Triangle& t : triangles) batch.add(t, batch.size(), {1, 2, 3});
  return projected(batch, kSimple, clip).p_ndc.numbers;
}

TEST(ClipModeAutomatic, AVertexOnTheEyePlaneIsCutOffWithTheSmallestNearPlaneToo) {
  const ProjectionTransform tiny = {true, 1, 0, 1, 0, 0x1p-1074, 1};
  EXPECT_EQ(projected(batch_of({triangle_at(0, -0.5, -0.5)}), tiny, ClipMode::automatic).counts.clipped, 1u);
}

/// Where the edge from `a` to `b` meets the near plane of kSimple, pulled in by `inset`, in NDC.
ReferenceVec3<448> cut_in_ndc(const Vec3& a, const Vec3& b, double inset) {
  using Exact = Real<448>;
  const auto z_clip = [](double z) { return (Exact(-z) * Exact(101) - Exact(200)) / Exact(99); };
  const auto inside = [&](double z) { return Exact(-z) * (Exact(1) - Exact(inset)) + z_clip(z); };
  const Exact t = inside(a.z) / (inside(a.z) - inside(b.z));
  const auto between = [&](const Exact& from, const Exact& to) { return from + t * (to - from); };
  const Exact w = between(-a.z, -b.z);
  return {between(a.x, b.x) / w, between(a.y, b.y) / w, between(z_clip(a.z), z_clip(b.z)) / w};
}

TEST(ClipInset, CutsStandWhereExactArithmeticPutsThem) {
  RandomNumbers random(36);
  for (int i = 0; i < 2000; ++i) {
    const double inset = i < 9 ? (i + 1) / 10.0 : random.between(0, 1) * std::exp2(-random.whole(0, 60));
    const auto point = [&](double z) { return Vec3{random.between(-9, 9), random.between(-9, 9), z}; };
    const Triangle p_view = {point(random.between(-0.99, 1)), point(-99), point(random.between(-200, -99))};
    const auto& [a, b, c] = p_view;
    const TriangleBatch p_ndc = projected(batch_of({p_view}), kSimple, ClipMode::near, CullMode::nothing,
                                          {17}, Precision::extended, inset)
                                    .p_ndc;
    ASSERT_EQ(p_ndc.size(), 2u);
    const Real<448> size(200);
    EXPECT_EQ(printed_vertex(p_ndc, 0, {17}), reference_vertex(cut_in_ndc(a, b, inset), {17}, size)) << inset;
    EXPECT_EQ(printed_vertex(p_ndc, 5, {17}), reference_vertex(cut_in_ndc(c, a, inset), {17}, size)) << inset;
    const TriangleBatch whole =
        projected(batch_of({p_view}), kSimple, ClipMode::automatic, CullMode::nothing, {17}).p_ndc;
    EXPECT_EQ(printed_vertex(p_ndc, 1, {17}), printed_vertex(whole, 1, {17})) << inset;
  }
}

// The corner lies beside a plane, by 2^-52 of its distance to 2^-20, or within all of them.
TEST(ProjectionStage, CutsWhatIsOutsideHoweverLittle) {
  RandomNumbers random(5);
  const auto beside = [&](double plane) {
    const double sign = random.bits() % 2 == 0 ? 1 : -1;
    return random.bits() % 2 == 0 ? plane * (1 + sign * std::exp2(random.whole(-52, -20))) : plane;
  };
  int cut_count = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool is_perspective = i % 2 == 0;
    const double near = std::exp2(random.between(-10, 10)),
                 far = near * (1 + std::exp2(random.between(-3, 20)));
    const ProjectionTransform projection = {is_perspective,
                                            random.between(0.5, 3),
                                            random.between(-1, 1),
                                            random.between(0.5, 3),
                                            random.between(-1, 1),
                                            near,
                                            far};
    const auto point = [&](double x_ndc, double y_ndc, double distance) {
      const double w = is_perspective ? distance : 1, shift = is_perspective ? -distance : 1;
      const auto coordinate = [&](double ndc, const Ball& scale, const Ball& offset) {
        return (ndc * w - offset.nearest_double() * shift) / scale.nearest_double();
      };
      return Vec3{coordinate(x_ndc, projection.x_scale, projection.x_offset),
                  coordinate(y_ndc, projection.y_scale, projection.y_offset), -distance};
    };
    const std::array<double, 3> distances = {near, (near + far) / 2, far};
    const double middle = distances[1];
    const Vec3 corner = point(beside(random.whole(-1, 1)), beside(random.whole(-1, 1)),
                              beside(distances[static_cast<std::size_t>(random.whole(0, 2))]));
    const TriangleBatch p_view = batch_of({{corner, point(0.5, 0, middle), point(0, 0.5, middle)}});
    const unsigned outside = outcode(to_clip_space(projection, corner));
    const auto is_cut = [&](ClipMode clip) {
      return projected(p_view, projection, clip, CullMode::nothing, {7}, Precision::in_doubles)
                 .counts.clipped == 1;
    };
    ASSERT_EQ(is_cut(ClipMode::frustum), outside != 0) << i;
    ASSERT_EQ(is_cut(ClipMode::near), (outside & 1) != 0) << i;
    cut_count += outside != 0 ? 1 : 0;
  }
  EXPECT_GT(cut_count, 5000);
  EXPECT_LT(cut_count, 15000);
}

TEST(ProjectionStage, EveryPieceHasItsTrianglesNumber) {
  EXPECT_EQ(numbers_of({triangle_at(-2, -2, -2), triangle_at(1, -2, -2), triangle_at(1, 1, 1),
                        triangle_at(1, 1, -2), triangle_at(-2, -2, -2)},
                       ClipMode::automatic),
            (std::vector<std::uint64_t>{0, 1, 1, 3, 4}));
}

TEST(ProjectionStage, ACutHasTheLocationOfTheCornerThatWeighsMost) {
  // The near plane, at distance 1, is nearer to the third corner than to the second, but nearest to the
  // first.
  const TriangleBatch pieces =
      projected(batch_of({triangle_at(-1.25, -2, -0.5)}), kSimple, ClipMode::near).p_ndc;
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces.locations[0], (VertexLocations{1, 2, 3}));
  EXPECT_EQ(pieces.locations[1], (VertexLocations{1, 3, 1}));
}

TEST(ProjectionStage, PiecesHaveTheAttributesOfTheirTriangleAndNoOthers) {
  const Triangle crossing = triangle_at(-2, -2, 0.5);
  for (const ClipMode clip : {ClipMode::near, ClipMode::reject}) {
    // Nothing is cut under `reject`; then all corners have to be in front of the eye.
    TriangleBatch with_colors = batch_of({clip == ClipMode::near ? crossing : triangle_at(-2, -2, -3)});
    TriangleBatch with_normals = with_colors;
    with_colors.attributes.colors = {{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}}};
    with_normals.attributes.normals = {{Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 0, 1}}};
    const AttributeArrays colored = projected(with_colors, kSimple, clip).p_ndc.attributes;
    const AttributeArrays curved = projected(with_normals, kSimple, clip).p_ndc.attributes;
    const std::size_t piece_count = clip == ClipMode::near ? 2 : 1;
    EXPECT_EQ(colored.colors.size(), piece_count);
    EXPECT_TRUE(colored.normals.empty());
    EXPECT_EQ(curved.normals.size(), piece_count);
    EXPECT_TRUE(curved.colors.empty());
    EXPECT_EQ(curved.w.size(), piece_count);
    EXPECT_EQ(curved.normals[0][0], (Vec3{0, 0, 1}));
  }
}

TEST(ProjectionStage, TheColorsOfCutsStayInTheirRange) {
  RandomNumbers random(4);
  for (int i = 0; i < 300; ++i) {
    TriangleBatch p_view = batch_of({triangle_at(random.between(-9, -1), random.between(-9, -1), 0.5)});
    p_view.attributes.colors = {{Vec3{255, 255, 255}, Vec3{255, 255, 255}, Vec3{255, 255, 255}}};
    const Result result = projected(p_view, kSimple, ClipMode::near);
    ASSERT_EQ(result.p_ndc.attributes.colors.size(), 2u);
    for (const auto& piece : result.p_ndc.attributes.colors)
      for (const Vec3& color : piece) EXPECT_LE(std::max({color.x, color.y, color.z}), 255);
  }
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
    const auto exact = reference_projection<448>(p);
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

}  // namespace
}  // namespace pipeline
