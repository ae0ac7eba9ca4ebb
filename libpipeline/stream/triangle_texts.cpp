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

void TriangleTexts::add_trimmed(std::string_view lines) {
  constexpr std::string_view kBlanks = " \t\r";
  while (!lines.empty()) {
    const std::size_t length = lines.find('\n');
    std::string_view line = lines.substr(0, length);
    line.remove_prefix(line.find_first_not_of(kBlanks));
    add_line(line.substr(0, line.find_last_not_of(kBlanks) + 1));
    lines.remove_prefix(length + 1);
  }
}

}  // namespace pipeline
