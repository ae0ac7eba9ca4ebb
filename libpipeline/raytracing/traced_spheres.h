#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "libpipeline/raytracing/ellipsoid.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The spheres of a text in view space, by their place among them. Each takes 240 bytes.
class TracedSpheres {
 public:
  struct Sphere {
    Ellipsoid surface;
    Vec3 color;  // 0 if the text has no colors
    std::uint64_t number;
    std::uint32_t material;
  };

  [[nodiscard]] std::size_t size() const { return spheres_.size(); }
  [[nodiscard]] bool empty() const { return spheres_.empty(); }
  [[nodiscard]] const Sphere& operator[](std::size_t index) const { return spheres_[index]; }
  [[nodiscard]] bool have_colors() const { return have_colors_; }

  /// Adds the sphere whose first entry in a batch is `entry`; false if it has no volume.
  [[nodiscard]] bool add(const TriangleBatch& p_view, std::size_t entry);

 private:
  std::vector<Sphere> spheres_;
  bool have_colors_ = false;
};

}  // namespace pipeline
