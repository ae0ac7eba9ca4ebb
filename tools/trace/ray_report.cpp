#include "tools/trace/ray_report.h"

#include <array>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/raytracing/ray_log.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

constexpr std::array kNames = {"primary", "shadow", "mirrored", "refracted"};  // by RayKind

std::string to_text(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

std::string target_of(const RayLog::Entry& entry) {
  if (entry.light) return "light " + std::to_string(*entry.light);
  if (!entry.object) return "nothing along " + to_text(entry.direction);
  return (entry.is_sphere ? "sphere " : "triangle ") + std::to_string(*entry.object) +
         (entry.is_front ? " front at " : " back at ") + to_text(entry.point);
}

std::string to_text(const RayLog::Entry& entry) {
  std::string text(2 * static_cast<std::size_t>(entry.depth), ' ');
  text.append(kNames[static_cast<std::size_t>(entry.kind)])
      .append(" weight ")
      .append(shortest_text(entry.weight));
  text.append(" from ").append(to_text(entry.origin));
  if (entry.is_cut) return text + " cut";
  return text + " to " + target_of(entry) + " brings " + to_text(entry.brought);
}

}  // namespace

std::vector<std::string> ray_lines(const Pixel& pixel, const RayCaster& caster,
                                   const LightTransport& transport, const PixelRays& rays) {
  RayCaster::Thread primary(caster);
  LightTransport::Thread light(transport);
  RayLog log;
  light.log_to(&log);
  const Ray ray = rays.ray(pixel.row, pixel.column);
  if (const auto seen = primary.cast(pixel.row, pixel.column, false))
    static_cast<void>(light.radiance(seen->id, ray));
  else
    log.add({.kind = RayKind::primary,
             .depth = 0,
             .weight = 1,
             .origin = ray.origin,
             .direction = unit_vector(ray.direction),
             .brought = light.background()});
  const std::string place = std::to_string(pixel.column) + "," + std::to_string(pixel.row) + ": ";
  std::vector<std::string> lines;
  for (const RayLog::Entry& entry : log.entries()) lines.push_back(place + to_text(entry));
  return lines;
}

}  // namespace pipeline
