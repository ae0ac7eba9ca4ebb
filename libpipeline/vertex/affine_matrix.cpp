#include "libpipeline/vertex/affine_matrix.h"

#include <algorithm>
#include <cmath>

namespace pipeline {

namespace {

/// Enlarges a bound by more than the few operations that computed it can lose by rounding and underflow.
double rounded_up(double bound) {
  return bound * (1 + 0x1p-40) + 0x1p-1000;
}

/// An upper bound on the Euclidean length of a row's linear part.
double row_length_bound(const std::array<Ball, 4>& row) {
  // The largest entry is factored out, so that no square leaves a double's range.
  const double largest = std::max({row[0].magnitude(), row[1].magnitude(), row[2].magnitude()});
  if (largest == 0 || !std::isfinite(largest)) return largest;
  const double x = row[0].magnitude() / largest;
  const double y = row[1].magnitude() / largest;
  const double z = row[2].magnitude() / largest;
  return rounded_up(largest * std::sqrt(x * x + y * y + z * z));
}

/// A bound on the Euclidean length of the errors of a row's linear part, from the entries' own.
double row_error_bound(const std::array<Ball, 4>& row) {
  const double sum = row[0].radius() + row[1].radius() + row[2].radius();
  return sum == 0 ? 0 : rounded_up(sum);
}

/// The Frobenius norm: no vector is lengthened by more.
double norm_bound(const AffineMatrix::Rows& rows) {
  return rounded_up(
      std::hypot(row_length_bound(rows[0]), row_length_bound(rows[1]), row_length_bound(rows[2])));
}

/// The error of a row of a * b that comes from b's own errors and from rounding the product, per unit of the
/// length of a's row.
double error_per_length(const AffineMatrix& b) {
  double error = 0;
  for (std::size_t i = 0; i < 3; ++i) error += b.row_errors[i] + 0x1p-101 * row_length_bound(b.rows[i]);
  return rounded_up(error);
}

}  // namespace

AffineMatrix::AffineMatrix(const Rows& entries) : AffineMatrix(entries, norm_bound(entries)) {}

AffineMatrix::AffineMatrix(const Rows& entries, double known_norm)
    : rows(entries),
      row_errors{row_error_bound(rows[0]), row_error_bound(rows[1]), row_error_bound(rows[2])},
      norm(known_norm) {}

AffineMatrix identity() {
  AffineMatrix::Rows rows;
  for (std::size_t i = 0; i < 3; ++i) rows[i][i] = 1;
  return {rows, 1};
}

AffineMatrix operator*(const AffineMatrix& a, const AffineMatrix& b) {
  AffineMatrix product = a;
  product.norm = rounded_up(a.norm * b.norm);
  product.orientation *= b.orientation;
  const double b_error = error_per_length(b);
  for (std::size_t i = 0; i < 3; ++i) {
    product.row_errors[i] = rounded_up(a.row_errors[i] * b.norm + row_length_bound(a.rows[i]) * b_error);
    for (std::size_t j = 0; j < 4; ++j) {
      Ball sum = j == 3 ? a.rows[i][3] : Ball();
      for (std::size_t k = 0; k < 3; ++k) sum = sum + a.rows[i][k] * b.rows[k][j];
      product.rows[i][j] = j == 3 ? sum : sum.with_error_at_most(product.row_errors[i]);
    }
  }
  return product;
}

// M3
AffineMatrix translated(const AffineMatrix& m, const Vec3& offset) {
  AffineMatrix product = m;
  const std::array<Ball, 3> column = {offset.x, offset.y, offset.z};
  for (auto& row : product.rows)
    for (std::size_t k = 0; k < 3; ++k) row[3] = row[3] + row[k] * column[k];
  return product;
}

// M3
AffineMatrix scaled(const AffineMatrix& m, const Vec3& factors) {
  AffineMatrix product = m;
  const std::array<Ball, 3> diagonal = {factors.x, factors.y, factors.z};
  const double largest = std::max({std::fabs(factors.x), std::fabs(factors.y), std::fabs(factors.z)});
  product.norm = rounded_up(m.norm * largest);
  for (std::size_t i = 0; i < 3; ++i) {
    product.orientation *= diagonal[i].sign();
    auto& row = product.rows[i];
    for (std::size_t k = 0; k < 3; ++k) row[k] = row[k] * diagonal[k];
    product.row_errors[i] = rounded_up(m.row_errors[i] * largest + 0x1p-101 * row_length_bound(row));
    for (std::size_t k = 0; k < 3; ++k) row[k] = row[k].with_error_at_most(product.row_errors[i]);
  }
  return product;
}

}  // namespace pipeline
