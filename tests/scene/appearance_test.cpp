#include "libpipeline/scene/appearance.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "libpipeline/scene/scene.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

// Lines 1 to 4 of a scene; its commands start on line 5.
const std::string kCameraLines = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n";
const std::string kTriangleLines = "triangle\n0 0 0\n1 0 0\n0 1 0\n";

/// The contents of a scene.
struct ReadScene {
  Appearance appearance;
  std::vector<Light> lights;
  std::vector<TriangleLines> triangles;
};

ReadScene scene_of(const std::string& commands) {
  const TextFile file(kCameraLines + commands + "end\n");
  TextReader text(file.descriptor(), "scene.txt");
  SceneReader reader(text);
  ReadScene scene;
  for (Command command = reader.next(); !std::holds_alternative<EndCommand>(command);
       command = reader.next()) {
    if (const auto* light = std::get_if<LightCommand>(&command)) scene.lights.push_back(light->light.value);
    if (std::holds_alternative<TriangleCommand>(command)) scene.triangles.push_back(reader.lines());
  }
  scene.appearance = reader.appearance();
  return scene;
}

std::string error_of_appearance(const std::string& commands) {
  return message_of([&] { scene_of(commands); });
}

TEST(Appearance, APlainSceneGivesNone) {
  const Appearance appearance = scene_of(kTriangleLines).appearance;
  EXPECT_FALSE(appearance.attributes || appearance.background || appearance.ambient ||
               !appearance.materials.empty() || appearance.attenuation || !appearance.lights.empty());
}

TEST(Appearance, TakesEveryCommandOnItsOwnLineOrTheNext) {
  for (const std::string blank : {" ", "\n"}) {
    const ReadScene scene =
        scene_of("background" + blank + "0 127.5 255\nambient" + blank + "0.1 0.2 0.3\nmaterial" + blank +
                 "0.5 0.25 2 40\nattenuation" + blank + "1 0 0.5\nlight" + blank + "1 2 3 0.5 1 2\nlight" +
                 blank + "4 5 6 1 1 1\n");
    EXPECT_EQ(scene.appearance.background->value.color, (Vec3{0, 127.5, 255}));
    EXPECT_EQ(scene.appearance.ambient->value, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(scene.appearance.materials.at(0).value.diffuse, 0.25);
    EXPECT_EQ(scene.appearance.materials.at(0).value.shininess, 40u);
    EXPECT_EQ(scene.appearance.attenuation->value.quadratic, 0.5);
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].position, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.lights[0].intensity, (Vec3{0.5, 1, 2}));
    EXPECT_FALSE(scene.appearance.attributes);
  }
}

TEST(Appearance, TheCurrentColorIsThatOfEveryVertexUntilItChanges) {
  const ReadScene scene = scene_of("color 1 2 3\n" + kTriangleLines + "color\n4 5 6\n" + kTriangleLines);
  EXPECT_TRUE(scene.appearance.columns() == (AttributeSet{false, true, false}));
  EXPECT_EQ(scene.triangles.at(0).vertices[2].color, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.triangles.at(1).vertices[0].color, (Vec3{4, 5, 6}));
}

TEST(Appearance, VerticesCarryTheAttributesAskedFor) {
  const ReadScene scene = scene_of(
      "attributes color normal\ntriangle\n0 1 2 3 4 5 6 7 8\n0 0 0 0 0 255 0 0 1\n0 0 0 9 9 9 1 0 0\n");
  EXPECT_EQ(scene.triangles.at(0).vertices[0].position, (Vec3{0, 1, 2}));
  EXPECT_EQ(scene.triangles.at(0).vertices[0].color, (Vec3{3, 4, 5}));
  EXPECT_EQ(scene.triangles.at(0).vertices[0].normal, (Vec3{6, 7, 8}));
}

TEST(Appearance, TheCurrentColorGoesWithNormalsInEitherOrder) {
  const std::string triangle = "triangle\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n";
  for (const std::string commands :
       {"color 1 2 3\nattributes normal\n", "attributes normal\ncolor 1 2 3\n"}) {
    const ReadScene scene = scene_of(commands + triangle);
    EXPECT_TRUE(scene.appearance.columns() == (AttributeSet{false, true, true}));
    EXPECT_EQ(scene.triangles.at(0).vertices[1].color, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.triangles.at(0).vertices[1].normal, (Vec3{0, 0, 1}));
  }
}

TEST(Appearance, NamesWhatIsWrong) {
  const Refusal refusals[] = {
      {"color 0 256 0\n", "5:9: expected the green of the color from 0 to 255, found '256'"},
      {"background\n-1 0 0\n", "6:1: expected the red of the background from 0 to 255, found '-1'"},
      {"attributes color\ntriangle 0 0 0 0 0 300\n",
       "6:20: expected the blue of vertex 1 of 3 (x y z r g b, by the line 'attributes color') from 0 to "
       "255, found '300'"},
      {"attributes normal\ntriangle\n0 0 0\n",
       "7:6: expected the normal's x of vertex 1 of 3 (x y z nx ny nz, by the line 'attributes normal'), "
       "found the end of the line"},
      {"attributes color\ntriangle\n0 0 0 1 2 3\n0 0 0 1 2 3 4\n",
       "8:13: expected the end of the line after vertex 2 of 3 (x y z r g b, by the line 'attributes "
       "color'), found '4'"},
      {"color 1 2 3\ntriangle\n0 0 0 1 2 3\n",
       "7:7: expected the end of the line after vertex 1 of 3 (x y z), found '1'"},
      {"attributes normal\ntriangle\n0 0 0 0 0 0\n",
       "7:7: expected a normal of vertex 1 of 3 other than 0 0 0, found 0 0 0"},
      {"material 1 1 0 1\nuse 1\nmaterial 1 1 0 1\n",
       "6:5: expected the number of a material above, a whole number below 1, found '1'"},
      {"use 0\n" + kTriangleLines + "use\n-1\n",
       "11:1: expected the number of a material above, a whole number below 1, found '-1'"},
      {"ambient 1 1 1\nambient 1 1 1\n",
       "6:1: expected one 'ambient', found a second one after scene.txt:5:9"},
      {"light 0 0 0 1 1 -1\n", "5:17: expected the blue of the light of at least 0, found '-1'"},
      {"material 1 -1 0 1\n", "5:12: expected the diffuse factor of at least 0, found '-1'"},
      {"material 1 1 0 1.5\n", "5:16: expected the shininess, a whole number below 2^64, found '1.5'"},
      {"attenuation 0 0 0\n", "5:13: expected an attenuation other than 0 0 0, found 0 0 0"},
      {kTriangleLines + "light 0 0 0 1 1 1\n",
       "9:1: expected 'light' before the first object, found 'light' after it"},
      {kTriangleLines + "color 1 2 3\n",
       "9:1: expected 'color' or 'attributes color' before the first object, too, found 'color' after it"},
  };
  for (const auto& [text, error] : refusals)
    EXPECT_EQ(error_of_appearance(text), "scene.txt:" + error) << text;
}

TEST(Appearance, ABackgroundMayHaveAnAlpha) {
  const auto alpha_of = [](const std::string& numbers) {
    return scene_of("background " + numbers + "\n").appearance.background->value.alpha;
  };
  EXPECT_EQ(alpha_of("1 2 3"), 255);
  EXPECT_EQ(alpha_of("1 2 3 0"), 0);
  EXPECT_EQ(alpha_of("1 2 3 254.5 # a comment"), 254.5);
  EXPECT_EQ(error_of_appearance("background 1 2 3 255.5\n"),
            "scene.txt:5:18: expected the alpha of the background from 0 to 255, found '255.5'");
  EXPECT_EQ(error_of_appearance("background 1 2 3 -1\n"),
            "scene.txt:5:18: expected the alpha of the background from 0 to 255, found '-1'");
  EXPECT_EQ(error_of_appearance("background 1 2 3 4 5\n"),
            "scene.txt:5:20: expected the end of the line after the alpha of the background, found '5'");
}

TEST(Appearance, NoNormalOfACompleteTriangleIsZero) {
  for (std::size_t zero = 0; zero < 3; ++zero) {
    std::array<std::string, 3> lines = {"0 0 0 0 0 1\n", "1 0 0 0 0 1\n", "0 1 0 0 0 1\n"};
    lines[zero] = "2 3 4 0 0 0\n";
    EXPECT_EQ(error_of_appearance("attributes normal\ntriangle\n" + lines[0] + lines[1] + lines[2]),
              "scene.txt:" + std::to_string(7 + zero) + ":7: expected a normal of vertex " +
                  std::to_string(zero + 1) + " of 3 other than 0 0 0, found 0 0 0");
  }
}

TEST(Appearance, AttributesAreNamedOnceInTheirOrder) {
  const std::string expected = "expected attributes of [color] [normal], in this order, found ";
  EXPECT_EQ(error_of_appearance("attributes normal color\n"), "scene.txt:5:19: " + expected + "'color'");
  EXPECT_EQ(error_of_appearance("attributes w color\n"), "scene.txt:5:12: " + expected + "'w'");
  EXPECT_EQ(error_of_appearance("attributes color\nattributes normal\n"),
            "scene.txt:6:1: expected one 'attributes', found a second one after scene.txt:5:12");
}

TEST(Appearance, TheCurrentMaterialIsThatOfEveryVertexUntilItChanges) {
  const ReadScene scene = scene_of("material 1 1 0 1\nmaterial 0 0 1 9\n" + kTriangleLines +
                                   "push\nuse 1\npop\n" + kTriangleLines + "use\n0\n" + kTriangleLines);
  EXPECT_TRUE(scene.appearance.columns() == (AttributeSet{.material = true}));
  ASSERT_EQ(scene.triangles.size(), 3u);
  EXPECT_EQ(scene.triangles[0].material, 0u);
  EXPECT_EQ(scene.triangles[1].material, 1u);
  EXPECT_EQ(scene.triangles[2].material, 0u);
}

TEST(Appearance, OneMaterialNeedsNoColumn) {
  const ReadScene scene = scene_of("material 0 0 1 9\nuse 0\n" + kTriangleLines);
  EXPECT_FALSE(scene.appearance.attributes);
  EXPECT_FALSE(scene_of("use 0\n" + kTriangleLines).appearance.attributes);
}

TEST(Appearance, AttributesAndMaterialsMayStandInAnyOrder) {
  const std::string materials = "material 1 1 0 1\nmaterial 1 1 1 9\n";
  const AttributeSet both = {.normal = true, .material = true};
  EXPECT_TRUE(scene_of(materials + "attributes normal\n").appearance.columns() == both);
  EXPECT_TRUE(scene_of("attributes normal\n" + materials).appearance.columns() == both);
}

TEST(Appearance, AWholeShininessMayBeWrittenWithDecimals) {
  const auto shininess_of = [](const std::string& number) {
    return scene_of("material 1 1 0 " + number + "\n").appearance.materials.at(0).value.shininess;
  };
  EXPECT_EQ(shininess_of("16.0"), 16u);
  EXPECT_EQ(shininess_of("+1.6e1"), 16u);
  EXPECT_EQ(shininess_of("0.000"), 0u);
  EXPECT_EQ(shininess_of("18446744073709551615"), 18446744073709551615u);
}

TEST(Appearance, AShininessIsBelowTwoToThe64) {
  for (const std::string number : {"18446744073709551616", "1e20", "1e999", "-1.0", "nan", "16.5"})
    EXPECT_EQ(error_of_appearance("material 1 1 0 " + number + "\n"),
              "scene.txt:5:16: expected the shininess, a whole number below 2^64, found '" + number + "'");
}

}  // namespace
}  // namespace pipeline
