#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_rounding.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// The arithmetic for vertices.
enum class Precision {
  in_doubles,  // by stable formulas, and printed as calculated
  extended     // every printed coordinate is exact but for one correct rounding, or counted as uncertain
};

/// Vertices, or lights, printed with an uncertain digit: the first one and their count.
struct UncertainDigits {
  LineAndColumn first;  // in the input; unknown if there is none
  std::uint64_t count = 0;

  void add(LineAndColumn location) {
    if (count++ == 0) first = location;
  }
};

/// The largest coordinate in absolute value; 1 if all are 0. Where numbers cancel, a remainder below 2^-60 of
/// it counts as 0 (round_to_text).
double size_of(const Vec3& point);
double size_of(const Triangle& triangle);

/// Rounds calculated coordinates to the numbers that are printed. Most pass the rounding test of a kernel
/// (vertex_kernel.h); the caller calculates the others again as balls, which this class rounds. It counts the
/// vertices with an uncertain printed digit.
class CoordinateRounder {
 public:
  /// `file` names the input in messages.
  CoordinateRounder(Precision precision, NumberFormat format, std::string file);

  /// The test that a kernel's coordinate must pass to be printed as it is.
  [[nodiscard]] RoundingTest rounding_test() const;

  /// Rounds the vertex at `location`, on the slow, exact path. `p` contains the exact image, `input_size` is
  /// the size of the triangle that was read (size_of). `is_certain` is false if another number of the vertex
  /// is uncertain. An InputError at the location if a coordinate is beyond a double's range.
  PrintablePoint rounded_exactly(const BallVec3& p, LineAndColumn location, double input_size,
                                 bool is_certain = true);
  /// Sets a vertex of a triangle of the batch to its rounded_exactly.
  void set_vertex_exactly(TriangleBatch& batch, std::size_t triangle, std::size_t vertex, const BallVec3& p,
                          double input_size, bool is_certain = true);
  /// Counts a vertex with an uncertain digit. If bounds must hold and `p` is too wide, an InputError.
  void add_uncertain(LineAndColumn vertex, const BallVec3& p, double input_size);
  /// The InputError for a vertex that has no bounds.
  [[nodiscard]] InputError without_bounds(LineAndColumn vertex) const;
  /// Makes every number that is not within rounding_error (bounds.h) of its exact value an InputError.
  void keep_bounds() { keeps_bounds_ = true; }
  /// 2^-60 of this counts as 0: the size of the numbers read or, if bounds must hold and it is less, of the
  /// point written.
  [[nodiscard]] double size_for_zero(double input_size, const BallVec3& p) const {
    return keeps_bounds_ ? size_within_bounds(input_size, p) : input_size;
  }

  /// The vertices with a printed digit that their balls were too wide to decide.
  [[nodiscard]] const UncertainDigits& uncertain() const { return uncertain_; }
  /// The location of a vertex of the input, for messages.
  [[nodiscard]] SourceLocation location_of(LineAndColumn vertex) const {
    return {file_, vertex.line(), vertex.column()};
  }

 private:
  [[nodiscard]] static double size_within_bounds(double input_size, const BallVec3& p);

  Precision precision_;
  NumberFormat format_;
  std::string file_;
  UncertainDigits uncertain_;
  bool keeps_bounds_ = false;
};

}  // namespace pipeline
