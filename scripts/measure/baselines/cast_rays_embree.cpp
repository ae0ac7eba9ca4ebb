// Builds Embree's hierarchy (robust mode) of the triangles of a view text, casts a ray through the center of
// every pixel, all on one thread, and prints the processor's seconds for both: the counterpart of cast_rays.
// The camera is `perspective 60 1`.
//
// usage: cast_rays_embree WIDTH HEIGHT TRIANGLES

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace {

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

std::vector<float> coordinates_of(const char* path) {
  std::ifstream text(path);
  std::string header;
  std::getline(text, header);
  std::vector<float> coordinates;
  for (float number; text >> number;) coordinates.push_back(number);
  return coordinates;
}

RTCScene scene_of(RTCDevice device, const std::vector<float>& coordinates) {
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t vertex_count = coordinates.size() / 3;
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
  for (std::size_t i = 0; i < 3 * vertex_count; ++i) vertices[i] = coordinates[i];
  auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
      triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), vertex_count / 3));
  for (std::size_t i = 0; i < vertex_count; ++i) indices[i] = static_cast<unsigned>(i);
  rtcCommitGeometry(triangles);
  rtcAttachGeometry(scene, triangles);
  rtcReleaseGeometry(triangles);
  rtcCommitScene(scene);
  return scene;
}

RTCRayHit ray_to(float x, float y) {
  RTCRayHit ray = {};
  ray.ray.dir_x = x;
  ray.ray.dir_y = y;
  ray.ray.dir_z = -1;
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return ray;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const int columns = std::atoi(argv[1]), rows = std::atoi(argv[2]);
  const std::vector<float> coordinates = coordinates_of(argv[3]);
  const RTCDevice device = rtcNewDevice("threads=1,start_threads=0");
  const auto begin = std::clock();
  const RTCScene scene = scene_of(device, coordinates);
  const double build_seconds = seconds_since(begin);
  const double half = std::tan(30 * std::numbers::pi / 180);
  const auto first_ray = std::clock();
  long hit_count = 0;
  constexpr int kTile = 16;
  for (int top = 0; top < rows; top += kTile)
    for (int left = 0; left < columns; left += kTile)
      for (int row = top; row < std::min(top + kTile, rows); ++row)
        for (int column = left; column < std::min(left + kTile, columns); ++column) {
          RTCRayHit ray = ray_to(static_cast<float>(half * ((2 * column + 1.0) / columns - 1)),
                                 static_cast<float>(half * (1 - (2 * row + 1.0) / rows)));
          RTCIntersectContext context;
          rtcInitIntersectContext(&context);
          context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
          rtcIntersect1(scene, &context, &ray);
          if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) ++hit_count;
        }
  std::printf("%.6f %.6f %ld\n", build_seconds, seconds_since(first_ray), hit_count);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
