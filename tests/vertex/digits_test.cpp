// A printed digit is right, or noted: the stages' exact digits against a reference of 512 bits where numbers
// cancel.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "libpipeline/vertex/attribute_transform.h"
#include "libpipeline/vertex/projection.h"
#include "libpipeline/vertex/vertex_transform.h"
#include "tests/vertex/printed_vertices.h"

namespace pipeline {
namespace {

constexpr int kBits = 512;
using R = Real<kBits>;
using ReferencePoint = ReferenceVec3<kBits>;
using TrackedModel = Model<kBits>;

/// Identical but for its rounding errors: numbers of the pivot's size are added and cancel.
TrackedModel around_pivot(double pivot) {
  return TrackedModel()
      .translate({pivot, 0, 0})
      .rotate(120, {1, 1, 1})
      .rotate(240, {1, 1, 1})
      .translate({-pivot, 0, 0});
}

const Triangle kOneToTen = {Vec3{1, 2, 3}, Vec3{4, 5, 6}, Vec3{7, 8, 10}};

TriangleBatch batch_of_one(const Triangle& triangle) {
  TriangleBatch batch;
  batch.add(triangle, 0, {1, 2, 3});
  return batch;
}

struct Images {
  TriangleBatch batch;
  UncertainDigits uncertain;
};

template <typename Transform>
Images images_of(TriangleBatch batch, const Transform& transform, NumberFormat format) {
  CoordinateRounder rounder(Precision::extended, format, "input");
  VertexTransform(transform).apply(batch, rounder);
  return {std::move(batch), rounder.uncertain()};
}

TEST(Digits, ThatAreAllLostInOneCoordinateAreNoted) {
  for (const double x : {-1e32, -1e34, -1e40}) {
    const ViewTransform view = view_from_world({x, 0.5, 1e32}, {0, 5, 9}, {0, 1, 0});
    EXPECT_EQ(images_of(batch_of_one(kOneToTen), view, kShortest).uncertain.count, 3) << x;
  }
}

TEST(Digits, OfAnOriginThatAreAllLostAreNoted) {
  EXPECT_EQ(images_of(batch_of_one(Triangle{}), around_pivot(1e31).computed, kShortest).uncertain.count, 3);
  EXPECT_EQ(images_of(batch_of_one(Triangle{}), around_pivot(1e10).computed, kShortest).uncertain.count, 0);
}

TEST(Digits, OfAnyCornerThatIsKeptBeforeTheCutAreNoted) {
  // In clip space, y of the corner in the middle of this narrow window is 0, but for errors of 2^-50.
  constexpr double kMiddle = 1 + 0x3p-52;
  const ProjectionTransform narrow = clip_from_view({Frustum{-1, 1, 1, 1 + 0x6p-52, 1, 100}, {}});
  const auto uncertain_count = [&](const Triangle& triangle, bool keeps_unclipped) {
    CoordinateRounder rounder(Precision::extended, kShortest, "input");
    ProjectionStage stage(narrow, ClipMode::near, CullMode::nothing, rounder);
    if (keeps_unclipped) stage.keep_unclipped_triangles();
    TriangleBatch pieces;
    stage.project(batch_of_one(triangle), pieces);
    EXPECT_EQ(stage.counts().clipped, 1u);
    return rounder.uncertain().count;
  };
  Triangle triangle = {Vec3{0, 2 * kMiddle, -2}, Vec3{1, 0, -0.5}, Vec3{-1, 0, -2}};
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(uncertain_count(triangle, true), uncertain_count(triangle, false) + 1) << corner;
    std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  }
}

TEST(Digits, FarBelowTheLargestCoordinateReadAreZero) {
  // Exactly 28.9 beside 9.2e32.
  const Triangle triangle = {
      Vec3{360600465047406421645071818424320.0, 849521458699077910551463540555776.0, 0}, Vec3{1, 2, 3},
      Vec3{2, 3, 5}};
  const AffineMatrix turned = TrackedModel().rotate(23, {0, 0, 1}).computed;
  const Images images = images_of(batch_of_one(triangle), turned, kShortest);
  EXPECT_EQ(images.batch.triangles[0][0].x, 0);
  EXPECT_EQ(images.uncertain.count, 0);
  EXPECT_EQ(images_of(batch_of_one(triangle), turned, {7}).uncertain.count, 1);
}

TEST(Digits, ThatCancelToZeroInOrdinaryScenesAreZero) {
  const TrackedModel third_turn =
      TrackedModel().rotate(30, {1, 1, 1}).rotate(30, {1, 1, 1}).rotate(60, {1, 1, 1});
  const Triangle axes = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  const Images images = images_of(batch_of_one(axes), third_turn.computed, kShortest);
  EXPECT_EQ(images.uncertain.count, 0);
  EXPECT_EQ(images.batch.triangles[0], (Triangle{Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}));
  EXPECT_EQ(images_of(batch_of_one(axes), around_pivot(1e10).computed, kShortest).batch.triangles[0], axes);
  EXPECT_EQ(images_of(batch_of_one(axes), around_pivot(1e10).computed, kShortest).uncertain.count, 0);
}

// ---- numbers next to a tie: either neighbor is right, in silence ----

TEST(Digits, NextToATieBehindAFarPivotAreCertain) {
  TrackedModel pivot;
  pivot.translate({1e15, 0, 0});
  for (int i = 0; i < 3; ++i) pivot.rotate(120, {1, 1, 1});
  pivot.translate({-1e15, 0, 0});
  const Images images = images_of(batch_of_one(Triangle{Vec3{0.003906250000005, 0, 0}}), pivot.computed, {7});
  EXPECT_EQ(printed_vertex(images.batch, 0, {7}), "0.0039062 0.0000000 0.0000000");
  EXPECT_EQ(images.uncertain.count, 0);
}

TEST(Digits, NextToATieOfDoublesAreCertain) {
  const TrackedModel moved = TrackedModel().translate({1, 0, 0}).translate({1.1102230246251565e-16, 0, 0});
  const Images images = images_of(batch_of_one(Triangle{Vec3{1e-40, 0, 0}}), moved.computed, kShortest);
  EXPECT_EQ(images.batch.triangles[0][0].x, 1);
  EXPECT_EQ(images.uncertain.count, 0);
}

// ---- lights ----

Located<Light> light_at(const Vec3& position) {
  return {{position, {1, 1, 1}}, {"scene.txt", 9, 7}};
}

TEST(DigitsOfALight, ThatAreLostAreNoted) {
  for (const double pivot : {1e25, 1e31, 1e35}) {
    TrackedModel model;
    model.translate({pivot, 0, 0});
    for (int i = 0; i < 3; ++i) model.rotate(120, {1, 1, 1});
    model.translate({-pivot, 0, 0});
    UncertainDigits uncertain;
    transformed(model.computed, light_at({1, 2, 3}), uncertain);
    transformed(model.computed, light_at({1, 2, 3}), uncertain);
    EXPECT_EQ(uncertain.count, 2) << pivot;
    EXPECT_EQ(uncertain.first, LineAndColumn(9, 7)) << pivot;
  }
  UncertainDigits uncertain;
  transformed(view_from_world({-1e34, 0.5, 1e32}, {0, 5, 9}, {0, 1, 0}), light_at({1, 2, 3}), uncertain);
  EXPECT_EQ(uncertain.count, 1);
}

TEST(DigitsOfALight, ThatCancelToZeroAreZero) {
  UncertainDigits uncertain;
  const TrackedModel model = TrackedModel().rotate(30, {1, 1, 1}).rotate(30, {1, 1, 1}).rotate(60, {1, 1, 1});
  EXPECT_EQ(transformed(model.computed, light_at({0, 0, 1}), uncertain).value.position, (Vec3{1, 0, 0}));
  EXPECT_EQ(uncertain.count, 0);
}

// ---- random scenes ----

/// True if a double is the nearest one to the truth, or as good as that next to a tie, or a 0 that is small
/// beside what was read.
bool is_right(double printed, const R& truth, double input_size) {
  if (printed == 0 && abs(truth) <= R(0x1p-60 * input_size)) return true;
  const R difference = truth - R(printed);
  const double neighbor = std::nextafter(printed, difference.sign() * HUGE_VAL);
  const R half_gap = times_power_of_two(abs(R(neighbor) - R(printed)), -1);
  return abs(difference) <= half_gap * R(1 + 0x1p-19);
}

/// The same for a text with decimals.
bool is_right(const std::string& printed, const R& truth, int decimals) {
  const R tolerance = times_power_of_two(R(1) / power_of_ten<kBits>(decimals), -20);
  return printed == truth.text(decimals) || printed == (truth - tolerance).text(decimals) ||
         printed == (truth + tolerance).text(decimals);
}

struct Verdict {
  std::uint64_t numbers = 0;
  std::uint64_t cancelling = 0;  // by more than 20 digits
  std::uint64_t noted = 0;
  std::uint64_t silent_cancelling = 0;  // of those, certain
  std::uint64_t wrong = 0;              // although certain

  void add(double printed, const R& truth, double input_size, const R& largest_on_the_way, bool is_certain) {
    count(largest_on_the_way, truth, is_certain);
    if (!is_certain || is_right(printed, truth, input_size)) return;
    if (wrong++ < 3) ADD_FAILURE() << std::hexfloat << printed << " is not " << truth;
  }
  void count(const R& largest_on_the_way, const R& truth, bool is_certain) {
    const bool cancels = largest_on_the_way > abs(truth) * R(1e20);
    ++numbers;
    cancelling += cancels ? 1 : 0;
    noted += is_certain ? 0 : 1;
    silent_cancelling += cancels && is_certain ? 1 : 0;
  }
};

/// A size of a whole number of digits and its half, or of any digits.
double random_size(RandomNumbers& random, double first, double last) {
  const double size = std::pow(10, random.between(first, last));
  return random.bits() % 2 == 0 ? std::pow(10, std::floor(std::log10(size))) : size;
}

Vec3 random_axis(RandomNumbers& random) {
  static constexpr Vec3 kAxes[] = {{0, 0, 1}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}, {1, 2, 3}};
  return kAxes[random.bits() % std::size(kAxes)];
}

/// Far translations around rotations that may well undo each other, under a matrix of ordinary size.
TrackedModel random_far_model(RandomNumbers& random, double far) {
  const Vec3 axis = random_axis(random);
  const Vec3 pivot = {far, random.bits() % 2 == 0 ? 0 : -far, random.bits() % 2 == 0 ? 0 : far / 3};
  const double angle = random.bits() % 4 == 0 ? random.between(-360, 360) : 30.0 * random.whole(-12, 12);
  TrackedModel model;
  if (random.bits() % 4 == 0) model.rotate(15.0 * random.whole(-24, 24), random_axis(random));
  model.translate(pivot).rotate(angle, axis);
  model.rotate(random.bits() % 4 == 0 ? -angle : 360 - angle, axis).translate({-pivot.x, -pivot.y, -pivot.z});
  return model;
}

ReferencePoint reference_of(const ReferenceMatrix<kBits>& m, const Vec3& p) {
  return m * ReferencePoint(p);
}

/// Adds the images of random triangles under a transform.
template <typename Transform>
void add_images(RandomNumbers& random, const Transform& transform, const ReferenceMatrix<kBits>& exact,
                double far, Verdict& verdict) {
  for (int i = 0; i < 4; ++i) {
    const double size = random_size(random, -2, 3);
    const Triangle triangle = {random_point(random, size), random_point(random, size),
                               random_point(random, size)};
    const Images images = images_of(batch_of_one(triangle), transform, kShortest);
    for (std::size_t v = 0; v < 3; ++v) {
      const Vec3& image = images.batch.triangles[0][v];
      const ReferencePoint truth = reference_of(exact, triangle[v]);
      const bool is_certain = images.uncertain.count == 0;
      verdict.add(image.x, truth.x, size_of(triangle), R(far), is_certain);
      verdict.add(image.y, truth.y, size_of(triangle), R(far), is_certain);
      verdict.add(image.z, truth.z, size_of(triangle), R(far), is_certain);
    }
    for (const int decimals : {7, 9}) {
      const Images in_decimals = images_of(batch_of_one(triangle), transform, {decimals});
      if (in_decimals.uncertain.count != 0) continue;
      for (std::size_t v = 0; v < 3; ++v) {
        const ReferencePoint truth = reference_of(exact, triangle[v]);
        const Vec3& hi = in_decimals.batch.triangles[0][v];
        const Vec3 lo = in_decimals.batch.low_parts.empty() ? Vec3() : in_decimals.batch.low_parts[0][v];
        const NumberFormat format = {decimals};
        EXPECT_TRUE(is_right(printed(hi.x, lo.x, format), truth.x, decimals));
        EXPECT_TRUE(is_right(printed(hi.y, lo.y, format), truth.y, decimals));
        EXPECT_TRUE(is_right(printed(hi.z, lo.z, format), truth.z, decimals));
      }
    }
    UncertainDigits uncertain;
    const Vec3 p = transformed(transform, light_at(triangle[0]), uncertain).value.position;
    const ReferencePoint truth = reference_of(exact, triangle[0]);
    verdict.add(p.x, truth.x, size_of(triangle[0]), R(far), uncertain.count == 0);
    verdict.add(p.y, truth.y, size_of(triangle[0]), R(far), uncertain.count == 0);
    verdict.add(p.z, truth.z, size_of(triangle[0]), R(far), uncertain.count == 0);
  }
}

/// Adds the images of random triangles under a random projection; x and z may cancel.
void add_projected(RandomNumbers& random, Verdict& verdict) {
  const double near = random_size(random, -3, 2);
  const double far = near * (1 + random_size(random, -8, 8));
  const double left = -near * random.between(0, 2);
  const double right = left + near * random.between(0.1, 3);
  const Frustum frustum = {left, right, -near, near * random.whole(1, 3), near, far};
  const ProjectionTransform projection = clip_from_view({frustum, {}});
  const auto exact = reference_projection<kBits>(frustum);
  CoordinateRounder rounder(Precision::extended, kShortest, "input");
  ProjectionStage stage(projection, ClipMode::none, CullMode::nothing, rounder);
  for (int i = 0; i < 4; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle) {
      p = random_point(random, near);
      p.z = -near * std::exp2(random.between(0, 10));
      if (random.bits() % 2 == 0) p.z = -2 * near * far / (near + far);    // 0 in NDC, but for its rounding
      if (random.bits() % 2 == 0) p.x = -p.z / near * (left + right) / 2;  // in the middle
    }
    TriangleBatch image;
    const std::uint64_t old_count = rounder.uncertain().count;
    stage.project(batch_of_one(triangle), image);
    const bool is_certain = rounder.uncertain().count == old_count;
    for (std::size_t v = 0; v < 3; ++v) {
      const ReferencePoint truth = exact.ndc(ReferencePoint(triangle[v]));
      const Vec3& p = image.triangles[0][v];
      for (const auto& [printed, true_value] : {std::pair{p.x, truth.x}, {p.y, truth.y}, {p.z, truth.z}})
        verdict.add(printed, true_value, size_of(triangle), R(1), is_certain);
    }
  }
}

void expect_no_silent_wrong_number(std::uint64_t count) {
  RandomNumbers random(1);
  Verdict verdict;
  while (verdict.numbers < count) {
    const double far = random_size(random, 24, 45);
    for (int i = 0; i < 2; ++i) {
      const TrackedModel model = random_far_model(random, far);
      add_images(random, model.computed, model.exact, far, verdict);
    }
    const Vec3 eye = {random.bits() % 2 == 0 ? far : -far, random.between(-far, far),
                      random_coordinate(random, 9)};
    const Vec3 look = random_point(random, 9);
    add_images(random, view_from_world(eye, look, {0, 0, 1}), reference_view<kBits>(eye, look, {0, 0, 1}),
               far, verdict);
    const TrackedModel ordinary = random_far_model(random, random_size(random, -1, 6));
    add_images(random, ordinary.computed, ordinary.exact, 1, verdict);
    add_projected(random, verdict);
  }
  std::printf("%llu numbers, %llu cancel by more than 20 digits (%llu of them certain), %llu noted\n",
              static_cast<unsigned long long>(verdict.numbers),
              static_cast<unsigned long long>(verdict.cancelling),
              static_cast<unsigned long long>(verdict.silent_cancelling),
              static_cast<unsigned long long>(verdict.noted));
  EXPECT_EQ(verdict.wrong, 0);
  EXPECT_GE(verdict.cancelling, verdict.numbers / 2);
  EXPECT_GT(verdict.silent_cancelling, verdict.numbers / 100);
}

TEST(Digits, OfRandomScenesAreRightOrNoted) {
  expect_no_silent_wrong_number(100'000);
}
TEST(Digits, LongOfRandomScenesAreRightOrNoted) {
  expect_no_silent_wrong_number(1'000'000);
}

/// A whole number, one with 7 decimals, or any.
Vec3 random_ordinary_point(RandomNumbers& random, double largest) {
  const auto coordinate = [&] {
    const double value = random.between(-largest, largest);
    const std::uint64_t shape = random.bits() % 4;
    return shape == 0 ? std::nearbyint(value) : shape == 1 ? value : std::nearbyint(value * 1e7) / 1e7;
  };
  return {coordinate(), coordinate(), coordinate()};
}

TrackedModel random_ordinary_model(RandomNumbers& random) {
  TrackedModel model;
  for (int i = random.whole(1, 5); i > 0; --i) {
    switch (random.bits() % 3) {
      case 0:
        model.translate(random_ordinary_point(random, 100));
        break;
      case 1:
        model.scale({random.between(0.1, 3), random.between(-3, -0.1), random.whole(1, 4) * 0.5});
        break;
      default:
        model.rotate(random.bits() % 2 == 0 ? 15.0 * random.whole(-24, 24) : random.between(-720, 720),
                     random_axis(random));
    }
  }
  return model;
}

TEST(Digits, OfOrdinaryScenesAreCertain) {
  RandomNumbers random(2);
  const ProjectionTransform projection = clip_from_view({Perspective{60, 1.25, 0.1, 100}, {}});
  for (int i = 0; i < 1'000; ++i) {
    const AffineMatrix model = random_ordinary_model(random).computed;
    Vec3 eye = random_ordinary_point(random, 10);
    eye.z += 20;
    const ViewTransform view = view_from_world(eye, random_ordinary_point(random, 5), {0, 1, 0});
    TriangleBatch p_model;
    for (std::size_t t = 0; t < 100; ++t)
      p_model.add({random_ordinary_point(random, 10), random_ordinary_point(random, 10),
                   random_ordinary_point(random, 10)},
                  t, {1, 2, 3});
    for (const NumberFormat format : {NumberFormat{7}, NumberFormat{9}, kShortest}) {
      const Images world = images_of(p_model, model, format);
      const Images seen = images_of(world.batch, view, format);
      CoordinateRounder rounder(Precision::extended, format, "input");
      TriangleBatch p_ndc;
      ProjectionStage(projection, ClipMode::frustum, CullMode::nothing, rounder).project(seen.batch, p_ndc);
      ASSERT_EQ(world.uncertain.count, 0) << i;
      ASSERT_EQ(seen.uncertain.count, 0) << i;
      ASSERT_EQ(rounder.uncertain().count, 0) << i;
    }
  }
}

// ---- cut triangles, and the projection handed on ----

TEST(Digits, OfTheWOfACutVertexAreNoted) {
  // Cut at w = 1e-20 between 1 and -1: of the 31 digits 11 are left, which is enough for -1.0000000 but not
  // for the w of a double. The cut of the other edge has no digit of its x right.
  const ProjectionTransform projection = clip_from_view({Perspective{90, 1, 1e-20, 10}, {}});
  for (const bool has_colors : {false, true}) {
    TriangleBatch p_view = batch_of_one(Triangle{Vec3{0, 0, -1}, Vec3{0, 0, 1}, Vec3{1, 0, 1}});
    if (has_colors) p_view.attributes.add(TriangleLines(), {false, true, false});
    CoordinateRounder rounder(Precision::extended, {7}, "input");
    TriangleBatch p_ndc;
    ProjectionStage(projection, ClipMode::near, CullMode::nothing, rounder).project(p_view, p_ndc);
    ASSERT_EQ(p_ndc.size(), 1);
    EXPECT_EQ(rounder.uncertain().count, has_colors ? 2 : 1);
  }
}

TEST(Digits, OfClippedTrianglesInClipSpaceAreRightOrNoted) {
  RandomNumbers random(6);
  std::uint64_t noted = 0;
  for (int i = 0; i < 1'000; ++i) {
    const double near = random.between(0.1, 1);
    const double far = near + random.between(0.1, 5);
    const Frustum frustum = {-1, 1, -1, 1, near, far};
    const ProjectionTransform projection = clip_from_view({frustum, {}});
    // z is 0 there in clip space, but for the rounding of the distance.
    const double middle = 2 * near * far / (near + far);
    const TriangleBatch p_view =
        batch_of_one(Triangle{Vec3{0, 0, -middle}, Vec3{0, 1, 2}, Vec3{0.5, 0, -middle}});
    CoordinateRounder rounder(Precision::extended, {7}, "input");
    ProjectionStage stage(projection, ClipMode::near, CullMode::nothing, rounder);
    stage.keep_unclipped_triangles();
    TriangleBatch p_ndc;
    stage.project(p_view, p_ndc);
    const R n = near;
    const R f = far;
    const R truth = ((f + n) * R(middle) - R(2) * n * f) / (f - n);
    ASSERT_NE(p_ndc.unclipped_of(0), nullptr);
    noted += rounder.uncertain().count;
    const double z = (*p_ndc.unclipped_of(0))[0].position.z;
    ASSERT_TRUE(rounder.uncertain().count > 0 || is_right(z, truth, 2)) << near << " " << far;
  }
  EXPECT_GT(noted, 10);
}

TEST(Digits, OfTheWindowOfAPerspectiveAreRight) {
  RandomNumbers random(7);
  for (int i = 0; i < 2'000; ++i) {
    double fov = random.between(0, 180);
    if (i % 3 == 1) fov = random_size(random, -250, 0);
    if (i % 3 == 2) fov = 180 - random_size(random, -13, 0);
    const Located<Projection> perspective = {Perspective{fov, 1, random_size(random, -20, 20), 1e30}, {}};
    const auto exact = reference_projection<kBits>(perspective.value);
    const auto window = std::get<Frustum>(volume_of(perspective, clip_from_view(perspective)));
    ASSERT_EQ(window.right, exact.right.nearest_double()) << fov;
    ASSERT_EQ(window.top, exact.top.nearest_double()) << fov;
  }
}

// ---- what is calculated in doubles ----

/// The exact image of a normal.
ReferencePoint reference_normal(const ReferenceMatrix<kBits>& m, const Vec3& normal) {
  const auto& [x, y, z] = m.rows;
  const ReferencePoint n = normalized(ReferencePoint(normal));
  const ReferencePoint image = {dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n)};
  return normalized(dot(x, cross(y, z)).sign() < 0 ? ReferencePoint() - image : image);
}

double largest_difference(const Vec3& a, const ReferencePoint& b) {
  return std::max({abs(R(a.x) - b.x), abs(R(a.y) - b.y), abs(R(a.z) - b.z)}).nearest_double();
}

TEST(Normals, AreWithinTheirBound) {
  RandomNumbers random(3);
  double worst = 0;
  for (int i = 0; i < 3'000; ++i) {
    const TrackedModel model = random_ordinary_model(random);
    const NormalTransform transform(model.computed);
    const Vec3 normal = random_point(random, 10);
    const double error = largest_difference(transform(normal), reference_normal(model.exact, normal));
    worst = std::max(worst, error / model.stretch);
  }
  std::printf("%g\n", worst);
  EXPECT_LE(worst, 1e-15);
}

TEST(Normals, AreZeroWhereAFlatteningScaleLeavesNone) {
  // Turned by 180 degrees about (1, 2, 3), only (3, 6, 2) is left of normals where z is flattened: nothing is
  // left of what is perpendicular to it. Rotations round, so that doubles alone leave 10^-17 of it, in some
  // direction.
  RandomNumbers random(8);
  for (int i = 0; i < 1'000; ++i) {
    TrackedModel model;
    model.rotate(random.between(-720, 720), random_axis(random));
    model.scale({1, 3, random.whole(2, 4) * 0.1});
    model.rotate(random.between(-720, 720), random_axis(random));
    const NormalTransform transform(scaled(model.computed, {1, 1, 0}) * rotation(180, {1, 2, 3}));
    const int x = random.whole(1, 9), y = random.whole(1, 9);
    const double size = std::exp2(random.whole(-300, 300));
    EXPECT_EQ(transform({2 * x * size, y * size, -3 * (x + y) * size}), Vec3{}) << i;
    EXPECT_NE(transform({3 * size, 6 * size, 2 * size}), Vec3{}) << i;
    // Flattened to a line.
    const AffineMatrix line =
        scaled(model.computed, {1, 0, 0}) * rotation(random.between(-720, 720), random_axis(random));
    EXPECT_EQ(NormalTransform(scaled(line, {0.5, 0, 1.5}))({x * size, y * size, size}), Vec3{}) << i;
  }
}

TEST(Normals, AreTheSameUnderEveryUniformScaling) {
  RandomNumbers random(10);
  for (int i = 0; i < 1'000; ++i) {
    const TrackedModel model = random_ordinary_model(random);
    const Vec3 normal = random_point(random, 10), image = NormalTransform(model.computed)(normal);
    const double factor = std::exp2(random.whole(-1'000, 1'000));
    const Vec3 factors = {factor, factor, factor};
    // Twice, since a matrix holds more than doubles do.
    EXPECT_EQ(NormalTransform(scaled(scaled(model.computed, factors), factors))(normal), image) << factor;
  }
}

TEST(Normals, KeepTheirDigitsUnderExtremeScalings) {
  RandomNumbers random(9);
  double worst = 0;
  for (int i = 0; i < 3'000; ++i) {
    TrackedModel model;
    model.rotate(random.between(-720, 720), random_axis(random));
    model.scale({1, 1, std::exp2(-random.whole(50, 70))});
    model.rotate(random.between(-720, 720), random_axis(random));
    const ReferencePoint flat = normalized(cross(model.exact.rows[0], model.exact.rows[1]));
    // Perpendicular, as far as doubles can be, to the only direction of which much is left.
    const Vec3 side = random_point(random, 10);
    const ReferencePoint tangent = cross(flat, ReferencePoint(side));
    const Vec3 normal = {tangent.x.nearest_double(), tangent.y.nearest_double(), tangent.z.nearest_double()};
    const NormalTransform transform(model.computed);
    worst = std::max(worst, largest_difference(transform(normal), reference_normal(model.exact, normal)));
  }
  std::printf("%g\n", worst);
  EXPECT_LE(worst, 1e-8);  // 2^-100 / 2^-70, and a few operations
}

TEST(Normals, AreWithinTheirBoundInViewSpace) {
  RandomNumbers random(4);
  double worst = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Vec3 eye = random_point(random, 10);
    const Vec3 look = {eye.x + 1, eye.y + random.between(-3, 3), eye.z + random.between(-9, 9)};
    const NormalTransform transform(view_from_world(eye, look, {0, 1, 0}));
    const Vec3 normal = random_point(random, 10);
    const ReferencePoint truth = reference_normal(reference_view<kBits>(eye, look, {0, 1, 0}), normal);
    worst = std::max(worst, largest_difference(transform(normal), truth));
    EXPECT_EQ(transform({}), Vec3{});
  }
  std::printf("%g\n", worst);
  EXPECT_LE(worst, 1e-15);
}

TEST(CutCorners, HaveColorsAndNormalsWithinTheirBounds) {
  // View space is NDC, but for z. Colors and normals are linear functions of the position, so a cut tells
  // its own; with few bits at the corners they are exact there.
  const Orthographic box = {-1, 1, -1, 1, -1, 1};
  const ProjectionTransform projection = clip_from_view({box, {}});
  RandomNumbers random(5);
  double worst_color = 0;
  double worst_normal = 0;
  std::size_t cuts = 0;
  for (int i = 0; i < 3'000; ++i) {
    TriangleLines lines;
    for (VertexLine& line : lines.vertices) {
      const auto coordinate = [&] { return std::nearbyint(random.between(-2048, 2048)) / 1024; };
      line.position = {coordinate(), coordinate(), coordinate()};
      line.color = {63.75 * (line.position.x + 2), 63.75 * (line.position.y + 2),
                    63.75 * (2 - line.position.z)};
      line.normal = {line.position.x / 2, line.position.y / 2, -line.position.z / 2};
    }
    const auto corner = [&](std::size_t v) { return lines.vertices[v].position; };
    TriangleBatch p_view = batch_of_one(Triangle{corner(0), corner(1), corner(2)});
    p_view.attributes.add(lines, {false, true, true});
    CoordinateRounder rounder(Precision::extended, kShortest, "input");
    ProjectionStage stage(projection, ClipMode::frustum, CullMode::nothing, rounder);
    TriangleBatch p_ndc;
    stage.project(p_view, p_ndc);
    cuts += p_ndc.size();
    for (std::size_t t = 0; t < p_ndc.size(); ++t)
      for (std::size_t v = 0; v < 3; ++v) {
        const Vec3& p = p_ndc.triangles[t][v];
        const Vec3& color = p_ndc.attributes.colors[t][v];
        const Vec3& normal = p_ndc.attributes.normals[t][v];
        const auto off = [](double a, double b) { return std::fabs(a - b); };
        worst_color = std::max({worst_color, off(color.x, 63.75 * (p.x + 2)), off(color.y, 63.75 * (p.y + 2)),
                                off(color.z, 63.75 * (p.z + 2))});
        worst_normal =
            std::max({worst_normal, off(normal.x, p.x / 2), off(normal.y, p.y / 2), off(normal.z, p.z / 2)});
      }
  }
  EXPECT_GT(cuts, 3'000);
  std::printf("%g\n", worst_color);
  EXPECT_LE(worst_color, 1e-12);
  std::printf("%g\n", worst_normal);
  EXPECT_LE(worst_normal, 1e-14);
}

}  // namespace
}  // namespace pipeline
