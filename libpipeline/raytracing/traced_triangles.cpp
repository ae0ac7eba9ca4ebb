#include "libpipeline/raytracing/traced_triangles.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/text/error.h"

namespace pipeline {

/// `pieces_` stays empty until the first piece.
void TracedTriangles::add_entry(const TriangleBatch& p_view, std::size_t index, std::uint8_t piece) {
  if (piece != kWhole) pieces_.resize(p_view_.size(), kWhole);
  if (piece != kWhole || !pieces_.empty()) pieces_.push_back(piece);
  p_view_.push_back(p_view.triangles[index]);
  numbers_.push_back(p_view.numbers[index]);
  attributes_.add(p_view.attributes, index);
}

void TracedTriangles::add(const TriangleBatch& p_view, ExactProjection& projection, const Watcher& look_at) {
  if (p_view.size() > 0) add_triangles(p_view, projection, look_at);
  for (const Sphere& sphere : p_view.spheres) {
    const std::optional<Ellipsoid> surface = Ellipsoid::from(sphere.points);
    if (!surface)
      throw InputError(projection.location_of(sphere.locations[0]),
                       expected_but_found("a sphere with a volume", "four points in a plane"));
    spheres_.push_back({*surface, sphere.color, sphere.number, sphere.material});
  }
}

void TracedTriangles::add_triangles(const TriangleBatch& p_view, ExactProjection& projection,
                                    const Watcher& look_at) {
  const auto take = [&](const TriangleBatch& part) {
    const TriangleBatch& p_ndc = projection.project(part);
    for (const Triangle& triangle : p_ndc.triangles)
      for (const Vec3& p : triangle) largest_depth_ = std::max(largest_depth_, std::fabs(p.z));
    look_at(part, p_ndc);
    return p_ndc.size();
  };
  const auto is_clipped = [&](const Triangle& p) { return projection.stage().clips(p); };
  if (std::ranges::none_of(p_view.triangles, is_clipped)) {
    take(p_view);
    for (std::size_t i = 0; i < p_view.size(); ++i) add_entry(p_view, i, kWhole);
    return;
  }
  TriangleBatch single;
  for (std::size_t i = 0; i < p_view.size(); ++i) {
    single.clear();
    single.add(p_view.triangles[i], p_view.numbers[i], p_view.locations[i]);
    single.attributes.add(p_view.attributes, i);
    const std::size_t count = take(single);
    if (!is_clipped(p_view.triangles[i])) {
      add_entry(p_view, i, kWhole);
      continue;
    }
    for (std::size_t piece = 0; piece < count; ++piece)
      add_entry(p_view, i, static_cast<std::uint8_t>(piece));
    if (count == 0 && keeps_dropped_) add_entry(p_view, i, kDropped);
  }
}

void TracedTriangles::copy(Id id, TriangleBatch& p_view) const {
  p_view.add(p_view_[id], numbers_[id], {});
  p_view.attributes.add(attributes_, id);
}

}  // namespace pipeline
