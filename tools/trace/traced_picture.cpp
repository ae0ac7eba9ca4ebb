#include "tools/trace/traced_picture.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "tools/rim/progress.h"

namespace pipeline {
namespace {

// Rays near each other find the same boxes and triangles in the processor's caches.
constexpr int kTile = 16;

/// The pixels of a screen in squares, row after row.
struct Tiles {
  explicit Tiles(const Viewport& of_pixels)
      : screen(of_pixels), across((screen.columns + kTile - 1) / kTile) {}

  [[nodiscard]] int count() const { return across * ((screen.rows + kTile - 1) / kTile); }
  template <typename Visitor>
  void for_each_pixel(int tile, Visitor&& visit) const {
    const int top = tile / across * kTile, left = tile % across * kTile;
    for (int row = top; row < std::min(top + kTile, screen.rows); ++row) {
      std::size_t pixel = static_cast<std::size_t>(row) * static_cast<std::size_t>(screen.columns) +
                          static_cast<std::size_t>(left);
      for (int column = left; column < std::min(left + kTile, screen.columns); ++column)
        visit(row, column, pixel++);
    }
  }

  const Viewport& screen;
  int across;
};

/// The rays of one thread.
class PixelTracer {
 public:
  PixelTracer(const TracedScene& scene, const Bvh& bvh, const PictureRays& rays, const ColorSetup& colors)
      : triangles_(scene.triangles()),
        rays_(rays),
        background_(colors.background),
        places_(rays.places()),
        order_(rays.sample_count),
        colors_(scene, bvh, PixelRays(scene.projection(), places_.screen()), colors),
        centers_(triangles_, bvh, scene.projection(), rays.screen),
        samples_(triangles_, bvh, scene.projection(), places_.screen()) {}

  void trace(int row, int column, std::size_t pixel, TracedPicture& picture) {
    const bool has_one_sample = rays_.sample_count == 1 && !is_random(rays_.sampling);
    if (rays_.has_depths || rays_.has_triangles || rays_.counts_covered || has_one_sample) {
      ++ray_count_;
      if (const auto seen = centers_.cast(row, column)) {
        ++covered_count_;
        if (rays_.has_depths) picture.depths[pixel] = seen->depth;
        if (rays_.has_triangles)
          picture.triangles[pixel] = static_cast<std::int64_t>(triangles_.number(seen->id));
        if (rays_.has_colors && has_one_sample) picture.colors[pixel] = colors_.color(row, column, *seen);
      }
    }
    if (rays_.has_colors && !has_one_sample) picture.colors[pixel] = mean_of(row, column);
  }
  [[nodiscard]] std::uint64_t ray_count() const { return ray_count_; }
  /// When all threads are done.
  void add_up(TracedPicture& picture) const {
    picture.covered_count += covered_count_;
    picture.shown_colors.add(colors_.shown());
    if (!colors_.light()) return;
    picture.work.rays.add(colors_.light()->counts());
    picture.shown_light.add(colors_.light()->shown());
    picture.shown_light.shows_something |= colors_.shown().show_something;
  }

 private:
  Color mean_of(int row, int column) {
    std::span<const int> samples = order_.samples();
    ColorMean mean;
    if (rays_.sampling == Sampling::adaptive) {
      const std::size_t first_count = order_.first_count();
      ColorRange range;
      for_each_color(row, column, samples.first(first_count), [&](Color color) {
        mean.add(color);
        range.add(color);
      });
      if (range.range() < rays_.threshold) return mean.mean();
      samples = samples.subspan(first_count);
    }
    for_each_color(row, column, samples, [&](Color color) { mean.add(color); });
    return mean.mean();
  }
  template <typename Visitor>
  void for_each_color(int row, int column, std::span<const int> samples, Visitor&& visit) {
    ray_count_ += samples.size();
    for (const int sample : samples) {
      const auto place = places_.of(row, column, sample);
      const auto seen = samples_.cast(place.row, place.column);
      visit(seen ? colors_.color(place.row, place.column, *seen) : background_);
    }
  }

  const TracedTriangles& triangles_;
  PictureRays rays_;
  Color background_;
  SamplePlaces places_;
  SampleOrder order_;
  SampleColors colors_;
  RayCaster centers_, samples_;
  std::uint64_t ray_count_ = 0;
  std::uint64_t covered_count_ = 0;
};

}  // namespace

TracedPicture::TracedPicture(const PictureRays& rays, Color background) : screen(rays.screen) {
  const std::size_t pixel_count =
      static_cast<std::size_t>(screen.rows) * static_cast<std::size_t>(screen.columns);
  if (rays.has_colors) colors.assign(pixel_count, background);
  if (rays.has_depths) depths.assign(pixel_count, screen.rear);
  if (rays.has_triangles) triangles.assign(pixel_count, -1);
}

TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, const PictureRays& rays,
                             const ColorSetup& colors, ThreadPool& pool) {
  TracedPicture picture(rays, colors.background);
  const Tiles tiles(rays.screen);
  std::vector<std::unique_ptr<PixelTracer>> tracers(static_cast<std::size_t>(pool.size()));
  Progress progress("trace", "ray");
  std::atomic<std::uint64_t> ray_count = 0;
  std::atomic<int> tile_count = 0;
  pool.start(tiles.count(), [&](int tile, int worker) {
    auto& tracer = tracers[static_cast<std::size_t>(worker)];
    if (!tracer) tracer = std::make_unique<PixelTracer>(scene, bvh, rays, colors);
    const std::uint64_t before = tracer->ray_count();
    tiles.for_each_pixel(
        tile, [&](int row, int column, std::size_t pixel) { tracer->trace(row, column, pixel, picture); });
    ray_count += tracer->ray_count() - before;
    ++tile_count;
    if (worker == 0) progress.show(ray_count, static_cast<double>(tile_count) / tiles.count());
  });
  pool.finish();
  picture.work.primary_rays = ray_count;
  for (const auto& tracer : tracers)
    if (tracer) tracer->add_up(picture);
  return picture;
}

}  // namespace pipeline
