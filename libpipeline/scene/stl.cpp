#include "libpipeline/scene/stl.h"

#include <numeric>

#include "libpipeline/scene/model_text.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

// 3D Systems, StereoLithography Interface Specification, 1989.

constexpr std::size_t kHeader = 84, kFacet = 50;  // bytes

std::uint64_t facet_count(std::string_view bytes) {
  return bytes.size() < kHeader ? 0 : number_in<std::uint32_t>(bytes.data() + kHeader - 4);
}

/// A binary file may begin with "solid", too, but its size follows from its count, or it has a zero byte.
bool is_text(std::string_view bytes) {
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return begin != std::string_view::npos && in_lower_case(bytes.substr(begin, 5)) == "solid" &&
         bytes.size() != kHeader + kFacet * facet_count(bytes) &&
         bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

void read_text(std::string_view bytes, Model& model) {
  ModelText text(model.name, bytes);
  std::size_t vertex_count = 0;
  bool is_complete = false;
  for (std::string_view word = text.word_of_any_line(); !word.empty(); word = text.word_of_any_line()) {
    const std::string lower = word.front() < 'a' ? in_lower_case(word) : std::string();
    const std::string_view keyword = lower.empty() ? word : lower;
    if (keyword == "solid" || keyword == "endsolid") {
      is_complete = keyword != "solid";
      const std::string name(text.rest_of_line());
      if (!is_complete) model.add_mesh(name);
    } else if (keyword == "vertex") {
      Vec3 p;
      for (double* x : {&p.x, &p.y, &p.z}) *x = text.number(text.word_of_any_line(), "a coordinate");
      model.meshes.back().corners.push_back(static_cast<std::uint32_t>(model.points.size()));
      model.points.push_back(p);
      if (++vertex_count > 3) text.fail(word, "endloop after three vertices");
    } else if (keyword == "endfacet" || keyword == "facet") {
      if (vertex_count != (keyword == "facet" ? 0 : 3)) text.fail(word, "vertices of a triangle");
      vertex_count = 0;
      if (keyword == "endfacet") continue;
      const std::string_view normal = text.word();  // unused
      if (!normal.empty() && in_lower_case(normal) != "normal") text.fail(normal, "normal");
      for (int i = 0; i < 3; ++i) text.word();
    } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop") {
      text.fail(word, "facet, outer loop, vertex, endloop, endfacet or endsolid");
    }
  }
  if (vertex_count != 0 || !is_complete) text.fail(text.word_of_any_line(), "endsolid");
}

/// The color in the two bytes after a facet. VisCAM sets the highest bit if there is a color; Magics, whose
/// header gives the object's color, clears it then, and has red in the lowest bits.
Floats color_in(std::uint16_t bits, bool is_of_magics, const Floats& of_object) {
  if (is_of_magics ? bits == 0 || bits >= 0x8000 : bits < 0x8000) return of_object;
  const auto channel = [&](int shift) {
    return static_cast<float>(scene_channel((bits >> shift & 31) / 31.0, false));
  };
  return {channel(is_of_magics ? 0 : 10), channel(5), channel(is_of_magics ? 10 : 0)};
}

void read_binary(std::string_view bytes, Model& model) {
  if (bytes.size() < kHeader) model.fail("an STL file", counted(bytes.size(), "byte"));
  const std::uint64_t most = (bytes.size() - kHeader) / kFacet;
  std::uint64_t count = facet_count(bytes);
  if (count == 0 && most > 0) {
    count = most;
    model.note("its header announces 0 triangles, but it has data for " + counted(count, "triangle") +
               ": this data is drawn");
  }
  if (count < most)
    model.note("it has data for " + counted(most, "triangle") + ", but its header announces " +
               std::to_string(count) + ": the rest is not drawn");
  if (count > most)
    model.fail(counted(count, "triangle") + " in a binary STL file", std::to_string(most) + ": it is cut");
  const std::size_t place = bytes.substr(0, kHeader - 7).find("COLOR=");
  const bool is_of_magics = place != std::string_view::npos;
  Floats of_object = kNoColor;
  for (std::size_t i = 0; is_of_magics && i < 3; ++i)
    of_object[i] = static_cast<float>(static_cast<unsigned char>(bytes[place + 6 + i]));
  ModelMesh& mesh = model.add_mesh("");
  mesh.corners.resize(3 * count);
  std::iota(mesh.corners.begin(), mesh.corners.end(), 0);
  model.points.reserve(3 * count);
  mesh.has_colors = is_of_magics;
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* const facet = bytes.data() + kHeader + i * kFacet;
    for (std::size_t k = 12; k < 48; k += 12) {
      const auto p = number_in<Floats>(facet + k);
      model.points.push_back({p[0], p[1], p[2]});
    }
    const auto bits = number_in<std::uint16_t>(facet + 48);
    mesh.has_colors = mesh.has_colors || bits >= 0x8000;
    if (mesh.has_colors) {
      model.colors.resize(3 * i, kNoColor);
      model.colors.insert(model.colors.end(), 3, color_in(bits, is_of_magics, of_object));
    }
  }
}

}  // namespace

bool is_whole_binary_stl(std::string_view bytes) {
  return facet_count(bytes) > 0 && bytes.size() == kHeader + kFacet * facet_count(bytes);
}

bool is_stl(std::string_view bytes) {
  if (is_text(bytes)) return true;
  const std::uint64_t size = kHeader + kFacet * facet_count(bytes);
  // Bytes may follow the triangles, or the count may be 0.
  return bytes.size() >= kHeader && (size > kHeader ? size <= bytes.size() && bytes.size() < 2 * size
                                                    : (bytes.size() - kHeader) % kFacet == 0);
}

void read_stl(std::string_view bytes, Model& model) {
  is_text(bytes) ? read_text(bytes, model) : read_binary(bytes, model);
}

}  // namespace pipeline
