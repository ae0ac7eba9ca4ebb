#include "libpipeline/visibility/triangle_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/algorithms.h"
#include "tests/numbers/random_numbers.h"
#include "tests/visibility/frame.h"

namespace pipeline {
namespace {

/// The tag of triangle `index`: never 0, the background's, and mostly above 2^24, so that every bit counts.
PixelTag high_tag_of(std::size_t index) {
  return 0xff123456 - static_cast<PixelTag>(index);
}

/// Draws triangle after triangle, each as a whole.
template <typename Visible>
Frame drawn_one_by_one(const std::vector<Triangle>& scene, const Viewport& screen) {
  Visible visible(screen);
  for (std::size_t i = 0; i < scene.size(); ++i) visible.draw({scene[i]}, high_tag_of(i));
  return frame_of(visible);
}

/// Tiny and huge triangles, on and off the screen, many at one of a few depths, so that some depths are
/// equal.
std::vector<Triangle> random_scene(int triangle_count, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 7 == 0 ? 3 : (i % 7 == 1 ? 1e6 : 0.05);
    const Vec3 location = {random.between(-1.2, 1.2), random.between(-1.2, 1.2), i % 3 / 4.0};
    const double depth_range = i % 2 == 0 ? 0 : 0.5;
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {location.x + random.between(-size, size), location.y + random.between(-size, size),
           location.z + random.between(-depth_range, depth_range)};
    scene.push_back(triangle);
  }
  return scene;
}

/// Triangles at three depths, nearly all of them small, some as high as the screen.
std::vector<Triangle> scene_of_small_triangles(int triangle_count) {
  RandomNumbers random(2);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 101 == 3 ? 0.9 : 0.02;
    const Vec3 location = {random.between(-1, 1), random.between(-1, 1), i % 3 / 4.0};
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {location.x + random.between(-size, size), location.y + random.between(-size, size), location.z};
    scene.push_back(triangle);
  }
  return scene;
}

template <typename Visible>
Frame drawn_on_threads(const std::vector<Triangle>& scene, const Viewport& screen, int thread_count,
                       std::size_t batch_size, double depth_epsilon = 0) {
  ThreadPool pool(thread_count);
  TriangleDrawing<Visible> drawing(screen, {}, pool);
  drawing.visible().set_depth_epsilon(depth_epsilon);
  for (std::size_t i = 0; i < scene.size();) {
    TaggedBatch& next = drawing.next();
    next.batch.clear();
    next.tags.clear();
    for (; next.tags.size() < batch_size && i < scene.size(); ++i) {
      next.batch.add(scene[i], i, {});
      next.tags.push_back(high_tag_of(i));
    }
    drawing.draw_next();
  }
  drawing.finish();
  return frame_of(drawing);
}

template <typename Visible>
void expect_the_same_for_all_threads() {
  constexpr Viewport kScreen = {150, 300, -1, -1, -1, 0.6};
  const std::vector<Triangle> scene = random_scene(1500, 1);
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2, 3, 8})
    for (const std::size_t batch_size : {1u, 13u, 2048u})
      EXPECT_TRUE(drawn_on_threads<Visible>(scene, kScreen, thread_count, batch_size) == expected)
          << thread_count << " threads, batches of " << batch_size;
}

TEST(TriangleDrawing, SmallTrianglesAreDrawnInTheirOrder) {
  // One thread draws some batches directly and some in bands; several threads draw all in bands.
  constexpr Viewport kScreen = {100, 150};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  std::vector<Triangle> scene = scene_of_small_triangles(12000);
  // Groups of large triangles among them.
  const std::vector<Triangle> large = random_scene(40, 3);
  for (const int location : {2100, 7000}) scene.insert(scene.begin() + location, large.begin(), large.end());
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2, 3})
    for (const std::size_t batch_size : {7u, 64u, 2048u})
      EXPECT_TRUE(drawn_on_threads<Visible>(scene, kScreen, thread_count, batch_size) == expected)
          << thread_count << " threads, batches of " << batch_size;
}

TEST(TriangleDrawing, NearestCoverageIsThatOfOneTriangleAfterTheOther) {
  expect_the_same_for_all_threads<ZBufferAlgorithm<NearestCoverage, DepthF64>>();
}

TEST(TriangleDrawing, CenterCoverageIsThatOfOneTriangleAfterTheOther) {
  expect_the_same_for_all_threads<ZBufferAlgorithm<CenterCoverage, DepthU24>>();
}

TEST(TriangleDrawing, InHighBandsATriangleStaysInItsRowsToo) {
  constexpr Viewport kScreen = {2, 70000};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  // The first two are near the bottom and as deep as the third, which reaches all bands.
  const std::vector<Triangle> scene = {{{{-1, -0.9, 0}, {1, -0.9, 0}, {0, -0.8, 0}}},
                                       {{{-1, -0.99, 0}, {1, -0.99, 0}, {0, -0.9899, 0}}},
                                       {{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}}};
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2})
    EXPECT_TRUE(drawn_on_threads<Visible>(scene, kScreen, thread_count, 3) == expected);
}

TEST(TriangleDrawing, AmongSmallTrianglesOneMayBeHighByAnyOfItsCorners) {
  constexpr Viewport kScreen = {2, 60000};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  const Triangle small = {{{0, 0, 0}, {0.1, 0, 0}, {0, 0.0001, 0}}};
  Triangle high = {{{-1, -0.9, 0.5}, {1, -0.9, 0.25}, {0, 0.9, 0}}};
  for (int i = 0; i < 3; ++i) {
    const std::vector<Triangle> scene = {small, high, small, small};
    EXPECT_TRUE(drawn_on_threads<Visible>(scene, kScreen, 1, 4) == drawn_one_by_one<Visible>(scene, kScreen));
    std::rotate(high.begin(), high.begin() + 1, high.end());
  }
}

TEST(TriangleDrawing, KeepsTheOrderWhereAllThatIsSeenDependsOnIt) {
  constexpr Viewport kScreen = {40, 30};
  // From top to bottom, so that each thread starts on pixels that are still undrawn.
  std::vector<Triangle> scene = scene_of_small_triangles(30000);
  std::ranges::sort(scene, std::greater(), [](const Triangle& p) { return p[0].y; });
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  constexpr double kEpsilon = 0.3;  // larger than the difference between two of the scene's depths
  Visible expected(kScreen);
  expected.set_depth_epsilon(kEpsilon);
  for (std::size_t i = 0; i < scene.size(); ++i) expected.draw({scene[i]}, high_tag_of(i));
  EXPECT_TRUE(drawn_on_threads<Visible>(scene, kScreen, 2, 50, kEpsilon) == frame_of(expected));
}

TEST(TriangleDrawing, NothingDrawnIsTheBackground) {
  constexpr Viewport kScreen = {5, 5};
  EXPECT_TRUE((drawn_on_threads<ZBufferAlgorithm<NearestCoverage, DepthF64>>({}, kScreen, 2, 1) ==
               Frame{std::vector<double>(25, 1), std::vector<PixelTag>(25)}));
}

TEST(TriangleDrawing, MayBeGivenUpInTheMiddle) {
  constexpr Viewport kScreen = {150, 300};
  ThreadPool pool(3);
  TriangleDrawing<ZBufferAlgorithm<NearestCoverage, DepthF64>> drawing(kScreen, {}, pool);
  for (int i = 0; i < 5; ++i) {
    drawing.next().batch.add({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}, 0, {});
    drawing.next().tags.resize(drawing.next().batch.size());
    drawing.draw_next();
  }
}

}  // namespace
}  // namespace pipeline
