#pragma once

#include <array>
#include <vector>

struct aiMesh;

namespace pipeline {

using CornerNormals = std::vector<std::array<float, 3>>;

/// A unit normal for every corner of every triangle, three in a row for each: the mean of the normals of
/// those triangles at this position whose planes turn by at most `crease_degrees` from the corner's own,
/// weighted by the corner's angle and by the area in one plane. A plane that has nearly all of that area
/// keeps its normal; what turns by at most half the crease from it shares it, and the rest is smoothed
/// without it. 0 where no triangle has an area.
CornerNormals smooth_normals(const aiMesh& mesh, double crease_degrees);

}  // namespace pipeline
