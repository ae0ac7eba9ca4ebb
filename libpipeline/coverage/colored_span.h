#pragma once

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/color.h"

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
