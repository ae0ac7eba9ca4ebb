#pragma once

#include <cstdint>
#include <exception>
#include <optional>
#include <vector>

#include "libpipeline/attribute_transform.h"
#include "libpipeline/coordinate_rounder.h"
#include "libpipeline/matrix_stack.h"
#include "libpipeline/scene.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/vertex_transform.h"

namespace pipeline {

/// The model stage: carries out a scene's commands, model space to world space.
class ModelStage {
 public:
  /// Carries out what stands before the first triangle; a mistake there is thrown by the first `read`.
  ModelStage(SceneReader& scene, CoordinateRounder& rounder);

  /// The scene's colour and light, the lights in world space.
  [[nodiscard]] Appearance appearance() const;
  /// Fills `p_world` with the next triangles, as many as are waiting but at least one; false at the scene's
  /// end. An InputError if the matrix stack under- or overflows or an image leaves a double's range;
  /// triangles before a mistake are given out before it is thrown.
  bool read(TriangleBatch& p_world);

 private:
  void read_until_triangle();
  void fill(TriangleBatch& p_world);
  void carry_out(const Command& command);
  void add_attributes(TriangleBatch& p_world);
  void add(const TriangleCommand& command, TriangleBatch& p_world);
  void multiply(const AffineMatrix& t);
  void forget_transforms();
  void push();
  void pop();

  SceneReader& scene_;
  CoordinateRounder& rounder_;
  MatrixStack stack_;
  std::optional<VertexTransform> world_from_model_;  // of the stack's top; made when a triangle needs it
  std::optional<NormalTransform> world_normal_from_model_;  // likewise, and only where there are normals
  std::vector<Placed<Light>> lights_;                       // in world space
  std::optional<TriangleCommand> first_triangle_;           // read, but not yet given out
  std::uint64_t next_number_ = 0;
  bool done_ = false;
  std::exception_ptr mistake_;  // found behind triangles that were still to be given out
};

}  // namespace pipeline
