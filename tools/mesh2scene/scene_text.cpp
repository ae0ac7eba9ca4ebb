#include "tools/mesh2scene/scene_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {

namespace {

std::string text_of(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

/// The color of a mesh without vertex colors, from 0 to 255.
Vec3 color_of(const ModelMesh& mesh, const Model& model, const SceneSetting& setting) {
  return setting.has_one_color ? setting.color : model.material(mesh).color.value_or(setting.color);
}

/// The materials of a scene made from a model: the distinct ones of its meshes, in the order of the meshes.
/// They may have the colors of their meshes as paints.
struct SceneMaterials {
  std::vector<std::string> lines;  // `material` and perhaps `paint`, for each; at least one
  std::map<std::optional<std::size_t>, std::size_t> numbers;  // by the model's
  bool have_paints = false, are_too_many = false;  // more than kMostMaterials: the others get number 0

  SceneMaterials(const Model& model, const SceneSetting& setting, bool paints) : have_paints(paints) {
    for (const PlacedMesh& placed : model.placed) {
      const auto [known, is_new] = numbers.try_emplace(placed.mesh->material);
      if (!is_new) continue;
      const ModelMaterial material = model.material(*placed.mesh);
      std::string line = "material ";
      // Three decimals are finer than a picture can show, and hide that files hold floats.
      for (const double factor : {material.ambient, material.diffuse, material.specular})
        line += shortest_text(std::round(factor * 1000) / 1000) + " ";
      line += shortest_text(std::round(material.shininess));
      if (have_paints) line += "\npaint " + text_of(color_of(*placed.mesh, model, setting));
      const auto number = static_cast<std::size_t>(std::ranges::find(lines, line) - lines.begin());
      if (number == lines.size() && number < kMostMaterials) lines.push_back(line);
      are_too_many = are_too_many || number == kMostMaterials;
      known->second = number < kMostMaterials ? number : 0;
    }
  }
};

std::string float_text(double value) {
  std::array<char, kMaxFloatLength> text{};
  return {text.data(), print_shortest_float(text.data(), static_cast<float>(value))};
}

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

/// The lines of vertices, kept for triangles that share them: the last line of each hash.
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

/// The value rounded to the decimals with which a length has five digits.
double rounded(double value, double length) {
  const int decimals = 4 - static_cast<int>(std::floor(std::log10(length)));
  if (decimals < 0 || decimals > kMaxDecimals) return value;
  const double units = std::pow(10, decimals);
  return std::round(value * units) / units + 0.0;
}

Vec3 rounded(const Vec3& v, double length) {
  return {rounded(v.x, length), rounded(v.y, length), rounded(v.z, length)};
}

/// The value rounded to whole 1 / units, if the difference is within the noise of the file's floats.
double without_noise(double value, double units, double noise) {
  const double coarse = std::round(value * units) / units;
  return (std::fabs(value - coarse) <= noise ? coarse : value) + 0.0;
}

struct SceneWriter {
  const Model& model_;
  const SceneSetting& setting_;
  const SceneMaterials& materials_;
  TextWriter& out_;
  bool has_color_columns_ = model_.has_vertex_colors() && !setting_.has_one_color;

  void write_setting() {
    for (const std::string& comment : setting_.comments) line("# " + on_one_line(comment));
    const ModelCamera& camera = setting_.camera;
    const double scale = setting_.scale, near = scale * camera.near, far = scale * camera.far;
    const double length = scale * camera.distance;
    const auto place = [&](const Vec3& p) { return text_of(rounded(scaled(p, scale), length)); };
    line(place(camera.eye));
    line(place(camera.look));
    line(text_of(rounded(camera.up, 1)));
    line(shortest_text(camera.fov_y_degrees) + " " + shortest_text(setting_.aspect) + " " +
         shortest_text(rounded(near, near)) + " " + shortest_text(rounded(far, far)) + " ratio");
    line("background " + text_of(setting_.background));
    line(has_color_columns_ ? "attributes color normal" : "attributes normal");
    for (const std::string& material : materials_.lines) line(material);
    if (setting_.ambient != Vec3{}) line("ambient " + text_of(setting_.ambient));
    for (const ModelLight& light : setting_.lights)
      line("light " + place(light.position) + " " + text_of(rounded(light.intensity, 0.1)));
    if (const std::string factor = shortest_text(scale); scale != 1)
      line("scale " + factor + " " + factor + " " + factor);
  }

  void write_meshes() {
    for (const PlacedMesh& placed : model_.placed) write(placed, placed.model_from_mesh.mirrors());
  }

  void write_node(const ModelNode& node, const NodeMatrix& above, bool is_above_mirrored) {
    const bool is_in_commands = node.steps && above.is_identity() && !node.parent_from_node.is_identity();
    const NodeMatrix pending = is_in_commands ? NodeMatrix() : product(above, node.parent_from_node);
    const bool is_mirrored = is_above_mirrored != node.parent_from_node.mirrors();
    if (is_in_commands) {
      const auto& [translation, turn, cosine, scaling] = *node.steps;
      line("push");
      if (translation != Vec3{}) line("translate " + float_text(translation));
      if (const double sine = std::sqrt(dot(turn, turn)); sine > 0) {
        const double angle = 2 * std::atan2(sine, cosine) * 180 / std::numbers::pi;
        const auto part = [&](double x) { return without_noise(x / sine, 1e6, 2e-7); };
        line("rotate " + float_text(without_noise(angle, 1e4, 2e-5)) + " " +
             float_text(Vec3{part(turn.x), part(turn.y), part(turn.z)}));
      }
      if (scaling != Vec3{1, 1, 1}) line("scale " + float_text(scaling));
    }
    for (const std::size_t index : node.meshes)
      if (const PlacedMesh placed = model_.placed_mesh(index, pending); !placed.shape->corners.empty())
        write(placed, is_mirrored);
    for (const ModelNode& child : node.children) write_node(child, pending, is_mirrored);
    if (is_in_commands) line("pop");
  }

  void line(std::string_view text) {
    out_.append(text);
    out_.append("\n");
  }

  void write(const PlacedMesh& placed, bool is_mirrored) {
    const ModelMesh& mesh = *placed.mesh;
    if (!mesh.name.empty()) line("# " + on_one_line(mesh.name));
    const Vec3 color = pipeline::color_of(mesh, model_, setting_);
    if (!has_color_columns_ && !materials_.have_paints && color != color_in_force_)
      line("color " + text_of(color));
    color_in_force_ = color;
    const std::size_t material = materials_.numbers.at(mesh.material);
    if (material != material_in_force_) line("use " + std::to_string(material));
    material_in_force_ = material;
    placed_ = &placed;
    color_ = color;
    // The winding of a mirror image is reversed.
    const std::array<std::size_t, 3> order = {0, is_mirrored ? 2U : 1U, is_mirrored ? 1U : 2U};
    const std::size_t corner_count = placed.shape->corners.size();
    for (std::size_t i = 0; i < corner_count; i += 3) write_triangle(i, order);
  }

  /// The normal at a corner of the mesh; its triangle's own normal if it has no usable one.
  [[nodiscard]] Vec3 normal(std::size_t corner) const {
    const auto& [x, y, z] = placed_->shape->normals[corner];
    const Vec3 in_mesh = {x, y, z};
    const Vec3 in_model =
        placed_->is_in_place ? in_mesh : unit_vector(placed_->model_from_mesh.normal(in_mesh));
    if (is_direction(in_model)) return in_model;
    const std::uint32_t* const i = placed_->shape->corners.data() + corner / 3 * 3;
    const Vec3 n =
        unit_vector(face_normal({placed_->position(i[0]), placed_->position(i[1]), placed_->position(i[2])}));
    // A triangle without area, which is not visible, gets any normal.
    return !is_direction(n) ? setting_.camera.up : placed_->model_from_mesh.mirrors() ? scaled(n, -1) : n;
  }

  /// True if a scene accepts it as a normal.
  static bool is_direction(const Vec3& n) {
    const auto is_0 = [](double value) { return static_cast<float>(value) == 0; };
    return std::isfinite(n.x + n.y + n.z) && !(is_0(n.x) && is_0(n.y) && is_0(n.z));
  }

  void write_triangle(std::size_t first_corner, const std::array<std::size_t, 3>& order) {
    static constexpr std::string_view kKeyword = "triangle\n";
    char* p = out_.reserve(kKeyword.size() + std::size_t{3} * 9 * (kMaxFloatLength + 1));
    p = std::copy(kKeyword.begin(), kKeyword.end(), p);
    for (const std::size_t i : order) {
      const std::size_t corner = first_corner + i;
      const std::uint32_t index = placed_->shape->corners[corner];
      VertexNumbers vertex;
      vertex.add(placed_->position(index));
      if (has_color_columns_) vertex.add(color_of(index));
      vertex.add(normal(corner));
      const std::string_view line = lines_.line_of(vertex);
      p = std::copy(line.begin(), line.end(), p);
    }
    out_.commit(p);
  }

  [[nodiscard]] Vec3 color_of(std::uint32_t index) const {
    if (!placed_->mesh->has_colors) return color_;
    const auto [red, green, blue] = model_.color(index);
    return std::isnan(red + green + blue) ? color_ : Vec3{red, green, blue};
  }

  std::optional<Vec3> color_in_force_{};
  std::size_t material_in_force_ = 0;
  // The mesh being written:
  const PlacedMesh* placed_ = nullptr;
  Vec3 color_{};
  VertexLines lines_{};
};

}  // namespace

bool write_scene(const Model& model, const SceneSetting& setting, bool as_nodes, TextWriter& out) {
  // Paints are used if all colors come from materials or the setting, unless they make too many materials.
  SceneMaterials materials(model, setting, setting.has_one_color || !model.has_vertex_colors());
  if (materials.have_paints && materials.are_too_many) materials = {model, setting, false};
  SceneWriter writer = {model, setting, materials, out};
  writer.write_setting();
  as_nodes ? writer.write_node(model.root, {}, false) : writer.write_meshes();
  writer.line("end");
  return !materials.are_too_many;
}

}  // namespace pipeline
