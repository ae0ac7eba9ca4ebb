#pragma once

#include <span>

#include "libpipeline/coverage/span.h"

namespace pipeline {

/// One row of a visibility algorithm's result: for every column the depth (NDC z) of the nearest triangle and
/// its tag, or the rear limit and the background's tag. Depth text and image are made from these rows alone.
struct VisibleRow {
  std::span<const double> depths;
  std::span<const PixelTag> tags;
};

}  // namespace pipeline
