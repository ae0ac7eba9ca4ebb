#include "libpipeline/vertex/transform.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/numbers/random_numbers.h"
#include "tests/vertex/reference_transforms.h"

namespace pipeline {
namespace {

constexpr int kTransformBits = 640;
using Exact640 = Real<kTransformBits>;
using ExactVec3 = ReferenceVec3<kTransformBits>;
using ExactMatrix = ReferenceMatrix<kTransformBits>;

// The reference's own error, relative to the largest term of its sums.
const Exact640 kSlack = times_power_of_two(Exact640(1), -500);

void expect_contained(const BallVec3& computed, const ExactVec3& truth, const Exact640& size) {
  ASSERT_TRUE(contains(computed.x, truth.x, size * kSlack)) << truth.x;
  ASSERT_TRUE(contains(computed.y, truth.y, size * kSlack)) << truth.y;
  ASSERT_TRUE(contains(computed.z, truth.z, size * kSlack)) << truth.z;
}

void expect_contained(const AffineMatrix& computed, const ExactMatrix& truth, const Exact640& size) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = computed.rows[i];
    expect_contained({row[0], row[1], row[2]}, truth.rows[i], size);
  }
  expect_contained({computed.rows[0][3], computed.rows[1][3], computed.rows[2][3]}, truth.offset, size);
}

/// The largest error of the linear part, relative to its largest entry.
double relative_error(const AffineMatrix& m) {
  double largest = 0;
  double error = 0;
  for (const auto& row : m.rows) {
    for (std::size_t j = 0; j < 3; ++j) {
      largest = std::max(largest, row[j].magnitude());
      error = std::max(error, row[j].radius());
    }
  }
  return error / largest;
}

Vec3 random_vector(RandomNumbers& random, int first_exponent, int last_exponent) {
  const auto number = [&] { return random.with_exponent(first_exponent, last_exponent); };
  return {number(), number(), number()};
}

double random_angle(RandomNumbers& random) {
  switch (random.bits() % 4) {
    case 0:
      return 15.0 * random.whole(-48, 48);
    case 1:
      return random.with_exponent(-300, 300);
    default:
      return random.between(-360, 360);
  }
}

/// A random transform, as computed and exactly.
struct RandomTransform {
  AffineMatrix computed;
  ExactMatrix exact;
};

RandomTransform random_rotation(RandomNumbers& random) {
  const double angle = random_angle(random);
  const int exponent = random.whole(-900, 900);
  const Vec3 axis = random_vector(random, exponent - 20, exponent);
  return {rotation(angle, axis), reference_rotation<kTransformBits>(angle, axis)};
}

RandomTransform random_transform(RandomNumbers& random, int last_exponent) {
  const Vec3 v = random_vector(random, -last_exponent, last_exponent);
  switch (random.bits() % 4) {
    case 0:
      return {translated(identity(), v), reference_translation<kTransformBits>(v)};
    case 1:
      return {scaled(identity(), v), reference_scaling<kTransformBits>(v)};
    default:
      return random_rotation(random);
  }
}

/// The largest entry, or 1.
Exact640 size_of(const ExactMatrix& m) {
  Exact640 size = 1;
  for (const ExactVec3& v : {m.rows[0], m.rows[1], m.rows[2], m.offset})
    size = std::max({size, abs(v.x), abs(v.y), abs(v.z)});
  return size;
}

TEST(Rotation, ContainsTheTruth) {
  RandomNumbers random(1);
  for (int i = 0; i < 3'000; ++i) {
    const RandomTransform r = random_rotation(random);
    expect_contained(r.computed, r.exact, 1);
    ASSERT_FALSE(HasFatalFailure()) << "rotation " << i;
  }
}

TEST(Rotation, IsKnownToThirtyDigits) {
  RandomNumbers random(2);
  for (int i = 0; i < 3'000; ++i) ASSERT_LE(relative_error(random_rotation(random).computed), 0x1p-95) << i;
}

TEST(Rotation, ByATinyAngleKeepsTheVersine) {
  // The entry (1 - cos) x y, which a later scaling can make visible.
  const AffineMatrix m = rotation(1e-200, {1, 1, 0});
  const Exact640 half_sine = sin(times_power_of_two(radians(Exact640(1e-200)), -1));
  EXPECT_TRUE(contains(m.rows[0][1], half_sine * half_sine));
  EXPECT_EQ(m.rows[0][1].sign(), 1);
}

/// Checks products of eight transforms. `multiply(random, last_exponent, product)` multiplies the computed
/// product by a random one, and returns it exactly.
template <typename Multiply>
void expect_products_contain_the_truth(std::uint64_t seed, Multiply&& multiply) {
  RandomNumbers random(seed);
  for (int i = 0; i < 1'000; ++i) {
    AffineMatrix computed = identity();
    ExactMatrix exact = reference_scaling<kTransformBits>({1, 1, 1});
    Exact640 size = 1;
    const int last_exponent = i % 2 == 0 ? 20 : 3;
    for (int depth = 0; depth < 8; ++depth) {
      const ExactMatrix factor = multiply(random, last_exponent, computed);
      exact = exact * factor;
      size = std::max(size, size_of(exact)) * size_of(factor);
      expect_contained(computed, exact, size);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "product " << i << ", factor " << depth;
    }
  }
}

TEST(MatrixProduct, ContainsTheTruth) {
  expect_products_contain_the_truth(3, [](RandomNumbers& random, int last_exponent, AffineMatrix& product) {
    const RandomTransform t = random_transform(random, last_exponent);
    product = product * t.computed;
    return t.exact;
  });
}

TEST(MatrixProduct, ContainsTheTruthWithoutTheProductsByZeroAndOne) {
  expect_products_contain_the_truth(5, [](RandomNumbers& random, int last_exponent, AffineMatrix& product) {
    const Vec3 v = random_vector(random, -last_exponent, last_exponent);
    const RandomTransform r = random_rotation(random);
    switch (random.whole(0, 2)) {
      case 0:
        product = translated(product, v);
        return reference_translation<kTransformBits>(v);
      case 1:
        product = scaled(product, v);
        return reference_scaling<kTransformBits>(v);
      default:
        product = product * r.computed;
        return r.exact;
    }
  });
}

TEST(MatrixProduct, HasTheSameMidpointsWithAndWithoutTheProductsByZeroAndOne) {
  RandomNumbers random(6);
  for (int i = 0; i < 1'000; ++i) {
    const Vec3 v = random_vector(random, -900, 900);
    const AffineMatrix m = translated(scaled(random_rotation(random).computed, random_vector(random, -9, 9)),
                                      random_vector(random, -9, 9));
    const auto expect_same = [](const AffineMatrix& shorter, const AffineMatrix& longer) {
      for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) {
          const Ball& a = shorter.rows[row][column];
          const Ball& b = longer.rows[row][column];
          ASSERT_EQ(a.value(), b.value());
          ASSERT_EQ(a.exponent(), b.exponent());
          ASSERT_LE(a.radius(), b.radius() * (1 + 0x1p-30));
        }
    };
    expect_same(translated(m, v), m * translated(identity(), v));
    expect_same(scaled(m, v), m * scaled(identity(), v));
    ASSERT_FALSE(HasFatalFailure()) << "matrix " << i;
  }
}

TEST(MatrixProduct, ContainsTheTruthWhereScalesLeaveTheRange) {
  RandomNumbers random(4);
  for (int i = 0; i < 1'000; ++i) {
    const double scale = random.with_exponent(-1000, 1000);
    const RandomTransform first = random_rotation(random);
    const RandomTransform second = random_rotation(random);
    const Vec3 factors = {scale, scale, scale};
    const Vec3 back = {1 / scale, 1 / scale, 1 / scale};
    AffineMatrix computed =
        scaled(identity(), factors) * first.computed * second.computed * scaled(identity(), back);
    const auto exact_scale = reference_scaling<kTransformBits>(factors);
    const auto exact_back = reference_scaling<kTransformBits>(back);
    ExactMatrix exact = exact_scale * first.exact * second.exact * exact_back;
    if (i % 2 == 0) {  // twice as far away
      computed = scaled(identity(), factors) * computed * second.computed * scaled(identity(), back);
      exact = exact_scale * exact * second.exact * exact_back;
    }
    expect_contained(computed, exact, 1);
    ASSERT_FALSE(HasFatalFailure()) << "scale " << std::hexfloat << scale;
    ASSERT_LE(relative_error(computed), 0x1p-90) << "scale " << std::hexfloat << scale;
  }
}

/// p + 10^6 y e_x: it lengthens vectors 10^6 times, and no such command exists.
AffineMatrix shear() {
  AffineMatrix::Rows rows = identity().rows;
  rows[0][1] = 1e6;
  return AffineMatrix(rows);
}

TEST(AffineMatrix, IsBoundedByItsEntriesWhereNoMoreIsKnown) {
  EXPECT_EQ(shear().row_errors, (std::array<double, 3>{}));
  EXPECT_GE(shear().norm, std::hypot(1e6, 1));  // the image of y
  EXPECT_LE(shear().norm, 1e6 * (1 + 1e-9));
  AffineMatrix::Rows uncertain = identity().rows;
  uncertain[2][0] = Ball(1) / Ball(3);
  const AffineMatrix m(uncertain);
  EXPECT_GE(m.row_errors[2], uncertain[2][0].radius());
  EXPECT_EQ(m.row_errors[1], 0);
}

// An error e of a row becomes e * shear: along x, 10^6 times as long.
TEST(MatrixProduct, LengthensErrorsAsItsSecondFactorLengthensVectors) {
  const AffineMatrix step = rotation(1.1, {1, 2, 3});
  AffineMatrix turned = step;
  for (int i = 1; i < 1'000; ++i) turned = turned * step;
  const AffineMatrix product = turned * shear();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_GE(product.row_errors[i], 1e6 * turned.row_errors[i]) << i;
}

TEST(MatrixProduct, ErrorGrowsLinearlyWithTheNumberOfRotations) {
  const AffineMatrix step = rotation(1.1, {1, 2, 3});
  const ExactMatrix exact_step = reference_rotation<kTransformBits>(1.1, {1, 2, 3});
  AffineMatrix m = step;
  ExactMatrix exact = exact_step;
  for (int i = 1; i < 10'000; ++i) {
    m = m * step;
    exact = exact * exact_step;
  }
  EXPECT_LE(relative_error(m), 10'000 * 0x1p-95);
  expect_contained(m, exact, 1);
}

TEST(ViewFromWorld, ContainsTheTruth) {
  RandomNumbers random(5);
  for (int i = 0; i < 3'000; ++i) {
    const int exponent = random.whole(-900, 900);
    const Vec3 eye = random_vector(random, exponent - 20, exponent);
    const Vec3 look = random_vector(random, exponent - 20, exponent + 20);
    const Vec3 up = random_vector(random, -exponent - 4, -exponent);
    const ViewTransform view = view_from_world(eye, look, up);
    const ExactMatrix exact = reference_view<kTransformBits>(eye, look, up);
    expect_contained(view.right, exact.rows[0], 1);
    expect_contained(view.up, exact.rows[1], 1);
    expect_contained(view.backward, exact.rows[2], 1);
    ASSERT_FALSE(HasFatalFailure()) << "camera " << i;
  }
}

TEST(ViewFromWorld, ContainsTheTruthWithUpCloseToTheViewDirection) {
  RandomNumbers random(6);
  for (int i = 0; i < 3'000; ++i) {
    const Vec3 look = random_vector(random, -3, 3);
    const double tilt = std::ldexp(1.0, random.whole(-51, -20));
    const Vec3 up = {look.x * (1 + tilt), look.y, look.z};
    const ViewTransform view = view_from_world({}, look, up);
    const ExactMatrix exact = reference_view<kTransformBits>({}, look, up);
    expect_contained(view.right, exact.rows[0], 1);
    expect_contained(view.up, exact.rows[1], 1);
    ASSERT_FALSE(HasFatalFailure()) << "camera " << i;
    ASSERT_LE(view.right.x.error(), 0x1p-90);
  }
}

TEST(IsParallelToView, SeesParallelVectorsOfAnySize) {
  EXPECT_TRUE(is_parallel_to_view({0, 0, 0}, {1, 2, 3}, {2, 4, 6}));
  EXPECT_TRUE(is_parallel_to_view({0, 0, 0}, {1, 2, 3}, {-0x1p-1000, -0x2p-1000, -0x3p-1000}));
  EXPECT_TRUE(is_parallel_to_view({1e15, 1e15, 1e15}, {1e15 + 1, 1e15 + 2, 1e15 + 3}, {2, 4, 6}));
}

TEST(IsParallelToView, SeesTheLastBitOfADifference) {
  EXPECT_FALSE(is_parallel_to_view({0, 0, 0}, {1, 2, 3}, {1, 2, 3 + 0x1p-51}));
  EXPECT_FALSE(
      is_parallel_to_view({0, 0, 0}, {1e-300, 2e-300, 3e-300}, {1e300, 2e300, 3.0000000000000004e300}));
}

TEST(IsParallelToView, AnUpThatIsNotParallelHasAViewTransform) {
  // Parallel up to about the 31st digit, with an eye whose bits make the view direction wider than a double.
  RandomNumbers random(7);
  for (int i = 0; i < 20'000; ++i) {
    const double p = random.whole(1 << 20, 1 << 26) * 0x1p26 + random.whole(0, 1 << 26);
    const double q = random.whole(1 << 20, 1 << 26) * 0x1p26 + random.whole(0, 1 << 26);
    // look - eye = p + a few bits below the low end of a double-double, in almost the ratio of up.
    const Vec3 eye = {-p * std::ldexp(1.0, -random.whole(48, 108)), 0, 0};
    const Vec3 look = {p, q, 0};
    const Vec3 up = {p, q, 0};
    if (is_parallel_to_view(eye, look, up)) continue;
    const ViewTransform view = view_from_world(eye, look, up);
    for (const Ball& entry : {view.right.x, view.right.y, view.right.z, view.up.x, view.up.y, view.up.z})
      ASSERT_TRUE(std::isfinite(entry.error()) && entry.error() >= 0)
          << std::hexfloat << p << ", " << q << ", " << eye.x;
  }
}

void expect_projection(const Projection& projection) {
  const ProjectionTransform computed = clip_from_view({projection, {}});
  const auto exact = reference_projection<kTransformBits>(projection);
  const Exact640 width = exact.right - exact.left;
  const Exact640 height = exact.top - exact.bottom;
  const Exact640 two_near = Exact640(2) * exact.near;
  const auto is_close = [](const Ball& ball, const Exact640& truth) {
    return contains(ball, truth, abs(truth) * kSlack);
  };
  ASSERT_EQ(computed.is_perspective, exact.is_perspective);
  if (exact.is_perspective) {
    ASSERT_TRUE(is_close(computed.x_scale, two_near / width)) << two_near / width;
    ASSERT_TRUE(is_close(computed.y_scale, two_near / height)) << two_near / height;
    ASSERT_TRUE(is_close(computed.x_offset, (exact.right + exact.left) / width));
    ASSERT_TRUE(is_close(computed.y_offset, (exact.top + exact.bottom) / height));
  } else {
    ASSERT_TRUE(is_close(computed.x_scale, Exact640(2) / width));
    ASSERT_TRUE(is_close(computed.y_scale, Exact640(2) / height));
    ASSERT_TRUE(is_close(computed.x_offset, -(exact.right + exact.left) / width));
    ASSERT_TRUE(is_close(computed.y_offset, -(exact.top + exact.bottom) / height));
  }
}

TEST(ClipFromView, ContainsTheTruthOfAPerspective) {
  RandomNumbers random(8);
  for (int i = 0; i < 2'000; ++i) {
    const double fov_y = random.between(0.001, 179.999);
    Perspective p = {fov_y, random.between(0.001, 179.99 / fov_y), std::fabs(random.with_exponent(-20, 20)),
                     0x1p30};
    expect_projection(p);
    p.aspect_rule = AspectRule::ratio;
    expect_projection(p);
    ASSERT_FALSE(HasFatalFailure()) << std::hexfloat << p.fov_y_degrees << ", " << p.aspect;
  }
}

TEST(ClipFromView, ContainsTheTruthOfExtremeFieldsOfView) {
  for (const double fov_y : {0x1p-1074, 1e-300, 1e-60, 1e-10, 179.999999999999, 179.99999999999997}) {
    for (const double aspect : {1.0, 1e-300, 1e-20, 0.1, 1 - 0x1p-53, 0x1p-1074}) {
      expect_projection(Perspective{fov_y, aspect, 1, 2});
      expect_projection(Perspective{fov_y, aspect, 1, 2, AspectRule::ratio});
      ASSERT_FALSE(HasFatalFailure()) << fov_y << ", " << aspect;
    }
  }
}

TEST(ClipFromView, ContainsTheTruthOfAFrustum) {
  RandomNumbers random(9);
  for (int i = 0; i < 2'000; ++i) {
    const auto number = [&] { return random.with_exponent(-300, 300); };
    expect_projection(Frustum{number(), number(), number(), number(), std::fabs(number()), 0x1p302});
    ASSERT_FALSE(HasFatalFailure()) << "frustum " << i;
  }
}

TEST(ClipFromView, ContainsTheTruthOfAParallelProjection) {
  RandomNumbers random(10);
  for (int i = 0; i < 2'000; ++i) {
    const auto number = [&] { return random.with_exponent(-300, 300); };
    expect_projection(Orthographic{number(), number(), number(), number(), -1, 1});
    ASSERT_FALSE(HasFatalFailure()) << "projection " << i;
  }
}

TEST(ClipFromView, RefusesAnAngleFromASideToASide) {
  const Located<Projection> wide = {Perspective{90, 2, 1, 2}, {"scene.txt", 4, 1}};
  try {
    clip_from_view(wide);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.txt:4:1: expected fovX = fovY * aspect above 0 and below 180 degrees (or --aspect "
                 "ratio; in a scene, "
                 "the word ratio at the end), "
                 "found 90 * 2");
  }
}

TEST(ClipFromView, TakesAnAngleJustBelowAHalfTurn) {
  EXPECT_NO_THROW(clip_from_view({Perspective{90 * (1 - 0x1p-53), 2, 1, 2}, {}}));
  EXPECT_THROW(clip_from_view({Perspective{100, 1e308, 1, 2}, {}}), InputError);
}

TEST(ClipFromView, TakesAFieldOfViewThatOnlyItsLowPartKeepsBelowAHalfTurn) {
  // (180 - 45 * 2^-45) (1 + 32 * 2^-52) = 180 - 1440 * 2^-97; in doubles that is 180.
  const double fov_y = 180 - 45 * 0x1p-45;
  const double aspect = 1 + 32 * 0x1p-52;
  EXPECT_EQ(fov_y * aspect, 180);
  EXPECT_NO_THROW(clip_from_view({Perspective{fov_y, aspect, 1, 2}, {}}));
}

TEST(ViewFromClip, TakesBackAProjectionBesideTheAxis) {
  // Scales and offsets are 1/2: the point (1, -1, -2) is at (1/2 - 1, -1/2 - 1) in clip space, with w 2.
  const ViewFromClip frustum(clip_from_view({Frustum{-1, 3, -1, 3, 1, 9}, {}}));
  EXPECT_EQ(frustum({-0.5, -1.5, 0}, 2), (Vec3{1, -1, -2}));
  // Scales are 1/2, offsets -1/2; z goes from -1 at 1 to 1 at 9.
  const ViewFromClip ortho(clip_from_view({Orthographic{-1, 3, -1, 3, 1, 9}, {}}));
  EXPECT_EQ(ortho({0, -1, 0.5}, 1), (Vec3{1, -1, -7}));
}

}  // namespace
}  // namespace pipeline
