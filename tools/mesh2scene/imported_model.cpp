#include "tools/mesh2scene/imported_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

Vec3 vec(const aiVector3D& v) {
  return {v.x, v.y, v.z};
}

Vec3 vec(const aiColor3D& c) {
  return {c.r, c.g, c.b};
}

/// True if the coordinates are finite as floats, which a scene's coordinates are.
bool are_floats(const Vec3& v) {
  const auto is_float = [](double x) { return std::abs(x) <= std::numeric_limits<float>::max(); };
  return is_float(v.x) && is_float(v.y) && is_float(v.z);
}

double degrees(double radians) {
  return radians * 180 / std::numbers::pi;
}

double fov_y_degrees(const aiCamera& camera, bool is_gltf) {
  const double fov_x = camera.mHorizontalFOV, aspect = camera.mAspect > 0 ? camera.mAspect : 1;
  // For glTF, assimp before 5.3 multiplies the angle by the aspect, in place of its half's tangent (its pull
  // request 4886).
  const bool is_multiple = is_gltf && std::pair(aiGetVersionMajor(), aiGetVersionMinor()) < std::pair(5U, 3U);
  const double fov_y = is_multiple ? fov_x / aspect : 2 * std::atan(std::tan(fov_x / 2) / aspect);
  // Four decimals hide that the file's angle is a float in radians.
  return std::round(degrees(fov_y) * 1e4) / 1e4;
}

/// The sRGB value of a linear one (IEC 61966-2-1).
double srgb_of_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace

Vec3 NodeMatrix::point(const Vec3& p) const {
  const Vec3 v = direction(p);
  return {v.x + rows[0][3], v.y + rows[1][3], v.z + rows[2][3]};
}

Vec3 NodeMatrix::direction(const Vec3& v) const {
  const auto component = [&](const std::array<double, 4>& row) {
    return row[0] * v.x + row[1] * v.y + row[2] * v.z;
  };
  return {component(rows[0]), component(rows[1]), component(rows[2])};
}

Vec3 NodeMatrix::normal(const Vec3& n) const {
  const auto row = [&](std::size_t i) { return Vec3{rows[i][0], rows[i][1], rows[i][2]}; };
  const Vec3 x = row(0), y = row(1), z = row(2);
  const Vec3 image = {dot(cross(y, z), n), dot(cross(z, x), n), dot(cross(x, y), n)};
  return dot(x, cross(y, z)) < 0 ? scaled(image, -1) : image;
}

NodeMatrix product(const NodeMatrix& a, const NodeMatrix& b) {
  NodeMatrix c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      c.rows[i][j] = a.rows[i][0] * b.rows[0][j] + a.rows[i][1] * b.rows[1][j] + a.rows[i][2] * b.rows[2][j] +
                     (j == 3 ? a.rows[i][3] : 0);
  return c;
}

NodeMatrix matrix_of(const aiNode& node) {
  const aiMatrix4x4& m = node.mTransformation;
  return {{{{m.a1, m.a2, m.a3, m.a4}, {m.b1, m.b2, m.b3, m.b4}, {m.c1, m.c2, m.c3, m.c4}}}};
}

ImportedModel::ImportedModel(const std::string& path, std::unique_ptr<ModelFiles> files,
                             double crease_degrees)
    : path_(path), importer_(std::make_unique<Assimp::Importer>()) {
  ModelFiles* const opened = files.release();
  importer_->SetIOHandler(opened);
  scene_ = importer_->ReadFile(opened->base_name(), aiProcess_Triangulate | aiProcess_SortByPType);
  opened->expect_separate_output();
  const std::string refusal = opened->refusal();
  if (scene_ == nullptr || scene_->mRootNode == nullptr)
    throw std::runtime_error(
        name() + ": " +
        (refusal.empty() ? "assimp cannot read this model: " + std::string(importer_->GetErrorString())
                         : refusal));
  if (!refusal.empty()) notes_.push_back(name() + ": " + refusal + ": left out");
  importer_->SetIOHandler(nullptr);  // which does not delete the former one
  delete opened;
  is_gltf_ = in_lower_case(path).ends_with(".gltf") || in_lower_case(path).ends_with(".glb");
  place(*scene_->mRootNode, {});
  if (meshes_.empty()) throw std::runtime_error(name() + ": expected a model with triangles, found none");
  check_vertices();
  note_coarse_coordinates();
  make_normals(crease_degrees);
  read_camera();
  read_lights();
  list_ignored();
}

ImportedModel::~ImportedModel() = default;

std::string ImportedModel::name() const {
  return path_ == "-" ? "<stdin>" : path_;
}

bool ImportedModel::is_drawn(const aiMesh& mesh) {
  return (mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) != 0 && mesh.mNumFaces > 0;
}

void ImportedModel::place(const aiNode& node, const NodeMatrix& model_from_parent) {
  const NodeMatrix model_from_node = product(model_from_parent, matrix_of(node));
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh* mesh = scene_->mMeshes[node.mMeshes[i]];
    if (is_drawn(*mesh)) meshes_.push_back({mesh, model_from_node});
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], model_from_node);
}

/// Far from the origin, the steps of floats, which assimp's coordinates are, show in a model's surface.
void ImportedModel::note_coarse_coordinates() {
  constexpr double kFineEnough =
      1e-4;  // of the model's extent: a tenth of a pixel in a picture of a thousand
  BoundingBox box;
  for (const aiMesh* mesh : std::span(scene_->mMeshes, scene_->mNumMeshes))
    for (const aiVector3D& v : std::span(mesh->mVertices, mesh->mNumVertices))
      box.add(Triangle{vec(v), vec(v), vec(v)});
  const double extent = largest_in(difference(box.high, box.low));
  const auto largest = static_cast<float>(std::max(largest_in(box.low), largest_in(box.high)));
  const double step = double{largest} - std::nextafter(largest, 0.0F);
  if (!(step > kFineEnough * extent) || extent == 0) return;
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      ": its coordinates, floats with steps of %.3g, are coarse for an extent of %.3g: move the model to "
      "the origin",
      step, extent);
  notes_.push_back(name() + text.data());
}

void ImportedModel::check_vertices() const {
  for (const PlacedMesh& placed : meshes_) {
    const aiMesh* const mesh = placed.mesh;
    // A file that ends within a face may leave one with fewer corners.
    for (unsigned i = 0; i < mesh->mNumFaces; ++i)
      if (const aiFace& face = mesh->mFaces[i];
          face.mNumIndices != 3 ||
          std::max({face.mIndices[0], face.mIndices[1], face.mIndices[2]}) >= mesh->mNumVertices)
        throw std::runtime_error(name() +
                                 ": expected triangles, found a face that is none: the file is broken");
    for (unsigned i = 0; i < mesh->mNumVertices; ++i)
      if (!are_floats(placed.position(i)))
        throw std::runtime_error(name() + ": expected finite coordinates, found others in mesh " +
                                 quoted(mesh->mName.C_Str()));
  }
}

void ImportedModel::make_normals(double crease_degrees) {
  // The normals in STL are those of flat triangles, also where the surface is round.
  const bool drops_normals = in_lower_case(path_).ends_with(".stl");
  for (const PlacedMesh& placed : meshes_)
    if ((drops_normals || !placed.mesh->HasNormals()) && !made_normals_.contains(placed.mesh))
      made_normals_[placed.mesh] = smooth_normals(*placed.mesh, crease_degrees);
}

const CornerNormals* ImportedModel::made_normals(const aiMesh& mesh) const {
  const auto found = made_normals_.find(&mesh);
  return found == made_normals_.end() ? nullptr : &found->second;
}

NodeMatrix ImportedModel::model_from(const aiNode* node) const {
  NodeMatrix matrix;
  for (; node != nullptr; node = node->mParent) matrix = product(matrix_of(*node), matrix);
  return matrix;
}

void ImportedModel::read_camera() {
  for (unsigned i = 0; i < scene_->mNumCameras && !camera_; ++i) {
    const aiCamera& camera = *scene_->mCameras[i];
    if (camera.mOrthographicWidth > 0) continue;
    const NodeMatrix model_from_camera = model_from(scene_->mRootNode->FindNode(camera.mName));
    // For glTF, assimp 5.2 gives the node's translation as a position in the node.
    const Vec3 eye = is_gltf_ ? Vec3{} : vec(camera.mPosition);
    camera_ = {.eye = model_from_camera.point(eye),
               .look = model_from_camera.point(sum(eye, vec(camera.mLookAt))),
               .up = model_from_camera.direction(vec(camera.mUp)),
               .fov_y_degrees = fov_y_degrees(camera, is_gltf_),
               .near = camera.mClipPlaneNear,
               .far = camera.mClipPlaneFar};
    const auto is_vector = [](const Vec3& v) { return std::isfinite(dot(v, v)) && dot(v, v) > 0; };
    const bool is_usable = camera_->fov_y_degrees > 0 && camera_->fov_y_degrees < 180 && camera_->near > 0 &&
                           camera_->far > camera_->near && std::isfinite(camera_->far) &&
                           is_vector(cross(difference(camera_->look, camera_->eye), camera_->up));
    if (!is_usable) camera_.reset();
  }
}

void ImportedModel::read_lights() {
  double brightest = 1;
  for (unsigned i = 0; i < scene_->mNumLights; ++i) {
    const aiLight& light = *scene_->mLights[i];
    const NodeMatrix model_from_light = model_from(scene_->mRootNode->FindNode(light.mName));
    const Vec3 intensity = vec(light.mColorDiffuse), position = model_from_light.point(vec(light.mPosition));
    // A scene has no light that takes light away.
    if (!are_floats(intensity) || std::min({intensity.x, intensity.y, intensity.z}) < 0 ||
        !are_floats(position))
      continue;
    if (light.mType == aiLightSource_AMBIENT)
      ambient_ = sum(ambient_, vec(light.mColorAmbient));
    else if (light.mType == aiLightSource_POINT || light.mType == aiLightSource_SPOT)
      lights_.push_back({position, intensity});
    else if (light.mType == aiLightSource_DIRECTIONAL)
      lights_.push_back({model_from_light.direction(vec(light.mDirection)), intensity, true});
    else
      continue;
    brightest = std::max({brightest, intensity.x, intensity.y, intensity.z});
  }
  // A scene's intensity is 1 at most where it is full; a file may count in candela.
  for (ModelLight& light : lights_) light.intensity = scaled(light.intensity, 1 / brightest);
}

void ImportedModel::list_ignored() {
  bool has_points = false, has_bones = false, has_textures = scene_->mNumTextures > 0, has_clear = false;
  for (unsigned i = 0; i < scene_->mNumMeshes; ++i) {
    has_points = has_points ||
                 (scene_->mMeshes[i]->mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE)) != 0;
    has_bones = has_bones || scene_->mMeshes[i]->mNumBones > 0;
  }
  for (unsigned i = 0; i < scene_->mNumMaterials; ++i) {
    const aiMaterial& material = *scene_->mMaterials[i];
    for (int type = aiTextureType_DIFFUSE; type <= AI_TEXTURE_TYPE_MAX; ++type)
      has_textures = has_textures || material.GetTextureCount(static_cast<aiTextureType>(type)) > 0;
    float opacity = 1;
    has_clear = has_clear || (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity < 1);
  }
  bool has_cones = false;
  for (unsigned i = 0; i < scene_->mNumLights; ++i)
    has_cones = has_cones || scene_->mLights[i]->mType == aiLightSource_SPOT;
  const auto list = [&](bool is_there, const char* what) {
    if (is_there) ignored_.emplace_back(what);
  };
  list(has_textures, "textures");
  list(has_clear, "transparency");
  list(has_points, "points and lines");
  list(has_bones, "bones");
  list(has_cones, "cones of spotlights");
  list(scene_->mNumAnimations > 0, "animations");
}

std::uint64_t ImportedModel::triangle_count() const {
  std::uint64_t count = 0;
  for (const PlacedMesh& placed : meshes_) count += placed.mesh->mNumFaces;
  return count;
}

bool ImportedModel::has_vertex_colors() const {
  return std::any_of(meshes_.begin(), meshes_.end(),
                     [](const PlacedMesh& placed) { return placed.mesh->HasVertexColors(0); });
}

const aiMaterial* ImportedModel::material(const aiMesh& mesh) const {
  if (mesh.mMaterialIndex >= scene_->mNumMaterials) return nullptr;
  const aiMaterial& material = *scene_->mMaterials[mesh.mMaterialIndex];
  aiString name;
  const bool has_name = material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS;
  // assimp's material for meshes without one: white and without a name for PLY, the last for glTF.
  const bool is_default = (has_name && name == aiString(AI_DEFAULT_MATERIAL_NAME)) ||
                          (!has_name && in_lower_case(path_).ends_with(".ply")) ||
                          (is_gltf_ && mesh.mMaterialIndex + 1 == scene_->mNumMaterials);
  return is_default ? nullptr : &material;
}

std::optional<Vec3> ImportedModel::color(const aiMesh& mesh) const {
  const aiMaterial* const of_mesh = material(mesh);
  aiColor3D color;
  if (of_mesh == nullptr || of_mesh->Get(AI_MATKEY_COLOR_DIFFUSE, color) != aiReturn_SUCCESS)
    return std::nullopt;
  return Vec3{channel(color.r), channel(color.g), channel(color.b)};
}

double ImportedModel::channel(double of_file) const {
  const double clamped = of_file > 0 ? std::min(of_file, 1.0) : 0;  // a NaN is 0
  // A thousandth of a level is finer than any file, and hides that 77 / 255 is no float.
  return std::round(1000 * 255 * (is_gltf_ ? srgb_of_linear(clamped) : clamped)) / 1000;
}

}  // namespace pipeline
