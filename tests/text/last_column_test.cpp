#include "libpipeline/text/last_column.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

/// "count: the lines without the column".
std::string taken(const std::string& text, std::size_t limit = 9, std::size_t bound = 1000) {
  const TrianglesWithoutLastColumn triangles(text, limit, bound);
  return std::to_string(triangles.count()) + ": " + std::string(triangles.lines());
}

TEST(LastColumn, IsTakenOffTheThreeLinesOfATriangle) {
  const std::string text = "0.5 1 2 7\n-3 4 5 7\n6 7 8 7\n\n1 1 1 12\n2 2 2 12\n3 3 3 12\n\n";
  const TrianglesWithoutLastColumn triangles(text, 9, 1000);
  EXPECT_EQ(triangles.lines(), "0.5 1 2\n-3 4 5\n6 7 8\n\n1 1 1\n2 2 2\n3 3 3\n\n");
  EXPECT_EQ(triangles.values(), (std::vector<std::uint32_t>{7, 12}));
  EXPECT_EQ(triangles.length_with_column(0), 0u);
  EXPECT_EQ(triangles.length_with_column(1), text.find("1 1 1 12"));
  EXPECT_EQ(triangles.length_with_column(2), text.size());
}

TEST(LastColumn, TakesNoMoreTrianglesThanItMay) {
  const std::string triangle = "1 1 1 2\n2 2 2 2\n3 3 3 2\n\n";
  EXPECT_EQ(taken(triangle + triangle, 1), "1: 1 1 1\n2 2 2\n3 3 3\n\n");
  EXPECT_EQ(taken(triangle + triangle, 0), "0: ");
}

TEST(LastColumn, IsLeftToTheGeneralReaderInAnyOtherForm) {
  const std::string good = "1 1 1 2\n2 2 2 2\n3 3 3 2\n\n", stripped = "1: 1 1 1\n2 2 2\n3 3 3\n\n";
  EXPECT_EQ(taken(good + good.substr(0, good.size() - 1)), stripped);  // cut short
  for (const char* const line :
       {"3 3 3 1", "3 3 3 2 ", "3 3 3 2\r", "3 3 3 -2", "3 3 3 2.0", "3 3 3 +2", "3 3 3 2e0", "3 3 3\t2",
        "3 3 3 1000", "3 3 3 1000000002", "3 3 3 4294967298", "2", "", "2 #2"})
    EXPECT_EQ(taken(good + "1 1 1 2\n2 2 2 2\n" + line + "\n\n" + good), stripped) << line;
  EXPECT_EQ(taken(good + "1 1 1 2\n2 2 2 2\n3 3 3 2\n# no blank line\n"), stripped);
  EXPECT_EQ(taken("1 1 1 5\n2 2 2 5\n3 3 3 5\n\n", 9, 5), "0: ");
}

TEST(LastColumn, IsPutOnTheThreeLinesOfATriangle) {
  const std::array<std::uint32_t, 2> values = {0, 4294967295};
  const std::string_view lines = "0.5 1 2\n-3 4 5\n6 7 8\n\n1 1 1\n2 2 2\n3 3 3\n\n";
  std::string out(lines.size() + values.size() * kMaxLastColumnLength, '?');
  char* const end = print_with_last_column(lines, values, out.data());
  out.resize(static_cast<std::size_t>(end - out.data()));
  EXPECT_EQ(out,
            "0.5 1 2 0\n-3 4 5 0\n6 7 8 0\n\n"
            "1 1 1 4294967295\n2 2 2 4294967295\n3 3 3 4294967295\n\n");
}

}  // namespace
}  // namespace pipeline
