#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {

/// A bound on the error of a vertex's coordinates: |coordinate - truth| <= absolute + relative * m, where m
/// is the vertex's largest |coordinate|. The truth is the stages' result without any rounding.
struct ErrorBound {
  double absolute = 0, relative = 0;

  [[nodiscard]] double at(double largest) const { return (absolute + relative * largest) * kRoundUp; }

  /// A factor above the rounding errors of a few sums and products of doubles.
  static constexpr double kRoundUp = 1 + 0x1p-40;
};

/// The header line `bounds` of a stage text. It names the text's space, so that no stage accepts a line that
/// an earlier program passed on unchanged.
struct Bounds {
  static constexpr std::array<std::string_view, 3> kSpaces = {"world", "view", "ndc"};

  ErrorBound error;                   // of the vertices; in a projected text, of those in view space
  std::optional<ErrorBound> rounded;  // in NDC: of its vertices against exact projection
  std::string_view space = kSpaces[0];
};

/// The relative error of rounding to the nearest double, and of a 0 in the shortest form.
constexpr double kRelativeRounding = 0x1p-53 * (1 + 0x1p-6);
/// Below this size, the shortest form has an absolute bound: where numbers cancel, one below 2^-60 times this
/// may become 0 (number_rounding.h).
constexpr double kLeastSize = 0x1p-30;

/// The distance between an exact coordinate and the double that a stage reads from its text.
inline ErrorBound rounding_error(NumberFormat format) {
  if (format.shortest) return {0x1p-60 * kLeastSize, kRelativeRounding};
  // Ties may go either way within 2^-20 of a unit.
  return {0.500001 / kPowersOfTen[static_cast<std::size_t>(format.decimals)], kRelativeRounding};
}

/// The bound of a rotated text whose own rounding errors are within `own` (tests/proofs/bounds.g). `row_sum`
/// bounds the sums of the rotation's |entries| by row. A vertex p and its image v = R (p - eye) have |p| <=
/// |eye| + sqrt(3) |v| in their largest coordinates.
inline ErrorBound error_in_view(const ErrorBound& world, const Vec3& eye, double row_sum,
                                const ErrorBound& own) {
  constexpr double kRoot3 = 1.7320509;
  const double size_error = world.relative * (largest_in(eye) + kRoot3 * own.absolute);
  return {(row_sum * (world.absolute + size_error) + own.absolute) * ErrorBound::kRoundUp,
          (row_sum * kRoot3 * world.relative * (1 + own.relative) + own.relative) * ErrorBound::kRoundUp};
}

}  // namespace pipeline
