#pragma once

#include <optional>
#include <string>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/viewport.h"
#include "tools/fragment_report.h"
#include "tools/tool.h"

namespace pipeline {

enum class Coverage { nearest, center };
enum class Algorithm { zbuffer, scanline };
enum class DepthFormat { f64, f32, u24 };

/// What `zbuf` was asked for.
struct RenderOptions {
  std::string config_path;
  std::string image_path = "out.bmp";
  std::string z_buffer_path = "-";
  std::string depth_image_path;  // empty: none
  Coverage coverage = Coverage::nearest;
  Algorithm algorithm = Algorithm::zbuffer;
  DepthFormat depth = DepthFormat::f64;
  double depth_epsilon = 0;
  int sample_count = 1;  // along each side of a pixel, for the image alone
  int thread_count = 1;
  FragmentOptions fragments;
  bool wireframe = false;
  bool framed = false;                  // the input has to be
  std::optional<ShadingModel> shading;  // nothing: what the text asks for
};

/// Draws the tool's input and writes the image and the depths. Neither depends on the algorithm or on the
/// number of threads. Nothing takes an older file's place before everything is written.
void render(Tool& tool, const RenderOptions& chosen, const Viewport& screen);

}  // namespace pipeline
