#pragma once

namespace pipeline {

/// What a calculated coordinate has to meet to be printed as it is: it is `finite`; or every number within
/// its error has the text of `decimals` decimals that it has; or every such number has the same `nearest`
/// double.
enum class CoordinateTestKind { finite, decimals, nearest };

struct CoordinateTest {
  CoordinateTestKind kind = CoordinateTestKind::finite;
  double scale = 1;  // 10^decimals
  /// True if doubles cannot meet the test, however good the formula: the calculation takes two for a number.
  bool needs_pairs = false;
};

}  // namespace pipeline
