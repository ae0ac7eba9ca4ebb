#include "libpipeline/visibility/unseen.h"

#include <cmath>
#include <limits>
#include <optional>

namespace pipeline {
namespace {

/// The maximum distance of a fragment's depth from the triangle's own depths: the rule `nearest` follows a
/// triangle's plane up to half a pixel outside it. Infinite if the plane is so steep that rounding matters.
double depth_reach(const Triangle& p, const BoundingBox& extent, double dx) {
  if (extent.low.z == extent.high.z) return 0;
  const auto& [a, b, c] = p;
  const double forward = (b.x - a.x) * (c.y - a.y);
  const double backward = (c.x - a.x) * (b.y - a.y);
  const double rise = (b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y);
  const double area = std::fabs(forward - backward);
  if (!(area > 0x1p-20 * (std::fabs(forward) + std::fabs(backward))))
    return std::numeric_limits<double>::infinity();
  // Twice the distance, and more than all rounding errors.
  return std::fabs(rise) / area * dx + 0x1p-20 * (std::fabs(extent.low.z) + std::fabs(extent.high.z));
}

/// The side on which a triangle misses the window past a corner, if it does: all of the window is then beyond
/// one of the triangle's edges.
std::optional<UnseenPlace> side_past_corner(const Triangle& p, const Viewport& screen) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    // The edge's normal, toward the third corner.
    double x = a.y - b.y, y = b.x - a.x;
    if (x * (c.x - a.x) + y * (c.y - a.y) < 0) x = -x, y = -y;
    if (!(std::fabs(x) * -screen.left + std::fabs(y) * -screen.bottom < x * a.x + y * a.y)) continue;
    if (std::fabs(x) > std::fabs(y)) return x > 0 ? UnseenPlace::right : UnseenPlace::left;
    return y > 0 ? UnseenPlace::above : UnseenPlace::below;
  }
  return std::nullopt;
}

}  // namespace

// True if the area in x and y exceeds the error of rounding the coordinates to doubles and of this
// calculation.
bool has_area(const Triangle& p) {
  const auto& [a, b, c] = p;
  const double forward = (b.x - a.x) * (c.y - a.y);
  const double backward = (c.x - a.x) * (b.y - a.y);
  const auto size = [](double first, double second) { return std::fabs(first) + std::fabs(second); };
  const double error = size(b.x, a.x) * std::fabs(c.y - a.y) + std::fabs(b.x - a.x) * size(c.y, a.y) +
                       size(c.x, a.x) * std::fabs(b.y - a.y) + std::fabs(c.x - a.x) * size(b.y, a.y);
  return !(std::fabs(forward - backward) <= 0x1p-52 * error);
}

bool may_be_visible(const Triangle& p_ndc, const BoundingBox& extent, const Viewport& screen) {
  const auto& [low, high] = extent;
  // One pixel more than the window on each side: rounding may move a vertex that touches it.
  const double dx = screen.dx(), dy = screen.dy();
  if (high.x < screen.left - dx || low.x > -screen.left + dx || high.y < screen.bottom - dy ||
      low.y > -screen.bottom + dy)
    return false;
  if (high.z >= screen.front && low.z < screen.rear) return true;
  const double reach = depth_reach(p_ndc, extent, dx);
  return high.z + reach >= screen.front && low.z - reach < screen.rear;
}

UnseenPlace unseen_place(const Triangle& p_ndc, const BoundingBox& extent, const FragmentDepths& fragments,
                         const Viewport& screen) {
  const auto& [low, high] = extent;
  if (high.z < screen.front) return UnseenPlace::near;
  if (low.z >= screen.rear) return UnseenPlace::far;
  if (high.x < screen.left) return UnseenPlace::left;
  if (low.x > -screen.left) return UnseenPlace::right;
  if (high.y < screen.bottom) return UnseenPlace::below;
  if (low.y > -screen.bottom) return UnseenPlace::above;
  if (fragments.visible || !has_area(p_ndc)) return UnseenPlace::without_area;
  if (fragments.before_front) return UnseenPlace::near;
  if (fragments.beyond_rear) return UnseenPlace::far;
  return side_past_corner(p_ndc, screen).value_or(UnseenPlace::between_centers);
}

}  // namespace pipeline
