#pragma once

#include "libpipeline/exact_grid.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/span.h"

namespace pipeline {

/// A triangle to be drawn.
struct ColoredTriangle {
  ExactTriangle triangle;
  Color color;
};

/// A span to be drawn.
struct ColoredSpan {
  Span span;
  Color color;
};

}  // namespace pipeline
