#include "tools/trace/traced_scene.h"

#include <stdexcept>

#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/error.h"
#include "libpipeline/vertex/projection.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

StageReader opened(TextReader& text, bool framed) {
  expect_kind(text, TextKind::view);
  StageReader reader(text);
  expect_header(reader, TextKind::view);
  if (framed) reader.expect_framed();
  reader.accept_spheres();
  return reader;
}

void expect_room(const TracedTriangles& triangles) {
  if (triangles.surface_count() > Bvh::kMaxPrimitives)
    throw std::runtime_error(
        expected_but_found("at most " + counted(Bvh::kMaxPrimitives, "triangle"), "more"));
}

}  // namespace

TracedScene::TracedScene(Tool& tool, const TraceOptions& chosen, const Viewport& screen, bool counts)
    : reader(opened(tool.input(), chosen.framed)),
      given(chosen.projection.projection(reader, tool)),
      projection(clip_from_view(given)),
      header(projected_header(reader.header(), given, projection)),
      triangles(projection, tool.input().file(), header.projected.has_value()),
      view(triangles.stage(), given, ViewVolume(projection), counts),
      drawing({.coverage = TypeValue<CenterCoverage>(), .depth = {}}, screen, chosen.sample_count, false) {}

void TracedScene::read(Tool& tool, const Viewport& screen, bool keeps_dropped) {
  if (keeps_dropped) triangles.keep_dropped();
  const bool is_painted = header.appearance.is_painted();
  for (TriangleBatch p_view; reader.read(p_view);) {
    if (is_painted) add_material_colors(header.appearance, p_view);
    tool.timing().triangle_count += p_view.object_count();
    add_places(p_view, projection, screen, spheres);
    const TriangleBatch& p_ndc = triangles.add(p_view);
    view.add(p_view, p_ndc);
    drawing.add(p_ndc);
    expect_room(triangles);
  }
}

}  // namespace pipeline
