// Draws the triangles of a bare NDC text as zbuf --coverage center does, and prints the seconds of drawing
// alone, without reading and writing: the counterpart of draw_plainly.
//
// usage: draw_triangles WIDTH HEIGHT TRIANGLES THREADS

#include <fcntl.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/triangle_drawing.h"

namespace {

using pipeline::TriangleBatch;

std::vector<TriangleBatch> batches_of(const char* path) {
  pipeline::TextReader text(open(path, O_RDONLY | O_CLOEXEC), path);
  pipeline::StageReader reader(text, /*marks_decimals=*/true);
  std::vector<TriangleBatch> batches;
  for (TriangleBatch batch; reader.read(batch);) batches.push_back(batch);
  return batches;
}

/// Draws one frame into an empty buffer.
double seconds_for(std::vector<TriangleBatch> batches, const pipeline::Viewport& screen, int thread_count) {
  using Visible = pipeline::ZBufferAlgorithm<pipeline::CenterCoverage, pipeline::DepthF64>;
  pipeline::TriangleColors colors;
  const auto begin = std::chrono::steady_clock::now();
  Visible visible(screen);
  pipeline::ThreadPool pool(thread_count);
  pipeline::TriangleDrawing<Visible> drawing(visible, screen, pool);
  for (TriangleBatch& batch : batches) {
    pipeline::TaggedBatch& next = drawing.next();
    std::swap(next.batch, batch);
    next.tags.clear();
    for (const std::uint64_t number : next.batch.numbers) next.tags.push_back(colors.of(number).rgb());
    drawing.draw_next();
  }
  drawing.finish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const pipeline::Viewport screen{std::atoi(argv[1]), std::atoi(argv[2])};
  const int thread_count = std::atoi(argv[4]);
  const std::vector<TriangleBatch> batches = batches_of(argv[3]);
  double best = 1e300;
  for (int frame = 0; frame < 3; ++frame) best = std::min(best, seconds_for(batches, screen, thread_count));
  std::printf("%.6f\n", best);
}
