#include "libpipeline/picture/depth_text.h"

#include <algorithm>

#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/scaled_number.h"

namespace pipeline {

// T23
void write_depth_row(TextWriter& text, std::span<const double> depths, double rear) {
  constexpr std::size_t kAtOnce = 64;
  constexpr int kDecimals = 6;
  while (!depths.empty()) {
    const auto next = depths.first(std::min(kAtOnce, depths.size()));
    char* out = text.reserve(next.size() * (kMaxNumberLength + 1));
    for (const double depth : next) {
      if (!(depth < rear)) continue;
      char* const end = print_scaled(out, depth, kDecimals);
      out = end != nullptr ? end : print_number(out, depth, 0, {.decimals = kDecimals});
      *out++ = '\t';
    }
    text.commit(out);
    depths = depths.subspan(next.size());
  }
  text.append("\n");
}

}  // namespace pipeline
