#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "tools/mesh2scene/imported_model.h"
#include "tools/mesh2scene/scene_setting.h"

struct aiMaterial;

namespace pipeline {

/// The materials of a scene made from a model: each distinct one that a mesh has, in the order of the meshes.
/// They carry the colors of their meshes as paints, if all colors come from materials or the setting, and the
/// paints leave no more than kMaxCount.
///
/// A file's ambient, diffuse and specular colors become factors: a scene gives its color to the first two and
/// white to the third. The metallic and roughness factors of glTF become those of Blinn-Phong:
///   a = roughness^2, shininess = 2 / a^2 - 2 (B. Walter et al., "Microfacet models for refraction through
///   rough surfaces", 2007; B. Karis, "Real shading in Unreal Engine 4", 2013), from 1 to 10,000;
///   specular = f0 (shininess + 2) / 8, at most 1 (T. Akenine-Moeller et al., "Real-Time Rendering", 3rd ed.,
///   2008, 7.6), with the reflectance f0 = 0.04 + metallic (base color - 0.04);
///   diffuse = 1 - metallic / 2: a metal has none, but nothing is mirrored in it, and half of its color
///   stands for that.
class SceneMaterials {
 public:
  /// More than these are not kept: each one more has the number 0.
  static constexpr std::size_t kMaxCount = 256;

  SceneMaterials(const ImportedModel& model, const SceneSetting& setting);

  /// `material` and perhaps `paint`, for each material; at least one.
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }
  [[nodiscard]] std::size_t number_of(const aiMesh& mesh) const;
  /// The color of a mesh without vertex colors, from 0 to 255.
  [[nodiscard]] Vec3 color_of(const aiMesh& mesh) const;
  [[nodiscard]] bool have_paints() const { return have_paints_; }
  /// True if there were more than kMaxCount.
  [[nodiscard]] bool are_too_many() const { return are_too_many_; }

 private:
  void number_all();

  std::vector<std::string> lines_;
  std::map<const aiMaterial*, std::size_t> numbers_;  // null: the number of meshes without one
  const ImportedModel& model_;
  const SceneSetting& setting_;
  bool have_paints_;
  bool are_too_many_ = false;
};

}  // namespace pipeline
