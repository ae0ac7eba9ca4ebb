#include "libpipeline/certainty/certain_pixels.h"

#include <algorithm>

#include "libpipeline/stream/memory.h"

namespace pipeline {

CertainPixels::CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : view_(screen, bounds, projected), screen_(screen), next_row_(screen.drawn_rows().first) {
  const auto [rear_from, rear_to] = view_.depths_at(screen.rear);
  const auto count =
      static_cast<std::size_t>(screen.drawn_row_count()) * static_cast<std::size_t>(screen.columns);
  expect_available_memory(count * sizeof(Pixel));
  pixels_.resize(count, {.farthest = rear_to, .number = kBackground, .nearest = rear_from});
}

std::span<CertainPixels::Pixel> CertainPixels::pixels_of(int row) {
  const auto columns = static_cast<std::size_t>(screen_.columns);
  return std::span(pixels_).subspan(static_cast<std::size_t>(row - screen_.drawn.first) * columns, columns);
}

void CertainPixels::add(const TriangleBatch& p_ndc) {
  const RowRange drawn = screen_.drawn_rows();
  for (std::size_t i = 0; i < p_ndc.size(); ++i) {
    if (!p_ndc.unclipped.empty()) {
      if (p_ndc.unclipped[i] && p_ndc.unclipped[i] == last_whole_) continue;
      last_whole_ = p_ndc.unclipped[i];
    }
    const UncertainTriangle triangle = view_.triangle(p_ndc, i);
    const auto [first, end] = triangle.rows;
    for (int row = std::max(first, drawn.first); row < std::min(end, drawn.end); ++row)
      add_row(triangle, row, static_cast<std::int64_t>(p_ndc.numbers[i]));
  }
}

void CertainPixels::add_row(const UncertainTriangle& triangle, int row, std::int64_t number) {
  const UncertainTriangle::Row on = triangle.row(row);
  const std::span pixels = pixels_of(row).subspan(static_cast<std::size_t>(triangle.columns.first));
  for (int column = on.possible.first; column < on.possible.end; ++column) {
    Pixel& pixel = pixels[static_cast<std::size_t>(column)];
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

void CertainPixels::add_row(std::span<const std::int64_t> shown) {
  const std::span<const Pixel> pixels = pixels_of(next_row_);
  for (std::size_t column = 0; column < shown.size(); ++column) {
    const Pixel& pixel = pixels[column];
    if (pixel.number == shown[column] && pixel.second_nearest > pixel.farthest) continue;
    if (++uncertain_count_ <= kMaxLines) uncertain_.emplace_back(next_row_, static_cast<int>(column));
  }
  ++next_row_;
}

std::string CertainPixels::report() const {
  std::string text = "certain " + std::to_string(pixels_.size() - uncertain_count_) + "\nuncertain " +
                     std::to_string(uncertain_count_) + "\n";
  for (const auto& [row, column] : uncertain_)
    text += std::to_string(row) + " " + std::to_string(column) + "\n";
  return text;
}

}  // namespace pipeline
