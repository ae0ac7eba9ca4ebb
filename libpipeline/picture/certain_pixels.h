#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
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
  /// Whether the pixel of a drawn row certainly shows the triangle `number`; -1: none.
  [[nodiscard]] bool is_certain(int row, int column, std::int64_t number) const {
    const std::size_t i = index_of(row, column);
    if (number < 0) return possible_[i] == kFar;
    // The one that surely covers may, too.
    return sure_numbers_[i] == static_cast<double>(number) && second_possible_[i] > sure_[i];
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Row;

  [[nodiscard]] bool is_hidden(const TrueOutline& outline) const;
  void add_row(const TrueOutline& outline, int row, std::int64_t number);
  void add_block(const Row& row, const RowRange& columns, const RowRange& sure) const;
  template <bool kIsSure>
  static void add_pixels(const Row& part, int begin, int end);
  void add_near_limits(const Row& row, const RowRange& columns, const RowRange& sure) const;
  [[nodiscard]] std::size_t index_of(int row, int column) const {
    return static_cast<std::size_t>(row - screen_.drawn_rows().first) *
               static_cast<std::size_t>(screen_.columns) +
           static_cast<std::size_t>(column);
  }

  Viewport screen_;
  TrueOutlines outlines_;
  std::array<double, 2> front_, rear_;  // depths that these limits lie between
  std::shared_ptr<const ClipTriangle> last_whole_;
  // By pixel: the least upper bound on the depths of those triangles that surely cover its center, and whose
  // it is; and the two least lower bounds of those that may.
  std::vector<double> sure_, possible_, second_possible_, sure_numbers_;
  /// By block of a row: a depth that is not below `sure_` there.
  int block_count_;
  std::vector<double> farthest_;
};

}  // namespace pipeline
