#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/deferred_error.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_source.h"
#include "libpipeline/vertex/matrix_stack.h"
#include "libpipeline/vertex/model_transform.h"

namespace pipeline {

/// The model stage: carries out a scene's commands, model space to world space.
class ModelStage final : public TriangleSource {
 public:
  /// Carries out what stands before the first triangle; a mistake there is thrown by the first `read`.
  explicit ModelStage(SceneReader& scene);

  /// The scene's color and light, the lights in world space.
  [[nodiscard]] Appearance appearance() const;
  /// The triangles are in model space, and their transforms to world space pending:
  /// apply_pending_transforms. False at the scene's end. An InputError if the matrix stack under- or
  /// overflows.
  bool read(TriangleBatch& batch) override;
  bool take_part(std::size_t size, TextPart& part, TriangleBatch& batch) override;
  [[nodiscard]] PartContents read_part(TextReader& part, TriangleBatch& batch) const override;
  void put_back(const TextPart& part) override { scene_.put_back(part); }
  [[nodiscard]] StreamPosition location() const override { return {scene_.line_count(), next_number_}; }
  void pass(const StreamPosition& location) override;

 private:
  void read_until_triangle();
  void fill(TriangleBatch& batch);
  void carry_out(const Command& command);
  void set_transform(TriangleBatch& batch, std::size_t first);
  void push();
  void pop();

  SceneReader& scene_;
  MatrixStack stack_;
  std::shared_ptr<const ModelTransform> transform_;  // of the stack's top; made when a triangle needs it
  std::vector<Located<Light>> lights_;               // in world space
  std::optional<TriangleCommand> first_triangle_;    // read, but not yet given out
  std::uint64_t next_number_ = 0;
  bool done_ = false;
  DeferredError deferred_error_;  // found behind triangles that were still to be given out
};

}  // namespace pipeline
