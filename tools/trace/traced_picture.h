#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/sampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/trace/sample_colors.h"
#include "tools/trace/trace_work.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// Which rays are cast for a picture.
struct PictureRays {
  Sampling sampling = Sampling::basic;
  int sample_count = 1;  // along each side of a pixel
  int threshold = 0;     // of adaptive sampling: all samples where the first ones differ by so many levels
  bool has_colors = true;
  bool has_depths = true;
  bool has_triangles = false;
  bool counts_covered = false;
};

/// What the pixels of a screen show, row after row.
struct TracedPicture {
  /// The picture of nothing.
  TracedPicture(const Viewport& of_pixels, const PictureRays& rays, Color background);
  template <typename T>
  [[nodiscard]] std::span<const T> row_of(const std::vector<T>& entries, int row) const {
    const auto columns = static_cast<std::size_t>(screen.columns);
    return std::span(entries).subspan(static_cast<std::size_t>(row) * columns, columns);
  }

  Viewport screen;
  // Empty if they are not requested; depths and triangles are those of the pixels' centers.
  std::vector<Color> colors;
  std::vector<double> depths;
  std::vector<std::int64_t> triangles;  // their numbers, -1 for none
  std::uint64_t covered_count = 0;      // of pixels whose center shows something; 0 if that is not requested
};

/// Makes the colors of a thread, in that thread.
using ColorsMaker = std::function<std::unique_ptr<SampleColors>()>;

/// Casts the rays of a picture. The places of its samples are those of `places`, on whose screen the colors
/// are calculated. Neither picture nor work depends on the number of threads.
TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, const Viewport& screen,
                             const SamplePlaces& places, const PictureRays& rays, Color background,
                             const ColorsMaker& make_colors, ThreadPool& pool, TraceWork& work);

}  // namespace pipeline
