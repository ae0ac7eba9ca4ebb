#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>

#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_parts.h"
#include "libpipeline/stream/triangle_source.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tools/stage_loop.h"
#include "tools/tool.h"

namespace pipeline {

/// The work of a StageLoop on several threads. This thread takes parts of the text, which a pool reads,
/// transforms and prints, and writes what is done; when all slots are taken, it helps. All is written in
/// order. Text with anything but triangles this thread reads itself, batch by batch.
class StageTeam {
 public:
  StageTeam(Tool& tool, StageWriter& writer, const CoordinateRounder& rounder, int thread_count,
            TriangleSource& source, const std::function<BatchTransform(CoordinateRounder&)>& make_transform);

  ~StageTeam();
  StageTeam(const StageTeam&) = delete;
  StageTeam& operator=(const StageTeam&) = delete;

  /// Everything from the first batch to the end of the input; returns where the first vertex stands
  /// whose digits are not certain, if there is one.
  LineAndColumn run();

 private:
  /// One batch on its way. What belongs to a slot is touched by one thread at a time.
  struct Slot {
    Slot(const StageWriter& whole, const CoordinateRounder& pattern,
         const std::function<BatchTransform(CoordinateRounder&)>& make_transform)
        : writer(text, whole), rounder(pattern), transform(make_transform(rounder)) {}

    /// To be called by any thread.
    void work(TriangleParts& parts);

    bool is_part = false;
    bool is_read = false;  // or else the part holds more than triangles
    TrianglePart part;
    TriangleBatch batch;
    std::size_t triangle_count = 0;  // in it as it was read
    TextWriter text;                 // only collects
    StageWriter writer;
    CoordinateRounder rounder;
    BatchTransform transform;
    std::exception_ptr failure;  // what went wrong behind the batch's last triangle
    std::atomic<bool> is_done = false;
  };

  bool fill_next();
  bool try_to_read(const std::function<bool()>& read);
  void make_room();
  void write_done();
  void write_all();
  void put_back();
  void write(const Slot& slot);

  [[nodiscard]] Slot& slot(std::size_t number) { return slots_[number % slots_.size()]; }

  Tool& tool_;
  StageWriter& writer_;
  TriangleSource& source_;
  TriangleParts parts_;
  std::deque<Slot> slots_;  // a slot's parts know each other's addresses
  // Those from number `begin_` to `end_` are in work.
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::exception_ptr read_failure_;
  ThreadPool pool_;  // the last member: its threads end before what they work on
};

}  // namespace pipeline
