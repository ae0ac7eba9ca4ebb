#include "tools/render.h"

#include <memory>
#include <optional>

#include "libpipeline/band_drawing.h"
#include "libpipeline/color.h"
#include "libpipeline/coverage.h"
#include "libpipeline/depth_text.h"
#include "libpipeline/image_file.h"
#include "libpipeline/output_file.h"
#include "libpipeline/stage_reader.h"
#include "libpipeline/surface_shader.h"
#include "libpipeline/visibility.h"
#include "tools/fragment_report.h"
#include "tools/progress.h"
#include "tools/shading_options.h"

namespace pipeline {
namespace {

/// What a triangle is drawn with: its colour, or what its pixels are shaded by later. It is asked for every
/// triangle in the order of the stream, and tells `report`, if there is one, of each.
class Paint {
 public:
  Paint(std::optional<SurfaceShader>& shader, FragmentReport* report) : shader_(shader), report_(report) {}
  Color operator()(const TriangleBatch& p_ndc, std::size_t index) {
    if (report_ != nullptr) report_->add(p_ndc, index);
    const Color color = colors_.of(p_ndc.numbers[index]);
    return shader_ ? shader_->add(p_ndc, index, color) : color;
  }

 private:
  TriangleColors colors_;
  std::optional<SurfaceShader>& shader_;
  FragmentReport* report_;
};

/// Reads the triangles: `batch()` is where the next ones go, `draw()` draws them.
template <typename Batch, typename Draw>
void for_each_batch(Tool& tool, StageReader& reader, Batch&& batch, Draw&& draw) {
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
void draw_all(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen, StageReader& reader,
              Paint& paint, ZBufferAlgorithm<CoverageRule, Depth>& visible) {
  BandDrawing drawing(visible, screen, chosen.thread_count);
  for_each_batch(
      tool, reader, [&]() -> TriangleBatch& { return drawing.next_batch(); },
      [&] { drawing.draw_batch(paint); });
  drawing.finish();
}
template <typename CoverageRule, typename Depth>
void draw_all(Tool& tool, const RenderOptions&, const ScreenConfig&, StageReader& reader, Paint& paint,
              ScanlineAlgorithm<CoverageRule, Depth>& visible) {
  TriangleBatch p_ndc;
  const auto draw = [&] {
    for (std::size_t i = 0; i < p_ndc.size(); ++i) visible.draw(exact_triangle(p_ndc, i), paint(p_ndc, i));
  };
  for_each_batch(
      tool, reader, [&]() -> TriangleBatch& { return p_ndc; }, draw);
}

template <VisibilityAlgorithm Visible>
void write_all(Tool& tool, const RenderOptions& chosen, const ScreenConfig& screen, const Visible& visible,
               std::optional<SurfaceShader>& shader) {
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
  int row_number = 0;
  visible.for_each_row([&](const VisibleRow& row) {
    write_depth_row(depths, row.depths, screen.rear);
    pixels.write_row(shader ? shader->shade(row_number++, row.colors) : row.colors);
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
  StageReader reader(tool.input(), chosen.coverage == Coverage::center);
  std::optional<SurfaceShader> shader = surface_shader(reader, screen, chosen.shading);
  tool.timing().lap(&Timing::read_seconds);
  Visible visible(screen, shader ? SurfaceShader::kNoSurface : background_color(reader.header().appearance));
  tool.timing().lap(&Timing::work_seconds);
  const std::unique_ptr<FragmentReport> report = fragment_report(chosen, screen);
  Paint paint(shader, report.get());
  draw_all(tool, chosen, screen, reader, paint, visible);
  if (report) report->finish();
  tool.timing().lap(&Timing::work_seconds);
  write_all(tool, chosen, screen, visible, shader);
  if (report) report->commit();
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
