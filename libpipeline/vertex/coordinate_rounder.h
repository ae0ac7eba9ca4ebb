#pragma once

#include <cstddef>
#include <string>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_rounding.h"
#include "libpipeline/vertex/affine_matrix.h"
#include "libpipeline/vertex/coordinate_test.h"

namespace pipeline {

/// How vertices are calculated: `in_doubles` by stable formulas, printed as they come out; `extended`
/// so that every number printed is the correctly rounded result of exact arithmetic.
enum class Precision { in_doubles, extended };

/// Decides which text a calculated coordinate gets. A number of one or two doubles and a bound of its error
/// are enough for most; where they are not, the caller calculates the number again as a ball.
class CoordinateRounder {
 public:
  /// `file` names the input in messages.
  CoordinateRounder(Precision precision, NumberFormat format, std::string file);

  /// What a calculated coordinate has to meet to be printed as it is.
  [[nodiscard]] CoordinateTest test() const;

  /// Sets one vertex of a triangle of the batch from balls. An InputError at the vertex's place if a
  /// coordinate is beyond a double's range.
  void set_vertex_exactly(TriangleBatch& batch, std::size_t triangle, std::size_t vertex, const BallVec3& p);

  /// Where the first vertex stands that was printed with digits that are not certain; nowhere if there is
  /// none.
  [[nodiscard]] LineAndColumn first_uncertain() const { return first_uncertain_; }
  /// The place of a vertex of the input.
  [[nodiscard]] SourceLocation location_of(LineAndColumn vertex) const {
    return {file_, vertex.line(), vertex.column()};
  }

 private:
  void expect_finite(double coordinate, const char* name, LineAndColumn vertex) const;

  Precision precision_;
  NumberFormat format_;
  std::string file_;
  LineAndColumn first_uncertain_;
};

}  // namespace pipeline
