// OBJ and its materials, MTL (Wavefront, Object files and Material library file, 1995).

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "libpipeline/scene/model_text.h"
#include "libpipeline/scene/polygon.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "tools/mesh2scene/readers.h"

namespace pipeline {
namespace {

/// The numbers of materials, by name; none for a material that is used, but not read yet.
using Materials = std::map<std::string, std::optional<std::size_t>, std::less<>>;

/// The brightest channel of a color; 0 for black or kNoColor.
float brightest(const Floats& color) {
  return std::max({0.0F, color[0], color[1], color[2]});
}

/// Reads a library, and adds its materials to the model's.
struct MtlReader {
  const std::string& name_;
  ModelText text_;
  Model& model_;
  Materials& numbers_;
  std::vector<Floats> colors_{};  // of the library's materials
  // The material being read:
  std::string current_{};
  Floats diffuse_ = kNoColor, ambient_ = kNoColor, specular_ = kNoColor, emitted_ = kNoColor;
  double shininess_ = 0;
  bool is_textured_ = false;

  void read() {
    for (bool is_there = true; is_there; is_there = text_.next_line()) {
      const std::string_view word = text_.word();
      if (word == "newmtl") {
        finish();
        current_ = std::string(text_.rest_of_line());
      } else if (word == "Kd" || word == "Ka" || word == "Ks" || word == "Ke") {
        (word == "Kd" ? diffuse_ : word == "Ka" ? ambient_ : word == "Ks" ? specular_ : emitted_) = color();
      } else if (word == "Ns") {
        shininess_ = text_.number_or_nan(text_.word());
      } else if (word == "d" || word == "Tr") {
        const std::string_view value = text_.word();
        const double opacity = value == "-halo" ? 1 : text_.number_or_nan(value);
        if (word == "d" ? opacity < 1 : opacity > 0) model_.unheld.insert("transparency");
      } else if (word.starts_with("map_")) {
        is_textured_ = is_textured_ || word == "map_Kd";
        model_.unheld.insert("textures");
      }
    }
    finish();
    scale_colors(model_, colors_, 1);
    const std::size_t first = model_.materials.size() - colors_.size();
    for (std::size_t i = 0; i < colors_.size(); ++i)
      if (const auto [red, green, blue] = colors_[i]; !std::isnan(red))
        model_.materials[first + i].color = Vec3{red, green, blue};
  }

  /// The color of a line with three numbers, or with one for all channels.
  Floats color() {
    std::string_view word = text_.word();
    if (word == "spectral" || word == "xyz") {
      model_.notes.push_back(name_ + ": colors as " + std::string(word) + " are not read: left out");
      return kNoColor;
    }
    std::array<double, 3> channels{};
    for (std::size_t i = 0; i < 3; ++i, word = text_.word())
      channels[i] = i > 0 && word.empty() ? channels[0] : text_.number_or_nan(word);
    return file_color({channels[0], channels[1], channels[2]});
  }

  void finish() {
    if (!current_.empty()) {
      ModelMaterial material;
      // Missing values read as 0: for an ambient color of 0, the diffuse color is taken; a specular color of
      // 0 without a shininess counts as not given.
      const float ambient = brightest(ambient_), diffuse = brightest(diffuse_);
      if (ambient > 0 && diffuse > 0) material.ambient = fraction(fraction(ambient) / fraction(diffuse));
      if (brightest(specular_) > 0 || shininess_ > 0) material.specular = fraction(brightest(specular_));
      if (shininess_ > 0) material.shininess = std::clamp(shininess_, 1.0, 10000.0);
      // A black material with a texture or emitted light did not look black to its author.
      const bool is_black = !(brightest(diffuse_) > 0);
      for (float& channel : emitted_) channel = std::min(channel, 1.0F);  // light has no upper limit
      colors_.push_back(is_black && brightest(emitted_) > 0 ? emitted_
                        : is_black && is_textured_          ? kNoColor
                                                            : diffuse_);
      numbers_[current_] = model_.materials.size();
      model_.materials.push_back(material);
    }
    diffuse_ = ambient_ = specular_ = emitted_ = kNoColor;
    shininess_ = is_textured_ = 0;
  }
};

struct ObjReader {
  ModelText text_;
  ModelFiles& files_;
  Model& model_;
  std::vector<Floats> normals_{};
  std::set<const char*> libraries_{};  // that were read
  std::set<std::string> missing_{};    // named in notes
  bool lacks_library_ = false, is_open_ = false, has_early_faces_ = false;
  std::uint64_t surface_ = 1;
  std::string name_ = "defaultobject";
  Materials materials_{};
  Materials::iterator material_ = materials_.try_emplace("").first;
  std::vector<Materials::iterator> mesh_materials_{};
  // The face being read:
  std::vector<std::uint32_t> corners_{}, corner_normals_{}, triangles_{};
  std::vector<Vec3> polygon_{};

  void read() {
    for (bool is_there = true; is_there; is_there = text_.next_line()) {
      const std::string_view word = text_.word();
      if (word == "v")
        read_vertex();
      else if (word == "vn")
        read_normal();
      else if (word == "f" || word == "fo")
        read_face();
      else if (word == "l" || word == "p")
        model_.unheld.insert("points and lines");
      else if (word == "curv" || word == "curv2" || word == "surf")
        model_.unheld.insert("free-form curves and surfaces");
      else if (word == "call")
        model_.unheld.insert("calls of other files");
      else if (word == "s")
        surface_ = 0, is_open_ = false, parse_count(text_.word(), surface_);  // else off
      else if (word == "o" || word == "g")
        name_ = text_.rest_of_line(), is_open_ = false;
      else if (word == "usemtl")
        use(text_.rest_of_line());
      else if (word == "mtllib")
        read_libraries();
    }
    if (!model_.colors.empty()) {
      model_.colors.resize(model_.points.size(), kNoColor);
      if (std::ranges::any_of(model_.colors, [](const Floats& color) { return std::isnan(color[0]); }))
        model_.note(kPartlyColored);
      scale_colors(model_, model_.colors, 1);
      for (ModelMesh& mesh : model_.meshes) mesh.has_colors = true;
    }
    if (has_early_faces_ && !normals_.empty())
      model_.note("faces come before their normals, which are made anew");
    // The libraries of materials may be named anywhere.
    std::string missing;
    for (std::size_t i = 0; i < mesh_materials_.size(); ++i) {
      model_.meshes[i].material = mesh_materials_[i]->second;
      if (!mesh_materials_[i]->second) missing = mesh_materials_[i]->first;
    }
    if (!missing.empty() && !lacks_library_)
      model_.note("its material " + pipeline::quoted(missing) + " is missing: its faces get the usual color");
  }

  /// Reads x y z, perhaps a weight, and perhaps a color.
  void read_vertex() {
    std::array<std::string_view, 7> words;
    std::size_t count = 0;
    for (std::string_view w = text_.word(); !w.empty() && count < words.size(); w = text_.word())
      words[count++] = w;
    if (count < 3) text_.fail(text_.word(), "three coordinates");
    const auto coordinate = [&](std::size_t i) { return text_.number(words[i], "a coordinate"); };
    Vec3 p = {coordinate(0), coordinate(1), coordinate(2)};
    if (count == 4 || count == 7) {
      const double w = coordinate(3);
      if (w == 0) text_.fail(words[3], "a weight other than 0");
      p = {p.x / w, p.y / w, p.z / w};
    }
    if (count >= 6) {
      const auto channel = [&](std::size_t i) { return text_.number_or_nan(words[count - 3 + i]); };
      model_.colors.resize(model_.points.size(), kNoColor);
      model_.colors.push_back(file_color({channel(0), channel(1), channel(2)}));
    }
    model_.points.push_back(p);
  }

  void read_normal() {
    Vec3 n;
    for (double* x : {&n.x, &n.y, &n.z}) *x = text_.number_or_nan(text_.word());
    normals_.push_back(floats(n));
  }

  /// The index, from 0, that begins a word, below `count`; `word` keeps the characters after the number.
  [[gnu::always_inline]] std::uint32_t index(std::string_view& word, std::size_t count,
                                             const char* of_what) const {
    const std::string_view whole = word;
    const bool is_from_end = word.starts_with('-');
    if (is_from_end || word.starts_with('+')) word.remove_prefix(1);
    const std::size_t length = std::min(word.find_first_not_of("0123456789"), word.size());
    std::uint64_t number = 0;
    if (!parse_count(word.substr(0, length), number) || number == 0 || number > count)
      text_.fail(whole,
                 std::string("a ") + of_what + " from 1 to " + std::to_string(count) + ", or back from -1");
    word.remove_prefix(length);
    return static_cast<std::uint32_t>(is_from_end ? count - number : number - 1);
  }

  void read_face() {
    corners_.clear();
    corner_normals_.clear();
    polygon_.clear();
    for (std::string_view word = text_.word(); !word.empty(); word = text_.word()) {
      std::string_view rest = word;
      corners_.push_back(index(rest, model_.points.size(), "vertex"));
      polygon_.push_back(model_.points[corners_.back()]);
      if (!rest.empty() && rest.front() != '/')
        text_.fail(word, "a face's corner, such as 1, 1/2, 1//3 or 1/2/3");
      // A texture's index is not needed; a normal's is, if there are normals.
      std::string_view normal = rest.substr(std::min(rest.find('/', 1), rest.size() - 1) + 1);
      if (normal.empty()) continue;
      has_early_faces_ |= normals_.empty();
      if (!normals_.empty()) corner_normals_.push_back(index(normal, normals_.size(), "normal"));
    }
    if (corners_.size() < 3) {
      model_.unheld.insert("points and lines");
      return;
    }
    ModelMesh& mesh = current();
    triangles_.clear();
    if (!append_triangles(polygon_, triangles_)) text_.fail(text_.rest().substr(0, 0), kPolygon);
    const bool has_normals = corner_normals_.size() == corners_.size();
    // Corners without normals, before or after others with them, get 0, which makes them flat.
    if (has_normals) mesh.normals.resize(mesh.corners.size());
    for (const std::uint32_t i : triangles_) {
      mesh.corners.push_back(corners_[i]);
      if (has_normals || !mesh.normals.empty())
        mesh.normals.push_back(has_normals ? normals_[corner_normals_[i]] : Floats{});
    }
  }

  void use(std::string_view name) {
    if (material_->first == name) return;
    // A material after the first faces of a group begins a new mesh with the material's name.
    if (is_open_) name_ = name;
    is_open_ = false;
    material_ = materials_.try_emplace(std::string(name)).first;
  }

  ModelMesh& current() {
    if (!is_open_) mesh_materials_.push_back(material_), model_.add_mesh(name_).surface = surface_;
    is_open_ = true;
    return model_.meshes.back();
  }

  /// Reads the libraries that a line names: one, perhaps in quotes and with blanks, or several.
  void read_libraries() {
    std::string names(text_.rest_of_line());
    if (names.starts_with('"') && names.ends_with('"') && names.size() > 1)
      names = names.substr(1, names.size() - 2);
    if (read_library(names)) return;
    std::ranges::replace(names, '\\', '/');
    std::istringstream words(names);
    for (std::string name; words >> name;) {
      if (read_library(name)) continue;
      lacks_library_ = true;
      if (files_.refusal().empty() && missing_.insert(name).second)
        model_.note("its material file " + pipeline::quoted(name) + " is missing");
    }
  }

  bool read_library(const std::string& name) {
    const std::optional<std::string_view> bytes = files_.read(name);
    if (bytes && libraries_.insert(bytes->data()).second)
      MtlReader{name, {name, *bytes}, model_, materials_}.read();
    return bytes.has_value();
  }
};

}  // namespace

void read_obj(std::string_view bytes, ModelFiles& files, Model& model) {
  ObjReader{{model.name, bytes}, files, model}.read();
}

}  // namespace pipeline
