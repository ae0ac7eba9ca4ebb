#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "libpipeline/mat4.h"
#include "libpipeline/number_rounding.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

/// How vertices are calculated: `plain` in doubles by stable formulas, printed as they come out; `extended`
/// so that every number printed is the correctly rounded result of exact arithmetic.
enum class Precision { plain, extended };

/// Decides which text a calculated coordinate gets. A double and a bound of its error are enough for most
/// numbers; where they are not, the caller calculates the number again as a ball.
class CoordinateRounder {
 public:
  /// `file` names the input in messages.
  CoordinateRounder(Precision precision, NumberFormat format, std::string file);

  /// True if `value`, which may be wrong by `error`, can be printed as it is.
  [[nodiscard]] bool accepts(double value, double error) const {
    return precision_ == Precision::plain ? std::isfinite(value) : rounds_safely(value, error, format_);
  }

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
