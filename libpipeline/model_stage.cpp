#include "libpipeline/model_stage.h"

#include <string>

namespace pipeline {

ModelStage::ModelStage(SceneReader& scene, CoordinateRounder& rounder) : scene_(scene), rounder_(rounder) {}

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
  while (!done_) {
    // What is in memory is passed on before the reader waits for more.
    if (!p_world.empty() && (p_world.size() >= kBatchSize || !scene_.has_command_waiting())) break;
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      add(*triangle, p_world);
    } else if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
      multiply(translation(translate->offset));
    } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
      multiply(scaling(scale->factors));
    } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
      multiply(rotation(rotate->angle_degrees, rotate->axis));
    } else if (std::holds_alternative<PushCommand>(command)) {
      push();
    } else if (std::holds_alternative<PopCommand>(command)) {
      pop();
    } else {
      done_ = true;
    }
  }
}

void ModelStage::add(const TriangleCommand& command, TriangleBatch& p_world) {
  if (!world_from_model_) world_from_model_.emplace(stack_.top());
  p_world.add(command.p_model, next_number_++, command.lines);
  try {
    world_from_model_->apply(p_world, p_world.size() - 1, rounder_);
  } catch (...) {
    p_world.truncate(p_world.size() - 1);
    throw;
  }
}

void ModelStage::multiply(const AffineMatrix& t) {
  stack_.multiply(t);
  world_from_model_.reset();
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
  world_from_model_.reset();
}

}  // namespace pipeline
