#pragma once

#include <string>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/projection.h"

namespace pipeline {

/// Rounds calculated triangles as if they had been written in the shortest form (--digits exact) and read
/// back: zeros lose their sign, and x and y whose text is a decimal in exact arithmetic are marked.
void pass_through_text(TriangleBatch& batch);

/// Projects triangles of a text as `project --digits exact` does, and rounds them as `zbuf` reads them.
class ExactProjection {
 public:
  /// `file` names the text in messages. With `is_lit`, pieces keep the triangle they were cut from.
  ExactProjection(const ProjectionTransform& projection, const std::string& file, bool is_lit)
      : rounder_(Precision::extended, kShortest, file),
        stage_(projection, ClipMode::automatic, CullMode::nothing, rounder_) {
    if (is_lit) stage_.keep_unclipped_triangles();
  }
  ExactProjection(const ExactProjection&) = delete;
  ExactProjection& operator=(const ExactProjection&) = delete;

  /// Fills `p_ndc` as ProjectionStage::project does; valid until the next call.
  const TriangleBatch& project(const TriangleBatch& p_view) {
    stage_.project(p_view, p_ndc_);
    pass_through_text(p_ndc_);
    return p_ndc_;
  }
  [[nodiscard]] const ProjectionStage& stage() const { return stage_; }

 private:
  CoordinateRounder rounder_;
  ProjectionStage stage_;
  TriangleBatch p_ndc_;
};

}  // namespace pipeline
