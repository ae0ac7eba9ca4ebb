#pragma once

#include <span>

#include "libpipeline/scene/color.h"

namespace pipeline {

/// One row of what a visibility algorithm found: for every column the depth (NDC z) of the nearest triangle
/// and its color, or the rear limit and the background. All that comes after (depth text, image) sees only
/// this.
struct VisibleRow {
  std::span<const double> depths;
  std::span<const Color> colors;
};

}  // namespace pipeline
