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
#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

namespace {

std::string text_of(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

/// The color of a mesh without vertex colors, from 0 to 255.
Vec3 color_of(const ModelMesh& mesh, const Model& model, const SceneSetting& setting) {
  constexpr Vec3 kUsual = {228, 222, 210};
  return setting.color.value_or(model.material(mesh).color.value_or(kUsual));
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

/// The text of a vertex's line.
struct VertexLine {
  std::array<std::uint64_t, 5> numbers{};  // in pairs of floats
  std::size_t length = 0;
  std::array<char, 9 * (kMaxFloatLength + 1)> text;
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
  bool as_nodes_;
  bool has_color_columns_ = model_.has_vertex_colors() && !setting_.color;

  void write_setting() {
    line("# " + on_one_line(setting_.comment));
    const ModelCamera& camera = setting_.camera;
    const double scale = setting_.scale, near = scale * camera.near, far = scale * camera.far;
    const double length = scale * camera.distance;
    const auto place = [&](const Vec3& p) { return text_of(rounded(scaled(p, scale), length)); };
    line(place(camera.eye));
    line(place(camera.look));
    line(text_of(rounded(camera.up, 1)));
    line(shortest_text(camera.fov_y_degrees) + " " + shortest_text(setting_.aspect) + " " +
         shortest_text(rounded(near, near)) + " " + shortest_text(rounded(far, far)) + " ratio");
    line("background 232 235 240");
    line(has_color_columns_ ? "attributes color normal" : "attributes normal");
    for (const std::string& material : materials_.lines) line(material);
    if (setting_.ambient != Vec3{}) line("ambient " + text_of(setting_.ambient));
    for (const ModelLight& light : setting_.lights)
      line("light " + place(light.position) + " " + text_of(rounded(light.intensity, 0.1)));
    if (const std::string factor = shortest_text(scale); scale != 1)
      line("scale " + factor + " " + factor + " " + factor);
  }

  /// `above` has the transforms that no command stands for; `is_mirrored` is by the commands.
  void write_node(const ModelNode& node, const NodeMatrix& above, bool is_mirrored) {
    const NodeMatrix& own = node.parent_from_node;
    const bool is_in_commands = as_nodes_ && node.steps && above.is_identity() && !own.is_identity();
    const NodeMatrix pending = is_in_commands ? NodeMatrix() : product(above, own);
    if (is_in_commands) {
      is_mirrored = is_mirrored != own.mirrors();
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
    // The winding of a mirror image is reversed.
    const std::size_t second = placed.model_from_mesh.mirrors() != is_mirrored ? 2 : 1;
    for (std::size_t i = 0; i < placed.shape->corners.size(); i += 3) {
      constexpr std::string_view kKeyword = "triangle\n";
      char* p = out_.reserve(kKeyword.size() + 3 * sizeof(VertexLine::text));
      p = std::copy(kKeyword.begin(), kKeyword.end(), p);
      for (const std::size_t corner : {i, i + second, i + 3 - second}) {
        const std::string_view text = vertex_line(placed, corner, color);
        p = std::copy(text.begin(), text.end(), p);
      }
      out_.commit(p);
    }
  }

  /// The normal at a corner of the mesh; its triangle's own normal if it has no usable one.
  [[nodiscard]] Vec3 normal(const PlacedMesh& placed, std::size_t corner) const {
    const auto& [x, y, z] = placed.shape->normals[corner];
    const Vec3 in_mesh = {x, y, z};
    const Vec3 in_model = placed.is_in_place ? in_mesh : unit_vector(placed.model_from_mesh.normal(in_mesh));
    if (is_direction(in_model)) return in_model;
    const std::uint32_t* const i = placed.shape->corners.data() + corner / 3 * 3;
    const Vec3 n =
        unit_vector(face_normal({placed.position(i[0]), placed.position(i[1]), placed.position(i[2])}));
    // A triangle without area, which is not visible, gets any normal.
    return !is_direction(n) ? setting_.camera.up : placed.model_from_mesh.mirrors() ? scaled(n, -1) : n;
  }

  /// True if a scene accepts it as a normal.
  static bool is_direction(const Vec3& n) { return std::isfinite(n.x + n.y + n.z) && floats(n) != Floats{}; }

  std::string_view vertex_line(const PlacedMesh& placed, std::size_t corner, const Vec3& color_of_mesh) {
    std::array<float, 10> numbers{};  // position, perhaps a color, normal, which is never 0
    std::size_t count = 0;
    const auto add = [&](const Vec3& v) {
      for (const float x : floats(v)) numbers[count++] = x;
    };
    const std::uint32_t index = placed.shape->corners[corner];
    add(placed.position(index));
    if (has_color_columns_) {
      const auto [red, green, blue] = placed.mesh->has_colors ? model_.color(index) : kNoColor;
      add(std::isnan(red + green + blue) ? color_of_mesh : Vec3{red, green, blue});
    }
    add(normal(placed, corner));
    const auto words = std::bit_cast<decltype(VertexLine::numbers)>(numbers);
    std::uint64_t hash = 0;
    for (const std::uint64_t word : words) hash = (hash ^ word) * 0x9e3779b97f4a7c15;
    VertexLine& line = lines_[hash >> (64 - kHashBits)];
    if (line.numbers != words) {
      line.numbers = words;
      char* p = line.text.data();
      for (std::size_t i = 0; i < count; ++i) {
        p = print_shortest_float(p, numbers[i]);
        *p++ = i + 1 < count ? ' ' : '\n';
      }
      line.length = static_cast<std::size_t>(p - line.text.data());
    }
    return {line.text.data(), line.length};
  }

  std::optional<Vec3> color_in_force_{};
  std::size_t material_in_force_ = 0;
  // The last line of each hash, kept for triangles that share vertices.
  static constexpr int kHashBits = 13;
  std::vector<VertexLine> lines_ = std::vector<VertexLine>(1U << kHashBits);
};

}  // namespace

bool write_scene(const Model& model, const SceneSetting& setting, bool as_nodes, TextWriter& out) {
  // Paints are used if all colors come from materials or the setting, unless they make too many materials.
  SceneMaterials materials(model, setting, setting.color || !model.has_vertex_colors());
  if (materials.have_paints && materials.are_too_many) materials = {model, setting, false};
  SceneWriter writer = {model, setting, materials, out, as_nodes};
  writer.write_setting();
  writer.write_node(model.root, {}, false);
  writer.line("end");
  return !materials.are_too_many;
}

}  // namespace pipeline
