#include "libpipeline/vertex/coordinate_rounder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

double size_of(const Vec3& point) {
  const double largest = largest_in(point);
  return largest == 0 ? 1 : largest;
}

double size_of(const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  return size_of(Vec3{largest_in(a), largest_in(b), largest_in(c)});
}

CoordinateRounder::CoordinateRounder(Precision precision, NumberFormat format, std::string file)
    : precision_(precision), format_(format), file_(std::move(file)) {}

RoundingTest CoordinateRounder::rounding_test() const {
  if (precision_ == Precision::in_doubles) return {RoundingTestKind::finite};
  if (format_.shortest) return {RoundingTestKind::nearest};
  // More decimals would show rounding errors of doubles of ordinary magnitude.
  constexpr int kMaxDecimalsOfDoubles = 10;
  return {RoundingTestKind::decimals, kPowersOfTen[static_cast<std::size_t>(format_.decimals)],
          format_.decimals > kMaxDecimalsOfDoubles};
}

// These two are seldom called; they are not inlined, so that their callers can be.
[[gnu::noinline]] double CoordinateRounder::size_within_bounds(double input_size, const BallVec3& p) {
  return std::min(input_size, std::max({p.x.magnitude(), p.y.magnitude(), p.z.magnitude(), kLeastSize}));
}

[[gnu::noinline]] void CoordinateRounder::add_uncertain(LineAndColumn vertex, const BallVec3& p,
                                                        double input_size) {
  uncertain_.add(vertex);
  const double radius = std::max({p.x.radius(), p.y.radius(), p.z.radius()});
  if (keeps_bounds_ && radius > 0x1p-62 * size_for_zero(input_size, p)) throw without_bounds(vertex);
}

InputError CoordinateRounder::without_bounds(LineAndColumn vertex) const {
  return {location_of(vertex), "a vertex within bounds", "numbers that cancel beyond 31 digits, or overflow"};
}

PrintablePoint CoordinateRounder::rounded_exactly(const BallVec3& p, LineAndColumn location,
                                                  double input_size, bool is_certain) {
  const PrintablePoint point = round_to_text(p, format_, size_for_zero(input_size, p));
  if (point.overflow != 0)
    throw InputError(location_of(location), "a vertex whose image is within a double's range",
                     std::string("an overflow of its ") + point.overflow);
  if (!is_certain || !point.is_certain) add_uncertain(location, p, input_size);
  return point;
}

// Flattened, as it is called for every vertex of a cut triangle.
[[gnu::flatten]] void CoordinateRounder::set_vertex_exactly(TriangleBatch& batch, std::size_t triangle,
                                                            std::size_t vertex, const BallVec3& p,
                                                            double input_size, bool is_certain) {
  const PrintablePoint rounded =
      rounded_exactly(p, batch.locations[triangle][vertex], input_size, is_certain);
  batch.triangles[triangle][vertex] = rounded.hi;
  if (batch.low_parts.empty()) {
    if (rounded.lo == Vec3{}) return;
    batch.low_parts.resize(batch.size());
  }
  batch.low_parts[triangle][vertex] = rounded.lo;
}

}  // namespace pipeline
