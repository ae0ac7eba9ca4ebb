#include "libpipeline/visibility/fragment.h"

#include <cmath>

#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// As shortest_text, also for the infinite depths that huge coordinates overflow to.
std::string depth_text(double depth) {
  if (std::isfinite(depth)) return shortest_text(depth);
  return depth < 0 ? "-inf" : "inf";
}

std::string to_text(DepthTestResult result, std::uint64_t winner) {
  switch (result) {
    case DepthTestResult::kept:
      return "kept";
    case DepthTestResult::behind:
      return "lost, behind triangle " + std::to_string(winner);
    case DepthTestResult::equal:
      return "lost, equal and later than triangle " + std::to_string(winner);
    case DepthTestResult::too_close:
      return "lost, nearer by too little than triangle " + std::to_string(winner);
    case DepthTestResult::before_front:
      return "lost, before the front limit";
    case DepthTestResult::beyond_rear:
      break;
  }
  return "lost, beyond the rear limit";
}

}  // namespace

std::string to_text(const Fragment& fragment) {
  return std::to_string(fragment.pixel.column) + "," + std::to_string(fragment.pixel.row) + ": triangle " +
         std::to_string(fragment.triangle) + ", depth " + depth_text(fragment.depth) + ": " +
         to_text(fragment.result, fragment.winner);
}

}  // namespace pipeline
