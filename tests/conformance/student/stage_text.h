#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "tests/conformance/student/matrix.h"

struct Camera {
  Vector eye, look, up;
  std::string kind;             // perspective or ortho
  std::vector<double> numbers;  // fovY aspect near far, or left right bottom top near far
  std::string rule;             // of a perspective: angle, ratio or nothing
};

struct Scene {
  Camera camera;
  std::vector<Triangle> triangles;
};

/// A line's words; what follows a # is a comment.
std::vector<std::string> words_of(const std::string& line);

/// The number, or an error that names the word.
double number(const std::string& word);
std::vector<double> numbers(const std::vector<std::string>& words, std::size_t first, std::size_t count);

/// Reads the fourth line of a scene, or the same line of a stage text without its first word.
void read_projection(std::vector<std::string> words, Camera& camera);

/// Reads the four camera lines at the beginning of a scene.
Camera read_camera(std::istream& scene);

/// Reads the triangles of a stage text; camera lines before them replace what `scene` has.
void read_stage(std::istream& text, Scene& scene);

enum class Header { kNone, kCamera, kProjection };

/// Writes triangles, with 7 decimals, behind as much of the camera as the next stage needs.
void write_stage(std::ostream& text, const Scene& scene, Header header);
