#pragma once

#include "libpipeline/coverage/rules.h"
#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// The depth (NDC z) of a triangle at a pixel that it covers by the rule, within 2^-97 of the largest |z| of
/// its vertices and of itself. Slow: for digits that the depth of a Span may lack.
Ball exact_depth(const NearestCoverage& rule, const ExactTriangle& triangle, int row, int column);
Ball exact_depth(const CenterCoverage& rule, const ExactTriangle& triangle, int row, int column);

}  // namespace pipeline
