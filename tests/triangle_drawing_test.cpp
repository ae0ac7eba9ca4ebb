#include "libpipeline/triangle_drawing.h"

#include <gtest/gtest.h>

#include <vector>

#include "libpipeline/coverage.h"
#include "libpipeline/visibility.h"
#include "tests/random_numbers.h"

namespace pipeline {
namespace {

struct Frame {
  std::vector<double> depths;
  std::vector<Color> colors;

  friend bool operator==(const Frame&, const Frame&) = default;
};

template <typename Visible>
Frame frame_of(const Visible& visible) {
  Frame frame;
  visible.for_each_row([&](const VisibleRow& row) {
    frame.depths.insert(frame.depths.end(), row.depths.begin(), row.depths.end());
    frame.colors.insert(frame.colors.end(), row.colors.begin(), row.colors.end());
  });
  return frame;
}

/// Triangle after triangle, each as a whole.
template <typename Visible>
Frame drawn_one_by_one(const std::vector<Triangle>& scene, const ScreenConfig& screen) {
  Visible visible(screen);
  TriangleColors colors;
  for (std::size_t i = 0; i < scene.size(); ++i) visible.draw({scene[i]}, colors.of(i));
  return frame_of(visible);
}

template <typename Visible>
Frame drawn_in_bands(const std::vector<Triangle>& scene, const ScreenConfig& screen, int thread_count,
                     std::size_t batch_size) {
  Visible visible(screen);
  TriangleDrawing drawing(visible, screen, thread_count);
  TriangleColors colors;
  const auto color_of = [&](const TriangleBatch& batch, std::size_t i) {
    return colors.of(batch.numbers[i]);
  };
  for (std::size_t i = 0; i < scene.size();) {
    TriangleBatch& batch = drawing.next_batch();
    batch.clear();
    for (; batch.size() < batch_size && i < scene.size(); ++i) batch.add(scene[i], i, {});
    drawing.draw_batch(color_of);
  }
  drawing.finish();
  return frame_of(visible);
}

/// Tiny and huge triangles, on and off the screen, many at one of few depths, so that some are equal.
std::vector<Triangle> random_scene(int triangle_count, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 7 == 0 ? 3 : (i % 7 == 1 ? 1e6 : 0.05);
    const Vec3 place = {random.between(-1.2, 1.2), random.between(-1.2, 1.2), i % 3 / 4.0};
    const double depth_range = i % 2 == 0 ? 0 : 0.5;
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {place.x + random.between(-size, size), place.y + random.between(-size, size),
           place.z + random.between(-depth_range, depth_range)};
    scene.push_back(triangle);
  }
  return scene;
}

template <typename Visible>
void expect_the_same_for_all_threads() {
  constexpr ScreenConfig kScreen = {150, 300, -1, -1, -1, 0.6};
  const std::vector<Triangle> scene = random_scene(1500, 1);
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2, 3, 8})
    for (const std::size_t batch_size : {1u, 13u, 2048u})
      EXPECT_TRUE(drawn_in_bands<Visible>(scene, kScreen, thread_count, batch_size) == expected)
          << thread_count << " threads, batches of " << batch_size;
}

/// Nearly all of them small, so that whole batches are drawn at once, some from the top to the bottom.
std::vector<Triangle> scene_of_small_triangles(int triangle_count) {
  RandomNumbers random(2);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 101 == 3 ? 0.9 : 0.02;
    const Vec3 place = {random.between(-1, 1), random.between(-1, 1), i % 3 / 4.0};
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {place.x + random.between(-size, size), place.y + random.between(-size, size), place.z};
    scene.push_back(triangle);
  }
  return scene;
}

TEST(TriangleDrawing, SmallTrianglesAreDrawnInTheirOrder) {
  constexpr ScreenConfig kScreen = {150, 300};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  std::vector<Triangle> scene = scene_of_small_triangles(5000);
  // Rounds of large triangles between them.
  const std::vector<Triangle> large = random_scene(40, 3);
  scene.insert(scene.begin() + 2100, large.begin(), large.end());
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2})
    for (const std::size_t batch_size : {7u, 64u, 2048u})
      EXPECT_TRUE(drawn_in_bands<Visible>(scene, kScreen, thread_count, batch_size) == expected)
          << thread_count << " threads, batches of " << batch_size;
}

TEST(TriangleDrawing, NearestCoverageIsThatOfOneTriangleAfterTheOther) {
  expect_the_same_for_all_threads<ZBufferAlgorithm<NearestCoverage, DepthF64>>();
}

TEST(TriangleDrawing, CenterCoverageIsThatOfOneTriangleAfterTheOther) {
  expect_the_same_for_all_threads<ZBufferAlgorithm<CenterCoverage, DepthU24>>();
}

TEST(TriangleDrawing, InHighBandsATriangleStaysInItsRowsToo) {
  constexpr ScreenConfig kScreen = {2, 70000};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  // The first two are near the bottom and as deep as the third, which reaches all bands.
  const std::vector<Triangle> scene = {{{{-1, -0.9, 0}, {1, -0.9, 0}, {0, -0.8, 0}}},
                                       {{{-1, -0.99, 0}, {1, -0.99, 0}, {0, -0.9899, 0}}},
                                       {{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}}};
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2})
    EXPECT_TRUE(drawn_in_bands<Visible>(scene, kScreen, thread_count, 3) == expected);
}

TEST(TriangleDrawing, NothingDrawnIsTheBackground) {
  constexpr ScreenConfig kScreen = {5, 5};
  EXPECT_TRUE((drawn_in_bands<ZBufferAlgorithm<NearestCoverage, DepthF64>>({}, kScreen, 2, 1) ==
               Frame{std::vector<double>(25, 1), std::vector<Color>(25)}));
}

TEST(TriangleDrawing, MayBeGivenUpInTheMiddle) {
  constexpr ScreenConfig kScreen = {150, 300};
  ZBufferAlgorithm<NearestCoverage, DepthF64> visible(kScreen);
  TriangleDrawing drawing(visible, kScreen, 3);
  for (int i = 0; i < 5; ++i) {
    drawing.next_batch().add({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}, 0, {});
    drawing.draw_batch([](const TriangleBatch&, std::size_t) { return Color(); });
  }
}

}  // namespace
}  // namespace pipeline
