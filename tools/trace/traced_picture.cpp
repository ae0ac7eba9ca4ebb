#include "tools/trace/traced_picture.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "tools/rim/progress.h"

namespace pipeline {

namespace {

/// The value with three digits.
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string millions(std::uint64_t count) {
  return rounded(static_cast<double>(count) / 1e6) + " million ";
}

/// Gives samples their colors, for one thread. A sample is a pixel of the screen whose rays are cast: the
/// picture's, or a finer one.
class SampleColors {
 public:
  SampleColors(const TracedScene& scene, const Bvh& bvh, const PixelRays& rays, const PictureSetup& setup)
      : triangles_(scene.triangles), rays_(rays), setup_(setup), cache_(kCached) {
    if (setup.light != nullptr) light_.emplace(triangles_, bvh, *setup.light);
  }

  /// The color of a sample that shows `seen`. Rays' colors are clamped and rounded as in `zbuf`.
  Color color(int row, int column, const RayCaster::Seen& seen) {
    if (light_) {
      const Color color = rounded_color(light_->radiance(seen, rays_.ray(row, column)));
      const bool is_lit = setup_.light->model != ShadingModel::none;
      if (shown_.add(color, setup_.background, is_lit))
        shown_.add(light_->dark_surface(), 1, setup_.light->lighting, is_lit);
      return color;
    }
    const CachedSurface& shown = surface(seen.id);
    if (setup_.shader == nullptr) return shown.own_color;
    const SurfaceShader& shader = *setup_.shader;
    const Color color = shader.color_at(shown.surface, row, column);
    if (shown_.add(color, setup_.background, shader.is_lit()))
      shown_.add(shader.dark_surface(triangles_.p_ndc(), seen.id, shown.own_color, shown.surface), 1,
                 shader.setup().lighting, shader.is_lit());
    return color;
  }
  [[nodiscard]] const ShownColors& shown() const { return shown_; }
  /// The light transport; none if no rays bring colors.
  [[nodiscard]] const std::optional<LightTransport>& light() const { return light_; }

 private:
  // Neighboring samples show the same few triangles.
  static constexpr std::size_t kCached = 256;
  struct CachedSurface {
    std::optional<SurfaceId> id;
    Color own_color;  // for triangles without a shader
    SurfaceShader::Surface surface;
  };

  const CachedSurface& surface(SurfaceId id) {
    CachedSurface& cached = cache_[id % kCached];
    if (cached.id == id) return cached;
    cached.id = id;
    cached.own_color = own_colors_.of(triangles_.number(id));
    if (setup_.shader == nullptr) return cached;
    const TriangleBatch& p_ndc = triangles_.p_ndc();
    cached.surface = setup_.shader->surface_of(p_ndc, id, cached.own_color);
    return cached;
  }

  const TracedTriangles& triangles_;
  PixelRays rays_;
  const PictureSetup& setup_;
  std::optional<LightTransport> light_;
  TriangleColors own_colors_;
  std::vector<CachedSurface> cache_;
  ShownColors shown_;
};

/// The rays of one thread.
class PixelTracer {
 public:
  PixelTracer(const TracedScene& scene, const Bvh& bvh, const PictureSetup& setup)
      : triangles_(scene.triangles),
        chosen_(setup.chosen),
        background_(setup.background),
        places_(setup.places()),
        order_(sample_order(chosen_.sample_count)),
        first_samples_(order_),
        is_random_(is_random(*chosen_.sampling)),
        colors_(scene, bvh, PixelRays(scene.projection, places_.screen()), setup),
        centers_(triangles_, bvh, scene.projection, setup.screen),
        samples_(triangles_, bvh, scene.projection, places_.screen(), is_random_ ? 1 : chosen_.sample_count) {
    if (chosen_.sampling == Sampling::adaptive)
      first_samples_ = first_samples_.first(std::min(kFirstSamples, order_.size()));
  }

  void trace(int row, int column, std::size_t pixel, TracedPicture& picture) {
    const bool has_colors = !picture.colors.empty(), has_depths = !picture.depths.empty(),
               has_triangles = !picture.triangles.empty();
    const bool has_one_sample = chosen_.sample_count == 1 && !is_random_;
    if (has_depths || has_triangles || chosen_.summarizes || has_one_sample) {
      ++ray_count_;
      if (const auto seen = centers_.cast(row, column)) {
        ++covered_count_;
        if (has_depths) picture.depths[pixel] = seen->depth;
        if (has_triangles) picture.triangles[pixel] = static_cast<std::int64_t>(triangles_.number(seen->id));
        if (has_colors && has_one_sample) picture.colors[pixel] = colors_.color(row, column, *seen);
      }
    }
    if (has_colors && !has_one_sample) picture.colors[pixel] = mean_of(row, column);
  }
  [[nodiscard]] std::uint64_t ray_count() const { return ray_count_; }
  /// Adds this thread's counts and colors; to be called after all threads have finished.
  void add_up(TracedPicture& picture) const {
    picture.covered_count += covered_count_;
    picture.shown.add(colors_.shown());
    picture.work.rays.cast[static_cast<std::size_t>(RayKind::primary)] += ray_count_;
    if (colors_.light()) picture.work.rays.add(colors_.light()->counts());
  }

 private:
  Color mean_of(int row, int column) {
    sample_colors_.clear();
    cast(row, column, first_samples_);
    if (first_samples_.size() < order_.size() && largest_difference(sample_colors_) >= chosen_.threshold)
      cast(row, column, std::span(order_).subspan(first_samples_.size()));
    ColorMean mean;
    for (const Color color : sample_colors_) mean.add(color);
    return mean.mean();
  }
  void cast(int row, int column, std::span<const int> samples) {
    ray_count_ += samples.size();
    for (const int sample : samples) {
      const auto place = places_.of(row, column, sample);
      const auto seen = samples_.cast(place.row, place.column);
      sample_colors_.push_back(seen ? colors_.color(place.row, place.column, *seen) : background_);
    }
  }

  const TracedTriangles& triangles_;
  const TraceOptions& chosen_;
  Color background_;
  SamplePlaces places_;
  const std::vector<int> order_;
  std::span<const int> first_samples_;  // all, unless the others depend on them
  bool is_random_;
  SampleColors colors_;
  RayCaster centers_, samples_;
  std::vector<Color> sample_colors_;  // of a pixel
  std::uint64_t ray_count_ = 0;
  std::uint64_t covered_count_ = 0;
};

}  // namespace

std::string to_text(const TraceWork& work) {
  const double seconds = std::max(work.cast_seconds, 1e-9);
  char build[48];
  std::snprintf(build, sizeof build, "build %.3f s", work.build_seconds);
  std::string all = build;
  for (std::size_t kind = 0; kind < kRayKindNames.size(); ++kind)
    if (const std::uint64_t count = work.rays.cast[kind]; count > 0)
      all += ", " + millions(count) + kRayKindNames[kind] + " rays at " +
             rounded(static_cast<double>(count) / 1e6 / seconds) + " million a second";
  if (work.rays.cut > 0)
    all += ", " + millions(work.rays.cut) + "rays cut, at most " + rounded(work.rays.largest_cut_weight) +
           " of a pixel's color";
  return all;
}

TracedPicture::TracedPicture(const PictureSetup& setup) : screen(setup.screen) {
  const std::size_t pixel_count =
      static_cast<std::size_t>(screen.rows) * static_cast<std::size_t>(screen.columns);
  if (setup.chosen.has_image()) colors.assign(pixel_count, setup.background);
  if (setup.chosen.has_depths()) depths.assign(pixel_count, screen.rear);
  if (!setup.chosen.triangle_array_path.empty()) triangles.assign(pixel_count, -1);
}

TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, const PictureSetup& setup,
                             ThreadPool& pool) {
  TracedPicture picture(setup);
  std::vector<std::unique_ptr<PixelTracer>> tracers(static_cast<std::size_t>(pool.size()));
  Progress progress("trace", "ray");
  std::atomic<std::uint64_t> ray_count = 0;
  std::atomic<int> row_count = 0;
  pool.start(setup.screen.rows, [&](int row, int worker) {
    auto& tracer = tracers[static_cast<std::size_t>(worker)];
    if (!tracer) tracer = std::make_unique<PixelTracer>(scene, bvh, setup);
    const std::uint64_t before = tracer->ray_count();
    const auto columns = static_cast<std::size_t>(setup.screen.columns);
    for (std::size_t column = 0; column < columns; ++column)
      tracer->trace(row, static_cast<int>(column), static_cast<std::size_t>(row) * columns + column, picture);
    ray_count += tracer->ray_count() - before;
    ++row_count;
    if (worker == 0) progress.show(ray_count, static_cast<double>(row_count) / setup.screen.rows);
  });
  pool.finish();
  for (const auto& tracer : tracers)
    if (tracer) tracer->add_up(picture);
  return picture;
}

}  // namespace pipeline
