#include "libpipeline/vertex/odd_transforms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

constexpr std::uint64_t kMostTyped = 100;  // triangles; larger models may have a few without area

/// The count of decimals that a number was written with, as far as its double shows; at most 10.
int decimal_count(double value) {
  double scaled = std::fabs(value);
  for (int count = 0; count < 10; ++count, scaled *= 10)
    if (std::fabs(scaled - std::round(scaled)) < 1e-6) return count;
  return 10;
}

/// True if `angle`, taken as radians, is a multiple of 30 or 45 degrees, up to a full turn, written with at
/// least four decimals, the last of them rounded or cut.
bool looks_like_radians(double angle) {
  constexpr double kFullTurn = 2 * std::numbers::pi;
  if (angle == 0 || std::fabs(angle) > kFullTurn + 1e-4) return false;
  const int count = decimal_count(angle);
  if (count < 4) return false;
  const double last_unit = std::pow(10.0, -count);
  return std::ranges::any_of(std::array{kFullTurn / 12, kFullTurn / 8}, [&](double step) {
    return std::fabs(angle - step * std::round(angle / step)) < last_unit;
  });
}

/// True for three points, no two of them equal, that lie on a line but for the rounding of decimals.
bool are_on_line(const Triangle& p) {
  constexpr double kSine = 1e-12;
  const Vec3 normal = cross(unit_vector(difference(p[1], p[0])), unit_vector(difference(p[2], p[0])));
  return dot(normal, normal) < kSine * kSine;
}

std::string in_degrees(double radians) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0f", radians * 180 / std::numbers::pi);
  return text.data();
}

}  // namespace

void OddTransforms::add(const RotateCommand& rotate, const SourceLocation& location) {
  const Vec3& axis = rotate.axis;
  const double angle = rotate.angle_degrees;
  if (angle == 0 && !without_angle_.is_known() &&
      std::max({std::fabs(axis.x), std::fabs(axis.y), std::fabs(axis.z)}) > 1)
    without_angle_ = at(location);
  if (in_radians_.is_known() || !looks_like_radians(angle)) return;
  in_radians_ = at(location);
  angle_ = angle;
}

void OddTransforms::add(const TriangleBatch& p_model) {
  for (std::size_t i = 0; i < p_model.size() && ++triangle_count_ <= kMostTyped; ++i) {
    const Triangle& p = p_model.triangles[i];
    const bool has_equal_vertices = p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
    if (!has_equal_vertices && !are_on_line(p)) continue;
    if (without_area_count_++ > 0) continue;
    without_area_ = p_model.locations[i][0];
    has_equal_vertices_ = has_equal_vertices;
  }
}

std::vector<std::string> OddTransforms::notes(const std::string& file, bool has_objects) const {
  std::vector<std::string> notes;
  const auto add = [&](LineAndColumn place, const std::string& note) {
    if (place.is_known())
      notes.push_back(to_string(SourceLocation{file, place.line(), place.column()}) + ": " + note);
  };
  add(in_radians_, "this angle looks like radians, but angles are in degrees: try " + in_degrees(angle_));
  add(without_angle_, "this rotate turns by 0 degrees: the angle comes first, then the axis");
  if (triangle_count_ <= kMostTyped)
    add(without_area_,
        std::string(has_equal_vertices_ ? "two vertices of this triangle are equal"
                                        : "the vertices of this triangle lie on a line") +
            ", so it has no area" +
            (without_area_count_ > 1 ? ", like " + std::to_string(without_area_count_ - 1) + " more" : ""));
  if (saved_count_ > 0)
    add(first_saved_, counted(saved_count_, "push command") +
                          " without a pop, the first of them here: the scene's end undoes "
                          "no transform");
  if (has_objects)
    add(last_transform_, "no triangle comes after this transform: write it before what it is to move");
  return notes;
}

}  // namespace pipeline
