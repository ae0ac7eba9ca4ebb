#pragma once

#include <algorithm>
#include <bit>
#include <limits>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// A picture cut into bands of neighboring rows, enough for every thread. Bands that are not drawn stay
/// empty, and each is low enough that its depths and tags stay in a core's cache while many triangles are
/// drawn into it.
class RowBands {
 public:
  /// A double and a PixelTag.
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

  /// The bands in which a triangle in NDC can have pixels by any coverage rule; there may be one too many
  /// where a vertex is close to the line of centers of a band's outermost row.
  [[nodiscard]] RowRange bands_of(const Triangle& p_ndc) const {
    // In a window whose size is near the smallest doubles, the division would overflow.
    if (!(rows_per_dy_ <= std::numeric_limits<double>::max())) return all_drawn();
    const double a = p_ndc[0].y, b = p_ndc[1].y, c = p_ndc[2].y;
    const double low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
    // In rows from the top of the screen, clamped to the screen and one more row.
    const double above = std::clamp((grid_.top_y - high) * rows_per_dy_ - kReach, -1.0, 1.0 * grid_.rows);
    const double below = std::clamp((grid_.top_y - low) * rows_per_dy_ + kReach, -1.0, 1.0 * grid_.rows);
    // Rounded up and down: a conversion truncates, which rounds a number down unless it is negative.
    const int first_row = std::max(grid_.rows - static_cast<int>(grid_.rows - above), drawn_.first);
    const int last_row = std::min(static_cast<int>(below + 1) - 1, drawn_.end - 1);
    const int end = (last_row >> height_bits_) + 1, first = first_row >> height_bits_;
    return {first, first_row > last_row ? first : end};
  }

 private:
  [[nodiscard]] RowRange all_drawn() const {
    return {drawn_.first >> height_bits_, ((drawn_.end - 1) >> height_bits_) + 1};
  }

  // In rows. On the screen, a row number is calculated to within 2^-33.
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

}  // namespace pipeline
