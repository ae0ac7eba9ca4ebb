#include "libpipeline/raytracing/exact_projection.h"

#include <cmath>
#include <cstdint>

#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// True if the text of `value` is a decimal in exact arithmetic; `low_part` is what the double lacks of it.
bool is_decimal(double value, double& low_part) {
  // In this range the shortest form has no exponent, and is n / 10^7 where one is the double
  // (print_shortest).
  constexpr double kScale = 1e7;
  const double size = std::fabs(value);
  if (size >= 0.001 && size < 1e5) return std::nearbyint(size * kScale) / kScale == size;
  char text[kMaxNumberLength];
  DoubleDouble decimal;
  if (!parse_exact_decimal({text, print_shortest(text, value)}, decimal)) return false;
  low_part = decimal.lo;
  return true;
}

}  // namespace

void pass_through_text(TriangleBatch& batch) {
  constexpr double kNoMinus = 0;
  batch.decimal_marks.resize(batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Triangle low_parts;
    unsigned marks = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      Vec3& p = batch.triangles[i][v];
      p = {p.x + kNoMinus, p.y + kNoMinus, p.z + kNoMinus};
      if (is_decimal(p.x, low_parts[v].x)) marks |= 1u << (3 * v);
      if (is_decimal(p.y, low_parts[v].y)) marks |= 2u << (3 * v);
    }
    batch.decimal_marks[i] = static_cast<std::uint16_t>(marks);
    if (low_parts == Triangle{} && batch.low_parts.empty()) continue;
    batch.low_parts.resize(batch.size());
    batch.low_parts[i] = low_parts;
  }
}

}  // namespace pipeline
