#include "libpipeline/model_stage.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pipeline {

ModelStage::ModelStage(SceneReader& scene) : scene_(scene) {
  try {
    read_until_triangle();
  } catch (...) {
    mistake_.keep();
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

bool ModelStage::read(TriangleBatch& batch) {
  return mistake_.read(batch, [&] { fill(batch); });
}

bool ModelStage::take_part(std::size_t size, TrianglePart& part, TriangleBatch& batch) {
  batch.clear();
  if (first_triangle_ || done_ || mistake_.is_kept() || !scene_.take_part(size, part)) return false;
  set_transform(batch);
  return true;
}

void ModelStage::pass(const TrianglePlace& place) {
  scene_.pass_lines(place.line_count);
  next_number_ = place.number;
}

void ModelStage::fill(TriangleBatch& batch) {
  if (first_triangle_) add(*std::exchange(first_triangle_, std::nullopt), batch);
  while (!done_) {
    if (add_waiting(batch)) continue;
    // What is in memory is passed on before the reader waits for more.
    if (!batch.empty() && (batch.size() >= kBatchSize || !scene_.has_command_waiting())) break;
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      add(*triangle, batch);
    } else {
      carry_out(command);
    }
  }
}

/// Carries out any command but a triangle.
void ModelStage::carry_out(const Command& command) {
  if (const auto* translate = std::get_if<TranslateCommand>(&command)) {
    stack_.translate(translate->offset);
    transform_.reset();
  } else if (const auto* scale = std::get_if<ScaleCommand>(&command)) {
    stack_.scale(scale->factors);
    transform_.reset();
  } else if (const auto* rotate = std::get_if<RotateCommand>(&command)) {
    stack_.multiply(rotation(rotate->angle_degrees, rotate->axis));
    transform_.reset();
  } else if (std::holds_alternative<PushCommand>(command)) {
    push();
  } else if (std::holds_alternative<PopCommand>(command)) {
    pop();
  } else if (const auto* light = std::get_if<LightCommand>(&command)) {
    lights_.push_back(transformed(stack_.top(), light->light));
  } else {
    done_ = std::holds_alternative<EndCommand>(command);
  }
}

/// The matrix that holds for the triangles which follow in the batch.
void ModelStage::set_transform(TriangleBatch& batch) {
  if (transform_ == nullptr)
    transform_ = std::make_shared<ModelTransform>(stack_.top(), scene_.appearance().columns().normal);
  if (batch.pending_transforms.empty() || batch.pending_transforms.back().transform != transform_)
    batch.pending_transforms.push_back({batch.size(), transform_});
}

/// Adds triangles by the fast path, as many as there are; false if there is none.
bool ModelStage::add_waiting(TriangleBatch& batch) {
  std::size_t line = 0;
  const auto triangles = scene_.waiting_triangles(kBatchSize - std::min(batch.size(), kBatchSize), line);
  if (triangles.empty()) return false;
  set_transform(batch);
  for (const Triangle& triangle : triangles) {
    batch.add(triangle, next_number_++, {line + 1, line + 2, line + 3});
    line += 4;
  }
  return true;
}

/// Adds the triangle that the scene has given out last.
void ModelStage::add(const TriangleCommand& command, TriangleBatch& batch) {
  set_transform(batch);
  batch.add(command.p_model, next_number_++, command.places);
  const AttributeSet columns = scene_.appearance().columns();
  if (columns.any()) batch.attributes.add(scene_.vertices(), columns);
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
  transform_.reset();
}

}  // namespace pipeline
