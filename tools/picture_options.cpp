#include "tools/picture_options.h"

#include "libpipeline/depth_image.h"
#include "libpipeline/number_text.h"
#include "libpipeline/supersampling.h"
#include "tools/command_line.h"
#include "tools/shading_options.h"

namespace pipeline {
namespace {

/// Takes a depth of at least 0.
std::string check_epsilon(const std::string& word) {
  const ParsedNumber number = parse_number(word);
  if (number.error == NumberError::none && number.value >= 0) return "";
  return expected_but_found("a number of at least 0", pipeline::quoted(word));
}

}  // namespace

void add_picture_options(CLI::App& options, RenderOptions& chosen) {
  add_file_option(options, "--depth-image", chosen.depth_image_path, depth_image_format_of,
                  "Where an image of the depths goes, a .pgm or .png file of 16 bits: bright at the front "
                  "limit, black at the rear limit");
  options
      .add_option("--depth-epsilon", chosen.depth_epsilon,
                  "By how much more than this a triangle has to be nearer than the one seen so far; the "
                  "order of the triangles counts then")
      ->type_name("E")
      ->check(CLI::Validator(check_epsilon, "", ""))
      ->capture_default_str();
  options
      .add_option("--samples", chosen.sample_count,
                  "N x N samples a pixel, whose mean the image shows; depths stay those of the pixel centres")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxSamples))
      ->capture_default_str();
  add_shading_option(options, chosen.shading);
  options.add_flag("--wireframe", chosen.wireframe,
                   "Show of visible surfaces only what lies within half a pixel of an edge");
}

void check_picture_options(const RenderOptions& chosen) {
  if (chosen.algorithm == Algorithm::scanline && chosen.depth_epsilon > 0)
    throw UsageError(
        "--depth-epsilon: " +
        expected_but_found("0 with --algorithm scanline, which keeps no order of drawing", "a number above"));
}

}  // namespace pipeline
