#include "tools/zbuf/wireframe.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {
namespace {

// Of a pixel, and of a depth: with a margin for rounding, so that no triangle hides its own edges.
constexpr double kReach = 0.501;
constexpr double kDepthError = 0x1p-48;

/// True if both points lie in one of the planes that clipping cuts at.
bool is_in_clip_plane(const Vec3& p, const Vec3& q) {
  const auto is_on_limit = [](double a, double b) { return a == b && (a == -1 || a == 1); };
  return is_on_limit(p.x, q.x) || is_on_limit(p.y, q.y) || is_on_limit(p.z, q.z);
}

/// Calculated at the corner between the two shorter edges: far away from another, differences vanish.
Vec3 plane_normal(const Triangle& p) {
  const std::array<Vec3, 3> edges = {difference(p[1], p[0]), difference(p[2], p[1]), difference(p[0], p[2])};
  const auto is_shorter = [](const Vec3& a, const Vec3& b) {
    return std::max(std::fabs(a.x), std::fabs(a.y)) < std::max(std::fabs(b.x), std::fabs(b.y));
  };
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(edges, is_shorter) - edges.begin());
  return cross(edges[(longest + 1) % 3], edges[(longest + 2) % 3]);
}

}  // namespace

Wireframe::Wireframe(const PixelRules& rules, const Viewport& screen, const Setup& setup)
    : setup_(setup),
      screen_(screen),
      grid_(screen),
      coverage_(rules, screen),
      edges_(screen.drawn_rows(), screen.columns, {screen.rear}),
      covers_(setup.shows_hidden ? RowRange{0, 0} : screen.drawn_rows(), screen.columns, {}),
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
  last_ = next;
  if (!setup_.shows_hidden) cover(triangle, id);
}

// T24c
void Wireframe::cover(const ExactTriangle& triangle, PixelTag id) {
  const auto& [a, b, c] = triangle.p_ndc;
  const double most = std::max({a.z, b.z, c.z});
  const Vec3 normal = plane_normal(triangle.p_ndc);
  const double slopes =
      std::fabs(normal.x / normal.z) * screen_.dx() + std::fabs(normal.y / normal.z) * screen_.dy();
  const double reach = kReach * setup_.samples_per_pixel * slopes +
                       kDepthError * std::max({std::fabs(a.z), std::fabs(b.z), std::fabs(c.z)});
  const auto cover_span = [&](const Span& span) {
    const std::span<Cover> row = covers_.row(span.row);
    for (int column = span.first_column; column <= span.last_column; ++column) {
      const double z = span.depth(column);
      if (!(z >= screen_.front && z < screen_.rear)) continue;
      const double farthest = z + reach < most ? z + reach : most;  // not where it is no number
      Cover& cover = row[static_cast<std::size_t>(column)];
      if (farthest < cover.farthest) cover = {farthest, id};
    }
  };
  coverage_.visit(
      [&](const auto& rule) { for_each_span(rule.rows(triangle), covers_.row_range(), cover_span); });
}

void Wireframe::draw_last() {
  if (!last_) return;
  pixels_.clear();
  add_edge_pixels(grid_, {last_->p_ndc, &last_->low_parts, last_->decimal_marks}, last_->is_drawn,
                  setup_.samples_per_pixel, edges_.row_range(), pixels_);
  const bool is_front = plane_normal(last_->p_ndc).z > 0;
  for (const EdgePixel& pixel : pixels_) {
    if (!(pixel.depth >= screen_.front)) continue;
    Edge& seen = edges_.row(pixel.row)[static_cast<std::size_t>(pixel.column)];
    const bool is_better = pixel.depth == seen.depth ? is_front && !seen.is_front : pixel.depth < seen.depth;
    if (is_better) seen = {pixel.depth, last_->id, is_front};
  }
  last_.reset();
}

std::span<const PixelTag> Wireframe::row(int row) {
  draw_last();
  const std::span<const Edge> edges = edges_.row(row);
  const std::span<const Cover> hiding = covers(row);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const bool is_hidden = !hiding.empty() && edges[i].depth > hiding[i].farthest;
    ids_[i] = is_hidden ? kNone : edges[i].id;
  }
  return ids_;
}

}  // namespace pipeline
