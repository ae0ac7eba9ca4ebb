#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/source_location.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// The columns of a vertex line after x y z, in this order: w, color (3), normal (3), material.
struct AttributeSet {
  bool w = false;
  bool color = false;
  bool normal = false;
  bool material = false;

  [[nodiscard]] bool any() const { return w || color || normal || material; }
  friend bool operator==(const AttributeSet&, const AttributeSet&) = default;
};

/// The names of attributes, in the order of their columns.
constexpr std::array<std::pair<std::string_view, bool AttributeSet::*>, 4> kAttributes = {
    {{"w", &AttributeSet::w},
     {"color", &AttributeSet::color},
     {"normal", &AttributeSet::normal},
     {"material", &AttributeSet::material}}};

/// The line of a header that names them: "attributes w color".
std::string attributes_line(const AttributeSet& attributes);

/// The values of a vertex line; those its text has no columns for are 0.
struct VertexLine {
  Vec3 position;
  double w = 0;  // of clip space; see RangeOfW
  Vec3 color;    // red, green, blue from 0 to 255
  Vec3 normal;   // in the space of the position
};

/// The vertex lines of a triangle. The material stands on each, but is the triangle's.
struct TriangleLines {
  std::array<VertexLine, 3> vertices;
  std::uint32_t material = 0;
};

/// A triangle in clip space, before the divide: w may be any number.
using ClipTriangle = std::array<VertexLine, 3>;

/// The attributes of a batch's triangles: each array is empty where the text has no such columns, otherwise
/// as long as the batch.
struct AttributeArrays {
  std::vector<std::array<double, 3>> w;      // by vertex
  std::vector<std::array<Vec3, 3>> colors;   // by vertex: red, green, blue from 0 to 255
  std::vector<std::array<Vec3, 3>> normals;  // by vertex, in the space of the positions
  std::vector<std::uint32_t> materials;      // by triangle, as numbers from 0

  void clear();
  /// Keeps the first `count` triangles.
  void truncate(std::size_t count);
  /// Makes the arrays that `attributes` names `count` triangles long.
  void resize(std::size_t count, const AttributeSet& attributes);
  /// Adds those values of a triangle's vertex lines that `attributes` names.
  void add(const TriangleLines& lines, const AttributeSet& attributes);
};

/// The columns of `count` triangles from `begin` on, for the kernels of fixed_text.h; `names` are those after
/// the position.
template <typename Positions, typename Attributes>
auto fixed_columns(Positions& positions, Attributes& attributes, const AttributeSet& names, std::size_t begin,
                   std::size_t count) {
  std::conditional_t<std::is_const_v<Positions>, ConstFixedColumns, FixedColumns> columns;
  const auto part = [&](auto& array) { return std::span(array).subspan(begin, count); };
  columns.groups[0] = part(positions);
  if (names.w) columns.w = part(attributes.w);
  if (names.material) columns.materials = part(attributes.materials);
  if (names.color) columns.groups[1] = part(attributes.colors);
  if (names.normal) columns.groups[names.color ? 2 : 1] = part(attributes.normals);
  return columns;
}

/// The names of all columns: "x y z", then the attributes'.
std::string column_names(const AttributeSet& attributes);

/// Whether the column w must be above 0, as after the divide, or may be any number, as in clip space.
enum class RangeOfW { above_zero, any };

/// Reads vertex lines with certain attributes. Errors name the expected columns.
class VertexLineReader {
 public:
  /// Numbers of materials have to be less than `material_count`.
  explicit VertexLineReader(const AttributeSet& attributes = {}, RangeOfW range_of_w = RangeOfW::above_zero,
                            std::size_t material_count = 1);

  [[nodiscard]] const AttributeSet& attributes() const { return attributes_; }
  /// Reads the line of vertex `vertex` (0 to 2) to its end; that of vertex 0 comes first. An InputError if a
  /// column is missing or left over, w is out of its range, a color channel is not from 0 to 255, or the
  /// material is not the number of one, or not that of vertex 0.
  void read(LineScanner& line, std::size_t vertex, TriangleLines& triangle) const {
    read(line, vertex, names_[vertex], triangle);
  }
  /// The same, with another name in messages.
  void read(LineScanner& line, std::size_t vertex, const std::string& name, TriangleLines& triangle) const;
  /// The fast path: adds at most `limit` triangles from the beginning of `text` to the arrays, as
  /// read_columns (fixed_text.h) reads them. None if a value is out of range, which the general path then
  /// reports.
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

/// Takes three numbers, each from 0 to 255 (else an InputError); `of` names the colored thing in messages.
Vec3 read_color(LineScanner& line, std::string_view of);

}  // namespace pipeline
