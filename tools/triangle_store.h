#pragma once

#include <cstddef>
#include <optional>

#include "libpipeline/coverage/span.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/fragment_report.h"

namespace pipeline {

/// Assigns every triangle of the stream, in order, the tag of its pixels: the RGB value of its color, or the
/// id under which it is kept for the surface shader. Hands each to the report, if there is one.
///
/// Of the triangles kept only those that are seen need to stay. They are found whenever twice as many are
/// kept as were seen the last time; so memory is bounded by the picture. That takes two passes over its
/// pixels, so it is done only when at least one triangle per pixel has been kept.
class TriangleStore {
 public:
  /// `pixel_count` is that of the picture, or of its samples.
  TriangleStore(std::optional<SurfaceShader>& shader, FragmentReport* report, std::size_t pixel_count);

  PixelTag add(const TriangleBatch& p_ndc, std::size_t index);

  /// True if it is time to let go of triangles.
  [[nodiscard]] bool is_full() const { return shader_ && shader_->size() >= capacity_; }
  /// Lets go of the triangles that no pixel shows. `for_each_tag(visit)` calls visit(tag), which changes it,
  /// for every pixel; all triangles so far are drawn.
  template <typename ForEachTag>
  void keep_seen(const ForEachTag& for_each_tag) {
    KeptIds kept(shader_->size());
    for_each_tag([&](PixelTag& tag) { kept.keep(tag); });
    let_go(kept);
    for_each_tag([&](PixelTag& tag) { tag = kept.new_id(tag); });
  }

 private:
  void let_go(KeptIds& kept);

  TriangleColors colors_;
  std::optional<SurfaceShader>& shader_;
  FragmentReport* report_;
  std::size_t min_capacity_;
  std::size_t capacity_;
};

}  // namespace pipeline
