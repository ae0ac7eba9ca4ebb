#include "libpipeline/zbuffer.h"

#include <cassert>

namespace pipeline {

ZBuffer::ZBuffer(const ScreenConfig& screen, Color background)
    : front_(screen.front),
      depths_(screen.rows, screen.columns, screen.rear),
      colors_(screen.rows, screen.columns, background) {}

void ZBuffer::draw(const Span& span, Color color) {
  assert(span.first_column >= 0 && span.last_column < depths_.columns());
  const int count = span.last_column - span.first_column + 1;
  double* const depths = &depths_.row(span.row)[static_cast<std::size_t>(span.first_column)];
  Color* const colors = &colors_.row(span.row)[static_cast<std::size_t>(span.first_column)];
  const SpanDepth depth = span.depth;
  const double front = front_;
  // No branches, every pixel is stored again, and colours are plain numbers: so the loop vectorises.
  for (int i = 0; i < count; ++i) {
    const double z = depth(span.first_column + i);
    const double old_z = depths[i];
    const std::uint32_t old_rgb = colors[i].rgb();
    const bool is_visible = (z < old_z) & (z >= front);
    depths[i] = is_visible ? z : old_z;
    colors[i] = Color::from_rgb(is_visible ? color.rgb() : old_rgb);
  }
}

}  // namespace pipeline
