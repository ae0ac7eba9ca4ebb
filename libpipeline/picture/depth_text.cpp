#include "libpipeline/picture/depth_text.h"

#include <algorithm>

#include "libpipeline/text/fixed_depths.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

void write_depth(TextWriter& text, double depth) {
  constexpr NumberFormat kSixDecimals = {6, false};
  char* end = print_number(text.reserve(kMaxNumberLength + 1), depth, 0, kSixDecimals);
  *end++ = '\t';
  text.commit(end);
}

}  // namespace

void write_depth_row(TextWriter& text, std::span<const double> depths, double rear) {
  constexpr std::size_t kAtOnce = 1024;
  while (!depths.empty()) {
    const auto next = depths.first(std::min(kAtOnce, depths.size()));
    const FixedDepths written =
        write_fixed_depths(next, rear, text.reserve(next.size() * kMaxFixedDepthLength));
    text.commit(written.end);
    depths = depths.subspan(written.count);
    if (written.count == next.size()) continue;
    write_depth(text, depths.front());
    depths = depths.subspan(1);
  }
  text.append("\n");
}

}  // namespace pipeline
