#pragma once

#include <span>

#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// Writes one row of z-buffer text: every depth below the rear limit with 6 decimals and a tab, then the end
/// of the line; an empty line for a row without any. Zero never carries a sign.
void write_depth_row(TextWriter& text, std::span<const double> depths, double rear);

}  // namespace pipeline
