// The model and view stages: printed numbers against a reference of at least 448 bits.

#include "libpipeline/vertex/vertex_transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "libpipeline/text/error.h"
#include "tests/vertex/printed_vertices.h"

namespace pipeline {
namespace {

/// The images of vertices; all printed digits must be certain.
template <typename Transform>
TriangleBatch images_of(const std::vector<Vec3>& vertices, const Transform& transform, NumberFormat format,
                        Precision precision = Precision::extended) {
  TriangleBatch batch = batch_of(vertices);
  CoordinateRounder rounder(precision, format, "input");
  VertexTransform(transform).apply(batch, rounder);
  EXPECT_FALSE(rounder.uncertain().first.is_known());
  return batch;
}

template <int bits>
Model<bits> random_model(RandomNumbers& random) {
  Model<bits> model;
  for (int i = random.whole(1, 5); i > 0; --i) {
    switch (random.bits() % 3) {
      case 0:
        model.translate(random_point(random, 1e6));
        break;
      case 1:
        model.scale({random.between(0.1, 3), random.between(-3, 3), random.whole(1, 4) * 0.5});
        break;
      default:
        model.rotate(random.bits() % 2 == 0 ? 15.0 * random.whole(-24, 24) : random.between(-720, 720),
                     {random_coordinate(random, 2), random_coordinate(random, 2), random.between(0.1, 2)});
    }
  }
  return model;
}

struct RandomCamera {
  Vec3 eye, look, up;
};

RandomCamera random_camera(RandomNumbers& random) {
  RandomCamera camera = {random_point(random, 1e6), random_point(random, 1e6), random_point(random, 10)};
  camera.eye.x += 0.25;  // eye and look differ
  camera.up.z += 0.125;
  return camera;
}

std::vector<Vec3> random_points(RandomNumbers& random, std::size_t count, double largest) {
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = random_point(random, largest);
  return points;
}

template <int bits>
void expect_model(const Model<bits>& model, const std::vector<Vec3>& vertices, NumberFormat format,
                  const Real<bits>& size) {
  const TriangleBatch images = images_of(vertices, model.computed, format);
  expect_printed<bits>(images, vertices, format, size, [&](const auto& p) { return model.exact * p; });
}

template <int bits>
void expect_view(const RandomCamera& c, const std::vector<Vec3>& vertices, NumberFormat format,
                 const Real<bits>& size) {
  const ReferenceMatrix<bits> exact = reference_view<bits>(c.eye, c.look, c.up);
  const TriangleBatch images = images_of(vertices, view_from_world(c.eye, c.look, c.up), format);
  expect_printed<bits>(images, vertices, format, size, [&](const auto& p) { return exact * p; });
}

/// Runs `check(random, format)` for every number format.
template <typename Check>
void for_every_format(std::uint64_t seed, int count, Check check) {
  for (const NumberFormat format : kFormats) {
    RandomNumbers random(seed);
    for (int i = 0; i < count; ++i) {
      check(random, format);
      ASSERT_FALSE(testing::Test::HasFailure())
          << "case " << i << ", "
          << (format.shortest ? "shortest" : std::to_string(format.decimals) + " decimals");
    }
  }
}

TEST(ModelTransform, PrintsTheCorrectlyRoundedNumbers) {
  for_every_format(1, 30, [](RandomNumbers& random, NumberFormat format) {
    expect_model<448>(random_model<448>(random), random_points(random, 30, 1e6), format, 1e10);
  });
}

// The nearest doubles to ties, too: 5 at the seventh decimal.
TEST(ModelTransform, PrintsTheCorrectlyRoundedNumbersOfUntransformedVertices) {
  for_every_format(4, 30, [](RandomNumbers& random, NumberFormat format) {
    std::vector<Vec3> points = random_points(random, 30, 1e6);
    for (Vec3& p : points) p.x = std::floor(p.x) + random.whole(0, 999'999) / 1e6 + 5e-7;
    expect_model<448>(Model<448>(), points, format, 1e6);
  });
}

// 3 times the double 1/3 is 1 - 2^-54, of which 1 is the nearest double.
TEST(ModelTransform, DoesNotTakeForTheIdentityWhatIsNearIt) {
  Model<448> model;
  model.scale({3, 3, 3}).scale({1 / 3.0, 1 / 3.0, 1 / 3.0});
  expect_model<448>(model, {{3.5, 0.25, 1.75}}, {17}, 1e6);
}

TEST(ModelTransform, PrintsTheCorrectlyRoundedNumbersOfExtremeScales) {
  for_every_format(2, 20, [](RandomNumbers& random, NumberFormat format) {
    const double scale = random.with_exponent(-990, 990);
    Model<4096> model;
    model.scale({scale, scale, scale})
        .rotate(random.between(0, 360), {1, 2, 3})
        .scale({1 / scale, 1 / scale, 1 / scale});
    model.rotate(15.0 * random.whole(0, 24), {0, 0, 1}).scale({0x1p-1000, 0x1p-1000, 0x1p-1000});
    model.scale({0x1p1000, 0x1p1000, 0x1p1000});
    expect_model<4096>(model, random_points(random, 3, 1e3), format, 1e6);
  });
}

TEST(ModelTransform, PrintsTheCorrectlyRoundedNumbersAroundAFarPivot) {
  for_every_format(3, 30, [](RandomNumbers& random, NumberFormat format) {
    const double pivot = random.between(0.9e9, 1.1e9);
    Model<448> model;
    model.translate({pivot, -pivot, pivot})
        .rotate(random.between(-360, 360), {1, 2, 3})
        .translate({-pivot, pivot, -pivot});
    // At a tie, 17 decimals next to 1e9 need more than the 31 digits of a ball.
    if (format.decimals < 17) expect_model<448>(model, random_points(random, 9, 100), format, 1e10);
  });
}

TEST(ModelTransform, ReportsUncertainDigitsAroundAPivotAtOneE30) {
  Model<448> model;
  model.translate({1e30, 0, 0}).rotate(33, {1, 2, 3}).translate({-1e30, 0, 0});
  TriangleBatch batch = batch_of({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
  CoordinateRounder rounder(Precision::extended, {7}, "input");
  VertexTransform(model.computed).apply(batch, rounder);
  EXPECT_EQ(rounder.uncertain().first, LineAndColumn(1));
}

TEST(ModelTransform, AddsTheLastDigitBesideOneE16) {
  const Model<448> model =
      Model<448>().translate({1e16, 0, 0}).translate({0.1, 0, 0}).translate({-1e16, 0, 0});
  expect_model<448>(model, {{0.3, 0, 0}, {1.3, 0, 0}, {0, 1, 0}}, {7}, 1e16);
}

TEST(ModelTransform, PrintsADigitTheDoubleHasNoRoomFor) {
  const TriangleBatch images =
      images_of({{0.1, 0, 0}, {0, 0, 0}, {0, 0, 1}}, Model<448>().translate({1e16, 0, 0}).computed, {7});
  EXPECT_EQ(printed_vertex(images, 0, {7}), "10000000000000000.1000000 0.0000000 0.0000000");
}

TEST(ModelTransform, PrintsNoSignOfZero) {
  const TriangleBatch images = images_of({{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, rotation(90, {0, 0, 1}), {7});
  EXPECT_EQ(printed_vertex(images, 0, {7}), "0.0000000 1.0000000 0.0000000");
  EXPECT_EQ(printed_vertex(images, 1, {7}), "1.0000000 0.0000000 0.0000000");
  EXPECT_EQ(printed_vertex(images, 2, {7}), "0.0000000 0.0000000 -1.0000000");
}

TEST(ModelTransform, AnOverflowNamesTheVertexsLocation) {
  TriangleBatch batch;
  batch.add({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, 0, {11, {12, 5}, 13});
  CoordinateRounder rounder(Precision::extended, {7}, "scene.txt");
  const VertexTransform transform(scaling({1e300, 1, 1}) * scaling({1e300, 1, 1}));
  try {
    transform.apply(batch, rounder);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.txt:12:5: expected a vertex whose image is within a double's range, found an "
                 "overflow of its x");
  }
}

TEST(ModelTransform, AnOverflowIsAnErrorInDoublesToo) {
  TriangleBatch batch = batch_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  CoordinateRounder rounder(Precision::in_doubles, {7}, "scene.txt");
  const VertexTransform transform(scaling({1e300, 1, 1}) * scaling({1e300, 1, 1}));
  EXPECT_THROW(transform.apply(batch, rounder), InputError);
}

TEST(ModelTransform, ZeroTimesAnOverflowingScaleIsZero) {
  const AffineMatrix m = scaling({1e300, 1, 1}) * scaling({1e300, 1, 1});
  const TriangleBatch images = images_of({{0, 1, 2}, {0, 3, 4}, {0, 5, 6}}, m, {7});
  EXPECT_EQ(printed_vertex(images, 0, {7}), "0.0000000 1.0000000 2.0000000");
}

TEST(ViewTransform, PrintsTheCorrectlyRoundedNumbers) {
  for_every_format(4, 30, [](RandomNumbers& random, NumberFormat format) {
    expect_view<448>(random_camera(random), random_points(random, 30, 1e6), format, 1e10);
  });
}

TEST(ViewTransform, PrintsTheCorrectlyRoundedNumbersOfFarEyes) {
  for (const double distance : {1e6, 1e8, 1e10, 1e12, 1e15}) {
    for_every_format(5, 10, [&](RandomNumbers& random, NumberFormat format) {
      const Vec3 eye = {distance + random.whole(0, 9), -distance * random.between(0, 1),
                        distance * random.between(0, 1)};
      const Vec3 look = {eye.x + random.whole(1, 9), eye.y + random.whole(1, 9), eye.z + random.whole(1, 9)};
      std::vector<Vec3> vertices = random_points(random, 9, 10);
      for (Vec3& p : vertices) p = {eye.x + p.x, eye.y + p.y, eye.z + p.z};
      expect_view<448>({eye, look, random_point(random, 1)}, vertices, format, 1e20);
    });
  }
}

TEST(ViewTransform, PrintsTheCorrectlyRoundedNumbersWithUpCloseToTheViewDirection) {
  for_every_format(6, 30, [](RandomNumbers& random, NumberFormat format) {
    const Vec3 look = {random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1)};
    const Vec3 up = {look.x + 1e-12, look.y, look.z};
    if (format.decimals < 17) expect_view<448>({{}, look, up}, random_points(random, 9, 1000), format, 1e20);
  });
}

TEST(ViewTransform, PrintsTheCorrectlyRoundedNumbersOfTinyAndHugeDirections) {
  for_every_format(7, 20, [](RandomNumbers& random, NumberFormat format) {
    const double length = random.with_exponent(-1000, 1000);
    const Vec3 look = {length * random.between(0.1, 1), length * random.between(-1, 1), -length};
    const double up = random.with_exponent(-1000, 1000);
    expect_view<4096>({{}, look, {0, up, up * random.between(0, 1)}}, random_points(random, 3, 1000), format,
                      1e6);
  });
}

TEST(ViewTransform, AnExactTieIsRoundedToEven) {
  const ViewTransform view = view_from_world({0, 0, 0}, {3, 0, -4}, {0, 1, 0});
  const TriangleBatch images = images_of({{0, 0, 0.01171875}, {0, 0, 1}, {0, 0, 2}}, view, {7});
  EXPECT_EQ(printed_vertex(images, 0, {7}), "0.0070312 0.0000000 0.0093750");
}

TEST(ViewTransform, OfTheEyeIsTheOrigin) {
  const Vec3 eye = {1e15 + 0.125, -3.1, 1e-300};
  const ViewTransform view = view_from_world(eye, {1, 2, 3}, {0, 1, 0.1});
  const TriangleBatch images = images_of({eye, eye, eye}, view, {.shortest = true});
  EXPECT_EQ(printed_vertex(images, 0, {.shortest = true}), "0 0 0");
}

constexpr int kTransforms = 1'000;
constexpr std::size_t kVerticesOfEach = 10'000;

TEST(ModelTransform, LongPrintsNoNumberThatDiffersFromTheReference) {
  RandomNumbers random(101);
  DifferenceCount extended;
  DifferenceCount in_doubles;
  for (int i = 0; i < kTransforms; ++i) {
    const Model<448> model = random_model<448>(random);
    const std::vector<Vec3> vertices = random_points(random, kVerticesOfEach, 1e6);
    const auto reference = [&](const auto& p) { return model.exact * p; };
    extended.add(images_of(vertices, model.computed, {7}), vertices, reference);
    if (i % 10 == 0)
      in_doubles.add(images_of(vertices, model.computed, {7}, Precision::in_doubles), vertices, reference);
  }
  extended.report("model, extended");
  in_doubles.report("model, double");
  EXPECT_EQ(extended.different, 0u) << extended.first;
}

TEST(ViewTransform, LongPrintsNoNumberThatDiffersFromTheReference) {
  RandomNumbers random(102);
  DifferenceCount extended;
  DifferenceCount in_doubles;
  for (int i = 0; i < kTransforms; ++i) {
    const RandomCamera c = random_camera(random);
    const ViewTransform view = view_from_world(c.eye, c.look, c.up);
    const ReferenceMatrix<448> exact = reference_view<448>(c.eye, c.look, c.up);
    const std::vector<Vec3> vertices = random_points(random, kVerticesOfEach, 1e6);
    const auto reference = [&](const auto& p) { return exact * p; };
    extended.add(images_of(vertices, view, {7}), vertices, reference);
    if (i % 10 == 0)
      in_doubles.add(images_of(vertices, view, {7}, Precision::in_doubles), vertices, reference);
  }
  extended.report("view, extended");
  in_doubles.report("view, double");
  EXPECT_EQ(extended.different, 0u) << extended.first;
}

}  // namespace
}  // namespace pipeline
