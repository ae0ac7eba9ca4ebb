#include "tools/trace/rendering.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/sampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/trace/ray_report.h"
#include "tools/trace/sample_colors.h"
#include "tools/trace/trace_work.h"
#include "tools/trace/traced_picture.h"
#include "tools/trace/traced_scene.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

PictureRays rays_of(const TraceOptions& chosen) {
  const ZbufOptions& picture = chosen.picture;
  return {.sampling = chosen.sampling.value_or(Sampling::regular),
          .sample_count = picture.sample_count,
          .threshold = chosen.threshold,
          .has_colors = picture.has_image(),
          .has_depths = picture.z_buffer_path != "none" || !picture.depth_image_path.empty() ||
                        !picture.depth_array_path.empty(),
          .has_triangles = !picture.triangle_array_path.empty(),
          .counts_covered = picture.summarizes};
}

/// Writes image and depths.
void write_all(Tool& tool, const ZbufOptions& chosen, const TracedPicture& picture, Color background) {
  PictureOutputs outputs(tool, chosen, picture.screen, 1, background);
  for (int row = 0; row < picture.screen.rows; ++row) {
    if (!picture.depths.empty()) outputs.write_depths(picture.row_of(picture.depths, row));
    if (outputs.wants_triangles()) outputs.write_triangles(picture.row_of(picture.triangles, row));
    if (outputs.wants_colors()) outputs.write_colors(picture.row_of(picture.colors, row));
  }
  outputs.finish(picture.covered_count);
}

/// Why triangles do not show: the notes of `project` and of `zbuf`.
std::optional<std::string> unseen_triangles_note(const TracedScene& scene) {
  if (auto note = scene.view().note()) return note;
  return scene.drawing().empty_picture_note();
}

/// Why a scene with spheres shows nothing: the note on those, and on the triangles, if there are some.
std::string unmet_note(const TracedScene& scene, std::uint64_t object_count) {
  const std::string note = unseen_spheres_note(scene.spheres());
  if (scene.triangles().spheres().size() == object_count) return note;
  const std::string triangles = unseen_triangles_note(scene).value_or("");
  const std::size_t reason = triangles.find("empty: ");
  return reason == std::string::npos ? note : note + "; " + triangles.substr(reason + 7);
}

}  // namespace

void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics) {
  const ZbufOptions& output = chosen.picture;
  const PictureRays rays = rays_of(chosen);
  const SamplePlaces places(screen, rays.sample_count, is_random(rays.sampling));
  statistics.open();
  TracedScene scene(tool, chosen, screen, statistics.is_wanted());
  const SurfaceOptions surfaces = {.model = output.shading,
                                   .wireframe = {},
                                   .background = parse_color(output.background),
                                   .holds_alpha = rays.has_colors && can_hold_alpha(output.image_path)};
  const Color background = background_color(scene.header().appearance, surfaces.background);
  std::optional<SurfaceShader> shader;
  if (rays.has_colors) shader = surface_shader(scene.header(), scene.header_end(), places.screen(), surfaces);
  const LightTransportSetup setup =
      light_transport_setup(scene.header().appearance, scene.projection().is_perspective, chosen);
  const bool sends_rays = rays.has_colors && needs_light_transport(setup);
  const std::vector<Pixel> probed = probed_pixels(output, screen);
  const bool casts_any_rays = sends_rays || !probed.empty();
  scene.read(casts_any_rays);
  // The shader of zbuf has no spheres.
  const bool has_spheres = !scene.triangles().spheres().empty();
  const bool traces_light = sends_rays || (rays.has_colors && has_spheres);
  tool.timing().lap(&Timing::read_seconds);

  TraceWork work;
  ShownLight shown_light;
  ThreadPool pool(chosen.thread_count());
  std::vector<std::string> probe_lines;
  const TracedPicture picture = [&] {
    auto last = std::chrono::steady_clock::now();
    const auto lap = [&] {
      const auto now = std::chrono::steady_clock::now();
      return std::chrono::duration<double>(now - std::exchange(last, now)).count();
    };
    const ProjectionTransform& projection = scene.projection();
    const TracedTriangles& triangles = scene.triangles();
    const Bvh bvh = hierarchy_of(triangles, PixelRays(projection, screen), pool,
                                 casts_any_rays ? RaysOfBoxes::any : RaysOfBoxes::primary);
    const LightTransport transport(triangles, bvh, setup);
    work.build_seconds = lap();

    const PixelRays sample_rays(projection, places.screen());
    const auto make_colors = [&]() -> std::unique_ptr<SampleColors> {
      if (!traces_light) return std::make_unique<SurfaceColors>(scene, shader ? &*shader : nullptr);
      return std::make_unique<LightColors>(transport, sample_rays, background, work, shown_light);
    };
    TracedPicture all = traced_picture(scene, bvh, screen, places, rays, background, make_colors, pool, work);
    work.cast_seconds = lap();
    for (const Pixel& pixel : probed)
      for (const std::string& line :
           ray_lines(pixel, {triangles, bvh, projection, screen}, transport, PixelRays(projection, screen)))
        probe_lines.push_back(line);
    return all;
  }();
  tool.timing().details = to_text(work);
  statistics.add("triangles", tool.timing().triangle_count);
  scene.view().add_to(statistics);
  statistics.add("primary_rays", work.primary_rays);
  if (traces_light) {
    statistics.add("shadow_rays", work.rays.shadow);
    statistics.add("mirrored_rays", work.rays.mirrored);
    statistics.add("refracted_rays", work.rays.refracted);
    statistics.add("cut_rays", work.rays.cut);
  }
  statistics.finish();
  tool.timing().lap(&Timing::work_seconds);

  write_all(tool, output, picture, background);
  statistics.commit();
  for (const std::string& line : probe_lines) Tool::report(line);
  if (!rays.has_colors) return;
  const auto note = [&]() -> std::optional<std::string> {
    if (has_spheres && !shown_light.has_seen) return unmet_note(scene, tool.timing().triangle_count);
    if (!has_spheres)
      if (auto unseen = unseen_triangles_note(scene)) return unseen;
    if (!traces_light) return shader ? invisible_colors_note(*shader) : std::nullopt;
    return shown_light.has_seen
               ? invisible_light_note(shown_light, background, setup.model != ShadingModel::none)
               : std::nullopt;
  }();
  if (note)
    tool.note(*note);
  else if (const auto squeezed = squeezed_note(scene.given_projection(), screen))
    tool.note(*squeezed);
}

}  // namespace pipeline
