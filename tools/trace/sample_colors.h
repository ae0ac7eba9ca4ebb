#pragma once

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// Gives samples their colors, for one thread. A sample is a pixel of the screen whose rays are cast: of the
/// picture's, or of a finer one.
class SampleColors {
 public:
  SampleColors() = default;
  virtual ~SampleColors() = default;
  SampleColors(const SampleColors&) = delete;
  SampleColors& operator=(const SampleColors&) = delete;

  /// The color of a sample that shows `seen`; one that shows nothing has the background's.
  virtual Color color(int row, int column, const RayCaster::Seen& seen) = 0;
};

}  // namespace pipeline
