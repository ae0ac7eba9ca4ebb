#include <algorithm>
#include <array>

#include "libpipeline/scene/model_text.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/scene/stl.h"
#include "tools/mesh2scene/readers.h"

namespace pipeline {
namespace {

/// The cure for a format that assimp reads.
constexpr std::string_view kAssimp = "assimp export";

/// Formats that are not read: the first bytes in lower case, the name, and the cure.
constexpr std::array<std::array<std::string_view, 3>, 16> kOtherFormats = {{
    {"version https://git-lfs", "a Git LFS pointer, which stands for the model", "git lfs pull gets it"},
    {"\x1f\x8b", "a file packed by gzip", "zcat unpacks it"},
    {"\xff\xfe", "text in UTF-16", "iconv -f UTF-16 -t UTF-8 converts it"},
    {"\xfe\xff", "text in UTF-16", "iconv -f UTF-16 -t UTF-8 converts it"},
    {"<!doctype html", "a page of HTML in place of the file", ""},
    {"<html", "a page of HTML in place of the file", ""},
    {"\x89png", "a PNG picture", ""},
    {"\xff\xd8", "a JPEG picture", ""},
    {"iso-10303-21", "a STEP file", "a CAD program such as FreeCAD makes an STL file of it"},
    {"blender", "a Blender file", "Blender exports glTF"},
    {"pk\x03\x04", "3MF", kAssimp},
    {"kaydara fbx", "FBX", kAssimp},
    {"; fbx", "FBX", kAssimp},
    {"off", "OFF", kAssimp},
    {"#vrml", "VRML", kAssimp},
    {"<", "XML, such as COLLADA, X3D or AMF", kAssimp},
}};

/// True if the first word of the text is one of OBJ's.
bool is_obj(const std::string& name, std::string_view bytes) {
  constexpr std::array<std::string_view, 13> kWords = {"v",      "vn", "vt",     "vp", "f", "o",     "g",
                                                       "usemtl", "s",  "mtllib", "l",  "p", "cstype"};
  ModelText text(name, bytes);
  std::string_view word = text.word();
  while (word.empty() && text.next_line()) word = text.word();
  return std::ranges::find(kWords, word) != kWords.end();
}

}  // namespace

Model read_model(const std::string& path, ModelFiles& files, double crease_degrees) {
  Model model;
  model.name = path == "-" ? "<stdin>" : path;
  const std::string_view bytes = files.model();
  const std::string_view begin =
      bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf"), bytes.size()));
  const std::string name = in_lower_case(path);
  const auto refuse = [&, &file = model.name](std::string_view found, std::string_view cure) {
    std::string text = std::string(found) + (cure.empty() ? "" : ": ") + std::string(cure);
    if (cure == kAssimp)
      text += " " + file + " " + file.substr(0, file.rfind('.')) + ".glb converts it (Debian: assimp-utils)";
    model.fail("an OBJ, STL, PLY or glTF file", text);
  };
  const bool is_binary_stl = is_whole_binary_stl(bytes);  // even if its header begins with "solid"
  for (const auto& [known, what, cure] : kOtherFormats)
    if (!is_binary_stl && in_lower_case(begin.substr(0, known.size())) == known) {
      if (known.starts_with("pk") && !name.ends_with(".3mf")) refuse("a ZIP archive", "unzip unpacks it");
      refuse(what, cure);
    }
  const bool is_ply = begin.starts_with("ply"), is_gltf = bytes.starts_with("glTF") || begin.starts_with("{");
  if (is_binary_stl ||
      (!is_ply && !is_gltf && (is_stl(bytes) || (name.ends_with(".stl") && !is_obj(model.name, bytes)))))
    model.format = "STL", read_stl(bytes, model);
  else if (is_ply)
    model.format = "PLY", read_ply(bytes, model);
  else if (is_gltf)
    model.format = "glTF", read_gltf(bytes, files, model);
  else if (is_obj(model.name, bytes) || name.ends_with(".obj"))
    model.format = "OBJ", read_obj(bytes, files, model);
  else if (begin.empty() || name.ends_with(".py") || begin.starts_with("#!"))
    refuse(begin.empty() ? "an empty file" : "a program", "");
  else
    refuse("another, perhaps one that assimp reads", kAssimp);
  if (!files.refusal().empty()) model.note(files.refusal() + ": left out");
  complete(model);
  add_normals(model, crease_degrees);
  return model;
}

}  // namespace pipeline
