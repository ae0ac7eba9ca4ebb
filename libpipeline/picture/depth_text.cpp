#include "libpipeline/picture/depth_text.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/number_rounding.h"
#include "libpipeline/text/scaled_number.h"

namespace pipeline {

// T23
void write_depth_row(TextWriter& text, std::span<const double> depths, double rear,
                     std::span<const Ball> exact) {
  constexpr int kDecimals = 6;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (!(depths[i] < rear)) continue;
    const auto [hi, lo, is_certain] = round_to_text(exact[i], {.decimals = kDecimals});
    char* const out = text.reserve(kMaxNumberLength + 1);
    char* const end = print_number(out, std::isfinite(hi) ? hi : depths[i], lo, {.decimals = kDecimals});
    *end = '\t';
    text.commit(end + 1);
  }
  if (!exact.empty()) depths = {};
  constexpr std::size_t kAtOnce = 256;
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
