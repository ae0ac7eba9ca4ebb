#include "libpipeline/picture/certain_pixels.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/stream/memory.h"

namespace pipeline {
namespace {

/// The length of the blocks of a row that are skipped where a triangle is hidden.
constexpr int kBlockColumns = 32;
/// A triangle whose box has at most so many pixels is looked up there before its sides are calculated.
constexpr int kFewPixels = 64;
/// Of a column, more than the divisions for it can lose on a screen.
constexpr double kMargin = 1e-6;

/// The columns of a row that a triangle may cover, and those that it surely covers, counted from the first of
/// its outline.
struct Columns {
  Columns(const TrueOutline& outline, int row) {
    const double count = outline.columns.end - outline.columns.first;
    std::array<double, 2> low = {-0.5, -0.5}, high = {count - 0.5, count - 0.5};
    for (const Side& side : outline.sides) {
      const double crossing = side.crossing(row);
      for (std::size_t i = 0; i < 2; ++i) {
        low[i] = std::max(low[i], crossing + side.low[i]);
        high[i] = std::min(high[i], crossing + side.high[i]);
      }
    }
    // Conversions to int round down.
    const auto rounded = [](double at, double by) { return static_cast<int>(at + (1 + by)); };
    possible = {rounded(std::min(low[0], count), -kMargin), rounded(std::max(high[0], -1.0), kMargin)};
    sure = {rounded(std::min(low[1], count), kMargin), rounded(std::max(high[1], -1.0), -kMargin)};
  }

  RowRange possible, sure;
};

}  // namespace

/// The pixels and the depths of a triangle on a row, by column from the first of its outline.
struct CertainPixels::Row {
  [[nodiscard]] double nearest(int column) const { return std::max(nearest_at_0 + nearest_per_column * column, least); }
  [[nodiscard]] double farthest(int column) const {
    return std::min(farthest_at_0 + farthest_per_column * column, greatest);
  }
  [[nodiscard]] double& sure(int column) const { return pixels[column]; }
  [[nodiscard]] double& sure_number(int column) const { return pixels[stride + column]; }
  [[nodiscard]] double& possible(int column) const { return pixels[2 * stride + column]; }
  [[nodiscard]] double& second_possible(int column) const { return pixels[3 * stride + column]; }

  double number;
  double nearest_per_column, farthest_per_column, least, greatest;
  bool is_limited;  // may be before the front limit, cut, or behind the rear limit
  std::ptrdiff_t stride;
  double* pixels = nullptr;
  double nearest_at_0 = 0, farthest_at_0 = 0;
};

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : screen_(screen),
      outlines_(screen, bounds, projected),
      front_(outlines_.depths_at(screen.front)),
      rear_(outlines_.depths_at(screen.rear)),
      block_count_((screen.columns + kBlockColumns - 1) / kBlockColumns) {
  front_[1] = std::max(front_[1], outlines_.near_depth());
  const auto rows = static_cast<std::size_t>(screen.drawn_row_count());
  expect_available_memory(4 * static_cast<std::size_t>(screen.columns) * rows * sizeof(double));
  pixels_.resize(4 * static_cast<std::size_t>(screen.columns) * rows, kFar);
  farthest_.resize(static_cast<std::size_t>(block_count_) * rows, kFar);
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  TrueOutline outline;
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    outlines_.set_box(outline, p_ndc, i);
    if (outline.is_empty() || is_hidden(outline)) continue;
    outlines_.set_sides(outline);
    Row part = {static_cast<double>(p_ndc.numbers[i]), outline.nearest.u, outline.farthest.u, outline.least,
                outline.greatest, outline.least <= front_[1] || outline.greatest >= rear_[0], screen_.columns};
    for (int row = outline.rows.first; row < outline.rows.end; ++row) add_row(part, outline, row);
  }
}

bool CertainPixels::is_hidden(const TrueOutline& outline) const {
  const int first = outline.columns.first, end = outline.columns.end;
  if (outline.greatest < front_[0] || outline.least > rear_[1]) return true;
  if ((end - first) * (outline.rows.end - outline.rows.first) > kFewPixels) return false;
  for (int row = outline.rows.first; row < outline.rows.end; ++row) {
    const double* const sure = &pixels_[index_of(row, 0)];
    for (int column = first; column < end; ++column)
      if (!(sure[column] < outline.least)) return false;
  }
  return true;
}

void CertainPixels::add_row(Row& part, const TrueOutline& outline, int row) {
  const int first = outline.columns.first, in_outline = row - outline.rows.first;
  const auto& [columns, sure_columns] = Columns(outline, in_outline);
  if (columns.first >= columns.end) return;
  part.pixels = &pixels_[index_of(row, first)];
  part.nearest_at_0 = outline.nearest.v * in_outline + outline.nearest.constant;
  part.farthest_at_0 = outline.farthest.v * in_outline + outline.farthest.constant;
  double* const farthest = &farthest_[static_cast<std::size_t>((row - screen_.drawn_rows().first) * block_count_)];
  // The block's nearest column, which may be beyond the triangle.
  const int nearest_in_block = part.nearest_per_column < 0 ? kBlockColumns - 1 : 0;
  const int end_block = (first + columns.end - 1) / kBlockColumns + 1;
  for (int block = (first + columns.first) / kBlockColumns; block < end_block; ++block) {
    const int begin = block * kBlockColumns - first;
    if (part.nearest(begin + nearest_in_block) > farthest[block]) continue;  // hidden
    const int end = std::min(begin + kBlockColumns, screen_.columns - first);
    const auto within = [&](const RowRange& all) {
      return RowRange{std::clamp(all.first, begin, end), std::clamp(all.end, begin, end)};
    };
    add_block(part, within(columns), within(sure_columns));
    if (!part.is_limited && sure_columns.first <= begin && sure_columns.end >= end)
      farthest[block] =
          std::min(farthest[block], part.farthest(part.farthest_per_column < 0 ? begin : end - 1));
  }
}

void CertainPixels::add_block(const Row& row, const RowRange& columns, const RowRange& sure) const {
  if (row.is_limited) return add_near_limits(row, columns, sure);
  const int begin = std::max(columns.first, sure.first), end = std::max(begin, sure.end);
  add_pixels<false>(row, columns.first, std::min(begin, columns.end));
  add_pixels<true>(row, begin, end);
  add_pixels<false>(row, end, columns.end);
}

/// Where no limit is near. Written so that compilers make vectors of it.
template <bool kIsSure>
void CertainPixels::add_pixels(const Row& of, int begin, int end) {
  const Row row = of;  // no pixel may be part of it
  const double number = row.number;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const double nearest = row.nearest(i), other = row.possible(i);
    row.second_possible(i) = std::min(row.second_possible(i), std::max(other, nearest));
    row.possible(i) = std::min(other, nearest);
    if constexpr (kIsSure) {
      const double farthest = row.farthest(i), before = row.sure(i), number_before = row.sure_number(i);
      row.sure(i) = std::min(before, farthest);
      row.sure_number(i) = before - farthest > 0 ? number : number_before;
    }
  }
}

/// Where a triangle, or a part of it, may be beyond a limit.
void CertainPixels::add_near_limits(const Row& row, const RowRange& columns, const RowRange& sure) const {
  for (int i = columns.first; i < columns.end; ++i) {
    const double nearest = row.nearest(i), farthest = row.farthest(i);
    if (farthest < front_[0] || nearest > rear_[1]) continue;
    const double shown = std::max(nearest, front_[0]);
    row.second_possible(i) = std::min(row.second_possible(i), std::max(row.possible(i), shown));
    row.possible(i) = std::min(row.possible(i), shown);
    const bool is_sure = i >= sure.first && i < sure.end && nearest > front_[1] && farthest < rear_[0];
    if (!is_sure || farthest >= row.sure(i)) continue;
    row.sure(i) = farthest;
    row.sure_number(i) = row.number;
  }
}

}  // namespace pipeline
