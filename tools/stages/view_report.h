#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "libpipeline/scene/camera.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/projection.h"
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
             bool counts_all);

  /// Takes a batch before the stage and after it.
  void add(const TriangleBatch& p_view, const TriangleBatch& p_ndc);

  /// The reason why nothing will be seen; none if something may be.
  [[nodiscard]] std::optional<std::string> note() const;
  void add_to(Statistics& statistics) const;

 private:
  void look_for_radians(const Triangle& p_view, bool may_be_in_view);

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
