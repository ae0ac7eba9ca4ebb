#include "libpipeline/coverage/span.h"

#include <gtest/gtest.h>

namespace pipeline {
namespace {

TEST(ColumnSearch, FindsTheFirstOfAnyRange) {
  for (int first = -3; first <= 3; ++first)
    for (int end = first; end <= first + 9; ++end)
      for (int found = first; found <= end; ++found)
        EXPECT_EQ(first_column_where(first, end, [&](int column) { return column >= found; }), found)
            << first << " " << end;
}

TEST(ColumnSearch, AsksNoColumnOutsideTheRange) {
  for (const bool answer : {false, true})
    first_column_where(2, 7, [&](int column) {
      EXPECT_GE(column, 2);
      EXPECT_LT(column, 7);
      return answer;
    });
}

TEST(ColumnSearch, OfALongRowAsksFewColumns) {
  int count = 0;
  EXPECT_EQ(first_column_where(0, 65'536, [&](int column) { return ++count, column >= 12'345; }), 12'345);
  EXPECT_LE(count, 17);  // log2(65536) + 1
}

}  // namespace
}  // namespace pipeline
