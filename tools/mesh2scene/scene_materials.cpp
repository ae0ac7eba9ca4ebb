#include "tools/mesh2scene/scene_materials.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/text/number_printer.h"
#include "tools/mesh2scene/scene_text.h"

namespace pipeline {

SceneMaterials::SceneMaterials(const Model& model, const SceneSetting& setting)
    : have_paints(setting.has_one_color || !model.has_vertex_colors()) {
  number_all(model, setting);
  if (!have_paints || !are_too_many) return;
  have_paints = are_too_many = false;
  lines.clear();
  numbers.clear();
  number_all(model, setting);
}

void SceneMaterials::number_all(const Model& model, const SceneSetting& setting) {
  for (const PlacedMesh& placed : model.placed) {
    const auto [known, is_new] = numbers.try_emplace(placed.mesh->material);
    if (!is_new) continue;
    const ModelMaterial material = model.material(*placed.mesh);
    std::string line = "material ";
    // Three decimals are finer than a picture shows, and hide that files hold floats.
    for (const double factor : {material.ambient, material.diffuse, material.specular})
      line += shortest_text(std::round(factor * 1000) / 1000) + " ";
    line += shortest_text(std::round(material.shininess));
    if (have_paints) line += "\npaint " + text_of(color_of(*placed.mesh, model, setting));
    const auto number = static_cast<std::size_t>(std::ranges::find(lines, line) - lines.begin());
    if (number < lines.size())
      known->second = number;
    else if (number == kMaxCount)
      are_too_many = true;
    else
      known->second = number, lines.push_back(line);
  }
}

Vec3 color_of(const ModelMesh& mesh, const Model& model, const SceneSetting& setting) {
  return setting.has_one_color ? setting.color : model.material(mesh).color.value_or(setting.color);
}

}  // namespace pipeline
