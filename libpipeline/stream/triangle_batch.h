#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/source_location.h"
#include "libpipeline/text/vertex_columns.h"

namespace pipeline {

/// The lines of a batch's triangles as written, without comments and surrounding blanks: three vertex lines
/// and a blank line for each triangle, and `clipped` with its lines before the first piece of a clipped one.
class TriangleTexts {
 public:
  /// The count of complete triangles.
  [[nodiscard]] std::size_t size() const { return ends_.size(); }
  /// The lines of one triangle.
  [[nodiscard]] std::string_view operator[](std::size_t index) const {
    const std::size_t begin = end_of(index);
    return std::string_view(lines_).substr(begin, ends_[index] - begin);
  }
  /// Keeps the first `count` triangles, or all if there are fewer.
  void truncate(std::size_t count) {
    ends_.resize(std::min(count, size()));
    lines_.resize(end_of(size()));
  }

  /// Adds lines, with their newlines, to the next triangle.
  void add(std::string_view lines) { lines_ += lines; }
  /// Adds a line, given without its newline, to the next triangle.
  void add_line(std::string_view line) { (lines_ += line) += '\n'; }
  /// Completes the next triangle.
  void end_triangle() {
    lines_ += '\n';
    ends_.push_back(lines_.size());
  }
  /// Adds triangles in fixed form (fixed_text.h), none of them shorter than `min_length`.
  void add_fixed_form(std::string_view triangles, std::size_t min_length) {
    constexpr std::string_view kTriangleEnd = "\n\n";
    min_length -= kTriangleEnd.size();
    const std::size_t offset = lines_.size();
    lines_ += triangles;
    for (std::size_t end = 0; end < triangles.size();) {
      // A blank line ends a triangle. Few numbers are longer than the shortest: this beats a search.
      for (end += min_length; triangles[end] != '\n' || triangles[end + 1] != '\n';) ++end;
      end += kTriangleEnd.size();
      ends_.push_back(offset + end);
    }
  }

 private:
  /// The end of the lines of the first `count` triangles.
  [[nodiscard]] std::size_t end_of(std::size_t count) const { return count == 0 ? 0 : ends_[count - 1]; }

  std::string lines_;
  std::vector<std::size_t> ends_;
};

/// The most triangles that a reader puts into a batch.
constexpr std::size_t kBatchSize = 2048;

/// The center of a sphere, or of its image under an affine map, and the ends of three half axes.
using SpherePoints = std::array<Vec3, 4>;

/// A sphere on its way through a stage.
struct Sphere {
  std::uint64_t number = 0;  // as a triangle's
  SpherePoints points = {};
  SpherePoints low_parts = {};  // as a triangle's
  std::array<LineAndColumn, 4> locations = {};
  std::optional<Vec3> color = {};  // in scenes with colors
  std::uint32_t material = 0;
};

/// Triangles on their way through a stage, as arrays with one entry per triangle, and the spheres after them:
/// a triangle after a sphere belongs to the next batch.
struct TriangleBatch {
  std::vector<Triangle> triangles;
  /// The rest of each coordinate, where a stage text has more digits than its double holds: empty, or as long
  /// as `triangles`.
  std::vector<Triangle> low_parts;
  /// The triangles' numbers in the scene, from 0.
  std::vector<std::uint64_t> numbers;
  std::vector<VertexLocations> locations;
  /// Bit 3 * vertex + axis is set for a coordinate written with at most 7 decimals and no exponent: it stands
  /// for that decimal (hi + low part, to 7 decimals), not for its nearest double. Empty if not requested.
  std::vector<std::uint16_t> decimal_marks;
  /// The vertices' attributes, for scenes with attributes.
  AttributeArrays attributes;
  /// For each piece of a clipped triangle, the triangle before the cut, in clip space, whose corners are lit;
  /// only in lit scenes. Empty if there is none, else as long as `triangles`.
  std::vector<std::shared_ptr<const ClipTriangle>> unclipped;
  /// The triangles' lines; empty if not requested.
  TriangleTexts texts;
  std::vector<Sphere> spheres;

  /// The count of triangles.
  [[nodiscard]] std::size_t size() const { return triangles.size(); }
  [[nodiscard]] bool empty() const { return triangles.empty() && spheres.empty(); }
  /// The count of triangles and spheres.
  [[nodiscard]] std::size_t object_count() const { return size() + spheres.size(); }
  /// The number of a triangle or, from size() on, of a sphere.
  [[nodiscard]] std::uint64_t number_of(std::size_t object) const {
    return object < size() ? numbers[object] : spheres[object - size()].number;
  }
  void clear() { truncate(0); }
  /// Keeps the first `count` triangles and spheres.
  void truncate(std::size_t count) {
    texts.truncate(count);
    spheres.resize(count - std::min(count, size()));
    count = std::min(count, size());
    triangles.resize(count);
    numbers.resize(count);
    locations.resize(count);
    if (!low_parts.empty()) low_parts.resize(count);
    if (!decimal_marks.empty()) decimal_marks.resize(count);
    attributes.truncate(count);
    if (!unclipped.empty()) unclipped.resize(count);
  }
  void add(const Triangle& triangle, std::uint64_t number, const VertexLocations& vertex_locations) {
    triangles.push_back(triangle);
    numbers.push_back(number);
    locations.push_back(vertex_locations);
    if (!low_parts.empty()) low_parts.emplace_back();
    if (!decimal_marks.empty()) decimal_marks.emplace_back();
    if (!unclipped.empty()) unclipped.emplace_back();
  }
  /// Completes triangles that were added to `triangles` alone: each has four lines of text, and the very
  /// first vertex is on line `first_vertex`.
  void complete(std::uint64_t first_number, std::size_t first_vertex) {
    const std::size_t old_size = numbers.size();
    numbers.resize(size());
    locations.resize(size());
    for (std::size_t i = old_size, line = first_vertex; i < size(); ++i, line += 4) {
      numbers[i] = first_number++;
      locations[i] = {line, line + 1, line + 2};
    }
    if (!low_parts.empty()) low_parts.resize(size());
    if (!decimal_marks.empty()) decimal_marks.resize(size());
    if (!unclipped.empty()) unclipped.resize(size());
  }
  /// Makes the last triangle a piece of `triangle`.
  void set_last_unclipped(std::shared_ptr<const ClipTriangle> triangle) {
    unclipped.resize(size());
    unclipped.back() = std::move(triangle);
  }
  [[nodiscard]] const ClipTriangle* unclipped_of(std::size_t index) const {
    return unclipped.empty() ? nullptr : unclipped[index].get();
  }
};

}  // namespace pipeline
