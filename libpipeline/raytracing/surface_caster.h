#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/picture/shading.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/surface_triangle.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// Casts rays from anywhere in the scene: finds the surface they meet, whether the eye sees it or not. For
/// one thread.
class SurfaceCaster {
 public:
  /// A hierarchy for any ray (boxes_of). Triangles that `project` drops have to be among them.
  SurfaceCaster(const TracedTriangles& triangles, const Bvh& bvh) : triangles_(triangles), bvh_(bvh) {}

  /// The first hit, of equally near surfaces the one with the lower id; none if the ray meets nothing.
  [[nodiscard]] std::optional<SurfaceHit> nearest(const SurfaceRay& ray);
  /// The hit of a surface that a primary ray is known to see.
  [[nodiscard]] SurfaceHit seen(SurfaceId id, const Ray& ray);

  /// A surface between a point and a light.
  struct Crossing {
    double t;  // from 0, at the point, to 1, at the light
    SurfaceId id;
    std::uint32_t material;
    bool is_front;  // the side that the ray from the point comes from
    double cosine;  // of the angle between the ray and the normal
  };
  /// Fills `crossings` with the surfaces that a ray crosses at t < 1, in their order; false as soon as
  /// `stops(material)` is true for one of them. Where it passes between two triangles, it crosses one.
  template <typename Stops>
  [[nodiscard]] bool cross(const SurfaceRay& ray, std::vector<Crossing>& crossings, Stops&& stops);

  /// A triangle's corners, for light at the corners; none for another shape.
  [[nodiscard]] std::optional<std::array<SurfacePoint, 3>> corners(SurfaceId id);
  /// The number of the object in the scene, from 0.
  [[nodiscard]] std::uint64_t number(SurfaceId id) const { return triangles_.number(id); }

 private:
  /// The meetings with a sphere that are surely beyond the ray's start.
  [[nodiscard]] Ellipsoid::Meetings sphere_meetings(SurfaceId id, const SurfaceRay& ray) const;
  /// The meeting with a triangle; none with the one that the ray starts on.
  [[nodiscard]] std::optional<SurfaceTriangleTest::Meeting> meeting(SurfaceId id, const SurfaceRay& ray,
                                                                    const SurfaceTriangleTest& test) const {
    if (id == ray.start || !triangles_.is_first(id)) return std::nullopt;
    return test(triangles_.p_view(id));
  }
  [[nodiscard]] SurfaceHit sphere_hit(SurfaceId id, const Ray& ray, const Ellipsoid::Meeting& meeting);
  static Vec3 point_at(const Ray& ray, double t) { return sum(ray.origin, scaled(ray.direction, t)); }

  [[nodiscard]] SurfaceHit triangle_hit(SurfaceId id, const Ray& ray,
                                        const SurfaceTriangleTest::Meeting& meeting);
  /// Sorts crossings, and merges those on the same side of the same place into one.
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
        limit = -1;  // ends the search
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
