#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// A point in clip space, before the divide: inside the view volume where -w <= x, y, z <= w. `weights` are
/// its barycentric coordinates in the triangle it was cut from, for interpolating attributes.
struct ClipVertex {
  /// The origin of a point that is a vertex's image.
  struct Origin {
    const ProjectionTransform* projection = nullptr;  // null for the point of a cut
    Vec3 p_view;
    double clip_inset = 0;

    bool operator==(const Origin&) const = default;
  };

  Ball x, y, z, w;
  std::array<double, 3> weights{};
  Origin origin = {};

  bool operator==(const ClipVertex&) const = default;
};

/// The image of a point, with weights 0; w is multiplied by 1 - clip_inset, exactly: a smaller w pulls in all
/// planes. `projection` has to outlive it.
ClipVertex to_clip_space(const ProjectionTransform& projection, const Vec3& p_view, double clip_inset = 0);

/// A plane of the view volume, from `near` to `above`, named after the place beyond it.
using ClipPlane = UnseenPlace;

constexpr std::array<ClipPlane, 6> kAllClipPlanes = {ClipPlane::near,  ClipPlane::far,   ClipPlane::left,
                                                     ClipPlane::right, ClipPlane::below, ClipPlane::above};
constexpr std::array<ClipPlane, 1> kNearPlane = {ClipPlane::near};

/// The signed distance from a plane in clip space, scaled: w + z for the near plane. Positive inside. Its
/// sign is certain for the image of a vertex, except at sides of a perspective whose tangent is not a double.
Ball distance_inside(ClipPlane plane, const ClipVertex& vertex);

/// The sign of distance_inside.
int side_of(ClipPlane plane, const ClipVertex& vertex);

/// A vertex's outcode (D. Cohen and I. Sutherland, 1967): the planes that it lies strictly outside of, bit i
/// for kAllClipPlanes[i]. A vertex on a plane, or so near that the side is not certain, counts as inside.
unsigned outcode(const ClipVertex& vertex);
/// The planes with at least one vertex of a polygon outside, and the planes with all vertices outside.
struct Outcodes {
  unsigned any = 0, all = ~0u;
};
Outcodes outcodes(std::span<const ClipVertex> polygon);

/// The part of a convex polygon inside all `planes` (I. Sutherland, G. Hodgman, "Reentrant polygon clipping",
/// 1974), in the same winding order; empty if at most an edge or a corner is left. A cut is interpolated from
/// the end of the edge nearer to the plane (if both are equally near, from the lower by y, x, z), so that
/// polygons that share an edge get the same point.
std::vector<ClipVertex> clip_polygon(std::span<const ClipVertex> polygon, std::span<const ClipPlane> planes);

/// A projection's view volume, to locate triangles in view space.
class ViewVolume {
 public:
  /// Its planes are pulled in by `clip_inset`, like a ProjectionStage's.
  explicit ViewVolume(const ProjectionTransform& projection, double clip_inset = 0);

  /// None if part of the triangle is inside or on the border, as far as 31 digits can tell; `behind` if no
  /// corner is in front of the eye. Otherwise the first plane, in the order of UnseenPlace, with all corners
  /// outside; or, if only clipping at several planes leaves nothing, the plane that cuts off the last part.
  [[nodiscard]] std::optional<UnseenPlace> outside(const Triangle& p_view) const;

 private:
  ProjectionTransform projection_;
  double clip_inset_;
  ProjectionCoefficients coefficients_;
};

}  // namespace pipeline
