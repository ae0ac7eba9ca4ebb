// Builds our hierarchy of the triangles of a view text, casts a ray through the center of every pixel, all on
// one thread, and prints the processor's seconds for both, and how many rays hit: the counterpart of
// cast_rays_embree. With `depths`, also calculates the depths that trace prints.
//
// usage: cast_rays WIDTH HEIGHT TRIANGLES [depths]

#include <fcntl.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/stream/stage_reader.h"

namespace {

using namespace pipeline;

double seconds_since(std::clock_t begin) {
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  const Viewport screen{std::atoi(argv[1]), std::atoi(argv[2])};
  TextReader text(open(argv[3], O_RDONLY | O_CLOEXEC), argv[3]);
  StageReader reader(text);
  const ProjectionTransform projection = clip_from_view(*reader.header().camera.projection);
  ExactProjection exact(projection, argv[3], false);
  TracedTriangles triangles;
  for (TriangleBatch batch; reader.read(batch);)
    triangles.add(batch, exact, [](const TriangleBatch&, const TriangleBatch&) {});

  ThreadPool pool(1);
  const std::clock_t begin = std::clock();
  const Bvh bvh = hierarchy_of(triangles, PixelRays(projection, screen), pool);
  const double build_seconds = seconds_since(begin);
  const RayCaster caster(triangles, bvh, projection, screen);
  RayCaster::Thread thread(caster);
  const std::clock_t first_ray = std::clock();
  long hit_count = 0;
  constexpr int kTile = 16;
  for (int top = 0; top < screen.rows; top += kTile)
    for (int left = 0; left < screen.columns; left += kTile)
      for (int row = top; row < std::min(top + kTile, screen.rows); ++row)
        for (int column = left; column < std::min(left + kTile, screen.columns); ++column)
          if (thread.cast(row, column, argc == 5)) ++hit_count;
  std::printf("%.6f %.6f %ld\n", build_seconds, seconds_since(first_ray), hit_count);
}
