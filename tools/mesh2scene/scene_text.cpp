#include "tools/mesh2scene/scene_text.h"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {

std::string float_text(double value) {
  std::array<char, kMaxFloatLength> text{};
  return {text.data(), print_shortest_float(text.data(), static_cast<float>(value))};
}

std::string text_of(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

namespace {

using pipeline::float_text;

std::string float_text(const Vec3& v) {
  return float_text(v.x) + " " + float_text(v.y) + " " + float_text(v.z);
}

/// The content of a vertex's line.
struct VertexNumbers {
  std::array<float, 10> numbers{};  // position, perhaps a color, normal, which is never 0
  std::size_t count = 0;

  void add(const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) numbers[count++] = static_cast<float>(x);
  }
  using Words = std::array<std::uint64_t, 5>;
  [[nodiscard]] Words words() const { return std::bit_cast<Words>(numbers); }
};

/// The lines of vertices, kept for the triangles that share them: of lines with the same hash, the last.
class VertexLines {
 public:
  [[nodiscard]] std::string_view line_of(const VertexNumbers& vertex) {
    const VertexNumbers::Words words = vertex.words();
    Line& line = lines_[hash(words) % kPlaces];
    if (line.words != words) {
      line.words = words;
      print(vertex, line);
    }
    return {line.text.data(), line.length};
  }

 private:
  struct Line {
    VertexNumbers::Words words{};
    std::size_t length = 0;
    std::array<char, 9 * (kMaxFloatLength + 1)> text;
  };

  static std::size_t hash(const VertexNumbers::Words& words) {
    std::uint64_t mixed = 0;
    for (const std::uint64_t word : words) mixed = ((mixed ^ word) + (mixed >> 32)) * 0x9e3779b97f4a7c15;
    return static_cast<std::size_t>(mixed >> 40);
  }

  static void print(const VertexNumbers& vertex, Line& line) {
    char* p = line.text.data();
    for (std::size_t i = 0; i < vertex.count; ++i) {
      p = print_shortest_float(p, vertex.numbers[i]);
      *p++ = i + 1 < vertex.count ? ' ' : '\n';
    }
    line.length = static_cast<std::size_t>(p - line.text.data());
  }

  static constexpr std::size_t kPlaces = 8192;

  std::vector<Line> lines_ = std::vector<Line>(kPlaces);
};

/// Rounds values to as many decimals as make five digits of a length.
class Rounding {
 public:
  explicit Rounding(double length) : decimals_(4 - static_cast<int>(std::floor(std::log10(length)))) {}

  [[nodiscard]] double operator()(double value) const {
    if (decimals_ < 0 || decimals_ > kMaxDecimals) return value;
    std::array<char, kMaxNumberLength> text{};
    const char* const end = print_number(text.data(), value, 0, {.decimals = decimals_});
    const double rounded = parse_number({text.data(), end}).value;
    return rounded == 0 ? 0 : rounded;
  }
  [[nodiscard]] Vec3 operator()(const Vec3& v) const { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }

 private:
  int decimals_;
};

/// A matrix as translate, rotate and scale, applied from right to left.
struct Commands {
  Vec3 translation;
  double angle_degrees = 0;
  Vec3 axis = {0, 0, 1};
  Vec3 scaling = {1, 1, 1};
};

/// The value with 1 / units decimals if it is as near to that as the matrix's floats allow.
double without_noise(double value, double units, double noise) {
  const double coarse = std::round(value * units) / units;
  return (std::fabs(value - coarse) <= noise ? coarse : value) + 0.0;
}

/// The rotation in the columns of an orthogonal matrix of determinant 1, by its quaternion.
void set_rotation(const std::array<Vec3, 3>& columns, Commands& commands) {
  const auto& [x, y, z] = columns;
  // w is the cosine of half the angle; the largest of the four components decides, so that no digits cancel.
  const double w2 = 1 + x.x + y.y + z.z, x2 = 1 + x.x - y.y - z.z, y2 = 1 - x.x + y.y - z.z,
               z2 = 1 - x.x - y.y + z.z;
  const double largest = std::max({w2, x2, y2, z2});
  double w = y.z - z.y;
  Vec3 v = {x2, x.y + y.x, z.x + x.z};
  if (largest == w2) {
    w = w2;
    v = {y.z - z.y, z.x - x.z, x.y - y.x};
  } else if (largest == y2) {
    w = z.x - x.z;
    v = {x.y + y.x, y2, y.z + z.y};
  } else if (largest == z2) {
    w = x.y - y.x;
    v = {z.x + x.z, y.z + z.y, z2};
  }
  const double sine = std::sqrt(dot(v, v));
  if (sine == 0) return;
  commands.angle_degrees = without_noise(2 * std::atan2(sine, w) * 180 / std::numbers::pi, 1e4, 2e-5);
  for (double Vec3::*component : {&Vec3::x, &Vec3::y, &Vec3::z})
    commands.axis.*component = without_noise(v.*component / sine, 1e6, 2e-7);
}

/// Nothing if the matrix has shear or flattens.
std::optional<Commands> commands_of(const NodeMatrix& m) {
  const auto column = [&](std::size_t j) { return Vec3{m.rows[0][j], m.rows[1][j], m.rows[2][j]}; };
  std::array<Vec3, 3> columns = {column(0), column(1), column(2)};
  Commands commands;
  commands.translation = column(3);
  const bool is_mirrored = dot(columns[0], cross(columns[1], columns[2])) < 0;
  std::array<double, 3> lengths{};
  for (std::size_t i = 0; i < 3; ++i) {
    lengths[i] = std::sqrt(dot(columns[i], columns[i])) * (is_mirrored ? -1 : 1);
    if (!(std::fabs(lengths[i]) > 0) || !std::isfinite(lengths[i])) return std::nullopt;
    columns[i] = scaled(columns[i], 1 / lengths[i]);
  }
  constexpr double kOrthogonal = 1e-6;  // floats leave this much
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::fabs(dot(columns[i], columns[(i + 1) % 3])) < kOrthogonal)) return std::nullopt;
  const auto scaling = [&](std::size_t i) {
    return without_noise(lengths[i], 1e6, 2e-7 * std::fabs(lengths[i]));
  };
  commands.scaling = {scaling(0), scaling(1), scaling(2)};
  set_rotation(columns, commands);
  return commands;
}

class SceneWriter {
 public:
  SceneWriter(const ImportedModel& model, const SceneSetting& setting, const SceneMaterials& materials,
              TextWriter& out)
      : model_(model),
        setting_(setting),
        materials_(materials),
        out_(out),
        has_color_columns_(model.has_vertex_colors() && !setting.has_one_color) {}

  void write_setting() {
    for (const std::string& comment : setting_.comments) line("# " + on_one_line(comment));
    const FramingCamera& camera = setting_.camera;
    const double scale = setting_.scale, near = scale * camera.near, far = scale * camera.far;
    const Rounding round(scale * camera.distance);
    const auto rounded = [&](const Vec3& p) { return round(scaled(p, scale)); };
    line(text_of(rounded(camera.eye)));
    line(text_of(rounded(camera.look)));
    line(text_of(Rounding(1)(camera.up)));
    line(shortest_text(setting_.fov_y_degrees) + " " + shortest_text(setting_.aspect) + " " +
         shortest_text(Rounding(near)(near)) + " " + shortest_text(Rounding(far)(far)) + " ratio");
    line("background " + text_of(setting_.background));
    line(has_color_columns_ ? "attributes color normal" : "attributes normal");
    for (const std::string& material : materials_.lines()) line(material);
    if (setting_.ambient != Vec3{}) line("ambient " + text_of(setting_.ambient));
    for (const ModelLight& light : setting_.lights)
      line("light " + text_of(rounded(light.position)) + " " + text_of(Rounding(0.1)(light.intensity)));
    if (const std::string factor = shortest_text(scale); scale != 1)
      line("scale " + factor + " " + factor + " " + factor);
  }

  void write_meshes() {
    for (const PlacedMesh& placed : model_.meshes()) write(placed);
  }

  void write_node(const aiNode& node, const NodeMatrix& above) {
    NodeMatrix pending = product(above, matrix_of(node));
    const auto commands = commands_of(pending);
    const bool is_in_commands = commands && !pending.is_identity();
    if (is_in_commands) {
      line("push");
      if (commands->translation != Vec3{}) line("translate " + float_text(commands->translation));
      if (commands->angle_degrees != 0)
        line("rotate " + float_text(commands->angle_degrees) + " " + float_text(commands->axis));
      if (commands->scaling != Vec3{1, 1, 1}) line("scale " + float_text(commands->scaling));
      pending = {};
    }
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
      if (const aiMesh* mesh = model_.scene().mMeshes[node.mMeshes[i]]; ImportedModel::is_drawn(*mesh))
        write({mesh, pending});
    for (unsigned i = 0; i < node.mNumChildren; ++i) write_node(*node.mChildren[i], pending);
    if (is_in_commands) line("pop");
  }

  void line(std::string_view text) {
    out_.append(text);
    out_.append("\n");
  }

 private:
  void write(const PlacedMesh& placed) {
    const aiMesh& mesh = *placed.mesh;
    if (mesh.mName.length > 0) line("# " + on_one_line(mesh.mName.C_Str()));
    const Vec3 color = materials_.color_of(mesh);
    if (!has_color_columns_ && !materials_.have_paints() && color != color_in_force_)
      line("color " + text_of(color));
    color_in_force_ = color;
    const std::size_t material = materials_.number_of(mesh);
    if (material != material_in_force_) line("use " + std::to_string(material));
    material_in_force_ = material;
    placed_ = &placed;
    made_normals_ = model_.made_normals(mesh);
    color_ = color;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) write_triangle(i);
  }

  /// The normal at a triangle's corner, from the file or made; the triangle's own if there is none of use.
  [[nodiscard]] Vec3 normal(unsigned face, std::size_t corner) const {
    const aiMesh& mesh = *placed_->mesh;
    const unsigned* const indices = mesh.mFaces[face].mIndices;
    Vec3 in_mesh;
    if (made_normals_ != nullptr) {
      const auto& [x, y, z] = (*made_normals_)[3 * std::size_t{face} + corner];
      in_mesh = {x, y, z};
    } else {
      const aiVector3D& n = mesh.mNormals[indices[corner]];
      in_mesh = {n.x, n.y, n.z};
    }
    const Vec3 in_model =
        placed_->is_in_place ? in_mesh : unit_vector(placed_->model_from_mesh.normal(in_mesh));
    return is_direction(in_model) ? in_model : face_normal(indices);
  }

  /// Any for a triangle without area, which is not seen.
  [[nodiscard]] Vec3 face_normal(const unsigned* indices) const {
    const Vec3 n = unit_vector(pipeline::face_normal(
        {placed_->position(indices[0]), placed_->position(indices[1]), placed_->position(indices[2])}));
    return is_direction(n) ? n : setting_.camera.up;
  }

  /// True if a scene takes it as a normal.
  static bool is_direction(const Vec3& n) {
    const auto is_0 = [](double value) { return static_cast<float>(value) == 0; };
    return std::isfinite(n.x + n.y + n.z) && !(is_0(n.x) && is_0(n.y) && is_0(n.z));
  }

  void write_triangle(unsigned face) {
    static constexpr std::string_view kKeyword = "triangle\n";
    char* p = out_.reserve(kKeyword.size() + std::size_t{3} * 9 * (kMaxFloatLength + 1));
    p = std::copy(kKeyword.begin(), kKeyword.end(), p);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const unsigned index = placed_->mesh->mFaces[face].mIndices[corner];
      VertexNumbers vertex;
      vertex.add(placed_->position(index));
      if (has_color_columns_) vertex.add(color_of(index));
      vertex.add(normal(face, corner));
      const std::string_view line = lines_.line_of(vertex);
      p = std::copy(line.begin(), line.end(), p);
    }
    out_.commit(p);
  }

  [[nodiscard]] Vec3 color_of(unsigned index) const {
    if (!placed_->mesh->HasVertexColors(0)) return color_;
    const aiColor4D& c = placed_->mesh->mColors[0][index];
    return {model_.channel(c.r), model_.channel(c.g), model_.channel(c.b)};
  }

  const ImportedModel& model_;
  const SceneSetting& setting_;
  const SceneMaterials& materials_;
  TextWriter& out_;
  bool has_color_columns_;
  std::optional<Vec3> color_in_force_;
  std::size_t material_in_force_ = 0;
  // The mesh that is being written:
  const PlacedMesh* placed_ = nullptr;
  const CornerNormals* made_normals_ = nullptr;
  Vec3 color_;
  VertexLines lines_;
};

}  // namespace

void write_scene(const ImportedModel& model, const SceneSetting& setting, const SceneMaterials& materials,
                 NodeForm node_form, TextWriter& out) {
  SceneWriter writer(model, setting, materials, out);
  writer.write_setting();
  if (node_form == NodeForm::applied)
    writer.write_meshes();
  else
    writer.write_node(*model.scene().mRootNode, {});
  writer.line("end");
}

}  // namespace pipeline
