#include "tools/zbuf/render.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/read_ahead.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/triangle_drawing.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/progress.h"
#include "tools/zbuf/all_edges.h"
#include "tools/zbuf/colored_rows.h"
#include "tools/zbuf/drawing_report.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"
#include "tools/zbuf/triangle_store.h"

namespace pipeline {
namespace {

/// Reads the triangles into `batch()`, batch by batch, hands each to the report and calls `draw()`.
template <typename Source, typename Batch, typename Draw>
void for_each_batch(Tool& tool, Source& source, DrawingReport& report, Batch&& batch, Draw&& draw) {
  Progress progress("zbuf");
  while (source.read(batch())) {
    tool.timing().triangle_count += batch().size();
    tool.timing().lap(&Timing::read_seconds);
    report.add(batch());
    draw();
    tool.timing().lap(&Timing::work_seconds);
    progress.show(tool.timing().triangle_count);
  }
}

/// The visible triangles at the pixel centers and, with several samples a pixel, at the samples.
template <VisibilityAlgorithm Visible>
struct SampledVisible {
  SampledVisible(const Viewport& of_centers, int sample_count, PixelTag background)
      : center_screen(of_centers),
        screen(sample_screen(of_centers, sample_count)),
        centers(of_centers, background) {
    if (sample_count > 1) samples.emplace(screen, background);
  }

  Viewport center_screen;
  Viewport screen;  // of the samples; of the centers if there is one sample a pixel
  Visible centers;
  std::optional<Visible> samples;
};

/// Whether a triangle is nearer than all before it somewhere. Under a depth epsilon any other may be left
/// out: a fragment that is drawn over one of depth c is nearer than c by more than epsilon, and none before
/// it is.
template <typename CoverageRule, typename Depth>
class NearestSoFar {
 public:
  template <typename Visible>
  explicit NearestSoFar(const SampledVisible<Visible>& visible) : at_centers_(visible.center_screen) {
    if (visible.samples) at_samples_.emplace(visible.screen);
  }

  /// True if the next triangle is.
  bool add(const ExactTriangle& p_ndc) {
    bool is_nearest = false;
    const auto look_at = [&](const Fragment& fragment) {
      is_nearest |= fragment.result == DepthTestResult::kept;
    };
    at_centers_.add(p_ndc, 0, look_at);
    if (at_samples_) at_samples_->add(p_ndc, 0, look_at);
    return is_nearest;
  }

 private:
  FragmentLog<CoverageRule, Depth> at_centers_;
  std::optional<FragmentLog<CoverageRule, Depth>> at_samples_;
};

template <typename CoverageRule, typename Depth>
void draw_all(Tool& tool, const ZbufOptions& chosen, StageReader& reader, TriangleStore& store,
              DrawingReport& report, SampledVisible<ZBufferAlgorithm<CoverageRule, Depth>>& visible) {
  using Drawing = TriangleDrawing<ZBufferAlgorithm<CoverageRule, Depth>>;
  visible.centers.set_depth_epsilon(chosen.depth_epsilon);
  ThreadPool pool(chosen.thread_count);
  Drawing centers(visible.centers, visible.center_screen, pool);
  std::optional<Drawing> samples;
  if (visible.samples) {
    visible.samples->set_depth_epsilon(chosen.depth_epsilon);
    samples.emplace(*visible.samples, visible.screen, pool);
  }
  std::vector<PixelTag> tags;
  std::optional<NearestSoFar<CoverageRule, Depth>> nearest;
  if (store.keeps_text() && chosen.depth_epsilon > 0) nearest.emplace(visible);
  const auto tag_of = [&](const TriangleBatch& p_ndc, std::size_t i) { return store.tag_of(p_ndc, i); };
  const auto draw_batch = [&] {
    if (!samples) return centers.draw_batch(tag_of);
    TriangleBatch& batch = samples->next_batch() = centers.next_batch();
    tags.clear();
    for (std::size_t i = 0; i < batch.size(); ++i) tags.push_back(tag_of(batch, i));
    const auto kept_tag = [&](const TriangleBatch&, std::size_t i) { return tags[i]; };
    centers.draw_batch(kept_tag);
    samples->draw_batch(kept_tag);
  };
  std::vector<std::uint8_t> winners, needed;
  const auto draw_and_keep_texts = [&] {
    const TriangleBatch& batch = centers.next_batch();
    const KeptIds::Id first_id = store.next_id();
    needed.clear();
    for (std::size_t i = 0; nearest && i < batch.size(); ++i)
      needed.push_back(nearest->add(exact_triangle(batch, i)) ? 1 : 0);
    if (samples || !centers.draws_at_once()) {
      store.add_texts(batch, first_id, {}, needed);
      return draw_batch();
    }
    centers.finish();  // only this batch is marked
    winners.assign(batch.size(), 0);
    visible.centers.mark_winners(first_id, winners.data());
    draw_batch();
    visible.centers.mark_winners(0, nullptr);
    store.add_texts(batch, first_id, winners, needed);
  };
  const auto finish = [&] {
    centers.finish();
    if (samples) samples->finish();
  };
  const auto draw = [&] {
    if (store.keeps_text())
      draw_and_keep_texts();
    else
      draw_batch();
    if (!store.is_full()) return;
    finish();
    store.keep_seen([&](const auto& visit) {
      if (!visible.samples || store.keeps_text()) visible.centers.for_each_drawn_tag(visit);
      if (visible.samples) visible.samples->for_each_drawn_tag(visit);
    });
  };
  ReadAhead ahead(reader, pool);
  for_each_batch(
      tool, ahead, report, [&]() -> TriangleBatch& { return centers.next_batch(); }, draw);
  finish();
}

template <typename CoverageRule, typename Depth>
void draw_all(Tool& tool, const ZbufOptions&, StageReader& reader, TriangleStore& store,
              DrawingReport& report, SampledVisible<ScanlineAlgorithm<CoverageRule, Depth>>& visible) {
  TriangleBatch p_ndc;
  const auto draw = [&] {
    if (store.keeps_text()) store.add_texts(p_ndc, store.next_id(), {}, {});
    for (std::size_t i = 0; i < p_ndc.size(); ++i) {
      const PixelTag tag = store.tag_of(p_ndc, i);
      visible.centers.draw(exact_triangle(p_ndc, i), tag);
      if (visible.samples) visible.samples->draw(exact_triangle(p_ndc, i), tag);
    }
  };
  for_each_batch(
      tool, reader, report, [&]() -> TriangleBatch& { return p_ndc; }, draw);
}

template <VisibilityAlgorithm Visible>
void write_all(Tool& tool, const ZbufOptions& chosen, const SampledVisible<Visible>& visible,
               const StageReader& reader, TriangleStore& store, std::optional<SurfaceShader>& shader,
               AllEdges* edges) {
  const Viewport& screen = visible.center_screen;
  PictureOutputs outputs(tool, chosen, screen, chosen.sample_count, store.background_color());
  ColoredRows colors(store, shader, edges, chosen.sample_count * screen.drawn_rows().first,
                     chosen.thread_count, outputs);
  std::vector<std::int64_t> numbers;
  KeptIds seen(store.id_count());
  const auto mark = [&](std::span<const PixelTag> tags) {
    if (outputs.seen() != nullptr) std::ranges::for_each(tags, [&](PixelTag id) { seen.keep(id); });
  };
  std::uint64_t covered_count = 0;
  visible.centers.for_each_row([&](const VisibleRow& row) {
    mark(row.tags);
    outputs.write_depths(row.depths);
    if (outputs.wants_triangles()) outputs.write_triangles(store.numbers_of(row.tags, numbers));
    if (chosen.summarizes)
      covered_count += static_cast<std::uint64_t>(
          std::ranges::count_if(row.depths, [&](double depth) { return depth < screen.rear; }));
    if (!visible.samples && outputs.wants_colors()) colors.add(row.tags);
  });
  if (visible.samples) {
    visible.samples->for_each_row([&](const VisibleRow& row) {
      mark(row.tags);
      if (outputs.wants_colors()) colors.add(row.tags);
    });
  }
  colors.finish();
  if (outputs.seen() != nullptr) store.write_seen(*outputs.seen(), reader, seen);
  outputs.finish(covered_count);
}

/// That the picture is empty, or squeezed. The note is about the whole picture; a band of it may well show
/// nothing.
void note_odd_picture(const Tool& tool, const DrawingReport& report, const Viewport& screen,
                      const std::optional<SurfaceShader>& shader,
                      const std::optional<Located<Projection>>& projected) {
  std::optional<std::string> note = report.empty_picture_note();
  const bool is_whole = screen.drawn_row_count() == screen.rows;
  if (!note && shader && is_whole) note = invisible_colors_note(*shader);
  if (!note && projected) note = squeezed_note_of_projected(projected->value, screen);
  if (note) tool.note(*note);
}

std::size_t pixel_count(const Viewport& screen) {
  return static_cast<std::size_t>(screen.columns) * static_cast<std::size_t>(screen.drawn_row_count());
}

template <VisibilityAlgorithm Visible>
void render_with(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics) {
  statistics.open();
  expect_kind(tool.input(), TextKind::ndc);
  StageReader reader(tool.input(), Visible::CoverageRule::kUsesDecimals);
  expect_header(reader, TextKind::ndc);
  reader.accept_clipped();
  if (chosen.framed) reader.expect_framed();
  if (!chosen.seen_path.empty()) reader.keep_text();
  const Viewport shaded_screen = sample_screen(screen, chosen.sample_count);
  SurfaceOptions surfaces;
  surfaces.model = chosen.shading;
  surfaces.background = parse_color(chosen.background);
  surfaces.holds_alpha = chosen.has_image() && can_hold_alpha(chosen.image_path);
  if (chosen.wireframe) surfaces.wireframe = {screen.dx(), screen.dy()};
  std::optional<SurfaceShader> shader;
  if (chosen.has_image())
    shader = surface_shader(reader.header(), reader.header_end(), shaded_screen, surfaces);
  tool.timing().lap(&Timing::read_seconds);
  const std::unique_ptr<FragmentReport> fragments = fragment_report(chosen, screen);
  const std::unique_ptr<DrawingReport> report = drawing_report(chosen, screen, statistics.is_wanted());
  TriangleStore::Setup kept;
  kept.keeps_text = !chosen.seen_path.empty();
  kept.keeps_numbers = !chosen.triangle_array_path.empty();
  kept.background = background_color(reader.header().appearance, surfaces.background);
  kept.pixel_count = pixel_count(shaded_screen);
  const std::unique_ptr<AllEdges> edges = all_edges(chosen, shaded_screen);
  kept.edges = edges.get();
  TriangleStore store(kept, shader, fragments.get());
  SampledVisible<Visible> visible(screen, chosen.sample_count, store.background());
  tool.timing().lap(&Timing::work_seconds);
  draw_all(tool, chosen, reader, store, *report, visible);
  if (fragments) fragments->finish();
  report->add_to(statistics);
  statistics.finish();
  tool.timing().lap(&Timing::work_seconds);
  write_all(tool, chosen, visible, reader, store, shader, edges.get());
  if (fragments) fragments->commit();
  statistics.commit();
  if (chosen.has_image()) {
    if (const auto note = opaque_note(reader.header().appearance)) tool.note(*note);
    note_odd_picture(tool, *report, screen, shader, reader.header().projected);
  }
}

}  // namespace

void render(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics) {
  dispatch(chosen, [&]<typename Rule, typename Depth>() {
    switch (chosen.algorithm) {
      case Algorithm::zbuffer:
        return render_with<ZBufferAlgorithm<Rule, Depth>>(tool, chosen, screen, statistics);
      case Algorithm::scanline:
        return render_with<ScanlineAlgorithm<Rule, Depth>>(tool, chosen, screen, statistics);
    }
  });
}

}  // namespace pipeline
