#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/sampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/trace/trace_options.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// A picture, and the source of its samples' colors.
struct PictureSetup {
  /// The places of the samples.
  [[nodiscard]] SamplePlaces places() const {
    return {screen, chosen.sample_count, is_random(*chosen.sampling)};
  }

  const TraceOptions& chosen;
  const Viewport& screen;
  Color background;
  const SurfaceShader* shader = nullptr;       // zbuf's; if null, every triangle has its own color
  const LightTransportSetup* light = nullptr;  // if set, rays bring the colors, not the shader
};

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
  explicit TracedPicture(const PictureSetup& setup);
  template <typename T>
  [[nodiscard]] std::span<const T> row_of(const std::vector<T>& entries, int row) const {
    const auto columns = static_cast<std::size_t>(screen.columns);
    return std::span(entries).subspan(static_cast<std::size_t>(row) * columns, columns);
  }

  Viewport screen;
  // Each is empty if not requested; depths and triangles are those at the pixels' centers.
  std::vector<Color> colors;
  std::vector<double> depths;
  std::vector<std::int64_t> triangles;  // their numbers, -1 for none
  std::uint64_t covered_count = 0;      // of pixels whose center shows something; 0 if not requested
  TraceWork work;                       // without seconds
  ShownColors shown;
};

/// Casts the rays of a picture on threads, whose number changes nothing. A shader's screen must be the one of
/// the samples' places.
TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, const PictureSetup& setup,
                             ThreadPool& pool);

}  // namespace pipeline
