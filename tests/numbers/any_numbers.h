#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// Finite numbers of every size, some with differences and products outside a double's range.
inline constexpr double kLargest = std::numeric_limits<double>::max();
inline const std::vector<double> kAnyNumbers = {0,      -0.0,  5e-324, -5e-324,  1e-310,   1e-200, -1e-160,
                                                0.5,    -0.5,  1,      -1.002,   1e154,    -1e160, 1e300,
                                                -1e300, 1e308, -1e308, kLargest, -kLargest};

/// Expects spans within the screen, with depths that are not NaN.
inline void expect_on_screen(const std::vector<Span>& spans, const Viewport& screen) {
  for (const Span& span : spans) {
    ASSERT_GE(span.row, 0);
    ASSERT_LT(span.row, screen.rows);
    ASSERT_GE(span.first_column, 0);
    ASSERT_LE(span.first_column, span.last_column);
    ASSERT_LT(span.last_column, screen.columns);
    for (const int column : {span.first_column, span.last_column})
      ASSERT_FALSE(std::isnan(span.depth(column)));
  }
}

}  // namespace pipeline
