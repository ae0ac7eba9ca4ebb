#include "libpipeline/raytracing/traced_triangles.h"

#include <optional>

#include "libpipeline/stream/text_round_trip.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

/// Adds triangle `index` of one batch to another, without its place in the text.
void copy_triangle(const TriangleBatch& from, std::size_t index, TriangleBatch& to) {
  to.add(from.triangles[index], from.numbers[index], from.locations[index]);
  to.attributes.add(from.attributes, index);
}

}  // namespace

ExactProjection::ExactProjection(const ProjectionTransform& projection, const std::string& file, bool is_lit)
    : rounder_(Precision::extended, kShortest, file),
      stage_(projection, ClipMode::automatic, CullMode::nothing, rounder_) {
  if (is_lit) stage_.keep_unclipped_triangles();
}

const TriangleBatch& ExactProjection::project(const TriangleBatch& p_view) {
  stage_.project(p_view, p_ndc_);
  pass_through_text(p_ndc_);
  return p_ndc_;
}

void TracedTriangles::add_whole(const TriangleBatch& p_view, std::size_t index) {
  p_view_.push_back(p_view.triangles[index]);
  numbers_.push_back(p_view.numbers[index]);
  if (!pieces_.empty()) pieces_.push_back(kWhole);
  attributes_.add(p_view.attributes, index);
}

void TracedTriangles::add(
    const TriangleBatch& p_view, ExactProjection& projection,
    const std::function<void(const TriangleBatch& p_view, const TriangleBatch& p_ndc)>& look_at) {
  if (p_view.size() > 0) add_triangles(p_view, projection, look_at);
  for (const Sphere& sphere : p_view.spheres)
    if (!spheres_.add(sphere))
      throw InputError(projection.location_of(sphere.locations[0]),
                       expected_but_found("a sphere with a volume", "four points in a plane"));
}

void TracedTriangles::add_triangles(
    const TriangleBatch& p_view, ExactProjection& projection,
    const std::function<void(const TriangleBatch& p_view, const TriangleBatch& p_ndc)>& look_at) {
  const auto take = [&](const TriangleBatch& part) -> const TriangleBatch& {
    const TriangleBatch& p_ndc = projection.project(part);
    for (const Triangle& triangle : p_ndc.triangles)
      for (const Vec3& p : triangle) largest_depth_ = std::max(largest_depth_, std::fabs(p.z));
    look_at(part, p_ndc);
    return p_ndc;
  };
  const auto is_clipped = [&](const Triangle& p) { return projection.stage().clips(p); };
  if (std::ranges::none_of(p_view.triangles, is_clipped)) {
    take(p_view);
    for (std::size_t i = 0; i < p_view.size(); ++i) add_whole(p_view, i);
    return;
  }
  TriangleBatch single;
  for (std::size_t i = 0; i < p_view.size(); ++i) {
    single.clear();
    copy_triangle(p_view, i, single);
    const std::size_t count = take(single).size();
    if (!is_clipped(p_view.triangles[i])) {
      add_whole(p_view, i);
      continue;
    }
    pieces_.resize(p_view_.size(), kWhole);
    const auto add = [&](std::uint8_t piece) {
      add_whole(p_view, i);
      pieces_.resize(p_view_.size());
      pieces_.back() = piece;
    };
    for (std::size_t piece = 0; piece < count; ++piece) add(static_cast<std::uint8_t>(piece));
    if (count == 0 && keeps_dropped_) add(kDropped);
  }
}

void TracedTriangles::copy(Id id, TriangleBatch& p_view) const {
  p_view.add(p_view_[id], numbers_[id], {});
  p_view.attributes.add(attributes_, id);
}

bool TracedSpheres::add(const Sphere& p_view) {
  const std::optional<Ellipsoid> surface = Ellipsoid::from(p_view.points);
  if (!surface) return false;
  have_colors_ = p_view.color.has_value();
  spheres_.push_back({*surface, p_view.color.value_or(Vec3{}), p_view.number, p_view.material});
  return true;
}

}  // namespace pipeline
