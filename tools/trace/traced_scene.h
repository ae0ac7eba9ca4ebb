#pragma once

#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/stage_text.h"
#include "libpipeline/vertex/transform.h"
#include "tools/rim/tool.h"
#include "tools/stages/view_report.h"
#include "tools/trace/sphere_report.h"
#include "tools/trace/trace_options.h"
#include "tools/zbuf/drawing_report.h"

namespace pipeline {

/// The tool's input in memory: all that rays may meet, and its projection.
class TracedScene {
 public:
  /// Reads the header. With `counts`, the reports count for --stats.
  TracedScene(Tool& tool, const TraceOptions& chosen, const Viewport& screen, bool counts);
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// Reads the body to its end. With `keeps_dropped`, keeps the triangles that `project` drops, too.
  void read(bool keeps_dropped);
  /// See TracedTriangles.
  void keep_images_alone() { triangles_.keep_images_alone(); }

  /// The header as `project` writes it.
  [[nodiscard]] const StageHeader& header() const { return header_; }
  [[nodiscard]] const SourceLocation& header_end() const { return reader_.header_end(); }
  [[nodiscard]] const ProjectionTransform& projection() const { return projection_; }
  /// The projection as the header or the options give it.
  [[nodiscard]] const Projection& given_projection() const { return given_.value; }
  [[nodiscard]] const TracedTriangles& triangles() const { return triangles_; }
  [[nodiscard]] const ViewReport& view() const { return view_; }
  [[nodiscard]] const DrawingReport& drawing() const { return drawing_; }
  [[nodiscard]] const UnseenSpheres& spheres() const { return spheres_.spheres(); }

 private:
  Tool& tool_;
  StageReader reader_;
  Located<Projection> given_;
  ProjectionTransform projection_;
  StageHeader header_;
  ExactProjection exact_;
  TracedTriangles triangles_;
  ViewReport view_;
  DrawingReport drawing_;
  SphereReport spheres_;
};

}  // namespace pipeline
