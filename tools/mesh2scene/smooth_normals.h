#pragma once

#include <array>
#include <vector>

struct aiMesh;

namespace pipeline {

using CornerNormals = std::vector<std::array<float, 3>>;

/// A unit normal for every corner of every triangle, three in a row for each: the mean of the normals of
/// those triangles at this position whose planes turn by at most `crease_degrees` from the corner's own,
/// weighted as in N. Max, "Weights for computing vertex normals from facet normals", Journal of Graphics
/// Tools 4(2), 1999, which makes it exact on a sphere. 0 where all of them have no area. The mesh has only
/// triangles.
CornerNormals smooth_normals(const aiMesh& mesh, double crease_degrees);

}  // namespace pipeline
