#include "tools/zbuf/wireframe.h"

#include <algorithm>
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
  Last next = {triangle.p_ndc, triangle.low_parts == nullptr ? Triangle() : *triangle.low_parts,
               triangle.decimal_marks, p_ndc.numbers[index], id};
  const Triangle& p = next.p_ndc;
  if (!setup_.says_what_was_clipped || p_ndc.unclipped_of(index) != nullptr)
    for (std::size_t i = 0; i < 3; ++i) next.is_drawn[i] = !is_in_clip_plane(p[i], p[(i + 1) % 3]);
  // Pieces are a fan around their first corner.
  if (last_ && last_->number == next.number && last_->p_ndc[0] == p[0] && last_->p_ndc[2] == p[1])
    next.is_drawn[0] = last_->is_drawn[2] = false;
  draw_last();
  surfaces_.push_back(surface(p));
  last_ = next;
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

void Wireframe::draw_last() {
  if (!last_) return;
  pixels_.clear();
  add_edge_pixels(grid_, {last_->p_ndc, &last_->low_parts, last_->decimal_marks}, last_->is_drawn,
                  setup_.samples_per_pixel, edges_.row_range(), pixels_);
  const bool is_front = surfaces_[last_->id].is_front;
  for (const EdgePixel& pixel : pixels_) {
    if (!(pixel.depth >= screen_.front)) continue;
    Edge& seen = edges_.row(pixel.row)[static_cast<std::size_t>(pixel.column)];
    const bool is_better = pixel.depth == seen.depth ? is_front && !seen.is_front : pixel.depth < seen.depth;
    if (is_better) seen = {pixel.depth, last_->id, is_front};
  }
  last_.reset();
}

// T24c
std::span<const PixelTag> Wireframe::row(int row, const VisibleRow& surfaces) {
  draw_last();
  const std::span<const Edge> edges = edges_.row(row);
  const auto is_hidden = [&](std::size_t i) {
    const PixelTag id = surfaces.tags[i];
    if (setup_.shows_hidden || id == kNone || edges[i].id == kNone) return false;
    const Surface& surface = surfaces_[id];
    return edges[i].depth > std::min(surface.most, surfaces.depths[i] + surface.reach);
  };
  for (std::size_t i = 0; i < ids_.size(); ++i) ids_[i] = is_hidden(i) ? kNone : edges[i].id;
  return ids_;
}

}  // namespace pipeline
