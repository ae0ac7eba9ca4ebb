#include "libpipeline/vertex/close_layers.h"

#include <algorithm>
#include <cmath>

namespace pipeline {
namespace {

// Where the last decimal is less than this share of every distance from the eye, layers so close are rare.
constexpr double kFine = 1e-5;
// Roundings on the way to a depth, one after the other: model, view.
constexpr double kRoundingsBefore = 2;
// A place counts as inside a triangle only if no weight is below this: neighbors meet on edges.
constexpr double kInside = 1e-6;

/// The places are where no grid of vertices is.
double place(int index, double offset, int side) {
  return 2 * (index + offset) / side - 1;
}

}  // namespace

CloseLayers::CloseLayers(const ProjectionTransform& projection, std::optional<int> decimals)
    : projection_(projection),
      x_scale_(std::fabs(projection.x_scale.nearest_double())),
      y_scale_(std::fabs(projection.y_scale.nearest_double())) {
  if (!decimals || !projection.is_perspective) return;
  decimals_ = *decimals;
  const double half_unit = std::pow(10, -decimals_) / 2;
  const double near = projection.near, far = projection.far;
  const double coarsest = std::max(half_unit / slope_at(far) / far, half_unit / near);
  if (!(coarsest > kFine)) return;
  half_unit_ = half_unit;
  places_.resize(kSide * kSide);
}

/// The distance in front of the eye.
double CloseLayers::distance_at(double z) const {
  const double near = projection_.near, far = projection_.far;
  return 2 * far * near / (far * (1 - z) + near * (1 + z));
}

/// By how much z grows with the distance.
double CloseLayers::slope_at(double distance) const {
  const double near = projection_.near, far = projection_.far;
  return 2 * near / (1 - near / far) / distance / distance;
}

void CloseLayers::add(const TriangleBatch& p_ndc) {
  if (half_unit_ == 0) return;
  for (const Triangle& triangle : p_ndc.triangles)
    if (look_count_ <= kMostLooks) look_at(triangle);
}

void CloseLayers::look_at(const Triangle& p_ndc) {
  const auto& [a, b, c] = p_ndc;
  // The places from `first` to before `last` in the triangle's box, on one axis.
  const auto range = [](double p, double q, double r, double offset) {
    const auto index = [&](double x) {
      return std::ceil(std::clamp((x + 1) * kSide / 2 - offset, -1.0, kSide + 0.0));
    };
    return std::pair(std::max(static_cast<int>(index(std::min({p, q, r}))), 0),
                     std::min(static_cast<int>(index(std::max({p, q, r}))), kSide));
  };
  constexpr double kRight = 0.37, kUp = 0.61;
  const auto [first_column, end_column] = range(a.x, b.x, c.x, kRight);
  if (first_column >= end_column) return;
  const auto [first_row, end_row] = range(a.y, b.y, c.y, kUp);
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  const Plane plane = {((b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y)) / area,
                       ((b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z)) / area};
  if (!std::isfinite(plane.z_x) || !std::isfinite(plane.z_y)) return;
  for (int row = first_row; row < end_row; ++row) {
    for (int column = first_column; column < end_column; ++column) {
      const double x = place(column, kRight, kSide), y = place(row, kUp, kSide);
      const double c_weight = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
      const double b_weight = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
      if (!(std::min({b_weight, c_weight, 1 - b_weight - c_weight}) > kInside)) continue;
      const double z = a.z + b_weight * (b.z - a.z) + c_weight * (c.z - a.z);
      if (z >= -1 && z <= 1) look_at(places_[static_cast<std::size_t>(row * kSide + column)], z, plane);
    }
    look_count_ += static_cast<std::size_t>(end_column - first_column);
  }
}

void CloseLayers::look_at(Place& place, double z, const Plane& plane) const {
  const double steepness = std::fabs(plane.z_x) + std::fabs(plane.z_y), d = distance_at(z);
  const double moved = (std::fabs(plane.z_x) * (x_scale_ + 1) + std::fabs(plane.z_y) * (y_scale_ + 1)) / d;
  const double error = half_unit_ * (1 + steepness + kRoundingsBefore * (moved + slope_at(d)));
  const double gap = std::fabs(z - place.z);
  const bool is_close = gap <= error + place.error;
  if (!is_close && z > place.z) return;
  const double rival = !is_close ? 0 : std::max(gap, place.rival);
  place = {std::min(z, place.z), is_close ? std::max(error, place.error) : error, rival};
}

std::optional<CloseLayers::Found> CloseLayers::found() const {
  if (look_count_ > kMostLooks) return std::nullopt;
  std::size_t shown_count = 0;
  double gap = 0;
  std::vector<double> missing;  // by which factor decimals are too coarse
  for (const Place& place : places_) {
    if (place.z <= 1) ++shown_count;
    if (place.rival == 0) continue;
    gap = std::max(gap, distance_at(place.z + place.rival) - distance_at(place.z));
    missing.push_back(2 * place.error / place.rival);
  }
  constexpr std::size_t kFewest = 4;
  if (missing.size() < kFewest || missing.size() * 100 < shown_count) return std::nullopt;
  std::ranges::sort(missing);
  const int more = static_cast<int>(std::ceil(std::log10(std::max(missing[missing.size() * 9 / 10], 1.01))));
  Found found = {static_cast<double>(missing.size()) / static_cast<double>(shown_count), gap, std::nullopt};
  if (decimals_ + more <= 12) found.enough = decimals_ + more;
  return found;
}

}  // namespace pipeline
