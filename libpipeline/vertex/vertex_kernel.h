#pragma once

#include <array>
#include <span>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/vertex/coordinate_test.h"
#include "libpipeline/vertex/vertex_block.h"

namespace pipeline {

// The fast paths of the arithmetic on vertices. A number is calculated in doubles, or as an unevaluated sum
// of two, together with a bound of its error; where the bound leaves the text open, the vertex is left to
// ball arithmetic. So the bytes of a correctly rounded text are those of exact arithmetic whichever kernel
// runs, and in plain doubles every kernel does the same operations in the same order.

/// A factor of a coordinate: a number as a pair of doubles, and what it adds to the error of an image per
/// unit of the coordinate, if the calculation is in doubles or in pairs.
struct Coefficient {
  double value = 0;  // the nearest double
  double error = 0;
  DoubleDouble pair;
  double pair_error = 0;
  double is_filled = 0;  // 0 if the number is exactly 0, else 1

  Coefficient() = default;
  /// NaN, which settles nothing, as the pair where the ball is beyond the range in which products of pairs
  /// are safe.
  explicit Coefficient(const Ball& number);
};

/// p' = rows * (p - origin, 1).
struct AffineCoefficients {
  Vec3 origin;
  std::array<std::array<Coefficient, 4>, 3> rows;
};

/// With w = -z (perspective) or 1: x' = (x_scale x + x_offset (-w)) / w, likewise y, z' in doubles by the
/// formula that near and far do not spoil.
struct ProjectionCoefficients {
  bool is_perspective = true;
  std::array<Coefficient, 3> scales;   // of x, y, z
  std::array<Coefficient, 3> offsets;  // of z or of 1, for x, y; of 1 for z
  double near = 0;
  double far = 0;
  double depth_range = 0;
};

/// One implementation of the loops over a block's vertices.
struct VertexKernel {
  const char* name;
  void (*transform)(const AffineCoefficients&, const CoordinateTest&, const VertexBlock& p,
                    ImageBlock& image);
  void (*project)(const ProjectionCoefficients&, const CoordinateTest&, const VertexBlock& p_view,
                  ImageBlock& p_ndc);
};

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere.
std::span<const VertexKernel> vertex_kernels();

/// The one in use: the fastest, or the one the environment variable PIPELINE_KERNEL names (kernel_choice.h).
const VertexKernel& vertex_kernel();

}  // namespace pipeline
