#pragma once

#include <optional>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/stream/stage_reader.h"
#include "tools/rim/tool.h"
#include "tools/stages/view_report.h"
#include "tools/trace/sphere_report.h"
#include "tools/trace/trace_options.h"
#include "tools/zbuf/drawing_report.h"

namespace pipeline {

/// The tool's input in memory: all that rays may meet, its projection, and the source of its colors.
struct TracedScene {
  /// Reads the header. With `counts`, the reports count for --stats.
  TracedScene(Tool& tool, const TraceOptions& chosen, const Viewport& screen, bool counts);
  TracedScene(const TracedScene&) = delete;
  TracedScene& operator=(const TracedScene&) = delete;

  /// Reads the body to its end, for rays from anywhere if colors need them or pixels are probed.
  void read(Tool& tool);

  const TraceOptions& chosen;
  const Viewport& screen;
  SamplePlaces places;
  StageReader reader;
  Located<Projection> given;  // by the header or the options
  ProjectionTransform projection;
  StageHeader header;  // as `project` writes it
  Color background;
  LightTransportSetup light;
  std::optional<SurfaceShader> shader;  // zbuf's, for the samples; if none, every triangle has its own color
  bool casts_any_rays = false;          // other than primary ones
  bool traces_light = false;            // rays bring the colors, not the shader
  TracedTriangles triangles;
  ViewReport view;
  DrawingReport drawing;
  UnseenSpheres spheres;
};

}  // namespace pipeline
