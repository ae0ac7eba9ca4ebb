#include "tools/zbuf/wireframe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libpipeline/numbers/exact_sum.h"

namespace pipeline {
namespace {

// Half a pixel, and no depth, each with a margin for rounding: no triangle hides its own edges.
constexpr double kReach = 0.501;
constexpr double kDepthError = 0x1p-48;

/// True if both points lie in one clipping plane.
bool is_in_clip_plane(const Vec3& p, const Vec3& q) {
  const auto is_on_limit = [](double a, double b) { return a == b && (a == -1 || a == 1); };
  return is_on_limit(p.x, q.x) || is_on_limit(p.y, q.y) || is_on_limit(p.z, q.z);
}

/// The normal in balls or, where these lose too much, exact but for rounding.
BallVec3 plane_normal(const Triangle& p) {
  constexpr double kCertain = 0x1p-50;
  const BallVec3 start = to_balls(p[0]), normal = cross(to_balls(p[1]) - start, to_balls(p[2]) - start);
  if (normal.z.error() <= kCertain * std::fabs(normal.z.value().hi)) return normal;
  return exact_face_normal(p);
}

}  // namespace

Wireframe::Wireframe(const PixelRules& rules, const Viewport& screen, const Setup& setup)
    : setup_(setup),
      screen_(screen),
      depth_(rules, screen),
      grid_(screen),
      edges_(screen.drawn_rows(), screen.columns, {screen.rear}),
      ids_(static_cast<std::size_t>(screen.columns)) {}

// T24b
void Wireframe::add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id) {
  const ExactTriangle triangle = exact_triangle(p_ndc, index);
  const Triangle& p = triangle.p_ndc;
  const std::uint64_t number = p_ndc.numbers[index];
  // Pieces are a fan around their first corner.
  const bool goes_on = last_ && last_->number == number && last_->p_ndc[0] == p[0] && last_->p_ndc[2] == p[1];
  draw_last(!goes_on);
  std::array<bool, 3> is_drawn = {!goes_on, true, true};
  if (!setup_.says_what_was_clipped || p_ndc.unclipped_of(index) != nullptr)
    for (std::size_t i = 0; i < 3; ++i) is_drawn[i] &= !is_in_clip_plane(p[i], p[(i + 1) % 3]);
  add_edge_pixels(grid_, triangle, is_drawn, setup_.samples_per_pixel, edges_.row_range(), pixels_);
  surfaces_.push_back(surface(p));
  last_ = {p, number, id};
}

Wireframe::Surface Wireframe::surface(const Triangle& p) const {
  const BallVec3 normal = plane_normal(p);
  const auto [least, most] = std::minmax({p[0].z, p[1].z, p[2].z});
  if (normal.z.sign() == 0) return {most, std::numeric_limits<double>::infinity(), false};
  const auto slope = [&](const Ball& part, double step) {
    return (part * Ball(step) / normal.z).magnitude();
  };
  const double slopes = slope(normal.x, screen_.dx()) + slope(normal.y, screen_.dy());
  const double size = std::max(std::fabs(least), std::fabs(most));
  const double error = kDepthError * size + depth_.separation(size);
  return {most, kReach * setup_.samples_per_pixel * slopes + error, normal.z.sign() > 0};
}

/// `is_closed` is false if the last edge lies within a clipped triangle.
void Wireframe::draw_last(bool is_closed) {
  const bool is_front = last_ && surfaces_[last_->id].is_front;
  for (const auto& [row, column, depth, edge] : pixels_) {
    if (!(depth >= screen_.front) || (edge == 2 && !is_closed)) continue;
    Edge& seen = edges_.row(row)[static_cast<std::size_t>(column)];
    if (depth < seen.depth || (depth == seen.depth && is_front && !seen.is_front))
      seen = {depth, last_->id, is_front};
  }
  pixels_.clear();
  last_.reset();
}

// T24c
std::span<const PixelTag> Wireframe::row(int row, const VisibleRow& surfaces) {
  draw_last();
  const std::span<const Edge> edges = edges_.row(row);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    ids_[i] = edges[i].id;
    if (setup_.shows_hidden || surfaces.tags[i] == kNone || ids_[i] == kNone) continue;
    const auto& [most, reach, is_front] = surfaces_[surfaces.tags[i]];
    if (edges[i].depth > std::min(most, surfaces.depths[i] + reach)) ids_[i] = kNone;
  }
  return ids_;
}

}  // namespace pipeline
