#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/deferred_error.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/attribute_transform.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/matrix_stack.h"
#include "libpipeline/vertex/odd_transforms.h"
#include "libpipeline/vertex/sphere_facets.h"
#include "libpipeline/vertex/vertex_transform.h"

namespace pipeline {

/// The form in which a scene's spheres are written.
struct SphereForm {
  bool is_refused = false;
  /// If given, a sphere becomes this many belts of facets (SphereFacets), and all triangles get normals.
  std::optional<std::size_t> belts;
};

/// The model stage: carries out a scene's commands, model space to world space.
class ModelStage {
 public:
  /// Carries out the commands before the first object; the first `read` throws an error in them. Triangles
  /// are numbered from `first_number` on.
  explicit ModelStage(SceneReader& scene, std::uint64_t first_number = 0, const SphereForm& spheres = {});

  /// The scene's color and light, the lights in world space.
  [[nodiscard]] Appearance appearance() const;
  /// The lights whose coordinates have an uncertain digit.
  [[nodiscard]] const UncertainDigits& uncertain_lights() const { return uncertain_lights_; }
  /// Fills the batch with the next triangles, in model space; false at the scene's end. An InputError if the
  /// scene is wrong or the matrix stack under- or overflows, thrown after the triangles before it are
  /// delivered.
  bool read(TriangleBatch& batch);
  /// Transforms the batch read last to world space, normals included. An InputError at the vertex on
  /// overflow, or where a facet's normal is lost; the batch then keeps the triangles before it.
  void transform(TriangleBatch& batch, CoordinateRounder& rounder);
  /// The first scale by 0 if no triangle transformed so far has an area; else none.
  [[nodiscard]] std::optional<SourceLocation> flattening_scale() const {
    return has_area_ ? std::nullopt : scale_by_0_;
  }
  [[nodiscard]] const OddTransforms& odd_transforms() const { return odd_transforms_; }

 private:
  /// The triangles and spheres of a batch under one matrix: from `first` up to the next run's `first`.
  struct Run {
    std::size_t first;
    VertexTransform world_from_model;
    std::optional<NormalTransform> world_normal_from_model;
  };

  void read_until_object();
  void fill(TriangleBatch& batch);
  bool add_buffered(TriangleBatch& batch);
  bool add_object(const Command& command, TriangleBatch& batch);
  void add(const TriangleCommand& triangle, TriangleBatch& batch);
  void add(const SphereCommand& sphere, TriangleBatch& batch);
  void add_facets(TriangleBatch& batch);
  void transform_normals(TriangleBatch& batch, const Run& run, std::size_t end,
                         CoordinateRounder& rounder) const;
  [[nodiscard]] AttributeSet columns() const;
  void carry_out(const Command& command);
  void keep_last_run();
  void begin_run(std::size_t first);
  void push();
  void pop();
  void look_for_area(const TriangleBatch& p_model);

  SceneReader& scene_;
  MatrixStack stack_;
  bool is_matrix_new_ = true;           // no run has it yet
  std::vector<Run> runs_;               // of the batch that was read last
  std::vector<Located<Light>> lights_;  // in world space
  UncertainDigits uncertain_lights_;
  std::optional<SourceLocation> scale_by_0_;  // the first
  OddTransforms odd_transforms_;
  bool has_area_ = false;                // a triangle has one, in world space
  std::optional<Command> first_object_;  // of the next batch, if already read
  bool refuses_spheres_;
  std::optional<SphereFacets> facets_;
  std::optional<SphereCommand> faceted_;  // the sphere whose facets come next
  std::size_t next_facet_ = 0;
  std::uint64_t next_number_;
  bool done_ = false;
  DeferredError deferred_error_;
};

}  // namespace pipeline
