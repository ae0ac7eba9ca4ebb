#include "tools/trace/trace_work.h"

#include <algorithm>
#include <cstdio>

namespace pipeline {
namespace {

/// With three digits.
std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

std::string millions(std::uint64_t count) {
  return rounded(static_cast<double>(count) / 1e6) + " million ";
}

}  // namespace

std::string to_text(const TraceWork& work) {
  const double seconds = std::max(work.cast_seconds, 1e-9);
  const auto speed = [&](std::uint64_t count, const char* kind) {
    return millions(count) + kind + " rays at " + rounded(static_cast<double>(count) / 1e6 / seconds) +
           " million a second";
  };
  char build[48];
  std::snprintf(build, sizeof build, "build %.3f s, ", work.build_seconds);
  std::string all = build + speed(work.primary_rays, "primary");
  if (work.rays.shadow > 0) all += ", " + speed(work.rays.shadow, "shadow");
  if (work.rays.mirrored > 0) all += ", " + speed(work.rays.mirrored, "mirrored");
  if (work.rays.refracted > 0) all += ", " + speed(work.rays.refracted, "refracted");
  if (work.rays.cut > 0)
    all += ", " + millions(work.rays.cut) + "rays cut, at most " + rounded(work.rays.largest_cut_weight) +
           " of a pixel's color";
  return all;
}

}  // namespace pipeline
