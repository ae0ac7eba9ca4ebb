#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "libpipeline/coverage/span.h"

namespace pipeline {

/// So many neighboring pixels of a row, from a multiple of it, are a block.
constexpr int kBlockColumns = 32;

/// For each block of some rows of a z-buffer a depth that no pixel of it exceeds. Depths only become less, so
/// the bound stays one without being touched; what is nowhere in a block nearer than the bound is seen
/// nowhere in it. Source: N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer visibility", 1993. `Depth` is
/// a depth format.
template <typename Depth>
class HierarchicalDepth {
 public:
  using Stored = typename Depth::Stored;
  /// Behind the last block of a row so many may be read.
  static constexpr std::size_t kPadding = 7;

  /// For rows of `columns` pixels. Takes memory when it is asked for a row.
  HierarchicalDepth(const RowRange& rows, int columns)
      : rows_(rows), stride_(static_cast<std::size_t>((columns + kBlockColumns - 1) / kBlockColumns)) {}

  /// Those of a row, block by block; at first more than any depth of a pixel.
  [[nodiscard]] Stored* row(int row) {
    if (farthest_.empty()) farthest_.assign(stride_ * row_count(rows_.end) + kPadding, kLargest);
    return &farthest_[stride_ * row_count(row)];
  }

 private:
  static constexpr Stored kLargest = std::numeric_limits<Stored>::has_infinity
                                         ? std::numeric_limits<Stored>::infinity()
                                         : std::numeric_limits<Stored>::max();
  [[nodiscard]] std::size_t row_count(int end) const { return static_cast<std::size_t>(end - rows_.first); }

  RowRange rows_;
  std::size_t stride_;
  std::vector<Stored> farthest_;
};

}  // namespace pipeline
