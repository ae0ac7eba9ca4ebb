#include "tools/trace/rendering.h"

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tools/rim/empty_picture_note.h"
#include "tools/trace/ray_report.h"
#include "tools/trace/traced_picture.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/screen.h"

namespace pipeline {
namespace {

/// The number of threads: a ray, or a triangle of the hierarchy, takes as long as 256 samples of zbuf.
int threads_for(const TracedScene& scene, std::size_t triangle_count) {
  const auto samples = static_cast<std::size_t>(scene.chosen.sample_count);
  const auto pixels =
      static_cast<std::size_t>(scene.screen.columns) * static_cast<std::size_t>(scene.screen.rows);
  return scene.chosen.threads_for(256 * (pixels * samples * samples + triangle_count));
}

/// Casts the rays of the picture and, for `probe_lines`, of the probed pixels.
TracedPicture cast(TracedScene& scene, std::size_t triangle_count, const std::vector<Pixel>& probed,
                   std::vector<std::string>& probe_lines) {
  ThreadPool pool(threads_for(scene, triangle_count));
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  auto boxes = boxes_of(scene.triangles, PixelRays(scene.projection, scene.screen),
                        scene.casts_any_rays ? RaysOfBoxes::any : RaysOfBoxes::primary);
  if (!scene.casts_any_rays && !scene.traces_light) scene.triangles.keep_images_alone();
  const Bvh bvh(std::move(boxes), pool);
  const double build_seconds = seconds();
  TracedPicture picture = traced_picture(scene, bvh, pool);
  picture.work.build_seconds = build_seconds;
  picture.work.cast_seconds = seconds() - build_seconds;
  for (const Pixel& pixel : probed) add_ray_lines(pixel, scene, bvh, probe_lines);
  return picture;
}

void add_to(Statistics& statistics, const TracedScene& scene, std::size_t triangle_count,
            const LightTransport::RayCounts& rays) {
  statistics.add("triangles", triangle_count);
  scene.view.add_to(statistics);
  for (std::size_t kind = 0; kind < (scene.traces_light ? rays.cast.size() : 1); ++kind)
    statistics.add(std::string(kRayKindNames[kind]) + "_rays", rays.cast[kind]);
  if (scene.traces_light) statistics.add("cut_rays", rays.cut);
}

void write(PictureOutputs& outputs, const TracedScene& scene, const TracedPicture& picture) {
  outputs.open(scene.screen, 1, scene.background);
  for (int row = 0; row < scene.screen.rows; ++row) {
    if (scene.chosen.has_depths()) outputs.write_depths(picture.row_of(picture.depths, row));
    if (outputs.wants_triangles()) outputs.write_triangles(picture.row_of(picture.triangles, row));
    if (outputs.wants_colors()) outputs.write_colors(picture.row_of(picture.colors, row));
  }
  outputs.finish(picture.covered_count);
}

/// The reason why triangles do not show: the note of `project`, else that of `zbuf`.
std::optional<std::string> unseen_triangles_note(const TracedScene& scene) {
  const auto note = scene.view.note();
  return note ? note : scene.drawing.empty_picture_note();
}

/// The reason why a scene with spheres shows nothing: the notes on spheres and, if there are any, triangles.
std::string unmet_note(const TracedScene& scene, std::uint64_t object_count) {
  const std::string note = unseen_spheres_note(scene.spheres);
  const std::string triangles = unseen_triangles_note(scene).value_or("");
  const std::size_t reason = triangles.find("empty: ");
  const bool has_triangles = object_count > scene.triangles.spheres().size();
  return has_triangles && reason != std::string::npos ? note + "; " + triangles.substr(reason + 7) : note;
}

/// The note on an empty or a squeezed image.
std::optional<std::string> note_on(const TracedScene& scene, const ShownColors& shown,
                                   std::uint64_t object_count) {
  const bool has_spheres = !scene.triangles.spheres().empty();
  if (has_spheres && shown.count() == 0) return unmet_note(scene, object_count);
  std::optional<std::string> note;
  if (!has_spheres) note = unseen_triangles_note(scene);
  const bool is_known = bright_light_note(scene.header.appearance).has_value();  // model has noted it
  if (!note) note = odd_colors_note(shown, {scene.background, false, is_known});
  return note ? note : squeezed_note(scene.given.value, scene.screen);
}

}  // namespace

void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics) {
  PictureOutputs outputs(tool, chosen, statistics);
  TracedScene scene(tool, chosen, screen, statistics.is_wanted());
  const std::vector<Pixel> probed = probed_pixels(chosen, screen);
  scene.read(tool);
  const std::uint64_t object_count = tool.timing().triangle_count;
  tool.timing().lap(&Timing::read_seconds);
  std::vector<std::string> probe_lines;
  const TracedPicture picture = cast(scene, object_count, probed, probe_lines);
  tool.timing().details = to_text(picture.work);
  add_to(statistics, scene, object_count, picture.work.rays);
  outputs.close_reports();
  tool.timing().lap(&Timing::work_seconds);
  write(outputs, scene, picture);
  for (const std::string& line : probe_lines) Tool::report(line);
  if (!chosen.has_image()) return;
  if (const auto note = note_on(scene, picture.shown, object_count)) tool.note(*note);
}

}  // namespace pipeline
