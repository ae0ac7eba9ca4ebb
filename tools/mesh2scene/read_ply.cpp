// PLY (G. Turk, The PLY polygon file format, 1994): a header of elements with properties, then their values,
// as text or binary in either order of bytes.

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "libpipeline/scene/model_text.h"
#include "libpipeline/scene/polygon.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/readers.h"

namespace pipeline {
namespace {

constexpr NumberType kInt8 = number_type<std::int8_t>(), kUint8 = number_type<std::uint8_t>(255),
                     kInt16 = number_type<std::int16_t>(), kUint16 = number_type<std::uint16_t>(65535),
                     kInt32 = number_type<std::int32_t>(), kUint32 = number_type<std::uint32_t>(),
                     kFloat = number_type<float>(), kDouble = number_type<double>();
const std::map<std::string_view, NumberType> kTypes = {
    {"char", kInt8},   {"int8", kInt8},     {"uchar", kUint8},   {"uint8", kUint8},
    {"short", kInt16}, {"int16", kInt16},   {"ushort", kUint16}, {"uint16", kUint16},
    {"int", kInt32},   {"int32", kInt32},   {"uint", kUint32},   {"uint32", kUint32},
    {"float", kFloat}, {"float32", kFloat}, {"double", kDouble}, {"float64", kDouble}};

/// The meaning of a property: the place of its value in a record.
enum Slot : std::size_t { kX, kNormal = 3, kRed = 6, kAlpha = 9, kIndices, kUnused, kSlotCount };

Slot slot_of(std::string_view name, bool is_list) {
  constexpr std::array<std::string_view, 17> kNames = {
      "x",     "y", "z", "nx", "ny", "nz",          "red",           "green",       "blue",
      "alpha", "r", "g", "b",  "a",  "diffuse_red", "diffuse_green", "diffuse_blue"};
  if (is_list) return name == "vertex_indices" || name == "vertex_index" ? kIndices : kUnused;
  const auto found = static_cast<std::size_t>(std::ranges::find(kNames, name) - kNames.begin());
  return static_cast<Slot>(found < 10 ? found : found < 14 ? found - 4 : found < 17 ? found - 8 : kUnused);
}

struct Property {
  NumberType type;
  std::optional<NumberType> count_type;  // of a list
  Slot slot;
};

struct Element {
  std::string_view name;
  std::uint64_t count;
  std::vector<Property> properties{};
  std::array<double, kSlotCount> full{};  // the value for white; 0 if no property has this slot

  /// Of the three slots from `first` on, the count of those with a property.
  [[nodiscard]] int count_of_three(std::size_t first) const {
    return (full[first] > 0) + (full[first + 1] > 0) + (full[first + 2] > 0);
  }
};

struct PlyReader {
  static constexpr auto kRestart = std::numeric_limits<std::uint32_t>::max();  // ends a strip in a list
  ModelText text_;
  Model& model_;
  ModelMesh& mesh_ = model_.add_mesh("");
  bool is_text_ = true, is_big_endian_ = false;
  std::optional<std::size_t> vertex_count_{};  // in the file; points may have copies for colors of faces
  double full_color_ = 1;
  std::vector<Element> elements_{};
  std::vector<Floats> normals_{};
  // The record being read:
  std::string_view word_{};
  std::array<double, kSlotCount> record_{};
  std::vector<std::uint32_t> indices_{};

  void read() {
    read_header();
    const ModelText begin = text_;
    const auto vertices = std::ranges::find(elements_, "vertex", &Element::name);
    if (vertices == elements_.end()) model_.fail("an element vertex", "none");
    for (auto e = elements_.begin(); e != vertices; ++e) read_records(*e, [] {});
    read_vertices(*vertices);
    // Faces before the vertices are read after them.
    if (vertices == elements_.begin())
      vertices->count = 0;
    else
      text_ = begin;
    for (const Element& e : elements_)
      if (e.name == "face" || e.name == "tristrips")
        read_faces(e);
      else
        read_records(e, [] {});
    if (is_text_ ? !text_.word_of_any_line().empty() : !text_.rest().empty())
      model_.note("more follows its last element: left out");
    if (!model_.colors.empty()) scale_colors(model_, model_.colors, full_color_);
    mesh_.has_colors = !model_.colors.empty();
    for (const std::uint32_t corner : mesh_.corners)
      if (!normals_.empty()) mesh_.normals.push_back(normals_[corner]);
  }

  void read_header() {
    for (std::string_view word; word != "end_header";) {
      word = text_.word();
      if (word == "format") {
        const std::string_view form = text_.word();
        is_text_ = form == "ascii";
        is_big_endian_ = form == "binary_big_endian";
        if (!is_text_ && !is_big_endian_ && form != "binary_little_endian")
          text_.fail(form, "ascii, binary_little_endian or binary_big_endian");
      } else if (word == "element") {
        const std::string_view name = text_.word(), count = text_.word();
        elements_.push_back({name, 0});
        if (!parse_count(count, elements_.back().count)) text_.fail(count, "a count");
        if (name == "edge") model_.unheld.insert("points and lines");
      } else if (word == "property" && !elements_.empty()) {
        std::string_view type = text_.word();
        Property property = {};
        const bool is_list = type == "list";
        if (is_list) property.count_type = type_of(text_.word());
        property.type = type_of(is_list ? text_.word() : type);
        property.slot = slot_of(text_.word(), is_list);
        const std::string_view name = elements_.back().name;
        elements_.back().properties.push_back(property);
        elements_.back().full[property.slot] = property.type.full;
        if (property.slot == kIndices && name != "face" && name != "tristrips" && name != "edge")
          model_.unheld.insert("element " + pipeline::quoted(name));
      } else if (word == "comment" || word == "obj_info") {
        if (text_.rest_of_line().starts_with("TextureFile")) model_.unheld.insert("textures");
      } else if (word != "end_header" && word != "ply" && !word.empty()) {
        text_.fail(word, "element, property, comment or end_header");
      }
      if (!text_.next_line() && word != "end_header") text_.fail(text_.rest(), "end_header");
    }
  }

  NumberType type_of(std::string_view word) const {
    const auto found = kTypes.find(word);
    if (found == kTypes.end()) text_.fail(word, "a type of PLY, such as float, uchar or int");
    return found->second;
  }

  [[noreturn]] void fail(const std::string& expected, double found) const {
    if (is_text_) text_.fail(word_, expected);
    model_.fail(expected + " at byte " + std::to_string(text_.offset()), shortest_text(found));
  }

  /// The next value; NaN if it is neither a number nor needed.
  double next(const NumberType& type, bool is_needed) {
    if (is_text_) {
      word_ = text_.word_of_any_line();
      return is_needed || word_.empty() ? text_.number(word_, "a number") : text_.number_or_nan(word_);
    }
    const std::string_view bytes = text_.rest();
    const std::size_t size = type.size;
    if (bytes.size() < size)
      model_.fail("more values at byte " + std::to_string(text_.offset()), "the end of the file: it is cut");
    text_.skip(size);
    if (!is_big_endian_) return type.value(bytes.data());
    std::array<char, 8> reversed{};
    std::reverse_copy(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size), reversed.begin());
    return type.value(reversed.data());
  }

  /// Reads all records of an element, and calls `visit` after each.
  template <typename Visit>
  void read_records(const Element& element, const Visit& visit) {
    std::size_t least = 0;
    for (const Property& p : element.properties) least += is_text_ ? 2 : p.count_type.value_or(p.type).size;
    if (least == 0) return;
    // Otherwise, a file of one line could ask for gigabytes.
    if (element.count > (text_.rest().size() + 1) / least)
      model_.fail(std::to_string(element.count) + " of element " + pipeline::quoted(element.name),
                  "the end of the file: it is cut");
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const Property& p : element.properties)
        if (p.count_type)
          read_list(p, element.name == "tristrips");
        else
          record_[p.slot] = next(p.type, p.slot < kNormal);
      if (is_text_ && !text_.rest().starts_with('\n') && !(word_ = text_.word()).empty())
        text_.fail(word_, "the end of the line");
      visit();
    }
  }

  void read_list(const Property& p, bool may_restart) {
    const double count = next(*p.count_type, true);
    if (!(count >= 0 && count < 0x1p53) || count != std::floor(count)) fail("a count", count);
    const bool are_indices = p.slot == kIndices && vertex_count_;
    if (are_indices) indices_.clear();
    for (auto left = static_cast<std::uint64_t>(count); left > 0; --left) {
      const double index = next(p.type, are_indices);
      if (!are_indices) continue;
      const bool is_restart = may_restart && (index == -1 || index == kRestart);
      const bool is_index =
          index >= 0 && index < static_cast<double>(*vertex_count_) && index == std::floor(index);
      if (!is_index && !is_restart) fail("the index of a vertex", index);
      indices_.push_back(is_restart ? kRestart : static_cast<std::uint32_t>(index));
    }
  }

  [[nodiscard]] Vec3 three(Slot first) const {
    return {record_[first], record_[first + 1], record_[first + 2]};
  }

  /// True if an element has colors; sets the value that is full.
  bool find_colors(const Element& element) {
    const int count = element.count_of_three(kRed);
    if (count == 1 || count == 2) model_.note(kPartlyColored);
    if (count == 3) full_color_ = element.full[kRed];
    return count == 3;
  }

  void read_vertices(const Element& element) {
    if (element.count_of_three(kX) < 3) model_.fail("the properties x, y and z of element vertex", "others");
    const bool has_normals = element.count_of_three(kNormal) == 3, has_colors = find_colors(element);
    read_records(element, [&] {
      model_.points.push_back(three(kX));
      if (has_normals) normals_.push_back(floats(three(kNormal)));
      if (has_colors) model_.colors.push_back(file_color(three(kRed)));
      if (record_[kAlpha] < element.full[kAlpha]) model_.unheld.insert("transparency");
    });
    vertex_count_ = model_.points.size();
  }

  /// Reads faces, or strips, which become faces of three corners.
  void read_faces(const Element& element) {
    const bool are_strips = element.name == "tristrips";
    const bool has_colors = model_.colors.empty() && find_colors(element);
    read_records(element, [&] {
      if (has_colors) color_corners();
      std::span<const std::uint32_t> rest = indices_;
      if (!are_strips) add_face();
      while (are_strips && !rest.empty()) {
        const auto size = static_cast<std::size_t>(std::ranges::find(rest, kRestart) - rest.begin());
        append_strip(rest.first(size), false, mesh_.corners);
        rest = rest.subspan(std::min(size + 1, rest.size()));
      }
      indices_.clear();
    });
  }

  void add_face() {
    if (indices_.size() > 3) {
      std::vector<Vec3> polygon;
      std::vector<std::uint32_t> triangles;
      for (const std::uint32_t i : indices_) polygon.push_back(model_.points[i]);
      if (!append_triangles(polygon, triangles)) fail(kPolygon, static_cast<double>(indices_.size()));
      for (std::uint32_t& i : triangles) i = indices_[i];
      indices_ = triangles;
    }
    if (indices_.size() >= 3)
      mesh_.corners.insert(mesh_.corners.end(), indices_.begin(), indices_.end());
    else if (!indices_.empty())
      model_.unheld.insert("points and lines");
  }

  /// Replaces the corners of a face by copies with its color.
  void color_corners() {
    for (std::uint32_t& index : indices_) {
      if (index == kRestart) continue;
      const Vec3 p = model_.points[index];
      if (!normals_.empty()) normals_.push_back(Floats(normals_[index]));
      model_.colors.resize(model_.points.size(), kNoColor);
      model_.colors.push_back(file_color(three(kRed)));
      index = static_cast<std::uint32_t>(model_.points.size());
      model_.points.push_back(p);
    }
  }
};

}  // namespace

void read_ply(std::string_view bytes, Model& model) {
  PlyReader{{model.name, bytes}, model}.read();
}

}  // namespace pipeline
