#include "libpipeline/vertex/model_stage.h"

#include <algorithm>
#include <string>
#include <utility>

#include "libpipeline/numbers/exact_sum.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/triangle_reader.h"

namespace pipeline {

namespace {

/// The unit normal on the side from which the triangle is counterclockwise; 0 if doubles do not keep eight
/// digits of it.
Vec3 face_normal_in_doubles(const Triangle& p) {
  const Vec3 b = difference(p[1], p[0]), c = difference(p[2], p[0]), normal = cross(b, c);
  const double size = largest_in(b) * largest_in(c);
  return size > 0x1p-900 && size < 0x1p900 && largest_in(normal) > 0x1p-20 * size ? unit_vector(normal)
                                                                                  : Vec3{};
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

/// Reads up to the first object: the output's header needs the complete appearance.
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
  if (facets_) batch.attributes.normals.resize(batch.size());  // even if an error has ended the batch
  return has_objects;
}

void ModelStage::transform(TriangleBatch& batch, CoordinateRounder& rounder) {
  if (!has_area_) look_for_area(batch);
  odd_transforms_.add(batch);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : batch.object_count();
    if (runs_[i].world_normal_from_model) transform_normals(batch, runs_[i], end, rounder);
    runs_[i].world_from_model.apply(batch, runs_[i].first, end, rounder);
  }
}

/// Transforms normals, or sets missing ones to the face's: in doubles or, if these lose digits, exactly.
void ModelStage::transform_normals(TriangleBatch& batch, const Run& run, std::size_t end,
                                   CoordinateRounder& rounder) const {
  const NormalTransform& transform = *run.world_normal_from_model;
  const bool in_doubles = !facets_ || transform.keeps_digits();
  const bool are_faces_without = facets_ && !scene_.appearance().columns().normal;
  auto& normals = batch.attributes.normals;
  if (in_doubles && are_faces_without)
    for (std::size_t i = run.first; i < end; ++i)
      if (normals[i][0] == Vec3{}) normals[i].fill(face_normal_in_doubles(batch.triangles[i]));
  if (in_doubles) transform.apply(batch.attributes, run.first, end);
  if (in_doubles && !are_faces_without) return;
  for (std::size_t i = run.first; i < end; ++i) {
    const bool is_face = are_faces_without && normals[i][0] == Vec3{};
    if (in_doubles && !is_face) continue;
    const BallVec3 face = is_face ? exact_face_normal(batch.triangles[i]) : BallVec3{};
    for (Vec3& normal : normals[i]) {
      const BallVec3 n = is_face ? face : to_balls(normal);
      normal = transform.image_in_balls(n);
      if (normal != Vec3{} || n == BallVec3{} || run.world_from_model.matrix().orientation == 0) continue;
      run.world_from_model.apply(batch, run.first, i, rounder);
      const SourceLocation location = rounder.location_of(batch.locations[i][0]);
      batch.truncate(i);
      throw InputError(location, "scales that leave a normal its digits",
                       "some that differ by more than 31 digits");
    }
  }
}

/// Without a scale by 0, no triangle loses its area; under one, no sphere is allowed.
void ModelStage::look_for_area(const TriangleBatch& p_model) {
  has_area_ = !scale_by_0_ || !p_model.spheres.empty();
  for (std::size_t i = 0, run = 0; i < p_model.size() && !has_area_; ++i) {
    if (run + 1 < runs_.size() && runs_[run + 1].first <= i) ++run;
    const NormalTransform transform(runs_[run].world_from_model.matrix());
    has_area_ = transform.image_in_balls(exact_face_normal(p_model.triangles[i])) != Vec3{};
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

/// Adds the sphere that the scene reader returned last, or makes its facets come next.
// M10
void ModelStage::add(const SphereCommand& sphere, TriangleBatch& batch) {
  if (refuses_spheres_) throw refused_sphere(scene_.location());
  begin_run(batch.object_count());
  if (runs_.back().world_from_model.matrix().orientation == 0)
    throw InputError(scene_.location(), "transforms that leave a sphere its volume", "a scale by 0");
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
/// remains its front.
void ModelStage::add_facets(TriangleBatch& batch) {
  const bool is_mirrored = runs_.back().world_from_model.matrix().orientation < 0;
  const LineAndColumn location = faceted_->center_location;
  const std::uint64_t number = next_number_;
  batch.attributes.normals.resize(batch.size());
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

/// Carries out any command but a triangle or a sphere.
// M2, M5
void ModelStage::carry_out(const Command& command) {
  if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    stack_.translate(translate->offset);
  } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
    const Vec3& factors = scale->factors;
    if (!scale_by_0_ && (factors.x == 0 || factors.y == 0 || factors.z == 0)) scale_by_0_ = scene_.location();
    stack_.scale(factors);
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
    odd_transforms_.add(*rotate, scene_.location());
    stack_.multiply(rotation(rotate->angle_degrees, rotate->axis));
  } else {
    if (std::holds_alternative<PushCommand>(command)) push();
    if (std::holds_alternative<PopCommand>(command)) pop();
    if (const auto* light = std::get_if<LightCommand>(&command))
      lights_.push_back(transformed(stack_.top(), light->light, uncertain_lights_));
    done_ = std::holds_alternative<EndCommand>(command);
    return;
  }
  odd_transforms_.add_transform(scene_.location());
  is_matrix_new_ = true;
}

/// Keeps the last run, whose matrix the next batch begins with.
void ModelStage::keep_last_run() {
  if (runs_.empty()) return;
  runs_.erase(runs_.begin(), runs_.end() - 1);
  runs_.front().first = 0;
}

/// Applies the matrix on top of the stack from triangle `first` of the batch on.
void ModelStage::begin_run(std::size_t first) {
  if (!is_matrix_new_) return;
  is_matrix_new_ = false;
  odd_transforms_.add_object();
  runs_.push_back({first, VertexTransform(stack_.top()), std::nullopt});
  if (columns().normal) runs_.back().world_normal_from_model.emplace(stack_.top());
}

void ModelStage::push() {
  if (stack_.push()) return odd_transforms_.add_push(scene_.location());
  throw InputError(scene_.location(), "at most " + std::to_string(stack_.max_saved()) + " saved matrices",
                   "another 'push' after a change");
}

void ModelStage::pop() {
  if (!stack_.pop())
    throw InputError(scene_.location(), "a matrix that 'push' has saved", "'pop' without one");
  odd_transforms_.add_pop();
  is_matrix_new_ = true;
}

}  // namespace pipeline
