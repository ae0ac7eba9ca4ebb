#include "libpipeline/vertex/lost_digits.h"

#include <cmath>

#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

const ProjectionTransform kDeep = {true, 1, 0, 1, 0, 0.001, 1000};
const ProjectionTransform kMap = {false, 1e-3, 0, 1e-3, 0, 1, 1e6};

/// Two triangles that fill a square of the window at this distance, in view space.
void add_wall(TriangleBatch& p_view, double distance, double half_side) {
  const auto corner = [&](int x, int y) { return Vec3{x * half_side, y * half_side, -distance}; };
  p_view.add({corner(-1, -1), corner(1, -1), corner(1, 1)}, p_view.size(), {});
  p_view.add({corner(-1, -1), corner(1, 1), corner(-1, 1)}, p_view.size(), {});
}

TriangleBatch part_of(const TriangleBatch& batch, std::size_t begin, std::size_t end) {
  TriangleBatch part;
  for (std::size_t i = begin; i < end; ++i) part.add(batch.triangles[i], batch.numbers[i], {});
  return part;
}

std::optional<LostDigits::Found> found(TriangleBatch p_view, std::optional<int> decimals = 7,
                                       const ProjectionTransform& projection = kDeep,
                                       std::size_t batch_size = 2048, std::optional<int> decimals_read = 7) {
  LostDigits lost_digits(projection, decimals, decimals_read);
  for (std::size_t i = 0; i < p_view.size(); i += batch_size) {
    const TriangleBatch part = part_of(p_view, i, std::min(i + batch_size, p_view.size()));
    lost_digits.add(part, projected(part, projection, ClipMode::automatic).p_ndc);
  }
  return lost_digits.found();
}

TEST(LostDigits, OfTwoWallsThatSevenDecimalsPrintAlikeAreFound) {
  TriangleBatch walls;
  add_wall(walls, 100.1, 75);
  add_wall(walls, 100, 50);
  const auto lost = found(walls);
  ASSERT_TRUE(lost);
  EXPECT_NEAR(lost->share, 0.5 * 0.5 / (0.75 * 0.75), 0.05);
  EXPECT_FALSE(lost->is_of_edges);
  EXPECT_FALSE(lost->may_be_one_plane);
  EXPECT_TRUE(lost->near_helps);
  ASSERT_TRUE(lost->enough);
  EXPECT_FALSE(found(walls, lost->enough));
  EXPECT_FALSE(found(walls, std::nullopt));
}

TEST(LostDigits, OfLayersOfAMapAreFound) {
  TriangleBatch map;
  add_wall(map, 700000, 800);
  add_wall(map, 699999.98, 400);
  const auto lost = found(map, 7, kMap);
  ASSERT_TRUE(lost);
  EXPECT_NEAR(lost->share, 0.25, 0.05);
  EXPECT_EQ(lost->enough, 8);
  EXPECT_FALSE(lost->near_helps);
  TriangleBatch apart;
  add_wall(apart, 700000, 800);
  add_wall(apart, 699999, 400);
  EXPECT_FALSE(found(apart, 7, kMap));
}

TEST(LostDigits, OfLayersCutAtTheNearPlaneAreFound) {
  TriangleBatch floors;
  floors.add({Vec3{-50, -1, -800}, Vec3{50, -1, -800}, Vec3{0, -1, 50}}, 0, {});
  floors.add({Vec3{-50, -0.99999, -900}, Vec3{50, -0.99999, -900}, Vec3{0, -0.99999, 50}}, 1, {});
  for (const auto n : {7U, 8U, 7U}) floors.add({Vec3{0, 0, -950}, Vec3{1, 0, -950}, Vec3{0, 1, -950}}, n, {});
  EXPECT_TRUE(found(floors));
  EXPECT_FALSE(found(floors, 12));
}

TEST(LostDigits, ThatAWallInFrontHidesDoNotCount) {
  TriangleBatch walls;
  add_wall(walls, 100.1, 50);
  add_wall(walls, 100, 50);
  add_wall(walls, 5, 3.125);
  EXPECT_FALSE(found(walls));
  std::ranges::reverse(walls.triangles);
  EXPECT_FALSE(found(walls));
}

TEST(LostDigits, AreNotThoseOfSurfacesInOnePlaneThatFacesTheEye) {
  TriangleBatch walls;
  add_wall(walls, 100, 50);
  add_wall(walls, 100, 30);
  add_wall(walls, 100, 50);
  EXPECT_FALSE(found(walls));
}

TEST(LostDigits, OfSurfacesInOnePlaneAreFoundWhereNumbersAreAsCoarseAsPixels) {
  TriangleBatch layers;
  add_wall(layers, 0.005, 0.004);
  add_wall(layers, 0.005, 0.002);
  const ProjectionTransform projection = {true, 1, 0, 1, 0, 0.001, 1};
  const auto lost = found(layers, 5, projection, 2048, 5);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(lost->may_be_one_plane);
  EXPECT_NEAR(lost->share, 0.25 / 2, 0.03);
  EXPECT_FALSE(found(layers, 7, projection, 2048, 7));
}

TEST(LostDigits, InFrontOfManyLargeTrianglesAreFound) {
  RandomNumbers random(3);
  TriangleBatch p_view;
  for (int i = 0; i < 4000; ++i) {
    const auto corner = [&] {
      return Vec3{random.between(-900, 900), random.between(-900, 900), -random.between(200, 900)};
    };
    p_view.add({corner(), corner(), corner()}, p_view.size(), {});
  }
  add_wall(p_view, 100.1, 75);
  add_wall(p_view, 100, 50);
  EXPECT_TRUE(found(p_view));
}

TEST(LostDigits, OfSurfacesInATiltedPlaneAreNeverEnough) {
  TriangleBatch p_view;
  const Vec3 a = {-3, -2, -4}, b = {3, -2, -6}, c = {0, 3, -7};
  const auto inside = [&](double of_a, double of_b) {
    const double of_c = 1 - of_a - of_b;
    return Vec3{of_a * a.x + of_b * b.x + of_c * c.x, of_a * a.y + of_b * b.y + of_c * c.y,
                of_a * a.z + of_b * b.z + of_c * c.z};
  };
  p_view.add({a, b, c}, 0, {});
  p_view.add({inside(0.8, 0.1), inside(0.1, 0.77), inside(0.13, 0.06)}, 1, {});
  const auto lost = found(p_view, 7, kSimple);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(lost->may_be_one_plane);
  EXPECT_FALSE(lost->enough);
}

/// A grid of triangles of which each is `size` units wide and high, at the distance 100 * size, as text with
/// seven decimals holds it.
TriangleBatch fine_grid(double size) {
  TriangleBatch p_view;
  const auto in_text = [](double number) { return std::nearbyint(number * 1e7) / 1e7; };
  const auto corner = [&](int x, int y) {
    return Vec3{in_text(size * (x + 0.217 * y)), in_text(size * (y + 0.113 * x)), in_text(-99.37 * size)};
  };
  for (int x = -20; x < 20; ++x)
    for (int y = -20; y < 20; ++y) {
      p_view.add({corner(x, y), corner(x + 1, y), corner(x + 1, y + 1)}, p_view.size(), {});
      p_view.add({corner(x, y), corner(x + 1, y + 1), corner(x, y + 1)}, p_view.size(), {});
    }
  return p_view;
}

TEST(LostDigits, OfEdgesInASmallSceneAreFound) {
  const ProjectionTransform projection = {true, 4, 0, 4, 0, 1e-5, 1};
  const auto lost = found(fine_grid(1.03e-5), 7, projection);
  ASSERT_TRUE(lost);
  EXPECT_TRUE(lost->is_of_edges);
  EXPECT_NEAR(lost->share, 0.01, 0.006);  // three edges, each off by some 4e-8 of 1e-5
  EXPECT_FALSE(found(fine_grid(1.03e-3), 7, projection));
  // A text with zeros at the ends of its numbers has lost nothing.
  EXPECT_TRUE(found(fine_grid(1.03e-5), 12, projection, 2048, 7));
  EXPECT_FALSE(found(fine_grid(1.03e-5), 12, projection, 2048, 9));
}

/// Triangles up to half as large as they are far away, at distances up to a tenth of `far`.
TriangleBatch random_triangles(RandomNumbers& random, const ProjectionTransform& projection, int count) {
  TriangleBatch p_view;
  const double nearest = 20 * projection.near, farthest = projection.far / 10;
  for (int i = 0; i < count; ++i) {
    const double distance = std::exp(random.between(std::log(nearest), std::log(farthest)));
    const auto corner = [&] {
      return Vec3{distance * random.between(-1, 1), distance * random.between(-1, 1),
                  -distance * random.between(0.75, 1.25)};
    };
    p_view.add({corner(), corner(), corner()}, p_view.size(), {});
  }
  return p_view;
}

TEST(LostDigits, AreNotFoundInRandomScenesWithoutCloseLayers) {
  RandomNumbers random(1);
  int found_count = 0, with_three_decimals = 0;
  for (int i = 0; i < 300; ++i) {
    const double ratio = std::pow(10, random.between(i % 3 == 0 ? 3 : 1, i % 3 == 0 ? 5 : 3));
    const double near = std::pow(10, random.between(-2, 1));
    const ProjectionTransform projection = {true, 1, 0, 1, 0, near, near * ratio};
    const TriangleBatch p_view = random_triangles(random, projection, 30);
    if (found(p_view, 7, projection)) ++found_count;
    if (found(p_view, 3, projection)) ++with_three_decimals;
  }
  EXPECT_EQ(found_count, 0);
  EXPECT_GT(with_three_decimals, 50);
}

TEST(LostDigits, AreTheSameWhereverBatchesEnd) {
  RandomNumbers random(2);
  TriangleBatch p_view;
  for (const Triangle& triangle : random_triangles(random, kDeep, 2500).triangles) {
    Triangle before = triangle;
    for (Vec3& p : before) p = {p.x / 1.0000001, p.y / 1.0000001, p.z / 1.0000001};
    p_view.add(triangle, p_view.size(), {});
    p_view.add(before, p_view.size(), {});
  }
  const auto lost = found(p_view);
  ASSERT_TRUE(lost);
  for (const std::size_t batch_size : {7u, 300u}) {
    const auto again = found(p_view, 7, kDeep, batch_size);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->share, lost->share);
    EXPECT_EQ(again->enough, lost->enough);
  }
}

}  // namespace
}  // namespace pipeline
