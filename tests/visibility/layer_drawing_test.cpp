#include "libpipeline/visibility/layer_drawing.h"

#include <gtest/gtest.h>

#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/algorithms.h"
#include "tests/visibility/drawn_scenes.h"

namespace pipeline {
namespace {

constexpr Viewport kScreen = {60, 70};

/// Gives batches of a scene, one after the other, to a drawing.
class Stream {
 public:
  explicit Stream(const std::vector<Triangle>& scene) : scene_(scene) {}

  template <typename Drawing>
  void draw(Drawing& drawing, std::size_t batch_size, std::size_t end) {
    while (next_ < end) {
      ColoredBatch batch;
      for (; batch.colors.size() < batch_size && next_ < end; ++next_) {
        batch.batch.add(scene_[next_], next_, {});
        batch.colors.push_back(colors_.of(next_));
      }
      drawing.draw(batch);
    }
  }

 private:
  const std::vector<Triangle>& scene_;
  std::size_t next_ = 0;
  TriangleColors colors_;
};

template <typename Visible>
void expect_what_is_drawn_one_by_one(const std::vector<Triangle>& scene,
                                     const std::vector<std::size_t>& batch_sizes) {
  const Frame expected = drawn_one_by_one<Visible>(scene, kScreen);
  for (const int thread_count : {1, 2, 3, 8})
    for (const std::size_t batch_size : batch_sizes) {
      Visible visible(kScreen);
      ThreadPool pool(thread_count);
      LayerDrawing drawing(visible, kScreen, pool);
      Stream(scene).draw(drawing, batch_size, scene.size());
      drawing.finish();
      EXPECT_TRUE(frame_of(visible) == expected) << thread_count << " threads, batches of " << batch_size;
    }
}

TEST(LayerDrawing, OfEqualDepthsTheFirstStaysWhateverLayerItIsIn) {
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  expect_what_is_drawn_one_by_one<Visible>(scene_of_small_triangles(20000), {50, 300, 2048});
}

TEST(LayerDrawing, SoItIsWhenTheNumbersOfBatchesBeginAnew) {
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF32>;
  constexpr int kTriangles = 5 * static_cast<int>(kMaxOrders) + 17;
  expect_what_is_drawn_one_by_one<Visible>(scene_of_small_triangles(kTriangles), {1, 2, 3});
}

TEST(LayerDrawing, DrawsLargeTrianglesToo) {
  using Visible = ZBufferAlgorithm<CenterCoverage, DepthU24>;
  expect_what_is_drawn_one_by_one<Visible>(random_scene(2000, 4), {13, 100});
}

TEST(LayerDrawing, MayBeFinishedManyTimes) {
  using Visible = ZBufferAlgorithm<NearestCoverage, DepthF64>;
  const std::vector<Triangle> scene = scene_of_small_triangles(3000);
  Visible visible(kScreen);
  ThreadPool pool(3);
  LayerDrawing drawing(visible, kScreen, pool);
  Stream stream(scene);
  for (const std::size_t end : {0u, 1u, 700u, 705u, 3000u}) {
    stream.draw(drawing, 10, end);
    drawing.finish();
    EXPECT_TRUE(
        frame_of(visible) ==
        drawn_one_by_one<Visible>({scene.begin(), scene.begin() + static_cast<std::ptrdiff_t>(end)}, kScreen))
        << end;
  }
}

TEST(LayerDrawing, LeavesTheBackgroundWhereNothingIsDrawn) {
  ZBufferAlgorithm<NearestCoverage, DepthF64> visible(kScreen, Color(1, 2, 3));
  ThreadPool pool(2);
  LayerDrawing drawing(visible, kScreen, pool);
  for (int i = 0; i < 20; ++i) {
    ColoredBatch behind_the_rear_limit = {{}, {Color(9, 9, 9)}};
    behind_the_rear_limit.batch.add({{{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}}}, 0, {});
    drawing.draw(behind_the_rear_limit);
  }
  drawing.finish();
  const Frame frame = frame_of(visible);
  EXPECT_EQ(frame.colors, std::vector<std::uint32_t>(60 * 70, 0x010203));
  EXPECT_EQ(frame.depths, std::vector<double>(60 * 70, 1));
}

}  // namespace
}  // namespace pipeline
