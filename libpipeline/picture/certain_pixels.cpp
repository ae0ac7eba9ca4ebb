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
    double low = -0.5, sure_low = low, high = count - 0.5, sure_high = high;
    for (const Side& side : outline.sides) {
      const double crossing = side.crossing(row);
      low = std::max(low, crossing + side.low);
      high = std::min(high, crossing + side.high);
      sure_low = std::max(sure_low, crossing + side.sure_low);
      sure_high = std::min(sure_high, crossing + side.sure_high);
    }
    // Conversions to int round down.
    const auto rounded = [](double at, double by) { return static_cast<int>(at + (1 + by)); };
    possible = {rounded(std::min(low, count), -kMargin), rounded(std::max(high, -1.0), kMargin)};
    sure = {rounded(std::min(sure_low, count), kMargin), rounded(std::max(sure_high, -1.0), -kMargin)};
  }

  RowRange possible, sure;
};

}  // namespace

/// The part of a triangle on a row. Its columns are counted from that of the first of these pixels.
struct CertainPixels::Row {
  [[nodiscard]] double nearest(int column) const {
    return std::max(nearest_at_0 + nearest_per_column * column, least);
  }
  [[nodiscard]] double farthest(int column) const {
    return std::min(farthest_at_0 + farthest_per_column * column, greatest);
  }

  double* sure;
  double* possible;
  double* second_possible;
  double* sure_numbers;
  double nearest_at_0, nearest_per_column, farthest_at_0, farthest_per_column, least, greatest;
  double number;
  bool is_limited;  // may be before the front limit, cut, or behind the rear limit
};

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : screen_(screen),
      outlines_(screen, bounds, projected),
      front_(outlines_.depths_at(screen.front)),
      rear_(outlines_.depths_at(screen.rear)),
      block_count_((screen.columns + kBlockColumns - 1) / kBlockColumns) {
  front_[1] = std::max(front_[1], outlines_.near_depth());
  const std::size_t count = index_of(screen.drawn_rows().end, 0);
  expect_available_memory(4 * count * sizeof(double));
  for (auto* pixels : {&sure_, &possible_, &second_possible_, &sure_numbers_}) pixels->resize(count, kFar);
  farthest_.resize(static_cast<std::size_t>(block_count_) * static_cast<std::size_t>(screen.drawn_row_count()), kFar);
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
    for (int row = outline.rows.first; row < outline.rows.end; ++row)
      add_row(outline, row, static_cast<std::int64_t>(p_ndc.numbers[i]));
  }
}

bool CertainPixels::is_hidden(const TrueOutline& outline) const {
  const auto& [columns, rows] = std::pair(outline.columns, outline.rows);
  if (outline.greatest < front_[0] || outline.least > rear_[1]) return true;
  if ((columns.end - columns.first) * (rows.end - rows.first) > kFewPixels) return false;
  for (int row = rows.first; row < rows.end; ++row)
    for (std::size_t i = index_of(row, columns.first), end = index_of(row, columns.end); i < end; ++i)
      if (!(sure_[i] < outline.least)) return false;
  return true;
}

void CertainPixels::add_row(const TrueOutline& outline, int row, std::int64_t number) {
  const int first = outline.columns.first, in_outline = row - outline.rows.first;
  const auto& [columns, sure_columns] = Columns(outline, in_outline);
  if (columns.first >= columns.end) return;
  const std::size_t at = index_of(row, first);
  const auto at_0 = [&](const Linear& f) { return f.v * in_outline + f.constant; };
  const Row part = {&sure_[at], &possible_[at], &second_possible_[at], &sure_numbers_[at],
                    at_0(outline.nearest), outline.nearest.u, at_0(outline.farthest), outline.farthest.u,
                    outline.least, outline.greatest, static_cast<double>(number),
                    outline.least <= front_[1] || outline.greatest >= rear_[0]};
  const int first_block = first / kBlockColumns, shift = first_block * kBlockColumns - first;
  double* const farthest = &farthest_[static_cast<std::size_t>(row - screen_.drawn_rows().first) * block_count_ + first_block];
  // The block's nearest column, which may be beyond the triangle.
  const int nearest_in_block = shift + (part.nearest_per_column < 0 ? kBlockColumns - 1 : 0);
  for (int block = (columns.first - shift) / kBlockColumns, end = (columns.end - 1 - shift) / kBlockColumns; block <= end; ++block) {
    if (part.nearest(block * kBlockColumns + nearest_in_block) > farthest[block]) continue;  // hidden
    const int begin = block * kBlockColumns + shift;
    const RowRange whole = {begin, std::min(begin + kBlockColumns, screen_.columns - first)};
    const auto within = [&](const RowRange& part_of) {
      return RowRange{std::clamp(part_of.first, whole.first, whole.end), std::clamp(part_of.end, whole.first, whole.end)};
    };
    add_block(part, within(columns), within(sure_columns));
    if (!part.is_limited && sure_columns.first <= whole.first && sure_columns.end >= whole.end)
      farthest[block] = std::min(farthest[block], part.farthest(part.farthest_per_column < 0 ? whole.first : whole.end - 1));
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
void CertainPixels::add_pixels(const Row& row, int begin, int end) {
  const double number = row.number;
#pragma GCC ivdep
  for (int i = begin; i < end; ++i) {
    const double nearest = row.nearest(i), other = row.possible[i];
    row.second_possible[i] = std::min(row.second_possible[i], std::max(other, nearest));
    row.possible[i] = std::min(other, nearest);
    if constexpr (kIsSure) {
      const double farthest = row.farthest(i), before = row.sure[i], number_before = row.sure_numbers[i];
      row.sure[i] = std::min(before, farthest);
      row.sure_numbers[i] = before - farthest > 0 ? number : number_before;
    }
  }
}

/// Where a triangle, or a part of it, may be beyond a limit.
void CertainPixels::add_near_limits(const Row& part, const RowRange& columns, const RowRange& sure) const {
  for (int i = columns.first; i < columns.end; ++i) {
    const double nearest = part.nearest(i), farthest = part.farthest(i);
    if (farthest < front_[0] || nearest > rear_[1]) continue;
    const double shown = std::max(nearest, front_[0]);
    part.second_possible[i] = std::min(part.second_possible[i], std::max(part.possible[i], shown));
    part.possible[i] = std::min(part.possible[i], shown);
    if (i < sure.first || i >= sure.end || !(farthest < std::min(part.sure[i], rear_[0])) || nearest <= front_[1])
      continue;
    part.sure[i] = farthest;
    part.sure_numbers[i] = part.number;
  }
}

}  // namespace pipeline
