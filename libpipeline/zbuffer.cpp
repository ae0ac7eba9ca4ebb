#include "libpipeline/zbuffer.h"

#include <cassert>

namespace pipeline {

template <typename Depth>
ZBuffer<Depth>::ZBuffer(const ScreenConfig& screen, Color background)
    : kernel_(span_fill_kernel()),
      format_(screen),
      front_(screen.front),
      rear_limit_(screen.rear),
      rear_(format_.store(screen.rear)),
      depths_(screen.rows, screen.columns, rear_),
      colors_(screen.rows, screen.columns, background) {}

template <typename Depth>
void ZBuffer<Depth>::draw(const Span& span, Color color) {
  assert(span.first_column >= 0 && span.last_column < depths_.columns());
  if (depth_epsilon_ > 0) return draw_what_is_nearer_by_epsilon(span, color);
  const auto first_column = static_cast<std::size_t>(span.first_column);
  kernel_.fill(SpanFill<Depth>{span, color, format_, front_, &depths_.row(span.row)[first_column],
                               &colors_.row(span.row)[first_column]});
}

template <typename Depth>
void ZBuffer<Depth>::draw_what_is_nearer_by_epsilon(const Span& span, Color color) {
  const std::span<Stored> depths = depths_.row(span.row);
  const std::span<Color> colors = colors_.row(span.row);
  for (int column = span.first_column; column <= span.last_column; ++column) {
    const auto at = static_cast<std::size_t>(column);
    const double z = span.depth(column);
    const Stored stored = format_.store(z);
    const bool is_empty = !(depths[at] < rear_);
    const bool is_nearer =
        is_empty ? stored < rear_ : format_.depth(depths[at]) - format_.depth(stored) > depth_epsilon_;
    if (!is_nearer || !(z >= front_)) continue;
    depths[at] = stored;
    colors[at] = color;
  }
}

template class ZBuffer<DepthF64>;
template class ZBuffer<DepthF32>;
template class ZBuffer<DepthU24>;

}  // namespace pipeline
