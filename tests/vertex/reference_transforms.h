#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "libpipeline/scene/camera.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/vertex/affine_matrix.h"
#include "libpipeline/vertex/transform.h"
#include "tests/numbers/real.h"

namespace pipeline {

// The transforms of the stages with `bits` bits instead of 106, by formulas other than the library's if such
// exist: rotations from quaternions, projections from their textbook matrices.

template <int bits>
struct ReferenceVec3 {
  Real<bits> x, y, z;

  ReferenceVec3() = default;
  ReferenceVec3(const Real<bits>& px, const Real<bits>& py, const Real<bits>& pz) : x(px), y(py), z(pz) {}
  explicit ReferenceVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  friend ReferenceVec3 operator+(const ReferenceVec3& a, const ReferenceVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend ReferenceVec3 operator-(const ReferenceVec3& a, const ReferenceVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Real<bits> dot(const ReferenceVec3& a, const ReferenceVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend ReferenceVec3 cross(const ReferenceVec3& a, const ReferenceVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend ReferenceVec3 normalized(const ReferenceVec3& a) {
    const Real<bits> length = sqrt(dot(a, a));
    return {a.x / length, a.y / length, a.z / length};
  }
};

/// The first three rows of an affine 4x4 matrix.
template <int bits>
struct ReferenceMatrix {
  std::array<ReferenceVec3<bits>, 3> rows;
  ReferenceVec3<bits> offset;

  friend ReferenceVec3<bits> operator*(const ReferenceMatrix& m, const ReferenceVec3<bits>& p) {
    return ReferenceVec3<bits>(dot(m.rows[0], p), dot(m.rows[1], p), dot(m.rows[2], p)) + m.offset;
  }
  friend ReferenceMatrix operator*(const ReferenceMatrix& a, const ReferenceMatrix& b) {
    ReferenceMatrix product;
    const auto column = [&](auto part) {
      return ReferenceVec3<bits>(b.rows[0].*part, b.rows[1].*part, b.rows[2].*part);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      product.rows[i].x = dot(a.rows[i], column(&ReferenceVec3<bits>::x));
      product.rows[i].y = dot(a.rows[i], column(&ReferenceVec3<bits>::y));
      product.rows[i].z = dot(a.rows[i], column(&ReferenceVec3<bits>::z));
    }
    product.offset = a * b.offset;
    return product;
  }
};

template <int bits>
ReferenceMatrix<bits> reference_scaling(const Vec3& factors) {
  return {{{{factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}}}, {}};
}

template <int bits>
ReferenceMatrix<bits> reference_translation(const Vec3& offset) {
  ReferenceMatrix<bits> m = reference_scaling<bits>({1, 1, 1});
  m.offset = ReferenceVec3<bits>(offset);
  return m;
}

template <int bits>
Real<bits> radians(const Real<bits>& degrees) {
  return remainder(degrees, Real<bits>(360)) * Real<bits>::pi() / Real<bits>(180);
}

/// The rotation by the quaternion (cos(angle / 2), sin(angle / 2) axis).
template <int bits>
ReferenceMatrix<bits> reference_rotation(double angle_degrees, const Vec3& axis) {
  using R = Real<bits>;
  const ReferenceVec3<bits> a = normalized(ReferenceVec3<bits>(axis));
  const R half = times_power_of_two(radians(R(angle_degrees)), -1);
  const R w = cos(half);
  const R x = sin(half) * a.x;
  const R y = sin(half) * a.y;
  const R z = sin(half) * a.z;
  const R two = 2;
  return {{{{w * w + x * x - y * y - z * z, two * (x * y - w * z), two * (x * z + w * y)},
            {two * (x * y + w * z), w * w - x * x + y * y - z * z, two * (y * z - w * x)},
            {two * (x * z - w * y), two * (y * z + w * x), w * w - x * x - y * y + z * z}}},
          {}};
}

/// Subtracts the eye after the rotation, as the textbook matrix does; the extra bits make up for the
/// cancellation.
template <int bits>
ReferenceMatrix<bits> reference_view(const Vec3& eye, const Vec3& look, const Vec3& up) {
  using V = ReferenceVec3<bits>;
  const V forward = normalized(V(look) - V(eye));
  const V right = normalized(cross(forward, normalized(V(up))));
  const V camera_up = cross(right, forward);
  const V backward = V() - forward;
  ReferenceMatrix<bits> m = {{right, camera_up, backward}, {}};
  m.offset = V() - m * V(eye);
  return m;
}

/// A projection, given by its window on the near plane (perspective and frustum) or in space (orthographic).
template <int bits>
struct ReferenceProjection {
  bool is_perspective = true;
  Real<bits> left, right, bottom, top, near, far;

  /// NDC by the matrices of glFrustum and glOrtho and the perspective divide.
  [[nodiscard]] ReferenceVec3<bits> ndc(const ReferenceVec3<bits>& p) const {
    using R = Real<bits>;
    const R two = 2;
    if (!is_perspective)
      return {(two * p.x - left - right) / (right - left), (two * p.y - bottom - top) / (top - bottom),
              (-two * p.z - far - near) / (far - near)};
    const R w = -p.z;
    return {(two * near * p.x + (right + left) * p.z) / (right - left) / w,
            (two * near * p.y + (top + bottom) * p.z) / (top - bottom) / w,
            (-(far + near) * p.z - two * far * near) / (far - near) / w};
  }
};

template <int bits>
ReferenceProjection<bits> reference_projection(const Projection& projection) {
  using R = Real<bits>;
  if (const auto* f = std::get_if<Frustum>(&projection))
    return {true, f->left, f->right, f->bottom, f->top, f->near, f->far};
  if (const auto* o = std::get_if<Orthographic>(&projection))
    return {false, o->left, o->right, o->bottom, o->top, o->near, o->far};
  const auto& p = std::get<Perspective>(projection);
  const R half_y = times_power_of_two(radians(R(p.fov_y_degrees)), -1);
  const R half_x = times_power_of_two(radians(R(p.fov_y_degrees) * R(p.aspect)), -1);
  const R top = R(p.near) * tan(half_y);
  const R right = p.aspect_rule == AspectRule::angle ? R(p.near) * tan(half_x) : top * R(p.aspect);
  return {true, -right, right, -top, top, p.near, p.far};
}

/// A model transform, computed by the library and exact.
template <int bits>
struct Model {
  AffineMatrix computed = identity();
  ReferenceMatrix<bits> exact = reference_scaling<bits>({1, 1, 1});
  double stretch = 1;  // at least the ratio of the largest to the smallest singular value of the linear part

  Model& translate(const Vec3& v) { return set(translated(computed, v), reference_translation<bits>(v)); }
  Model& scale(const Vec3& v) {
    const auto [least, largest] = std::minmax({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    stretch *= largest / least;
    return set(scaled(computed, v), reference_scaling<bits>(v));
  }
  Model& rotate(double angle, const Vec3& axis) {
    return set(computed * rotation(angle, axis), reference_rotation<bits>(angle, axis));
  }

 private:
  Model& set(const AffineMatrix& product, const ReferenceMatrix<bits>& exact_t) {
    computed = product;
    exact = exact * exact_t;
    return *this;
  }
};

/// 10^exponent.
template <int bits>
Real<bits> power_of_ten(int exponent) {
  return exponent == 0 ? Real<bits>(1) : Real<bits>(10) * power_of_ten<bits>(exponent - 1);
}

/// A calculated number in units of the last printed decimal, rounded, ties to even. A number within 2^-150
/// units of a tie counts as the tie, since the reference itself has rounding errors.
template <int bits>
Real<bits> in_units(const Real<bits>& value, const Real<bits>& units_per_one) {
  const Real<bits> fine = round_to_even(times_power_of_two(value * units_per_one, 150));
  return round_to_even(times_power_of_two(fine, -150));
}

/// The expected text of a calculated number; `size` is the size of the largest number in the calculation.
template <int bits>
std::string reference_text(const Real<bits>& value, NumberFormat format, const Real<bits>& size = 1) {
  if (!format.shortest) {
    const Real<bits> scale = power_of_ten<bits>(format.decimals);
    return (in_units(value, scale) / scale).text(format.decimals);
  }
  const bool is_zero = abs(value) <= times_power_of_two(size, -bits / 2);
  const double nearest = is_zero ? 0.0 : rounded_to_bits(value, bits - 100).nearest_double();
  char text[kMaxNumberLength];
  return {text, print_number(text, nearest, 0, format)};
}

inline std::string printed(double hi, double lo, NumberFormat format) {
  char text[kMaxNumberLength];
  return {text, print_number(text, hi, lo, format)};
}

}  // namespace pipeline
