#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "libpipeline/color.h"
#include "libpipeline/config.h"
#include "libpipeline/exact_grid.h"
#include "libpipeline/pixel_grid.h"
#include "libpipeline/row_bands.h"
#include "libpipeline/span.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/worker_team.h"

namespace pipeline {

/// Draws triangles band by band of the screen: several batches at a time, all that reach a band before the
/// next band, so that its pixels stay in the cache; and with several threads, each band by one of them, while
/// the caller reads on. On one thread, a batch of small triangles is drawn at once: their pixels are
/// somewhere else anyway, and they themselves are still in the cache. A pixel belongs to one band and sees
/// its triangles in the order of the stream, so the result does not depend on the number of threads.
/// `Visible` has a class Band(visible, rows) with draw(triangle, color) and finish(), which only touch those
/// rows.
template <typename Visible>
class BandDrawing {
 public:
  BandDrawing(Visible& visible, const ScreenConfig& screen, int thread_count)
      : visible_(visible), grid_(screen), bands_(screen), team_(thread_count) {
    if (thread_count == 1) whole_.emplace(visible, RowRange{0, screen.rows});
    for (Round& round : rounds_) round.bands.resize(static_cast<std::size_t>(bands_.count()));
  }

  /// Where the next batch is to be put.
  [[nodiscard]] TriangleBatch& next_batch() { return filling().batches[filling().batch_count]; }
  /// Takes what was put there, each triangle in the colour `color_of(batch, index)`, which is asked for at
  /// once and in order. It may be drawn later, at the latest in finish().
  template <typename ColorOf>
  void draw_batch(ColorOf&& color_of) {
    if (whole_ && is_of_small_triangles(next_batch())) return draw_at_once(next_batch(), color_of);
    sort_into_bands(filling(), color_of);
    if (filling().is_full()) draw_round();
  }
  /// Draws all that is not drawn yet.
  void finish() {
    draw_round();
    team_.finish();
  }

 private:
  static constexpr std::size_t kMaxBatches = 16;
  static constexpr std::size_t kBatchesInCache = 4;
  static constexpr std::size_t kMaxEntries = std::size_t{1} << 18;

  static_assert(kBatchSize <= std::size_t{1} << 16);
  struct Entry {
    std::uint16_t batch;
    std::uint16_t index;
  };
  /// Batches that are drawn together.
  struct Round {
    /// Where triangles reach several bands, a band's pixels are drawn more often while they are in the cache
    /// if there are many; small ones had better stay in it themselves.
    [[nodiscard]] bool is_full() const {
      const bool is_of_small_triangles = entry_count < 2 * triangle_count;
      return batch_count == kMaxBatches || entry_count >= kMaxEntries ||
             (batch_count >= kBatchesInCache && is_of_small_triangles);
    }

    std::array<TriangleBatch, kMaxBatches> batches;
    std::array<std::vector<Color>, kMaxBatches> colors;
    std::vector<std::vector<Entry>> bands;  // which triangles reach a band
    std::size_t batch_count = 0;
    std::size_t triangle_count = 0;
    std::size_t entry_count = 0;
  };

  [[nodiscard]] Round& filling() { return rounds_[filling_]; }

  /// By some of them.
  [[nodiscard]] bool is_of_small_triangles(const TriangleBatch& batch) const {
    constexpr double kSmall = 32;  // width and height together, in pixels
    constexpr std::size_t kStep = 8;
    double width = 0, height = 0, count = 0;
    for (std::size_t i = 0; i < batch.size(); i += kStep, ++count) {
      const Triangle& p = batch.triangles[i];
      width += std::max({p[0].x, p[1].x, p[2].x}) - std::min({p[0].x, p[1].x, p[2].x});
      height += std::max({p[0].y, p[1].y, p[2].y}) - std::min({p[0].y, p[1].y, p[2].y});
    }
    return width / grid_.dx + height / grid_.dy < kSmall * count;
  }

  template <typename ColorOf>
  void draw_at_once(const TriangleBatch& batch, ColorOf& color_of) {
    if (filling().batch_count > 0) draw_round();
    team_.finish();
    for (std::size_t i = 0; i < batch.size(); ++i) whole_->draw(exact_triangle(batch, i), color_of(batch, i));
    whole_->finish();
  }

  template <typename ColorOf>
  void sort_into_bands(Round& round, ColorOf& color_of) {
    const std::size_t number = round.batch_count++;
    const TriangleBatch& batch = round.batches[number];
    round.colors[number].clear();
    round.triangle_count += batch.size();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      round.colors[number].push_back(color_of(batch, i));
      const RowRange range = bands_.bands_of(batch.triangles[i]);
      for (int band = range.first; band < range.end; ++band)
        round.bands[static_cast<std::size_t>(band)].push_back(
            {static_cast<std::uint16_t>(number), static_cast<std::uint16_t>(i)});
      round.entry_count += static_cast<std::size_t>(range.end - range.first);
    }
  }

  /// Has the team draw what was collected, once it is done with what came before.
  void draw_round() {
    team_.finish();
    Round& round = filling();
    team_.start(bands_.count(), [this, &round](int band) { draw_band(round, band); });
    filling_ = 1 - filling_;
    filling().batch_count = 0;
    filling().triangle_count = 0;
    filling().entry_count = 0;
  }

  void draw_band(Round& round, int band) {
    std::vector<Entry>& entries = round.bands[static_cast<std::size_t>(band)];
    if (entries.empty()) return;
    typename Visible::Band rows(visible_, bands_.rows(band));
    for (const Entry entry : entries)
      rows.draw(exact_triangle(round.batches[entry.batch], entry.index),
                round.colors[entry.batch][entry.index]);
    rows.finish();
    entries.clear();
  }

  Visible& visible_;
  PixelGrid grid_;
  std::optional<typename Visible::Band> whole_;  // on one thread: for what is drawn at once
  RowBands bands_;
  std::array<Round, 2> rounds_;  // one is filled while the other is drawn
  std::size_t filling_ = 0;
  WorkerTeam team_;  // the last: its threads end before what they use
};

}  // namespace pipeline
