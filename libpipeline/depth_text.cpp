#include "libpipeline/depth_text.h"

#include "libpipeline/number_text.h"

namespace pipeline {

void write_depth_row(TextWriter& text, std::span<const double> depths, double rear) {
  constexpr NumberFormat kSixDecimals = {6, false};
  for (const double depth : depths) {
    if (!(depth < rear)) continue;
    char* end = print_number(text.reserve(kMaxNumberLength + 1), depth, 0, kSixDecimals);
    *end++ = '\t';
    text.commit(end);
  }
  text.append("\n");
}

}  // namespace pipeline
