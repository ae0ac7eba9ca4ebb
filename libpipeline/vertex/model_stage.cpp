#include "libpipeline/vertex/model_stage.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/triangle_reader.h"

namespace pipeline {

namespace {

/// The vector from a to b, scaled by a power of two to a largest coordinate in [1, 2).
Vec3 scaled_edge(const Vec3& a, const Vec3& b) {
  Vec3 edge = difference(b, a);
  if (!std::isfinite(largest_in(edge))) edge = difference(scaled(b, 0.5), scaled(a, 0.5));
  if (largest_in(edge) == 0) return edge;
  const int exponent = std::ilogb(largest_in(edge));
  return {std::scalbn(edge.x, -exponent), std::scalbn(edge.y, -exponent), std::scalbn(edge.z, -exponent)};
}

/// The unit normal on the side from where the triangle is counterclockwise, 0 if it has no area. Edges may
/// have any length.
Vec3 unit_face_normal(const Triangle& p) {
  constexpr double kLeast = 0x1p-600, kMost = 0x1p1000;  // of products that are used as they are
  const Vec3 normal = face_normal(p);
  const double largest = largest_in(normal);  // but for nan, of products that both overflow
  if (largest > kLeast && largest < kMost && std::isfinite(normal.x + normal.y + normal.z))
    return unit_vector(normal);
  return unit_vector(cross(scaled_edge(p[0], p[1]), scaled_edge(p[0], p[2])));
}

}  // namespace

ModelStage::ModelStage(SceneReader& scene, std::uint64_t first_number, const SphereForm& spheres)
    : scene_(scene), refuses_spheres_(spheres.is_refused), next_number_(first_number) {
  if (spheres.belts) facets_.emplace(*spheres.belts);
  try {
    read_until_object();
  } catch (...) {
    deferred_error_.keep();
  }
}

/// The output's header needs the complete appearance.
void ModelStage::read_until_object() {
  while (!done_ && !first_object_) {
    const Command command = scene_.next();
    if (std::holds_alternative<TriangleCommand>(command) || std::holds_alternative<SphereCommand>(command)) {
      first_object_ = command;
    } else {
      carry_out(command);
    }
  }
}

Appearance ModelStage::appearance() const {
  Appearance appearance = scene_.appearance();
  appearance.lights = lights_;
  if (facets_) {
    if (!appearance.attributes) appearance.attributes = {{}, {}};
    appearance.attributes->value.normal = true;
  }
  return appearance;
}

/// The columns of the output triangles.
AttributeSet ModelStage::columns() const {
  AttributeSet columns = scene_.appearance().columns();
  columns.normal |= facets_.has_value();
  return columns;
}

bool ModelStage::read(TriangleBatch& batch) {
  const bool has_objects = deferred_error_.read(batch, [&] { fill(batch); });
  if (facets_) add_face_normals(batch);  // also of a batch that an error has ended
  return has_objects;
}

void ModelStage::transform(TriangleBatch& batch, CoordinateRounder& rounder) {
  if (!has_area_) look_for_area(batch);
  odd_transforms_.add(batch);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const auto& [first, world_from_model, world_normal_from_model] = runs_[i];
    const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : batch.object_count();
    if (world_normal_from_model) world_normal_from_model->apply(batch.attributes, first, end);
    world_from_model.apply(batch, first, end, rounder);
  }
}

/// Without a scale by 0, no triangle loses its area; under one, there is no sphere.
void ModelStage::look_for_area(const TriangleBatch& p_model) {
  has_area_ = !scale_by_0_ || !p_model.spheres.empty();
  for (std::size_t i = 0, run = 0; i < p_model.size() && !has_area_; ++i) {
    if (run + 1 < runs_.size() && runs_[run + 1].first <= i) ++run;
    has_area_ = !runs_[run].world_from_model.flattens(p_model.triangles[i]);
  }
}

void ModelStage::fill(TriangleBatch& batch) {
  keep_last_run();
  if (first_object_) add_object(*std::exchange(first_object_, std::nullopt), batch);
  while (!done_ && !first_object_) {
    if (faceted_) {
      if (batch.size() >= kBatchSize) break;
      add_facets(batch);
      continue;
    }
    if (batch.spheres.empty() && add_buffered(batch)) continue;
    // Triangles are passed on before the reader waits for more text.
    if (!batch.empty() && (batch.object_count() >= kBatchSize || !scene_.has_buffered_command())) break;
    const Command command = scene_.next();
    if (!batch.spheres.empty() && std::holds_alternative<TriangleCommand>(command))
      first_object_ = command;  // of the next batch
    else if (!add_object(command, batch))
      carry_out(command);
  }
}

/// Adds a triangle or a sphere; false for another command.
bool ModelStage::add_object(const Command& command, TriangleBatch& batch) {
  if (const auto* triangle = std::get_if<TriangleCommand>(&command))
    add(*triangle, batch);
  else if (const auto* sphere = std::get_if<SphereCommand>(&command))
    add(*sphere, batch);
  else
    return false;
  return true;
}

/// Adds triangles by the fast path; false if it finds none, or the batch is full.
bool ModelStage::add_buffered(TriangleBatch& batch) {
  constexpr std::size_t kMaxAtOnce = 24;
  const std::size_t old_size = batch.size();
  if (old_size >= kBatchSize) return false;
  std::size_t line = 0;
  const std::size_t limit = std::min(kBatchSize - old_size, kMaxAtOnce);
  const std::size_t count = scene_.read_buffered(limit, batch.triangles, batch.attributes, line);
  if (count == 0) return false;
  batch.complete(next_number_, line + 1);
  next_number_ += count;
  begin_run(old_size);
  return true;
}

/// Adds the triangle that the scene reader returned last.
// M6
void ModelStage::add(const TriangleCommand& triangle, TriangleBatch& batch) {
  begin_run(batch.size());
  batch.add(triangle.p_model, next_number_++, triangle.locations);
  const AttributeSet columns = scene_.appearance().columns();
  if (columns.any()) batch.attributes.add(scene_.lines(), columns);
}

/// Adds the sphere that the scene reader returned last, or has its facets come next.
// M10
void ModelStage::add(const SphereCommand& sphere, TriangleBatch& batch) {
  if (refuses_spheres_) throw refused_sphere(scene_.location());
  begin_run(batch.object_count());
  if (runs_.back().world_from_model.orientation() == 0)
    throw InputError(scene_.location(),
                     expected_but_found("transforms that leave a sphere its volume", "a scale by 0"));
  if (facets_) {
    faceted_ = sphere;
    next_facet_ = 0;
    return;
  }
  const auto& [c, r, location] = sphere;
  batch.spheres.push_back({.number = next_number_++,
                           .points = {c, {c.x + r, c.y, c.z}, {c.x, c.y + r, c.z}, {c.x, c.y, c.z + r}},
                           .locations = {location, location, location, location},
                           .material = scene_.lines().material});
  if (columns().color) batch.spheres.back().color = scene_.lines().vertices[0].color;
}

/// Adds facets of the sphere as long as there is room; all have its number. The outside of a mirrored sphere
/// stays the front.
void ModelStage::add_facets(TriangleBatch& batch) {
  const bool is_mirrored = runs_.back().world_from_model.orientation() < 0;
  const LineAndColumn location = faceted_->center_location;
  const std::uint64_t number = next_number_;
  add_face_normals(batch);
  TriangleLines lines = scene_.lines();
  for (; next_facet_ < facets_->size() && batch.size() < kBatchSize; ++next_facet_) {
    auto [corners, normals] = (*facets_)(*faceted_, next_facet_);
    if (is_mirrored) {
      std::swap(corners[1], corners[2]);
      std::swap(normals[1], normals[2]);
    }
    batch.add(corners, number, {location, location, location});
    for (std::size_t i = 0; i < 3; ++i) lines.vertices[i].normal = normals[i];
    batch.attributes.add(lines, columns());
  }
  if (next_facet_ < facets_->size()) return;
  faceted_.reset();
  ++next_number_;
}

/// Gives triangles without normals their face normal.
void ModelStage::add_face_normals(TriangleBatch& batch) const {
  for (std::size_t i = batch.attributes.normals.size(); i < batch.size(); ++i) {
    const Vec3 normal = unit_face_normal(batch.triangles[i]);
    batch.attributes.normals.push_back({normal, normal, normal});
  }
}

/// Carries out any command but a triangle or a sphere.
// M2, M5
void ModelStage::carry_out(const Command& command) {
  if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    odd_transforms_.add_transform(scene_.location());
    stack_.translate(translate->offset);
    is_matrix_new_ = true;
  } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
    const Vec3& factors = scale->factors;
    if (!scale_by_0_ && (factors.x == 0 || factors.y == 0 || factors.z == 0)) scale_by_0_ = scene_.location();
    odd_transforms_.add_transform(scene_.location());
    stack_.scale(factors);
    is_matrix_new_ = true;
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
    odd_transforms_.add(*rotate, scene_.location());
    stack_.multiply(rotation(rotate->angle_degrees, rotate->axis));
    is_matrix_new_ = true;
  } else if (std::holds_alternative<PushCommand>(command)) {
    push();
  } else if (std::holds_alternative<PopCommand>(command)) {
    pop();
  } else if (const auto* light = std::get_if<LightCommand>(&command)) {
    lights_.push_back(transformed(stack_.top(), light->light, uncertain_lights_));
  } else {
    done_ = std::holds_alternative<EndCommand>(command);
  }
}

/// The next batch begins with the matrix with which the last one ended.
void ModelStage::keep_last_run() {
  if (runs_.empty()) return;
  runs_.erase(runs_.begin(), runs_.end() - 1);
  runs_.front().first = 0;
}

/// From triangle `first` of the batch on, the matrix on top of the stack applies.
void ModelStage::begin_run(std::size_t first) {
  if (!is_matrix_new_) return;
  is_matrix_new_ = false;
  odd_transforms_.add_object();
  runs_.push_back({first, VertexTransform(stack_.top()), std::nullopt});
  if (columns().normal) runs_.back().world_normal_from_model.emplace(stack_.top());
}

void ModelStage::push() {
  if (stack_.push()) return odd_transforms_.add_push(scene_.location());
  throw InputError(scene_.location(),
                   expected_but_found("at most " + std::to_string(stack_.max_saved()) + " saved matrices",
                                      "another 'push' after a change"));
}

void ModelStage::pop() {
  if (!stack_.pop())
    throw InputError(scene_.location(),
                     expected_but_found("a matrix that 'push' has saved", "'pop' without one"));
  odd_transforms_.add_pop();
  is_matrix_new_ = true;
}

}  // namespace pipeline
