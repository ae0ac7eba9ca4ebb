#pragma once

#include <array>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A 4x4 matrix whose last row is 0 0 0 1, as in every product of translations, rotations and scalings: the
/// three rows above it. For column vectors: (A * B) p = A (B p). If each entry's error had only its own
/// bound, the bound would grow by up to sqrt(3) with every rotation, although a rotation turns errors without
/// lengthening them (the wrapping effect: R. Moore, "Interval Analysis", 1966). So a matrix also has bounds,
/// for each row, on the Euclidean length of the errors of its first three entries, and on how much the linear
/// part can lengthen a vector. Each entry uses the smaller of its two bounds.
struct AffineMatrix {
  using Rows = std::array<std::array<Ball, 4>, 3>;

  /// Bounds errors and norm by the entries: right for every transform.
  explicit AffineMatrix(const Rows& entries);
  /// For a known norm: an isometry's is 1, which its entries alone would bound by sqrt(3).
  AffineMatrix(const Rows& entries, double known_norm);

  Rows rows;
  std::array<double, 3> row_errors;  // bounds on the lengths of errors; infinite where unknown
  double norm;                       // an upper bound on the linear part's 2-norm
  int orientation = 1;               // the determinant's sign, exactly: -1 mirrors space, 0 flattens it

  friend bool operator==(const AffineMatrix&, const AffineMatrix&) = default;
};

AffineMatrix identity();
AffineMatrix operator*(const AffineMatrix& a, const AffineMatrix& b);
/// The products of m and the matrix of glTranslate or glScale, without the products by 0 and 1.
AffineMatrix translated(const AffineMatrix& m, const Vec3& offset);
AffineMatrix scaled(const AffineMatrix& m, const Vec3& factors);

}  // namespace pipeline
