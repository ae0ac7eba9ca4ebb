#include "libpipeline/numbers/exact_sum.h"

#include <array>
#include <cassert>

namespace pipeline {
namespace {

constexpr std::size_t kMaxProducts = 18;

/// A product of four doubles as significand * 2^exponent; the exponent is from 4 (-1073 - 53), as the least
/// double is 1/2 * 2^-1073, to 4 (1024 - 53).
struct WholeProduct {
  FixedInt<4> significand;
  int exponent;
};
constexpr int kLeastExponent = -4504, kLargestExponent = 3884;
// Both have room for a sum of 18 significands of 212 bits.
using UsualSum = FixedInt<8>;
using LargestSum = FixedInt<136>;
constexpr int kUsualRange = 280;

WholeProduct whole(const ExactProduct& product) {
  WholeProduct result = {1, 0};
  for (const double factor : {product.a, product.b, product.c, product.d}) {
    int own = 0;
    const double fraction = std::frexp(factor, &own);
    result.significand =
        result.significand * FixedInt<4>(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    result.exponent += own - 53;
  }
  return result;
}

template <typename Sum>
Ball sum_of(std::span<const WholeProduct> products, int least_exponent) {
  Sum sum(0);
  for (const WholeProduct& p : products) sum = sum + (Sum(p.significand) << (p.exponent - least_exponent));
  return to_ball(sum, least_exponent);
}

}  // namespace

Ball exact_sum(std::span<const ExactProduct> products) {
  assert(products.size() <= kMaxProducts);
  std::array<WholeProduct, kMaxProducts> terms;
  std::size_t count = 0;
  int least = kLargestExponent, largest = kLeastExponent;
  for (const ExactProduct& product : products) {
    if (product.a == 0 || product.b == 0 || product.c == 0 || product.d == 0) continue;
    terms[count] = whole(product);
    least = std::min(least, terms[count].exponent);
    largest = std::max(largest, terms[count++].exponent);
  }
  const std::span<const WholeProduct> used = std::span(terms).first(count);
  return largest - least <= kUsualRange ? sum_of<UsualSum>(used, least) : sum_of<LargestSum>(used, least);
}

BallVec3 exact_face_normal(const Triangle& p) {
  const Vec3 &a = p[0], &b = p[1], &c = p[2];
  const auto along = [&](double Vec3::*u, double Vec3::*v) {  // multiplied out
    return exact_sum(
        {{b.*u, c.*v}, {b.*v, a.*u}, {a.*v, c.*u}, {-(b.*v), c.*u}, {-(b.*u), a.*v}, {-(a.*u), c.*v}});
  };
  return {along(&Vec3::y, &Vec3::z), along(&Vec3::z, &Vec3::x), along(&Vec3::x, &Vec3::y)};
}

}  // namespace pipeline
