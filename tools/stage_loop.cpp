#include "tools/stage_loop.h"

#include <string>

namespace pipeline {
namespace {

void note_lost_digits(const Tool& tool, const StageWriter& writer, const CoordinateRounder& rounder) {
  if (rounder.first_uncertain_line() > 0)
    tool.note(to_string({rounder.file(), rounder.first_uncertain_line()}) +
              ": numbers cancel here beyond 31 digits; the last digits of this vertex are not certain");
  if (!writer.keeps_four_digits())
    tool.note("the largest coordinate keeps fewer than 4 significant digits; use --digits exact");
}

}  // namespace

void StageLoop::run(const std::function<bool(TriangleBatch&)>& read,
                    const std::function<void(TriangleBatch&)>& transform) {
  Timing& timing = tool.timing();
  const auto write = [&](const TriangleBatch& batch) {
    writer.write(batch);
    tool.output().flush();
    timing.lap(&Timing::write_seconds);
  };
  TriangleBatch batch;
  while (read(batch)) {
    timing.triangle_count += batch.size();
    timing.lap(&Timing::read_seconds);
    try {
      transform(batch);
    } catch (...) {
      write(batch);
      throw;
    }
    timing.lap(&Timing::work_seconds);
    write(batch);
  }
  writer.finish();
  note_lost_digits(tool, writer, rounder);
}

}  // namespace pipeline
