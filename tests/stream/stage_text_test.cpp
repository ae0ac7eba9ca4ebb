#include "libpipeline/stream/stage_text.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/stream/stage_text_io.h"

namespace pipeline {
namespace {

TEST(StageText, AnErrorLineStandsOnOneLine) {
  EXPECT_EQ(error_line("model: cannot open a\nb\r: No such file"),
            "error model: cannot open a\\x0ab\\x0d: No such file\n");
}

TEST(StageText, HoldsTheLongestNumbers) {
  TriangleBatch batch;
  const Vec3 longest = {-0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023, -0x1.fffffffffffffp1023};
  for (std::uint64_t i = 0; i < 100; ++i) batch.add({longest, longest, longest}, 18446744073709551615u, {});
  const std::string text = written(batch, {.decimals = kMaxDecimals});
  EXPECT_EQ(text.size(), 100 * (30 + 9 * (1 + 309 + 1 + 17 + 1) + 1));
}

// Header and columns for color and light.

const std::string kLooks =
    "attributes w color normal\nbackground 1 2 3\nambient 0.1 0.2 0.3\nmaterial 1 0.5 0.25 100000\n"
    "attenuation 1 0 0.125\nlight 1 2 3 0.5 1 1.5\nlight 4 5 6 1 1 1\n";
const std::string kFullTriangle =
    "1 2 3 0.1 4 5 6 0 0 1\n4 5 6 12.5 7 8 255 1 0 0\n7 8 9 1e+22 0 0 0 0 0 0\n\n";

TEST(StageText, ColorAndLightComeBackAsTheyWere) {
  const std::string text = kLooks + kFullTriangle + "triangle 7\n" + kFullTriangle;
  EXPECT_EQ(copy_of(text), text);
}

/// Triangle `n` in fixed form, with the columns color, normal and material.
std::string with_material(int n, int material) {
  std::string text;
  for (int vertex = 0; vertex < 3; ++vertex)
    text += std::to_string(n) + ".25 -0.50 " + std::to_string(vertex) + ".75 10.00 20.50 " +
            std::to_string(n % 256) + ".00 0.00 1.00 -0.25 " + std::to_string(material) + "\n";
  return text + "\n";
}

// More triangles than a block has, runs of a material, and lines that only the general reader takes.
TEST(StageText, MaterialsComeBackAsTheyWereInBlocksAndLineByLine) {
  std::string header = "attributes color normal material\n", text, odd;
  for (int i = 0; i < 120; ++i) header += "material 1 1 0 " + std::to_string(i) + "\n";
  for (int n = 0; n < 700; ++n) {
    const std::string triangle = with_material(n, n / 6 % 120);
    text += triangle;
    odd += n % 50 == 7 ? "\t" + triangle : triangle;
  }
  EXPECT_EQ(copy_of(header + text, {.decimals = 2}), header + text);
  EXPECT_EQ(copy_of(header + odd, {.decimals = 2}), header + text);
  const std::string shortest = copy_of(header + text);
  EXPECT_NE(shortest, header + text);
  EXPECT_EQ(copy_of(shortest, {.decimals = 2}), header + text);
}

TEST(StageText, AMaterialHasNoExponent) {
  std::string text = "attributes material\n";
  for (int i = 0; i <= 100'000; ++i) text += "material 1 1 0 1\n";
  const std::string digits = "." + std::string(20, '0');  // more than fast paths print
  for (int vertex = 0; vertex < 3; ++vertex)
    text += "1" + digits + " 2" + digits + " 3" + digits + " 100000\n";
  EXPECT_EQ(copy_of(text + "\n", {.decimals = 20}), text + "\n");
}

TEST(StageText, HeaderNumbersAndWKeepAllTheirDigits) {
  EXPECT_EQ(
      copy_of(
          "attributes w color\nambient 0.1 0.25 1e-9\n1 2 3 0.125 4.5 5 6\n0 0 0 1 0 0 0\n0 0 0 1 0 0 0\n\n",
          {.decimals = 1}, false),
      "attributes w color\nambient 0.1 0.25 1e-09\n1.0 2.0 3.0 0.125 4.5 5.0 6.0\n"
      "0.0 0.0 0.0 1 0.0 0.0 0.0\n0.0 0.0 0.0 1 0.0 0.0 0.0\n\n");
}

}  // namespace
}  // namespace pipeline
