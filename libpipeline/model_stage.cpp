#include "libpipeline/model_stage.h"

#include <array>
#include <string>
#include <utility>

namespace pipeline {

ModelStage::ModelStage(SceneReader& scene, CoordinateRounder& rounder) : scene_(scene), rounder_(rounder) {
  try {
    read_until_triangle();
  } catch (...) {
    mistake_ = std::current_exception();
  }
}

/// The header of what is written has to be known before the first triangle is.
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

bool ModelStage::read(TriangleBatch& p_world) {
  p_world.clear();
  if (mistake_) std::rethrow_exception(mistake_);
  try {
    fill(p_world);
  } catch (...) {
    if (p_world.empty()) throw;
    mistake_ = std::current_exception();
  }
  return !p_world.empty();
}

void ModelStage::fill(TriangleBatch& p_world) {
  if (first_triangle_) add(*std::exchange(first_triangle_, std::nullopt), p_world);
  while (!done_) {
    // What is in memory is passed on before the reader waits for more.
    if (!p_world.empty() && (p_world.size() >= kBatchSize || !scene_.has_command_waiting())) break;
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      add(*triangle, p_world);
    } else {
      carry_out(command);
    }
  }
}

/// Carries out any command but a triangle.
void ModelStage::carry_out(const Command& command) {
  if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    multiply(translation(translate->offset));
  } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
    multiply(scaling(scale->factors));
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
    multiply(rotation(rotate->angle_degrees, rotate->axis));
  } else if (std::holds_alternative<PushCommand>(command)) {
    push();
  } else if (std::holds_alternative<PopCommand>(command)) {
    pop();
  } else if (const auto* light = std::get_if<LightCommand>(&command)) {
    lights_.push_back(transformed(stack_.top(), Placed<Light>{light->light, scene_.place()}));
  } else {
    done_ = std::holds_alternative<EndCommand>(command);
  }
}

void ModelStage::add(const TriangleCommand& command, TriangleBatch& p_world) {
  if (!world_from_model_) world_from_model_.emplace(stack_.top());
  p_world.add(command.p_model, next_number_++, command.lines);
  if (scene_.appearance().attributes) add_attributes(p_world);
  try {
    world_from_model_->apply(p_world, p_world.size() - 1, rounder_);
  } catch (...) {
    p_world.truncate(p_world.size() - 1);
    throw;
  }
}

/// Of the triangle that the scene has given out last.
void ModelStage::add_attributes(TriangleBatch& p_world) {
  const AttributeSet columns = scene_.appearance().columns();
  std::array<VertexLine, 3> vertices = scene_.vertices();
  if (columns.normal) {
    if (!world_normal_from_model_) world_normal_from_model_.emplace(stack_.top());
    for (VertexLine& vertex : vertices) vertex.normal = (*world_normal_from_model_)(vertex.normal);
  }
  p_world.attributes.add(vertices, columns);
}

/// What was made of the matrix that the stack had on top.
void ModelStage::forget_transforms() {
  world_from_model_.reset();
  world_normal_from_model_.reset();
}

void ModelStage::multiply(const AffineMatrix& t) {
  stack_.multiply(t);
  forget_transforms();
}

void ModelStage::push() {
  if (stack_.push()) return;
  throw InputError(scene_.place(),
                   expected_but_found("at most " + std::to_string(stack_.max_saved()) + " saved matrices",
                                      "another 'push' after a change"));
}

void ModelStage::pop() {
  if (!stack_.pop())
    throw InputError(scene_.place(),
                     expected_but_found("a matrix that 'push' has saved", "'pop' without one"));
  forget_transforms();
}

}  // namespace pipeline
