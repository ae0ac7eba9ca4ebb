#pragma once

#include <optional>

#include "libpipeline/raytracing/sampling.h"
#include "tools/rim/command_line.h"
#include "tools/stages/stage_options.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

/// The options of `trace`, as members with their defaults.
struct TraceOptions : PictureOptions {
  explicit TraceOptions(CommandLine& options);

  ProjectionOptions projection;
  std::optional<Sampling> sampling;  // `complete` chooses, if there is none
  int threshold = 8;                 // of adaptive sampling: the difference of colors, in levels of 255
  bool without_shadows = false;
  bool without_recursion = false;
  double min_contribution = 1.0 / 510;
  int max_depth = 32;

  /// Chooses the options that depend on others, and on whether standard output is a terminal. A UsageError if
  /// options exclude each other.
  void complete(const CommandLine& options, bool is_terminal);
  [[nodiscard]] bool has_depths() const {
    return z_buffer_path != "none" || !depth_image_path.empty() || !depth_array_path.empty();
  }

 private:
  void add_pixels(CommandLine& options);
  void add_color_and_light(CommandLine& options);
};

}  // namespace pipeline
