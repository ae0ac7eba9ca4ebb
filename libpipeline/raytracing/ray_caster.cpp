#include "libpipeline/raytracing/ray_caster.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// The distance where primary rays begin: parallel rays also begin behind the eye plane.
double first_distance(const PixelRays& rays) {
  return rays.is_perspective() ? 0 : -std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<Bvh::Primitive> boxes_of(const TracedTriangles& triangles, const PixelRays& rays,
                                     RaysOfBoxes of) {
  // A bound on the rounded numbers for one triangle.
  const auto most = [&](const BoundingBox& box) {
    const auto largest = [&](double Vec3::*axis) {
      return std::max(std::fabs(box.low.*axis), std::fabs(box.high.*axis));
    };
    const double distance = largest(&Vec3::z);
    return largest(&Vec3::x) + largest(&Vec3::y) + distance +
           rays.reach() * (rays.is_perspective() ? distance : 1);
  };
  const auto box_of = [&](SurfaceId id) {
    return id < triangles.size() ? BoundingBox(triangles.p_view(id)) : triangles.sphere(id).surface.box();
  };
  const auto count = static_cast<SurfaceId>(triangles.surface_count());
  double most_of_all = 0;
  if (of == RaysOfBoxes::any)
    for (SurfaceId id = 0; id < count; ++id) most_of_all = std::max(most_of_all, most(box_of(id)));
  std::vector<Bvh::Primitive> primitives;
  primitives.reserve(count);
  for (SurfaceId id = 0; id < count; ++id) {
    const BoundingBox box = box_of(id);
    constexpr double kPadding = 0x1p-46;
    primitives.push_back({FloatBox(box, kPadding * (of == RaysOfBoxes::any ? most_of_all : most(box))), id});
  }
  return primitives;
}

std::optional<RayCaster::Seen> RayCaster::cast(int row, int column) {
  const Ray ray = rays_.ray(row, column);
  const double largest_depth = triangles_.largest_depth();
  double limit = depth_.distance_up_to(screen_.rear, largest_depth);
  std::optional<Seen> nearest;
  bvh_.for_each_candidate(ray, first_distance(rays_), limit, [&](SurfaceId id) {
    const auto next = triangles_.is_sphere(id) ? sphere_at(id, ray) : triangle_at(id, row, column);
    const auto order = [](const Seen& seen) { return std::pair(seen.depth, seen.id); };
    if (!next || (nearest && order(*nearest) < order(*next))) return;
    nearest = next;
    limit = std::min(limit, depth_.distance_up_to(next->depth, largest_depth));
  });
  return nearest;
}

/// The triangle, if its fragment here exists and is within the depth limits.
std::optional<RayCaster::Seen> RayCaster::triangle_at(SurfaceId id, int row, int column) {
  if (!may_cover(id, row, column)) return std::nullopt;
  const std::optional<Span>& span = span_of(id, row);
  if (!span || column < span->first_column || column > span->last_column) return std::nullopt;
  const double depth = span->depth(column);
  return is_between_limits(depth) ? std::optional(Seen{id, depth}) : std::nullopt;
}

/// True if the pixel's center lies in the box around the triangle, or within a pixel of it: a quick test.
bool RayCaster::may_cover(SurfaceId id, int row, int column) const {
  const auto& [low, high] = BoundingBox(triangles_.p_ndc().triangles[id]);
  const double x = pixels_.x_of(column), y = pixels_.y_of(row);
  return x >= low.x - pixels_.dx && x <= high.x + pixels_.dx && y >= low.y - pixels_.dy &&
         y <= high.y + pixels_.dy;
}

/// The sphere's nearer side if it is within the depth limits, else the farther one: the front limit may cut a
/// sphere open.
std::optional<RayCaster::Seen> RayCaster::sphere_at(SurfaceId id, const Ray& ray) const {
  const double first = first_distance(rays_);
  const auto [entrance, exit] = triangles_.sphere(id).surface.meetings(ray);
  for (const auto& [distance, is_from_within] : {std::pair(entrance, false), std::pair(exit, true)}) {
    const double depth = depth_.at(distance);
    if (distance > first && is_between_limits(depth)) return Seen{id, depth, is_from_within};
  }
  return std::nullopt;
}

/// The triangle's pixels in a row.
const std::optional<Span>& RayCaster::span_of(SurfaceId id, int row) {
  CachedRows& cached = cache_[id % kCached];
  if (cached.id != id) {
    const TriangleBatch& p_ndc = triangles_.p_ndc();
    cached.id = id;
    cached.spans.assign(row_count_, {});
    cached.rows.emplace(
        grid_, ExactTriangle{p_ndc.triangles[id], p_ndc.low_parts.empty() ? nullptr : &p_ndc.low_parts[id],
                             p_ndc.decimal_marks[id]});
  }
  CachedSpan& found = cached.spans[static_cast<std::size_t>(row) % row_count_];
  if (found.row != row) {
    const bool is_in_rows = row >= cached.rows->first_row() && row <= cached.rows->last_row();
    found.row = row;
    found.span = is_in_rows ? cached.rows->span(row) : std::nullopt;
  }
  return found.span;
}

}  // namespace pipeline
