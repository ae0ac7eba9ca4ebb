#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Looks at some places of the picture for two layers whose depths the decimals of the stage texts cannot
/// tell apart: which of them is seen there is decided by rounding. Only views in which decimals are that
/// coarse are looked at: to others this costs nothing.
class CloseLayers {
 public:
  struct Found {
    double share;               // of the places that show a triangle
    double gap;                 // the largest distance of two such layers along the view
    std::optional<int> enough;  // decimals that tell 9 of 10 apart; none if 12 do not
  };

  /// `decimals` of the texts of all stages; none if they are exact.
  CloseLayers(const ProjectionTransform& projection, std::optional<int> decimals);

  /// Adds triangles in NDC, before they are rounded.
  void add(const TriangleBatch& p_ndc);
  /// The layers found; none if they are less than a hundredth of the visible part.
  [[nodiscard]] std::optional<Found> found() const;

 private:
  static constexpr int kSide = 32;
  static constexpr std::size_t kMostLooks = std::size_t{1}
                                            << 22;  // no more than a second, whatever the scene

  /// The nearest surface at a place.
  struct Place {
    double z = 2;  // nothing
    double error = 0;
    double rival = 0;  // the distance in z to another layer that may be nearer, 0 if there is none
  };
  struct Plane {
    double z_x, z_y;  // slopes
  };

  void look_at(const Triangle& p_ndc);
  void look_at(Place& place, double z, const Plane& plane) const;
  [[nodiscard]] double distance_at(double z) const;
  [[nodiscard]] double slope_at(double distance) const;

  const ProjectionTransform& projection_;
  int decimals_ = 0;
  double half_unit_ = 0;  // of the last decimal; 0: not looked at
  double x_scale_, y_scale_;
  std::size_t look_count_ = 0;
  std::vector<Place> places_;  // row by row
};

}  // namespace pipeline
