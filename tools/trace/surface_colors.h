#pragma once

#include <optional>
#include <vector>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"
#include "tools/trace/sample_colors.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// The colors of `zbuf`: without shadows, mirrors and glass.
class SurfaceColors : public SampleColors {
 public:
  /// Without a shader, every triangle has a color of its own.
  SurfaceColors(const TracedScene& scene, const SurfaceShader* shader);

  Color color(int row, int column, const RayCaster::Seen& seen) override;
  [[nodiscard]] const ShownColors& shown() const { return shown_; }

 private:
  using Id = TracedTriangles::Id;

  // Neighboring samples show the same few triangles; 75 KiB.
  static constexpr std::size_t kCached = 256;
  struct CachedSurface {
    std::optional<Id> id;
    Color own_color;  // of triangles without a shader
    SurfaceShader::Surface surface;
  };

  const CachedSurface& surface(Id id);

  const TracedTriangles& triangles_;
  const SurfaceShader* shader_;
  ExactProjection projection_;
  TriangleColors own_colors_;
  TriangleBatch p_view_;
  std::vector<CachedSurface> cache_;
  ShownColors shown_;
};

}  // namespace pipeline
