#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "libpipeline/coverage/span.h"

namespace pipeline {

/// The length of a block of neighboring pixels of a row; its first column is a multiple of it.
constexpr int kBlockColumns = 32;

/// For each block of some rows of a z-buffer, a depth that none of its pixels exceeds. Stored depths only
/// decrease, so a bound stays valid without updates. A span that is nowhere nearer than the bound within a
/// block is hidden in the whole block. Source: N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer
/// visibility", 1993. `Depth` is a depth format.
template <typename Depth>
class HierarchicalDepth {
 public:
  using Stored = typename Depth::Stored;
  /// Kernels may read this many bounds past the last block of a row.
  static constexpr std::size_t kPadding = 7;

  /// For rows of `columns` pixels. Allocates at the first call of row().
  HierarchicalDepth(const RowRange& rows, int columns)
      : rows_(rows), stride_(static_cast<std::size_t>((columns + kBlockColumns - 1) / kBlockColumns)) {}

  /// The bounds of a row, block by block; at first no less than any depth.
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
