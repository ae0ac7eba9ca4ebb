#include "tools/picture_options.h"

#include "libpipeline/depth_image.h"
#include "libpipeline/supersampling.h"
#include "tools/shading_options.h"

namespace pipeline {

void add_picture_options(CommandLine& options, RenderOptions& chosen) {
  options.add_word("--depth-image", "FILE", chosen.depth_image_path,
                   "Where an image of the depths goes, a .pgm or .png file of 16 bits: bright at the front "
                   "limit, black at the rear limit",
                   wrong_with_name(depth_image_format_of));
  options.add_number(
      "--depth-epsilon", "E", chosen.depth_epsilon, [](double epsilon) { return epsilon >= 0; },
      "a number of at least 0",
      "By how much more than this a triangle has to be nearer than the one seen so far; the order of the "
      "triangles counts then");
  options.add_whole(
      "--samples", chosen.sample_count, 1, kMaxSamples,
      "N x N samples a pixel, whose mean the image shows; depths stay those of the pixel centres");
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
