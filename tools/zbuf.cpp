// zbuf: decides which triangle is seen at each pixel. Normalized device coordinates in, depths and image out.

#include <csignal>
#include <string>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/config.h"
#include "libpipeline/text/error.h"
#include "tools/command_line.h"
#include "tools/fragment_report.h"
#include "tools/picture_options.h"
#include "tools/render.h"
#include "tools/tool.h"

using namespace pipeline;

namespace {

void add_options(CommandLine& options, RenderOptions& chosen) {
  options.add_operand("CONFIG", chosen.config_path, true,
                      "The screen (config.txt): WIDTH HEIGHT in pixels; or on four lines\n"
                      "that, the left limit of x, the bottom limit of y, the front and rear limits of z");
  options.add_word("--image", "FILE", chosen.image_path, "Where the image goes, a .bmp, .ppm or .png file",
                   wrong_with_name(image_format_of));
  options.add_word("--z-buffer", "FILE", chosen.z_buffer_path, "Where the depths go; - is standard output");
  options.add_choice<Coverage>(
      "--coverage", chosen.coverage, {{"nearest", Coverage::nearest}, {"center", Coverage::center}},
      "Which pixels a triangle covers.\n"
      "nearest: on each row from the pixel nearest to its left end to that nearest to its right end\n"
      "center: those whose centers lie inside, decided exactly");
  options.add_choice<Algorithm>(
      "--algorithm", chosen.algorithm, {{"zbuffer", Algorithm::zbuffer}, {"scanline", Algorithm::scanline}},
      "How it is found out which triangle is seen; both give the same output.\n"
      "zbuffer: every pixel keeps the nearest depth so far\n"
      "scanline: triangles are kept and compared row by row, without memory for the image");
  options.add_choice<DepthFormat>(
      "--depth", chosen.depth,
      {{"f64", DepthFormat::f64}, {"f32", DepthFormat::f32}, {"u24", DepthFormat::u24}},
      "How a pixel keeps its depth: as a double, a float, or in 2^24 equal steps between the limits");
  options.add_threads(chosen.thread_count, "How many threads draw with the z-buffer");
  add_picture_options(options, chosen);
  add_fragment_options(options, chosen.fragments);
  options.add_flag(
      "--framed", chosen.framed,
      "Refuse a text without the frame that model --framed gives it: an empty one may come from a "
      "stage that was killed");
}

void check_threads(const RenderOptions& chosen) {
  if (chosen.algorithm == Algorithm::scanline && chosen.thread_count > 1)
    throw UsageError("--threads: " +
                     expected_but_found("1 with --algorithm scanline, which goes through the rows in turn",
                                        "'" + std::to_string(chosen.thread_count) + "'"));
}

Viewport read_screen(const Tool& tool, const std::string& path) {
  InputFile file = tool.second_input(path, "CONFIG");
  return read_config(file.text());
}

}  // namespace

int main(int argc, char** argv) {
  Tool tool({"zbuf",
             "Reads triangles in normalized device coordinates and writes the depth of every pixel that "
             "shows one, and the image.",
             "What project has written (or stage3.txt)"},
            OutputKind::other_text);
  RenderOptions chosen;
  add_options(tool.options(), chosen);
  // A closed reader is a failure to write like any other: the image that was begun has to be removed.
  std::signal(SIGPIPE, SIG_IGN);

  return tool.run(argc, argv, [&] {
    check_threads(chosen);
    check_picture_options(chosen);
    const Viewport screen = read_screen(tool, chosen.config_path);
    check_image_size(image_format_of(chosen.image_path), screen.columns, screen.rows, chosen.image_path);
    render(tool, chosen, screen);
  });
}
