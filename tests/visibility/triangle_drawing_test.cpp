#include "libpipeline/visibility/triangle_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/algorithms.h"
#include "tests/visibility/drawn_scenes.h"

namespace pipeline {
namespace {

/// `color_of(i)` is the color of triangle i.
template <typename Visible, typename ColorOf>
void draw_on_threads(Visible& visible, const std::vector<Triangle>& scene, const Viewport& screen,
                     int thread_count, std::size_t batch_size, const ColorOf& color_of) {
  ThreadPool pool(thread_count);
  TriangleDrawing drawing(visible, screen, pool);
  for (std::size_t i = 0; i < scene.size();) {
    TriangleBatch& batch = drawing.next_batch();
    batch.clear();
    for (; batch.size() < batch_size && i < scene.size(); ++i) batch.add(scene[i], i, {});
    drawing.draw_batch([&](const TriangleBatch& of, std::size_t k) { return color_of(of.numbers[k]); });
  }
  drawing.finish();
}

template <typename Visible>
Frame drawn_on_threads(const std::vector<Triangle>& scene, const Viewport& screen, int thread_count,
                       std::size_t batch_size) {
  Visible visible(screen);
  TriangleColors colors;
  draw_on_threads(visible, scene, screen, thread_count, batch_size,
                  [&](std::uint64_t number) { return colors.of(number); });
  return frame_of(visible);
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
  // On one thread some batches at once and some in bands, on several all in bands.
  constexpr Viewport kScreen = {100, 150};
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  std::vector<Triangle> scene = scene_of_small_triangles(12000);
  // Rounds of large triangles between them.
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

TEST(TriangleDrawing, MayHaveIdsForColors) {
  constexpr Viewport kScreen = {40, 30};
  const std::vector<Triangle> scene = scene_of_small_triangles(3000);
  const auto id_of = [](std::uint64_t i) {
    return Color::from_rgb(0xff123456 - static_cast<std::uint32_t>(i));
  };
  ZBufferAlgorithm<NearestCoverage, DepthF64> expected(kScreen), visible(kScreen);
  for (std::size_t i = 0; i < scene.size(); ++i) expected.draw({scene[i]}, id_of(i));
  draw_on_threads(visible, scene, kScreen, 2, 50, id_of);
  EXPECT_TRUE(frame_of(visible) == frame_of(expected));
}

TEST(TriangleDrawing, KeepsTheOrderWhereAllThatIsSeenDependsOnIt) {
  constexpr Viewport kScreen = {40, 30};
  // From the top to the bottom, so that there are pixels nobody has drawn yet whenever a thread begins.
  std::vector<Triangle> scene = scene_of_small_triangles(30000);
  std::ranges::sort(scene, std::greater(), [](const Triangle& p) { return p[0].y; });
  const auto color_of = [](std::uint64_t i) { return Color::from_rgb(static_cast<std::uint32_t>(i)); };
  ZBufferAlgorithm<NearestCoverage, DepthF64> expected(kScreen), visible(kScreen);
  expected.set_depth_epsilon(0.3);  // more than the distance of two of the scene's depths
  visible.set_depth_epsilon(0.3);
  for (std::size_t i = 0; i < scene.size(); ++i) expected.draw({scene[i]}, color_of(i));
  draw_on_threads(visible, scene, kScreen, 2, 50, color_of);
  EXPECT_TRUE(frame_of(visible) == frame_of(expected));
}

TEST(TriangleDrawing, NothingDrawnIsTheBackground) {
  constexpr Viewport kScreen = {5, 5};
  EXPECT_TRUE((drawn_on_threads<ZBufferAlgorithm<NearestCoverage, DepthF64>>({}, kScreen, 2, 1) ==
               Frame{std::vector<double>(25, 1), std::vector<std::uint32_t>(25)}));
}

TEST(TriangleDrawing, MayBeGivenUpInTheMiddle) {
  constexpr Viewport kScreen = {150, 300};
  ZBufferAlgorithm<NearestCoverage, DepthF64> visible(kScreen);
  ThreadPool pool(3);
  TriangleDrawing drawing(visible, kScreen, pool);
  for (int i = 0; i < 5; ++i) {
    drawing.next_batch().add({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}, 0, {});
    drawing.draw_batch([](const TriangleBatch&, std::size_t) { return Color(); });
  }
}

}  // namespace
}  // namespace pipeline
