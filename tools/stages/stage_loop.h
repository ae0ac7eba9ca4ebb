#pragma once

#include <stdexcept>

#include "libpipeline/stream/coordinate_extent.h"
#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"

namespace pipeline {

/// The loop of a text filter: reads a batch, transforms it, and writes it out at once, until the input ends.
/// An error is reported after the triangles before it are written.
class StageLoop {
 public:
  /// `rounder` is the transform's.
  StageLoop(Tool& tool, StageWriter& writer, const CoordinateRounder& rounder, Statistics& statistics)
      : tool_(tool), writer_(writer), rounder_(rounder), statistics_(statistics) {
    statistics_.open();
  }

  /// `source.read(batch)` fills a batch; false at the end of the input. `transform(batch)` changes a batch in
  /// place; where it throws, the batch keeps the triangles before the error. `uncertain_lights` belong to
  /// the header that was written.
  template <typename Source, typename Transform>
  void run(Source& source, const Transform& transform, const UncertainDigits& uncertain_lights = {}) {
    Timing& timing = tool_.timing();
    for (TriangleBatch batch; source.read(batch);) {
      timing.triangle_count += batch.object_count();
      timing.lap(&Timing::read_seconds);
      try {
        transform(batch);
      } catch (const std::runtime_error&) {  // after std::bad_alloc a batch may be half filled
        write(batch);
        throw;
      }
      timing.lap(&Timing::work_seconds);
      write(batch);
    }
    finish(uncertain_lights);
  }

  /// For stages that read triangles. The last one notes that none came.
  void note_if_no_triangle_came() const;
  /// Adds the extents in `format` to the statistics, and writes them once the output is safe.
  void write_statistics(NumberFormat format);

 private:
  void write(const TriangleBatch& batch);
  void finish(const UncertainDigits& uncertain_lights);
  void note_uncertain(const char* one_of_them, const UncertainDigits& uncertain) const;

  Tool& tool_;
  StageWriter& writer_;
  const CoordinateRounder& rounder_;
  Statistics& statistics_;
  CoordinateExtent extent_;  // for the statistics
};

}  // namespace pipeline
