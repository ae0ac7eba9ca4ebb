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
struct TracedScene {
  /// Reads the header. With `counts`, the reports count for --stats.
  TracedScene(Tool& tool, const TraceOptions& chosen, const Viewport& screen, bool counts);
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// Reads the body to its end. With `keeps_dropped`, keeps the triangles that `project` drops, too.
  void read(Tool& tool, const Viewport& screen, bool keeps_dropped);

  StageReader reader;
  Located<Projection> given;  // by the header or the options
  ProjectionTransform projection;
  StageHeader header;  // as `project` writes it
  TracedTriangles triangles;
  ViewReport view;
  DrawingReport drawing;
  UnseenSpheres spheres;
};

}  // namespace pipeline
