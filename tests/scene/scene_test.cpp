#include "libpipeline/scene/scene.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

// Lines 1 to 4 of a scene; its commands start on line 5.
const std::string kCamera = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n";

/// A scene's commands, EndCommand included.
std::vector<Command> commands_of(const std::string& scene) {
  const TextFile file(scene);
  TextReader text(file.descriptor(), "scene.txt");
  SceneReader reader(text);
  std::vector<Command> commands;
  do commands.push_back(reader.next());
  while (!std::holds_alternative<EndCommand>(commands.back()));
  return commands;
}

CameraParameters camera_of(const std::string& scene) {
  const TextFile file(scene);
  TextReader text(file.descriptor(), "scene.txt");
  return SceneReader(text).camera();
}

std::string error_of(const std::string& scene) {
  return message_of([&] { commands_of(scene); });
}

/// The error of a scene whose commands are `commands`, from line 5.
std::string error_of_commands(const std::string& commands) {
  return error_of(kCamera + commands);
}

/// The error of a scene whose first four lines are given.
std::string error_of_camera(const std::string& eye, const std::string& look, const std::string& up,
                            const std::string& projection) {
  return error_of(eye + "\n" + look + "\n" + up + "\n" + projection + "\nend\n");
}

std::string error_of_projection(const std::string& line) {
  return error_of_camera("0 0 5", "0 0 0", "0 1 0", line);
}

TEST(Scene, NamesWhatIsWrongInAProjection) {
  const Refusal refusals[] = {
      {"frustum -1 1 -1 1 1 9 ratio", "4:23: expected the end of the line after far, found 'ratio'"},
      {"ortho -1 1 -1 1 1 9 ratio", "4:21: expected the end of the line after far, found 'ratio'"},
      {"60 1 1 100 ratio 1", "4:18: expected the end of the line after 'ratio', found '1'"},
      {"60 1 1 100 angle ratio", "4:18: expected the end of the line after 'angle', found 'ratio'"},
      {"x 1 1 100", "4:1: expected fovY, found 'x'"},
      {"60 x 1 100", "4:4: expected aspect, found 'x'"},
      {"60 1 x 100", "4:6: expected near, found 'x'"},
      {"60 1 1", "4:7: expected far, found the end of the line"},
      {"60 1 1 100 5", "4:12: expected ratio, angle or the end of the line after far, found '5'"},
      {"frustum x 1 -1 1 1 9", "4:9: expected left, found 'x'"},
      {"frustum -1 x -1 1 1 9", "4:12: expected right, found 'x'"},
      {"ortho -1 1 x 1 1 9", "4:12: expected bottom, found 'x'"},
      {"ortho -1 1 -1 x 1 9", "4:15: expected top, found 'x'"},
      {"ortho -1 1 -1 1 1", "4:18: expected far, found the end of the line"},
      {"ortho", "4:6: expected left, found the end of the line"},
      {"90 3 1 100", ""},
      {"60 0 1 100", "4:4: expected aspect above 0, found '0'"},
      {"60 -1 1 100", "4:4: expected aspect above 0, found '-1'"},
      {"60 1 0 100", "4:6: expected near above 0, found '0'"},
      {"60 1 -0.5 100", "4:6: expected near above 0, found '-0.5'"},
      {"frustum -1 1 -1 1 0 9", "4:19: expected near above 0, found '0'"},
      {"ortho -1 1 -1 1 0 9", ""},
      {"60 1 1 1", "4:8: expected far beyond near, found '1'"},
      {"60 1 1.5 1", "4:10: expected far beyond near, found '1'"},
      {"frustum -1 1 -1 1 9 1", "4:21: expected far beyond near, found '1'"},
      {"ortho -1 1 -1 1 -5 -6", "4:20: expected far beyond near, found '-6'"},
      {"ortho 1 1 -1 1 1 9", "4:9: expected right other than left, found '1'"},
      {"frustum -1 1 2 2.0 1 9", "4:16: expected top other than bottom, found '2.0'"},
      {"ortho 1 -1 2 -2 1 9", ""},
  };
  for (const auto& [text, error] : refusals)
    EXPECT_EQ(error_of_projection(text), error.empty() ? "no error" : "scene.txt:" + error) << text;
}

// A comment keeps a line from the fast path.
TEST(Scene, TrianglesAreTheSameByEitherPath) {
  const std::string vertices[] = {"0.1 -2 3", "  1e-3 .5 5.", "123456789.25 0.30000000000000004 -0"};
  for (const std::string first : {"", "\n", " \r\n\n", "push\n"}) {
    for (const std::string end : {"\n", "\r\n", " \t\n"}) {
      for (const std::string& vertex : vertices) {
        const auto scene = [&](const std::string& comment) {
          std::string text = kCamera + first + "triangle" + end;
          for (int i = 0; i < 3; ++i) text += vertex + comment + end;
          return text + "pop\nend\n";
        };
        const auto triangle_of = [](const std::vector<Command>& commands) {
          return std::get<TriangleCommand>(commands[commands.size() - 3]);
        };
        const TriangleCommand fast = triangle_of(commands_of(scene("")));
        const TriangleCommand slow = triangle_of(commands_of(scene(" # slow")));
        EXPECT_EQ(fast.p_model, slow.p_model) << scene("");
        EXPECT_EQ(fast.locations, slow.locations) << scene("");
      }
    }
  }
}

TEST(Scene, CountsTheLinesOfTrianglesInFixedForm) {
  const std::string error =
      error_of_commands("triangle\n1 2 3\n4 5 6\n7 8 9\n\ntriangle\n1 2 3\n4 5 6\n7 8 9\ncube\n");
  EXPECT_EQ(error.substr(0, error.find(' ')), "scene.txt:14:1:");
}

TEST(Scene, RemembersWhereTheCameraStands) {
  const CameraParameters camera = camera_of("# a scene\n\n 0 0 5\n0 0 0\n\t0 1 0\northo -1 1 -1 1 0 1\nend");
  EXPECT_EQ(to_string(camera.eye->location), "scene.txt:3:2");
  EXPECT_EQ(to_string(camera.look->location), "scene.txt:4:1");
  EXPECT_EQ(to_string(camera.up->location), "scene.txt:5:2");
  EXPECT_EQ(to_string(camera.projection->location), "scene.txt:6:7");
}

TEST(Scene, LocatesItsCommand) {
  const TextFile file(kCamera + "\n  push\nend\n");
  TextReader text(file.descriptor(), "scene.txt");
  SceneReader reader(text);
  reader.next();
  EXPECT_EQ(to_string(reader.location()), "scene.txt:6:3");
}

const std::string kFirstCommands =
    "a command (triangle, sphere, translate, scale, rotate, push, pop or end; before the first object also "
    "color, attributes, background, light, ambient, material or attenuation)";

// Errors of the camera.

TEST(Scene, NamesWhatIsMissingOrWrong) {
  const Refusal refusals[] = {
      {"", "1:1: expected the eye (three numbers), found the end of the input"},
      {"# nothing\n\n", "3:1: expected the eye (three numbers), found the end of the input"},
      {"0 0 5\n", "2:1: expected the point looked at (three numbers), found the end of the input"},
      {"0 0 5\n0 0 0\n", "3:1: expected the up direction (three numbers), found the end of the input"},
      {"0 0 5\n0 0 0\n0 1 0\n",
       "4:1: expected fovY aspect near far (or: ortho L R B T N F, or: frustum L R B T N F), found the end "
       "of the input"},
      {"x 0 5\n", "1:1: expected the x of the eye, found 'x'"},
      {"camera {\n",
       "1:1: expected the x of the eye, found 'camera' (a scene begins with numbers: pipeline help scene)"},
      {"0 0 5\n0 nan 0\n", "2:3: expected the y of the point looked at, found 'nan'"},
      {"0 0 5\n0 0 0\n0 1\n", "3:4: expected the z of the up direction, found the end of the line"},
      {"0 0 5 0\n", "1:7: expected the end of the line after the z of the eye, found '0'"},
      {"triangle\n0 0 0\n1 0 0\n0 1 0\nend\n", "1:1: expected the x of the eye, found 'triangle'"},
  };
  for (const auto& [text, error] : refusals) EXPECT_EQ(error_of(text), "scene.txt:" + error) << text;
}

TEST(Scene, FovYLiesBetween0And180Degrees) {
  for (const std::string fov_y : {"0", "-0", "-60", "180", "1e300"})
    EXPECT_EQ(error_of_projection(fov_y + " 1 1 100"),
              "scene.txt:4:1: expected fovY above 0 and below 180 degrees, found '" + fov_y + "'");
  EXPECT_EQ(error_of_projection("179.99999999999997 1 1 100"), "no error");
  EXPECT_EQ(error_of_projection("5e-324 1 1 100"), "no error");
}

TEST(Scene, UpIsNotParallelToTheViewDirection) {
  EXPECT_EQ(
      error_of_camera("0 0 5", "0 0 0", "0 0 2", "60 1 1 100"),
      "scene.txt:3:1: expected an up direction that is not parallel to the view direction, found 0 0 2");
  EXPECT_EQ(error_of_camera("0 0 0", "0.1 0.2 0.3", "-1e-200 -2e-200 -3e-200", "60 1 1 100"), "no error")
      << "decimal tenths are not quite parallel";
  EXPECT_EQ(error_of_camera("0 0 5", "0 0 0", "0 1e-300 2", "60 1 1 100"), "no error");
}

// Errors of the commands.

TEST(Scene, NamesWhatIsWrongInItsCommands) {
  const Refusal refusals[] = {
      {"push\n", "6:1: expected 'end', which closes a scene, found the end of the input"},
      {"end\n\npush\n", "7:1: expected nothing after 'end', found 'push'"},
      {"end end\n", "5:5: expected the end of the line after 'end', found 'end'"},
      {"  cube 1\n", "5:3: expected " + kFirstCommands + ", found 'cube'"},
      {"Triangle\n", "5:1: expected " + kFirstCommands + ", found 'Triangle' (keywords are lower case)"},
      {"color 1 2 3\ntriangle\n0 0 0\n1 0 0\n0 1 0\ncube\n",
       "10:1: expected a command (triangle, sphere, translate, scale, rotate, push, pop or end; also color), "
       "found 'cube'"},
      {"triangle\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nend\n",
       "9:1: expected a command (triangle, sphere, translate, scale, rotate, push, pop or end), found '1' (a "
       "triangle has three vertices)"},
      {"triangle\n0 0 0\n1 0 0\nend\n", "8:1: expected the x of vertex 3 of 3, found 'end'"},
      {"triangle", "6:1: expected vertex 1 of 3, found the end of the input"},
      {"triangle\n0 0 0\n1 0 0\n", "8:1: expected vertex 3 of 3, found the end of the input"},
      {"triangle\n0 0\n", "6:4: expected the z of vertex 1 of 3, found the end of the line"},
      {"triangle\n0 0 0\n1 0 0 0\n",
       "7:7: expected the end of the line after the z of vertex 2 of 3, found '0'"},
      {"triangle 0 0 0 1 0 0 0 1 0\nend\n",
       "5:16: expected the end of the line after the z of vertex 1 of 3, found '1'"},
      {"translate\n", "6:1: expected three distances, found the end of the input"},
      {"scale\n", "6:1: expected three factors, found the end of the input"},
      {"rotate\n", "6:1: expected an angle and an axis (four numbers), found the end of the input"},
      {"translate\nend\n", "6:1: expected the x of the translation, found 'end'"},
      {"translate\n1 2 inf\n", "6:5: expected the z of the translation, found 'inf'"},
      {"scale 1 2,5 1\n",
       "5:9: expected the y of the scale, found '2,5' (decimals have a point, and blanks stand between "
       "numbers)"},
      {"rotate 0x10 0 0 1\n", "5:8: expected an angle in degrees, found '0x10'"},
      {"rotate 90 0 1.5abc 1\n", "5:13: expected the y of the axis, found '1.5abc'"},
      {"translate 0 1e999 0\n",
       "5:13: expected the y of the translation within a double's range, found '1e999'"},
      {"rotate 90\n0 0 1\nend\n", "5:10: expected the x of the axis, found the end of the line"},
      {"rotate\n 90 0 0 -0.0\nend\n", "6:5: expected a rotation axis, found 0 0 0"},
      {"push 2\n", "5:6: expected the end of the line after 'push', found '2'"},
      {"pop\t2\n", "5:5: expected the end of the line after 'pop', found '2'"},
  };
  for (const auto& [text, error] : refusals) EXPECT_EQ(error_of_commands(text), "scene.txt:" + error) << text;
}

}  // namespace
}  // namespace pipeline
