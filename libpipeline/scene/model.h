#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

/// A node's axes and origin in the coordinates of its parent.
struct NodeMatrix {
  Vec3 x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1}, origin;

  friend bool operator==(const NodeMatrix&, const NodeMatrix&) = default;
  [[nodiscard]] bool is_identity() const { return *this == NodeMatrix(); }
  [[nodiscard]] Vec3 point(const Vec3& p) const { return sum(direction(p), origin); }
  [[nodiscard]] Vec3 direction(const Vec3& v) const {
    return sum(sum(scaled(x, v.x), scaled(y, v.y)), scaled(z, v.z));
  }
  /// The image of a plane's normal, of any length, by the matrix of cofactors.
  [[nodiscard]] Vec3 normal(const Vec3& n) const;
  [[nodiscard]] bool mirrors() const { return dot(x, cross(y, z)) < 0; }
};

inline NodeMatrix product(const NodeMatrix& a, const NodeMatrix& b) {
  return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.point(b.origin)};
}

using Floats = std::array<float, 3>;
inline Floats floats(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
/// Stands for a missing color.
constexpr Floats kNoColor = {NAN, NAN, NAN};

/// A color from 0 to 255, and the factors of a line `material`.
struct ModelMaterial {
  std::optional<Vec3> color;
  double ambient = 1, diffuse = 1, specular = 0.15, shininess = 20;
};

/// How many characters of a name are kept.
constexpr std::size_t kLongestName = 1000;

/// Triangles of one material.
struct ModelMesh {
  std::string name;
  std::vector<std::uint32_t> corners{};  // three points of the model for each triangle
  std::vector<Floats> normals{};         // for each corner; empty where the file gives none
  std::optional<std::size_t> shape{};    // the mesh that has the corners and normals, if another one
  std::optional<std::size_t> material{};
  bool has_colors = false;  // in the model's colors
  std::size_t surface = 1;  // meshes of one number are smoothed together; 0 stays flat
};

/// A node's scaling, then rotation by a unit quaternion, then translation.
struct NodeSteps {
  Vec3 translation;
  Vec3 turn;  // the axis, as long as the sine of half the angle
  double cosine = 1;
  Vec3 scaling = {1, 1, 1};
};

/// A node's meshes, by their indices, and the nodes below it.
struct ModelNode {
  NodeMatrix parent_from_node;
  std::optional<NodeSteps> steps;  // if the file gives them, and none flattens
  std::vector<std::size_t> meshes;
  std::vector<ModelNode> children;
};

/// Angles in degrees, points and directions in the model's space.
struct ModelCamera {
  Vec3 eye, look, up;
  double fov_y_degrees = 0;
  double near = 0, far = 0;  // far is infinite if the file gives none
  double distance = 0;       // from the eye to `look`, the middle of the model in depth
};

/// A point light, or one from afar.
struct ModelLight {
  Vec3 position;  // if is_far, the direction in which it shines
  Vec3 intensity;
  bool is_far = false;
};

/// A mesh, and its place in the model.
struct PlacedMesh {
  const ModelMesh* mesh;
  const ModelMesh* shape;  // has the corners and normals
  const Vec3* points;
  NodeMatrix model_from_mesh;
  bool is_in_place = model_from_mesh.is_identity();

  /// A point in the model's space.
  [[nodiscard]] Vec3 position(std::uint32_t index) const {
    const Vec3& v = points[index];
    // Adding 0 removes a zero's sign, as the product does.
    return is_in_place ? Vec3{v.x + 0.0, v.y + 0.0, v.z + 0.0} : model_from_mesh.point(v);
  }
};

/// The content of a model file.
struct Model {
  std::string name;    // of the file, for messages
  std::string format;  // "OBJ"
  std::vector<Vec3> points;
  std::vector<Floats> colors;  // of points, from 0 to 255; may be fewer than these
  std::vector<ModelMaterial> materials;
  std::vector<ModelMesh> meshes;
  ModelNode root;
  std::optional<ModelCamera> camera;
  std::vector<ModelLight> lights;
  std::set<std::string> unheld;  // parts of the file that no scene can hold: "textures", "bones"
  std::vector<std::string> notes;
  std::vector<PlacedMesh> placed;  // meshes with triangles, once for each node with them

  /// Throws a std::runtime_error "expected ..., found ...".
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const;
  void note(const std::string& message) { notes.push_back(name + ": " + message); }
  /// Adds an empty mesh to the root node.
  ModelMesh& add_mesh(const std::string& mesh_name);

  [[nodiscard]] PlacedMesh placed_mesh(std::size_t index, const NodeMatrix& model_from_mesh) const {
    return {&meshes[index], &meshes[meshes[index].shape.value_or(index)], points.data(), model_from_mesh};
  }
  [[nodiscard]] std::uint64_t triangle_count() const;
  [[nodiscard]] Floats color(std::size_t point) const {
    return point < colors.size() ? colors[point] : kNoColor;
  }
  [[nodiscard]] bool has_vertex_colors() const;
  /// True if all shown meshes are black.
  [[nodiscard]] bool is_black() const;
  [[nodiscard]] ModelMaterial material(const ModelMesh& mesh) const {
    return mesh.material ? materials[*mesh.material] : ModelMaterial();
  }
  /// Calls `visit` with every vertex of every triangle, in the model's space.
  template <typename Visit>
  void for_each_corner(const Visit& visit) const {
    for (const PlacedMesh& mesh : placed)
      for (const std::uint32_t index : mesh.shape->corners) visit(mesh.position(index));
  }
};

/// A color as a file gives it, with -1 for a channel that is not a number.
Floats file_color(const Vec3& color);
/// Converts a file's colors to a scene's; `full` is the file's value for white: 1, 255 or 65535. If some
/// exceed twice that, and they are not linear, 255 is white. A color with a negative channel becomes
/// kNoColor. Notes report both.
void scale_colors(Model& model, std::span<Floats> colors, double full, bool is_linear = false);

/// The value clamped to [0, 1]; 0 for NaN.
inline double fraction(double value) {
  return value > 0 ? std::min(value, 1.0) : 0;
}
/// True if the coordinates are finite as floats: a written scene's coordinates are floats.
bool are_floats(const Vec3& v);

/// A channel from 0 to 1 as a scene's, from 0 to 255; a linear one is converted to sRGB.
double scene_channel(double channel, bool is_linear);

/// Places the meshes, scales the lights to at most full intensity, and adds notes. A std::runtime_error if
/// there is no triangle, or a coordinate that is not finite.
void complete(Model& model);

}  // namespace pipeline
