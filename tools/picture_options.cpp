#include "tools/picture_options.h"

#include "libpipeline/picture/depth_image.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/text/number_printer.h"
#include "tools/shading_options.h"

namespace pipeline {

void add_picture_options(CommandLine& options, RenderOptions& chosen) {
  options.add_word(
      "--depth-image", "FILE", chosen.depth_image_path,
      "Also write the depths as an image of 16 bits, a .pgm or .png file: white at the front limit, "
      "black at the rear limit",
      wrong_with_name(depth_image_format_of));
  options.add_number(
      "--depth-epsilon", "E", chosen.depth_epsilon, [](double epsilon) { return epsilon >= 0; },
      "a number of at least 0",
      "Let a triangle through only where it is nearer than the one seen so far by more than E; the order of "
      "the triangles counts then");
  options.add_whole("--samples", chosen.sample_count, 1, kMaxSamples,
                    "Smooth edges: a pixel of the image is the mean of N x N samples, its depth stays that "
                    "of its center; N");
  add_shading_option(options, chosen.shading);
  options.add_flag("--wireframe", chosen.wireframe,
                   "Show of the visible surfaces only their edges: what lies within half a pixel of one");
}

void check_picture_options(const RenderOptions& chosen) {
  if (chosen.algorithm == Algorithm::scanline && chosen.depth_epsilon > 0)
    throw UsageError("--depth-epsilon: " +
                     expected_but_found("0 with --algorithm scanline, which keeps no order of drawing",
                                        "'" + shortest_text(chosen.depth_epsilon) + "'"));
}

}  // namespace pipeline
