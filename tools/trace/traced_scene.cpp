#include "tools/trace/traced_scene.h"

#include <algorithm>
#include <stdexcept>

#include "libpipeline/stream/text_kind.h"
#include "libpipeline/text/error.h"
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

/// True if colors need more than primary rays: a shadow may fall, or a material mirrors or is clear.
bool needs_light_transport(const LightTransportSetup& setup) {
  const bool has_lights = setup.model != ShadingModel::none && !setup.lighting.lights.empty();
  return (has_lights && setup.has_shadows) ||
         (setup.recurses && std::ranges::any_of(setup.materials, &Material::sends_rays));
}

}  // namespace

TracedScene::TracedScene(Tool& tool, const TraceOptions& options, const Viewport& pixels, bool counts)
    : chosen(options),
      screen(pixels),
      places(screen, chosen.sample_count, is_random(*chosen.sampling)),
      reader(opened(tool.input(), chosen.framed)),
      given(chosen.projection.projection(reader, tool)),
      projection(clip_from_view(given)),
      header(projected_header(reader.header(), given, projection)),
      background(background_color(header.appearance, parse_color(chosen.background))),
      light{.model = shading_model(header.appearance, chosen.shading),
            .lighting = lighting_of(header.appearance, projection.is_perspective),
            .materials = materials_of(header.appearance),
            .background = to_vec3(background),
            .has_shadows = !chosen.without_shadows,
            .recurses = !chosen.without_recursion,
            .min_contribution = chosen.min_contribution,
            .max_depth = chosen.max_depth},
      triangles(projection, tool.input().file(), header.projected.has_value()),
      view(triangles.stage(), given, ViewVolume(projection), counts),
      drawing({.coverage = TypeValue<CenterCoverage>(), .depth = {}}, screen, chosen.sample_count, false) {
  if (chosen.has_image()) shader = surface_shader(header, reader.header_end(), places.screen(), chosen);
}

void TracedScene::read(Tool& tool) {
  traces_light = chosen.has_image() && needs_light_transport(light);
  casts_any_rays = traces_light || !chosen.probes.empty();
  if (casts_any_rays) triangles.keep_dropped();
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
  // zbuf's shader does not take spheres.
  if (chosen.has_image() && !triangles.spheres().empty()) traces_light = true;
}

}  // namespace pipeline
