#include "tools/trace/trace_work.h"

#include <algorithm>
#include <cstdio>

namespace pipeline {

std::string to_text(const TraceWork& work) {
  const auto millions = [](std::uint64_t count) { return static_cast<double>(count) / 1e6; };
  const double seconds = std::max(work.cast_seconds, 1e-9);
  char text[160];
  std::snprintf(text, sizeof text,
                "build %.3f s, %.3g million primary rays at %.3g million a second, %.3g million exactly",
                work.build_seconds, millions(work.primary_rays), millions(work.primary_rays) / seconds,
                millions(work.exact_decisions));
  std::string all = text;
  const auto add = [&](const char* kind, std::uint64_t count) {
    if (count == 0) return;
    std::snprintf(text, sizeof text, ", %.3g million %s rays at %.3g million a second", millions(count), kind,
                  millions(count) / seconds);
    all += text;
  };
  add("shadow", work.rays.shadow);
  add("mirrored", work.rays.mirrored);
  add("refracted", work.rays.refracted);
  if (work.rays.cut > 0) {
    std::snprintf(text, sizeof text, ", %.3g million rays cut, at most %.3g of a pixel's color",
                  millions(work.rays.cut), work.rays.largest_cut_weight);
    all += text;
  }
  return all;
}

}  // namespace pipeline
