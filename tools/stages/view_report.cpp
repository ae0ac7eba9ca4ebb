#include "tools/stages/view_report.h"

#include <algorithm>
#include <numbers>
#include <variant>

#include "libpipeline/text/error.h"
#include "tools/rim/empty_picture_note.h"

namespace pipeline {
namespace {

bool has_vertex_in(const ViewVolume& volume, const Triangle& p_view) {
  return std::ranges::any_of(p_view, [&](const Vec3& vertex) {
    return !volume.outside({vertex, vertex, vertex});
  });
}

}  // namespace

ViewReport::ViewReport(const ProjectionStage& stage, const Located<Projection>& projection,
                       const ViewVolume& volume, bool counts_all)
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

void ViewReport::add(const TriangleBatch& p_view, const TriangleBatch& p_ndc) {
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

void ViewReport::look_for_radians(const Triangle& p_view, bool may_be_in_view) {
  if (may_be_in_view && has_vertex_in(volume_, p_view)) return volume_if_radians_.reset();
  is_filled_ |= may_be_in_view;
  if (may_be_in_view ? has_vertex_in(*volume_if_radians_, p_view) : !volume_if_radians_->outside(p_view))
    ++in_view_if_radians_count_;
}

std::optional<std::string> ViewReport::note() const {
  if (triangle_count_ == 0) return std::nullopt;
  if (volume_if_radians_ && in_view_if_radians_count_ > 0)
    return radians_note(fov_y_degrees_, in_view_if_radians_count_, is_filled_);
  if (is_all_dropped_) return dropped_note(outside_, culled_count_);
  return std::nullopt;
}

void ViewReport::add_to(Statistics& statistics) const {
  statistics.add(outside_, false);
  statistics.add("cut", stage_.counts().clipped);
  statistics.add("culled", stage_.counts().culled);
}

}  // namespace pipeline
