#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// Spans on their way into a buffer of pixels. The memory of a small triangle's pixels is somewhere else than
/// that of the last one's, so a span waits, while its pixels are fetched into the cache, until others have
/// been made. Spans leave in the order in which they came.
class SpanQueue {
 public:
  /// What is put in at a time has at most `most_spans` spans.
  explicit SpanQueue(std::size_t most_spans)
      : halves_{Half(kWaiting + most_spans), Half(kWaiting + most_spans)} {}

  /// Where the next spans are to be written, one after the other.
  [[nodiscard]] TaggedSpan* end() { return halves_[filling_].end; }
  /// Takes what was written there, up to `new_end`. Calls `fetch(span)` for each at once, and
  /// `draw(spans)` for those that have waited.
  template <typename Fetch, typename Draw>
  void put(TaggedSpan* new_end, Fetch&& fetch, Draw&& draw) {
    Half& half = halves_[filling_];
    for (const TaggedSpan* span = half.end; span != new_end; ++span) fetch(*span);
    half.end = new_end;
    if (half.end < half.begin() + kWaiting) return;
    filling_ = 1 - filling_;
    take(halves_[filling_], draw);
  }
  /// Calls `draw(spans)` for all that wait.
  template <typename Draw>
  void finish(Draw&& draw) {
    take(halves_[1 - filling_], draw);
    take(halves_[filling_], draw);
  }

 private:
  // So many are fetched before the first of them is drawn.
  static constexpr std::size_t kWaiting = 32;

  struct Half {
    explicit Half(std::size_t count) : memory(::operator new(count * sizeof(TaggedSpan))), end(begin()) {}
    [[nodiscard]] TaggedSpan* begin() const { return static_cast<TaggedSpan*>(memory.get()); }

    struct Delete {
      void operator()(void* p) const { ::operator delete(p); }
    };
    // Nothing is there before it is written.
    std::unique_ptr<void, Delete> memory;
    TaggedSpan* end;
  };

  template <typename Draw>
  void take(Half& half, Draw& draw) {
    draw(std::span<const TaggedSpan>(half.begin(), half.end));
    half.end = half.begin();
  }

  std::array<Half, 2> halves_;
  std::size_t filling_ = 0;
};

}  // namespace pipeline
