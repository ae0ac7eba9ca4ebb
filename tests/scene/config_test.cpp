#include "libpipeline/scene/config.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

Viewport config_of(const std::string& text) {
  const TextFile file(text);
  TextReader reader(file.descriptor(), "config.txt");
  return read_config(reader);
}

std::string error_of_config(const std::string& text) {
  return message_of([&] { config_of(text); });
}

/// Columns, rows, left, bottom, front and rear.
std::vector<double> numbers_of(const std::string& text) {
  const Viewport viewport = config_of(text);
  return {static_cast<double>(viewport.columns),
          static_cast<double>(viewport.rows),
          viewport.left,
          viewport.bottom,
          viewport.front,
          viewport.rear};
}

TEST(Config, PixelCentersLieHalfAPixelInsideTheLimits) {
  const Viewport viewport = config_of("8 4\n-4\n-1\n0 1");
  EXPECT_EQ(viewport.dx(), 1);
  EXPECT_EQ(viewport.dy(), 0.5);
  EXPECT_EQ(viewport.left_x(), -3.5);
  EXPECT_EQ(viewport.top_y(), 0.75);
}

TEST(Config, NamesWhatIsWrong) {
  const Refusal refusals[] = {
      {"", "1:1: expected the width and height in pixels, found the end of the input"},
      {"\n# nothing\n", "3:1: expected the width and height in pixels, found the end of the input"},
      {"0 500", "1:1: expected the width in pixels, a whole number from 1 to 65535, found '0'"},
      {" 65536 500", "1:2: expected the width in pixels, a whole number from 1 to 65535, found '65536'"},
      {"99999999999999999999 500",
       "1:1: expected the width in pixels, a whole number from 1 to 65535, found '99999999999999999999'"},
      {"500 0", "1:5: expected the height in pixels, a whole number from 1 to 65535, found '0'"},
      {"500 -5", "1:5: expected the height in pixels, a whole number from 1 to 65535, found '-5'"},
      {"500 500.0", "1:5: expected the height in pixels, a whole number from 1 to 65535, found '500.0'"},
      {"500",
       "1:4: expected the height in pixels, a whole number from 1 to 65535, found the end of the line"},
      {"500 500 500", "1:9: expected the end of the line after the height, found '500'"},
      {"500 500\n1\n-1\n0 2", "2:1: expected the left limit of X, a negative number, found '1'"},
      {"500 500\n0\n-1\n0 2", "2:1: expected the left limit of X, a negative number, found '0'"},
      {"500 500\n-0\n-1\n0 2", "2:1: expected the left limit of X, a negative number, found '-0'"},
      {"500 500\n -nan\n-1\n0 2", "2:2: expected the left limit of X, a negative number, found '-nan'"},
      {"500 500\n-1 -1\n0 2", "2:4: expected the end of the line after the left limit of X, found '-1'"},
      {"500 500\n-1\n0.5\n0 2", "3:1: expected the bottom limit of Y, a negative number, found '0.5'"},
      {"500 500\n-1\n", "3:1: expected the bottom limit of Y, found the end of the input"},
      {"500 500\n-1\n-1\n2 0",
       "4:3: expected the rear limit of Z, a number greater than the front limit, found '0'"},
      {"500 500\n-1\n-1\n2 2",
       "4:3: expected the rear limit of Z, a number greater than the front limit, found '2'"},
      {"500 500\n-1\n-1\n2",
       "4:2: expected the rear limit of Z, a number greater than the front limit, found the end of the line"},
      {"500 500\n-1\n-1\nfront 2", "4:1: expected the front limit of Z, found 'front'"},
      {"500 500\n-1\n-1\n", "4:1: expected the front and rear limits of Z, found the end of the input"},
      {"500 500\n-1\n-1\n0 2 4", "4:5: expected the end of the line after the rear limit of Z, found '4'"},
      {"500 500\n-1\n-1\n0 2\n\n  3", "6:3: expected nothing after the limits of Z, found '3'"},
  };
  for (const auto& [text, error] : refusals) EXPECT_EQ(error_of_config(text), "config.txt:" + error) << text;
}

TEST(Config, LimitsWhosePixelsADoubleCannotTellApartAreErrors) {
  EXPECT_EQ(error_of_config("500 500\n-1e201\n-1\n0 2"),
            "config.txt:2:1: expected the left limit of X, a number from -1e200 to -1e-200, found '-1e201'");
  EXPECT_EQ(
      error_of_config("500 500\n-1\n-1e-201\n0 2"),
      "config.txt:3:1: expected the bottom limit of Y, a number from -1e200 to -1e-200, found '-1e-201'");
  EXPECT_EQ(numbers_of("500 500\n-1e200\n-1e-200\n0 2"),
            (std::vector<double>{500, 500, -1e200, -1e-200, 0, 2}));
}

TEST(ParseSize, IsAViewportWithoutLimits) {
  Viewport expected;
  expected.columns = 400;
  expected.rows = 65535;
  EXPECT_EQ(parse_size("400x65535"), expected);
}

TEST(ParseSize, TakesOneWordWithAnXInIt) {
  for (const char* const word : {"", "x", "400", "400x", "x300", "400X300", "400x300x1", "0x3", "3x0",
                                 "65536x1", "1x65536", "+1x1", "1.0x1", "1 x1"})
    EXPECT_EQ(parse_size(word), std::nullopt) << word;
}

}  // namespace
}  // namespace pipeline
