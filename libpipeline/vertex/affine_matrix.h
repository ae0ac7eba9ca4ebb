#pragma once

#include <array>

#include "libpipeline/numbers/ball_vec.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A 4x4 matrix whose last row is 0 0 0 1, as every product of translations, rotations and scalings has:
/// the three rows above, row by row. Column vectors: (A * B) p = A (B p).
///
/// Bounding the error of each entry alone would let it grow by up to sqrt(3) with every rotation, although a
/// rotation turns errors without making them longer (the wrapping effect: R. Moore, "Interval Analysis",
/// 1966). So a matrix also keeps for each row the length that the errors of its first three entries have
/// together, and by how much the linear part can lengthen a vector; of both bounds an entry has the smaller
/// one.
struct AffineMatrix {
  std::array<std::array<Ball, 4>, 3> rows;
  std::array<double, 3> row_errors{};  // bounds of a Euclidean length; infinite where nothing is known
  double norm = 1;                     // a bound of the linear part's 2-norm

  friend bool operator==(const AffineMatrix&, const AffineMatrix&) = default;
};

AffineMatrix identity();
AffineMatrix operator*(const AffineMatrix& a, const AffineMatrix& b);
/// m * the translation by `offset`, and m * the scaling by `factors`, without the products by 0 and 1.
AffineMatrix translated(const AffineMatrix& m, const Vec3& offset);
AffineMatrix scaled(const AffineMatrix& m, const Vec3& factors);
/// Sets `row_errors` from the entries' own errors.
void bound_row_errors(AffineMatrix& m);

}  // namespace pipeline
