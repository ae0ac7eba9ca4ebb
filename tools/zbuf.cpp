// zbuf: decides which triangle is seen at each pixel. Normalised device coordinates in, depths and image out.

#include <csignal>
#include <optional>
#include <string>

#include "libpipeline/color.h"
#include "libpipeline/config.h"
#include "libpipeline/coverage.h"
#include "libpipeline/depth_text.h"
#include "libpipeline/image_file.h"
#include "libpipeline/output_file.h"
#include "libpipeline/stage_text.h"
#include "libpipeline/visibility.h"
#include "tools/command_line.h"
#include "tools/tool.h"

using namespace pipeline;

namespace {

enum class Coverage { nearest, center };
enum class Algorithm { zbuffer, scanline };
enum class DepthFormat { f64, f32, u24 };

struct ZbufOptions {
  std::string config_path;
  std::string image_path = "out.bmp";
  std::string z_buffer_path = "-";
  Coverage coverage = Coverage::nearest;
  Algorithm algorithm = Algorithm::zbuffer;
  DepthFormat depth = DepthFormat::f64;
};

void add_options(CLI::App& options, ZbufOptions& chosen) {
  const auto has_format = [](std::string& path) {
    try {
      static_cast<void>(image_format_of(path));
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  options.add_option("CONFIG", chosen.config_path, "The screen: size and limits (config.txt)")->required();
  options.add_option("--image", chosen.image_path, "Where the image goes, a .bmp or .ppm file")
      ->type_name("FILE")
      ->check(CLI::Validator(has_format, "", ""))
      ->capture_default_str();
  options.add_option("--z-buffer", chosen.z_buffer_path, "Where the depths go; - is standard output")
      ->type_name("FILE")
      ->capture_default_str();
  add_choice<Coverage>(options, "--coverage", chosen.coverage, {{"nearest", Coverage::nearest}, {"center", Coverage::center}},
                       "Which pixels a triangle covers. nearest: on each row from the pixel nearest to the left end to "
                       "that nearest to the right end; center: those whose centres lie inside, decided exactly");
  add_choice<Algorithm>(options, "--algorithm", chosen.algorithm,
                        {{"zbuffer", Algorithm::zbuffer}, {"scanline", Algorithm::scanline}},
                        "How it is found out which triangle is seen. zbuffer: every pixel keeps the nearest depth so far; "
                        "scanline: triangles are kept and compared row by row, without memory for the image. Both give "
                        "the same output");
  add_choice<DepthFormat>(options, "--depth", chosen.depth,
                          {{"f64", DepthFormat::f64},
                           {"f32", DepthFormat::f32},
                           {"u24", DepthFormat::u24}},
                          "How a pixel keeps its depth: as a double, a float, or in 2^24 equal steps between the limits");
}

ScreenConfig read_screen(const Tool& tool, const std::string& path) {
  InputFile file = tool.second_input(path, "CONFIG");
  return read_config(file.text());
}

template <VisibilityAlgorithm Visible>
void draw_all(Tool& tool, Coverage coverage, Visible& visible) {
  StageReader reader(tool.input(), coverage == Coverage::center);
  TriangleColors colors;
  TriangleBatch p_ndc;
  while (reader.read(p_ndc)) {
    tool.timing().triangle_count += p_ndc.size();
    tool.timing().lap(&Timing::read_seconds);
    for (std::size_t i = 0; i < p_ndc.size(); ++i) visible.draw(exact_triangle(p_ndc, i), colors.of(p_ndc.numbers[i]));
    tool.timing().lap(&Timing::work_seconds);
  }
}

/// Nothing takes an older file's place before everything is written.
template <VisibilityAlgorithm Visible>
void write_all(Tool& tool, const ZbufOptions& chosen, const ScreenConfig& screen, const Visible& visible) {
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
void render(Tool& tool, const ZbufOptions& chosen, const ScreenConfig& screen) {
  Visible visible(screen);
  draw_all(tool, chosen.coverage, visible);
  write_all(tool, chosen, screen, visible);
}

template <typename CoverageRule, typename Depth>
void render(Tool& tool, const ZbufOptions& chosen, const ScreenConfig& screen) {
  switch (chosen.algorithm) {
    case Algorithm::zbuffer:
      return render<ZBufferAlgorithm<CoverageRule, Depth>>(tool, chosen, screen);
    case Algorithm::scanline:
      return render<ScanlineAlgorithm<CoverageRule, Depth>>(tool, chosen, screen);
  }
}

template <typename Depth>
void render_in(Tool& tool, const ZbufOptions& chosen, const ScreenConfig& screen) {
  switch (chosen.coverage) {
    case Coverage::nearest:
      return render<NearestCoverage, Depth>(tool, chosen, screen);
    case Coverage::center:
      return render<CenterCoverage, Depth>(tool, chosen, screen);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool("zbuf",
            "Reads triangles in normalised device coordinates and writes the depth of every pixel that "
            "shows one, and the image.",
            OutputKind::other_text);
  ZbufOptions chosen;
  add_options(tool.options(), chosen);
  // A closed reader is a failure to write like any other: the image that was begun has to be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    const ScreenConfig screen = read_screen(tool, chosen.config_path);
    check_image_size(image_format_of(chosen.image_path), screen.columns, screen.rows, chosen.image_path);
    switch (chosen.depth) {
      case DepthFormat::f64:
        return render_in<DepthF64>(tool, chosen, screen);
      case DepthFormat::f32:
        return render_in<DepthF32>(tool, chosen, screen);
      case DepthFormat::u24:
        return render_in<DepthU24>(tool, chosen, screen);
    }
  });
}
