#pragma once

#include <optional>

#include "tools/command_line.h"
#include "tools/stage_options.h"
#include "tools/zbuf_options.h"

namespace pipeline {

/// The options of `trace`: those of `project` and `zbuf` where they mean the same.
struct TraceOptions {
  explicit TraceOptions(CommandLine& options);
  TraceOptions(const TraceOptions&) = delete;
  TraceOptions& operator=(const TraceOptions&) = delete;

  /// At least 1.
  [[nodiscard]] int thread_count() const;

  ZbufOptions picture;  // with the coverage rule `center`; 0 threads: one on every core
  std::optional<ProjectionOptions> projection;  // always there
};

}  // namespace pipeline
