#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/visibility/fragment.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The pixels of `--probe`. A UsageError if one is not on the screen.
std::vector<Pixel> probed_pixels(const PictureOptions& chosen, const Viewport& screen);

/// Reports every triangle's fragments at the requested pixels. Takes triangles in the order of the stream, so
/// the report does not depend on the threads that draw them.
class FragmentReport {
 public:
  virtual ~FragmentReport() = default;
  /// Takes the next triangle.
  virtual void add(const TriangleBatch& p_ndc, std::size_t index) = 0;
  /// Prints the fragments of the probes on stderr.
  virtual void finish() const = 0;
};

/// The report on the chosen probes and, unless it is null, to `log` on the whole picture; null if neither is
/// requested. A UsageError if a probe is not on the screen.
std::unique_ptr<FragmentReport> fragment_report(const ZbufOptions& chosen, const Viewport& screen,
                                                TextWriter* log);

}  // namespace pipeline
