#include "tools/trace/ray_report.h"

#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

std::string to_text(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

std::string target_of(const LoggedRay& ray) {
  if (ray.light) return "light " + std::to_string(*ray.light);
  if (!ray.object) return "nothing along " + to_text(ray.direction);
  return (ray.is_sphere ? "sphere " : "triangle ") + std::to_string(*ray.object) +
         (ray.is_front ? " front at " : " back at ") + to_text(ray.point);
}

std::string to_text(const LoggedRay& ray) {
  const std::string text = std::string(2 * static_cast<std::size_t>(ray.depth), ' ') +
                           kRayKindNames[static_cast<std::size_t>(ray.kind)] + " weight " +
                           shortest_text(ray.weight) + " from " + to_text(ray.origin);
  return text + (ray.is_cut ? " cut" : " to " + target_of(ray) + " brings " + to_text(ray.brought));
}

}  // namespace

void add_ray_lines(const Pixel& pixel, const TracedScene& scene, const Bvh& bvh,
                   std::vector<std::string>& lines) {
  RayLog log;
  const Ray ray = PixelRays(scene.projection, scene.screen).ray(pixel.row, pixel.column);
  RayCaster primary(scene.triangles, bvh, scene.projection, scene.screen);
  LightTransport light(scene.triangles, bvh, scene.light);
  light.log_to(log);
  static_cast<void>(light.radiance(primary.cast(pixel.row, pixel.column), ray));
  for (const LoggedRay& logged : log)
    lines.push_back(std::to_string(pixel.column) + "," + std::to_string(pixel.row) + ": " + to_text(logged));
}

}  // namespace pipeline
