#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/row_bands.h"
#include "libpipeline/visibility/tagged_batch.h"

namespace pipeline {

/// Draws a picture band by band: all triangles of several batches that reach one band are drawn before those
/// of the next band, so that the band's pixels stay in the cache. With several threads, each band is drawn by
/// one of them while the caller reads on. A pixel belongs to one band, and a band's triangles are drawn in
/// the order of the stream, so the result does not depend on the number of threads. `Visible` has a class
/// Drawer(visible, rows) with draw(triangle, tag) and finish(), which touch only those rows.
///
/// Source: "sort-middle" in S. Molnar, M. Cox, D. Ellsworth, H. Fuchs, "A sorting classification of parallel
/// rendering", 1994.
template <typename Visible>
class BandDrawing {
 public:
  /// The pool may do other work, too.
  BandDrawing(Visible& visible, const Viewport& screen, ThreadPool& pool)
      : visible_(visible), bands_(screen), pool_(pool) {
    for (Round& round : rounds_) round.bands.resize(static_cast<std::size_t>(bands_.count()));
  }
  ~BandDrawing() { pool_.cancel(); }
  BandDrawing(const BandDrawing&) = delete;
  BandDrawing& operator=(const BandDrawing&) = delete;

  /// Swaps the batch in and hands back an empty one to refill. Draws it now or later, at the latest in
  /// finish().
  void draw(TaggedBatch& batch) {
    is_idle_ = false;
    Round& round = rounds_[filling_];
    std::swap(round.batches[round.batch_count], batch);
    sort_into_bands(round);
    if (round.is_full()) draw_round();
  }
  /// Draws the batches still waiting.
  void finish() {
    if (is_idle_) return;
    draw_round();
    pool_.finish();
    is_idle_ = true;
  }

 private:
  static constexpr std::size_t kMaxBatches = 16;
  static constexpr std::size_t kBatchesInCache = 4;
  static constexpr std::size_t kMaxEntries = std::size_t{1} << 18;

  struct Entry {
    std::uint16_t batch;
    std::uint16_t index;
  };
  /// Batches drawn together.
  struct Round {
    /// Large triangles, which reach several bands, are collected over many batches, so that more of them are
    /// drawn while a band's pixels are in the cache. Small triangles are collected over few batches, so that
    /// they themselves stay in the cache.
    [[nodiscard]] bool is_full() const {
      const bool is_of_small_triangles = entry_count < 2 * triangle_count;
      return batch_count == kMaxBatches || entry_count >= kMaxEntries ||
             (batch_count >= kBatchesInCache && is_of_small_triangles);
    }

    std::array<TaggedBatch, kMaxBatches> batches;
    std::vector<std::vector<Entry>> bands;  // which triangles reach a band
    std::size_t batch_count = 0;
    std::size_t triangle_count = 0;
    std::size_t entry_count = 0;
  };

  /// Lists the triangles of the round's next batch by the bands they reach.
  void sort_into_bands(Round& round) {
    const std::size_t number = round.batch_count++;
    const TriangleBatch& batch = round.batches[number].batch;
    assert(batch.size() <= std::size_t{1} << 16);
    round.triangle_count += batch.size();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const RowRange range = bands_.bands_of(batch.triangles[i]);
      for (int band = range.first; band < range.end; ++band)
        round.bands[static_cast<std::size_t>(band)].push_back(
            {static_cast<std::uint16_t>(number), static_cast<std::uint16_t>(i)});
      round.entry_count += static_cast<std::size_t>(range.end - range.first);
    }
  }

  /// Has the pool draw the round once it has drawn the previous one.
  void draw_round() {
    pool_.finish();
    Round& round = rounds_[filling_];
    if (round.batch_count == 0) return;
    pool_.start(bands_.count(), [this, &round](int band, int) { draw_band(round, band); });
    filling_ = 1 - filling_;
    rounds_[filling_].batch_count = 0;
    rounds_[filling_].triangle_count = 0;
    rounds_[filling_].entry_count = 0;
  }

  void draw_band(Round& round, int band) {
    std::vector<Entry>& entries = round.bands[static_cast<std::size_t>(band)];
    if (entries.empty()) return;
    typename Visible::Drawer drawer(visible_, bands_.rows(band));
    for (const Entry entry : entries) {
      const TaggedBatch& drawn = round.batches[entry.batch];
      drawer.draw(exact_triangle(drawn.batch, entry.index), drawn.tags[entry.index]);
    }
    drawer.finish();
    entries.clear();
  }

  Visible& visible_;
  RowBands bands_;
  std::array<Round, 2> rounds_;  // one is filled while the other is drawn
  std::size_t filling_ = 0;
  bool is_idle_ = true;
  ThreadPool& pool_;
};

}  // namespace pipeline
