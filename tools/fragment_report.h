#pragma once

#include <cstddef>
#include <memory>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/zbuf_options.h"

namespace pipeline {

/// Tells what every triangle brings to the pixels that were asked for. It takes triangles in the order of the
/// stream, so what it says does not depend on who draws them.
class FragmentReport {
 public:
  virtual ~FragmentReport() = default;
  /// Takes the next triangle.
  virtual void add(const TriangleBatch& p_ndc, std::size_t index) = 0;
  /// Says on stderr what the probes have seen, and closes the file.
  virtual void finish() = 0;
  /// Puts the file in its place.
  virtual void commit() = 0;
};

/// The report that was asked for, with the coverage rule and the depth format that draw; none if none was. A
/// UsageError if a probe is not on the screen.
std::unique_ptr<FragmentReport> fragment_report(const ZbufOptions& chosen, const Viewport& screen);

}  // namespace pipeline
