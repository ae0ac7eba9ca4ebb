#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libpipeline/scene/scene.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/source_location.h"

namespace pipeline {

/// Finds a scene's legal but probably mistaken transforms and triangles; notes the first of each kind.
class OddTransforms {
 public:
  /// Looks at a rotate's numbers; the caller adds it by add_transform, too.
  void add(const RotateCommand& rotate, const SourceLocation& location);
  /// Adds a translate, scale or rotate.
  void add_transform(const SourceLocation& location) { last_transform_ = at(location); }
  void add_push(const SourceLocation& location) {
    if (saved_count_++ == 0) first_saved_ = at(location);
  }
  /// Adds a pop that matches a push.
  void add_pop() {
    --saved_count_;
    last_transform_ = {};
  }
  /// Adds an object, the purpose of the transforms before it.
  void add_object() { last_transform_ = {}; }
  /// Adds triangles in model space, some perhaps without area.
  void add(const TriangleBatch& p_model);

  /// The notes at the scene's end; `has_objects` is true if it has any object.
  [[nodiscard]] std::vector<std::string> notes(const std::string& file, bool has_objects) const;

 private:
  static LineAndColumn at(const SourceLocation& location) { return {location.line, location.column}; }

  LineAndColumn in_radians_, without_angle_, last_transform_, first_saved_;  // unknown if none
  double angle_ = 0;                                                         // the angle at in_radians_
  std::uint64_t saved_count_ = 0;
  LineAndColumn without_area_;  // the first such triangle
  std::uint64_t triangle_count_ = 0, without_area_count_ = 0;
  bool has_equal_vertices_ = false;  // of the triangle at without_area_
};

}  // namespace pipeline
