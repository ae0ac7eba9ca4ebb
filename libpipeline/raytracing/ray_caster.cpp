#include "libpipeline/raytracing/ray_caster.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/numbers/bounding_box.h"

namespace pipeline {
namespace {

/// The nearest point a primary ray may have: parallel rays begin behind the eye plane, too.
double first_distance(const PixelRays& rays) {
  return rays.is_perspective() ? 0 : -std::numeric_limits<double>::infinity();
}

}  // namespace

Bvh hierarchy_of(const TracedTriangles& triangles, const PixelRays& rays, ThreadPool& pool, RaysOfBoxes of) {
  // Of the numbers that are rounded, a bound on the largest, for one triangle.
  const auto most = [&](const BoundingBox& box) {
    const auto largest = [&](double Vec3::*axis) {
      return std::max(std::fabs(box.low.*axis), std::fabs(box.high.*axis));
    };
    const double distance = largest(&Vec3::z);
    return largest(&Vec3::x) + largest(&Vec3::y) + distance +
           rays.reach() * (rays.is_perspective() ? distance : 1);
  };
  const auto box_of = [&](TracedTriangles::Id id) {
    return id < triangles.size() ? BoundingBox(triangles.p_view(id)) : triangles.sphere(id).surface.box();
  };
  const auto count = static_cast<TracedTriangles::Id>(triangles.surface_count());
  double most_of_all = 0;
  if (of == RaysOfBoxes::any)
    for (TracedTriangles::Id id = 0; id < count; ++id) most_of_all = std::max(most_of_all, most(box_of(id)));
  std::vector<Bvh::Primitive> primitives;
  primitives.reserve(count);
  for (TracedTriangles::Id id = 0; id < count; ++id) {
    const BoundingBox box = box_of(id);
    constexpr double kPadding = 0x1p-46;
    primitives.push_back({FloatBox(box, kPadding * (of == RaysOfBoxes::any ? most_of_all : most(box))), id});
  }
  return {std::move(primitives), pool};
}

std::optional<RayCaster::Seen> RayCaster::cast(int row, int column, bool wants_depth) {
  row_ = row;
  column_ = column;
  nearest_.reset();
  const Ray ray = rays_.ray(row, column);
  const double largest_depth = triangles_.largest_depth();
  double limit = depth_.distance_up_to(screen_.rear, largest_depth);
  bvh_.for_each_candidate(ray, first_distance(rays_), limit, [&](TracedTriangles::Id id) {
    const std::optional<Candidate> next = candidate(id, ray);
    if (!next) return;
    take_nearer(*next);
    if (nearest_) limit = std::min(limit, depth_.distance_up_to(nearest_->depth.high, largest_depth));
  });
  if (nearest_ && wants_depth) nearest_ = made_exact(*nearest_);
  if (!nearest_) return std::nullopt;
  return Seen{nearest_->id, nearest_->depth.low};
}

/// The triangle, if it may be seen here: its fragment is within the limits.
std::optional<RayCaster::Candidate> RayCaster::candidate(TracedTriangles::Id id, const Ray& ray) {
  if (triangles_.is_sphere(id)) return sphere_candidate(id, ray);
  if (triangles_.piece(id)) return exact_candidate(id);
  if (triangles_.is_dropped(id)) return std::nullopt;
  const Hit hit = test_(ray, triangles_.p_view(id));
  if (hit.result == HitResult::miss) return std::nullopt;
  if (hit.result == HitResult::uncertain) return exact_candidate(id);
  if (hit.depth.high < screen_.front || hit.depth.low >= screen_.rear) return std::nullopt;
  const bool is_surely_within = hit.depth.low >= screen_.front && hit.depth.high < screen_.rear;
  if (!is_surely_within) return exact_candidate(id);
  return Candidate{id, hit.depth, false};
}

std::optional<RayCaster::Candidate> RayCaster::exact_candidate(TracedTriangles::Id id) {
  const std::optional<double> depth = exact_.depth(id, row_, column_);
  if (!depth || !(*depth >= screen_.front && *depth < screen_.rear)) return std::nullopt;
  return Candidate{id, {*depth, *depth}, true};
}

/// The sphere's nearer side, if that is within the limits, else the farther one: the front limit may cut a
/// sphere open.
std::optional<RayCaster::Candidate> RayCaster::sphere_candidate(TracedTriangles::Id id,
                                                                const Ray& ray) const {
  const double first = first_distance(rays_);
  for (const auto& [distance, is_front] : triangles_.sphere(id).surface.meetings(ray)) {
    if (!(distance > first)) continue;
    const double depth = depth_.at(distance);
    if (depth >= screen_.front && depth < screen_.rear)
      return Candidate{is_front ? id : id | TracedTriangles::kFromWithin, {depth, depth}, true};
  }
  return std::nullopt;
}

/// Where the depths may be equal, or in either order, they are calculated as `zbuf` does; of equal ones the
/// earlier triangle stays.
void RayCaster::take_nearer(const Candidate& next) {
  if (!nearest_ || next.depth.high < nearest_->depth.low) {
    nearest_ = next;
    return;
  }
  if (next.depth.low > nearest_->depth.high) return;
  nearest_ = made_exact(*nearest_);
  const std::optional<Candidate> rival = made_exact(next);
  if (!rival) return;
  const auto order = [](const Candidate& c) { return std::pair(c.depth.low, c.id); };
  if (!nearest_ || order(*rival) < order(*nearest_)) nearest_ = rival;
}

const CenterRows& ExactFragments::rows_of(TracedTriangles::Id id) {
  CachedRows& cached = cache_[id % kCached];
  if (cached.id == id) return *cached.rows;
  p_view_.clear();
  p_view_.add(triangles_.p_view(id), 0, {});
  const TriangleBatch& p_ndc = projection_.project(p_view_);
  const std::size_t piece = triangles_.piece(id).value_or(0);
  cached.id = id;
  cached.rows.emplace(grid_, ExactTriangle{p_ndc.triangles[piece],
                                           p_ndc.low_parts.empty() ? nullptr : &p_ndc.low_parts[piece],
                                           p_ndc.decimal_marks[piece]});
  return *cached.rows;
}

std::optional<double> ExactFragments::depth(TracedTriangles::Id id, int row, int column) {
  ++count_;
  const CenterRows& rows = rows_of(id);
  if (row < rows.first_row() || row > rows.last_row()) return std::nullopt;
  const std::optional<Span> span = rows.span(row);
  if (!span || column < span->first_column || column > span->last_column) return std::nullopt;
  return span->depth(column);
}

}  // namespace pipeline
