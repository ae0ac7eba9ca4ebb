#include "libpipeline/certainty/certain_pixels.h"

#include <algorithm>

#include "libpipeline/stream/memory.h"

namespace pipeline {

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : view_(screen, bounds, projected),
      screen_(screen),
      rows_(screen.drawn_rows()),
      front_(view_.depths_at(screen.front)) {
  front_[1] = std::max(front_[1], view_.near_depth());  // what is nearer may be cut
  const auto [rear_from, rear_to] = view_.depths_at(screen.rear);
  expect_available_memory(index_of(rows_.end) * sizeof(PixelDepths));
  pixels_.resize(index_of(rows_.end), {.farthest = rear_to, .number = kBackground, .nearest = rear_from});
  block_farthest_.resize(index_of(rows_.end) / kBlockColumns + 1, rear_to);
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    const UncertainPolygon polygon = view_.polygon(p_ndc, i);
    if (polygon.count == 0 && !polygon.is_anywhere) continue;
    Outline outline(polygon, screen_.columns, screen_.rows);
    outline.cut_before(front_);
    const RowRange& rows = outline.rows();
    for (int row = std::max(rows.first, rows_.first); row < std::min(rows.end, rows_.end); ++row)
      add_row(outline, row, static_cast<std::int64_t>(p_ndc.numbers[i]));
  }
}

void CertainPixels::add_row(const Outline& outline, int row, std::int64_t number) {
  const Outline::Row on = outline.row(row);
  const std::size_t first = index_of(row) + static_cast<std::size_t>(outline.first_column());
  const auto index = [first](int column) { return first + static_cast<std::size_t>(column); };
  for (int begin = on.possible.first, end = begin; begin < on.possible.end; begin = end) {
    const std::size_t block = index(begin) / kBlockColumns;
    const std::size_t next = (block + 1) * kBlockColumns - first;
    end = std::min(on.possible.end, static_cast<int>(next));
    // Depths are greatest and least at the ends.
    if (std::min(outline.nearest(on, begin), outline.nearest(on, end - 1)) > block_farthest_[block]) continue;
    for (int column = begin; column < end; ++column) {
      PixelDepths& pixel = pixels_[index(column)];
      const double nearest = outline.nearest(on, column);
      if (nearest > pixel.farthest) continue;
      pixel.second_nearest = std::min(pixel.second_nearest, std::max(pixel.nearest, nearest));
      pixel.nearest = std::min(pixel.nearest, nearest);
      if (column < on.sure.first || column >= on.sure.end) continue;
      const double farthest = outline.farthest(on, column);
      if (farthest >= pixel.farthest) continue;
      pixel.farthest = farthest;
      pixel.number = number;
    }
    if (on.sure.first <= begin && on.sure.end >= end && end - begin == kBlockColumns)
      block_farthest_[block] = std::min(block_farthest_[block],
                                        std::max(outline.farthest(on, begin), outline.farthest(on, end - 1)));
  }
}

}  // namespace pipeline
