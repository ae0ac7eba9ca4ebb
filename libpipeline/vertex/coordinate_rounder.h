#pragma once

#include <cstddef>
#include <string>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_rounding.h"
#include "libpipeline/vertex/affine_matrix.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// How vertices are calculated.
enum class Precision {
  in_doubles,  // by stable formulas, and printed as calculated
  extended     // every printed number is the correctly rounded result of exact arithmetic
};

/// Rounds calculated coordinates to the numbers that are printed. Most pass the rounding test of a kernel
/// (vertex_kernel.h); the caller calculates the others again as balls, which this class rounds. It remembers
/// whether a printed digit was uncertain.
class CoordinateRounder {
 public:
  /// `file` names the input in messages.
  CoordinateRounder(Precision precision, NumberFormat format, std::string file);

  /// The test that a kernel's coordinate must pass to be printed as it is.
  [[nodiscard]] RoundingTest rounding_test() const;

  /// Sets one vertex of a triangle of the batch: the slow, exact path. `p` contains the exact image. An
  /// InputError at the vertex's location if a coordinate is beyond a double's range.
  void set_vertex_exactly(TriangleBatch& batch, std::size_t triangle, std::size_t vertex, const BallVec3& p);

  /// The location of the first vertex printed with an uncertain digit: its ball was too wide to decide it.
  /// Not known (is_known()) if there is none.
  [[nodiscard]] LineAndColumn first_uncertain() const { return first_uncertain_; }
  /// The location of a vertex of the input, for messages.
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
