#pragma once

#include <span>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// Writes one row of z-buffer text: every depth below the rear limit with 6 decimals and a tab, then the end
/// of the line; an empty line if no depth is. Zero never has a sign. If `exact` is not empty, writes these
/// depths instead: doubles have too few digits for depths far beyond 1000.
void write_depth_row(TextWriter& text, std::span<const double> depths, double rear,
                     std::span<const Ball> exact = {});

}  // namespace pipeline
