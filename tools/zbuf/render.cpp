#include "tools/zbuf/render.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "libpipeline/coverage/exact_depth.h"
#include "libpipeline/coverage/rules.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/read_ahead.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/text_kind.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/progress.h"
#include "tools/zbuf/all_edges.h"
#include "tools/zbuf/certainty_report.h"
#include "tools/zbuf/colored_rows.h"
#include "tools/zbuf/drawing_report.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/sampled_drawing.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"

namespace pipeline {
namespace {

// Where limits are wider, the doubles of depths may have too few digits for the decimals written (F5).
constexpr double kMaxDepthInDoubles = 1000;

std::size_t pixel_count(const Viewport& screen) {
  return static_cast<std::size_t>(screen.columns) * static_cast<std::size_t>(screen.drawn_row_count());
}

/// Who takes every batch before it is drawn.
struct Reports {
  std::unique_ptr<DrawingReport> drawing;
  std::optional<CertaintyReport> certainty;  // as far as it is requested

  void add(const TriangleBatch& p_ndc) {
    drawing->add(p_ndc);
    if (certainty) certainty->add(p_ndc);
  }
};

/// Reads the triangles into `batch()`, batch by batch, hands each to the reports and calls `draw()`.
template <typename Source, typename Batch, typename Draw>
void for_each_batch(Tool& tool, Source& source, const Appearance& appearance, Reports& reports, Batch&& batch,
                    Draw&& draw) {
  Progress progress("zbuf");
  const bool is_painted = appearance.is_painted();
  while (source.read(batch())) {
    if (is_painted) add_material_colors(appearance, batch());
    tool.timing().triangle_count += batch().size();
    tool.timing().lap(&Timing::read_seconds);
    reports.add(batch());
    draw();
    tool.timing().lap(&Timing::work_seconds);
    progress.show(tool.timing().triangle_count);
  }
}

// Not inlined: in a function of their own, the compiler inlines more of what the loops call.
template <typename CoverageRule, typename Depth>
[[gnu::noinline]] void draw_all(Tool& tool, const ZbufOptions& chosen, StageReader& reader,
                                TriangleStore& store, Reports& reports,
                                SampledVisible<ZBufferAlgorithm<CoverageRule, Depth>>& visible) {
  visible.set_depth_epsilon(chosen.rules.depth_epsilon);
  ThreadPool pool(chosen.threads_for(pixel_count(visible.screen)));
  SampledDrawing drawing(visible, store, pool);
  if (store.keeps_text() && chosen.rules.depth_epsilon > 0)
    store.keep_where(NearestSoFar<CoverageRule, Depth>(visible));
  const auto draw = [&] {
    drawing.draw_batch();
    if (!store.is_full()) return;
    drawing.finish();
    store.keep_seen([&](const auto& visit) {
      visible.centers.for_each_drawn_tag(visit);
      if (visible.samples) visible.samples->for_each_drawn_tag(visit);
    });
  };
  ReadAhead ahead(reader, pool);
  for_each_batch(
      tool, ahead, reader.header().appearance, reports,
      [&]() -> TriangleBatch& { return drawing.next_batch(); }, draw);
  drawing.finish();
}

template <typename CoverageRule, typename Depth>
[[gnu::noinline]] void draw_all(Tool& tool, const ZbufOptions&, StageReader& reader, TriangleStore& store,
                                Reports& reports,
                                SampledVisible<ScanlineAlgorithm<CoverageRule, Depth>>& visible) {
  TriangleBatch p_ndc;
  const auto draw = [&] {
    for (std::size_t i = 0; i < p_ndc.size(); ++i) {
      const PixelTag tag = store.tag_of(p_ndc, i);
      visible.centers.draw(exact_triangle(p_ndc, i), tag);
      if (visible.samples) visible.samples->draw(exact_triangle(p_ndc, i), tag);
    }
  };
  for_each_batch(
      tool, reader, reader.header().appearance, reports, [&]() -> TriangleBatch& { return p_ndc; }, draw);
}

/// The depths of a row exactly; meaningless where no triangle is seen.
template <typename Coverage>
void set_exact_depths(const Coverage& rule, const TriangleStore& store, int row,
                      std::span<const PixelTag> ids, std::vector<Ball>& depths) {
  depths.resize(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == KeptIds::kNoTriangle) continue;
    const auto& [p, low_parts, marks] = store.corners(ids[i]);
    const bool is_flat = p[0].z == p[1].z && p[0].z == p[2].z;
    depths[i] = is_flat ? Ball(p[0].z) : exact_depth(rule, {p, &low_parts, marks}, row, static_cast<int>(i));
  }
}

template <VisibilityAlgorithm Visible>
[[gnu::noinline]] void write_all(PictureOutputs& outputs, const ZbufOptions& chosen,
                                 const SampledVisible<Visible>& visible, const StageReader& reader,
                                 TriangleStore& store, std::optional<SurfaceShader>& shader, AllEdges* edges,
                                 std::optional<CertaintyReport>& certainty) {
  const Viewport& screen = visible.center_screen;
  // To light a sample by one light takes as long as to draw four.
  const std::size_t cost = shader ? 1 + 4 * shader->setup().lighting.lights.size() : 0;
  outputs.open(screen, chosen.sample_count, store.background_color());
  TextWriter* const seen_text = outputs.open_text(chosen.seen_path);
  TextWriter* const certainty_text = outputs.open_text(chosen.certainty_path);
  ColoredRows colors(store, shader, edges, chosen.sample_count * screen.drawn_rows().first,
                     chosen.threads_for(cost * pixel_count(visible.screen)), outputs);
  std::vector<std::int64_t> numbers;
  KeptIds seen(store.id_count());
  const auto mark = [&](std::span<const PixelTag> tags) {
    if (seen_text != nullptr) std::ranges::for_each(tags, [&](PixelTag id) { seen.keep(id); });
  };
  std::uint64_t covered_count = 0;
  const typename Visible::CoverageRule rule(screen);
  int number = screen.drawn_rows().first;
  std::vector<Ball> exact;
  visible.centers.for_each_row([&](const VisibleRow& row) {
    mark(row.tags);
    if (store.keeps_corners()) set_exact_depths(rule, store, number++, row.tags, exact);
    outputs.write_depths(row.depths, exact);
    if (outputs.wants_triangles()) outputs.write_triangles(store.numbers_of(row.tags, numbers));
    if (certainty) certainty->add_row(row.tags, store);
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
  if (seen_text != nullptr) store.write_seen(*seen_text, reader, seen);
  if (certainty) certainty->write(*certainty_text);
  outputs.finish(covered_count);
}

/// That the picture is empty, or squeezed. The note is about the whole picture; a band of it may well show
/// nothing.
void note_odd_picture(const Tool& tool, const DrawingReport& report, const Viewport& screen,
                      const std::optional<SurfaceShader>& shader, const StageHeader& header) {
  if (const auto note = opaque_note(header.appearance)) tool.note(*note);
  std::optional<std::string> note = report.empty_picture_note();
  const bool is_whole = screen.drawn_row_count() == screen.rows;
  if (!note && shader && is_whole) note = invisible_colors_note(*shader);
  if (!note && header.projected) note = squeezed_note_of_projected(header.projected->value, screen);
  if (note) tool.note(*note);
}

StageReader opened(Tool& tool, const ZbufOptions& chosen, bool uses_decimals) {
  expect_kind(tool.input(), TextKind::ndc);
  StageReader reader(tool.input(), uses_decimals);
  expect_header(reader, TextKind::ndc);
  reader.accept_clipped();
  if (chosen.framed) reader.expect_framed();
  if (!chosen.seen_path.empty()) {
    // What is seen leaves out triangles that might be.
    if (reader.header().bounds)
      throw UsageError("--seen: " + expected_but_found("a text without bounds", "'bounds'"));
    reader.keep_text();
  }
  return reader;
}

TriangleStore::Setup kept(const ZbufOptions& chosen, const StageReader& reader, const Viewport& of_samples,
                          AllEdges* edges) {
  return {.keeps_text = !chosen.seen_path.empty(),
          .keeps_numbers = !chosen.triangle_array_path.empty() || !chosen.certainty_path.empty(),
          .keeps_corners = chosen.z_buffer_path != "none" &&
                           std::max(-of_samples.front, of_samples.rear) > kMaxDepthInDoubles &&
                           std::holds_alternative<TypeValue<DepthF64>>(chosen.rules.depth),
          .background = background_color(reader.header().appearance, parse_color(chosen.background)),
          .pixel_count = pixel_count(of_samples),
          .edges = edges};
}

template <VisibilityAlgorithm Visible>
void render_with(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics) {
  PictureOutputs outputs(tool, chosen, statistics);
  StageReader reader = opened(tool, chosen, Visible::CoverageRule::kUsesDecimals);
  const Viewport of_samples = sample_screen(screen, chosen.sample_count);
  SurfaceOptions surfaces = surface_options(chosen);
  if (chosen.wireframe) surfaces.wireframe = {screen.dx(), screen.dy()};
  std::optional<SurfaceShader> shader;
  if (chosen.has_image()) shader = surface_shader(reader.header(), reader.header_end(), of_samples, surfaces);
  tool.timing().lap(&Timing::read_seconds);
  const auto fragments = fragment_report(chosen, screen, outputs.open_fragments(chosen.fragments_path));
  Reports reports = {drawing_report(chosen.rules, screen, chosen.sample_count, statistics.is_wanted()), {}};
  if (!chosen.certainty_path.empty()) reports.certainty.emplace(reader, screen);
  const std::unique_ptr<AllEdges> edges = all_edges(chosen, of_samples);
  TriangleStore store(kept(chosen, reader, of_samples, edges.get()), shader, fragments.get());
  SampledVisible<Visible> visible(screen, chosen.sample_count, store.background());
  tool.timing().lap(&Timing::work_seconds);
  draw_all(tool, chosen, reader, store, reports, visible);
  if (fragments) fragments->finish();
  reports.drawing->add_to(statistics);
  outputs.close_reports();
  tool.timing().lap(&Timing::work_seconds);
  write_all(outputs, chosen, visible, reader, store, shader, edges.get(), reports.certainty);
  if (chosen.has_image()) note_odd_picture(tool, *reports.drawing, screen, shader, reader.header());
}

}  // namespace

void render(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics) {
  dispatch(chosen.rules, [&]<typename Rule, typename Depth>() {
    switch (chosen.algorithm) {
      case Algorithm::zbuffer:
        return render_with<ZBufferAlgorithm<Rule, Depth>>(tool, chosen, screen, statistics);
      case Algorithm::scanline:
        return render_with<ScanlineAlgorithm<Rule, Depth>>(tool, chosen, screen, statistics);
    }
  });
}

}  // namespace pipeline
