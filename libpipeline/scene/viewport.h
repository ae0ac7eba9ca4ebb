#pragma once

#include <algorithm>
#include <limits>

namespace pipeline {

/// The largest width and height, in pixels.
constexpr int kMaxViewportSize = 65535;

/// -left and -bottom lie in [kMinLimit, kMaxLimit], so that neither a pixel's size nor the distance from a
/// pixel to any finite vertex leaves the range of a double.
constexpr double kMinLimit = 1e-200;
constexpr double kMaxLimit = 1e200;

/// Rows, or bands of rows, from `first` to before `end`.
struct RowRange {
  int first = 0;
  int end = std::numeric_limits<int>::max();

  friend bool operator==(const RowRange&, const RowRange&) = default;
};

/// The viewport transform's parameters: the window [left, -left] x [bottom, -bottom] of NDC becomes
/// columns x rows pixels, row 0 at the top, column 0 on the left. Depths are visible where front <= z < rear.
struct Viewport {
  int columns = 0;
  int rows = 0;
  double left = -1;
  double bottom = -1;
  double front = -1;
  double rear = 1;
  /// For exact calculations: true where the limit was written as a decimal number with at most 7 decimals.
  /// Then it stands for that decimal (limit + low part, rounded to 7 decimals), not for its nearest double.
  bool left_is_decimal = false;
  bool bottom_is_decimal = false;
  double left_low_part = 0;
  double bottom_low_part = 0;
  /// The rows to draw, all or a band; rows beyond the screen are ignored. The other members describe the
  /// whole picture.
  RowRange drawn = {};

  [[nodiscard]] RowRange drawn_rows() const { return {drawn.first, std::min(drawn.end, rows)}; }
  [[nodiscard]] int drawn_row_count() const { return drawn_rows().end - drawn.first; }
  /// The width and height of a pixel in NDC.
  [[nodiscard]] double dx() const { return -2 * left / columns; }
  [[nodiscard]] double dy() const { return -2 * bottom / rows; }
  /// The center of the pixel (0, 0) in NDC.
  [[nodiscard]] double left_x() const { return left + dx() / 2; }
  [[nodiscard]] double top_y() const { return -bottom - dy() / 2; }

  friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// The positions of a viewport's pixel centers in NDC, rounded: row 0 at the top, column 0 on the left. A
/// bound on their error: tests/proofs/pixel_center.g.
struct PixelGrid {
  explicit PixelGrid(const Viewport& viewport)
      : columns(viewport.columns),
        rows(viewport.rows),
        half_width(-viewport.left),
        half_height(-viewport.bottom),
        left_x(viewport.left_x()),
        top_y(viewport.top_y()),
        dx(viewport.dx()),
        dy(viewport.dy()) {}

  [[nodiscard]] double x_of(int column) const { return left_x + column * dx; }
  [[nodiscard]] double y_of(int row) const { return top_y - row * dy; }

  int columns;
  int rows;
  double half_width;  // of the window, exactly; the numbers below are rounded
  double half_height;
  double left_x;
  double top_y;
  double dx;
  double dy;
};

}  // namespace pipeline
