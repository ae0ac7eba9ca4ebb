#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_writer.h"
#include "tests/stream/stage_text_io.h"

namespace pipeline {
namespace {

const std::string kPlainTriangle = "0 0 0\n1 0 0\n0 1 0\n\n";
const std::string kSphere = "sphere\n1 2 3\n3 2 3\n1 4 3\n1 2 5\n\n";

std::string error_of_copy(const std::string& text) {
  return message_of([&] { copy_of(text); });
}

TEST(Spheres, AreReadAndWrittenAmongTriangles) {
  for (const std::string& text :
       {kSphere, kPlainTriangle + kSphere, kSphere + kPlainTriangle,
        kSphere + kSphere + kPlainTriangle + kPlainTriangle + kSphere,
        "triangle 7\n" + kSphere + kPlainTriangle, "framed\n" + kPlainTriangle + kSphere + "end\n"})
    EXPECT_EQ(copy_of(text), text);
}

TEST(Spheres, FollowTheTrianglesOfTheirBatch) {
  const TextFile file(kPlainTriangle + kSphere + kSphere + kPlainTriangle + kSphere);
  TextReader reader(file.descriptor(), "in.txt");
  StageReader stage(reader);
  stage.accept_spheres();
  TriangleBatch batch;
  std::vector<std::vector<std::uint64_t>> numbers;
  while (stage.read(batch)) {
    EXPECT_EQ(batch.size(), 1u);
    numbers.emplace_back();
    for (std::size_t i = 0; i < batch.object_count(); ++i) numbers.back().push_back(batch.number_of(i));
    EXPECT_EQ(batch.spheres.back().points, (SpherePoints{Vec3{1, 2, 3}, {3, 2, 3}, {1, 4, 3}, {1, 2, 5}}));
  }
  EXPECT_EQ(numbers, (std::vector<std::vector<std::uint64_t>>{{0, 1, 2}, {3, 4}}));
}

TEST(Spheres, AreDroppedBeforeTriangles) {
  for (std::size_t count = 0; count <= 3; ++count) {
    TriangleBatch batch;
    batch.add({}, 0, {});
    batch.spheres = {{.number = 1}, {.number = 2}};
    batch.truncate(count);
    EXPECT_EQ(batch.object_count(), count);
    EXPECT_EQ(batch.size(), count == 0 ? 0u : 1u);
  }
}

TEST(Spheres, AreRefusedWhereTrianglesAloneAreRead) {
  const std::string refused =
      "expected triangles alone, found a sphere: trace draws it, and model --facets N makes triangles of it";
  EXPECT_EQ(message_of([] { triangles_of(kSphere); }), "in.txt:1:1: " + refused);
  EXPECT_EQ(message_of([] { triangles_of(kPlainTriangle + kSphere); }), "in.txt:5:1: " + refused);
  // Projected texts have none.
  EXPECT_EQ(error_of_copy("attributes w\n" + kSphere), "in.txt:2:1: " + refused);
  EXPECT_EQ(error_of_copy("projected ortho -1 1 -1 1 -1 1\n" + kSphere), "in.txt:2:1: " + refused);
}

TEST(Spheres, NameTheWordThatIsWrong) {
  EXPECT_EQ(error_of_copy("sphere 1\n"),
            "in.txt:1:8: expected the end of the line after 'sphere', found '1'");
  EXPECT_EQ(error_of_copy("sphere\n0 0 0\n\n"),
            "in.txt:3:1: expected the center + r i of a sphere (x y z), found a blank line inside a sphere");
  EXPECT_EQ(error_of_copy("sphere\n0 0 0\n1 0 0\n0 1 0\n"),
            "in.txt:5:1: expected the center + r k of a sphere (x y z), found the end of the input inside a "
            "sphere");
  EXPECT_EQ(error_of_copy("sphere\n0 0 0 0\n"),
            "in.txt:2:7: expected the end of the line after the center of a sphere (x y z), found '0'");
  EXPECT_EQ(error_of_copy("attributes color\nsphere\n0 0 0 1 2 3\n0 0 1 1 2 4\n"),
            "in.txt:4:7: expected the color of the sphere's center, found '1'");
  EXPECT_EQ(error_of_copy("sphere\n0 0 0\nerror model: no\n"),
            "in.txt:3:1: an earlier stage failed: model: no");
}

}  // namespace
}  // namespace pipeline
