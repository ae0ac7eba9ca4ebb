// Draws the triangles of a bare NDC text with Mesa's software renderer and prints the seconds that drawing
// took.
//
// usage: draw_osmesa WIDTH HEIGHT TRIANGLES

#include <GL/gl.h>
#include <GL/osmesa.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "scripts/measure/baselines/numbers_of.h"

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const int width = std::atoi(argv[1]), height = std::atoi(argv[2]);
  const std::vector<float> corners = numbers_of<float>(argv[3]);
  std::vector<unsigned char> colors(corners.size());
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = static_cast<unsigned char>(i / 9 * 37 + i % 3 * 80);

  std::vector<unsigned char> image(4u * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 24, 0, 0, nullptr);
  if (context == nullptr || !OSMesaMakeCurrent(context, image.data(), GL_UNSIGNED_BYTE, width, height))
    return 1;
  glEnable(GL_DEPTH_TEST);
  glShadeModel(GL_FLAT);
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(3, GL_FLOAT, 0, corners.data());
  glColorPointer(3, GL_UNSIGNED_BYTE, 0, colors.data());

  // The first frame compiles shaders.
  double best = 1e300;
  for (int frame = 0; frame < 3; ++frame) {
    const auto begin = std::chrono::steady_clock::now();
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size() / 3));
    glFinish();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (seconds < best) best = seconds;
  }
  std::printf("%.6f\n", best);
  OSMesaDestroyContext(context);
}
