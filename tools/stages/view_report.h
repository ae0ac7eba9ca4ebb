#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "libpipeline/scene/camera.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/vertex/projection.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/statistics.h"

namespace pipeline {

/// Watches where the triangles of `project` lie: for a note if none is passed on, and for --stats. Without
/// --stats, it watches only until a triangle is passed on (and, if fovY is below pi, until a vertex is in
/// view).
class ViewReport {
 public:
  /// `volume` is the view volume of the stage and its projection, whose fovY below pi may be meant in
  /// radians.
  ViewReport(const ProjectionStage& stage, const Located<Projection>& projection, const ViewVolume& volume,
             bool counts_all)
      : stage_(stage), volume_(volume), counts_all_(counts_all) {
    const auto* perspective = std::get_if<Perspective>(&projection.value);
    if (perspective == nullptr || perspective->fov_y_degrees >= std::numbers::pi) return;
    Perspective in_degrees = *perspective;
    in_degrees.fov_y_degrees *= 180 / std::numbers::pi;
    try {
      volume_if_radians_.emplace(clip_from_view({in_degrees, projection.location}));
      fov_y_degrees_ = perspective->fov_y_degrees;
    } catch (const InputError&) {
      // With a wider angle, it would not be a perspective.
    }
  }

  /// Takes a batch before the stage and after it.
  void add(const TriangleBatch& p_view, const TriangleBatch& p_ndc) {
    triangle_count_ += p_view.size();
    is_all_dropped_ &= p_ndc.empty();
    for (const Triangle& triangle : p_view.triangles) {
      if (!is_all_dropped_ && !counts_all_ && !volume_if_radians_) return;
      if (stage_.culls(triangle)) {
        ++culled_count_;
        continue;
      }
      const auto part = volume_.outside(triangle);
      if (part) outside_.add(*part, BoundingBox(triangle));
      if (volume_if_radians_) look_for_radians(triangle, !part);
    }
  }
  /// The reason why nothing will be seen; none if something may be.
  [[nodiscard]] std::optional<std::string> note() const {
    if (triangle_count_ == 0) return std::nullopt;
    if (volume_if_radians_ && in_view_if_radians_count_ > 0)
      return radians_note(fov_y_degrees_, in_view_if_radians_count_, is_filled_);
    if (is_all_dropped_) return dropped_note(outside_, culled_count_);
    return std::nullopt;
  }
  void add_to(Statistics& statistics) const {
    statistics.add(outside_, false);
    statistics.add("cut", stage_.counts().clipped);
    statistics.add("culled", stage_.counts().culled);
  }

 private:
  static bool has_vertex_in(const ViewVolume& volume, const Triangle& p_view) {
    return std::ranges::any_of(p_view, [&](const Vec3& p) { return !volume.outside({p, p, p}); });
  }
  void look_for_radians(const Triangle& p_view, bool may_be_in_view) {
    if (may_be_in_view && has_vertex_in(volume_, p_view)) return volume_if_radians_.reset();
    is_filled_ |= may_be_in_view;
    if (may_be_in_view ? has_vertex_in(*volume_if_radians_, p_view) : !volume_if_radians_->outside(p_view))
      ++in_view_if_radians_count_;
  }

  const ProjectionStage& stage_;
  ViewVolume volume_;
  bool counts_all_;
  bool is_all_dropped_ = true;
  std::uint64_t triangle_count_ = 0;
  std::uint64_t culled_count_ = 0;
  UnseenPlaces outside_;

  double fov_y_degrees_ = 0;
  std::optional<ViewVolume> volume_if_radians_;  // none if that is not, or no longer, suspected
  std::uint64_t in_view_if_radians_count_ = 0;
  bool is_filled_ = false;  // by triangles without a vertex in view
};

}  // namespace pipeline
