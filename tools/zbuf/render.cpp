#include "tools/zbuf/render.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "libpipeline/certainty/certain_pixels.h"
#include "libpipeline/coverage/rules.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/text_kind.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/progress.h"
#include "tools/zbuf/colored_rows.h"
#include "tools/zbuf/drawing_report.h"
#include "tools/zbuf/fragment_report.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/sampled_drawing.h"
#include "tools/zbuf/screen.h"
#include "tools/zbuf/surface_shading.h"
#include "tools/zbuf/wireframe.h"

namespace pipeline {
namespace {

std::size_t pixel_count(const Viewport& screen) {
  return static_cast<std::size_t>(screen.columns) * static_cast<std::size_t>(screen.drawn_row_count());
}

/// The reports, which get every batch before it is drawn.
struct Reports {
  Reports(const ZbufOptions& chosen, const Viewport& screen, bool counts, TextWriter* fragment_log)
      : drawing(chosen.rules, screen, chosen.sample_count, counts), fragments(chosen, screen, fragment_log) {}

  DrawingReport drawing;
  FragmentReport fragments;
  std::optional<CertainPixels> certainty;

  void add(const TriangleBatch& p_ndc) {
    drawing.add(p_ndc);
    fragments.add(p_ndc);
    if (certainty) certainty->add(p_ndc);
  }
};

/// Reads the triangles batch by batch, hands each to the reports, and draws it.
void draw_all(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, StageReader& reader,
              Reports& reports, TriangleStore& store, SampledDrawing& drawing) {
  const Appearance& appearance = reader.header().appearance;
  const bool is_painted = appearance.is_painted();
  Progress progress("zbuf");
  if (store.keeps_text() && chosen.rules.depth_epsilon > 0)
    store.keep_where(NearestSoFar(chosen.rules, screen, chosen.sample_count));
  while (reader.read(drawing.next().batch)) {
    auto& [batch, tags] = drawing.next();
    if (is_painted) add_material_colors(appearance, batch);
    tool.timing().triangle_count += batch.size();
    tool.timing().lap(&Timing::read_seconds);
    reports.add(batch);
    store.set_tags(batch, tags);
    drawing.draw_next();
    if (chosen.algorithm != Algorithm::scanline && store.is_full()) {
      drawing.finish();
      store.keep_seen(drawing);
    }
    tool.timing().lap(&Timing::work_seconds);
    progress.show(tool.timing().triangle_count);
  }
  drawing.finish();
}

/// Writes the outputs. True if all pixels show one triangle.
bool write_all(PictureOutputs& outputs, const ZbufOptions& chosen, const Viewport& screen,
               const SampledDrawing& drawing, const StageReader& reader, TriangleStore& store,
               std::optional<SurfaceShader>& shader, std::optional<CertainPixels>& certainty) {
  // Lighting a sample by one light takes as long as drawing four.
  const std::size_t cost = shader ? 1 + 4 * shader->setup().lighting.lights.size() : 0;
  outputs.open(screen, chosen.sample_count, store.background_color());
  TextWriter* const seen_text = outputs.open_text(chosen.seen_path);
  TextWriter* const certainty_text = outputs.open_text(chosen.certainty_path);
  const Viewport of_samples = sample_screen(screen, chosen.sample_count);
  ColoredRows colors(store, shader, chosen.sample_count * screen.drawn_rows().first,
                     chosen.threads_for(cost * pixel_count(of_samples)), outputs);
  std::vector<std::int64_t> numbers;
  KeptIds seen(store.id_count());
  const auto mark = [&](std::span<const PixelTag> tags) {
    if (seen_text != nullptr) std::ranges::for_each(tags, [&](PixelTag id) { seen.keep(id); });
  };
  std::uint64_t covered_count = 0;
  std::optional<PixelTag> only;  // the tag of all pixels so far
  bool is_one = true;
  int number = screen.drawn_rows().first;
  std::vector<Ball> exact;
  drawing.centers().for_each_row([&](const VisibleRow& row) {
    mark(row.tags);
    if (!only) only = row.tags.front();
    is_one = is_one && only != store.background() &&
             std::ranges::all_of(row.tags, [&](PixelTag tag) { return tag == *only; });
    store.set_exact_depths(number++, row.tags, exact);
    outputs.write_depths(row.depths, exact);
    if (outputs.wants_triangles() || certainty) store.set_numbers(row.tags, numbers);
    if (outputs.wants_triangles()) outputs.write_triangles(numbers);
    if (certainty) certainty->add_row(numbers);
    if (chosen.summarizes)
      covered_count += static_cast<std::uint64_t>(
          std::ranges::count_if(row.depths, [&](double depth) { return depth < screen.rear; }));
    if (drawing.samples() == nullptr && outputs.wants_colors()) colors.add(row);
  });
  if (drawing.samples() != nullptr) {
    drawing.samples()->for_each_row([&](const VisibleRow& row) {
      mark(row.tags);
      if (outputs.wants_colors()) colors.add(row);
    });
  }
  colors.finish();
  if (seen_text != nullptr) store.write_seen(*seen_text, reader, seen);
  if (certainty) certainty_text->append(certainty->report());
  outputs.finish(covered_count);
  return is_one;
}

/// Notes an empty or a squeezed picture. Notes are about the whole picture: a band of it may well show
/// nothing.
void note_odd_picture(const Tool& tool, const ZbufOptions& chosen, const DrawingReport& report,
                      const Viewport& screen, const std::optional<SurfaceShader>& shader,
                      const StageHeader& header, bool shows_one_triangle) {
  constexpr std::size_t kLargePicture = 1000;  // pixels; a smaller one may well show one triangle
  if (const auto note = opaque_note(header.appearance)) tool.note(*note);
  std::optional<std::string> note;
  const ShownColors shown = shader ? shader->shown() : ShownColors();
  if (!chosen.wireframe || shown.visible == 0) note = report.empty_picture_note();
  const bool is_whole = screen.drawn_row_count() == screen.rows;
  const bool is_known = bright_light_note(header.appearance).has_value();  // model has noted it
  if (!note && shader && is_whole)
    note = odd_colors_note(shown, {shader->setup().background, chosen.wireframe, is_known});
  if (!note && is_whole && shows_one_triangle && !chosen.wireframe && pixel_count(screen) >= kLargePicture)
    note =
        "one triangle fills the picture, and no edge is in view: it is too large or too near, or fovY too "
        "small";
  if (!note && shader && is_whole && !is_known && !chosen.wireframe && shown.first && !shown.is_varied &&
      !shader->is_plane())
    note = "all that is drawn has one color, so only its outline shows: " +
           std::string(shader->is_lit() ? "does a light reach the side that is seen?"
                                        : "give it a light, or triangles their own colors");
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
    // The visible triangles leave out others that may be visible within the bounds.
    if (reader.header().bounds) throw UsageError("--seen", "a text without bounds", "'bounds'");
    reader.keep_text();
  }
  return reader;
}

CertainPixels certain_pixels(const StageReader& reader, const Viewport& screen) {
  const StageHeader& header = reader.header();
  if (!header.bounds || !header.bounds->value.rounded || !header.projected || !header.appearance.columns().w)
    throw InputError(reader.header_end(),
                     "a text with 'bounds', 'projected' and the column 'w' for --certify "
                     "(model --bounds, and stages that keep them)",
                     "none");
  return {screen, header.bounds->value, header.projected->value};
}

TriangleStore::Setup kept(const ZbufOptions& chosen, const Appearance& appearance, const Viewport& screen) {
  const Viewport of_samples = sample_screen(screen, chosen.sample_count);
  const bool shows_edges = chosen.wireframe && (chosen.has_image() || !chosen.seen_path.empty());
  const Wireframe::Setup edges = {chosen.has_all_edges, !appearance.lights.empty(), chosen.sample_count};
  // With wider limits, depths in doubles may have too few digits for the decimals written (F5).
  constexpr double kMaxDepthInDoubles = 1000;
  const bool needs_exact_depths = !(chosen.z_buffer_path == "none" && chosen.depth_array_path.empty()) &&
                                  std::max(-screen.front, screen.rear) > kMaxDepthInDoubles &&
                                  std::holds_alternative<TypeValue<DepthF64>>(chosen.rules.depth);
  return {.keeps_text = !chosen.seen_path.empty(),
          .keeps_numbers = !chosen.triangle_array_path.empty() || !chosen.certainty_path.empty(),
          .exact_depths = needs_exact_depths
                              ? std::optional(CoverageRules::made(chosen.rules.coverage, screen))
                              : std::nullopt,
          .background = background_color(appearance, parse_color(chosen.background)),
          .pixel_count = pixel_count(of_samples),
          .wireframe = shows_edges ? std::make_unique<Wireframe>(chosen.rules, of_samples, edges) : nullptr};
}

}  // namespace

void render(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics) {
  PictureOutputs outputs(tool, chosen, statistics);
  const bool uses_decimals =
      chosen.wireframe ||
      std::visit([]<typename Rule>(TypeValue<Rule>) { return Rule::kUsesDecimals; }, chosen.rules.coverage);
  StageReader reader = opened(tool, chosen, uses_decimals);
  const Viewport of_samples = sample_screen(screen, chosen.sample_count);
  std::optional<SurfaceShader> shader;
  if (chosen.has_image())
    shader = surface_shader(reader.header(), reader.header_end(), of_samples, chosen, chosen.wireframe);
  tool.timing().lap(&Timing::read_seconds);
  Reports reports(chosen, screen, statistics.is_wanted(), outputs.open_text(chosen.fragments_path, false));
  if (!chosen.certainty_path.empty()) reports.certainty = certain_pixels(reader, screen);
  TriangleStore store(kept(chosen, reader.header().appearance, screen), shader);
  const bool is_one_by_one = chosen.algorithm == Algorithm::scanline;
  ThreadPool pool(is_one_by_one ? 1 : chosen.threads_for(pixel_count(of_samples)));
  SampledDrawing drawing(chosen, screen, store.background(), pool);
  tool.timing().lap(&Timing::work_seconds);
  draw_all(tool, chosen, screen, reader, reports, store, drawing);
  reports.fragments.finish();
  reports.drawing.add_to(statistics);
  outputs.close_reports();
  tool.timing().lap(&Timing::work_seconds);
  const bool shows_one_triangle =
      write_all(outputs, chosen, screen, drawing, reader, store, shader, reports.certainty);
  if (chosen.has_image())
    note_odd_picture(tool, chosen, reports.drawing, screen, shader, reader.header(), shows_one_triangle);
}

}  // namespace pipeline
