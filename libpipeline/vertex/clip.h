#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// A point in clip space before the divide: inside the view volume where -w <= x, y, z <= w.
/// `weights` say which mean of the triangle's corners it is, for their attributes.
struct ClipVertex {
  Ball x, y, z, w;
  std::array<double, 3> weights{};
};

ClipVertex to_clip_space(const ProjectionTransform& projection, const Vec3& p_view);

/// A plane of the view frustum, as it stands in clip space.
enum class ClipPlane { near, far, left, right, bottom, top };

constexpr std::array<ClipPlane, 6> kAllClipPlanes = {ClipPlane::near,  ClipPlane::far,    ClipPlane::left,
                                                     ClipPlane::right, ClipPlane::bottom, ClipPlane::top};
constexpr std::array<ClipPlane, 1> kNearPlane = {ClipPlane::near};

/// The signed distance from the plane, up to a factor: positive inside. The near plane's is z + w.
Ball distance_inside(ClipPlane plane, const ClipVertex& vertex);

/// The planes (bit i for kAllClipPlanes[i]) a vertex lies strictly outside of: its outcode (D. Cohen and
/// I. Sutherland, 1967). A vertex on a plane, or so near that 31 digits cannot tell, counts as inside.
unsigned outcode(const ClipVertex& vertex);

/// The part of a convex polygon inside all `planes` (I. Sutherland, G. Hodgman, "Reentrant polygon clipping",
/// 1974), in the same order round; empty if nothing but an edge or a corner is left. A cut is calculated from
/// the end of the edge that is nearer to the plane (of equals from the lower one, by y, x, z), so that
/// polygons that share an edge get the same point.
std::vector<ClipVertex> clip_polygon(std::span<const ClipVertex> polygon, std::span<const ClipPlane> planes);

}  // namespace pipeline
