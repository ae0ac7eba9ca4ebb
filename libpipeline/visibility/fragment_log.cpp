#include "libpipeline/visibility/fragment_log.h"

#include <array>
#include <cmath>

#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// shortest_text that also takes infinite depths, to which huge coordinates overflow.
std::string depth_text(double depth) {
  if (std::isfinite(depth)) return shortest_text(depth);
  return depth < 0 ? "-inf" : "inf";
}

std::string to_text(DepthTestResult result, std::uint64_t winner) {
  constexpr std::array kTexts = {"kept",
                                 "lost, behind triangle ",
                                 "lost, equal and later than triangle ",
                                 "lost, nearer by too little than triangle ",
                                 "lost, before the front limit",
                                 "lost, beyond the rear limit"};
  const std::string text = kTexts[static_cast<std::size_t>(result)];
  return text.back() == ' ' ? text + std::to_string(winner) : text;
}

}  // namespace

std::string to_text(const Fragment& fragment) {
  return std::to_string(fragment.pixel.column) + "," + std::to_string(fragment.pixel.row) + ": triangle " +
         std::to_string(fragment.triangle) + ", depth " + depth_text(fragment.depth) + ": " +
         to_text(fragment.result, fragment.winner);
}

}  // namespace pipeline
