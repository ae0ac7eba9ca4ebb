#include "libpipeline/visibility/edge_table.h"

#include <algorithm>
#include <iterator>

namespace pipeline {
namespace {

using Edges = std::span<ActiveEdge>;

bool is_left_of(const ActiveEdge& a, const ActiveEdge& b) {
  return a.column < b.column;
}

/// Insertion sort: one step for every two edges that have crossed since the last scanline. Falls back to
/// std::sort if there are too many.
void sort_nearly_sorted(Edges edges) {
  std::size_t steps_left = 16 * edges.size();
  for (std::size_t i = 1; i < edges.size(); ++i) {
    const ActiveEdge edge = edges[i];
    std::size_t target = i;
    for (; target > 0 && is_left_of(edge, edges[target - 1]); --target) edges[target] = edges[target - 1];
    edges[target] = edge;
    if (i - target > steps_left) return std::sort(edges.begin(), edges.end(), is_left_of);
    steps_left -= i - target;
  }
}

}  // namespace

void ActiveEdgeList::sort_by_column() {
  const auto first_new = edges_.begin() + static_cast<std::ptrdiff_t>(sorted_count_);
  sort_nearly_sorted({edges_.begin(), first_new});
  std::sort(first_new, edges_.end(), is_left_of);
  std::inplace_merge(edges_.begin(), first_new, edges_.end(), is_left_of);
  sorted_count_ = edges_.size();
}

std::span<const ActiveEdge> ActiveEdgeList::on_scanline() const {
  const ActiveEdge nowhere = {kNowhere, 0, false};
  return {edges_.begin(), std::lower_bound(edges_.begin(), edges_.end(), nowhere, is_left_of)};
}

}  // namespace pipeline
