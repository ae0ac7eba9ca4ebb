#include "tools/trace/traced_picture.h"

#include <algorithm>
#include <atomic>

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

/// What the threads share.
struct Shared {
  const TracedTriangles& triangles;
  const RayCaster& centers;
  const RayCaster& samples;
  const SamplePlaces& places;
  const SampleOrder& order;
  const PictureRays& rays;
  Color background;
  bool casts_centers;
  bool shows_centers;  // the center's color is the pixel's
};

/// The rays of one thread.
class PixelTracer {
 public:
  PixelTracer(const Shared& shared, std::unique_ptr<SampleColors> colors)
      : shared_(shared), colors_(std::move(colors)), centers_(shared.centers), samples_(shared.samples) {}

  void trace(int row, int column, std::size_t pixel, TracedPicture& picture) {
    if (shared_.casts_centers) {
      ++ray_count_;
      if (const auto seen = centers_.cast(row, column, shared_.rays.has_depths)) {
        ++covered_count_;
        if (shared_.rays.has_depths) picture.depths[pixel] = seen->depth;
        if (shared_.rays.has_triangles)
          picture.triangles[pixel] = static_cast<std::int64_t>(shared_.triangles.number(seen->id));
        if (shared_.shows_centers) picture.colors[pixel] = colors_->color(row, column, *seen);
      }
    }
    if (shared_.rays.has_colors && !shared_.shows_centers) picture.colors[pixel] = mean_of(row, column);
  }
  [[nodiscard]] std::uint64_t ray_count() const { return ray_count_; }
  /// When all threads are done.
  void add_up(TracedPicture& picture, TraceWork& work) const {
    work.exact_decisions += centers_.exact_count() + samples_.exact_count();
    picture.covered_count += covered_count_;
    colors_->add_up();
  }

 private:
  Color mean_of(int row, int column) {
    std::span<const int> samples = shared_.order.samples();
    ColorMean mean;
    if (shared_.rays.sampling == Sampling::adaptive) {
      const std::size_t first_count = shared_.order.first_count();
      ColorRange range;
      for_each_color(row, column, samples.first(first_count), [&](Color color) {
        mean.add(color);
        range.add(color);
      });
      if (range.range() < shared_.rays.threshold) return mean.mean();
      samples = samples.subspan(first_count);
    }
    for_each_color(row, column, samples, [&](Color color) { mean.add(color); });
    return mean.mean();
  }
  template <typename Visitor>
  void for_each_color(int row, int column, std::span<const int> samples, Visitor&& visit) {
    ray_count_ += samples.size();
    for (const int sample : samples) {
      const auto place = shared_.places.of(row, column, sample);
      const auto seen = samples_.cast(place.row, place.column, false);
      visit(seen ? colors_->color(place.row, place.column, *seen) : shared_.background);
    }
  }

  const Shared& shared_;
  std::unique_ptr<SampleColors> colors_;
  RayCaster::Thread centers_;
  RayCaster::Thread samples_;
  std::uint64_t ray_count_ = 0;
  std::uint64_t covered_count_ = 0;
};

}  // namespace

TracedPicture::TracedPicture(const Viewport& of_pixels, const PictureRays& rays, Color background)
    : screen(of_pixels) {
  const std::size_t pixel_count =
      static_cast<std::size_t>(screen.rows) * static_cast<std::size_t>(screen.columns);
  if (rays.has_colors) colors.assign(pixel_count, background);
  if (rays.has_depths) depths.assign(pixel_count, screen.rear);
  if (rays.has_triangles) triangles.assign(pixel_count, -1);
}

TracedPicture traced_picture(const TracedScene& scene, const Bvh& bvh, const Viewport& screen,
                             const SamplePlaces& places, const PictureRays& rays, Color background,
                             const ColorsMaker& make_colors, ThreadPool& pool, TraceWork& work) {
  TracedPicture picture(screen, rays, background);
  const bool has_one_sample = rays.sample_count == 1 && !is_random(rays.sampling);
  const RayCaster centers(scene.triangles(), bvh, scene.projection(), screen);
  const RayCaster samples(scene.triangles(), bvh, scene.projection(), places.screen());
  const SampleOrder order(rays.sample_count);
  const Shared shared = {
      .triangles = scene.triangles(),
      .centers = centers,
      .samples = samples,
      .places = places,
      .order = order,
      .rays = rays,
      .background = background,
      .casts_centers = rays.has_depths || rays.has_triangles || rays.counts_covered || has_one_sample,
      .shows_centers = rays.has_colors && has_one_sample};
  const Tiles tiles(screen);
  std::vector<std::unique_ptr<PixelTracer>> tracers(static_cast<std::size_t>(pool.size()));
  Progress progress("trace", "ray");
  std::atomic<std::uint64_t> ray_count = 0;
  std::atomic<int> tile_count = 0;
  pool.start(tiles.count(), [&](int tile, int worker) {
    auto& tracer = tracers[static_cast<std::size_t>(worker)];
    if (!tracer) tracer = std::make_unique<PixelTracer>(shared, make_colors());
    const std::uint64_t before = tracer->ray_count();
    tiles.for_each_pixel(
        tile, [&](int row, int column, std::size_t pixel) { tracer->trace(row, column, pixel, picture); });
    ray_count += tracer->ray_count() - before;
    ++tile_count;
    if (worker == 0) progress.show(ray_count, static_cast<double>(tile_count) / tiles.count());
  });
  pool.finish();
  work.primary_rays = ray_count;
  for (const auto& tracer : tracers)
    if (tracer) tracer->add_up(picture, work);
  return picture;
}

}  // namespace pipeline
