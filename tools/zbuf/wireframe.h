#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/coverage/edge_pixels.h"
#include "libpipeline/numbers/exact_sum.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The picture of `--wireframe`: at every pixel or sample, the nearest edge that no triangle hides. Takes
/// triangles in the order of the stream, whatever the visibility algorithm.
class Wireframe {
 public:
  struct Setup {
    bool shows_hidden = false;
    bool says_what_was_clipped = false;  // true for texts with lights
    int samples_per_pixel = 1;           // in a row or a column
  };

  /// `screen` has pixels or samples.
  Wireframe(const PixelRules& rules, const Viewport& screen, const Setup& setup)
      : setup_(setup),
        screen_(screen),
        depth_(rules, screen),
        grid_(screen),
        edges_(screen.drawn_rows(), screen.columns, {screen.rear}),
        ids_(static_cast<std::size_t>(screen.columns)) {}

  /// Takes the next triangle, with its id, the count so far. Its edges are drawn at the next `add` or `row`,
  /// as the next triangle may be a piece that shares one.
  // T24b
  void add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id) {
    const ExactTriangle triangle = exact_triangle(p_ndc, index);
    const Triangle& p = triangle.p_ndc;
    const std::uint64_t number = p_ndc.numbers[index];
    // Pieces are a fan around their first corner.
    const bool goes_on =
        last_ && last_->number == number && last_->p_ndc[0] == p[0] && last_->p_ndc[2] == p[1];
    draw_last(!goes_on);
    std::array<bool, 3> is_drawn = {!goes_on, true, true};
    if (!setup_.says_what_was_clipped || p_ndc.unclipped_of(index) != nullptr)
      for (std::size_t i = 0; i < 3; ++i) is_drawn[i] &= !is_in_clip_plane(p[i], p[(i + 1) % 3]);
    add_edge_pixels(grid_, triangle, is_drawn, setup_.samples_per_pixel, edges_.row_range(), pixels_);
    surfaces_.push_back(surface(p));
    last_ = {p, number, id};
  }
  /// The ids shown in a row whose visible surfaces are these; to be called after the last triangle.
  // T24c
  std::span<const PixelTag> row(int row, const VisibleRow& surfaces) {
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
  /// Calls `visit(id)`, which may change the id, for every triangle that the picture needs, now or later,
  /// besides the visible surfaces.
  template <typename Visitor>
  void for_each_id(Visitor&& visit) {
    for (int row = edges_.row_range().first; row < edges_.row_range().end; ++row)
      for (Edge& edge : edges_.row(row)) visit(edge.id);
    if (last_) visit(last_->id);
  }
  /// Drops the triangles that are not kept.
  void keep(const KeptIds& kept) { surfaces_.keep(kept); }

 private:
  static constexpr PixelTag kNone = KeptIds::kNoTriangle;
  // Half a pixel, and no depth, each with a margin for rounding: no triangle hides its own edges.
  static constexpr double kReach = 0.501, kDepthError = 0x1p-48;

  /// The nearest edge at a pixel.
  struct Edge {
    double depth;
    PixelTag id = kNone;
    bool is_front = true;  // the triangle's corners run counterclockwise
  };
  /// A triangle hides all that is farther than all its corners, or farther than itself by more than `reach`.
  struct Surface {
    double most, reach;
    bool is_front;
  };
  struct Last {
    Triangle p_ndc;
    std::uint64_t number;
    PixelTag id;
  };

  /// True if both points lie in one clipping plane.
  static bool is_in_clip_plane(const Vec3& p, const Vec3& q) {
    const auto is_on_limit = [](double a, double b) { return a == b && (a == -1 || a == 1); };
    return is_on_limit(p.x, q.x) || is_on_limit(p.y, q.y) || is_on_limit(p.z, q.z);
  }

  /// The normal in balls or, where these lose too much, exact but for rounding.
  static BallVec3 plane_normal(const Triangle& p) {
    constexpr double kCertain = 0x1p-50;
    const BallVec3 start = to_balls(p[0]), normal = cross(to_balls(p[1]) - start, to_balls(p[2]) - start);
    if (normal.z.error() <= kCertain * std::fabs(normal.z.value().hi)) return normal;
    return exact_face_normal(p);
  }
  [[nodiscard]] Surface surface(const Triangle& p) const {
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
  void draw_last(bool is_closed = true) {
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

  Setup setup_;
  Viewport screen_;
  AnyDepth depth_;
  ExactGrid grid_;
  Raster<Edge> edges_;
  ChunkedArray<Surface> surfaces_;  // by the ids of their triangles
  std::optional<Last> last_;
  std::vector<EdgePixel> pixels_;  // of the last triangle
  std::vector<PixelTag> ids_;
};

}  // namespace pipeline
