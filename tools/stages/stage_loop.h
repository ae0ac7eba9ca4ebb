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

  /// For stages that read triangles. The last one notes that there are none.
  void note_if_no_triangle_came() const {
    if (tool_.timing().triangle_count == 0 && Tool::is_last_stage()) tool_.note("the input has no triangles");
  }
  /// Adds the extents in `format` to the statistics, and writes them once the output is safe.
  void write_statistics(NumberFormat format) {
    if (!statistics_.is_wanted()) return;
    statistics_.add(extent_, format);
    tool_.close_output();
    statistics_.finish();
    statistics_.commit();
  }

 private:
  void write(const TriangleBatch& batch) {
    writer_.write(batch);
    if (statistics_.is_wanted()) extent_.add(batch);
    tool_.output().flush();
    tool_.timing().lap(&Timing::write_seconds);
  }
  /// Completes the text, and notes uncertain digits.
  void finish(const UncertainDigits& uncertain_lights) {
    writer_.finish();
    statistics_.add("triangles", tool_.timing().triangle_count);
    note_uncertain("light", uncertain_lights);
    note_uncertain("vertex", rounder_.uncertain());
  }
  void note_uncertain(const char* one_of_them, const UncertainDigits& uncertain) const {
    if (uncertain.count == 0) return;
    const std::uint64_t others = uncertain.count - 1;
    const std::string and_others = others == 0 ? "" : " and of " + std::to_string(others) + " more";
    tool_.note(to_string(rounder_.location_of(uncertain.first)) + ": the digits of this " + one_of_them +
               and_others + " are not certain: numbers cancel here, and 31 digits are too few");
  }

  Tool& tool_;
  StageWriter& writer_;
  const CoordinateRounder& rounder_;
  Statistics& statistics_;
  CoordinateExtent extent_;  // for the statistics
};

}  // namespace pipeline
