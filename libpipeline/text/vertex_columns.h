#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

// The columns of vertex lines after x y z, called attributes. A new one needs a member of AttributeSet, of
// VertexLine and of AttributeArrays, and a row in kAttributes, in the order of the columns: all code that
// reads, prints, keeps, transforms or cuts vertices goes by these rows. The material, a triangle's only
// attribute, comes after them.

/// The attributes of a text.
struct AttributeSet {
  bool w = false;
  bool color = false;
  bool normal = false;
  bool material = false;

  [[nodiscard]] bool any() const { return *this != AttributeSet{}; }
  friend bool operator==(const AttributeSet&, const AttributeSet&) = default;
};

/// The values of a vertex line; 0 where the text has no such column.
struct VertexLine {
  Vec3 position;
  double w = 0;  // of clip space; see RangeOfW
  Vec3 color;    // red, green, blue from 0 to 255
  Vec3 normal;   // in the space of the position
};

/// A triangle in clip space, before the divide: w may be any number.
using ClipTriangle = std::array<VertexLine, 3>;

/// The vertex lines of a triangle. Each line has the material, but it belongs to the triangle.
struct TriangleLines {
  std::array<VertexLine, 3> vertices;
  std::uint32_t material = 0;
};

/// The attributes of a batch's triangles: an array is empty if the text has no such columns, else as long as
/// the batch.
struct AttributeArrays {
  std::vector<std::array<double, 3>> w;      // by vertex
  std::vector<std::array<Vec3, 3>> colors;   // by vertex: red, green, blue from 0 to 255
  std::vector<std::array<Vec3, 3>> normals;  // by vertex, in the space of the positions
  std::vector<std::uint32_t> materials;      // by triangle, as numbers from 0

  /// The attributes whose arrays are not empty.
  [[nodiscard]] AttributeSet names() const;
  /// Keeps the first `count` triangles.
  void truncate(std::size_t count);
  /// Sets the length of the arrays for `attributes` to `count` triangles.
  void resize(std::size_t count, const AttributeSet& attributes);
  /// Adds the values of a triangle's vertex lines for the attributes in `attributes`.
  void add(const TriangleLines& lines, const AttributeSet& attributes);
  /// Adds all attributes of triangle `index` of `others`.
  void add(const AttributeArrays& others, std::size_t index);
  /// Copies the existing attributes of triangle `index`.
  void copy(std::size_t index, ClipTriangle& vertices) const;
};

/// An attribute of vertices: Value is Vec3, for three columns, or double, for one.
template <typename Value>
struct VertexAttribute {
  std::string_view name;  // in the line `attributes`
  bool AttributeSet::*is_there;
  Value VertexLine::*value;
  std::vector<std::array<Value, 3>> AttributeArrays::*array;
  std::string_view columns;                                                // as messages name them
  std::array<std::string_view, std::is_same_v<Value, Vec3> ? 3 : 1> each;  // each column, as messages name it
  bool turns_as_normal = false;  // under transforms, which change no other attribute
  std::string_view range = {};   // as messages name it; empty if all numbers are allowed
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_in_range(double number) const { return (number >= least) & (number <= greatest); }
};

// clang-format off
inline constexpr VertexAttribute<double> kW = {
    "w", &AttributeSet::w, &VertexLine::w, &AttributeArrays::w,
    "w", {"the w of "}, false, "above 0", std::numeric_limits<double>::denorm_min()};
inline constexpr VertexAttribute<Vec3> kColor = {
    "color", &AttributeSet::color, &VertexLine::color, &AttributeArrays::colors,
    "r g b", {"the red of ", "the green of ", "the blue of "}, false, "from 0 to 255", 0, 255};
inline constexpr VertexAttribute<Vec3> kNormal = {
    "normal", &AttributeSet::normal, &VertexLine::normal, &AttributeArrays::normals,
    "nx ny nz", {"the normal's x of ", "the normal's y of ", "the normal's z of "}, true};
// clang-format on
inline constexpr std::tuple kAttributes = {kW, kColor, kNormal};

/// Calls `visit` with each attribute of vertices.
template <typename Visit>
constexpr void for_each_attribute(Visit visit) {
  std::apply([&](const auto&... attributes) { (visit(attributes), ...); }, kAttributes);
}

/// Bit 3 * vertex + axis is set for a coordinate with at most kExactDecimals (number_parser.h).
using DecimalMarks = std::uint16_t;

/// The count of attributes whose values are of this type.
template <typename Value, typename... All>
constexpr std::size_t attribute_count(const std::tuple<VertexAttribute<All>...>&) {
  return (std::size_t{std::is_same_v<All, Value>} + ...);
}

inline void AttributeArrays::add(const AttributeArrays& others, std::size_t index) {
  for_each_attribute([&](const auto& row) {
    const auto& array = others.*row.array;
    if (!array.empty()) (this->*row.array).push_back(array[index]);
  });
  if (!others.materials.empty()) materials.push_back(others.materials[index]);
}

/// The numbers of a value.
inline std::array<double*, 1> numbers_of(double& value) {
  return {&value};
}
inline std::array<double*, 3> numbers_of(Vec3& value) {
  return {&value.x, &value.y, &value.z};
}

}  // namespace pipeline
