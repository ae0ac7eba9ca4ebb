#include "libpipeline/scene/model.h"

#include <cstdio>
#include <limits>
#include <stdexcept>

#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// Notes if a model is so far from the origin that the steps of its scene's float coordinates show.
void note_coarse_coordinates(Model& model) {
  constexpr double kFineEnough = 1e-4;  // of the model's extent: a tenth of a pixel if it has 1000
  BoundingBox box;
  for (const Vec3& p : model.points) box.add(Triangle{p, p, p});
  const double extent = largest_in(difference(box.high, box.low));
  const auto largest = static_cast<float>(std::max(largest_in(box.low), largest_in(box.high)));
  const double step = double{largest} - std::nextafter(largest, 0.0F);
  if (!(step > kFineEnough * extent) || extent == 0) return;
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "its coordinates, floats with steps of %.3g, are coarse for an extent of %.3g: move the model to "
      "the origin",
      step, extent);
  model.note(text.data());
}

void place(Model& model, const ModelNode& node, const NodeMatrix& model_from_parent) {
  const NodeMatrix model_from_node = product(model_from_parent, node.parent_from_node);
  for (const std::size_t index : node.meshes)
    if (const PlacedMesh placed = model.placed_mesh(index, model_from_node); !placed.shape->corners.empty())
      model.placed.push_back(placed);
  for (const ModelNode& child : node.children) place(model, child, model_from_node);
}

void check_positions(const Model& model) {
  for (const PlacedMesh& placed : model.placed)
    for (const std::uint32_t index : placed.shape->corners)
      if (!are_floats(placed.position(index)))
        model.fail("finite coordinates", "others in mesh " + pipeline::quoted(placed.mesh->name));
}

void note_unused_points(Model& model) {
  std::vector<bool> is_used(model.points.size());
  for (const ModelMesh& mesh : model.meshes)
    for (const std::uint32_t index : mesh.corners) is_used[index] = true;
  const auto count = static_cast<std::uint64_t>(std::ranges::count(is_used, true));
  if (2 * count < is_used.size())
    model.note("its triangles use " + std::to_string(count) + " of its " + std::to_string(is_used.size()) +
               " vertices: the others are not drawn");
}

}  // namespace

Vec3 NodeMatrix::normal(const Vec3& n) const {
  const Vec3 image = NodeMatrix{cross(y, z), cross(z, x), cross(x, y), {}}.direction(n);
  return mirrors() ? scaled(image, -1) : image;
}

bool are_floats(const Vec3& v) {
  return largest_in(v) <= std::numeric_limits<float>::max() && std::isfinite(v.x + v.y + v.z);
}

void Model::fail(const std::string& expected, const std::string& found) const {
  throw std::runtime_error(name + ": " + expected_but_found(expected, found));
}

ModelMesh& Model::add_mesh(const std::string& mesh_name) {
  root.meshes.push_back(meshes.size());
  return meshes.emplace_back(ModelMesh{.name = mesh_name.substr(0, kLongestName)});
}

std::uint64_t Model::triangle_count() const {
  std::uint64_t count = 0;
  for (const PlacedMesh& mesh : placed) count += mesh.shape->corners.size() / 3;
  return count;
}

bool Model::has_vertex_colors() const {
  return std::ranges::any_of(placed, [](const PlacedMesh& mesh) { return mesh.mesh->has_colors; });
}

bool Model::is_black() const {
  return std::ranges::all_of(placed, [&](const PlacedMesh& shown) {
    if (!shown.mesh->has_colors) return material(*shown.mesh).color == Vec3{};
    return std::ranges::all_of(shown.shape->corners, [&](auto i) { return color(i) == Floats{}; });
  });
}

Floats file_color(const Vec3& color) {
  const auto channel = [](double c) { return std::isfinite(c) ? c : -1; };
  return floats({channel(color.x), channel(color.y), channel(color.z)});
}

void scale_colors(Model& model, std::span<Floats> colors, double full, bool is_linear) {
  double largest = 0;
  bool has_odd = false;
  for (const Floats& color : colors)
    for (const float channel : color) {
      has_odd = has_odd || channel < 0;
      if (std::isfinite(channel)) largest = std::max(largest, double{channel} / full);
    }
  const bool are_bytes = largest > 2 && !is_linear;
  for (Floats& color : colors) {
    const bool is_none = !(std::min({color[0], color[1], color[2]}) >= 0);
    for (float& c : color)
      c = is_none ? NAN : static_cast<float>(scene_channel(c / full / (are_bytes ? 255 : 1), is_linear));
  }
  const std::string reach = "its colors reach to " + shortest_text(std::round(largest * 1000) / 1000);
  if (are_bytes) model.note(reach + ": 255 is taken for full, not 1");
  if (largest > 1.001 && !are_bytes) model.note(reach + ": they are drawn as 1, which is full");
  if (has_odd) model.note("it has colors that are negative or no numbers: they are left out");
}

double scene_channel(double channel, bool is_linear) {
  double value = fraction(channel);
  // Converts linear to sRGB (IEC 61966-2-1).
  if (is_linear) value = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
  // A thousandth of a level is finer than any file's steps, and hides that 77 / 255 is not a float.
  return std::round(1000 * 255 * value) / 1000;
}

void complete(Model& model) {
  note_coarse_coordinates(model);
  // In a scene, full intensity is 1; a file may count in candela.
  double brightest = 1;
  for (const ModelLight& light : model.lights) brightest = std::max(brightest, largest_in(light.intensity));
  for (ModelLight& light : model.lights) light.intensity = scaled(light.intensity, 1 / brightest);
  place(model, model.root, {});
  const auto& parts = model.unheld;
  if (model.placed.empty())
    model.fail("a model with triangles",
               parts.empty() ? "none" : "none, but " + listed({parts.begin(), parts.end()}));
  constexpr std::uint64_t kMost = 1'000'000'000;  // nested nodes may double it endlessly
  if (model.triangle_count() > kMost)
    model.fail("at most " + counted(kMost, "triangle"), std::to_string(model.triangle_count()));
  check_positions(model);
  note_unused_points(model);
}

}  // namespace pipeline
