#include "libpipeline/vertex/model_stage.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

namespace pipeline {

ModelStage::ModelStage(SceneReader& scene, std::uint64_t first_number)
    : scene_(scene), next_number_(first_number) {
  try {
    read_until_triangle();
  } catch (...) {
    deferred_error_.keep();
  }
}

/// The output's header needs the complete appearance.
void ModelStage::read_until_triangle() {
  while (!done_ && !first_triangle_) {
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      first_triangle_ = *triangle;
    } else {
      carry_out(command);
    }
  }
}

Appearance ModelStage::appearance() const {
  Appearance appearance = scene_.appearance();
  appearance.lights = lights_;
  return appearance;
}

bool ModelStage::read(TriangleBatch& batch) {
  return deferred_error_.read(batch, [&] { fill(batch); });
}

void ModelStage::transform(TriangleBatch& batch, CoordinateRounder& rounder) {
  if (!has_area_) look_for_area(batch);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const auto& [first, world_from_model, world_normal_from_model] = runs_[i];
    const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first : batch.size();
    if (world_normal_from_model)
      for (auto& normals : std::span(batch.attributes.normals).subspan(first, end - first))
        for (Vec3& normal : normals) normal = (*world_normal_from_model)(normal);
    world_from_model.apply(batch, first, end, rounder);
  }
}

/// Without a scale by 0, no triangle loses its area.
void ModelStage::look_for_area(const TriangleBatch& p_model) {
  has_area_ = !scale_by_0_;
  for (std::size_t i = 0, run = 0; i < p_model.size() && !has_area_; ++i) {
    if (run + 1 < runs_.size() && runs_[run + 1].first <= i) ++run;
    has_area_ = !runs_[run].world_from_model.flattens(p_model.triangles[i]);
  }
}

void ModelStage::fill(TriangleBatch& batch) {
  keep_last_run();
  if (first_triangle_) add(*std::exchange(first_triangle_, std::nullopt), batch);
  while (!done_) {
    if (add_buffered(batch)) continue;
    // Triangles are passed on before the reader waits for more text.
    if (!batch.empty() && (batch.size() >= kBatchSize || !scene_.has_buffered_command())) break;
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      add(*triangle, batch);
    } else {
      carry_out(command);
    }
  }
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
void ModelStage::add(const TriangleCommand& triangle, TriangleBatch& batch) {
  begin_run(batch.size());
  batch.add(triangle.p_model, next_number_++, triangle.locations);
  const AttributeSet columns = scene_.appearance().columns();
  if (columns.any()) batch.attributes.add(scene_.vertices(), columns);
}

/// Carries out any command but a triangle.
void ModelStage::carry_out(const Command& command) {
  if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    stack_.translate(translate->offset);
    is_matrix_new_ = true;
  } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
    const Vec3& factors = scale->factors;
    if (!scale_by_0_ && (factors.x == 0 || factors.y == 0 || factors.z == 0)) scale_by_0_ = scene_.location();
    stack_.scale(factors);
    is_matrix_new_ = true;
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
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
  runs_.push_back({first, VertexTransform(stack_.top()), std::nullopt});
  if (scene_.appearance().columns().normal) runs_.back().world_normal_from_model.emplace(stack_.top());
}

void ModelStage::push() {
  if (stack_.push()) return;
  throw InputError(scene_.location(),
                   expected_but_found("at most " + std::to_string(stack_.max_saved()) + " saved matrices",
                                      "another 'push' after a change"));
}

void ModelStage::pop() {
  if (!stack_.pop())
    throw InputError(scene_.location(),
                     expected_but_found("a matrix that 'push' has saved", "'pop' without one"));
  is_matrix_new_ = true;
}

}  // namespace pipeline
