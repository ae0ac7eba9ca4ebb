#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/fixed_text.h"

namespace pipeline {

/// Delivers the triangles of a stage text batch by batch and in order, while a thread pool parses the next
/// ones. It never waits for the input while it has triangles to deliver.
///
/// Only text in fixed form (fixed_text.h), which nearly all text has, is parsed ahead: there, the triangles'
/// numbers and lines follow from their count. The reader parses any other text, in order.
class ReadAhead {
 public:
  static constexpr std::size_t kPartSize = std::size_t{1} << 16;  // about 700 triangles

  /// The pool may also have other tasks; a pool of one parses nothing ahead. A part of the text has at most
  /// `part_size` characters.
  ReadAhead(StageReader& reader, ThreadPool& pool, std::size_t part_size = kPartSize);
  ~ReadAhead() { pool_.cancel(); }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// See StageReader::read.
  bool read(TriangleBatch& batch);

 private:
  /// A copy of a part of the text, and its triangles. The reader keeps the text until they are delivered, so
  /// it can parse the part itself.
  struct Slot {
    void parse();

    std::string text;        // the part, then characters that the kernel may read but does not use
    std::size_t length = 0;  // of the part
    TriangleBatch batch;
    FixedTextPart read;  // all of it, if it is in fixed form
    std::atomic<bool> is_done = false;
  };

  void start_parts();
  std::string_view next_part();
  void wait_for(const Slot& slot);
  void drop_parts();
  [[nodiscard]] Slot& slot(std::size_t number) { return slots_[number % slots_.size()]; }

  StageReader& reader_;
  std::size_t part_size_;
  std::deque<Slot> slots_;
  // Slots from number `begin_` to before `end_` are in work or done.
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t length_ = 0;  // of their parts together
  int pause_ = 0;           // this many batches are left to the reader before the next part is tried
  ThreadPool& pool_;
};

}  // namespace pipeline
