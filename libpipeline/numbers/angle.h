#pragma once

#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// The sine, the cosine and 1 - cosine of an angle. The last has its own place because the difference would
/// lose its digits where the angle is small.
struct SineCosine {
  Ball sine;
  Ball cosine;
  Ball versine;
};

/// Below this many degrees the series end with their first terms, and the others might underflow.
constexpr double kTinyDegrees = 0x1p-200;

Ball to_radians(const Ball& degrees);

/// Of `degrees` taken as exact. The angle is reduced in degrees, where that is exact, before it becomes
/// radians, so that 1e22 degrees are as good as 1; multiples of 30 and 90 degrees come out exact where the
/// value is rational (I. Niven, "Irrational Numbers", 1956: 0, 1/2, 1 are the only rational sines of rational
/// degrees). No libm function takes part, so every system gives the same bits.
SineCosine sine_cosine_of_degrees(DoubleDouble degrees);

}  // namespace pipeline
