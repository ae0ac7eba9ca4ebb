#pragma once

#include <atomic>
#include <cstddef>
#include <deque>

#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_parts.h"
#include "libpipeline/stream/triangle_source.h"

namespace pipeline {

/// A source's triangles, batch by batch as it gives them, of which a pool reads the next ones ahead, part by
/// part. It never waits for the input while there is something to give.
class ReadAhead {
 public:
  /// The pool may have other work besides. A pool of one reads nothing ahead.
  ReadAhead(TriangleSource& source, ThreadPool& pool);
  ~ReadAhead() { pool_.cancel(); }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// See TriangleSource::read.
  bool read(TriangleBatch& batch);

 private:
  struct Slot {
    TrianglePart part;
    TriangleBatch batch;
    bool is_read = false;  // or else the part holds more than triangles
    std::atomic<bool> is_done = false;
  };

  void take_parts();
  bool take_first(TriangleBatch& batch);
  [[nodiscard]] Slot& slot(std::size_t number) { return slots_[number % slots_.size()]; }

  TriangleSource& source_;
  TriangleParts parts_;
  std::deque<Slot> slots_;
  // Those from number `begin_` to `end_` are in work.
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  ThreadPool& pool_;
};

}  // namespace pipeline
