#include "libpipeline/picture/depth_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/text/text_input.h"

namespace pipeline {
namespace {

std::string text_of(const std::vector<std::vector<double>>& rows, double rear) {
  const TextFile file("");
  TextWriter text(file.descriptor(), "z_buffer.txt");
  for (const auto& row : rows) write_depth_row(text, row, rear);
  text.flush();
  return file.whole_text();
}

TEST(DepthText, IsALineARowWithATabAfterEveryValue) {
  EXPECT_EQ(text_of({{0.5, 0.25}, {1, -0.125}}, 2), "0.500000\t0.250000\t\n1.000000\t-0.125000\t\n");
}

TEST(DepthText, LeavesOutWhatIsAtTheRear) {
  EXPECT_EQ(text_of({{2, 0.5, 2, 1.9999999, 2}}, 2), "0.500000\t2.000000\t\n");
}

TEST(DepthText, ARowWithoutValuesIsAnEmptyLine) {
  EXPECT_EQ(text_of({{2, 2}, {2, 2}}, 2), "\n\n");
}

TEST(DepthText, ZeroCarriesNoSign) {
  EXPECT_EQ(text_of({{0.0, -0.0, -0.0000001, 0.0000001, -0.0000006}}, 2),
            "0.000000\t0.000000\t0.000000\t0.000000\t-0.000001\t\n");
}

TEST(DepthText, RoundsToTheNearestSixDecimals) {
  EXPECT_EQ(text_of({{0.0000004999, 0.1234567, 0.9999996, 1.0 / 3}}, 2),
            "0.000000\t0.123457\t1.000000\t0.333333\t\n");
}

TEST(DepthText, ExactTiesGoToTheEvenDigit) {
  // 2^-7 = 0.0078125: at six decimals half-way between ...812 and ...813; 3 * 2^-7 = 0.0234375.
  EXPECT_EQ(text_of({{0.0078125, 0.0234375}}, 2), "0.007812\t0.023438\t\n");
}

TEST(DepthText, LargeDepthsAreWrittenInFull) {
  EXPECT_EQ(text_of({{-1e22, 1e17}}, 1e300),
            "-10000000000000000000000.000000\t100000000000000000.000000\t\n");
  EXPECT_EQ(text_of({{-1.7976931348623157e308}}, 0).size(), 1u + 309 + 7 + 2);
}

}  // namespace
}  // namespace pipeline
