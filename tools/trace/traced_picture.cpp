#include "tools/trace/traced_picture.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>

#include "libpipeline/picture/supersampling.h"
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

/// Casts the rays of one thread, and gives samples their colors. A sample is a pixel of the screen whose rays
/// are cast: the picture's, or a finer one.
class PixelTracer {
 public:
  PixelTracer(const TracedScene& scene, const Bvh& bvh)
      : scene_(scene),
        order_(sample_order(scene.chosen.sample_count)),
        first_samples_(order_),
        rays_(scene.projection, scene.places.screen()),
        centers_(scene.triangles, bvh, scene.projection, scene.screen),
        samples_(scene.triangles, bvh, scene.projection, scene.places.screen(),
                 is_random(*scene.chosen.sampling) ? 1 : scene.chosen.sample_count),
        cache_(kCached) {
    if (scene.traces_light) light_.emplace(scene.triangles, bvh, scene.light);
    if (scene.chosen.sampling == Sampling::adaptive)
      first_samples_ = first_samples_.first(std::min(kFirstSamples, order_.size()));
  }

  void trace(int row, int column, std::size_t pixel, TracedPicture& picture) {
    const bool has_colors = !picture.colors.empty(), has_depths = !picture.depths.empty(),
               has_triangles = !picture.triangles.empty();
    const bool has_one_sample = scene_.chosen.sample_count == 1 && !is_random(*scene_.chosen.sampling);
    if (has_depths || has_triangles || scene_.chosen.summarizes || has_one_sample) {
      ++ray_count_;
      if (const auto seen = centers_.cast(row, column)) {
        ++covered_count_;
        if (has_depths) picture.depths[pixel] = seen->depth;
        if (has_triangles)
          picture.triangles[pixel] = static_cast<std::int64_t>(scene_.triangles.number(seen->id));
        if (has_colors && has_one_sample) picture.colors[pixel] = color(row, column, *seen);
      }
    }
    if (has_colors && !has_one_sample) picture.colors[pixel] = mean_of(row, column);
  }
  [[nodiscard]] std::uint64_t ray_count() const { return ray_count_; }
  /// Adds this thread's counts and colors; to be called after all threads have finished.
  void add_up(TracedPicture& picture) const {
    picture.covered_count += covered_count_;
    picture.shown.add(shown_);
    picture.work.rays.cast[static_cast<std::size_t>(RayKind::primary)] += ray_count_;
    if (light_) picture.work.rays.add(light_->counts());
  }

 private:
  // Neighboring samples show the same few triangles.
  static constexpr std::size_t kCached = 256;
  struct CachedSurface {
    std::optional<SurfaceId> id;
    Color own_color;  // for triangles without a shader
    SurfaceShader::Surface surface;
  };

  Color mean_of(int row, int column) {
    colors_.clear();
    cast(row, column, first_samples_);
    if (first_samples_.size() < order_.size() && largest_difference(colors_) >= scene_.chosen.threshold)
      cast(row, column, std::span(order_).subspan(first_samples_.size()));
    ColorMean mean;
    for (const Color color : colors_) mean.add(color);
    return mean.mean();
  }
  void cast(int row, int column, std::span<const int> samples) {
    ray_count_ += samples.size();
    for (const int sample : samples) {
      const auto place = scene_.places.of(row, column, sample);
      const auto seen = samples_.cast(place.row, place.column);
      colors_.push_back(seen ? color(place.row, place.column, *seen) : scene_.background);
    }
  }

  /// The color of a sample that shows `seen`. Rays' colors are clamped and rounded as in `zbuf`.
  Color color(int row, int column, const RayCaster::Seen& seen) {
    if (light_) {
      const Color color = rounded_color(light_->radiance(seen, rays_.ray(row, column)));
      const bool is_lit = scene_.light.model != ShadingModel::none;
      if (shown_.add(color, scene_.background, is_lit))
        shown_.add(light_->dark_surface(), 1, scene_.light.lighting, is_lit);
      return color;
    }
    const CachedSurface& shown = surface(seen.id);
    if (!scene_.shader) return shown.own_color;
    const SurfaceShader& shader = *scene_.shader;
    const Color color = shader.color_at(shown.surface, row, column);
    if (shown_.add(color, scene_.background, shader.is_lit()))
      shown_.add(shader.dark_surface(shown.surface), 1, shader.setup().lighting, shader.is_lit());
    return color;
  }
  const CachedSurface& surface(SurfaceId id) {
    CachedSurface& cached = cache_[id % kCached];
    if (cached.id == id) return cached;
    cached.id = id;
    cached.own_color = own_colors_.of(scene_.triangles.number(id));
    if (scene_.shader)
      cached.surface = scene_.shader->surface_of(scene_.triangles.p_ndc(), id, cached.own_color);
    return cached;
  }

  const TracedScene& scene_;
  const std::vector<int> order_;
  std::span<const int> first_samples_;  // all, unless the others depend on them
  PixelRays rays_;
  RayCaster centers_, samples_;
  std::optional<LightTransport> light_;  // none if no rays bring colors
  TriangleColors own_colors_;
  std::vector<CachedSurface> cache_;
  std::vector<Color> colors_;  // of a pixel's samples
  ShownColors shown_;
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

TracedPicture::TracedPicture(const TracedScene& scene)
    : columns(static_cast<std::size_t>(scene.screen.columns)) {
  const std::size_t pixel_count = static_cast<std::size_t>(scene.screen.rows) * columns;
  if (scene.chosen.has_image()) colors.assign(pixel_count, scene.background);
  if (scene.chosen.has_depths()) depths.assign(pixel_count, scene.screen.rear);
  if (!scene.chosen.triangle_array_path.empty()) triangles.assign(pixel_count, -1);
}

TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, ThreadPool& pool) {
  TracedPicture picture(scene);
  std::vector<std::unique_ptr<PixelTracer>> tracers(static_cast<std::size_t>(pool.size()));
  Progress progress("trace", "ray");
  std::atomic<std::uint64_t> ray_count = 0;
  std::atomic<int> row_count = 0;
  pool.start(scene.screen.rows, [&](int row, int worker) {
    auto& tracer = tracers[static_cast<std::size_t>(worker)];
    if (!tracer) tracer = std::make_unique<PixelTracer>(scene, bvh);
    const std::uint64_t before = tracer->ray_count();
    for (std::size_t column = 0; column < picture.columns; ++column)
      tracer->trace(row, static_cast<int>(column), static_cast<std::size_t>(row) * picture.columns + column,
                    picture);
    ray_count += tracer->ray_count() - before;
    ++row_count;
    if (worker == 0) progress.show(ray_count, static_cast<double>(row_count) / scene.screen.rows);
  });
  pool.finish();
  for (const auto& tracer : tracers)
    if (tracer) tracer->add_up(picture);
  return picture;
}

}  // namespace pipeline
