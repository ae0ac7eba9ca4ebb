#pragma once

#include <initializer_list>

#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// The product of four finite doubles.
struct ExactProduct {
  double a, b, c, d = 1;
};

/// The sum of products, rounded once: the error is at most 2^-100 of the sum, and a sum of 0 is exactly 0. At
/// most 16 products. Slow: for signs that balls cannot tell.
Ball exact_sum(std::initializer_list<ExactProduct> products);

}  // namespace pipeline
