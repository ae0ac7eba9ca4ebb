#include "libpipeline/visibility/fragment.h"

#include <array>
#include <charconv>

namespace pipeline {
namespace {

/// The shortest text that reads back to the same double; zero has no sign. Unlike shortest_text, it takes the
/// infinite depths that huge coordinates overflow to.
std::string shortest(double depth) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), depth == 0 ? 0.0 : depth).ptr;
  return {text.data(), end};
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
         std::to_string(fragment.triangle) + ", depth " + shortest(fragment.depth) + ": " +
         to_text(fragment.result, fragment.winner);
}

}  // namespace pipeline
