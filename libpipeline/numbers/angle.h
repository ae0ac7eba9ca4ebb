#pragma once

#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// The sine, the cosine and 1 - cosine of an angle. The last is kept separately because the subtraction would
/// cancel its digits for a small angle.
struct SineCosine {
  Ball sine;
  Ball cosine;
  Ball versine;
};

/// Below this many degrees the first term of each series suffices, and the others might underflow.
constexpr double kTinyDegrees = 0x1p-200;

Ball to_radians(const Ball& degrees);

/// Takes `degrees` as exact. The angle is reduced in degrees, which is exact, before it is converted to
/// radians, so 1e22 degrees are as accurate as 1; multiples of 30 and 90 degrees come out exact where the
/// value is rational (I. Niven, "Irrational Numbers", 1956: 0, 1/2, 1 are the only rational sines of rational
/// degrees). No libm function is used, so every system gives the same bits.
SineCosine sine_cosine_of_degrees(DoubleDouble degrees);

}  // namespace pipeline
