#include "tools/trace/rendering.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/vertex/projected_header.h"
#include "tools/depth_files.h"
#include "tools/drawing_report.h"
#include "tools/empty_picture_note.h"
#include "tools/image_rows.h"
#include "tools/progress.h"
#include "tools/surface_shading.h"
#include "tools/view_report.h"

namespace pipeline {
namespace {

using Id = TracedTriangles::Id;

/// How long the parts of the work took, and how many rays there were.
struct Work {
  double build_seconds = 0;
  double cast_seconds = 0;
  std::uint64_t primary_rays = 0;
  std::uint64_t exact_decisions = 0;  // depths that were calculated exactly, or denied
  std::size_t node_count = 0;
};

class Stopwatch {
 public:
  /// The seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string to_text(const Work& work) {
  char text[160];
  std::snprintf(text, sizeof text,
                "build %.3f s, %.3g million primary rays at %.3g million a second, %.3g million exactly",
                work.build_seconds, static_cast<double>(work.primary_rays) / 1e6,
                static_cast<double>(work.primary_rays) / 1e6 / std::max(work.cast_seconds, 1e-9),
                static_cast<double>(work.exact_decisions) / 1e6);
  return text;
}

/// What the pixels of a screen show, row after row.
struct SeenPixels {
  SeenPixels(const Viewport& of_pixels, bool has_depths) : screen(of_pixels) {
    const std::size_t count =
        static_cast<std::size_t>(screen.rows) * static_cast<std::size_t>(screen.columns);
    ids.assign(count, KeptIds::kNoTriangle);
    if (has_depths) depths.assign(count, screen.rear);
  }
  [[nodiscard]] std::size_t begin(int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(screen.columns);
  }
  template <typename T>
  [[nodiscard]] std::span<const T> row_of(const std::vector<T>& entries, int row) const {
    return std::span(entries).subspan(begin(row), static_cast<std::size_t>(screen.columns));
  }

  Viewport screen;
  std::vector<Id> ids;
  std::vector<double> depths;  // empty if they are not requested
};

/// Casts a ray through every pixel.
void cast_all(const TracedTriangles& triangles, const Bvh& bvh, const ProjectionTransform& projection,
              ThreadPool& pool, SeenPixels& seen, Work& work) {
  // Rays near each other find the same boxes and triangles in the processor's caches.
  constexpr int kTile = 16;
  const Viewport& screen = seen.screen;
  const RayCaster caster(triangles, bvh, projection, screen);
  std::vector<std::unique_ptr<RayCaster::Thread>> threads(static_cast<std::size_t>(pool.size()));
  Progress progress("trace", "ray");
  std::atomic<std::uint64_t> ray_count = 0;
  const bool wants_depths = !seen.depths.empty();
  const auto cast = [&](RayCaster::Thread& thread, int row, int column) {
    const auto found = thread.cast(row, column, wants_depths);
    if (!found) return;
    const std::size_t pixel = seen.begin(row) + static_cast<std::size_t>(column);
    seen.ids[pixel] = found->id;
    if (wants_depths) seen.depths[pixel] = found->depth;
  };
  const int band_count = (screen.rows + kTile - 1) / kTile;
  pool.start(band_count, [&](int band, int worker) {
    auto& thread = threads[static_cast<std::size_t>(worker)];
    if (!thread) thread = std::make_unique<RayCaster::Thread>(caster);
    const int end_row = std::min((band + 1) * kTile, screen.rows);
    for (int left = 0; left < screen.columns; left += kTile)
      for (int row = band * kTile; row < end_row; ++row)
        for (int column = left; column < std::min(left + kTile, screen.columns); ++column)
          cast(*thread, row, column);
    ray_count +=
        static_cast<std::uint64_t>(end_row - band * kTile) * static_cast<std::uint64_t>(screen.columns);
    if (worker == 0) progress.show(ray_count);
  });
  pool.finish();
  for (const auto& thread : threads)
    if (thread) work.exact_decisions += thread->exact_count();
  work.primary_rays += ray_count;
}

/// The colors of rows of pixels, or of samples, by the triangles they show.
class RowColors {
 public:
  RowColors(const TracedTriangles& triangles, ExactProjection& projection,
            std::optional<SurfaceShader>& shader, Color background)
      : triangles_(triangles), shader_(shader), background_(background), surfaces_(triangles.size()) {
    projection_ = &projection;
  }

  /// Prepares the triangles that pixels show; all calls come before the first next().
  void add(const std::vector<Id>& ids) {
    if (shader_)
      for (const Id id : ids) surfaces_.keep(id);
  }
  void finish() {
    if (!shader_) return;
    surfaces_.renumber();
    TriangleBatch p_view;
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const auto id = static_cast<Id>(i);
      if (!surfaces_.is_kept(id)) continue;
      p_view.clear();
      triangles_.copy(id, p_view);
      const TriangleBatch& p_ndc = projection_->project(p_view);
      shader_->add(p_ndc, triangles_.piece(id).value_or(0), colors_.of(triangles_.number(id)));
    }
  }
  /// Those of the next row, valid until the next call.
  std::span<const Color> next(std::span<const Id> ids) {
    if (shader_) {
      shown_.resize(ids.size());
      std::ranges::transform(ids, shown_.begin(), [&](Id id) { return surfaces_.new_id(id); });
      return shader_->shade(row_number_++, shown_);
    }
    row_.resize(ids.size());
    std::ranges::transform(ids, row_.begin(), [&](Id id) {
      return id == KeptIds::kNoTriangle ? background_ : colors_.of(triangles_.number(id));
    });
    return row_;
  }

 private:
  const TracedTriangles& triangles_;
  ExactProjection* projection_;
  std::optional<SurfaceShader>& shader_;
  Color background_;
  KeptIds surfaces_;  // the shader's ids
  std::vector<SurfaceShader::SurfaceId> shown_;
  std::vector<Color> row_;
  TriangleColors colors_;
  int row_number_ = 0;
};

/// Writes image and depths. `samples` are those of the image, if a pixel has several.
void write_all(Tool& tool, const ZbufOptions& chosen, const SeenPixels& centers,
               const std::optional<SeenPixels>& samples, RowColors& colors) {
  const Viewport& screen = centers.screen;
  ImageRows image(chosen.image_path, screen, chosen.sample_count);
  DepthFiles depths(tool.output(), chosen.z_buffer_path, chosen.depth_image_path, screen);
  for (int row = 0; row < screen.rows; ++row)
    if (!centers.depths.empty()) depths.write_row(centers.row_of(centers.depths, row));
  const SeenPixels& shown = samples ? *samples : centers;
  for (int row = 0; row < shown.screen.rows && image.is_wanted(); ++row)
    image.write_row(colors.next(shown.row_of(shown.ids, row)));
  depths.close();
  image.close();
  tool.close_output();
  image.commit();
  depths.commit();
  if (chosen.summarizes) {
    const auto is_covered = [](Id id) { return id != KeptIds::kNoTriangle; };
    Tool::report(summary(chosen.image_path, screen,
                         static_cast<std::uint64_t>(std::ranges::count_if(centers.ids, is_covered))));
  }
  tool.timing().lap(&Timing::write_seconds);
}

/// Why the picture shows nothing: the notes of `project` and of `zbuf`.
std::optional<std::string> empty_picture_note(const ViewReport& view, const DrawingReport& drawing,
                                              const std::optional<SurfaceShader>& shader) {
  if (auto note = view.note()) return note;
  if (auto note = drawing.empty_picture_note()) return note;
  return shader ? invisible_colors_note(*shader) : std::nullopt;
}

void expect_room(const TracedTriangles& triangles) {
  if (triangles.size() > Bvh::kMaxPrimitives)
    throw std::runtime_error(
        expected_but_found("at most " + counted(Bvh::kMaxPrimitives, "triangle"), "more"));
}

}  // namespace

void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics) {
  const ZbufOptions& picture = chosen.picture;
  statistics.open();
  expect_kind(tool.input(), TextKind::view);
  StageReader reader(tool.input());
  expect_header(reader, TextKind::view);
  if (picture.framed) reader.expect_framed();
  const Located<Projection> given = chosen.projection->projection(reader, tool);
  const ProjectionTransform projection = clip_from_view(given);
  const StageHeader header = projected_header(reader.header(), given, projection);
  const SurfaceOptions surfaces = {
      .model = picture.shading, .wireframe = {}, .background = parse_color(picture.background)};
  std::optional<SurfaceShader> shader;
  if (picture.has_image())
    shader =
        surface_shader(header, reader.header_end(), sample_screen(screen, picture.sample_count), surfaces);

  ExactProjection exact(projection, tool.input().file(), header.projected.has_value());
  ViewReport view(exact.stage(), ViewVolume(projection), statistics.is_wanted());
  view.suspect_radians(given);
  const std::unique_ptr<DrawingReport> drawing = drawing_report(picture, screen, false);
  TracedTriangles triangles;
  for (TriangleBatch p_view; reader.read(p_view);) {
    tool.timing().triangle_count += p_view.size();
    triangles.add(p_view, exact, [&](const TriangleBatch& part, const TriangleBatch& p_ndc) {
      view.add(part, p_ndc);
      drawing->add(p_ndc);
    });
    expect_room(triangles);
  }
  tool.timing().lap(&Timing::read_seconds);

  Work work;
  Stopwatch watch;
  ThreadPool pool(chosen.thread_count());
  const bool has_samples = picture.sample_count > 1 && picture.has_image();
  const bool has_depths = picture.z_buffer_path != "none" || !picture.depth_image_path.empty();
  SeenPixels centers(screen, has_depths);
  std::optional<SeenPixels> samples;
  {
    const Bvh bvh = hierarchy_of(triangles, PixelRays(projection, screen), pool);
    work.node_count = bvh.node_count();
    work.build_seconds = watch.lap();
    if (has_depths || !has_samples || picture.summarizes)
      cast_all(triangles, bvh, projection, pool, centers, work);
    if (has_samples) {
      samples.emplace(sample_screen(screen, picture.sample_count), false);
      cast_all(triangles, bvh, projection, pool, *samples, work);
    }
    work.cast_seconds = watch.lap();
  }
  tool.timing().details = to_text(work);
  statistics.add("triangles", tool.timing().triangle_count);
  view.add_to(statistics);
  statistics.add("primary_rays", work.primary_rays);
  statistics.finish();
  tool.timing().lap(&Timing::work_seconds);

  RowColors colors(triangles, exact, shader, background_color(header.appearance, surfaces.background));
  const SeenPixels& shown = samples ? *samples : centers;
  colors.add(shown.ids);
  colors.finish();
  write_all(tool, picture, centers, samples, colors);
  statistics.commit();
  if (picture.has_image())
    if (const auto note = empty_picture_note(view, *drawing, shader)) tool.note(*note);
}

}  // namespace pipeline
