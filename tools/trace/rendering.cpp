#include "tools/trace/rendering.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/trace/ray_report.h"
#include "tools/trace/traced_picture.h"
#include "tools/trace/traced_scene.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

/// The number of threads: a ray, or a triangle of the hierarchy, takes as long as 256 samples of zbuf.
int threads_for(const TraceOptions& chosen, const Viewport& screen, std::size_t triangle_count) {
  const auto samples = static_cast<std::size_t>(chosen.sample_count);
  const auto pixels = static_cast<std::size_t>(screen.columns) * static_cast<std::size_t>(screen.rows);
  return chosen.threads_for(256 * (pixels * samples * samples + triangle_count));
}

LightTransportSetup light_transport_setup(const TraceOptions& chosen, const TracedScene& scene,
                                          Color background) {
  const Appearance& appearance = scene.header.appearance;
  return {.model = shading_model(appearance, chosen.shading),
          .lighting = lighting_of(appearance, scene.projection.is_perspective),
          .materials = materials_of(appearance),
          .background = to_vec3(background),
          .has_shadows = !chosen.without_shadows,
          .recurses = !chosen.without_recursion,
          .min_contribution = chosen.min_contribution,
          .max_depth = chosen.max_depth};
}

/// True if colors need more than primary rays: a shadow may fall, or a material mirrors or is clear.
bool needs_light_transport(const LightTransportSetup& setup) {
  const bool has_lights = setup.model != ShadingModel::none && !setup.lighting.lights.empty();
  return (has_lights && setup.has_shadows) ||
         (setup.recurses && std::ranges::any_of(setup.materials, &Material::sends_rays));
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

/// A run of `trace`, from the header of its input to the notes.
class Rendering {
 public:
  /// Reads the header.
  Rendering(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics)
      : tool_(tool),
        chosen_(chosen),
        screen_(screen),
        statistics_(statistics),
        outputs_(tool, chosen, statistics),
        scene_(tool, chosen, screen, statistics.is_wanted()),
        picture_{chosen, screen, background_color(scene_.header.appearance, parse_color(chosen.background))},
        light_(light_transport_setup(chosen, scene_, picture_.background)) {
    if (chosen.has_image())
      shader_ = surface_shader(scene_.header, scene_.reader.header_end(), picture_.places().screen(), chosen);
    probed_ = probed_pixels(chosen, screen);
  }

  void read() {
    const bool sends_rays = chosen_.has_image() && needs_light_transport(light_);
    casts_any_rays_ = sends_rays || !probed_.empty();
    scene_.read(tool_, screen_, casts_any_rays_);
    // zbuf's shader does not take spheres.
    has_spheres_ = !scene_.triangles.spheres().empty();
    traces_light_ = sends_rays || (chosen_.has_image() && has_spheres_);
    tool_.timing().lap(&Timing::read_seconds);
  }

  TracedPicture cast() {
    ThreadPool pool(threads_for(chosen_, screen_, tool_.timing().triangle_count));
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    auto boxes = boxes_of(scene_.triangles, PixelRays(scene_.projection, screen_),
                          casts_any_rays_ ? RaysOfBoxes::any : RaysOfBoxes::primary);
    if (!casts_any_rays_ && !traces_light_) scene_.triangles.keep_images_alone();
    const Bvh bvh(std::move(boxes), pool);
    const double build_seconds = seconds();
    if (shader_) picture_.shader = &*shader_;
    if (traces_light_) picture_.light = &light_;
    TracedPicture picture = traced_picture(scene_, bvh, picture_, pool);
    picture.work.build_seconds = build_seconds;
    picture.work.cast_seconds = seconds() - build_seconds;
    for (const Pixel& pixel : probed_) add_ray_lines(pixel, scene_, bvh, screen_, light_, probe_lines_);
    return picture;
  }

  void write(const TracedPicture& picture) {
    tool_.timing().details = to_text(picture.work);
    add_statistics(picture.work);
    outputs_.close_reports();
    tool_.timing().lap(&Timing::work_seconds);
    outputs_.open(screen_, 1, picture_.background);
    for (int row = 0; row < screen_.rows; ++row) {
      if (chosen_.has_depths()) outputs_.write_depths(picture.row_of(picture.depths, row));
      if (outputs_.wants_triangles()) outputs_.write_triangles(picture.row_of(picture.triangles, row));
      if (outputs_.wants_colors()) outputs_.write_colors(picture.row_of(picture.colors, row));
    }
    outputs_.finish(picture.covered_count);
    for (const std::string& line : probe_lines_) Tool::report(line);
  }

  /// Notes an empty or a squeezed image.
  void note(const TracedPicture& picture) const {
    if (!chosen_.has_image()) return;
    if (const auto note = invisible_note(picture.shown))
      tool_.note(*note);
    else if (const auto squeezed = squeezed_note(scene_.given.value, screen_))
      tool_.note(*squeezed);
  }

 private:
  void add_statistics(const TraceWork& work) {
    statistics_.add("triangles", tool_.timing().triangle_count);
    scene_.view.add_to(statistics_);
    for (std::size_t kind = 0; kind < (traces_light_ ? work.rays.cast.size() : 1); ++kind)
      statistics_.add(std::string(kRayKindNames[kind]) + "_rays", work.rays.cast[kind]);
    if (traces_light_) statistics_.add("cut_rays", work.rays.cut);
  }

  [[nodiscard]] std::optional<std::string> invisible_note(const ShownColors& shown) const {
    if (has_spheres_ && shown.count() == 0) return unmet_note(scene_, tool_.timing().triangle_count);
    if (!has_spheres_)
      if (auto unseen = unseen_triangles_note(scene_)) return unseen;
    return odd_colors_note(shown, {picture_.background});
  }

  Tool& tool_;
  const TraceOptions& chosen_;
  const Viewport& screen_;
  Statistics& statistics_;
  PictureOutputs outputs_;
  TracedScene scene_;
  PictureSetup picture_;
  std::optional<SurfaceShader> shader_;
  LightTransportSetup light_;
  std::vector<Pixel> probed_;
  bool casts_any_rays_ = false;  // other than primary ones
  bool has_spheres_ = false, traces_light_ = false;
  std::vector<std::string> probe_lines_;
};

}  // namespace

void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics) {
  Rendering rendering(tool, chosen, screen, statistics);
  rendering.read();
  const TracedPicture picture = rendering.cast();
  rendering.write(picture);
  rendering.note(picture);
}

}  // namespace pipeline
