#include "libpipeline/scene/camera.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "libpipeline/text/number_parser.h"
#include "tests/text/text_input.h"

namespace pipeline {
namespace {

CameraParameters camera(const Vec3& eye, const Vec3& look, const Vec3& up) {
  CameraParameters camera;
  camera.eye = {eye, {"in.txt", 1, 5}};
  camera.look = {look, {"in.txt", 2, 6}};
  camera.up = {up, {"in.txt", 3, 4}};
  return camera;
}

std::string error_of_check(const CameraParameters& camera) {
  return message_of([&] { check_camera(camera); });
}

/// A line with the characters after it that a LineScanner may read.
std::string with_slack(const std::string& line) {
  return line + std::string(kDecimalNumberSlack, ' ');
}

/// The error of reading a projection from the numbers after the option of that name.
std::string error_of_projection(const std::string& keyword, const std::string& numbers) {
  const std::string file = "--" + keyword, text = with_slack(numbers);
  LineScanner line(std::string_view(text).substr(0, numbers.size()), file, 0);
  return message_of([&] { read_projection(keyword, line); });
}

TEST(Camera, LooksAtAnotherPointThanTheEye) {
  EXPECT_EQ(error_of_check(camera({0.1, -2, 1e30}, {0.1, -2, 1e30}, {0, 1, 0})),
            "in.txt:2:6: expected a point other than the eye to look at, found 0.1 -2 1e+30");
}

TEST(Camera, MayLookAtTheNextDouble) {
  EXPECT_EQ(error_of_check(camera({1, 0, 0}, {0x1.0000000000001p0, 0, 0}, {0, 1, 0})), "no error");
}

TEST(Camera, HasAnUpDirectionEvenIfItIsAlone) {
  CameraParameters alone;
  alone.up = {Vec3{}, {"--up"}};
  EXPECT_EQ(error_of_check(alone), "--up: expected an up direction, found 0 0 0");
}

TEST(Camera, NamesAnOptionWithoutALine) {
  EXPECT_EQ(error_of_projection("perspective", "60 1 0 100"),
            "--perspective: expected near above 0, found '0'");
}

TEST(Camera, EachPartIsReadOnce) {
  const std::string file = "in.txt";
  const std::string numbers = with_slack("0 1 0");
  CameraParameters camera;
  LineScanner first(numbers, file, 3);
  EXPECT_TRUE(read_camera_part("up", {file, 3, 1}, first, camera));
  LineScanner second(numbers, file, 4);
  EXPECT_EQ(message_of([&] {
              read_camera_part("up", {file, 4, 1}, second, camera);
            }),
            "in.txt:4:1: expected one up, found a second one after in.txt:3:1");
}

TEST(Camera, MergedPartsAreThePreferredOnes) {
  CameraParameters preferred;
  preferred.look = {{1, 1, 1}, {"--look"}};
  const CameraParameters both = merged(preferred, camera({0, 0, 5}, {}, {0, 1, 0}));
  EXPECT_EQ(to_string(both.eye->location), "in.txt:1:5");
  EXPECT_EQ(to_string(both.look->location), "--look");
  EXPECT_EQ(to_string(both.up->location), "in.txt:3:4");
  EXPECT_FALSE(both.projection);
}

}  // namespace
}  // namespace pipeline
