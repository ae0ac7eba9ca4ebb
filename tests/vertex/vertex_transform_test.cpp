// The model and view stages: printed numbers against a reference of at least 448 bits.

#include "libpipeline/vertex/vertex_transform.h"

#include <gtest/gtest.h>

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

TEST(ModelTransform, AnOverflowIsAnErrorInDoublesToo) {
  TriangleBatch batch = batch_of({Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
  CoordinateRounder rounder(Precision::in_doubles, {7}, "scene.txt");
  const VertexTransform transform(scaled(scaled(identity(), {1e300, 1, 1}), {1e300, 1, 1}));
  EXPECT_THROW(transform.apply(batch, rounder), InputError);
}

TEST(ViewTransform, PrintsTheCorrectlyRoundedNumbers) {
  for_every_format(4, 30, [](RandomNumbers& random, NumberFormat format) {
    expect_view<448>(random_camera(random), random_points(random, 30, 1e6), format, 1e10);
  });
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
