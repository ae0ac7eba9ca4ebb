#include "libpipeline/vertex/close_layers.h"

#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

const ProjectionTransform kDeep = {true, 1, 0, 1, 0, 0.001, 1000};

/// Two triangles that fill half of the width and the height of the window at this distance, to NDC.
void add_wall(TriangleBatch& batch, const ProjectionTransform& projection, double distance,
              double share = 0.5) {
  const double side = share * distance, near = projection.near, far = projection.far;
  const double z = (far + near) / (far - near) - 2 * far * near / (far - near) / distance;
  const auto corner = [&](int x, int y) { return Vec3{x * side / distance, y * side / distance, z}; };
  batch.add({corner(-1, -1), corner(1, -1), corner(1, 1)}, batch.size(), {});
  batch.add({corner(-1, -1), corner(1, 1), corner(-1, 1)}, batch.size(), {});
}

std::optional<CloseLayers::Found> found(const TriangleBatch& p_ndc, std::optional<int> decimals = 7,
                                        const ProjectionTransform& projection = kDeep) {
  CloseLayers layers(projection, decimals);
  layers.add(p_ndc);
  return layers.found();
}

TEST(CloseLayers, OfTwoWallsThatSevenDecimalsPrintAlikeAreFound) {
  TriangleBatch walls;
  add_wall(walls, kDeep, 100.1, 0.75);
  add_wall(walls, kDeep, 100);
  const auto layers = found(walls);
  ASSERT_TRUE(layers);
  EXPECT_NEAR(layers->share, 0.5 * 0.5 / (0.75 * 0.75), 0.05);
  EXPECT_NEAR(layers->gap, 0.1, 1e-6);
  ASSERT_TRUE(layers->enough);
  EXPECT_FALSE(found(walls, *layers->enough));
  EXPECT_TRUE(found(walls, *layers->enough - 1));
  EXPECT_FALSE(found(walls, std::nullopt));
}

TEST(CloseLayers, ThatAWallInFrontHidesDoNotCount) {
  TriangleBatch walls;
  add_wall(walls, kDeep, 100.1);
  add_wall(walls, kDeep, 100);
  add_wall(walls, kDeep, 5, 0.625);
  EXPECT_FALSE(found(walls));
  std::ranges::reverse(walls.triangles);
  EXPECT_FALSE(found(walls));
}

TEST(CloseLayers, AreNotLookedForWhereDecimalsAreFine) {
  const ProjectionTransform shallow = {true, 1, 0, 1, 0, 1, 100};
  TriangleBatch walls;
  add_wall(walls, shallow, 50);
  add_wall(walls, shallow, 50.00001);
  EXPECT_FALSE(found(walls, 7, shallow));
  EXPECT_TRUE(found(walls, 5, shallow));
}

TEST(CloseLayers, AreNeitherNeighborsNorTheSameTriangleTwice) {
  TriangleBatch walls;
  add_wall(walls, kDeep, 100);
  add_wall(walls, kDeep, 100);
  EXPECT_FALSE(found(walls));
}

/// Triangles up to half as large as they are far away, at distances up to a tenth of `far`.
TriangleBatch random_triangles(RandomNumbers& random, const ProjectionTransform& projection) {
  TriangleBatch p_view;
  const double nearest = 20 * projection.near, farthest = projection.far / 10;
  for (int i = 0; i < 30; ++i) {
    const double distance = std::exp(random.between(std::log(nearest), std::log(farthest)));
    const auto corner = [&] {
      return Vec3{distance * random.between(-1, 1), distance * random.between(-1, 1),
                  -distance * random.between(0.75, 1.25)};
    };
    p_view.add({corner(), corner(), corner()}, p_view.size(), {});
  }
  return p_view;
}

TEST(CloseLayers, AreNotFoundInRandomScenesWithoutAny) {
  RandomNumbers random(1);
  int found_count = 0, with_three_decimals = 0;
  for (int i = 0; i < 1000; ++i) {
    const double ratio = std::pow(10, random.between(i % 3 == 0 ? 3 : 1, i % 3 == 0 ? 5 : 3));
    const double near = std::pow(10, random.between(-2, 1));
    const ProjectionTransform projection = {true, 1, 0, 1, 0, near, near * ratio};
    TriangleBatch p_view = random_triangles(random, projection);
    const TriangleBatch p_ndc = projected(p_view, projection, ClipMode::none).p_ndc;
    if (found(p_ndc, 7, projection)) ++found_count;
    if (found(p_ndc, 3, projection)) ++with_three_decimals;
  }
  EXPECT_EQ(found_count, 0);
  EXPECT_GT(with_three_decimals, 500);
}

}  // namespace
}  // namespace pipeline
