#include "libpipeline/vertex/model_stage.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <utility>

namespace pipeline {
namespace {

/// Adds triangles by the fast path, as long as the batch has less than `most`; false if there is none.
bool add_buffered(SceneReader& scene, std::size_t most, std::uint64_t& next_number, TriangleBatch& batch) {
  constexpr std::size_t kMaxAtOnce = 64;
  const std::size_t old_size = batch.size();
  batch.triangles.resize(std::max(old_size, std::min(most, old_size + kMaxAtOnce)));
  std::size_t line = 0;
  const std::size_t count = scene.read_buffered(std::span(batch.triangles).subspan(old_size), line);
  batch.triangles.resize(old_size + count);
  batch.complete(next_number, line + 1);
  next_number += count;
  return count > 0;
}

/// Adds the triangle that the scene has given out last.
void add(const TriangleCommand& command, const SceneReader& scene, std::uint64_t& next_number,
         TriangleBatch& batch) {
  batch.add(command.p_model, next_number++, command.locations);
  const AttributeSet columns = scene.appearance().columns();
  if (columns.any()) batch.attributes.add(scene.vertices(), columns);
}

}  // namespace

ModelStage::ModelStage(SceneReader& scene) : scene_(scene) {
  try {
    read_until_triangle();
  } catch (...) {
    deferred_error_.keep();
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
  return deferred_error_.read(batch, [&] { fill(batch); });
}

bool ModelStage::take_part(std::size_t size, TextPart& part, TriangleBatch& batch) {
  batch.clear();
  if (first_triangle_ || done_ || deferred_error_.is_kept() || !scene_.take_part(size, part)) return false;
  set_transform(batch, 0);
  return true;
}

PartContents ModelStage::read_part(TextReader& part, TriangleBatch& batch) const {
  SceneReader scene(part, scene_);
  PartContents contents;
  try {
    for (;;) {
      if (add_buffered(scene, std::numeric_limits<std::size_t>::max(), contents.next_number, batch)) continue;
      if (!part.has_buffered_lines(1)) break;
      const Command command = scene.next();
      const auto* const triangle = std::get_if<TriangleCommand>(&command);
      if (triangle == nullptr) return {};
      add(*triangle, scene, contents.next_number, batch);
    }
  } catch (const InputError&) {
    return {};
  }
  for (LineScanner line; part.next_line(line);) {  // blank lines and comments are lines, too
  }
  contents.is_whole = true;
  return contents;
}

void ModelStage::pass(const StreamPosition& location) {
  scene_.pass_lines(location.line_count);
  next_number_ = location.number;
}

void ModelStage::fill(TriangleBatch& batch) {
  const auto add_one = [&](const TriangleCommand& triangle) {
    set_transform(batch, batch.size());
    add(triangle, scene_, next_number_, batch);
  };
  if (first_triangle_) add_one(*std::exchange(first_triangle_, std::nullopt));
  while (!done_) {
    const std::size_t size = batch.size();
    if (add_buffered(scene_, kBatchSize, next_number_, batch)) {
      set_transform(batch, size);
      continue;
    }
    // What is in memory is passed on before the reader waits for more.
    if (!batch.empty() && (batch.size() >= kBatchSize || !scene_.has_buffered_command())) break;
    const Command command = scene_.next();
    if (const auto* triangle = std::get_if<TriangleCommand>(&command)) {
      add_one(*triangle);
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

/// The matrix that holds from triangle `first` of the batch on.
void ModelStage::set_transform(TriangleBatch& batch, std::size_t first) {
  if (transform_ == nullptr)
    transform_ = std::make_shared<ModelTransform>(stack_.top(), scene_.appearance().columns().normal);
  if (batch.pending_transforms.empty() || batch.pending_transforms.back().transform != transform_)
    batch.pending_transforms.push_back({first, transform_});
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
  transform_.reset();
}

}  // namespace pipeline
