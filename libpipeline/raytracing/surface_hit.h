#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/raytracing/pixel_rays.h"

namespace pipeline {

/// A surface that rays meet: a triangle's id in TracedTriangles. Other shapes are counted on from there.
using SurfaceId = std::uint32_t;
constexpr SurfaceId kNoSurface = std::numeric_limits<SurfaceId>::max();

/// A ray in view space that may start on a surface, at a point that is off the surface by at most `error` in
/// each coordinate. It does not meet the surface it starts on where it starts; of any other it meets only
/// points that are surely beyond its start.
struct SurfaceRay {
  Ray ray;
  SurfaceId start = kNoSurface;
  double error = 0;
};

/// Where a ray meets a surface, in view space.
struct SurfaceHit {
  SurfaceId id = kNoSurface;
  double t = 0;      // the ray's parameter
  Vec3 point;        // on the surface, but for `error`
  double error = 0;  // a bound on the distance between the surface and the point, in each coordinate
  Vec3 face_normal;  // of length 1, on the front side: a triangle is counterclockwise from there
  Vec3 normal;       // for light, of any length and on either side
  Vec3 color;        // the surface's own, channels from 0 to 255
  std::uint32_t material = 0;
  bool is_front = true;                // the side that the ray comes from; inside is the back
  std::array<double, 3> weights = {};  // of a triangle's corners, each from 0 to 1
};

}  // namespace pipeline
