#pragma once

#include <memory>
#include <optional>
#include <string>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/rim/statistics.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// Watches the triangles of `zbuf` as they are read: whether one shows and, with --stats, the fate of
/// each. Takes them in the order of the stream, so the report depends neither on the visibility algorithm nor
/// on the threads that draw.
class DrawingReport {
 public:
  virtual ~DrawingReport() = default;
  /// Takes the next triangles.
  virtual void add(const TriangleBatch& p_ndc) = 0;
  /// Why no triangle shows; none if one does.
  [[nodiscard]] virtual std::optional<std::string> empty_picture_note() const = 0;
  /// Adds the counts and extents, if the report counts.
  virtual void add_to(Statistics& statistics) const = 0;
};

/// The report for these rules; it counts if `counts` is true.
std::unique_ptr<DrawingReport> drawing_report(const PixelRules& rules, const Viewport& screen,
                                              int sample_count, bool counts);

}  // namespace pipeline
