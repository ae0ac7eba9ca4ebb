// glTF 2.0 (Khronos Group, glTF 2.0 Specification, 2021), as JSON or GLB.

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <stdexcept>

// Unused parts, which would take time to compile.
#define JSON_NO_IO
#define JSON_USE_IMPLICIT_CONVERSIONS 0
#include <nlohmann/json.hpp>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/model_text.h"
#include "libpipeline/scene/polygon.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/readers.h"

namespace pipeline {
namespace {

constexpr double kNoEnd = std::numeric_limits<double>::infinity();

/// A value of a document; if missing, null or of another type, it reads as 0, "" or no items.
struct Json {
  const nlohmann::json* value;

  Json(const nlohmann::json& json) : value(&json) {}  // NOLINT(google-explicit-constructor)

  Json operator[](std::string_view name) const {
    const auto found = value->find(name);
    return found == value->end() ? kNothing : *found;
  }
  Json operator[](std::size_t index) const { return index < items().size() ? items()[index] : kNothing; }
  [[nodiscard]] bool is_there() const { return !value->is_null(); }
  [[nodiscard]] double number(double missing = 0) const {
    return value->is_number() ? value->get<double>() : missing;
  }
  [[nodiscard]] const std::string& text() const {
    return (value->is_string() ? *value : kNoText).get_ref<const std::string&>();
  }
  [[nodiscard]] const std::vector<nlohmann::json>& items() const {
    return (value->is_array() ? *value : kNoItems).get_ref<const nlohmann::json::array_t&>();
  }

  inline static const nlohmann::json kNothing, kNoText = "", kNoItems = nlohmann::json::array();
};

/// Parses a whole text, up to a NUL, since chunks of GLB are padded.
nlohmann::json parse_json(const std::string& name, std::string_view text) {
  std::size_t place = 0;
  std::string reason;
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {  // "...: ... - REASON; last read: '...'"
    reason = error.what();
    reason = reason.substr(0, reason.find("; last read")).substr(reason.find(" - ") + 3);
    place = text.substr(0, error.byte - 1).find_last_of(" \t\r\n,:[]{}\"") + 1;
  } catch (const nlohmann::json::out_of_range& error) {  // "... number overflow parsing '1e999'"
    const std::string what = error.what();
    place = text.find(what.substr(what.find('\'') + 1, what.size() - what.find('\'') - 2));
    reason = "numbers of doubles";
  }
  ModelText(name, text).fail(text.substr(place, 20), "JSON (" + reason + ")");
}

/// The JSON and the numbers of a GLB file; for a text file, only the JSON.
std::array<std::string_view, 2> parts_of(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {bytes.substr(bytes.starts_with("\xef\xbb\xbf") ? 3 : 0)};
  std::array<std::string_view, 2> parts;
  for (bytes.remove_prefix(std::min<std::size_t>(12, bytes.size())); bytes.size() > 8;) {
    const auto size = std::size_t{number_in<std::uint32_t>(bytes.data())};
    const std::string_view kind = bytes.substr(4, 3);
    bytes.remove_prefix(8);
    const std::string_view part = bytes.substr(0, size);
    bytes.remove_prefix(part.size());
    if (kind == "JSO" || kind == "BIN") parts[kind == "JSO" ? 0 : 1] = part;
  }
  return parts;
}

/// True if an extension is read, or does not change triangles.
bool is_supported(std::string_view extension) {
  constexpr std::array kSupported = {"KHR_mesh_quantization", "KHR_lights_punctual", "KHR_node_visibility",
                                     "KHR_animation_pointer", "KHR_xmp_json_ld"};
  return extension.starts_with("KHR_materials_") || extension.find("_texture_") != std::string_view::npos ||
         std::ranges::find(kSupported, extension) != kSupported.end();
}

constexpr std::array kComponents = {  // from 5120 on
    number_type<std::int8_t>(127),
    number_type<std::uint8_t>(255),
    number_type<std::int16_t>(32767),
    number_type<std::uint16_t>(65535),
    NumberType{},
    number_type<std::uint32_t>(),
    number_type<float>()};

struct GltfReader {
  const Json document_;
  std::string_view binary_;  // of a GLB file
  ModelFiles& files_;
  Model& model_;
  std::map<const nlohmann::json*, std::string> decoded_{};     // buffers in base64
  std::map<const nlohmann::json*, std::string_view> found_{};  // all buffers
  // assimp keeps the colors of other formats when it converts them.
  bool is_linear_ = !document_["asset"]["generator"].text().starts_with("Open Asset Import Library");
  std::vector<Vec3> linear_colors_{};  // of materials
  std::map<std::size_t, std::vector<std::size_t>> meshes_{};
  std::map<nlohmann::json, std::size_t> shapes_{};  // the first mesh of primitives that differ in materials
  std::map<std::array<double, 3>, std::pair<std::uint32_t, std::uint32_t>> points_{};
  std::vector<double> normals_{};  // of the last accessor
  double normals_index_ = -1;
  bool has_orthographic_ = false;
  std::size_t node_count_ = 0, taken_ = 0;

  void read() {
    if (const std::string& version = document_["asset"]["version"].text(); !version.starts_with("2"))
      model_.fail("glTF of version 2", "version " + pipeline::quoted(version));
    for (const Json extension : document_["extensionsRequired"].items())
      if (!is_supported(extension.text()))
        model_.fail("extensions that are supported",
                    pipeline::quoted(extension.text()) + ", which the file requires");
    for (const Json extension : document_["extensionsUsed"].items()) {
      if (extension.text() == "KHR_materials_unlit") model_.unheld.insert("unlit surfaces");
      if (extension.text() == "EXT_mesh_gpu_instancing") model_.unheld.insert("further instances");
    }
    for (const auto& [part, name] : {std::pair("animations", "animations"), std::pair("skins", "bones"),
                                     std::pair("textures", "textures")})
      if (document_[part][0].is_there()) model_.unheld.insert(name);
    for (const Json material : document_["materials"].items()) read_material(material);
    if (document_["scenes"][0].is_there()) {
      const Json index = document_["scene"];
      const Json scene = index.is_there() ? item("scenes", index) : document_["scenes"][0];
      for (const Json node : scene["nodes"].items()) read_node(node, {}, 0, model_.root);
    } else {
      for (std::size_t i = 0; i < document_["meshes"].items().size(); ++i)
        show_mesh(nlohmann::json(i), model_.root);
    }
    if (!model_.colors.empty()) scale_colors(model_, model_.colors, 1, is_linear_);
    if (has_orthographic_ && !model_.camera)
      model_.note("its orthographic camera is left out: the model is framed");
  }

  /// An item of one of the document's arrays.
  Json item(const char* array, Json index) const {
    const Json items = document_[array];
    const double i = index.number(-1);
    if (!(i >= 0 && i < static_cast<double>(items.items().size())))
      model_.fail(std::string("an index of ") + array + " below " + std::to_string(items.items().size()),
                  index.is_there() ? shortest_text(i) : "none");
    return items[static_cast<std::size_t>(i)];
  }

  /// A count or an offset in bytes; 0 if it is missing.
  std::size_t count(Json json, const char* name) const {
    const double value = json[name].number();
    if (!(value >= 0 && value < 1e15))
      model_.fail(std::string("a number from 0 as ") + name, shortest_text(value));
    return static_cast<std::size_t>(value);
  }

  std::string_view buffer(Json index) {
    const Json json = item("buffers", index);
    if (const auto known = found_.find(json.value); known != found_.end()) return known->second;
    const std::string& uri = json["uri"].text();
    std::string_view bytes = binary_;
    if (uri.starts_with("data:")) {
      const auto [known, is_new] = decoded_.try_emplace(json.value);
      if (is_new) known->second = from_base64(std::string_view(uri).substr(uri.find(',') + 1));
      bytes = known->second;
    } else if (json["uri"].is_there()) {
      std::optional<std::string_view> file = files_.read(uri);
      if (!file) file = files_.read(without_percent_codes(uri));
      if (!file && !files_.refusal().empty()) throw std::runtime_error(model_.name + ": " + files_.refusal());
      if (!file) model_.fail("the file of its numbers", "no " + pipeline::quoted(uri));
      bytes = *file;
    } else if (json.value != document_["buffers"][0].value) {
      model_.fail("the uri of a buffer", "none: only the first may be in the file");
    }
    if (count(json, "byteLength") > bytes.size())
      model_.fail(counted(count(json, "byteLength"), "byte") + " in a buffer",
                  std::to_string(bytes.size()) + ": it is cut");
    return found_[json.value] = bytes;
  }

  /// The first `width` of the components of each of `n` values.
  std::vector<double> values_at(Json place, double type, std::size_t components, std::size_t n,
                                std::size_t width, bool is_normalized = false) {
    const bool is_known = type >= 5120 && type <= 5126 && type != 5124 && type == std::floor(type);
    if (!is_known) model_.fail("a componentType from 5120 to 5126", shortest_text(type));
    const auto& [size, value, most] = kComponents[static_cast<std::size_t>(type - 5120)];
    const Json view = item("bufferViews", place["bufferView"]);
    std::string_view bytes = buffer(view["buffer"]);
    bytes = bytes.substr(std::min(count(view, "byteOffset"), bytes.size()), count(view, "byteLength"));
    bytes.remove_prefix(std::min(count(place, "byteOffset"), bytes.size()));
    const std::size_t packed = size * components, stride = std::max(count(view, "byteStride"), packed);
    if (n > 0 && (bytes.size() < packed || n - 1 > (bytes.size() - packed) / stride))
      model_.fail(counted(n, "value") + " in a view of " + counted(bytes.size(), "byte"), "the view's end");
    const double full = is_normalized ? most : 1, least = is_normalized ? -1 : -kNoEnd;
    std::vector<double> values;
    values.reserve(n * width);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < width; ++k)
        values.push_back(std::max(value(bytes.data() + i * stride + k * size) / full, least));
    return values;
  }

  /// Counts numbers, and refuses small files whose accessors share bytes to stand for gigabytes.
  void take(std::size_t numbers, const std::string& where) {
    taken_ += numbers;
    if (taken_ > 4'000'000 + 16 * files_.size())
      model_.fail("at most 4 million numbers, and 16 for each byte of its files", "more in " + where);
  }

  /// The values of an accessor whose type has at least `width` numbers, which are cut to `width`.
  std::vector<double> numbers(Json index, std::size_t width) {
    const Json json = item("accessors", index), sparse = json["sparse"];
    constexpr std::array<std::string_view, 4> kKinds = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    const std::string& kind = json["type"].text();
    const auto components = static_cast<std::size_t>(std::ranges::find(kKinds, kind) - kKinds.begin()) + 1;
    if (components > kKinds.size() || components < width)
      model_.fail("an accessor of " + counted(width, "number"), pipeline::quoted(kind));
    const double type = json["componentType"].number();
    const bool is_normalized = *json["normalized"].value == true,
               is_in_buffer = json["bufferView"].is_there();
    const std::size_t n = count(json, "count"), replaced = count(sparse, "count");
    if (!is_in_buffer && !sparse.is_there())
      model_.fail("an accessor with numbers in a buffer", "none: they are compressed, or missing");
    std::vector<double> values;
    if (is_in_buffer) values = values_at(json, type, components, n, width, is_normalized);
    take((n + replaced) * width, "accessors[" + shortest_text(index.number()) + "]");
    values.resize(n * width);
    if (!sparse.is_there()) return values;
    const Json places = sparse["indices"], others = sparse["values"];
    const std::vector<double> at = values_at(places, places["componentType"].number(), 1, replaced, 1),
                              by = values_at(others, type, components, replaced, width, is_normalized);
    for (std::size_t i = 0; i < replaced; ++i) {
      if (!(at[i] >= 0 && at[i] < static_cast<double>(n)))
        model_.fail("sparse indices below " + std::to_string(n), shortest_text(at[i]));
      for (std::size_t k = 0; k < width; ++k)
        values[static_cast<std::size_t>(at[i]) * width + k] = by[i * width + k];
    }
    return values;
  }

  static Vec3 vec(Json json, double missing, std::size_t i = 0) {
    return {json[i].number(missing), json[i + 1].number(missing), json[i + 2].number(missing)};
  }

  void read_material(Json json) {
    const Json rough = json["pbrMetallicRoughness"];
    const Json gloss = json["extensions"]["KHR_materials_pbrSpecularGlossiness"]["diffuseFactor"];
    const Json base = gloss.is_there() ? gloss : rough["baseColorFactor"];
    const Vec3 color = vec(base, 1);
    // A material that only emits light has the color of that light.
    const Vec3& shown = linear_colors_.emplace_back(color == Vec3{} ? vec(json["emissiveFactor"], 0) : color);
    const auto channel = [&](double c) { return scene_channel(c, is_linear_); };
    ModelMaterial& material = model_.materials.emplace_back();
    material.color = Vec3{channel(shown.x), channel(shown.y), channel(shown.z)};
    // docs/models.md has the formulas and their sources.
    const double metal = fraction(rough["metallicFactor"].number(gloss.is_there() ? 0 : 1)),
                 a = std::pow(fraction(rough["roughnessFactor"].number(1)), 2);
    material.shininess = std::clamp(2 / (a * a) - 2, 1.0, 10000.0);
    material.specular =
        fraction((0.04 + metal * (fraction(largest_in(color)) - 0.04)) * (material.shininess + 2) / 8);
    material.diffuse = 1 - metal / 2;
    if (const std::string& mode = json["alphaMode"].text();
        (base[3].number(1) < 1 && !mode.empty() && mode != "OPAQUE") ||
        json["extensions"]["KHR_materials_transmission"]["transmissionFactor"].number() > 0)
      model_.unheld.insert("transparency");
  }

  static void set_matrix(Json json, ModelNode& node) {
    if (const Json m = json["matrix"]; m.items().size() == 16) {
      node.parent_from_node = {vec(m, 0), vec(m, 0, 4), vec(m, 0, 8), vec(m, 0, 12)};
      return;
    }
    const Json q = json["rotation"];
    const double x = q[0].number(), y = q[1].number(), z = q[2].number(), w = q[3].number(1);
    const Vec3 scale = vec(json["scale"], 1);
    node.parent_from_node = {
        scaled({1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)}, scale.x),
        scaled({2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, scale.y),
        scaled({2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, scale.z),
        vec(json["translation"], 0)};
    if (scale.x * scale.y * scale.z != 0) node.steps = {node.parent_from_node.origin, {x, y, z}, w, scale};
  }

  void read_node(Json index, const NodeMatrix& model_from_parent, int depth, ModelNode& parent) {
    const Json json = item("nodes", index);
    if (depth > 1000 || ++node_count_ > 1'000'000)
      model_.fail("nodes without a cycle, at most 1,000 deep and 1,000,000 in all", "others");
    const Json visible = json["extensions"]["KHR_node_visibility"]["visible"];
    if (visible.is_there() && *visible.value != true) {
      model_.unheld.insert("hidden nodes");
      return;
    }
    ModelNode node;
    set_matrix(json, node);
    const NodeMatrix model_from_node = product(model_from_parent, node.parent_from_node);
    if (const Json mesh = json["mesh"]; mesh.is_there()) show_mesh(mesh, node);
    if (json["camera"].is_there()) read_camera(item("cameras", json["camera"]), model_from_node);
    if (const Json light = json["extensions"]["KHR_lights_punctual"]["light"]; light.is_there()) {
      const Json lights = document_["extensions"]["KHR_lights_punctual"]["lights"];
      read_light(lights[static_cast<std::size_t>(std::clamp(light.number(), 0.0, 1e9))], model_from_node);
    }
    for (const Json child : json["children"].items()) read_node(child, model_from_node, depth + 1, node);
    parent.children.push_back(std::move(node));
  }

  void read_camera(Json json, const NodeMatrix& m) {
    const Json lens = json["perspective"];
    if (json["type"].text() == "orthographic") has_orthographic_ = true;
    // Four decimals hide that the file's angle is a float in radians.
    const double fov = std::round(lens["yfov"].number() * 180 / std::numbers::pi * 1e4) / 1e4,
                 near = lens["znear"].number(), far = lens["zfar"].number(kNoEnd);
    const Vec3 up = m.direction({0, 1, 0}), side = cross(m.direction({0, 0, -1}), up);
    if (!model_.camera && fov > 0 && fov < 180 && near > 0 && far > near && dot(side, side) > 0 &&
        std::isfinite(dot(side, side)))
      model_.camera = {m.point({}), m.point({0, 0, -1}), up, fov, near, far};
  }

  void read_light(Json json, const NodeMatrix& m) {
    const std::string& type = json["type"].text();
    const Vec3 intensity = scaled(vec(json["color"], 1), json["intensity"].number(1));
    if (type == "spot") model_.unheld.insert("cones of spotlights");
    const bool is_far = type == "directional", is_light = is_far || type == "spot" || type == "point";
    const ModelLight light = {is_far ? m.direction({0, 0, -1}) : m.point({}), intensity, is_far};
    // No scene accepts a light beyond floats, or with a negative intensity.
    if (is_light && are_floats(light.position) && are_floats(intensity) &&
        std::min({intensity.x, intensity.y, intensity.z}) >= 0)
      model_.lights.push_back(light);
  }

  /// Shows a mesh in a node; its primitives are read once.
  void show_mesh(Json number, ModelNode& node) {
    const Json json = item("meshes", number);
    const auto index = static_cast<std::size_t>(number.number());
    const auto [known, is_new] = meshes_.try_emplace(index);
    const std::vector<nlohmann::json>& primitives = json["primitives"].items();
    const std::string own = json["name"].text().substr(0, kLongestName),
                      name = own.empty() ? "meshes[" + std::to_string(index) + "]" : own;
    for (std::size_t i = 0; is_new && i < primitives.size(); ++i)
      add_primitive(primitives[i], primitives.size() > 1 ? name + "-" + std::to_string(i) : name, index + 1,
                    known->second);
    take(16 * known->second.size(), name);  // the memory that a mesh in a node takes
    node.meshes.insert(node.meshes.end(), known->second.begin(), known->second.end());
  }

  void add_primitive(Json json, const std::string& name, std::size_t surface,
                     std::vector<std::size_t>& shown) {
    const double mode = json["mode"].number(4);
    const Json attributes = json["attributes"], material = json["material"];
    if (mode < 4) model_.unheld.insert("points and lines");
    if (json["targets"][0].is_there()) model_.unheld.insert("morph targets");
    if (mode < 4 || mode > 6 || !attributes["POSITION"].is_there()) return;
    ModelMesh mesh = {.name = name, .has_colors = attributes["COLOR_0"].is_there(), .surface = surface};
    // assimp gives a material of this name to meshes without a material.
    if (material.is_there() &&
        (item("materials", material)["name"].text() != "DefaultMaterial" || is_linear_))
      mesh.material = static_cast<std::size_t>(material.number());
    // Corners and normals do not depend on the material, but colors do; and without normals, the primitives
    // of a mesh are smoothed together.
    nlohmann::json key = *json.value;
    if (!mesh.has_colors) key.erase("material");
    if (!attributes["NORMAL"].is_there() && document_["meshes"][surface - 1]["primitives"][1].is_there())
      key["mesh"] = surface;
    const auto [known, is_new] = shapes_.try_emplace(std::move(key), model_.meshes.size());
    if (is_new)
      read_shape(json, mesh);
    else
      mesh.shape = known->second;
    shown.push_back(model_.meshes.size());
    model_.meshes.push_back(std::move(mesh));
  }

  void read_shape(Json json, ModelMesh& mesh) {
    const Json attributes = json["attributes"];
    const auto [base, size] = points_of(attributes, json["material"]);
    std::vector<std::uint32_t> indices(json["indices"].is_there() ? 0 : size);
    std::iota(indices.begin(), indices.end(), base);
    if (json["indices"].is_there())
      for (const double i : numbers(json["indices"], 1)) {
        if (!(i >= 0 && i < size) || i != std::floor(i))
          model_.fail("whole indices below " + std::to_string(size) + " in " + mesh.name, shortest_text(i));
        indices.push_back(base + static_cast<std::uint32_t>(i));
      }
    if (json["mode"].number(4) == 4)
      mesh.corners.assign(indices.begin(), indices.end() - static_cast<std::ptrdiff_t>(indices.size() % 3));
    else
      append_strip(indices, json["mode"].number() == 6, mesh.corners);
    take(mesh.corners.size(), mesh.name);
    if (const Json normals = attributes["NORMAL"]; normals.number(-1) != normals_index_)
      normals_ = normals.is_there() ? numbers(normals, 3) : std::vector<double>();
    normals_index_ = attributes["NORMAL"].number(-1);
    if (normals_.size() >= 3 * std::size_t{size} && size > 0)
      for (const std::uint32_t corner : mesh.corners) {
        const double* const n = normals_.data() + std::size_t{3} * (corner - base);
        mesh.normals.push_back(floats({n[0], n[1], n[2]}));
      }
  }

  /// The index in the model of a primitive's first point, and the count of its points.
  std::pair<std::uint32_t, std::uint32_t> points_of(Json attributes, const Json material) {
    const Json colors = attributes["COLOR_0"];
    const std::array key = {attributes["POSITION"].number(), colors.number(-1),
                            colors.is_there() ? material.number(-1) : -1};
    const auto [known, is_new] = points_.try_emplace(key);
    if (!is_new) return known->second;
    const std::vector<double> positions = numbers(attributes["POSITION"], 3);
    const std::size_t base = model_.points.size();
    for (std::size_t i = 0; i < positions.size(); i += 3)
      model_.points.push_back({positions[i], positions[i + 1], positions[i + 2]});
    if (colors.is_there()) {
      const std::vector<double> values = numbers(colors, 3);
      if (values.size() != positions.size())
        model_.fail(counted(positions.size() / 3, "color") + " in COLOR_0, one for each vertex",
                    std::to_string(values.size() / 3));
      const Vec3 factor =
          material.is_there() ? linear_colors_[static_cast<std::size_t>(material.number())] : Vec3{1, 1, 1};
      model_.colors.resize(base, kNoColor);
      for (std::size_t i = 0; i < values.size(); i += 3)
        model_.colors.push_back(file_color(product(factor, {values[i], values[i + 1], values[i + 2]})));
    }
    return known->second = {static_cast<std::uint32_t>(base),
                            static_cast<std::uint32_t>(positions.size() / 3)};
  }
};

}  // namespace

void read_gltf(std::string_view bytes, ModelFiles& files, Model& model) {
  if (bytes.starts_with("glTF") && bytes.substr(4, 1) != "\2") model.fail("glTF of version 2", "another");
  const auto [json, binary] = parts_of(bytes);
  const nlohmann::json document = parse_json(model.name, json);
  GltfReader{document, binary, files, model}.read();
}

}  // namespace pipeline
