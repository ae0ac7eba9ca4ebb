#include "libpipeline/picture/certain_pixels.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "libpipeline/stream/memory.h"

namespace pipeline {

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : screen_(screen),
      outlines_(screen, bounds, projected),
      front_(outlines_.distance_at(screen.front)),
      rear_(outlines_.distance_at(screen.rear)) {
  const std::size_t count = index_of(screen.drawn_rows().end, 0);
  expect_available_memory(count * sizeof(Pixel));
  pixels_.resize(count);
}

std::size_t CertainPixels::index_of(int row, int column) const {
  return static_cast<std::size_t>(row - screen_.drawn_rows().first) *
             static_cast<std::size_t>(screen_.columns) +
         static_cast<std::size_t>(column);
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    const auto whole = p_ndc.unclipped.empty() ? nullptr : p_ndc.unclipped[i];
    if (whole && whole == last_whole_) continue;
    last_whole_ = whole;
    const TrueOutline outline = outlines_.of(p_ndc, i);
    for (int row = outline.rows.first; row < outline.rows.end; ++row)
      add_row(outline, row, static_cast<std::int64_t>(p_ndc.numbers[i]));
  }
}

CertainPixels::Columns CertainPixels::columns_of(const TrueOutline& outline, double v) const {
  const double step = outlines_.step(0);
  const auto u = [&](int column) { return (column - outline.column) * step; };
  // What linear functions demand holds between two columns where it holds.
  const auto trim = [](RowRange& columns, auto holds) {
    while (columns.first < columns.end && !holds(columns.first)) ++columns.first;
    while (columns.first < columns.end && !holds(columns.end - 1)) --columns.end;
  };
  RowRange columns = outline.columns;
  const std::span possible = std::span(outline.possible).first(outline.possible_count);
  for (const Linear& f : possible) {
    if (columns.end - columns.first < 8) break;  // the division takes longer
    // Within a pixel of the column where the function is 0, to begin with.
    const double zero = -f.at(0, v) / (f.u * step);
    if (std::isnan(zero)) continue;
    const auto column = static_cast<int>(std::floor(std::clamp(zero, -1e6, 1e6))) + outline.column;
    if (f.u * step > 0) columns.first = std::max(columns.first, column - 1);
    if (f.u * step < 0) columns.end = std::min(columns.end, column + 3);
  }
  trim(columns, [&](int column) {
    return std::ranges::none_of(possible, [&](const Linear& f) { return f.at(u(column), v) < 0; });
  });
  RowRange sure = outline.may_be_sure ? columns : RowRange{0, 0};
  trim(sure, [&](int column) {
    return std::ranges::all_of(outline.sure, [&](const Linear& f) { return f.at(u(column), v) > 0; });
  });
  return {columns, sure};
}

void CertainPixels::add_row(const TrueOutline& outline, int row, std::int64_t number) {
  const double v = (row - outline.row) * outlines_.step(1);
  const auto [columns, sure] = columns_of(outline, v);
  for (int column = columns.first; column < columns.end; ++column) {
    Pixel& pixel = pixels_[index_of(row, column)];
    if (outline.nearest > pixel.sure) continue;  // hidden
    const auto [nearest, farthest] = outline.distances((column - outline.column) * outlines_.step(0), v);
    if (farthest < front_.first || nearest > rear_.second) continue;
    const double shown = std::min(std::max(nearest, front_.first), std::numeric_limits<double>::max());
    pixel.second_possible = std::min(pixel.second_possible, std::max(pixel.possible, shown));
    pixel.possible = std::min(pixel.possible, shown);
    const bool is_sure = column >= sure.first && column < sure.end &&
                         farthest < std::min(pixel.sure, rear_.first) &&
                         nearest > std::max(front_.second, outlines_.near());
    if (!is_sure) continue;
    pixel.sure = farthest;
    pixel.sure_number = number;
  }
}

bool CertainPixels::is_certain(int row, int column, std::int64_t number) const {
  const Pixel& pixel = pixels_[index_of(row, column)];
  if (number < 0) return pixel.possible == Pixel::kFar;
  // The one that surely covers may, too.
  return pixel.sure_number == number && pixel.second_possible > pixel.sure;
}

}  // namespace pipeline
