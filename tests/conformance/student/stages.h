#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/conformance/student/stage_text.h"

/// The commands of a scene, up to its end, carried out: triangles in world space.
std::vector<Triangle> model(std::istream& commands);

/// World space to view space.
std::vector<Triangle> view(const std::vector<Triangle>& world, const Camera& camera);

/// View space to NDC, after the divide by w.
std::vector<Triangle> project(const std::vector<Triangle>& triangles, const Camera& camera);

struct Config {
  int width, height;
  double left = -1, bottom = -1, front = -1, rear = 1;
};

Config read_config(const std::string& path);

struct Color {
  int red = 0, green = 0, blue = 0;
};

struct Picture {
  std::vector<std::vector<double>> depths;  // z_buffer[row][column], row 0 at the top
  std::vector<std::vector<Color>> colors;
  double empty;  // the depth of a pixel without a triangle
};

Picture draw(const std::vector<Triangle>& ndc, Config config);
void write_depths(std::ostream& text, const Picture& picture);
void write_bitmap(const std::string& path, const Picture& picture);
