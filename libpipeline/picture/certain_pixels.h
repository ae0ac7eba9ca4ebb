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
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// What is known of a picture's pixels, by the depths of true outlines.
struct PixelBounds {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  /// The length of the blocks of a row that are skipped where a triangle is hidden.
  static constexpr int kBlockColumns = 32;
  /// A row's arrays are longer than it, so that vectors of columns that begin in it end in them.
  static constexpr int kPadding = 7;

  [[nodiscard]] std::size_t index_of(int row, int column) const {
    return 4 * static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(column);
  }

  int columns, first_row;
  std::ptrdiff_t stride, block_count;
  std::array<double, 2> front, rear;  // depths that these limits lie between
  // For each row, by column: the least upper bound on the depths of those triangles that surely cover the
  // pixel's center; the bits of the number of that one; and the two least lower bounds of those that may
  // cover it.
  std::vector<double> pixels = {};
  /// For each block of a row, a depth that no upper bound there exceeds.
  std::vector<double> farthest = {};
};

/// Which pixels show, by rule `center`, the triangle that exact arithmetic shows, whatever the true vertices
/// are within the bounds of a projected text: the pixels of which some triangle surely covers the center, and
/// no other may be as near there, or that no triangle may cover.
class CertainPixels {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Takes the next triangles. Pieces stand for the triangle that they were cut from.
  void add(const TriangleBatch& p_ndc);
  /// Calls `visit(column)` for the pixels of a drawn row that might show another triangle than that of their
  /// tag, of the number number_of(tag), or any at all where that is -1.
  template <typename Tag, typename NumberOf, typename Visit>
  void for_each_uncertain(int row, std::span<const Tag> tags, NumberOf&& number_of, Visit&& visit) const {
    const std::ptrdiff_t stride = bounds_.stride;
    const double* pixel = &bounds_.pixels[bounds_.index_of(row, 0)];
    Tag last = tags[0];
    std::int64_t number = number_of(last);
    for (std::size_t i = 0; i < tags.size(); ++i, ++pixel) {
      if (tags[i] != last) number = number_of(last = tags[i]);
      // The one that surely covers may, too.
      const bool is_certain =
          number < 0 ? pixel[2 * stride] == PixelBounds::kFar
                     : std::bit_cast<std::int64_t>(pixel[stride]) == number && pixel[3 * stride] > pixel[0];
      if (!is_certain) visit(static_cast<int>(i));
    }
  }

 private:
  TrueView view_;
  PixelBounds bounds_;
  std::vector<std::size_t> indices_;  // of a batch's triangles that count
  std::shared_ptr<const ClipTriangle> last_whole_;
};

}  // namespace pipeline
