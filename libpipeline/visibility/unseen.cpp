#include "libpipeline/visibility/unseen.h"

#include <cmath>

namespace pipeline {
namespace {

/// Whether the area of a triangle in x and y is more than the rounding of its coordinates to doubles, and of
/// the calculation here, can make it.
bool has_area(const Triangle& p) {
  const auto& [a, b, c] = p;
  const double forward = (b.x - a.x) * (c.y - a.y);
  const double backward = (c.x - a.x) * (b.y - a.y);
  const auto size = [](double first, double second) { return std::fabs(first) + std::fabs(second); };
  const double error = size(b.x, a.x) * std::fabs(c.y - a.y) + std::fabs(b.x - a.x) * size(c.y, a.y) +
                       size(c.x, a.x) * std::fabs(b.y - a.y) + std::fabs(c.x - a.x) * size(b.y, a.y);
  return !(std::fabs(forward - backward) <= 0x1p-52 * error);
}

}  // namespace

UnseenReason unseen_reason(const Triangle& p_ndc, const FragmentDepths& fragments, const Viewport& screen) {
  const auto [low, high] = std::pair(BoundingBox(p_ndc).low, BoundingBox(p_ndc).high);
  if (high.z < screen.front) return UnseenReason::before_front;
  if (low.z >= screen.rear) return UnseenReason::beyond_rear;
  if (high.x < screen.left) return UnseenReason::left;
  if (low.x > -screen.left) return UnseenReason::right;
  if (high.y < screen.bottom) return UnseenReason::below;
  if (low.y > -screen.bottom) return UnseenReason::above;
  if (!has_area(p_ndc)) return UnseenReason::without_area;
  if (fragments.before_front) return UnseenReason::before_front;
  if (fragments.beyond_rear) return UnseenReason::beyond_rear;
  return UnseenReason::between_centers;
}

}  // namespace pipeline
