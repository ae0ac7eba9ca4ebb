#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The triangles of a stage text, batch by batch and in order, of which a thread pool parses the next ones
/// ahead. It never waits for the input while it has triangles to give.
///
/// Only text in fixed form (fixed_text.h) is parsed ahead, as nearly all text is: there the numbers and lines
/// of the triangles follow from their count. Where other text comes, the reader parses it as usual.
class ReadAhead {
 public:
  static constexpr std::size_t kPartSize = std::size_t{1} << 16;  // about 700 triangles

  /// The pool may have other work besides; a pool of one parses nothing ahead. A part of the text has at
  /// most `part_size` characters.
  ReadAhead(StageReader& reader, ThreadPool& pool, std::size_t part_size = kPartSize);
  ~ReadAhead() { pool_.cancel(); }
  ReadAhead(const ReadAhead&) = delete;
  ReadAhead& operator=(const ReadAhead&) = delete;

  /// See StageReader::read.
  bool read(TriangleBatch& batch);

 private:
  /// A part of the text on its way through the pool; the reader keeps that text, too, until it is delivered.
  struct Slot {
    void parse();

    std::string text;        // and what the kernel may look at behind it
    std::size_t length = 0;  // of the text
    TriangleBatch batch;
    bool is_in_fixed_form = false;  // all of it
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
  // The parts from number `begin_` to before `end_` are on their way.
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t length_ = 0;  // of their text together
  int pause_ = 0;           // how many batches the reader parses before the next part is tried
  ThreadPool& pool_;
};

}  // namespace pipeline
