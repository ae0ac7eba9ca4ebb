#include "libpipeline/picture/wireframe.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

// Half a pixel, and a margin for rounding where a line runs just between two rows of centers.
constexpr double kReach = 0.5 + 0x1p-30;

/// True if both points lie in one of the planes that clipping cuts at.
bool is_in_clip_plane(const Vec3& p, const Vec3& q) {
  const auto is_on_limit = [](double a, double b) { return a == b && (a == -1 || a == 1); };
  return is_on_limit(p.x, q.x) || is_on_limit(p.y, q.y) || is_on_limit(p.z, q.z);
}

}  // namespace

Wireframe::Line Wireframe::line(const Vec3& p, const Vec3& q) const {
  const Vec3 through_both = cross(p, q);
  const double pixels = std::hypot(through_both.x * pixel_.dx, through_both.y * pixel_.dy);
  if (!(pixels > 0)) return kNotDrawn;
  return {through_both.x / pixels, through_both.y / pixels, through_both.z / pixels};
}

void Wireframe::add(const Triangle& screen_corners) {
  const auto& [a, b, c] = screen_corners;
  edges_.push_back({line(a, b), line(b, c), line(c, a)});
}

void Wireframe::add_piece(const Triangle& p_ndc, const Triangle& screen_corners, std::uint64_t number) {
  add(screen_corners);
  Edges& edges = edges_.back();
  for (std::size_t i = 0; i < 3; ++i)
    if (is_in_clip_plane(p_ndc[i], p_ndc[(i + 1) % 3])) edges[i] = kNotDrawn;
  // Pieces are a fan around their first corner.
  if (last_ && last_->number == number && last_->p_ndc[0] == p_ndc[0] && last_->p_ndc[2] == p_ndc[1]) {
    edges[0] = kNotDrawn;
    edges_[edges_.size() - 2][2] = kNotDrawn;
  }
  last_ = {number, p_ndc};
}

bool Wireframe::is_on_edge(const Edges& edges, double x, double y) {
  return std::any_of(edges.begin(), edges.end(),
                     [&](const Line& line) { return std::fabs(line.a * x + line.b * y + line.c) <= kReach; });
}

}  // namespace pipeline
