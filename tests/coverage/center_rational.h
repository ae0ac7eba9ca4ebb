#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <utility>

#include "libpipeline/scene/viewport.h"
#include "tests/coverage/center_reference.h"

namespace pipeline {

/// A vertex or a pixel center.
struct RationalPoint {
  mpq_class x, y, z;
};

/// The decimal of 7 decimals nearest to hi + lo.
inline mpq_class decimal(double hi, double lo) {
  const mpq_class units = (mpq_class(hi) + mpq_class(lo)) * 10'000'000 + mpq_class(1, 2);
  mpz_class whole;
  mpz_fdiv_q(whole.get_mpz_t(), units.get_num_mpz_t(), units.get_den_mpz_t());
  mpq_class result(whole, 10'000'000);
  result.canonicalize();
  return result;
}

/// The pixels that a triangle owns by the rule `center`, and its depth there, in rational numbers: directly
/// from the definition, pixel by pixel.
class ExactCoverage {
 public:
  ExactCoverage(const TextTriangle& t, const Viewport& s) {
    const auto number = [&](std::size_t i, double hi, double lo) {
      return ((t.decimal_marks >> i) & 1u) != 0 ? decimal(hi, lo) : mpq_class(hi);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& p = t.p[i];
      const Vec3& low = t.low_parts[i];
      p_[i] = {number(3 * i, p.x, low.x), number(3 * i + 1, p.y, low.y), number(3 * i + 2, p.z, low.z)};
    }
    left_ = s.left_is_decimal ? decimal(s.left, s.left_low_part) : mpq_class(s.left);
    bottom_ = s.bottom_is_decimal ? decimal(s.bottom, s.bottom_low_part) : mpq_class(s.bottom);
    dx_ = -2 * left_ / s.columns;
    dy_ = -2 * bottom_ / s.rows;
    area_ = edge(p_[0], p_[1], p_[2]);
    if (area_ < 0) std::swap(p_[1], p_[2]);
    area_ = abs(area_);
  }

  [[nodiscard]] bool covers(int row, int column) const {
    const RationalPoint center = center_of(row, column);
    bool result = area_ != 0;
    for (std::size_t i = 0; i < 3 && result; ++i) {
      const RationalPoint& from = p_[i];
      const RationalPoint& to = p_[(i + 1) % 3];
      const mpq_class value = edge(from, to, center);
      const bool is_top_or_left = to.y < from.y || (to.y == from.y && to.x < from.x);
      result = value > 0 || (value == 0 && is_top_or_left);
    }
    return result;
  }

  [[nodiscard]] mpq_class depth(int row, int column) const {
    const RationalPoint center = center_of(row, column);
    mpq_class sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += edge(p_[(i + 1) % 3], p_[(i + 2) % 3], center) * p_[i].z;
    return sum / area_;
  }

  [[nodiscard]] mpq_class largest_depth() const {
    return std::max({mpq_class(abs(p_[0].z)), mpq_class(abs(p_[1].z)), mpq_class(abs(p_[2].z))});
  }

 private:
  static mpq_class edge(const RationalPoint& a, const RationalPoint& b, const RationalPoint& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  }
  [[nodiscard]] RationalPoint center_of(int row, int column) const {
    return {left_ + dx_ * (2 * column + 1) / 2, -bottom_ - dy_ * (2 * row + 1) / 2, 0};
  }

  std::array<RationalPoint, 3> p_;
  mpq_class left_, bottom_, dx_, dy_, area_;
};

}  // namespace pipeline
