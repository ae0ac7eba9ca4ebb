#pragma once

#include <algorithm>

#include "libpipeline/config.h"
#include "libpipeline/pixel_grid.h"
#include "libpipeline/span.h"
#include "libpipeline/vec.h"

namespace pipeline {

/// A screen cut into bands of neighbouring rows: so many that threads can share them out, and each so low
/// that its depths and colours stay in a core's cache while many triangles are drawn into it.
class RowBands {
 public:
  explicit RowBands(const ScreenConfig& screen)
      : grid_(screen), rows_per_dy_(1 / grid_.dy), height_(height_for(screen)) {}

  [[nodiscard]] int count() const { return (grid_.rows + height_ - 1) / height_; }
  [[nodiscard]] RowRange rows(int band) const {
    return {band * height_, std::min((band + 1) * height_, grid_.rows)};
  }

  /// The bands in which a triangle in NDC can have pixels, whatever the coverage rule: perhaps one too many,
  /// where a vertex is next to the line of centres of a band's outermost row.
  [[nodiscard]] RowRange bands_of(const Triangle& p_ndc) const {
    const auto [low, high] = std::minmax({p_ndc[0].y, p_ndc[1].y, p_ndc[2].y});
    const double first = (grid_.top_y - high) * rows_per_dy_ - kReach;
    const double last = (grid_.top_y - low) * rows_per_dy_ + kReach;
    if (!(last >= 0 && first < grid_.rows)) return {0, 0};
    const double from_top = std::max(first, 0.0);
    const int above = static_cast<int>(from_top), first_row = above + static_cast<int>(above < from_top);
    const int last_row = static_cast<int>(std::min(last, grid_.rows - 1.0));
    return first_row > last_row ? RowRange{0, 0} : RowRange{first_row / height_, last_row / height_ + 1};
  }

 private:
  // In rows. On the screen, a row number is calculated to within 2^-33.
  static constexpr double kReach = 0x1p-20;
  static constexpr int kBytesInCache = 1 << 19;
  static constexpr int kMaxCount = 512;

  static int height_for(const ScreenConfig& screen) {
    constexpr int kBytesPerPixel = 12;
    const int in_cache = std::clamp(kBytesInCache / (kBytesPerPixel * screen.columns), 8, 64);
    return std::max(in_cache, (screen.rows + kMaxCount - 1) / kMaxCount);
  }

  PixelGrid grid_;
  double rows_per_dy_;
  int height_;
};

}  // namespace pipeline
