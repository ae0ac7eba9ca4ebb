#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/picture/shown_colors.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/surface_caster.h"

namespace pipeline {

enum class RayKind { primary, shadow, mirrored, refracted };
constexpr std::array kRayKindNames = {"primary", "shadow", "mirrored", "refracted"};  // by RayKind

/// A ray that takes part in the color of a pixel.
struct LoggedRay {
  RayKind kind;
  int depth;                                 // 0 for a primary ray, else 1 more than the parent ray
  double weight;                             // the largest part of the pixel's color that it can bring
  Vec3 origin;                               // in view space
  bool is_cut = false;                       // not cast
  std::optional<std::uint64_t> object = {};  // the number of the object that it meets, if any
  std::optional<std::size_t> light = {};     // the number of a shadow ray's light
  Vec3 point = {};                           // where it meets the object
  Vec3 direction = {};                       // of length 1, if it meets no object
  bool is_front = true;
  bool is_sphere = false;
  Vec3 brought = {};  // a color; for a shadow ray, the part of the light that arrives
};

/// The rays that make the color of a pixel, each after its parent.
using RayLog = std::vector<LoggedRay>;

/// The rules by which light travels in a scene, and by which rays end.
struct LightTransportSetup {
  ShadingModel model = ShadingModel::none;  // `none`: a surface shows its own color
  Lighting lighting;
  std::vector<Material> materials;  // by their numbers
  Vec3 background;                  // channels from 0 to 255
  bool has_shadows = true;
  bool recurses = true;  // otherwise nothing mirrors or is clear
  /// A ray that would bring less than this part of a pixel's color is not cast; by default, half a level.
  double min_contribution = 1.0 / 510;
  int max_depth = 32;  // the maximum count of reflections and refractions on a path
};

/// The color that rays bring, by T. Whitted's recursion ("An improved illumination model for shaded display",
/// 1980):
///   alpha ((1 - R) local + R mirror) + (1 - alpha) (F mirror + (1 - F) refracted)
/// with the material's reflectance R, and F by Fresnel's equations. `local` is lit_color with the part of
/// each light that arrives on a straight line: an opaque surface passes nothing; a clear one passes (1 -
/// alpha) (1 - F), and its inside exp(-absorption times length). A ray that hits the back of a surface came
/// through its material, which weakens it in the same way. Colors are linear sums of channels from 0 to 255,
/// not clamped.
class LightTransport {
 public:
  /// Needs a hierarchy for any ray, and triangles that include those that `project` drops. For one thread.
  LightTransport(const TracedTriangles& triangles, const Bvh& bvh, const LightTransportSetup& setup)
      : setup_(setup), caster_(triangles, bvh) {}

  struct RayCounts {
    std::array<std::uint64_t, kRayKindNames.size()> cast = {};  // by RayKind, but for primary rays
    std::uint64_t cut = 0;          // not cast: they would have brought too little or were too deep
    double largest_cut_weight = 0;  // the largest sum of cut weights for one primary ray

    void add(const RayCounts& other);
  };

  /// The radiance of a primary ray from what it sees, already found.
  [[nodiscard]] Vec3 radiance(const std::optional<RayCaster::Seen>& seen, const Ray& ray);
  [[nodiscard]] const RayCounts& counts() const { return counts_; }
  /// The data that explain why the last radiance may be black.
  [[nodiscard]] const DarkSurface& dark_surface() const { return dark_; }
  /// Logs every later ray.
  void log_to(RayLog& log) { log_ = &log; }

 private:
  /// The history of a ray: its weight is the largest part of the pixel's color that it can bring.
  struct Path {
    double weight;
    int depth;
    double length;  // from the eye to the ray's start
    std::size_t log_entry;
  };

  /// Adds a ray to the log, if there is one.
  void log(RayKind kind, Path& path, const Vec3& origin) {
    if (log_ == nullptr) return;
    path.log_entry = log_->size();
    log_->push_back({kind, path.depth, path.weight, origin});
  }
  [[nodiscard]] Vec3 color_of(const SurfaceHit& hit, const Ray& ray, Path path);
  [[nodiscard]] Vec3 surface_color(const SurfaceHit& hit, const Ray& ray, const Path& path);
  [[nodiscard]] Vec3 local_color(const SurfaceHit& hit, const Ray& ray, const Path& path);
  [[nodiscard]] Vec3 follow(RayKind kind, const SurfaceRay& ray, const Path& path, double share);
  [[nodiscard]] Vec3 part_of_light(const SurfaceHit& hit, std::size_t light, const Path& path);
  [[nodiscard]] Vec3 part_through(const SurfaceHit& hit, const Vec3& to_light);
  [[nodiscard]] const Material& material(const SurfaceHit& hit) const {
    return setup_.materials[hit.material];
  }

  const LightTransportSetup& setup_;
  SurfaceCaster caster_;
  RayCounts counts_;
  DarkSurface dark_;
  double cut_weight_ = 0;
  std::vector<SurfaceCaster::Crossing> crossings_;
  RayLog* log_ = nullptr;
};

}  // namespace pipeline
