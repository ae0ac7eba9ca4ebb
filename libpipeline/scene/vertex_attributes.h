#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libpipeline/text/text_reader.h"
#include "libpipeline/text/vertex_columns.h"

namespace pipeline {

struct FixedTextPart;
enum class TriangleFrame;

/// The line of a header that names attributes: "attributes w color".
std::string attributes_line(const AttributeSet& attributes);

/// The names of all columns: "x y z", then the names of the attributes' columns.
std::string column_names(const AttributeSet& attributes);

/// The range of the column w: above 0 after the divide, any number in clip space.
enum class RangeOfW { above_zero, any };

/// Reads vertex lines with certain attributes. Errors name the expected columns.
class VertexLineReader {
 public:
  /// Materials have numbers below `material_count`.
  explicit VertexLineReader(const AttributeSet& attributes = {}, RangeOfW range_of_w = RangeOfW::above_zero,
                            std::size_t material_count = 1);

  [[nodiscard]] const AttributeSet& attributes() const { return attributes_; }
  /// Reads the line of vertex `vertex` (0 to 2) to its end; vertex 0 comes first. An InputError if a column
  /// is missing or left over, w is out of its range, a color channel is not from 0 to 255, or the material
  /// does not exist or differs from vertex 0's.
  void read(LineScanner& line, std::size_t vertex, TriangleLines& triangle) const {
    read(line, vertex, names_[vertex], triangle);
  }
  /// Reads a vertex line with another name in messages.
  void read(LineScanner& line, std::size_t vertex, const std::string& name, TriangleLines& triangle) const;
  /// The fast path: adds at most `limit` triangles from the beginning of `text` to the arrays, as
  /// read_columns (fixed_text.h) reads them. Adds none if a value is out of range; the general path then
  /// reports it.
  FixedTextPart read_triangles(std::string_view text, TriangleFrame frame, std::size_t limit,
                               std::span<DecimalMarks> marks, std::vector<Triangle>& positions,
                               AttributeArrays& attributes) const;

 private:
  void read_material(LineScanner& line, std::size_t vertex, const std::string& name,
                     TriangleLines& triangle) const;
  [[nodiscard]] bool are_in_range(const AttributeArrays& attributes, std::size_t begin,
                                  TriangleFrame frame) const;

  AttributeSet attributes_;
  RangeOfW range_of_w_;
  std::size_t material_count_;
  std::array<std::string, 3> names_;
};

/// Takes three numbers from 0 to 255 (else an InputError); `of` names the colored item in messages.
Vec3 read_color(LineScanner& line, std::string_view of);

}  // namespace pipeline
