#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "libpipeline/picture/true_outline.h"

namespace pipeline {

/// Which pixels show, by rule `center`, the triangle that exact arithmetic shows, whatever the true vertices
/// are within the bounds of a projected text: the pixels of which some triangle surely covers the center, and
/// no other may be as near there, or that no triangle may cover.
class CertainPixels {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Takes the next triangles. Pieces stand for the triangle that they were cut from.
  void add(const TriangleBatch& p_ndc);
  /// Calls `visit(column)` for the pixels of a drawn row that might show another triangle than that of the
  /// number, or any at all where it is -1.
  template <typename Visit>
  void for_each_uncertain(int row, std::span<const std::int64_t> numbers, Visit&& visit) const {
    const auto stride = static_cast<std::size_t>(screen_.columns);
    const double* pixel = &pixels_[index_of(row, 0)];  // as Row has them
    for (std::size_t i = 0; i < stride; ++i, ++pixel) {
      // The one that surely covers may, too.
      const bool is_certain = numbers[i] < 0 ? pixel[2 * stride] == kFar
                                             : std::bit_cast<std::int64_t>(pixel[stride]) == numbers[i] &&
                                                   pixel[3 * stride] > pixel[0];
      if (!is_certain) visit(static_cast<int>(i));
    }
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Row;

  [[nodiscard]] bool is_hidden(const TrueOutline& outline) const;
  void add_row(Row& part, const TrueOutline& outline, int row);
  template <bool kIsSure>
  static void add_pixels(const Row& of, int begin, int end);
  void add_near_limits(const Row& row, const RowRange& columns, const RowRange& sure) const;
  [[nodiscard]] std::size_t index_of(int row, int column) const {
    return 4 * static_cast<std::size_t>(row - screen_.drawn_rows().first) *
               static_cast<std::size_t>(screen_.columns) +
           static_cast<std::size_t>(column);
  }

  Viewport screen_;
  TrueOutlines outlines_;
  std::array<double, 2> front_, rear_;  // depths that these limits lie between
  std::shared_ptr<const ClipTriangle> last_whole_;
  // For each row, by column: the least upper bound on the depths of those triangles that surely cover the
  // pixel's center; the bits of the number of that one; and the two least lower bounds of those that may
  // cover it.
  std::vector<double> pixels_;
  /// For each block of a row, a depth that no upper bound there exceeds.
  int block_count_;
  std::vector<double> farthest_;
};

}  // namespace pipeline
