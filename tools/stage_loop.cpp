#include "tools/stage_loop.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "tools/stage_team.h"

namespace pipeline {
namespace {

/// Batch after batch, in this thread alone; returns where the first vertex stands whose digits are not
/// certain, if there is one.
LineAndColumn run_alone(Tool& tool, StageWriter& writer, CoordinateRounder rounder, TriangleSource& source,
                        const std::function<BatchTransform(CoordinateRounder&)>& make_transform) {
  Timing& timing = tool.timing();
  const BatchTransform transform = make_transform(rounder);
  const auto write = [&](const TriangleBatch& batch) {
    writer.write(batch);
    tool.output().flush();
    timing.lap(&Timing::write_seconds);
  };
  TriangleBatch batch;
  while (source.read(batch)) {
    timing.triangle_count += batch.size();
    timing.lap(&Timing::read_seconds);
    try {
      transform(batch);
    } catch (const std::runtime_error&) {  // lack of memory may have left the batch half filled
      write(batch);
      throw;
    }
    timing.lap(&Timing::work_seconds);
    write(batch);
  }
  return rounder.first_uncertain();
}

}  // namespace

StageLoop::StageLoop(Tool& tool, StageWriter& writer, CoordinateRounder rounder, int thread_count)
    : tool_(tool), writer_(writer), rounder_(std::move(rounder)), thread_count_(thread_count) {}

void StageLoop::run(TriangleSource& source,
                    const std::function<BatchTransform(CoordinateRounder&)>& make_transform) {
  const LineAndColumn uncertain =
      thread_count_ == 1 ? run_alone(tool_, writer_, rounder_, source, make_transform)
                         : StageTeam(tool_, writer_, rounder_, thread_count_, source, make_transform).run();
  writer_.finish();
  if (uncertain.is_known())
    tool_.note(to_string(rounder_.location_of(uncertain)) +
               ": numbers cancel here beyond 31 digits; the last digits of this vertex are not certain");
  if (!writer_.keeps_four_digits())
    tool_.note("the largest coordinate keeps fewer than 4 significant digits; use --digits exact");
}

}  // namespace pipeline
