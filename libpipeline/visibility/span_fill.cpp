#include "libpipeline/visibility/span_fill.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "libpipeline/numbers/kernel_choice.h"

namespace pipeline {
namespace {

/// Draws the span's pixels from the column `first` to before `end`; returns whether any is visible.
template <typename Depth>
bool fill_columns_in_a_loop(const SpanFill<Depth>& pixels, int first, int end) {
  const SpanDepth depth = pixels.span.depth;
  bool is_any_seen = false;
  for (int column = first; column < end; ++column) {
    const typename Depth::Stored stored = pixels.format.store(depth(column));
    if (!(stored < pixels.depths[column])) continue;
    pixels.depths[column] = stored;
    pixels.tags[column] = pixels.tag;
    is_any_seen = true;
  }
  return is_any_seen;
}

/// The kernel that runs everywhere: pixel by pixel.
template <typename Depth>
void fill_span_in_a_loop(const SpanFill<Depth>& pixels) {
  const Span& span = pixels.span;
  if (pixels.farthest == nullptr) {
    fill_columns_in_a_loop(pixels, span.first_column, span.last_column + 1);
    return;
  }
  const SpanBlocks blocks(pixels);
  const auto stored = [&](int column) { return pixels.format.store(span.depth(column)); };
  for (int block = blocks.first; block <= blocks.last; ++block) {
    const int begin = block * kBlockColumns, end = std::min(begin + kBlockColumns, pixels.columns);
    const int first = std::max(begin, span.first_column), last = std::min(end - 1, span.last_column);
    const auto [nearest, farthest] = std::minmax({stored(first), stored(last)});
    auto& farthest_there = pixels.farthest[block];
    if (!(nearest < farthest_there)) continue;
    if (!fill_columns_in_a_loop(pixels, first, last + 1))
      farthest_there = *std::max_element(pixels.depths + begin, pixels.depths + end);
    else if (block >= blocks.first_whole && block <= blocks.last_whole)
      farthest_there = std::min(farthest_there, farthest);
  }
}

template <typename Depth>
struct KernelList {
  std::array<SpanFillKernel<Depth>, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", fill_span_in_a_loop};
    if (const auto* const avx2 = span_fill_avx2<Depth>()) kernels[count++] = *avx2;
  }
};

}  // namespace

template <typename Depth>
std::span<const SpanFillKernel<Depth>> span_fill_kernels() {
  static const KernelList<Depth> list;
  return {list.kernels.data(), list.count};
}

template <typename Depth>
const SpanFillKernel<Depth>& span_fill_kernel() {
  static const SpanFillKernel<Depth>& chosen = chosen_kernel(span_fill_kernels<Depth>());
  return chosen;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a template's argument
#define PIPELINE_INSTANTIATE(Depth)                                           \
  template std::span<const SpanFillKernel<Depth>> span_fill_kernels<Depth>(); \
  template const SpanFillKernel<Depth>& span_fill_kernel<Depth>();
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace pipeline
