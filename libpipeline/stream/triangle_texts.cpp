#include "libpipeline/stream/triangle_texts.h"

#include "libpipeline/text/fixed_text.h"

namespace pipeline {

void TriangleTexts::add_fixed_form(std::string_view triangles, int decimals) {
  constexpr std::string_view kTriangleEnd = "\n\n";
  const std::size_t min_length = min_fixed_triangle_length(decimals) - kTriangleEnd.size();
  const std::size_t offset = lines_.size();
  lines_ += triangles;
  for (std::size_t end = 0; end < triangles.size();) {
    // A blank line ends a triangle. Few numbers are longer than the shortest: faster than a search.
    for (end += min_length; triangles[end] != '\n' || triangles[end + 1] != '\n';) ++end;
    end += kTriangleEnd.size();
    ends_.push_back(offset + end);
  }
}

}  // namespace pipeline
