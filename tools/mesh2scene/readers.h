#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libpipeline/scene/model.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// The files that a model may consist of: the model itself, and regular files in or below its folder. No step
/// of a path, neither `..` nor a link, may lead out of the folder. Nothing is written.
class ModelFiles {
 public:
  /// Reads a model and changes to the folder of `path`, as given; or reads standard input if `path` is "-",
  /// which has no folder and no other files. All files together may have at most `megabytes`, and none
  /// may be standard output or one of `written`.
  ModelFiles(const std::string& path, std::size_t megabytes, const std::vector<std::string>& written);

  [[nodiscard]] std::string_view model() const { return model_; }
  /// The bytes of the model and all other files that were read.
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The bytes of another file; nothing if it is not opened. If the path leads nowhere, its last part is
  /// tried in the model's folder. A UsageError if it is an output.
  std::optional<std::string_view> read(const std::string& file);
  /// Names the first file not opened because the model must not use it; empty if there is none.
  [[nodiscard]] std::string refusal() const;

 private:
  std::string_view content(int descriptor, const std::string& name);

  using Inode = std::pair<std::uint64_t, std::uint64_t>;  // and its device
  std::map<Inode, std::string> outputs_;
  std::map<Inode, TextWriter> contents_;  // which are never written
  std::string_view model_;
  std::string refused_;  // the file that refusal() names
  std::size_t megabytes_, size_ = 0;
  bool has_folder_ = false;
};

/// Reads a model file in the format that its first bytes show, whatever its name; makes missing normals.
/// Throws InputError or std::runtime_error, whose message names the file.
Model read_model(const std::string& path, ModelFiles& files, double crease_degrees);

/// Gives meshes without normals one for every corner: of length 1, or 0 in a flat mesh (surface 0) and where
/// no triangle has an area. Meshes of one surface are smoothed together.
/// A corner's normal is the mean over its neighbors: the triangles at its position whose normals differ from
/// its own triangle's by at most `crease_degrees`. A neighbor's weight is its angle there times the area of
/// all triangles in its plane there. If one plane has over 80 % of the neighbors' area, a corner whose
/// triangle is within half the crease of that plane takes its normal, and any other the mean without that
/// plane. Where more than 256 triangles meet, the rule is simpler (smooth_normals.cpp, kMany).
void add_normals(Model& model, double crease_degrees);

constexpr const char* kPartlyColored = "some of its vertices have no color: they get the color of their mesh";

// The readers of formats fill a model that has only its name.

void read_ply(std::string_view bytes, Model& model);
void read_obj(std::string_view bytes, ModelFiles& files, Model& model);
void read_gltf(std::string_view bytes, ModelFiles& files, Model& model);

}  // namespace pipeline
