#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// A point in clip space, before the divide: inside the view volume where -w <= x, y, z <= w. `weights` are
/// its barycentric coordinates in the triangle it was cut from, for interpolating attributes.
struct ClipVertex {
  Ball x, y, z, w;
  std::array<double, 3> weights{};

  bool operator==(const ClipVertex&) const = default;
};

/// The image of a point, with weights 0.
ClipVertex to_clip_space(const ProjectionTransform& projection, const Vec3& p_view);

/// The planes of the view volume.
enum class ClipPlane { near, far, left, right, bottom, top };

constexpr std::array<ClipPlane, 6> kAllClipPlanes = {ClipPlane::near,  ClipPlane::far,    ClipPlane::left,
                                                     ClipPlane::right, ClipPlane::bottom, ClipPlane::top};
constexpr std::array<ClipPlane, 1> kNearPlane = {ClipPlane::near};

/// The signed distance from a plane in clip space, scaled: w + z for the near plane. Positive inside.
Ball distance_inside(ClipPlane plane, const ClipVertex& vertex);

/// The planes (bit i for kAllClipPlanes[i]) a vertex lies strictly outside of: its outcode (D. Cohen and
/// I. Sutherland, 1967). A vertex on a plane, or so near that 31 digits cannot tell, counts as inside.
unsigned outcode(const ClipVertex& vertex);

/// The part of a convex polygon inside all `planes` (I. Sutherland, G. Hodgman, "Reentrant polygon clipping",
/// 1974), in the same winding order; empty if no more than an edge or a corner is left. A cut is interpolated
/// from the end of the edge nearer to the plane (from the lower one, by y, x, z, if both are equally near),
/// so that polygons that share an edge get the same point.
std::vector<ClipVertex> clip_polygon(std::span<const ClipVertex> polygon, std::span<const ClipPlane> planes);

}  // namespace pipeline
