#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/drawing.h"

namespace pipeline {

/// A picture cut into bands of neighboring rows. Bands outside the drawn rows stay empty. A band has 8 to 64
/// rows, as many as a core's cache can hold the depths and tags of while many triangles are drawn into it (8
/// even if it cannot); more only in a picture so tall that there would be more than 512 bands.
class RowBands {
 public:
  /// The size of a double and a PixelTag.
  static constexpr int kBytesPerPixel = 12;

  explicit RowBands(const Viewport& screen)
      : grid_(screen),
        drawn_(screen.drawn_rows()),
        rows_per_dy_(1 / grid_.dy),
        height_bits_(height_bits_for(screen)) {}

  [[nodiscard]] int count() const { return ((grid_.rows - 1) >> height_bits_) + 1; }
  [[nodiscard]] RowRange rows(int band) const {
    return {std::max(band << height_bits_, drawn_.first), std::min((band + 1) << height_bits_, drawn_.end)};
  }

  /// The bands in which a triangle in NDC can have pixels by any coverage rule; perhaps one too many if a
  /// vertex is close to the line of centers of a band's outermost row.
  [[nodiscard]] RowRange bands_of(const Triangle& p_ndc) const {
    // For a window about as small as the smallest doubles, the division has overflowed.
    if (!(rows_per_dy_ <= std::numeric_limits<double>::max())) return all_drawn();
    const double a = p_ndc[0].y, b = p_ndc[1].y, c = p_ndc[2].y;
    const double low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
    // The unit is rows from the top of the screen, clamped to the screen and one more row.
    const double above = std::clamp((grid_.top_y - high) * rows_per_dy_ - kReach, -1.0, 1.0 * grid_.rows);
    const double below = std::clamp((grid_.top_y - low) * rows_per_dy_ + kReach, -1.0, 1.0 * grid_.rows);
    // These are rounded up and down: a conversion truncates, which rounds a nonnegative number down.
    const int first_row = std::max(grid_.rows - static_cast<int>(grid_.rows - above), drawn_.first);
    const int last_row = std::min(static_cast<int>(below + 1) - 1, drawn_.end - 1);
    const int end = (last_row >> height_bits_) + 1, first = first_row >> height_bits_;
    return {first, first_row > last_row ? first : end};
  }

 private:
  [[nodiscard]] RowRange all_drawn() const {
    return {drawn_.first >> height_bits_, ((drawn_.end - 1) >> height_bits_) + 1};
  }

  // A margin in rows. On the screen, a row number is calculated to within 2^-33.
  static constexpr double kReach = 0x1p-20;
  static constexpr int kBytesInCache = 1 << 19;
  static constexpr int kMaxCount = 512;

  static int height_bits_for(const Viewport& screen) {
    const int in_cache = std::clamp(kBytesInCache / (kBytesPerPixel * screen.columns), 8, 64);
    const int least = (screen.rows + kMaxCount - 1) / kMaxCount;
    return std::max(std::bit_width(static_cast<unsigned>(in_cache)) - 1,
                    std::bit_width(static_cast<unsigned>(least - 1)));
  }

  PixelGrid grid_;
  RowRange drawn_;
  double rows_per_dy_;
  int height_bits_;  // a band has 2^height_bits_ rows
};

/// Draws a picture band by band: for several batches, all triangles that reach one band are drawn before the
/// next band's, so that the band's pixels stay in the cache. With several threads, each band is drawn by one
/// of them while the caller reads on. A pixel belongs to one band, and a band's triangles are drawn in the
/// order of the stream, so the result does not depend on the number of threads. `Visible` has a class
/// Drawer(visible, rows) with draw(triangle, tag) and finish(), which touch only these rows.
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

  /// Swaps the batch in and hands back an old one to refill. Draws it at the latest in finish().
  void draw(TaggedBatch& batch) {
    is_idle_ = false;
    Round& round = rounds_[filling_];
    std::swap(round.batches[round.batch_count], batch);
    sort_into_bands(round);
    if (round.is_full()) draw_round();
  }
  /// Draws all batches that still wait.
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
    /// drawn while a band's pixels are in the cache; small ones over few, so that the triangles stay in the
    /// cache.
    [[nodiscard]] bool is_full() const {
      const bool is_of_small_triangles = entry_count < 2 * triangle_count;
      return batch_count == kMaxBatches || entry_count >= kMaxEntries ||
             (batch_count >= kBatchesInCache && is_of_small_triangles);
    }

    std::array<TaggedBatch, kMaxBatches> batches;
    std::vector<std::vector<Entry>> bands;  // the triangles that reach each band
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

/// Draws on the threads of a pool. The result is as if the triangles were drawn one after the other, for any
/// number of threads. `Visible` is as for BandDrawing, made from a screen and the background's tag.
///
/// On one thread, batches of small triangles are drawn at once: their pixels are scattered over the picture
/// anyway, and the triangles themselves are still in the cache. All others are drawn in bands.
template <typename Visible>
class TriangleDrawing final : public Drawing {
 public:
  /// The pool may do other work, too.
  TriangleDrawing(const Viewport& screen, PixelTag background, ThreadPool& pool)
      : grid_(screen), visible_(screen, background), bands_(visible_, screen, pool) {
    if (pool.size() == 1) picture_.emplace(visible_, screen.drawn_rows());
  }

  [[nodiscard]] Visible& visible() { return visible_; }
  TaggedBatch& next() override { return next_; }
  void draw_next() override {
    assert(next_.tags.size() == next_.batch.size());
    if (!picture_ || !has_small_triangles(next_.batch)) return bands_.draw(next_);
    bands_.finish();
    for (std::size_t i = 0; i < next_.batch.size(); ++i)
      picture_->draw(exact_triangle(next_.batch, i), next_.tags[i]);
    picture_->finish();
  }
  void finish() override { bands_.finish(); }
  void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) override {
    visible_.for_each_drawn_row(visit);
  }
  void for_each_row(const std::function<void(const VisibleRow&)>& visit) const override {
    visible_.for_each_row(visit);
  }

 private:
  /// True if the triangles are small, judged by every eighth.
  [[nodiscard]] bool has_small_triangles(const TriangleBatch& batch) const {
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

  PixelGrid grid_;
  Visible visible_;
  TaggedBatch next_;
  std::optional<typename Visible::Drawer> picture_;  // on one thread: for batches drawn at once
  BandDrawing<Visible> bands_;
};

}  // namespace pipeline
