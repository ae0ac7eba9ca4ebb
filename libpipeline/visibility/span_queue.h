#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// Spans on their way into a buffer of pixels. A small triangle's pixels are far in memory from those of the
/// one before, so a span is queued while its pixels are fetched into the cache. First in, first out.
class SpanQueue {
 public:
  /// At most `most_spans` spans are queued at a time.
  explicit SpanQueue(std::size_t most_spans)
      : halves_{Half(kWaiting + most_spans), Half(kWaiting + most_spans)} {}

  /// Where to write the next spans, one after the other.
  [[nodiscard]] TaggedSpan* end() { return halves_[filling_].end; }
  /// Queues the spans written there, up to `new_end`. Calls `fetch(span)` for each at once, and `draw(spans)`
  /// for those queued long enough.
  template <typename Fetch, typename Draw>
  void put(TaggedSpan* new_end, Fetch&& fetch, Draw&& draw) {
    Half& half = halves_[filling_];
    for (const TaggedSpan* span = half.end; span != new_end; ++span) fetch(*span);
    half.end = new_end;
    if (half.end < half.spans.get() + kWaiting) return;
    filling_ = 1 - filling_;
    take(halves_[filling_], draw);
  }
  /// Calls `draw(spans)` for all still queued.
  template <typename Draw>
  void finish(Draw&& draw) {
    take(halves_[1 - filling_], draw);
    take(halves_[filling_], draw);
  }

 private:
  // The number of spans fetched before the first of them is drawn.
  static constexpr std::size_t kWaiting = 32;

  struct Half {
    explicit Half(std::size_t count)
        : spans(std::make_unique_for_overwrite<TaggedSpan[]>(count)), end(spans.get()) {}

    std::unique_ptr<TaggedSpan[]> spans;  // not initialized: they are written before they are read
    TaggedSpan* end;
  };

  template <typename Draw>
  void take(Half& half, Draw& draw) {
    draw(std::span<const TaggedSpan>(half.spans.get(), half.end));
    half.end = half.spans.get();
  }

  std::array<Half, 2> halves_;
  std::size_t filling_ = 0;
};

}  // namespace pipeline
