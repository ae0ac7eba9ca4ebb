#include "tools/render.h"

#include <optional>

#include "libpipeline/band_drawing.h"
#include "libpipeline/color.h"
#include "libpipeline/coverage.h"
#include "libpipeline/depth_text.h"
#include "libpipeline/image_file.h"
#include "libpipeline/output_file.h"
#include "libpipeline/stage_text.h"
#include "libpipeline/visibility.h"
#include "tools/progress.h"

namespace pipeline {
namespace {

/// Reads the triangles: `batch()` is where the next ones go, `draw()` draws them.
template <typename Batch, typename Draw>
void for_each_batch(Tool& tool, Coverage coverage, Batch&& batch, Draw&& draw) {
  StageReader reader(tool.input(), coverage == Coverage::center);
  Progress progress("zbuf");
  while (reader.read(batch())) {
    tool.timing().triangle_count += batch().size();
    tool.timing().lap(&Timing::read_seconds);
    draw();
    tool.timing().lap(&Timing::work_seconds);
    progress.show(tool.timing().triangle_count);
  }
}

template <typename CoverageRule, typename Depth>
void draw_all(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen,
              ZBufferAlgorithm<CoverageRule, Depth>& visible) {
  BandDrawing drawing(visible, screen, chosen.thread_count);
  for_each_batch(
      tool, chosen.coverage, [&]() -> TriangleBatch& { return drawing.next_batch(); }, [&] { drawing.draw_batch(); });
  drawing.finish();
}

template <typename CoverageRule, typename Depth>
void draw_all(Tool& tool, const RenderOptions& chosen, const ScreenConfig&,
              ScanlineAlgorithm<CoverageRule, Depth>& visible) {
  TriangleColors colors;
  TriangleBatch p_ndc;
  const auto draw = [&] {
    for (std::size_t i = 0; i < p_ndc.size(); ++i) visible.draw(exact_triangle(p_ndc, i), colors.of(p_ndc.numbers[i]));
  };
  for_each_batch(tool, chosen.coverage, [&]() -> TriangleBatch& { return p_ndc; }, draw);
}

template <VisibilityAlgorithm Visible>
void write_all(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen, const Visible& visible) {
  OutputFile image(chosen.image_path);
  ImageWriter pixels(image.descriptor(), chosen.image_path, image_format_of(chosen.image_path),
                     screen.columns, screen.rows);
  std::optional<OutputFile> z_buffer;
  std::optional<TextWriter> z_buffer_text;
  if (chosen.z_buffer_path != "-") {
    z_buffer.emplace(chosen.z_buffer_path);
    z_buffer_text.emplace(z_buffer->descriptor(), chosen.z_buffer_path);
  }
  TextWriter& depths = z_buffer_text ? *z_buffer_text : tool.output();
  visible.for_each_row([&](const VisibleRow& row) {
    write_depth_row(depths, row.depths, screen.rear);
    pixels.write_row(row.colors);
  });
  depths.flush();
  pixels.finish();
  if (z_buffer) z_buffer->close();
  image.commit();
  if (z_buffer) z_buffer->commit();
  tool.timing().lap(&Timing::write_seconds);
}

template <VisibilityAlgorithm Visible>
void render_with(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen) {
  Visible visible(screen);
  tool.timing().lap(&Timing::work_seconds);
  draw_all(tool, chosen, screen, visible);
  tool.timing().lap(&Timing::work_seconds);
  write_all(tool, chosen, screen, visible);
}

template <typename CoverageRule, typename Depth>
void render_with(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen) {
  switch (chosen.algorithm) {
    case Algorithm::zbuffer:
      return render_with<ZBufferAlgorithm<CoverageRule, Depth>>(tool, chosen, screen);
    case Algorithm::scanline:
      return render_with<ScanlineAlgorithm<CoverageRule, Depth>>(tool, chosen, screen);
  }
}

template <typename Depth>
void render_in(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen) {
  switch (chosen.coverage) {
    case Coverage::nearest:
      return render_with<NearestCoverage, Depth>(tool, chosen, screen);
    case Coverage::center:
      return render_with<CenterCoverage, Depth>(tool, chosen, screen);
  }
}

}  // namespace

void render(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen) {
  switch (chosen.depth) {
    case DepthFormat::f64:
      return render_in<DepthF64>(tool, chosen, screen);
    case DepthFormat::f32:
      return render_in<DepthF32>(tool, chosen, screen);
    case DepthFormat::u24:
      return render_in<DepthU24>(tool, chosen, screen);
  }
}

}  // namespace pipeline
