#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/stream/thread_pool.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// The times of a run of `trace` by part, and the counts of rays, also of primary ones.
struct TraceWork {
  double build_seconds = 0;
  double cast_seconds = 0;
  LightTransport::RayCounts rays;
};

/// The line of `--timing`.
std::string to_text(const TraceWork& work);

/// The triangles, depths and colors of a screen, row after row.
struct TracedPicture {
  /// The picture without triangles.
  explicit TracedPicture(const TracedScene& scene);
  template <typename T>
  [[nodiscard]] std::span<const T> row_of(const std::vector<T>& entries, int row) const {
    return std::span(entries).subspan(static_cast<std::size_t>(row) * columns, columns);
  }

  std::size_t columns;
  // Each is empty if not requested; depths and triangles are those at the pixels' centers.
  std::vector<Color> colors;
  std::vector<double> depths;
  std::vector<std::int64_t> triangles;  // their numbers, -1 for none
  std::uint64_t covered_count = 0;      // of pixels whose center shows something; 0 if not requested
  TraceWork work;                       // without seconds
  ShownColors shown;
};

/// Casts the rays of a picture on threads, whose number changes nothing.
TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, ThreadPool& pool);

}  // namespace pipeline
