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
  const auto first_column = static_cast<std::size_t>(span.first_column);
  kernel_.fill(SpanFill<Depth>{span, color, format_, front_, &depths_.row(span.row)[first_column],
                               &colors_.row(span.row)[first_column]});
}

template class ZBuffer<DepthF64>;
template class ZBuffer<DepthF32>;
template class ZBuffer<DepthU24>;

}  // namespace pipeline
