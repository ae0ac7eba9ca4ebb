#pragma once

#include <assimp/mesh.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "tools/mesh2scene/model_files.h"
#include "tools/mesh2scene/smooth_normals.h"

struct aiMaterial;
struct aiNode;
struct aiScene;

namespace Assimp {
class Importer;
}

namespace pipeline {

/// The upper three rows of a node's matrix, which takes the node's coordinates to its parent's: doubles, as
/// products of several would lose digits in assimp's floats.
struct NodeMatrix {
  std::array<std::array<double, 4>, 3> rows{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  friend bool operator==(const NodeMatrix&, const NodeMatrix&) = default;
  [[nodiscard]] bool is_identity() const { return *this == NodeMatrix(); }
  [[nodiscard]] Vec3 point(const Vec3& p) const;
  [[nodiscard]] Vec3 direction(const Vec3& v) const;
  /// The image of a normal, of any length, as a plane's: by the matrix of cofactors.
  [[nodiscard]] Vec3 normal(const Vec3& n) const;
};

NodeMatrix product(const NodeMatrix& a, const NodeMatrix& b);
NodeMatrix matrix_of(const aiNode& node);

/// A mesh of triangles where it stands in the model.
struct PlacedMesh {
  const aiMesh* mesh;
  NodeMatrix model_from_mesh;
  bool is_in_place = model_from_mesh.is_identity();

  /// The position of a vertex, in the model's space.
  [[nodiscard]] Vec3 position(unsigned index) const {
    const aiVector3D& v = mesh->mVertices[index];
    const Vec3 p = {v.x + 0.0, v.y + 0.0, v.z + 0.0};  // a zero without a sign, as the product's
    return is_in_place ? p : model_from_mesh.point(p);
  }
};

/// Angles in degrees, points and directions in the model's space.
struct ModelCamera {
  Vec3 eye, look, up;
  double fov_y_degrees = 0;
  double near = 0, far = 0;
};

/// The intensity is 1 for full.
struct ModelLight {
  Vec3 position;  // of a light from afar: the direction in which it shines
  Vec3 intensity;
  bool is_far = false;
};

/// A model file as assimp reads it. All meshes consist of triangles.
class ImportedModel {
 public:
  /// `path` names the files' model, "-" for standard input. Where normals are missing they are made; edges
  /// whose sides meet at more than `crease_degrees` stay sharp. Throws std::runtime_error, whose message
  /// names the file, if assimp cannot read it, if a coordinate is not finite, or if it has no triangle.
  ImportedModel(const std::string& path, std::unique_ptr<ModelFiles> files, double crease_degrees);
  ~ImportedModel();
  ImportedModel(const ImportedModel&) = delete;
  ImportedModel& operator=(const ImportedModel&) = delete;

  /// The file's, for messages.
  [[nodiscard]] std::string name() const;
  /// True if a mesh holds triangles.
  [[nodiscard]] static bool is_drawn(const aiMesh& mesh);
  [[nodiscard]] const aiScene& scene() const { return *scene_; }
  /// Every mesh, as often as a node shows it, in the order of the nodes from the root on.
  [[nodiscard]] const std::vector<PlacedMesh>& meshes() const { return meshes_; }
  [[nodiscard]] std::uint64_t triangle_count() const;
  /// The normals made for a mesh; null if it has its own.
  [[nodiscard]] const CornerNormals* made_normals(const aiMesh& mesh) const;
  /// Calls `visit` with every vertex of every triangle, in the model's space.
  template <typename Visit>
  void for_each_corner(const Visit& visit) const {
    for (const PlacedMesh& placed : meshes_)
      for (const aiFace& face : std::span(placed.mesh->mFaces, placed.mesh->mNumFaces))
        for (const unsigned index : std::span(face.mIndices, 3)) visit(placed.position(index));
  }
  [[nodiscard]] const std::optional<ModelCamera>& camera() const { return camera_; }
  [[nodiscard]] const std::vector<ModelLight>& lights() const { return lights_; }
  [[nodiscard]] Vec3 ambient() const { return ambient_; }
  [[nodiscard]] bool has_vertex_colors() const;
  /// Remarks for the user: files that were not opened, coordinates that are too coarse.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Parts of the file that no scene can hold: "textures", "bones".
  [[nodiscard]] const std::vector<std::string>& ignored() const { return ignored_; }
  /// The file's own material of a mesh; null if it gives none.
  [[nodiscard]] const aiMaterial* material(const aiMesh& mesh) const;
  /// The color of a mesh without vertex colors, from 0 to 255; nothing if the file gives none.
  [[nodiscard]] std::optional<Vec3> color(const aiMesh& mesh) const;
  /// A channel of the file, from 0 to 1, as a channel of a scene.
  [[nodiscard]] double channel(double of_file) const;

 private:
  void place(const aiNode& node, const NodeMatrix& model_from_parent);
  void note_coarse_coordinates();
  void check_vertices() const;
  void make_normals(double crease_degrees);
  void read_camera();
  void read_lights();
  void list_ignored();
  [[nodiscard]] NodeMatrix model_from(const aiNode* node) const;

  std::string path_;
  std::unique_ptr<Assimp::Importer> importer_;
  const aiScene* scene_ = nullptr;
  std::vector<PlacedMesh> meshes_;
  std::map<const aiMesh*, CornerNormals> made_normals_;
  std::optional<ModelCamera> camera_;
  std::vector<ModelLight> lights_;
  Vec3 ambient_;
  std::vector<std::string> notes_, ignored_;
  bool is_gltf_ = false;  // whose colors are linear
};

}  // namespace pipeline
