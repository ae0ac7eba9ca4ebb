#pragma once

#include <optional>

#include "libpipeline/raytracing/sampling.h"
#include "tools/rim/command_line.h"
#include "tools/stages/stage_options.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The options of `trace`: those of `project` and `zbuf` where they mean the same.
struct TraceOptions {
  explicit TraceOptions(CommandLine& options);
  TraceOptions(const TraceOptions&) = delete;
  TraceOptions& operator=(const TraceOptions&) = delete;

  /// Chooses the options that depend on others, and on whether standard output is a terminal. A UsageError if
  /// options exclude each other.
  void complete(const CommandLine& options, bool is_terminal);
  /// At least 1.
  [[nodiscard]] int thread_count() const;

  ZbufOptions picture;               // with the coverage rule `center`; 0 threads: one on every core
  std::optional<Sampling> sampling;  // none: regular
  int threshold = 8;                 // of adaptive sampling: the difference of colors, in levels of 255
  std::optional<ProjectionOptions> projection;  // always there
  bool without_shadows = false;
  bool without_recursion = false;
  double min_contribution = 1.0 / 510;
  int max_depth = 32;
};

}  // namespace pipeline
