#include "libpipeline/certainty/certain_pixels.h"

#include <algorithm>

#include "libpipeline/stream/memory.h"

namespace pipeline {

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : view_(screen, bounds, projected), screen_(screen), rows_(screen.drawn_rows()) {
  const auto [rear_from, rear_to] = view_.depths_at(screen.rear);
  expect_available_memory(index_of(rows_.end) * sizeof(PixelDepths));
  pixels_.resize(index_of(rows_.end), {.farthest = rear_to, .number = kBackground, .nearest = rear_from});
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    const UncertainTriangle triangle = view_.triangle(p_ndc, i);
    const auto [first, end] = triangle.rows;
    for (int row = std::max(first, rows_.first); row < std::min(end, rows_.end); ++row)
      add_row(triangle, row, static_cast<std::int64_t>(p_ndc.numbers[i]));
  }
}

void CertainPixels::add_row(const UncertainTriangle& triangle, int row, std::int64_t number) {
  const UncertainTriangle::Row on = triangle.row(row);
  const auto pixels = pixels_.begin() + static_cast<std::ptrdiff_t>(index_of(row)) + triangle.columns.first;
  for (int column = on.possible.first; column < on.possible.end; ++column) {
    PixelDepths& pixel = pixels[column];
    const double nearest = triangle.nearest(on, column);
    if (nearest > pixel.farthest) continue;
    pixel.second_nearest = std::min(pixel.second_nearest, std::max(pixel.nearest, nearest));
    pixel.nearest = std::min(pixel.nearest, nearest);
    if (column < on.sure.first || column >= on.sure.end) continue;
    const double farthest = triangle.farthest(on, column);
    if (farthest >= pixel.farthest) continue;
    pixel.farthest = farthest;
    pixel.number = number;
  }
}

}  // namespace pipeline
