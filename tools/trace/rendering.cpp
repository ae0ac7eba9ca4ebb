#include "tools/trace/rendering.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/sampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/trace/light_colors.h"
#include "tools/trace/ray_report.h"
#include "tools/trace/surface_colors.h"
#include "tools/trace/trace_work.h"
#include "tools/trace/traced_picture.h"
#include "tools/trace/traced_scene.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/image_rows.h"
#include "tools/zbuf/pixel_files.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

/// One of `Colors` for each worker of a pool, made by the worker itself.
template <typename Colors>
class WorkersColors {
 public:
  using Maker = std::function<std::unique_ptr<Colors>()>;

  WorkersColors(const ThreadPool& pool, Maker maker)
      : maker_(std::move(maker)), workers_(static_cast<std::size_t>(pool.size())) {}

  SampleColors& operator()(int worker) {
    auto& colors = workers_[static_cast<std::size_t>(worker)];
    if (!colors) colors = maker_();
    return *colors;
  }
  template <typename Visitor>
  void for_each(Visitor&& visit) const {
    for (const auto& colors : workers_)
      if (colors) visit(*colors);
  }

 private:
  Maker maker_;
  std::vector<std::unique_ptr<Colors>> workers_;
};

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
  const Viewport& screen = picture.screen;
  ImageRows image(chosen.image_path, screen, 1, background);
  PixelFiles pixels(tool.output(), chosen, screen);
  for (int row = 0; row < screen.rows; ++row) {
    if (!picture.depths.empty()) pixels.write_depths(picture.row_of(picture.depths, row));
    if (pixels.wants_triangles()) pixels.write_triangles(picture.row_of(picture.triangles, row));
    if (image.is_wanted()) image.write_row(picture.row_of(picture.colors, row));
  }
  pixels.close();
  image.close();
  tool.close_output();
  image.commit();
  pixels.commit();
  if (chosen.summarizes) Tool::report(summary(chosen.image_path, screen, picture.covered_count));
  tool.timing().lap(&Timing::write_seconds);
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
    Stopwatch watch;
    const ProjectionTransform& projection = scene.projection();
    const TracedTriangles& triangles = scene.triangles();
    const Bvh bvh = hierarchy_of(triangles, PixelRays(projection, screen), pool,
                                 casts_any_rays ? RaysOfBoxes::any : RaysOfBoxes::primary);
    const LightTransport transport(triangles, bvh, setup);
    work.build_seconds = watch.lap();

    WorkersColors<SurfaceColors> surface_colors(
        pool, [&] { return std::make_unique<SurfaceColors>(scene, shader ? &*shader : nullptr); });
    WorkersColors<LightColors> light_colors(pool, [&] {
      return std::make_unique<LightColors>(transport, projection, places.screen(), background);
    });
    const ColorsOfWorker colors =
        traces_light ? ColorsOfWorker(std::ref(light_colors)) : ColorsOfWorker(std::ref(surface_colors));
    TracedPicture all = traced_picture(scene, bvh, screen, places, rays, background, colors, pool, work);
    light_colors.for_each([&](const LightColors& light) {
      light.add_to(work);
      shown_light.add(light.shown());
    });
    if (shader)
      surface_colors.for_each([&](const SurfaceColors& surface) { shader->add_shown(surface.shown()); });
    work.cast_seconds = watch.lap();
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
