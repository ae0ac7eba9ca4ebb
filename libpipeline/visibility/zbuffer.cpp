#include "libpipeline/visibility/zbuffer.h"

#include <cassert>

#include "libpipeline/coverage/span.h"
#include "libpipeline/stream/memory.h"

namespace pipeline {
namespace {

/// `a` if `takes_a`, else `b`. Branch-free: which of two depths is nearer is unpredictable.
PixelTag select(bool takes_a, PixelTag a, PixelTag b) {
  const PixelTag mask = PixelTag{0} - PixelTag{takes_a};
  return (a & mask) | (b & ~mask);
}

/// Draws into a row whose first pixel is at `depths` and `tags`. Not inlined, so that its callers can be.
template <typename Depth>
[[gnu::noinline]] void draw_pixel_by_pixel(const Span& span, PixelTag tag, const Depth& format, double front,
                                           typename Depth::Stored* depths, PixelTag* tags) {
  const SpanDepth depth = span.depth;
  const int last_column = span.last_column;
  for (int column = span.first_column; column <= last_column; ++column) {
    const double z = depth(column);
    const typename Depth::Stored stored = format.store(z);
    if (!is_drawn(z, front)) continue;
    const typename Depth::Stored old = depths[column];
    depths[column] = is_nearer(stored, old) ? stored : old;
    tags[column] = select(is_nearer(stored, old), tag, tags[column]);
  }
}

}  // namespace

template <typename Depth>
ZBuffer<Depth>::ZBuffer(const Viewport& screen, PixelTag background)
    : fill_(chosen_kernel(span_fill_kernels<Depth>())),
      format_(screen),
      front_(screen.front),
      rear_limit_(screen.rear),
      rear_(format_.store(screen.rear)),
      background_(background),
      rows_(screen.drawn_rows()),
      depths_(rows_, screen.columns),
      tags_(rows_, screen.columns),
      is_filled_(static_cast<std::size_t>(screen.drawn_row_count())) {}

template <typename Depth>
void ZBuffer<Depth>::fill_row(int row) {
  // Checks once per chunk, on any thread; never in pictures smaller than a chunk. To fill so many bytes takes
  // a hundred times as long as to ask whether the system has them.
  constexpr std::size_t kCheckedChunk = std::size_t{16} << 20;
  const std::size_t row_size =
      static_cast<std::size_t>(depths_.columns()) * (sizeof(Stored) + sizeof(PixelTag));
  const std::size_t rows_of_chunk = kCheckedChunk / row_size + 1;
  if (index_of(row) % rows_of_chunk == rows_of_chunk - 1) expect_available_memory(kCheckedChunk);
  std::ranges::fill(depths_.row(row), rear_);
  std::ranges::fill(tags_.row(row), background_);
  is_filled_[index_of(row)] = 1;
}

template <typename Depth>
void ZBuffer<Depth>::draw(const Span& span, PixelTag tag, HierarchicalDepth<Depth>* farthest) {
  if (!is_filled_[index_of(span.row)]) fill_row(span.row);
  draw_in_filled_row(span, tag, farthest);
}

template <typename Depth>
void ZBuffer<Depth>::draw_in_filled_row(const Span& span, PixelTag tag, HierarchicalDepth<Depth>* farthest) {
  assert(span.first_column >= 0 && span.last_column < depths_.columns());
  if (!(is_drawn(span.depth(span.first_column), front_) && is_drawn(span.depth(span.last_column), front_))) {
    const Span part = part_behind_front(span);
    if (part.first_column <= part.last_column) draw_in_filled_row(part, tag, farthest);
    return;
  }
  if (depth_epsilon_ > 0) return draw_what_is_nearer_by_epsilon(span, tag);
  const bool is_long = span.last_column - span.first_column >= kBlockColumns;
  fill_(SpanFill<Depth>{span, tag, format_, depths_.columns(), depths_.row(span.row).data(),
                        tags_.row(span.row).data(),
                        farthest != nullptr && is_long ? farthest->row(span.row) : nullptr});
}

template <typename Depth>
void ZBuffer<Depth>::draw(std::span<const TaggedSpan> spans, HierarchicalDepth<Depth>* farthest) {
  // Drawing a shorter span takes less time than calling a kernel.
  constexpr int kShort = 4;
  // Copies: the compiler knows that writing pixels does not change them.
  const Depth format = format_;
  const double front = front_;
  const bool has_epsilon = depth_epsilon_ > 0;
  const auto columns = static_cast<std::size_t>(depths_.columns());
  const auto first_row = static_cast<std::size_t>(rows_.first);
  Stored* const first_depth = depths_.row(rows_.first).data();
  PixelTag* const first_tag = tags_.row(rows_.first).data();
  const std::uint8_t* const is_filled = is_filled_.data();
  for (const auto& [span, tag] : spans) {
    assert(span.row >= rows_.first && span.row < rows_.end);
    assert(span.first_column >= 0 && span.last_column < depths_.columns());
    const bool is_short = span.last_column - span.first_column < kShort;
    const std::size_t row = static_cast<std::size_t>(span.row) - first_row;
    const std::size_t row_begin = row * columns;
    if (is_filled[row] == 0) fill_row(span.row);
    if (is_short && !has_epsilon)
      draw_pixel_by_pixel(span, tag, format, front, first_depth + row_begin, first_tag + row_begin);
    else
      draw_in_filled_row(span, tag, farthest);
  }
}

/// Every rounding in a SpanDepth is monotone, so calculated depths cross the front limit once.
template <typename Depth>
Span ZBuffer<Depth>::part_behind_front(const Span& span) const {
  Span part = span;
  const int end = span.last_column + 1;
  const auto is_behind_front = [&](int column) { return is_drawn(span.depth(column), front_); };
  if (is_behind_front(span.last_column))
    part.first_column = first_column_where(span.first_column, end, is_behind_front);
  else
    part.last_column = first_column_where(span.first_column, end, std::not_fn(is_behind_front)) - 1;
  return part;
}

template <typename Depth>
void ZBuffer<Depth>::draw_what_is_nearer_by_epsilon(const Span& span, PixelTag tag) {
  const std::span<Stored> depths = depths_.row(span.row);
  const std::span<PixelTag> tags = tags_.row(span.row);
  for (int column = span.first_column; column <= span.last_column; ++column) {
    const auto at = static_cast<std::size_t>(column);
    const Stored stored = format_.store(span.depth(column));
    const bool is_empty = !(depths[at] < rear_);
    const bool is_won = is_empty ? is_nearer(stored, rear_)
                                 : format_.depth(depths[at]) - format_.depth(stored) > depth_epsilon_;
    if (!is_won) continue;
    depths[at] = stored;
    tags[at] = tag;
  }
}

#define PIPELINE_INSTANTIATE(Depth) template class ZBuffer<Depth>;
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE

}  // namespace pipeline
