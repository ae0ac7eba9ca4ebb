// A triangle in five lines, from normalized device coordinates to characters.

#include <cstdio>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/algorithms.h"

int main() {
  const pipeline::Viewport viewport{.columns = 8, .rows = 4};
  const pipeline::Triangle p_ndc = {{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}};
  pipeline::ZBufferAlgorithm<pipeline::CenterCoverage, pipeline::DepthF64> picture(viewport);
  picture.draw({p_ndc}, {});
  picture.for_each_row([&](const pipeline::VisibleRow& row) {
    // The library's own warning options, including -Wconversion, do not apply here: this narrows.
    for (const float depth : row.depths) std::putchar(depth < viewport.rear ? '#' : '.');
    std::putchar('\n');
  });
}
