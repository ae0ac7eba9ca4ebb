#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/decimal_number.h"
#include "libpipeline/text/source_location.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Which columns stand behind x y z on a vertex line, in this order: w, the color, the normal.
struct AttributeSet {
  bool w = false;
  bool color = false;
  bool normal = false;

  [[nodiscard]] bool any() const { return w || color || normal; }
  friend bool operator==(const AttributeSet&, const AttributeSet&) = default;
};

/// Position, w, color and normal.
constexpr std::size_t kMaxColumns = 10;

/// What one vertex line may hold; what its text has no columns for stays 0.
struct VertexLine {
  Vec3 position;
  double w = 0;  // of clip space, above 0
  Vec3 color;    // red, green, blue from 0 to 255
  Vec3 normal;
};

/// A vertex line of plain numbers: the first three are the position.
struct DecimalVertexLine {
  std::array<DecimalNumber, kMaxColumns> numbers;
  std::size_t indent = 0;  // the blanks before the first number
};
using DecimalVertexLines = std::array<DecimalVertexLine, 3>;

/// Where the vertices on these lines begin; the first stands on line `first_line`.
inline VertexLocations locations_of(const DecimalVertexLines& lines, std::size_t first_line) {
  return {LineAndColumn(first_line, lines[0].indent + 1), LineAndColumn(first_line + 1, lines[1].indent + 1),
          LineAndColumn(first_line + 2, lines[2].indent + 1)};
}

/// The vertex on a line with these attributes.
VertexLine to_vertex_line(const DecimalVertexLine& line, const AttributeSet& attributes);
/// A triangle in clip space, before the divide: w may be anything.
using ClipTriangle = std::array<VertexLine, 3>;

/// The names of all columns: "x y z", then those of the attributes.
std::string column_names(const AttributeSet& attributes);

/// Whether the column w must be above 0, as behind the divide, or may be anything, as in clip space.
enum class RangeOfW { above_zero, any };

/// Reads vertex lines with these attributes. Errors name the columns that are expected.
class VertexLineReader {
 public:
  explicit VertexLineReader(const AttributeSet& attributes = {}, RangeOfW range_of_w = RangeOfW::above_zero);

  [[nodiscard]] const AttributeSet& attributes() const { return attributes_; }
  /// Reads the line of vertex `vertex` (0 to 2) to its end. An InputError unless w is in its range and
  /// colors lie from 0 to 255.
  VertexLine read(LineScanner& line, std::size_t vertex) const;
  /// The fast path: reads the three lines of a triangle at `p` and returns the beginning of the line behind
  /// them. Null if they hold anything but plain numbers (plain_number.h), or do not end before `end`, or one
  /// is wrong; the general path then says so.
  const char* read_decimals(const char* p, const char* end, DecimalVertexLines& vertices) const;

 private:
  [[nodiscard]] bool are_in_range(std::span<const DecimalNumber> columns) const;

  AttributeSet attributes_;
  RangeOfW range_of_w_;
  std::size_t column_count_;
  std::array<std::string, 3> names_;
};

/// Takes the red, green and blue of `of`, each from 0 to 255.
Vec3 read_color(LineScanner& line, std::string_view of);

/// The attributes of a batch's triangles: each array is empty where the text has no such columns, else as
/// long as the batch.
struct AttributeArrays {
  std::vector<std::array<double, 3>> w;      // by vertex
  std::vector<std::array<Vec3, 3>> colors;   // by vertex: red, green, blue from 0 to 255
  std::vector<std::array<Vec3, 3>> normals;  // by vertex, in the space of the positions

  void clear();
  /// Keeps the first `count` triangles.
  void truncate(std::size_t count);
  /// Adds what `attributes` names of a triangle's vertex lines.
  void add(const std::array<VertexLine, 3>& vertices, const AttributeSet& attributes);
};

}  // namespace pipeline
