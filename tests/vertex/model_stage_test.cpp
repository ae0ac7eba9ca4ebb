#include "libpipeline/vertex/model_stage.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

// Lines 1 to 4 of a scene; its commands start on line 5.
const std::string kCamera = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n";
// A triangle whose first vertex is the point (1 2 3).
const std::string kDegenerate = "triangle\n1 2 3\n0 0 0\n0 0 0\n";

TriangleBatch triangles_from(int descriptor) {
  TextReader text(descriptor, "scene.txt");
  SceneReader scene(text);
  CoordinateRounder rounder(Precision::extended, {}, "scene.txt");
  ModelStage stage(scene);
  TriangleBatch all;
  for (TriangleBatch batch; stage.read(batch);) {
    stage.transform(batch, rounder);
    for (std::size_t i = 0; i < batch.size(); ++i)
      all.add(batch.triangles[i], batch.numbers[i], batch.locations[i]);
  }
  return all;
}

/// The world-space triangles of a scene with these commands.
TriangleBatch triangles_of(const std::string& commands) {
  return triangles_from(TextFile(kCamera + commands + "end\n").descriptor());
}

/// The images of the point (1 2 3), one for each triangle of the commands.
std::vector<Vec3> first_vertices_of(const std::string& commands) {
  std::vector<Vec3> vertices;
  for (const Triangle& triangle : triangles_of(commands).triangles) vertices.push_back(triangle[0]);
  return vertices;
}

std::string error_of(const std::string& commands) {
  return message_of([&] { triangles_of(commands); });
}

// A blank at the end of a line keeps a triangle from the fastest path.
TEST(ModelStage, AttributesAreTheSameByEveryPath) {
  for (const bool has_columns : {false, true}) {
    std::string commands = has_columns ? "attributes color normal\n" : "attributes normal\n";
    constexpr std::size_t kCount = 3000;
    const auto blue_of = [&](std::size_t i) { return has_columns ? i % 256 : i / 100; };
    for (std::size_t i = 0; i < kCount; ++i) {
      if (!has_columns && i % 100 == 0) commands += "color 1 2 " + std::to_string(i / 100) + "\n";
      const std::string color = has_columns ? " 1 2 " + std::to_string(i % 256) : "";
      const std::string line =
          std::to_string(i) + ".5 0.0 0.0" + color + " 0.00 -2.00 0.00" + (i % 90 == 7 ? " \n" : "\n");
      commands += "triangle\n" + line + line + line;
    }
    const TextFile file(kCamera + commands + "end\n");
    TextReader text(file.descriptor(), "scene.txt");
    SceneReader scene(text);
    CoordinateRounder rounder(Precision::extended, {}, "scene.txt");
    ModelStage stage(scene);
    std::size_t count = 0;
    for (TriangleBatch batch; stage.read(batch);) {
      stage.transform(batch, rounder);
      for (std::size_t i = 0; i < batch.size(); ++i, ++count) {
        const Vec3 color = {1, 2, static_cast<double>(blue_of(count))};
        ASSERT_EQ(batch.triangles[i][1], (Vec3{static_cast<double>(count) + 0.5, 0, 0})) << count;
        ASSERT_EQ(batch.attributes.colors.at(i), (Triangle{color, color, color})) << count;
        ASSERT_EQ(batch.attributes.normals.at(i)[2], (Vec3{0, -1, 0})) << count;
        ASSERT_EQ(batch.numbers[i], count);
      }
      ASSERT_EQ(batch.attributes.colors.size(), batch.size());
      ASSERT_EQ(batch.attributes.normals.size(), batch.size());
    }
    EXPECT_EQ(count, kCount);
  }
}

TEST(ModelStage, AWrongAttributeAfterFastTrianglesIsAnError) {
  const auto triangles = [](int count, const std::string& columns) {
    std::string text;
    for (int i = 0; i < count; ++i)
      text += "triangle\n0 0 0" + columns + "0 0 0" + columns + "0 0 0" + columns;
    return text;
  };
  EXPECT_EQ(error_of("attributes normal\n" + triangles(101, " 0 1 0\n") +
                     "triangle\n1 0 0 0 1 0\n1 0 0 0 0 0\n1 0 0 0 1 0\n"),
            "scene.txt:412:7: expected a normal of vertex 2 of 3 other than 0 0 0, found 0 0 0");
  EXPECT_EQ(error_of("attributes color\n" + triangles(101, " 0 1 0\n") +
                     "triangle\n1 0 0 0 1 0\n1 0 0 0 0 900\n1 0 0 0 1 0\n"),
            "scene.txt:412:11: expected the blue of vertex 2 of 3 (x y z r g b, by the line 'attributes "
            "color') from 0 to 255, found '900'");
}

TEST(ModelStage, LocatesItsVertices) {
  EXPECT_EQ(triangles_of("triangle\n\n1 2 3\n 0 0 0\n# c\n0 0 0\n").locations[0],
            (VertexLocations{{7, {8, 2}, 10}}));
}

TEST(ModelStage, AMatrixHoldsAcrossBatches) {
  std::string many;
  for (std::size_t i = 0; i < kBatchSize; ++i) many += kDegenerate;
  const std::vector<Vec3> vertices =
      first_vertices_of("translate 1 0 0\n" + many + many + "translate 1 0 0\n" + many);
  std::vector<Vec3> expected(2 * kBatchSize, {2, 2, 3});
  expected.resize(3 * kBatchSize, {3, 2, 3});
  EXPECT_EQ(vertices, expected);
}

// A comment keeps a line from the fast paths.
TEST(ModelStage, TrianglesAreTheSameByEveryPath) {
  const std::string vertex = "0.1000000 -2.0000000 12345678.1234567";
  const auto scene = [&](const std::string& comment) {
    const std::string triangle = "triangle\n" + vertex + comment + "\n" + vertex + "\n" + vertex + "\n";
    return triangle + triangle + "\n" + triangle + "\n\n" + triangle + "push\nscale 2 2 2\n" + triangle +
           triangle + "pop\n" + triangle;
  };
  const TriangleBatch fast = triangles_of(scene(""));
  const TriangleBatch slow = triangles_of(scene(" # slow"));
  ASSERT_EQ(fast.size(), 7u);
  EXPECT_EQ(fast.triangles, slow.triangles);
  EXPECT_EQ(fast.numbers, slow.numbers);
  EXPECT_EQ(fast.locations, slow.locations);
}

TEST(ModelStage, DeliversTheTrianglesBeforeAnError) {
  const TextFile file(kCamera + kDegenerate + kDegenerate + "pop\n");
  TextReader text(file.descriptor(), "scene.txt");
  SceneReader scene(text);
  ModelStage stage(scene);
  TriangleBatch batch;
  ASSERT_TRUE(stage.read(batch));
  EXPECT_EQ(batch.size(), 2u);
  EXPECT_EQ(message_of([&] { stage.read(batch); }),
            "scene.txt:13:1: expected a matrix that 'push' has saved, found 'pop' without one");
}

TEST(ModelStage, ReadsASceneThatArrivesByteByByte) {
  const TextInPieces slow(
      TextInPieces::bytes_of(kCamera + "push\ntranslate 1 0 0\n" + kDegenerate + "pop\nend"));
  EXPECT_EQ(triangles_from(slow.descriptor()).triangles.at(0)[0], (Vec3{2, 2, 3}));
}

}  // namespace
}  // namespace pipeline
