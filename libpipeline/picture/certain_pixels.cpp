#include "libpipeline/picture/certain_pixels.h"

#include <algorithm>
#include <bit>

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
  [[nodiscard]] double nearest(int column) const {
    return std::max(nearest_at_0 + nearest_per_column * column, least);
  }
  [[nodiscard]] double farthest(int column) const {
    return std::min(farthest_at_0 + farthest_per_column * column, greatest);
  }
  [[nodiscard]] double& sure(int column) const { return pixels[column]; }
  [[nodiscard]] double& sure_number(int column) const { return pixels[stride + column]; }
  [[nodiscard]] double& possible(int column) const { return pixels[2 * stride + column]; }
  [[nodiscard]] double& second_possible(int column) const { return pixels[3 * stride + column]; }

  double number;  // its bits
  double nearest_per_column, farthest_per_column, least, greatest;
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
  front_[1] = std::max(front_[1], outlines_.near_depth());  // what is nearer may be cut
  const std::size_t count = index_of(screen.drawn_rows().end, 0);
  expect_available_memory(count * sizeof(double));
  pixels_.resize(count, kFar);
  farthest_.resize(static_cast<std::size_t>(block_count_ * screen.drawn_row_count()), kFar);
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
    Row part = {std::bit_cast<double>(p_ndc.numbers[i]),
                outline.nearest.u,
                outline.farthest.u,
                outline.least,
                outline.greatest,
                screen_.columns};
    for (int row = outline.rows.first; row < outline.rows.end; ++row) add_row(part, outline, row);
  }
}

bool CertainPixels::is_hidden(const TrueOutline& outline) const {
  const int first = outline.columns.first, end = outline.columns.end;
  if (std::int64_t{end - first} * (outline.rows.end - outline.rows.first) > kFewPixels) return false;
  for (int row = outline.rows.first; row < outline.rows.end; ++row) {
    const double* const sure = &pixels_[index_of(row, 0)];
    for (int column = first; column < end; ++column)
      if (!(sure[column] < outline.least)) return false;
  }
  return true;
}

void CertainPixels::add_row(Row& part, const TrueOutline& outline, int row) {
  const int first = outline.columns.first, in_outline = row - outline.rows.first;
  const auto& [columns, sure] = Columns(outline, in_outline);
  if (columns.first >= columns.end) return;
  part.pixels = &pixels_[index_of(row, first)];
  part.nearest_at_0 = outline.nearest.v * in_outline + outline.nearest.constant;
  part.farthest_at_0 = outline.farthest.v * in_outline + outline.farthest.constant;
  double* const farthest =
      &farthest_[static_cast<std::size_t>((row - screen_.drawn_rows().first) * block_count_)];
  const int nearest_in_block =
      part.nearest_per_column < 0 ? kBlockColumns - 1 : 0;  // beyond the outline, too
  const int end_block = (first + columns.end - 1) / kBlockColumns + 1;
  for (int block = (first + columns.first) / kBlockColumns; block < end_block; ++block) {
    const int begin = block * kBlockColumns - first;
    if (part.nearest(begin + nearest_in_block) > farthest[block]) continue;  // hidden
    const int end = std::min(begin + kBlockColumns, screen_.columns - first);
    const int from = std::max(columns.first, begin), to = std::min(columns.end, end);
    const int sure_from = std::clamp(sure.first, from, to), sure_to = std::clamp(sure.end, sure_from, to);
    if (part.least <= front_[1] || part.greatest >= rear_[0]) {
      add_near_limits(part, {from, to}, {sure_from, sure_to});
      continue;
    }
    add_pixels<false>(part, from, sure_from);
    add_pixels<true>(part, sure_from, sure_to);
    add_pixels<false>(part, sure_to, to);
    if (sure_from > begin || sure_to < end) continue;
    const int farthest_column = part.farthest_per_column < 0 ? begin : end - 1;
    farthest[block] = std::min(farthest[block], part.farthest(farthest_column));
  }
}

/// Adds pixels to a triangle that is within the limits. Written so that compilers make vectors of it.
template <bool kIsSure>
void CertainPixels::add_pixels(const Row& of, int begin, int end) {
  const Row row = of;  // in no pixel's memory
  for (int i = begin; i < end; ++i) {
    const double nearest = row.nearest(i), other = row.possible(i);
    row.second_possible(i) = std::min(row.second_possible(i), std::max(other, nearest));
    row.possible(i) = std::min(other, nearest);
    if constexpr (kIsSure) {
      const double farthest = row.farthest(i), before = row.sure(i), number_before = row.sure_number(i);
      row.sure(i) = std::min(before, farthest);
      row.sure_number(i) = before - farthest > 0 ? row.number : number_before;
    }
  }
}

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
