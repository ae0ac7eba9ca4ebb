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
    : tool_(tool),
      reader_(opened(tool.input(), chosen.framed)),
      given_(chosen.projection.projection(reader_, tool)),
      projection_(clip_from_view(given_)),
      header_(projected_header(reader_.header(), given_, projection_)),
      exact_(projection_, tool.input().file(), header_.projected.has_value()),
      view_(exact_.stage(), ViewVolume(projection_), counts),
      drawing_({.coverage = TypeValue<CenterCoverage>(), .depth = {}}, screen, chosen.sample_count, false),
      spheres_(projection_, screen) {
  view_.suspect_radians(given_);
}

void TracedScene::read(bool keeps_dropped) {
  if (keeps_dropped) triangles_.keep_dropped();
  const bool is_painted = header_.appearance.is_painted();
  for (TriangleBatch p_view; reader_.read(p_view);) {
    if (is_painted) add_material_colors(header_.appearance, p_view);
    tool_.timing().triangle_count += p_view.object_count();
    spheres_.add(p_view);
    const TriangleBatch& p_ndc = exact_.project(p_view);
    view_.add(p_view, p_ndc);
    drawing_.add(p_ndc);
    triangles_.add(p_view, p_ndc, tool_.input().file());
    expect_room(triangles_);
  }
}

}  // namespace pipeline
