#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/picture/shading.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// A ray in view space that may start on a surface, at a point off it by at most `error` in each coordinate.
/// It does not meet this surface at its start, and it meets other surfaces only at points surely beyond its
/// start.
struct SurfaceRay {
  Ray ray;
  SurfaceId start = kNoSurface;
  double error = 0;
};

/// The point where a ray meets a surface, in view space.
struct SurfaceHit {
  SurfaceId id = kNoSurface;  // for none; the other members then mean nothing
  double t = 0;               // the ray's parameter
  Vec3 point;                 // on the surface, within `error`
  double error = 0;           // a bound on the point's distance from the surface in each coordinate
  Vec3 face_normal;           // of length 1, on the front, from which a triangle is counterclockwise
  Vec3 normal;                // for lighting, of any length and on either side
  Vec3 color;                 // the surface's own, channels from 0 to 255
  std::uint32_t material = 0;
  bool is_front = true;                // true if the ray comes from the front; a body's inside is the back
  std::array<double, 3> weights = {};  // of a triangle's corners, from 0 to 1
};

/// A meeting of a ray with a surface.
struct SurfaceMeeting {
  double t;
  std::array<double, 3> weights = {};  // of a triangle's corners, each from 0 to 1; their sum is 1
  bool is_front = true;                // of a sphere: the ray comes from outside
};

/// The test of any ray against triangles anywhere. The ray's largest coordinate becomes the z axis, and edge
/// functions are evaluated in x and y; two triangles get the same values at a shared edge, so that no ray
/// passes between them (S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", 2013).
class SurfaceTriangleTest {
 public:
  explicit SurfaceTriangleTest(const SurfaceRay& ray);

  /// The meeting of the ray with the triangle beyond its start, if any. A ray does not meet a triangle whose
  /// plane, within the errors, may contain its start.
  [[nodiscard]] std::optional<SurfaceMeeting> operator()(const Triangle& p_view) const;
  /// The meeting with a triangle that the ray is known to meet, in spite of errors.
  [[nodiscard]] SurfaceMeeting known(const Triangle& p_view) const;

 private:
  struct Edges {
    std::array<double, 3> functions, z;
  };

  [[nodiscard]] Edges edges(const Triangle& p_view) const;
  [[nodiscard]] SurfaceMeeting meeting(const Edges& edges) const;
  [[nodiscard]] bool may_start_on(const Triangle& p_view) const;

  SurfaceRay ray_;
  std::size_t x_, y_, z_;  // the axes
  double x_shear_, y_shear_, z_scale_;
};

/// A bound on the distance, in each coordinate, of a weighted mean of the triangle's corners in doubles from
/// its plane. The sum of the weights is off by 3 roundings; the mean has 3 more.
double error_of_mean(const Triangle& p_view);

/// Casts rays from anywhere in the scene: finds the surface that they meet, even one that the eye does not
/// see. For one thread.
class SurfaceCaster {
 public:
  /// Needs a hierarchy for any ray (boxes_of), and triangles that include those that `project` drops.
  SurfaceCaster(const TracedTriangles& triangles, const Bvh& bvh) : triangles_(triangles), bvh_(bvh) {}

  /// The first hit, of the surface with the lower id if two are equally near; of kNoSurface if the ray meets
  /// nothing.
  [[nodiscard]] SurfaceHit nearest(const SurfaceRay& ray);
  /// The hit of a primary ray on a surface that it is known to see, a sphere perhaps from within.
  [[nodiscard]] SurfaceHit seen(SurfaceId id, bool is_from_within, const Ray& ray);

  /// A surface between a point and a light.
  struct Crossing {
    double t;  // from 0, at the point, to 1, at the light
    SurfaceId id;
    std::uint32_t material;
    bool is_front;  // true if the ray from the point comes from the front
    double cosine;  // of the angle between the ray and the normal
  };
  /// Fills `crossings` with the surfaces that a ray crosses at t < 1, in order of t; false as soon as
  /// `stops(material)` is true for one of them. At the common edge of two triangles, it crosses one.
  template <typename Stops>
  [[nodiscard]] bool cross(const SurfaceRay& ray, std::vector<Crossing>& crossings, Stops&& stops);

  /// A triangle's corners, for lighting at the corners; none for another shape.
  [[nodiscard]] std::optional<std::array<SurfacePoint, 3>> corners(SurfaceId id);
  /// The number of the object in the scene, from 0.
  [[nodiscard]] std::uint64_t number(SurfaceId id) const { return triangles_.number(id); }

 private:
  /// Calls `visit` with the meetings surely beyond the ray's start, at most two.
  template <typename Visit>
  void for_each_meeting(SurfaceId id, const SurfaceRay& ray, const SurfaceTriangleTest& test,
                        const Visit& visit) const;
  [[nodiscard]] Vec3 unit_normal(SurfaceId id, const Ray& ray, double t) const {
    if (!triangles_.is_sphere(id)) return unit_vector(face_normal(triangles_.p_view(id)));
    return triangles_.sphere(id).surface.normal(point_at(ray, t));
  }
  [[nodiscard]] SurfaceHit hit(SurfaceId id, const Ray& ray, const SurfaceMeeting& meeting);
  static Vec3 point_at(const Ray& ray, double t) { return sum(ray.origin, scaled(ray.direction, t)); }
  /// A bound on the error, in each coordinate, of a ray's point at t on a sphere: the errors of t, of the
  /// product and of the sum.
  static double error_of_point(const Ray& ray, double t) {
    return 0x1p-50 * (largest_in(ray.origin) + std::fabs(t) * largest_in(ray.direction));
  }
  /// Sorts crossings, and merges equal ones: the same point, side and material.
  static void settle(std::vector<Crossing>& crossings);

  const TracedTriangles& triangles_;
  const Bvh& bvh_;
  TriangleColors colors_;
};

/// A ray that starts on a surface never meets it at its start, however near a sphere's other meeting is.
template <typename Visit>
void SurfaceCaster::for_each_meeting(SurfaceId id, const SurfaceRay& ray, const SurfaceTriangleTest& test,
                                     const Visit& visit) const {
  if (!triangles_.is_sphere(id)) {
    if (id == ray.start || !triangles_.is_first(id)) return;
    if (const auto found = test(triangles_.p_view(id))) visit(*found);
    return;
  }
  const auto [entrance, exit] = triangles_.sphere(id).surface.meetings(ray.ray, id == ray.start);
  if (std::isnan(exit)) return;
  for (const auto& [t, is_front] : {std::pair(entrance, true), std::pair(exit, false)}) {
    const double error = ray.start == kNoSurface ? 0 : 2 * ray.error + error_of_point(ray.ray, t);
    if (t * largest_in(ray.ray.direction) > error) visit(SurfaceMeeting{t, {}, is_front});
  }
}

template <typename Stops>
bool SurfaceCaster::cross(const SurfaceRay& ray, std::vector<Crossing>& crossings, Stops&& stops) {
  crossings.clear();
  const SurfaceTriangleTest test(ray);
  double limit = 1;
  bool is_stopped = false;
  bvh_.for_each_candidate(ray.ray, 0, limit, [&](SurfaceId id) {
    if (is_stopped) return;
    for_each_meeting(id, ray, test, [&](const SurfaceMeeting& meeting) {
      if (is_stopped || !(meeting.t < 1)) return;
      const std::uint32_t material = triangles_.material(id);
      is_stopped = stops(material);
      if (is_stopped) {
        limit = -1;  // this ends the search
        return;
      }
      const double cosine = dot(unit_vector(ray.ray.direction), unit_normal(id, ray.ray, meeting.t));
      const bool is_front = triangles_.is_sphere(id) ? meeting.is_front : cosine < 0;
      crossings.push_back({meeting.t, id, material, is_front, std::fabs(cosine)});
    });
  });
  if (is_stopped) return false;
  settle(crossings);
  return true;
}

}  // namespace pipeline
