#pragma once

#include <array>
#include <initializer_list>

#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// The sum of products of three finite doubles each, rounded once: the error is at most 2^-100 of the sum,
/// and a sum of 0 is exactly 0. At most 16 products. Slow: for signs that balls cannot tell.
Ball exact_sum(std::initializer_list<std::array<double, 3>> products);

}  // namespace pipeline
