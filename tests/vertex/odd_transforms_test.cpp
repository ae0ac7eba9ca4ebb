#include "libpipeline/vertex/odd_transforms.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libpipeline/vertex/model_stage.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

using Notes = std::vector<std::string>;

/// Of a scene whose commands begin on line 5.
Notes notes_of(const std::string& commands) {
  const TextFile file("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n" + commands + "end\n");
  TextReader text(file.descriptor(), "scene.txt");
  SceneReader scene(text);
  ModelStage stage(scene);
  std::size_t count = 0;
  for (TriangleBatch batch; stage.read(batch);) count += batch.size();
  return stage.odd_transforms().notes("scene.txt", count > 0);
}

const std::string kTriangle = "triangle\n1 2 3\n0 1 0\n1 0 0\n";

TEST(OddTransforms, AnAngleThatIsAPartOfAFullTurnInRadiansIsNoted) {
  for (const auto& [angle, degrees] : {std::pair("1.5708", "90"),
                                       {"1.5707", "90"},
                                       {"-0.785398", "-45"},
                                       {"3.14159265358979", "180"},
                                       {"0.5236", "30"},
                                       {"6.2832", "360"}})
    EXPECT_EQ(
        notes_of("rotate " + std::string(angle) + " 0 0 1\n" + kTriangle),
        Notes{std::string("scene.txt:5:1: this angle looks like radians, but angles are in degrees: try ") +
              degrees});
}

TEST(OddTransforms, OtherAnglesAreNot) {
  for (const char* angle :
       {"0", "1.571", "3.14", "1.5", "1.5710", "0.5233", "1.570697", "90", "6.8068", "45.0001"})
    EXPECT_EQ(notes_of("rotate " + std::string(angle) + " 0 0 1\n" + kTriangle), Notes{}) << angle;
}

TEST(OddTransforms, ARotationByNothingAboutALongAxisIsNoted) {
  EXPECT_EQ(notes_of("scale 1 1 1\nrotate 0 0 1 90\nrotate 0 45 0 0\n" + kTriangle),
            Notes{"scene.txt:6:1: this rotate turns by 0 degrees: the angle comes first, then the axis"});
  EXPECT_EQ(notes_of("rotate 0 0 1 0\nrotate 0 -1 1 1\nrotate 1 0 0 90\n" + kTriangle), Notes{});
}

TEST(OddTransforms, APushThatIsOpenAtTheEndIsNoted) {
  const std::string words = " without a pop, the first of them here: the scene's end undoes no transform";
  EXPECT_EQ(notes_of("push\npop\npush\npush\npop\npush\n" + kTriangle),
            Notes{"scene.txt:7:1: 2 push commands" + words});
  EXPECT_EQ(notes_of("push\n" + kTriangle + "pop\npush\n"), Notes{"scene.txt:11:1: 1 push command" + words});
  EXPECT_EQ(notes_of("push\npush\n" + kTriangle + "pop\npop\n"), Notes{});
}

TEST(OddTransforms, ATransformThatNoTriangleFollowsIsNoted) {
  const std::string words = ": no triangle comes after this transform: write it before what it is to move";
  for (const char* transform : {"translate 1 0 0\n", "scale 2 2 2\n", "rotate 90 1 0 0\n"})
    EXPECT_EQ(notes_of(kTriangle + transform), Notes{"scene.txt:9:1" + words});
  EXPECT_EQ(notes_of("push\n" + kTriangle + "translate 1 0 0\npop\n"), Notes{});
  EXPECT_EQ(notes_of("translate 1 0 0\n"), Notes{});  // that there is no triangle is another note
  EXPECT_EQ(notes_of("translate 1 0 0\n" + kTriangle), Notes{});
}

}  // namespace
}  // namespace pipeline
