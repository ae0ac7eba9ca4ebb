#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

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

/// The test of any ray with triangles anywhere. The ray's largest coordinate becomes the z axis, and edge
/// functions are compared in x and y; two triangles calculate alike at the edge they share, so that no ray
/// passes between them (S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", 2013).
class SurfaceTriangleTest {
 public:
  struct Meeting {
    double t;
    std::array<double, 3> weights;  // each from 0 to 1, their sum is 1
  };

  explicit SurfaceTriangleTest(const SurfaceRay& ray);

  /// Where the ray meets the triangle beyond its start; none if it does not. A start that may lie in the
  /// triangle's plane, as far as errors can tell, does not meet it.
  [[nodiscard]] std::optional<Meeting> operator()(const Triangle& p_view) const;
  /// Where it meets a triangle that it is known to meet, in spite of errors.
  [[nodiscard]] Meeting known(const Triangle& p_view) const;

 private:
  struct Edges {
    double a, b, c;
    std::array<double, 3> z;
  };

  [[nodiscard]] Edges edges(const Triangle& p_view) const;
  [[nodiscard]] Meeting meeting(const Edges& edges) const;
  [[nodiscard]] bool may_start_on(const Triangle& p_view) const;

  SurfaceRay ray_;
  std::size_t x_, y_, z_;  // the axes
  double x_shear_, y_shear_, z_scale_;
};

/// A bound on how far, in each coordinate, a weighted mean of the triangle's corners in doubles is off its
/// plane. The sum of the weights is off by 3 roundings, and the mean has 3 more.
double error_of_mean(const Triangle& p_view);

}  // namespace pipeline
