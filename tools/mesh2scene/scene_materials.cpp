#include "tools/mesh2scene/scene_materials.h"

#include <assimp/scene.h>

#include <algorithm>
#include <cmath>

#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/scene_text.h"

namespace pipeline {
namespace {

struct Factors {
  double ambient = 1;
  double diffuse = 1;
  double specular = 0.15;
  double shininess = 20;
};

/// From 0 to `most`; a number that is none is 0.
double clamped(double value, double most) {
  return value > 0 ? std::min(value, most) : 0;
}

/// Three decimals are finer than a picture shows, and hide that files hold floats.
std::string text_of(const Factors& factors) {
  std::string text;
  for (const double factor : {factors.ambient, factors.diffuse, factors.specular})
    text += shortest_text(std::round(factor * 1000) / 1000) + " ";
  return text + shortest_text(std::round(factors.shininess));
}

constexpr double kMaxShininess = 10000;

/// Sets the factors by metallic and roughness factors; false if the material has none.
bool set_by_roughness(const aiMaterial& material, Factors& factors) {
  ai_real metallic = 1, roughness = 1;
  const bool has_metallic = material.Get(AI_MATKEY_METALLIC_FACTOR, metallic) == aiReturn_SUCCESS;
  const bool has_roughness = material.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == aiReturn_SUCCESS;
  if (!has_metallic && !has_roughness) return false;
  aiColor3D base(1, 1, 1);
  if (material.Get(AI_MATKEY_BASE_COLOR, base) != aiReturn_SUCCESS)
    material.Get(AI_MATKEY_COLOR_DIFFUSE, base);
  const double metal = clamped(metallic, 1);
  const double a = std::pow(clamped(roughness, 1), 2);
  const double brightest = clamped(std::max({base.r, base.g, base.b}), 1);
  factors.shininess = std::clamp(2 / (a * a) - 2, 1.0, kMaxShininess);
  factors.specular = clamped((0.04 + metal * (brightest - 0.04)) * (factors.shininess + 2) / 8, 1);
  factors.diffuse = 1 - metal / 2;
  return true;
}

/// Sets the factors by colors. Formats without them, and files that leave them out, are read as 0: an ambient
/// color of 0 is taken for the diffuse one, and a specular color of 0 without a shininess for none given.
void set_by_colors(const aiMaterial& material, Factors& factors) {
  const auto brightness = [&](const char* key, unsigned type, unsigned index) {
    aiColor3D color(0, 0, 0);
    material.Get(key, type, index, color);
    return clamped(std::max({color.r, color.g, color.b}), 1);
  };
  const double ambient = brightness(AI_MATKEY_COLOR_AMBIENT);
  const double diffuse = brightness(AI_MATKEY_COLOR_DIFFUSE);
  const double specular = brightness(AI_MATKEY_COLOR_SPECULAR);
  ai_real shininess = 0, strength = 1;
  material.Get(AI_MATKEY_SHININESS, shininess);
  material.Get(AI_MATKEY_SHININESS_STRENGTH, strength);
  if (ambient > 0 && diffuse > 0) factors.ambient = clamped(ambient / diffuse, 1);
  if (specular == 0 && !(shininess > 0)) return;
  factors.specular = specular * clamped(strength, 1);
  if (shininess > 0) factors.shininess = std::clamp(double{shininess}, 1.0, kMaxShininess);
}

std::string line_of(const aiMaterial* material) {
  Factors factors;
  if (material != nullptr && !set_by_roughness(*material, factors)) set_by_colors(*material, factors);
  return text_of(factors);
}

}  // namespace

SceneMaterials::SceneMaterials(const ImportedModel& model, const SceneSetting& setting)
    : model_(model), setting_(setting), have_paints_(setting.has_one_color || !model.has_vertex_colors()) {
  number_all();
  if (!have_paints_ || !are_too_many_) return;
  have_paints_ = are_too_many_ = false;
  lines_.clear();
  numbers_.clear();
  number_all();
}

void SceneMaterials::number_all() {
  for (const PlacedMesh& placed : model_.meshes()) {
    const aiMaterial* const material = model_.material(*placed.mesh);
    if (numbers_.contains(material)) continue;
    std::string line = "material " + line_of(material);
    if (have_paints_) line += "\npaint " + text_of(color_of(*placed.mesh));
    const auto number = static_cast<std::size_t>(std::ranges::find(lines_, line) - lines_.begin());
    if (number == lines_.size() && number == kMaxCount) {
      are_too_many_ = true;
      numbers_[material] = 0;
      continue;
    }
    if (number == lines_.size()) lines_.push_back(line);
    numbers_[material] = number;
  }
}

std::size_t SceneMaterials::number_of(const aiMesh& mesh) const {
  return numbers_.at(model_.material(mesh));
}

Vec3 SceneMaterials::color_of(const aiMesh& mesh) const {
  return setting_.has_one_color ? setting_.color : model_.color(mesh).value_or(setting_.color);
}

}  // namespace pipeline
