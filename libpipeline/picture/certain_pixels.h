#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/picture/true_outline.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The depths of a triangle on a row, by column from the first of its outline.
struct RowDepths {
  [[nodiscard]] double nearest(int column) const {
    return std::max(nearest_at_0 + nearest_per_column * column, least);
  }
  [[nodiscard]] double farthest(int column) const {
    return std::min(farthest_at_0 + farthest_per_column * column, greatest);
  }

  std::uint64_t number;  // of the triangle
  int first_column;
  double nearest_at_0, nearest_per_column, farthest_at_0, farthest_per_column, least, greatest;
};

/// What is known of a picture's pixels, by the depths of true outlines.
struct PixelBounds {
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  /// Some pixels of a row.
  struct Block {
    double farthest = kFar;  // a depth that no upper bound there exceeds
    bool is_free = true;     // of any triangle
    /// The only triangle so far, which surely covers all of its pixels. They do not have it yet.
    std::optional<RowDepths> alone = {};
  };

  /// The length of the blocks of a row that are skipped where a triangle is hidden.
  static constexpr int kBlockColumns = 32;
  /// A row's arrays are longer than it, so that vectors of columns that begin in it end in them.
  static constexpr int kPadding = 7;

  [[nodiscard]] std::size_t index_of(int row, int column) const {
    return 4 * static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] std::size_t block_of(int row, int column) const {
    return static_cast<std::size_t>((row - first_row) * block_count + column / kBlockColumns);
  }

  int columns, first_row, end_row;  // those that are drawn
  std::ptrdiff_t stride, block_count;
  std::array<double, 2> front, rear;  // depths that these limits lie between
  // For each row, by column: the least upper bound on the depths of those triangles that surely cover the
  // pixel's center; the bits of the number of that one; and the two least lower bounds of those that may
  // cover it.
  std::vector<double> pixels = {};
  std::vector<Block> blocks = {};  // of each row
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
    const double* const pixels = &bounds_.pixels[bounds_.index_of(row, 0)];
    const PixelBounds::Block* block = &bounds_.blocks[bounds_.block_of(row, 0)];
    for (std::size_t begin = 0, end = 0; begin < tags.size(); begin = end, ++block) {
      end = std::min(begin + PixelBounds::kBlockColumns, tags.size());
      Tag last = tags[begin];
      std::int64_t number = number_of(last);
      const auto is_alone = [&] {
        return number >= 0 && std::bit_cast<std::int64_t>(block->alone->number) == number;
      };
      const auto of_block = tags.subspan(begin, end - begin);
      if (block->alone && is_alone() && std::ranges::count(of_block, last) == std::ssize(of_block)) continue;
      const double* pixel = pixels + begin;
      for (std::size_t i = begin; i < end; ++i, ++pixel) {
        if (tags[i] != last) number = number_of(last = tags[i]);
        // The one that surely covers may, too.
        const bool is_certain = block->alone ? is_alone()
                                : number < 0 ? pixel[2 * stride] == PixelBounds::kFar
                                             : std::bit_cast<std::int64_t>(pixel[stride]) == number &&
                                                   pixel[3 * stride] > pixel[0];
        if (!is_certain) visit(static_cast<int>(i));
      }
    }
  }

 private:
  TrueView view_;
  PixelBounds bounds_;
  std::vector<std::size_t> indices_;  // of a batch's triangles that count
  std::shared_ptr<const ClipTriangle> last_whole_;
};

}  // namespace pipeline
