#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>

#include "libpipeline/coordinate_rounder.h"
#include "libpipeline/stage_writer.h"
#include "libpipeline/text_writer.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/worker_team.h"
#include "tools/stage_loop.h"
#include "tools/tool.h"

namespace pipeline {

/// The work of a StageLoop on several threads. Batches are read one after another; a team transforms and
/// prints a round of them while this thread writes the round before and reads the next one. All is written in
/// order.
class StageRounds {
 public:
  StageRounds(Tool& tool, StageWriter& writer, const CoordinateRounder& rounder, int thread_count,
              const std::function<BatchTransform(CoordinateRounder&)>& make_transform);

  /// Everything from the first batch to the end of the input; returns where the first vertex stands
  /// whose digits are not certain, if there is one.
  LineAndColumn run(const std::function<bool(TriangleBatch&)>& read);

 private:
  /// One batch on its way. What belongs to a slot is touched by one thread at a time.
  struct Slot {
    Slot(const StageWriter& whole, const CoordinateRounder& pattern,
         const std::function<BatchTransform(CoordinateRounder&)>& make_transform)
        : writer(text, whole), rounder(pattern), transform(make_transform(rounder)) {}

    void work();

    TriangleBatch batch;
    TextWriter text;  // only collects
    StageWriter writer;
    CoordinateRounder rounder;
    BatchTransform transform;
    std::exception_ptr failure;  // what went wrong behind the batch's last triangle
  };

  struct Round {
    std::deque<Slot> slots;  // a slot's parts know each other's addresses
    int count = 0;           // of the slots in use
  };

  void fill(Round& round, const std::function<bool(TriangleBatch&)>& read, bool may_wait);
  void start(Round& round);
  void write(Round& round);

  Tool& tool_;
  StageWriter& writer_;
  std::array<Round, 2> rounds_;
  std::exception_ptr read_failure_;
  bool has_more_ = true;
  WorkerTeam team_;  // the last member: its threads end before what they work on
};

}  // namespace pipeline
