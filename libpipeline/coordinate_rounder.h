#pragma once

#include <cstddef>
#include <string>

#include "libpipeline/coordinate_test.h"
#include "libpipeline/mat4.h"
#include "libpipeline/number_rounding.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

/// How vertices are calculated: `plain` in doubles by stable formulas, printed as they come out; `extended`
/// so that every number printed is the correctly rounded result of exact arithmetic.
enum class Precision { plain, extended };

/// Decides which text a calculated coordinate gets. A number of one or two doubles and a bound of its error
/// are enough for most; where they are not, the caller calculates the number again as a ball.
class CoordinateRounder {
 public:
  /// `file` names the input in messages.
  CoordinateRounder(Precision precision, NumberFormat format, std::string file);

  /// What a calculated coordinate has to meet to be printed as it is.
  [[nodiscard]] CoordinateTest test() const;

  /// Sets one vertex of a triangle of the batch from balls. An InputError with the vertex's line if a
  /// coordinate is beyond a double's range.
  void set_vertex(TriangleBatch& batch, std::size_t triangle, std::size_t vertex, const BallVec3& p);

  /// The line of the first vertex that was printed with digits that are not certain, 0 if there is none.
  [[nodiscard]] std::size_t first_uncertain_line() const { return first_uncertain_line_; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  Precision precision_;
  NumberFormat format_;
  std::string file_;
  std::size_t first_uncertain_line_ = 0;
};

}  // namespace pipeline
