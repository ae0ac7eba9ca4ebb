#include "libpipeline/zbuffer.h"

#include <cassert>

namespace pipeline {

template <typename Depth>
ZBuffer<Depth>::ZBuffer(const ScreenConfig& screen, Color background)
    : format_(screen),
      front_(screen.front),
      rear_limit_(screen.rear),
      rear_(format_.store(screen.rear)),
      depths_(screen.rows, screen.columns, rear_),
      colors_(screen.rows, screen.columns, background) {}

template <typename Depth>
void ZBuffer<Depth>::draw(const Span& span, Color color) {
  assert(span.first_column >= 0 && span.last_column < depths_.columns());
  const int count = span.last_column - span.first_column + 1;
  Stored* const depths = &depths_.row(span.row)[static_cast<std::size_t>(span.first_column)];
  Color* const colors = &colors_.row(span.row)[static_cast<std::size_t>(span.first_column)];
  const SpanDepth depth = span.depth;
  const Depth format = format_;
  const double front = front_;
  // No branches, every pixel is stored again, and colours are plain numbers: so the loop vectorises.
  for (int i = 0; i < count; ++i) {
    const double z = depth(span.first_column + i);
    const Stored new_depth = format.store(z);
    const Stored old_depth = depths[i];
    const std::uint32_t old_rgb = colors[i].rgb();
    const bool is_visible = (new_depth < old_depth) & (z >= front);
    depths[i] = is_visible ? new_depth : old_depth;
    colors[i] = Color::from_rgb(is_visible ? color.rgb() : old_rgb);
  }
}

template class ZBuffer<DepthF64>;
template class ZBuffer<DepthF32>;
template class ZBuffer<DepthU24>;
template class ZBuffer<DepthU16>;

}  // namespace pipeline
