#include "libpipeline/vertex/vertex_kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/number_printer.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"
#include "tests/numbers/testable_targets.h"

namespace pipeline {
namespace {

using ExactKernel = Real<4096>;

constexpr RoundingTest kNearest = {RoundingTestKind::nearest};

RoundingTest test_of_decimals(int decimals, bool needs_pairs) {
  return {RoundingTestKind::decimals, std::pow(10.0, decimals), needs_pairs};
}

std::string printed(double value, int decimals) {
  char text[kMaxNumberLength];
  return {text, print_number(text, value, 0, {.decimals = decimals})};
}

/// A transform with three equal rows.
AffineCoefficients coefficients_of(const std::array<Ball, 4>& row, const Vec3& origin = {}) {
  AffineCoefficients coefficients;
  coefficients.origin = origin;
  for (auto& coefficient_row : coefficients.rows)
    for (std::size_t j = 0; j < 4; ++j) coefficient_row[j] = Coefficient(row[j]);
  return coefficients;
}

VertexBlock block_of(const Vec3& p) {
  VertexBlock block;
  const Triangle triangle = {p, p, p};
  block.fill({&triangle, 1});
  return block;
}

class VertexKernels : public testing::TestWithParam<std::size_t> {
 protected:
  static const VertexKernel& kernel() { return *kVertexKernels[GetParam()]; }
  static ImageBlock image_of(const AffineCoefficients& coefficients, const Vec3& p,
                             const RoundingTest& test = kNearest) {
    ImageBlock image;
    kernel().transform(coefficients, test, block_of(p), image);
    return image;
  }
  static bool accepts(const std::array<Ball, 4>& row, const Vec3& p, const RoundingTest& test = kNearest) {
    return image_of(coefficients_of(row), p, test).passes_rounding_test[0] != 0;
  }
};

std::array<Ball, 4> random_row(RandomNumbers& random, int largest_exponent) {
  std::array<Ball, 4> row;
  for (Ball& entry : row) {
    const DoubleDouble value = random.double_double(-largest_exponent, largest_exponent);
    if (random.bits() % 8 != 0) entry = Ball::with_error(value, 0);
  }
  return row;
}

Vec3 random_vec3(RandomNumbers& random, int largest_exponent) {
  const auto coordinate = [&] { return random.with_exponent(-largest_exponent, largest_exponent); };
  return {coordinate(), coordinate(), coordinate()};
}

ExactKernel exact_image(const std::array<Ball, 4>& row, const Vec3& origin, const Vec3& p) {
  return midpoint<4096>(row[0]) * (ExactKernel(p.x) - ExactKernel(origin.x)) +
         midpoint<4096>(row[1]) * (ExactKernel(p.y) - ExactKernel(origin.y)) +
         midpoint<4096>(row[2]) * (ExactKernel(p.z) - ExactKernel(origin.z)) + midpoint<4096>(row[3]);
}

TEST_P(VertexKernels, AcceptOnlyTheNearestDouble) {
  RandomNumbers random(1);
  int passed_count = 0;
  for (int i = 0; i < 30'000; ++i) {
    const int largest_exponent = i % 10 == 0 ? 290 : 20;
    const std::array<Ball, 4> row = random_row(random, largest_exponent);
    const Vec3 origin = random_vec3(random, largest_exponent);
    const Vec3 p = random_vec3(random, largest_exponent);
    const ImageBlock image = image_of(coefficients_of(row, origin), p);
    if (image.passes_rounding_test[0] == 0) continue;
    ++passed_count;
    ASSERT_EQ(image.p[0][0], exact_image(row, origin, p).nearest_double()) << i;
  }
  EXPECT_GT(passed_count, 27'000);
}

TEST_P(VertexKernels, AcceptOnlyTheNearestDecimal) {
  RandomNumbers random(2);
  int passed_count = 0;
  for (int i = 0; i < 30'000; ++i) {
    const int decimals = random.whole(0, 17);
    const std::array<Ball, 4> row = random_row(random, 3);
    const Vec3 origin = random_vec3(random, 3);
    const Vec3 p = random_vec3(random, 3);
    const ImageBlock image =
        image_of(coefficients_of(row, origin), p, test_of_decimals(decimals, i % 2 == 0));
    if (image.passes_rounding_test[0] == 0) continue;
    ++passed_count;
    ASSERT_EQ(printed(image.p[0][0], decimals), exact_image(row, origin, p).text(decimals)) << i;
  }
  EXPECT_GT(passed_count, 15'000);
}

TEST_P(VertexKernels, AcceptNoTieBetweenTwoDoubles) {
  EXPECT_TRUE(accepts({1, 0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(accepts({1, 0x1p-53, 0, 0}, {1, 1, 0}));
  EXPECT_FALSE(accepts({1, 0, 0, 3}, {0x1p-52, 0, 0}));
}

TEST_P(VertexKernels, AcceptNoTieOfDecimals) {
  for (const bool needs_pairs : {false, true}) {
    EXPECT_TRUE(accepts({1, 0, 0, 0}, {0.25, 0, 0}, test_of_decimals(2, needs_pairs)));
    EXPECT_FALSE(accepts({1, 0, 0, 0}, {0.125, 0, 0}, test_of_decimals(2, needs_pairs)));
    EXPECT_FALSE(accepts({1, 1, 0, 0}, {0.5, -1, 0}, test_of_decimals(0, needs_pairs)));
  }
}

TEST_P(VertexKernels, AcceptNoNumberWhoseErrorReachesATie) {
  const Ball wide = Ball::with_error({1, 0x1p-53 - 0x1p-100}, 0x1p-90);
  EXPECT_FALSE(accepts({wide, 0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(accepts({1, 0, 0, wide}, {0, 0, 0}));
}

TEST_P(VertexKernels, AcceptZeroIfEveryTermIsZero) {
  EXPECT_TRUE(accepts({0, 5, 0, 0}, {7, 0, -0.0}));
  EXPECT_FALSE(accepts({1, 1, 0, 0}, {3, -3, 0}));
  EXPECT_FALSE(accepts({Ball::with_error({0, 0}, 0x1p-200), 0, 0, 0}, {1, 0, 0}));
  // A product that underflows is not zero.
  EXPECT_FALSE(accepts({0x1p-280, 0, 0, 0}, {0x1p-900, 0, 0}));
}

TEST_P(VertexKernels, RejectWhatIsBeyondTheirRange) {
  EXPECT_FALSE(accepts({Ball(0x1p1000), 0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(accepts({Ball(0x1p-1000), 0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(accepts({0x1p200, 0, 0, 0}, {0x1p900, 0, 0}));
  for (const RoundingTest test : {RoundingTest{}, kNearest, test_of_decimals(7, false)})
    EXPECT_FALSE(accepts({2, 0, 0, 0}, {0x1.8p1023, 0, 0}, test));
}

TEST_P(VertexKernels, TestEveryVertexOfABlockByItself) {
  std::array<Triangle, VertexBlock::kTriangles> triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto x = static_cast<double>(i);
    triangles[i] = {Vec3{x, 0, 0}, Vec3{x, 1, 0}, Vec3{x, 0, 1}};
  }
  VertexBlock block;
  block.fill(triangles);
  ImageBlock image;
  kernel().transform(coefficients_of({1, 0x1p-53, 0, 1}), kNearest, block, image);
  ASSERT_EQ(image.count, 3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    EXPECT_EQ(image.p[0][3 * i], static_cast<double>(i + 1));
    EXPECT_NE(image.passes_rounding_test[3 * i], 0u);
    EXPECT_NE(image.passes_rounding_test[3 * i + 2], 0u);
  }
  EXPECT_EQ(image.passes_rounding_test[1], 0u);  // 1 + 2^-53
}

TEST_P(VertexKernels, TransformNormalsAsOneByOneUpToAZero) {
  RandomNumbers random(5);
  const std::array<Vec3, 3> rows = {random_vec3(random, 3), random_vec3(random, 3), random_vec3(random, 3)};
  std::array<Vec3, 29> normals;
  for (Vec3& normal : normals) normal = random_vec3(random, 900);
  normals[20] = {0, -0.0, 0};
  const std::array<Vec3, 29> before = normals;
  const std::size_t count = kernel().transform_normals(rows, normals);
  EXPECT_GE(count, 16u);  // two vectors of eight lanes
  ASSERT_LE(count, 20u);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 n = unit_vector(before[i]), image = {dot(rows[0], n), dot(rows[1], n), dot(rows[2], n)};
    EXPECT_EQ(normals[i], i < count ? unit_vector(image) : before[i]) << i;
  }
}

ProjectionCoefficients random_projection(RandomNumbers& random, std::array<Ball, 3>& scales,
                                         std::array<Ball, 3>& offsets) {
  ProjectionCoefficients coefficients;
  coefficients.is_perspective = random.bits() % 2 == 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scales[axis] = Ball::with_error(random.double_double(-10, 10), 0);
    offsets[axis] = random.bits() % 4 == 0 ? Ball() : Ball::with_error(random.double_double(-10, 10), 0);
    coefficients.scales[axis] = Coefficient(scales[axis]);
    coefficients.offsets[axis] = Coefficient(offsets[axis]);
  }
  return coefficients;
}

// The tests of ProjectionStage cover the depth in doubles.
TEST_P(VertexKernels, AcceptOnlyTheNearestQuotient) {
  RandomNumbers random(3);
  int passed_count = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::array<Ball, 3> scales;
    std::array<Ball, 3> offsets;
    const ProjectionCoefficients coefficients = random_projection(random, scales, offsets);
    Vec3 p = random_vec3(random, 20);
    if (i % 16 != 0) p.z = -std::fabs(p.z);
    const int decimals = random.whole(11, 17);
    const bool is_nearest = i % 2 == 0;
    ImageBlock p_ndc;
    kernel().project(coefficients, is_nearest ? kNearest : test_of_decimals(decimals, true), block_of(p),
                     p_ndc);
    if (p_ndc.passes_rounding_test[0] == 0) continue;
    ++passed_count;
    const ExactKernel w = coefficients.is_perspective ? -p.z : 1;
    ASSERT_GT(w.sign(), 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ExactKernel q = coefficients.is_perspective && axis < 2 ? p.z : 1;
      const ExactKernel v = axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
      const ExactKernel truth = (midpoint<4096>(scales[axis]) * v + midpoint<4096>(offsets[axis]) * q) / w;
      if (is_nearest) {
        ASSERT_EQ(p_ndc.p[axis][0], truth.nearest_double()) << i;
      } else {
        ASSERT_EQ(printed(p_ndc.p[axis][0], decimals), truth.text(decimals)) << i;
      }
    }
  }
  EXPECT_GT(passed_count, 8'000);
}

TEST_P(VertexKernels, AcceptNoQuotientBehindTheEyeOrOnItsPlane) {
  ProjectionCoefficients coefficients;
  for (Coefficient& coefficient : coefficients.scales) coefficient = Coefficient(Ball(1));
  for (const double z : {0.0, -0.0, 1.0, -0x1p-500, -0x1p500}) {
    ImageBlock p_ndc;
    kernel().project(coefficients, kNearest, block_of({1, 1, z}), p_ndc);
    EXPECT_EQ(p_ndc.passes_rounding_test[0], 0u) << z;
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, VertexKernels, testing::ValuesIn(testable_targets(kVertexKernels)),
                         name_of_target);

}  // namespace
}  // namespace pipeline
