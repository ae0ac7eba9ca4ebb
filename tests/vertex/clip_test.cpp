#include "libpipeline/vertex/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/numbers/random_numbers.h"
#include "tests/vertex/clip_reference.h"

namespace pipeline {
namespace {

/// A vertex in clip space, in front of the eye or behind it, with coordinates of few bits or of full
/// precision.
ClipVertex random_vertex(RandomNumbers& random) {
  const auto number = [&] { return random.bits() % 3 == 0 ? random.whole(-4, 4) : random.between(-4, 4); };
  return {number(), number(), number(), number() + 1};
}

Polygon random_triangle(RandomNumbers& random) {
  return {random_vertex(random), random_vertex(random), random_vertex(random)};
}

std::string to_text(const Polygon& polygon) {
  std::string text;
  for (const ClipVertex& v : polygon)
    for (const Coordinate c : kCoordinates)
      text += std::to_string((v.*c).nearest_double()) + (c == &ClipVertex::w ? "\n" : " ");
  return text;
}

/// A point at the given distance inside `plane`, well inside the others.
ClipVertex at_distance(ClipPlane plane, double distance, double along) {
  const double far_inside = 100;
  ClipVertex v = {along, 2 * along, 3 * along, far_inside};
  const Ball on_plane = Ball(distance) - Ball(far_inside);
  if (plane == ClipPlane::near) v.z = on_plane;
  if (plane == ClipPlane::far) v.z = -on_plane;
  if (plane == ClipPlane::left) v.x = on_plane;
  if (plane == ClipPlane::right) v.x = -on_plane;
  if (plane == ClipPlane::below) v.y = on_plane;
  if (plane == ClipPlane::above) v.y = -on_plane;
  return v;
}

/// A triangle whose corners lie at these distances inside `plane`.
Polygon at_distances(ClipPlane plane, double a, double b, double c) {
  return {at_distance(plane, a, 0), at_distance(plane, b, 1), at_distance(plane, c, -1)};
}

TEST(DistanceInside, IsPositiveWithinEachPlane) {
  const ClipVertex inside = {0.5, -0.5, 0.25, 1};
  EXPECT_EQ(distance_inside(ClipPlane::near, inside), Ball(1.25));
  EXPECT_EQ(distance_inside(ClipPlane::far, inside), Ball(0.75));
  EXPECT_EQ(distance_inside(ClipPlane::left, inside), Ball(1.5));
  EXPECT_EQ(distance_inside(ClipPlane::right, inside), Ball(0.5));
  EXPECT_EQ(distance_inside(ClipPlane::below, inside), Ball(0.5));
  EXPECT_EQ(distance_inside(ClipPlane::above, inside), Ball(1.5));
}

TEST(Outcode, HasABitForEachPlaneAVertexIsOutsideOf) {
  EXPECT_EQ(outcode({0, 0, 0, 1}), 0u);
  EXPECT_EQ(outcode({0, 0, -2, 1}), 1u);
  EXPECT_EQ(outcode({0, 0, 2, 1}), 2u);
  EXPECT_EQ(outcode({-2, 0, 0, 1}), 4u);
  EXPECT_EQ(outcode({2, 0, 0, 1}), 8u);
  EXPECT_EQ(outcode({0, -2, 0, 1}), 16u);
  EXPECT_EQ(outcode({0, 2, 0, 1}), 32u);
  EXPECT_EQ(outcode({-2, 2, 2, 1}), 2u + 4u + 32u);
}

TEST(Outcode, OfAVertexBehindTheEyeHasBothBitsOfAPair) {
  EXPECT_EQ(outcode({0, 0, 0, -1}), 63u);
}

TEST(Outcode, AVertexOnAPlaneIsInside) {
  EXPECT_EQ(outcode({1, -1, -1, 1}), 0u);
}

TEST(Outcode, TheLastBitBesideAPlaneCounts) {
  EXPECT_EQ(outcode({1 + 0x1p-52, 0, 0, 1}), 8u);
  EXPECT_EQ(outcode({1 - 0x1p-53, 0, 0, 1}), 0u);
}

TEST(ClipPolygon, TouchingAPlaneFromOutsideLeavesNothing) {
  for (const ClipPlane plane : kAllClipPlanes) {
    EXPECT_TRUE(clipped_at(plane, at_distances(plane, 0, -2, -3)).empty());
    EXPECT_TRUE(clipped_at(plane, at_distances(plane, 0, 0, -3)).empty());
    EXPECT_TRUE(clipped_at(plane, at_distances(plane, -1, 0, 0)).empty());
  }
}

TEST(ClipPolygon, TouchingAPlaneFromInsideLeavesTheWhole) {
  for (const ClipPlane plane : kAllClipPlanes) {
    for (const Polygon& triangle :
         {at_distances(plane, 0, 2, 3), at_distances(plane, 0, 0, 3), at_distances(plane, 1, 0, 0)})
      EXPECT_TRUE(is_same(clipped_at(plane, triangle), triangle));
  }
}

TEST(ClipPolygon, ATriangleInAPlaneIsWhole) {
  for (const ClipPlane plane : kAllClipPlanes) {
    const Polygon triangle = at_distances(plane, 0, 0, 0);
    EXPECT_TRUE(is_same(clipped_at(plane, triangle), triangle));
  }
}

TEST(ClipPolygon, APlaneThroughACornerCutsTheOppositeEdge) {
  for (const ClipPlane plane : kAllClipPlanes) {
    const Polygon triangle = at_distances(plane, 0, 2, -3);
    const Polygon inside = clipped_at(plane, triangle);
    ASSERT_EQ(inside.size(), 3u);
    EXPECT_TRUE(is_same(inside[0], triangle[0]));
    EXPECT_TRUE(is_same(inside[1], triangle[1]));
  }
}

TEST(ClipPolygon, ACutNextToASmallCornerKeepsItsDigits) {
  // Only (1 2 -4 3) is outside, at distance 1 from the near plane; the others are 10^230 inside.
  const Polygon triangle = {{1, 2, -4, 3}, {1e200, 0, 1e230, 0}, {-1e200, 0, 1e230, 0}};
  for (const std::size_t first : {0u, 1u, 2u}) {
    const Polygon rotated = {triangle[first], triangle[(first + 1) % 3], triangle[(first + 2) % 3]};
    int near_count = 0;
    for (const ClipVertex& v : clipped_at(ClipPlane::near, rotated)) {
      if (abs(value(v.x)) > Exact(1e100)) continue;
      ++near_count;
      // The cuts lie 10^-230 along their edges: x = 1 +- 10^-30, y = 2.
      EXPECT_LE(abs(value(v.x) - Exact(1)), Exact(1.1e-30));
      EXPECT_LE(abs(value(v.y) - Exact(2)), Exact(1e-30));
      EXPECT_LE(v.y.radius(), 1e-30);
    }
    EXPECT_EQ(near_count, 2);
  }
}

/// Clips at one plane after another; the projected areas of the parts cut off and of the remaining part must
/// add up to the triangle's.
void expect_area_conserved(const Polygon& triangle) {
  Polygon remaining = triangle;
  std::vector<Polygon> parts;
  for (const ClipPlane plane : kAllClipPlanes) {
    parts.push_back(clipped_at(plane, turned_inside_out(remaining)));
    remaining = clipped_at(plane, remaining);
  }
  ASSERT_TRUE(is_same(remaining, clip_polygon(triangle, kAllClipPlanes)));
  parts.push_back(remaining);
  const Exact size = size_of(triangle);
  for (const Coordinate first : kCoordinates) {
    for (const Coordinate second : kCoordinates) {
      Exact sum;
      for (const Polygon& part : parts) sum = sum + double_area(part, first, second);
      ASSERT_LE(abs(sum - double_area(triangle, first, second)), size * size * kTolerance)
          << to_text(triangle);
    }
  }
}

void expect_nothing_outside(const Polygon& triangle) {
  const Polygon inside = clip_polygon(triangle, kAllClipPlanes);
  ASSERT_TRUE(inside.empty() || (inside.size() >= 3 && inside.size() <= 9)) << to_text(triangle);
  const Exact least = -size_of(triangle) * kTolerance;
  for (const ClipVertex& v : inside)
    for (const ClipPlane plane : kAllClipPlanes)
      ASSERT_GE(value(distance_inside(plane, v)), least) << to_text(triangle) << "clipped\n"
                                                         << to_text(inside);
}

/// Every triangle of the fan must have the winding of the clipped one.
void expect_winding_kept(const Polygon& triangle) {
  const Polygon inside = clip_polygon(triangle, kAllClipPlanes);
  const Exact size = size_of(triangle);
  for (const Coordinate first : kCoordinates) {
    for (const Coordinate second : kCoordinates) {
      const int turn = double_area(triangle, first, second).sign();
      for (std::size_t i = 1; i + 1 < inside.size(); ++i) {
        const Exact piece = double_area({inside[0], inside[i], inside[i + 1]}, first, second);
        ASSERT_GE(Exact(turn) * piece, -size * size * kTolerance) << to_text(triangle);
      }
    }
  }
}

/// The corners of `polygon` on the edge from a to b, by the triangle's barycentric coordinates.
Polygon corners_on_edge(const Polygon& polygon, const ClipVertex& a, const ClipVertex& b) {
  Polygon found;
  const Exact size = size_of({a, b});
  for (const ClipVertex& v : polygon) {
    const bool is_on_line =
        std::all_of(std::begin(kCoordinates), std::end(kCoordinates), [&](Coordinate first) {
          return std::all_of(std::begin(kCoordinates), std::end(kCoordinates), [&](Coordinate second) {
            return abs(double_area({a, b, v}, first, second)) <= size * size * kTolerance;
          });
        });
    if (is_on_line) found.push_back(v);
  }
  return found;
}

void expect_same_cuts_for_neighbors(RandomNumbers& random) {
  const ClipVertex a = random_vertex(random);
  const ClipVertex b = random_vertex(random);
  const Polygon first = clip_polygon(Polygon{a, b, random_vertex(random)}, kAllClipPlanes);
  const Polygon second = clip_polygon(Polygon{b, a, random_vertex(random)}, kAllClipPlanes);
  if (first.empty() || second.empty()) return;
  Polygon on_first = corners_on_edge(first, a, b);
  Polygon on_second = corners_on_edge(second, a, b);
  ASSERT_EQ(on_first.size(), on_second.size()) << to_text({a, b});
  for (const ClipVertex& v : on_first)
    ASSERT_TRUE(std::any_of(on_second.begin(), on_second.end(), [&](const ClipVertex& other) {
      return is_same(v, other);
    })) << to_text({a, b});
}

template <typename Check>
void for_random_triangles(std::uint64_t seed, int count, Check check) {
  RandomNumbers random(seed);
  for (int i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) check(random_triangle(random));
}

TEST(ClipPolygon, AreaIsConserved) {
  for_random_triangles(1, 3'000, expect_area_conserved);
}
TEST(ClipPolygon, NoPieceLiesOutside) {
  for_random_triangles(2, 5'000, expect_nothing_outside);
}
TEST(ClipPolygon, WindingIsKept) {
  for_random_triangles(3, 3'000, expect_winding_kept);
}

TEST(ClipPolygon, NeighborsGetTheSamePointsOnTheirEdge) {
  RandomNumbers random(4);
  for (int i = 0; i < 5'000 && !HasFatalFailure(); ++i) expect_same_cuts_for_neighbors(random);
}

TEST(ClipPolygon, NeighborsGetTheSamePointWhereOnlyWDiffers) {
  const ClipVertex a = {-4, -4, -4, 7};
  // The first b is farther outside the plane than a is inside, the second equally far.
  for (const ClipVertex& b : {ClipVertex{-4, -4, -4, -4.3}, ClipVertex{-4, -4, -4, 1}}) {
    const Polygon first = clipped_at(ClipPlane::near, {a, b, {0, 0, -4, -4}});
    const Polygon second = clipped_at(ClipPlane::near, {b, a, {0, 0, -4, -4}});
    ASSERT_EQ(first.size(), 3u);
    ASSERT_EQ(second.size(), 3u);
    EXPECT_TRUE(is_same(first[1], second[0]));
  }
}

/// A vertex as far inside `plane` as `v` is inside the near plane.
ClipVertex turned_from_near(ClipPlane plane, ClipVertex v) {
  if (plane == ClipPlane::near) return v;
  if (plane == ClipPlane::far) return {v.x, v.y, -v.z, v.w};
  if (plane == ClipPlane::left) return {v.z, v.x, v.y, v.w};
  if (plane == ClipPlane::right) return {-v.z, v.x, v.y, v.w};
  if (plane == ClipPlane::below) return {v.x, v.z, v.y, v.w};
  return {v.x, -v.z, v.y, v.w};
}

/// Two vertices as far from the near plane, one inside and one outside, with errors of their own. They differ
/// in z, in w or in both, perhaps also in x and y.
std::pair<ClipVertex, ClipVertex> equally_far_pair(RandomNumbers& random) {
  const auto inexact = [&](double number) {
    return Ball::with_error({number, 0}, std::fabs(random.with_exponent(-100, -60)));
  };
  const Ball x = inexact(random.whole(-1, 1)), y = inexact(random.whole(-1, 1));
  const Ball other_x = random.whole(0, 1) == 0 ? x : inexact(random.whole(2, 3));
  const Ball other_y = random.whole(0, 1) == 0 ? y : inexact(random.whole(2, 3));
  const Ball z = inexact(2), w = inexact(2);
  switch (random.whole(0, 3)) {
    case 0:
      return {{x, y, z, w}, {other_x, other_y, inexact(-6), w}};
    case 1:
      return {{x, y, z, w}, {other_x, other_y, z, inexact(-6)}};
    case 2:
      return {{x, y, z, w}, {other_x, other_y, inexact(-7), inexact(3)}};
    default:
      return {{x, y, z, w}, {other_x, other_y, inexact(3), inexact(-7)}};
  }
}

TEST(ClipPolygon, NeighborsGetTheSamePointHalfwayBetweenTheirCorners) {
  RandomNumbers random(6);
  for (int i = 0; i < 500; ++i) {
    const auto [near_a, near_b] = equally_far_pair(random);
    for (const ClipPlane plane : kAllClipPlanes) {
      const ClipVertex a = turned_from_near(plane, near_a), b = turned_from_near(plane, near_b);
      const ClipVertex c = turned_from_near(plane, {1, 2, -9, 1});
      const Polygon first = clipped_at(plane, {a, b, c});
      const Polygon second = clipped_at(plane, {b, a, c});
      ASSERT_EQ(first.size(), 3u);
      ASSERT_EQ(second.size(), 3u);
      ASSERT_TRUE(is_same(first[1], second[0])) << to_text({a, b});
    }
  }
}

TEST(ClipPolygon, LongAllPropertiesHold) {
  for_random_triangles(101, 100'000, expect_area_conserved);
  for_random_triangles(102, 100'000, expect_nothing_outside);
  for_random_triangles(103, 100'000, expect_winding_kept);
  RandomNumbers random(104);
  for (int i = 0; i < 100'000 && !HasFatalFailure(); ++i) expect_same_cuts_for_neighbors(random);
}

TEST(ClipPolygon, PiecesAreNearlyExact) {
  RandomNumbers random(5);
  for (int i = 0; i < 3'000; ++i) {
    const Polygon triangle = random_triangle(random);
    const Exact size = size_of(triangle);
    for (const ClipVertex& v : clipped_at(ClipPlane::near, triangle))
      for (const Coordinate c : kCoordinates)
        ASSERT_LE(radius<448>(v.*c), size * kTolerance) << to_text(triangle);
  }
}

TEST(ToClipSpace, PutsTheNearPlaneAtMinusWAndTheFarPlaneAtW) {
  const ProjectionTransform projection = {true, 1, 0, 1, 0, 0.1, 7};
  const ClipVertex near = to_clip_space(projection, {0, 0, -0.1});
  const ClipVertex far = to_clip_space(projection, {0, 0, -7});
  EXPECT_EQ(distance_inside(ClipPlane::near, near).sign(), 0);
  EXPECT_EQ(distance_inside(ClipPlane::far, far).sign(), 0);
}

/// The bit of a plane in an outcode.
unsigned bit_of(ClipPlane plane) {
  return 1u << (std::ranges::find(kAllClipPlanes, plane) - kAllClipPlanes.begin());
}

TEST(ToClipSpace, TellsTheLastBitBesideTheNearPlane) {
  const double near = 0.1;
  for (const double far : {0.1 + 0x1p-56, 0.2, 1e12, 1e300}) {
    const ProjectionTransform projection = {true, 1, 0, 1, 0, near, far};
    EXPECT_EQ(outcode(to_clip_space(projection, {0, 0, -std::nextafter(near, 1)})) & 1u, 0u) << far;
    EXPECT_EQ(outcode(to_clip_space(projection, {0, 0, -std::nextafter(near, 0)})) & 1u, 1u) << far;
  }
}

TEST(ToClipSpace, TellsTheLastBitBesideEverySideWithOrWithoutInset) {
  const double low = 0, high = 0x1p100, tiny = 0x1p-100;
  for (const bool is_perspective : {false, true}) {
    ProjectionTransform projection = {is_perspective, Ball(2) / high, -1, Ball(2) / high, -1, 1, 9};
    if (is_perspective) projection.x_offset = projection.y_offset = 1;
    projection.sides = {VolumeSides{1, low, high}, VolumeSides{1, low, high}};
    const auto code = [&](double x, double y) { return outcode(to_clip_space(projection, {x, y, -1})); };
    EXPECT_EQ(code(low, low), 0u);
    EXPECT_EQ(code(-tiny, high), bit_of(ClipPlane::left));
    EXPECT_EQ(code(high, -tiny), bit_of(ClipPlane::below));
    EXPECT_EQ(code(std::nextafter(high, 2 * high), tiny), bit_of(ClipPlane::right));
    EXPECT_EQ(code(tiny, std::nextafter(high, 2 * high)), bit_of(ClipPlane::above));
    // Half of the width and half of the height are pulled in: the left side is at a quarter.
    const auto pulled_in = [&](double x) {
      return outcode(to_clip_space(projection, {x, high / 2, -5}, 0.5)) & bit_of(ClipPlane::left);
    };
    const double quarter = (is_perspective ? 5 : 1) * high / 4;
    EXPECT_EQ(pulled_in(quarter), 0u);
    EXPECT_NE(pulled_in(std::nextafter(quarter, 0)), 0u);
  }
}

TEST(ToClipSpace, OfAParallelProjectionHasWOne) {
  const ProjectionTransform projection = {false, 2, 0.5, 3, -0.5, -1, 3};
  const ClipVertex v = to_clip_space(projection, {1, 1, -1});
  EXPECT_EQ(v.x, Ball(2.5));
  EXPECT_EQ(v.y, Ball(2.5));
  EXPECT_EQ(v.z, Ball(0));
  EXPECT_EQ(v.w, Ball(1));
}

}  // namespace
}  // namespace pipeline
