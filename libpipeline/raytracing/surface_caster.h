#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/picture/shading.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// A surface that rays meet: the id of a triangle in TracedTriangles; other shapes follow the triangles.
using SurfaceId = std::uint32_t;
constexpr SurfaceId kNoSurface = std::numeric_limits<SurfaceId>::max();

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
  SurfaceId id = kNoSurface;
  double t = 0;      // the ray's parameter
  Vec3 point;        // on the surface, within `error`
  double error = 0;  // a bound on the point's distance from the surface in each coordinate
  Vec3 face_normal;  // of length 1, on the front, from which a triangle is counterclockwise
  Vec3 normal;       // for lighting, of any length and on either side
  Vec3 color;        // the surface's own, channels from 0 to 255
  std::uint32_t material = 0;
  bool is_front = true;                // true if the ray comes from the front; a body's inside is the back
  std::array<double, 3> weights = {};  // of a triangle's corners, from 0 to 1
};

/// The test of any ray against triangles anywhere. The ray's largest coordinate becomes the z axis, and edge
/// functions are evaluated in x and y; two triangles get the same values at a shared edge, so that no ray
/// passes between them (S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", 2013).
class SurfaceTriangleTest {
 public:
  struct Meeting {
    double t;
    std::array<double, 3> weights;  // each from 0 to 1, their sum is 1
  };

  explicit SurfaceTriangleTest(const SurfaceRay& ray);

  /// The meeting of the ray with the triangle beyond its start, if any. A ray does not meet a triangle whose
  /// plane, within the errors, may contain its start.
  [[nodiscard]] std::optional<Meeting> operator()(const Triangle& p_view) const;
  /// The meeting with a triangle that the ray is known to meet, in spite of errors.
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

/// A bound on the distance, in each coordinate, of a weighted mean of the triangle's corners in doubles from
/// its plane. The sum of the weights is off by 3 roundings; the mean has 3 more.
double error_of_mean(const Triangle& p_view);

/// Casts rays from anywhere in the scene: finds the surface that they meet, even one that the eye does not
/// see. For one thread.
class SurfaceCaster {
 public:
  /// Needs a hierarchy for any ray (boxes_of), and triangles that include those that `project` drops.
  SurfaceCaster(const TracedTriangles& triangles, const Bvh& bvh) : triangles_(triangles), bvh_(bvh) {}

  /// The first hit, of the surface with the lower id if two are equally near; none if the ray meets nothing.
  [[nodiscard]] std::optional<SurfaceHit> nearest(const SurfaceRay& ray);
  /// The hit of a primary ray on a surface that it is known to see.
  [[nodiscard]] SurfaceHit seen(SurfaceId id, const Ray& ray);

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
  /// The meetings with a sphere that are surely beyond the ray's start.
  [[nodiscard]] Ellipsoid::Meetings sphere_meetings(SurfaceId id, const SurfaceRay& ray) const;
  /// The meeting with a triangle, if any; none with the triangle that the ray starts on.
  [[nodiscard]] std::optional<SurfaceTriangleTest::Meeting> meeting(SurfaceId id, const SurfaceRay& ray,
                                                                    const SurfaceTriangleTest& test) const {
    if (id == ray.start || !triangles_.is_first(id)) return std::nullopt;
    return test(triangles_.p_view(id));
  }
  [[nodiscard]] SurfaceHit sphere_hit(SurfaceId id, const Ray& ray, const Ellipsoid::Meeting& meeting);
  static Vec3 point_at(const Ray& ray, double t) { return sum(ray.origin, scaled(ray.direction, t)); }

  [[nodiscard]] SurfaceHit triangle_hit(SurfaceId id, const Ray& ray,
                                        const SurfaceTriangleTest::Meeting& meeting);
  /// Sorts crossings, and merges equal ones: the same point, side and material.
  static void settle(std::vector<Crossing>& crossings);

  const TracedTriangles& triangles_;
  const Bvh& bvh_;
  TriangleColors colors_;
};

template <typename Stops>
bool SurfaceCaster::cross(const SurfaceRay& ray, std::vector<Crossing>& crossings, Stops&& stops) {
  crossings.clear();
  const SurfaceTriangleTest test(ray);
  double limit = 1;
  bool is_stopped = false;
  bvh_.for_each_candidate(ray.ray, 0, limit, [&](SurfaceId id) {
    const auto add = [&](double t, std::optional<bool> is_front, const auto& unit_normal) {
      if (is_stopped || !(t < 1)) return;
      is_stopped = stops(triangles_.material(id));
      if (is_stopped) {
        limit = -1;  // this ends the search
        return;
      }
      const double cosine = dot(unit_vector(ray.ray.direction), unit_normal());
      crossings.push_back({t, id, triangles_.material(id), is_front.value_or(cosine < 0), std::fabs(cosine)});
    };
    if (is_stopped) return;
    if (triangles_.is_sphere(id)) {
      for (const auto& [t, is_front] : sphere_meetings(id, ray))
        add(t, is_front, [&, at = t] { return triangles_.sphere(id).surface.normal(point_at(ray.ray, at)); });
    } else if (const auto found = meeting(id, ray, test)) {
      add(found->t, {}, [&] { return unit_vector(face_normal(triangles_.p_view(id))); });
    }
  });
  if (is_stopped) return false;
  settle(crossings);
  return true;
}

}  // namespace pipeline
