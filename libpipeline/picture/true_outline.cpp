#include "libpipeline/picture/true_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace pipeline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double lost(double p, double q, double r = 0) {
  return TrueView::kLost * (std::fabs(p) + std::fabs(q) + std::fabs(r));
}

}  // namespace

TrueView::TrueView(const Viewport& screen, const Bounds& error, const Projection& projected)
    : bounds(error), is_perspective(std::holds_alternative<Frustum>(projected)) {
  const auto axis = [&](double low, double high, double first, double step, double limit,
                        const RowRange& all) {
    const double scale = std::fabs((is_perspective ? 2 * near : 2) / (high - low));
    return Axis{first, step, 1 / step, lost(limit, 0), scale, 1 / scale * kUp, -(high + low) / (high - low),
                all};
  };
  const auto set = [&](const auto& p) {
    near = p.near;
    far = p.far;
    axes = {axis(p.left, p.right, screen.left_x(), screen.dx(), screen.left, {0, screen.columns}),
            axis(p.bottom, p.top, screen.top_y(), -screen.dy(), screen.bottom, {0, screen.rows})};
  };
  if (is_perspective)
    set(std::get<Frustum>(projected));
  else
    set(std::get<Orthographic>(projected));
  if (!is_perspective) return;
  const double front = depths_at(screen.front)[0];
  // Triangles that come no nearer than near / 1024 are not cut.
  nearest_shown = std::max(near / 1024, front < 0 ? -1 / front : kInfinity) / kUp;
}

std::array<double, 2> TrueView::depths_at(double z) const {
  const double range = far - near, sign = is_perspective ? -1 : 1;
  const double middle = z * range + sign * (far + near), error = lost(z * range, far, near);
  const auto scaled = [&](double depth) { return is_perspective ? depth / near / far / 2 : depth / 2; };
  if (!std::isfinite(error)) return {-kInfinity, kInfinity};
  return {scaled(middle - error), scaled(middle + error)};
}

}  // namespace pipeline
